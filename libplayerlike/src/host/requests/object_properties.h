// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

/// Access to robots and obstacles by name; docs/simulation.md lists the properties.
namespace playerlike {

/// The robot or obstacle of this name. @throws SessionError kBadArgument that names the existing
/// objects.
[[nodiscard]] sim::SceneObject require_object(const sim::Simulation& simulation,
                                              const std::string& name);

/// Moves an object. @throws SessionError kBadArgument: no such object, a pose that is not finite,
/// or a pose that is not possible, with the reason.
void place_object(sim::Simulation& simulation, const std::string& name, const sim::Pose& pose);

/// @throws SessionError kBadArgument: no such object, or no such property; the error names the
/// object's properties.
[[nodiscard]] PropertyValue object_property(const sim::Simulation& simulation,
                                            const std::string& name, const std::string& property);

/// @throws SessionError kBadArgument as object_property(); also for a read-only property and for an
/// invalid value.
void set_object_property(sim::Simulation& simulation, const std::string& name,
                         const std::string& property, const PropertyValue& value);

}  // namespace playerlike
