// What is here: packings found by their key in memory, or made and kept. What is not: files.
#include "optimize/evaluate/packing_cache.h"

#include <list>
#include <mutex>
#include <utility>

namespace perfora::optimize {

namespace {

/// All kept packings together stay below this many discs (24 bytes each: about 240 MB).
constexpr std::int64_t most_discs_kept = 10'000'000;

struct Entry {
  geometry::PackingKey key;
  std::mutex making;
  std::shared_ptr<const geometry::Packing> packing;
};

struct Cache {
  std::mutex access;
  std::list<std::shared_ptr<Entry>> entries;  ///< newest use first
};

Cache& cache() {
  static Cache instance;
  return instance;
}

/// The entry of `key`, moved to the front; a new, empty one when there is none.
std::shared_ptr<Entry> entry_of(const geometry::PackingKey& key) {
  const std::lock_guard lock(cache().access);
  auto& entries = cache().entries;
  for (auto it = entries.begin(); it != entries.end(); ++it) {
    if ((*it)->key == key) {
      entries.splice(entries.begin(), entries, it);
      return entries.front();
    }
  }
  entries.push_front(std::make_shared<Entry>());
  entries.front()->key = key;
  return entries.front();
}

/// Lets the least recently used go until the rest is small enough; the newest always stays.
void trim() {
  const std::lock_guard lock(cache().access);
  auto& entries = cache().entries;
  std::int64_t discs = 0;
  for (auto it = entries.begin(); it != entries.end();) {
    if ((*it)->packing) discs += (*it)->packing->size();
    if (discs > most_discs_kept && it != entries.begin()) {
      it = entries.erase(it);
    } else {
      ++it;
    }
  }
}

}  // namespace

std::shared_ptr<const geometry::Packing> cached_packing(const geometry::PackingKey& key,
                                                        const std::function<geometry::Packing()>& make) {
  const std::shared_ptr<Entry> entry = entry_of(key);
  std::shared_ptr<const geometry::Packing> packing;
  {
    const std::lock_guard one_maker(entry->making);
    if (!entry->packing) {
      auto made = std::make_shared<const geometry::Packing>(make());
      const std::lock_guard lock(cache().access);  // trim() reads the pointer under this lock
      entry->packing = std::move(made);
    }
    packing = entry->packing;
  }
  trim();
  return packing;
}

void clear_packing_cache() {
  const std::lock_guard lock(cache().access);
  cache().entries.clear();
}

}  // namespace perfora::optimize
