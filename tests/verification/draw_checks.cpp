// What is here: the tables of docs/verification.md, from what the checks wrote.
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/verification/draw_verification.h"

namespace perfora::verification {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Suite of a line "Prefix/Suite | what | ...": without GoogleTest's prefix of parameterised suites.
std::string suite_of(const std::string& line) {
  const std::string suite = line.substr(0, line.find(" | "));
  return suite.substr(suite.find('/') == std::string::npos ? 0 : suite.find('/') + 1);
}

}  // namespace

void insert_checks(const std::filesystem::path& docs) {
  std::map<std::string, std::string> tables;
  std::istringstream lines(read(docs / "data" / "verification" / "checks.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::string& table = tables[suite_of(line)];
    if (table.empty()) table = "\n| check | measured | expected | holds |\n|---|---|---|---|\n";
    std::string row = line.substr(line.find(" | ") + 3);
    // A bar inside a formula would end the cell.
    for (std::size_t at = row.find("|r|"); at != std::string::npos; at = row.find("|r|", at)) row.replace(at, 3, "r");
    table += "| " + row + " |\n";
  }
  std::string document = read(docs / "verification.md");
  for (const auto& [suite, table] : tables) {
    const std::string open = "<!-- checks: " + suite + " -->\n", close = "<!-- end -->";
    const std::size_t start = document.find(open);
    if (start == std::string::npos) throw std::runtime_error("verification.md has no place for suite " + suite);
    const std::size_t from = start + open.size(), to = document.find(close, from);
    if (to == std::string::npos) throw std::runtime_error("verification.md: no end mark for suite " + suite);
    document.replace(from, to - from, table + "\n");
  }
  std::ofstream(docs / "verification.md") << document;
}

}  // namespace perfora::verification
