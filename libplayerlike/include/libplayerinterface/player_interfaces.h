/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// The interfaces' constants and data types, as Player has them in a header of their own.

#include "libplayerinterface/player.h"
