// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What is kept of a run, and the words for events of the arena.
#include "simulation/chronicle.h"

#include <array>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/simulation/arena_event.h"

namespace sim {
namespace {

constexpr std::size_t kKeptCollisions = 1024;
constexpr std::size_t kKeptSpokenTexts = 1024;

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

void Chronicle::add_event(SimTime now_ns, ArenaEventKind kind, std::string what, std::string who,
                          std::string text, double value) {
  if (!records_events_) return;
  if (events_.newest.size() == kKeptArenaEvents) events_.newest.pop_front();
  events_.newest.push_back(
      {++events_.count, now_ns, kind, std::move(what), std::move(who), std::move(text), value});
  if (log_) {
    log_(LogLevel::kInfo, "arena, " + fixed_text(to_seconds(now_ns), 2) +
                              " s: " + description(events_.newest.back()));
  }
}

void Chronicle::archive_events(StateArchive& archive) {
  archive(events_.count);
  archive.list(events_.newest, [&](ArenaEvent& event) {
    archive(event.number);
    archive.time(event.time_ns);
    archive.choice(event.kind, kLastArenaEventKind);
    archive(event.what, event.who, event.text, event.value);
  });
  archive.expect(events_.newest.size() <= kKeptArenaEvents, "few events");
}

void Chronicle::add_collision(Collision collision) {
  if (collisions_.size() == 2 * kKeptCollisions) forget_old_collisions();
  collisions_.push_back(std::move(collision));
}

void Chronicle::forget_old_collisions() {
  if (collisions_.size() <= kKeptCollisions) return;
  collisions_.erase(collisions_.begin(),
                    collisions_.end() - static_cast<std::ptrdiff_t>(kKeptCollisions));
}

void Chronicle::add_spoken(SpokenText spoken, const std::string& speaker) {
  if (spoken_texts_.size() == kKeptSpokenTexts) spoken_texts_.erase(spoken_texts_.begin());
  if (log_) log_(LogLevel::kInfo, "robot " + speaker + " says: " + spoken.text);
  spoken_texts_.push_back(std::move(spoken));
}

void Chronicle::archive(StateArchive& archive, std::size_t robots) {
  forget_old_collisions();
  archive.list(collisions_, [&](Collision& collision) {
    archive.time(collision.time_ns);
    archive.index(collision.robot, robots);
    archive(collision.partner);
  });
  archive.list(spoken_texts_, [&](SpokenText& spoken) {
    archive.time(spoken.time_ns);
    archive.index(spoken.robot, robots);
    archive(spoken.text);
  });
}

void Chronicle::archive_places(StateArchive& archive) {
  for (Collision& collision : collisions_) archive(collision.place);
}

void Chronicle::take_over_from(Chronicle& before) {
  collisions_ = std::move(before.collisions_);
  spoken_texts_ = std::move(before.spoken_texts_);
  events_ = std::move(before.events_);
}

}  // namespace sim
