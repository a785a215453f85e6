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

/// A client of the C library: its public struct and its private data. A PlayerClient does its work;
/// proxies do the work of its devices.
///
/// A round of data updates all proxies at once. Devices that are not delivered yet wait in
/// `pending_`; a device copies the data of its proxy when it is delivered. One read delivers the
/// whole round (PULL, the mode after connect()) or one device (PUSH).
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

  /// Whether something can be delivered; does not let simulated time advance.
  [[nodiscard]] bool poll();
  /// As poll(), but waits for up to `timeout`; a negative timeout waits until there is something to
  /// deliver or the run is over.
  [[nodiscard]] bool peek(std::chrono::milliseconds timeout);
  /// Waits for a round of data. @throws PlayerError also at the end of the run.
  void read_round();
  /// Delivers what one read delivers. @return PULL: the client itself, also if a callback has
  /// destroyed it; PUSH: the next device with new data, or the client itself after a round without
  /// data. Null if there was nothing to deliver.
  void* deliver();

  void add(Device& device);
  void remove(Device& device) noexcept;
  void note_arrival(Device& device);
  /// Removes a device's undelivered data.
  void forget_arrival(const Device& device) noexcept;
  /// The device whose struct begins with this common part; null if a program made the struct
  /// itself.
  [[nodiscard]] Device* find(const playerc_device_t* common) const noexcept;
  /// The first device at an address; null if there is none.
  [[nodiscard]] Device* find(int code, int index) const noexcept;
  [[nodiscard]] const std::vector<Device*>& all() const noexcept { return devices_; }

  void set_replace_rule(int code, int index, int type, bool replace);
  /// Applies the rules that were set for this device before it was subscribed to.
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
  void* deliver_next();

  std::unique_ptr<PlayerCc::PlayerClient> player_;
  std::vector<Device*> devices_;  // in order of creation
  std::deque<Device*> pending_;   // null: the client itself, after a round without data
  std::shared_ptr<const char> exists_ = std::make_shared<const char>();
  std::vector<ReplaceRule> replace_rules_;
  std::vector<playerc_mclient_t*> groups_;
};

}  // namespace playerlike::clib
