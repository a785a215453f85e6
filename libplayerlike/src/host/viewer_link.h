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

/// What a window shows at one moment.
struct ViewScene {
  sim::SceneSnapshot scene;
  std::string status;              ///< line of the status bar
  std::string message;             ///< passing message, or ""
  std::vector<std::string> help;   ///< lines of help
  std::uint32_t robot_colour = 0;  ///< of the chosen robot, 0xRRGGBB
  bool paused = false;
  bool finished = false;  ///< the run is over: this is the last picture
};

/// The run that a window shows, as its link sees it. Called from the link's thread.
class ViewedRun {
 public:
  virtual ~ViewedRun() = default;
  /// What is to be shown now.
  [[nodiscard]] virtual ViewScene view_scene() = 0;
  /// A key went down or up.
  /// @return the file into which the picture on the screen is to be written; "": none.
  [[nodiscard]] virtual std::string on_key(std::uint32_t keysym, bool pressed, bool control) = 0;
  /// The window has lost the keyboard.
  virtual void on_keys_released() = 0;
  /// A picture was written, or why not.
  virtual void on_saved(const std::string& file, const std::string& problem) = 0;
  /// The user closed the window: the run shall end.
  virtual void on_closed() = 0;
  /// The viewer is gone without having been closed by the user; the run goes on.
  virtual void on_lost(const std::string& reason) = 0;
};

/// A run's end of the connection to the process that shows its window.
///
/// A thread of its own takes what the viewer sends and, at most 30 times a second of wall time and
/// only when the viewer has shown the last picture, asks the run for a scene, draws it and sends
/// it. Sending never blocks, so a viewer that hangs is only not sent anything. One that ends, or
/// sends what is no message, is told to the run (on_lost) and forgotten.
class ViewerLink {
 public:
  /// @param socket  a connected stream socket, from now on the link's; closed when programs are
  ///                started from this one.
  /// @throws std::runtime_error if it is none.
  ViewerLink(int socket, ViewedRun& run);
  ViewerLink(const ViewerLink&) = delete;
  ViewerLink& operator=(const ViewerLink&) = delete;
  /// Closes the connection, by which the window is closed, and ends the thread.
  ~ViewerLink();

 private:
  using Clock = std::chrono::steady_clock;

  void serve();
  /// Waits until the socket can be read or written, a frame is due, or the end.
  void wait_for_work();
  /// @return false if the connection is over.
  [[nodiscard]] bool receive();
  [[nodiscard]] bool handle(const view::ViewerMessage& message);
  [[nodiscard]] bool frame_is_due() const;
  void draw_frame();
  void send_some();
  void save_picture(const std::string& file);

  int socket_ = -1;
  int stop_ = -1;  ///< eventfd: readable when the thread shall end
  ViewedRun& run_;
  std::string received_;
  std::string outgoing_;                                ///< a frame that is being sent
  std::size_t sent_ = 0;                                ///< bytes of it that are gone
  sim::render::Image image_;                            ///< of the newest frame
  std::uint32_t number_ = 0;                            ///< of the newest frame
  std::uint32_t shown_ = 0;                             ///< the newest frame that is on the screen
  std::optional<sim::render::SceneRenderer> renderer_;  ///< unset until the viewer said hello
  bool last_frame_ = false;  ///< the run is over, its last frame was made
  Clock::time_point next_frame_{};
  std::thread thread_;
};

}  // namespace playerlike
