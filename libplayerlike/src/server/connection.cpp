// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <asio/buffer.hpp>
#include <asio/error.hpp>
#include <asio/post.hpp>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include "process/debugger.h"
#include "process/local_process.h"
#include "sim/core/number_text.h"

namespace playerlike::server {
namespace {

constexpr std::size_t kSmallestRoom = std::size_t{8} << 10U;
constexpr std::size_t kLargestRoom = std::size_t{256} << 10U;
// Messages that are handled before other connections get a turn.
constexpr int kMessagesATurn = 64;
// Maximum number of buffers in one system call.
constexpr std::size_t kBuffersAWrite = 64;
// Time from the decision to close to the forced end, for a peer that reads the farewell slowly or
// not at all.
constexpr auto kCloseTime = std::chrono::seconds(2);

Connection::Clock::duration wall(double seconds) {
  return std::chrono::duration_cast<Connection::Clock::duration>(
      std::chrono::duration<double>(seconds));
}

std::string seconds_text(double seconds) { return sim::rounded_text(seconds, 6) + " s"; }

std::string bytes_text(std::uint64_t bytes) {
  if (bytes < 10'000) return std::to_string(bytes) + " bytes";
  if (bytes < 10'000'000) return sim::fixed_text(static_cast<double>(bytes) / 1e3, 0) + " kB";
  return sim::fixed_text(static_cast<double>(bytes) / 1e6, 0) + " MB";
}

}  // namespace

Connection::Connection(asio::generic::stream_protocol::socket socket, std::string name,
                       ConnectionOwner& owner)
    : socket_(std::move(socket)),
      name_(std::move(name)),
      owner_(owner),
      splitter_(protocol::Encoding::kJson, owner.limits().message_bytes),
      room_(kSmallestRoom) {}

void Connection::start(std::unique_ptr<Handler> handler) {
  handler_ = std::move(handler);
  read();
}

void Connection::refuse(std::string farewell) {
  refused_ = true;
  close(std::move(farewell), "refused");
}

void Connection::hand_over(std::unique_ptr<Handler> handler) {
  if (state_ != State::kOpen) return;
  next_handler_ = std::move(handler);
  // Outside of on_message() the old handler may be the caller, so it is replaced later.
  if (!processing_) process_soon();
}

// --- Reading

bool Connection::paused() const {
  const ServerLimits& limits = owner_.limits();
  return busy_ || in_flight_ >= limits.requests_in_flight ||
         queued_bytes_ > limits.queued_bytes / 2;
}

void Connection::read() {
  if (reading_ || state_ == State::kEnded || peer_left_) return;
  if (state_ == State::kOpen && (processing_ || process_posted_ || paused())) return;
  reading_ = true;
  reading_bytes_ = state_ != State::kOpen || handler_->takes_bytes();
  asio::mutable_buffer buffer = asio::buffer(scratch_);
  if (!reading_bytes_) {
    const auto room = splitter_.room(room_);
    buffer = asio::buffer(room.data(), room.size());
  }
  socket_.async_read_some(
      buffer, [self = shared_from_this()](const asio::error_code& error, std::size_t size) {
        self->reading_ = false;
        self->on_read(error, size);
      });
}

void Connection::on_read(const asio::error_code& error, std::size_t size) {
  if (state_ == State::kEnded) return;
  if (error) {
    peer_left_ = true;
    if (error != asio::error::eof) return end("the connection was lost: " + error.message());
    if (write_ended_) return end(reason_);
    return close("", "it left");  // answers that are queued are still sent
  }
  if (state_ == State::kClosing) return read();
  bytes_in_ += size;
  if (reading_bytes_) {
    guarded([&] { handler_->on_message(std::string_view(scratch_.data(), size)); });
    ++requests_;
    return read();
  }
  splitter_.added(size);
  const std::uint64_t bytes_out_before = bytes_out_;
  if (size >= room_) room_ = std::min(room_ * 2, kLargestRoom);
  process();
  // Linux acknowledges at once for a while only, so the option is set again. What was written has
  // acknowledged already.
  if (acknowledges_at_once_ && bytes_out_ == bytes_out_before && state_ != State::kEnded) {
    const int on = 1;
    setsockopt(socket_.native_handle(), IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
  }
}

// Runs an action of a handler. If it throws, the connection is closed; the others are not affected.
template <typename Action>
void Connection::guarded(Action action) {
  try {
    action();
  } catch (const protocol::ProtocolError& error) {
    fail(error);
  } catch (const std::exception& error) {
    owner_.log(sim::LogLevel::kError, name_ + ": " + error.what());
    fail(protocol::ProtocolError("server/internal", error.what()));
  }
}

void Connection::process() {
  process_posted_ = false;
  if (processing_ || state_ != State::kOpen) return;
  if (next_handler_) handler_ = std::move(next_handler_);
  // An asynchronous read owns the splitter's room. All earlier bytes have been processed.
  if (reading_) return;
  processing_ = true;
  const std::uint64_t requests_before = requests_;
  bool more = true;
  for (int i = 0; i < kMessagesATurn && more; ++i) {
    more = false;
    guarded([&] { more = process_one(); });
    if (next_handler_) handler_ = std::move(next_handler_);
    more = more && state_ == State::kOpen;
  }
  processing_ = false;
  if (more) process_soon();
  const Clock::time_point now = Clock::now();
  if (requests_ > requests_before) last_request_ = now;
  if (paused() || !splitter_.partial()) {
    partial_since_.reset();
  } else if (!partial_since_) {
    partial_since_ = now;
  }
  flush();
  read();
}

bool Connection::process_one() {
  if (paused()) return false;
  const auto message = splitter_.next();
  if (!message) return false;
  ++requests_;
  partial_since_.reset();
  handler_->on_message(*message);
  return true;
}

void Connection::process_soon() {
  if (process_posted_) return;
  process_posted_ = true;
  post(&Connection::process);
}

void Connection::set_in_flight(std::size_t requests) {
  const bool was_paused = paused();
  if (requests < in_flight_ && owner_.limits().idle_s > 0.0) last_request_ = Clock::now();
  in_flight_ = requests;
  if (was_paused && !paused() && !processing_ && !reading_) process_soon();
}

void Connection::set_busy(bool busy) {
  const bool was_paused = paused();
  if (busy_ && !busy && owner_.limits().idle_s > 0.0) last_request_ = Clock::now();
  busy_ = busy;
  if (was_paused && !paused() && !processing_ && !reading_) process_soon();
}

std::optional<std::uint64_t> Connection::settled_input() const {
  if (state_ != State::kOpen || paused()) return bytes_in_;
  asio::error_code error;
  if (process_posted_ || (reading_ && socket_.available(error) > 0)) return std::nullopt;
  return bytes_in_;
}

std::optional<int> Connection::local_process() {
  return socket_.is_open() ? peer_process(socket_.native_handle()) : std::nullopt;
}

std::function<std::optional<int>()> Connection::process_search() {
  return socket_.is_open() ? peer_process_search(socket_.native_handle())
                           : std::function<std::optional<int>()>();
}

std::uint32_t Connection::own_ipv4() { return own_ipv4_of(socket_.native_handle()); }

// --- Writing

void Connection::push(Item item) {
  queued_bytes_ += item.bytes().size();
  queue_.push_back(std::move(item));
}

void Connection::send(std::string bytes) {
  if (state_ != State::kOpen || bytes.empty()) return;
  if (queued_bytes_ > owner_.limits().queued_bytes) {
    return fail(protocol::ProtocolError(
        "server/slow-reader", "more than " + std::to_string(owner_.limits().queued_bytes) +
                                  " bytes wait to be read by this client"));
  }
  push({std::move(bytes), nullptr});
  if (!processing_) flush();
}

bool Connection::send_record(std::shared_ptr<const std::string> bytes) {
  if (state_ != State::kOpen) return false;
  if (queued_bytes_ > 0 && queued_bytes_ + bytes->size() > owner_.limits().queued_bytes) {
    ++records_lost_;
    return false;
  }
  push({"", std::move(bytes)});
  if (!processing_) flush();
  return true;
}

void Connection::flush() {
  if (writing_ || processing_ || state_ == State::kEnded) return;
  const bool was_paused = paused();
  if (!write_some()) {
    writing_ = true;
    socket_.async_wait(asio::socket_base::wait_write,
                       [self = shared_from_this()](const asio::error_code& error) {
                         self->writing_ = false;
                         if (!error) self->flush();
                       });
  }
  if (state_ == State::kClosing && queue_.empty()) close_when_read();
  if (was_paused && state_ == State::kOpen && !paused() && !reading_) process_soon();
}

bool Connection::write_some() {
  std::vector<asio::const_buffer> buffers;
  buffers.reserve(std::min(queue_.size(), kBuffersAWrite));
  while (!queue_.empty()) {
    buffers.clear();
    std::size_t total = 0;
    for (const Item& item : queue_) {
      if (buffers.size() == kBuffersAWrite) break;
      buffers.emplace_back(asio::buffer(item.bytes()));
      if (&item == &queue_.front()) buffers.front() += queue_begin_;
      total += buffers.back().size();
    }
    asio::error_code error;
    const std::size_t size = socket_.write_some(buffers, error);
    if (error == asio::error::would_block || error == asio::error::try_again) return false;
    if (error) {
      end(peer_left_ ? reason_ : "the connection was lost: " + error.message());
      return true;
    }
    written(size);
    if (size < total) return false;
  }
  return true;
}

void Connection::written(std::size_t size) {
  bytes_out_ += size;
  queued_bytes_ -= size;
  queue_begin_ += size;
  while (!queue_.empty() && queue_begin_ >= queue_.front().bytes().size()) {
    queue_begin_ -= queue_.front().bytes().size();
    queue_.pop_front();
  }
}

// --- The end

void Connection::fail(const protocol::ProtocolError& error) {
  if (state_ != State::kOpen) return;
  // Drop queued items that have not been started: they would only delay the reason.
  if (queued_bytes_ > owner_.limits().queued_bytes) {
    const std::size_t kept = queue_begin_ > 0 ? 1 : 0;
    queue_.resize(kept);
    queued_bytes_ = kept == 0 ? 0 : queue_.front().bytes().size() - queue_begin_;
  }
  std::string farewell;
  try {
    if (handler_) farewell = handler_->farewell(error);
  } catch (const std::exception& e) {
    owner_.log(sim::LogLevel::kError, name_ + ": " + e.what());
  }
  close(std::move(farewell), std::string(error.what()) + " [" + error.id() + "]");
}

void Connection::close(std::string farewell) { close(std::move(farewell), "the server closed it"); }

void Connection::close(std::string farewell, std::string reason) {
  if (state_ != State::kOpen) return;
  state_ = State::kClosing;
  reason_ = std::move(reason);
  close_deadline_ = Clock::now() + kCloseTime;
  if (!farewell.empty()) push({std::move(farewell), nullptr});
  post(&Connection::drop_handler);
  flush();
}

// If the socket were closed while the peer still sends, the system would discard data that the peer
// has not read yet. So only the sending direction is shut down. The connection is read until the
// peer closes it or the time is over.
void Connection::close_when_read() {
  if (write_ended_) return;
  if (peer_left_) return end(reason_);
  write_ended_ = true;
  asio::error_code error;
  socket_.shutdown(asio::socket_base::shutdown_send, error);
  if (error) return end(reason_);
  read();
}

void Connection::end(std::string reason) {
  if (state_ == State::kEnded) return;
  state_ = State::kEnded;
  if (reason_.empty()) reason_ = std::move(reason);
  asio::error_code ignored;
  socket_.close(ignored);
  post(&Connection::forget);
}

void Connection::forget() {
  drop_handler();
  owner_.ended(*this);
}

void Connection::drop_handler() {
  if (!handler_ && !next_handler_) return;
  handler_.reset();
  next_handler_.reset();
  queue_.shrink_to_fit();
  owner_.handler_gone();
}

void Connection::post(void (Connection::*member)()) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), member] { ((*self).*member)(); });
}

void Connection::hurry(Clock::time_point deadline) {
  if (state_ == State::kClosing) close_deadline_ = std::min(*close_deadline_, deadline);
}

void Connection::enforce_limits(Clock::time_point now) {
  if (state_ == State::kClosing && now >= *close_deadline_) end(reason_);
  if (state_ != State::kOpen) return;
  if (!reading_) {
    if (process_posted_ || queued_bytes_ > 0) return;
    // Reading is paused because too many requests are in flight, so only poll() shows that the peer
    // has left.
    pollfd state{socket_.native_handle(), POLLRDHUP, 0};
    if (poll(&state, 1, 0) > 0) {
      peer_left_ = true;
      close("", "it left");
    }
    return;
  }
  const ServerLimits& limits = owner_.limits();
  const auto too_late = [&](Clock::time_point since, double limit_s) {
    return limit_s > 0.0 && now - std::max(since, debugged_at_) >= wall(limit_s);
  };
  const bool partial_too_late =
      partial_since_ && too_late(*partial_since_, limits.partial_request_s);
  const bool first_too_late = requests_ == 0 && too_late(opened_, limits.first_request_s) &&
                              !handler_->takes_bytes() && !handler_->may_be_silent();
  if ((partial_too_late || first_too_late) && is_debugged()) {
    debugged_at_ = now;
    return;
  }
  if (partial_too_late) {
    return fail(protocol::ProtocolError(
        "server/partial-request",
        "a request was not complete within " + seconds_text(limits.partial_request_s)));
  }
  if (handler_->takes_bytes() || handler_->may_be_silent()) return;
  if (first_too_late) {
    return fail(protocol::ProtocolError(
        "server/first-request", "no request came within " + seconds_text(limits.first_request_s)));
  }
  if (in_flight_ == 0 && requests_ > 0 && too_late(last_request_, limits.idle_s)) {
    fail(protocol::ProtocolError("server/idle", "no request for " + seconds_text(limits.idle_s)));
  }
}

// Under a debugger a program may stand in the middle of a request.
bool Connection::is_debugged() {
  const std::optional<int> process = local_process();
  return tracer_of(0) != 0 || (process && tracer_of(*process) != 0);
}

std::string Connection::summary() const {
  const std::string time =
      sim::fixed_text(std::chrono::duration<double>(Clock::now() - opened_).count(), 1) + " s";
  constexpr std::size_t kLongest = 200;
  std::string text = name_ +
                     (description_.empty() ? "" : " (" + description_.substr(0, kLongest) + ')') +
                     ": closed after " + time + ": " + reason_.substr(0, kLongest) + "; " +
                     std::to_string(requests_) + (requests_ == 1 ? " request, " : " requests, ") +
                     bytes_text(bytes_in_) + " in, " + bytes_text(bytes_out_) + " out";
  if (records_lost_ > 0) text += ", " + std::to_string(records_lost_) + " records lost";
  // Parts of the text come from the client; control characters could forge lines of the log.
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

}  // namespace playerlike::server
