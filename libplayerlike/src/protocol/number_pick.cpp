// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/number_pick.h"

#include <algorithm>
#include <array>

#include "protocol/field_codec.h"

namespace playerlike::protocol {
namespace {

using sim::Field;
using sim::FieldType;

constexpr std::array<std::string_view, 3> kPoseParts{"x", "y", "yaw"};

bool has_numbers(const Field& field) {
  switch (field.type) {
    case FieldType::kNumber:
    case FieldType::kInt:
    case FieldType::kInt64:
    case FieldType::kUint32:
    case FieldType::kUint64:
    case FieldType::kBool:
    case FieldType::kNumbers:
      return field.drop == nullptr && dot_in(field) == nullptr;
    default:
      return false;
  }
}

/// Finds the field that has a key. @param path  the tables around it that are included, and itself.
/// @return whether there is one; `part` is the part of a pose.
bool find_numbers(const sim::FieldTable& table, std::string_view key,
                  std::vector<const Field*>& path, int& part) {
  for (const Field& field : table.fields) {
    path.push_back(&field);
    if (field.type == FieldType::kInclude) {
      if (find_numbers(field.table(), key, path, part)) return true;
    } else if (field.type == FieldType::kPose && is_in_place(field)) {
      const auto* const at = std::find(kPoseParts.begin(), kPoseParts.end(), key);
      part = static_cast<int>(at - kPoseParts.begin());
      if (at != kPoseParts.end()) return true;
    } else if (field.name == key && has_numbers(field)) {
      return true;
    }
    path.pop_back();
  }
  return false;
}

}  // namespace

NumberPick::NumberPick(std::string_view type, const std::string& key) : kind_(reading_kind(type)) {
  if (!find_numbers(*kind_.fields, key, path_, part_)) {
    refuse_value("keys", "keys of numbers or doubles in the readings of a " + std::string(type),
                 key);
  }
}

const void* NumberPick::value_in(const sim::Reading& reading) const {
  const void* value = kind_.object(reading);
  for (const Field* const field : path_) value = field->get(value);
  return value;
}

std::size_t NumberPick::count(const sim::Reading& reading) const {
  if (path_.back()->type != FieldType::kNumbers) return 1;
  return static_cast<const std::vector<double>*>(value_in(reading))->size();
}

void NumberPick::append(const sim::Reading& reading, std::vector<double>& numbers) const {
  const void* value = value_in(reading);
  const Field& field = *path_.back();
  switch (field.type) {
    case FieldType::kNumbers: {
      const auto& list = *static_cast<const std::vector<double>*>(value);
      numbers.insert(numbers.end(), list.begin(), list.end());
      return;
    }
    case FieldType::kPose: {
      const auto& pose = *static_cast<const sim::Pose*>(value);
      numbers.push_back(part_ == 0 ? pose.x_m : part_ == 1 ? pose.y_m : pose.yaw_rad);
      return;
    }
    case FieldType::kNumber:
      numbers.push_back(*static_cast<const double*>(value));
      return;
    case FieldType::kBool:
      numbers.push_back(*static_cast<const bool*>(value) ? 1.0 : 0.0);
      return;
    default:
      numbers.push_back(static_cast<double>(sim::integer_at(field, value)));
  }
}

}  // namespace playerlike::protocol
