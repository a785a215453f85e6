// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/launch/start_of_run.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/host/host_state.h"
#include "playerlike/messages/driver_settings.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/state_archive.h"

namespace playerlike {

sim::Simulation simulation_at_start(sim::WorldDescription world, const RunSettings& settings,
                                    const sim::LogHook& log) {
  check_drivers(world);
  check_interfaces(world);
  settings.apply_to(world);
  sim::Simulation simulation(std::move(world), log);
  if (settings.start) {
    simulation.restore(settings.start->snapshot);
    for (const auto& [device, command] : settings.start->commands) {
      if (const auto refusal = simulation.apply(device, command)) {
        if (log) log(sim::LogLevel::kWarning, *refusal);
      }
    }
    return simulation;
  }
  if (settings.start_state.empty()) return simulation;
  constexpr std::size_t kMostState = std::size_t{1} << 30U;
  const auto refuse = [&settings](const std::string& found) {
    throw sim::ConfigError(std::vector<sim::ConfigIssue>{{"run/start", settings.start_state, "",
                                                          "a state of this world", found,
                                                          "playpen run --from writes such files"}});
  };
  std::string bytes;
  if (const auto error =
          sim::read_whole_file(settings.start_state, {.most_bytes = kMostState}, bytes)) {
    refuse(error->found);
  }
  try {
    simulation.restore({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const sim::SnapshotError& e) {
    refuse(e.what());
  }
  return simulation;
}

}  // namespace playerlike
