// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/request_guard.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "protocol/codec.h"
#include "server/native_work.h"
#include "session/checks.h"
#include "sim/core/number_text.h"

namespace playerlike::server {
namespace {

using protocol::ProtocolError;

constexpr std::size_t kMaxReason = 200;

}  // namespace

void RequestGuard::require_rights(int robot) const {
  if (robot < 0) {
    if (rights_.command_all()) return note_change();
    throw ProtocolError(
        "access/denied",
        "this affects all robots: only clients that may command each of them may do it");
  }
  const auto index = static_cast<std::size_t>(robot);
  if (index < rights_.command.size() && rights_.command[index]) return note_change();
  throw ProtocolError("access/denied", "robot " + host_.robots()[index].name +
                                           " obeys only clients whose hello has its token");
}

int RequestGuard::robot_named(const std::string& name) const {
  const auto& robots = host_.robots();
  const auto it = std::find_if(robots.begin(), robots.end(),
                               [&](const RobotInfo& robot) { return robot.name == name; });
  return it == robots.end() ? -1 : static_cast<int>(it - robots.begin());
}

void RequestGuard::check_command(DeviceId device) const {
  require_device(host_.robots(), device);
  require_rights(device.robot);
}

void RequestGuard::check_canvas() const {
  if (may_draw()) return note_change();
  throw ProtocolError(
      "access/denied",
      "only clients that may command a robot may draw on the shared canvas, erase or "
      "resize it: present the token of a robot in hello, or draw on a layer of "
      "your own");
}

/// The checks of requests, one function for each that has one.
struct RequestGuard::Check {
  const RequestGuard& guard;

  template <typename One>
  void operator()(const One& what) const {
    if constexpr (requires { One::kTellsTruth; }) require_truth();
    if constexpr (requires { check(what); }) check(what);
  }

 private:
  void require_truth() const {
    if (guard.rights_.truth) return;
    throw ProtocolError(
        "access/denied",
        "this world keeps the poses and properties of its objects and its map private "
        "(\"privacy\" in its \"simulation\"): that takes the tokens of all robots");
  }
  void check(const SubscribeRequest& what) const {
    const std::vector<RobotInfo>& robots = guard.host_.robots();
    require_device(robots, what.device);
    const auto robot = static_cast<std::size_t>(what.device.robot);
    if (guard.rights_.read[robot]) return;
    throw ProtocolError("access/denied",
                        "this world lets a client read the sensors of its own robots only "
                        "(\"privacy\" in its \"simulation\"): for those of " +
                            robots[robot].name + " present that robot's token");
  }
  void check(const ReplaceRequest& what) const {
    if (what.device) require_device(guard.host_.robots(), *what.device);
  }
  void check(const SetCellsRequest& what) const {
    if (what.layer == sim::kBaseLayer) guard.check_canvas();
  }
  void check(const ResizeCanvasRequest&) const { guard.check_canvas(); }
  void check(const PlaceObjectRequest& what) const {
    guard.require_rights(guard.robot_named(what.name));
  }
  void check(const SetObjectPropertyRequest& what) const {
    guard.require_rights(guard.robot_named(what.name));
  }
  void check(const SetConfigurationRequest&) const { guard.require_rights(-1); }
  void check(const SetBlockRequest&) const { guard.require_rights(-1); }
  void check(const SetTimerRequest&) const { guard.require_rights(-1); }
  void check(const SetTrapRequest&) const { guard.require_rights(-1); }
  void check(const SaveStateRequest&) const { guard.require_rights(-1); }
  void check(const RestoreStateRequest&) const { guard.require_rights(-1); }
  void check(const WorldMapRequest& what) const {
    if (what.tile) {
      const sim::CellRect& tile = *what.tile;
      if (static_cast<double>(tile.width) * tile.height <= kMaxMapCells) return;
      protocol::refuse_value("tile", "at most 4194304 cells",
                             {tile.column, tile.row, tile.width, tile.height});
    }
    const sim::Vec2 arena_m = native_arena_m(guard.host_);
    if (!(what.cell_size_m > 0.0) || (arena_m / what.cell_size_m).prod() <= kMaxMapCells) return;
    throw SessionError(SessionError::Code::kBadArgument,
                       "a server makes maps of up to 4194304 cells: a cell of this arena must be " +
                           sim::rounded_text(std::sqrt(arena_m.prod() / kMaxMapCells), 6) +
                           " m long at least, unless the map is asked for in tiles");
  }
  void check(const SetBlackboardRequest&) const {
    if (guard.rights_.change_shared()) return guard.note_change();
    throw ProtocolError("access/denied",
                        "only clients that may command a robot may set entries of the shared "
                        "blackboard: present the token of a robot in hello");
  }
  void check(const NoteGoalRequest& what) const {
    require_device(guard.host_.robots(), what.device);
    guard.require_rights(what.device.robot);
  }
  void check(const TakeChargeRequest& what) const {
    require_device(guard.host_.robots(), what.device);
    guard.require_rights(what.device.robot);
  }
  void check(const LogRequest& what) const {
    if (!what.file && !what.replay && !what.rewind && !what.running) return;
    const std::vector<RobotInfo>& robots = guard.host_.robots();
    const auto robot = std::find_if(robots.rbegin(), robots.rend(),
                                    [&](const RobotInfo& r) { return r.port == guard.port_; });
    guard.require_rights(robot == robots.rend() ? -1 : static_cast<int>(robots.rend() - robot) - 1);
  }
  // The reason is written to the log.
  static void check(const PreferRealTimeRequest& what) {
    if (what.reason.size() <= kMaxReason && is_printable(what.reason)) return;
    protocol::refuse_value("reason", "at most 200 printable bytes", what.reason);
  }
};

void RequestGuard::check(const Request& request) const { std::visit(Check{*this}, request); }

}  // namespace playerlike::server
