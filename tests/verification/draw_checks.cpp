// What is here: the tables of docs/developer/verification.md, from what the checks wrote.
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

/// A row whose formulas Markdown leaves alone: |r| would end the cell, E* would be taken for emphasis.
std::string in_markdown(const std::string& row) {
  const std::string no = "**no**";
  std::string text;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (row.compare(k, 3, "|r|") == 0) {
      text += 'r';
      k += 2;
    } else if (row.compare(k, no.size(), no) == 0) {
      text += no;
      k += no.size() - 1;
    } else {
      if (row[k] == '*') text += '\\';
      text += row[k];
    }
  }
  return text;
}

}  // namespace

void insert_checks(const std::filesystem::path& docs) {
  std::map<std::string, std::string> tables;
  std::istringstream lines(read(docs / "data" / "verification" / "checks.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::string& table = tables[suite_of(line)];
    if (table.empty()) table = "\n| check | measured | expected | holds |\n|---|---|---|---|\n";
    table += "| " + in_markdown(line.substr(line.find(" | ") + 3)) + " |\n";
  }
  const auto page = docs / "developer" / "verification.md";
  std::string document = read(page);
  for (const auto& [suite, table] : tables) {
    const std::string open = "<!-- checks: " + suite + " -->\n", close = "<!-- end -->";
    const std::size_t start = document.find(open);
    if (start == std::string::npos) throw std::runtime_error("verification.md has no place for suite " + suite);
    const std::size_t from = start + open.size(), to = document.find(close, from);
    if (to == std::string::npos) throw std::runtime_error("verification.md: no end mark for suite " + suite);
    document.replace(from, to - from, table + "\n");
  }
  std::ofstream(page) << document;
}

}  // namespace perfora::verification
