// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Events of the arena, and the state of blocks, events, scores and verdict.
#include <array>
#include <cmath>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/simulation/arena_event.h"
#include "simulation/controller.h"
#include "simulation/simulation_impl.h"

namespace sim {
namespace {

constexpr std::array<std::string_view, 23> kKindNames = {
    "timer",    "trap",   "configuration", "rising", "extended", "sinking", "retracted", "waiting",
    "refused",  "placed", "message",       "text",   "canvas",   "restart", "score",     "enabled",
    "disabled", "reset",  "end",           "moving", "arrived",  "blocked", "pushed"};
static_assert(kKindNames.size() == static_cast<std::size_t>(kLastArenaEventKind) + 1);

// Who or what hindered an obstacle.
std::string cause_of(const ArenaEvent& event) {
  if (!event.who.empty()) return " by robot " + event.who;
  return event.text.empty() ? "" : " by " + event.text;
}

}  // namespace

std::string_view to_string(ArenaEventKind kind) {
  return kKindNames.at(static_cast<std::size_t>(kind));
}

std::string description(const ArenaEvent& event) {
  switch (event.kind) {
    case ArenaEventKind::kTimer:
      return "timer " + event.what + " acts";
    case ArenaEventKind::kTrap:
      return "robot " + event.who + " springs trap " + event.what + " (" + event.text + ')';
    case ArenaEventKind::kConfiguration:
      return "configuration " + event.what;
    case ArenaEventKind::kRising:
    case ArenaEventKind::kSinking:
      return "block " + event.what + " is " + std::string(to_string(event.kind));
    case ArenaEventKind::kExtended:
    case ArenaEventKind::kRetracted:
      return "block " + event.what + " is " + std::string(to_string(event.kind));
    case ArenaEventKind::kWaiting:
      return event.what + " waits: " + event.text;
    case ArenaEventKind::kRefused:
      return "refused: " + event.text;
    case ArenaEventKind::kPlaced:
      return "obstacle " + event.what + " is placed";
    case ArenaEventKind::kMessage:
      return event.what + ": " + event.text;
    case ArenaEventKind::kText:
      return event.what + " shows: " + event.text;
    case ArenaEventKind::kCanvas:
      return event.what + " changes the canvas";
    case ArenaEventKind::kRestart:
      return "robot " + event.who + " is back at its start";
    case ArenaEventKind::kScore:
      return "robot " + event.who + " gets " + shortest_text(event.value) + " points from " +
             event.what;
    case ArenaEventKind::kEnabled:
      return event.what + " is switched on";
    case ArenaEventKind::kDisabled:
      return event.what + " is switched off";
    case ArenaEventKind::kReset:
      return "the world is reset";
    case ArenaEventKind::kMoving:
      return "obstacle " + event.what + " begins to move";
    case ArenaEventKind::kArrived:
      return "obstacle " + event.what + " is at the end of its path";
    case ArenaEventKind::kBlocked:
      return "obstacle " + event.what + " is blocked" + cause_of(event);
    case ArenaEventKind::kPushed:
      return "obstacle " + event.what + " is off its path" + cause_of(event);
    case ArenaEventKind::kEnd:
      break;
  }
  std::string text = event.value > 0.0 ? "passed" : "failed";
  if (!event.text.empty()) {
    text += ": ";
    text += event.text;
  }
  return text;
}

void Simulation::Impl::record(ArenaEventKind kind, std::string what, std::string who,
                              std::string text, double value) {
  if (!records_events) return;
  if (events.newest.size() == kKeptArenaEvents) events.newest.pop_front();
  events.newest.push_back(
      {++events.count, now_ns, kind, std::move(what), std::move(who), std::move(text), value});
  if (log) {
    log(LogLevel::kInfo,
        "arena, " + fixed_text(to_seconds(now_ns), 2) + " s: " + description(events.newest.back()));
  }
}

void Simulation::Impl::archive_arena(StateArchive& archive) {
  if (!records_events) return;
  int last = -1;
  archive.list(block_motions, [&](BlockMotion& motion) {
    archive.index(motion.obstacle, world.arena.obstacles.size());
    archive.choice(motion.phase, BlockPhase::kSinking);
    ObstacleDescription& block = obstacle(motion.obstacle);
    const bool waits = motion.phase == BlockPhase::kRetracted;
    archive(block.present_height_m);
    const bool can_be = motion.obstacle > last && block.type == ObstacleType::kDynamic &&
                        block.carried_by < 0 && motion.phase != BlockPhase::kExtended &&
                        waits == (block.state == ObstacleState::kRetracted) &&
                        waits != block.present_height_m.has_value() &&
                        (waits || block.rise_speed_mps > 0.0) &&
                        block.present_height_m.value_or(0.0) >= 0.0 &&
                        block.present_height_m.value_or(0.0) <= block.height_m;
    archive.expect(can_be, "blocks that move");
    last = motion.obstacle;
  });
  archive(events.count);
  archive.list(events.newest, [&](ArenaEvent& event) {
    archive(event.number);
    archive.time(event.time_ns);
    archive.choice(event.kind, kLastArenaEventKind);
    archive(event.what, event.who, event.text, event.value);
  });
  archive.expect(events.newest.size() <= kKeptArenaEvents, "few events");
  if (!controller) return;
  for (double& score : scores) archive(score);
  bool ended = verdict.has_value();
  archive(ended);
  if (ended && !verdict) verdict.emplace();
  if (ended) {
    archive(verdict->passed, verdict->reason);
    archive.time(verdict->time_ns);
  }
  controller->archive(archive);
}

std::optional<std::string> Simulation::set_configuration(const std::string& name) {
  if (!impl_->controller) {
    return "there is no configuration named \"" + name + "\"; this world has none";
  }
  return impl_->controller->configure(name);
}

std::optional<std::string> Simulation::set_timer_enabled(const std::string& name, bool enabled) {
  if (!impl_->controller) {
    return "there is no timer named \"" + name + "\"; this world has none";
  }
  return impl_->controller->set_timer_enabled(name, enabled);
}

std::optional<std::string> Simulation::set_trap_enabled(const std::string& name, bool enabled) {
  if (!impl_->controller) return "there is no trap named \"" + name + "\"; this world has none";
  return impl_->controller->set_trap_enabled(name, enabled);
}

std::optional<bool> Simulation::timer_or_trap_enabled(const std::string& name) const {
  if (!impl_->controller) return std::nullopt;
  return impl_->controller->is_enabled(name);
}

ArenaState Simulation::arena_state() const {
  return impl_->controller ? impl_->controller->state() : ArenaState{};
}

const std::vector<double>& Simulation::scores() const noexcept { return impl_->scores; }
const std::optional<Verdict>& Simulation::verdict() const noexcept { return impl_->verdict; }

}  // namespace sim
