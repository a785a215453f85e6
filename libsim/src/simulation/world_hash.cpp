// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/world_hash.h"

#include <array>
#include <string>
#include <vector>

#include "sim/core/assert.h"
#include "sim/core/fields.h"
#include "sim/core/hash.h"
#include "sim/devices/builtin.h"
#include "sim/io/field_reader.h"
#include "sim/world/robot_model.h"
#include "world/world_fields.h"

namespace sim {
namespace {

/// Adds the values of tables of fields. Lists add their length, optional values whether they are
/// there, variants which one it is.
class FieldHash {
 public:
  void add(const FieldTable& table, const void* object) {
    for_each_field(table, object, [this](const Field& field, const void* owner) {
      if (field.is_identity) add_member(field, field.get(owner));
    });
  }

  StateHash hash;

 private:
  template <typename T>
  static const T& as(const void* value) {
    return *static_cast<const T*>(value);
  }

  void add_parts(const Vec2& p) {
    hash.add(p.x());
    hash.add(p.y());
  }
  void add_parts(const Pose& pose) {
    add_parts(pose.position());
    hash.add(pose.yaw_rad);
  }
  void add_parts(const Colour& colour) {
    for (const std::uint8_t part : {colour.r, colour.g, colour.b, colour.a}) hash.add(part);
  }
  void add_parts(double number) { hash.add(number); }
  void add_parts(std::uint8_t byte) { hash.add(byte); }
  void add_parts(const std::string& text) { hash.add(text); }
  void add_parts(const auto& list) {
    hash.add(list.size());
    for (const auto& part : list) add_parts(part);
  }

  void add_member(const Field& field, const void* value) {
    hash.add(value != nullptr);
    if (value != nullptr) add_value(field, value);
  }

  void add_kind(const Field& field, const void* value) {
    for (std::size_t i = 0; i < field.kinds.size(); ++i) {
      const void* const object = field.kinds[i].find(value);
      if (object == nullptr) continue;
      hash.add(i);
      return add(field.kinds[i].table(), object);
    }
  }

  void add_list(const Field& field, const void* list) {
    const std::size_t count = field.list->size(list);
    hash.add(count);
    for (std::size_t i = 0; i < count; ++i) {
      const void* const element = field.list->at(list, i);
      if (!field.kinds.empty()) {
        add_kind(field, element);
      } else if (field.element != nullptr) {
        hash.add(field.element->text(element));
      } else {
        add(field.table(), element);
      }
    }
  }

  void add_value(const Field& field, const void* value) {
    switch (field.type) {
      case FieldType::kNumber:
        return add_parts(as<double>(value));
      case FieldType::kInt:
      case FieldType::kInt64:
      case FieldType::kUint32:
      case FieldType::kUint64:
      case FieldType::kChoice:
        return hash.add(integer_at(field, value));
      case FieldType::kBool:
        return hash.add(as<bool>(value));
      case FieldType::kText:
        return add_parts(as<std::string>(value));
      case FieldType::kColour:
        return add_parts(as<Colour>(value));
      case FieldType::kVec2:
        return add_parts(as<Vec2>(value));
      case FieldType::kPose:
        return add_parts(as<Pose>(value));
      case FieldType::kVec3:
        return add_parts(as<std::array<double, 3>>(value));
      case FieldType::kBytes:
      case FieldType::kOctets:
        return add_parts(as<std::vector<std::uint8_t>>(value));
      case FieldType::kNumbers:
        return add_parts(as<std::vector<double>>(value));
      case FieldType::kTexts:
        return add_parts(as<std::vector<std::string>>(value));
      case FieldType::kPoses:
        return add_parts(as<std::vector<Pose>>(value));
      case FieldType::kPoints:
        return add_parts(as<std::vector<Vec2>>(value));
      case FieldType::kList:
      case FieldType::kMap:
        return add_list(field, value);
      case FieldType::kStruct:
      case FieldType::kInclude:
        return add(field.table(), value);
      case FieldType::kVariant:
        return add_kind(field, value);
      case FieldType::kCustom:
        return hash.add(field.custom->text(value));
      case FieldType::kForm:
        SIM_ASSERT(false);  // occurs in messages only
    }
  }
};

void add(FieldHash& sum, const std::vector<DeviceDescription>& devices, Realism level) {
  sum.hash.add(devices.size());
  for (const DeviceDescription& device : devices) {
    sum.hash.add(device.name);
    sum.hash.add(device.type);
    // At this level a setting that a file states differs from one that is left out.
    if (level == Realism::kReal) {
      sum.hash.add(device.given.size());
      for (const std::string& key : device.given) sum.hash.add(key);
    }
    const DeviceKind* const kind = find_device_kind(device.type);
    if (!device.params.has_value() || kind == nullptr) continue;
    sum.add(*kind->settings, kind->settings_in(device.params));
  }
}

}  // namespace

std::uint64_t world_hash(const WorldDescription& world) {
  FieldHash sum;
  sum.add(fields_of<WorldDescription>(), &world);
  for (const RobotDescription& robot : world.robots) {
    if (const RobotModel* model = find_robot_model(world, robot.model)) {
      sum.add(fields_of<RobotModel>(), model);
    }
    add(sum, robot.devices, world.simulation.realism);
  }
  return sum.hash.value();
}

}  // namespace sim
