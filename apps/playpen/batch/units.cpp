// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/units.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "grade/fingerprint.h"
#include "grade/grade.h"
#include "grade/text.h"
#include "grade/world_patch.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"

namespace playpen::batch {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kUnitsFile = "units.json";

std::string text_of(const std::optional<double>& seconds) {
  return seconds ? sim::shortest_text(*seconds) : "-";
}

/// The world of a condition, with the values of the parameters.
/// @param folder  for its file.
/// @return its hash.
std::uint64_t make_world(const Plan& plan, const fs::path& folder, Condition& condition) {
  if (plan.parameters.empty()) {
    condition.file = condition.original;
    return sim::world_hash(sim::load_world(condition.file));
  }
  const auto [text, description] = grade::read_json_world(condition.original, "parameters");
  grade::WorldPatch patch;
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
    patch.values.push_back({plan.parameters[i].pointer, condition.values[i]});
  }
  const std::string changed = grade::patched_world(text, description, patch);
  condition.file =
      (folder / (condition.world + "-" + grade::fingerprint_of_texts({changed}) + ".json"))
          .string();
  grade::write_text_file(condition.file, changed);
  return sim::world_hash(sim::load_world(condition.file));
}

/// All combinations of the values of parameters, the last parameter changing fastest.
std::vector<std::vector<std::string>> combinations(const std::vector<Parameter>& parameters) {
  std::vector<std::vector<std::string>> all = {{}};
  for (const Parameter& parameter : parameters) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& begin : all) {
      for (const std::string& value : parameter.values) {
        longer.push_back(begin);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

std::optional<double> number_or_null(const ordered_json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

ordered_json to_json(const Batch& batch) {
  ordered_json programs = ordered_json::array();
  for (const PlannedProgram& program : batch.programs) {
    programs.push_back({{"name", program.name}, {"command", program.command}});
  }
  ordered_json conditions = ordered_json::array();
  for (const Condition& condition : batch.conditions) {
    conditions.push_back({{"world", condition.world},
                          {"original", condition.original},
                          {"file", condition.file},
                          {"values", condition.values}});
  }
  ordered_json units = ordered_json::array();
  for (const Unit& unit : batch.units) {
    ordered_json one = ordered_json::array();
    one.push_back(unit.id);
    one.push_back(unit.program);
    one.push_back(unit.condition);
    one.push_back(unit.seed);
    units.push_back(std::move(one));
  }
  return {{"version", batch.version},
          {"task", batch.task_file},
          {"duration", or_null(batch.duration_s)},
          {"timeout", or_null(batch.timeout_s)},
          {"realism", batch.realism ? ordered_json(sim::to_string(*batch.realism)) : nullptr},
          {"isolated", batch.isolation},
          {"readable", batch.readable},
          {"programs", programs},
          {"parameters", batch.parameters},
          {"conditions", conditions},
          {"units", units}};
}

Batch batch_from(const ordered_json& root) {
  Batch batch;
  batch.version = root.at("version");
  batch.task_file = root.at("task");
  batch.duration_s = number_or_null(root.at("duration"));
  batch.timeout_s = number_or_null(root.at("timeout"));
  if (!root.at("realism").is_null()) {
    batch.realism = sim::parse_realism(root["realism"].get<std::string>());
  }
  batch.isolation = root.at("isolated");
  batch.readable = root.at("readable").get<std::vector<std::string>>();
  for (const ordered_json& program : root.at("programs")) {
    batch.programs.push_back(
        {program.at("name"), program.at("command").get<std::vector<std::string>>()});
    if (batch.programs.back().command.empty()) throw std::invalid_argument("a program");
  }
  batch.parameters = root.at("parameters").get<std::vector<std::string>>();
  for (const ordered_json& condition : root.at("conditions")) {
    batch.conditions.push_back({condition.at("world"), condition.at("original"),
                                condition.at("file"),
                                condition.at("values").get<std::vector<std::string>>()});
    if (batch.conditions.back().values.size() != batch.parameters.size()) {
      throw std::invalid_argument("a condition");
    }
  }
  for (const ordered_json& unit : root.at("units")) {
    batch.units.push_back({unit.at(0), unit.at(1), unit.at(2), unit.at(3)});
    const Unit& last = batch.units.back();
    // The id is the name of a folder.
    const bool is_id =
        last.id.size() == 16 && last.id.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!is_id || last.program >= batch.programs.size() ||
        last.condition >= batch.conditions.size()) {
      throw std::invalid_argument("a unit");
    }
  }
  return batch;
}

}  // namespace

grade::Task task_of(const Batch& batch, const Condition& condition) {
  grade::Task task;
  if (!batch.task_file.empty()) task = grade::read_task(batch.task_file);
  grade::choose_worlds(task, {condition.original});
  task.worlds.front().file = condition.file;
  if (batch.duration_s) task.duration_s = batch.duration_s;
  if (batch.timeout_s) task.timeout_s = *batch.timeout_s;
  return task;
}

Batch make_batch(const Plan& plan, const BatchSettings& settings) {
  Batch batch;
  batch.version = settings.version;
  batch.isolation = settings.isolation;
  batch.readable = settings.readable;
  batch.task_file = plan.task;
  batch.duration_s = plan.duration_s;
  batch.timeout_s = plan.timeout_s;
  batch.realism = plan.realism;
  batch.programs = plan.programs;
  for (const Parameter& parameter : plan.parameters) batch.parameters.push_back(parameter.pointer);
  grade::Task task;
  if (!plan.task.empty()) task = grade::read_task(plan.task);
  if (!plan.worlds.empty()) grade::choose_worlds(task, plan.worlds);
  const std::vector<std::uint64_t>& seeds = plan.seeds.empty() ? task.seeds : plan.seeds;

  const std::vector<std::vector<std::string>> values = combinations(plan.parameters);
  std::vector<std::string> keys;  // by condition
  for (const grade::TaskWorld& world : task.worlds) {
    for (const std::vector<std::string>& combination : values) {
      Condition condition;
      condition.world = grade::world_name(world.file);
      condition.original = world.file.empty() ? "" : fs::absolute(world.file).string();
      condition.values = combination;
      keys.push_back(
          sim::hexadecimal_text(make_world(plan, settings.out / "worlds", condition), 16));
      batch.conditions.push_back(std::move(condition));
    }
  }
  const std::string common = grade::fingerprint_of_texts(
      {settings.version, plan.task.empty() ? "" : grade::fingerprint_of(task),
       text_of(plan.duration_s), plan.realism ? std::string(sim::to_string(*plan.realism)) : "-",
       settings.isolation});
  for (std::size_t program = 0; program < batch.programs.size(); ++program) {
    const std::string key = grade::fingerprint_of_command(batch.programs[program].command);
    for (std::size_t condition = 0; condition < batch.conditions.size(); ++condition) {
      for (const std::uint64_t seed : seeds) {
        batch.units.push_back(
            {grade::fingerprint_of_texts({common, key, batch.conditions[condition].world,
                                          keys[condition], std::to_string(seed)}),
             program, condition, seed});
      }
    }
  }
  return batch;
}

void write_batch(const Batch& batch, const fs::path& out) {
  grade::write_text_file(
      out / kUnitsFile,
      to_json(batch).dump(1, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

Batch read_batch(const fs::path& out) {
  const fs::path file = out / kUnitsFile;
  std::string text;
  sim::FileLimits limits;
  limits.most_bytes = std::size_t{1} << 30;
  if (const auto error = sim::read_whole_file(file.string(), limits, text)) {
    throw std::runtime_error("the batch's file '" + file.string() + "' cannot be read: expected " +
                             "what playpen batch PLAN --out writes, found " + error->found);
  }
  try {
    return batch_from(ordered_json::parse(text));
  } catch (const std::exception& error) {
    throw std::runtime_error("the file '" + file.string() +
                             "' is not one that playpen batch has written: " + error.what());
  }
}

}  // namespace playpen::batch
