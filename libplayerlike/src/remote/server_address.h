// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/framing.h"

namespace playerlike {

/// The address of a server.
struct ServerAddress {
  std::string host;  ///< a name, or an IPv4 or IPv6 address without brackets
  int tcp_port = protocol::kDefaultTcpPort;
  std::string path = {};               ///< of a Unix socket; replaces host and port
  std::optional<int> descriptor = {};  ///< of a connected socket; replaces all of these

  /// Whether it is on this machine, without TCP.
  [[nodiscard]] bool is_local() const noexcept { return !path.empty() || descriptor.has_value(); }
  /// "HOST:PORT", "unix:PATH" or "unix:fd=N", for messages.
  [[nodiscard]] std::string text() const;
};

/// Optional prefix of host names that mean a Playpen server.
inline constexpr std::string_view kTcpPrefix = "tcp://";
/// Prefix of host names that mean a Player server.
inline constexpr std::string_view kPlayerPrefix = "player://";

/// Prefix of Unix sockets on which a Playpen server listens: "unix:PATH"; "unix:fd=N" is a
/// descriptor that is connected to a server already.
inline constexpr std::string_view kUnixPrefix = "unix:";

/// Parses "unix:PATH", "unix:fd=N", "tcp://HOST[:PORT]", "player://HOST[:PORT]" or "HOST[:PORT]";
/// an IPv6 address is in brackets.
/// @param default_port  of an address without a port.
/// @throws SessionError kBadArgument with the reason.
[[nodiscard]] ServerAddress parse_server_address(const std::string& text,
                                                 int default_port = protocol::kDefaultTcpPort);

}  // namespace playerlike
