// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Where the robot is in the world, as the arena's localisation (a `pose` device) knows it.
///
/// Player's localisers, such as amcl, tell of several poses that they think possible, and need to
/// be told where to begin. This one looks from above: it has one hypothesis, of weight 1, as soon
/// as there is a reading, and its covariance is that of the device's noise. Frames: W world, unless
/// Position2dProxy::SetOdometry() on the same device has moved the frame it reports in.
class LocalizeProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  LocalizeProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LocalizeProxy() override;

  // The map that Player's localisers use. This one uses none, so all of it is 0: MapProxy tells of
  // the world's.
  uint32_t GetMapSizeX() const;  ///< columns: 0
  uint32_t GetMapSizeY() const;  ///< rows: 0
  uint32_t GetMapTileX() const;  ///< column of the map's tile: 0
  uint32_t GetMapTileY() const;  ///< row of the map's tile: 0
  double GetMapScale() const;    ///< side of a cell [m]: 0

  /// Readings that wait to be looked at: 0.
  uint32_t GetPendingCount() const;
  /// How many poses are thought possible: 1, but 0 before the first reading.
  uint32_t GetHypothCount() const;
  /// The pose that is thought possible: mean [m, rad], covariance [m^2, rad^2] (of x, y and yaw,
  /// then 0 off the diagonal) and weight 1.
  /// An index that is not below GetHypothCount() gives zeros; after the first reading a warning
  /// says so, once for each proxy.
  player_localize_hypoth_t GetHypoth(uint32_t aIndex) const;
  /// The same as GetHypothCount().
  uint32_t GetNumHypoths() const;

  /// Fetches the particles of localisers that have some: here the hypothesis is the only one.
  /// @return 0, or -1 before the first reading, when there is none.
  int GetParticles();
  /// Pose of a particle that GetParticles() fetched [m, rad].
  /// An index outside of GetNumParticles() gives zeros; a warning says so, once for each proxy.
  player_pose2d_t GetParticlePose(int index) const;
  /// How many particles GetParticles() fetched: 1, but 0 before.
  uint32_t GetNumParticles() const;

  /// Tells Player's localisers where to begin. This one cannot be lost, so nothing changes; where a
  /// robot stands is set with SimulationProxy::SetPose2d().
  /// @param pose  x [m], y [m], yaw [rad].
  /// @param cov   covariance; not looked at, since Player 2.1 had three numbers here and later ones
  ///              have six.
  /// @throws PlayerError kBadArgument for a pose that is null or no finite number.
  void SetPose(double pose[3], double cov[6]);

 private:
  // Guarded by the client's mutex.
  std::vector<player_pose2d_t> mParticles;
};

}  // namespace PlayerCc

namespace std {
/// Prints the hypotheses, one a line: weight, then x [m], y [m] and yaw [rad].
std::ostream& operator<<(std::ostream& os, const PlayerCc::LocalizeProxy& c);
}  // namespace std
