// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "playerlike/host/event_client.h"

namespace playerlike {

/// The alarms of event clients, see Alarm. An alarm is removed when it has been notified. Not
/// thread-safe: guarded by the host's mutex.
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
  /// Whether an alarm lets lockstep time advance.
  [[nodiscard]] bool let_time_pass() const {
    return std::any_of(alarms_.begin(), alarms_.end(),
                       [](const auto& alarm) { return alarm.second.lets_time_pass; });
  }
  /// Notifies and removes the alarms that are due, in order of their ids.
  /// @param all  the run is over: all alarms are due.
  void ring(const sim::Simulation& simulation, bool all) {
    if (alarms_.empty()) return;
    std::erase_if(alarms_, [&](const auto& numbered) {
      const Alarm& alarm = numbered.second;
      const bool due = all || (alarm.until_ns && simulation.now_ns() >= *alarm.until_ns) ||
                       (alarm.condition && alarm.condition(simulation));
      if (due) alarm.notify();
      return due;
    });
  }

 private:
  std::vector<std::pair<AlarmId, Alarm>> alarms_;  ///< in order of id
  AlarmId next_ = 1;
};

}  // namespace playerlike
