// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/socket_session.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>

#include "host/end_of_program.h"
#include "playerlike/host/event_client.h"
#include "playerlike/session/layer_book.h"
#include "session/checks.h"
#include "session/farewell.h"
#include "session/socket_line.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

using nlohmann::json;
using protocol::Encoding;
using std::chrono::milliseconds;
using Seconds = std::chrono::duration<double>;

// A program that ignores the end of the run this often is ended, as in an embedded simulation.
constexpr int kReadsAfterEnd = 1000;
constexpr double kLongest_s = 1e9;  // 30 years
// Of a message that sets cells, besides the cells [bytes].
constexpr std::size_t kMessageOverhead = 512;
// Longest side of a rectangle in a message.
constexpr std::size_t kMaxMapSide = 8192;
// Sides of the tiles in which maps are fetched [cells]: 4 MiB each.
constexpr int kTileSide = 1024;

Connection::Clock::duration wall(double seconds) {
  return std::chrono::duration_cast<Connection::Clock::duration>(
      Seconds(std::clamp(seconds, 0.0, kLongest_s)));
}

// Nobody is to wait for a thread that has ended.
thread_local Farewell<SocketLine> farewell_to_server([](SocketLine& line) {
  try {
    line.tell(json{{"do", "thread_ended"}, {"thread", this_thinker()}});
  } catch (const std::exception&) {
    // The server notices that it has lost the connection.
  }
});

/// What no other process calls itself.
std::string process_name() {
  static const std::string random = [] {
    std::random_device device;
    return std::to_string(device()) + '-' + std::to_string(device());
  }();
  return random + '-' + std::to_string(getpid());  // not that of a process that this one forked
}

/// The name of this program, as a server takes it.
std::string program_name() {
  constexpr std::size_t kMost = 64;
  std::string name;
#ifdef __GLIBC__
  name = program_invocation_short_name;
#endif
  std::erase_if(name, [](char c) { return c < ' ' || c > '~'; });
  return name.substr(0, kMost);
}

/// Reads an answer: what it should hold and does not is the server's fault.
template <typename Read>
auto understood(Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const protocol::ProtocolError& e) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       std::string("the server's answer cannot be understood: ") + e.what());
  }
}

json device_request(const char* what, DeviceId device) {
  return {{"do", what}, {"device", protocol::encode_device_id(device)}};
}

json read_request(const char* wait) {
  return {{"do", "read"}, {"wait", wait}, {"thread", this_thinker()}};
}

json read_request(const char* wait, double timeout_s) {
  json request = read_request(wait);
  request["timeout"] = timeout_s;
  return request;
}

std::pair<int, int> key_of(DeviceId device) { return {device.robot, device.device}; }
DeviceId device_of(const std::pair<int, int>& key) { return {key.first, key.second}; }

bool same(const CanvasInfo& a, const CanvasInfo& b) {
  return a.width == b.width && a.height == b.height && a.cell_size_m == b.cell_size_m &&
         a.origin_x_m == b.origin_x_m && a.origin_y_m == b.origin_y_m;
}

/// Whether clients could not tell two worlds from one another by their devices.
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
    line_ = std::make_shared<SocketLine>(connection, protocol::require_text(welcome, "simulation"));
    const TimeStatistics time = protocol::decode_time(protocol::require(welcome, "time"));
    line_->set_paced(time.mode == sim::TimeMode::kPaced);
  });
  line_->simulation()->add(line_);
  resumed_ = connection;
}

SocketSession::~SocketSession() { close(); }

json SocketSession::hello() const {
  json hello = {
      {"version", protocol::kVersion}, {"encoding", protocol::to_string(settings_.encoding)},
      {"port", settings_.port},        {"tokens", settings_.tokens},
      {"name", program_name()},        {"process", process_name()}};
  if (follow_) hello["follow"] = *follow_;
  return hello;
}

std::shared_ptr<Connection> SocketSession::connect() const {
  std::shared_ptr<Connection> connection =
      Connection::open(settings_.server, hello(), wall(settings_.connect_timeout_s),
                       [this] { return closed_.load(); });
  connection->set_request_timeout(wall(request_timeout_s_));
  return connection;
}

void SocketSession::throw_closed() {
  throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
}

void SocketSession::require_open() const {
  if (closed_) throw_closed();
}

template <typename Use>
auto SocketSession::with_connection(Use use) const {
  for (;;) {
    require_open();
    const std::shared_ptr<Connection> connection = line_->connection();
    try {
      return use();
    } catch (const ConnectionLost&) {
      require_open();
      if (!recover(connection)) throw;
    }
  }
}

bool SocketSession::pause(double seconds) const {
  Lock lock(mutex_);
  // Not at once in any case: a server that refuses is not to be asked without pause.
  changed_.wait_for(lock, std::max(wall(seconds), wall(0.01)), [&] { return closed_.load(); });
  return !closed_;
}

void SocketSession::resume(const std::shared_ptr<Connection>& connection) const {
  const auto carry_out = [&](json& request) {
    static_cast<void>(connection->answer(connection->ask(request)));
  };
  std::vector<json> requests;
  {
    const Lock lock(mutex_);
    resumed_ = connection;
    if (!replace_by_default_) {
      requests.push_back({{"do", "replace"}, {"device", nullptr}, {"replace", false}});
    }
    for (const auto& [key, count] : subscriptions_) {
      for (int i = 0; i < count; ++i) {
        requests.push_back(device_request("subscribe", device_of(key)));
      }
    }
    for (const auto& [key, replace] : replace_) {
      requests.push_back(device_request("replace", device_of(key)));
      requests.back()["replace"] = replace;
    }
  }
  for (json& request : requests) carry_out(request);
}

bool SocketSession::recover(const std::shared_ptr<Connection>& lost) const {
  const int limit = retry_limit_;
  if (limit == 0) return false;
  const Lock lock(recover_mutex_);
  if (line_->connection() != lost) return true;
  std::string reason;
  int attempts = 0;
  while ((limit < 0 || attempts < limit) && (attempts == 0 || pause(retry_time_s_))) {
    ++attempts;
    try {
      const std::shared_ptr<Connection> connection = connect();
      understood([&] {
        const json& welcome = connection->welcome();
        if (!same(robots_, protocol::decode_robots(protocol::require(welcome, "robots")))) {
          throw SessionError(SessionError::Code::kDisconnected,
                             "the server has robots now that this client does not know");
        }
        resume(connection);
        line_->replace(connection, protocol::require_text(welcome, "simulation"));
        note(welcome);
      });
      return true;
    } catch (const SessionError& e) {
      reason = e.what();
    }
  }
  require_open();
  throw SessionError(SessionError::Code::kDisconnected,
                     "the connection is lost, and " + std::to_string(attempts) +
                         (attempts == 1 ? " attempt" : " attempts") +
                         " to connect again failed: " + reason);
}

// --- Saying and asking

json SocketSession::request(json request) const {
  json answer = with_connection([&] { return line_->ask(request); });
  note(answer);
  throw_complaint();
  return answer;
}

json SocketSession::read(json request) const {
  farewell_to_server.remember(line_);
  return with_connection([&] { return line_->wait(request); });
}

void SocketSession::tell(const json& message) const {
  with_connection([&] { line_->tell(message); });
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

void SocketSession::throw_complaint() const {
  if (const auto complaint = line_->connection()->complaint()) throw *complaint;
}

const std::vector<RobotInfo>& SocketSession::robots() const noexcept { return robots_; }
int SocketSession::port() const noexcept { return settings_.port; }

bool SocketSession::connected() const noexcept { return !closed_ && !line_->connection()->lost(); }

void SocketSession::subscribe(DeviceId device) {
  require_device(robots_, device);
  request_for_good(device_request("subscribe", device), [&] { ++subscriptions_[key_of(device)]; });
}

template <typename Note>
void SocketSession::request_for_good(const json& request, Note note_it) {
  for (;;) {
    std::shared_ptr<Connection> answered_by;
    const json answer = with_connection([&] {
      json copy = request;
      return line_->ask(copy, answered_by);
    });
    note(answer);
    throw_complaint();
    const Lock lock(mutex_);
    // Another thread may have made another connection since the answer, and told it of all but
    // this.
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
  json request = device_request("unsubscribe", device);
  for (;;) {
    require_open();
    const std::shared_ptr<Connection> connection = line_->connection();
    std::shared_ptr<Connection> answered_by = connection;
    std::optional<ConnectionLost> lost;
    try {
      note(line_->ask(request, answered_by));
    } catch (const ConnectionLost& e) {
      lost = e;
    }
    bool newest = false;
    {
      const Lock lock(mutex_);
      newest = resumed_ == answered_by;
    }
    if (newest) {
      // Not worth another connection: that will not have the subscription.
      if (lost) throw *lost;
      return;
    }
    // Another thread is making a connection, which was told of the subscription before.
    { const Lock made(recover_mutex_); }
    if (line_->connection() != subscribed) return;
  }
}

void SocketSession::set_replace(std::optional<DeviceId> device, bool replace) {
  json message = {{"do", "replace"}, {"device", nullptr}, {"replace", replace}};
  if (device) message["device"] = protocol::encode_device_id(*device);
  request_for_good(message, [&] {
    if (device) {
      replace_[key_of(*device)] = replace;
    } else {
      replace_by_default_ = replace;
      replace_.clear();
    }
  });
}

std::uint32_t SocketSession::overflow_count() const { return overflow_; }

// --- Time

/// The right to send a `read`, which one thread has at a time.
class SocketSession::ReadTurn {
 public:
  /// @param lock  of `mutex_`, held.
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

void SocketSession::accept(const json& answer, bool round) {
  note(answer);
  understood([&] {
    std::vector<protocol::DecodedReading> readings;
    if (const auto list = answer.find("readings"); list != answer.end()) {
      if (!list->is_array()) protocol::refuse_value("readings", "a list", *list);
      readings.reserve(list->size());
      const Encoding encoding = line_->connection()->encoding();
      for (const json& reading : *list) {
        readings.push_back(protocol::decode_reading(reading, encoding));
      }
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
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || round_ || !reading_; });
  require_open();
  if (round_) return;
  {
    const ReadTurn turn(*this, lock);
    try {
      accept(read(read_request("data")), /*round=*/true);
    } catch (const SessionError& e) {
      if (e.code() != SessionError::Code::kFinished) throw;
      throw_finished();
    }
  }
  throw_complaint();
}

int SocketSession::take(ReadingSink& sink) {
  Lock lock(mutex_);
  require_open();
  if (!round_ && !reading_ && !over_) {
    {
      const ReadTurn turn(*this, lock);
      accept(request(read_request("none")), /*round=*/false);
    }
    lock.lock();
  }
  round_ = false;
  const std::vector<protocol::DecodedReading> readings = std::exchange(readings_, {});
  lock.unlock();
  for (const protocol::DecodedReading& reading : readings) {
    sink.on_reading(reading.device, *reading.reading);
  }
  return static_cast<int>(readings.size());
}

bool SocketSession::peek(milliseconds timeout) {
  timeout = std::max(timeout, milliseconds(0));
  Lock lock(mutex_);
  require_open();
  if (reading_ && !round_) {
    // What the other thread waits for will do.
    changed_.wait_for(lock, std::min<milliseconds>(timeout, std::chrono::hours(1)),
                      [&] { return closed_ || round_ || !reading_; });
    require_open();
    if (reading_) return round_ || over_;
  }
  if (round_ || over_) return true;
  const ReadTurn turn(*this, lock);
  try {
    accept(read(read_request("peek", std::chrono::duration<double>(timeout).count())),
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
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !reading_; });
  require_open();
  const ReadTurn turn(*this, lock);
  accept(read(read_request("join")), /*round=*/false);
}

void SocketSession::sleep(double seconds) {
  if (!(seconds >= 0.0 && seconds <= kLongest_s)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "sleep takes a number of seconds in [0, 1e9]");
  }
  if (line_->paced()) return sleep_by_the_wall_clock(seconds);
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !reading_; });
  require_open();
  const ReadTurn turn(*this, lock);
  try {
    accept(read(read_request("sleep", seconds)), /*round=*/false);
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kFinished) throw;
  }
}

// Another thread may read this session meanwhile, so the server is not asked to wait.
void SocketSession::sleep_by_the_wall_clock(double seconds) {
  {
    Lock lock(mutex_);
    const bool other_reads = reading_;
    lock.unlock();
    if (!other_reads) join();  // the start gate may wait for it
  }
  TimeStatistics now = time();
  const sim::SimTime end_ns = now.sim_time_ns + sim::from_seconds(seconds);
  while (now.sim_time_ns < end_ns && !now.finished) {
    // A little less than what is left, and not for long: the factor may change.
    const double left_s =
        sim::to_seconds(end_ns - now.sim_time_ns) / std::max(now.real_time_factor, 0.01);
    Lock lock(mutex_);
    changed_.wait_for(lock, wall(std::clamp(0.9 * left_s, 0.0005, 0.1)),
                      [&] { return closed_.load(); });
    lock.unlock();
    now = time();
  }
}

TimeStatistics SocketSession::time() const {
  const json answer = request({{"do", "time"}});
  TimeStatistics time =
      understood([&] { return protocol::decode_time(protocol::require(answer, "time")); });
  const bool paced = time.mode == sim::TimeMode::kPaced;
  if (paced != line_->paced()) line_->set_paced(paced);
  return time;
}

void SocketSession::prefer_real_time(const std::string& reason) {
  request({{"do", "prefer_real_time"}, {"reason", reason}});
  static_cast<void>(time());
}

void SocketSession::set_request_timeout(double seconds) {
  request_timeout_s_ = seconds;
  line_->connection()->set_request_timeout(wall(seconds));
}

void SocketSession::set_retries(int limit, double time_s) {
  retry_time_s_ = time_s;
  retry_limit_ = limit;
}

// --- Commands, and other sessions

void SocketSession::send(DeviceId device, const sim::Command& command) {
  require_open();
  require_device(robots_, device);
  require_finite(command);
  json message = device_request("command", device);
  message["command"] = protocol::encode_command(command);
  tell(message);
}

std::unique_ptr<Session> SocketSession::open_follower() {
  require_open();
  const std::string key =
      understood([&] { return protocol::require_text(line_->connection()->welcome(), "key"); });
  SocketSettings settings = settings_;
  settings.request_timeout_s = request_timeout_s_;
  return std::unique_ptr<Session>(new SocketSession(std::move(settings), key));
}

const void* SocketSession::simulation() const noexcept { return line_->simulation().get(); }

// --- The canvas

DrawQueue& SocketSession::draw_queue() noexcept { return line_->drawings(); }

void SocketSession::flush_drawings() {
  with_connection([&] { line_->flush(); });
}

void SocketSession::draw_cells(sim::LayerId layer, const sim::CellRect& rect,
                               std::span<const sim::CellValue> values) {
  require_cells(rect, values.size());
  const std::shared_ptr<Connection> connection = line_->connection();
  const Encoding encoding = connection->encoding();
  // Pieces that fit a message: rows if they do, else parts of rows.
  const std::size_t most = std::max<std::size_t>(
      (connection->message_limit() - kMessageOverhead) / (encoding == Encoding::kCbor ? 4 : 6), 1);
  const auto width = static_cast<std::size_t>(rect.width);
  const std::size_t most_columns = std::min({width, most, kMaxMapSide});
  const auto columns = static_cast<int>(most_columns);
  const auto rows =
      static_cast<int>(std::min({most / std::max<std::size_t>(most_columns, 1), kMaxMapSide,
                                 static_cast<std::size_t>(rect.height)}));
  const auto set = [&](const sim::CellRect& part, std::span<const sim::CellValue> cells) {
    request({{"do", "set_cells"},
             {"layer", layer},
             {"rect", {part.column, part.row, part.width, part.height}},
             {"cells", protocol::encode_cells(cells, encoding)}});
  };
  if (columns == rect.width && rows == rect.height) return set(rect, values);
  std::vector<sim::CellValue> cells;
  for (int row = 0; row < rect.height; row += rows) {
    for (int column = 0; column < rect.width; column += columns) {
      const sim::CellRect part{rect.column + column, rect.row + row,
                               std::min(columns, rect.width - column),
                               std::min(rows, rect.height - row)};
      cells.clear();
      for (int i = 0; i < part.height; ++i) {
        const auto line = values.subspan(
            static_cast<std::size_t>(row + i) * width + static_cast<std::size_t>(column),
            static_cast<std::size_t>(part.width));
        cells.insert(cells.end(), line.begin(), line.end());
      }
      set(part, cells);
    }
  }
}

std::optional<sim::CellValue> SocketSession::cell(sim::LayerId layer, int column, int row) {
  const json answer = request({{"do", "cell"}, {"layer", layer}, {"column", column}, {"row", row}});
  return understood([&]() -> std::optional<sim::CellValue> {
    const json& cell = protocol::require(answer, "cell");
    if (cell.is_null()) return std::nullopt;
    const auto values = protocol::decode_cells(cell, line_->connection()->encoding());
    if (values.size() != 1) throw protocol::ProtocolError("protocol/bad-value", "cell: not one");
    return values.front();
  });
}

std::vector<sim::CellValue> SocketSession::cells(sim::LayerId layer) {
  const json answer = request({{"do", "cells"}, {"layer", layer}});
  return understood([&] {
    return protocol::decode_cells(protocol::require(answer, "cells"),
                                  line_->connection()->encoding());
  });
}

sim::LayerId SocketSession::create_layer(sim::LayerKind kind, sim::LayerStyle style) {
  require_style(style);
  const json answer = request({{"do", "create_layer"},
                               {"kind", protocol::encode_layer_kind(kind)},
                               {"style", protocol::encode_style(style)}});
  return understood([&] {
    return static_cast<sim::LayerId>(
        protocol::require_integer(answer, "layer", 0, std::numeric_limits<int>::max()));
  });
}

void SocketSession::remove_layer(sim::LayerId layer) {
  request({{"do", "remove_layer"}, {"layer", layer}});
}

void SocketSession::set_layer_style(sim::LayerId layer, sim::LayerStyle style) {
  require_style(style);
  request({{"do", "set_layer_style"}, {"layer", layer}, {"style", protocol::encode_style(style)}});
}

std::vector<sim::LayerInfo> SocketSession::layers() {
  const json answer = request({{"do", "layers"}});
  return understood([&] { return protocol::decode_layers(protocol::require(answer, "layers")); });
}

std::vector<std::uint8_t> SocketSession::canvas_image() {
  const json answer = request({{"do", "canvas_image"}});
  return understood(
      [&] { return protocol::require_bytes(answer, "image", line_->connection()->encoding()); });
}

void SocketSession::resize_canvas(int width, int height) {
  line_->settle_others();  // what they drew is meant for the size before
  request({{"do", "resize_canvas"}, {"width", width}, {"height", height}});
}

CanvasInfo SocketSession::canvas_info() const {
  const Lock lock(mutex_);
  return canvas_;
}

std::uint64_t SocketSession::canvas_generation() const noexcept {
  return canvas_generation_.load(std::memory_order_acquire);
}

void SocketSession::save_image(const std::string& name, int scale,
                               std::optional<sim::LayerId> layer) {
  json what = {{"do", "save_image"}, {"name", name}, {"scale", scale}};
  if (layer) what["layer"] = *layer;
  request(what);
}

void SocketSession::save_map(sim::LayerId layer, const std::string& name, sim::io::MapMode mode) {
  request({{"do", "save_map"}, {"layer", layer}, {"name", name}, {"mode", to_string(mode)}});
}

sim::ViewMode SocketSession::view_mode() const {
  const json answer = request({{"do", "view_mode"}});
  return understood([&] {
    const auto mode = sim::parse_view_mode(protocol::require_text(answer, "mode"));
    if (!mode) throw protocol::ProtocolError("protocol/bad-value", "mode: no view mode");
    return *mode;
  });
}

void SocketSession::set_view_mode(sim::ViewMode mode) {
  request({{"do", "set_view_mode"}, {"mode", sim::to_string(mode)}});
}

sim::OccupancyMap SocketSession::world_map(double cell_size_m) {
  if (!(cell_size_m > 0.0 && std::isfinite(cell_size_m))) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the cell size of a map is a positive number [m], but is " +
                           sim::rounded_text(cell_size_m, 6));
  }
  const auto tile = [&](int column, int row) {
    return request({{"do", "world_map"},
                    {"cell_size", cell_size_m},
                    {"tile", {column, row, kTileSide, kTileSide}}});
  };
  json answer = tile(0, 0);
  return understood([&] {
    const auto side = [&](const char* key) {
      return static_cast<int>(protocol::require_integer(answer, key, 1, kMaxMapSide));
    };
    const Encoding encoding = line_->connection()->encoding();
    sim::OccupancyMap part = protocol::decode_map(protocol::require(answer, "map"), encoding);
    sim::OccupancyMap map;
    map.width = side("width");
    map.height = side("height");
    map.cell_size_m = part.cell_size_m;
    map.origin = protocol::require_pose(answer, "origin").position();
    if (part.width == map.width && part.height == map.height) return part;
    map.cells.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    for (int row = 0; row < map.height; row += kTileSide) {
      for (int column = 0; column < map.width; column += kTileSide) {
        if (row > 0 || column > 0) {
          answer = tile(column, row);
          part = protocol::decode_map(protocol::require(answer, "map"), encoding);
        }
        if (part.width != std::min(kTileSide, map.width - column) ||
            part.height != std::min(kTileSide, map.height - row)) {
          throw protocol::ProtocolError("protocol/bad-value", "map: not the tile asked for");
        }
        for (int y = 0; y < part.height; ++y) {
          std::copy_n(
              part.cells.begin() + static_cast<std::ptrdiff_t>(y) * part.width, part.width,
              map.cells.begin() + static_cast<std::ptrdiff_t>(row + y) * map.width + column);
        }
      }
    }
    return map;
  });
}

ObjectPose SocketSession::object_pose(const std::string& name) {
  const json answer = request({{"do", "object_pose"}, {"name", name}});
  return understood([&]() -> ObjectPose {
    return {protocol::require_pose(answer, "pose"),
            protocol::require_integer(answer, "t", 0, std::numeric_limits<std::int64_t>::max())};
  });
}

void SocketSession::place_object(const std::string& name, const sim::Pose& pose) {
  require_finite(sim::PlaceCommand{pose});  // JSON would not take it
  request({{"do", "place_object"}, {"name", name}, {"pose", protocol::encode_pose(pose)}});
}

PropertyValue SocketSession::object_property(const std::string& name, const std::string& property) {
  const json answer = request({{"do", "object_property"}, {"name", name}, {"property", property}});
  return understood([&] { return protocol::require_property(answer, "value"); });
}

void SocketSession::set_object_property(const std::string& name, const std::string& property,
                                        const PropertyValue& value) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    for (const double number : *numbers) require_finite(sim::RotateCommand{number});
  }
  request({{"do", "set_object_property"},
           {"name", name},
           {"property", property},
           {"value", protocol::encode_property(value)}});
}

LogStatus SocketSession::control_log(const LogControl& changes) {
  json message = {{"do", "log"}};
  if (changes.file) message["file"] = *changes.file;
  if (changes.replay) message["replay"] = *changes.replay;
  if (changes.rewind) message["rewind"] = true;
  if (changes.running) message["running"] = *changes.running;
  const json answer = request(std::move(message));
  return understood([&] { return protocol::decode_log(protocol::require(answer, "log")); });
}

void SocketSession::close() noexcept {
  if (closed_.exchange(true)) return;
  {
    const Lock lock(mutex_);
    changed_.notify_all();
  }
  line_->close();
}

}  // namespace playerlike
