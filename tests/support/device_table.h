// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <string>
#include <vector>

#include "sim/io/world_io.h"

namespace sim::test {

/// Settings of the devices in this table: enough to check that they are read.
struct PlainParams {
  double frequency_hz = 10.0;
  double noise = 0.0;

  friend bool operator==(const PlainParams&, const PlainParams&) = default;
};

/// A device table for tests of io that need no devices: the S1R's types and a camera, each with the
/// settings "frequency" and "noise".
inline std::vector<io::DeviceType> device_table() {
  std::vector<io::DeviceType> types;
  for (const char* name : {"camera", "laser", "motion", "odometry", "pen", "pose"}) {
    types.push_back(
        {name,
         [](io::Reader& settings, const std::any& defaults) -> std::any {
           PlainParams params = std::any_cast<PlainParams>(defaults);
           params.frequency_hz =
               settings.number("frequency", params.frequency_hz, {0.0, 1000.0, true, "Hz"});
           params.noise = settings.number("noise", params.noise, {0.0, 10.0, false, "m"});
           return params;
         },
         [] { return std::any(PlainParams{}); }});
  }
  return types;
}

}  // namespace sim::test
