// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "protocol/framing.h"

namespace playerlike {

/// Where a server is.
struct ServerAddress {
  std::string host;  ///< a name, or an IPv4 or IPv6 address without brackets
  int tcp_port = protocol::kDefaultTcpPort;

  /// "HOST:PORT", for messages.
  [[nodiscard]] std::string text() const;
};

/// What host names that mean a server may begin with.
inline constexpr std::string_view kTcpPrefix = "tcp://";

/// Reads "tcp://HOST[:PORT]" or "HOST[:PORT]"; an IPv6 address is in brackets.
/// @throws SessionError kBadArgument, saying what is wrong.
[[nodiscard]] ServerAddress parse_server_address(const std::string& text);

}  // namespace playerlike
