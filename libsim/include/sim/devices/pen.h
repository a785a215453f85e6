// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/canvas/canvas.h"
#include "sim/devices/device.h"

namespace sim {

/// Settings of a pen.
struct PenParams {
  Colour colour{0x00, 0xc8, 0x00, 0xff};  ///< of the trail
  bool trail = false;                     ///< draw where the robot drives, without being told
};

/// The pen by which a robot draws on the canvas. Clients draw what they like with it; with
/// `trail` on it also marks the robot's way by itself.
class Pen final : public Actuator {
 public:
  Pen(std::string name, const PenParams& params);

  [[nodiscard]] const PenParams& params() const noexcept { return params_; }
  /// Marks the way from the last position to this one, if the trail is on and the pen active.
  void mark_trail(const Pose& X_WB, Canvas& canvas);
  void placed(const Pose&) override { has_last_ = false; }  // no line to there
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
