// What is here: a sweep file run in a folder, with a count of what is left, and its table read. What is not: what a
// sweep file holds (docs/user/design-files.md).
#include <perfora/campaign.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: sweep SWEEP.toml FOLDER\n");
    return 1;
  }
  try {
    perfora::CampaignOptions options;
    options.folder = argv[2];
    options.workers = 2;
    options.progress = [](const perfora::Progress& progress) {
      std::printf("%d finished, at most %d to come\n", int(progress.finished), int(progress.remaining));
      return true;
    };
    const perfora::Campaign sweep = perfora::run_campaign(argv[1], options);
    std::printf("%s\n", sweep.reason.c_str());
    const auto labels = sweep.rows.texts("label");
    const auto plateau = sweep.rows.values("plateau_stress");
    for (std::size_t row = 0; row < labels.size(); ++row)
      std::printf("%s: %.0f Pa\n", labels[row].c_str(), plateau[row]);
    return sweep.status == perfora::Status::completed ? 0 : 2;
  } catch (const perfora::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
