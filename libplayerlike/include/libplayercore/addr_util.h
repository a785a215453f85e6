/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// libplayerinterface/addr_util.h, under the name that it had in Player 2.

#include "libplayerinterface/addr_util.h"
