// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace playpen::fuzz {

/// A fault of a device of the robot under test.
struct DeviceFault {
  enum class Kind {
    kDead,   ///< no readings from a time on
    kGap,    ///< no readings for a while
    kBlind,  ///< the maximum range from a time on
    kJump,   ///< the pose jumps at a time
    kDrift,  ///< distances are measured too long or too short, in the whole run
  };
  Kind kind = Kind::kDead;
  std::string device;  ///< its name
  double at_s = 1.0;   ///< when it begins, in tenths; not of a drift [s]
  double for_s = 0.0;  ///< of a gap, in tenths [s]
  double x_m = 0.0;    ///< of a jump: forward, in centimetres [m]
  int yaw_deg = 0;     ///< of a jump
  double scale = 1.0;  ///< of a drift: the measured distance over the true one
};

/// Adds the timers of a fault to those of a world file's controller; none for a drift.
/// @param robot  that has the device.
/// @param name   of the timer; a second one has an end.
void add_timers(nlohmann::ordered_json& timers, const DeviceFault& fault, const std::string& robot,
                const std::string& name);

/// A phrase about a fault: "a laser that is dead from 12 s on".
[[nodiscard]] std::string text_of(const DeviceFault& fault);

}  // namespace playpen::fuzz
