// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "viewer_process.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace playpen {
namespace {

constexpr std::chrono::seconds kOpeningLimit{30};

/// The error for a user who cannot have a window.
std::runtime_error no_window(const std::string& reason) {
  return std::runtime_error("--view cannot open a window: " + reason +
                            ". To watch the run later, record a film instead: "
                            "--record film.mp4");
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

ViewerProcess::ViewerProcess(const std::string& title) {
  if (!is_set("DISPLAY")) {
    throw no_window(is_set("WAYLAND_DISPLAY")
                        ? "it needs an X display, and DISPLAY is not set (under Wayland, Xwayland "
                          "sets it)"
                        : "there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
  }
  try {
    companion_.emplace("playpen-view", std::vector{title});
  } catch (const std::runtime_error& error) {
    throw no_window(error.what());
  }
  // The viewer's first message means that its window is open. It stays in the socket, for the host.
  const Companion::News news = companion_->wait(kOpeningLimit);
  if (news == Companion::News::kNothing) throw no_window("playpen-view does not answer");
  if (news == Companion::News::kMessage) return;
  const char* const display = std::getenv("DISPLAY");
  throw no_window(std::string("the display ") + (display == nullptr ? "" : display) +
                  " cannot be used");
}

}  // namespace playpen
