// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What old programs ask the preprocessor about Player: the version whose interface this library
/// has.

#include <stdint.h>

/// The version of Player whose interface this library has, as a text.
#ifndef PLAYER_VERSION
#define PLAYER_VERSION "3.1.0"
#endif
