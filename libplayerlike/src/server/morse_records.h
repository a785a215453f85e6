// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "server/morse_components.h"

namespace playerlike::server {

/// Adds the members of a reading of a sensor of space or air (velocity, gyroscope, gps, posture,
/// semantic_camera, ...) to the object of its stream. @return false for other readings.
bool put_space_record(nlohmann::json& object, const sim::Reading& reading,
                      const StreamFormat& format);

/// The same for pictures and hands: camera, depth_camera, hand.
bool put_picture_record(nlohmann::json& object, const sim::Reading& reading,
                        const StreamFormat& format);

}  // namespace playerlike::server
