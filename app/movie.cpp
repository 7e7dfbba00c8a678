// What is here: `perfora movie`: numbered PNG of a run's frames in a folder, and a film of them where ffmpeg is there.
// What is not: the pictures (report/movie.h).
#include "report/movie.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/files.h"
#include "io/letters.h"
#include "io/lock.h"

extern char** environ;  // NOLINT: POSIX names it

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* film_name = "movie.mp4";

struct MovieFlags {
  CommonFlags common;
  std::string input, output, title;
  double frames_per_second = 8.0;
};

/// Whether the path names a program that PATH has.
bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    std::error_code none;
    if (fs::is_regular_file(fs::path(folders.substr(0, end)) / program, none)) return true;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return false;
}

/// Runs a program to its end; false where it failed.
bool run_program(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Throws io::InputError for the name of a film: movie writes a folder.
void refuse_name_of_film(const fs::path& folder) {
  constexpr std::array<std::string_view, 7> films = {".mp4", ".gif", ".webm", ".avi", ".mkv", ".mov", ".png"};
  const std::string extension = io::lower(folder.extension().string());
  if (std::find(films.begin(), films.end(), extension) != films.end() && !fs::is_directory(folder))
    throw io::InputError({"-o", 0, folder.string()}, "is the name of one file",
                         fmt::format("a folder is written: the pictures, and {} where ffmpeg is installed", film_name),
                         "name the folder: -o " + fs::path(folder).replace_extension().string());
}

/// The folder, without the pictures of an earlier film. Throws io::InputError where there are some and no --force.
void clear_folder(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw io::InputError({folder.string(), 0, ""}, "this is a file, and a film needs a folder", "",
                         "name another one with -o");
  io::make_folders(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool own = name == film_name || (name.starts_with("frame-") && name.ends_with(".png"));
    if (!own) continue;
    if (!force)
      throw io::InputError({entry.path().string(), 0, ""}, "already exists", "",
                           "--force replaces the pictures, or name another folder with -o");
    io::remove_output(entry.path());
  }
}

int movie(const MovieFlags& flags) {
  flags.common.apply();
  refuse_name_of_film(flags.output);
  const results::RunResult run = results::read_run(flags.input);
  const fs::path folder = output_or_default(flags.output, default_name(flags.input, "-movie"));
  clear_folder(folder, flags.common.force);
  const io::OutputLock lock(folder / film_name);
  const std::string title = flags.title.empty() ? results::title_of(run.provenance, flags.input) : flags.title;
  const std::size_t count = report::draw_movie(run, title, folder);
  bool film = false;
  if (is_installed("ffmpeg")) {
    const fs::path made = io::temporary_name(folder / film_name);
    film =
        run_program({"ffmpeg", "-y", "-loglevel", "error", "-framerate", fmt::format("{:g}", flags.frames_per_second),
                     "-i", (folder / "frame-%04d.png").string(), "-pix_fmt", "yuv420p", "-f", "mp4", made.string()});
    if (film) fs::rename(made, folder / film_name);
    if (!film) io::log_warning("ffmpeg made no film of the pictures; they are there");
  } else {
    io::log_info("ffmpeg is not installed, so there is no film; any program that joins pictures makes one");
  }
  if (flags.common.json)
    print_json({{"schema", "perfora.movie/1"},
                {"status", "completed"},
                {"reason", ""},
                {"output", folder.string()},
                {"frames", count},
                {"film", film}});
  io::log_info(fmt::format("written: {} ({} picture{}{})", folder.string(), count, count == 1 ? "" : "s",
                           film ? std::string(", ") + film_name : ""));
  return exit_ok;
}

}  // namespace

void add_movie(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<MovieFlags>();
  CLI::App* command =
      program.add_subcommand("movie", "Draw every frame of a run, and a film where ffmpeg is installed");
  command->add_option("FILE", flags->input, "Run file R.h5, best with output.frames = \"all\"")->required();
  command->add_option("-o,--output", flags->output, "Folder of the pictures (default: FILE's name + -movie)")
      ->type_name("DIR");
  command->add_option("--title", flags->title, "Heading (default: FILE's name)")->type_name("TEXT");
  command->add_option("--rate", flags->frames_per_second, "Frames a second of the film (default 8)")
      ->check(number_within(0.1, 120.0))
      ->type_name("N");
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] { exit_code = movie(*flags); });
}

}  // namespace perfora::app
