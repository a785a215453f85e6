// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "host/stepping/clients.h"
#include "host/stepping/command_book.h"
#include "host/stepping/commanders.h"
#include "host/stepping/hand_drive.h"
#include "playerlike/session/layer_registry.h"

namespace playerlike {

class Mirror;

/// Replaces the last queued command if the new one is for the same device and makes it void.
/// Relative movements and counted commands replace nothing. @return whether it did.
[[nodiscard]] bool replaces_last(std::vector<std::pair<DeviceId, sim::Command>>& queue,
                                 DeviceId device, const sim::Command& command);

/// The clients' commands and drawings, and how they are applied to the simulation: commands before
/// each step, drawings then or earlier. The host's mutex guards it unless stated otherwise.
class Inputs {
 public:
  /// @param simulation  must outlive this object.
  /// @param mirror  takes the commands for robots that mirror real ones; null: there are none.
  Inputs(sim::Simulation& simulation, const std::vector<RobotInfo>& robots, Warn warn,
         Mirror* mirror = nullptr)
      : commands(robots.size()),
        commanders(simulation, robots),
        simulation_(simulation),
        mirror_(mirror),
        warn_(std::move(warn)) {}

  /// Stores a command for the next step; the caller holds the client's input mutex, not the host's.
  /// Of successive commands to one device that replace each other, only the last is stored. @return
  /// whether there are too many: then they must be applied now.
  [[nodiscard]] bool add(Client& client, DeviceId device, const sim::Command& command);

  /// Applies the clients' commands for the next step, then the user's commands from the window.
  void before_step(const Clients& clients);
  void apply(Client& client);
  /// Executes a command in the simulation, or sends it to the real robot that the device mirrors:
  /// the only way to command a device. @return nothing on success, otherwise the reason.
  std::optional<std::string> execute(DeviceId device, const sim::Command& command);
  /// Executes a command of somebody who is not a client, at once.
  /// @return as execute().
  std::optional<std::string> execute_for(Commanders::Who who, DeviceId device,
                                         const sim::Command& command);
  /// Stops robots that nobody commands any more.
  void stop(const std::vector<int>& robots);
  /// The same before the next step, or at once if they mirror real robots.
  void stop_at_next_step(const std::vector<int>& robots);
  void apply_drawings(Client& client);
  /// Allocates a client's draw queue.
  void reserve_drawings(Client& client);
  /// Removes drawings except those on the shared canvas or on one of the client's layers.
  void keep_own_drawings(const Client& client, std::vector<sim::DrawOperation>& operations) const;

  /// The owners of the layers.
  LayerRegistry registry;
  /// The clients' commands so far.
  CommandBook commands;
  Commanders commanders;
  /// Steering by hand; only in a run with a window or a page.
  std::optional<HandDrive> hand;
  /// Called for each command that is executed; may be empty.
  std::function<void(DeviceId, const sim::Command&)> on_command;

 private:
  sim::Simulation& simulation_;
  Mirror* const mirror_;
  const Warn warn_;
  std::vector<int> to_stop_;                ///< robots, before the next step
  std::atomic<bool> commands_wait_{false};  ///< a client has sent commands since the last step
  bool somebody_draws_ = false;             ///< a client has had a draw queue
};

}  // namespace playerlike
