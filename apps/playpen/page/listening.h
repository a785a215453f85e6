// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
// Boost 1.74 uses std::exchange without its header, so these come after it.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>

#include "page_settings.h"

namespace playpen::page {

/// What the user reads who has given an option that cannot be used.
[[nodiscard]] inline std::runtime_error option_error(const std::string& option,
                                                     const std::string& expected,
                                                     const std::string& found,
                                                     const std::string& id) {
  return std::runtime_error(option + ": expected " + expected + ", found " + found + " [" + id +
                            ']');
}

/// The address that "--page-bind" means: an IPv4 address of a name if it has one.
[[nodiscard]] inline boost::asio::ip::address address_of(boost::asio::ip::tcp::resolver resolver,
                                                         const std::string& bind) {
  using Resolver = boost::asio::ip::tcp::resolver;
  boost::system::error_code error;
  const auto found =
      resolver.resolve(bind, "0", Resolver::passive | Resolver::numeric_service, error);
  const auto is_v4 = [](const auto& entry) { return entry.endpoint().address().is_v4(); };
  const auto first = std::find_if(found.begin(), found.end(), is_v4);
  if (error || found.empty()) {
    throw option_error("--page-bind", "an IPv4 or IPv6 address, or a name of this machine",
                       '"' + bind + '"', "server/address");
  }
  return (first == found.end() ? found.begin() : first)->endpoint().address();
}

/// Listens on the first port that is free. For page_server.cpp alone, since it shows types of
/// Boost.
/// @throws std::runtime_error that names the option to change, and the error in docs/errors.md.
inline void listen_on(boost::asio::ip::tcp::acceptor& acceptor, const PageSettings& settings) {
  namespace asio = boost::asio;
  using asio::ip::tcp;
  const asio::ip::address address =
      address_of(tcp::resolver(acceptor.get_executor()), settings.bind);
  constexpr int kGreatestPort = 65535;
  const int last = std::min(settings.port + settings.ports - 1, kGreatestPort);
  boost::system::error_code error;
  for (int port = settings.port; port <= last; ++port) {
    const tcp::endpoint endpoint(address, static_cast<unsigned short>(port));
    boost::system::error_code ignored;
    acceptor.close(ignored);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    // "::" accepts IPv4 too.
    if (!error && address.is_v6()) acceptor.set_option(asio::ip::v6_only(false), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return;
    if (error != asio::error::address_in_use) break;
  }
  const std::string ports = settings.ports == 1
                                ? std::to_string(settings.port)
                                : std::to_string(settings.port) + " to " + std::to_string(last);
  if (error == asio::error::address_in_use) {
    throw option_error("--page-port", "a free TCP port",
                       ports + ", taken (ss -ltnp tells by whom; port 0 takes any free one)",
                       "server/port-taken");
  }
  if (error == asio::error::access_denied) {
    throw option_error("--page-port", "a TCP port that this user may open, from 1024 on", ports,
                       "server/port-not-allowed");
  }
  throw option_error("--page-bind", "an address of this machine",
                     '"' + settings.bind + "\": " + error.message(), "server/address");
}

}  // namespace playpen::page
