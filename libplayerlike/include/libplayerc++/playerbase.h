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

/// The same direction as z [rad], in [-pi, pi]. Not as in C: a program may have an atan2 of its
/// own.
#ifndef NORMALIZE
#define NORMALIZE(z) (std::atan2(std::sin(z), std::cos(z)))
#endif

// Last, since it leaves alone what is defined above. The other macros are there.
#include "libplayercommon/playercommon.h"
