// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/// Keys of a window, as they go down and up.
///
/// highgui's waitKey() tells neither releases nor, with its Qt backend, Tab and any key pressed
/// with Ctrl. So the keys are taken from the X server itself, by a connection of our own that asks
/// for the same window's events; highgui keeps getting its own.
class KeyWatch {
 public:
  /// A key went down (once, however long it is held) or up.
  using KeySink = std::function<void(std::uint32_t keysym, bool pressed, bool control)>;

  /// Connects with the display that DISPLAY names.
  /// @throws std::runtime_error if there is none.
  KeyWatch();
  KeyWatch(const KeyWatch&) = delete;
  KeyWatch& operator=(const KeyWatch&) = delete;
  ~KeyWatch();

  [[nodiscard]] int screen_width_px() const;
  [[nodiscard]] int screen_height_px() const;

  /// Readable when something has happened.
  [[nodiscard]] int descriptor() const;

  /// Looks for this process's window of that title, and from then on watches it.
  /// @return whether it is there.
  bool attach(const std::string& title);

  /// Hands on what has happened since the last call.
  /// @param released  called when the window has lost the keyboard, so that releases are missed.
  void poll(const KeySink& key, const std::function<void()>& released);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
