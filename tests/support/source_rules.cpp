// What is here: the rules themselves. What is not: a parser of C++; a line that begins with #include is one, wherever
// it stands.
#include "tests/support/source_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace perfora::test {
namespace {

/// A library whose headers may be named in few places only.
struct Confined {
  std::regex include;
  std::regex allowed_in;
  std::string sentence;
};

const std::vector<Confined>& confined_libraries() {
  static const std::vector<Confined> list = {
      {std::regex("CGAL/.*"), std::regex("geometry/[^/]+\\.cpp"), "CGAL belongs in geometry/*.cpp only"},
      {std::regex("nlopt\\.h(pp)?"), std::regex("optimize/[^/]+\\.cpp"), "NLopt belongs in one optimize/*.cpp only"},
      {std::regex("toml\\+\\+/.*|toml\\.hpp"), std::regex("io/[^/]+\\.cpp"), "toml++ belongs in one io/*.cpp only"},
      {std::regex("H5.*|hdf5(_hl)?\\.h"), std::regex("io/hdf5(_[a-z]+)?\\.cpp|io/hdf5_[a-z]+\\.h"),
       "HDF5's C API belongs in io/hdf5*.cpp only"},
  };
  return list;
}

/// Rank of the room a path begins with, or -1.
int room_rank(const std::string& path) {
  const auto found = std::find(rooms.begin(), rooms.end(), path.substr(0, path.find('/')));
  if (found == rooms.end() || path.find('/') == std::string::npos) return -1;
  return static_cast<int>(found - rooms.begin());
}

void check_include(const std::string& path, const std::string& include, std::vector<std::string>& out) {
  const int from = room_rank(path);
  const int to = room_rank(include);
  if (include.find("..") != std::string::npos)
    out.push_back(path + ": include \"" + include + "\" by its room, not by \"..\"");
  if (to > from) {
    const auto room = static_cast<std::size_t>(from);
    out.push_back(path + ": includes " + include + ", but " + rooms[room] + " knows nothing of " +
                  rooms[static_cast<std::size_t>(to)]);
  }
  for (const auto& library : confined_libraries())
    if (std::regex_match(include, library.include) && !std::regex_match(path, library.allowed_in))
      out.push_back(path + ": includes <" + include + ">: " + library.sentence);
}

}  // namespace

std::vector<std::string> includes_of(std::string_view text) {
  static const std::regex pattern("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::vector<std::string> found;
  std::istringstream stream{std::string(text)};
  std::smatch match;
  for (std::string line; std::getline(stream, line);)
    if (std::regex_match(line, match, pattern)) found.push_back(match[1]);
  return found;
}

std::vector<std::string> violations(const std::string& path, std::string_view text) {
  std::vector<std::string> out;
  if (text.substr(0, 2) != "//")
    out.push_back(path + ": the first line is no comment that says what is here and what is not");
  const auto lines = std::count(text.begin(), text.end(), '\n');
  if (lines > maximum_lines)
    out.push_back(path + ": " + std::to_string(lines) + " lines; at most " + std::to_string(maximum_lines) +
                  " are read in one go; split it");
  if (room_rank(path) >= 0)
    for (const auto& include : includes_of(text)) check_include(path, include, out);
  return out;
}

std::vector<std::string> violations_together(const std::map<std::string, std::string>& files) {
  std::vector<std::string> out;
  for (const std::string name : {"nlopt", "toml"}) {
    std::vector<std::string> users;
    for (const auto& [path, text] : files) {
      const auto includes = includes_of(text);
      const bool uses = std::any_of(includes.begin(), includes.end(), [&](const std::string& include) {
        return include.rfind(name + ".h", 0) == 0 || include.rfind(name + "++/", 0) == 0;
      });
      if (room_rank(path) >= 0 && uses) users.push_back(path);
    }
    if (users.size() > 1) out.push_back(users[1] + ": a second file besides " + users[0] + " includes " + name);
  }
  return out;
}

}  // namespace perfora::test
