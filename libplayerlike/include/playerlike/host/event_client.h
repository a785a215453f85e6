// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "playerlike/process/thread_id.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class Host;
struct Client;

/// Drawings that are executed piece by piece, see EventClient::draw_some().
struct DrawWork {
  std::vector<sim::DrawOperation> operations;
  sim::DrawProgress progress;
  std::size_t written = 0;  ///< cells, so far
  bool begun = false;
};

/// A client of a host without a thread of its own, for event loops: waiting is begun, and its end
/// is told. See Host::connect_events(). All members may be called from any thread, but by one at a
/// time.
class EventClient final {
 public:
  /// How a wait stands.
  enum class Outcome {
    kIdle,      ///< none was begun, or it was cancelled
    kWaiting,   ///< not over yet
    kData,      ///< a reading waits to be taken
    kTime,      ///< the time is over
    kFinished,  ///< the run is over, and nothing is left to take
  };

  EventClient(std::shared_ptr<Host> host, std::shared_ptr<Client> client);
  EventClient(const EventClient&) = delete;
  EventClient& operator=(const EventClient&) = delete;
  /// Closes the session.
  ~EventClient();

  /// All that does not wait. Its wait() and peek() must not be called, nor may it be asked to join
  /// or sleep.
  [[nodiscard]] Session& session() noexcept { return *session_; }

  /// As Session::wait(): over with kData or kFinished.
  /// @return the outcome, kWaiting if it is not over yet; so for the calls below.
  Outcome begin_wait(ThreadId thread_id);
  /// As Session::peek(): over with kData, kTime or kFinished. In a paced simulation it does not end
  /// by time: who began it cancels it.
  Outcome begin_peek(ThreadId thread_id, std::chrono::milliseconds timeout);
  /// As SleepRequest: over with kTime or kFinished.
  /// @throws SessionError kBadArgument.
  Outcome begin_sleep(ThreadId thread_id, double seconds);
  /// As JoinRequest.
  void join(ThreadId thread_id);

  /// Carries on with drawings as Session::draw() does, until about so many cells have been written
  /// (a row of tiles or a line more at most); the simulation is locked for that long only. What the
  /// session has drawn before comes first. Drawings that a later fill of the same layer covers are
  /// left out.
  /// @return whether all is done. @throws SessionError kDisconnected once the session is closed.
  bool draw_some(DrawWork& work, std::size_t cells);

  /// How the last wait stands.
  [[nodiscard]] Outcome outcome() const;
  /// Ends a wait: outcome() is kIdle then. In lockstep the client thinks again.
  void cancel();

 private:
  std::shared_ptr<Host> host_;
  std::shared_ptr<Client> client_;
  std::unique_ptr<Session> session_;
};

/// Something that an event loop waits for besides its clients' readings.
struct Alarm {
  std::optional<sim::SimTime> until_ns;  ///< over when simulated time has come so far
  /// Over when this is so; asked after each step, with the simulation locked. May be empty.
  std::function<bool(const sim::Simulation&)> condition;
  bool lets_time_pass = false;  ///< whether lockstep time goes on for it while no client takes part
  /// Called once when it is over or the run is, with the simulation locked, by whichever thread
  /// steps: it must do no more than pass the news on. The alarm is gone then.
  std::function<void()> notify;
};
/// Names an alarm; never given twice.
using AlarmId = std::uint64_t;

}  // namespace playerlike
