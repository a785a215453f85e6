// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Configuration macros that old programs test: the version of Player whose interface this library
/// has, and the system functions that are available without Player's replacements.

#include <stdint.h>
#include <sys/types.h>

/// The version of Player whose interface this library has, as a text.
#ifndef PLAYER_VERSION
#define PLAYER_VERSION "3.1.0"
#endif

// Features of Linux. A program's own configuration may define these macros too.
#ifndef HAVE_CFMAKERAW
#define HAVE_CFMAKERAW 1
#endif
#ifndef HAVE_CLOCK_GETTIME
#define HAVE_CLOCK_GETTIME 1
#endif
#ifndef HAVE_DIRNAME
#define HAVE_DIRNAME 1
#endif
#ifndef HAVE_GETOPT
#define HAVE_GETOPT 1
#endif
#ifndef HAVE_GETTIMEOFDAY
#define HAVE_GETTIMEOFDAY 1
#endif
#ifndef HAVE_M
#define HAVE_M 1
#endif
#ifndef HAVE_NANOSLEEP
#define HAVE_NANOSLEEP 1
#endif
#ifndef HAVE_POLL
#define HAVE_POLL 1
#endif
#ifndef HAVE_POLLFD
#define HAVE_POLLFD 1
#endif
#ifndef HAVE_POLLIN
#define HAVE_POLLIN 1
#endif
#ifndef HAVE_RINT
#define HAVE_RINT 1
#endif
#ifndef HAVE_ROUND
#define HAVE_ROUND 1
#endif
#ifndef HAVE_STDINT_H
#define HAVE_STDINT_H 1
#endif
#ifndef HAVE_STL
#define HAVE_STL 1
#endif
#ifndef HAVE_STRUCT_TIMESPEC
#define HAVE_STRUCT_TIMESPEC 1
#endif
#ifndef HAVE_USLEEP
#define HAVE_USLEEP 1
#endif
