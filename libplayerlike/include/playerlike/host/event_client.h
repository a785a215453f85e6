// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/process/thread_id.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class Host;
struct Client;

/// Drawings that are executed in several parts; see EventClient::draw_some().
struct DrawWork {
  std::vector<sim::DrawOperation> operations;
  sim::DrawProgress progress;
  std::size_t written = 0;  ///< number of cells written so far
  bool begun = false;
};

/// How an event client takes part in lockstep.
enum class EventRole {
  kParticipant,  ///< simulated time waits for it and advances for it
  kFollower,     ///< acts for another session, see Session::open_follower()
  kOnlooker,     ///< simulated time neither waits for it nor advances for it; its commands come
                 ///< after those of all others
};

/// Which thread of which process has opened a session at a server. Sessions of one process are in
/// the order in which these threads were started, not of their arrival, as within a process.
struct CreationOrder {
  ThreadId process = 0;      ///< 0: unknown, the session comes last
  std::uint64_t thread = 0;  ///< its number within the process; a thread started later has a
                             ///< greater one
};

/// A client of a host for event loops, without its own thread. A call begins a wait and returns; a
/// callback reports the end of the wait. See Host::connect_events(). Any thread may call the
/// members, but only one at a time.
class EventClient final {
 public:
  /// State of a wait.
  enum class Outcome {
    kIdle,      ///< no wait has begun, or it was cancelled
    kWaiting,   ///< the wait is not over
    kData,      ///< a reading is available
    kTime,      ///< the timeout has expired
    kFinished,  ///< the run is over, and no reading is left
  };

  EventClient(std::shared_ptr<Host> host, std::shared_ptr<Client> client);
  EventClient(const EventClient&) = delete;
  EventClient& operator=(const EventClient&) = delete;
  /// Closes the session.
  ~EventClient();

  /// The session, for calls that do not block. Do not call its wait() or peek(), and do not send a
  /// JoinRequest or SleepRequest.
  [[nodiscard]] Session& session() noexcept { return *session_; }

  /// Closes the session of a process that has ended without closing it. Its robots stop with the
  /// next step, if there is one: in a process of its own such a program would have ended the run.
  void abandon() noexcept;

  /// Sets how to find the client's process on this machine. While it is under a debugger, the
  /// silence limit does not count. Without this call, no debugger of the client is known.
  /// @param find  called rarely, by any thread, with the simulation locked; may return nullopt.
  void set_process_search(std::function<std::optional<int>()> find);

  /// Begins a wait like Session::wait(). It ends with kData or kFinished.
  /// @return the outcome, or kWaiting if the wait is not over. The same applies to the functions
  ///         below.
  Outcome begin_wait(ThreadId thread_id);
  /// Begins a wait like Session::peek(). It ends with kData, kTime or kFinished. In a paced
  /// simulation the timeout does not end it: the caller must cancel it.
  Outcome begin_peek(ThreadId thread_id, std::chrono::milliseconds timeout);
  /// Begins a wait like SleepRequest. It ends with kTime or kFinished.
  /// @throws SessionError kBadArgument.
  Outcome begin_sleep(ThreadId thread_id, double seconds);
  /// What a program in virtual time waits for, whose threads take turns; for begin_turns_wait().
  struct TurnsWait {
    bool wants_data = false;                 ///< data of this client end the wait
    sim::SimTime until_ns = 0;               ///< this simulated time ends it
    std::vector<const EventClient*> others;  ///< so do data of these clients of the program
    std::vector<const EventClient*> joined;  ///< take part from now on
  };
  /// Begins a wait for all threads of a program. It ends with kData (data of this client), kTime,
  /// kFinished, or kIdle (data of another one).
  /// @param thread_id  of the program: all of its clients have the same.
  Outcome begin_turns_wait(ThreadId thread_id, const TurnsWait& what);
  /// Whether a reading is available.
  [[nodiscard]] bool has_data() const;
  /// Joins the lockstep like JoinRequest.
  void join(ThreadId thread_id);

  /// Continues drawings like Session::draw(), until about this number of cells has been written (at
  /// most a row of tiles or a line more). The simulation is locked only for this time. Earlier
  /// drawings of the session are executed first. Drawings that a later fill of the same layer
  /// covers are skipped.
  /// @return whether all drawings are complete.
  /// @throws SessionError kDisconnected once the session is closed.
  bool draw_some(DrawWork& work, std::size_t cells);

  /// State of the last wait.
  [[nodiscard]] Outcome outcome() const;
  /// Cancels a wait; outcome() is then kIdle. In lockstep, simulated time stands still for this
  /// client again.
  void cancel();

 private:
  friend class Host;  // and its core

  std::shared_ptr<Host> host_;
  std::shared_ptr<Client> client_;
  std::unique_ptr<Session> session_;
};

/// Why nothing is executed any more, with the id of the error in protocols.
inline constexpr const char* kRunIsOver = "session/finished: the run is over";

/// Commands robots for somebody without a session, such as a client in MORSE's protocol. Any thread
/// may call the members.
class Commander final {
 public:
  explicit Commander(std::shared_ptr<Host> host);
  Commander(const Commander&) = delete;
  Commander& operator=(const Commander&) = delete;
  /// The real robots that it has commanded last stop. Simulated ones drive on, as in MORSE.
  ~Commander();

  /// Executes a command at once, in the simulation or by the real robot that the device mirrors.
  /// @return nothing on success, otherwise the reason: the device refuses, it is not there at the
  ///         real robot, the connection to that one is lost, or the run is over.
  std::optional<std::string> command(DeviceId device, const sim::Command& command);

 private:
  std::shared_ptr<Host> host_;
};

/// An event that an event loop waits for, in addition to its clients' readings.
struct Alarm {
  std::optional<sim::SimTime> until_ns;  ///< the alarm is due at this simulated time
  /// The alarm is due when this returns true. It is called after each step, with the simulation
  /// locked. May be empty.
  std::function<bool(const sim::Simulation&)> condition;
  bool lets_time_pass = false;  ///< lockstep time advances even if no client takes part
  /// Called once when the alarm is due or the run is over, by the thread that steps, with the
  /// simulation locked. It must only forward the notification. The alarm is removed afterwards.
  std::function<void()> notify;
};
/// Id of an alarm; never reused.
using AlarmId = std::uint64_t;

}  // namespace playerlike
