// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a voice.
struct SpeechParams {
  double shown_s = 4.0;  ///< display time of a text in pictures [s]
};

/// A robot's voice. The text of a SayCommand appears next to the robot in pictures until the robot
/// says something else or the display time is over, and in the log and the report of the run. An
/// empty text removes the current one. No other robot hears it. Texts over kMaxSpeech bytes are
/// refused.
class Speech final : public Actuator {
 public:
  Speech(std::string name, const SpeechParams& params);

  /// The text shown now; empty: none.
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
  SimTime left_ns_ = 0;  ///< remaining display time
};

}  // namespace sim
