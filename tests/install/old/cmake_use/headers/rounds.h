// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
const int rounds = ROUNDS;
