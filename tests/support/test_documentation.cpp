// What is here: documentation held against the code: the reference of docs/design-files.md, keys and files that other
// pages name. What is not: whether the text is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "optimize/evaluate/design.h"

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
  const std::string text = read_text(source / "docs/design-files.md");
  const std::string line = "\n---\n\n";
  const auto place = text.find(line);
  ASSERT_NE(place, std::string::npos);
  EXPECT_EQ(text.substr(place + line.size()), printed_reference())
      << "the keys have changed: write what `perfora reference` prints below the line of docs/design-files.md";
}

TEST(Documentation, KeysThatTheTheoryNamesExist) {
  const optimize::DesignFile design;
  const std::regex name("`([a-z]+\\.[a-z_]+)( = [^`]*)?`");
  const std::string text = read_text(source / "docs/theory.md");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) {
    const std::string key = (*it)[1];
    const auto sections = design.schema().section_names();
    if (std::find(sections.begin(), sections.end(), key.substr(0, key.find('.'))) == sections.end()) continue;
    EXPECT_NE(design.schema().find(key), nullptr) << "docs/theory.md names " << key;
    ++found;
  }
  EXPECT_GT(found, 20);
}

TEST(Documentation, LinksLeadToFilesThatExist) {
  const std::regex link("\\]\\(([^)#:]+)(#[^)]*)?\\)");
  std::vector<fs::path> pages = {source / "README.md", source / "designs/README.md"};
  for (const auto& entry : fs::directory_iterator(source / "docs")) pages.push_back(entry.path());
  for (const auto& page : pages) {
    if (page.extension() != ".md" || !fs::exists(page)) continue;
    const std::string text = read_text(page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it)
      EXPECT_TRUE(fs::exists(page.parent_path() / (*it)[1].str())) << page << " links to " << (*it)[1];
  }
}

}  // namespace
}  // namespace perfora::test
