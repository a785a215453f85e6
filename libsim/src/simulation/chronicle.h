// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/state_archive.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/simulation.h"

namespace sim {

/// What has happened in a run, as far as it is kept for clients and reports: events of the arena,
/// collisions and spoken texts, the newest of each.
class Chronicle {
 public:
  explicit Chronicle(LogHook log) : log_(std::move(log)) {}

  /// Events are neither kept nor logged before this.
  void begin_events() { records_events_ = true; }
  [[nodiscard]] bool records_events() const noexcept { return records_events_; }
  void add_event(SimTime now_ns, ArenaEventKind kind, std::string what, std::string who,
                 std::string text, double value);
  [[nodiscard]] const ArenaEvents& events() const noexcept { return events_; }

  void add_collision(Collision collision);
  /// Not done with each new collision, since it moves all that are kept.
  void forget_old_collisions();
  [[nodiscard]] const std::vector<Collision>& collisions() const noexcept { return collisions_; }

  /// @param speaker  the robot's name.
  void add_spoken(SpokenText spoken, const std::string& speaker);
  [[nodiscard]] const std::vector<SpokenText>& spoken_texts() const noexcept {
    return spoken_texts_;
  }

  [[nodiscard]] const LogHook& log() const noexcept { return log_; }

  /// Collisions and spoken texts.
  void archive(StateArchive& archive, std::size_t robots);
  void archive_events(StateArchive& archive);
  /// The places of collisions, which only pictures and reports use.
  void archive_places(StateArchive& archive);
  /// Continues that of another simulation.
  void take_over_from(Chronicle& before);

 private:
  LogHook log_;
  bool records_events_ = false;
  ArenaEvents events_;
  std::vector<Collision> collisions_;
  std::vector<SpokenText> spoken_texts_;
};

}  // namespace sim
