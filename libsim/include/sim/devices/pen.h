// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/canvas/canvas.h"
#include "sim/devices/device.h"

namespace sim {

/// Settings of a pen.
struct PenParams {
  Colour colour{0x00, 0xc8, 0x00, 0xff};  ///< of the trail
  bool trail = false;                     ///< draw a trail while the robot drives
};

/// The pen with which a robot draws on the canvas. Clients may draw anything with it; with `trail`
/// it also draws the robot's path.
class Pen final : public Actuator {
 public:
  Pen(std::string name, const PenParams& params);

  [[nodiscard]] const PenParams& params() const noexcept { return params_; }
  /// Draws the path from the last position to this one, if the trail is on and the pen is active.
  void mark_trail(const Pose& X_WB, Canvas& canvas);
  void placed(const Pose&) override { has_last_ = false; }  // leave a gap in the trail
  [[nodiscard]] Pen* pen() noexcept override { return this; }
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl&) override { has_last_ = false; }

 private:
  PenParams params_;
  bool has_last_ = false;
  int last_column_ = 0;
  int last_row_ = 0;
};

}  // namespace sim
