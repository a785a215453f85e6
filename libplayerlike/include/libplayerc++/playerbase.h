// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What client programs take for granted once they have included playerc++.h: the standard headers
/// that half of them rely on without naming them, the type `uint` (sys/types.h), and Player's
/// macros, those of libplayercommon/playercommon.h too. A macro that the program has defined before
/// is left alone.

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

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

#ifndef TRUE
#define TRUE 1
#endif
#ifndef FALSE
#define FALSE 0
#endif

/// The lesser of two values; each may be evaluated twice.
#ifndef MIN
#define MIN(a, b) (((a) < (b)) ? (a) : (b))
#endif

/// The greater of two values; each may be evaluated twice.
#ifndef MAX
#define MAX(a, b) (((a) > (b)) ? (a) : (b))
#endif

/// Degrees to radians.
#ifndef DTOR
#define DTOR(d) ((d)*M_PI / 180.0)
#endif

/// Radians to degrees.
#ifndef RTOD
#define RTOD(r) ((r)*180.0 / M_PI)
#endif

/// The same direction as z [rad], in [-pi, pi].
#ifndef NORMALIZE
#define NORMALIZE(z) (std::atan2(std::sin(z), std::cos(z)))
#endif

// Last, since it leaves alone what is defined above.
#include "libplayercommon/playercommon.h"
