// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "libCCMorse/PlayerClient.h"
#include "libplayerc++/localizeproxy.h"

namespace playerlike {
class AmclThread;
class ClientCore;
}  // namespace playerlike

namespace CCMorse {

/// Finds out where a robot is on the world's map, from its laser and its odometry: adaptive Monte
/// Carlo localisation (docs/localisation.md). It runs in its own thread with its own client, so it
/// needs no entry in the world, and works with any server that offers a map, a laser and odometry.
///
/// Its getters have the names of LocalizeProxy. Until the first SetPose() the robot may be anywhere
/// on the map.
///
/// Frames: poses are in the world's frame W.
///
/// The map is that of the world when the driver starts (MapProxy shows it, too); its edge counts as
/// a wall. The robot's motion is the difference between readings of the odometry, so a program that
/// calls Position2dProxy::SetOdometry() meanwhile disturbs the driver.
///
/// Time: in lockstep the driver's thread takes part, and simulated time advances only while the
/// program's own clients wait. Calls at simulated time t take effect at the driver's first round
/// after t; results are those of its last round before now. A run is therefore repeatable although
/// it has several threads.
///
/// Errors: members throw PlayerError kDisconnected once the client is gone, kRunIsOver in the same
/// cases as the client's proxies, and kBadArgument for invalid values.
///
/// Threads: all members may be called from any thread.
class AmclDriver {
 public:
  /// Starts the driver's thread. When the constructor returns, the thread has joined the lockstep.
  /// @param aClient         a client on the robot's port; it must outlive all uses of the driver.
  /// @param aOdometry       index of the position2d that measures the robot's motion; an S1R's
  ///                        odometry is 1.
  /// @param aLaser          index of the laser.
  /// @param aMapResolution  side of a cell of the map [m].
  /// @throws PlayerError kNoSuchDevice for an index that the port does not have, kNotAvailable if
  ///         the client may not read the map, kBadArgument for a null pointer or a map
  ///         without a free cell.
  explicit AmclDriver(PlayerClient* aClient, uint32_t aOdometry = 1, uint32_t aLaser = 0,
                      double aMapResolution = 0.05);
  AmclDriver(const AmclDriver&) = delete;
  AmclDriver& operator=(const AmclDriver&) = delete;
  /// Ends the thread. Simulated time does not advance.
  ~AmclDriver();

  /// The robot is near this pose [m, m, rad], with coordinates up to 1e9 m; the standard deviations
  /// are the settings init_pose_var (1 m) and init_pose_var_yaw_deg.
  void SetPose(double aX, double aY, double aYaw);
  /// The robot is near this pose [m, m, rad].
  /// @param aDeviation     standard deviation of x and of y [m], 0 to 1e9.
  /// @param aYawDeviation  standard deviation of the heading [rad], 0 to 1e9.
  void SetPose(double aX, double aY, double aYaw, double aDeviation, double aYawDeviation);
  /// The robot may be anywhere on the map.
  void Spread();

  /// Number of hypotheses: at most 10; 0 before the driver's first round.
  uint32_t GetHypothCount() const;
  /// A possible pose, the most likely one first: see LocalizeProxy::GetHypoth(). An index that is
  /// not below GetHypothCount() gives zeros.
  player_localize_hypoth_t GetHypoth(uint32_t aIndex) const;
  /// Number of particles.
  uint32_t GetNumParticles() const;
  /// Pose of a particle [m, m, rad]; zeros if there is no such particle.
  player_pose2d_t GetParticlePose(uint32_t aIndex) const;
  /// Weight of a particle; the weights add up to 1. 0 if there is no such particle.
  double GetParticleWeight(uint32_t aIndex) const;
  /// Number of scans that the filter has used since it started.
  uint64_t GetUpdates() const;

  /// Changes a setting. The filter starts anew from the last SetPose(), or anywhere.
  /// @param aName   key in world files, e.g. "pf_max_samples"; docs/devices/amcl.md lists them. The
  ///                names of devices, "frequency", "init_pose" and "map_resolution" do not exist
  ///                here; "init_pose_var" is one number, for x and y.
  /// @param aValue  in the units of world files: angles in degrees.
  /// @throws PlayerError kBadArgument for an unknown name or a value out of range.
  void Set(const std::string& aName, double aValue);
  /// Returns a setting in use, in the units of world files.
  /// @throws PlayerError kBadArgument for an unknown name.
  double Get(const std::string& aName) const;

 private:
  std::shared_ptr<playerlike::ClientCore> mCore;
  std::unique_ptr<playerlike::AmclThread> mThread;
};

}  // namespace CCMorse

namespace PlayerCc {

/// The same class in both namespaces; see CCMorse::AmclDriver.
using CCMorse::AmclDriver;

}  // namespace PlayerCc
