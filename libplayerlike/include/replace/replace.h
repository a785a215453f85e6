// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file replace/replace.h
/// Player's replacements for functions that some systems lack. Linux has all of them, so this
/// header only includes the system headers that declare them. For C and C++.

#include <dirent.h>
#include <getopt.h>
#include <math.h>
#include <poll.h>
#include <sys/time.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>
