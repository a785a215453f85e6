// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/b2_distance.h>
#include <box2d/box2d.h>

#include <vector>

#include "sim/core/state_archive.h"

namespace sim::physics {

/// Writes or reads Box2D's state of a world, except shapes and masses: the motion of bodies,
/// contacts with their impulses in Box2D's order, and the tree and the buffer of the broad phase.
///
/// All of this affects later steps: contacts are solved in the order in which the tree reported
/// them, and start with the impulses of the previous step.
/// @param fixtures  all fixtures of the world, by FixtureInfo::id; nullptr: does not exist now.
///     When reading, the bodies must exist, created in the order of those that were written.
void archive_box2d(StateArchive& archive, b2World& world, const std::vector<b2Fixture*>& fixtures);

/// Writes or reads the impulses with which a joint starts its next step.
void archive_joint(StateArchive& archive, b2FrictionJoint& joint);

inline void archive_vector(StateArchive& archive, b2Vec2& vector) { archive(vector.x, vector.y); }

}  // namespace sim::physics
