// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Conditions and actions of the arena controller.
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/core/assert.h"
#include "sim/core/math.h"
#include "sim/devices/battery.h"
#include "sim/devices/fiducial.h"
#include "simulation/blocks.h"
#include "simulation/controller.h"
#include "simulation/obstacle_motions.h"

namespace sim {
namespace {

// Number of texts on the scene; further texts replace the oldest.
constexpr std::size_t kMostTexts = 64;

// The newest reading of a robot's device; nullptr if there is none yet.
template <typename Kind>
const Kind* reading_of(const RobotParts& robot, int device) {
  if (device < 0) return nullptr;
  const Sensor* sensor = robot.devices[static_cast<std::size_t>(device)]->sensor();
  const auto* reading = dynamic_cast<const Kind*>(&sensor->reading());
  return reading == nullptr || reading->sequence == 0 ? nullptr : reading;
}

// What a fault does, after "the laser of r1".
const char* fault_words(FaultAction::Kind kind) {
  switch (kind) {
    case FaultAction::Kind::kDead:
      return " is dead";
    case FaultAction::Kind::kBlind:
      return " is blind";
    case FaultAction::Kind::kJump:
      return " jumps";
    case FaultAction::Kind::kNone:
      break;
  }
  return " works again";
}

}  // namespace

int Simulation::Impl::Controller::robot_of(const std::string& name, int cause) const {
  if (name.empty()) return cause;
  const auto found = robot_of_.find(name);
  return found == robot_of_.end() ? -1 : static_cast<int>(found->second);
}

// --- Conditions

bool Simulation::Impl::Controller::hold(const std::vector<ArenaCondition>& conditions,
                                        int robot) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const ArenaCondition& condition) {
    return std::visit([&](const auto& kind) { return holds(kind, robot); }, condition);
  });
}

bool Simulation::Impl::Controller::holds(const TimeCondition& condition, int) const {
  const double time_s = to_seconds(impl_.now_ns - origin_ns_);
  return condition.from_s <= time_s && time_s < condition.to_s;
}

bool Simulation::Impl::Controller::holds(const CountCondition& condition, int) const {
  const auto timer = timer_of_.find(condition.of);
  const std::uint64_t count = timer != timer_of_.end() ? timers_[timer->second].count
                                                       : trap_counts_[trap_of_.at(condition.of)];
  return condition.limits.contain(static_cast<double>(count));
}

bool Simulation::Impl::Controller::holds(const BlockCondition& condition, int) const {
  const std::optional<int> block = impl_.find_obstacle(condition.block);
  SIM_ASSERT(block.has_value());
  return impl_.blocks->phase_of(*block) == condition.phase;
}

std::optional<double> Simulation::Impl::Controller::quantity(RobotQuantity quantity,
                                                             std::size_t robot) const {
  switch (quantity) {
    case RobotQuantity::kCollisions:
      return impl_.robots[robot].statistics.collisions;
    case RobotQuantity::kSpeed: {
      const Twist& twist = impl_.physics->body(static_cast<int>(robot)).twist;
      return math::hypot(twist.v_mps, twist.lateral_mps);
    }
    case RobotQuantity::kBattery: {
      const auto* reading = reading_of<BatteryReading>(impl_.robots[robot], batteries_[robot]);
      if (reading == nullptr) return std::nullopt;
      return reading->charge_percent;
    }
    case RobotQuantity::kScore:
      break;
  }
  return scores_[robot];
}

bool Simulation::Impl::Controller::holds(const QuantityCondition& condition, int robot) const {
  const int index = robot_of(condition.robot, robot);
  if (index < 0) return false;
  const std::optional<double> value = quantity(condition.quantity, static_cast<std::size_t>(index));
  return value && condition.limits.contain(*value);
}

bool Simulation::Impl::Controller::holds(const FiducialCondition& condition, int robot) const {
  const int index = robot_of(condition.robot, robot);
  if (index < 0) return false;
  const auto i = static_cast<std::size_t>(index);
  const auto* reading = reading_of<FiducialReading>(impl_.robots[i], fiducials_[i]);
  return reading != nullptr &&
         std::any_of(reading->marks.begin(), reading->marks.end(),
                     [&](const auto& mark) { return mark.id == condition.number; });
}

// --- Actions

template <>
void Simulation::Impl::Controller::act(const ConfigurationAction& action, const Cause&) {
  static_cast<void>(configure(action.configuration));  // events tell what was refused
}

template <>
void Simulation::Impl::Controller::act(const BlocksAction& action, const Cause&) {
  for (const std::string& block : action.blocks) {
    static_cast<void>(change_block(block, action.change));
  }
}

// Changes a block. If that is refused, records an event and returns the reason.
std::optional<std::string> Simulation::Impl::Controller::change_block(const std::string& name,
                                                                      BlocksAction::Change change) {
  int index = 0;
  if (auto reason = impl_.blocks->find_free(name, index)) {
    impl_.record(ArenaEventKind::kRefused, name, {}, *reason);
    return reason;
  }
  bool extend = change == BlocksAction::Change::kExtend;
  if (change == BlocksAction::Change::kToggle) {
    const BlockPhase phase = impl_.blocks->phase_of(index);
    extend = phase == BlockPhase::kRetracted || phase == BlockPhase::kSinking;
  }
  return impl_.blocks->set(index, extend);  // records what it refuses
}

template <>
void Simulation::Impl::Controller::act(const PlaceAction& action, const Cause&) {
  static_cast<void>(place(action.obstacle, action.pose));
}

std::optional<std::string> Simulation::Impl::Controller::place(const std::string& name,
                                                               const Pose& pose) {
  auto reason = impl_.place_block(name, pose);
  if (reason) {
    impl_.record(ArenaEventKind::kRefused, name, {}, *reason);
  } else {
    impl_.record(ArenaEventKind::kPlaced, name);
  }
  return reason;
}

template <>
void Simulation::Impl::Controller::act(const MessageAction& action, const Cause& cause) {
  impl_.record(ArenaEventKind::kMessage, cause.name, {}, action.text);
}

template <>
void Simulation::Impl::Controller::act(const TextAction& action, const Cause& cause) {
  const ArenaDescription& arena = impl_.world.arena;
  const Vec2 place = action.place.value_or(arena.origin + 0.5 * arena.size);
  std::erase_if(texts_, [&](const Text& text) { return text.place == place; });
  if (texts_.size() >= kMostTexts) texts_.erase(texts_.begin());
  if (!action.text.empty()) {
    const SimTime end_ns =
        action.duration_s > 0.0 ? impl_.now_ns + from_seconds(action.duration_s) : kNever;
    texts_.push_back({place, action.text, action.colour, end_ns});
  }
  find_next_time();
  impl_.record(ArenaEventKind::kText, cause.name, {}, action.text, action.duration_s);
}

template <>
void Simulation::Impl::Controller::act(const CanvasAction& action, const Cause& cause) {
  impl_.record(ArenaEventKind::kCanvas, cause.name);
  const Colour colour = action.colour.value_or(Colour{0, 0, 0, 0});
  Canvas& canvas = impl_.layers.base();
  if (!action.area) return canvas.clear(colour);
  const Vec2 low = action.area->center - 0.5 * action.area->size;
  const Vec2 high = action.area->center + 0.5 * action.area->size;
  const int left = std::max(canvas.column(low.x()), 0);
  const int right = std::min(canvas.column(high.x()), canvas.width() - 1);
  const int top = std::max(canvas.row(high.y()), 0);
  const int bottom = std::min(canvas.row(low.y()), canvas.height() - 1);
  if (left > right || top > bottom) return;
  const std::vector<CellValue> cells(static_cast<std::size_t>(right - left + 1),
                                     CellValue::of(colour));
  for (int row = top; row <= bottom; ++row) {
    impl_.layers.set_cells(kBaseLayer, {left, row, right - left + 1, 1}, cells);
  }
}

template <>
void Simulation::Impl::Controller::act(const RestartAction& action, const Cause& cause) {
  const int index = robot_of(action.robot, cause.robot);
  if (index < 0) return;
  const auto robot = static_cast<std::size_t>(index);
  if (std::find(waiting_.begin(), waiting_.end(), robot) != waiting_.end() || restart(robot)) {
    return;
  }
  const std::string& name = impl_.world.robots[robot].name;
  const bool waits = action.when_blocked == WhenBlocked::kWait;
  if (waits) waiting_.push_back(robot);
  impl_.record(waits ? ArenaEventKind::kWaiting : ArenaEventKind::kRefused, name, {},
               "the start of robot " + name + " is taken");
}

// Puts a robot back to its start. Returns whether its place was free.
bool Simulation::Impl::Controller::restart(std::size_t robot) {
  const RobotDescription& description = impl_.world.robots[robot];
  if (impl_.place(robot, description.pose)) return false;
  impl_.record(ArenaEventKind::kRestart, description.name, description.name);
  return true;
}

template <>
void Simulation::Impl::Controller::act(const ScoreAction& action, const Cause& cause) {
  const int index = robot_of(action.robot, cause.robot);
  if (index < 0) return;
  const auto robot = static_cast<std::size_t>(index);
  scores_[robot] += action.points;
  impl_.record(ArenaEventKind::kScore, cause.name, impl_.world.robots[robot].name, {},
               action.points);
}

template <>
void Simulation::Impl::Controller::act(const SwitchAction& action, const Cause&) {
  for (const std::string& name : action.names) {
    static_cast<void>(timer_of_.contains(name) ? set_timer_enabled(name, action.on)
                                               : set_trap_enabled(name, action.on));
  }
}

template <>
void Simulation::Impl::Controller::act(const EndAction& action, const Cause& cause) {
  verdict_ = Verdict{action.passed, action.reason, impl_.now_ns};
  impl_.record(ArenaEventKind::kEnd, cause.name, {}, action.reason, action.passed ? 1.0 : 0.0);
}

template <>
void Simulation::Impl::Controller::act(const MoveAction& action, const Cause&) {
  const std::optional<int> obstacle = impl_.find_obstacle(action.obstacle);
  SIM_ASSERT(obstacle.has_value() && impl_.obstacle_motions);
  impl_.obstacle_motions->move(*obstacle, action.motion);
}

template <>
void Simulation::Impl::Controller::act(const FaultAction& action, const Cause& cause) {
  const int index = robot_of(action.robot, cause.robot);
  if (index < 0) return;
  const auto robot = static_cast<std::size_t>(index);
  if (!impl_.set_fault(robot, action)) return;
  impl_.record(
      ArenaEventKind::kMessage, cause.name, {},
      "the " + action.device + " of " + impl_.world.robots[robot].name + fault_words(action.kind));
}

void Simulation::Impl::Controller::act(const std::vector<ArenaAction>& actions,
                                       const Cause& cause) {
  for (const ArenaAction& action : actions) {
    if (!may_work(cost_.of(action), cause.name)) return;
    std::visit([&](const auto& kind) { act(kind, cause); }, action);
  }
}

}  // namespace sim
