/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Player's common macros for angles, numbers and messages (libplayercommon/error.h), for C and
/// C++. A macro that the program has already defined is not changed.

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <sys/param.h>

#include "libplayercommon/error.h"

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

/// Converts radians to degrees.
#ifndef RTOD
#define RTOD(r) ((r)*180.0 / M_PI)
#endif

/// Converts degrees to radians.
#ifndef DTOR
#define DTOR(d) ((d)*M_PI / 180.0)
#endif

/// Normalizes the angle z [rad] to [-pi, pi].
#ifndef NORMALIZE
#define NORMALIZE(z) (atan2(sin(z), cos(z)))
#endif

/// Boolean type in C.
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

/// Number of elements of an array.
#ifndef ARRAYSIZE
#define ARRAYSIZE(x) ((int)(sizeof(x) / sizeof((x)[0])))
#endif

/// Asserts that an index is within an array.
#ifndef ASSERT_INDEX
#define ASSERT_INDEX(index, array) assert((size_t)(index) < sizeof(array) / sizeof((array)[0]));
#endif

/// Same as assert().
#ifndef VERIFY
#define VERIFY(m) assert(m)
#endif

/// Reads a number of the given type at the address in a pointer.
#ifndef GETFIRSTUINT8
#define GETFIRSTUINT8(x) (*((uint8_t*)(x)))
#define GETFIRSTINT8(x) (*((int8_t*)(x)))
#define GETFIRSTUINT16(x) (*((uint16_t*)(x)))
#define GETFIRSTINT16(x) (*((int16_t*)(x)))
#define GETFIRSTUINT32(x) (*((uint32_t*)(x)))
#define GETFIRSTINT32(x) (*((int32_t*)(x)))
#endif

/// Lower byte and upper byte of a 16-bit number; MAKEUINT16 combines two bytes.
#ifndef LOBYTE
#define LOBYTE(w) ((uint8_t)((w)&0xFF))
#endif
#ifndef HIBYTE
#define HIBYTE(w) ((uint8_t)(((w) >> 8) & 0xFF))
#endif
#ifndef MAKEUINT16
#define MAKEUINT16(lo, hi) ((uint16_t)((((uint16_t)(hi)) << 8) | ((uint16_t)(lo))))
#endif

/// Maximum length of a file name.
#ifndef MAX_FILENAME_SIZE
#define MAX_FILENAME_SIZE PATH_MAX
#endif
