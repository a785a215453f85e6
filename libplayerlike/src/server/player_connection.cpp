// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/player_connection.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "libplayerinterface/player_constants.h"
#include "playerlike/server/server_settings.h"
#include "proxies/interfaces.h"
#include "session/checks.h"
#include "sim/core/time.h"

namespace playerlike::server {
namespace {

using player::Devaddr;
using protocol::ProtocolError;

// More rules are refused; real clients have one for each device at most.
constexpr std::size_t kMaxRules = 256;
constexpr int kMaxNotes = 20;
// A client that sends without a pause must not stop time.
constexpr int kMaxTurns = 16;

bool same_device(const Devaddr& a, const Devaddr& b) {
  return a.interf == b.interf && a.index == b.index;
}

bool matches(std::int32_t rule, std::int32_t value) { return rule == -1 || rule == value; }

std::string device_text(const Devaddr& address) {
  const char* const name = PlayerCc::interface_name(address.interf);
  return (name == nullptr ? "interface " + std::to_string(address.interf) : std::string(name)) +
         ':' + std::to_string(address.index);
}

}  // namespace

PlayerConnection::PlayerConnection(Peer& peer, Hub& hub, int robot_port, int tcp_port)
    : peer_(peer),
      hub_(hub),
      robot_port_(robot_port),
      tcp_port_(tcp_port),
      host_(peer.own_ipv4()),
      state_(hub.player_state ? hub.player_state
                              : hub.player_state = std::make_shared<PlayerState>()),
      self_(std::make_shared<PlayerConnection*>(this)),
      rights_(hub.access().rights({}, robot_port)),
      guard_(hub.host(), rights_, robot_port, hub.settings().onlookers),
      wait_(hub, robot_port,
            hub.settings().onlookers ? EventRole::kOnlooker : EventRole::kParticipant,
            [this] { on_wait_end(); }),
      session_(wait_.session(), guard_) {
  wait_.client()->set_process_search(peer_.process_search());
  peer_.set_framing(protocol::Framing::kPlayer);
  peer_.acknowledge_at_once();
  peer_.describe("player, port " + std::to_string(tcp_port_));
  // Player queues all data until a client says otherwise.
  session_.request(ReplaceRequest{std::nullopt, false});
  peer_.send(player::banner());
  state_->peers.push_back(&peer_);
}

PlayerConnection::~PlayerConnection() { std::erase(state_->peers, &peer_); }

void PlayerConnection::on_message(std::string_view bytes) {
  try {
    handle(player::parse_message(bytes));
  } catch (...) {
    flush();
    throw;
  }
  flush();
}

std::string PlayerConnection::farewell(const ProtocolError& error) {
  // Player's protocol has no message for it; the log has the reason.
  static_cast<void>(error);
  return "";
}

void PlayerConnection::handle(const player::Message& message) {
  const player::Msghdr& header = message.header;
  const Devaddr address = own_address(header.addr.interf, header.addr.index);
  switch (header.type) {
    case PLAYER_MSGTYPE_REQ:
      break;
    case PLAYER_MSGTYPE_CMD:
      if (OpenDevice* const to = find(address)) command(*to, message);
      return;
    case PLAYER_MSGTYPE_DATA:
    case PLAYER_MSGTYPE_RESP_ACK:
    case PLAYER_MSGTYPE_SYNCH:
    case PLAYER_MSGTYPE_RESP_NACK:
      return note("ignored a message of type " + std::to_string(header.type) +
                  ", which only servers send");
    default:
      throw ProtocolError("player/type", "expected a message of type 1 to 6, found type " +
                                             std::to_string(header.type));
  }
  if (header.addr.interf == PLAYER_PLAYER_CODE) {
    if (header.subtype == PLAYER_PLAYER_REQ_AUTH) return authenticate(message.payload);
    if (header.subtype == PLAYER_PLAYER_REQ_DATA) return request_data();
    Answer answer;
    try {
      answer = answer_player(message);
    } catch (const ProtocolError& error) {
      note("refused request " + std::to_string(header.subtype) + " of player: " + error.what());
    }
    respond(address, header.subtype, answer);
    // A device that was opened or the mode may have begun rounds of PUSH.
    return begin_to_wait();
  }
  OpenDevice* const to = find(address);
  if (to == nullptr) return respond(address, header.subtype, {});
  request(*to, message);
}

// --- The interface player

PlayerConnection::Answer PlayerConnection::answer_player(const player::Message& message) {
  switch (message.header.subtype) {
    case PLAYER_PLAYER_REQ_DATAMODE:
      return set_mode(message.payload);
    case PLAYER_PLAYER_REQ_ADD_REPLACE_RULE:
      return add_rule(message.payload);
    default:
      break;
  }
  // Whoever may not connect learns nothing about the world.
  if (message.header.subtype == PLAYER_PLAYER_REQ_DEV) return open_or_close(message.payload);
  if (!rights_.connect) return {};
  switch (message.header.subtype) {
    case PLAYER_PLAYER_REQ_DEVLIST:
      return list_devices();
    case PLAYER_PLAYER_REQ_DRIVERINFO:
      return describe_driver(message.payload);
    case PLAYER_PLAYER_REQ_NAMESERVICE:
      return find_robot(message.payload);
    default:
      return {};
  }
}

PlayerConnection::Answer PlayerConnection::list_devices() {
  player::DeviceDevlist list;
  for (const InterfaceAddress& item : list_interfaces(session_.robots(), robot_port_)) {
    const auto code = PlayerCc::interface_code(item.interface);
    if (!code) continue;
    const Devaddr address =
        own_address(static_cast<unsigned>(*code), static_cast<unsigned>(item.index));
    if (list.devices.size() < PLAYER_MAX_DEVICES) list.devices.push_back(address);
  }
  return {true, player::encode(list)};
}

PlayerConnection::Answer PlayerConnection::describe_driver(std::string_view payload) {
  auto info = player::decode<player::DeviceDriverinfo>(payload);
  info.addr = own_address(info.addr.interf, info.addr.index);
  const auto driver = driver_of(info.addr);
  if (!driver) return {};
  info.driver_name = player::text_bytes(*driver);
  return {true, player::encode(info)};
}

PlayerConnection::Answer PlayerConnection::open_or_close(std::string_view payload) {
  auto answer = player::decode<player::DeviceReq>(payload);
  answer.addr = own_address(answer.addr.interf, answer.addr.index);
  const int mode = std::exchange(answer.access, PLAYER_ERROR_MODE);
  answer.driver_name.clear();
  const auto refusal = [&] { return Answer{false, player::encode(answer)}; };
  const std::optional<std::string> driver = driver_of(answer.addr);
  if (!rights_.connect || !driver) return refusal();
  OpenDevice* const device = find(answer.addr);
  if (mode == PLAYER_OPEN_MODE && device != nullptr) {
    ++device->count;
    answer.access = PLAYER_OPEN_MODE;
  } else if (mode == PLAYER_OPEN_MODE) {
    try {
      open(answer.addr);
    } catch (const std::exception& error) {
      note(device_text(answer.addr) + " was not opened: " + error.what());
      return refusal();
    }
    answer.access = PLAYER_OPEN_MODE;
  } else if (mode == PLAYER_CLOSE_MODE && device != nullptr) {
    if (--device->count == 0) close(*device);
    answer.access = PLAYER_CLOSE_MODE;
  }
  // Otherwise the access remains "error", as Player answers.
  answer.driver_name = player::text_bytes(*driver);
  return {true, player::encode(answer)};
}

PlayerConnection::Answer PlayerConnection::set_mode(std::string_view payload) {
  const int mode = player::decode<player::DeviceDatamodeReq>(payload).mode;
  if (mode != PLAYER_DATAMODE_PUSH && mode != PLAYER_DATAMODE_PULL) return {};
  const bool pull = mode == PLAYER_DATAMODE_PULL;
  if (pull == pull_) return {true, ""};
  pull_ = pull;
  requested_ = false;
  if (waiting_ && pull_) {
    wait_.client()->cancel();
    waiting_ = false;
  }
  peer_.set_in_flight(0);
  return {true, ""};
}

PlayerConnection::Answer PlayerConnection::add_rule(std::string_view payload) {
  const auto rule = player::decode<player::AddReplaceRuleReq>(payload);
  if (rule.replace < PLAYER_PLAYER_MSG_REPLACE_RULE_ACCEPT ||
      rule.replace > PLAYER_PLAYER_MSG_REPLACE_RULE_IGNORE) {
    return {};
  }
  const auto same = std::find_if(rules_.begin(), rules_.end(), [&](const auto& known) {
    return known.interf == rule.interf && known.index == rule.index && known.type == rule.type &&
           known.subtype == rule.subtype;
  });
  if (same != rules_.end()) {
    same->replace = rule.replace;
  } else if (rules_.size() < kMaxRules) {
    rules_.push_back(rule);
  } else {
    return {};
  }
  apply_rules();
  return {true, ""};
}

PlayerConnection::Answer PlayerConnection::find_robot(std::string_view payload) {
  auto asked = player::decode<player::DeviceNameserviceReq>(payload);
  const std::string name =
      player::text_of({reinterpret_cast<const char*>(asked.name.data()), asked.name.size()});
  for (const RobotInfo& robot : session_.robots()) {
    const auto port = hub_.player_ports().find(robot.port);
    if (robot.name != name || port == hub_.player_ports().end()) continue;
    asked.port = static_cast<std::uint16_t>(port->second);
    return {true, player::encode(asked)};
  }
  return {};
}

void PlayerConnection::authenticate(std::string_view payload) {
  const auto answer = [this](bool accepted) {
    respond(own_address(PLAYER_PLAYER_CODE, 0), PLAYER_PLAYER_REQ_AUTH, {accepted, ""});
    flush();
  };
  std::string token;
  try {
    const auto key = player::decode<player::DeviceAuthReq>(payload).auth_key;
    token = player::text_of({reinterpret_cast<const char*>(key.data()), key.size()});
  } catch (const ProtocolError&) {
    return answer(false);
  }
  if (tokens_.size() >= kMaxTokens) return answer(false);
  const Hub::TokenVerdict verdict = hub_.check_tokens(peer_, {token});
  hub_.answer_after(verdict.delay, peer_, self_, [this, answer, token, wrong = verdict.wrong] {
    if (!wrong) {
      tokens_.push_back(token);
      rights_ = hub_.access().rights(tokens_, robot_port_);
    }
    answer(!wrong);
  });
}

void PlayerConnection::request_data() {
  respond(own_address(PLAYER_PLAYER_CODE, 0), PLAYER_PLAYER_REQ_DATA, {rights_.connect, ""});
  if (!pull_ || !rights_.connect) return;
  requested_ = true;
  turns_ = 0;
  wait_after_others();
}

// --- Devices

// Devices are made only for clients that open them, since some have a thread or a layer.
std::optional<std::string> PlayerConnection::driver_of(const Devaddr& address) const {
  const char* const name = PlayerCc::interface_name(address.interf);
  if (name == nullptr) return std::nullopt;
  try {
    const auto& robots = session_.robots();
    const InterfaceBinding binding = find_interface(robots, robot_port_, name, address.index);
    if (binding.is_world()) return "world";
    if (const char* const type = binding.driver_type()) return type;
    return require_device(robots, binding.reading).type;
  } catch (const SessionError&) {
    return std::nullopt;  // no such device
  }
}

PlayerConnection::OpenDevice* PlayerConnection::find(const Devaddr& address) {
  const auto it = std::find_if(open_.begin(), open_.end(), [&](const OpenDevice& device) {
    return same_device(device.address, address);
  });
  return it == open_.end() ? nullptr : &*it;
}

void PlayerConnection::open(const Devaddr& address) {
  const char* const name = PlayerCc::interface_name(address.interf);
  const InterfaceBinding binding =
      find_interface(session_.robots(), robot_port_, name, address.index);
  auto device = wire::make_player_device(session_, robot_port_, name, address.index);
  if (device == nullptr) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "the interface is not offered to clients of Player's protocol");
  }
  OpenDevice opened;
  opened.address = address;
  if (!binding.is_world()) opened.belongs_to = binding.reading;
  const std::vector<DeviceId> sources = device->sources();
  opened.device = std::move(device);
  try {
    for (const DeviceId source : sources) {
      session_.request(SubscribeRequest{source});
      opened.sources.push_back(source);
    }
  } catch (...) {
    for (const DeviceId source : opened.sources) session_.request(UnsubscribeRequest{source});
    throw;
  }
  open_.push_back(std::move(opened));
  apply_rules();
}

void PlayerConnection::close(OpenDevice& device) {
  for (const DeviceId source : device.sources) session_.request(UnsubscribeRequest{source});
  open_.remove_if([&](const OpenDevice& other) { return &other == &device; });
}

void PlayerConnection::note(const std::string& text) {
  if (++notes_ <= kMaxNotes) hub_.log(sim::LogLevel::kInfo, peer_.name() + ": " + text);
}

template <typename Action>
void PlayerConnection::guarded(OpenDevice& device, Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    if (!std::exchange(device.has_failed, true)) {
      note(device_text(device.address) + ": " + error.what() +
           " (further errors of this device are not logged)");
    }
  }
}

void PlayerConnection::command(OpenDevice& to, const player::Message& message) {
  guarded(to, [&] {
    // Drivers act without further checks, see GuardedSession.
    if (to.belongs_to) {
      guard_.check_command(*to.belongs_to);
    } else if (guard_.may_draw()) {
      guard_.note_change();
    }
    if (auto drawings = to.device->drawings(message.header.subtype, message.payload)) {
      if (!guard_.may_draw()) guard_.check_canvas();
      return draw(std::move(drawings));
    }
    to.device->command(message.header.subtype, message.payload);
  });
}

void PlayerConnection::draw(std::unique_ptr<wire::Drawings> drawings) {
  struct Rest {
    DrawWork work;
    std::unique_ptr<wire::Drawings> drawings;
  };
  const auto rest = std::make_shared<Rest>();
  rest->drawings = std::move(drawings);
  std::vector<sim::DrawOperation> second;
  const bool is_more = rest->drawings->next(rest->work.operations) && rest->drawings->next(second);
  if (!is_more && light_drawings_.queue(session_, rest->work.operations, state_->peers.size())) {
    return;
  }
  rest->work.operations.insert(rest->work.operations.end(), second.begin(), second.end());
  // The job holds no reference to this connection, which may end before.
  const auto run_slice = [client = wait_.client(), rest] {
    if (!client->draw_some(rest->work, kSliceCells)) return true;
    rest->work = {};
    return rest->drawings->next(rest->work.operations);
  };
  work(run_slice, [this](const std::exception_ptr& error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
      note(std::string("a drawing was not finished: ") + e.what());
    }
  });
}

void PlayerConnection::work(std::function<bool()> run_slice,
                            std::function<void(const std::exception_ptr&)> then) {
  peer_.set_busy(true);
  const auto done = [weak = std::weak_ptr(self_),
                     then = std::move(then)](const std::exception_ptr& error) {
    const auto self = weak.lock();
    if (!self) return;
    then(error);
    (*self)->flush();
    (*self)->peer_.set_busy(false);
  };
  hub_.work({std::move(run_slice), done});
}

void PlayerConnection::request(OpenDevice& to, const player::Message& message) {
  const Devaddr address = to.address;
  const int subtype = message.header.subtype;
  Answer answer;
  bool is_made_elsewhere = false;
  guarded(to, [&] {
    if (auto make = to.device->long_answer(message.header.subtype, message.payload)) {
      const auto made = std::make_shared<Answer>();
      const auto run_slice = [client = wait_.client(), make = std::move(make), made] {
        std::optional<std::string> payload = make(client->session());
        made->accepted = payload.has_value();
        if (payload) made->payload = std::move(*payload);
        return false;
      };
      work(run_slice, [this, address, subtype, made](const std::exception_ptr& error) {
        if (OpenDevice* const device = find(address)) {
          guarded(*device, [&] {
            if (error) std::rethrow_exception(error);
          });
        }
        respond(address, subtype, *made);
      });
      is_made_elsewhere = true;
      return;
    }
    std::optional<std::string> payload =
        to.device->request(message.header.subtype, message.payload);
    answer.accepted = payload.has_value();
    if (payload) answer.payload = std::move(*payload);
  });
  if (!is_made_elsewhere) respond(address, subtype, answer);
}

// --- Rules

// As in Player, the first rule that matches counts.
int PlayerConnection::rule(const Devaddr& address, int subtype) const {
  for (const player::AddReplaceRuleReq& rule : rules_) {
    if (matches(rule.interf, address.interf) && matches(rule.index, address.index) &&
        matches(rule.type, PLAYER_MSGTYPE_DATA) &&
        (subtype == -1 || matches(rule.subtype, subtype))) {
      return rule.replace;
    }
  }
  return PLAYER_PLAYER_MSG_REPLACE_RULE_ACCEPT;
}

// The host replaces readings by device; if devices of Player share a source, its readings are
// queued for the one that wants them all.
void PlayerConnection::apply_rules() {
  for (const OpenDevice& device : open_) {
    for (const DeviceId source : device.sources) {
      const bool wants_all = std::any_of(open_.begin(), open_.end(), [&](const OpenDevice& other) {
        const auto& sources = other.sources;
        return std::find(sources.begin(), sources.end(), source) != sources.end() &&
               rule(other.address, -1) == PLAYER_PLAYER_MSG_REPLACE_RULE_ACCEPT;
      });
      session_.request(ReplaceRequest{source, !wants_all});
    }
  }
}

// --- Rounds

namespace {

/// Calls a function for each reading.
template <typename Function>
class EachReading final : public ReadingSink {
 public:
  explicit EachReading(Function function) : function_(std::move(function)) {}
  void on_reading(DeviceId device, const sim::SharedReading& reading) override {
    function_(device, *reading);
  }

 private:
  Function function_;
};

}  // namespace

void PlayerConnection::data(std::uint8_t subtype, std::string payload) {
  if (!rules_.empty() &&
      rule(current_->address, subtype) == PLAYER_PLAYER_MSG_REPLACE_RULE_IGNORE) {
    return;
  }
  ++round_messages_;
  append(current_->address, PLAYER_MSGTYPE_DATA, subtype, data_time_s_, payload);
}

bool PlayerConnection::wants_round() const {
  if (!rights_.connect) return false;
  // In lockstep a client that has taken part holds time until it waits again.
  return pull_ ? requested_ : !open_.empty() || has_joined_;
}

ThreadId PlayerConnection::thread_id() {
  if (thread_id_ != 0) return thread_id_;
  if (hub_.settings().onlookers || hub_.host().time().mode == sim::TimeMode::kPaced) {
    return thread_id_ = new_thread_id();
  }
  // A program of one thread may read several connections in turn, so those of a process count as
  // one thread. No client can choose such a name for its process in `hello`.
  const std::optional<int> process = peer_.local_process();
  thread_id_ =
      process ? hub_.thread_id("\nplayer " + std::to_string(*process), 0) : new_thread_id();
  return thread_id_;
}

void PlayerConnection::begin_to_wait() {
  if (waiting_ || !wants_round()) return;
  const ThreadId who = thread_id();
  has_joined_ = true;
  waiting_ = true;
  const Outcome outcome = wait_.begin([&] { return wait_.client()->begin_wait(who); });
  if (outcome == Outcome::kWaiting) {
    if (pull_) peer_.set_in_flight(1);
    return;
  }
  finish_round(outcome);
}

std::optional<std::uint64_t> PlayerConnection::others_input() const {
  std::uint64_t total = 0;
  for (const Peer* peer : state_->peers) {
    if (peer == &peer_) continue;
    const std::optional<std::uint64_t> bytes = peer->settled_input();
    if (!bytes) return std::nullopt;
    total += *bytes;
  }
  return total;
}

// A program that has several connections expects its commands on one of them to take effect before
// the time that it lets pass on another one. They arrived before the data request, but the event
// loop may serve the data request first. So wait until a turn of the loop finds no further input. A
// turn completes reads that have begun.
void PlayerConnection::wait_after_others() {
  if (state_->peers.size() < 2 || hub_.settings().onlookers ||
      hub_.host().time().mode == sim::TimeMode::kPaced) {
    return begin_to_wait();
  }
  const std::optional<std::uint64_t> now = others_input();
  const std::optional<std::uint64_t> before = std::exchange(others_input_, now);
  if ((turns_ > 0 && now && now == before) || turns_ == kMaxTurns) return begin_to_wait();
  ++turns_;
  hub_.after(std::chrono::microseconds(0), [this, weak = std::weak_ptr(self_)] {
    if (!weak.expired()) wait_after_others();
  });
}

void PlayerConnection::on_wait_end() {
  if (!waiting_) return;
  const Outcome outcome = wait_.client()->outcome();
  if (outcome != Outcome::kWaiting) finish_round(outcome);
}

void PlayerConnection::finish_round(Outcome outcome) {
  waiting_ = false;
  if (pull_) {
    peer_.set_in_flight(0);
  } else {
    flush();  // answers must not be lost with data
  }
  if (outcome == Outcome::kFinished) {
    flush();
    hub_.log(sim::LogLevel::kInfo, peer_.name() + ": the simulated run is over");
    return peer_.close("");
  }
  light_drawings_.note_step();
  if (outcome != Outcome::kData) return;
  round_messages_ = 0;
  EachReading readings([this](DeviceId source, const sim::Reading& reading) {
    data_time_s_ = sim::to_seconds(reading.time_ns);
    for (OpenDevice& device : open_) {
      if (std::find(device.sources.begin(), device.sources.end(), source) == device.sources.end()) {
        continue;
      }
      current_ = &device;
      guarded(device, [&] { device.device->on_reading(source, reading, *this); });
    }
  });
  // A round that began before the first device was opened may end without readings.
  const bool has_sources = std::any_of(
      open_.begin(), open_.end(), [](const OpenDevice& device) { return !device.sources.empty(); });
  if (session_.take(readings) == 0 && pull_ && has_sources) return begin_to_wait();
  requested_ = false;
  data_time_s_ = now_s();
  for (OpenDevice& device : open_) {
    current_ = &device;
    guarded(device, [&] { device.device->on_round(*this); });
  }
  if (pull_) {
    end_pull_round();
    return flush();
  }
  if (!out_.empty()) {
    // Data of PUSH may be lost if the client does not read them.
    const bool sent =
        peer_.send_record(std::make_shared<const std::string>(std::exchange(out_, {})));
    if (!sent) dropped_ += round_messages_;
  }
  hub_.post([this, weak = std::weak_ptr(self_)] {
    if (!weak.expired()) begin_to_wait();
  });
}

void PlayerConnection::end_pull_round() {
  const std::uint32_t overflow = session_.request(OverflowRequest{});
  dropped_ += overflow - std::exchange(overflow_, overflow);
  const Devaddr address = own_address(PLAYER_PLAYER_CODE, 0);
  if (dropped_ == 0) {
    return append(address, PLAYER_MSGTYPE_SYNCH, PLAYER_PLAYER_SYNCH_OK, now_s(), "");
  }
  append(address, PLAYER_MSGTYPE_SYNCH, PLAYER_PLAYER_SYNCH_OVERFLOW, now_s(),
         player::encode(player::Uint32{std::exchange(dropped_, 0U)}));
}

// --- Output

Devaddr PlayerConnection::own_address(unsigned interface, unsigned index) const {
  return {host_, static_cast<std::uint32_t>(tcp_port_), static_cast<std::uint16_t>(interface),
          static_cast<std::uint16_t>(index)};
}

double PlayerConnection::now_s() const { return sim::to_seconds(hub_.host().now_ns()); }

void PlayerConnection::append(const Devaddr& address, int type, int subtype, double time_s,
                              std::string_view payload) {
  player::Msghdr header;
  header.addr = address;
  header.type = static_cast<std::uint8_t>(type);
  header.subtype = static_cast<std::uint8_t>(subtype);
  header.timestamp = time_s;
  player::append_message(out_, header, payload);
}

void PlayerConnection::respond(const Devaddr& address, int subtype, const Answer& answer) {
  append(address, answer.accepted ? PLAYER_MSGTYPE_RESP_ACK : PLAYER_MSGTYPE_RESP_NACK, subtype,
         now_s(), answer.payload);
}

void PlayerConnection::flush() {
  if (!out_.empty()) peer_.send(std::exchange(out_, {}));
}

}  // namespace playerlike::server
