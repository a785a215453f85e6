// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/server/server_settings.h"
#include "playerlike/server/token_throttle.h"
#include "protocol/framing.h"
#include "server/worker_thread.h"
#include "sim/core/log.h"

namespace playerlike::server {

/// Rights of a connection, given by the tokens that it has presented.
struct Rights {
  bool connect = false;       ///< may use services and read
  bool watch = false;         ///< may watch
  std::vector<bool> command;  ///< by robot index: may command it
  std::vector<bool> read;     ///< by robot index: may read its sensors
  bool truth = false;         ///< may read ground truth: poses of objects, the map, the scene
  /// Whether it may make requests that affect all robots (reset, pause, quit): it may command every
  /// robot.
  [[nodiscard]] bool command_all() const;
  /// Whether it may change what all robots share, the canvas (draw, erase, resize) and the
  /// blackboard: it may command a robot, or the world has none.
  [[nodiscard]] bool change_shared() const;
};

/// Grants rights for tokens. Compares tokens in constant time.
///
/// A connection may connect if it presents the server's token or the token of any robot; on a
/// server without a token everybody may. Commanding a robot requires the robot's token, or, if the
/// robot has none, the server's token.
class Access {
 public:
  /// @throws sim::ConfigError access/unknown-robot.
  /// @param own_only  see Host::own_sensors_only(). Reading a robot's sensors requires its token,
  ///                  or, if it has none, a session on its port. Reading other ground truth
  ///                  requires the tokens of all robots.
  Access(const AccessSettings& settings, const std::vector<RobotInfo>& robots,
         bool own_only = false);
  /// @param tokens  the presented tokens; of a list that is much longer than the number of robots,
  ///                only the first ones are checked.
  /// @param port    of the session; 0: none.
  [[nodiscard]] Rights rights(const std::vector<std::string>& tokens, int port = 0) const;
  /// Whether a token is unknown to the server; always false on a server without tokens.
  [[nodiscard]] bool has_wrong(const std::vector<std::string>& tokens) const;

 private:
  std::string server_token_;               ///< "": no token
  std::vector<std::string> robot_tokens_;  ///< by index; "": no token
  std::vector<int> ports_;                 ///< by index
  bool open_watching_ = false;
  bool own_only_ = false;
};

/// Maximum number of tokens that a connection may present.
inline constexpr std::size_t kMaxTokens = 64;

/// A connection, as its handler sees it. Used by the server's thread only.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// Queues an answer, which must not be lost. If too many bytes are queued, the connection is
  /// closed.
  virtual void send(std::string bytes) = 0;
  /// Queues a record of a stream, which may be lost and may be shared by many peers. @return false:
  /// too many bytes are queued, so the record is dropped.
  virtual bool send_record(std::shared_ptr<const std::string> bytes) = 0;
  /// Sends the queue, then `farewell`, then closes. The handler is destroyed later, not before this
  /// returns; what it sends in the meantime is dropped.
  virtual void close(std::string farewell) = 0;
  /// Sets the number of requests without an answer. While it is too high, the connection does not
  /// read.
  virtual void set_in_flight(std::size_t requests) = 0;
  /// While true, the connection does not read, because a request is executed elsewhere.
  virtual void set_busy(bool busy) = 0;
  /// Sets the framing of the following input; at first kLines.
  virtual void set_framing(protocol::Framing framing) = 0;
  /// From now on input is acknowledged to the other end's system at once, if no answer does so. The
  /// next message of a client that leaves Nagle's algorithm on then follows without delay.
  virtual void acknowledge_at_once() {}
  /// Bytes of input that the handler has got; nullopt while more has arrived that it could take.
  [[nodiscard]] virtual std::optional<std::uint64_t> settled_input() const { return 0; }
  /// The process at the other end; nullopt if it is unknown or on another machine. See
  /// peer_process().
  [[nodiscard]] virtual std::optional<int> local_process() { return std::nullopt; }
  /// The same search for later and for any thread; see peer_process_search().
  [[nodiscard]] virtual std::function<std::optional<int>()> process_search() { return {}; }
  /// The address of this end as it lies in memory; 0: not IPv4.
  [[nodiscard]] virtual std::uint32_t own_ipv4() { return 0; }
  /// "127.0.0.1:51234", for the log.
  [[nodiscard]] virtual const std::string& name() const noexcept = 0;
  /// Sets the text for the log: protocol and client name, 'playpen cbor "robot"'.
  virtual void describe(const std::string& /*text*/) {}
};

/// Handles the input of one connection. Used by the server's thread only. Destroyed when the
/// connection is over, whoever ended it; after that, lockstep time is pumped.
class Handler {
 public:
  Handler() = default;
  Handler(const Handler&) = delete;
  Handler& operator=(const Handler&) = delete;
  virtual ~Handler() = default;

  /// Handles a complete line or frame, without its end or length; the text is valid during the
  /// call. A ProtocolError closes the connection; other exceptions must not escape.
  virtual void on_message(std::string_view message) = 0;
  /// The last message for a connection that is closed because of this error.
  [[nodiscard]] virtual std::string farewell(const protocol::ProtocolError& error) = 0;
  /// Whether on_message() takes bytes as they arrive, in chunks of any size, instead of complete
  /// messages; asked before each chunk. No message is too long or too late then.
  [[nodiscard]] virtual bool takes_bytes() const noexcept { return false; }
  /// Whether the client may be silent, since it only listens. The time limits for the first and the
  /// next request do not apply then. Asked when such a limit has expired.
  [[nodiscard]] virtual bool may_be_silent() const noexcept { return false; }
};

class Hub;
class MorseState;    // morse_state.h
struct NativeState;  // native_state.h
struct PlayerState;  // player_connection.h

/// Creates the handler of a new connection.
using MakeHandler = std::function<std::unique_ptr<Handler>(Peer&, Hub&)>;

/// State and services that all connections of a server share. Used by the server's thread only,
/// except for post().
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

  /// Runs a task on the server's thread later. May be called from any thread, also while the
  /// simulation is locked.
  virtual void post(std::function<void()> task) = 0;
  /// Runs a task on the server's thread after a delay. @return an id for cancel().
  virtual std::uint64_t after(std::chrono::microseconds delay, std::function<void()> task) = 0;
  virtual void cancel(std::uint64_t timer) = 0;

  /// Gives long work to the worker thread, which runs jobs slice by slice in turn. The server's
  /// thread calls `job.done`. When the server ends, remaining slices and `job.done` are dropped.
  virtual void work(Job job) = 0;
  /// Claims room for an answer that the worker thread makes; destroying the result releases it.
  /// @throws ProtocolError server/busy if the bytes that clients have not read yet would exceed
  /// ServerLimits::all_queued_bytes.
  [[nodiscard]] virtual std::shared_ptr<void> claim_room(std::size_t bytes) = 0;

  /// Lets lockstep time advance. Must be called when a client has begun to wait or has left. When
  /// this returns, waits that are over have been notified and posted tasks have run, so the caller
  /// may have been called back. Two exceptions: if time advances for long (some ms), or inside of
  /// such a callback, this happens after the return, without another wake-up.
  virtual void pump() = 0;

  /// A client has just got an answer, and its next message comes so soon that it is worth looking
  /// for it before the server's thread sleeps, see ShortWait.
  virtual void expect_soon() {}

  /// Number of open connections; 0: unknown.
  [[nodiscard]] virtual std::size_t connections() const noexcept { return 0; }

  /// TCP ports of Player's protocol by the robots' ports in the world; empty if it is not offered.
  [[nodiscard]] virtual const std::map<int, int>& player_ports() const noexcept = 0;
  /// Opens another port on the server's addresses, with its own kind of handler.
  /// @param first  the first port to try, then the following ones; 0: any free port.
  /// @return the port.
  /// @throws ProtocolError server/no-port if none is free.
  virtual int listen(int first, MakeHandler make) = 0;
  /// Replaces the handler of a connection; inside its on_message(), after that returns.
  virtual void hand_over(Peer& peer, std::unique_ptr<Handler> handler) = 0;

  /// How to respond to the tokens of a connection.
  struct TokenVerdict {
    bool wrong = false;                  ///< whether a token is unknown to this server
    std::chrono::milliseconds delay{0};  ///< to wait before the answer
  };
  /// Checks tokens; counts wrong ones and logs some of them.
  [[nodiscard]] TokenVerdict check_tokens(const Peer& peer, const std::vector<std::string>& tokens);
  /// Runs an action for a connection after a delay, at once if the delay is zero. The connection
  /// does not read in the meantime; other connections are not delayed.
  /// @param handler  of the connection; if it has expired by then, the action is dropped.
  void answer_after(std::chrono::milliseconds delay, Peer& peer, std::weak_ptr<void> handler,
                    std::function<void()> action);

  /// Ends the server on a client's request.
  virtual void quit() = 0;

  /// The id of a thread in a client's process, see EventClient.
  /// @param process  the name of the process in its hellos.
  /// @param thread   the thread's number there.
  [[nodiscard]] virtual ThreadId thread_id(const std::string& process, std::uint64_t thread) = 0;

  /// State of the connections in MORSE's protocol, created for the first one. Must be destroyed
  /// while post() can still be called.
  std::shared_ptr<MorseState> morse_state;
  /// State of the connections in Playpen's own protocol, created for the first one.
  std::shared_ptr<NativeState> native_state;
  /// State of the connections in Player's protocol, created for the first one.
  std::shared_ptr<PlayerState> player_state;

 private:
  TokenThrottle throttle_;  ///< counts wrong tokens on all ports
};

/// Handler of a connection to the services' port, for MORSE's protocol and `playpen hello`.
[[nodiscard]] std::unique_ptr<Handler> make_morse_handler(Peer& peer, Hub& hub);

/// Handler of a connection to the port of MORSE's clock synchronisation.
[[nodiscard]] std::unique_ptr<Handler> make_sync_handler(Peer& peer, Hub& hub);

/// Opens the ports of all streams of MORSE's protocol. @throws protocol::ProtocolError
/// server/no-port.
void open_morse_streams(Hub& hub);

/// Executes `playpen hello`: answers, and switches the connection to Playpen's protocol.
/// @param id        of the request; the answer has MORSE's format.
/// @param argument  of hello: an object.
void say_hello(Peer& peer, Hub& hub, const std::string& id, const nlohmann::json& argument);

}  // namespace playerlike::server
