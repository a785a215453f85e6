// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "localizer.h"

#include <cmath>

const char* const LOCALIZER_NAME = "amcl";

namespace {

// With less weight, the best hypothesis is one of several [1].
const double CLEAR_WEIGHT = 0.8;

// Reads the robot's amcl driver, a particle filter that runs beside the program: in the simulation,
// or in the server of a real robot.
class AmclReader final : public Localizer {
 public:
  AmclReader(CCMorse::PlayerClient& client, const par::GridFrame& map)
      : map_(map), localize_(&client, 0) {
    forget();
  }

  void update() override {
    localize_.NotFresh();
    if (localize_.GetHypothCount() == 0) return;
    const player_localize_hypoth_t best = localize_.GetHypoth(0);
    estimate_.pose = {best.mean.px, best.mean.py, best.mean.pa};
    estimate_.positionError = std::sqrt(best.cov[0] + best.cov[1]);
    estimate_.headingError = std::sqrt(best.cov[2]);
    if (best.alpha < CLEAR_WEIGHT) estimate_.positionError = ANYWHERE;
  }

  Estimate estimate() const override { return estimate_; }

  std::vector<par::Pose> particles() const override {
    std::vector<par::Pose> poses;
    if (localize_.GetParticles() != 0) return poses;
    for (unsigned i = 0; i < localize_.GetNumParticles(); i++) {
      const player_pose2d_t pose = localize_.GetParticlePose(static_cast<int>(i));
      poses.push_back({pose.px, pose.py, pose.pa});
    }
    return poses;
  }

  void forget() override {
    // amcl has no request for this: it gets a pose in the middle of the map, and a covariance that
    // covers the map and all headings.
    double pose[3] = {map_.origin.x + 0.5 * map_.width * map_.cell_size_m,
                      map_.origin.y + 0.5 * map_.height * map_.cell_size_m, 0.0};
    double covariance[6] = {ANYWHERE * ANYWHERE, ANYWHERE * ANYWHERE, par::kPi * par::kPi, 0, 0, 0};
    localize_.SetPose(pose, covariance);
    estimate_ = Estimate();
    estimate_.positionError = ANYWHERE;
    estimate_.headingError = par::kPi;
  }

 private:
  static constexpr double ANYWHERE = 3.0;  // standard deviation of an unknown position [m]

  const par::GridFrame map_;
  mutable PlayerCc::LocalizeProxy localize_;  // GetParticles() asks for them
  Estimate estimate_;
};

}  // namespace

std::unique_ptr<Localizer> makeLocalizer(CCMorse::PlayerClient& client, const par::Mask& walls,
                                         const CCMorse::Position2dProxy& /*odometry*/,
                                         CCMorse::LaserProxy& /*laser*/) {
  return std::unique_ptr<Localizer>(new AmclReader(client, walls.frame()));
}
