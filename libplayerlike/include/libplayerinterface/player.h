// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What Player calls its interfaces: all constants and data types of its messages. For C and C++.

#include "libplayerinterface/player_constants.h"
#include "libplayerinterface/player_structs.h"
