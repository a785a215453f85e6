/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Player's message macros PLAYER_ERROR, PLAYER_WARN and PLAYER_MSG, for C and C++. The digit in a
/// name is the number of arguments of the printf() format. Errors and warnings are printed to
/// standard error. Messages of level 0 or 1 are printed to standard output; debug messages of
/// higher levels are discarded.

#include <errno.h>
#include <stdio.h>

/// Prints an error or a warning on a separate line.
#define PLAYER_ERROR(msg) ((void)fprintf(stderr, "error   : " msg "\n"))
#define PLAYER_ERROR1(msg, a) ((void)fprintf(stderr, "error   : " msg "\n", a))
#define PLAYER_ERROR2(msg, a, b) ((void)fprintf(stderr, "error   : " msg "\n", a, b))
#define PLAYER_ERROR3(msg, a, b, c) ((void)fprintf(stderr, "error   : " msg "\n", a, b, c))
#define PLAYER_ERROR4(msg, a, b, c, d) ((void)fprintf(stderr, "error   : " msg "\n", a, b, c, d))
#define PLAYER_ERROR5(msg, a, b, c, d, e) \
  ((void)fprintf(stderr, "error   : " msg "\n", a, b, c, d, e))

#define PLAYER_WARN(msg) ((void)fprintf(stderr, "warning : " msg "\n"))
#define PLAYER_WARN1(msg, a) ((void)fprintf(stderr, "warning : " msg "\n", a))
#define PLAYER_WARN2(msg, a, b) ((void)fprintf(stderr, "warning : " msg "\n", a, b))
#define PLAYER_WARN3(msg, a, b, c) ((void)fprintf(stderr, "warning : " msg "\n", a, b, c))
#define PLAYER_WARN4(msg, a, b, c, d) ((void)fprintf(stderr, "warning : " msg "\n", a, b, c, d))
#define PLAYER_WARN5(msg, a, b, c, d, e) \
  ((void)fprintf(stderr, "warning : " msg "\n", a, b, c, d, e))
#define PLAYER_WARN6(msg, a, b, c, d, e, f) \
  ((void)fprintf(stderr, "warning : " msg "\n", a, b, c, d, e, f))
#define PLAYER_WARN7(msg, a, b, c, d, e, f, g) \
  ((void)fprintf(stderr, "warning : " msg "\n", a, b, c, d, e, f, g))

/// Prints a message on a separate line, unless its level is above 1.
#define PLAYER_MSG0(level, msg) ((level) > 1 ? (void)0 : (void)printf("" msg "\n"))
#define PLAYER_MSG1(level, msg, a) ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a))
#define PLAYER_MSG2(level, msg, a, b) ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b))
#define PLAYER_MSG3(level, msg, a, b, c) \
  ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b, c))
#define PLAYER_MSG4(level, msg, a, b, c, d) \
  ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b, c, d))
#define PLAYER_MSG5(level, msg, a, b, c, d, e) \
  ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b, c, d, e))
#define PLAYER_MSG6(level, msg, a, b, c, d, e, f) \
  ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b, c, d, e, f))
#define PLAYER_MSG7(level, msg, a, b, c, d, e, f, g) \
  ((level) > 1 ? (void)0 : (void)printf("" msg "\n", a, b, c, d, e, f, g))
