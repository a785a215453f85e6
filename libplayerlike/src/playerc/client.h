// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <vector>

#include "libplayerc++/playerclient.h"
#include "libplayerc/playerc.h"

namespace playerlike::clib {

class Device;

/// A client of the C library: its struct, and what is kept beside it. It does its work by a
/// PlayerClient, as its devices do by proxies.
///
/// A round of data fills the proxies at once, but programs are told of one device at a time: those
/// that have not been told of yet wait in `arrived`, and take over what their proxies have when
/// they leave it.
class Client final : public playerc_client_t {
 public:
  Client(const char* host, int port);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client();

  /// The client behind a struct. @throws PlayerError for a null pointer.
  [[nodiscard]] static Client& of(playerc_client_t* client);

  void connect();
  void disconnect() noexcept;
  /// @throws PlayerError if there is no connection.
  [[nodiscard]] PlayerCc::PlayerClient& player() const;

  /// Whether something is there to be delivered, without letting simulated time go on.
  [[nodiscard]] bool look();
  /// The same, waiting for so long; less than 0: until there is something, or the run is over.
  [[nodiscard]] bool peek(std::chrono::milliseconds timeout);
  /// Waits for a round of data. @throws PlayerError also at the end of the run.
  void read_round();
  /// The next struct that a program is told of, null if there is none: a device's, brought up to
  /// date, or the client's own at the end of a round.
  void* deliver();

  void add(Device& device);
  void remove(Device& device) noexcept;
  void note_arrival(Device& device);
  /// Takes out what a device has not been told of yet.
  void forget_arrival(const Device& device) noexcept;
  /// The device that begins with this; null if it is a program's own.
  [[nodiscard]] Device* find(const playerc_device_t* common) const noexcept;
  /// The first device at an address; null if there is none.
  [[nodiscard]] Device* find(int code, int index) const noexcept;
  [[nodiscard]] const std::vector<Device*>& all() const noexcept { return devices_; }

  void set_replace_rule(int code, int index, int type, bool replace);
  /// Carries out what was said of this device before it was subscribed to.
  void apply_replace_rules(Device& device);

  void join(playerc_mclient_t& group) { groups_.push_back(&group); }
  void leave(const playerc_mclient_t& group) noexcept;

 private:
  struct ReplaceRule {
    int code;
    int index;
    bool replace;
  };

  void end_round();

  std::unique_ptr<PlayerCc::PlayerClient> player_;
  std::vector<Device*> devices_;  // in the order in which they were made
  std::deque<Device*> arrived_;   // null: the client itself
  std::vector<ReplaceRule> replace_rules_;
  std::vector<playerc_mclient_t*> groups_;
};

}  // namespace playerlike::clib
