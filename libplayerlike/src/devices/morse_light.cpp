// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/client_core.h"
#include "core/errors.h"
#include "libCCMorse/MorseLight.h"
#include "sim/core/number_text.h"

namespace CCMorse {

MorseLight::MorseLight(const MorseRobot& aRobot, const std::string& aName)
    : MorseActuator(aRobot, aName, "blinkenlight", "MorseLight") {}
MorseLight::~MorseLight() = default;

void MorseLight::SetOn(bool aOn) {
  const auto lock = Lock("SetOn");
  sim::LightCommand command;
  command.enabled = aOn;
  Core()->send("MorseLight::SetOn", {RobotIndex(), DeviceIndex()}, command);
}

void MorseLight::SetBlinking(double aPeriod, double aDutyCycle) {
  const char* fun = "MorseLight::SetBlinking";
  if (!(aPeriod >= 0.0 && aPeriod <= 1e6 && aDutyCycle >= 0.0 && aDutyCycle <= 1.0)) {
    playerlike::refuse(
        fun, "a light's period is in 0..1e6 s and its duty cycle in 0..1, but they are " +
                 sim::rounded_text(aPeriod, 6) + " and " + sim::rounded_text(aDutyCycle, 6));
  }
  const auto lock = Lock("SetBlinking");
  sim::LightCommand command;
  command.period_s = aPeriod;
  command.duty_cycle = aDutyCycle;
  Core()->send(fun, {RobotIndex(), DeviceIndex()}, command);
}

void MorseLight::SetColour(std::uint8_t aRed, std::uint8_t aGreen, std::uint8_t aBlue) {
  const auto lock = Lock("SetColour");
  sim::LightCommand command;
  command.colour = sim::Colour{aRed, aGreen, aBlue, 255};
  Core()->send("MorseLight::SetColour", {RobotIndex(), DeviceIndex()}, command);
}

}  // namespace CCMorse
