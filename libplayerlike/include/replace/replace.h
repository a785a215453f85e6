// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file replace/replace.h
/// What programs include for functions that some systems lack, for which Player had replacements.
/// Linux has them all: this header includes those that declare them. For C and C++.

#include <dirent.h>
#include <getopt.h>
#include <math.h>
#include <poll.h>
#include <sys/time.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>
