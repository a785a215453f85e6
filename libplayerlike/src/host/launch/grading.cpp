// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/grading.h"

#include <nlohmann/json.hpp>

#include "playerlike/host/report.h"
#include "sim/core/hash.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/simulation/world_hash.h"
#include "sim/world/realism.h"

namespace playerlike {
namespace {

constexpr const char* kCourse = "course";  // left out of the entry

/// The signature of a report with its entry "graded".
std::string signature_of(Report report, const std::string& nonce) {
  report.graded->signature.reset();
  sim::StateHash hash;
  hash.add(nonce);
  hash.add(text_of_report(report));
  hash.add(nonce);
  return sim::hexadecimal_text(hash.value(), 16);
}

Report::Graded entry_of(const Grading& grading) {
  Report::Graded entry;
  entry.nonce = grading.nonce;
  entry.world_name = grading.world_name;
  entry.world = sim::hexadecimal_text(grading.world, 16);
  entry.seed = grading.seed;
  entry.duration_s = grading.duration_s;
  entry.time = grading.time;
  if (grading.realism != kCourse) entry.realism = grading.realism;
  // Left out if they are all defaults.
  if (const std::string rules = to_text(grading.rules); !rules.empty()) entry.rules = rules;
  return entry;
}

std::string duration_text(const std::optional<double>& duration_s) {
  return duration_s ? sim::shortest_text(*duration_s) + " s" : "no limit";
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
  Report whole = report_from(report);
  whole.graded = entry_of(grading);
  whole.graded->signature = signature_of(whole, grading.nonce);
  return text_of_report(whole);
}

std::optional<std::string> fault_of_graded(const std::string& report, const Grading& expected) {
  using nlohmann::ordered_json;
  const ordered_json content = ordered_json::parse(report);
  if (!content.is_object() || !content.contains("graded")) {
    return "the report is not signed by the simulation of this run: the program wrote report.json "
           "itself, or is linked with an older Playpen";
  }
  const Report whole = report_from(report);
  const Report::Graded& found = whole.graded.value();
  const Report::Graded wanted = entry_of(expected);
  if (found.nonce != wanted.nonce) return "the report is that of another run";
  if (const std::string realism = found.realism.value_or(kCourse); realism != expected.realism) {
    return "the program ran with the realism " + realism + ", not with " + expected.realism +
           ": it must leave PLAYPEN_REALISM alone";
  }
  if (found.world != wanted.world) {
    return "the program ran the world \"" + found.world_name +
           "\", which is not that of the task (\"" + expected.world_name +
           "\"): it must connect to \"localhost\", not to \"sim:FILE\", and leave PLAYPEN_WORLD "
           "alone";
  }
  if (found.seed != wanted.seed) {
    return "the program ran with the seed " + std::to_string(found.seed) + ", not with " +
           std::to_string(wanted.seed) + ": it must leave PLAYPEN_SEED alone";
  }
  if (found.duration_s != wanted.duration_s) {
    return "the program ran with a duration of " + duration_text(found.duration_s) + ", not of " +
           duration_text(wanted.duration_s) + ": it must leave PLAYPEN_DURATION alone";
  }
  if (found.time != wanted.time) {
    return "the program ran with the time " + found.time + ", not with " + wanted.time +
           ": it must leave PLAYPEN_TIME alone";
  }
  if (found.rules != wanted.rules) {
    return "the program ran with other rules than those of the task: it must leave PLAYPEN_TASK "
           "alone";
  }
  // The signature covers the fields of the table: there must be no other keys.
  if (found.signature != signature_of(whole, expected.nonce) ||
      content != ordered_json::parse(text_of_report(whole))) {
    return "report.json was changed after the run had ended";
  }
  if (whole.run.steps == 0) {
    return "the simulation never stepped: the program connected, but it has not called Read()";
  }
  return std::nullopt;
}

}  // namespace playerlike
