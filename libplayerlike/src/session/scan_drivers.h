// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "playerlike/messages/driver_settings.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

/// What the drivers lasercspace and laserposeinterpolator make of scans. The proxies and Player's
/// wire protocol share it.
namespace playerlike {

/// The border of the free configuration space: each range is shortened to the distance that the
/// middle of a disc of the radius can move along the beam, from the laser on, before the disc
/// touches the end of a beam.
///
/// As in Player's driver lasercspace, the ends of beams that met nothing count, too. A range is 0
/// if the disc touches an end from the start.
/// @note O(beams^2 / step).
[[nodiscard]] std::shared_ptr<sim::LaserReading> configuration_space(
    const sim::LaserReading& scan, const CspaceSettings& settings);

/// The scan that a driver makes of a laser's.
[[nodiscard]] sim::SharedReading made_scan(const ScanDriverInfo& driver,
                                           const sim::SharedReading& scan);

/// The newest poses, to find the pose at the time of a scan.
class ScanPoses {
 public:
  /// @param interpolate  see PoseInterpolatorSettings.
  explicit ScanPoses(bool interpolate) : interpolate_(interpolate) {}

  void add(const sim::PoseReading& reading);
  /// Whether the pose at this time is known: there is a pose of this time or a later one, or
  /// without interpolation any pose.
  [[nodiscard]] bool knows(sim::SimTime time_ns) const;
  /// The pose at a time, between the two newest poses by linear interpolation; outside of their
  /// times the nearer one of them. nullopt before the first pose.
  [[nodiscard]] std::optional<sim::Pose> at(sim::SimTime time_ns) const;

 private:
  struct Stamped {
    sim::SimTime time_ns;
    sim::Pose pose;
  };
  bool interpolate_;
  std::optional<Stamped> newest_;
  std::optional<Stamped> before_;
};

}  // namespace playerlike
