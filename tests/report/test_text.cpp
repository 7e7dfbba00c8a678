// What is here: every file Perfora writes is described; anything else is refused in words. What is not: the program's
// `show`.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error.h"
#include "io/hdf5.h"
#include "io/journal.h"
#include "report/text.h"
#include "report/xdmf.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using results::testing::fresh_folder;
using ::testing::HasSubstr;

std::string refusal(const std::filesystem::path& path) {
  try {
    describe_file(path);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Describe, RunPackingAndXdmfCompanion) {
  const auto folder = fresh_folder("describe");
  const results::testing::SyntheticRun run = results::testing::make_run(0.05, 2, 1e-3, 0.6);
  write_run(run, folder / "R.h5");
  write_pack(run, folder / "P.h5");
  write_xdmf(folder / "R.h5", folder / "R.xdmf");
  // Values of ${PROJECT_SOURCE_DIR}/tests/results/synthetic_run.cpp: peak 0.55 MPa at 0.9 %, plateau 0.025 MPa, 1,201 rows, 8 frames.
  EXPECT_THAT(describe_file(folder / "R.h5"),
              AllOf(HasSubstr("completed, reached the wanted strain"), HasSubstr("50.00 x 50.00 mm"),
                    HasSubstr("1,201 rows"), ContainsRegex("frames +8, strain 0 % to 60.00 %"),
                    ContainsRegex("first peak stress +0.5500 MPa"), ContainsRegex("first peak strain +0.9000 %"),
                    ContainsRegex("plateau window +20 %, 40 %"), ContainsRegex("broken bonds +61,234")));
  EXPECT_THAT(describe_file(folder / "P.h5"),
              AllOf(HasSubstr("Packing"), ContainsRegex("thinnest wall +5 mm"), ContainsRegex("perforations +4")));
  EXPECT_THAT(describe_file(folder / "R.xdmf.h5"), HasSubstr("R.xdmf"));
}

TEST(Describe, Checkpoint) {
  const auto folder = fresh_folder("checkpoint");
  io::Hdf5Writer file(folder / "checkpoint.h5");
  file.attribute("/", "format", std::string("perfora.checkpoint/1"));
  file.attribute("/", "strain", 0.123);
  file.attribute("/", "steps", std::int64_t{1234567});
  file.dataset("/discs/radius", std::vector<double>(1000, 1e-3));
  file.commit();
  EXPECT_THAT(describe_file(folder / "checkpoint.h5"),
              AllOf(HasSubstr("12.30 %"), HasSubstr("1,234,567"), HasSubstr("1,000"), HasSubstr("--resume")));
  EXPECT_EQ(describe_file(folder), describe_file(folder / "checkpoint.h5"));
}

TEST(Describe, JournalEvenTornAndWithoutItsLock) {
  const auto path = fresh_folder("journal") / "journal.jsonl";
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

TEST(Describe, ResultAndToml) {
  const auto folder = fresh_folder("result");
  io::write_file(
      folder / "result.json",
      R"({"schema": "perfora.optimize/1", "score": 0.0123, "target": 40000.0, "best": {"layout.diameter": 0.0182},
      "stop_reason": null, "seeds": {"packing": 12345678901234}, "curve": [1,2,3,4,5,6,7,8]})");
  EXPECT_THAT(describe_file(folder / "result.json"),
              AllOf(ContainsRegex("target +0.04000 MPa"), ContainsRegex("layout.diameter +18.20 mm"),
                    ContainsRegex("stop reason +not reached"), ContainsRegex("packing +12345678901234"),
                    ContainsRegex("curve +8 entries")));
  io::write_file(folder / "design.toml", "title = \"a\"\n[layout]\ndiameter = \"20 mm\"\nrows = 6\n");
  EXPECT_THAT(describe_file(folder / "design.toml"),
              AllOf(HasSubstr("Design"), HasSubstr("[layout]"), ContainsRegex("diameter +\"20 mm\"")));
  io::write_file(folder / "study.toml", "[study]\nmaxeval = 10\n");
  EXPECT_THAT(describe_file(folder / "study.toml"), HasSubstr("Study"));
}

TEST(Describe, RefusesWhatItCannotRead) {
  const auto folder = fresh_folder("unknown");
  io::write_file(folder / "a.txt", "hello");
  io::write_file(folder / "empty.json", "");
  io::write_file(folder / "other.json", "{\"a\": 1}");
  io::write_file(folder / "broken.json", "{\"a\": ");
  io::write_file(folder / "short.h5", "\x89HDF\r\n\x1a\n and no more");
  for (const char* name : {"a.txt", "empty.json", "other.json", "broken.json"})
    EXPECT_THAT(refusal(folder / name), AllOf(HasSubstr(name), HasSubstr("a run (R.h5)"))) << name;
  for (const char* name : {"missing.h5", "short.h5"}) EXPECT_THAT(refusal(folder / name), HasSubstr(name));
  std::filesystem::create_directory(folder / "sub");
  EXPECT_THAT(refusal(folder / "sub"), HasSubstr("no journal, checkpoint or result"));
}

}  // namespace
}  // namespace perfora::report
