// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a voice.
struct SpeechParams {
  double shown_s = 4.0;  ///< for so long a text stands over the robot in pictures [s], > 0
};

/// A robot's voice. What it says by a SayCommand stands over the robot in pictures until it says
/// something else or its time is over, and in the log and the report of the run. An empty text
/// takes away what stands there. No other robot hears it. Refused are texts of more than kMaxSpeech
/// bytes.
class Speech final : public Actuator {
 public:
  Speech(std::string name, const SpeechParams& params);

  /// What stands over the robot now; empty: nothing.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  void integrate(const StepContext& context) override;
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  SpeechParams params_;
  std::string text_;
  SimTime left_ns_ = 0;  ///< until it goes
};

}  // namespace sim
