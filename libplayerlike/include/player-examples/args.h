// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What programs find that include "args.h", as Player's examples do, and have none of their own:
/// the package names this folder as the last to look in.

#include "libplayerc++/args.h"
