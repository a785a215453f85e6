// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/run_record.h"

#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <variant>

#include "grade/figures.h"
#include "grade/run_json.h"

namespace playpen::grade {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json goal_json(const std::optional<Goal>& goal) {
  if (!goal) return nullptr;
  return {{"x", goal->position.x()}, {"y", goal->position.y()}, {"tolerance", goal->tolerance_m}};
}

ordered_json sight_json(const std::optional<Sight>& sight) {
  if (!sight) return nullptr;
  return {{"state", name_of(sight->state)},
          {"sensor", sight->sensor},
          {"shown_for", sight->shown_for_s},
          {"last_shown", or_null(sight->last_shown_s)},
          {"distance", sight->distance_m},
          {"bearing", sight->bearing_rad},
          {"field_of_view", sight->field_of_view_rad}};
}

ordered_json collision_json(const std::optional<Contact>& contact) {
  if (!contact) return nullptr;
  return {{"time", contact->time_s},
          {"with", contact->partner},
          {"x", contact->place.x()},
          {"y", contact->place.y()},
          {"sight", sight_json(contact->sight)}};
}

/// The run as in the JSON file of a grading, and what is missing there.
ordered_json record_of(const GradedRun& run) {
  ordered_json record = json_of(run);
  if (run.goal) {
    record["goal"]["yaw"] = or_null(run.goal->yaw_rad);
    record["goal"]["yaw_tolerance"] = run.goal->yaw_tolerance_rad;
  }
  return record;
}

void read_into(const json& value, bool& into) { into = value.get<bool>(); }
void read_into(const json& value, double& into) { into = value.get<double>(); }
void read_into(const json& value, std::string& into) { into = value.get<std::string>(); }

void read_into(const json& value, int& into) {
  // get() of a real number that is not an int is undefined.
  if (!value.is_number_integer()) throw std::invalid_argument("not a whole number");
  into = value.get<int>();
}

void read_into(const json& value, std::uint64_t& into) {
  if (!value.is_number_unsigned()) throw std::invalid_argument("not a whole number");
  into = value.get<std::uint64_t>();
}

template <typename T>
void read_into(const json& value, std::optional<T>& into) {
  if (value.is_null()) return;
  read_into(value, into.emplace());
}

void read_into(const json& value, Refusal& into) {
  read_into(value.at("time"), into.time_s);
  read_into(value.at("what"), into.what);
}

void read_into(const json& value, Sight& into) {
  const auto name = value.at("state").get<std::string>();
  for (const Sight::State state : kSightStates) {
    if (name_of(state) == name) into.state = state;
  }
  read_into(value.at("sensor"), into.sensor);
  read_into(value.at("shown_for"), into.shown_for_s);
  read_into(value.at("last_shown"), into.last_shown_s);
  read_into(value.at("distance"), into.distance_m);
  read_into(value.at("bearing"), into.bearing_rad);
  read_into(value.at("field_of_view"), into.field_of_view_rad);
}

void read_into(const json& value, Contact& into) {
  read_into(value.at("time"), into.time_s);
  read_into(value.at("with"), into.partner);
  read_into(value.at("x"), into.place.x());
  read_into(value.at("y"), into.place.y());
  if (const json& sight = value.at("sight"); !sight.is_null()) {
    read_into(sight, into.sight.emplace(Sight{}));
  }
}

void read_into(const json& value, Goal& into) {
  read_into(value.at("x"), into.position.x());
  read_into(value.at("y"), into.position.y());
  read_into(value.at("tolerance"), into.tolerance_m);
  read_into(value.at("yaw"), into.yaw_rad);
  read_into(value.at("yaw_tolerance"), into.yaw_tolerance_rad);
}

template <typename T>
void read_into(const json& value, std::vector<T>& into) {
  for (const json& element : value) read_into(element, into.emplace_back());
}

void read_into(const json& value, Ending& into) {
  const auto name = value.get<std::string>();
  for (const Ending ending : kEndings) {
    if (name_of(ending) == name) into = ending;
  }
}

void read_into(const json& value, Measures& into) {
  for (const Figure& figure : kFigures) {
    std::visit([&](auto member) { read_into(value.at(std::string(figure.name)), into.*member); },
               figure.member);
  }
  if (const json& first = value.at("first_collision"); !first.is_null()) {
    read_into(first, into.first_collision.emplace());
  }
  if (const json& verdict = value.at("verdict"); !verdict.is_null()) {
    into.verdict = verdict == "passed";
    read_into(value.at("verdict_reason"), into.verdict_reason);
  }
  read_into(value.at("commanded"), into.commanded);
  read_into(value.at("refused"), into.refused);
}

void read_into(const json& value, GradedRun& into) {
  read_into(value.at("world"), into.world);
  read_into(value.at("seed"), into.seed);
  read_into(value.at("folder"), into.folder);
  read_into(value.at("robot"), into.robot);
  if (const json& goal = value.at("goal"); !goal.is_null()) read_into(goal, into.goal.emplace());
  const json& end = value.at("end");
  read_into(end.at("kind"), into.ending);
  if (end.contains("status")) read_into(end["status"], into.status);
  if (end.contains("signal")) read_into(end["signal"], into.signal.emplace());
  read_into(value, into.measures);
  read_into(value.at("faults"), into.faults);
  read_into(value.at("wall_time"), into.wall_time_s);
}

}  // namespace

ordered_json json_of(const GradedRun& run) {
  const Measures& m = run.measures;
  ordered_json end = {{"kind", name_of(run.ending)}};
  if (run.ending == Ending::kBadStatus) end["status"] = run.status;
  if (run.signal) end["signal"] = *run.signal;
  ordered_json whole = {{"world", run.world},   {"seed", run.seed},
                        {"folder", run.folder}, {"passed", run.passed()},
                        {"faults", run.faults}, {"end", end},
                        {"robot", run.robot},   {"goal", goal_json(run.goal)}};
  for (const Figure& figure : kFigures) {
    whole[std::string(figure.name)] =
        std::visit([&m](auto member) { return or_null(m.*member); }, figure.member);
    if (figure.name == "collisions") whole["first_collision"] = collision_json(m.first_collision);
  }
  whole["verdict"] = m.verdict ? ordered_json(*m.verdict ? "passed" : "failed") : ordered_json();
  whole["verdict_reason"] = m.verdict ? ordered_json(m.verdict_reason) : ordered_json();
  whole["commanded"] = m.commanded;
  whole["refused"] = ordered_json::array();
  for (const Refusal& refusal : m.refused) {
    whole["refused"].push_back({{"time", refusal.time_s}, {"what", refusal.what}});
  }
  whole["wall_time"] = run.wall_time_s;
  return whole;
}

std::string run_text(const GradedRun& run) {
  return record_of(run).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::optional<GradedRun> read_run(std::string_view text) {
  try {
    const json record = json::parse(text);
    GradedRun run;
    read_into(record, run);
    // Members that are unknown, contradict each other or have no effect make a difference here.
    if (json(record_of(run)) != record) return std::nullopt;
    return run;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace playpen::grade
