// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/speech.h"

#include <utility>

#include "devices/device_kind.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"

namespace sim {

Speech::Speech(std::string name, const SpeechParams& params)
    : Actuator(std::move(name), "speech"), params_(params) {}

std::optional<std::string> Speech::execute(const Command& command, RobotControl& robot) {
  const auto* say = std::get_if<SayCommand>(&command);
  if (say == nullptr) return Actuator::execute(command, robot);
  if (say->text.size() > kMaxSpeech) {
    return "device " + name() + " says at most " + std::to_string(kMaxSpeech) +
           " bytes at a time, but the text has " + std::to_string(say->text.size());
  }
  text_ = say->text;
  left_ns_ = from_seconds(params_.shown_s);
  if (!text_.empty()) robot.say(text_);
  return std::nullopt;
}

void Speech::integrate(const StepContext& context) {
  if (text_.empty()) return;
  left_ns_ -= context.world.simulation.step_ns;
  if (left_ns_ < 0) text_.clear();
}

void Speech::deactivated(RobotControl&) { text_.clear(); }

void Speech::show(SimTime, RobotSnapshot& shot) const {
  if (!text_.empty()) shot.says = text_;
}

void Speech::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive(text_);
  archive.time(left_ns_);
}

constexpr Field kSpeechSettings[] = {
    field<&SpeechParams::shown_s>("shown", "s",
                                  "time for which pictures show a text over the robot")
        .above(0.0, 1000.0),
};
SIM_FIELDS(SpeechParams, kSpeechSettings)

DeviceKind speech_kind() { return device_kind<Speech, SpeechParams, void>("speech", {{"speech"}}); }

}  // namespace sim
