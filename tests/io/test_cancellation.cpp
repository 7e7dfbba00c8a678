// What is here: requests to stop: who sees which. What is not: work that stops (solver/test_stopping.cpp).
#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <thread>

#include "io/cancellation.h"

namespace perfora::io {
namespace {

TEST(Cancellation, WithoutASourceNothingIsEverRequested) {
  EXPECT_FALSE(Cancellation().requested());
}

TEST(Cancellation, EveryTokenOfItsSourceSeesTheRequestAndNoOther) {
  CancellationSource source, other;
  const Cancellation before = source.token(), copy = before, foreign = other.token();
  EXPECT_FALSE(before.requested());
  std::thread([&] { source.request(); }).join();
  EXPECT_TRUE(before.requested());
  EXPECT_TRUE(copy.requested());
  EXPECT_TRUE(source.token().requested());
  EXPECT_FALSE(foreign.requested());
}

TEST(Cancellation, ATokenOutlivesItsSource) {
  std::optional<CancellationSource> source(std::in_place);
  const Cancellation asked = source->token();
  source->request();
  source.reset();
  EXPECT_TRUE(asked.requested());
}

CancellationSource of_signal;

TEST(Cancellation, ASignalHandlerMayRequest) {
  const auto earlier = std::signal(SIGUSR1, [](int) { of_signal.request(); });
  const Cancellation token = of_signal.token();
  EXPECT_FALSE(token.requested());
  std::raise(SIGUSR1);
  EXPECT_TRUE(token.requested());
  std::signal(SIGUSR1, earlier);
}

}  // namespace
}  // namespace perfora::io
