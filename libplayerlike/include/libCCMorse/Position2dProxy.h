// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/position2dproxy.h"

namespace CCMorse {

/// The one class under both names; see PlayerCc::Position2dProxy.
using PlayerCc::Position2dProxy;

}  // namespace CCMorse
