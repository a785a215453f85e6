// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "remote/message_sender.h"
#include "virtual_time/program_clock.h"

namespace playerlike {

/// The simulation of a server in lockstep as the clock of virtual time: when no thread of the
/// program can run, one of them has the server advance time until one of their waits is over.
///
/// The server sees the program as one thread, which waits when all of its threads do. A message
/// goes out for each such wait, not for each step. It travels on the connection of a session whose
/// data a thread waits for, and its answer brings these data.
///
/// Simulated time is counted from the first session on, as in a process of its own, also if the
/// server has run before. Members may be called from any thread.
class RemoteClock final : public ProgramClock, public std::enable_shared_from_this<RemoteClock> {
 public:
  /// The clock's state of a session. The mutex of Turns guards it unless stated otherwise.
  struct Client {
    std::shared_ptr<MessageSender> sender;  ///< constant
    std::uint64_t number = 0;               ///< of the session at the server
    bool follower = false;                  ///< constant
    ThreadId creator = 0;                   ///< the thread that connected it; constant

    ThreadId owner = 0;                   ///< the thread that waited last; 0: none
    bool must_join = false;               ///< the server does not know yet that it takes part
    bool has_data = false;                ///< a round was fetched, or waits at the server
    bool wants_data = false;              ///< data end the present wait, ...
    bool fetches = false;                 ///< ... and are fetched, since they are taken at once
    std::optional<sim::SimTime> wake_ns;  ///< this time ends the present wait
    int zero_peeks = 0;                   ///< consecutive calls of peek(0)
    std::optional<nlohmann::json> round;  ///< an answer with data, until take_round()
    bool fetched = false;                 ///< the same until note_taken()
    std::optional<ConnectionLost> lost;   ///< until a thread of the session has got it, and ...
    bool usable = true;                   ///< ... false until note_reconnected()
    bool closed = false;
    std::chrono::steady_clock::time_point seen{};  ///< when the program last used it
  };
  using ClientPointer = std::shared_ptr<Client>;

  struct Settings {
    sim::SimTime step_ns = 0;
    /// Of which this is the clock. It is kept, so that later sessions find the clock.
    std::shared_ptr<RemoteSimulation> simulation;
    double silence_limit_s = 5.0;  ///< wall time
    bool quiet_end = false;        ///< see SocketSettings
  };
  /// How a wait has ended.
  enum class Outcome {
    kOver,   ///< by data, time or the end of the run
    kRetry,  ///< time is no longer virtual: the session must wait by itself
  };

  explicit RemoteClock(const Settings& settings);

  /// Adds a session of the calling thread. @param server_ns  the server's time.
  ClientPointer add(std::shared_ptr<MessageSender> sender, std::uint64_t number, bool follower,
                    sim::SimTime server_ns);
  /// The session closes. @return whether its connection must be kept, see MessageSender::leave():
  /// it is the last one, and time must pass at the server while the program has no session.
  [[nodiscard]] bool remove(const ClientPointer& client) noexcept;
  /// Whether time is virtual and waits must use this clock.
  [[nodiscard]] bool rules() const noexcept { return Turns::instance().active(); }

  /// Waits like Session::wait(): with kOver there is a round, or the run is over.
  /// @throws SessionError; ConnectionLost.
  Outcome wait(Client& client);
  /// Waits like SleepRequest.
  Outcome sleep(Client& client, sim::SimTime duration_ns);
  /// Waits like Session::peek(). @param result  receives the answer if the outcome is kOver.
  Outcome peek(Client& client, std::chrono::milliseconds timeout, bool& result);
  /// The session has a new connection. @param number  of the session there.
  void note_reconnected(Client& client, std::uint64_t number);
  /// Joins like JoinRequest.
  void join(Client& client);
  /// Whether data are there; without a message.
  [[nodiscard]] bool has_data(const Client& client) const;
  /// The answer that a wait has brought, if there is one.
  [[nodiscard]] std::optional<nlohmann::json> take_round(Client& client);
  /// The session has taken its data.
  void note_taken(Client& client);
  /// The program has used the session.
  void touch(Client& client);
  /// The calling thread reads in the background, see PreferRealTimeRequest.
  void note_background();
  /// A session has thrown because the run is over.
  void note_end_reported();
  /// The calling thread, which has waited here, ends.
  void thread_ended() noexcept;

  bool step(Lock& lock) override;
  [[nodiscard]] bool step_waits() const noexcept override { return true; }
  void check_silent_clients() override {}  // the server does
  [[nodiscard]] std::chrono::steady_clock::time_point last_seen(
      const TurnThread& thread) const override;
  void on_silent(const TurnThread& thread) override;
  bool on_blocked(const TurnThread& /*thread*/) override { return false; }
  [[nodiscard]] sim::SimTime now_ns() const noexcept override {
    return now_ns_.load(std::memory_order_acquire);
  }
  [[nodiscard]] sim::SimTime step_ns() const noexcept override { return settings_.step_ns; }
  [[nodiscard]] std::chrono::steady_clock::duration silence_limit() const override;

 private:
  class Wait;
  /// A message to the server, and what it waits for.
  struct Advance {
    ClientPointer carrier;
    std::shared_ptr<Connection> connection;  ///< null: not sent yet
    std::uint64_t id = 0;
    nlohmann::json request;
    bool wants_data = false;  ///< data of the carrier end it, ...
    bool fetches = false;     ///< ... and are part of the answer
  };

  [[nodiscard]] bool in_turns() const override { return rules(); }
  [[nodiscard]] bool over() const override { return over_; }
  [[nodiscard]] bool ended_by_program() const override { return false; }
  void adopt_sessions_of(ThreadId thread_id) override;
  [[nodiscard]] Lock lock_for_stepping() const override { return lock_shortly(); }
  [[nodiscard]] Lock lock_shortly() const override { return Lock(Turns::instance().mutex()); }
  [[nodiscard]] EndRules end_rules() const override;
  void tell_end(bool /*asleep*/) override {}

  void adopt(Client& client, ThreadId thread_id);
  Outcome wait_until(Lock& lock, Client& client, bool wants_data,
                     std::optional<sim::SimTime> wake_ns);
  /// What to have the server do for the threads that wait. @return false: there is no session.
  [[nodiscard]] bool prepare(Advance& advance);
  /// Sends the message, if it has not been sent, and waits a little for the answer. The mutex must
  /// not be held. @param lost  receives the error.
  [[nodiscard]] static std::optional<nlohmann::json> answer_to(Advance& advance,
                                                               std::optional<ConnectionLost>& lost);
  /// Time passes although the server cannot be reached. @return whether it has.
  bool pass_alone();
  [[nodiscard]] std::optional<sim::SimTime> earliest_wake() const;
  /// The server has answered. @param answer  of the message.
  void apply(const Advance& advance, nlohmann::json answer);
  [[nodiscard]] static bool is_over(const RemoteClock& clock, const Client& client);
  void make_waiters_ready();

  const Settings settings_;
  std::atomic<sim::SimTime> now_ns_{0};
  sim::SimTime start_ns_ = 0;           ///< the server's time at this clock's zero
  std::vector<ClientPointer> clients_;  ///< as in Clients of the host: followers, then the others
  ClientPointer last_;  ///< a closed session whose connection carries messages if there is no other
  std::optional<Advance> advance_;  ///< the message on its way
  bool busy_ = false;               ///< a thread waits for its answer, without the mutex
  bool over_ = false;
  bool end_reported_ = false;
  std::size_t reasons_told_ = 0;  ///< how many of Turns::unrepeatable() the server knows
};

}  // namespace playerlike
