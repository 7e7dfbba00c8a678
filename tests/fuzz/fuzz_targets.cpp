// What is here: the targets: designs, sweeps and studies, layouts and outlines, curves, HDF5 files, journals.
// What is not: a checkpoint's way into a simulation (tests/faults/try_mutations.py tries that).
#include "fuzz_targets.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "geometry/layout.h"
#include "geometry/outline_file.h"
#include "io/error.h"
#include "io/files.h"
#include "io/journal.h"
#include "optimize/campaign/sweep.h"
#include "optimize/evaluate/design.h"
#include "optimize/search/study.h"
#include "results/campaign_folder.h"
#include "results/curve_file.h"
#include "results/describe.h"
#include "results/elastic_file.h"
#include "results/history_file.h"
#include "results/material_file.h"
#include "results/pack_file.h"
#include "results/run_file.h"
#include "results/sweep_record.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void stop(const std::string& why) {
  std::fprintf(stderr, "not allowed: %s\n", why.c_str());
  std::abort();
}

/// A folder of this process that goes with it.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "perfora-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) stop("no folder");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path path_;
};

/// The input as a file that readers are given by name.
fs::path file_of(std::string_view input, const char* name) {
  static const Folder folder;
  const fs::path path = folder.path_ / name;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr || std::fwrite(input.data(), 1, input.size(), file) != input.size()) stop("cannot write");
  std::fclose(file);
  return path;
}

/// Refused or not: the next reader has its turn.
template <class Read>
void let(const Read& read) {
  try {
    read();
  } catch (const io::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) stop("two lines: " + std::string(error.what()));
  }
}

void design(std::string_view input) {
  const optimize::DesignFile file = optimize::DesignFile::from_toml(std::string(input), "design.toml");
  const std::string written = file.schema().to_toml();
  // What is accepted is written so that it is accepted again, and means the same.
  if (optimize::DesignFile::from_toml(written, "again.toml").schema().to_toml() != written) stop("not the same again");
}

void campaign(std::string_view input) {
  const fs::path path = file_of(input, "work.toml");
  file_of("[cell]\nwidth = \"12 mm\"\nheight = \"12 mm\"\n[layout]\nrows = 1\ncolumns = 1\ndiameter = \"6 mm\"\n",
          "d.toml");
  let([&] { (void)optimize::read_sweep(path); });
  let([&] { (void)optimize::read_study(path); });
}

void layout(std::string_view input) {
  geometry::LayoutOptions options;
  options.family = geometry::LayoutFamily::list;
  options.file = file_of(input, "holes.csv").string();
  (void)geometry::place_perforations(options, 1);
}

void outline(std::string_view input) {
  (void)geometry::parse_wkt_polygon(input);
  (void)geometry::read_outline(file_of(input, "outline.txt"));
}

void curve(std::string_view input) {
  (void)results::read_curve(file_of(input, "curve.csv"));
}

void hdf5(std::string_view input) {
  const fs::path path = file_of(input, "file.h5");
  let([&] { (void)results::describe_file(path); });
  let([&] { (void)results::stored_summary(path); });
  let([&] { (void)results::read_pack(path); });
  let([&] { (void)results::read_elastic(path); });
  let([&] { (void)results::read_material_tests(path); });
  let([&] { (void)results::read_history_file(path); });
  let([&] {
    const results::RunResult run = results::read_run(path);
    for (std::size_t k = 0; k < run.frames.size(); ++k) let([&] { (void)results::read_frame(run, k); });
  });
}

/// The lines with the checksums that they should have: what is behind them is looked at.
void journal(std::string_view input) {
  std::string text;
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string_view line = input.substr(0, end);
    std::array<char, 16> sum{};
    std::snprintf(sum.data(), sum.size(), "%08x ", io::crc32(line));
    text.append(sum.data()).append(line).append("\n");
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  const fs::path path = file_of(text, "journal.jsonl");
  let([&] { (void)io::read_journal(path); });
  let([&] { (void)results::describe_file(path); });
  let([&] { (void)results::campaign_title(path.parent_path()); });
  let([&] { (void)results::campaign_kind(path.parent_path()); });
  let([&] { (void)results::read_ensemble_record(path.parent_path()); });
}

constexpr std::array targets = {FuzzTarget{"design", design},  FuzzTarget{"campaign", campaign},
                                FuzzTarget{"layout", layout},  FuzzTarget{"outline", outline},
                                FuzzTarget{"curve", curve},    FuzzTarget{"hdf5", hdf5},
                                FuzzTarget{"journal", journal}};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() {
  return targets;
}

void feed(const FuzzTarget& target, std::string_view input) {
  try {
    let([&] { target.run(input); });
  } catch (const std::exception& error) {
    stop(std::string(target.name) + ": " + error.what());
  }
}

}  // namespace perfora::test
