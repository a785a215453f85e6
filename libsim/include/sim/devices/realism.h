// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/description.h"

namespace sim {

/// Changes the settings of all devices as the world's level says (SimulationDescription::realism):
///
/// - kIdeal sets each setting that has figures for realism (Field::realism) to its ideal figure;
/// - kCourse changes nothing;
/// - kReal sets each of them to its real figure if no file states it (DeviceDescription::given) and
///   it has its default.
///
/// The constructor of Simulation calls it. A second call changes nothing.
void apply_realism(WorldDescription& world);

}  // namespace sim
