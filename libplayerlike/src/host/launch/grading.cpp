// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/grading.h"

#include <nlohmann/json.hpp>

#include "sim/core/hash.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/simulation/world_hash.h"
#include "sim/world/realism.h"

namespace playerlike {
namespace {

using nlohmann::ordered_json;

constexpr const char* kEntry = "graded";
constexpr const char* kSignature = "signature";
constexpr const char* kCourse = "course";  // left out of the entry
constexpr const char* kRules = "rules";    // left out if they are all defaults

/// The signature of a report that has its entry "graded", but no signature yet.
std::string signature_of(const ordered_json& report, const std::string& nonce) {
  sim::StateHash hash;
  hash.add(nonce);
  hash.add(report.dump());
  hash.add(nonce);
  return sim::hexadecimal_text(hash.value(), 16);
}

ordered_json entry_of(const Grading& grading) {
  ordered_json entry = {{"nonce", grading.nonce},
                        {"world_name", grading.world_name},
                        {"world", sim::hexadecimal_text(grading.world, 16)},
                        {"seed", grading.seed},
                        {"duration", nullptr},
                        {"time", grading.time}};
  if (grading.duration_s) entry["duration"] = *grading.duration_s;
  if (grading.realism != kCourse) entry["realism"] = grading.realism;
  if (const std::string rules = to_text(grading.rules); !rules.empty()) entry[kRules] = rules;
  return entry;
}

std::string duration_text(const ordered_json& duration) {
  return duration.is_null() ? "no limit" : sim::shortest_text(duration.get<double>()) + " s";
}

}  // namespace

Grading grading_of(const std::string& nonce, const TaskRules& rules,
                   const sim::WorldDescription& world) {
  Grading grading;
  grading.nonce = nonce;
  grading.rules = rules;
  grading.world_name = world.name;
  grading.world = sim::world_hash(world);
  const sim::SimulationDescription& simulation = world.simulation;
  grading.seed = simulation.seed;
  if (simulation.duration_ns) grading.duration_s = sim::to_seconds(*simulation.duration_ns);
  if (simulation.time_mode == sim::TimeMode::kPaced) {
    grading.time = sim::shortest_text(simulation.time_factor);
  }
  grading.realism = sim::to_string(simulation.realism);
  return grading;
}

std::string signed_report(const std::string& report, const Grading& grading) {
  if (grading.nonce.empty()) return report;
  ordered_json whole = ordered_json::parse(report);
  whole[kEntry] = entry_of(grading);
  const std::string signature = signature_of(whole, grading.nonce);
  whole[kEntry][kSignature] = signature;
  return whole.dump(2) + '\n';
}

std::optional<std::string> fault_of_graded(const std::string& report, const Grading& expected) {
  ordered_json whole = ordered_json::parse(report);
  if (!whole.is_object() || !whole.contains(kEntry)) {
    return "the report is not signed by the simulation of this run: the program wrote report.json "
           "itself, or is linked with an older Playpen";
  }
  ordered_json& entry = whole[kEntry];
  const auto found = [&entry](const char* key) -> const ordered_json& { return entry.at(key); };
  if (found("nonce").get<std::string>() != expected.nonce) {
    return "the report is that of another run";
  }
  const ordered_json wanted = entry_of(expected);
  if (const std::string realism = entry.value("realism", kCourse); realism != expected.realism) {
    return "the program ran with the realism " + realism + ", not with " + expected.realism +
           ": it must leave PLAYPEN_REALISM alone";
  }
  if (found("world") != wanted.at("world")) {
    return "the program ran the world \"" + found("world_name").get<std::string>() +
           "\", which is not that of the task (\"" + expected.world_name +
           "\"): it must connect to \"localhost\", not to \"sim:FILE\", and leave PLAYPEN_WORLD "
           "alone";
  }
  if (found("seed") != wanted.at("seed")) {
    return "the program ran with the seed " + found("seed").dump() + ", not with " +
           wanted.at("seed").dump() + ": it must leave PLAYPEN_SEED alone";
  }
  if (found("duration") != wanted.at("duration")) {
    return "the program ran with a duration of " + duration_text(found("duration")) + ", not of " +
           duration_text(wanted.at("duration")) + ": it must leave PLAYPEN_DURATION alone";
  }
  if (found("time") != wanted.at("time")) {
    return "the program ran with the time " + found("time").get<std::string>() + ", not with " +
           expected.time + ": it must leave PLAYPEN_TIME alone";
  }
  if (entry.value(kRules, "") != to_text(expected.rules)) {
    return "the program ran with other rules than those of the task: it must leave PLAYPEN_TASK "
           "alone";
  }
  const std::string signature = found(kSignature).get<std::string>();
  entry.erase(kSignature);
  if (signature != signature_of(whole, expected.nonce)) {
    return "report.json was changed after the run had ended";
  }
  if (whole.at("run").at("steps").get<std::uint64_t>() == 0) {
    return "the simulation never stepped: the program connected, but it has not called Read()";
  }
  return std::nullopt;
}

}  // namespace playerlike
