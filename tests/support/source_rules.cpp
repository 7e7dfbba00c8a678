// What is here: the rules themselves. What is not: a parser of C++; a line that begins with #include is one, wherever
// it stands.
#include "tests/support/source_rules.h"

#include <algorithm>
#include <regex>
#include <set>
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
      {std::regex("nlopt\\.h(pp)?"), std::regex("optimize/search/[^/]+\\.cpp"),
       "NLopt belongs in one optimize/search/*.cpp only"},
      {std::regex("toml\\+\\+/.*|toml\\.hpp"), std::regex("io/[^/]+\\.cpp"), "toml++ belongs in one io/*.cpp only"},
      {std::regex("pybind11/.*|Python\\.h"), std::regex("bindings/[^/]+\\.(cpp|h)"), "Python belongs in bindings only"},
      {std::regex("H5.*|hdf5(_hl)?\\.h"), std::regex("io/hdf5(_[a-z]+)?\\.cpp|io/hdf5_[a-z]+\\.h"),
       "HDF5's C API belongs in io/hdf5*.cpp only"},
  };
  return list;
}

bool lies_in(const std::string& path, const std::string& folder) {
  return path.rfind(folder + "/", 0) == 0;
}

/// The room a path lies in, or nullptr.
const Room* room_of(const std::string& path) {
  const auto found =
      std::find_if(rooms.begin(), rooms.end(), [&](const Room& room) { return lies_in(path, room.name); });
  return found == rooms.end() ? nullptr : &*found;
}

/// Whether a file is a header that users of the library include.
bool is_public(const std::string& path) {
  return lies_in(path, "perfora") && path.ends_with(".h") &&
         std::find(private_headers.begin(), private_headers.end(), path) == private_headers.end();
}

void check_include(const std::string& path, const std::string& include, std::vector<std::string>& out) {
  const Room* from = room_of(path);
  const Room* to = room_of(include);
  if (include.find("..") != std::string::npos)
    out.push_back(path + ": include \"" + include + "\" by its room, not by \"..\"");
  if (to && to != from && std::find(from->knows.begin(), from->knows.end(), to->name) == from->knows.end())
    out.push_back(path + ": includes " + include + ", but " + from->name + " knows nothing of " + to->name);
  if (lies_in(path, "bindings") && to && to->name == "perfora" && !is_public(include))
    out.push_back(path + ": includes " + include + ", which is no public header");
  if (is_public(path) && !is_public(include) && include.find('.') != std::string::npos)
    out.push_back(path + ": includes " + include + ", which is neither of the standard library nor installed with it");
  for (const auto& library : confined_libraries())
    if (std::regex_match(include, library.include) && !std::regex_match(path, library.allowed_in))
      out.push_back(path + ": includes <" + include + ">: " + library.sentence);
}

/// The other rooms ask a perforation, never its shape: none of them names an alternative of geometry's `Shape`.
void check_shapes(const std::map<std::string, std::string>& files, std::vector<std::string>& out) {
  const auto header = files.find("geometry/shapes.h");
  static const std::regex list("using Shape = std::variant<([^>]*)>"), name("\\w+");
  std::smatch alternatives;
  if (header == files.end() || !std::regex_search(header->second, alternatives, list)) return;
  const std::string names = alternatives[1];
  for (auto shape = std::sregex_iterator(names.begin(), names.end(), name); shape != std::sregex_iterator(); ++shape)
    for (const auto& [path, text] : files)
      if (room_of(path) && !lies_in(path, "geometry") &&
          std::regex_search(text, std::regex("geometry::" + shape->str() + "\\b")))
        out.push_back(path + ": names the shape " + shape->str() + ", which belongs in geometry only");
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
  // They go by the locale of the process, which a program around the library may set: 0.5 would be read as 0.
  for (const char* by_locale : {"strtod(", "strtof(", "std::stod(", "std::stof(", "atof(", "sscanf(", "snprintf("})
    if (!path.starts_with("tests/") && text.find(by_locale) != std::string_view::npos)
      out.push_back(path + ": " + by_locale +
                    ") goes by the locale; read with io/numbers.h, print with io/text.h or fmt");
  if (room_of(path))
    for (const auto& include : includes_of(text)) check_include(path, include, out);
  return out;
}

namespace {

/// Files that `path` includes, directly or through others.
std::set<std::string> reached_from(const std::string& path, const std::map<std::string, std::string>& files) {
  std::set<std::string> reached;
  std::vector<std::string> waiting = {path};
  while (!waiting.empty()) {
    const auto file = files.find(waiting.back());
    waiting.pop_back();
    if (file == files.end()) continue;
    for (const auto& include : includes_of(file->second))
      if (reached.insert(include).second) waiting.push_back(include);
  }
  return reached;
}

}  // namespace

std::vector<std::string> violations_together(const std::map<std::string, std::string>& files) {
  std::vector<std::string> out;
  check_shapes(files, out);
  for (const std::string name : {"nlopt", "toml"}) {
    std::vector<std::string> users;
    for (const auto& [path, text] : files) {
      const auto includes = includes_of(text);
      const bool uses = std::any_of(includes.begin(), includes.end(), [&](const std::string& include) {
        return include.rfind(name + ".h", 0) == 0 || include.rfind(name + "++/", 0) == 0;
      });
      if (room_of(path) && uses) users.push_back(path);
    }
    if (users.size() > 1) out.push_back(users[1] + ": a second file besides " + users[0] + " includes " + name);
  }
  for (const auto& [path, text] : files)
    for (const auto& folder : solver_rooms) {
      if (!lies_in(path, folder)) continue;
      for (const auto& include : includes_of(text)) {
        if (lies_in(include, folder)) continue;
        for (const auto& further : reached_from(include, files))
          if (lies_in(further, folder))
            out.push_back(path + ": includes " + include + ", which includes " + further + " of this folder");
      }
    }
  return out;
}

}  // namespace perfora::test
