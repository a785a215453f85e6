// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's data types, and those of its C client library, under the name that this library's
/// headers use.

#include "libplayerc/playerc.h"
#include "libplayerinterface/player.h"
