// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_streams.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "server/morse_components.h"
#include "server/morse_state.h"
#include "server/python_json.h"
#include "sim/devices/contact_sensors.h"

namespace playerlike::server {
namespace {

using nlohmann::json;

/// Period of robot_properties [simulated time].
constexpr sim::SimTime kPropertiesPeriod_ns = sim::kNanosecondsPerSecond;

std::string line_of(const json& object) { return python_json(object) + '\n'; }

/// As in MORSE, a collision sensor says nothing while nothing touches.
bool is_silent(const sim::Reading& reading) {
  const auto* collision = dynamic_cast<const sim::CollisionReading*>(&reading);
  return collision != nullptr && !collision->collision;
}

/// The token in a line {"playpen_token": "..."}.
std::optional<std::string> token_in(std::string_view line) {
  try {
    const json object = protocol::decode_json_value(line);
    return protocol::require_text(object, "playpen_token");
  } catch (const protocol::ProtocolError&) {
    return std::nullopt;
  }
}

/// A connection to a stream's port. Its first line may present a token.
class StreamConnection : public Handler {
 public:
  StreamConnection(Peer& peer, Hub& hub)
      : peer_(peer), hub_(hub), state_(hub.morse_state), rights_(hub.access().rights({})) {}

  [[nodiscard]] std::string farewell(const protocol::ProtocolError&) override { return ""; }
  [[nodiscard]] bool may_be_silent() const noexcept override {
    return rights_.connect || rights_.watch;
  }
  [[nodiscard]] Peer& peer() noexcept { return peer_; }

 protected:
  /// Handles the first line if it presents a token. @return whether it does.
  bool take_token(std::string_view line) {
    const bool first = std::exchange(first_line_, false);
    if (!first) return false;
    const auto token = token_in(line);
    if (!token) return false;
    const Hub::TokenVerdict verdict = hub_.check_tokens(peer_, {*token});
    // A connection has one attempt: a wrong token closes it.
    hub_.answer_after(verdict.delay, peer_, alive_, [this, wrong = verdict.wrong, token = *token] {
      if (wrong) return peer_.close("");
      rights_ = hub_.access().rights({token});
      on_rights();
    });
    return true;
  }
  /// Called when the token has changed the rights.
  virtual void on_rights() {}
  [[nodiscard]] const Rights& rights() const noexcept { return rights_; }
  [[nodiscard]] MorseState& state() noexcept { return *state_; }
  /// Logs a warning once per connection.
  void complain(const std::string& component, const std::string& what) {
    if (std::exchange(complained_, true)) return;
    hub_.log(sim::LogLevel::kWarning,
             peer_.name() + ": stream of " + component + ": " + what + " (told once)");
  }

 private:
  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<MorseState> state_;
  Rights rights_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< for timers; expires with this
  bool first_line_ = true;
  bool complained_ = false;
};

/// Collects readings, so that they are encoded after the simulation's mutex is released.
struct ReadingKeeper final : ReadingSink {
  void on_reading(DeviceId /*device*/, const sim::SharedReading& reading) override {
    readings.push_back(reading);
  }
  std::vector<sim::SharedReading> readings;
};

}  // namespace

/// The records that all readers of a sensor get. While it has readers, it is subscribed to the
/// sensor, and an alarm announces readings. It does not take part in the lockstep.
class MorseStreams::Source : public std::enable_shared_from_this<Source> {
 public:
  Source(MorseState& state, const MorseComponent& component)
      : state_(state), component_(component) {}
  ~Source() { stop(); }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  void add(StreamConnection& reader) {
    readers_.push_back(&reader);
    if (readers_.size() == 1) start();
  }
  void remove(StreamConnection& reader) {
    const auto removed = std::erase(readers_, &reader);
    if (removed > 0 && readers_.empty()) stop();
  }
  [[nodiscard]] const MorseComponent& component() const noexcept { return component_; }

 private:
  void start() {
    ++generation_;
    if (component_.device) {
      const DeviceId device = *component_.device;
      count_ = state_.host().count_of_readings(device);
      client_ = state_.host().connect_events(kMorsePort, {});
      client_->session().request(ReplaceRequest{std::nullopt, false});
      client_->session().request(SubscribeRequest{device});
      format_ = state_.host().with_simulation(
          [&](const sim::Simulation& simulation) { return stream_format(simulation, device); });
    }
    set_alarm();
  }

  void stop() {
    if (alarm_) state_.host().cancel_alarm(*alarm_);
    alarm_.reset();
    client_.reset();
  }

  void set_alarm() {
    Alarm alarm;
    if (component_.device) {
      alarm.condition = [&host = state_.host(), device = *component_.device,
                         count = count_](const sim::Simulation&) {
        return host.count_of_readings(device) > count;
      };
    } else {
      alarm.until_ns = state_.host().time().sim_time_ns + kPropertiesPeriod_ns;
    }
    alarm.notify = [box = state_.postbox(), weak = weak_from_this(), number = generation_] {
      box->post([weak, number] {
        const auto source = weak.lock();
        if (source && source->generation_ == number && !source->readers_.empty()) source->ring();
      });
    };
    alarm_ = state_.host().set_alarm(std::move(alarm));
  }

  void ring() {
    alarm_.reset();
    if (component_.device) {
      // Before the readings are taken, so that none is missed.
      count_ = state_.host().count_of_readings(*component_.device);
      ReadingKeeper kept;
      static_cast<void>(client_->session().take(kept));
      for (const auto& reading : kept.readings) {
        if (is_silent(*reading)) continue;
        write(std::make_shared<const std::string>(line_of(morse_record(*reading, format_))));
      }
    } else {
      write(std::make_shared<const std::string>(properties()));
    }
    if (!state_.host().finished()) return set_alarm();
    for (StreamConnection* reader : readers_) reader->peer().close("");
  }

  void write(const std::shared_ptr<const std::string>& line) {
    // A reader that is too slow loses the record.
    for (StreamConnection* reader : readers_) {
      static_cast<void>(reader->peer().send_record(line));
    }
  }

  [[nodiscard]] std::string properties() {
    const RobotInfo& robot = state_.host().robots()[static_cast<std::size_t>(component_.robot)];
    return line_of(morse_properties_record(robot, state_.host().time().sim_time_ns));
  }

  MorseState& state_;
  const MorseComponent& component_;
  std::vector<StreamConnection*> readers_;
  std::unique_ptr<EventClient> client_;
  StreamFormat format_;
  std::uint64_t count_ = 0;  ///< of readings after which the alarm is due
  std::optional<AlarmId> alarm_;
  std::uint64_t generation_ = 0;  ///< number of starts; tells a stale alarm from a current one
};

/// A client that reads a sensor's stream. Its input is ignored, except for a token.
class MorseStreams::Reader final : public StreamConnection {
 public:
  Reader(Peer& peer, Hub& hub, std::shared_ptr<Source> source)
      : StreamConnection(peer, hub), source_(std::move(source)) {
    listen_if_allowed();
  }
  ~Reader() override { source_->remove(*this); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void on_message(std::string_view line) override { static_cast<void>(take_token(line)); }

 private:
  void on_rights() override { listen_if_allowed(); }
  void listen_if_allowed() {
    if (listens_ || !(rights().connect || rights().watch)) return;
    const auto robot = static_cast<std::size_t>(source_->component().robot);
    if (!rights().read.at(robot) && !rights().watch) {
      return complain(source_->component().name,
                      "access/denied: this world lets a client read the sensors of its own robots "
                      "only; the first line must be {\"playpen_token\": \"...\"} with a token for "
                      "this robot");
    }
    listens_ = true;
    source_->add(*this);
  }

  std::shared_ptr<Source> source_;
  bool listens_ = false;
};

/// A client that writes commands for an actuator, one per line.
class MorseStreams::Writer final : public StreamConnection {
 public:
  Writer(Peer& peer, Hub& hub, const MorseComponent& component)
      : StreamConnection(peer, hub),
        component_(component),
        commander_(hub.host().shared_from_this()) {}

  void on_message(std::string_view line) override {
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || take_token(line)) return;
    if (!rights().command.at(static_cast<std::size_t>(component_.robot))) {
      return complain(component_.name,
                      "access/denied: the first line must be {\"playpen_token\": \"...\"} with a "
                      "token for this robot");
    }
    try {
      const json object = protocol::decode_json_value(line);
      const sim::Command command =
          state().host().with_simulation([&](const sim::Simulation& simulation) {
            return morse_command(component_, object, simulation);
          });
      MorseState::command(commander_, *component_.device, command);
    } catch (const std::runtime_error& e) {
      complain(component_.name, e.what());
    }
  }

 private:
  const MorseComponent& component_;
  Commander commander_;
};

MorseStreams::MorseStreams(MorseState& state)
    : state_(state), next_port_(state.hub().settings().stream_port) {}

MorseStreams::~MorseStreams() = default;

int MorseStreams::port(const MorseComponent& component) {
  const auto known = streams_.find(component.name);
  if (known != streams_.end()) return known->second.port;
  Stream stream;
  MakeHandler make;
  // The components belong to the state, which every connection keeps alive.
  if (component.stream == StreamDirection::kOut) {
    stream.source = std::make_shared<Source>(state_, component);
    make = [weak = std::weak_ptr(stream.source)](Peer& peer, Hub& hub) -> std::unique_ptr<Handler> {
      return std::make_unique<Reader>(peer, hub, weak.lock());
    };
  } else {
    make = [&component](Peer& peer, Hub& hub) -> std::unique_ptr<Handler> {
      return std::make_unique<Writer>(peer, hub, component);
    };
  }
  stream.port = state_.hub().listen(next_port_, std::move(make));
  if (next_port_ != 0) next_port_ = stream.port + 1;
  return streams_.emplace(component.name, std::move(stream)).first->second.port;
}

void MorseStreams::open_all() {
  for (const MorseComponent& component : state_.components()) {
    if (component.stream != StreamDirection::kNone && component.device) port(component);
  }
}

void open_morse_streams(Hub& hub) { MorseState::of(hub)->streams().open_all(); }

// --- The clock synchronisation

namespace {

/// A client that lets simulated time advance by one step per message. Only one at a time is
/// allowed, as in MORSE.
class SyncConnection final : public Handler {
 public:
  SyncConnection(Peer& peer, Hub& hub) : peer_(peer), hub_(hub), state_(MorseState::of(hub)) {
    if (state_->synchronised()) {
      throw protocol::ProtocolError("server/sync-taken", "another client synchronises the clock");
    }
    allow(hub_.access().rights({}));
  }
  ~SyncConnection() override {
    if (allowed_) state_->set_synchronised(false);
  }
  SyncConnection(const SyncConnection&) = delete;
  SyncConnection& operator=(const SyncConnection&) = delete;

  [[nodiscard]] bool takes_bytes() const noexcept override { return true; }

  // Bytes that arrive together count as one message, as in MORSE; lines count separately.
  void on_message(std::string_view bytes) override {
    if (!allowed_) {
      std::vector<std::string> tokens;
      if (auto token = token_in(bytes)) tokens.push_back(std::move(*token));
      const Hub::TokenVerdict verdict = hub_.check_tokens(peer_, tokens);
      return hub_.answer_after(verdict.delay, peer_, alive_, [this, tokens = std::move(tokens)] {
        allow(hub_.access().rights(tokens));
        if (!allowed_) peer_.close("access/denied: a token for all robots is needed\n");
      });
    }
    const auto lines = std::count(bytes.begin(), bytes.end(), '\n');
    hub_.host().add_step_credit(static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(1, lines)));
    hub_.pump();
  }
  [[nodiscard]] std::string farewell(const protocol::ProtocolError&) override { return ""; }

 private:
  void allow(const Rights& rights) {
    allowed_ = rights.command_all() && !state_->synchronised();
    if (allowed_) state_->set_synchronised(true);
  }

  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<MorseState> state_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< for timers; expires with this
  bool allowed_ = false;
};

}  // namespace

std::unique_ptr<Handler> make_sync_handler(Peer& peer, Hub& hub) {
  return std::make_unique<SyncConnection>(peer, hub);
}

}  // namespace playerlike::server
