// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "core/client_core.h"
#include "session/scan_drivers.h"

namespace playerlike {

/// Subscribes a client to a device that measures the robot's pose, and keeps the newest poses.
/// The client's mutex guards them.
class PoseFeed final : public ReadingListener {
 public:
  /// The caller holds the client's mutex.
  /// @throws SessionError, PlayerCc::PlayerError if the client is not usable.
  PoseFeed(std::shared_ptr<ClientCore> core, DeviceId device, bool interpolate)
      : core_(std::move(core)), poses_(interpolate) {
    core_->add(device, *this);
  }
  PoseFeed(const PoseFeed&) = delete;
  PoseFeed& operator=(const PoseFeed&) = delete;
  ~PoseFeed() override { core_->remove(*this); }

  void on_reading(const sim::SharedReading& reading) override {
    if (const auto* pose = dynamic_cast<const sim::PoseReading*>(reading.get())) poses_.add(*pose);
  }
  [[nodiscard]] const ScanPoses& poses() const { return poses_; }

 private:
  std::shared_ptr<ClientCore> core_;
  ScanPoses poses_;
};

}  // namespace playerlike
