// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "playerlike/messages/messages.h"
#include "playerlike/session/layer_registry.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The state of a host between two steps, without its clients: see Host::save() and
/// RunSettings::start.
struct HostState {
  sim::Snapshot snapshot;
  /// Commands that clients have sent for the next step, in the order in which they are executed.
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  /// The layers of the clients, without owners: a new client on the same port that creates a layer
  /// of the same name replaces it.
  LayerRegistry layers;
};

}  // namespace playerlike
