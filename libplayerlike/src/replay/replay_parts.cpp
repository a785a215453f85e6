// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A run in parts, while it goes on.
#include <algorithm>
#include <utility>

#include "playerlike/replay/replay_builder.h"

namespace playerlike::replay {
namespace {

constexpr std::size_t kMostHistory = 4000;     // frames that whole() has
constexpr std::size_t kMostHappenings = 2000;  // of each kind that whole() has
constexpr std::size_t kMostReadings = 1;       // of each device that whole() has

template <typename Element>
std::vector<Element> rest(const std::vector<Element>& all, std::size_t first) {
  return {all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())), all.end()};
}

template <typename Element>
void drop(std::vector<Element>& all, std::size_t count) {
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size())));
}

// The elements that were not taken yet; the earlier ones are counted as taken.
template <typename Element>
std::vector<Element> take_rest(const std::vector<Element>& all, std::size_t& taken) {
  return rest(all, std::exchange(taken, all.size()));
}

// The readings from number `first` on.
DeviceLog readings_from(const DeviceLog& log, std::size_t first) {
  DeviceLog part = log;
  drop(part.times_ns, first);
  drop(part.X_WB, first);
  for (Series& series : part.series) drop(series.values, first);
  for (ListSeries& list : part.lists) {
    std::size_t values = 0;
    for (std::size_t i = 0; i < std::min(first, list.counts.size()); ++i) {
      values += static_cast<std::size_t>(list.counts[i]);
    }
    drop(list.values, values);
    drop(list.counts, first);
  }
  return part;
}

// Forgets the oldest elements of a list that has too many.
template <typename Element>
std::size_t forget(std::vector<Element>& all, std::size_t& taken) {
  if (all.size() <= kMostHappenings) return 0;
  const std::size_t count = std::min(all.size() - kMostHappenings / 2, taken);
  drop(all, count);
  taken -= count;
  return count;
}

bool is_empty(const ChangeLog& log) { return log.times_ns().empty(); }

}  // namespace

bool has_news(const ReplayRun& part) {
  const auto is_news = [](const auto& log) { return !log.times_ns.empty(); };
  return !part.frames_ns.empty() || !part.collisions.empty() || !part.events.empty() ||
         !part.spoken.empty() || !part.commands.empty() || !part.output.empty() ||
         !part.notes.empty() || std::ranges::any_of(part.devices, is_news) ||
         !std::ranges::all_of(part.obstacles, is_empty) || !is_empty(part.trap_states) ||
         !is_empty(part.timer_dues) || !is_empty(part.scores) ||
         std::ranges::any_of(part.robots, [](const RobotLog& r) { return !is_empty(r.looks); }) ||
         std::ranges::any_of(part.layers,
                             [](const LayerLog& l) { return !l.is_known || !l.changes.empty(); });
}

ReplayRun ReplayBuilder::take() {
  ReplayRun part;
  part.end_ns = run_.end_ns = last_ns_;
  part.frames_ns = std::exchange(run_.frames_ns, {});
  for (RobotLog& robot : run_.robots) {
    RobotLog& own = part.robots.emplace_back();
    own.X_WB = std::exchange(robot.X_WB, {});
    own.twists = std::exchange(robot.twists, {});
    own.stalled = std::exchange(robot.stalled, {});
    own.looks = robot.looks.take();
  }
  for (ChangeLog& log : run_.obstacles) part.obstacles.push_back(log.take());
  for (std::size_t i = 0; i < run_.devices.size(); ++i) {
    DeviceLog& log = run_.devices[i];
    DeviceLog& own = part.devices.emplace_back(readings_from(log, taken_readings_[i]));
    own.known_series = std::exchange(known_[i].series, log.series.size());
    own.known_lists = std::exchange(known_[i].lists, log.lists.size());
    const std::size_t count = log.times_ns.size();
    taken_readings_[i] = std::min(count, kMostReadings);
    if (count > kMostReadings) log = readings_from(log, count - kMostReadings);
  }
  part.trap_states = run_.trap_states.take();
  part.timer_dues = run_.timer_dues.take();
  part.scores = run_.scores.take();
  part.verdict = run_.verdict;
  part.collisions = take_rest(run_.collisions, taken_.collisions);
  part.events = take_rest(run_.events, taken_.events);
  part.spoken = take_rest(run_.spoken, taken_.spoken);
  part.notes = take_rest(run_.notes, taken_.notes);
  part.first_goal = run_.first_goal + taken_.goals;
  part.goals = rest(run_.goals, taken_.goals);
  while (taken_.goals < run_.goals.size() && run_.goals[taken_.goals].reached_ns) ++taken_.goals;
  part.first_text = run_.first_text + taken_.texts;
  part.texts = rest(run_.texts, taken_.texts);
  while (taken_.texts < run_.texts.size() && run_.texts[taken_.texts].gone_ns) ++taken_.texts;
  part.commands = std::exchange(run_.commands, {});
  part.command_texts = std::exchange(run_.command_texts, {});
  text_index_.clear();
  command_count_ = 0;
  part.output = std::exchange(run_.output, {});
  for (LayerLog& layer : run_.layers) {
    std::vector<LayerChange> changes = std::exchange(layer.changes, {});
    LayerLog& own = part.layers.emplace_back(layer);
    own.changes = std::move(changes);
    layer.is_known = true;
  }
  remember_frames(part);
  forget_happenings();
  return part;
}

void ReplayBuilder::remember_frames(const ReplayRun& part) {
  for (std::size_t i = 0; i < part.frames_ns.size(); ++i) {
    // The newest frame is always kept, and replaced by the next one if that comes soon.
    const std::size_t count = history_ns_.size();
    const bool replaces =
        count > 1 && history_ns_[count - 1] - history_ns_[count - 2] < history_period_ns_;
    if (replaces) history_ns_.pop_back();
    history_ns_.push_back(part.frames_ns[i]);
    for (std::size_t r = 0; r < history_.size(); ++r) {
      RobotLog& own = history_[r];
      if (replaces) {
        own.X_WB.pop_back();
        own.twists.pop_back();
        own.stalled.pop_back();
      }
      own.X_WB.push_back(part.robots[r].X_WB[i]);
      own.twists.push_back(part.robots[r].twists[i]);
      own.stalled.push_back(part.robots[r].stalled[i]);
    }
  }
  if (history_ns_.size() <= kMostHistory) return;
  history_period_ns_ *= 2;
  const auto thin = [](auto& all) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i % 2 == 0 || i + 1 == all.size()) all[kept++] = all[i];
    }
    all.resize(kept);
  };
  thin(history_ns_);
  for (RobotLog& own : history_) {
    thin(own.X_WB);
    thin(own.twists);
    thin(own.stalled);
  }
}

void ReplayBuilder::forget_happenings() {
  forget(run_.collisions, taken_.collisions);
  forget(run_.events, taken_.events);
  forget(run_.spoken, taken_.spoken);
  run_.first_text += forget(run_.texts, taken_.texts);
  const std::size_t goals = forget(run_.goals, taken_.goals);
  run_.first_goal += goals;
  for (std::ptrdiff_t& goal : newest_goal_) {
    goal =
        goal < static_cast<std::ptrdiff_t>(goals) ? -1 : goal - static_cast<std::ptrdiff_t>(goals);
  }
}

ReplayRun ReplayBuilder::whole() const {
  ReplayRun all = run_;
  all.frames_ns = history_ns_;
  for (std::size_t i = 0; i < all.robots.size(); ++i) {
    RobotLog& robot = all.robots[i];
    robot.X_WB = history_[i].X_WB;
    robot.twists = history_[i].twists;
    robot.stalled = history_[i].stalled;
    robot.looks = robot.looks.newest();
  }
  for (ChangeLog& log : all.obstacles) log = log.newest();
  for (DeviceLog& device : all.devices) device.known_series = device.known_lists = 0;
  all.trap_states = all.trap_states.newest();
  all.timer_dues = all.timer_dues.newest();
  all.scores = all.scores.newest();
  for (std::size_t i = 0; i < all.layers.size(); ++i) {
    LayerLog& layer = all.layers[i];
    layer.is_known = false;
    if (i < first_layer_ || i - first_layer_ >= cells_.size() || !last_frame_ns_) continue;
    const std::vector<std::uint8_t>& cells = cells_[i - first_layer_];
    std::vector<CellRun> runs = cell_runs(std::vector<std::uint8_t>(cells.size(), 0), cells);
    if (!runs.empty()) layer.changes = {{*last_frame_ns_, std::move(runs)}};
  }
  return all;
}

}  // namespace playerlike::replay
