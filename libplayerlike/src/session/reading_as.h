// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <typeinfo>

#include "sim/devices/device.h"

namespace playerlike {

/// The reading as its own type; null if it is of another type.
template <typename Reading>
[[nodiscard]] const Reading* reading_as(const sim::Reading& reading) noexcept {
  return typeid(reading) == typeid(Reading) ? static_cast<const Reading*>(&reading) : nullptr;
}

/// A reading that a proxy gets. The headers of clients can name this type, but not one of `sim`:
/// programs have variables with that name.
struct NewReading {
  const sim::SharedReading& reading;
};

}  // namespace playerlike
