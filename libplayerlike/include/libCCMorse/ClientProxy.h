// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/clientproxy.h"

namespace CCMorse {

/// The one class under both names; see PlayerCc::ClientProxy.
using PlayerCc::ClientProxy;

}  // namespace CCMorse
