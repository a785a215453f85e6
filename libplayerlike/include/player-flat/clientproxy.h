// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// libplayerc++/clientproxy.h, for programs that leave out the folder.

#include "libplayerc++/clientproxy.h"
