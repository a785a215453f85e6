// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/controller.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "sim/devices/battery.h"
#include "sim/devices/fiducial.h"

namespace sim {
namespace {

std::vector<std::string> names_of(const auto& list) {
  std::vector<std::string> names;
  for (const auto& element : list) names.push_back(element.name);
  return names;
}

std::string unknown(const char* kind, const std::string& name,
                    const std::vector<std::string>& known) {
  constexpr std::size_t kMostNames = 40;
  std::string text = std::string("there is no ") + kind + " named \"" + name + "\"; this world has";
  for (std::size_t i = 0; i < std::min(known.size(), kMostNames); ++i) {
    text += i == 0 ? ": " : ", ";
    text += known[i];
  }
  if (known.empty()) text += " none";
  if (known.size() > kMostNames) text += ", ...";
  return text;
}

template <typename Kind>
int first_device(const std::vector<std::unique_ptr<Device>>& devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (dynamic_cast<const Kind*>(devices[i].get()) != nullptr) return static_cast<int>(i);
  }
  return -1;
}

const char* text_of(TrapDescription::On on) {
  switch (on) {
    case TrapDescription::On::kEnter:
      return "enter";
    case TrapDescription::On::kLeave:
      return "leave";
    case TrapDescription::On::kStay:
      break;
  }
  return "stay";
}

}  // namespace

Simulation::Impl::Controller::Controller(Impl& owner)
    : impl_(owner), description_(owner.world.controller), cost_(owner.world), watch_(owner.world) {
  for (const TimerDescription& timer : description_.timers) {
    timer_of_.emplace(timer.name, timer_of_.size());
  }
  for (const TrapDescription& trap : description_.traps) {
    trap_of_.emplace(trap.name, trap_of_.size());
  }
  for (std::size_t i = 0; i < owner.robots.size(); ++i) {
    robot_of_.emplace(owner.world.robots[i].name, i);
    batteries_.push_back(first_device<Battery>(owner.robots[i].devices));
    fiducials_.push_back(first_device<FiducialFinder>(owner.robots[i].devices));
  }
  scores_.resize(owner.robots.size());
  reset();
}

void Simulation::Impl::Controller::reset() {
  started_ = false;
  configuration_.clear();
  timers_.clear();
  for (const TimerDescription& timer : description_.timers) {
    Timer& made = timers_.emplace_back();
    if (timer.jitter_s > 0.0 || timer.within_s) {
      made.random.emplace(impl_.world.simulation.seed, "controller/" + timer.name);
    }
  }
  watch_ = TrapWatch(impl_.world);
  trap_counts_.assign(description_.traps.size(), 0);
  stays_.clear();
  waiting_.clear();
  texts_.clear();
  next_time_ns_ = kNever;
}

// --- Times

void Simulation::Impl::Controller::start() {
  started_ = true;
  origin_ns_ = impl_.now_ns;
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    if (description_.timers[i].enabled) begin_timer(i);
  }
  find_next_time();
  work();
}

void Simulation::Impl::Controller::after_step() { work(); }

void Simulation::Impl::Controller::work() {
  if (verdict_) return;
  work_ = 0;
  cost_.set_canvas(impl_.layers.width(), impl_.layers.height());
  if (impl_.now_ns >= next_time_ns_) {
    end_texts();
    run_timers();
    find_next_time();
  }
  if (!trap_counts_.empty()) run_traps();
  if (!waiting_.empty()) retry_restarts();
}

// io::check_world() refuses a timer or trap that would do too much by itself. Several may do too
// much together.
bool Simulation::Impl::Controller::may_work(std::int64_t operations, const std::string& name) {
  if (verdict_) return false;
  work_ += operations;
  if (work_ <= io::kMaxControllerWork) return true;
  const std::string reason = "the controller would do more than " +
                             std::to_string(io::kMaxControllerWork) +
                             " operations in one step, the last of them for \"" + name + '"';
  if (const LogHook& log = impl_.chronicle.log()) log(LogLevel::kError, "the run ends: " + reason);
  verdict_ = Verdict{false, reason, impl_.now_ns};
  impl_.record(ArenaEventKind::kEnd, name, {}, reason, 0.0);
  return false;
}

void Simulation::Impl::Controller::find_next_time() {
  next_time_ns_ = kNever;
  for (const Timer& timer : timers_) {
    if (timer.enabled) next_time_ns_ = std::min(next_time_ns_, timer.due_ns);
  }
  for (const Text& text : texts_) next_time_ns_ = std::min(next_time_ns_, text.end_ns);
}

void Simulation::Impl::Controller::begin_timer(std::size_t i) {
  const TimerDescription& description = description_.timers[i];
  Timer& timer = timers_[i];
  timer.enabled = true;
  timer.begun = true;
  timer.begin_ns = impl_.now_ns;
  timer.moment = 0;
  timer.acted = 0;
  double first_s = description.at_s;
  if (description.within_s) {
    const Vec2 within_s = *description.within_s;
    first_s = within_s[0] + (within_s[1] - within_s[0]) * timer.random->uniform();
  }
  timer.first_ns = from_seconds(first_s);
  plan_timer(i);
}

// Finds the timer's next time, or switches it off if there is none.
void Simulation::Impl::Controller::plan_timer(std::size_t i) {
  const TimerDescription& description = description_.timers[i];
  Timer& timer = timers_[i];
  const bool over = (timer.moment > 0 && description.every_s <= 0.0) ||
                    (description.times > 0 && timer.acted >= description.times);
  if (over) {
    timer.enabled = false;
    timer.due_ns = kNever;
    return;
  }
  const SimTime period_ns = from_seconds(description.every_s);
  if (period_ns > 0 && timer.moment > kNever / period_ns) {
    timer.due_ns = kNever;
    return;
  }
  timer.due_ns = timer.begin_ns + timer.first_ns + timer.moment * period_ns;
  if (description.jitter_s > 0.0) {
    const double shift_s = description.jitter_s * (2.0 * timer.random->uniform() - 1.0);
    timer.due_ns = std::max(timer.begin_ns, timer.due_ns + from_seconds(shift_s));
  }
  timer.due_ns = std::min(timer.due_ns, kNever);
  ++timer.moment;
}

void Simulation::Impl::Controller::run_timers() {
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    Timer& timer = timers_[i];
    timer.begun = false;
    // A timer that its own actions switch on again goes on in the next step.
    while (timer.enabled && timer.due_ns <= impl_.now_ns && !timer.begun && !verdict_) {
      act_timer(i);
    }
  }
}

void Simulation::Impl::Controller::act_timer(std::size_t i) {
  const TimerDescription& description = description_.timers[i];
  if (!may_work(cost_.of(description.conditions), description.name)) return;
  const bool acts = hold(description.conditions, -1);
  if (acts) {
    ++timers_[i].acted;
    ++timers_[i].count;
  }
  plan_timer(i);  // first, because its actions may switch it on again
  if (!acts) return;
  impl_.record(ArenaEventKind::kTimer, description.name);
  act(description.actions, {description.name, -1});
}

void Simulation::Impl::Controller::end_texts() {
  std::erase_if(texts_, [&](const Text& text) { return text.end_ns <= impl_.now_ns; });
}

// --- Traps

void Simulation::Impl::Controller::run_traps() {
  using On = TrapDescription::On;
  // Actions can only switch traps and place robots; both take effect in the next update.
  for (const TrapWatch::Change& change : watch_.update(*impl_.physics, impl_.world)) {
    const TrapDescription& trap = description_.traps[change.trap];
    if (trap.on == On::kStay) {
      std::erase_if(stays_, [&](const Stay& stay) {
        return stay.trap == change.trap && stay.robot == change.robot;
      });
      if (change.inside && watch_.enabled(change.trap)) {
        stays_.push_back({change.trap, change.robot, impl_.now_ns + from_seconds(trap.stay_s)});
      }
    } else if (change.inside == (trap.on == On::kEnter)) {
      static_cast<void>(spring(change.trap, change.robot, text_of(trap.on)));
    }
  }
  if (stays_.empty()) return;
  const std::vector<Stay> stays = stays_;  // actions may change them
  for (const Stay& stay : stays) {
    if (stay.due_ns > impl_.now_ns) continue;
    if (!spring(stay.trap, stay.robot, text_of(On::kStay))) continue;
    std::erase_if(stays_, [&](const Stay& other) {
      return other.trap == stay.trap && other.robot == stay.robot;
    });
  }
}

// Returns whether the trap acts.
bool Simulation::Impl::Controller::spring(std::size_t trap, std::size_t robot, const char* how) {
  const TrapDescription& description = description_.traps[trap];
  const int index = static_cast<int>(robot);
  if (!watch_.enabled(trap) || !may_work(cost_.of(description.conditions), description.name) ||
      !hold(description.conditions, index)) {
    return false;
  }
  ++trap_counts_[trap];
  impl_.record(ArenaEventKind::kTrap, description.name, impl_.world.robots[robot].name, how);
  if (description.once) switch_trap(trap, false);
  act(description.actions, {description.name, index});
  return true;
}

void Simulation::Impl::Controller::retry_restarts() {
  std::erase_if(waiting_, [&](std::size_t robot) { return restart(robot); });
}

// --- Switching timers and traps on and off

void Simulation::Impl::Controller::switch_timer(std::size_t i, bool enabled) {
  if (enabled) {
    begin_timer(i);
  } else {
    timers_[i].enabled = false;
    timers_[i].due_ns = kNever;
  }
  find_next_time();
}

void Simulation::Impl::Controller::switch_trap(std::size_t i, bool enabled) {
  watch_.set_enabled(i, enabled);
  std::erase_if(stays_, [&](const Stay& stay) { return stay.trap == i; });
}

std::optional<std::string> Simulation::Impl::Controller::set_timer_enabled(const std::string& name,
                                                                           bool enabled) {
  const auto found = timer_of_.find(name);
  if (found == timer_of_.end()) return unknown("timer", name, names_of(description_.timers));
  if (!started_) start();
  if (timers_[found->second].enabled == enabled) return std::nullopt;
  switch_timer(found->second, enabled);
  impl_.record(enabled ? ArenaEventKind::kEnabled : ArenaEventKind::kDisabled, name);
  return std::nullopt;
}

std::optional<std::string> Simulation::Impl::Controller::set_trap_enabled(const std::string& name,
                                                                          bool enabled) {
  const auto found = trap_of_.find(name);
  if (found == trap_of_.end()) return unknown("trap", name, names_of(description_.traps));
  if (watch_.enabled(found->second) == enabled) return std::nullopt;
  switch_trap(found->second, enabled);
  impl_.record(enabled ? ArenaEventKind::kEnabled : ArenaEventKind::kDisabled, name);
  return std::nullopt;
}

std::optional<bool> Simulation::Impl::Controller::is_enabled(const std::string& name) const {
  if (const auto trap = trap_of_.find(name); trap != trap_of_.end()) {
    return watch_.enabled(trap->second);
  }
  const auto timer = timer_of_.find(name);
  if (timer == timer_of_.end()) return std::nullopt;
  return started_ ? timers_[timer->second].enabled : description_.timers[timer->second].enabled;
}

std::optional<std::string> Simulation::Impl::Controller::configure(const std::string& name) {
  const auto& all = description_.configurations;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
  if (found == all.end()) return unknown("configuration", name, names_of(all));
  configuration_ = name;
  impl_.record(ArenaEventKind::kConfiguration, name);
  std::string refused;
  const auto note = [&refused](const std::optional<std::string>& reason) {
    if (!reason) return;
    if (!refused.empty()) refused += "; ";
    refused += *reason;
  };
  using Change = BlocksAction::Change;
  using Others = ArenaConfiguration::Others;
  std::vector<std::string> extended = found->extended;
  std::vector<std::string> retracted = found->retracted;
  if (found->others != Others::kKeep) {
    std::set<std::string_view> listed(found->extended.begin(), found->extended.end());
    listed.insert(found->retracted.begin(), found->retracted.end());
    for (const ObstacleDescription& block : impl_.world.arena.obstacles) {
      if (block.type != ObstacleType::kDynamic || listed.contains(block.name)) continue;
      (found->others == Others::kExtended ? extended : retracted).push_back(block.name);
    }
  }
  for (const std::string& block : retracted) note(change_block(block, Change::kRetract));
  for (const auto& [obstacle, pose] : found->places) note(place(obstacle, pose));
  for (const std::string& block : extended) note(change_block(block, Change::kExtend));
  if (refused.empty()) return std::nullopt;
  return refused;
}

std::optional<std::string> Simulation::canvas_refusal(int width, int height) const {
  if (impl_->world.controller.empty()) return std::nullopt;
  io::ControllerWork work(impl_->world);
  work.set_canvas(width, height);
  const std::vector<io::ControllerWork::Excess> excesses = work.excesses();
  if (excesses.empty()) return std::nullopt;
  const io::ControllerWork::Excess& first = excesses.front();
  const ControllerDescription& controller = impl_->world.controller;
  return "the arena controller fills the canvas, which " + std::to_string(width) + " x " +
         std::to_string(height) + " cells would make too much work for one step: \"" +
         (first.is_timer ? controller.timers[first.index].name
                         : controller.traps[first.index].name) +
         "\" would do " + io::text_of(first) + ", and at most " +
         std::to_string(io::kMaxControllerWork) + " are allowed";
}

// --- Pictures and state

ArenaState Simulation::Impl::Controller::state() const {
  ArenaState state;
  state.configuration = configuration_;
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    const Timer& timer = timers_[i];
    ArenaTrigger& trigger = state.timers.emplace_back();
    trigger.name = description_.timers[i].name;
    trigger.enabled = started_ ? timer.enabled : description_.timers[i].enabled;
    trigger.count = timer.count;
    if (timer.enabled && timer.due_ns != kNever) {
      trigger.time_left_s = to_seconds(timer.due_ns - impl_.now_ns);
    }
  }
  for (std::size_t i = 0; i < trap_counts_.size(); ++i) {
    ArenaTrigger& trigger = state.traps.emplace_back();
    trigger.name = description_.traps[i].name;
    trigger.enabled = watch_.enabled(i);
    trigger.count = trap_counts_[i];
  }
  return state;
}

void Simulation::Impl::Controller::show(SceneSnapshot& scene) const {
  const auto left_s = [this](SimTime end_ns) { return to_seconds(end_ns - impl_.now_ns); };
  for (const Text& text : texts_) {
    SceneText& shown = scene.texts.emplace_back();
    shown.place = text.place;
    shown.text = text.text;
    shown.colour = text.colour;
    if (text.end_ns != kNever) shown.time_left_s = left_s(text.end_ns);
  }
  for (std::size_t i = 0; i < description_.traps.size(); ++i) {
    TrapWatch::Region region = watch_.region(i, *impl_.physics, impl_.world);
    TrapMark& mark = scene.traps.emplace_back();
    mark.name = description_.traps[i].name;
    mark.outline = std::move(region.corners);
    mark.center = region.center;
    mark.radius_m = region.radius_m;
    mark.enabled = watch_.enabled(i);
    for (std::size_t robot = 0; robot < impl_.robots.size(); ++robot) {
      if (watch_.inside(i, robot)) mark.robots.push_back(static_cast<int>(robot));
    }
  }
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    TimerMark& mark = scene.timers.emplace_back();
    mark.name = description_.timers[i].name;
    if (timers_[i].enabled) mark.time_left_s = left_s(timers_[i].due_ns);
  }
}

void Simulation::Impl::Controller::take_over_from(Controller& before, SimTime later_ns) {
  scores_ = std::move(before.scores_);
  verdict_ = std::move(before.verdict_);
  origin_ns_ += later_ns;
  for (Timer& timer : timers_) {
    timer.begin_ns += later_ns;
    if (timer.due_ns != kNever) timer.due_ns += later_ns;
  }
  for (Stay& stay : stays_) stay.due_ns += later_ns;
  for (Text& text : texts_) {
    if (text.end_ns != kNever) text.end_ns += later_ns;
  }
  find_next_time();
}

void Simulation::Impl::Controller::archive(StateArchive& archive) {
  for (double& score : scores_) archive(score);
  bool ended = verdict_.has_value();
  archive(ended);
  if (ended && !verdict_) verdict_.emplace();
  if (ended) {
    archive(verdict_->passed, verdict_->reason);
    archive.time(verdict_->time_ns);
  }
  archive(started_, configuration_);
  const auto& known = description_.configurations;
  archive.expect(configuration_.empty() ||
                     std::any_of(known.begin(), known.end(),
                                 [&](const auto& c) { return c.name == configuration_; }),
                 "a configuration of the world");
  archive.time(origin_ns_);
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    Timer& timer = timers_[i];
    archive(timer.enabled, timer.moment, timer.acted, timer.count);
    for (SimTime* time : {&timer.begin_ns, &timer.first_ns, &timer.due_ns}) archive.time(*time);
    // Otherwise the next step would make up for a long time.
    const SimTime period_ns = from_seconds(description_.timers[i].every_s);
    const bool goes_on = timer.enabled && period_ns > 0 && !verdict_;
    archive.expect(
        timer.moment >= 0 &&
            (!goes_on || timer.due_ns == kNever ||
             (timer.moment <= kNever / period_ns + 1 && timer.due_ns >= impl_.now_ns &&
              timer.begin_ns + timer.first_ns + timer.moment * period_ns >= impl_.now_ns)),
        "timers that are not late");
    if (timer.random) archive(*timer.random);
  }
  watch_.archive(archive);
  for (std::uint64_t& count : trap_counts_) archive(count);
  const std::size_t robot_count = impl_.robots.size();
  archive.list(stays_, [&](Stay& stay) {
    archive.index(stay.trap, trap_counts_.size());
    archive.index(stay.robot, robot_count);
    archive.time(stay.due_ns);
  });
  archive.list(waiting_, [&](std::size_t& robot) { archive.index(robot, robot_count); });
  archive.list(texts_, [&](Text& text) {
    archive(text.place, text.text, text.colour);
    archive.time(text.end_ns);
  });
  if (archive.reading()) find_next_time();
}

// --- Simulation

std::optional<std::string> Simulation::set_configuration(const std::string& name) {
  ++interventions_;
  if (!impl_->controller) {
    return "there is no configuration named \"" + name + "\"; this world has none";
  }
  return impl_->controller->configure(name);
}

std::optional<std::string> Simulation::set_timer_enabled(const std::string& name, bool enabled) {
  ++interventions_;
  if (!impl_->controller) {
    return "there is no timer named \"" + name + "\"; this world has none";
  }
  return impl_->controller->set_timer_enabled(name, enabled);
}

std::optional<std::string> Simulation::set_trap_enabled(const std::string& name, bool enabled) {
  ++interventions_;
  if (!impl_->controller) return "there is no trap named \"" + name + "\"; this world has none";
  return impl_->controller->set_trap_enabled(name, enabled);
}

std::optional<bool> Simulation::timer_or_trap_enabled(const std::string& name) const {
  if (!impl_->controller) return std::nullopt;
  return impl_->controller->is_enabled(name);
}

ArenaState Simulation::arena_state() const {
  return impl_->controller ? impl_->controller->state() : ArenaState{};
}

const std::vector<double>& Simulation::scores() const noexcept {
  static const std::vector<double> none;
  return impl_->controller ? impl_->controller->scores() : none;
}

const std::optional<Verdict>& Simulation::verdict() const noexcept {
  if (impl_->controller) return impl_->controller->verdict();
  static const std::optional<Verdict> none;
  return none;
}

}  // namespace sim
