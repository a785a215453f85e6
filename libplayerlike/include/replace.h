// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

// replace/replace.h, for programs that include it without its folder.

#include "replace/replace.h"
