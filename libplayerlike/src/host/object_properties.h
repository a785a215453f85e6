// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

/// What sessions offer of robots and obstacles by name; docs/simulation.md lists the properties.
namespace playerlike {

/// The robot or obstacle of that name. @throws SessionError kBadArgument that names those there
/// are.
[[nodiscard]] sim::SceneObject require_object(const sim::Simulation& simulation,
                                              const std::string& name);

/// Puts it somewhere. @throws SessionError kBadArgument: no such object, a pose that is not finite,
/// or what is against it.
void place_object(sim::Simulation& simulation, const std::string& name, const sim::Pose& pose);

/// @throws SessionError kBadArgument: no such object, or a property that it has not, naming those
/// it
///         has.
[[nodiscard]] PropertyValue object_property(const sim::Simulation& simulation,
                                            const std::string& name, const std::string& property);

/// @throws SessionError kBadArgument as object_property(); for a property that cannot be changed,
/// and
///         a value that it cannot have.
void set_object_property(sim::Simulation& simulation, const std::string& name,
                         const std::string& property, const PropertyValue& value);

}  // namespace playerlike
