// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/tcp_connect.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <asio/buffer.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/local/stream_protocol.hpp>
#include <cerrno>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "sim/core/number_text.h"

namespace playerlike {

using asio::ip::tcp;
using std::chrono::milliseconds;

std::string seconds_text(SocketClock::duration duration) {
  return sim::rounded_text(std::chrono::duration<double>(duration).count(), 6) + " s";
}

SocketClock::duration wall_duration(double seconds) {
  return std::chrono::duration_cast<SocketClock::duration>(
      std::chrono::duration<double>(std::clamp(seconds, 0.0, kLongest_s)));
}

bool wait_for_socket(int socket, short events, SocketClock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - SocketClock::now());
    pollfd polled{socket, events, 0};
    const int ready =
        poll(&polled, 1, static_cast<int>(std::clamp<milliseconds::rep>(left.count(), 0, 60'000)));
    if (ready > 0) return true;
    if (SocketClock::now() >= deadline) return false;
  }
}

void fail_to_connect(const ServerAddress& address, const std::string& why) {
  throw SessionError(SessionError::Code::kDisconnected,
                     "cannot connect to " + address.text() + ": " + why);
}

namespace {

/// Resolves a host name.
std::vector<asio::ip::address> look_up(const ServerAddress& server, SocketClock::duration timeout,
                                       const ConnectDeadline& deadline) {
  asio::error_code error;
  if (const auto numeric = asio::ip::make_address(server.host, error); !error) return {numeric};
  using Found = std::pair<asio::error_code, std::vector<asio::ip::address>>;
  // A resolver call cannot be cancelled. If it takes too long, its thread is abandoned.
  const auto promise = std::make_shared<std::promise<Found>>();
  std::future<Found> future = promise->get_future();
  std::thread([promise, host = server.host] {
    asio::io_context context;
    tcp::resolver resolver(context);
    Found found;
    for (const auto& entry : resolver.resolve(host, "", found.first)) {
      found.second.push_back(entry.endpoint().address());
    }
    promise->set_value(std::move(found));
  }).detach();
  const bool done = deadline.wait([&](SocketClock::time_point until) {
    return future.wait_until(until) == std::future_status::ready;
  });
  if (!done) {
    fail_to_connect(server, "looking up its address took longer than " + seconds_text(timeout));
  }
  const Found found = future.get();
  if (found.first || found.second.empty()) {
    fail_to_connect(server, "there is no such host (" + found.first.message() + ')');
  }
  return found.second;
}

/// Connects a socket. @return the error text, nullopt if it is connected.
std::optional<std::string> connect_to(tcp::socket& socket, const tcp::endpoint& endpoint,
                                      const ConnectDeadline& deadline, std::size_t share,
                                      const char* refused) {
  asio::error_code error;
  socket.open(endpoint.protocol(), error);
  if (!error) socket.non_blocking(true, error);
  if (!error) {
    socket.connect(endpoint, error);
    if (error == asio::error::in_progress || error == asio::error::would_block) {
      const int handle = socket.native_handle();
      const bool done = deadline.wait(
          [&](SocketClock::time_point until) { return wait_for_socket(handle, POLLOUT, until); },
          share);
      if (!done) return "no answer in time";
      int problem = 0;
      socklen_t size = sizeof problem;
      getsockopt(handle, SOL_SOCKET, SO_ERROR, &problem, &size);
      error = asio::error_code(problem, asio::system_category());
    }
  }
  if (!error) socket.set_option(tcp::no_delay(true), error);
  if (!error) socket.set_option(asio::socket_base::keep_alive(true), error);
  if (!error) return std::nullopt;
  if (error == asio::error::connection_refused) {
    return std::string("connection refused: ") + refused;
  }
  return error.message();
}

}  // namespace

void connect_tcp(StreamSocket& socket, const ServerAddress& address, SocketClock::duration timeout,
                 const ConnectDeadline& deadline, const char* refused) {
  tcp::socket made(socket.get_executor());
  const auto hosts = look_up(address, timeout, deadline);
  std::string reasons;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    const tcp::endpoint endpoint(hosts[i], static_cast<asio::ip::port_type>(address.tcp_port));
    // Each remaining address gets an equal share of the time left.
    const auto problem = connect_to(made, endpoint, deadline, hosts.size() - i, refused);
    if (!problem) {
      socket = std::move(made);
      return;
    }
    asio::error_code ignored;
    made.close(ignored);
    if (reasons.find(*problem) != std::string::npos) continue;
    reasons += (reasons.empty() ? "" : "; ") + *problem;
  }
  fail_to_connect(address, reasons);
}

namespace {

/// A copy of a descriptor that this process has got connected. The copy is closed with the session;
/// the original is closed at once, so that it serves one session only.
StreamSocket::native_handle_type take_descriptor(const ServerAddress& address) {
  int type = 0;
  socklen_t size = sizeof type;
  sockaddr_storage peer{};
  socklen_t peer_size = sizeof peer;
  const int given = *address.descriptor;
  if (getsockopt(given, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_STREAM ||
      getpeername(given, reinterpret_cast<sockaddr*>(&peer), &peer_size) != 0) {
    fail_to_connect(address,
                    "this is no connected stream socket of this process; a descriptor that was "
                    "handed in serves one client only");
  }
  const int copy = fcntl(given, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) fail_to_connect(address, std::generic_category().message(errno));
  ::close(given);
  return copy;
}

}  // namespace

void connect_local(StreamSocket& socket, const ServerAddress& address) {
  asio::error_code error;
  if (address.descriptor) {
    socket.assign(asio::generic::stream_protocol(AF_UNIX, 0), take_descriptor(address), error);
  } else {
    asio::local::stream_protocol::socket made(socket.get_executor());
    made.connect(asio::local::stream_protocol::endpoint(address.path), error);
    if (!error) socket = std::move(made);
  }
  if (!error) socket.non_blocking(true, error);
  if (!error) return;
  if (error == asio::error::connection_refused) {
    fail_to_connect(address, "nobody listens there: is `playpen serve --unix` running?");
  }
  if (error.value() == ENOENT) {
    fail_to_connect(address, "there is no such socket: is `playpen serve --unix` running?");
  }
  fail_to_connect(address, error.message());
}

std::string connect_again(int limit, const std::function<bool()>& pause,
                          const std::function<void()>& attempt) {
  std::string reason;
  int attempts = 0;
  while ((limit < 0 || attempts < limit) && (attempts == 0 || pause())) {
    ++attempts;
    try {
      attempt();
      return "";
    } catch (const SessionError& e) {
      reason = e.what();
    }
  }
  return "the connection is lost, and " + std::to_string(attempts) +
         (attempts == 1 ? " attempt" : " attempts") + " to connect again failed: " + reason;
}

std::string socket_problem(const ServerAddress& address, const asio::error_code& error) {
  if (error == asio::error::eof) {
    return "the server at " + address.text() + " has closed the connection";
  }
  return "the connection to " + address.text() + " is lost: " + error.message();
}

std::string write_all(StreamSocket& socket, const ServerAddress& address, std::string_view bytes,
                      SocketClock::duration timeout) {
  const auto deadline = SocketClock::now() + timeout;
  while (!bytes.empty()) {
    asio::error_code error;
    const std::size_t count = socket.write_some(asio::buffer(bytes), error);
    bytes.remove_prefix(count);
    if (error == asio::error::would_block || error == asio::error::try_again) {
      if (!wait_for_socket(socket.native_handle(), POLLOUT, deadline)) {
        return "the server at " + address.text() + " has taken nothing for " +
               seconds_text(timeout);
      }
    } else if (error && error != asio::error::interrupted) {
      return socket_problem(address, error);
    }
  }
  return "";
}

std::size_t read_some(StreamSocket& socket, const ServerAddress& address, std::span<char> room) {
  asio::error_code error;
  const std::size_t count = socket.read_some(asio::buffer(room.data(), room.size()), error);
  if (error == asio::error::would_block || error == asio::error::try_again ||
      error == asio::error::interrupted) {
    return 0;
  }
  if (error) throw ConnectionLost(socket_problem(address, error));
  return count;
}

bool is_at_end(int socket) noexcept {
  char byte = 0;
  return recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

}  // namespace playerlike
