// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/window/frame_link.h"
#include "playerlike/view/protocol.h"
#include "sim/render/render.h"
#include "sim/simulation/scene_snapshot.h"

namespace playerlike {

/// The contents of a window.
struct ViewScene {
  sim::SceneSnapshot scene;
  std::string status;              ///< text of the status bar
  std::string message;             ///< temporary message, or ""
  std::vector<std::string> help;   ///< lines of the help text
  std::uint32_t robot_colour = 0;  ///< of the chosen robot, 0xRRGGBB
  bool paused = false;
  bool finished = false;  ///< the run is over: this is the last picture
};

/// The run that a window shows. Called from the link's thread.
class ViewedRun {
 public:
  virtual ~ViewedRun() = default;
  /// The present contents of the window.
  [[nodiscard]] virtual ViewScene view_scene() = 0;
  /// A key was pressed or released. @return the file for a copy of the picture on the screen; "":
  /// none.
  [[nodiscard]] virtual std::string on_key(std::uint32_t keysym, bool pressed, bool control) = 0;
  /// The window has lost the keyboard focus.
  virtual void on_keys_released() = 0;
  /// The scene of the last call of view_scene() is on the screen.
  virtual void on_shown() {}
  /// A picture was written; `problem` is the error, or "".
  virtual void on_saved(const std::string& file, const std::string& problem) = 0;
  /// The user closed the window: the run must end.
  virtual void on_closed() = 0;
  /// The viewer has ended without the user's request; the run continues.
  virtual void on_lost(const std::string& reason) = 0;
};

/// A run's end of the connection to the process that shows its window (playerlike/view/protocol.h).
/// The next frame is made only when the viewer has shown the last one.
class ViewerLink final : public FrameLink {
 public:
  /// @param socket  as FrameLink. @throws std::runtime_error as FrameLink.
  ViewerLink(int socket, ViewedRun& run);
  /// Closes the connection, which closes the window, and ends the thread.
  ~ViewerLink() override;

 protected:
  [[nodiscard]] bool handle_messages(std::string& received, bool& garbage) override;
  [[nodiscard]] bool wants_frame() const override {
    return renderer_ && !last_frame_ && shown_ == number_;
  }
  [[nodiscard]] std::string make_frame() override;
  /// The last picture is on the screen: closing the connection closes the window.
  [[nodiscard]] bool is_done() const override { return last_frame_ && shown_ == number_; }
  void on_lost(const std::string& reason) override { run_.on_lost(reason); }

 private:
  [[nodiscard]] bool handle(const view::ViewerMessage& message);
  void save_picture(const std::string& file);

  ViewedRun& run_;
  sim::render::Image image_;                            ///< of the newest frame
  std::uint32_t number_ = 0;                            ///< of the newest frame
  std::uint32_t shown_ = 0;                             ///< the newest frame on the screen
  std::optional<sim::render::SceneRenderer> renderer_;  ///< unset until the viewer has said hello
  bool last_frame_ = false;  ///< the last frame of the finished run was drawn
};

}  // namespace playerlike
