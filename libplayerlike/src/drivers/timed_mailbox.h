// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "playerlike/session/session.h"

namespace playerlike {

/// Requests to a driver's thread, and its outcomes, such that results do not depend on the relative
/// speed of threads.
///
/// Requests of other threads are stamped with the simulated time. A round at time r takes the
/// requests made before r, because a request made at r may or may not have arrived yet. For the
/// same reason outcome() returns the outcome of an earlier round.
///
/// Threads: all members may be called from any thread; the host's mutex is locked under that of the
/// mailbox. take() and publish() belong to the driver's thread.
template <typename Request, typename Outcome>
class TimedMailbox {
 public:
  /// An outcome, and the number of the last request that its round took.
  struct Numbered {
    Outcome outcome{};
    std::uint64_t number = 0;
  };

  /// Stamps a request. @param act  called with its number, with the mailbox locked.
  template <typename Act>
  void post(Session& session, Request request, Act act) {
    const std::lock_guard lock(mutex_);
    const sim::SimTime now_ns = session.request(TimeRequest{}).sim_time_ns;
    requests_.push_back({now_ns, ++last_number_, std::move(request)});
    act(last_number_);
  }

  /// Begins a round: publishes the outcome of the previous round, and returns the requests made
  /// before this one.
  [[nodiscard]] std::vector<Request> take(sim::SimTime before_ns) {
    const std::lock_guard lock(mutex_);
    if (newest_.time_ns < before_ns) before_ = newest_;
    newest_.time_ns = before_ns;
    std::vector<Request> taken;
    auto request = requests_.begin();
    for (; request != requests_.end() && request->time_ns < before_ns; ++request) {
      newest_.result.number = request->number;
      taken.push_back(std::move(request->what));
    }
    requests_.erase(requests_.begin(), request);
    return taken;
  }

  /// Ends a round.
  void publish(Outcome outcome) {
    const std::lock_guard lock(mutex_);
    newest_.result.outcome = std::move(outcome);
  }

  /// Reads the outcome of the last round before now. @param look  called with it, with the
  /// mailbox locked.
  template <typename Look>
  auto outcome(Session& session, Look look) const {
    const std::lock_guard lock(mutex_);
    sim::SimTime now_ns = std::numeric_limits<sim::SimTime>::max();
    try {
      now_ns = session.request(TimeRequest{}).sim_time_ns;
    } catch (const SessionError&) {
      // The connection is closed, so there are no further rounds.
    }
    return look((newest_.time_ns < now_ns ? newest_ : before_).result);
  }

  /// Calls a function with the mailbox locked.
  template <typename Function>
  auto locked(Function function) const {
    const std::lock_guard lock(mutex_);
    return function();
  }

 private:
  struct Stamped {
    sim::SimTime time_ns;
    std::uint64_t number;
    Request what;
  };
  struct Round {
    sim::SimTime time_ns = -1;
    Numbered result;
  };

  mutable std::mutex mutex_;  // guards the members below
  std::vector<Stamped> requests_;
  std::uint64_t last_number_ = 0;
  Round newest_;
  Round before_;
};

}  // namespace playerlike
