// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devices/client_core.h"
#include "libplayerc++/clientproxy.h"
#include "playerlike/messages/messages.h"

namespace PlayerCc {

/// The end of a proxy that sessions see: receives readings, and knows which devices stand behind
/// it.
struct ClientProxy::Link final : playerlike::ReadingListener {
  Link(ClientProxy& owner, std::shared_ptr<playerlike::ClientCore> shared)
      : proxy(owner), core(std::move(shared)) {}

  void on_reading(const sim::Reading& reading) override;
  void on_round() override;
  std::function<void()> notification() override;
  void on_close() override;

  /// Notes that the program looks at the data; with the client's mutex held.
  void note_look() const {
    if (has_readings) core->note_look(valid);
  }
  /// Notes that there are data of this time [s]; with the client's mutex held.
  void refresh(double time_s);

  [[nodiscard]] const playerlike::RobotInfo& robot() const {
    return core->robot_of(binding.reading);
  }
  [[nodiscard]] const playerlike::DeviceInfo& info() const {
    return core->info_of(binding.reading);
  }
  /// A setting of the device that readings come from.
  [[nodiscard]] double property(const std::string& name, double otherwise) const;

  ClientProxy& proxy;
  const std::shared_ptr<playerlike::ClientCore> core;
  playerlike::InterfaceBinding binding;
  bool attached = false;
  bool has_readings = false;  ///< of the device behind it, which it is subscribed to
  bool valid = false;
  playerc_device_t device = {};
};

/// What a device has measured, as the simulator has it; valid as long as that is.
struct detail::Reading {
  const sim::Reading& measured;
};

/// What a client's calls go through, for the rest of the library.
struct detail::CoreAccess {
  [[nodiscard]] static const std::shared_ptr<playerlike::ClientCore>& get(
      const PlayerClient& client) {
    return client.mCore;
  }
};

/// What Player calls the driver behind an address: the kind of device, or "world".
[[nodiscard]] inline std::string driver_name(const playerlike::ClientCore& core,
                                             const playerlike::InterfaceBinding& binding) {
  if (binding.is_world()) return "world";
  return binding.driver != nullptr ? "snd" : core.info_of(binding.reading).type;
}

/// Name of an interface by its code; nullptr if there is none.
[[nodiscard]] const char* interface_name(int code) noexcept;
/// Code of an interface by its name; nullopt if there is none.
[[nodiscard]] std::optional<int> interface_code(const std::string& name) noexcept;

}  // namespace PlayerCc
