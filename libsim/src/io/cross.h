// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/pose.h"

namespace sim::io {

/// The z component of the cross product of two vectors in the plane: positive if b is to the left
/// of a.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace sim::io
