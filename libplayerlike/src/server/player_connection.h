// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/player_xdr.h"
#include "server/event_wait.h"
#include "server/guarded_session.h"
#include "server/light_drawings.h"
#include "server/peer.h"
#include "server/request_guard.h"
#include "wire/player_device.h"

namespace playerlike::server {

/// State that the connections in Player's protocol share, see Hub::player_state.
struct PlayerState {
  std::vector<const Peer*> peers;  ///< of all handlers
};

/// Handles one connection in Player's protocol (docs/player_wire.md).
///
/// Answers each request at once, or when the worker thread has made an answer that takes long. A
/// data request in PULL mode begins a wait of the connection's
/// event client; in PUSH mode a wait follows the other. In lockstep, simulated time advances when
/// all clients wait. All messages of a round are written together. Used by the server's thread
/// only.
class PlayerConnection final : public Handler, private wire::DataSink {
 public:
  /// @param hub         must outlive the handler.
  /// @param robot_port  the world's port of the robot.
  /// @param tcp_port    on which the server listens; Player's clients know the robot by it.
  /// @throws SessionError as Host::connect_events().
  PlayerConnection(Peer& peer, Hub& hub, int robot_port, int tcp_port);
  ~PlayerConnection() override;

  void on_message(std::string_view bytes) override;
  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override;
  /// A client in PUSH mode only listens.
  [[nodiscard]] bool may_be_silent() const noexcept override { return !pull_ && !open_.empty(); }

 private:
  using Outcome = EventClient::Outcome;

  /// A device that the client has opened.
  struct OpenDevice {
    player::Devaddr address;
    std::unique_ptr<wire::PlayerDevice> device;
    std::vector<DeviceId> sources;       ///< subscribed
    std::optional<DeviceId> belongs_to;  ///< a device of its robot; none: the world's
    int count = 1;                       ///< how many times it is open
    bool has_failed = false;             ///< an error was logged
  };
  struct Answer {
    bool accepted = false;
    std::string payload;
  };

  void handle(const player::Message& message);
  // Requests of the interface player.
  [[nodiscard]] Answer answer_player(const player::Message& message);
  [[nodiscard]] Answer list_devices();
  [[nodiscard]] Answer describe_driver(std::string_view payload);
  [[nodiscard]] Answer open_or_close(std::string_view payload);
  [[nodiscard]] Answer set_mode(std::string_view payload);
  [[nodiscard]] Answer add_rule(std::string_view payload);
  [[nodiscard]] Answer find_robot(std::string_view payload);
  void authenticate(std::string_view payload);
  void request_data();

  // Devices.
  /// Name of the driver of a device; nullopt if there is no such device.
  [[nodiscard]] std::optional<std::string> driver_of(const player::Devaddr& address) const;
  [[nodiscard]] OpenDevice* find(const player::Devaddr& address);
  /// @throws SessionError, ProtocolError if the client may not read the device.
  void open(const player::Devaddr& address);
  void close(OpenDevice& device);
  void command(OpenDevice& to, const player::Message& message);
  /// Responds, at once or when the answer is made.
  void request(OpenDevice& to, const player::Message& message);
  void draw(std::unique_ptr<wire::Drawings> drawings);
  /// Has the worker thread do a job. Meanwhile the connection does not read.
  /// @param then  called afterwards by the server's thread, if the connection still exists.
  void work(std::function<bool()> run_slice, std::function<void(const std::exception_ptr&)> then);
  /// Runs an action of a device. Its first error is logged.
  template <typename Action>
  void guarded(OpenDevice& device, Action action);
  /// Writes a line to the log; not more than a few for a connection.
  void note(const std::string& text);

  // Rules about data that were not taken yet.
  [[nodiscard]] int rule(const player::Devaddr& address, int subtype) const;
  void apply_rules();

  // Rounds.
  void data(std::uint8_t subtype, std::string payload) override;
  [[nodiscard]] bool wants_round() const;
  /// Begins a wait if the client wants a round.
  void begin_to_wait();
  /// The input of all other connections, see Peer::settled_input().
  [[nodiscard]] std::optional<std::uint64_t> others_input() const;
  /// Calls begin_to_wait() when the input of the other connections that has arrived was handled.
  void wait_after_others();
  void on_wait_end();
  void finish_round(Outcome outcome);
  /// Adds the SYNCH message, which tells how many data were dropped since the last one.
  void end_pull_round();
  [[nodiscard]] ThreadId thread_id();

  // Output.
  [[nodiscard]] player::Devaddr own_address(unsigned interface, unsigned index) const;
  void append(const player::Devaddr& address, int type, int subtype, double time_s,
              std::string_view payload);
  void respond(const player::Devaddr& address, int subtype, const Answer& answer);
  void flush();
  [[nodiscard]] double now_s() const;

  Peer& peer_;
  Hub& hub_;
  const int robot_port_;
  const int tcp_port_;
  const std::uint32_t host_;  ///< this end's address in Player's form
  std::shared_ptr<PlayerState> state_;
  std::shared_ptr<PlayerConnection*> self_;  ///< expires with the handler; later tasks check it
  std::vector<std::string> tokens_;          ///< that the client has presented
  Rights rights_;
  RequestGuard guard_;
  EventWait wait_;
  GuardedSession session_;

  bool pull_ = false;
  bool requested_ = false;  ///< PULL: data was requested and has not been sent
  bool waiting_ = false;
  std::optional<std::uint64_t> others_input_;  ///< at the last turn, see Peer::settled_input()
  int turns_ = 0;            ///< of the event loop since wait_after_others() was first called
  bool has_joined_ = false;  ///< takes part in the lockstep
  ThreadId thread_id_ = 0;
  std::vector<player::AddReplaceRuleReq> rules_;
  std::list<OpenDevice> open_;
  OpenDevice* current_ = nullptr;  ///< whose messages data() takes
  double data_time_s_ = 0.0;       ///< their time
  LightDrawings light_drawings_;
  std::string out_;                   ///< messages to send together
  std::uint32_t round_messages_ = 0;  ///< data messages of the present round
  std::uint32_t overflow_ = 0;        ///< the session's count when it was last asked
  std::uint32_t dropped_ = 0;         ///< data that the client was not told about
  int notes_ = 0;                     ///< lines written by note()
};

}  // namespace playerlike::server
