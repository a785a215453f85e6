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

#include "playerlike/host/event_client.h"
#include "server/native_state.h"
#include "server/native_work.h"
#include "server/peer.h"

namespace playerlike::server {

/// Answers one connection in Playpen's own protocol (docs/protocol.md).
///
/// Requests are executed as they come; a `read` that waits is answered when its wait is over,
/// the others at once. A request that fails has done nothing. Used by the server's thread only.
class NativeHandler final : public Handler {
 public:
  /// What `hello` has agreed upon.
  struct Terms {
    protocol::Encoding encoding = protocol::Encoding::kJson;
    Rights rights;
    bool session = true;  ///< false: only watches, and takes no part in the simulation
    int port = kMorsePort;
    std::string process;  ///< see Hub::thread_id(); not empty
    std::string key;      ///< names the session for its followers; not empty
    bool follower = false;
  };

  /// @param hub  lives longer; has a native_state.
  /// @throws SessionError as Host::connect_events().
  NativeHandler(Peer& peer, Hub& hub, Terms terms);
  ~NativeHandler() override;

  void on_message(std::string_view message) override;
  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override;

  /// Size and place of the canvas, of which the client is told herewith.
  [[nodiscard]] nlohmann::json tell_canvas();

 private:
  using json = nlohmann::json;  // NOLINT(readability-identifier-naming): as it is named there
  using Outcome = EventClient::Outcome;
  struct OwnRequest;
  struct Guard;
  class ReadingList;

  enum class Wait { kData, kPeek, kSleep, kJoin, kNone };
  /// A `read` that is not answered yet.
  struct Waiting {
    json id;
    Wait wait;
    std::uint64_t timer = 0;  ///< 0: none
  };

  void execute(const json& message, const json& id, std::string& name);
  /// Does something for a request; what that throws is answered.
  template <typename Action>
  void guarded(const json& id, const std::string& name, Action action);
  /// Has the workshop do something for a request, then calls then(), unless that has failed: then
  /// the request does. Nothing more is read from the connection before.
  void work(const json& id, const std::string& name, std::function<bool()> piece,
            std::function<void()> then);
  /// Has a request answered that takes long: see native_work.h.
  void answer_elsewhere(Request request, const json& id, const std::string& name);
  /// Takes drawings that are little work, to be executed as those of programs are.
  /// @return false if they are more: then they are for draw_elsewhere(). Those that are covered by
  ///         others are taken out.
  [[nodiscard]] bool draw_here(std::vector<sim::DrawOperation>& drawings);
  /// Has the workshop carry drawings out, and calls then() afterwards.
  void draw_elsewhere(std::vector<sim::DrawOperation> drawings, const json& id,
                      const std::string& name, std::function<void()> then);
  /// @throws ProtocolError access/denied if drawings are on the shared canvas, and not allowed
  /// there.
  void require_drawing(std::span<const sim::DrawOperation> drawings) const;
  void require_canvas_rights() const;
  void answer(const json& id, json answer);
  void fail(const json& id, const std::string& name, std::string_view error, const char* message);

  void read(const json& request, const json& id);
  /// @return how the wait stands.
  Outcome begin(Wait wait, const json& request);
  void begin_to_wait(const json& request, const json& id, Wait wait);
  /// Answers the `read` that waits if its wait is over.
  void answer_waiting();
  void on_peek_timeout();
  json round(Wait wait, Outcome outcome);
  json readings();

  [[nodiscard]] Session& session() { return client_->session(); }
  [[nodiscard]] ThreadId thread_id(const json& request);
  /// @throws ProtocolError access/denied.
  void require_command(DeviceId device) const;
  /// @param robot  index; -1: all robots. @throws ProtocolError access/denied.
  void require_rights(int robot) const;
  [[nodiscard]] int robot_named(const std::string& name) const;

  // Requests that are about the connection or the client, not about the simulation.
  json command(const json& request);
  json time(const json& request);
  json thread_ended(const json& request);
  json watch(const json& request);
  json bye(const json& request);

  /// All of them. @return nullptr for an unknown name.
  [[nodiscard]] static const OwnRequest* find_own_request(std::string_view name);

  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<NativeState> state_;
  Terms terms_;
  std::shared_ptr<NativeHandler*> self_;  ///< outlived by what was posted for this one
  std::shared_ptr<EventClient> client_;   ///< none: only watches; shared with what is worked on
  std::optional<Waiting> waiting_;
  bool ending_ = false;                  ///< has said bye
  std::uint64_t canvas_generation_ = 0;  ///< of which the client knows
  std::size_t light_cells_ = 0;  ///< written by drawings that may not have been executed yet
};

}  // namespace playerlike::server
