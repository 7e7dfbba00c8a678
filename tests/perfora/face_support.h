// What is here: a folder that goes away, a design small enough to be evaluated in a second, the sentence of an error.
// What is not: tests.
#pragma once

#include <string>

#include "perfora/design.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora {

using optimize::DesignFolder;

inline Design small_block() {
  return Design::from_toml(optimize::small_design);
}

/// The sentence of the Error that `action` throws; "" when it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace perfora
