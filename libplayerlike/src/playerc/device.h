// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"
#include "libplayerc/playerc.h"
#include "playerc/client.h"
#include "playerc/guard.h"
#include "virtual_time/virtual_time.h"

namespace playerlike::clib {

/// The private part of a device of the C library: it owns the proxy that does the device's work
/// while it is subscribed to.
class Device {
 public:
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device();

  /// The common part of the struct.
  [[nodiscard]] playerc_device_t& common() noexcept { return common_; }
  [[nodiscard]] const playerc_device_t& common() const noexcept { return common_; }
  /// Null while it is not subscribed to.
  [[nodiscard]] virtual PlayerCc::ClientProxy* proxy() noexcept = 0;

  /// Sets the client that owns this device from now on; null: none.
  void begin(playerc_client_t* client, int code, int index);
  /// @throws PlayerError for an address without a device; the error names the devices that exist.
  void subscribe(int access);
  void unsubscribe() noexcept;
  void client_is_gone() noexcept;

  /// Copies the proxy's data to the struct and calls the callbacks. @return the struct.
  void* deliver();

 protected:
  explicit Device(playerc_device_t& common) : common_(common) {}

  /// Makes the proxy for the address in the common part.
  virtual void attach(PlayerCc::PlayerClient& player) = 0;
  virtual void detach() noexcept = 0;
  /// Whether the proxy has new data to deliver; called after each round.
  [[nodiscard]] virtual bool has_news() { return true; }
  /// Copies new data from the proxy to the struct.
  virtual void refresh() = 0;
  /// Returns the function that reports the device's new events; empty: none. deliver() calls it
  /// before the callbacks. It may destroy the device.
  [[nodiscard]] virtual std::function<void()> take_events() { return {}; }

 private:
  playerc_device_t& common_;
  Client* client_ = nullptr;
};

/// A struct of the C library, backed by a proxy of libplayerc++.
template <typename CStruct, typename Proxy>
class ProxyBacked : public CStruct, public Device {
 public:
  using Struct = CStruct;

  ProxyBacked() : CStruct(), Device(static_cast<CStruct*>(this)->info) {}

  [[nodiscard]] Proxy* proxy() noexcept override { return proxy_.get(); }
  /// @throws PlayerError if the device is not subscribed to.
  [[nodiscard]] Proxy& proxy_or_throw() const {
    if (proxy_ == nullptr) refuse("the device is not subscribed to");
    return *proxy_;
  }

 protected:
  void attach(PlayerCc::PlayerClient& player) override {
    proxy_ = std::make_unique<Proxy>(&player, this->info.addr.index);
  }
  void detach() noexcept override { proxy_.reset(); }
  void refresh() override {}

 private:
  std::unique_ptr<Proxy> proxy_;
};

/// The driver name of the device at an address of the client's port. @throws PlayerError
/// kNoSuchDevice; the error names the devices that exist.
[[nodiscard]] std::string driver_at(PlayerCc::PlayerClient& player, int code, int index);

/// The device behind a struct. @throws PlayerError for a null pointer.
template <typename T>
[[nodiscard]] T& device_of(typename T::Struct* device) {
  if (device == nullptr) refuse("the device is a null pointer");
  return static_cast<T&>(*device);
}

/// Runs action(device) with the device behind a struct; handles errors like reported().
template <typename T, typename Action>
auto with_device(const char* fun, typename T::Struct* device, Action action) {
  virtual_time::count_data_reads();
  return reported(fun, [&] { return action(device_of<T>(device)); });
}

/// Length to allocate for an array of `count` readings. Beyond the readings the array is padded, at
/// first with zeros, to the length that such arrays had in Player 2, because programs index it with
/// the beam numbers of their own laser.
[[nodiscard]] inline std::size_t with_room(std::size_t count) noexcept {
  constexpr std::size_t kLeast = 1024;
  return std::max(count, kLeast);
}

/// Fills the array behind a struct's pointer and pads it, see with_room(). @return its address,
/// which is never null: after a reading Player's library has allocated its arrays even if they are
/// empty, and programs look at the first element before they look at the count.
template <typename T, typename Element>
[[nodiscard]] T* copied(std::vector<T>& array, uint32_t count, Element element) {
  array.resize(with_room(count));
  for (uint32_t i = 0; i < count; ++i) array[i] = element(i);
  return array.data();
}

/// Stores a result unless the caller passed a null pointer.
template <typename T, typename Value>
void store_result(T* where, Value value) {
  if (where != nullptr) *where = static_cast<T>(value);
}

// NOLINTBEGIN(bugprone-macro-parentheses): arguments are types and parts of names
/// The four functions that all devices have.
#define PLAYERLIKE_CLIB_FRAME(name, Type, code)                                                    \
  playerc_##name##_t* playerc_##name##_create(playerc_client_t* client, int index) {               \
    return playerlike::clib::guarded(                                                              \
        __func__, [&]() -> playerc_##name##_t* {                                                   \
          auto device = std::make_unique<Type>();                                                  \
          device->begin(client, code, index);                                                      \
          return device.release();                                                                 \
        });                                                                                        \
  }                                                                                                \
  void playerc_##name##_destroy(playerc_##name##_t* device) { delete static_cast<Type*>(device); } \
  int playerc_##name##_subscribe(playerc_##name##_t* device, int access) {                         \
    return playerlike::clib::with_device<Type>(__func__, device,                                   \
                                               [&](Type& self) { self.subscribe(access); });       \
  }                                                                                                \
  int playerc_##name##_unsubscribe(playerc_##name##_t* device) {                                   \
    return playerlike::clib::with_device<Type>(__func__, device,                                   \
                                               [](Type& self) { self.unsubscribe(); });            \
  }
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace playerlike::clib
