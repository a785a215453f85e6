// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's Position2dProxy as programs for the real robots include it: the same class as
/// PlayerCc::Position2dProxy and CCMorse::Position2dProxy.

#include "libCCMorse/ClientProxy.h"
#include "libCCMorse/MorseError.h"
#include "libCCMorse/Position2dProxy.h"
#include "libplayerc++/playerbase.h"
