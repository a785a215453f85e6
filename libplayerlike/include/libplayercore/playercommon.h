/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// libplayercommon/playercommon.h, under the name that it had in Player 2.

#include "libplayercommon/playercommon.h"
