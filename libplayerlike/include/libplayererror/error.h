/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// libplayercommon/error.h, under the name that it had in Player 2.1.

#include "libplayercommon/error.h"
