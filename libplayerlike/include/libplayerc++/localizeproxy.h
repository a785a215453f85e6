// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <type_traits>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Poses at which the robot may be, by a localisation.
///
/// A localisation that uses the world's map (an `amcl` device, or a driver of a Player server) has
/// several hypotheses with weights and covariances, and particles. The arena's localisation (a
/// `pose` device) observes the robot from above: from the first reading on it has exactly one
/// hypothesis, of weight 1, whose covariance is that of the device's noise.
///
/// Frame: the world frame W; of a `pose` device, unless Position2dProxy::SetOdometry() on the same
/// device has changed it.
class LocalizeProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  LocalizeProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LocalizeProxy() override;

  // The map of the localisation; 0 for a `pose` device, which has none, for a Player server, which
  // does not send them, and before the first reading. MapProxy gives the world's map.
  uint32_t GetMapSizeX() const;  ///< columns
  uint32_t GetMapSizeY() const;  ///< rows
  uint32_t GetMapTileX() const;  ///< column of the map's tile: 0
  uint32_t GetMapTileY() const;  ///< row of the map's tile: 0
  double GetMapScale() const;    ///< side length of a cell [m]

  /// Number of scans that wait for processing: 0 in a simulation.
  uint32_t GetPendingCount() const;
  /// Number of hypotheses: at most 10 of amcl, 1 of a `pose` device; 0 before the first reading.
  uint32_t GetHypothCount() const;
  /// A possible pose, the most likely one first: mean [m, rad], covariance (xx, yy, yaw yaw, xy, y
  /// yaw, x yaw) [m^2, rad^2, m rad] and weight.
  /// An index that is not below GetHypothCount() gives zeros; after the first reading a warning
  /// says so, once for each proxy.
  player_localize_hypoth_t GetHypoth(uint32_t aIndex) const;
  /// Same as GetHypothCount().
  uint32_t GetNumHypoths() const;

  /// Fetches the particles of a particle filter: of amcl by a request. For a `pose` device the
  /// hypothesis is the only particle.
  /// @return 0, or -1 before the first reading.
  int GetParticles();
  /// Pose of a particle that GetParticles() fetched [m, rad].
  /// An index outside of GetNumParticles() gives zeros; a warning says so, once for each proxy.
  player_pose2d_t GetParticlePose(int index) const;
  /// Weight of a particle that GetParticles() fetched; the weights add up to 1. Not in Player's
  /// library.
  double GetParticleWeight(int index) const;
  /// Number of particles that GetParticles() has fetched; 0 before that call.
  uint32_t GetNumParticles() const;

  /// Tells amcl, or the localisation of a Player server, where the robot is. It has no effect on a
  /// `pose` device, which cannot get lost. To move a robot, use SimulationProxy::SetPose2d().
  /// @param pose  x [m], y [m], yaw [rad].
  /// @param cov   covariance. An array of 3 numbers, as in Player 2.1, has the variances of x and y
  ///              [m^2] and of yaw [rad^2]. An array of 6 numbers, as in Player 3, adds the
  ///              covariances of x and y [m^2], y and yaw, x and yaw [m rad]. Of a pointer the
  ///              first 3 numbers are read. Null: the variances of the device's settings (amcl), or
  ///              0.5 m and 15 degrees (a Player server).
  /// @throws PlayerError kBadArgument for a pose that is null or not finite, and for a covariance
  ///         that is not finite or not positive semidefinite.
  template <std::size_t kCount>
  void SetPose(double pose[3], const double (&cov)[kCount]) {
    TellPose(pose, cov, kCount);
  }
  template <std::size_t kCount>
  void SetPose(double pose[3], double (&cov)[kCount]) {
    TellPose(pose, cov, kCount);
  }
  /// Same, for a pointer. A template, since arrays would otherwise come here.
  template <typename Pointer>
  typename std::enable_if<std::is_convertible<Pointer, const double*>::value>::type SetPose(
      double pose[3], Pointer cov) {
    TellPose(pose, cov, 3);
  }
  /// Same as SetPose() with a null pointer.
  void SetPose(double pose[3], std::nullptr_t) { TellPose(pose, nullptr, 0); }

 private:
  void TellPose(const double* aPose, const double* aCovariance, std::size_t aCount);

  // Guarded by the client's mutex.
  std::vector<player_pose2d_t> mParticles;
  std::vector<double> mWeights;  // of mParticles
};

}  // namespace PlayerCc

namespace std {
/// Prints the hypotheses, one per line: weight, then x [m], y [m] and yaw [rad].
std::ostream& operator<<(std::ostream& os, const PlayerCc::LocalizeProxy& c);
}  // namespace std
