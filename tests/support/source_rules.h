// What is here: the rules of the house that source files must keep (arrows between rooms, libraries that stay in one
// file, opening comment, length), as a check of one file's text. What is not: reading the tree (test_room_arrows.cpp).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace perfora::test {

/// A file longer than this should be two.
inline constexpr int maximum_lines = 400;

/// A room, and the rooms it may include beside itself. The first part of a path that names a room decides.
struct Room {
  std::string name;
  std::vector<std::string> knows;
};

/// Rooms from the ground up. `report` reads results alone; `app` knows all but `perfora`, the public face, which
/// `bindings` alone includes.
inline const std::vector<Room> rooms = {
    {"io", {}},
    {"geometry", {"io"}},
    {"results", {"io", "geometry"}},
    {"solver", {"io", "geometry", "results"}},
    {"optimize/evaluate", {"io", "geometry", "results", "solver"}},
    {"optimize/campaign", {"io", "geometry", "results", "solver", "optimize/evaluate"}},
    {"optimize/model", {"io", "geometry", "results", "solver", "optimize/evaluate"}},
    {"optimize/search",
     {"io", "geometry", "results", "solver", "optimize/evaluate", "optimize/campaign", "optimize/model"}},
    {"perfora", {"io", "geometry", "results", "solver", "optimize/evaluate", "optimize/campaign", "optimize/search"}},
    {"bindings", {"perfora"}},
    {"report/export", {"io", "geometry", "results"}},
    {"report", {"io", "geometry", "results"}},
    {"app",
     {"io", "geometry", "results", "solver", "optimize/evaluate", "optimize/campaign", "optimize/model",
      "optimize/search", "report", "report/export"}},
};

/// Headers of the room perfora that are not installed; the others include the standard library and each other alone.
inline const std::vector<std::string> private_headers = {"perfora/inside.h"};

/// Folders inside the room solver that its other files stand upon.
inline const std::vector<std::string> solver_rooms = {"solver/kernels", "solver/elastic"};

/// What the file's `#include` lines name, in order, with the brackets or quotes left out.
std::vector<std::string> includes_of(std::string_view text);

/// What is wrong with one file, a sentence each ("" is never among them). `path` is relative to the project,
/// "solver/laws.h". Files outside the rooms (tests) are held to the opening comment and the length alone.
std::vector<std::string> violations(const std::string& path, std::string_view text);

/// Rules that need all files at once (path -> text): NLopt's and toml++'s headers, each included by one .cpp file at
/// most; a folder inside a room includes no file of the room that includes the folder, directly or through others; the
/// shapes of geometry/shapes.h are named in geometry alone.
std::vector<std::string> violations_together(const std::map<std::string, std::string>& files);

}  // namespace perfora::test
