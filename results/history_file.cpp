// What is here: the history of an evaluation written and read. What is not: what is computed from it.
#include "results/history_file.h"

#include "io/hdf5.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {

void write_history_file(const std::filesystem::path& path, const History& history) {
  io::Hdf5Writer file(path);
  file.attribute("/", "format", std::string(history_format));
  file.group("/history");
  write_history(file, "/history", history);
  file.commit();
}

History read_history_file(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, history_format, "the history of an evaluation", "remove it: the evaluation is made again");
  return read_history(file, "/history");
}

}  // namespace perfora::results
