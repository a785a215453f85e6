// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "host/clients.h"
#include "host/view_controls.h"
#include "playerlike/session/layer_book.h"

namespace playerlike {

/// What clients want done with the simulation, and how that is applied: commands before each step,
/// drawings then or earlier. Guarded by the host's mutex, but for what says otherwise.
class Inputs {
 public:
  /// @param simulation  must live as long as this.
  Inputs(sim::Simulation& simulation, Warn warn)
      : simulation_(simulation), warn_(std::move(warn)) {}

  /// Keeps a command for the next step; with the client's input mutex, without the host's. Of
  /// commands in a row to one device that replace each other, the last is kept.
  /// @return whether there are so many that they are to be applied now.
  [[nodiscard]] bool add(Client& client, DeviceId device, const sim::Command& command);

  /// Applies what clients have sent for the next step, and the hand at the window after that.
  void before_step(const Clients& clients);
  void apply(Client& client);
  void apply_drawings(Client& client);
  /// Makes room for a client's drawings, from now on.
  void reserve_drawings(Client& client);
  /// Keeps those drawings that are on the shared canvas or on one of the client's layers.
  void keep_own_drawings(const Client& client, std::vector<sim::DrawOperation>& operations) const;

  /// Whose layers are which.
  LayerBook book;
  /// Of a run with a window.
  std::optional<HandDrive> hand;

 private:
  sim::Simulation& simulation_;
  const Warn warn_;
  std::atomic<bool> commands_wait_{false};  ///< some client has sent some since the last step
  bool somebody_draws_ = false;             ///< some client has had a queue for drawings
};

}  // namespace playerlike
