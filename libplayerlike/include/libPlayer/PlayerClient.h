// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's PlayerClient as programs for the real robots include it: the same class as
/// PlayerCc::PlayerClient and CCMorse::PlayerClient.

#include "libCCMorse/ClientProxy.h"
#include "libCCMorse/MorseError.h"
#include "libCCMorse/PlayerClient.h"
#include "libplayerc++/playerbase.h"
