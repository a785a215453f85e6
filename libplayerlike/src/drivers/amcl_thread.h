// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "drivers/driver_thread.h"
#include "drivers/timed_mailbox.h"
#include "libplayerc++/laserproxy.h"
#include "libplayerc++/position2dproxy.h"
#include "sim/devices/amcl.h"

namespace playerlike {

/// What an AmclThread knows after a round.
struct AmclState {
  std::vector<sim::PoseHypothesis> hypotheses;  ///< the most likely one first
  std::vector<sim::Particle> particles;
  std::uint64_t updates = 0;  ///< scans used since the filter started
};

/// Runs a sim::MonteCarloLocalizer in a thread with its own PlayerClient, which reads laser and
/// odometry.
///
/// Lockstep: the thread takes part from the constructor on. TimedMailbox describes when requests
/// take effect; results do not depend on the relative speed of threads.
class AmclThread {
 public:
  /// @param session   a follower; not null.
  /// @param odometry  index of the position2d that measures the motion.
  /// @param laser     index of the laser.
  /// @param params    those of the filter and the map are used.
  /// @throws PlayerCc::PlayerError kNoSuchDevice, kBadArgument for a map without a free cell.
  /// @throws SessionError if the session may not read the map.
  AmclThread(std::unique_ptr<Session> session, int odometry, int laser,
             const sim::AmclParams& params, const char* fun);
  ~AmclThread() { thread_.end(); }

  /// The robot is near a pose. @param covariance  none: that of the settings.
  void set_pose(const sim::Pose& mean, const std::optional<sim::PoseCovariance>& covariance);
  void spread();
  /// Starts the filter anew with other settings.
  void set_params(const sim::AmclParams& params);
  [[nodiscard]] sim::AmclParams params() const;
  /// The state as of the last round before now; null before the first round.
  [[nodiscard]] std::shared_ptr<const AmclState> state() const;

 private:
  struct SetPose {
    sim::Pose mean;
    std::optional<sim::PoseCovariance> covariance;
  };
  struct Spread {};
  using Request = std::variant<SetPose, Spread, sim::AmclParams>;

  void round();
  void start_filter();
  void measure();

  DriverThread thread_;
  PlayerCc::Position2dProxy odometry_;
  PlayerCc::LaserProxy laser_;
  sim::Pose X_BL_;

  // Used by the thread only, after the constructor.
  sim::OccupancyMap map_;
  sim::AmclParams in_use_;
  std::optional<SetPose> start_;  ///< none: anywhere
  std::optional<sim::MonteCarloLocalizer> localizer_;
  std::optional<sim::Pose> X_OB_;  ///< in the last odometry reading
  std::vector<double> ranges_m_;   // scratch

  TimedMailbox<Request, std::shared_ptr<const AmclState>> mailbox_;
  sim::AmclParams params_;  // guarded by the mailbox
};

}  // namespace playerlike
