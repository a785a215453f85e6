// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's LaserProxy as programs for the real robots include it: the same class as
/// PlayerCc::LaserProxy and CCMorse::LaserProxy.

#include "libCCMorse/ClientProxy.h"
#include "libCCMorse/LaserProxy.h"
#include "libCCMorse/MorseError.h"
#include "libplayerc++/playerbase.h"
