// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Pose of the robot in the world, measured by the arena's localisation (a `pose` device).
///
/// Player's localisers, such as amcl, have several hypotheses and need an initial pose. The arena's
/// localisation observes the robot from above: from the first reading on it has exactly one
/// hypothesis, of weight 1, whose covariance is that of the device's noise.
///
/// Frame: the world frame W, unless Position2dProxy::SetOdometry() on the same device has changed
/// it.
class LocalizeProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  LocalizeProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LocalizeProxy() override;

  // The map that Player's localisers use. This localisation uses no map, so all values are 0.
  // MapProxy gives the world's map.
  uint32_t GetMapSizeX() const;  ///< columns: 0
  uint32_t GetMapSizeY() const;  ///< rows: 0
  uint32_t GetMapTileX() const;  ///< column of the map's tile: 0
  uint32_t GetMapTileY() const;  ///< row of the map's tile: 0
  double GetMapScale() const;    ///< side length of a cell [m]: 0

  /// Number of readings that wait for processing: 0.
  uint32_t GetPendingCount() const;
  /// Number of hypotheses: 1, or 0 before the first reading.
  uint32_t GetHypothCount() const;
  /// The pose that is thought possible: mean [m, rad], covariance [m^2, rad^2] (of x, y and yaw,
  /// then 0 off the diagonal) and weight 1.
  /// An index that is not below GetHypothCount() gives zeros; after the first reading a warning
  /// says so, once for each proxy.
  player_localize_hypoth_t GetHypoth(uint32_t aIndex) const;
  /// Same as GetHypothCount().
  uint32_t GetNumHypoths() const;

  /// Fetches the particles of a particle filter. Here the hypothesis is the only particle.
  /// @return 0, or -1 before the first reading.
  int GetParticles();
  /// Pose of a particle that GetParticles() fetched [m, rad].
  /// An index outside of GetNumParticles() gives zeros; a warning says so, once for each proxy.
  player_pose2d_t GetParticlePose(int index) const;
  /// Number of particles that GetParticles() has fetched: 1, or 0 before that call.
  uint32_t GetNumParticles() const;

  /// Sets the initial pose of Player's localisers. It changes nothing here, because this
  /// localisation cannot get lost. To move a robot, use SimulationProxy::SetPose2d().
  /// @param pose  x [m], y [m], yaw [rad].
  /// @param cov   covariance; never read, because it has three elements in Player 2.1 and six in
  ///              later versions.
  /// @throws PlayerError kBadArgument for a pose that is null or not finite.
  void SetPose(double pose[3], double cov[6]);

 private:
  // Guarded by the client's mutex.
  std::vector<player_pose2d_t> mParticles;
};

}  // namespace PlayerCc

namespace std {
/// Prints the hypotheses, one per line: weight, then x [m], y [m] and yaw [rad].
std::ostream& operator<<(std::ostream& os, const PlayerCc::LocalizeProxy& c);
}  // namespace std
