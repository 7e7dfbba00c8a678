// What is here: the history of an evaluation written and read. What is not: what is computed from it.
#include "results/history_file.h"

#include "io/hdf5.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {

void write_history_file(const std::filesystem::path& path, const History& history, double grade) {
  io::Hdf5Writer file(path);
  file.attribute("/", "format", std::string(history_format));
  file.attribute("/", "grade", grade);
  file.group("/history");
  write_history(file, "/history", history);
  file.commit();
}

StoredHistory read_history_file(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, history_format, "the history of an evaluation", "remove it: the evaluation is made again");
  const double grade = file.has_attribute("/", "grade") ? file.attribute_double("/", "grade") : 1.0;
  return {read_history(file, "/history"), grade};
}

}  // namespace perfora::results
