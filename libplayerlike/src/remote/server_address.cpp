// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/server_address.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "playerlike/messages/messages.h"

namespace playerlike {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw SessionError(
      SessionError::Code::kBadArgument,
      '"' + text + "\" names no server: " + why +
          "; servers are named as tcp://HOST, tcp://HOST:PORT or tcp://[IPV6]:PORT, and "
          "Player's as player://HOST or player://HOST:PORT");
}

std::optional<int> parse_port(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || port < 1 || port > 65535) {
    return std::nullopt;
  }
  return port;
}

bool may_be_in_host(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
         c == '.' || c == '_' || c == ':' || c == '%';
}

}  // namespace

std::string ServerAddress::text() const {
  const bool is_v6 = host.find(':') != std::string::npos;
  return (is_v6 ? '[' + host + ']' : host) + ':' + std::to_string(tcp_port);
}

ServerAddress parse_server_address(const std::string& text, int default_port) {
  std::string_view rest = text;
  for (const std::string_view prefix : {kTcpPrefix, kPlayerPrefix}) {
    if (text.starts_with(prefix)) rest.remove_prefix(prefix.size());
  }
  if (rest.find("//") != std::string_view::npos) {
    refuse(text, "only tcp:// and player:// are known");
  }

  ServerAddress address;
  address.tcp_port = default_port;
  std::optional<std::string_view> port;
  if (rest.starts_with('[')) {
    const std::size_t end = rest.find(']');
    if (end == std::string_view::npos) refuse(text, "the bracket is not closed");
    address.host = rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (rest.starts_with(':')) {
      port = rest.substr(1);
    } else if (!rest.empty()) {
      refuse(text, "only a colon and a port may follow the bracket");
    }
  } else {
    const std::size_t colon = rest.find(':');
    if (colon != rest.rfind(':')) refuse(text, "an IPv6 address is written in brackets");
    address.host = rest.substr(0, colon);
    if (colon != std::string_view::npos) port = rest.substr(colon + 1);
  }
  if (address.host.empty()) refuse(text, "the host is missing");
  if (!std::all_of(address.host.begin(), address.host.end(), may_be_in_host)) {
    refuse(text, "a host is a name or an address");
  }
  if (port) {
    const std::optional<int> number = parse_port(*port);
    if (!number) refuse(text, "the port must be a whole number from 1 to 65535");
    address.tcp_port = *number;
  }
  return address;
}

}  // namespace playerlike
