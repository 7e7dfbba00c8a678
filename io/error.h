// What is here: what a user did wrong (InputError), what the machine around the program did not do (SurroundingsError),
// and the search for the nearest known name.
// What is not: numerical failures (a status in a returned value) and bugs (assert).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace perfora::io {

/// Where a value came from: a file with a line (0: no line known), "--set" or a command-line flag, and the key it was
/// given for.
struct Origin {
  std::string file;
  int line = 0;
  std::string key;
};

/// Something the user wrote is wrong. what() reads "file:line: key: what is wrong; what is allowed; what to do",
/// with the parts that are empty left out. The program turns it into one sentence on standard error and exit code 1.
class InputError : public std::runtime_error {
 public:
  /// `problem` is required; `allowed` and `remedy` should be given wherever they can be said.
  InputError(Origin origin, std::string problem, std::string allowed = {}, std::string remedy = {});
  const Origin& origin() const { return origin_; }
  const std::string& problem() const { return problem_; }

 private:
  Origin origin_;
  std::string problem_;
};

/// The surroundings failed, not the input and not the work: a disk that is full, a lost worker, no memory. It is never
/// the result of a design; the same command may succeed once there is room. what() is one sentence that names the file
/// or the process and says what to do. The program turns it into exit code 3.
class SurroundingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance (case-insensitive), or "" when none is within a third of its
/// length.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace perfora::io
