// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/amcl_thread.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/errors.h"

namespace playerlike {

namespace {

// The stream of the filter's random numbers. Runs differ by their readings only.
constexpr std::uint64_t kSeed = 1;
constexpr const char* kStream = "AmclDriver";

// The map with a ring of occupied cells: a scan shows the border, the map of the floor does not.
sim::OccupancyMap walled(const sim::OccupancyMap& map) {
  sim::OccupancyMap walled;
  walled.width = map.width + 2;
  walled.height = map.height + 2;
  walled.cell_size_m = map.cell_size_m;
  walled.origin = map.origin - sim::Vec2(map.cell_size_m, map.cell_size_m);
  const auto width = static_cast<std::ptrdiff_t>(map.width);
  walled.cells.assign(
      static_cast<std::size_t>(walled.width) * static_cast<std::size_t>(walled.height), 1.0F);
  for (std::ptrdiff_t row = 0; row < map.height; ++row) {
    std::copy_n(map.cells.begin() + row * width, width,
                walled.cells.begin() + (row + 1) * (width + 2) + 1);
  }
  return walled;
}

}  // namespace

AmclThread::AmclThread(std::unique_ptr<Session> session, int odometry, int laser,
                       const sim::AmclParams& params, const char* fun)
    : thread_(std::move(session)),
      odometry_(&thread_.client(), static_cast<uint32_t>(odometry)),
      laser_(&thread_.client(), static_cast<uint32_t>(laser)),
      in_use_(params),
      params_(params) {
  const player_pose3d_t mount = laser_.GetPose();
  X_BL_ = {mount.px, mount.py, mount.pyaw};
  map_ = walled(thread_.session().request(WorldMapRequest{params.map_resolution_m}).map);
  start_filter();
  if (localizer_->field().free_cells() == 0) refuse(fun, "the map has no free cell");
  thread_.start([this] { round(); });
}

void AmclThread::start_filter() {
  auto field = std::make_shared<const sim::LikelihoodField>(
      map_, sim::LikelihoodSettings{in_use_.range_deviation_m, in_use_.bad_share});
  localizer_.emplace(sim::monte_carlo_settings(in_use_), std::move(field),
                     sim::RandomStream(kSeed, kStream));
  if (start_) {
    localizer_->set_pose(start_->mean,
                         start_->covariance.value_or(sim::initial_covariance(in_use_)));
  } else {
    localizer_->spread();
  }
}

void AmclThread::round() {
  const sim::SimTime now_ns = thread_.session().request(TimeRequest{}).sim_time_ns;
  for (const Request& request : mailbox_.take(now_ns)) {
    if (const auto* params = std::get_if<sim::AmclParams>(&request)) {
      in_use_ = *params;
      start_filter();
    } else if (const auto* pose = std::get_if<SetPose>(&request)) {
      start_ = *pose;
      localizer_->set_pose(pose->mean, pose->covariance.value_or(sim::initial_covariance(in_use_)));
    } else {
      start_.reset();
      localizer_->spread();
    }
  }
  measure();
  auto state = std::make_shared<AmclState>();
  state->hypotheses = localizer_->hypotheses();
  state->particles = localizer_->particles();
  state->updates = localizer_->updates();
  mailbox_.publish(std::move(state));
}

void AmclThread::measure() {
  if (odometry_.IsFresh()) {
    odometry_.NotFresh();
    const sim::Pose X_OB{odometry_.GetXPos(), odometry_.GetYPos(), odometry_.GetYaw()};
    // Exactly no motion for equal poses: rounding would move the particles.
    if (X_OB_ && !(*X_OB_ == X_OB)) localizer_->move(X_OB_->inverse() * X_OB);
    X_OB_ = X_OB;
  }
  if (!laser_.IsFresh()) return;
  laser_.NotFresh();
  if (!localizer_->wants_scan()) return;
  ranges_m_.resize(laser_.GetCount());
  for (std::size_t i = 0; i < ranges_m_.size(); ++i) {
    ranges_m_[i] = laser_.GetRange(static_cast<uint32_t>(i));
  }
  localizer_->update(sim::scan_points(X_BL_, ranges_m_, laser_.GetMinAngle(), laser_.GetScanRes(),
                                      laser_.GetMaxRange(), in_use_.max_beams));
}

// --- Other threads

void AmclThread::set_pose(const sim::Pose& mean,
                          const std::optional<sim::PoseCovariance>& covariance) {
  mailbox_.post(thread_.session(), SetPose{mean, covariance}, [](std::uint64_t /*number*/) {});
}

void AmclThread::spread() {
  mailbox_.post(thread_.session(), Spread{}, [](std::uint64_t /*number*/) {});
}

void AmclThread::set_params(const sim::AmclParams& params) {
  mailbox_.post(thread_.session(), params, [&](std::uint64_t /*number*/) { params_ = params; });
}

sim::AmclParams AmclThread::params() const {
  return mailbox_.locked([this] { return params_; });
}

std::shared_ptr<const AmclState> AmclThread::state() const {
  // The mailbox needs the session to know the time.
  return mailbox_.outcome(thread_.session(), [](const auto& result) { return result.outcome; });
}

}  // namespace playerlike
