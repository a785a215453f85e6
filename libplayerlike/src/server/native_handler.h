// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/event_wait.h"
#include "server/light_drawings.h"
#include "server/native_state.h"
#include "server/native_step.h"
#include "server/native_work.h"
#include "server/peer.h"
#include "server/request_guard.h"

namespace playerlike::server {

/// Handles one connection in Playpen's own protocol (docs/protocol.md).
///
/// Requests are executed in order. A `read` that waits is answered at the end of its wait, others
/// at once. A request that fails has no effect. Used by the server's thread only.
class NativeHandler final : public Handler {
 public:
  /// The terms that `hello` has negotiated.
  struct Terms {
    protocol::Encoding encoding = protocol::Encoding::kJson;
    Rights rights;
    bool session = true;  ///< false: only watches, without a client in the simulation
    int port = kMorsePort;
    std::string process;  ///< see Hub::thread_id(); not empty
    std::string key;      ///< identifies the session for its followers; not empty
    bool follower = false;
    CreationOrder order;
  };

  /// @param hub  must outlive the handler; its native_state is set.
  /// @throws SessionError as Host::connect_events().
  NativeHandler(Peer& peer, Hub& hub, Terms terms);
  ~NativeHandler() override;

  void on_message(std::string_view message) override;
  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override;

  /// Number of the session; 0: it only watches.
  [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
  /// Size and position of the canvas; notes that the client knows them.
  [[nodiscard]] nlohmann::json tell_canvas();

 private:
  using json = nlohmann::json;  // NOLINT(readability-identifier-naming): the library's name
  using Outcome = EventClient::Outcome;
  struct OwnRequest;
  class ReadingList;

  /// The waits of `read`, and that of `step`.
  enum class Wait { kData, kPeek, kSleep, kTurns, kJoin, kNone, kStep };
  /// A `read` or `step` without an answer so far.
  struct Waiting {
    json id;
    Wait wait;
    bool take = true;         ///< kTurns: whether the answer contains the data
    std::uint64_t timer = 0;  ///< 0: none
    ThreadId thread = 0;      ///< kStep: who waits
    bool rests = false;       ///< kStep: goes on after others have had a turn
  };

  void execute(const json& message, const json& id, std::string& name);
  /// Answers a request at once, or has the worker thread answer it if it takes long.
  void handle_request(Request request, const json& id, const std::string& name);
  /// Runs an action for a request; answers its exceptions.
  template <typename Action>
  void guarded(const json& id, const std::string& name, Action action);
  /// Has the worker thread run run_slice(), then calls then(). If run_slice() throws, the request
  /// fails. Reading from the connection pauses until then.
  void work(const json& id, const std::string& name, std::function<bool()> run_slice,
            std::function<void()> then);
  /// Has the worker thread answer a request that takes long, see native_work.h.
  void answer_elsewhere(Request request, const json& id, const std::string& name);
  /// Queues drawings that are little work, like those of embedded programs. Removes drawings that
  /// others cover.
  /// @return false if they are too much work: then draw_elsewhere() must draw them.
  [[nodiscard]] bool draw_here(std::vector<sim::DrawOperation>& drawings);
  /// Has the worker thread draw, and calls then() afterwards.
  void draw_elsewhere(std::vector<sim::DrawOperation> drawings, const json& id,
                      const std::string& name, std::function<void()> then);
  /// @throws ProtocolError access/denied for drawings on the shared canvas without the right to
  /// change it.
  void require_drawing(std::span<const sim::DrawOperation> drawings) const;
  void answer(const json& id, json answer);
  void fail(const json& id, const std::string& name, std::string_view error, const char* message);

  void read(const json& request, const json& id);
  /// Starts a wait. @return its state.
  Outcome begin(Wait wait, const json& request);
  void begin_to_wait(const json& request, const json& id, Wait wait);
  /// Answers the waiting `read` if its wait is over.
  void answer_waiting();
  void on_peek_timeout();
  /// @param take  see Waiting.
  json round(Wait wait, Outcome outcome, bool take = true);
  json round_of_turns(bool take);
  /// Whether all connections to the server are those of this process's sessions.
  [[nodiscard]] bool is_only_program() const;
  /// The wait of a program in virtual time, see docs/protocol.md#virtual-time.
  [[nodiscard]] EventClient::TurnsWait turns_wait(const json& request) const;
  /// Notes reasons why another run may differ, which the request tells.
  void note_unrepeatable(const json& request);
  /// Numbers of the process's sessions that have data.
  [[nodiscard]] json ready_sessions() const;
  /// Adds the session's readings to an answer. @return their number.
  std::size_t take_readings(json& answer);

  /// Sends the speeds of a `step`, and begins its wait.
  void step(const json& request, const json& id);
  /// Begins or continues the wait of a `step`, and answers when it is over.
  void wait_for_step(const json& id, ThreadId thread);
  /// Continues the wait of a step that rests, see Waiting.
  void go_on_with_step();
  /// Whether the wait of a step is over after one that ended with this outcome.
  [[nodiscard]] bool step_is_over(Outcome outcome);
  json round_of_step();
  /// How many numbers of a device an answer to `step` contains, by its present reading.
  [[nodiscard]] std::size_t expected_numbers(const StepSelection::Device& device);
  /// Subscribes to devices, or to none of them. @throws SessionError.
  void subscribe_all(const StepSelection& selection);
  void unsubscribe_all(const StepSelection& selection);

  /// Opens the connection's session in the simulation.
  void open_session(EventRole role);

  [[nodiscard]] Session& session() { return wait_->session(); }
  [[nodiscard]] ThreadId thread_id(const json& request);

  // Requests about the connection or the client, not about the simulation.
  json command(const json& request);
  json select(const json& request);
  json time(const json& request);
  json thread_ended(const json& request);
  json watch(const json& request);
  json leave(const json& request);
  json bye(const json& request);

  /// Finds one of these requests. @return null for an unknown name.
  [[nodiscard]] static const OwnRequest* find_own_request(std::string_view name);

  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<NativeState> state_;
  Terms terms_;
  std::uint64_t number_ = 0;
  RequestGuard guard_;
  std::shared_ptr<NativeHandler*> self_;  ///< expires with the handler; posted tasks check it
  std::optional<EventWait> wait_;         ///< none: only watches
  std::optional<Waiting> waiting_;
  bool ending_ = false;                  ///< the client has sent bye
  std::uint64_t canvas_generation_ = 0;  ///< the generation that the client knows
  LightDrawings light_drawings_;
  std::unique_ptr<StepSelection> selection_;  ///< of `select`; null before it
  // For images, which come one after another.
  Spare<std::uint8_t> spare_bytes_;
  Spare<sim::CellValue> spare_cells_;
};

}  // namespace playerlike::server
