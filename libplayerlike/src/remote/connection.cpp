// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

using asio::ip::tcp;
using nlohmann::json;
using protocol::Encoding;
using protocol::MessageSplitter;
using protocol::ProtocolError;
using Clock = Connection::Clock;
using std::chrono::milliseconds;

// Limit of an answer: all cells that a simulation may have, in base64.
constexpr std::size_t kAnswerLimit = std::size_t{512} << 20U;
constexpr std::size_t kRoom = std::size_t{256} << 10U;
// The id of requests whose answers are ignored.
constexpr std::uint64_t kNobody = 0;

std::string seconds_text(Clock::duration duration) {
  return sim::rounded_text(std::chrono::duration<double>(duration).count(), 6) + " s";
}

/// Waits until the socket is readable (or writable). @return false at the deadline.
bool wait_for(int socket, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
    pollfd polled{socket, events, 0};
    const int ready =
        poll(&polled, 1, static_cast<int>(std::clamp<milliseconds::rep>(left.count(), 0, 60'000)));
    if (ready > 0) return true;
    if (Clock::now() >= deadline) return false;
  }
}

/// A deadline for the whole attempt to connect.
class Deadline {
 public:
  Deadline(Clock::duration timeout, const std::function<bool()>& give_up)
      : end_(Clock::now() + timeout), give_up_(give_up) {}
  [[nodiscard]] Clock::time_point end() const noexcept { return end_; }
  /// Waits until `ready(until)` is true. @param share  the wait may use 1/share of the time left.
  template <typename Ready>
  [[nodiscard]] bool wait(Ready ready, std::size_t share = 1) const {
    const auto now = Clock::now();
    const auto end = now + (end_ - now) / static_cast<Clock::rep>(share);
    for (;;) {
      if (give_up_ && give_up_()) return false;
      if (ready(std::min(end, Clock::now() + milliseconds(50)))) return true;
      if (Clock::now() >= end) return false;
    }
  }

 private:
  Clock::time_point end_;
  const std::function<bool()>& give_up_;
};

[[noreturn]] void fail_to_connect(const ServerAddress& address, const std::string& why) {
  throw SessionError(SessionError::Code::kDisconnected,
                     "cannot connect to " + address.text() + ": " + why);
}

/// Resolves a host name.
std::vector<asio::ip::address> look_up(const ServerAddress& server, Clock::duration timeout,
                                       const Deadline& deadline) {
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
  const bool done = deadline.wait([&](Clock::time_point until) {
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
std::optional<std::string> connect(tcp::socket& socket, const tcp::endpoint& endpoint,
                                   const Deadline& deadline, std::size_t share) {
  asio::error_code error;
  socket.open(endpoint.protocol(), error);
  if (!error) socket.non_blocking(true, error);
  if (!error) {
    socket.connect(endpoint, error);
    if (error == asio::error::in_progress || error == asio::error::would_block) {
      const int handle = socket.native_handle();
      const bool done = deadline.wait(
          [&](Clock::time_point until) { return wait_for(handle, POLLOUT, until); }, share);
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
    return "connection refused: is `playpen serve` running there?";
  }
  return error.message();
}

/// A message's text member; `otherwise` if it is missing or not a text.
std::string text_or(const json& message, const char* key, const std::string& otherwise) {
  if (!message.is_object()) return otherwise;
  const auto text = message.find(key);
  return text != message.end() && text->is_string() ? text->get<std::string>() : otherwise;
}

/// Converts an error answer to a SessionError.
SessionError error_of(const json& message) {
  const std::string id = text_or(message, "error", "");
  const std::string text = text_or(message, "message", id);
  if (const auto code = protocol::session_error_code(id)) return {*code, text};
  // The server's checks are stricter than the client library's in a few cases.
  const bool bad = id == "protocol/bad-value" || id == "protocol/number";
  return {bad ? SessionError::Code::kBadArgument : SessionError::Code::kNotAvailable,
          text + " [" + id + ']'};
}

bool is_error(const json& message) {
  const auto error = message.find("error");
  return error != message.end() && error->is_string();
}

}  // namespace

struct Connection::Impl {
  struct Slot {
    std::optional<json> answer;
  };

  explicit Impl(ServerAddress server) : address(std::move(server)) {}

  const ServerAddress address;
  asio::io_context context;
  tcp::socket socket{context};
  Encoding encoding = Encoding::kJson;
  MessageSplitter splitter{Encoding::kJson, kAnswerLimit};  // used by the leader only
  json welcome;
  std::size_t message_limit = 0;
  std::atomic<Clock::rep> timeout{};

  std::mutex send_mutex;  // guards writes to the socket; never locked while `mutex` is held

  std::mutex mutex;  // guards the members below
  std::condition_variable changed;
  std::uint64_t next_id = kNobody + 1;
  std::map<std::uint64_t, Slot> slots;
  bool led = false;   // a leader is reading the socket
  int followers = 0;  // threads that wait for the leader
  Clock::time_point heard{};
  Clock::time_point asked{};  // when the server was last asked for a sign of life
  std::optional<SessionError> async_error;
  std::string bye_message;  // the server's last message
  bool lost = false;
  std::string reason;

  [[nodiscard]] Clock::duration request_timeout() const { return Clock::duration(timeout.load()); }

  void lose(const std::string& why) noexcept {
    {
      const std::lock_guard lock(mutex);
      if (lost) return;
      lost = true;
      reason = bye_message.empty()
                   ? why
                   : "the server at " + address.text() + " has ended: " + bye_message;
    }
    // Not closed: another thread may be polling it.
    ::shutdown(socket.native_handle(), SHUT_RDWR);
    changed.notify_all();
  }

  [[noreturn]] void throw_lost() {
    const std::lock_guard lock(mutex);
    throw ConnectionLost(reason);
  }

  std::string problem_text(const asio::error_code& error) const {
    if (error == asio::error::eof) {
      return "the server at " + address.text() + " has closed the connection";
    }
    return "the connection to " + address.text() + " is lost: " + error.message();
  }

  void send(std::string_view bytes) {
    std::unique_lock lock(send_mutex);
    const auto deadline = Clock::now() + request_timeout();
    std::string problem;
    while (!bytes.empty() && problem.empty()) {
      asio::error_code error;
      const std::size_t count = socket.write_some(asio::buffer(bytes), error);
      bytes.remove_prefix(count);
      if (error == asio::error::would_block || error == asio::error::try_again) {
        if (!wait_for(socket.native_handle(), POLLOUT, deadline)) {
          problem = "the server at " + address.text() + " has taken nothing for " +
                    seconds_text(request_timeout());
        }
      } else if (error && error != asio::error::interrupted) {
        problem = problem_text(error);
      }
    }
    lock.unlock();
    if (problem.empty()) return;
    lose(problem);
    throw_lost();
  }

  /// Reads once if data arrive before the deadline. Only the leader may call it.
  std::vector<json> receive(Clock::time_point deadline) {
    std::vector<json> messages;
    const auto take = [&] {
      while (const auto message = splitter.next()) {
        messages.push_back(protocol::decode(*message, encoding));
      }
    };
    take();  // messages that arrived together with the answer to hello
    if (!messages.empty() || !wait_for(socket.native_handle(), POLLIN, deadline)) return messages;
    const std::span<char> room = splitter.room(kRoom);
    asio::error_code error;
    const std::size_t count = socket.read_some(asio::buffer(room.data(), room.size()), error);
    if (error == asio::error::would_block || error == asio::error::try_again ||
        error == asio::error::interrupted) {
      return messages;
    }
    if (error) throw ConnectionLost(problem_text(error));
    splitter.added(count);
    {
      const std::lock_guard lock(mutex);
      heard = Clock::now();
    }
    take();
    return messages;
  }

  /// Whether the socket has data to read.
  [[nodiscard]] bool has_unread() {
    pollfd polled{socket.native_handle(), POLLIN, 0};
    return poll(&polled, 1, 0) > 0;
  }

  /// Reads the socket once as the leader; `lock` is held before and after.
  void lead(std::unique_lock<std::mutex>& lock, Clock::time_point deadline) {
    led = true;
    lock.unlock();
    std::vector<json> messages;
    std::string problem;
    try {
      messages = receive(deadline);
    } catch (const ConnectionLost& e) {
      problem = e.what();
    } catch (const std::exception& e) {
      problem = "the server at " + address.text() +
                " has sent what is no message of Playpen's protocol: " + e.what();
    }
    lock.lock();
    led = false;
    for (json& message : messages) hand_over(std::move(message));
    if (followers > 0) changed.notify_all();
    if (problem.empty()) return;
    lock.unlock();
    lose(problem);
    lock.lock();
  }

  void hand_over(json message) {
    const auto id = message.find("id");
    if (id != message.end() && id->is_number_unsigned()) {
      const auto slot = slots.find(id->get<std::uint64_t>());
      if (slot != slots.end()) slot->second.answer = std::move(message);
      return;
    }
    const std::string event = text_or(message, "event", "");
    if (event == "error" && !async_error) async_error = error_of(message);
    if (event == "bye") bye_message = text_or(message, "message", "good-bye");
  }

  /// Sends hello on the new connection and checks the answer. @throws SessionError.
  void say_hello(const json& hello, const Deadline& deadline) {
    const auto no_playpen = [&](const std::string& what) {
      fail_to_connect(address, "there is no Playpen server: " + what);
    };
    send("1 playpen hello [" + hello.dump(-1, ' ', false, json::error_handler_t::replace) + "]\n");
    std::string line;
    const bool done = deadline.wait([&](Clock::time_point until) {
      if (!wait_for(socket.native_handle(), POLLIN, until)) return false;
      const std::span<char> room = splitter.room(kRoom);
      asio::error_code error;
      const std::size_t count = socket.read_some(asio::buffer(room.data(), room.size()), error);
      if (error == asio::error::would_block || error == asio::error::interrupted) return false;
      if (error) fail_to_connect(address, problem_text(error));
      splitter.added(count);
      const auto message = splitter.next();
      if (message) line = *message;
      return message.has_value();
    });
    if (!done) no_playpen("it does not answer");
    constexpr std::string_view kSuccess = "1 SUCCESS ";
    constexpr std::string_view kFailed = "1 FAILED ";
    const std::string shown = line.substr(0, 80);
    try {
      if (line.starts_with(kFailed)) {
        const json error =
            protocol::decode_json_value(std::string_view(line).substr(kFailed.size()));
        if (!is_error(error)) no_playpen("it answers \"" + shown + '"');
        const SessionError refusal = error_of(error);
        throw SessionError(refusal.code(), address.text() + " refuses: " + refusal.what());
      }
      if (!line.starts_with(kSuccess)) no_playpen("it answers \"" + shown + '"');
      welcome = protocol::decode_json_value(std::string_view(line).substr(kSuccess.size()));
      const auto chosen = protocol::parse_encoding(protocol::require_text(welcome, "encoding"));
      if (!chosen) no_playpen("it chooses an unknown encoding");
      encoding = *chosen;
      splitter.set_encoding(encoding);
      constexpr std::int64_t kMost = std::int64_t{1} << 40U;
      message_limit = static_cast<std::size_t>(protocol::require_integer(
          protocol::require(welcome, "limits"), "message_bytes", 1024, kMost));
    } catch (const ProtocolError& e) {
      no_playpen(e.what());
    }
  }
};

Connection::Connection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Connection::~Connection() = default;

std::shared_ptr<Connection> Connection::open(const ServerAddress& address, const json& hello,
                                             Clock::duration timeout,
                                             const std::function<bool()>& give_up) {
  const Deadline deadline(timeout, give_up);
  const auto hosts = look_up(address, timeout, deadline);
  auto impl = std::make_unique<Impl>(address);
  impl->timeout = timeout.count();
  std::string reasons;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    const tcp::endpoint endpoint(hosts[i], static_cast<asio::ip::port_type>(address.tcp_port));
    // Each remaining address gets an equal share of the time left.
    const auto problem = connect(impl->socket, endpoint, deadline, hosts.size() - i);
    if (!problem) {
      impl->say_hello(hello, deadline);
      return std::shared_ptr<Connection>(new Connection(std::move(impl)));
    }
    asio::error_code ignored;
    impl->socket.close(ignored);
    if (reasons.find(*problem) != std::string::npos) continue;
    reasons += (reasons.empty() ? "" : "; ") + *problem;
  }
  fail_to_connect(address, reasons);
}

const json& Connection::welcome() const noexcept { return impl_->welcome; }
Encoding Connection::encoding() const noexcept { return impl_->encoding; }
std::size_t Connection::message_limit() const noexcept { return impl_->message_limit; }

void Connection::set_request_timeout(Clock::duration timeout) noexcept {
  impl_->timeout = timeout.count();
}

std::uint64_t Connection::ask(json& request, std::string before) {
  std::uint64_t id = 0;
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) throw ConnectionLost(impl_->reason);
    id = impl_->next_id++;
    impl_->slots.emplace(id, Impl::Slot{});
  }
  try {
    request["id"] = id;
    before += protocol::encode(request, impl_->encoding);
    impl_->send(before);
  } catch (...) {
    const std::lock_guard lock(impl_->mutex);
    impl_->slots.erase(id);
    throw;
  }
  return id;
}

json Connection::answer(std::uint64_t id, WaitPolicy policy,
                        std::optional<Clock::duration> at_most) {
  Impl& c = *impl_;
  std::unique_lock lock(c.mutex);
  const auto began = Clock::now();
  c.heard = std::max(c.heard, began);
  const auto slot = c.slots.find(id);
  bool looked = false;  // whether the splitter was searched after the time limit
  for (;;) {
    if (slot->second.answer) {
      json answer = std::move(*slot->second.answer);
      c.slots.erase(slot);
      if (is_error(answer)) throw error_of(answer);
      return answer;
    }
    if (c.lost) {
      c.slots.erase(slot);
      throw ConnectionLost(c.reason);
    }
    const auto timeout = std::min(c.request_timeout(), at_most.value_or(Clock::duration::max()));
    const bool living = policy == WaitPolicy::kWhileAlive;
    const auto limit = (living ? c.heard : began) + timeout;
    const auto now = Clock::now();
    // Data that arrived in time count, even if this thread was scheduled late.
    if (now >= limit && now < limit + std::max<Clock::duration>(timeout, milliseconds(1000)) &&
        (c.has_unread() || !std::exchange(looked, true))) {
      if (!c.led) {
        c.lead(lock, now);
      } else {
        ++c.followers;
        c.changed.wait_for(lock, milliseconds(10));
        --c.followers;
      }
      continue;
    }
    if (now >= limit) {
      lock.unlock();
      c.lose("the server at " + c.address.text() + " has not answered for " +
             seconds_text(timeout));
      lock.lock();
      continue;
    }
    auto wake = limit;
    if (living && c.asked <= c.heard) {
      const auto next = c.heard + timeout / 2;
      if (now >= next) {
        c.asked = now;
        lock.unlock();
        const std::string question =
            protocol::encode(json{{"id", kNobody}, {"do", "time"}}, c.encoding);
        try {
          c.send(question);
        } catch (const ConnectionLost&) {
          // The start of the loop handles it.
        }
        lock.lock();
        continue;
      }
      wake = next;
    }
    if (!c.led) {
      c.lead(lock, wake);
    } else {
      ++c.followers;
      c.changed.wait_until(lock, wake);
      --c.followers;
    }
  }
}

void Connection::tell(std::string_view bytes) {
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) throw ConnectionLost(impl_->reason);
  }
  impl_->send(bytes);
}

std::optional<SessionError> Connection::async_error() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->async_error, std::nullopt);
}

bool Connection::lost() const noexcept {
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) return true;
  }
  char byte = 0;
  const ssize_t count = recv(impl_->socket.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0;
}

void Connection::close(const std::string& reason) noexcept { impl_->lose(reason); }

}  // namespace playerlike
