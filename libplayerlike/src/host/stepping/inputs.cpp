// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/inputs.h"

#include <algorithm>
#include <span>
#include <variant>

#include "host/mirror/mirror.h"

namespace playerlike {
namespace {

// Maximum number of a client's commands per step. Further ones are applied early, so that a client
// that never reads does not use up memory.
constexpr std::size_t kCommandLimit = 1 << 12;

// Whether a command replaces an earlier one of its kind that has not been applied yet. Relative
// movements and counted commands do not.
bool replaces_earlier_ones(const sim::Command& command) {
  return is_one_of<sim::TwistCommand, sim::HeadingCommand, sim::PositionCommand, sim::CarCommand,
                   sim::MotorEnableCommand, sim::SetPoseCommand>(command);
}

}  // namespace

bool replaces_last(std::vector<std::pair<DeviceId, sim::Command>>& queue, DeviceId device,
                   const sim::Command& command) {
  if (!replaces_earlier_ones(command) || queue.empty() || !(queue.back().first == device) ||
      queue.back().second.index() != command.index()) {
    return false;
  }
  queue.back().second = command;
  return true;
}

bool Inputs::add(Client& client, DeviceId device, const sim::Command& command) {
  auto& all = client.commands;
  if (replaces_last(all, device, command)) return false;
  all.emplace_back(device, command);
  commands_wait_.store(true, std::memory_order_relaxed);
  return all.size() > kCommandLimit;
}

void Inputs::before_step(const Clients& clients) {
  if (!to_stop_.empty()) stop(std::exchange(to_stop_, {}));
  const bool commanded = commands_wait_.exchange(false);
  if (commanded || somebody_draws_) {
    for (const auto& client : clients) apply(*client);
  }
  if (hand) hand->before_step(simulation_);
}

void Inputs::apply(Client& client) {
  const std::lock_guard input(client.input_mutex);
  const auto kind = client.follower ? Commanders::Kind::kFollower : Commanders::Kind::kClient;
  for (const auto& [device, command] : client.commands) {
    if (const auto refusal = commanders.note(&client, device, kind)) {
      if (!std::exchange(client.overruled, true)) warn_(*refusal);
      continue;
    }
    if (hand) hand->note_command(device, command);
    commands.note(device.robot, client.port, command, simulation_.now_ns());
    const auto refusal = execute(device, command);
    // The log has said that a real robot is lost.
    if (refusal && !(mirror_ != nullptr && mirror_->has_lost(device.robot))) warn_(*refusal);
  }
  client.commands.clear();
  apply_drawings(client);
}

std::optional<std::string> Inputs::execute(DeviceId device, const sim::Command& command) {
  if (on_command) on_command(device, command);
  if (mirror_ != nullptr) {
    if (auto executed = mirror_->take_command(device, command)) return *std::move(executed);
  }
  return simulation_.apply(device, command);
}

std::optional<std::string> Inputs::execute_for(Commanders::Who who, DeviceId device,
                                               const sim::Command& command) {
  if (auto refusal = commanders.note(who, device, Commanders::Kind::kMorse)) return refusal;
  if (hand) hand->note_command(device, command);
  return execute(device, command);
}

void Inputs::stop_at_next_step(const std::vector<int>& robots) {
  if (mirror_ != nullptr) return stop(robots);
  to_stop_.insert(to_stop_.end(), robots.begin(), robots.end());
}

void Inputs::stop(const std::vector<int>& robots) {
  for (const int robot : robots) {
    for (const auto& [device, command] : commanders.stop(robot)) {
      if (hand) hand->note_command(device, command);
      static_cast<void>(execute(device, command));  // a device that is switched off stands
    }
  }
}

// Drops drawings on layers of other clients, with one check for each run of drawings on one layer.
// Usually all drawings are on the client's own layers and are drawn without a copy.
void Inputs::apply_drawings(Client& client) {
  client.drawings.drain([&](std::span<const sim::DrawOperation> operations) {
    std::optional<sim::LayerId> layer;
    const bool all_own = std::all_of(operations.begin(), operations.end(), [&](const auto& o) {
      if (layer == o.layer) return true;
      layer = o.layer;
      return registry.may_use(client.number, o.layer);
    });
    if (all_own) return simulation_.layers().draw(operations);
    std::vector<sim::DrawOperation> own(operations.begin(), operations.end());
    keep_own_drawings(client, own);
    simulation_.layers().draw(own);
  });
}

void Inputs::reserve_drawings(Client& client) {
  client.drawings.reserve();
  somebody_draws_ = true;
}

void Inputs::keep_own_drawings(const Client& client,
                               std::vector<sim::DrawOperation>& operations) const {
  std::optional<sim::LayerId> layer;
  bool own = false;
  std::erase_if(operations, [&](const sim::DrawOperation& o) {
    if (layer != o.layer) own = registry.may_use(client.number, o.layer);
    layer = o.layer;
    return !own;
  });
}

}  // namespace playerlike
