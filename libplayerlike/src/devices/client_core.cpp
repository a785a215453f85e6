// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/client_core.h"

#include <algorithm>
#include <utility>

namespace playerlike {

ClientCore::ClientCore(std::unique_ptr<Session> session) : session_(std::move(session)) {}

ClientCore::~ClientCore() { session_->close(); }

void ClientCore::add(DeviceId device, ReadingListener& listener, std::optional<bool> replace) {
  require_usable();
  entries_.reserve(entries_.size() + 1);  // nothing may throw after the subscription
  session_->request(SubscribeRequest{device});
  entries_.push_back({device, &listener, false});
  if (replace) session_->request(ReplaceRequest{device, *replace});
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
  entries_.erase(it);
  if (closed_) return;
  try {
    session_->request(UnsubscribeRequest{device});
  } catch (const std::exception&) {
    // The session has ended meanwhile, and with it all subscriptions.
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
    // Another thread of this client may have taken the round: then there is one more to wait for,
    // but not for ever, as that thread may always be first. The data are new all the same.
    constexpr int kMostRounds = 3;
    done = count > 0 || entries_.empty() || ++rounds == kMostRounds;
  }
  for (const auto& call : notifications) call();
}

bool ClientCore::read_what_waits() {
  Notifications notifications;
  int count = 0;
  {
    const std::lock_guard lock(mutex_);
    count = hand_out(notifications);
  }
  for (const auto& call : notifications) call();
  return count > 0;
}

int ClientCore::hand_out(Notifications& notifications) {
  const int count = session_->take(*this);
  for (Entry& entry : entries_) {
    if (!std::exchange(entry.updated, false)) continue;
    entry.listener->on_round();
    if (auto call = entry.listener->notification()) notifications.push_back(std::move(call));
  }
  return count;
}

void ClientCore::on_reading(DeviceId device, const sim::Reading& reading) {
  for (Entry& entry : entries_) {
    if (!(entry.device == device)) continue;
    entry.updated = true;
    entry.listener->on_reading(reading);
  }
}

void ClientCore::close() noexcept {
  {
    const std::lock_guard lock(mutex_);
    if (closed_.exchange(true)) return;
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

sim::LayerId ClientCore::take_sheet() {
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

void ClientCore::give_back_sheet(sim::LayerId layer) noexcept {
  const std::lock_guard lock(mutex_);
  const auto sheet = sheets_.find(layer);
  if (sheet != sheets_.end()) sheet->second = false;
}

const RobotInfo& ClientCore::robot_of(DeviceId device) const {
  return robots().at(static_cast<std::size_t>(device.robot));
}

const DeviceInfo& ClientCore::info_of(DeviceId device) const {
  const RobotInfo& robot = robot_of(device);
  const auto it = std::find_if(robot.devices.begin(), robot.devices.end(),
                               [&](const DeviceInfo& d) { return d.id == device; });
  if (it == robot.devices.end()) {
    throw SessionError(SessionError::Code::kNoSuchDevice,
                       "robot " + robot.name + " has no device with that number");
  }
  return *it;
}

std::shared_ptr<ClientCore> make_core(std::unique_ptr<Session> session) {
  if (session == nullptr) {
    throw SessionError(SessionError::Code::kBadArgument, "the session is null");
  }
  return std::make_shared<ClientCore>(std::move(session));
}

}  // namespace playerlike
