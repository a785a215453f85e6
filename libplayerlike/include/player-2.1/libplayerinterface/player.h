// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// libplayerinterface/player.h, as programs include it that name the version of Player.

#include "libplayerinterface/player.h"
