// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "core/client_core.h"
#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// The session side of a sensor.
struct MorseSensor::Receiver final : playerlike::ReadingListener {
  explicit Receiver(MorseSensor& owner) : sensor(owner) { sensor.Core()->bind(sensor.mElements); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;
  ~Receiver() override { sensor.Core()->unbind(sensor.mElements); }

  void on_reading(const sim::SharedReading& reading) override;
  void on_close() override { newest.valid = false; }

  /// Locks for an access that Elements::Find() could not answer without the mutex.
  [[nodiscard]] PlayerCc::mutex_t::scoped_lock lock_element(const char* function) {
    return sensor.Lock(function, sensor.mElements.Looks());
  }

  MorseSensor& sensor;
  playerlike::Newest newest;
  double time_s = 0.0;
  bool fresh = false;
};

template <typename Reading, typename Function>
auto MorseSensor::Look(const char* aFunction, Function aLook) const
    -> decltype(aLook(std::declval<const Reading&>())) {
  const auto lock = Lock(aFunction);
  return aLook(mReceiver->newest.as<Reading>());
}

template <typename Reading, typename T>
T MorseSensor::Look(const char* aFunction, T Reading::*aMember) const {
  const auto lock = Lock(aFunction);
  return mReceiver->newest.as<Reading>().*aMember;
}

}  // namespace CCMorse
