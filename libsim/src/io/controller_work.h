// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/world/description.h"

/// The cost of an arena controller's work, so that no world stalls a simulation.
namespace sim::io {

/// The most that an arena controller may do in a step [operations]. It takes about 10 ms.
inline constexpr std::int64_t kMaxControllerWork = 20'000;

/// Counts the work of timers and traps in operations, each of which takes half a microsecond or
/// less. The count depends on nothing but the world and the size of its canvas, so it is the same
/// on all machines.
class ControllerWork {
 public:
  /// @param world  must outlive this object.
  explicit ControllerWork(const WorldDescription& world);

  /// Sets the size of the canvas; at first it is the world's.
  void set_canvas(int width, int height);

  [[nodiscard]] std::int64_t of(const ArenaAction& action) const;
  [[nodiscard]] std::int64_t of(const std::vector<ArenaCondition>& conditions) const;
  /// All that a timer or trap does when it acts once.
  template <typename Trigger>
  [[nodiscard]] std::int64_t of_one(const Trigger& trigger) const {
    std::int64_t work = of(trigger.conditions);
    for (const ArenaAction& action : trigger.actions) work += of(action);
    return work;
  }
  /// How often a timer acts in a step at most.
  [[nodiscard]] std::int64_t most_acts(const TimerDescription& timer) const;
  [[nodiscard]] std::int64_t of_configuration(const std::string& name) const;

  /// A timer or trap that would do more than kMaxControllerWork in a step by itself.
  struct Excess {
    bool is_timer = false;
    std::size_t index = 0;
    std::int64_t acts = 1;  ///< in a step
    std::int64_t work = 0;  ///< of each
  };
  [[nodiscard]] std::vector<Excess> excesses() const;

 private:
  struct OfAction;

  [[nodiscard]] std::int64_t of_block() const;

  const WorldDescription& world_;
  CanvasDescription canvas_;
  std::int64_t robots_;
  std::int64_t obstacles_;
  std::int64_t dynamic_ = 0;  // obstacles
  std::int64_t timers_;
  std::map<std::string, std::int64_t, std::less<>> configurations_;
};

/// "4 million operations in a step: 100 times 40000".
[[nodiscard]] std::string text_of(const ControllerWork::Excess& excess);

}  // namespace sim::io
