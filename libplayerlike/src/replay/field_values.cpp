// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/field_values.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "sim/core/colour.h"
#include "sim/core/number_text.h"
#include "sim/core/pose.h"
#include "sim/devices/builtin.h"

namespace playerlike::replay {
namespace {

using sim::Field;
using sim::FieldType;

template <typename T>
const T& value_as(const void* value) {
  return *static_cast<const T*>(value);
}

class FieldWalker {
 public:
  FieldWalker(
      const std::function<void(FieldValue)>& number,
      const std::function<void(const std::string&, const char*, std::span<const double>)>& list)
      : number_(number), list_(list) {}

  void walk(const sim::FieldTable& table, const void* object, const std::string& prefix) {
    sim::for_each_field(table, object, [&](const Field& field, const void* owner) {
      const void* const value = field.get(owner);
      if (value != nullptr) visit(field, value, prefix);
    });
  }

 private:
  void visit(const Field& field, const void* value, const std::string& prefix) {
    const std::string name = prefix + field.name;
    const char* const unit = field.range.unit;
    switch (field.type) {
      case FieldType::kNumber:
        return number_({name, unit, {}, value_as<double>(value), field.may_be_left_out});
      case FieldType::kInt:
      case FieldType::kInt64:
      case FieldType::kUint32:
      case FieldType::kUint64:
      case FieldType::kChoice:
        return number_(
            {name, unit, field.words, static_cast<double>(sim::integer_at(field, value))});
      case FieldType::kBool:
        return number_({name, unit, {}, value_as<bool>(value) ? 1.0 : 0.0});
      case FieldType::kVec2: {
        const auto& vector = value_as<sim::Vec2>(value);
        return parts(name, unit, {{"x", vector.x()}, {"y", vector.y()}});
      }
      case FieldType::kPose: {
        const auto& pose = value_as<sim::Pose>(value);
        return parts(name, unit, {{"x", pose.x_m}, {"y", pose.y_m}, {"yaw", pose.yaw_rad}});
      }
      case FieldType::kVec3: {
        const auto& vector = value_as<std::array<double, 3>>(value);
        return parts(name, unit, {{"0", vector[0]}, {"1", vector[1]}, {"2", vector[2]}});
      }
      case FieldType::kOctets: {
        const auto& octets = value_as<std::vector<std::uint8_t>>(value);
        return numbers(name, unit, std::vector<double>(octets.begin(), octets.end()));
      }
      case FieldType::kNumbers:
        return numbers(name, unit, value_as<std::vector<double>>(value));
      case FieldType::kPoses:
      case FieldType::kPoints:
      case FieldType::kList:
        return elements(field, value, name);
      case FieldType::kStruct:
        return walk(field.table(), value, name.empty() ? "" : name + '.');
      default:
        return;  // has no numbers, or none that all values have
    }
  }

  // The parts of a pose have two units, "m, rad": the last one belongs to the last part.
  void parts(const std::string& name, const char* unit,
             const std::vector<std::pair<const char*, double>>& all) {
    for (const auto& [part, value] : all) {
      const std::string_view units(unit);
      const char* own = unit;
      if (units == "m, rad") own = std::string_view(part) == "yaw" ? "rad" : "m";
      number_(
          {name.empty() || name.ends_with('_') ? name + part : name + '.' + part, own, {}, value});
    }
  }

  void numbers(const std::string& name, const char* unit, const std::vector<double>& values) {
    if (values.size() > kMostListedNumbers) return list_(name, unit, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      number_({name + '.' + std::to_string(i), unit, {}, values[i]});
    }
  }

  void elements(const Field& field, const void* value, const std::string& name) {
    if (field.list == nullptr) return;
    const std::size_t count = field.list->size(value);
    number_({name + ".count", "", {}, static_cast<double>(count)});
    if (field.type != FieldType::kList || field.table == nullptr) return;
    for (std::size_t i = 0; i < std::min(count, kMostListedElements); ++i) {
      walk(field.table(), field.list->at(value, i), name + '.' + std::to_string(i) + '.');
    }
  }

  const std::function<void(FieldValue)>& number_;
  const std::function<void(const std::string&, const char*, std::span<const double>)>& list_;
};

}  // namespace

void visit_values(
    const sim::FieldTable& table, const void* object, const std::function<void(FieldValue)>& number,
    const std::function<void(const std::string&, const char*, std::span<const double>)>& list) {
  FieldWalker(number, list).walk(table, object, "");
}

std::string text_of(const sim::Command& command) {
  constexpr int kDigits = 4;
  const sim::AlternativeKind<sim::Command>& kind = sim::command_kinds()[command.index()];
  std::string text = kind.name;
  visit_values(
      kind.fields(), sim::object_in(command),
      [&](const FieldValue& value) {
        if (value.may_be_left_out && value.value == 0.0) return;
        text += ' ' + value.name + '=';
        const auto word = static_cast<std::size_t>(value.value);
        text += value.value >= 0.0 && word < value.words.size()
                    ? value.words[word]
                    : sim::rounded_text(value.value, kDigits);
      },
      [&](const std::string& name, const char*, std::span<const double> numbers) {
        text += ' ' + name + "=(" + std::to_string(numbers.size()) + " numbers)";
      });
  sim::for_each_field(
      kind.fields(), sim::object_in(command), [&](const Field& field, const void* owner) {
        const void* const value = field.get(owner);
        if (field.type != FieldType::kText || value == nullptr) return;
        text += ' ' + std::string(field.name) + "=\"" + value_as<std::string>(value) + '"';
      });
  return text;
}

}  // namespace playerlike::replay
