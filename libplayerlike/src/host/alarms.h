// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "playerlike/host/event_client.h"

namespace playerlike {

/// What event loops wait for besides readings, see Alarm. An alarm that was notified is gone.
/// Not thread-safe: guarded by the host's mutex.
class Alarms {
 public:
  AlarmId set(Alarm alarm) {
    alarms_.emplace_back(next_, std::move(alarm));
    return next_++;
  }
  /// @return whether it was still set.
  bool cancel(AlarmId alarm) {
    return std::erase_if(alarms_, [alarm](const auto& a) { return a.first == alarm; }) > 0;
  }
  /// Whether lockstep time goes on for one of them.
  [[nodiscard]] bool let_time_pass() const {
    return std::any_of(alarms_.begin(), alarms_.end(),
                       [](const auto& alarm) { return alarm.second.lets_time_pass; });
  }
  /// Notifies those that are due, in order of number; the others stay.
  /// @param all  the run is over: all are due.
  void ring(const sim::Simulation& simulation, bool all) {
    std::erase_if(alarms_, [&](const auto& numbered) {
      const Alarm& alarm = numbered.second;
      const bool due = all || (alarm.until_ns && simulation.now_ns() >= *alarm.until_ns) ||
                       (alarm.condition && alarm.condition(simulation));
      if (due) alarm.notify();
      return due;
    });
  }

 private:
  std::vector<std::pair<AlarmId, Alarm>> alarms_;  ///< in order of number
  AlarmId next_ = 1;
};

}  // namespace playerlike
