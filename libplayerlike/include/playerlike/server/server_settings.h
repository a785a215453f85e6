// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "sim/core/log.h"

namespace playerlike {

/// Limits of a server. A client that exceeds a limit gets an error; its connection is closed, or
/// the excess data is dropped. Other clients are not affected.
struct ServerLimits {
  std::size_t message_bytes = std::size_t{1} << 20U;  ///< of a line or frame from a client
  std::size_t requests_in_flight = 256;               ///< unanswered, per connection
  std::size_t connections = 256;                      ///< of all ports together
  std::size_t queued_bytes = std::size_t{8} << 20U;   ///< unsent data for one client
  /// Unsent data for all clients together, including large answers in progress.
  std::size_t all_queued_bytes = std::size_t{1} << 30U;
  double first_request_s = 10.0;    ///< wall time from the connection to its first complete request
  double partial_request_s = 10.0;  ///< wall time from a request's first byte to its last
  double idle_s = 0.0;              ///< wall time without a complete request; 0: no limit
};

/// Permissions from a token file; see docs/remote.md.
struct AccessSettings {
  std::string server_token;                         ///< token for connecting; "": not required
  std::map<std::string, std::string> robot_tokens;  ///< robot name -> token to command it
  bool open_watching = false;                       ///< whether watching requires no token
  std::string file;                                 ///< name of the token file, for messages
};

/// Settings of a server.
struct ServerSettings {
  std::string bind = "127.0.0.1";  ///< an IPv4 or IPv6 address, or a name of this machine
  std::optional<int> port = 4000;  ///< port for services; 0: any free port; nullopt: no such port
  std::string unix_path;           ///< Unix socket for services beside the port; "": none
  int stream_port = 60000;         ///< first of MORSE's stream ports; 0: any free ports
  bool open_streams = false;       ///< opens all of MORSE's stream ports at the start, in the order
                                   ///< of list_streams; otherwise each when a client asks for it
  std::optional<int> sync_port;    ///< port of MORSE's clock synchronisation; 0: any free port
  /// TCP port of Player's protocol for the robots whose port in the world is kPlayerPort. Others
  /// have the same distance to it as in the world. 0: any free ports; nullopt: no such ports.
  std::optional<int> player_port;
  /// For a simulation that a program in this process drives: clients are onlookers (EventRole), and
  /// the server does not step the simulation.
  bool onlookers = false;
  bool open = false;  ///< allows a non-loopback address without a token
  AccessSettings access;
  ServerLimits limits;
};

/// Settings of a server with Player's ports only, on this machine, for onlookers.
/// @param player_port  see ServerSettings::player_port.
[[nodiscard]] ServerSettings onlooker_settings(int player_port);

inline constexpr std::size_t kMinToken = 8;    ///< [bytes]; shorter tokens are refused, for one
                                               ///< more release
inline constexpr std::size_t kGoodToken = 16;  ///< [bytes]; shorter tokens cause a warning
inline constexpr std::size_t kMaxToken = 256;  ///< [bytes]; longer tokens are refused

/// Returns a random token: 128 bits from the system's random source, in hexadecimal.
[[nodiscard]] std::string make_token();

/// Reads a token file (docs/remote.md). Messages never contain tokens.
/// @param log  receives warnings about a file that other users may read and about tokens shorter
///             than kGoodToken.
/// @throws sim::ConfigError with all faults: access/token, or the general errors of settings files.
[[nodiscard]] AccessSettings read_token_file(const std::string& file, const sim::LogHook& log = {});

/// Tokens for the live page (docs/page.md); "": not given.
struct PageTokens {
  std::string command;  ///< for watching and commanding
  std::string watch;    ///< for watching
};

/// Reads a file with the live page's tokens, {"command": "...", "watch": "..."}. Messages never
/// contain tokens.
/// @param log  as of read_token_file().
/// @throws sim::ConfigError with all faults, as read_token_file(); access/token also if both tokens
///         are equal.
[[nodiscard]] PageTokens read_page_tokens(const std::string& file, const sim::LogHook& log = {});

}  // namespace playerlike
