// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/travel_meter.h"

#include <cmath>

namespace playerlike {

void TravelMeter::observe(const sim::Vec2& place, double path_length_m) {
  const std::pair square(static_cast<std::int64_t>(std::floor(place.x() / kSquare_m)),
                         static_cast<std::int64_t>(std::floor(place.y() / kSquare_m)));
  if (!last_ || square != square_) visited_.insert(square);
  square_ = square;
  constexpr double kRounding_m = 1e-6;
  const bool jumped =
      !last_ || (place - *last_).norm() > path_length_m - last_path_m_ + kRounding_m;
  last_ = place;
  last_path_m_ = path_length_m;
  if (jumped) {
    anchor_ = place;
  } else if (const double move_m = (place - anchor_).norm(); move_m >= kMove_m) {
    distance_m_ += move_m;
    anchor_ = place;
  }
}

}  // namespace playerlike
