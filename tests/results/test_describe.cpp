// What is here: every file Perfora writes has a summary or is described; anything else is refused in words. What is
// not: how summaries read (test_summary_text.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/journal.h"
#include "results/describe.h"
#include "tests/io/io_support.h"

namespace perfora::results {
namespace {

using io::input_error;
using io::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(StoredSummary, OfResultFilesAndFolders) {
  const TemporaryFolder folder;
  const nlohmann::json record = {{"schema", "perfora.evaluate/1"}, {"status", "completed"}};
  io::Hdf5Writer file(folder / "R.h5");
  file.attribute("/", "format", std::string("perfora.run/1"));
  file.text("/summary", record.dump());
  file.commit();
  EXPECT_EQ(stored_summary(folder / "R.h5"), record);
  EXPECT_EQ(stored_summary(folder.file("a.json", record.dump())), record);
  EXPECT_EQ(stored_summary(folder.path()), std::nullopt) << "neither result.json nor ensemble.json";
  folder.file("ensemble.json", record.dump());
  EXPECT_EQ(stored_summary(folder.path()), record);
}

TEST(StoredSummary, RefusesWhatIsBroken) {
  const TemporaryFolder folder;
  folder.file("empty.json", "");
  folder.file("other.json", "{\"a\": 1}");
  folder.file("number.json", "{\"schema\": 1}");
  folder.file("list.json", "[]");
  folder.file("broken.json", "{\"schema\": \"perfora.pack/1\", ");
  folder.file("short.h5", "\x89HDF\r\n\x1a\n and no more");
  for (const char* name : {"empty.json", "other.json", "number.json", "list.json", "broken.json"})
    EXPECT_THAT(input_error([&] { stored_summary(folder / name); }), AllOf(HasSubstr(name), HasSubstr("(.h5)")));
  for (const char* name : {"missing.h5", "missing.json", "short.h5"})
    EXPECT_THAT(input_error([&] { stored_summary(folder / name); }), HasSubstr(name));
}

TEST(Describe, CheckpointAndXdmfCompanion) {
  const TemporaryFolder folder;
  io::Hdf5Writer companion(folder / "R.xdmf.h5");
  companion.attribute("/", "format", std::string("perfora.xdmf/1"));
  companion.commit();
  EXPECT_THAT(describe_file(folder / "R.xdmf.h5"), HasSubstr("R.xdmf"));
  io::Hdf5Writer file(folder / "checkpoint.h5");
  file.attribute("/", "format", std::string("perfora.checkpoint/1"));
  file.attribute("/", "strain", 0.123);
  file.attribute("/", "steps", std::int64_t{1234567});
  file.dataset("/simulation/discs/radius", std::vector<double>(1000, 1e-3));
  file.commit();
  EXPECT_THAT(describe_file(folder / "checkpoint.h5"),
              AllOf(HasSubstr("12.3 %"), HasSubstr("1,234,567"), HasSubstr("1,000"), HasSubstr("--resume")));
  EXPECT_EQ(describe_file(folder.path()), describe_file(folder / "checkpoint.h5"));
}

TEST(Describe, JournalEvenTornAndWithoutItsLock) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.jsonl";
  io::Journal journal(path);
  journal.append(R"({"event": "study"})");
  journal.append(R"({"event": "evaluation", "score": 1})");
  journal.append(R"({"event": "evaluation", "score": 2})");
  EXPECT_THAT(describe_file(path),
              AllOf(ContainsRegex("evaluation +2"), ContainsRegex("study +1"), Not(HasSubstr("torn"))));
  const std::string whole = io::read_file(path);
  io::write_file(path, whole + "0123abcd {\"event\": \"eval");
  EXPECT_THAT(describe_file(path), AllOf(ContainsRegex("evaluation +2"), HasSubstr("torn")));
  std::string damaged = whole;
  damaged[whole.find("study")] = 'X';
  io::write_file(path, damaged);
  EXPECT_THAT(describe_file(path), HasSubstr("line 1 fails its checksum"));
}

TEST(Describe, Toml) {
  const TemporaryFolder folder;
  folder.file("design.toml", "title = \"a\"\n[layout]\ndiameter = \"20 mm\"\nrows = 6\nx = [1, 2, 3, 4, 5, 6, 7]\n");
  EXPECT_THAT(describe_file(folder / "design.toml"), AllOf(HasSubstr("Design"), HasSubstr("[layout]"),
                                                           ContainsRegex("diameter +20 mm"), HasSubstr("[7 values]")));
  folder.file("study.toml", "[study]\nmaxeval = 10\n");
  EXPECT_THAT(describe_file(folder / "study.toml"), HasSubstr("Study"));
}

TEST(Describe, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  folder.file("a.txt", "hello");
  folder.file("empty.txt", "");
  for (const char* name : {"a.txt", "empty.txt"})
    EXPECT_THAT(input_error([&] { describe_file(folder / name); }), AllOf(HasSubstr(name), HasSubstr("(.h5)")));
  std::filesystem::create_directory(folder / "sub");
  EXPECT_THAT(input_error([&] { describe_file(folder / "sub"); }), HasSubstr("no journal, checkpoint or result"));
}

}  // namespace
}  // namespace perfora::results
