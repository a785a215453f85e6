// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// replace/replace.h, as programs include it that leave out its folder.

#include "replace/replace.h"
