// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/core.h"
#include "host/window/view_controls.h"
#include "host/window/viewer_link.h"

namespace playerlike {

/// A run's live window: its contents and the actions of its keys. The link's thread calls it
/// without the host's mutex.
class Host::Core::Window final : public ViewedRun {
 public:
  Window(Core& core, int socket);
  /// Closes the window. The mutex must not be held.
  void close();

  ViewScene view_scene() override;
  std::string on_key(std::uint32_t keysym, bool pressed, bool control) override;
  void on_shown() override;
  void on_keys_released() override;
  void on_saved(const std::string& file, const std::string& problem) override;
  void on_closed() override;
  void on_lost(const std::string& reason) override;

 private:
  /// Executes the action of a pressed key that does not drive a robot.
  void act(ViewAction action);
  void change_view_mode(int by);
  void change_speed(bool faster);
  void change_pause();
  [[nodiscard]] std::string next_picture_file();
  /// Shows a temporary message in the window.
  void tell(const std::string& text);

  Core& core_;
  KeyDrive hand_;
  bool help_ = true;     ///< shown
  std::string message_;  ///< shown until the time below
  WallClock::time_point message_end_{};
  int pictures_ = 0;  ///< number of the last picture that the user saved
  std::unique_ptr<ViewerLink> link_;
};

}  // namespace playerlike
