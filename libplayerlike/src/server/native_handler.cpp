// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/native_handler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <utility>

#include "protocol/codec.h"
#include "protocol/request_codec.h"
#include "server/worker_thread.h"
#include "session/checks.h"
#include "sim/core/number_text.h"

namespace playerlike::server {
namespace {

using protocol::json;
using protocol::ProtocolError;

// Doubles represent all whole numbers up to this one exactly.
constexpr std::int64_t kMaxInteger = std::int64_t{1} << 53U;
constexpr double kMaxTimeout_s = 1e9;

std::int64_t integer_or(const json& object, const char* key, std::int64_t otherwise,
                        std::int64_t least, std::int64_t most) {
  return object.contains(key) ? protocol::require_integer(object, key, least, most) : otherwise;
}

double require_timeout(const json& request) {
  const double timeout_s = protocol::require_number(request, "timeout");
  if (!(timeout_s >= 0.0 && timeout_s <= kMaxTimeout_s)) {
    protocol::refuse_value("timeout", "seconds in 0..1e9", request["timeout"]);
  }
  return timeout_s;
}

}  // namespace

// --- Requests

/// A request that is not part of Session: its name, its keys and its function.
struct NativeHandler::OwnRequest {
  using Method = json (NativeHandler::*)(const json&);
  std::string_view name;
  std::initializer_list<std::string_view> keys;  ///< all allowed keys
  Method handle;                                 ///< null: `read`, `step` and `draw`, handled
                                                 ///< separately
  bool for_watchers = false;                     ///< allowed without a session
};

const NativeHandler::OwnRequest* NativeHandler::find_own_request(std::string_view name) {
  using H = NativeHandler;
  static const OwnRequest kRequests[] = {
      {"read",
       {"id", "do", "wait", "timeout", "thread", "commands", "drawings", "until", "data", "take",
        "others", "joined", "unrepeatable"},
       nullptr},
      {"select", {"id", "do", "numbers", "motions"}, &H::select},
      {"step", {"id", "do", "twists", "thread"}, nullptr},
      {"command", {"id", "do", "device", "command"}, &H::command},
      {"draw", {"id", "do", "drawings"}, nullptr},
      {"time", {"id", "do"}, &H::time, true},
      {"thread_ended", {"id", "do", "thread"}, &H::thread_ended},
      {"watch", {"id", "do", "rate", "canvas"}, &H::watch, true},
      {"leave", {"id", "do"}, &H::leave},
      {"bye", {"id", "do"}, &H::bye, true},
  };
  const auto* const it =
      std::find_if(std::begin(kRequests), std::end(kRequests),
                   [&](const OwnRequest& request) { return request.name == name; });
  return it == std::end(kRequests) ? nullptr : it;
}

// --- Requests

NativeHandler::NativeHandler(Peer& peer, Hub& hub, Terms terms)
    : peer_(peer),
      hub_(hub),
      state_(hub.native_state),
      terms_(std::move(terms)),
      guard_(hub.host(), terms_.rights, terms_.port),
      self_(std::make_shared<NativeHandler*>(this)) {
  if (!terms_.session) return;
  number_ = ++state_->sessions;
  open_session(terms_.follower ? EventRole::kFollower : EventRole::kParticipant);
}

void NativeHandler::open_session(EventRole role) {
  wait_.emplace(
      hub_, terms_.port, role, [this] { answer_waiting(); }, terms_.order);
  wait_->client()->set_process_search(peer_.process_search());
  state_->open[terms_.key] = {number_, terms_.port, terms_.rights.command, terms_.process,
                              wait_->client().get()};
}

NativeHandler::~NativeHandler() {
  state_->watching.forget(peer_);
  if (wait_) state_->open.erase(terms_.key);
  if (wait_ && !ending_) wait_->client()->abandon();
  if (waiting_ && waiting_->timer != 0) hub_.cancel(waiting_->timer);
}

json NativeHandler::tell_canvas() {
  if (!wait_) {
    return protocol::encode_canvas(state_->watching.session().request(CanvasInfoRequest{}));
  }
  // Read the generation first: a change in between is then reported twice, but never missed.
  canvas_generation_ = session().canvas_generation();
  return protocol::encode_canvas(session().request(CanvasInfoRequest{}));
}

void NativeHandler::on_message(std::string_view bytes) {
  if (ending_) return;
  // If a wait is over, it was over before this message.
  answer_waiting();
  json id;
  std::string name;
  guarded(id, name, [&] {
    json message = protocol::decode(bytes, terms_.encoding, &spare_bytes_);
    if (message.contains("id")) id = protocol::require_integer(message, "id", 0, kMaxInteger);
    execute(message, id, name);
    protocol::keep_bytes(message, spare_bytes_);
  });
}

template <typename Action>
void NativeHandler::guarded(const json& id, const std::string& name, Action action) {
  try {
    action();
  } catch (const ProtocolError& error) {
    fail(id, name, error.id(), error.what());
  } catch (const SessionError& error) {
    fail(id, name, protocol::error_id(error.code()), error.what());
  } catch (const std::exception& error) {
    hub_.log(sim::LogLevel::kError, peer_.name() + ": " + error.what());
    fail(id, name, "server/internal", error.what());
  }
}

void NativeHandler::execute(const json& message, const json& id, std::string& name) {
  name = protocol::require_text(message, "do");
  const OwnRequest* own = find_own_request(name);
  const auto type = own == nullptr ? protocol::find_request(name) : std::nullopt;
  if (own == nullptr && !type) {
    throw ProtocolError("protocol/unknown-request",
                        "there is no request of this name; see 'playpen doc protocol'");
  }
  if (!wait_ && (own == nullptr || !own->for_watchers)) {
    throw ProtocolError("access/denied", "this connection only watches, as its hello said");
  }
  if (type) {
    return handle_request(protocol::decode_request(*type, message, terms_.encoding, &spare_cells_),
                          id, name);
  }
  protocol::refuse_unknown_keys(message, own->keys, "this request");
  if (own->handle != nullptr) {
    answer(id, (this->*own->handle)(message));
    if (ending_) peer_.close("");
    return;
  }
  if (name == "read") return read(message, id);
  if (name == "step") return step(message, id);
  auto drawings =
      protocol::decode_drawings(protocol::require(message, "drawings"), terms_.encoding);
  require_drawing(drawings);
  if (draw_here(drawings)) return answer(id, json::object());
  draw_elsewhere(std::move(drawings), id, name, [this, id] { answer(id, json::object()); });
}

void NativeHandler::handle_request(Request request, const json& id, const std::string& name) {
  guard_.check(request);
  if (native_work_cells(request, session(), hub_.host()) > kInlineCells) {
    return answer_elsewhere(std::move(request), id, name);
  }
  answer(id, protocol::encode_answer(request, session().answer(request), terms_.encoding));
  if (auto* const image = std::get_if<SetCellsRequest>(&request)) {
    spare_cells_.keep(std::move(image->cells));
  }
}

// --- Work

void NativeHandler::work(const json& id, const std::string& name, std::function<bool()> run_slice,
                         std::function<void()> then) {
  peer_.set_busy(true);
  const auto done = [weak = std::weak_ptr<NativeHandler*>(self_), id, name,
                     then = std::move(then)](const std::exception_ptr& error) {
    const auto self = weak.lock();
    if (!self) return;
    NativeHandler& handler = **self;
    handler.guarded(id, name, [&] {
      if (error) std::rethrow_exception(error);
      then();
    });
    handler.peer_.set_busy(false);
  };
  hub_.work({std::move(run_slice), done});
}

void NativeHandler::answer_elsewhere(Request request, const json& id, const std::string& name) {
  const std::size_t bytes = native_answer_bytes(request, session(), terms_.encoding);
  std::shared_ptr<void> room = bytes > kSmallAnswer ? hub_.claim_room(bytes) : nullptr;
  struct Made {
    std::string bytes;
    std::uint64_t canvas_generation;
  };
  const auto made = std::make_shared<Made>();
  made->canvas_generation = canvas_generation_;
  // The job holds no reference to the handler, which may be destroyed before the job is done.
  const auto run_slice = [client = wait_->client(), encoding = terms_.encoding,
                          request = std::move(request), id, made] {
    Session& session = client->session();
    json answer = protocol::encode_answer(request, session.answer(request), encoding);
    if (id.is_null()) return false;
    answer["id"] = id;
    // Read the generation first: a change in between is then reported twice, but never missed.
    const std::uint64_t generation = session.canvas_generation();
    if (generation != made->canvas_generation) {
      answer["canvas"] = protocol::encode_canvas(session.request(CanvasInfoRequest{}));
      made->canvas_generation = generation;
    }
    made->bytes = protocol::encode(answer, encoding);
    return false;
  };
  work(id, name, run_slice, [this, made, room = std::move(room)] {
    if (made->bytes.empty()) return;
    canvas_generation_ = std::max(canvas_generation_, made->canvas_generation);
    peer_.send(std::move(made->bytes));
  });
}

void NativeHandler::require_drawing(std::span<const sim::DrawOperation> drawings) const {
  if (guard_.may_draw()) return;
  if (std::any_of(drawings.begin(), drawings.end(),
                  [](const auto& drawing) { return drawing.layer == sim::kBaseLayer; })) {
    guard_.check_canvas();
  }
}

bool NativeHandler::draw_here(std::vector<sim::DrawOperation>& drawings) {
  return light_drawings_.queue(session(), drawings, state_->open.size());
}

void NativeHandler::draw_elsewhere(std::vector<sim::DrawOperation> drawings, const json& id,
                                   const std::string& name, std::function<void()> then) {
  const auto drawing = std::make_shared<DrawWork>();
  drawing->operations = std::move(drawings);
  work(
      id, name,
      [client = wait_->client(), drawing] { return !client->draw_some(*drawing, kSliceCells); },
      std::move(then));
}

void NativeHandler::answer(const json& id, json answer) {
  if (id.is_null()) return;
  answer["id"] = id;
  if (wait_ && session().canvas_generation() != canvas_generation_) {
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

/// The readings in the format of an answer to `read`.
class NativeHandler::ReadingList final : public ReadingSink {
 public:
  ReadingList(const std::vector<RobotInfo>& robots, protocol::Encoding encoding)
      : robots_(robots), encoding_(encoding) {}

  void on_reading(DeviceId device, const sim::SharedReading& reading) override {
    const RobotInfo& robot = robots_[static_cast<std::size_t>(device.robot)];
    const DeviceInfo& info = robot.devices[static_cast<std::size_t>(device.device)];
    ++count_;
    if (encoding_ == protocol::Encoding::kCbor) {
      protocol::append_cbor_reading(device, info.type, *reading, items_);
    } else {
      list_.push_back(protocol::encode_reading(device, info.type, *reading, encoding_));
    }
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] json take() {
    if (encoding_ != protocol::Encoding::kCbor) return std::move(list_);
    return protocol::encoded_list(count_, items_);
  }

 private:
  const std::vector<RobotInfo>& robots_;
  protocol::Encoding encoding_;
  std::size_t count_ = 0;
  json list_ = json::array();
  std::string items_;
};

ThreadId NativeHandler::thread_id(const json& request) {
  const std::int64_t thread = integer_or(request, "thread", 0, 0, kMaxInteger);
  return hub_.thread_id(terms_.process, static_cast<std::uint64_t>(thread));
}

void NativeHandler::read(const json& request, const json& id) {
  static constexpr std::array<std::string_view, 6> kWaits{"data",  "peek", "sleep",
                                                          "turns", "join", "none"};
  const std::string text = protocol::require_text(request, "wait");
  const auto found = std::find(kWaits.begin(), kWaits.end(), text);
  if (found == kWaits.end()) {
    protocol::refuse_value("wait", "data, peek, sleep, turns, join or none", request["wait"]);
  }
  const auto wait = static_cast<Wait>(found - kWaits.begin());
  if (wait != Wait::kNone && waiting_) {
    throw ProtocolError("protocol/busy", "another read of this session waits; one can at a time");
  }
  if (wait == Wait::kSleep || (wait == Wait::kPeek && request.contains("timeout"))) {
    static_cast<void>(require_timeout(request));
  }
  static_cast<void>(integer_or(request, "thread", 0, 0, kMaxInteger));
  if (wait == Wait::kTurns) {
    static_cast<void>(turns_wait(request));
    note_unrepeatable(request);
  }

  // Checks all commands before the first one is sent: a request that fails has no effect.
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  if (request.contains("commands")) {
    const json& list = request["commands"];
    if (!list.is_array()) protocol::refuse_value("commands", "a list", list);
    commands.reserve(list.size());
    for (const json& item : list) {
      protocol::refuse_unknown_keys(item, {"device", "command"}, "an item of commands");
      commands.emplace_back(protocol::require_device_id(item, "device"),
                            protocol::decode_command(protocol::require(item, "command")));
      guard_.check_command(commands.back().first);
    }
  }
  std::vector<sim::DrawOperation> drawings;
  if (request.contains("drawings")) {
    drawings = protocol::decode_drawings(request["drawings"], terms_.encoding);
  }
  require_drawing(drawings);
  const auto go_on = [this, id, wait](const auto& list, const json& what) {
    for (const auto& [device, command] : list) session().send(device, command);
    if (wait == Wait::kJoin) wait_->client()->join(thread_id(what));
    if (wait == Wait::kJoin || wait == Wait::kNone) return answer(id, round(wait, Outcome::kData));
    begin_to_wait(what, id, wait);
  };
  if (draw_here(drawings)) return go_on(commands, request);
  json rest = json::object();
  for (const char* key : {"thread", "timeout", "until", "data", "take", "others", "joined"}) {
    if (request.contains(key)) rest[key] = request[key];
  }
  draw_elsewhere(
      std::move(drawings), id, "read",
      [go_on, commands = std::move(commands), rest = std::move(rest)] { go_on(commands, rest); });
}

NativeHandler::Outcome NativeHandler::begin(Wait wait, const json& request) {
  const ThreadId who = thread_id(request);
  if (wait == Wait::kData) return wait_->client()->begin_wait(who);
  if (wait == Wait::kSleep) return wait_->client()->begin_sleep(who, require_timeout(request));
  if (wait == Wait::kTurns) return wait_->client()->begin_turns_wait(who, turns_wait(request));
  const double timeout_s = request.contains("timeout") ? require_timeout(request) : 0.0;
  const std::chrono::milliseconds timeout(std::llround(timeout_s * 1e3));
  const Outcome outcome = wait_->client()->begin_peek(who, timeout);
  // In a paced simulation the host does not end a peek, see EventClient, so a timer does. The mode
  // is checked after the start: if the simulation becomes paced later, the peek ends by simulated
  // time.
  if (outcome != Outcome::kWaiting || hub_.host().time().mode != sim::TimeMode::kPaced) {
    return outcome;
  }
  waiting_->timer = hub_.after(timeout, [weak = std::weak_ptr<NativeHandler*>(self_)] {
    if (const auto self = weak.lock()) (*self)->on_peek_timeout();
  });
  return outcome;
}

void NativeHandler::begin_to_wait(const json& request, const json& id, Wait wait) {
  const bool take = wait != Wait::kTurns || protocol::require_bool(request, "take");
  waiting_ = {id, wait, take};
  try {
    const Outcome outcome = wait_->begin([&] { return begin(wait, request); });
    if (outcome == Outcome::kWaiting) return peer_.set_in_flight(1);
    if (waiting_->timer != 0) hub_.cancel(waiting_->timer);
    waiting_.reset();
    answer(id, round(wait, outcome, take));
  } catch (...) {
    waiting_.reset();
    throw;
  }
}

void NativeHandler::answer_waiting() {
  if (!waiting_ || waiting_->rests) return;
  const Outcome outcome = wait_->client()->outcome();
  if (outcome == Outcome::kWaiting) return;
  const Waiting done = std::move(*waiting_);
  waiting_.reset();
  if (done.timer != 0) hub_.cancel(done.timer);
  peer_.set_in_flight(0);
  guarded(done.id, done.wait == Wait::kStep ? "step" : "read", [&] {
    if (done.wait == Wait::kStep && !step_is_over(outcome)) {
      return wait_for_step(done.id, done.thread);
    }
    answer(done.id, round(done.wait, outcome, done.take));
  });
}

void NativeHandler::go_on_with_step() {
  if (!waiting_ || !waiting_->rests) return;
  const Waiting step = *waiting_;
  guarded(step.id, "step", [&] { wait_for_step(step.id, step.thread); });
}

void NativeHandler::on_peek_timeout() {
  if (!waiting_) return;
  waiting_->timer = 0;
  if (wait_->client()->outcome() == Outcome::kWaiting) wait_->client()->cancel();
  answer_waiting();
}

// The answer to a `read` for the outcome of its wait. A cancelled wait has timed out.
json NativeHandler::round(Wait wait, Outcome outcome, bool take) {
  if (wait == Wait::kStep) return round_of_step();
  if (outcome != Outcome::kIdle && wait != Wait::kNone) light_drawings_.note_step();
  if (wait == Wait::kData && outcome == Outcome::kFinished) {
    throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
  }
  if (wait == Wait::kData && outcome != Outcome::kData) {
    throw SessionError(SessionError::Code::kDisconnected, "the session is closed");
  }
  if (wait == Wait::kTurns) return round_of_turns(take && outcome == Outcome::kData);
  const bool looks = wait == Wait::kData || wait == Wait::kPeek || wait == Wait::kNone;
  const bool takes = looks && (outcome == Outcome::kData || outcome == Outcome::kFinished);
  json answer = json::object();
  const TimeStatistics time = hub_.host().time();
  const bool some = takes && take_readings(answer) > 0;
  if (!takes) answer["readings"] = json::array();
  answer["data"] = some || (wait != Wait::kNone && takes);
  answer["t"] = time.sim_time_ns;
  answer["finished"] = time.finished;
  answer["overflow"] = session().request(OverflowRequest{});
  return answer;
}

std::size_t NativeHandler::take_readings(json& answer) {
  ReadingList list(hub_.host().robots(), terms_.encoding);
  session().take(list);
  answer["readings"] = list.take();
  return list.count();
}

// --- Commands

json NativeHandler::command(const json& request) {
  const DeviceId device = protocol::require_device_id(request, "device");
  const sim::Command command = protocol::decode_command(protocol::require(request, "command"));
  guard_.check_command(device);
  session().send(device, command);
  return json::object();
}

// --- Time

json NativeHandler::time(const json& /*request*/) {
  return {{"time", protocol::encode_time(hub_.host().time())}};
}

json NativeHandler::thread_ended(const json& request) {
  static_cast<void>(protocol::require_integer(request, "thread", 0, kMaxInteger));
  hub_.host().thread_ended(thread_id(request));
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
    throw ProtocolError(
        "access/denied",
        terms_.rights.truth
            ? "watchers must present a token in hello"
            : "this world is private (\"privacy\" in its \"simulation\"): watchers see "
              "all robots, and must present the tokens of all robots in hello");
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
