// What is here: the one kind of error a user sees (InputError), and the search for the nearest known name.
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

/// The candidate closest to `name` by edit distance (case-insensitive), or "" when none is within a third of its
/// length.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace perfora::io
