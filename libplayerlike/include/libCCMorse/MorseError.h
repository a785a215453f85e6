// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/playererror.h"

namespace CCMorse {

/// The same class in both namespaces; see PlayerCc::PlayerError.
using PlayerCc::PlayerError;

/// Name of PlayerError in CCMorse programs. All functions of this library throw it.
typedef PlayerCc::PlayerError MorseError;

}  // namespace CCMorse
