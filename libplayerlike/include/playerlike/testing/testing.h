// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Tests of controller classes and functions, in the test's own process; see docs/testing.md. The
/// matchers are in playerlike/testing/matchers.h, which needs GoogleTest's gmock.
#include "playerlike/testing/run.h"    // IWYU pragma: export
#include "playerlike/testing/world.h"  // IWYU pragma: export
