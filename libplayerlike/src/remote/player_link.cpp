// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_link.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "protocol/framing.h"
#include "protocol/player_xdr.h"

namespace playerlike {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t{64} << 10U;

/// Clients stamp their messages with the wall clock.
double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// The text of a greeting: printable characters up to the first zero.
std::string printable(std::string_view bytes) {
  std::string text = player::text_of(bytes);
  std::erase_if(text, [](char c) { return c < ' ' || c > '~'; });
  return text;
}

}  // namespace

player::Devaddr player_itself() noexcept { return {0, 0, PLAYER_PLAYER_CODE, 0}; }

struct PlayerLink::Impl {
  Impl(ServerAddress server, Receiver& to) : address(std::move(server)), receiver(to) {}

  const ServerAddress address;
  Receiver& receiver;
  asio::io_context context;
  StreamSocket socket{context};
  std::string version;
  std::atomic<Clock::rep> timeout{};

  // Used by the leader only.
  protocol::MessageSplitter splitter{protocol::Framing::kPlayer, player::kMaxPayload};
  std::size_t round_bytes = 0;  // received since the last complete round

  std::mutex send_mutex;     // guards writes to the socket; never locked while `mutex` is held
  std::mutex request_mutex;  // held by the thread whose request is in flight; locked first

  std::mutex mutex;  // guards the members below
  std::condition_variable changed;
  bool led = false;                     // a leader is reading the socket
  bool round_requested = false;         // and the round is not complete yet
  std::optional<player::Msghdr> asked;  // the request in flight: interface, index and subtype
  std::optional<Reply> reply;
  Clock::time_point heard{};  // when data have arrived last
  bool lost = false;
  std::string reason;

  [[nodiscard]] Clock::duration request_timeout() const { return Clock::duration(timeout.load()); }

  void lose(const std::string& why) noexcept {
    {
      const std::lock_guard lock(mutex);
      if (lost) return;
      lost = true;
      reason = why;
    }
    // Not closed: another thread may be polling it.
    ::shutdown(socket.native_handle(), SHUT_RDWR);
    changed.notify_all();
  }

  void send(const player::Devaddr& device, std::uint8_t type, std::uint8_t subtype,
            std::string_view payload) {
    std::string bytes;
    player::Msghdr header;
    header.addr = device;
    header.type = type;
    header.subtype = subtype;
    header.timestamp = wall_clock_s();
    player::append_message(bytes, header, payload);
    std::string problem;
    {
      const std::lock_guard lock(send_mutex);
      problem = write_all(socket, address, bytes, request_timeout());
    }
    if (!problem.empty()) lose(problem);
    throw_if_lost();
  }

  void throw_if_lost() {
    const std::lock_guard lock(mutex);
    if (lost) throw ConnectionLost(reason);
  }

  /// Reads the socket once if data arrive before the deadline. Only the leader may call it, without
  /// the lock. @throws ConnectionLost, protocol::ProtocolError.
  void receive(Clock::time_point deadline) {
    if (!wait_for_socket(socket.native_handle(), POLLIN, deadline)) return;
    const std::size_t count = read_some(socket, address, splitter.room(kReadAtOnce));
    if (count == 0) return;
    splitter.added(count);
    round_bytes += count;
    {
      const std::lock_guard lock(mutex);
      heard = Clock::now();
    }
    handle_messages();
    if (round_bytes > kMaxRound) {
      throw ConnectionLost("the server at " + address.text() +
                           " sends data without end, more than " +
                           std::to_string(kMaxRound >> 20U) + " MiB in a round");
    }
  }

  /// Handles all complete messages that have arrived.
  void handle_messages() {
    while (const auto bytes = splitter.next()) {
      const player::Message message = player::parse_message(*bytes);
      switch (message.header.type) {
        case PLAYER_MSGTYPE_DATA:
          receiver.on_data(message.header, message.payload);
          break;
        case PLAYER_MSGTYPE_SYNCH:
          round_bytes = 0;
          {
            const std::lock_guard lock(mutex);
            round_requested = false;  // before threads see the round: they may request the next one
          }
          receiver.on_round(message.header.subtype == PLAYER_PLAYER_SYNCH_OVERFLOW
                                ? player::decode<player::Uint32>(message.payload).value
                                : 0);
          break;
        case PLAYER_MSGTYPE_RESP_ACK:
        case PLAYER_MSGTYPE_RESP_NACK:
          take_reply(message);
          break;
        default:  // Player's client ignores commands and requests of a server, too
          break;
      }
    }
  }

  void take_reply(const player::Message& message) {
    const std::lock_guard lock(mutex);
    const player::Msghdr& header = message.header;
    if (!asked || reply || asked->addr.interf != header.addr.interf ||
        asked->addr.index != header.addr.index || asked->subtype != header.subtype) {
      return;  // the answer to a request that nobody waits for any more
    }
    reply = Reply{header.type == PLAYER_MSGTYPE_RESP_ACK, header.timestamp,
                  std::string(message.payload)};
  }

  /// Reads the socket once as the leader; `lock` is held before and after.
  void lead(std::unique_lock<std::mutex>& lock, Clock::time_point deadline) {
    led = true;
    lock.unlock();
    std::string problem;
    try {
      receive(deadline);
    } catch (const ConnectionLost& e) {
      problem = e.what();
    } catch (const std::exception& e) {
      problem = "the server at " + address.text() +
                " has sent what is no message of Player 3.1: " + e.what();
    }
    if (!problem.empty()) lose(problem);
    lock.lock();
    led = false;
    changed.notify_all();
  }

  [[nodiscard]] bool has_unread() {
    return wait_for_socket(socket.native_handle(), POLLIN, Clock::now());
  }

  /// Waits for the greeting. @throws SessionError.
  void read_banner(const ConnectDeadline& deadline, Clock::time_point at_latest) {
    std::string bytes;
    const auto refuse = [&](const std::string& what) {
      throw NoPlayerServer("there is no Player server at " + address.text() + ": " + what);
    };
    const bool done = deadline.wait([&](Clock::time_point until) {
      if (Clock::now() >= at_latest) return true;
      if (!wait_for_socket(socket.native_handle(), POLLIN, std::min(until, at_latest))) {
        return false;
      }
      std::string room(player::kBannerBytes - bytes.size(), '\0');
      try {
        bytes.append(room, 0, read_some(socket, address, room));
      } catch (const ConnectionLost& e) {
        refuse(e.what());
      }
      return bytes.size() == player::kBannerBytes;
    });
    if (!done || bytes.size() < player::kBannerBytes) {
      refuse(bytes.empty() ? "it does not greet" : "it greets with \"" + printable(bytes) + '"');
    }
    const std::string text = printable(bytes);
    const std::string_view prefix = PLAYER_IDENT_STRING;
    if (!text.starts_with(prefix)) refuse("it greets with \"" + text + '"');
    version = text.substr(prefix.size());
    if (!version.starts_with("3.")) {
      throw NoPlayerServer("the server at " + address.text() + " is Player " + version +
                           ", whose messages differ; Playpen speaks those of Player 3");
    }
  }
};

PlayerLink::PlayerLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PlayerLink::~PlayerLink() = default;

std::shared_ptr<PlayerLink> PlayerLink::open(const ServerAddress& address, Receiver& receiver,
                                             Clock::duration timeout,
                                             Clock::duration banner_timeout,
                                             const std::function<bool()>& give_up) {
  const ConnectDeadline deadline(timeout, give_up);
  auto impl = std::make_unique<Impl>(address, receiver);
  impl->timeout = timeout.count();
  connect_tcp(impl->socket, address, timeout, deadline, "is a Player server running there?");
  impl->read_banner(deadline, Clock::now() + banner_timeout);
  impl->heard = Clock::now();
  return std::shared_ptr<PlayerLink>(new PlayerLink(std::move(impl)));
}

const ServerAddress& PlayerLink::address() const noexcept { return impl_->address; }
const std::string& PlayerLink::version() const noexcept { return impl_->version; }

void PlayerLink::set_request_timeout(Clock::duration timeout) noexcept {
  impl_->timeout = timeout.count();
}
PlayerLink::Clock::duration PlayerLink::request_timeout() const noexcept {
  return impl_->request_timeout();
}

void PlayerLink::command(const player::Devaddr& device, std::uint8_t subtype,
                         std::string_view payload) {
  impl_->throw_if_lost();
  impl_->send(device, PLAYER_MSGTYPE_CMD, subtype, payload);
}

std::optional<PlayerLink::Reply> PlayerLink::request(const player::Devaddr& device,
                                                     std::uint8_t subtype,
                                                     std::string_view payload) {
  const std::lock_guard in_flight(impl_->request_mutex);
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) throw ConnectionLost(impl_->reason);
    player::Msghdr asked;
    asked.addr = device;
    asked.subtype = subtype;
    impl_->asked = asked;
    impl_->reply.reset();
  }
  std::optional<Reply> reply;
  try {
    impl_->send(device, PLAYER_MSGTYPE_REQ, subtype, payload);
    wait(Clock::now() + impl_->request_timeout(), [&] { return impl_->reply.has_value(); });
  } catch (const ConnectionLost&) {
    const std::lock_guard lock(impl_->mutex);
    impl_->asked.reset();
    throw;
  }
  const std::lock_guard lock(impl_->mutex);
  impl_->asked.reset();
  reply.swap(impl_->reply);
  return reply;
}

void PlayerLink::request_round() {
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) throw ConnectionLost(impl_->reason);
    if (std::exchange(impl_->round_requested, true)) return;
  }
  impl_->send(player_itself(), PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_REQ_DATA, {});
}

bool PlayerLink::wait(Clock::time_point deadline, const std::function<bool()>& done) {
  std::unique_lock lock(impl_->mutex);
  bool looked = false;  // whether the socket was read after the deadline
  for (;;) {
    if (done()) return true;
    if (impl_->lost) throw ConnectionLost(impl_->reason);
    const bool late = Clock::now() >= deadline;
    // Data that arrived in time count, even if this thread was scheduled late.
    if (late && std::exchange(looked, true)) return false;
    if (!impl_->led) {
      impl_->lead(lock, deadline);
    } else if (late) {
      return false;
    } else {
      impl_->changed.wait_until(lock, deadline);
    }
  }
}

void PlayerLink::wait_while_alive(const std::function<bool()>& done) {
  Clock::time_point asked{};
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->heard = std::max(impl_->heard, Clock::now());
  }
  for (;;) {
    Clock::time_point heard{};
    {
      const std::lock_guard lock(impl_->mutex);
      heard = impl_->heard;
    }
    const Clock::duration timeout = impl_->request_timeout();
    const bool has_asked = asked > heard;
    if (wait(heard + (has_asked ? timeout : timeout / 2), done)) return;
    {
      const std::lock_guard lock(impl_->mutex);
      if (impl_->heard != heard) continue;
    }
    if (has_asked) {
      impl_->lose("the server at " + impl_->address.text() + " has not answered for " +
                  seconds_text(timeout));
      continue;
    }
    asked = Clock::now();
    // Any request to the server itself would do; this one changes nothing.
    player::DeviceDatamodeReq mode;
    mode.mode = PLAYER_DATAMODE_PULL;
    impl_->send(player_itself(), PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_REQ_DATAMODE,
                player::encode(mode));
  }
}

bool PlayerLink::lost() const noexcept {
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) return true;
  }
  return is_at_end(impl_->socket.native_handle());
}

void PlayerLink::close(const std::string& reason) noexcept { impl_->lose(reason); }

}  // namespace playerlike
