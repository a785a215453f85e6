// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/host.h"
#include "playerlike/messages/requests.h"
#include "server/peer.h"

namespace playerlike::server {

/// Refuses requests and commands that a client of a server may not make, and requests that a server
/// never executes. Used by the server's thread only.
class RequestGuard {
 public:
  /// All must outlive the guard. Later changes of `rights` take effect at once.
  /// @param port      of the client's session.
  /// @param onlooker  whether changes are noted, see Host::note_onlooker_acts().
  RequestGuard(Host& host, const Rights& rights, int port, bool onlooker = false)
      : host_(host), rights_(rights), port_(port), onlooker_(onlooker) {}

  /// @throws ProtocolError access/denied or protocol/bad-value; SessionError kNoSuchDevice or
  ///         kBadArgument.
  void check(const Request& request) const;
  /// Checks a command to a device. @throws as check().
  void check_command(DeviceId device) const;
  /// Whether the client may change the canvas that all clients share.
  [[nodiscard]] bool may_draw() const { return rights_.change_shared(); }
  /// @throws ProtocolError access/denied unless may_draw().
  void check_canvas() const;
  /// Notes that the client may change the world and is about to. The checks do so, too.
  void note_change() const {
    if (onlooker_) host_.note_onlooker_acts();
  }

 private:
  struct Check;

  /// @param robot  index; -1: all robots. @throws ProtocolError access/denied.
  void require_rights(int robot) const;
  /// The index of the robot with this name; -1 if the object is not a robot.
  [[nodiscard]] int robot_named(const std::string& name) const;

  Host& host_;
  const Rights& rights_;
  const int port_;
  const bool onlooker_;
};

}  // namespace playerlike::server
