// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/happenings.h"

#include <algorithm>
#include <utility>

namespace playerlike::replay {

HappeningsWatch::Happenings HappeningsWatch::look(const sim::Simulation& simulation) {
  Happenings found;
  std::uint64_t contacts = 0;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    contacts += static_cast<std::uint64_t>(simulation.statistics(robot).collisions);
  }
  const std::span<const sim::Collision> kept = simulation.collisions();
  found.collisions = kept.last(
      std::min<std::size_t>(kept.size(), contacts - std::exchange(collisions_, contacts)));
  for (const sim::ArenaEvent& event : simulation.arena_events().newest) {
    if (event.number > events_) found.events.push_back(event);
  }
  events_ = simulation.arena_events().count;
  // The list drops its oldest texts when it is full. Then those after the newest known one are new.
  const std::span<const sim::SpokenText> said = simulation.spoken_texts();
  std::size_t first = std::min(spoken_, said.size());
  if (spoken_ == said.size()) {
    while (first > 0 &&
           !(said[first - 1].time_ns == newest_.time_ns && said[first - 1].robot == newest_.robot &&
             said[first - 1].text == newest_.text)) {
      --first;
    }
  }
  found.spoken = said.subspan(first);
  spoken_ = said.size();
  if (!said.empty()) newest_ = said.back();
  return found;
}

}  // namespace playerlike::replay
