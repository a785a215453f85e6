// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Declarations that client programs expect from playerc++.h: standard headers that many of them
/// use without including them, the type `uint` (sys/types.h), and Player's macros, including those
/// of libplayercommon/playercommon.h. A macro that the program has already defined is not changed.

#include <sys/time.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iostream>
#include <list>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Normalizes the angle z [rad] to [-pi, pi]. It calls std::atan2 and not the C function, because a
/// program may define its own atan2.
#ifndef NORMALIZE
#define NORMALIZE(z) (std::atan2(std::sin(z), std::cos(z)))
#endif

// Defines the other macros. It must be last, because it does not change the macros that are defined
// above.
#include "libplayercommon/playercommon.h"
