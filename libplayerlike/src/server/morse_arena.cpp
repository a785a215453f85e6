// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests to the component `arena`: configurations, blocks, timers and traps, events.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "server/morse_services.h"
#include "session/checks.h"
#include "sim/core/time.h"
#include "sim/simulation/arena_event.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

// The session for requests about the arena. What happens in it tells where robots are.
Session& arena_session_of(MorseCall& call) {
  require_truth(call);
  return call.state.session();
}

ArenaStatus arena_status_of(MorseCall& call) {
  return arena_session_of(call).request(ArenaRequest{});
}

// --- Configurations

json list_configurations(MorseCall& call) { return arena_status_of(call).configurations; }

json get_configuration(MorseCall& call) { return arena_status_of(call).configuration; }

json set_configuration(MorseCall& call) {
  arena_session_of(call).request(SetConfigurationRequest{call.arguments.text(0)});
  return nullptr;
}

// --- Blocks

json set_block(MorseCall& call, bool extended) {
  const std::string name = call.arguments.text(0);
  arena_session_of(call).request(SetBlockRequest{name, extended});
  for (const ArenaBlock& block : arena_status_of(call).blocks) {
    if (block.name == name) return block.state;
  }
  return nullptr;
}
json extend(MorseCall& call) { return set_block(call, true); }
json retract(MorseCall& call) { return set_block(call, false); }

// --- Timers and traps

json set_trigger(MorseCall& call, bool enabled) {
  const std::string name = call.arguments.text(0);
  const ArenaStatus status = arena_status_of(call);
  std::vector<std::string> known;
  for (const auto* list : {&status.timers, &status.traps}) {
    for (const sim::ArenaTrigger& trigger : *list) known.push_back(trigger.name);
  }
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) throw MorseRefusal(unknown_name("timer or trap", name, known));
  if (found - known.begin() < std::ssize(status.timers)) {
    arena_session_of(call).request(SetTimerRequest{name, enabled});
  } else {
    arena_session_of(call).request(SetTrapRequest{name, enabled});
  }
  return nullptr;
}
json enable(MorseCall& call) { return set_trigger(call, true); }
json disable(MorseCall& call) { return set_trigger(call, false); }

// --- State and events

json triggers(const std::vector<sim::ArenaTrigger>& list) {
  json all = json::object();
  for (const sim::ArenaTrigger& trigger : list) {
    json& entry = all[trigger.name];
    entry = {{"enabled", trigger.enabled}, {"count", trigger.count}};
    if (trigger.time_left_s) entry["time_left"] = *trigger.time_left_s;
  }
  return all;
}

json get_state(MorseCall& call) {
  const ArenaStatus status = arena_status_of(call);
  json blocks = json::object();
  for (const ArenaBlock& block : status.blocks) {
    blocks[block.name] = {{"state", block.state}, {"height", block.height_m}};
  }
  json scores = json::object();
  for (const ArenaScore& score : status.scores) scores[score.robot] = score.points;
  json verdict;
  if (status.verdict) {
    verdict = {{"passed", status.verdict->passed},
               {"reason", status.verdict->reason},
               {"timestamp", sim::to_seconds(status.verdict->time_ns)}};
  }
  return {{"timestamp", sim::to_seconds(status.time_ns)},
          {"configuration", status.configuration},
          {"blocks", std::move(blocks)},
          {"timers", triggers(status.timers)},
          {"traps", triggers(status.traps)},
          {"scores", std::move(scores)},
          {"verdict", std::move(verdict)}};
}

json events(MorseCall& call) {
  const int since = call.arguments.integer(0, 0, std::numeric_limits<int>::max(), 0);
  const ArenaEventList list =
      arena_session_of(call).request(ArenaEventsRequest{static_cast<std::uint64_t>(since)});
  json all = json::array();
  for (const sim::ArenaEvent& event : list.events) {
    all.push_back({{"number", event.number},
                   {"timestamp", sim::to_seconds(event.time_ns)},
                   {"kind", to_string(event.kind)},
                   {"what", event.what},
                   {"who", event.who},
                   {"text", event.text},
                   {"value", event.value}});
  }
  return {{"events", std::move(all)}, {"newest", list.newest}, {"lost", list.lost}};
}

constexpr MorseService kArena[] = {
    {"list_configurations", "", Right::kConnect, list_configurations},
    {"get_configuration", "", Right::kConnect, get_configuration},
    {"set_configuration", "name", Right::kAll, set_configuration},
    {"extend", "block", Right::kAll, extend},
    {"retract", "block", Right::kAll, retract},
    {"enable", "name", Right::kAll, enable},
    {"disable", "name", Right::kAll, disable},
    {"get_state", "", Right::kConnect, get_state},
    {"events", "since=0", Right::kConnect, events},
};

}  // namespace

std::span<const MorseService> arena_services() { return kArena; }

}  // namespace playerlike::server
