// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/mapproxy.h"

namespace CCMorse {

/// The one class under both names; see PlayerCc::MapProxy.
using PlayerCc::MapProxy;

}  // namespace CCMorse
