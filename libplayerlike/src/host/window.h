// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/core.h"
#include "host/viewer_link.h"

namespace playerlike {

/// A run's live window: what it shows, and what its keys do. Called by the link's thread, without
/// the host's lock.
class Host::Core::Window final : public ViewedRun {
 public:
  Window(Core& core, int socket);
  /// Closes the window. Not to be called with the lock held.
  void close();

  ViewScene view_scene() override;
  std::string on_key(std::uint32_t keysym, bool pressed, bool control) override;
  void on_keys_released() override;
  void on_saved(const std::string& file, const std::string& problem) override;
  void on_closed() override;
  void on_lost(const std::string& reason) override;

 private:
  /// Carries out a pressed key that drives no robot.
  void act(ViewAction action);
  void change_view_mode(int by);
  void change_speed(bool faster);
  void change_pause();
  [[nodiscard]] std::string next_picture_file();
  /// Puts a passing message into the window.
  void tell(const std::string& text);

  Core& core_;
  HandDrive& hand_;
  bool help_ = true;     ///< shown
  std::string message_;  ///< shown until then
  WallClock::time_point message_end_{};
  int pictures_ = 0;  ///< number of the newest picture that the user saved
  std::unique_ptr<ViewerLink> link_;
};

}  // namespace playerlike
