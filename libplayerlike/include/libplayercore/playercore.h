/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// What client programs take from the header of Player's server library: data types, constants,
/// macros and names of interfaces. There are no drivers here, nor anything else of a server.

#include "libplayercommon/error.h"
#include "libplayercommon/playercommon.h"
#include "libplayerinterface/addr_util.h"
#include "libplayerinterface/interface_util.h"
#include "libplayerinterface/player.h"
#include "playerconfig.h"
