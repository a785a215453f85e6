// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "session/range_settings.h"
#include "sim/core/math.h"
#include "sim/devices/fiducial.h"

/// @file
/// Player's interface fiducial.
namespace playerlike {

template <typename Item>
[[nodiscard]] Item fiducial_item(const sim::FiducialReading::Mark& mark,
                                 const DeviceSettings& settings) {
  const sim::Pose& X_ST = mark.X_ST;
  Item item = {};
  item.id = mark.id;
  item.pose = {X_ST.x_m, X_ST.y_m, 0.0, 0.0, 0.0, X_ST.yaw_rad};
  // The distance is uncertain along the line of sight, the bearing across it.
  const double along = setting_of(settings, "noise");
  const double across =
      setting_of(settings, "noise_bearing") * sim::math::hypot(X_ST.x_m, X_ST.y_m);
  const double bearing = sim::math::atan2(X_ST.y_m, X_ST.x_m);
  item.upose.px =
      sim::math::hypot(along * sim::math::cos(bearing), across * sim::math::sin(bearing));
  item.upose.py =
      sim::math::hypot(along * sim::math::sin(bearing), across * sim::math::cos(bearing));
  item.upose.pyaw = setting_of(settings, "noise_yaw");
  return item;
}

template <typename Item>
[[nodiscard]] sim::FiducialReading::Mark mark_of(const Item& item) {
  return {item.id, {item.pose.px, item.pose.py, item.pose.pyaw}};
}

}  // namespace playerlike
