// What is here: making, finding and removing R.part/, the choice between its checkpoints. What is not: what lies in it.
#include "solver/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/progress.h"
#include "results/file_parts.h"

namespace perfora::solver {
namespace {

namespace fs = std::filesystem;

/// The configuration without the strain to run to: a stopped run may be resumed to another end.
std::string without_until(const std::string& config) {
  std::istringstream in(config);
  std::string out, line;
  while (std::getline(in, line))
    if (line.rfind("until", 0) != 0) out += line + "\n";
  return out;
}

/// The first line of a configuration is a comment on program, seeds and kernel; keys follow.
void require_same_configuration(const fs::path& file, const std::string& stored, const std::string& now,
                                const std::function<std::string(const std::string&)>& comparable) {
  const auto prepared = [&](const std::string& whole) {
    const std::size_t keys = whole.find('\n') + 1;
    return without_until(comparable ? whole.substr(0, keys) + comparable(whole.substr(keys)) : whole);
  };
  if (prepared(stored) != prepared(now))
    throw io::InputError({file.string(), 0, ""}, "the unfinished run there has another configuration",
                         "--resume continues with the same design, seeds and program",
                         "use the same design, or start anew with --force");
}

}  // namespace

RunFolder::RunFolder(const fs::path& run_file) : folder_(run_file) {
  folder_.replace_extension(".part");
}

std::array<fs::path, 2> RunFolder::checkpoint_files() const {
  return {folder_ / "checkpoint.h5", folder_ / "checkpoint-2.h5"};
}

void RunFolder::start_afresh() const {
  for (const fs::path& file : checkpoint_files()) fs::remove(file);  // first: a half-removed run is never gone on with
  fs::remove_all(folder_);
  io::make_folders(folder_ / "frames");
}

bool RunFolder::holds_checkpoint() const {
  const auto files = checkpoint_files();
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) { return fs::exists(file); });
}

/// A checkpoint that was found, or why it cannot be used.
struct RunFolder::Found {
  fs::path file;
  std::size_t slot = 0;
  std::optional<Checkpoint> checkpoint;
  std::string problem;
};

RunFolder::Found RunFolder::look_at(std::size_t slot, const Simulation& simulation) const {
  Found found{checkpoint_files()[slot], slot, {}, {}};
  try {
    found.checkpoint = read_checkpoint(found.file, simulation);
  } catch (const io::InputError& error) {
    found.problem = error.what();
  }
  return found;
}

RunProgress RunFolder::resume(Simulation& simulation, const std::string& configuration,
                              const std::function<std::string(const std::string&)>& comparable) {
  std::vector<Found> sound, damaged;
  for (std::size_t slot = 0; slot < checkpoint_files().size(); ++slot) {
    if (!fs::exists(checkpoint_files()[slot])) continue;
    Found found = look_at(slot, simulation);
    (found.checkpoint ? sound : damaged).push_back(std::move(found));
  }
  if (sound.empty()) {
    std::string problems;
    for (const Found& found : damaged) problems += (problems.empty() ? "" : "; ") + found.problem;
    throw io::InputError({folder_.string(), 0, ""}, "the unfinished run there cannot be gone on with: " + problems, "",
                         "start it anew with --force");
  }
  std::sort(sound.begin(), sound.end(),
            [](const Found& a, const Found& b) { return a.checkpoint->number > b.checkpoint->number; });
  number_ = sound.front().checkpoint->number;
  for (const Found& found : sound)
    require_same_configuration(found.file, found.checkpoint->configuration, configuration, comparable);
  for (const Found& found : damaged)
    io::log_warning(fmt::format("a checkpoint is passed over: {}; the run goes on from {}", found.problem,
                                sound.front().file.string()));
  const Found& chosen = prefer_complete(sound, simulation.discs().size());
  next_ = 1 - chosen.slot;
  other_peak_frame_ = chosen.checkpoint->run.peak_frame_step;
  Checkpoint checkpoint = *chosen.checkpoint;
  simulation.restore(std::move(checkpoint.simulation));
  return std::move(checkpoint.run);
}

void RunFolder::write_checkpoint(const Simulation& simulation, const RunProgress& progress,
                                 const std::string& configuration) {
  solver::write_checkpoint(checkpoint_files()[next_], {number_ + 1, configuration, simulation.snapshot(), progress});
  ++number_;
  next_ = 1 - next_;
  std::vector<std::int64_t> named = progress.frame_steps;
  named.push_back(progress.peak_frame_step);
  named.push_back(other_peak_frame_);
  other_peak_frame_ = progress.peak_frame_step;
  remove_frames_but(named);
}

fs::path RunFolder::frame_file(std::int64_t step) const {
  return folder_ / "frames" / fmt::format("{:012d}.h5", step);
}

void RunFolder::remove_frames_but(const std::vector<std::int64_t>& steps) const {
  std::set<fs::path> named;
  for (const std::int64_t step : steps) named.insert(frame_file(step));
  std::error_code ignored;  // a frame too many does no harm
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "frames", ignored))
    if (!named.contains(entry.path())) fs::remove(entry.path(), ignored);
}

std::string RunFolder::frame_problem(std::int64_t step, std::int32_t discs) const {
  try {
    const io::Hdf5Reader file(frame_file(step), io::Checksum::required);
    (void)results::read_frame_group(file, "/frame", results::read_frame_info(file, "/frame", ""), discs);
    return {};
  } catch (const io::InputError& error) {
    return error.what();
  }
}

std::vector<RunFolder::LostFrame> RunFolder::lost_frames(const RunProgress& progress, std::int32_t discs) const {
  std::vector<LostFrame> lost;
  const auto look = [&](std::int64_t step, double strain) {
    std::string problem = frame_problem(step, discs);
    if (!problem.empty()) lost.push_back({step, strain, std::move(problem)});
  };
  for (std::size_t k = 0; k < progress.frame_steps.size(); ++k)
    look(progress.frame_steps[k], progress.frame_strains[k]);
  if (progress.peak_frame_step > 0) look(progress.peak_frame_step, progress.peak_frame_strain);
  return lost;
}

/// A frame that the newest checkpoint names and the one before does not is taken again by the run that goes on from
/// there: that costs a minute. Frames that both name are lost.
const RunFolder::Found& RunFolder::prefer_complete(std::vector<Found>& sound, std::int32_t discs) const {
  for (const Found& found : sound) {
    if (!lost_frames(found.checkpoint->run, discs).empty()) continue;
    if (&found != &sound.front())
      io::log_warning(fmt::format("a checkpoint is passed over: {}; the run goes on from {} and takes the frame again",
                                  lost_frames(sound.front().checkpoint->run, discs).front().problem,
                                  found.file.string()));
    return found;
  }
  RunProgress& run = sound.front().checkpoint->run;
  for (const LostFrame& lost : lost_frames(run, discs)) {
    io::log_warning(
        fmt::format("the frame at strain {:.4f} is lost: {}; the run goes on without it", lost.strain, lost.problem));
    if (lost.step == run.peak_frame_step) run.peak_frame_step = 0;
    const auto place = std::find(run.frame_steps.begin(), run.frame_steps.end(), lost.step);
    if (place == run.frame_steps.end()) continue;
    run.frame_strains.erase(run.frame_strains.begin() + (place - run.frame_steps.begin()));
    run.frame_steps.erase(place);
  }
  return sound.front();
}

void RunFolder::remove() const {
  std::error_code error;
  fs::remove_all(folder_, error);
  if (error)
    io::log_warning(fmt::format("{}: the folder of the finished run cannot be removed ({}); remove it by hand",
                                folder_.string(), error.message()));
}

}  // namespace perfora::solver
