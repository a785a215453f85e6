// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/goal_thread.h"

#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "proxies/link.h"

namespace playerlike {

using PlayerCc::PlayerError;

namespace {

bool needs_laser(const GoalDriverSettings& settings) {
  return !std::holds_alternative<GotoSettings>(settings);
}

}  // namespace

GoalThread::GoalThread(std::unique_ptr<Session> session, int position, int laser,
                       const GoalDriverSettings& settings, const char* fun)
    : thread_(std::move(session)),
      position_(&thread_.client(), static_cast<uint32_t>(position)),
      in_use_(settings),
      navigator_(make_navigator(settings)),
      settings_(settings) {
  if (needs_laser(settings)) {
    laser_ =
        std::make_unique<PlayerCc::LaserProxy>(&thread_.client(), static_cast<uint32_t>(laser));
  }
  if (position_.HasCapability(PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL) == 0) {
    throw PlayerError(fun, "the robot has no motors (a device of type \"motion\") in this world",
                      PlayerError::kNotAvailable);
  }
  if (laser_) {
    const player_pose3d_t mount = laser_->GetPose();
    scan_.X_BL = {mount.px, mount.py, mount.pyaw};
  }
  thread_.start([this] { round(); });
}

GoalThread::~GoalThread() {
  // Opened now, because a closed session cannot open another one.
  std::unique_ptr<Session> last;
  try {
    if (state() == GoalState::kMoving) last = thread_.session().open_follower();
  } catch (const SessionError&) {
    // The connection to the server is lost.
  }
  thread_.end();
  if (!last || state() != GoalState::kMoving) return;
  try {
    // Closing a session still executes its last command.
    PlayerCc::PlayerClient client(std::move(last));
    PlayerCc::Position2dProxy(&client, position_.GetIndex()).SetSpeed(0.0, 0.0);
  } catch (const PlayerError&) {
    // The run is over, so no robot needs to be stopped.
  }
}

void GoalThread::round() {
  const sim::SimTime now_ns = thread_.session().request(TimeRequest{}).sim_time_ns;
  for (const Request& request : mailbox_.take(now_ns)) {
    if (const auto* goal = std::get_if<Goal>(&request)) {
      begin(*goal);
    } else if (const auto* settings = std::get_if<GoalDriverSettings>(&request)) {
      in_use_ = *settings;
      navigator_->set_settings(in_use_);
    } else {
      navigator_->cancel();
    }
  }
  if (unnoted_ && position_.IsValid()) note_goal(*std::exchange(unnoted_, std::nullopt));
  // Navigation needs a pose, and a new scan if it uses the laser.
  const bool has_data = position_.IsValid() && (laser_ ? laser_->IsFresh() : position_.IsFresh());
  if (navigator_->state() == GoalState::kMoving && has_data) {
    if (laser_) {
      laser_->NotFresh();
      const uint32_t count = laser_->GetCount();
      scan_.angle_min_rad = laser_->GetMinAngle();
      scan_.resolution_rad = laser_->GetScanRes();
      scan_.range_max_m = laser_->GetMaxRange();
      scan_.ranges_m.resize(count);
      for (uint32_t i = 0; i < count; ++i) scan_.ranges_m[i] = laser_->GetRange(i);
    } else {
      position_.NotFresh();
    }
    const sim::Pose X_WB{position_.GetXPos(), position_.GetYPos(), position_.GetYaw()};
    const sim::Twist twist = navigator_->step(sim::to_seconds(now_ns), X_WB, scan_);
    position_.SetSpeed(twist.v_mps, twist.omega_radps);
  }
  mailbox_.publish(navigator_->state());
}

void GoalThread::begin(const Goal& goal) {
  const DrivingLimits own =
      std::visit([](const auto& settings) { return settings.limits(); }, in_use_);
  GoalDriverSettings limited = in_use_;
  std::visit(
      [&](auto& settings) {
        settings.slow_down(goal.max_speed_mps.value_or(own.max_speed_mps),
                           goal.max_turn_rate_radps.value_or(own.max_turn_rate_radps));
      },
      limited);
  navigator_->set_settings(limited);
  navigator_->start({goal.position, goal.yaw_rad});
  unnoted_ = goal.position;
}

// The goal is in the frame of the position device, which may be the frame of odometry. The host
// knows the true pose of the robot, so the request contains the goal relative to the robot.
void GoalThread::note_goal(const sim::Vec2& goal) {
  const sim::Pose X_FB{position_.GetXPos(), position_.GetYPos(), position_.GetYaw()};
  Session& session = thread_.session();
  const InterfaceBinding binding = find_interface(session.robots(), session.port(), "position2d",
                                                  static_cast<int>(position_.GetIndex()));
  const DrivingLimits limits =
      std::visit([](const auto& settings) { return settings.limits(); }, in_use_);
  try {
    session.request(NoteGoalRequest{binding.motion.value_or(binding.reading), X_FB.inverse() * goal,
                                    limits.goal_distance_m});
  } catch (const SessionError&) {
    // An older server refuses this request. If the session has ended, the next iteration detects
    // it.
  }
}

void GoalThread::ask(const Request& request, GoalState leads_to) {
  mailbox_.post(thread_.session(), request, [&](std::uint64_t number) {
    asked_for_ = leads_to;
    last_number_ = number;
  });
}

void GoalThread::go_to(const Goal& goal) { ask(goal, GoalState::kMoving); }

void GoalThread::cancel() { ask(Cancel{}, GoalState::kIdle); }

void GoalThread::set_settings(const GoalDriverSettings& settings) {
  mailbox_.post(thread_.session(), settings,
                [&](std::uint64_t /*number*/) { settings_ = settings; });
}

GoalDriverSettings GoalThread::settings() const {
  return mailbox_.locked([this] { return settings_; });
}

GoalState GoalThread::state() const {
  return mailbox_.outcome(thread_.session(), [this](const auto& result) {
    return result.number >= last_number_ ? result.outcome : asked_for_;
  });
}

std::shared_ptr<GoalDriver> share_driver(Session& session, const InterfaceBinding& binding) {
  using Key = std::tuple<const void*, int, int>;  // simulation, robot, index
  static std::mutex mutex;
  static auto* const drivers = new std::map<Key, std::weak_ptr<GoalDriver>>;  // never destroyed
  const GoalDriverInfo& info = *binding.driver;
  const std::lock_guard lock(mutex);
  std::erase_if(*drivers, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<GoalDriver>& entry = (*drivers)[{session.simulation(), binding.robot, info.index}];
  if (auto driver = entry.lock()) return driver;
  auto driver = std::make_shared<GoalThread>(session.open_follower(), info.position, info.laser,
                                             info.settings, "Position2dProxy::Position2dProxy");
  entry = driver;
  return driver;
}

}  // namespace playerlike
