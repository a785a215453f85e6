// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace playerlike {

/// Properties of a server's devices by their names. Sessions with servers whose devices have
/// properties of their own derive from it: those with Player servers.
class DeviceProperties {
 public:
  using Value = std::variant<bool, std::int32_t, double, std::string>;

  /// Asks the device with this index of an interface for a property.
  /// @param kind  any value of the wanted type.
  /// @return a value of that type; nothing if the device refuses or does not answer.
  /// @throws SessionError kNoSuchDevice, kDisconnected.
  [[nodiscard]] virtual std::optional<Value> property(unsigned interface, unsigned index,
                                                      const std::string& name,
                                                      const Value& kind) = 0;
  /// Sets a property. @return whether the device has accepted it. @throws as property().
  [[nodiscard]] virtual bool set_property(unsigned interface, unsigned index,
                                          const std::string& name, const Value& value) = 0;

 protected:
  ~DeviceProperties() = default;
};

}  // namespace playerlike
