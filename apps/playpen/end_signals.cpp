// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "end_signals.h"

#include <chrono>
#include <ctime>
#include <optional>
#include <utility>

#include "playerlike/host/program.h"

namespace playpen {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr long kLook_ns = 50'000'000;
// A process that ends in good order is late when it has computed for so long, or has done next to
// nothing for so long. The processor's time counts, so that a busy machine does not make it late.
constexpr auto kPatience = milliseconds(1500);
constexpr auto kNextToNothing = milliseconds(5);
constexpr auto kLongestWait = std::chrono::seconds(60);

Clock::duration processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

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
  if (thread_.joinable()) thread_.join();
}

void EndSignals::listen(std::function<void(int)> on_first, std::function<void(int)> on_late) {
  on_first_ = std::move(on_first);
  on_late_ = std::move(on_late);
  thread_ = std::thread([this] { watch(); });
}

/// The time since the first signal.
class EndSignals::Lateness {
 public:
  Lateness() : begin_(Clock::now()), busy_(begin_), computed_(processor_time()) {}

  [[nodiscard]] Clock::duration age() const { return Clock::now() - begin_; }
  /// Must be called often.
  [[nodiscard]] bool is_late() {
    const Clock::time_point now = Clock::now();
    const Clock::duration computed = processor_time();
    if (computed - computed_when_busy_ > kNextToNothing) {
      busy_ = now;
      computed_when_busy_ = computed;
    }
    return now - busy_ > kPatience || now - begin_ > kLongestWait ||
           (now - begin_ > kPatience && computed - computed_ > kPatience);
  }

 private:
  Clock::time_point begin_;
  Clock::time_point busy_;  ///< when it last did something
  Clock::duration computed_;
  Clock::duration computed_when_busy_ = computed_;
};

void EndSignals::watch() {
  std::optional<Lateness> lateness;
  while (!over_) {
    const timespec time{0, kLook_ns};
    const int signal = sigtimedwait(&held_, nullptr, &time);
    if (signal > 0 && !lateness) {
      lateness.emplace();
      on_first_(signal);
      first_ = signal;
      continue;
    }
    if (!lateness) continue;
    const bool ends_at_once =
        signal > 0 && !playerlike::is_same_request(first_, signal, lateness->age());
    if ((!ends_at_once && !lateness->is_late()) || over_) continue;
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
