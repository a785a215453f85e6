// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// libplayerc++/playerclient.h, for programs that leave out the folder.

#include "libplayerc++/playerclient.h"
