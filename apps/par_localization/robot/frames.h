// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_LOCALIZATION_FRAMES_H
#define PAR_LOCALIZATION_FRAMES_H

#include <cmath>

#include "par_common/grid.h"

// The pose that `step` describes when it is seen from `from`: first `from`, then `step` in its
// frame.
inline par::Pose then(const par::Pose& from, const par::Pose& step) {
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  return {from.x + c * step.x - s * step.y, from.y + s * step.x + c * step.y,
          par::normalize_angle(from.yaw + step.yaw)};
}

// The pose `to` seen from `from`: then(from, seenFrom(from, to)) is `to`.
inline par::Pose seenFrom(const par::Pose& from, const par::Pose& to) {
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  return {c * dx + s * dy, -s * dx + c * dy, par::normalize_angle(to.yaw - from.yaw)};
}

#endif
