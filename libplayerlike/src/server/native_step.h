// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "playerlike/messages/messages.h"
#include "protocol/number_pick.h"

namespace playerlike::server {

/// What a session has chosen by `select` for its steps, see docs/protocol.md.
struct StepSelection {
  /// A device and the numbers of its readings that an answer to `step` contains.
  struct Device {
    DeviceId id;
    std::vector<protocol::NumberPick> picks;
    sim::SharedReading newest = nullptr;  ///< null: none since the last answer
  };
  std::vector<Device> devices;
  std::vector<std::size_t> by_id;  ///< indices of `devices`, sorted by DeviceId
  std::size_t numbers = 0;         ///< of an answer, as far as it is known before the next step
  std::vector<DeviceId> motions;   ///< that the speeds of a step are for
};

}  // namespace playerlike::server
