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

/// Rooms from the ground up: a room includes itself and the rooms before it.
inline const std::vector<std::string> rooms = {"io", "geometry", "solver", "optimize", "report", "app"};

/// What the file's `#include` lines name, in order, with the brackets or quotes left out.
std::vector<std::string> includes_of(std::string_view text);

/// What is wrong with one file, a sentence each ("" is never among them). `path` is relative to the project,
/// "solver/laws.h". Files outside the rooms (tests) are held to the opening comment and the length alone.
std::vector<std::string> violations(const std::string& path, std::string_view text);

/// Rules that need all files at once (path -> text): NLopt's and toml++'s headers, each included by one .cpp file at
/// most.
std::vector<std::string> violations_together(const std::map<std::string, std::string>& files);

}  // namespace perfora::test
