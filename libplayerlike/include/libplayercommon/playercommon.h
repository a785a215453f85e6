/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Player's odds and ends for programs in C and C++: macros of angles and numbers, and those for
/// messages (libplayercommon/error.h). One that the program has defined before is left alone.

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <sys/param.h>

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
#if !defined(__cplusplus) && !defined(true)
#define true 1
#define false 0
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

/// The same as assert().
#ifndef VERIFY
#define VERIFY(m) assert(m)
#endif

/// The first number of a kind in bytes that a pointer leads to.
#ifndef GETFIRSTUINT8
#define GETFIRSTUINT8(x) (*((uint8_t*)(x)))
#define GETFIRSTINT8(x) (*((int8_t*)(x)))
#define GETFIRSTUINT16(x) (*((uint16_t*)(x)))
#define GETFIRSTINT16(x) (*((int16_t*)(x)))
#define GETFIRSTUINT32(x) (*((uint32_t*)(x)))
#define GETFIRSTINT32(x) (*((int32_t*)(x)))
#endif

/// The lower and the upper byte of a number of 16 bits, and such a number made of both.
#ifndef LOBYTE
#define LOBYTE(w) ((uint8_t)((w)&0xFF))
#endif
#ifndef HIBYTE
#define HIBYTE(w) ((uint8_t)(((w) >> 8) & 0xFF))
#endif
#ifndef MAKEUINT16
#define MAKEUINT16(lo, hi) ((uint16_t)((((uint16_t)(hi)) << 8) | ((uint16_t)(lo))))
#endif

/// Longest name of a file.
#ifndef MAX_FILENAME_SIZE
#define MAX_FILENAME_SIZE PATH_MAX
#endif
