// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/server/server_settings.h"
#include "protocol/framing.h"
#include "server/token_guard.h"
#include "server/workshop.h"
#include "sim/core/log.h"

namespace playerlike::server {

/// What a connection may do, by the tokens that it has presented.
struct Rights {
  bool connect = false;       ///< use services and read
  bool watch = false;         ///< watch
  std::vector<bool> command;  ///< one a robot, by index: command it
  std::vector<bool> read;     ///< one a robot, by index: read its sensors
  bool truth = false;         ///< read what is no sensor's: poses of objects, the map, the scene
  /// Whether it may do what concerns all robots (reset, pause, quit): it may command each.
  [[nodiscard]] bool command_all() const;
  /// Whether it may change the canvas that all robots share (draw on it, erase, resize): it may
  /// command a robot, or the world has none.
  [[nodiscard]] bool change_canvas() const;
};

/// Who may do what. Compares tokens in constant time.
///
/// Who presents the server's token, or the token of any robot, may connect; anybody, if the server
/// has none. A robot with a token is commanded by those who present it, the others by those who
/// present the server's.
class Access {
 public:
  /// @throws sim::ConfigError access/unknown-robot.
  /// @param own_only  see Host::own_sensors_only(): a robot's sensors are read by those who present
  ///                  its token, or, if it has none, on its port; all else that is true by those
  ///                  who present the tokens of all robots.
  Access(const AccessSettings& settings, const std::vector<RobotInfo>& robots,
         bool own_only = false);
  /// @param tokens  those presented; of a list that is much longer than there are robots, only the
  ///                first ones count.
  /// @param port    of the session; 0: none.
  [[nodiscard]] Rights rights(const std::vector<std::string>& tokens, int port = 0) const;
  /// Whether one of these tokens is none of the server's; never on a server without tokens.
  [[nodiscard]] bool has_wrong(const std::vector<std::string>& tokens) const;

 private:
  std::string server_token_;               ///< "": none
  std::vector<std::string> robot_tokens_;  ///< by index; "": none
  std::vector<int> ports_;                 ///< by index
  bool open_watching_ = false;
  bool own_only_ = false;
};

/// The most tokens that one connection may present.
inline constexpr std::size_t kMaxTokens = 64;

/// The other end of a connection, as those see it who answer. Used by the server's thread only.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// Sends bytes: an answer, that must not be lost. A peer with too many waiting is closed.
  virtual void send(std::string bytes) = 0;
  /// Sends bytes that may be lost: a stream's record, which may go to many peers.
  /// @return whether it goes out; false: too many bytes wait, the record is dropped.
  virtual bool send_record(std::shared_ptr<const std::string> bytes) = 0;
  /// Sends what waits, then `farewell`, then closes. The handler is destroyed soon, but not before
  /// this returns; nothing that it sends meanwhile goes out.
  virtual void close(std::string farewell) = 0;
  /// Requests that are being answered; kept by the handler, limited by the connection: while it
  /// has too many, nothing is read from it.
  virtual void set_in_flight(std::size_t requests) = 0;
  /// While true, nothing is read from the connection: its handler is at work for it elsewhere.
  virtual void set_busy(bool busy) = 0;
  /// What the bytes that follow are encoded in; at first kJson (lines).
  virtual void set_encoding(protocol::Encoding encoding) = 0;
  /// "127.0.0.1:51234", for the log.
  [[nodiscard]] virtual const std::string& name() const noexcept = 0;
  /// What it speaks and who it says it is, for the log: "playpen cbor \"robot\"".
  virtual void describe(const std::string& /*text*/) {}
};

/// Understands what one connection says. Used by the server's thread only. Destroyed when the
/// connection is over, whoever ended it; lockstep time is pumped after that.
class Handler {
 public:
  Handler() = default;
  Handler(const Handler&) = delete;
  Handler& operator=(const Handler&) = delete;
  virtual ~Handler() = default;

  /// A whole line or frame, without its end or length; valid during the call. ProtocolErrors that
  /// escape are answered by closing the connection; others must not.
  virtual void on_message(std::string_view message) = 0;
  /// A message that is too long or was not whole in time: what to say before closing.
  [[nodiscard]] virtual std::string farewell(const protocol::ProtocolError& error) = 0;
  /// Whether on_message() takes bytes as they come, in any pieces, instead of whole messages; asked
  /// before each piece. Nothing can be too long or late then.
  [[nodiscard]] virtual bool takes_bytes() const noexcept { return false; }
  /// Whether it is well that nothing comes from the other end, which only listens: no limit of time
  /// until the first or the next request holds then. Asked when such a time is over.
  [[nodiscard]] virtual bool may_be_silent() const noexcept { return false; }
};

class Hub;
class MorseState;    // morse_state.h
struct NativeState;  // native_state.h

/// Makes the handler of a new connection.
using MakeHandler = std::function<std::unique_ptr<Handler>(Peer&, Hub&)>;

/// What all connections of a server share. Used by the server's thread only, but for post().
class Hub {
 public:
  Hub() = default;
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;
  virtual ~Hub() = default;

  [[nodiscard]] virtual Host& host() noexcept = 0;
  [[nodiscard]] virtual const ServerSettings& settings() const noexcept = 0;
  [[nodiscard]] virtual const Access& access() const noexcept = 0;
  virtual void log(sim::LogLevel level, const std::string& text) = 0;

  /// Has something done by the server's thread, soon. From any thread, also with the simulation
  /// locked.
  virtual void post(std::function<void()> task) = 0;
  /// The same, after a time. @return names it for cancel().
  virtual std::uint64_t after(std::chrono::microseconds delay, std::function<void()> task) = 0;
  virtual void cancel(std::uint64_t timer) = 0;

  /// Has long work done by another thread, in pieces, in turn with that of others; `job.done` is
  /// called by the server's thread. Neither happens any more once the server ends.
  virtual void work(Job job) = 0;
  /// Claims room for an answer that is made elsewhere, until what is returned is destroyed.
  /// @throws ProtocolError server/busy if with it more bytes than
  /// ServerLimits::all_queued_bytes would wait to be read by clients.
  [[nodiscard]] virtual std::shared_ptr<void> claim_room(std::size_t bytes) = 0;

  /// To be called when a client has begun to wait, or left: lockstep time may go on now. What is
  /// over then has been notified, and what was posted meanwhile been done, when this returns; so
  /// the caller may have been called back. Only if time goes on for long (some ms), or from inside
  /// of such a call back, that happens after this has returned, but without another wake-up.
  virtual void pump() = 0;

  /// Opens a further port, on the same addresses, whose connections get their own handlers.
  /// @param first  tried first, then the next ones up; 0: any free one.
  /// @return the port. @throws ProtocolError server/no-port if there is none.
  virtual int listen(int first, MakeHandler make) = 0;
  /// Replaces the handler of a connection (from inside its on_message(): after that returns).
  virtual void hand_over(Peer& peer, std::unique_ptr<Handler> handler) = 0;

  /// What is to be done about tokens that a connection has presented.
  struct TokenVerdict {
    bool wrong = false;                  ///< whether one of them is none of this server's
    std::chrono::milliseconds delay{0};  ///< of the answer
  };
  /// Looks at tokens; notes wrong ones, and tells the log of them now and then.
  [[nodiscard]] TokenVerdict judge_tokens(const Peer& peer, const std::vector<std::string>& tokens);
  /// Does something for a connection after a time, in which nothing more is read from it and nobody
  /// else waits for it; at once if that is no time.
  /// @param handler  of the connection: if it has expired by then, nothing is done.
  void answer_after(std::chrono::milliseconds delay, Peer& peer, std::weak_ptr<void> handler,
                    std::function<void()> action);

  /// A client has asked for the end of the server.
  virtual void quit() = 0;

  /// Returns the id of a thread of a client's process, see EventClient.
  /// @param process  what the process calls itself in its hellos; @param thread  its number there.
  [[nodiscard]] virtual ThreadId thread_id(const std::string& process, std::uint64_t thread) = 0;

  /// What the connections in MORSE's protocol share; made for the first one. To be dropped while
  /// post() can still be called.
  std::shared_ptr<MorseState> morse_state;
  /// What the connections in Playpen's own protocol share; made for the first one.
  std::shared_ptr<NativeState> native_state;

 private:
  TokenGuard guard_;  ///< of all ports
};

/// Handler of a new connection to the services' port: MORSE's protocol, and `playpen hello`.
[[nodiscard]] std::unique_ptr<Handler> make_morse_handler(Peer& peer, Hub& hub);

/// Handler of a new connection to the port of MORSE's clock synchronisation.
[[nodiscard]] std::unique_ptr<Handler> make_sync_handler(Peer& peer, Hub& hub);

/// Carries out `playpen hello`: answers, and hands the connection over to Playpen's protocol.
/// @param id        of the request, to be answered in MORSE's form.
/// @param argument  what hello was given: an object.
void say_hello(Peer& peer, Hub& hub, const std::string& id, const nlohmann::json& argument);

}  // namespace playerlike::server
