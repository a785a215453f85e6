// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/server_planner.h"

#include <mutex>
#include <utility>

namespace playerlike {
namespace {

/// Passes calls on to the server, and keeps the newest state that it has sent.
class ServerPlanner final : public Planner {
 public:
  ServerPlanner(DevicePlanners& server, unsigned index) : server_(server), index_(index) {}

  void set_goal(const sim::Pose& goal) override {
    server_.set_planner_goal(index_, goal);
    const std::lock_guard lock(mutex_);
    // Until the server reports on the new goal, nothing of the old one may seem to be about it.
    PlannerState fresh;
    fresh.pose = state_.pose;
    fresh.goal = goal;
    state_ = std::move(fresh);
  }
  void set_start(const sim::Pose& start) override { server_.set_planner_start(index_, start); }
  void enable(bool on) override { server_.enable_planner(index_, on); }

  [[nodiscard]] PlannerState state() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  [[nodiscard]] PlannerState state_with_waypoints() override {
    DevicePlanners::Path path = server_.planner_path(index_);
    PlannerState whole = state();
    whole.waypoints = std::move(path.waypoints);
    whole.length_m = path.length_m;
    whole.reported_waypoints.reset();
    return whole;
  }
  void on_reading(const sim::Reading& reading) override {
    const auto* planner = dynamic_cast<const PlannerReading*>(&reading);
    if (planner == nullptr) return;
    const std::lock_guard lock(mutex_);
    state_ = planner->state;
  }

 private:
  DevicePlanners& server_;
  const unsigned index_;
  mutable std::mutex mutex_;
  PlannerState state_;  // guarded by mutex_
};

}  // namespace

std::shared_ptr<Planner> make_server_planner(Session& session, const InterfaceBinding& binding) {
  auto* const server = dynamic_cast<DevicePlanners*>(&session);
  if (server == nullptr || binding.address == nullptr) {
    throw SessionError(SessionError::Code::kNotAvailable, "the server has no such planner");
  }
  return std::make_shared<ServerPlanner>(*server, static_cast<unsigned>(binding.address->index));
}

}  // namespace playerlike
