/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Player's odds and ends for programs in C and C++: macros of angles and numbers, and those for
/// messages (libplayercommon/error.h). One that the program has defined before is left alone.

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>

#include "libplayercommon/error.h"

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

/// Radians to degrees.
#ifndef RTOD
#define RTOD(r) ((r)*180.0 / M_PI)
#endif

/// Degrees to radians.
#ifndef DTOR
#define DTOR(d) ((d)*M_PI / 180.0)
#endif

/// The same direction as z [rad], in [-pi, pi].
#ifndef NORMALIZE
#define NORMALIZE(z) (atan2(sin(z), cos(z)))
#endif

/// The type of truth values in C.
#ifndef BOOL
#define BOOL int
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

/// How many elements an array has.
#ifndef ARRAYSIZE
#define ARRAYSIZE(x) ((int)(sizeof(x) / sizeof((x)[0])))
#endif

/// Whether an index lies in an array, asserted.
#ifndef ASSERT_INDEX
#define ASSERT_INDEX(index, array) assert((size_t)(index) < sizeof(array) / sizeof((array)[0]));
#endif

/// Longest name of a file.
#ifndef MAX_FILENAME_SIZE
#define MAX_FILENAME_SIZE PATH_MAX
#endif
