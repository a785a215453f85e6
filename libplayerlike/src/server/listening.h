// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <asio/generic/stream_protocol.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/address.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/local/stream_protocol.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "playerlike/server/server_settings.h"
#include "server/peer.h"

/// The sockets on which a server listens.
namespace playerlike::server {

/// Throws a sim::ConfigError with one issue.
[[noreturn]] void throw_issue(std::string id, std::string place, std::string expected,
                              std::string found, std::string hint);

/// Programs that this process starts must not keep its ports and connections open.
void close_on_exec(int descriptor);

/// A port on all of the server's addresses.
struct Listener {
  std::vector<asio::ip::tcp::acceptor> acceptors;
  int port = 0;
  bool services = false;  ///< the services' port
  MakeHandler make;
};

/// The addresses to listen on. @throws sim::ConfigError, also if they need a token.
[[nodiscard]] std::vector<asio::ip::address> checked_addresses(asio::io_context& io,
                                                               const ServerSettings& settings);

/// Opens a port on all addresses. @param port  0: any free one. @return the error.
[[nodiscard]] asio::error_code open(asio::io_context& io,
                                    const std::vector<asio::ip::address>& addresses, int port,
                                    Listener& listener);

/// @param place  the setting that gives the port, for errors.
void open_or_throw(asio::io_context& io, const std::vector<asio::ip::address>& addresses,
                   const ServerSettings& settings, int port, const char* place, Listener& listener);

/// TCP ports of Player's protocol by the robots' ports, 0 for any free one.
/// @throws sim::ConfigError server/port-range.
[[nodiscard]] std::map<int, int> wanted_player_ports(const ServerSettings& settings,
                                                     const std::vector<int>& robot_ports);

/// A Unix socket that accepts connections of this user's processes (permissions 0600). It replaces
/// a socket file on which nobody listens, and removes its own file at the end.
class UnixListener {
 public:
  /// Receives a connected socket and a name of the peer for the log.
  using OnConnect = std::function<void(asio::generic::stream_protocol::socket, const std::string&)>;
  /// Receives the error of a failed attempt to accept; accept() continues.
  using OnError = std::function<void(const asio::error_code&)>;

  /// Opens the socket. @throws sim::ConfigError server/unix-socket.
  UnixListener(asio::io_context& io, std::string path);
  ~UnixListener();
  UnixListener(const UnixListener&) = delete;
  UnixListener& operator=(const UnixListener&) = delete;

  /// Throws what the constructor would throw, without side effects.
  static void check(const std::string& path);

  /// Accepts connections until close() or an error.
  void accept(OnConnect on_connect, OnError on_error);
  /// Stops to listen, and removes the socket's file.
  void close() noexcept;

 private:
  asio::local::stream_protocol::acceptor acceptor_;
  const std::string path_;
  dev_t device_ = 0;  ///< of the socket's file, with `inode_`: another server may have replaced it
  ino_t inode_ = 0;
};

/// The name of a Unix socket's peer for the log: "unix:PROCESS".
[[nodiscard]] std::string unix_peer_name(int socket);

}  // namespace playerlike::server
