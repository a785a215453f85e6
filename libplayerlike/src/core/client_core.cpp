// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/client_core.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "core/debug_types.h"
#include "core/errors.h"
#include "core/warnings.h"
#include "session/checks.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"

__thread std::uint64_t PlayerCc::detail::thread_number = 0;

namespace playerlike {

using PlayerCc::detail::Elements;
using PlayerCc::detail::thread_number;

ClientCore::ClientCore(std::unique_ptr<Session> session) : session_(std::move(session)) {
  keep_debug_types();
}

ClientCore::~ClientCore() { session_->close(); }

void ClientCore::send(const char* fun, DeviceId device, const sim::Command& command) {
  translated(fun, [&] { session_->send(device, command); });
  warn_of_clamped_speed(fun, device, command);
}

ClientCore::SpeedLimits ClientCore::speed_limits(DeviceId motors) const {
  const RobotInfo& robot = robot_of(motors);
  SpeedLimits limits{robot.max_speed_mps, robot.max_turn_rate_radps};
  const std::map<std::string, double>& settings = info_of(motors).properties;
  const auto tighten = [&settings](const char* name, double& value) {
    const auto it = settings.find(name);
    if (it != settings.end()) value = std::min(value, it->second);
  };
  tighten("max_speed", limits.speed_mps);
  tighten("max_turn_rate", limits.turn_rate_radps);
  return limits;
}

void ClientCore::warn_of_clamped_speed(const char* fun, DeviceId device,
                                       const sim::Command& command) {
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  if (const auto* twist = std::get_if<sim::TwistCommand>(&command)) {
    speed_mps = twist->twist.v_mps;
    turn_rate_radps = twist->twist.omega_radps;
  } else if (const auto* heading = std::get_if<sim::HeadingCommand>(&command)) {
    speed_mps = heading->v_mps;
  } else if (const auto* car = std::get_if<sim::CarCommand>(&command)) {
    speed_mps = car->v_mps;
  } else {
    return;
  }
  constexpr SpeedLimits kTold;
  const std::pair key(device.robot, device.device);
  auto known = watched_speeds_.find(key);
  if (known == watched_speeds_.end()) {
    known = watched_speeds_.emplace(key, speed_limits(device)).first;
  }
  SpeedLimits& limits = known->second;
  const auto is_beyond = [](double value, double limit) {
    constexpr double kRounding = 1e-3;  // of limits in files
    return limit > 0.0 && std::abs(value) > limit * (1.0 + kRounding);
  };
  const bool too_fast = is_beyond(speed_mps, limits.speed_mps);
  if (!too_fast && !is_beyond(turn_rate_radps, limits.turn_rate_radps)) return;
  const auto number = [](double value) { return sim::rounded_text(value, 4); };
  warn(std::string(fun) + ": robot " + robot_of(device).name +
       (too_fast ? " drives at most " + number(limits.speed_mps) + " m/s, so " + number(speed_mps) +
                       " m/s is clamped to that"
                 : " turns at most " + number(limits.turn_rate_radps) + " rad/s, so " +
                       number(turn_rate_radps) + " rad/s is clamped to that") +
       " (reported once)");
  limits = kTold;
}

void ClientCore::add(DeviceId device, ReadingListener& listener, std::optional<bool> replace) {
  require_usable();
  // Nothing may throw after the subscription.
  entries_.push_back({device, &listener, false});
  const auto place = by_device_.emplace(std::pair(device.robot, device.device), &entries_.back());
  try {
    session_->request(SubscribeRequest{device});
  } catch (...) {
    by_device_.erase(place);
    entries_.pop_back();
    throw;
  }
  if (replace) session_->request(ReplaceRequest{device, *replace});
}

void ClientCore::add_poller(ReadingListener& listener) {
  require_usable();
  entries_.push_back({DeviceId{-1, -1}, &listener, false});
}

bool ClientCore::listens(const ReadingListener& listener) const noexcept {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.listener == &listener; });
}

void ClientCore::remove(ReadingListener& listener) noexcept {
  const std::lock_guard lock(mutex_);
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.listener == &listener; });
  if (it == entries_.end()) return;
  const DeviceId device = it->device;
  const bool polls = it->polls();
  std::erase_if(by_device_, [&](const auto& place) { return place.second == &*it; });
  entries_.erase(it);
  if (closed_ || polls) return;
  try {
    session_->request(UnsubscribeRequest{device});
  } catch (const std::exception&) {
    // The session has ended, and with it all its subscriptions.
  }
}

void ClientCore::read(const std::atomic<bool>* stop) {
  Notifications notifications;
  int rounds = 0;
  for (bool done = false; !done;) {
    session_->wait();
    const std::lock_guard lock(mutex_);
    if (stop != nullptr && *stop) return;
    const int count = hand_out(notifications);
    // Another thread of this client may have taken the round; then wait for the next one. Limited,
    // since the other thread may win every time. The data are new in any case.
    constexpr int kMostRounds = 3;
    done = count > 0 || listens_to_nothing() || ++rounds == kMostRounds;
  }
  for (const auto& call : notifications) call();
}

bool ClientCore::read_pending() {
  Notifications notifications;
  int count = 0;
  {
    const std::lock_guard lock(mutex_);
    count = hand_out(notifications);
  }
  for (const auto& call : notifications) call();
  return count > 0;
}

void ClientCore::begin_change() noexcept {
  static constinit std::atomic<std::uint64_t> last{0};
  if (thread_number == 0) thread_number = ++last;
  if (holder_.mThread == thread_number || !usable()) return;
  withdraw_views();
  auto viewer = std::ranges::find(viewers_, thread_number);
  if (viewer == viewers_.end()) viewer = std::ranges::find(viewers_, std::uint64_t{0});
  if (viewer == viewers_.end()) return;  // a third thread has no view
  *viewer = thread_number;
  holder_ = {thread_number, static_cast<std::size_t>(viewer - viewers_.begin())};
}

void ClientCore::withdraw_views() noexcept {
  holder_ = {};
  for (Elements* const elements : bound_) elements->Withdraw();
}

void ClientCore::bind(Elements& elements) {
  const std::lock_guard lock(mutex_);
  elements.Bind(&holder_);
  bound_.push_back(&elements);
}

void ClientCore::unbind(Elements& elements) noexcept {
  const std::lock_guard lock(mutex_);
  std::erase(bound_, &elements);
}

void ClientCore::set_run_is_over(bool over) {
  const std::lock_guard lock(mutex_);
  if (over) withdraw_views();
  run_is_over_ = over;
}

int ClientCore::hand_out(Notifications& notifications) {
  begin_change();
  const int count = session_->take(*this);
  for (Entry& entry : entries_) {
    if (entry.polls()) entry.updated = entry.listener->on_poll();
    if (!std::exchange(entry.updated, false)) continue;
    entry.listener->on_round();
    if (auto call = entry.listener->notification()) notifications.push_back(std::move(call));
  }
  return count;
}

bool ClientCore::listens_to_nothing() const noexcept {
  return std::all_of(entries_.begin(), entries_.end(), [](const Entry& e) { return e.polls(); });
}

void ClientCore::on_reading(DeviceId device, const sim::SharedReading& reading) {
  const auto [begin, end] = by_device_.equal_range({device.robot, device.device});
  for (auto it = begin; it != end; ++it) {
    it->second->updated = true;
    it->second->listener->on_reading(reading);
  }
}

void ClientCore::close() noexcept {
  {
    const std::lock_guard lock(mutex_);
    if (closed_.exchange(true)) return;
    withdraw_views();
    for (const Entry& entry : entries_) entry.listener->on_close();
  }
  session_->close();
}

void ClientCore::require_usable() const {
  if (closed_) {
    throw SessionError(SessionError::Code::kDisconnected,
                       "the client that this device belongs to is gone");
  }
  if (run_is_over_) {
    throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
  }
}

void ClientCore::note_pose(int robot, const sim::Pose& pose, bool absolute) {
  const auto [it, is_new] = poses_.try_emplace(robot, KnownPose{pose, absolute});
  if (!is_new && (absolute || !it->second.absolute)) it->second = {pose, absolute};
}

std::optional<sim::Pose> ClientCore::last_pose(int robot) const {
  const auto it = poses_.find(robot);
  if (it == poses_.end()) return std::nullopt;
  return it->second.pose;
}

std::vector<sim::CellValue> ClientCore::list_of_cells(std::size_t size) {
  std::unique_lock lock(spare_mutex_);
  std::vector<sim::CellValue> cells = spare_cells_.take();
  lock.unlock();
  cells.resize(size);
  return cells;
}

void ClientCore::set_cells(sim::LayerId layer, const sim::CellRect& rect,
                           std::vector<sim::CellValue> cells) {
  Request request = SetCellsRequest{layer, rect, std::move(cells)};
  static_cast<void>(session_->answer(request));
  const std::lock_guard lock(spare_mutex_);
  spare_cells_.keep(std::move(std::get<SetCellsRequest>(request).cells));
}

sim::LayerId ClientCore::acquire_layer() {
  constexpr int kPriority = 100;
  require_usable();
  const std::vector<sim::LayerInfo> layers = session_->request(LayersRequest{});
  for (int number = 0;; ++number) {
    sim::LayerStyle style;
    style.name = number == 0 ? "graphics2d" : "graphics2d_" + std::to_string(number);
    style.priority = kPriority;
    const auto layer = std::find_if(layers.begin(), layers.end(), [&](const sim::LayerInfo& l) {
      return l.style.name == style.name;
    });
    if (layer == layers.end()) {
      const sim::LayerId made =
          session_->request(CreateLayerRequest{sim::LayerKind::kColour, std::move(style)});
      sheets_[made] = true;
      return made;
    }
    const auto sheet = sheets_.find(layer->id);
    if (sheet == sheets_.end() || sheet->second) continue;
    sheet->second = true;
    sim::DrawOperation clear;
    clear.kind = sim::DrawOperation::Kind::kFill;
    clear.layer = layer->id;
    session_->draw({&clear, 1});
    return layer->id;
  }
}

void ClientCore::release_layer(sim::LayerId layer) noexcept {
  const std::lock_guard lock(mutex_);
  const auto sheet = sheets_.find(layer);
  if (sheet != sheets_.end()) sheet->second = false;
}

const RobotInfo& ClientCore::robot_of(DeviceId device) const {
  return robots().at(static_cast<std::size_t>(device.robot));
}

const DeviceInfo& ClientCore::info_of(DeviceId device) const {
  return require_device(robots(), device);
}

void show_elements(Elements& elements, const Newest& newest) {
  const auto show = [&](const std::vector<double>& values, auto... bearings) {
    elements.Show(newest.reading, values.data(), static_cast<std::uint32_t>(values.size()),
                  bearings...);
  };
  if (const auto* scan = newest.find<sim::LaserReading>()) {
    show(scan->ranges_m, scan->angle_min_rad, scan->resolution_rad);
  } else if (const auto* round = newest.find<sim::RangerReading>()) {
    show(round->ranges_m);
  }
}

std::shared_ptr<ClientCore> make_core(std::unique_ptr<Session> session) {
  if (session == nullptr) {
    throw SessionError(SessionError::Code::kBadArgument, "the session is null");
  }
  return std::make_shared<ClientCore>(std::move(session));
}

}  // namespace playerlike
