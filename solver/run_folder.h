// What is here: the folder R.part/ in which the closed files of a run grow. What is not: their contents (checkpoint.h,
// results/run_file.h), when they are written (run.cpp).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace perfora::solver {

/// The folder R.part/ beside R.h5. Every file in it is written whole and renamed.
class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& run_file);
  const std::filesystem::path& path() const { return folder_; }
  /// An empty folder with config.toml; what an earlier run left there is removed.
  void start_afresh(const std::string& config);
  /// Whether it holds a checkpoint of this configuration (loading.until aside). `in_names_of_today` turns stored keys
  /// into those of `config`; empty: they are. Throws io::InputError when it holds one of another.
  bool can_resume(const std::string& config,
                  const std::function<std::string(const std::string&)>& in_names_of_today) const;
  std::filesystem::path frame_file(int number) const;
  /// Where the frame at the largest stress so far is kept aside.
  std::filesystem::path peak_frame_file() const { return folder_ / "frames" / "peak.h5"; }
  /// The first `count` of them.
  std::vector<std::filesystem::path> frame_files(int count) const;
  std::filesystem::path checkpoint_file() const { return folder_ / "checkpoint.h5"; }
  void remove() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace perfora::solver
