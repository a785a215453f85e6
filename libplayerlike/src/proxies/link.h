// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/client_core.h"
#include "libplayerc++/clientproxy.h"
#include "playerlike/messages/messages.h"
#include "proxies/interfaces.h"

namespace PlayerCc {

/// The name of a proxy's elements, for warnings.
struct ElementWords {
  const char* one;                      ///< "beam"
  const char* many;                     ///< "beams"
  const char* owner_has = "there are";  ///< text before the count
  const char* value = "0";              ///< value of elements past the end
};

/// The end of a proxy that sessions see: receives readings, and knows which devices stand behind
/// it.
struct ClientProxy::Link final : playerlike::ReadingListener {
  Link(ClientProxy& owner, std::shared_ptr<playerlike::ClientCore> shared)
      : proxy(owner), core(std::move(shared)) {
    core->bind(proxy.mElements);
  }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  ~Link() override { core->unbind(proxy.mElements); }

  void on_reading(const sim::SharedReading& reading) override;
  void on_round() override;
  bool on_poll() override;
  std::function<void()> notification() override;
  void on_close() override;

  /// Locks the client's mutex and counts `looks` accesses to data. @throws PlayerError as
  /// LockData().
  [[nodiscard]] scoped_lock_t lock(const char* fun, int looks = 1) const;
  /// As lock(), without the check that the client is usable.
  [[nodiscard]] scoped_lock_t lock_anyway(int looks = 1) const;
  /// Locks for a command, which is no access to data. @throws PlayerError as LockData().
  [[nodiscard]] scoped_lock_t lock_for_command(const char* fun) const;
  /// Locks for an access that Elements::Find() could not answer without the mutex.
  [[nodiscard]] scoped_lock_t lock_element(const char* fun) const {
    return lock(fun, proxy.mElements.Looks());
  }
  /// Lets the getters return a reading. The client's mutex is held, and begin_change() was called
  /// if they could return another one before.
  /// @param whole  of rangefinders: the whole scan, if `reading` is a part of it.
  void show(sim::SharedReading reading, sim::SharedReading whole = nullptr) {
    newest.reading = std::move(reading);
    whole_scan = std::move(whole);
    playerlike::show_elements(proxy.mElements, newest);
  }
  /// Of rangefinders: the whole scan of which a part may be shown.
  [[nodiscard]] const sim::SharedReading& measured() const {
    return whole_scan != nullptr ? whole_scan : newest.reading;
  }
  /// Notes new data with this time stamp [s]. The client's mutex is held.
  void refresh(double time_s);

  [[nodiscard]] const playerlike::RobotInfo& robot() const {
    return core->robot_of(binding.reading);
  }
  [[nodiscard]] const playerlike::DeviceInfo& info() const {
    return core->info_of(binding.reading);
  }
  /// A property of the device that makes the readings.
  [[nodiscard]] double property(const std::string& name, double otherwise) const;

  /// A property that programs ask for by its name and type: bool, int32_t, double or string.
  /// @return nothing if the device has none.
  template <typename T>
  [[nodiscard]] std::optional<T> named_property(const char* fun, const char* name) const;
  /// Sets such a property, which only devices of Player servers may have. @return 0, or -1.
  template <typename T>
  int set_named_property(const char* fun, const char* name, const T& value) const;

  /// Returns whether `index` is below `count`. All getters and setters of one element use this
  /// check.
  ///
  /// If it is not, the function warns once for this proxy and its copies. Callers continue with 0,
  /// because Player's proxies read undefined memory in this case. There is no warning while `count`
  /// is 0, because programs access elements before their first Read().
  [[nodiscard]] bool has_element(const char* fun, const ElementWords& words, std::int64_t index,
                                 std::size_t count) const;
  /// Returns the element of a list, or zero if it does not exist; see has_element().
  template <typename T>
  [[nodiscard]] T element_or_zero(const char* fun, const ElementWords& words, std::int64_t index,
                                  const std::vector<T>& list) const {
    if (!has_element(fun, words, index, list.size())) return T{};
    return list[static_cast<std::size_t>(index)];
  }
  /// Warns in the name of `fun`, unless this proxy or a copy of it has warned before.
  void warn_once(const char* fun, const std::string& text) const;

  /// Gives a command to the device that readings come from; with the client's mutex held.
  void send(const char* fun, const sim::Command& command) const {
    core->send(fun, binding.reading, command);
  }

  ClientProxy& proxy;
  const std::shared_ptr<playerlike::ClientCore> core;
  playerlike::InterfaceBinding binding;
  bool attached = false;
  bool has_readings = false;  ///< whether it is subscribed to a device that makes readings
  /// What getters return. Elements has a handle of its own, which only the client's holder
  /// releases: while that thread reads numbers without the mutex, another one may replace this.
  playerlike::Newest newest;
  sim::SharedReading whole_scan;  ///< see show()
  playerc_device_t device = {};
  /// Copies share it, because programs pass proxies by value in loops.
  std::shared_ptr<bool> has_warned = std::make_shared<bool>(false);
};

template <typename Reading, typename Function>
auto ClientProxy::Look(Function aLook, const char* aFun) const
    -> decltype(aLook(std::declval<const Reading&>())) {
  const scoped_lock_t lock(LockData(aFun));
  return aLook(mLink->newest.as<Reading>());
}

template <typename Reading, typename T>
T ClientProxy::Look(T Reading::*aMember, const char* aFun) const {
  const scoped_lock_t lock(LockData(aFun));
  return mLink->newest.as<Reading>().*aMember;
}

/// Gives the rest of the library access to a client's core.
struct detail::CoreAccess {
  [[nodiscard]] static const std::shared_ptr<playerlike::ClientCore>& get(
      const PlayerClient& client) {
    return client.mCore;
  }
};

/// Player's name of the driver at an address: that of a Player server, otherwise the type of
/// device or driver, or "world".
[[nodiscard]] inline std::string driver_name(const playerlike::ClientCore& core,
                                             const playerlike::InterfaceBinding& binding) {
  if (binding.address != nullptr) return binding.address->driver;
  if (binding.is_world()) return "world";
  const char* const type = binding.driver_type();
  return type != nullptr ? type : core.info_of(binding.reading).type;
}

}  // namespace PlayerCc
