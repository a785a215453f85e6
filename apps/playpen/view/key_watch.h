// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/// Key presses and releases of a window.
///
/// highgui's waitKey() reports no releases and, with its Qt backend, neither Tab nor any key
/// pressed with Ctrl. So this class gets the keys from the X server, over its own connection that
/// requests the same window's events; highgui still receives its own events.
class KeyWatch {
 public:
  /// Called when a key is pressed (once, however long it is held) or released.
  using KeySink = std::function<void(std::uint32_t keysym, bool pressed, bool control)>;

  /// Connects to the display that DISPLAY names.
  /// @throws std::runtime_error if there is none.
  KeyWatch();
  KeyWatch(const KeyWatch&) = delete;
  KeyWatch& operator=(const KeyWatch&) = delete;
  ~KeyWatch();

  [[nodiscard]] int screen_width_px() const;
  [[nodiscard]] int screen_height_px() const;

  /// Becomes readable when there are events.
  [[nodiscard]] int descriptor() const;

  /// Finds this process's window with that title, and watches it from then on.
  /// @return whether the window exists.
  bool attach(const std::string& title);

  /// Reports the events since the last call.
  /// @param released  called when the window has lost the keyboard focus, so that releases are
  ///        missed.
  void poll(const KeySink& key, const std::function<void()>& released);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
