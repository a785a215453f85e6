// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's error as programs for the real robots include it: the same class as
/// PlayerCc::PlayerError and CCMorse::MorseError.

#include "libCCMorse/MorseError.h"
#include "libplayerc++/playerbase.h"
