// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "diff/recorded_difference.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "playerlike/replay/field_values.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/devices/builtin.h"

namespace playpen::diff {
namespace {

using DeviceId = sim::Simulation::DeviceId;

/// Numbers of a struct by the names of its fields.
struct NamedNumbers {
  std::string name;
  bool is_list = false;
  std::vector<double> numbers;
};

std::vector<NamedNumbers> numbers_of(const sim::FieldTable& table, const void* object) {
  std::vector<NamedNumbers> all;
  playerlike::replay::visit_values(
      table, object,
      [&all](const playerlike::replay::FieldValue& field) {
        all.push_back({field.name, false, {field.value}});
      },
      [&all](const std::string& name, const char*, std::span<const double> numbers) {
        all.push_back({name, true, {numbers.begin(), numbers.end()}});
      });
  return all;
}

std::string name_of(const sim::Simulation& run, DeviceId id) {
  return run.world().robots[static_cast<std::size_t>(id.robot)].name + '.' +
         run.device(id.robot, id.device).name();
}

/// The device of another run that has the same names.
std::optional<DeviceId> same_device(const sim::Simulation& run, DeviceId id,
                                    const sim::Simulation& other) {
  const auto robot = other.find_robot(run.world().robots[static_cast<std::size_t>(id.robot)].name);
  if (!robot) return std::nullopt;
  const auto device = other.find_device(*robot, run.device(id.robot, id.device).name());
  if (!device || other.device(*robot, *device).type() != run.device(id.robot, id.device).type()) {
    return std::nullopt;
  }
  return DeviceId{*robot, *device};
}

/// The first value in which two readings of one kind differ.
std::optional<RecordedPair> differing_value(const std::vector<NamedNumbers>& first,
                                            const std::vector<NamedNumbers>& second) {
  for (std::size_t i = 0; i < std::max(first.size(), second.size()); ++i) {
    const bool in_first = i < first.size();
    if (!in_first || i >= second.size() || first[i].name != second[i].name) {
      const std::string& name = in_first ? first[i].name : second[i].name;
      return RecordedPair{0.0, "", name, in_first ? "one" : "none", in_first ? "none" : "one"};
    }
    const std::vector<double>& a = first[i].numbers;
    const std::vector<double>& b = second[i].numbers;
    const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (x == a.end() && y == b.end()) continue;
    const std::string index =
        first[i].is_list ? '[' + std::to_string(x - a.begin()) + ']' : std::string();
    return RecordedPair{0.0, "", first[i].name + index,
                        x == a.end() ? "none" : sim::shortest_text(*x),
                        y == b.end() ? "none" : sim::shortest_text(*y)};
  }
  return std::nullopt;
}

bool has_updated(const sim::Simulation& run, DeviceId id) {
  return std::find(run.updated().begin(), run.updated().end(), id) != run.updated().end();
}

/// The first reading of the last step in which two runs differ.
std::optional<RecordedPair> differing_reading(const sim::Simulation& first,
                                              const sim::Simulation& second) {
  const double time_s = sim::to_seconds(first.now_ns());
  for (const DeviceId id : first.updated()) {
    const auto other = same_device(first, id, second);
    if (!other) continue;
    if (!has_updated(second, *other)) {
      return RecordedPair{time_s, name_of(first, id), "", "a reading", "none"};
    }
    const sim::Device& a = first.device(id.robot, id.device);
    const sim::Device& b = second.device(other->robot, other->device);
    const sim::DeviceKind* const kind = sim::find_device_kind(a.type());
    if (kind == nullptr || kind->reading.fields == nullptr) continue;
    auto pair = differing_value(
        numbers_of(*kind->reading.fields, kind->reading.object(a.sensor()->reading())),
        numbers_of(*kind->reading.fields, kind->reading.object(b.sensor()->reading())));
    if (!pair) continue;
    pair->time_s = time_s;
    pair->device = name_of(first, id);
    return pair;
  }
  for (const DeviceId id : second.updated()) {
    const auto other = same_device(second, id, first);
    if (other && !has_updated(first, *other)) {
      return RecordedPair{time_s, name_of(second, id), "", "none", "a reading"};
    }
  }
  return std::nullopt;
}

/// A command in exact numbers, for comparison.
std::string exact_text(const playerlike::RecordedCommand& command) {
  std::string text = playerlike::replay::text_of(command.command);
  const auto& kind = sim::command_kinds()[command.command.index()];
  for (const NamedNumbers& field : numbers_of(kind.fields(), sim::object_in(command.command))) {
    for (const double number : field.numbers) text += ' ' + sim::shortest_text(number);
  }
  return text;
}

/// A command in words: rounded unless that hides a difference.
std::string words_of(const playerlike::RecordedCommand& command, bool exact) {
  return exact ? exact_text(command) : playerlike::replay::text_of(command.command);
}

std::optional<RecordedPair> differing_command(const playerlike::Rerun& first,
                                              const playerlike::Rerun& second, double before_s) {
  const auto a = first.commands();
  const auto b = second.commands();
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= b.size()) {
      return RecordedPair{before_s, name_of(first.simulation(), a[i].device), "",
                          words_of(a[i], false), "none"};
    }
    const std::string device = name_of(second.simulation(), b[i].device);
    if (i >= a.size()) return RecordedPair{before_s, device, "", "none", words_of(b[i], false)};
    if (name_of(first.simulation(), a[i].device) == device &&
        exact_text(a[i]) == exact_text(b[i])) {
      continue;
    }
    const bool exact =
        playerlike::replay::text_of(a[i].command) == playerlike::replay::text_of(b[i].command);
    return RecordedPair{before_s, name_of(first.simulation(), a[i].device), "",
                        words_of(a[i], exact), words_of(b[i], exact)};
  }
  return std::nullopt;
}

std::string line_of(const char* what, const RecordedPair& pair) {
  std::string text = std::string("first ") + what + " that differs: at " +
                     sim::fixed_text(pair.time_s, 3) + " s, " + pair.device;
  if (!pair.value.empty()) text += ' ' + pair.value;
  return text + ": " + pair.first + " in run 1, " + pair.second + " in run 2\n";
}

}  // namespace

RecordedDifference recorded_difference(playerlike::Rerun& first, playerlike::Rerun& second) {
  RecordedDifference difference;
  while (!difference.command || !difference.reading) {
    const double before_s = sim::to_seconds(first.simulation().now_ns());
    if (!first.step() || !second.step()) break;
    if (!difference.command) difference.command = differing_command(first, second, before_s);
    if (first.simulation().now_ns() != second.simulation().now_ns()) break;
    if (!difference.reading) {
      difference.reading = differing_reading(first.simulation(), second.simulation());
    }
  }
  return difference;
}

std::string text_of(const RecordedDifference& difference) {
  std::string text;
  if (difference.command) text += line_of("command", *difference.command);
  if (difference.reading) text += line_of("reading", *difference.reading);
  return text;
}

}  // namespace playpen::diff
