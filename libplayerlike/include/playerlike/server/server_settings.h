// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "sim/core/log.h"

namespace playerlike {

/// What a server puts up with. A client that goes beyond is told so, and closed or left without
/// what does not fit; the others notice nothing.
struct ServerLimits {
  std::size_t message_bytes = std::size_t{1} << 20U;  ///< of one line or frame from a client
  std::size_t requests_in_flight = 256;               ///< of one connection, not answered yet
  std::size_t connections = 256;                      ///< of all ports together
  std::size_t queued_bytes = std::size_t{8} << 20U;   ///< that wait to be sent to one client
  /// That wait to be sent to all clients together, those of large answers in the making among them.
  std::size_t all_queued_bytes = std::size_t{1} << 30U;
  double first_request_s = 10.0;    ///< wall time from the connection to its first whole request
  double partial_request_s = 10.0;  ///< wall time from a request's first byte to its last
  double idle_s = 0.0;              ///< wall time without a whole request; 0: no limit
};

/// Who may do what, from a token file; see docs/remote.md.
struct AccessSettings {
  std::string server_token;                         ///< "": anybody may connect
  std::map<std::string, std::string> robot_tokens;  ///< by the robot's name: only who presents it
                                                    ///< commands that robot
  bool open_watching = false;                       ///< watching needs no token
  std::string file;                                 ///< where it is from, for messages
};

/// How a simulation is offered over TCP.
struct ServerSettings {
  std::string bind = "127.0.0.1";  ///< an IPv4 or IPv6 address, or a name of this machine
  int port = 4000;                 ///< for services; 0: any free one
  int stream_port = 60000;         ///< the first of MORSE's stream ports; 0: any free ones
  std::optional<int> sync_port;    ///< of MORSE's clock synchronisation; 0: any free one
  bool open = false;               ///< allows an address beyond loopback without a token
  AccessSettings access;
  ServerLimits limits;
};

inline constexpr std::size_t kMinToken = 8;    ///< bytes of a token at least, for one more release
inline constexpr std::size_t kGoodToken = 16;  ///< bytes of a token at least, without a warning
inline constexpr std::size_t kMaxToken = 256;  ///< bytes of a token at most

/// A token that nobody can guess: 128 random bits of the system's in hexadecimal.
[[nodiscard]] std::string make_token();

/// Reads a token file (docs/remote.md). Tokens are not shown in messages.
/// @param log  is warned if others may read the file, and of tokens with less than kGoodToken
/// bytes.
/// @throws sim::ConfigError with all that is wrong: access/token, or as for other settings files.
[[nodiscard]] AccessSettings read_token_file(const std::string& file, const sim::LogHook& log = {});

}  // namespace playerlike
