// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/version.h"

namespace sim::io::stage {
namespace {

/// Properties in the user's files that differ between the versions of Stage; the first of each.
struct Signs {
  const Property* pose_of_four = nullptr;
  const Property* turning_pose = nullptr;  ///< of three numbers, the last of which is not 0
  const Property* size_of_two = nullptr;
  const Property* size_of_three = nullptr;
  const Property* old_device = nullptr;  ///< what only models of Stage 2 and early 3 have
};

void look_for(const Entity& entity, Signs& signs) {
  if (is_window(entity.type)) return;
  const auto first = [](const Property*& sign, const Property& property) {
    if (sign == nullptr) sign = &property;
  };
  for (const Property& property : entity.properties) {
    if (property.place.file->starts_with(kShippedFolder)) continue;
    const std::size_t count = property.values.size();
    if (property.name == "pose" && count >= 4) first(signs.pose_of_four, property);
    if (property.name == "pose" && count == 3 && property.values[2].number != 0.0) {
      first(signs.turning_pose, property);
    }
    // Later versions do not read a size of the world itself.
    if (property.name == "size" && count == 2 && !entity.type.empty()) {
      first(signs.size_of_two, property);
    }
    if (property.name.starts_with("size") && count == 3) first(signs.size_of_three, property);
    if (property.name == "laser_return" || property.name == "scount" || entity.type == "laser") {
      first(signs.old_device, property);
    }
  }
  for (const Entity& child : entity.children) look_for(child, signs);
}

}  // namespace

void read_version(const Entity& root, Units& units, Report& report) {
  Signs signs;
  look_for(root, signs);
  if (signs.pose_of_four == nullptr && signs.turning_pose != nullptr) {
    units.three_number_poses_turn = true;
    report.note("poses", signs.turning_pose->place,
                "poses of three numbers are read as [x y heading], as in Stage 2");
  }
  const Property* flat = signs.size_of_two;
  if (flat == nullptr && signs.size_of_three == nullptr && signs.pose_of_four == nullptr) {
    flat = signs.old_device;
  }
  if (flat == nullptr) return;
  units.flat = true;
  report.note("flat", flat->place,
              "a world of Stage 2 is flat: all sensors see all models, at any height");
}

}  // namespace sim::io::stage
