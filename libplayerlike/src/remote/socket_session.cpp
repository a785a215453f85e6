// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/socket_session.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>

#include "playerlike/process/thread_id.h"
#include "process/end_of_program.h"
#include "process/printed.h"
#include "process/thread_end.h"
#include "protocol/request_codec.h"
#include "remote/message_sender.h"
#include "session/checks.h"
#include "sim/core/error.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

using nlohmann::json;
using protocol::Encoding;
using std::chrono::milliseconds;

// The program is ended after so many reads beyond the end of the run, as in an embedded simulation.
constexpr int kReadsAfterEnd = 1000;

// Tells the server that a thread has ended, so that nobody waits for it.
void say_goodbye(void* sender) {
  try {
    static_cast<MessageSender*>(sender)->tell([](Encoding encoding, std::string& out) {
      protocol::append_encoded({{"do", "thread_ended"}, {"thread", this_thread_id()}}, encoding,
                               out);
    });
  } catch (const std::exception&) {
    // The server notices the lost connection itself.
  }
}

/// A name that no other process has.
std::string process_name() {
  static const std::string random = [] {
    std::random_device device;
    return std::to_string(device()) + '-' + std::to_string(device());
  }();
  return random + '-' + std::to_string(getpid());  // the pid tells a forked child from its parent
}

/// The program's name in the form that servers accept.
std::string program_name() {
  constexpr std::size_t kMost = 64;
  std::string name;
#ifdef __GLIBC__
  name = program_invocation_short_name;
#endif
  std::erase_if(name, [](char c) { return c < ' ' || c > '~'; });
  return name.substr(0, kMost);
}

/// Decodes an answer; an error in it is the server's fault.
template <typename Read>
auto understood(Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const protocol::ProtocolError& e) {
    throw misunderstood(e.what());
  }
}

std::vector<protocol::DecodedReading> decoded_readings(const json& list) {
  if (list.is_binary() && list.get_binary().subtype() == protocol::kEncodedItemTag) {
    const auto& bytes = list.get_binary();
    return protocol::decode_cbor_readings(
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  std::vector<protocol::DecodedReading> readings;
  for (const json& reading : protocol::require_list(list, "readings")) {
    readings.push_back(protocol::decode_reading(reading, Encoding::kJson));
  }
  return readings;
}

std::uint64_t session_number(const json& welcome) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53U;
  return static_cast<std::uint64_t>(protocol::require_integer(welcome, "session", 1, kMost));
}

json read_request(const char* wait, std::optional<double> timeout_s = std::nullopt) {
  json request = {{"do", "read"}, {"wait", wait}, {"thread", this_thread_id()}};
  if (timeout_s) request["timeout"] = *timeout_s;
  return request;
}

std::pair<int, int> key_of(DeviceId device) { return {device.robot, device.device}; }
DeviceId device_of(const std::pair<int, int>& key) { return {key.first, key.second}; }

bool same(const CanvasInfo& a, const CanvasInfo& b) {
  return a.width == b.width && a.height == b.height && a.cell_size_m == b.cell_size_m &&
         a.origin_x_m == b.origin_x_m && a.origin_y_m == b.origin_y_m;
}

/// Whether two worlds have equal devices, so that clients cannot tell them apart.
bool same(const std::vector<RobotInfo>& a, const std::vector<RobotInfo>& b) {
  const auto same_device = [](const DeviceInfo& x, const DeviceInfo& y) {
    return x.id == y.id && x.name == y.name && x.type == y.type;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const RobotInfo& x, const RobotInfo& y) {
                      return x.name == y.name && x.port == y.port &&
                             std::equal(x.devices.begin(), x.devices.end(), y.devices.begin(),
                                        y.devices.end(), same_device);
                    });
}

void require_style(const sim::LayerStyle& style) {
  if (std::isfinite(style.transparency)) return;
  throw SessionError(SessionError::Code::kBadArgument,
                     "a layer's transparency is a number in 0..1");
}

}  // namespace

SessionError misunderstood(const std::string& why) {
  return {SessionError::Code::kNotAvailable, "the server's answer cannot be understood: " + why};
}

SocketSettings SocketSettings::from_environment(ServerAddress server, int port) {
  SocketSettings settings;
  settings.server = std::move(server);
  settings.port = port;
  if (const char* text = std::getenv("PLAYPEN_ENCODING"); text != nullptr && *text != '\0') {
    const auto encoding = protocol::parse_encoding(text);
    if (!encoding) {
      throw sim::ConfigError({"run/environment", "PLAYPEN_ENCODING", "", "\"cbor\" or \"json\"",
                              '"' + std::string(text) + '"', ""});
    }
    settings.encoding = *encoding;
  }
  if (const char* text = std::getenv("PLAYPEN_TOKEN"); text != nullptr) {
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::size_t comma = rest.find(',');
      if (comma != 0) settings.tokens.emplace_back(rest.substr(0, comma));
      rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    }
  }
  return settings;
}

// --- Connecting

SocketSession::SocketSession(SocketSettings settings)
    : SocketSession(std::move(settings), std::nullopt) {}

SocketSession::SocketSession(SocketSettings settings, std::optional<std::string> follow)
    : settings_(std::move(settings)),
      follow_(std::move(follow)),
      request_timeout_s_(settings_.request_timeout_s) {
  const std::shared_ptr<Connection> connection = connect();
  const json& welcome = connection->welcome();
  understood([&] {
    robots_ = protocol::decode_robots(protocol::require(welcome, "robots"));
    canvas_ = protocol::decode_canvas(protocol::require(welcome, "canvas"));
    sender_ =
        std::make_shared<MessageSender>(connection, protocol::require_text(welcome, "simulation"));
    const TimeStatistics time = protocol::decode_time(protocol::require(welcome, "time"));
    sender_->set_paced(time.mode == sim::TimeMode::kPaced);
    sender_->simulation()->add(sender_);
    take_part_in_turns(time, session_number(welcome));
  });
  resumed_ = connection;
}

SocketSession::~SocketSession() { close(); }

json SocketSession::hello() const {
  json hello = {
      {"version", protocol::kVersion}, {"encoding", protocol::to_string(settings_.encoding)},
      {"port", settings_.port},        {"tokens", settings_.tokens},
      {"name", program_name()},        {"process", process_name()}};
  if (follow_) hello["follow"] = *follow_;
  if (settings_.virtual_time) hello["thread"] = this_thread_id();
  return hello;
}

std::shared_ptr<Connection> SocketSession::connect() const {
  std::shared_ptr<Connection> connection =
      Connection::open(settings_.server, hello(), wall_duration(settings_.connect_timeout_s),
                       [this] { return closed_.load(); });
  connection->set_request_timeout(wall_duration(request_timeout_s_));
  return connection;
}

void SocketSession::throw_closed() {
  throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
}

void SocketSession::require_open() const {
  if (closed_) throw_closed();
}

bool SocketSession::pause(double seconds) const {
  Lock lock(mutex_);
  // Always wait a little, so that a server that refuses is not asked in a tight loop.
  changed_.wait_for(lock, std::max(wall_duration(seconds), wall_duration(0.01)),
                    [&] { return closed_.load(); });
  return !closed_;
}

void SocketSession::resume(const std::shared_ptr<Connection>& connection) const {
  std::vector<Request> requests;
  {
    const Lock lock(mutex_);
    resumed_ = connection;
    if (!replace_by_default_) requests.emplace_back(ReplaceRequest{std::nullopt, false});
    for (const auto& [key, count] : subscriptions_) {
      for (int i = 0; i < count; ++i) requests.emplace_back(SubscribeRequest{device_of(key)});
    }
    for (const auto& [key, replace] : replace_) {
      requests.emplace_back(ReplaceRequest{device_of(key), replace});
    }
  }
  for (const Request& request : requests) {
    json message = protocol::encode_request(request, connection->encoding());
    std::string bytes;
    static_cast<void>(connection->answer(connection->ask(message, bytes)));
  }
}

bool SocketSession::recover(const std::shared_ptr<Connection>& lost) const {
  const int limit = retry_limit_;
  if (limit == 0) return false;
  const Lock lock(recover_mutex_);
  if (sender_->connection() != lost) return true;
  const std::string problem = connect_again(
      limit, [this] { return pause(retry_time_s_); },
      [this] {
        const std::shared_ptr<Connection> connection = connect();
        understood([&] {
          const json& welcome = connection->welcome();
          if (!same(robots_, protocol::decode_robots(protocol::require(welcome, "robots")))) {
            throw SessionError(SessionError::Code::kDisconnected,
                               "the server has robots now that this client does not know");
          }
          resume(connection);
          sender_->replace(connection, protocol::require_text(welcome, "simulation"));
          if (turns_) clock_->note_reconnected(*turns_, session_number(welcome));
          note(welcome);
        });
      });
  if (problem.empty()) return true;
  require_open();
  throw SessionError(SessionError::Code::kDisconnected, problem);
}

// --- Messages and requests

json SocketSession::ask(json& request) const {
  json answer = with_connection([&] { return sender_->ask(request); });
  note(answer);
  throw_async_error();
  return answer;
}

json SocketSession::read(json request) const {
  if (ThreadEnd* const end = ThreadEnd::mine()) end->say_goodbye(sender_, say_goodbye);
  return with_connection([&] { return sender_->wait(request); });
}

void SocketSession::note(const json& answer) const {
  const auto canvas = answer.find("canvas");
  if (canvas == answer.end() || canvas->is_null()) return;
  const CanvasInfo now = understood([&] { return protocol::decode_canvas(*canvas); });
  const Lock lock(mutex_);
  if (same(canvas_, now)) return;
  canvas_ = now;
  canvas_generation_.fetch_add(1, std::memory_order_release);
}

void SocketSession::throw_async_error() const {
  if (const auto async_error = sender_->connection()->async_error()) throw *async_error;
}

const std::vector<RobotInfo>& SocketSession::robots() const noexcept { return robots_; }
int SocketSession::port() const noexcept { return settings_.port; }

bool SocketSession::connected() const noexcept {
  const virtual_time::Inside inside;
  return !closed_ && !sender_->connection()->lost();
}

template <typename Note>
void SocketSession::request_persistently(const Request& request, Note note_it) {
  for (;;) {
    std::shared_ptr<Connection> answered_by;
    const json answer = with_connection([&] {
      json message = protocol::encode_request(request, sender_->connection()->encoding());
      return sender_->ask(message, answered_by);
    });
    note(answer);
    throw_async_error();
    const Lock lock(mutex_);
    // After the answer another thread may have made a new connection, and resumed on it without
    // this request.
    if (resumed_ != answered_by) continue;
    note_it();
    return;
  }
}

void SocketSession::unsubscribe(DeviceId device) {
  std::shared_ptr<const Connection> subscribed;
  {
    const Lock lock(mutex_);
    subscribed = resumed_;
    const auto it = subscriptions_.find(key_of(device));
    if (it != subscriptions_.end() && --it->second == 0) {
      subscriptions_.erase(it);
      const std::size_t waited = readings_.size();
      std::erase_if(readings_, [&](const auto& reading) { return reading.device == device; });
      if (waited > 0 && readings_.empty()) round_ = false;
    }
  }
  json request =
      protocol::encode_request(UnsubscribeRequest{device}, sender_->connection()->encoding());
  for (;;) {
    require_open();
    const std::shared_ptr<Connection> connection = sender_->connection();
    std::shared_ptr<Connection> answered_by = connection;
    std::optional<ConnectionLost> lost;
    try {
      note(sender_->ask(request, answered_by));
    } catch (const ConnectionLost& e) {
      lost = e;
    }
    bool newest = false;
    {
      const Lock lock(mutex_);
      newest = resumed_ == answered_by;
    }
    if (newest) {
      // No new connection is needed: it would not have the subscription.
      if (lost) throw *lost;
      return;
    }
    // Another thread is making a connection; it copied the subscriptions before this change.
    { const Lock made(recover_mutex_); }
    if (sender_->connection() != subscribed) return;
  }
}

// --- Time

/// The right to send a `read`; one thread has it at a time.
class SocketSession::ReadTurn {
 public:
  /// @param lock  of `mutex_`, locked.
  ReadTurn(SocketSession& session, Lock& lock) : session_(session) {
    session_.reading_ = true;
    lock.unlock();
  }
  ~ReadTurn() {
    const Lock lock(session_.mutex_);
    session_.reading_ = false;
    session_.changed_.notify_all();
  }
  ReadTurn(const ReadTurn&) = delete;
  ReadTurn& operator=(const ReadTurn&) = delete;

 private:
  SocketSession& session_;
};

void SocketSession::store_answer(const json& answer, bool round) {
  note(answer);
  understood([&] {
    std::vector<protocol::DecodedReading> readings;
    if (const auto list = answer.find("readings"); list != answer.end()) {
      readings = decoded_readings(*list);
    }
    constexpr std::int64_t kMost = 0xffffffff;
    if (answer.contains("overflow")) {
      overflow_ =
          static_cast<std::uint32_t>(protocol::require_integer(answer, "overflow", 0, kMost));
    }
    const bool over = answer.contains("finished") && protocol::require_bool(answer, "finished");
    const bool data = answer.contains("data") && protocol::require_bool(answer, "data");
    const Lock lock(mutex_);
    over_ = over_ || over;
    round_ = round_ || round || data || !readings.empty();
    std::move(readings.begin(), readings.end(), std::back_inserter(readings_));
  });
}

void SocketSession::throw_finished() {
  if (settings_.quiet_end) {
    end_program_quietly_if_uncaught();
    Lock lock(mutex_);
    if (++reads_after_end_ > kReadsAfterEnd) end_program_quietly();
  }
  throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
}

void SocketSession::wait() {
  const virtual_time::Inside inside;
  if (settings_.quiet_end) flush_printed();  // the server's process may count it: PrintedBytes
  if (in_turns() && wait_for_data_in_turns()) return;
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || round_ || !reading_; });
  require_open();
  if (round_) return;
  {
    const ReadTurn turn(*this, lock);
    try {
      store_answer(read(read_request("data")), /*round=*/true);
    } catch (const SessionError& e) {
      if (e.code() != SessionError::Code::kFinished) throw;
      throw_finished();
    }
  }
  throw_async_error();
}

int SocketSession::take(ReadingSink& sink) {
  const virtual_time::Inside inside;
  require_open();
  const bool turns = in_turns();
  if (turns) {
    if (const auto round = clock_->take_round(*turns_)) store_answer(*round, /*round=*/true);
  }
  Lock lock(mutex_);
  if (!round_ && !reading_ && !over_ && (!turns || clock_->has_data(*turns_))) {
    {
      const ReadTurn turn(*this, lock);
      store_answer(ask(read_request("none")), /*round=*/false);
    }
    lock.lock();
  }
  round_ = false;
  std::vector<protocol::DecodedReading> readings = std::exchange(readings_, {});
  lock.unlock();
  if (turns) clock_->note_taken(*turns_);
  for (protocol::DecodedReading& reading : readings) {
    sink.on_reading(reading.device, std::move(reading.reading));
  }
  return static_cast<int>(readings.size());
}

bool SocketSession::peek(milliseconds timeout) {
  const virtual_time::Inside inside;
  timeout = std::max(timeout, milliseconds(0));
  if (bool result = false; in_turns() && peek_in_turns(timeout, result)) return result;
  Lock lock(mutex_);
  require_open();
  if (reading_ && !round_) {
    // The round that the other thread waits for serves this one as well.
    changed_.wait_for(lock, std::min<milliseconds>(timeout, std::chrono::hours(1)),
                      [&] { return closed_ || round_ || !reading_; });
    require_open();
    if (reading_) return round_ || over_;
  }
  if (round_ || over_) return true;
  const ReadTurn turn(*this, lock);
  try {
    store_answer(read(read_request("peek", std::chrono::duration<double>(timeout).count())),
                 /*round=*/false);
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kFinished) throw;
    const Lock again(mutex_);
    over_ = true;
  }
  const Lock again(mutex_);
  return round_ || over_;
}

void SocketSession::join() {
  if (in_turns()) {
    note_wait();
    require_open();
    return clock_->join(*turns_);
  }
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !reading_; });
  require_open();
  const ReadTurn turn(*this, lock);
  store_answer(read(read_request("join")), /*round=*/false);
}

void SocketSession::sleep(double seconds) {
  if (!(seconds >= 0.0 && seconds <= kLongest_s)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "sleep takes a number of seconds in [0, 1e9]");
  }
  if (in_turns() && sleep_in_turns(seconds)) return;
  if (sender_->paced()) return sleep_by_the_wall_clock(seconds);
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !reading_; });
  require_open();
  const ReadTurn turn(*this, lock);
  try {
    store_answer(read(read_request("sleep", seconds)), /*round=*/false);
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kFinished) throw;
  }
}

// Another thread may read in this session meanwhile, so the sleep happens here and not at the
// server.
void SocketSession::sleep_by_the_wall_clock(double seconds) {
  {
    Lock lock(mutex_);
    const bool other_reads = reading_;
    lock.unlock();
    if (!other_reads) join();  // the start gate may wait for this client
  }
  TimeStatistics now = time();
  const sim::SimTime end_ns = now.sim_time_ns + sim::from_seconds(seconds);
  while (now.sim_time_ns < end_ns && !now.finished) {
    // A little less than the time left, and not for long, since the real-time factor may change.
    const double left_s =
        sim::to_seconds(end_ns - now.sim_time_ns) / std::max(now.real_time_factor, 0.01);
    Lock lock(mutex_);
    changed_.wait_for(lock, wall_duration(std::clamp(0.9 * left_s, 0.0005, 0.1)),
                      [&] { return closed_.load(); });
    lock.unlock();
    now = time();
  }
}

TimeStatistics SocketSession::time() const {
  auto time = std::get<TimeStatistics>(ask_for(TimeRequest{}));
  const bool paced = time.mode == sim::TimeMode::kPaced;
  if (paced != sender_->paced()) sender_->set_paced(paced);
  return time;
}

// --- Commands and other sessions

void SocketSession::send(DeviceId device, const sim::Command& command) {
  const virtual_time::Inside inside;
  require_open();
  require_device(robots_, device);
  require_finite(command);
  if (turns_) clock_->touch(*turns_);
  with_connection([&] {
    sender_->tell([&](Encoding encoding, std::string& out) {
      protocol::append_command_request(device, command, encoding, out);
    });
  });
}

std::unique_ptr<Session> SocketSession::open_follower() {
  const virtual_time::Inside inside;
  require_open();
  const std::string key =
      understood([&] { return protocol::require_text(sender_->connection()->welcome(), "key"); });
  SocketSettings settings = settings_;
  settings.request_timeout_s = request_timeout_s_;
  return std::unique_ptr<Session>(new SocketSession(std::move(settings), key));
}

const void* SocketSession::simulation() const noexcept {
  if (turns_) return static_cast<const TurnClock*>(clock_.get());
  return sender_->simulation().get();
}

// --- Requests; socket_canvas.cpp has those that send cells in pieces

/// Handles the requests that need more than one message and its answer.
struct SocketSession::RequestHandler {
  SocketSession& session;

  void operator()(const SubscribeRequest& what) const {
    require_device(session.robots_, what.device);
    session.request_persistently(what, [&] { ++session.subscriptions_[key_of(what.device)]; });
  }
  void operator()(const UnsubscribeRequest& what) const { session.unsubscribe(what.device); }
  void operator()(const ReplaceRequest& what) const {
    session.request_persistently(what, [&] {
      if (what.device) {
        session.replace_[key_of(*what.device)] = what.replace;
      } else {
        session.replace_by_default_ = what.replace;
        session.replace_.clear();
      }
    });
  }
  std::uint32_t operator()(const OverflowRequest&) const { return session.overflow_; }
  void operator()(const JoinRequest&) const { session.join(); }
  void operator()(const SleepRequest& what) const { session.sleep(what.seconds); }
  TimeStatistics operator()(const TimeRequest&) const { return session.time(); }
  void operator()(const PreferRealTimeRequest& what) const {
    if (session.in_turns()) {
      session.note_wait();
      session.clock_->note_background();
      return virtual_time::note_background();
    }
    static_cast<void>(session.ask_for(what));
    static_cast<void>(session.time());
  }
  void operator()(const NoteLooksRequest&) const {}  // the server may let time pass
  void operator()(const AnswerTimeoutRequest& what) const {
    session.request_timeout_s_ = what.seconds;
    session.sender_->connection()->set_request_timeout(wall_duration(what.seconds));
  }
  void operator()(const RetriesRequest& what) const {
    session.retry_time_s_ = what.time_s;
    session.retry_limit_ = what.limit;
  }
  void operator()(const FlushDrawingsRequest&) const {
    session.with_connection([&] { session.sender_->flush(); });
  }
  void operator()(const SetCellsRequest& what) const { session.set_cells(what); }
  void operator()(const RemoveLayerRequest& what) const {
    session.forget_layers();
    static_cast<void>(session.ask_for(what));
  }
  void operator()(const RestoreStateRequest& what) const {
    session.forget_layers();
    session.sender_->confirm_others();  // earlier images of other sessions are replaced, too
    static_cast<void>(session.ask_for(what));
  }
  CanvasInfo operator()(const CanvasInfoRequest&) const {
    const Lock lock(session.mutex_);
    return session.canvas_;
  }
  CanvasInfo operator()(const ResizeCanvasRequest& what) const {
    session.sender_->confirm_others();  // earlier drawings of other sessions belong to the old size
    return std::get<CanvasInfo>(session.ask_for(what));
  }
  WorldMap operator()(const WorldMapRequest& what) const {
    if (what.tile) return std::get<WorldMap>(session.ask_for(what));
    return session.world_map(what.cell_size_m);
  }

  // JSON has finite numbers only.
  static void check(const CreateLayerRequest& what) { require_style(what.style); }
  static void check(const SetLayerStyleRequest& what) { require_style(what.style); }
  static void check(const PlaceObjectRequest& what) {
    require_finite(sim::PlaceCommand{what.pose});
  }
  static void check(const SetObjectPropertyRequest& what) {
    const auto* numbers = std::get_if<std::vector<double>>(&what.value);
    if (numbers == nullptr) return;
    for (const double number : *numbers) require_finite(sim::RotateCommand{number});
  }

  /// Requests about what all sessions have drawn. Whole images, which need no answer, are part of
  /// it at once.
  template <typename One>
  static constexpr bool kSeesImages =
      std::is_same_v<One, CanvasImageRequest> || std::is_same_v<One, SaveImageRequest> ||
      std::is_same_v<One, CellsRequest> || std::is_same_v<One, CellRequest> ||
      std::is_same_v<One, SaveStateRequest>;

  template <typename One>
  typename One::Result operator()(const One& what) const {
    if constexpr (requires { check(what); }) check(what);
    if constexpr (kSeesImages<One>) session.sender_->confirm_others();
    if constexpr (!requires { One::kName; }) {
      throw SessionError(SessionError::Code::kNotAvailable,
                         "a server does this for clients in MORSE's protocol only");
    }
    Answer answer = session.ask_for(what);
    if constexpr (!std::is_void_v<typename One::Result>) {
      return std::get<typename One::Result>(std::move(answer));
    }
  }
};

Answer SocketSession::answer(const Request& request) {
  const virtual_time::Inside inside;
  return answer_by(RequestHandler{*this}, request);
}

Answer SocketSession::ask_for(const Request& request) const {
  const Encoding encoding = sender_->connection()->encoding();
  const json answer = ask(protocol::encode_request(request, encoding));
  return understood([&] { return protocol::decode_answer(request, answer, encoding); });
}

void SocketSession::close() noexcept {
  const virtual_time::Inside inside;
  if (closed_.exchange(true)) return;
  {
    const Lock lock(mutex_);
    changed_.notify_all();
  }
  if (turns_ && clock_->remove(turns_) && sender_->leave()) return;
  sender_->close();
}

}  // namespace playerlike
