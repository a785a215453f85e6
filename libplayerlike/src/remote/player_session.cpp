// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_session.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "messages/player_interfaces.h"
#include "protocol/player_xdr.h"
#include "remote/player_commands.h"
#include "remote/player_robots.h"
#include "remote/player_world.h"
#include "session/checks.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

using std::chrono::milliseconds;

/// Limits of the readings that wait for a client that queues them.
constexpr std::size_t kMaxQueue = 1000;  // per device
constexpr std::size_t kMaxQueueBytes = std::size_t{64} << 20U;

/// The longest time that a call to sleep may name [s].
constexpr double kLongestSleep_s = 1e9;

SessionError not_available(const std::string& what) {
  return {SessionError::Code::kNotAvailable, what};
}

/// An answer of the server itself that must be there. @throws SessionError.
std::string require_reply(PlayerLink& link, std::uint8_t subtype, std::string_view payload,
                          const char* what) {
  const auto reply = link.request(player_itself(), subtype, payload);
  if (reply && reply->accepted) return reply->payload;
  throw SessionError(SessionError::Code::kDisconnected,
                     "the Player server at " + link.address().text() +
                         (reply ? " refuses " : " does not answer ") + what);
}

/// Stands for the simulation behind a server.
const void* identity_of(const ServerAddress& server) {
  // The names of servers, which are few, are never removed.
  static std::mutex mutex;
  static auto* const names = new std::set<std::string>();
  const std::lock_guard lock(mutex);
  return &*names->insert(server.text()).first;
}

}  // namespace

// --- Bytes that cannot be understood

void PlayerSession::refuse_bytes(PlayerLink& link, const std::string& why) {
  const std::string text = "the server at " + link.address().text() +
                           " has sent what is no message of Player 3.1: " + why;
  link.close(text);
  throw SessionError(SessionError::Code::kDisconnected, text);
}

template <typename Read>
auto PlayerSession::understood_by(PlayerLink& link, Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const protocol::ProtocolError& e) {
    refuse_bytes(link, e.what());
  }
}

// --- Connecting

PlayerSession::PlayerSession(PlayerSettings settings)
    : settings_(std::move(settings)),
      simulation_(identity_of(settings_.server)),
      began_(SocketClock::now()),
      world_(std::make_unique<PlayerWorld>(*this)),
      request_timeout_s_(settings_.request_timeout_s) {
  link_ = connect();
  const std::vector<ListedDevice> devices =
      understood_by(*link_, [this] { return list_devices(*link_); });
  robots_.push_back(
      describe_player_robot(settings_.server.text(), settings_.server.tcp_port, devices));
  make_addresses(devices);
}

PlayerSession::~PlayerSession() { close(); }

std::shared_ptr<PlayerLink> PlayerSession::connect() {
  std::shared_ptr<PlayerLink> link = PlayerLink::open(
      settings_.server, *this, wall_duration(settings_.connect_timeout_s),
      wall_duration(settings_.banner_timeout_s), [this] { return closed_.load(); });
  link->set_request_timeout(wall_duration(request_timeout_s_));
  for (const std::string& token : settings_.tokens) {
    player::DeviceAuthReq key;
    key.auth_key.assign(
        token.begin(), token.begin() + static_cast<std::ptrdiff_t>(
                                           std::min<std::size_t>(token.size(), PLAYER_KEYLEN - 1)));
    key.auth_key.push_back(0);
    const auto reply = link->request(player_itself(), PLAYER_PLAYER_REQ_AUTH, player::encode(key));
    if (reply && reply->accepted) break;
  }
  player::DeviceDatamodeReq mode;
  mode.mode = PLAYER_DATAMODE_PULL;
  static_cast<void>(require_reply(*link, PLAYER_PLAYER_REQ_DATAMODE, player::encode(mode),
                                  "to send data on request (PULL mode)"));
  return link;
}

std::vector<ListedDevice> PlayerSession::list_devices(PlayerLink& link) {
  const auto list = player::decode<player::DeviceDevlist>(
      require_reply(link, PLAYER_PLAYER_REQ_DEVLIST, {}, "the request for its list of devices"));
  const auto port = static_cast<std::uint32_t>(link.address().tcp_port);
  // A server may list the devices of its other ports, too. Behind a tunnel it knows its port by
  // another number.
  const bool has_port = std::any_of(list.devices.begin(), list.devices.end(),
                                    [&](const player::Devaddr& at) { return at.robot == port; });
  std::vector<ListedDevice> devices;
  std::set<std::pair<unsigned, unsigned>> seen;
  bool answers = true;  // a server that does not answer one of these requests is not asked again
  for (const player::Devaddr& at : list.devices) {
    if (has_port && at.robot != port) continue;
    if (!seen.emplace(at.interf, at.index).second) continue;
    player::DeviceDriverinfo info;
    info.addr = at;
    std::optional<PlayerLink::Reply> reply;
    if (answers) {
      reply = link.request(player_itself(), PLAYER_PLAYER_REQ_DRIVERINFO, player::encode(info));
      answers = reply.has_value();
    }
    std::string driver = "unknown";
    if (reply && reply->accepted) {
      driver =
          player::text_of(player::decode<player::DeviceDriverinfo>(reply->payload).driver_name);
    }
    devices.push_back({at, std::move(driver)});
  }
  return devices;
}

void PlayerSession::make_addresses(const std::vector<ListedDevice>& devices) {
  const RobotInfo& robot = robots_.front();
  by_device_.resize(robot.devices.size());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const PlayerAddress& listed = robot.addresses->at(i);
    auto address = std::make_unique<Address>();
    address->at = devices[i].address;
    address->at.host = 0;
    address->at.robot = static_cast<std::uint32_t>(settings_.server.tcp_port);
    address->name = listed.interface + ':' + std::to_string(listed.index);
    address->readings = PlayerReadings(address->at.interf);
    if (listed.reading.robot >= 0) {
      address->device = listed.reading.device;
      by_device_[static_cast<std::size_t>(listed.reading.device)] = address.get();
    }
    if (listed.motion) by_device_[static_cast<std::size_t>(listed.motion->device)] = address.get();
    by_interface_[{address->at.interf, address->at.index}] = address.get();
    addresses_.push_back(std::move(address));
  }
}

void PlayerSession::require_open() const {
  if (!closed_) return;
  throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
}

std::shared_ptr<PlayerLink> PlayerSession::link() const {
  const Lock lock(mutex_);
  return link_;
}

bool PlayerSession::connected() const noexcept { return !closed_ && !link()->lost(); }

template <typename Use>
auto PlayerSession::with_link(Use use) {
  for (;;) {
    require_open();
    const std::shared_ptr<PlayerLink> now = link();
    try {
      return understood_by(*now, [&] { return use(*now); });
    } catch (const ConnectionLost&) {
      require_open();
      if (!recover(now)) throw;
    }
  }
}

bool PlayerSession::pause(double seconds) {
  Lock lock(mutex_);
  // Always wait a little, so that a server that refuses is not asked in a tight loop.
  changed_.wait_for(lock, std::max(wall_duration(seconds), wall_duration(0.01)),
                    [&] { return closed_.load(); });
  return !closed_;
}

bool PlayerSession::recover(const std::shared_ptr<PlayerLink>& lost) {
  const int limit = retry_limit_;
  if (limit == 0) return false;
  const Lock one_at_a_time(recover_mutex_);
  if (link() != lost) return true;
  const std::string problem = connect_again(
      limit, [this] { return pause(retry_time_s_); },
      [this] {
        const std::shared_ptr<PlayerLink> made = connect();
        understood_by(*made, [&] { resume(*made); });
        const Lock lock(mutex_);
        link_ = made;
      });
  if (problem.empty()) return true;
  require_open();
  throw SessionError(SessionError::Code::kDisconnected, problem);
}

void PlayerSession::resume(PlayerLink& link) {
  std::vector<const Address*> open;
  {
    const Lock lock(mutex_);
    for (const auto& address : addresses_) {
      if (address->opened) open.push_back(address.get());
    }
  }
  for (const Address* address : open) send_open(link, *address, PLAYER_OPEN_MODE);
  world_->resume(link);
}

void PlayerSession::close() noexcept {
  if (closed_.exchange(true)) return;
  // The link calls this session while it holds its own lock, so this lock must not be held then.
  std::shared_ptr<PlayerLink> link;
  {
    const Lock lock(mutex_);
    changed_.notify_all();
    link = link_;
  }
  if (link != nullptr) link->close("the connection is closed");
}

// --- Devices

PlayerSession::Address& PlayerSession::address_of(DeviceId device) {
  static_cast<void>(require_device(robots_, device));
  return *by_device_[static_cast<std::size_t>(device.device)];
}

PlayerSession::Address* PlayerSession::address_of(unsigned interface) {
  // The first index: programs do not say which map or simulation they mean.
  const auto it = by_interface_.lower_bound({interface, 0});
  return it != by_interface_.end() && it->first.first == interface ? it->second : nullptr;
}

PlayerSession::Address& PlayerSession::address_of(unsigned interface, unsigned index) {
  const auto found = by_interface_.find({interface, index});
  if (found != by_interface_.end()) return *found->second;
  throw SessionError(SessionError::Code::kNoSuchDevice,
                     "the Player server at " + settings_.server.text() + " has no " +
                         player_interface_name(static_cast<int>(interface)) + ':' +
                         std::to_string(index));
}

void PlayerSession::send_open(PlayerLink& link, const Address& address, std::uint8_t mode) {
  player::DeviceReq request;
  request.addr.interf = address.at.interf;
  request.addr.index = address.at.index;
  request.access = mode;
  const auto reply = link.request(player_itself(), PLAYER_PLAYER_REQ_DEV, player::encode(request));
  if (!reply) {
    throw not_available("the Player server at " + link.address().text() + " has not answered for " +
                        seconds_text(link.request_timeout()) + " whether it opens " + address.name +
                        "; SetRequestTimeout() allows more time");
  }
  if (mode == PLAYER_CLOSE_MODE) return;
  if (!reply->accepted ||
      player::decode<player::DeviceReq>(reply->payload).access != PLAYER_OPEN_MODE) {
    throw not_available("the Player server at " + link.address().text() + " does not open " +
                        address.name +
                        ": its driver failed to start (see the server's log), or this client may "
                        "not use it");
  }
}

void PlayerSession::open(PlayerLink& link, Address& address) {
  const Lock one_at_a_time(open_mutex_);
  {
    const Lock lock(mutex_);
    if (address.opened) return;
  }
  send_open(link, address, PLAYER_OPEN_MODE);
  {
    const Lock lock(mutex_);
    address.opened = true;
    if (std::exchange(address.completed, true) || address.device < 0) return;
  }
  complete(link, address);
}

void PlayerSession::complete(PlayerLink& link, Address& address) {
  RobotInfo& robot = robots_.front();
  const auto index = static_cast<std::size_t>(address.device);
  RobotInfo sizes;
  DeviceInfo device;
  {
    const Lock lock(mutex_);
    sizes.length_m = robot.length_m;
    device = robot.devices[index];
  }
  bool answers = true;  // a driver that does not answer one of these requests answers none
  const AskDevice ask_device = [&](std::uint8_t subtype) -> std::optional<std::string> {
    if (!answers) return std::nullopt;
    const auto reply = link.request(address.at, subtype, {});
    answers = reply.has_value();
    if (!reply || !reply->accepted) return std::nullopt;
    return reply->payload;
  };
  const bool had_size = sizes.length_m > 0.0;
  complete_device(address.at.interf, ask_device, sizes, device);
  const Lock lock(mutex_);
  robot.devices[index].type = device.type;
  robot.devices[index].properties = device.properties;
  if (had_size || address.at.interf != PLAYER_POSITION2D_CODE) return;
  robot.length_m = sizes.length_m;
  robot.width_m = sizes.width_m;
  robot.height_m = sizes.height_m;
  robot.center_m = sizes.center_m;
  robot.radius_m = sizes.radius_m;
}

void PlayerSession::subscribe(DeviceId device) {
  Address& address = address_of(device);
  if (address.device != device.device) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the motors of " + address.name + " have no readings");
  }
  with_link([&](PlayerLink& link) { open(link, address); });
  const Lock lock(mutex_);
  ++address.subscriptions;
}

void PlayerSession::unsubscribe(DeviceId device) {
  Address& address = address_of(device);
  const Lock one_at_a_time(open_mutex_);
  {
    const Lock lock(mutex_);
    if (address.subscriptions == 0 || --address.subscriptions > 0) return;
    address.opened = false;
    std::erase_if(waiting_, [&](const Waiting& w) {
      if (w.address != &address) return false;
      waiting_bytes_ -= w.bytes;
      return true;
    });
    if (waiting_.empty()) round_ = false;
  }
  require_open();
  send_open(*link(), address, PLAYER_CLOSE_MODE);
}

void PlayerSession::set_replace(const ReplaceRequest& what) {
  Address* const only = what.device ? &address_of(*what.device) : nullptr;
  player::AddReplaceRuleReq rule;
  rule.interf = only == nullptr ? -1 : only->at.interf;
  rule.index = only == nullptr ? -1 : only->at.index;
  rule.type = PLAYER_MSGTYPE_DATA;
  rule.subtype = -1;
  rule.replace =
      what.replace ? PLAYER_PLAYER_MSG_REPLACE_RULE_REPLACE : PLAYER_PLAYER_MSG_REPLACE_RULE_ACCEPT;
  with_link([&](PlayerLink& link) {
    // A server without such rules queues as it likes.
    static_cast<void>(
        link.request(player_itself(), PLAYER_PLAYER_REQ_ADD_REPLACE_RULE, player::encode(rule)));
  });
  const Lock lock(mutex_);
  if (only != nullptr) {
    only->replace = what.replace;
    return;
  }
  replace_by_default_ = what.replace;
  for (const auto& address : addresses_) address->replace.reset();
}

std::string PlayerSession::ask(PlayerLink& link, const Address& address, std::uint8_t subtype,
                               std::string_view payload) {
  const auto reply = link.request(address.at, subtype, payload);
  const std::string what = "request " + std::to_string(subtype) + " of " + address.name;
  if (!reply) {
    throw not_available("the Player server at " + link.address().text() + " has not answered " +
                        what + " for " + seconds_text(link.request_timeout()) +
                        ": its driver may not support it; SetRequestTimeout() allows more time");
  }
  if (!reply->accepted) {
    throw not_available("the Player server at " + link.address().text() + " refuses " + what +
                        ": its driver does not support it, or not with these values");
  }
  return reply->payload;
}

std::string PlayerSession::ask(Address& address, std::uint8_t subtype, std::string_view payload) {
  return with_link([&](PlayerLink& link) {
    open(link, address);
    return ask(link, address, subtype, payload);
  });
}

void PlayerSession::send(DeviceId device, const sim::Command& command) {
  require_open();
  Address& address = address_of(device);
  require_finite(command);
  sim::Command whole = command;
  if (auto* light = std::get_if<sim::LightCommand>(&whole)) {
    const Lock lock(mutex_);
    if (light->period_s) address.period_s = light->period_s;
    if (light->duty_cycle) address.duty_cycle = light->duty_cycle;
    if (light->period_s || light->duty_cycle) {
      light->period_s = address.period_s;
      light->duty_cycle = address.duty_cycle;
    }
  }
  const std::optional<PlayerCommand> message = to_player(address.at.interf, whole);
  if (!message) {
    throw not_available("Player's " + address.name + " has no such command");
  }
  tell(address, *message);
}

void PlayerSession::tell(Address& address, const PlayerCommand& message) {
  with_link([&](PlayerLink& link) {
    open(link, address);
    if (message.is_request) {
      static_cast<void>(ask(link, address, message.subtype, message.payload));
    } else {
      link.command(address.at, message.subtype, message.payload);
    }
  });
}

// --- Readings

void PlayerSession::on_data(const player::Msghdr& header, std::string_view payload) {
  const auto found = by_interface_.find({header.addr.interf, header.addr.index});
  if (found == by_interface_.end()) return;
  Address& address = *found->second;
  const Lock lock(mutex_);
  if (address.at.interf == PLAYER_BLACKBOARD_CODE) {
    if (header.subtype == PLAYER_BLACKBOARD_DATA_UPDATE) world_->on_update(payload);
    return;
  }
  if (address.subscriptions == 0) return;
  sim::SharedReading reading;
  try {
    reading =
        address.readings.convert(header.subtype, header.timestamp, payload,
                                 robots_.front().devices[static_cast<std::size_t>(address.device)]);
  } catch (const protocol::ProtocolError& e) {
    throw protocol::ProtocolError(e.id(), "data of " + address.name + ": " + e.what());
  }
  if (reading == nullptr) return;
  time_ns_ = reading->time_ns;
  // A message may complete the reading of the last one, see PlayerReadings::convert().
  const auto incomplete = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) {
    return w.address == &address && w.reading->sequence == reading->sequence;
  });
  if (incomplete != waiting_.end()) {
    incomplete->reading = std::move(reading);
    incomplete->bytes += payload.size();
    waiting_bytes_ += payload.size();
    return;
  }
  const auto of_address = [&](const Waiting& w) { return w.address == &address; };
  const auto drop = [&](auto it) {
    waiting_bytes_ -= it->bytes;
    waiting_.erase(it);
  };
  if (address.replace.value_or(replace_by_default_)) {
    const auto older = std::find_if(waiting_.begin(), waiting_.end(), of_address);
    if (older != waiting_.end()) drop(older);
  } else {
    const auto queued =
        static_cast<std::size_t>(std::count_if(waiting_.begin(), waiting_.end(), of_address));
    if (queued >= kMaxQueue || waiting_bytes_ + payload.size() > kMaxQueueBytes) {
      const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), of_address);
      ++overflow_;
      if (oldest == waiting_.end()) return;
      drop(oldest);
    }
  }
  if (waiting_.empty()) first_ = SocketClock::now();
  waiting_.push_back({&address, std::move(reading), payload.size()});
  waiting_bytes_ += payload.size();
}

void PlayerSession::on_round(std::uint32_t dropped) {
  const Lock lock(mutex_);
  overflow_ += dropped;
  ++rounds_;
  round_ = !waiting_.empty();
}

bool PlayerSession::has_round() const {
  if (round_) return true;
  // A server that sends data but never ends the round is not waited for without end.
  return !waiting_.empty() && SocketClock::now() - first_ > wall_duration(request_timeout_s_);
}

bool PlayerSession::subscribes_to_nothing() {
  const Lock lock(mutex_);
  return std::all_of(addresses_.begin(), addresses_.end(),
                     [](const auto& address) { return address->subscriptions == 0; });
}

void PlayerSession::await_round(PlayerLink& link, std::optional<SocketClock::time_point> deadline) {
  for (;;) {
    std::uint64_t rounds = 0;
    {
      const Lock lock(mutex_);
      if (has_round()) return;
      rounds = rounds_;
    }
    link.request_round();
    const auto done = [&] {
      const Lock lock(mutex_);
      return has_round() || rounds_ != rounds;  // a round may have no readings for this client
    };
    if (!deadline) {
      link.wait_while_alive(done);
    } else if (!link.wait(*deadline, done)) {
      return;
    }
  }
}

void PlayerSession::wait() {
  // A server may end a round without data, as Playpen's does when simulated time has advanced, or
  // wait for data, as Player does.
  constexpr double kWithoutSubscription_s = 0.1;
  with_link([&](PlayerLink& link) {
    if (!subscribes_to_nothing()) return await_round(link, std::nullopt);
    const auto rounds = [this] {
      const Lock lock(mutex_);
      return rounds_;
    };
    const std::uint64_t before = rounds();
    link.request_round();
    static_cast<void>(link.wait(SocketClock::now() + wall_duration(kWithoutSubscription_s),
                                [&] { return rounds() != before; }));
  });
}

bool PlayerSession::peek(milliseconds timeout) {
  const auto deadline = SocketClock::now() +
                        std::clamp<milliseconds>(timeout, milliseconds(0), std::chrono::hours(1));
  return with_link([&](PlayerLink& link) {
    if (subscribes_to_nothing()) {
      static_cast<void>(link.wait(deadline, [] { return false; }));
      return false;
    }
    await_round(link, deadline);
    const Lock lock(mutex_);
    return has_round();
  });
}

int PlayerSession::take(ReadingSink& sink) {
  require_open();
  bool look = false;
  {
    const Lock lock(mutex_);
    look = !has_round();
  }
  if (look && !subscribes_to_nothing()) {
    with_link([&](PlayerLink& link) { await_round(link, SocketClock::now()); });
  }
  std::deque<Waiting> taken;
  {
    const Lock lock(mutex_);
    if (!has_round()) return 0;
    round_ = false;
    taken.swap(waiting_);
    waiting_bytes_ = 0;
  }
  std::stable_sort(taken.begin(), taken.end(), [](const Waiting& a, const Waiting& b) {
    return a.address->device < b.address->device;
  });
  for (const Waiting& one : taken) sink.on_reading({0, one.address->device}, one.reading);
  return static_cast<int>(taken.size());
}

// --- Time and other sessions

void PlayerSession::sleep(double seconds) {
  if (!(seconds >= 0.0 && seconds <= kLongestSleep_s)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "sleep takes a number of seconds in [0, 1e9]");
  }
  Lock lock(mutex_);
  changed_.wait_for(lock, wall_duration(seconds), [&] { return closed_.load(); });
  lock.unlock();
  require_open();
}

TimeStatistics PlayerSession::time() {
  TimeStatistics time;
  const Lock lock(mutex_);
  time.sim_time_ns = time_ns_;
  time.wall_time_s = std::chrono::duration<double>(SocketClock::now() - began_).count();
  time.real_time_factor = 1.0;
  time.mode = sim::TimeMode::kPaced;
  return time;
}

std::unique_ptr<Session> PlayerSession::open_follower() {
  require_open();
  PlayerSettings settings = settings_;
  settings.request_timeout_s = request_timeout_s_;
  return std::make_unique<PlayerSession>(std::move(settings));
}

// --- Requests

struct PlayerSession::RequestHandler {
  PlayerSession& session;

  void operator()(const SubscribeRequest& what) const { session.subscribe(what.device); }
  void operator()(const UnsubscribeRequest& what) const { session.unsubscribe(what.device); }
  void operator()(const ReplaceRequest& what) const { session.set_replace(what); }
  std::uint32_t operator()(const OverflowRequest& /*what*/) const {
    const Lock lock(session.mutex_);
    return session.overflow_;
  }
  void operator()(const JoinRequest& /*what*/) const { session.require_open(); }
  void operator()(const SleepRequest& what) const { session.sleep(what.seconds); }
  TimeStatistics operator()(const TimeRequest& /*what*/) const { return session.time(); }
  void operator()(const PreferRealTimeRequest& /*what*/) const { session.require_open(); }
  void operator()(const NoteLooksRequest& /*what*/) const {}
  void operator()(const AnswerTimeoutRequest& what) const {
    session.request_timeout_s_ = what.seconds;
    session.link()->set_request_timeout(wall_duration(what.seconds));
  }
  void operator()(const RetriesRequest& what) const {
    session.retry_time_s_ = what.time_s;
    session.retry_limit_ = what.limit;
  }
  /// Only the simulation's report and pictures use it.
  void operator()(const NoteGoalRequest& what) const {
    static_cast<void>(session.address_of(what.device));
  }
  std::vector<LocalizationParticle> operator()(const ParticlesRequest& what) const {
    return session.particles(what.device);
  }
  Charge operator()(const TakeChargeRequest& what) const { return session.take_charge(what); }
  CanvasInfo operator()(const CanvasInfoRequest& /*what*/) const {
    constexpr double kCell_m = 0.02;
    return {0, 0, kCell_m, 0.0, 0.0};
  }

  template <typename One>
  typename One::Result operator()(const One& what) const {
    session.require_open();
    if constexpr (requires { session.world_->handle(what); }) {
      return session.world_->handle(what);
    } else {
      throw not_available(
          "a Player server has no canvas, no layers and no arena controller; these exist in "
          "Playpen's simulations only (\"localhost\", or tcp:// for `playpen serve`)");
    }
  }
};

Answer PlayerSession::answer(const Request& request) {
  return answer_by(RequestHandler{*this}, request);
}

}  // namespace playerlike
