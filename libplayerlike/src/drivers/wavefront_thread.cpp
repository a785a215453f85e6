// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/wavefront_thread.h"

#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "drivers/server_planner.h"
#include "proxies/link.h"
#include "sim/canvas/layers.h"
#include "sim/core/math.h"

namespace playerlike {

using PlayerCc::PlayerError;

namespace {

constexpr const char* kLayerName = "wavefront";
constexpr sim::Colour kPathColour{230, 60, 0, 255};

InterfaceBinding output_binding(Session& session, int output) {
  return find_interface(session.robots(), session.port(), "position2d", output);
}

}  // namespace

WavefrontThread::WavefrontThread(std::unique_ptr<Session> session, const PlannerInfo& info)
    : settings_(info.settings),
      thread_(std::move(session)),
      driver_(share_driver(thread_.session(), output_binding(thread_.session(), settings_.output))),
      output_(&thread_.client(), static_cast<uint32_t>(settings_.output)) {
  PlayerCc::PlayerClient& client = thread_.client();
  if (settings_.localize >= 0) {
    localize_ = std::make_unique<PlayerCc::LocalizeProxy>(
        &client, static_cast<uint32_t>(settings_.localize));
  } else {
    position_ = std::make_unique<PlayerCc::Position2dProxy>(
        &client, static_cast<uint32_t>(settings_.position));
  }
  Session& own = thread_.session();
  wave_ = std::make_unique<DistanceWave>(own.request(WorldMapRequest{settings_.cell_size_m}).map,
                                         settings_);
  if (settings_.draw) {
    CreateLayerRequest layer;
    layer.kind = sim::LayerKind::kBinary;
    layer.style.name = std::string(kLayerName) + ' ' + std::to_string(info.index);
    layer.style.colour = kPathColour;
    layer.style.priority = 1;
    try {
      layer_ = own.request(layer);
    } catch (const SessionError&) {
      // There are too many layers; the path is not drawn.
    }
  }
  thread_.start([this] { round(); });
}

WavefrontThread::~WavefrontThread() {
  // Opened now, because a closed session cannot open another one.
  std::unique_ptr<Session> last;
  try {
    if (state().waypoint_index >= 0) last = thread_.session().open_follower();
  } catch (const SessionError&) {
    // The connection to the server is lost.
  }
  thread_.end();
  if (!last) return;
  try {
    // Others may use the driver, too. Closing a session still executes its last command.
    PlayerCc::PlayerClient client(std::move(last));
    PlayerCc::Position2dProxy(&client, output_.GetIndex()).SetSpeed(0.0, 0.0);
  } catch (const PlayerError&) {
    // The run is over, so no robot needs to be stopped.
  }
}

void WavefrontThread::round() {
  const sim::SimTime now_ns = thread_.session().request(TimeRequest{}).sim_time_ns;
  const double time_s = sim::to_seconds(now_ns);
  if (std::exchange(stops_again_, false) && !driving_) output_.SetSpeed(0.0, 0.0);
  for (const Request& request : mailbox_.take(now_ns)) take(request);
  const std::optional<sim::Pose> pose = measured_pose();
  if (pose) now_.pose = *pose;
  if (has_goal_ && (pose || start_) && enabled_) {
    if (must_plan_) plan(time_s);
    if (pose && !start_ && now_.valid && !now_.done) follow(time_s);
  }
  mailbox_.publish(now_);
}

void WavefrontThread::take(const Request& request) {
  if (const auto* goal = std::get_if<NewGoal>(&request)) {
    now_.goal = goal->pose;
    has_goal_ = true;
    must_plan_ = true;
    now_.done = false;
  } else if (const auto* start = std::get_if<NewStart>(&request)) {
    stop();
    start_ = start->pose;
    must_plan_ = has_goal_;
  } else {
    enabled_ = std::get<Enable>(request).on;
    if (!enabled_) stop();
    if (enabled_ && start_) {
      start_.reset();
      must_plan_ = has_goal_;
    }
  }
}

// The pose of the robot in the world; none before the first reading.
std::optional<sim::Pose> WavefrontThread::measured_pose() {
  if (localize_) {
    if (localize_->GetHypothCount() == 0) return std::nullopt;
    // Player's localisers list the most likely hypothesis first.
    const player_pose2d_t mean = localize_->GetHypoth(0).mean;
    return sim::Pose{mean.px, mean.py, mean.pa};
  }
  if (!position_->IsValid()) return std::nullopt;
  return sim::Pose{position_->GetXPos(), position_->GetYPos(), position_->GetYaw()};
}

void WavefrontThread::plan(double time_s) {
  must_plan_ = false;
  planned_time_s_ = time_s;
  const sim::Vec2 from = start_ ? start_->position() : now_.pose.position();
  planned_from_ = from;
  now_.waypoints.clear();
  now_.waypoint_index = -1;
  now_.length_m = 0.0;
  const std::optional<PlannedPath> path = wave_->plan(from, now_.goal.position());
  now_.valid = path.has_value();
  if (!path) {
    stop();
    draw_path();
    return;
  }
  now_.length_m = path->length_m;
  sim::Vec2 before = from;
  for (const sim::Vec2& p : path->waypoints) {
    const sim::Vec2 way = p - before;
    now_.waypoints.push_back({p.x(), p.y(), sim::math::atan2(way.y(), way.x())});
    before = p;
  }
  now_.waypoints.back().yaw_rad = now_.goal.yaw_rad;
  if (!start_) {
    now_.waypoint_index = 0;
    driving_ = false;
  }
  draw_path();
}

void WavefrontThread::follow(double time_s) {
  const GoalState drive = driving_ ? driver_->state() : GoalState::kMoving;
  const sim::Vec2 p_WB = now_.pose.position();
  const double heading_error_rad =
      std::abs(sim::normalize_angle(now_.goal.yaw_rad - now_.pose.yaw_rad));
  const auto last = static_cast<int>(now_.waypoints.size()) - 1;
  const bool at_goal = (now_.goal.position() - p_WB).norm() <= settings_.distance_epsilon_m &&
                       heading_error_rad <= settings_.angle_epsilon_rad;
  if (at_goal || (drive == GoalState::kReached && now_.waypoint_index == last)) {
    stop();
    now_.done = true;
    now_.waypoint_index = -1;
    return;
  }
  const bool may_replan = settings_.replan_dist_thresh_m >= 0.0 &&
                          settings_.replan_min_time_s >= 0.0 &&
                          time_s - planned_time_s_ >= settings_.replan_min_time_s;
  const bool is_far = (p_WB - planned_from_).norm() > settings_.replan_dist_thresh_m;
  if (drive == GoalState::kBlocked || (may_replan && is_far)) {
    // The driver may see what the map does not show; it tries again from where it is now.
    plan(time_s);
    if (!now_.valid) return;
  }
  // Passes a waypoint as soon as the robot is near it and could drive straight to the next one.
  while (now_.waypoint_index < static_cast<int>(now_.waypoints.size()) - 1) {
    const auto i = static_cast<std::size_t>(now_.waypoint_index);
    const bool is_near =
        (now_.waypoints[i].position() - p_WB).norm() <= settings_.distance_epsilon_m &&
        wave_->is_line_free(p_WB, now_.waypoints[i + 1].position());
    const bool is_reached = driving_ && drive == GoalState::kReached;
    if (!is_near && !is_reached) break;
    ++now_.waypoint_index;
    driving_ = false;
    if (is_reached) break;
  }
  now_.waypoint = now_.waypoints[static_cast<std::size_t>(now_.waypoint_index)];
  if (!driving_) drive_to_waypoint();
}

// Gives the current waypoint to the driver, in the frame of the driver's position.
void WavefrontThread::drive_to_waypoint() {
  if (!output_.IsValid()) return;
  const sim::Pose X_FB{output_.GetXPos(), output_.GetYPos(), output_.GetYaw()};
  const sim::Pose X_FW = X_FB * now_.pose.inverse();
  const sim::Pose goal = X_FW * now_.waypoint;
  const bool is_last = now_.waypoint_index + 1 == static_cast<int>(now_.waypoints.size());
  driver_->go_to(
      {goal.position(), is_last ? std::optional<double>(goal.yaw_rad) : std::nullopt, {}, {}});
  driving_ = true;
}

void WavefrontThread::stop() {
  if (!driving_) return;
  driving_ = false;
  output_.SetSpeed(0.0, 0.0);  // cancels the driver's goal
  // The driver's round at this time does not know of it yet, and its command may come later.
  stops_again_ = true;
}

void WavefrontThread::draw_path() {
  if (!layer_) return;
  Session& session = thread_.session();
  const CanvasInfo canvas = session.request(CanvasInfoRequest{});
  std::vector<sim::DrawOperation> drawing(1);
  drawing[0].kind = sim::DrawOperation::Kind::kFill;
  drawing[0].layer = *layer_;
  drawing[0].value = sim::CellValue::of(false);
  const auto column = [&](double x_m) {
    return static_cast<int>(std::floor((x_m - canvas.origin_x_m) / canvas.cell_size_m));
  };
  const auto row = [&](double y_m) {
    return canvas.height - 1 -
           static_cast<int>(std::floor((y_m - canvas.origin_y_m) / canvas.cell_size_m));
  };
  sim::Vec2 from = planned_from_;
  for (const sim::Pose& waypoint : now_.waypoints) {
    sim::DrawOperation line;
    line.kind = sim::DrawOperation::Kind::kLine;
    line.layer = *layer_;
    line.x0 = column(from.x());
    line.y0 = row(from.y());
    line.x1 = column(waypoint.x_m);
    line.y1 = row(waypoint.y_m);
    line.value = sim::CellValue::of(true);
    drawing.push_back(line);
    from = waypoint.position();
  }
  session.draw(drawing);
}

// --- Other threads

void WavefrontThread::ask(const Request& request) {
  const PlannerState before = state();
  mailbox_.post(thread_.session(), request, [&](std::uint64_t number) {
    asked_for_ = before;
    if (const auto* goal = std::get_if<NewGoal>(&request)) {
      asked_for_.goal = goal->pose;
      asked_for_.done = false;
      asked_for_.valid = false;
      asked_for_.waypoint_index = -1;
      asked_for_.waypoints.clear();
      asked_for_.length_m = 0.0;
    }
    last_number_ = number;
  });
}

void WavefrontThread::set_goal(const sim::Pose& goal) { ask(NewGoal{goal}); }

void WavefrontThread::set_start(const sim::Pose& start) { ask(NewStart{start}); }

void WavefrontThread::enable(bool on) { ask(Enable{on}); }

PlannerState WavefrontThread::state() const {
  return mailbox_.outcome(thread_.session(), [this](const auto& result) {
    return result.number >= last_number_ ? result.outcome : asked_for_;
  });
}

std::shared_ptr<Planner> share_planner(Session& session, const InterfaceBinding& binding) {
  if (binding.planner == nullptr) {
    return make_server_planner(session, binding);
  }
  using Key = std::tuple<const void*, int, int>;  // simulation, robot, index
  static std::mutex mutex;
  static auto* const planners = new std::map<Key, std::weak_ptr<Planner>>;  // never destroyed
  const PlannerInfo& info = *binding.planner;
  const std::lock_guard lock(mutex);
  std::erase_if(*planners, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<Planner>& entry = (*planners)[{session.simulation(), binding.robot, info.index}];
  if (auto planner = entry.lock()) return planner;
  auto planner = std::make_shared<WavefrontThread>(session.open_follower(), info);
  entry = planner;
  return planner;
}

}  // namespace playerlike
