// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/b2_distance.h>
#include <box2d/box2d.h>

#include <vector>

#include "sim/core/state_archive.h"

namespace sim::physics {

/// Writes or reads all that Box2D keeps of a world besides shapes and masses: how bodies move,
/// contacts with their impulses, in Box2D's order, and the tree and the buffer of its broad phase.
///
/// All of it bears on what happens next: contacts are solved in the order in which the tree gave
/// them, and begin from the impulses of the step before.
/// @param fixtures  all of the world, by FixtureInfo::id; nullptr: not there now. When reading, the
///                  bodies are there already, made in the order of those that were written.
void archive_box2d(StateArchive& archive, b2World& world, const std::vector<b2Fixture*>& fixtures);

/// Writes or reads where b2Distance begins.
/// @param a, b  the shapes between which it is.
void archive_cache(StateArchive& archive, b2SimplexCache& cache, const b2Shape& a,
                   const b2Shape& b);

inline void archive_vector(StateArchive& archive, b2Vec2& vector) { archive(vector.x, vector.y); }

}  // namespace sim::physics
