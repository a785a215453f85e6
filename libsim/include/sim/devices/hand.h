// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "sim/devices/mount.h"

namespace sim {

/// Settings of a hand. Angle, distance and tag are those of MORSE's Gripper.
struct HandParams : SensorMount {
  double frequency_hz = 10.0;                 ///< [Hz]
  double angle_rad = std::numbers::pi / 3.0;  ///< full aperture of its reach, (0, 2 pi]
  double distance_m = 0.5;                    ///< of the farthest object that it reaches [m]
  std::string tag = "Graspable";              ///< it takes objects with this tag; empty: all
};

/// A reading of a hand.
struct HandReading final : Reading {
  std::string held;  ///< name of the object that it holds; empty: none
  std::string near;  ///< name of the object that it would take now; empty: none
};

/// Takes an object near it and carries it (MORSE's Gripper). It has no fingers: what it takes keeps
/// its pose relative to the robot.
///
/// Takes GripCommand: kClose takes the nearest `portable` obstacle whose middle is in a cone about
/// the hand's x axis; kOpen puts it down. The object stays on the plane: an arm that moves does not
/// move it.
class Hand final : public SensorOf<HandReading> {
 public:
  Hand(std::string name, const HandParams& params);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] std::string_view carrier() const noexcept override { return mounting_.carrier(); }
  /// Refuses to close where nothing is in reach, to open if something is in the object's way, and
  /// any other action. To close a hand that holds something, and to open an empty one, do nothing.
  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  void archive(StateArchive& archive) override;

  /// Name of the object that it holds; empty: none.
  [[nodiscard]] std::string held(const WorldDescription& world, int robot) const;
  /// Index of the obstacle that it would take; -1: none.
  [[nodiscard]] int nearest(const WorldDescription& world, const BodyState& body) const;

 protected:
  void measure(const StepContext& context) override;

 private:
  [[nodiscard]] bool holds(const WorldDescription& world, int robot) const;

  HandParams params_;
  Mounting mounting_;
  int held_ = -1;  // index of the obstacle; another client may have moved it elsewhere
};

}  // namespace sim
