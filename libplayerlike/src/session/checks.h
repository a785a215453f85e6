// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"

/// Argument checks that all sessions make before they call a simulation or a server; see also
/// require_finite().
namespace playerlike {

/// Finds the device among the robots. @throws SessionError kNoSuchDevice.
const DeviceInfo& require_device(const std::vector<RobotInfo>& robots, DeviceId device);

/// The error for a name that does not exist: it suggests a similar name and lists the known ones.
/// @param what  e.g. "timer".
[[nodiscard]] std::string unknown_name(const char* what, const std::string& name,
                                       const std::vector<std::string>& known);

/// @throws SessionError kBadArgument.
[[noreturn]] void refuse_argument(const std::string& message);
/// Does so if a simulation has given a reason why it cannot do what was requested.
void require_done(const std::optional<std::string>& refusal);

/// Whether a text that is shown to other users has no control character; it may be UTF-8.
[[nodiscard]] bool is_printable(std::string_view text);

}  // namespace playerlike
