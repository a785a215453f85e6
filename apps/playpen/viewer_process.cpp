// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "viewer_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kOpeningLimit{30};
constexpr std::chrono::seconds kClosingLimit{2};

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

/// The path of playpen-view, which is installed and built beside this program.
std::string viewer_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path program = folder / "playpen-view";
  if (!error && access(program.c_str(), X_OK) == 0) return program.string();
  throw no_window("the program playpen-view is missing, which belongs beside playpen in " +
                  folder.string());
}

}  // namespace

ViewerProcess::ViewerProcess(const std::string& title) {
  if (!is_set("DISPLAY")) {
    throw no_window(is_set("WAYLAND_DISPLAY")
                        ? "it needs an X display, and DISPLAY is not set (under Wayland, Xwayland "
                          "sets it)"
                        : "there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
  }
  std::array<std::string, 2> command = {viewer_program(), title};
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw no_window(std::strerror(errno));
  }
  socket_ = ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // The viewer communicates through its standard input.
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  std::array<char*, 3> arguments = {command[0].data(), command[1].data(), nullptr};
  const int error =
      posix_spawn(&child_, command[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error != 0) {
    close(socket_);
    throw no_window(command[0] + ": " + std::strerror(error));
  }
  try {
    wait_for_window();
  } catch (...) {
    end();
    throw;
  }
  fcntl(socket_, F_SETFD, 0);  // the client program inherits it
}

// The viewer's first message means that its window is open. It stays in the socket, for the host.
void ViewerProcess::wait_for_window() {
  pollfd readable{socket_, POLLIN, 0};
  const auto deadline = std::chrono::steady_clock::now() + kOpeningLimit;
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const int ready = poll(&readable, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) throw no_window("playpen-view does not answer");
    char first = 0;
    if (recv(socket_, &first, 1, MSG_PEEK) > 0) return;
    const char* const display = std::getenv("DISPLAY");
    throw no_window(std::string("the display ") + (display == nullptr ? "" : display) +
                    " cannot be used");
  }
}

ViewerProcess::~ViewerProcess() { end(); }

void ViewerProcess::end() noexcept {
  close(socket_);
  const auto deadline = std::chrono::steady_clock::now() + kClosingLimit;
  for (;;) {
    const pid_t ended = waitpid(child_, nullptr, WNOHANG);
    if (ended == child_ || (ended < 0 && errno != EINTR)) return;
    if (std::chrono::steady_clock::now() > deadline) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

}  // namespace playpen
