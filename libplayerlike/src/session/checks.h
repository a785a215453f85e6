// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"

/// What all sessions check before a simulation, or a server, is bothered; see also
/// require_finite().
namespace playerlike {

/// The device as the world has it. @throws SessionError kNoSuchDevice.
const DeviceInfo& require_device(const std::vector<RobotInfo>& robots, DeviceId device);

/// Whether a text that others are shown holds no control character; it may be UTF-8.
[[nodiscard]] bool is_printable(std::string_view text);

}  // namespace playerlike
