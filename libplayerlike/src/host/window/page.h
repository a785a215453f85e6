// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/core.h"
#include "host/window/frame_link.h"
#include "playerlike/page/protocol.h"
#include "playerlike/replay/replay_builder.h"

namespace playerlike {

/// A run's live page: what its viewers get, and the actions of those who may command
/// (docs/page.md). The link's thread calls it without the host's mutex.
class Host::Core::Page final : public FrameLink {
 public:
  /// @throws std::runtime_error as FrameLink.
  Page(Core& core, int socket);
  /// Sends the end of the run, and closes the connection.
  ~Page() override;
  /// Sends the end of the run, and closes the connection. The mutex must not be held.
  void end() { stop(); }

 protected:
  [[nodiscard]] bool handle_messages(std::string& received, bool& garbage) override;
  [[nodiscard]] bool wants_frame() const override { return ready_ && !under_way_; }
  [[nodiscard]] std::string make_frame() override;
  [[nodiscard]] std::string last_frame() override;
  void tick() override;
  [[nodiscard]] Clock::time_point awake_until() const override;
  void on_lost(const std::string& reason) override;

 private:
  /// A robot that a client steers: until the wall-clock time, unless it repeats the command.
  struct Steering {
    std::uint32_t client = 0;
    Clock::time_point until;
  };

  /// What is new, and everything if somebody waits for it; nullopt if there is nothing.
  /// @param ends  whether this is the last frame.
  [[nodiscard]] std::string frame(bool ends);
  void look();
  [[nodiscard]] nlohmann::json live(bool ends) const;
  void execute(std::uint32_t client, const std::string& text);
  /// @return the refusal; "": the command was executed.
  [[nodiscard]] std::string execute(std::uint32_t client, const nlohmann::json& command);
  [[nodiscard]] std::string steer(std::uint32_t client, const nlohmann::json& what);
  [[nodiscard]] std::string pause(bool paused);
  [[nodiscard]] std::string change_speed(double factor);
  [[nodiscard]] std::string set_block(const nlohmann::json& what);
  [[nodiscard]] std::string place(const nlohmann::json& what);
  void end_steering(int robot);

  Core& core_;
  bool ready_ = false;       ///< the page process listens
  bool under_way_ = false;   ///< a part was sent, and not taken yet
  bool want_whole_ = false;  ///< a viewer waits for a whole
  bool anew_ = false;        ///< and all viewers need one
  std::optional<replay::ReplayBuilder> builder_;
  Clock::time_point next_look_{};    ///< of tick()
  std::string sent_live_;            ///< the last part's `live`
  std::map<int, Steering> steered_;  ///< by robot
  /// The newest command to each device of each robot. The host's mutex guards it.
  struct NewestCommand {
    sim::Command command;
    bool is_new = false;  ///< since the last frame
  };
  std::vector<std::vector<NewestCommand>> commands_;
};

}  // namespace playerlike
