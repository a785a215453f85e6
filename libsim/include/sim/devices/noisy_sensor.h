// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/core/random_stream.h"
#include "sim/core/state_archive.h"
#include "sim/devices/device.h"
#include "sim/devices/mount.h"

namespace sim {

/// A sensor with settings and a random stream of its own: what is alike in small sensors.
/// @tparam Params       its settings, with `frequency_hz` and `latency_s`.
/// @tparam ReadingType  its readings.
template <typename Params, typename ReadingType>
class NoisySensor : public SensorOf<ReadingType> {
 public:
  /// @param type  its name in world files.
  NoisySensor(std::string name, const char* type, const Params& params, RandomStream noise)
      : SensorOf<ReadingType>(std::move(name), type, params.frequency_hz, params.latency_s),
        params_(params),
        noise_(std::move(noise)) {}
  void archive(StateArchive& archive) override {
    SensorOf<ReadingType>::archive(archive);
    archive(noise_);
  }

 protected:
  [[nodiscard]] const Params& params() const noexcept { return params_; }
  [[nodiscard]] RandomStream& noise() noexcept { return noise_; }

 private:
  Params params_;
  RandomStream noise_;
};

/// A NoisySensor on the robot's body, on a head or on an arm.
/// @tparam Params  its settings, a SensorMount.
template <typename Params, typename ReadingType>
class MountedSensor : public NoisySensor<Params, ReadingType> {
 public:
  MountedSensor(std::string name, const char* type, const Params& params, RandomStream noise)
      : NoisySensor<Params, ReadingType>(std::move(name), type, params, std::move(noise)),
        mounting_(params) {}
  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override {
    return mounting_.connect(robot, devices);
  }
  [[nodiscard]] std::string_view carrier() const noexcept override { return mounting_.carrier(); }

 protected:
  [[nodiscard]] const Mounting& mounting() const noexcept { return mounting_; }

 private:
  Mounting mounting_;
};

}  // namespace sim
