// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/server_address.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "playerlike/messages/messages.h"

namespace playerlike {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw SessionError(
      SessionError::Code::kBadArgument,
      '"' + text + "\" names no server: " + why +
          "; servers are named as tcp://HOST, tcp://HOST:PORT, tcp://[IPV6]:PORT or unix:PATH, "
          "and Player's as player://HOST or player://HOST:PORT");
}

std::optional<int> parse_whole(std::string_view text, int least, int most) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < least || number > most) {
    return std::nullopt;
  }
  return number;
}

std::optional<int> parse_port(std::string_view text) { return parse_whole(text, 1, 65535); }

[[noreturn]] void refuse_unix(const std::string& text, const std::string& why) {
  throw SessionError(SessionError::Code::kBadArgument,
                     '"' + text + "\" names no Unix socket: " + why +
                         "; they are named as unix:PATH, or unix:fd=N for a descriptor that is "
                         "connected already");
}

ServerAddress parse_unix_address(const std::string& text) {
  constexpr std::string_view kDescriptor = "fd=";
  const std::string_view rest = std::string_view(text).substr(kUnixPrefix.size());
  ServerAddress address;
  if (rest.starts_with(kDescriptor)) {
    address.descriptor =
        parse_whole(rest.substr(kDescriptor.size()), 0, std::numeric_limits<int>::max());
    if (!address.descriptor) refuse_unix(text, "the descriptor must be a whole number from 0");
    return address;
  }
  if (rest.empty()) refuse_unix(text, "the path is missing");
  if (rest.starts_with('@')) refuse_unix(text, "abstract sockets have no permissions");
  if (rest.size() > protocol::kMaxUnixPath) {
    refuse_unix(text, "the path has " + std::to_string(rest.size()) + " bytes, and at most " +
                          std::to_string(protocol::kMaxUnixPath) + " are possible");
  }
  address.path = rest;
  return address;
}

bool may_be_in_host(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
         c == '.' || c == '_' || c == ':' || c == '%';
}

}  // namespace

std::string ServerAddress::text() const {
  if (descriptor) return std::string(kUnixPrefix) + "fd=" + std::to_string(*descriptor);
  if (!path.empty()) return std::string(kUnixPrefix) + path;
  const bool is_v6 = host.find(':') != std::string::npos;
  return (is_v6 ? '[' + host + ']' : host) + ':' + std::to_string(tcp_port);
}

ServerAddress parse_server_address(const std::string& text, int default_port) {
  if (text.starts_with(kUnixPrefix)) return parse_unix_address(text);
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
