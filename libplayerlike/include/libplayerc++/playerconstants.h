// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's constants, under the name that this library's headers use.

#include "libplayerinterface/player_constants.h"
