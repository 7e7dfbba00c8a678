// What is here: packings kept in memory, one a key, so that a search makes each only once. What is not: how they are
// made or read.
#pragma once

#include <functional>
#include <memory>

#include "geometry/packing.h"

namespace perfora::optimize {

/// The packing of `key`: from memory, or made by `make` and kept. The oldest are let go beyond a fixed number of discs
/// in all. Threads that ask for the same key at the same time wait for one to make it. An exception of `make` passes
/// through and nothing is kept.
std::shared_ptr<const geometry::Packing> cached_packing(const geometry::PackingKey& key,
                                                        const std::function<geometry::Packing()>& make);

/// Forgets all packings (tests, memory).
void clear_packing_cache();

}  // namespace perfora::optimize
