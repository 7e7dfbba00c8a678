// What is here: two small OpenMP programs for the preset `tsan`: `clean` uses every construct the rooms use and must
// pass, `race` has a race on purpose and must be reported. What is not: anything of Perfora.
#include <cstdio>
#include <cstring>
#include <numeric>
#include <vector>

namespace {

constexpr int size = 4096;

bool clean() {
  std::vector<int> first(size), second(size), third(size);
  long sum = 0;
  int critical_sum = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    sum = 0;
    critical_sum = 0;
#pragma omp parallel num_threads(3)
    {
#pragma omp for schedule(static)
      for (int k = 0; k < size; ++k) first[static_cast<std::size_t>(k)] = k;
        // Reads what other threads have written: right only because of the barrier at the end of the loop above.
#pragma omp for schedule(dynamic, 64)
      for (int k = 0; k < size; ++k)
        second[static_cast<std::size_t>(k)] = first[static_cast<std::size_t>(size - 1 - k)];
#pragma omp barrier
#pragma omp for schedule(static) reduction(+ : sum)
      for (int k = 0; k < size; ++k) sum += second[static_cast<std::size_t>(size - 1 - k)];
#pragma omp critical
      critical_sum += 1;
    }
#pragma omp parallel for schedule(dynamic, 32) num_threads(3)
    for (int k = 0; k < size; ++k) third[static_cast<std::size_t>(k)] = second[static_cast<std::size_t>(k)];
    if (sum != std::accumulate(third.begin(), third.end(), 0L) || critical_sum != 3) return false;
  }
  return sum == static_cast<long>(size) * (size - 1) / 2;
}

// The loop without a barrier: a thread reads what another one is still writing.
void race() {
  std::vector<int> first(size), second(size);
  for (int repeat = 0; repeat < 50; ++repeat) {
#pragma omp parallel num_threads(3)
    {
#pragma omp for schedule(static) nowait
      for (int k = 0; k < size; ++k) first[static_cast<std::size_t>(k)] = k + repeat;
#pragma omp for schedule(static)
      for (int k = 0; k < size; ++k)
        second[static_cast<std::size_t>(k)] = first[static_cast<std::size_t>(size - 1 - k)];
    }
  }
  std::printf("%d\n", second[1]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "race") == 0) {
    race();
    return 0;
  }
  return clean() ? 0 : 1;
}
