// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "end_signals.h"

#include <unistd.h>

#include <chrono>
#include <optional>
#include <utility>

#include "playerlike/host/program.h"

namespace playpen {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kLook_ns = 50'000'000;
// A process that ends in good order is late when it has computed for so long, or has done next to
// nothing for so long. A busy machine or a slow disk does not make it late.
constexpr auto kPatience = std::chrono::milliseconds(1500);
constexpr auto kLongestWait = std::chrono::seconds(60);

}  // namespace

EndSignals::EndSignals() {
  sigemptyset(&held_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) {
      sigaddset(&held_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &held_, &old_mask_);
}

EndSignals::~EndSignals() {
  over_ = true;
  if (!thread_.joinable()) return;
  // A signal for this thread only ends its present wait; it is no request.
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    if (sigismember(&held_, signal) != 1) continue;
    pthread_kill(thread_.native_handle(), signal);
    break;
  }
  thread_.join();
}

void EndSignals::listen(std::function<void(int)> on_first, std::function<void(int)> on_late) {
  on_first_ = std::move(on_first);
  on_late_ = std::move(on_late);
  thread_ = std::thread([this] { watch(); });
}

void EndSignals::watch() {
  std::optional<playerlike::TimeGiven> given;  // since the first signal
  Clock::time_point begin;
  while (!over_) {
    const timespec time{0, kLook_ns};
    const int signal = sigtimedwait(&held_, nullptr, &time);
    if (over_) return;
    if (signal > 0 && !given) {
      begin = Clock::now();
      given.emplace(getpid(), gettid());
      on_first_(signal);
      first_ = signal;
      continue;
    }
    if (!given) continue;
    given->look();
    const Clock::duration age = Clock::now() - begin;
    const bool ends_at_once = signal > 0 && !playerlike::is_same_request(first_, signal, age);
    const bool is_late = given->idle() > kPatience ||
                         (age > kPatience && given->computed() > kPatience) || age > kLongestWait;
    if ((!ends_at_once && !is_late) || over_) continue;
    // From now on each of the signals ends the process.
    for (const int one : {SIGINT, SIGTERM, SIGHUP}) {
      if (sigismember(&held_, one) == 1) std::signal(one, SIG_DFL);
    }
    pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
    if (ends_at_once) raise(signal);
    on_late_(first_);
    return;
  }
}

}  // namespace playpen
