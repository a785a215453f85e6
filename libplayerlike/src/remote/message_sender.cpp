// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/message_sender.h"

#include <algorithm>
#include <map>
#include <utility>

#include "protocol/codec.h"

namespace playerlike {
namespace {

using nlohmann::json;
using protocol::Encoding;
using std::chrono::milliseconds;

// Period of the flusher: in a paced simulation a drawing waits at most twice this long.
constexpr milliseconds kFlushPeriod(20);
// How long to wait for the server's good-bye.
constexpr milliseconds kGoodBye(1000);
// More bytes than this are not held back.
constexpr std::size_t kMostHeldBack = std::size_t{32} << 10U;
// Maximum size of a `draw` message without its drawings, and of one drawing [bytes].
constexpr std::size_t kCallOverhead = 256;
constexpr std::size_t drawing_bytes(Encoding encoding) {
  return encoding == Encoding::kCbor ? 28 : 96;
}

}  // namespace

// --- RemoteSimulation

std::shared_ptr<RemoteSimulation> RemoteSimulation::of(const std::string& name) {
  // Never destroyed: clients at namespace scope may outlive any static object.
  struct Known {
    std::mutex mutex;
    std::map<std::string, std::weak_ptr<RemoteSimulation>> simulations;
  };
  static auto* known = new Known;
  const std::lock_guard lock(known->mutex);
  std::erase_if(known->simulations, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<RemoteSimulation>& entry = known->simulations[name];
  std::shared_ptr<RemoteSimulation> simulation = entry.lock();
  if (!simulation) entry = simulation = std::make_shared<RemoteSimulation>();
  return simulation;
}

std::shared_ptr<RemoteClock> RemoteSimulation::clock_or(
    const std::function<std::shared_ptr<RemoteClock>()>& make) {
  const std::lock_guard lock(mutex_);
  if (!clock_) clock_ = make();
  return clock_;
}

void RemoteSimulation::add(const std::shared_ptr<MessageSender>& sender) {
  const std::lock_guard lock(mutex_);
  senders_.push_back(sender);
}

void RemoteSimulation::remove(const MessageSender& sender) noexcept {
  const std::lock_guard lock(mutex_);
  std::erase_if(senders_, [&](const auto& weak) {
    const std::shared_ptr<MessageSender> known = weak.lock();
    return !known || known.get() == &sender;
  });
}

std::vector<std::shared_ptr<MessageSender>> RemoteSimulation::others(
    const MessageSender& sender) const {
  std::vector<std::shared_ptr<MessageSender>> others;
  const std::lock_guard lock(mutex_);
  if (senders_.size() < 2) return others;
  for (const auto& weak : senders_) {
    std::shared_ptr<MessageSender> other = weak.lock();
    if (other && other.get() != &sender) others.push_back(std::move(other));
  }
  return others;
}

// --- MessageSender

MessageSender::MessageSender(std::shared_ptr<Connection> connection, const std::string& simulation)
    : connection_(std::move(connection)), simulation_(RemoteSimulation::of(simulation)) {}

MessageSender::~MessageSender() { close(); }

std::shared_ptr<Connection> MessageSender::connection() const {
  const std::lock_guard lock(connection_mutex_);
  return connection_;
}

std::shared_ptr<RemoteSimulation> MessageSender::simulation() const {
  const std::lock_guard lock(connection_mutex_);
  return simulation_;
}

void MessageSender::replace(std::shared_ptr<Connection> connection, const std::string& simulation) {
  const std::shared_ptr<RemoteSimulation> now = RemoteSimulation::of(simulation);
  const std::shared_ptr<RemoteSimulation> before = this->simulation();
  if (before != now) {
    before->remove(*this);
    now->add(shared_from_this());
  }
  const std::lock_guard lock(connection_mutex_);
  connection_ = std::move(connection);
  simulation_ = now;
  joined_ = false;
  holds_back_ = false;
}

void MessageSender::begin_with_waiting(const Connection& connection) {
  const Encoding encoding = connection.encoding();
  const std::size_t limit = connection.message_limit();
  if (outgoing_.capacity() > Spare<char>::kMostBytes) outgoing_ = {};
  outgoing_ = held_back_;
  held_back_.clear();
  const std::size_t room = limit > kCallOverhead ? limit - kCallOverhead : 0;
  const std::size_t most = std::max<std::size_t>(room / drawing_bytes(encoding), 1);
  drawings_.drain([&](std::span<const sim::DrawOperation> drawings) {
    while (!drawings.empty()) {
      const auto part = drawings.first(std::min(drawings.size(), most));
      drawings = drawings.subspan(part.size());
      protocol::append_draw_request(part, encoding, outgoing_);
      sent_.fetch_add(1);
    }
  });
}

std::uint64_t MessageSender::send_request(Connection& connection, json& request) {
  begin_with_waiting(connection);
  return connection.ask(request, outgoing_);
}

void MessageSender::flush() {
  const Lock lock(send_mutex_);
  if (!has_room_) {
    drawings_.reserve();
    has_room_ = true;
    start_flusher();
  }
  const std::shared_ptr<Connection> connection = this->connection();
  begin_with_waiting(*connection);
  connection->tell(outgoing_);  // even without drawings, since it throws if the connection is lost
}

std::uint64_t MessageSender::begin_wait(json& request, std::shared_ptr<Connection>& on) {
  confirm_others();
  on = connection();
  const Lock lock(send_mutex_);
  const std::uint64_t id = send_request(*on, request);
  // No time passes until the server has read this request, and so the messages before it.
  acknowledged_.store(sent_);
  joined_ = true;
  return id;
}

json MessageSender::ask(json& request, Connection::WaitPolicy policy, bool waits,
                        std::shared_ptr<Connection>* answered_by) {
  const std::shared_ptr<Connection> connection = this->connection();
  if (answered_by != nullptr) *answered_by = connection;
  std::uint64_t id = 0;
  std::uint64_t sent = 0;
  {
    const Lock lock(send_mutex_);
    id = send_request(*connection, request);
    sent = sent_;
    // Time stands still until the server has read this request, and so the messages before it.
    if (waits && joined_) acknowledged_ = sent;
  }
  json answer = connection->answer(id, policy);
  acknowledged_ = sent;
  if (waits) joined_ = true;
  return answer;
}

json MessageSender::ask(json& request, Connection::WaitPolicy policy) {
  return ask(request, policy, false, nullptr);
}

json MessageSender::ask(json& request, std::shared_ptr<Connection>& answered_by) {
  return ask(request, Connection::WaitPolicy::kTimeout, false, &answered_by);
}

json MessageSender::wait(json& request) {
  if (!paced_) confirm_others();
  return ask(request, Connection::WaitPolicy::kWhileAlive, true, nullptr);
}

void MessageSender::tell(const Append& append) {
  const Lock lock(send_mutex_);
  const std::shared_ptr<Connection> connection = this->connection();
  sent_.fetch_add(1);
  begin_with_waiting(*connection);
  append(connection->encoding(), outgoing_);
  if (holds_back_ && outgoing_.size() < kMostHeldBack) {
    held_back_.swap(outgoing_);
    outgoing_.clear();
  }
  connection->tell(outgoing_);  // even without bytes, since it throws if the connection is lost
}

void MessageSender::hold_back(bool holds) noexcept {
  if (holds_back_.exchange(holds) != holds) connection()->expect_soon(holds);
}

void MessageSender::flush_and_confirm() noexcept {
  if (sent_ == acknowledged_ && drawings_.empty()) return;
  try {
    json question = {{"do", "time"}};
    ask(question);
  } catch (const std::exception&) {
    // Its own session will report the error.
  }
}

void MessageSender::confirm_others() noexcept {
  for (const auto& other : simulation()->others(*this)) other->flush_and_confirm();
}

void MessageSender::set_paced(bool paced) {
  paced_ = paced;
  const Lock lock(send_mutex_);
  start_flusher();
}

// The caller holds `send_mutex_`.
void MessageSender::start_flusher() {
  if (!paced_ || !has_room_) return;
  const Lock lock(flusher_mutex_);
  if (closing_ || flusher_.joinable()) return;
  flusher_ = std::thread([this] { flush_now_and_then(); });
}

void MessageSender::flush_now_and_then() {
  Lock lock(flusher_mutex_);
  while (!closing_) {
    flusher_changed_.wait_for(lock, kFlushPeriod);
    if (closing_ || drawings_.empty()) continue;
    lock.unlock();
    try {
      flush();
    } catch (const std::exception&) {
      // The program's next call will report the error.
    }
    lock.lock();
  }
}

bool MessageSender::stop_flusher() noexcept {
  {
    const Lock lock(flusher_mutex_);
    if (closing_) return true;
    closing_ = true;
    flusher_changed_.notify_all();
  }
  if (flusher_.joinable()) flusher_.join();
  return false;
}

bool MessageSender::leave() noexcept {
  try {
    json request = {{"do", "leave"}};
    ask(request);
  } catch (const std::exception&) {
    return false;
  }
  static_cast<void>(stop_flusher());
  const Lock lock(send_mutex_);
  drawings_.close();
  return true;
}

void MessageSender::close() noexcept {
  if (stop_flusher()) return;
  const std::shared_ptr<Connection> connection = this->connection();
  try {
    if (!connection->lost()) {
      std::uint64_t id = 0;
      json bye = {{"do", "bye"}};
      {
        const Lock lock(send_mutex_);
        id = send_request(*connection, bye);
      }
      static_cast<void>(connection->answer(id, Connection::WaitPolicy::kTimeout, kGoodBye));
    }
  } catch (const std::exception&) {
    // The connection is lost already.
  }
  {
    const Lock lock(send_mutex_);
    drawings_.close();
  }
  connection->close("the connection is closed");
  simulation()->remove(*this);
}

}  // namespace playerlike
