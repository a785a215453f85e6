// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/results/run_log.h"
#include "host/stepping/client.h"
#include "playerlike/host/event_client.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The clients of a run and their subscriptions; distributes readings.
///
/// Clients are in the order in which their inputs are applied: followers first, then the others,
/// then onlookers, each group in order of number. Not thread-safe: guarded by the host's mutex.
class Clients {
 public:
  /// Both arguments must outlive this object.
  /// @param by_creator  virtual time: within a group, clients are in the order in which the threads
  ///                    that connect them were started.
  /// @param mirror  whose readings replace those of the simulation; null: there is none.
  Clients(const sim::Simulation& simulation, const std::vector<RobotInfo>& robots, bool by_creator,
          const Mirror* mirror = nullptr);

  [[nodiscard]] auto begin() const { return clients_.begin(); }
  [[nodiscard]] auto end() const { return clients_.end(); }
  [[nodiscard]] bool any_but_onlookers() const;

  std::shared_ptr<Client> add(int port, EventRole role, std::function<void()> notify,
                              const CreationOrder& order = {});
  void remove(Client& client) noexcept;

  void subscribe(Client& client, DeviceId device);
  void unsubscribe(Client& client, DeviceId device);
  /// @param device  one of the client's; nullopt: all devices, also those subscribed to later.
  void set_replace(Client& client, std::optional<DeviceId> device, bool replace);

  /// Gives the readings of a step to the subscribed clients.
  /// @param logs  by port; a log that is replayed replaces the devices of its port.
  void distribute(const std::map<int, RunLog>& logs);
  /// Notes the loss of a real robot for each client that has subscribed to its readings.
  void note_loss(const Mirror::Loss& loss);
  /// Why a client would wait without end: all readings that it has subscribed to come from real
  /// robots whose connections are lost. Empty: it would not.
  [[nodiscard]] std::string reason_not_to_wait(const Client& client) const;
  /// The newest reading of a sensor, of which each subscriber was given a share; null before the
  /// first.
  [[nodiscard]] sim::SharedReading newest(DeviceId device) const;
  /// The number of readings of a sensor up to now. Any thread may call.
  [[nodiscard]] std::uint64_t count_of_readings(DeviceId device) const noexcept {
    return feed(device).readings;
  }
  /// Takes a client's unread readings, in order of device.
  std::vector<std::pair<DeviceId, sim::SharedReading>> take(Client& client);

 private:
  /// What a sensor has given, and to whom.
  struct Feed {
    std::vector<Client*> subscribers;
    std::atomic<std::uint64_t> readings{0};  ///< only one thread counts at a time

    void count() noexcept {
      readings.store(readings.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }
  };

  [[nodiscard]] const Feed& feed(DeviceId device) const noexcept {
    return feeds_[static_cast<std::size_t>(device.robot)][static_cast<std::size_t>(device.device)];
  }
  [[nodiscard]] Feed& feed(DeviceId device) noexcept {
    return const_cast<Feed&>(std::as_const(*this).feed(device));
  }
  /// @return null if the client has no subscription to this device.
  [[nodiscard]] static Client::Subscription* find(Client& client, DeviceId device);
  void forget_subscriber(const Client& client, DeviceId device) noexcept;
  void begin_round(Client& client) const;
  /// Gives a reading to those subscribers of its device for which is_for(client) is true.
  template <typename IsFor>
  static void give(const Feed& feed, DeviceId device, const sim::SharedReading& reading,
                   IsFor is_for);

  const sim::Simulation& simulation_;
  const bool by_creator_;
  const Mirror* const mirror_;
  std::vector<std::shared_ptr<Client>> clients_;
  int next_number_ = 0;
  std::size_t unsubscribed_ = 0;          ///< clients without subscriptions
  std::vector<std::vector<Feed>> feeds_;  ///< by robot and device
};

}  // namespace playerlike
