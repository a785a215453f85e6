// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <asio/io_context.hpp>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

#include "process/debugger.h"
#include "process/local_process.h"
#include "process/short_wait.h"
#include "protocol/codec.h"

namespace playerlike {
namespace {

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

/// Whether a wait has ended so late that the process was stopped meanwhile.
bool is_much_later(Clock::time_point now, Clock::time_point planned, Clock::duration limit) {
  return now - planned > std::max<Clock::duration>(limit / 4, milliseconds(250));
}

bool is_error(const json& message) {
  const auto error = message.find("error");
  return error != message.end() && error->is_string();
}

}  // namespace

struct Connection::Impl {
  struct Slot {
    Clock::time_point asked;
    std::optional<json> answer;
  };

  explicit Impl(ServerAddress server) : address(std::move(server)) {}

  const ServerAddress address;
  asio::io_context context;
  StreamSocket socket{context};
  Encoding encoding = Encoding::kJson;
  MessageSplitter splitter{Encoding::kJson, kAnswerLimit};  // used by the leader only
  json welcome;
  std::size_t message_limit = 0;
  std::atomic<Clock::rep> timeout{};
  std::atomic<bool> expects_soon{false};
  ShortWait short_wait;  // used by the leader only

  std::mutex send_mutex;  // guards writes to the socket; never locked while `mutex` is held

  std::mutex mutex;  // guards the members below
  std::condition_variable changed;
  std::uint64_t next_id = kNobody + 1;
  std::map<std::uint64_t, Slot> slots;
  bool led = false;   // a leader is reading the socket
  int followers = 0;  // threads that wait for the leader
  Clock::time_point heard{};
  Clock::time_point asked{};          // when the server was last asked for a sign of life
  Clock::time_point excused_until{};  // by a debugger: no limit ends earlier
  std::optional<int> server_process;  // on this machine; 0: elsewhere
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

  void send(std::string_view bytes) {
    std::unique_lock lock(send_mutex);
    const std::string problem = write_all(socket, address, bytes, request_timeout());
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
        messages.push_back(protocol::decode(*message, encoding, nullptr, "readings"));
      }
    };
    take();  // messages that arrived together with the answer to hello
    if (!messages.empty()) return messages;
    std::size_t count = 0;
    const auto read = [&] {
      count = read_some(socket, address, splitter.room(kRoom));
      return count > 0;
    };
    if (!(expects_soon && short_wait.look(read))) {
      if (!wait_for_socket(socket.native_handle(), POLLIN, deadline) || !read()) return messages;
    }
    splitter.added(count);
    {
      const std::lock_guard lock(mutex);
      heard = Clock::now();
    }
    take();
    return messages;
  }

  /// Whether this process or the server's is under a debugger now. `mutex` is held.
  [[nodiscard]] bool is_debugged() {
    if (tracer_of(0) != 0) return true;
    if (!server_process) server_process = peer_process(socket.native_handle()).value_or(0);
    return *server_process != 0 && tracer_of(*server_process) != 0;
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

  /// Waits for an answer, see Connection::answer().
  /// @param give_up  returns nullopt if there is none by then.
  std::optional<json> answer(std::uint64_t id, WaitPolicy policy,
                             std::optional<Clock::duration> at_most,
                             std::optional<Clock::time_point> give_up);

  /// Sends hello on the new connection and checks the answer. @throws SessionError.
  void say_hello(const json& hello, const ConnectDeadline& deadline) {
    const auto no_playpen = [&](const std::string& what) {
      fail_to_connect(address, "there is no Playpen server: " + what);
    };
    send("1 playpen hello [" + hello.dump(-1, ' ', false, json::error_handler_t::replace) + "]\n");
    std::string line;
    const bool done = deadline.wait([&](Clock::time_point until) {
      if (!wait_for_socket(socket.native_handle(), POLLIN, until)) return false;
      std::size_t count = 0;
      try {
        count = read_some(socket, address, splitter.room(kRoom));
      } catch (const ConnectionLost& e) {
        fail_to_connect(address, e.what());
      }
      if (count == 0) return false;
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
  const ConnectDeadline deadline(timeout, give_up);
  auto impl = std::make_unique<Impl>(address);
  impl->timeout = timeout.count();
  if (address.is_local()) {
    connect_local(impl->socket, address);
  } else {
    connect_tcp(impl->socket, address, timeout, deadline, "is `playpen serve` running there?");
  }
  impl->say_hello(hello, deadline);
  return std::shared_ptr<Connection>(new Connection(std::move(impl)));
}

const json& Connection::welcome() const noexcept { return impl_->welcome; }
Encoding Connection::encoding() const noexcept { return impl_->encoding; }
std::size_t Connection::message_limit() const noexcept { return impl_->message_limit; }

void Connection::expect_soon(bool soon) noexcept { impl_->expects_soon = soon; }

void Connection::set_request_timeout(Clock::duration timeout) noexcept {
  impl_->timeout = timeout.count();
}

std::uint64_t Connection::ask(json& request, std::string& bytes) {
  std::uint64_t id = 0;
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->lost) throw ConnectionLost(impl_->reason);
    id = impl_->next_id++;
    impl_->slots.emplace(id, Impl::Slot{Clock::now(), std::nullopt});
  }
  try {
    request["id"] = id;
    protocol::append_encoded(request, impl_->encoding, bytes);
    impl_->send(bytes);
  } catch (...) {
    const std::lock_guard lock(impl_->mutex);
    impl_->slots.erase(id);
    throw;
  }
  return id;
}

json Connection::answer(std::uint64_t id, WaitPolicy policy,
                        std::optional<Clock::duration> at_most) {
  return *impl_->answer(id, policy, at_most, std::nullopt);
}

std::optional<json> Connection::answer_within(std::uint64_t id, Clock::duration at_most) {
  return impl_->answer(id, WaitPolicy::kWhileAlive, std::nullopt, Clock::now() + at_most);
}

std::optional<json> Connection::Impl::answer(std::uint64_t id, WaitPolicy policy,
                                             std::optional<Clock::duration> at_most,
                                             std::optional<Clock::time_point> give_up) {
  Impl& c = *this;
  std::unique_lock lock(c.mutex);
  const auto slot = c.slots.find(id);
  const auto began = slot->second.asked;
  c.heard = std::max(c.heard, began);
  bool looked = false;          // whether the splitter was searched after the time limit
  auto planned = Clock::now();  // end of the last wait
  for (;;) {
    if (slot->second.answer) {
      json found = std::move(*slot->second.answer);
      c.slots.erase(slot);
      if (is_error(found)) throw error_of(found);
      return found;
    }
    if (c.lost) {
      c.slots.erase(slot);
      throw ConnectionLost(c.reason);
    }
    const auto longest = std::min(c.request_timeout(), at_most.value_or(Clock::duration::max()));
    const bool living = policy == WaitPolicy::kWhileAlive;
    const auto limit = std::max((living ? c.heard : began) + longest, c.excused_until);
    const auto now = Clock::now();
    const bool was_stopped = is_much_later(now, std::exchange(planned, now), longest);
    // Looked for from half of the limit on: so much is left when a debugger leaves a process.
    const auto half = limit - longest / 2;
    if (!at_most && (was_stopped || (now >= half && c.is_debugged()))) {
      c.excused_until = now + longest;
      continue;
    }
    // Data that arrived in time count, even if this thread was scheduled late.
    if (now >= limit && now < limit + std::max<Clock::duration>(longest, milliseconds(1000)) &&
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
             seconds_text(longest));
      lock.lock();
      continue;
    }
    if (give_up && now >= *give_up) return std::nullopt;
    auto wake = std::min(now < half ? half : limit, give_up.value_or(limit));
    if (living && c.asked <= c.heard) {
      const auto next = c.heard + longest / 2;
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
      wake = std::min(wake, next);
    }
    planned = wake;
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
  return is_at_end(impl_->socket.native_handle());
}

void Connection::close(const std::string& reason) noexcept { impl_->lose(reason); }

}  // namespace playerlike
