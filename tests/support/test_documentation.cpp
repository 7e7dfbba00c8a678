// What is here: documentation held against the code: the reference of docs/user/design-files.md, keys, links
// and pages that text and sources name. What is not: whether the text is true.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "optimize/evaluate/design.h"
#include "results/measure_table.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;
const fs::path source = PERFORA_SOURCE_DIR;

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string printed_reference() {
  std::string text;
  FILE* pipe = popen("'" PERFORA_PROGRAM "' reference", "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " PERFORA_PROGRAM);
  char part[4096];
  for (std::size_t size; (size = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, size);
  EXPECT_EQ(pclose(pipe), 0);
  return text;
}

TEST(Documentation, ReferenceIsWhatTheTableOfKeysPrints) {
  const std::string text = read_text(source / "docs/user/design-files.md");
  const std::string line = "\n---\n\n";
  const auto place = text.find(line);
  ASSERT_NE(place, std::string::npos);
  EXPECT_EQ(text.substr(place + line.size()), printed_reference())
      << "the keys have changed: write what `perfora reference` prints below the line of docs/user/design-files.md";
}

TEST(Documentation, FormatsListTheTableOfMeasures) {
  const std::string text = read_text(source / "docs/user/formats.md");
  const std::string begin = "<!-- the table of measures begins -->\n", end = "<!-- the table of measures ends -->";
  const auto from = text.find(begin), to = text.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  const std::string written = text.substr(from + begin.size(), to - from - begin.size());
  EXPECT_EQ(written, results::measure_reference())
      << "the measures have changed: write this between the two marks of docs/user/formats.md";
}

/// The blocks of code in this language.
std::vector<std::string> blocks_of(const std::string& page, const std::string& language) {
  const std::string begin = "\n```" + language + "\n", end = "\n```\n";
  std::vector<std::string> blocks;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    const std::size_t to = page.find(end, at);
    blocks.push_back(page.substr(at, to + 1 - at));
    at = to;
  }
  return blocks;
}

// The consumer's programs are built and run by the test installed_library_serves_a_consumer.
TEST(Documentation, ProgramsOfTheLibrarysPageAreTheConsumers) {
  const std::string page = read_text(source / "docs/user/library.md");
  const fs::path consumer = source / "tests/support/consumer";
  EXPECT_THAT(blocks_of(page, "cpp"),
              ::testing::ElementsAre(read_text(consumer / "crush.cpp"), read_text(consumer / "sweep.cpp")));
  const std::string project = read_text(consumer / "CMakeLists.txt");
  EXPECT_THAT(blocks_of(page, "cmake"), ::testing::ElementsAre(project.substr(project.find('\n') + 1)));
}

TEST(Documentation, KeysThatTheTheoryNamesExist) {
  const optimize::DesignFile design;
  const std::regex name("`([a-z]+\\.[a-z_]+)( = [^`]*)?`");
  const std::string text = read_text(source / "docs/user/theory.md");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) {
    const std::string key = (*it)[1];
    const auto sections = design.schema().section_names();
    if (std::find(sections.begin(), sections.end(), key.substr(0, key.find('.'))) == sections.end()) continue;
    EXPECT_NE(design.schema().find(key), nullptr) << "docs/user/theory.md names " << key;
    ++found;
  }
  EXPECT_GT(found, 20);
}

/// Every text file of the project with one of these extensions; what is built or hidden is left out.
std::vector<fs::path> project_files(const std::vector<std::string>& extensions) {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(source); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.front() == '.' || name == "build" || name == "out" || name == "runs"))
      entry.disable_recursion_pending();
    const std::string extension = entry->path().extension().string();
    if (entry->is_regular_file() && std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
      files.push_back(entry->path());
  }
  return files;
}

/// The names under which GitHub finds the headings of a page: lower case, a hyphen for a blank, no punctuation.
std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto start = line.find_first_not_of('#');
    if (start == 0 || start == std::string::npos || line[start] != ' ') continue;
    std::string anchor;
    for (const char c : line.substr(start + 1))
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      else if (c == ' ')
        anchor += '-';
    anchors.insert(anchor);
  }
  return anchors;
}

/// Relative links of a page that lead nowhere: to a file that is missing, or to a heading its page does not have.
std::vector<std::string> broken_links(const fs::path& page, const std::string& text) {
  const std::regex link("\\]\\(([^)#:\\s]*)(#([^)\\s]*))?\\)");
  std::vector<std::string> broken;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string file = (*it)[1], anchor = (*it)[3];
    const fs::path target = file.empty() ? page : page.parent_path() / file;
    const bool found = fs::exists(target) && (anchor.empty() || anchors_of(read_text(target)).count(anchor) != 0);
    if (!found) broken.push_back(file + (*it)[2].str());
  }
  return broken;
}

TEST(Documentation, LinksLeadToFilesAndHeadingsThatExist) {
  const auto pages = project_files({".md"});
  ASSERT_GT(pages.size(), 10u);
  for (const auto& page : pages)
    EXPECT_THAT(broken_links(page, read_text(page)), ::testing::IsEmpty()) << "links of " << page;
}

TEST(Documentation, BrokenLinksAreFound) {
  const std::string text = "[a](README.md) [b](no.md) [c](README.md#two-commands) [d](README.md#no) [e](https://x.org)";
  EXPECT_THAT(broken_links(source / "page.md", text), ::testing::ElementsAre("no.md", "README.md#no"));
}

/// The text in one line: marks of comments and joints of string literals left out, so that a name may be wrapped.
std::string unwrapped(const std::string& text) {
  std::string joined = std::regex_replace(text, std::regex("\\n\\s*(///?<?|#)? *"), " ");
  joined = std::regex_replace(joined, std::regex("\\\\\""), "\"");
  return joined;
}

TEST(Documentation, PagesAndSectionsThatSourcesNameExist) {
  const std::regex name("docs/[A-Za-z0-9_/-]+\\.md(,? \"([^\"]+)\")?");
  int pages = 0, sections = 0;
  for (const auto& file : project_files({".h", ".cpp", ".md", ".toml", ".py", ".txt"})) {
    const std::string text = unwrapped(read_text(file));
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++pages) {
      const std::string page = it->str().substr(0, it->str().find(".md") + 3), section = (*it)[2];
      EXPECT_TRUE(fs::exists(source / page)) << file << " names " << page;
      if (section.empty()) continue;
      EXPECT_NE(read_text(source / page).find("# " + section + "\n"), std::string::npos)
          << file << " names the section \"" << section << "\" of " << page;
      ++sections;
    }
  }
  EXPECT_GT(pages, 20);
  EXPECT_GT(sections, 10);
}

}  // namespace
}  // namespace perfora::test
