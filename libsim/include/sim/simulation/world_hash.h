// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world/description.h"

namespace sim {

/// Hash that identifies a world. It covers everything that a run depends on, except what a host's
/// RunSettings may change (seed, duration, time mode and factor, view mode).
///
/// It includes all fields of the world, its robots' models and devices but those that are marked
/// as no part of its identity (Field::is_identity). Names of files are not included. Equal
/// descriptions give equal hashes on all machines of the same byte order; two different worlds have
/// equal hashes only by chance (2^-64).
[[nodiscard]] std::uint64_t world_hash(const WorldDescription& world);

}  // namespace sim
