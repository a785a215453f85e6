// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/snd_thread.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "proxies/link.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

using PlayerCc::PlayerError;

SndThread::SndThread(std::unique_ptr<Session> session, int position, int laser,
                     const SndSettings& settings)
    : client_(std::move(session)),
      position_(&client_, static_cast<uint32_t>(position)),
      laser_(&client_, static_cast<uint32_t>(laser)),
      in_use_(settings),
      navigation_(settings),
      settings_(settings) {
  if (position_.HasCapability(PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL) == 0) {
    throw PlayerError("SndDriver::SndDriver",
                      "the robot has no motors (a device of type \"motion\") in this world",
                      PlayerError::kNotAvailable);
  }
  const player_pose3d_t mount = laser_.GetPose();
  scan_.X_BL = {mount.px, mount.py, mount.pyaw};
  const virtual_time::Inside inside;  // this is not the program's own thread
  // The caller, and with it simulated time, must not continue before the thread has joined.
  std::unique_lock lock(mutex_);
  thread_ = std::thread([this] { run(); });
  started_changed_.wait(lock, [this] { return started_; });
}

SndThread::~SndThread() {
  // Opened now, because a closed session cannot open another one.
  std::unique_ptr<Session> last;
  try {
    if (state() == SndState::kMoving) last = session().open_follower();
  } catch (const SessionError&) {
    // The connection to the server is lost.
  }
  PlayerCc::detail::CoreAccess::get(client_)->close();  // the thread's next call fails and ends it
  {
    const virtual_time::Inside inside;  // the thread ends without simulated time
    thread_.join();
  }
  if (!last || state() != SndState::kMoving) return;
  try {
    // Closing a session still executes its last command.
    PlayerCc::PlayerClient client(std::move(last));
    PlayerCc::Position2dProxy(&client, position_.GetIndex()).SetSpeed(0.0, 0.0);
  } catch (const PlayerError&) {
    // The run is over, so no robot needs to be stopped.
  }
}

Session& SndThread::session() const {
  return PlayerCc::detail::CoreAccess::get(client_)->session();
}

void SndThread::run() {
  try {
    session().request(JoinRequest{});
    {
      const std::lock_guard lock(mutex_);
      started_ = true;
    }
    started_changed_.notify_all();
    while (true) {
      client_.Read();
      round();
    }
  } catch (const PlayerError&) {
    // The run is over, or the driver is being destroyed.
  } catch (const SessionError&) {
    // The run is over or the driver is being destroyed, before the first round.
  }
  const std::lock_guard lock(mutex_);
  started_ = true;
  started_changed_.notify_all();
}

void SndThread::round() {
  const sim::SimTime now_ns = session().request(TimeRequest{}).sim_time_ns;
  take_requests(now_ns);
  if (unnoted_ && position_.IsValid()) note_goal(*std::exchange(unnoted_, std::nullopt));
  // Navigation needs both a scan and a pose.
  if (navigation_.state() == SndState::kMoving && laser_.IsFresh() && position_.IsValid()) {
    laser_.NotFresh();
    const uint32_t count = laser_.GetCount();
    scan_.angle_min_rad = laser_.GetMinAngle();
    scan_.resolution_rad = laser_.GetScanRes();
    scan_.range_max_m = laser_.GetMaxRange();
    scan_.ranges_m.resize(count);
    for (uint32_t i = 0; i < count; ++i) scan_.ranges_m[i] = laser_.GetRange(i);
    const sim::Pose X_WB{position_.GetXPos(), position_.GetYPos(), position_.GetYaw()};
    const sim::Twist twist = navigation_.step(sim::to_seconds(now_ns), X_WB, scan_);
    position_.SetSpeed(twist.v_mps, twist.omega_radps);
  }
  const std::lock_guard lock(mutex_);
  newest_.state = navigation_.state();
}

// Takes the requests made before this round, and publishes the outcome of the previous round.
void SndThread::take_requests(sim::SimTime before_ns) {
  const std::lock_guard lock(mutex_);
  if (newest_.time_ns < before_ns) before_ = newest_;
  newest_.time_ns = before_ns;
  auto request = requests_.begin();
  for (; request != requests_.end() && request->time_ns < before_ns; ++request) {
    newest_.number = request->number;
    if (const auto* goal = std::get_if<Goal>(&request->what)) {
      begin(*goal);
    } else if (const auto* settings = std::get_if<SndSettings>(&request->what)) {
      in_use_ = *settings;
      navigation_.set_settings(in_use_);
    } else {
      navigation_.cancel();
    }
  }
  requests_.erase(requests_.begin(), request);
}

void SndThread::begin(const Goal& goal) {
  SndSettings limited = in_use_;
  limited.max_speed_mps =
      std::min(limited.max_speed_mps, goal.max_speed_mps.value_or(limited.max_speed_mps));
  limited.max_turn_rate_radps = std::min(
      limited.max_turn_rate_radps, goal.max_turn_rate_radps.value_or(limited.max_turn_rate_radps));
  navigation_.set_settings(limited);
  navigation_.start({goal.position, goal.yaw_rad});
  unnoted_ = goal.position;
}

// The goal is in the frame of the position device, which may be the frame of odometry. The host
// knows the true pose of the robot, so the request contains the goal relative to the robot.
void SndThread::note_goal(const sim::Vec2& goal) {
  const sim::Pose X_FB{position_.GetXPos(), position_.GetYPos(), position_.GetYaw()};
  const InterfaceBinding binding = find_interface(
      session().robots(), session().port(), "position2d", static_cast<int>(position_.GetIndex()));
  try {
    session().request(NoteGoalRequest{binding.motion.value_or(binding.reading),
                                      X_FB.inverse() * goal, in_use_.goal_distance_m});
  } catch (const SessionError&) {
    // An older server refuses this request. If the session has ended, the next iteration detects
    // it.
  }
}

void SndThread::ask(std::variant<Goal, Cancel, SndSettings> what) {
  const std::lock_guard lock(mutex_);
  if (const auto* settings = std::get_if<SndSettings>(&what)) {
    settings_ = *settings;
    requests_.push_back(
        {session().request(TimeRequest{}).sim_time_ns, last_number_, std::move(what)});
    return;
  }
  asked_for_ = std::holds_alternative<Goal>(what) ? SndState::kMoving : SndState::kIdle;
  requests_.push_back(
      {session().request(TimeRequest{}).sim_time_ns, ++last_number_, std::move(what)});
}

void SndThread::go_to(const Goal& goal) { ask(goal); }

void SndThread::cancel() { ask(Cancel{}); }

void SndThread::set_settings(const SndSettings& settings) { ask(settings); }

SndSettings SndThread::settings() const {
  const std::lock_guard lock(mutex_);
  return settings_;
}

SndState SndThread::state() const {
  const std::lock_guard lock(mutex_);
  sim::SimTime now_ns = std::numeric_limits<sim::SimTime>::max();
  try {
    now_ns = session().request(TimeRequest{}).sim_time_ns;
  } catch (const SessionError&) {
    // The connection is closed, so there are no further rounds.
  }
  const Outcome& outcome = newest_.time_ns < now_ns ? newest_ : before_;
  return outcome.number == last_number_ ? outcome.state : asked_for_;
}

std::shared_ptr<GoalDriver> share_driver(Session& session, const InterfaceBinding& binding) {
  using Key = std::tuple<const void*, int, int>;  // simulation, robot, index
  static std::mutex mutex;
  static auto* const drivers = new std::map<Key, std::weak_ptr<GoalDriver>>;  // never destroyed
  const SndDriverDescription& description = *binding.driver;
  const std::lock_guard lock(mutex);
  std::erase_if(*drivers, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<GoalDriver>& entry =
      (*drivers)[{session.simulation(), binding.robot, description.index}];
  if (auto driver = entry.lock()) return driver;
  auto driver = std::make_shared<SndThread>(session.open_follower(), description.position,
                                            description.laser, description.settings);
  entry = driver;
  return driver;
}

}  // namespace playerlike
