// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/listening.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <asio/ip/v6_only.hpp>
#include <cerrno>
#include <system_error>
#include <utility>

#include "protocol/framing.h"
#include "sim/core/error.h"

namespace playerlike::server {
namespace {

using asio::ip::tcp;
using UnixProtocol = asio::local::stream_protocol;

}  // namespace

void throw_issue(std::string id, std::string place, std::string expected, std::string found,
                 std::string hint) {
  throw sim::ConfigError(sim::ConfigIssue{std::move(id), "", std::move(place), std::move(expected),
                                          std::move(found), std::move(hint)});
}

void close_on_exec(int descriptor) { fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

// --- TCP

namespace {

/// Resolves a name to addresses of this machine.
std::vector<asio::ip::address> addresses_of(asio::io_context& io, const std::string& name) {
  constexpr const char* kExpected = "an IPv4 or IPv6 address of this machine, or a name of it";
  asio::error_code error;
  const asio::ip::address literal = asio::ip::make_address(name, error);
  if (!error) return {literal};
  tcp::resolver resolver(io);
  const auto results = resolver.resolve(name, "", tcp::resolver::passive, error);
  std::vector<asio::ip::address> addresses;
  for (const auto& result : results) {
    const asio::ip::address address = result.endpoint().address();
    if (std::find(addresses.begin(), addresses.end(), address) == addresses.end()) {
      addresses.push_back(address);
    }
  }
  if (error || addresses.empty()) {
    throw_issue("server/address", "bind", kExpected,
                '"' + name + "\": " + (error ? error.message() : "no address"), "");
  }
  return addresses;
}

void require_token(const ServerSettings& settings,
                   const std::vector<asio::ip::address>& addresses) {
  if (settings.open || !settings.access.server_token.empty()) return;
  for (const asio::ip::address& address : addresses) {
    if (address.is_loopback()) continue;
    throw_issue("server/token-needed", "bind",
                "a token for clients, since other machines can reach this address",
                '"' + settings.bind + "\" without one",
                "name a token file that has a \"server\" token, or allow everybody with --open");
  }
}

/// @param alone  whether this is the only address: then "::" accepts IPv4 too. A name may resolve
///               to an address of each protocol.
asio::error_code open_on(asio::io_context& io, const asio::ip::address& address, bool alone,
                         Listener& listener) {
  try {
    const tcp::endpoint endpoint(address, static_cast<std::uint16_t>(listener.port));
    tcp::acceptor acceptor(io);
    acceptor.open(endpoint.protocol());
    close_on_exec(acceptor.native_handle());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    if (address.is_v6()) acceptor.set_option(asio::ip::v6_only(!alone));
    acceptor.bind(endpoint);
    acceptor.listen();
    acceptor.non_blocking(true);
    listener.port = acceptor.local_endpoint().port();
    listener.acceptors.push_back(std::move(acceptor));
    return {};
  } catch (const std::system_error& e) {
    return e.code();
  }
}

}  // namespace

std::vector<asio::ip::address> checked_addresses(asio::io_context& io,
                                                 const ServerSettings& settings) {
  std::vector<asio::ip::address> addresses = addresses_of(io, settings.bind);
  require_token(settings, addresses);
  return addresses;
}

asio::error_code open(asio::io_context& io, const std::vector<asio::ip::address>& addresses,
                      int port, Listener& listener) {
  asio::error_code result;
  // A port that is free on the first address may be in use on another, so try again.
  for (int attempt = 0; attempt < (port == 0 ? 10 : 1); ++attempt) {
    listener.acceptors.clear();
    listener.port = port;
    result.clear();
    for (const asio::ip::address& address : addresses) {
      const asio::error_code error = open_on(io, address, addresses.size() == 1, listener);
      // A name may have an address of a protocol that this machine does not support.
      const bool no_such_address =
          error == asio::error::address_family_not_supported || error.value() == EADDRNOTAVAIL;
      if (error && !(no_such_address && addresses.size() > 1)) result = error;
      if (result) break;
    }
    if (!result && listener.acceptors.empty()) {
      result = asio::error_code(EADDRNOTAVAIL, asio::system_category());
    }
    if (result != asio::error::address_in_use) break;
  }
  return result;
}

void open_or_throw(asio::io_context& io, const std::vector<asio::ip::address>& addresses,
                   const ServerSettings& settings, int port, const char* place,
                   Listener& listener) {
  const asio::error_code error = open(io, addresses, port, listener);
  if (!error) return;
  const std::string where = settings.bind + ':' + std::to_string(port);
  if (error == asio::error::address_in_use) {
    throw_issue("server/port-taken", place, "a free TCP port", std::to_string(port) + ", taken",
                "another playpen serve, MORSE or Player may hold it (ss -ltnp tells); port 0 "
                "takes any free one");
  }
  if (error == asio::error::access_denied) {
    throw_issue("server/port-not-allowed", place, "a TCP port that this user may open",
                where + ": " + error.message(), "ports from 1024 on are open to all users");
  }
  throw_issue("server/address", "bind", "an address of this machine",
              where + ": " + error.message(), "");
}

std::map<int, int> wanted_player_ports(const ServerSettings& settings,
                                       const std::vector<int>& robot_ports) {
  constexpr int kMaxPort = 65535;
  std::map<int, int> ports;
  if (!settings.player_port) return ports;
  for (const int port : robot_ports) ports[port] = 0;
  if (*settings.player_port == 0 || ports.empty()) return ports;
  const int shift = *settings.player_port - kPlayerPort;
  const int first = ports.begin()->first;
  const int last = ports.rbegin()->first;
  if (first + shift < 1 || last + shift > kMaxPort) {
    throw_issue("server/port-range", "player_port",
                "a port from " + std::to_string(std::max(1, kPlayerPort + 1 - first)) + " to " +
                    std::to_string(std::min(kMaxPort, kMaxPort + kPlayerPort - last)) +
                    ", which robots on port 6665 get, since the world's are on " +
                    std::to_string(first) + " to " + std::to_string(last),
                std::to_string(*settings.player_port), "port 0 takes any free ports");
  }
  for (auto& [robot_port, port] : ports) port = robot_port + shift;
  return ports;
}

// --- Unix sockets

namespace {

[[noreturn]] void refuse_unix_socket(const std::string& path, const std::string& found,
                                     std::string hint) {
  throw_issue("server/unix-socket", "unix", "a path for a Unix socket on which nobody listens",
              '"' + path + "\": " + found, std::move(hint));
}

/// Whether a process listens on the socket of this path.
bool has_listener(const std::string& path) {
  asio::io_context io;
  UnixProtocol::socket socket(io);
  asio::error_code error;
  socket.connect(UnixProtocol::endpoint(path), error);
  return error != asio::error::connection_refused;
}

/// Checks a path. @return whether a socket's file must be removed, since nobody listens there.
bool is_left_over(const std::string& path) {
  if (path.empty() || path.size() > protocol::kMaxUnixPath) {
    refuse_unix_socket(path, std::to_string(path.size()) + " bytes",
                       "the system takes 1 to " + std::to_string(protocol::kMaxUnixPath) +
                           " bytes; /tmp or $XDG_RUNTIME_DIR have short paths");
  }
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return false;
    refuse_unix_socket(path, std::generic_category().message(errno), "");
  }
  if (!S_ISSOCK(status.st_mode)) {
    refuse_unix_socket(path, "a file that is no socket", "remove it, or give another path");
  }
  if (has_listener(path)) {
    refuse_unix_socket(path, "a server listens there, or this user may not connect to it",
                       "end that server, or give another path");
  }
  return true;
}

}  // namespace

void UnixListener::check(const std::string& path) { static_cast<void>(is_left_over(path)); }

UnixListener::UnixListener(asio::io_context& io, std::string path)
    : acceptor_(io), path_(std::move(path)) {
  if (is_left_over(path_)) unlink(path_.c_str());
  asio::error_code error;
  acceptor_.open(UnixProtocol(), error);
  if (!error) close_on_exec(acceptor_.native_handle());
  if (!error) acceptor_.bind(UnixProtocol::endpoint(path_), error);
  // Nobody can connect before listen().
  if (!error && chmod(path_.c_str(), S_IRUSR | S_IWUSR) != 0) {
    error = asio::error_code(errno, asio::system_category());
  }
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (!error) acceptor_.non_blocking(true, error);
  if (error) {
    refuse_unix_socket(path_, error.message(), "name a path in a folder in which you may write");
  }
  struct stat status {};
  if (lstat(path_.c_str(), &status) == 0) {
    device_ = status.st_dev;
    inode_ = status.st_ino;
  }
}

UnixListener::~UnixListener() { close(); }

void UnixListener::accept(OnConnect on_connect, OnError on_error) {
  acceptor_.async_accept([this, on_connect = std::move(on_connect), on_error = std::move(on_error)](
                             const asio::error_code& error, UnixProtocol::socket socket) mutable {
    if (error == asio::error::operation_aborted) return;
    if (error && error != asio::error::connection_aborted) return on_error(error);
    if (!error) {
      const std::string name = unix_peer_name(socket.native_handle());
      on_connect(asio::generic::stream_protocol::socket(std::move(socket)), name);
    }
    accept(std::move(on_connect), std::move(on_error));
  });
}

void UnixListener::close() noexcept {
  if (!acceptor_.is_open()) return;
  asio::error_code ignored;
  acceptor_.close(ignored);
  struct stat status {};
  if (lstat(path_.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_) {
    unlink(path_.c_str());
  }
}

std::string unix_peer_name(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return "unix:0";
  return "unix:" + std::to_string(peer.pid);
}

}  // namespace playerlike::server
