/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Player's constants and data types, under the name that they had in Player 2.

#include "libplayerinterface/player.h"
