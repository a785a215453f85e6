// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Why a goal is refused: a number that is not finite, or a tolerance or speed that is not
/// positive; nothing for a good one.
[[nodiscard]] std::optional<std::string> refusal_of(const GotoCommand& goal);

}  // namespace sim
