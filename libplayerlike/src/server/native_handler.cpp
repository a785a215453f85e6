// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/native_handler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <utility>

#include "protocol/codec.h"
#include "session/checks.h"
#include "sim/core/number_text.h"
#include "sim/world/view_mode.h"

namespace playerlike::server {
namespace {

using protocol::json;
using protocol::ProtocolError;

// Whole numbers up to here are whole numbers in every language's doubles.
constexpr std::int64_t kMaxInteger = std::int64_t{1} << 53U;
constexpr int kMaxSide = 1 << 14;  // of a rectangle; canvases have no more than 8192
constexpr int kMaxCell = 1 << 30;
// Cells of a map: more would take the server's thread, or the simulation's lock, for too long.
constexpr double kMaxMapCells = 1 << 22;
constexpr double kMaxTimeout_s = 1e9;
constexpr std::size_t kMaxReason = 200;

// The signal whose wait this thread is beginning: it looks at the outcome itself.
thread_local const void* beginning = nullptr;

class Beginning {
 public:
  explicit Beginning(const void* who) { beginning = who; }
  ~Beginning() { beginning = nullptr; }
  Beginning(const Beginning&) = delete;
  Beginning& operator=(const Beginning&) = delete;
};

std::int64_t integer_or(const json& object, const char* key, std::int64_t otherwise,
                        std::int64_t least, std::int64_t most) {
  return object.contains(key) ? protocol::require_integer(object, key, least, most) : otherwise;
}

sim::LayerId require_layer(const json& request) {
  return static_cast<sim::LayerId>(protocol::require_integer(request, "layer", 0, kMaxCell));
}

double require_timeout(const json& request) {
  const double timeout_s = protocol::require_number(request, "timeout");
  if (!(timeout_s >= 0.0 && timeout_s <= kMaxTimeout_s)) {
    protocol::refuse_value("timeout", "seconds in 0..1e9", request["timeout"]);
  }
  return timeout_s;
}

sim::CellRect require_rect(const json& request, const char* key = "rect") {
  const json& rect = protocol::require(request, key);
  if (!rect.is_array() || rect.size() != 4) {
    protocol::refuse_value(key, "[column, row, width, height]", rect);
  }
  const auto number = [&](std::size_t i, std::int64_t least, std::int64_t most) {
    return static_cast<int>(protocol::require_integer({{key, rect[i]}}, key, least, most));
  };
  return {number(0, -kMaxCell, kMaxCell), number(1, -kMaxCell, kMaxCell), number(2, 0, kMaxSide),
          number(3, 0, kMaxSide)};
}

}  // namespace

// --- Requests

/// A request's name and keys, and what carries it out.
struct NativeHandler::Request {
  using Carry = json (NativeHandler::*)(const json&);
  std::string_view name;
  std::initializer_list<std::string_view> keys;  ///< all that are known
  Carry carry;                                   ///< none: `read`
  bool for_watchers = false;                     ///< needs no session
};

const NativeHandler::Request* NativeHandler::find_request(std::string_view name) {
  using H = NativeHandler;
  static const Request kRequests[] = {
      {"read", {"id", "do", "wait", "timeout", "thread", "commands", "drawings"}, nullptr},
      {"command", {"id", "do", "device", "command"}, &H::command},
      {"draw", {"id", "do", "drawings"}, &H::draw},
      {"set_cells", {"id", "do", "layer", "rect", "cells"}, &H::set_cells},
      {"cell", {"id", "do", "layer", "column", "row"}, &H::cell},
      {"cells", {"id", "do", "layer"}, &H::cells},
      {"subscribe", {"id", "do", "device"}, &H::subscribe},
      {"unsubscribe", {"id", "do", "device"}, &H::unsubscribe},
      {"replace", {"id", "do", "device", "replace"}, &H::replace},
      {"create_layer", {"id", "do", "kind", "style"}, &H::create_layer},
      {"remove_layer", {"id", "do", "layer"}, &H::remove_layer},
      {"set_layer_style", {"id", "do", "layer", "style"}, &H::set_layer_style},
      {"layers", {"id", "do"}, &H::layers},
      {"canvas_image", {"id", "do"}, &H::canvas_image},
      {"resize_canvas", {"id", "do", "width", "height"}, &H::resize_canvas},
      {"save_image", {"id", "do", "name", "scale", "layer"}, &H::save_image},
      {"save_map", {"id", "do", "layer", "name", "mode"}, &H::save_map},
      {"view_mode", {"id", "do"}, &H::view_mode},
      {"set_view_mode", {"id", "do", "mode"}, &H::set_view_mode},
      {"world_map", {"id", "do", "cell_size", "tile"}, &H::world_map},
      {"object_pose", {"id", "do", "name"}, &H::object_pose},
      {"place_object", {"id", "do", "name", "pose"}, &H::place_object},
      {"object_property", {"id", "do", "name", "property"}, &H::object_property},
      {"set_object_property", {"id", "do", "name", "property", "value"}, &H::set_object_property},
      {"log", {"id", "do", "file", "replay", "rewind", "running"}, &H::log},
      {"time", {"id", "do"}, &H::time, true},
      {"prefer_real_time", {"id", "do", "reason"}, &H::prefer_real_time},
      {"thread_ended", {"id", "do", "thread"}, &H::thread_ended},
      {"watch", {"id", "do", "rate", "canvas"}, &H::watch, true},
      {"bye", {"id", "do"}, &H::bye, true},
  };
  const auto it = std::find_if(std::begin(kRequests), std::end(kRequests),
                               [&](const Request& request) { return request.name == name; });
  return it == std::end(kRequests) ? nullptr : it;
}

NativeHandler::NativeHandler(Peer& peer, Hub& hub, Terms terms)
    : peer_(peer),
      hub_(hub),
      state_(hub.native_state),
      terms_(std::move(terms)),
      self_(std::make_shared<NativeHandler*>(this)) {
  if (!terms_.session) return;
  const void* me = self_.get();
  const auto notify = [&hub, me, weak = std::weak_ptr<NativeHandler*>(self_)] {
    if (beginning == me) return;
    hub.post([weak] {
      if (const auto self = weak.lock()) (*self)->answer_waiting();
    });
  };
  client_ = hub_.host().connect_events(terms_.port, notify, terms_.follower);
  state_->leaders[terms_.key] = {terms_.port, terms_.rights.command};
}

NativeHandler::~NativeHandler() {
  state_->watching.forget(peer_);
  if (client_) state_->leaders.erase(terms_.key);
  if (waiting_ && waiting_->timer != 0) hub_.cancel(waiting_->timer);
}

json NativeHandler::tell_canvas() {
  if (!client_) {
    sim::CanvasDescription canvas;
    hub_.host().with_simulation(
        [&](sim::Simulation& simulation) { canvas = simulation.layers().description(); });
    return protocol::encode_canvas(
        {canvas.width, canvas.height, canvas.cell_size_m, canvas.origin.x(), canvas.origin.y()});
  }
  // In this order: what changes in between is told of twice.
  canvas_generation_ = session().canvas_generation();
  return protocol::encode_canvas(session().canvas_info());
}

void NativeHandler::on_message(std::string_view bytes) {
  if (ending_) return;
  // A wait that is over was so before this message.
  answer_waiting();
  json id;
  std::string name;
  const auto refuse = [&](std::string_view error, const char* message) {
    fail(id, name, error, message);
  };
  try {
    const json message = protocol::decode(bytes, terms_.encoding);
    if (message.contains("id")) id = protocol::require_integer(message, "id", 0, kMaxInteger);
    carry_out(message, id, name);
  } catch (const ProtocolError& error) {
    refuse(error.id(), error.what());
  } catch (const SessionError& error) {
    refuse(protocol::error_id(error.code()), error.what());
  } catch (const std::exception& error) {
    hub_.log(sim::LogLevel::kError, peer_.name() + ": " + error.what());
    refuse("server/internal", error.what());
  }
}

void NativeHandler::carry_out(const json& message, const json& id, std::string& name) {
  name = protocol::require_text(message, "do");
  const Request* request = find_request(name);
  if (request == nullptr) {
    throw ProtocolError("protocol/unknown-request",
                        "there is no request of this name; see docs/protocol.md");
  }
  if (!client_ && !request->for_watchers) {
    throw ProtocolError("access/denied", "this connection only watches, as its hello said");
  }
  protocol::refuse_unknown_keys(message, request->keys, "this request");
  if (request->carry == nullptr) return read(message, id);
  answer(id, (this->*request->carry)(message));
  if (ending_) peer_.close("");
}

void NativeHandler::answer(const json& id, json answer) {
  if (id.is_null()) return;
  answer["id"] = id;
  if (client_ && session().canvas_generation() != canvas_generation_) {
    answer["canvas"] = tell_canvas();
  }
  peer_.send(protocol::encode(answer, terms_.encoding));
}

void NativeHandler::fail(const json& id, const std::string& name, std::string_view error,
                         const char* message) {
  json answer = {{"error", error}, {"message", message}};
  if (id.is_null()) {
    answer["event"] = "error";
    if (!name.empty()) answer["do"] = name;
  } else {
    answer["id"] = id;
  }
  peer_.send(protocol::encode(answer, terms_.encoding));
}

std::string NativeHandler::farewell(const ProtocolError& error) {
  if (error.id() == "server/closing") {
    return protocol::encode({{"event", "bye"}, {"message", error.what()}}, terms_.encoding);
  }
  return protocol::encode({{"event", "error"}, {"error", error.id()}, {"message", error.what()}},
                          terms_.encoding);
}

// --- Reading

/// Readings as the answer to a `read` has them.
class NativeHandler::ReadingList final : public ReadingSink {
 public:
  ReadingList(const std::vector<RobotInfo>& robots, protocol::Encoding encoding)
      : robots_(robots), encoding_(encoding) {}

  void on_reading(DeviceId device, const sim::Reading& reading) override {
    const RobotInfo& robot = robots_[static_cast<std::size_t>(device.robot)];
    const DeviceInfo& info = robot.devices[static_cast<std::size_t>(device.device)];
    list_.push_back(protocol::encode_reading(device, info.type, reading, encoding_));
  }
  [[nodiscard]] json take() { return std::move(list_); }

 private:
  const std::vector<RobotInfo>& robots_;
  protocol::Encoding encoding_;
  json list_ = json::array();
};

ThinkerId NativeHandler::thinker(const json& request) {
  const std::int64_t thread = integer_or(request, "thread", 0, 0, kMaxInteger);
  return hub_.thinker(terms_.process, static_cast<std::uint64_t>(thread));
}

void NativeHandler::read(const json& request, const json& id) {
  static constexpr std::array<std::string_view, 5> kWaits{"data", "peek", "sleep", "join", "none"};
  const std::string text = protocol::require_text(request, "wait");
  const auto found = std::find(kWaits.begin(), kWaits.end(), text);
  if (found == kWaits.end()) {
    protocol::refuse_value("wait", "data, peek, sleep, join or none", request["wait"]);
  }
  const auto wait = static_cast<Wait>(found - kWaits.begin());
  if (wait != Wait::kNone && waiting_) {
    throw ProtocolError("protocol/busy", "another read of this session waits; one can at a time");
  }
  if (wait == Wait::kSleep || (wait == Wait::kPeek && request.contains("timeout"))) {
    static_cast<void>(require_timeout(request));
  }
  static_cast<void>(integer_or(request, "thread", 0, 0, kMaxInteger));

  // First all is looked at, then all is done: a request that fails has done nothing.
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  if (request.contains("commands")) {
    const json& list = request["commands"];
    if (!list.is_array()) protocol::refuse_value("commands", "a list", list);
    commands.reserve(list.size());
    for (const json& item : list) {
      protocol::refuse_unknown_keys(item, {"device", "command"}, "an item of commands");
      commands.emplace_back(protocol::require_device_id(item, "device"),
                            protocol::decode_command(protocol::require(item, "command")));
      require_command(commands.back().first);
    }
  }
  std::vector<sim::DrawOperation> drawings;
  if (request.contains("drawings")) {
    drawings = protocol::decode_drawings(request["drawings"], terms_.encoding);
  }
  session().draw(drawings);
  for (const auto& [device, command] : commands) session().send(device, command);

  if (wait == Wait::kJoin) client_->join(thinker(request));
  if (wait == Wait::kJoin || wait == Wait::kNone) return answer(id, round(wait, Outcome::kData));
  begin_to_wait(request, id, wait);
}

NativeHandler::Outcome NativeHandler::begin(Wait wait, const json& request) {
  const ThinkerId who = thinker(request);
  if (wait == Wait::kData) return client_->begin_wait(who);
  if (wait == Wait::kSleep) return client_->begin_sleep(who, require_timeout(request));
  const double timeout_s = request.contains("timeout") ? require_timeout(request) : 0.0;
  const std::chrono::milliseconds timeout(std::llround(timeout_s * 1e3));
  const Outcome outcome = client_->begin_peek(who, timeout);
  // In a paced simulation it does not end by itself, see EventClient. Asked afterwards: one that
  // becomes paced later lets it end by simulated time.
  if (outcome != Outcome::kWaiting || hub_.host().time().mode != sim::TimeMode::kPaced) {
    return outcome;
  }
  waiting_->timer = hub_.after(timeout, [weak = std::weak_ptr<NativeHandler*>(self_)] {
    if (const auto self = weak.lock()) (*self)->on_peek_timeout();
  });
  return outcome;
}

void NativeHandler::begin_to_wait(const json& request, const json& id, Wait wait) {
  waiting_ = {id, wait};
  try {
    Outcome outcome;
    {
      const Beginning scope(self_.get());
      outcome = begin(wait, request);
      // Most often time can go on at once, and then the wait is over without another turn of the
      // server's thread.
      if (outcome == Outcome::kWaiting) hub_.pump();
    }
    if (outcome == Outcome::kWaiting) {
      if (waiting_) answer_waiting();
      if (waiting_) peer_.set_in_flight(1);
      return;
    }
    waiting_.reset();
    answer(id, round(wait, outcome));
  } catch (...) {
    waiting_.reset();
    throw;
  }
}

void NativeHandler::answer_waiting() {
  if (!waiting_) return;
  const Outcome outcome = client_->outcome();
  if (outcome == Outcome::kWaiting) return;
  const Waiting done = std::move(*waiting_);
  waiting_.reset();
  if (done.timer != 0) hub_.cancel(done.timer);
  peer_.set_in_flight(0);
  try {
    answer(done.id, round(done.wait, outcome));
  } catch (const SessionError& error) {
    fail(done.id, "read", protocol::error_id(error.code()), error.what());
  } catch (const std::exception& error) {
    fail(done.id, "read", "server/internal", error.what());
  }
}

void NativeHandler::on_peek_timeout() {
  if (!waiting_) return;
  waiting_->timer = 0;
  if (client_->outcome() == Outcome::kWaiting) client_->cancel();
  answer_waiting();
}

// What a `read` is answered when its wait has come out so; one that was cancelled was by time.
json NativeHandler::round(Wait wait, Outcome outcome) {
  if (wait == Wait::kData && outcome == Outcome::kFinished) {
    throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
  }
  if (wait == Wait::kData && outcome != Outcome::kData) {
    throw SessionError(SessionError::Code::kDisconnected, "the session is closed");
  }
  const bool looks = wait == Wait::kData || wait == Wait::kPeek || wait == Wait::kNone;
  const bool takes = looks && (outcome == Outcome::kData || outcome == Outcome::kFinished);
  json answer = {{"readings", takes ? readings() : json::array()}};
  const TimeStatistics time = hub_.host().time();
  const bool some = !answer["readings"].empty();
  answer["data"] = some || (wait != Wait::kNone && takes);
  answer["t"] = time.sim_time_ns;
  answer["finished"] = time.finished;
  answer["overflow"] = session().overflow_count();
  return answer;
}

json NativeHandler::readings() {
  ReadingList list(hub_.host().robots(), terms_.encoding);
  session().take(list);
  return list.take();
}

// --- Commands

void NativeHandler::require_command(DeviceId device) const {
  require_device(hub_.host().robots(), device);
  const auto robot = static_cast<std::size_t>(device.robot);
  if (robot < terms_.rights.command.size() && terms_.rights.command[robot]) return;
  throw ProtocolError("access/denied", "robot " + hub_.host().robots()[robot].name +
                                           " obeys only those whose hello has its token");
}

json NativeHandler::command(const json& request) {
  const DeviceId device = protocol::require_device_id(request, "device");
  const sim::Command command = protocol::decode_command(protocol::require(request, "command"));
  require_command(device);
  session().send(device, command);
  return json::object();
}

json NativeHandler::subscribe(const json& request) {
  session().subscribe(protocol::require_device_id(request, "device"));
  return json::object();
}

json NativeHandler::unsubscribe(const json& request) {
  session().unsubscribe(protocol::require_device_id(request, "device"));
  return json::object();
}

json NativeHandler::replace(const json& request) {
  std::optional<DeviceId> device;
  if (request.contains("device") && !request["device"].is_null()) {
    device = protocol::require_device_id(request, "device");
    require_device(hub_.host().robots(), *device);
  }
  session().set_replace(device, protocol::require_bool(request, "replace"));
  return json::object();
}

// --- The canvas

json NativeHandler::draw(const json& request) {
  const json& drawings = protocol::require(request, "drawings");
  session().draw(protocol::decode_drawings(drawings, terms_.encoding));
  return json::object();
}

json NativeHandler::set_cells(const json& request) {
  const json& cells = protocol::require(request, "cells");
  session().draw_cells(require_layer(request), require_rect(request),
                       protocol::decode_cells(cells, terms_.encoding));
  return json::object();
}

json NativeHandler::cell(const json& request) {
  const auto column = protocol::require_integer(request, "column", -kMaxCell, kMaxCell);
  const auto row = protocol::require_integer(request, "row", -kMaxCell, kMaxCell);
  const std::optional<sim::CellValue> value =
      session().cell(require_layer(request), static_cast<int>(column), static_cast<int>(row));
  return {
      {"cell", value ? protocol::encode_cells(std::span(&*value, 1), terms_.encoding) : json()}};
}

json NativeHandler::cells(const json& request) {
  const std::vector<sim::CellValue> cells = session().cells(require_layer(request));
  return {{"cells", protocol::encode_cells(cells, terms_.encoding)}};
}

json NativeHandler::create_layer(const json& request) {
  const sim::LayerKind kind = protocol::decode_layer_kind(protocol::require(request, "kind"));
  const sim::LayerStyle style = protocol::decode_style(protocol::require(request, "style"));
  return {{"layer", session().create_layer(kind, style)}};
}

json NativeHandler::remove_layer(const json& request) {
  session().remove_layer(require_layer(request));
  return json::object();
}

json NativeHandler::set_layer_style(const json& request) {
  const sim::LayerStyle style = protocol::decode_style(protocol::require(request, "style"));
  session().set_layer_style(require_layer(request), style);
  return json::object();
}

json NativeHandler::layers(const json& /*request*/) {
  return {{"layers", protocol::encode_layers(session().layers())}};
}

json NativeHandler::canvas_image(const json& /*request*/) {
  json answer = {{"image", protocol::bytes(session().canvas_image(), terms_.encoding)}};
  answer["canvas"] = tell_canvas();
  return answer;
}

json NativeHandler::resize_canvas(const json& request) {
  const auto side = [&](const char* key) {
    return static_cast<int>(protocol::require_integer(request, key, -kMaxCell, kMaxCell));
  };
  session().resize_canvas(side("width"), side("height"));
  return {{"canvas", tell_canvas()}};
}

json NativeHandler::save_image(const json& request) {
  const auto scale = integer_or(request, "scale", 1, -kMaxCell, kMaxCell);
  std::optional<sim::LayerId> layer;
  if (request.contains("layer")) layer = require_layer(request);
  session().save_image(protocol::require_text(request, "name"), static_cast<int>(scale), layer);
  return json::object();
}

json NativeHandler::save_map(const json& request) {
  sim::io::MapMode mode = sim::io::MapMode::kTrinary;
  if (request.contains("mode")) {
    const auto named = sim::io::parse_map_mode(protocol::require_text(request, "mode"));
    if (!named) protocol::refuse_value("mode", "trinary or scale", request["mode"]);
    mode = *named;
  }
  session().save_map(require_layer(request), protocol::require_text(request, "name"), mode);
  return json::object();
}

json NativeHandler::view_mode(const json& /*request*/) {
  return {{"mode", sim::to_string(session().view_mode())}};
}

json NativeHandler::set_view_mode(const json& request) {
  const auto mode = sim::parse_view_mode(protocol::require_text(request, "mode"));
  if (!mode) protocol::refuse_value("mode", "ground, mini-map or full-screen", request["mode"]);
  session().set_view_mode(*mode);
  return json::object();
}

json NativeHandler::world_map(const json& request) {
  const double cell_size_m = protocol::require_number(request, "cell_size");
  if (request.contains("tile")) {
    const sim::CellRect tile = require_rect(request, "tile");
    if (static_cast<double>(tile.width) * tile.height > kMaxMapCells) {
      protocol::refuse_value("tile", "at most 4194304 cells", request["tile"]);
    }
    return map_tile(cell_size_m, tile);
  }
  sim::Vec2 arena_m;
  hub_.host().with_simulation(
      [&](sim::Simulation& simulation) { arena_m = simulation.world().arena.size; });
  if (cell_size_m > 0.0 && (arena_m / cell_size_m).prod() > kMaxMapCells) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a server makes maps of up to 4194304 cells: a cell of this arena must be " +
                           sim::rounded_text(std::sqrt(arena_m.prod() / kMaxMapCells), 6) +
                           " m long at least, unless the map is asked for in tiles");
  }
  return {{"map", protocol::encode_map(session().world_map(cell_size_m), terms_.encoding)}};
}

json NativeHandler::map_tile(double cell_size_m, const sim::CellRect& tile) {
  sim::OccupancyMap map;
  sim::CanvasDescription grid;
  hub_.host().with_simulation([&](sim::Simulation& simulation) {
    const sim::ArenaDescription& arena = simulation.world().arena;
    grid = map_grid(arena, cell_size_m);
    const int right = std::clamp(tile.column + tile.width, 0, grid.width);
    const int bottom = std::clamp(tile.row + tile.height, 0, grid.height);
    const int left = std::clamp(tile.column, 0, right);
    const int top = std::clamp(tile.row, 0, bottom);
    sim::CanvasDescription part = grid;
    part.width = right - left;
    part.height = bottom - top;
    part.origin += cell_size_m * sim::Vec2(left, grid.height - bottom);
    if (part.width > 0 && part.height > 0) map = sim::true_map(arena, part);
  });
  if (map.cells.empty()) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the map has no such tile: it has " + std::to_string(grid.width) + " x " +
                           std::to_string(grid.height) + " cells");
  }
  return {{"map", protocol::encode_map(map, terms_.encoding)},
          {"width", grid.width},
          {"height", grid.height},
          {"origin", protocol::encode_pose({grid.origin.x(), grid.origin.y(), 0.0})}};
}

// --- Objects by name, and the log

void NativeHandler::require_rights(int robot) const {
  if (robot < 0) {
    if (terms_.rights.command_all()) return;
    throw ProtocolError("access/denied",
                        "this concerns all robots: only who may command each of them may do it");
  }
  const auto index = static_cast<std::size_t>(robot);
  if (index < terms_.rights.command.size() && terms_.rights.command[index]) return;
  throw ProtocolError("access/denied", "robot " + hub_.host().robots()[index].name +
                                           " obeys only those whose hello has its token");
}

// Of an object's robot; -1 for anything else.
int NativeHandler::robot_named(const std::string& name) const {
  const auto& robots = hub_.host().robots();
  const auto it = std::find_if(robots.begin(), robots.end(),
                               [&](const RobotInfo& robot) { return robot.name == name; });
  return it == robots.end() ? -1 : static_cast<int>(it - robots.begin());
}

json NativeHandler::object_pose(const json& request) {
  const ObjectPose object = session().object_pose(protocol::require_text(request, "name"));
  return {{"pose", protocol::encode_pose(object.pose)}, {"t", object.time_ns}};
}

json NativeHandler::place_object(const json& request) {
  const std::string name = protocol::require_text(request, "name");
  const sim::Pose pose = protocol::require_pose(request, "pose");
  require_rights(robot_named(name));
  session().place_object(name, pose);
  return json::object();
}

json NativeHandler::object_property(const json& request) {
  return {{"value", protocol::encode_property(
                        session().object_property(protocol::require_text(request, "name"),
                                                  protocol::require_text(request, "property")))}};
}

json NativeHandler::set_object_property(const json& request) {
  const std::string name = protocol::require_text(request, "name");
  const std::string property = protocol::require_text(request, "property");
  const PropertyValue value = protocol::require_property(request, "value");
  require_rights(robot_named(name));
  session().set_object_property(name, property, value);
  return json::object();
}

json NativeHandler::log(const json& request) {
  LogControl changes;
  if (request.contains("file")) changes.file = protocol::require_text(request, "file");
  if (request.contains("replay")) changes.replay = protocol::require_bool(request, "replay");
  if (request.contains("rewind")) changes.rewind = protocol::require_bool(request, "rewind");
  if (request.contains("running")) changes.running = protocol::require_bool(request, "running");
  if (changes.file || changes.replay || changes.rewind || changes.running) {
    int robot = -1;
    const auto& robots = hub_.host().robots();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (robots[i].port == terms_.port) robot = static_cast<int>(i);
    }
    require_rights(robot);
  }
  return {{"log", protocol::encode_log(session().control_log(changes))}};
}

// --- Time

json NativeHandler::time(const json& /*request*/) {
  return {{"time", protocol::encode_time(hub_.host().time())}};
}

json NativeHandler::prefer_real_time(const json& request) {
  const std::string reason = protocol::require_text(request, "reason");
  // It is logged.
  if (reason.size() > kMaxReason || !is_printable(reason)) {
    protocol::refuse_value("reason", "at most 200 printable bytes", request["reason"]);
  }
  session().prefer_real_time(reason);
  return json::object();
}

json NativeHandler::thread_ended(const json& request) {
  static_cast<void>(protocol::require_integer(request, "thread", 0, kMaxInteger));
  hub_.host().thinker_ended(thinker(request));
  hub_.pump();
  return json::object();
}

// --- Watching and the end

json NativeHandler::watch(const json& request) {
  const double rate_hz = protocol::require_number(request, "rate");
  const bool canvas = request.contains("canvas") && protocol::require_bool(request, "canvas");
  if (rate_hz != 0.0 && !(rate_hz >= WatchHub::kMinRate_hz && rate_hz <= WatchHub::kMaxRate_hz)) {
    protocol::refuse_value("rate", "events a second, 0.01..60, or 0", request["rate"]);
  }
  if (!terms_.rights.watch) {
    throw ProtocolError("access/denied", "who watches must present a token in hello");
  }
  state_->watching.forget(peer_);
  if (rate_hz > 0.0) state_->watching.watch(peer_, terms_.encoding, rate_hz, canvas);
  return json::object();
}

json NativeHandler::bye(const json& /*request*/) {
  ending_ = true;
  return json::object();
}

}  // namespace playerlike::server
