// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/playerclient.h"

namespace CCMorse {

/// The one class under both names; see PlayerCc::PlayerClient.
using PlayerCc::PlayerClient;

}  // namespace CCMorse
