// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/playererror.h"

namespace CCMorse {

/// The one class under both names; see PlayerCc::PlayerError.
using PlayerCc::PlayerError;

/// What everything in this library throws: PlayerError, as CCMorse programs call it.
typedef PlayerCc::PlayerError MorseError;

}  // namespace CCMorse
