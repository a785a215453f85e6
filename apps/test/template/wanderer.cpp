// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "wanderer.h"

#include <algorithm>
#include <cmath>

Wanderer::Wanderer(const std::string& host, unsigned port)
    : client_(host, port), position_(&client_, 0), laser_(&client_, 0) {
  position_.SetMotorEnable(true);
}

void Wanderer::step() {
  client_.Read();  // a tenth of a simulated second
  reads_without_scan_ = laser_.IsFresh() ? 0 : reads_without_scan_ + 1;
  laser_.NotFresh();
  if (reads_without_scan_ > 2 || laser_.GetCount() == 0) {
    position_.SetSpeed(0.0, 0.0);  // blind
    return;
  }
  double left = laser_.GetMaxRange();   // least range ahead on the left [m]
  double right = laser_.GetMaxRange();  // and on the right [m]
  for (unsigned i = 0; i < laser_.GetCount(); ++i) {
    const double bearing = laser_.GetBearing(i);  // [rad], to the left
    if (std::abs(bearing) > 0.9) continue;
    double& side = bearing > 0.0 ? left : right;
    side = std::min(side, laser_.GetRange(i));
  }
  const double nearest = std::min(left, right);
  if (nearest > 0.25) {
    turn_ = 0.0;
  } else if (turn_ == 0.0) {
    turn_ = left > right ? 1.0 : -1.0;  // until the way is free, or corners would hold it
  }
  if (turn_ != 0.0) {
    position_.SetSpeed(0.0, turn_);  // [m/s], [rad/s]
  } else {
    position_.SetSpeed(std::min(0.3, 0.5 * nearest), 0.0);
  }
}
