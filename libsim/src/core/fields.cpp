// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/fields.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/core/assert.h"

namespace sim {
namespace {

template <typename T>
const T& as(const void* value) {
  return *static_cast<const T*>(value);
}

bool is_finite(const Pose& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
}

bool is_finite(const Field& field, const void* value) {
  switch (field.type) {
    case FieldType::kNumber:
      return std::isfinite(as<double>(value));
    case FieldType::kVec2:
      return as<Vec2>(value).allFinite();
    case FieldType::kPose:
      return is_finite(as<Pose>(value));
    case FieldType::kVec3:
      return std::ranges::all_of(as<std::array<double, 3>>(value),
                                 [](double x) { return std::isfinite(x); });
    case FieldType::kNumbers:
      return std::ranges::all_of(as<std::vector<double>>(value),
                                 [](double x) { return std::isfinite(x); });
    case FieldType::kPoints:
      return std::ranges::all_of(as<std::vector<Vec2>>(value),
                                 [](const Vec2& point) { return point.allFinite(); });
    case FieldType::kPoses:
      return std::ranges::all_of(as<std::vector<Pose>>(value),
                                 [](const Pose& pose) { return is_finite(pose); });
    case FieldType::kStruct:
    case FieldType::kInclude:
      return all_finite(field.table(), value);
    case FieldType::kList:
      for (std::size_t i = 0; field.table != nullptr && i < field.list->size(value); ++i) {
        if (!all_finite(field.table(), field.list->at(value, i))) return false;
      }
      return true;
    default:
      return true;
  }
}

void add_pose(const Pose& pose, const std::string& prefix, const std::string& suffix,
              std::map<std::string, double>& properties) {
  properties[prefix + "_x" + suffix] = pose.x_m;
  properties[prefix + "_y" + suffix] = pose.y_m;
  properties[prefix + "_yaw" + suffix] = pose.yaw_rad;
}

std::string property_of(const Field& field) {
  if (field.property != nullptr) return field.property;
  std::string name = field.name;
  if (field.is_angle) name.resize(name.size() - std::string_view("_deg").size());
  return name;
}

void add_field(const Field& field, const void* value, std::map<std::string, double>& properties,
               const std::string& suffix) {
  if (value == nullptr && field.type != FieldType::kPose) return;
  const std::string name = property_of(field);
  switch (field.type) {
    case FieldType::kNumber:
      properties[name + suffix] = as<double>(value);
      return;
    case FieldType::kInt:
    case FieldType::kInt64:
    case FieldType::kUint32:
    case FieldType::kUint64:
    case FieldType::kChoice:
      properties[name + suffix] = static_cast<double>(integer_at(field, value));
      return;
    case FieldType::kBool:
      properties[name + suffix] = as<bool>(value) ? 1.0 : 0.0;
      return;
    case FieldType::kVec2: {
      const std::string prefix = name.empty() ? "" : name + "_";
      properties[prefix + "x" + suffix] = as<Vec2>(value).x();
      properties[prefix + "y" + suffix] = as<Vec2>(value).y();
      return;
    }
    case FieldType::kPose:
      return add_pose(value == nullptr ? Pose{} : as<Pose>(value), name, suffix, properties);
    case FieldType::kPoses:
    case FieldType::kList: {
      const std::size_t count = field.list->size(value);
      properties[field.lists_elements ? "count" : name] = static_cast<double>(count);
      for (std::size_t i = 0; field.lists_elements && i < count; ++i) {
        std::string end = "_";
        end += std::to_string(i);
        const void* element = field.list->at(value, i);
        if (field.type == FieldType::kPoses) {
          add_pose(as<Pose>(element), name, end, properties);
        } else {
          add_properties(field.table(), element, properties, end);
        }
      }
      return;
    }
    case FieldType::kStruct:
      return add_properties(field.table(), value, properties, suffix);
    case FieldType::kCustom:
      return field.add_custom_properties(value, properties);
    default:
      return;  // has no numbers
  }
}

}  // namespace

const Field& field_named(const FieldTable& table, std::string_view name) {
  const auto field =
      std::ranges::find_if(table.fields, [name](const Field& one) { return one.name == name; });
  SIM_ASSERT(field != table.fields.end());
  return *field;
}

std::int64_t integer_at(const Field& field, const void* value) {
  switch (field.type) {
    case FieldType::kInt64:
      return as<std::int64_t>(value);
    case FieldType::kUint32:
      return as<std::uint32_t>(value);
    case FieldType::kUint64:
      return static_cast<std::int64_t>(as<std::uint64_t>(value));
    default: {
      SIM_ASSERT(field.type == FieldType::kInt || field.type == FieldType::kChoice);
      int number = 0;
      std::memcpy(&number, value, sizeof number);
      return number;
    }
  }
}

void set_integer(const Field& field, void* value, std::int64_t number) {
  switch (field.type) {
    case FieldType::kInt64:
      *static_cast<std::int64_t*>(value) = number;
      return;
    case FieldType::kUint32:
      *static_cast<std::uint32_t*>(value) = static_cast<std::uint32_t>(number);
      return;
    case FieldType::kUint64:
      *static_cast<std::uint64_t*>(value) = static_cast<std::uint64_t>(number);
      return;
    default: {
      SIM_ASSERT(field.type == FieldType::kInt || field.type == FieldType::kChoice);
      const int narrow = static_cast<int>(number);
      std::memcpy(value, &narrow, sizeof narrow);
    }
  }
}

bool all_finite(const FieldTable& table, const void* object) {
  return std::ranges::all_of(table.fields, [object](const Field& field) {
    const void* value = field.get(object);
    return value == nullptr || is_finite(field, value);
  });
}

void add_properties(const FieldTable& table, const void* object,
                    std::map<std::string, double>& properties, const std::string& suffix) {
  for_each_field(table, object, [&](const Field& field, const void* owner) {
    if (!field.is_property) return;
    const void* const value = field.get(owner);
    if (field.unlisted_at && as<double>(value) == *field.unlisted_at) return;
    add_field(field, value, properties, suffix);
  });
}

}  // namespace sim
