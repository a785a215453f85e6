// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

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

/// A run's end of the connection to the process that shows its window.
///
/// Its thread handles the viewer's messages. At most 30 times per wall-clock second, and only when
/// the viewer has shown the last picture, it asks the run for a scene, draws it and sends it.
/// Sending never blocks, so a viewer that hangs gets no further pictures. If the viewer ends or
/// sends an invalid message, the run is notified (on_lost) and the connection is closed.
class ViewerLink {
 public:
  /// @param socket  a connected stream socket, owned by the link from now on; close-on-exec is set.
  /// @throws std::runtime_error if it is not a socket.
  ViewerLink(int socket, ViewedRun& run);
  ViewerLink(const ViewerLink&) = delete;
  ViewerLink& operator=(const ViewerLink&) = delete;
  /// Closes the connection, which closes the window, and ends the thread.
  ~ViewerLink();

 private:
  using Clock = std::chrono::steady_clock;

  void serve();
  /// Waits until the socket is readable or writable, a frame is due, or the thread must end.
  void wait_for_work();
  /// @return false if the connection is over.
  [[nodiscard]] bool receive();
  [[nodiscard]] bool handle(const view::ViewerMessage& message);
  [[nodiscard]] bool frame_is_due() const;
  void draw_frame();
  void send_some();
  void save_picture(const std::string& file);

  int socket_ = -1;
  int stop_ = -1;  ///< eventfd: readable when the thread must end
  ViewedRun& run_;
  std::string received_;
  std::string outgoing_;                                ///< a frame that is being sent
  std::size_t sent_ = 0;                                ///< bytes of it sent so far
  sim::render::Image image_;                            ///< of the newest frame
  std::uint32_t number_ = 0;                            ///< of the newest frame
  std::uint32_t shown_ = 0;                             ///< the newest frame on the screen
  std::optional<sim::render::SceneRenderer> renderer_;  ///< unset until the viewer has said hello
  bool last_frame_ = false;  ///< the last frame of the finished run was drawn
  Clock::time_point next_frame_{};
  std::thread thread_;
};

}  // namespace playerlike
