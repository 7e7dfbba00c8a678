// What is here: how thorough a test is under the sanitizers. What is not: tests.
#pragma once

namespace perfora::test {

/// `fewer` under the address or thread sanitizer, `all` otherwise: for tests that repeat one path of the code at many
/// moments (kills, numbers of workers). Sanitizers look at the path; the plain build looks at the moments.
constexpr int thinned([[maybe_unused]] int all, [[maybe_unused]] int fewer) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return fewer;
#else
  return all;
#endif
}

}  // namespace perfora::test
