// What is here: libgomp's fork, join, barriers and locks, told to the thread sanitizer. gcc's libgomp synchronises with
// bare futexes that the sanitizer cannot see, so it would report every region as a race; these wrappers announce the
// order and hand on to libgomp. What is not: suppressions (none are needed: a real race is still seen, which the
// self-check proves). Linked to tests of the preset `tsan` alone.
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

#include <cstdlib>

#define PERFORA_NOT_SANITIZED __attribute__((no_sanitize("thread")))

namespace {

template <class Function>
PERFORA_NOT_SANITIZED Function* real(Function*, const char* name) {
  void* symbol = dlsym(RTLD_NEXT, name);
  if (symbol == nullptr) std::abort();
  return reinterpret_cast<Function*>(symbol);
}

// What one team shares: its body and data, and an address each for "the region begins" and "a thread is done".
struct Region {
  void (*body)(void*);
  void* data;
  char done = 0;
};

// Barriers of a team alternate between two addresses, so that a thread that is already at the next barrier orders
// nothing before this one.
char barrier_address[2];
thread_local unsigned barrier_number = 0;
char lock_address;

PERFORA_NOT_SANITIZED void thread_of_team(void* pointer) {
  auto* region = static_cast<Region*>(pointer);
  __tsan_acquire(region);
  barrier_number = 0;
  region->body(region->data);
  __tsan_release(&region->done);
}

template <class Barrier>
PERFORA_NOT_SANITIZED void at_barrier(Barrier barrier) {
  char* address = &barrier_address[barrier_number++ % 2];
  __tsan_release(address);
  barrier();
  __tsan_acquire(address);
}

template <class Fork>
PERFORA_NOT_SANITIZED void in_team(void (*body)(void*), void* data, Fork fork) {
  const unsigned outer_barriers = barrier_number;
  Region region{body, data};
  __tsan_release(&region);
  fork(&thread_of_team, &region);
  __tsan_acquire(&region.done);
  barrier_number = outer_barriers;
}

}  // namespace

extern "C" {

PERFORA_NOT_SANITIZED void GOMP_parallel(void (*body)(void*), void* data, unsigned threads, unsigned flags) {
  [[maybe_unused]] static auto* const next = real(&GOMP_parallel, "GOMP_parallel");
  in_team(body, data, [&](auto* run, void* region) { next(run, region, threads, flags); });
}

#define PERFORA_PARALLEL_LOOP(name)                                                                                    \
  PERFORA_NOT_SANITIZED void name(void (*body)(void*), void* data, unsigned threads, long start, long end, long step,  \
                                  long chunk, unsigned flags) {                                                        \
    [[maybe_unused]] static auto* const next = real(&name, #name);                                                     \
    in_team(body, data, [&](auto* run, void* region) { next(run, region, threads, start, end, step, chunk, flags); }); \
  }
PERFORA_PARALLEL_LOOP(GOMP_parallel_loop_dynamic)
PERFORA_PARALLEL_LOOP(GOMP_parallel_loop_guided)
PERFORA_PARALLEL_LOOP(GOMP_parallel_loop_nonmonotonic_dynamic)
PERFORA_PARALLEL_LOOP(GOMP_parallel_loop_nonmonotonic_guided)

#define PERFORA_BARRIER(name)                                      \
  PERFORA_NOT_SANITIZED void name() {                              \
    [[maybe_unused]] static auto* const next = real(&name, #name); \
    at_barrier([] { next(); });                                    \
  }
PERFORA_BARRIER(GOMP_barrier)
PERFORA_BARRIER(GOMP_loop_end)
PERFORA_BARRIER(GOMP_sections_end)

#define PERFORA_LOCK(start, end)                                     \
  PERFORA_NOT_SANITIZED void start() {                               \
    [[maybe_unused]] static auto* const next = real(&start, #start); \
    next();                                                          \
    __tsan_acquire(&lock_address);                                   \
  }                                                                  \
  PERFORA_NOT_SANITIZED void end() {                                 \
    [[maybe_unused]] static auto* const next = real(&end, #end);     \
    __tsan_release(&lock_address);                                   \
    next();                                                          \
  }
PERFORA_LOCK(GOMP_critical_start, GOMP_critical_end)
PERFORA_LOCK(GOMP_atomic_start, GOMP_atomic_end)

PERFORA_NOT_SANITIZED void GOMP_critical_name_start(void** lock) {
  [[maybe_unused]] static auto* const next = real(&GOMP_critical_name_start, "GOMP_critical_name_start");
  next(lock);
  __tsan_acquire(lock);
}
PERFORA_NOT_SANITIZED void GOMP_critical_name_end(void** lock) {
  [[maybe_unused]] static auto* const next = real(&GOMP_critical_name_end, "GOMP_critical_name_end");
  __tsan_release(lock);
  next(lock);
}

}  // extern "C"
