// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

class ActArray;
class Ptz;

/// Settings of a posture sensor.
struct PostureParams {
  double frequency_hz = 10.0;  ///< [Hz]
  std::string of;              ///< name of the robot's ptz or actarray; empty: none
};

/// A reading of a posture sensor.
struct PostureReading final : Reading {
  std::vector<std::string> joints;  ///< names; of a ptz "pan" and "tilt"
  std::vector<double> positions;    ///< of the joints, in the same order [m or rad]
};

/// Reports the positions of the joints of a ptz or an actarray by their names (MORSE's PTUPosture
/// and ArmaturePose).
class Posture final : public SensorOf<PostureReading> {
 public:
  Posture(std::string name, const PostureParams& params);
  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] std::string_view carrier() const noexcept override { return params_.of; }
  /// Names of the joints.
  [[nodiscard]] std::vector<std::string> joints() const;
  /// Positions of the joints now, in the same order [m or rad].
  [[nodiscard]] std::vector<double> positions() const;
  /// Lengths of an arm's links, in the order of its joints; empty for a ptz [m].
  [[nodiscard]] std::vector<double> lengths_m() const;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }

 protected:
  void measure(const StepContext& context) override;

 private:
  PostureParams params_;
  const Ptz* head_ = nullptr;
  const ActArray* arm_ = nullptr;
};

}  // namespace sim
