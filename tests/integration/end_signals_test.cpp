// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The signals of a server whose simulation does not end. Each test's server is a process of its
// own.
#include "end_signals.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <thread>

namespace playpen {
namespace {

constexpr int kLate = 7;

/// A process with EndSignals, which never ends by itself.
class Server {
 public:
  /// @param work  what its main thread does.
  explicit Server(const std::function<void()>& work) {
    if (pipe(told_.data()) != 0) std::abort();
    process_ = fork();
    if (process_ != 0) return;
    EndSignals signals;
    std::mutex simulation;  // that nobody gets
    simulation.lock();
    std::thread waits([&] { const std::lock_guard lock(simulation); });
    signals.listen([this](int signal) { tell(static_cast<char>(signal)); },
                   [](int signal) { std::_Exit(signal == SIGTERM ? kLate : 1); });
    tell('r');
    work();
    std::_Exit(2);
  }
  ~Server() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// What the process tells next: 'r' when it is ready, then the first signal.
  [[nodiscard]] char told() const {
    char byte = 0;
    return read(told_[0], &byte, 1) == 1 ? byte : '\0';
  }
  void send(int signal) const { kill(process_, signal); }
  [[nodiscard]] int end() {
    int status = 0;
    waitpid(process_, &status, 0);
    return status;
  }

 private:
  void tell(char byte) const { static_cast<void>(!write(told_[1], &byte, 1)); }

  std::array<int, 2> told_{};
  pid_t process_ = -1;
};

void compute_for_ever() {
  static std::atomic<unsigned> count{0};
  for (;;) ++count;
}

void wait_for_ever() {
  for (;;) pause();
}

/// A server that does this must be ended by its first signal.
void expect_late_end(void (*work)()) {
  Server server(work);
  ASSERT_EQ(server.told(), 'r');
  server.send(SIGTERM);
  EXPECT_EQ(server.told(), SIGTERM);
  const int status = server.end();
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), kLate);
}

TEST(EndSignals, FirstSignal_EndsComputingServer) { expect_late_end(compute_for_ever); }

TEST(EndSignals, FirstSignal_EndsWaitingServer) { expect_late_end(wait_for_ever); }

TEST(EndSignals, SecondSignal_Kills) {
  Server server(wait_for_ever);
  ASSERT_EQ(server.told(), 'r');
  server.send(SIGTERM);
  EXPECT_EQ(server.told(), SIGTERM);
  server.send(SIGINT);  // no copy of the first
  const int status = server.end();
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
}

}  // namespace
}  // namespace playpen
