// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "companion.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kClosingLimit{2};

std::string program_beside(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path program = folder / name;
  if (!error && access(program.c_str(), X_OK) == 0) return program.string();
  throw std::runtime_error("the program " + name + " is missing, which belongs beside playpen in " +
                           folder.string());
}

}  // namespace

Companion::Companion(const std::string& name, std::vector<std::string> arguments) {
  std::string program = program_beside(name);
  std::vector<char*> words = {program.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error(std::strerror(errno));
  }
  socket_ = ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  // The socket of another companion among them, which that one would find open.
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  const int error = posix_spawn(&child_, program.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error != 0) {
    close(socket_);
    throw std::runtime_error(program + ": " + std::strerror(error));
  }
  fcntl(socket_, F_SETFD, 0);  // the client program inherits it
}

Companion::News Companion::wait(std::chrono::seconds limit) const {
  pollfd readable{socket_, POLLIN, 0};
  const auto deadline = std::chrono::steady_clock::now() + limit;
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const int ready = poll(&readable, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return News::kNothing;
    char first = 0;
    return recv(socket_, &first, 1, MSG_PEEK) > 0 ? News::kMessage : News::kEnd;
  }
}

int Companion::copy_of_socket() const {
  const int copy = fcntl(socket_, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (copy < 0) throw std::runtime_error(std::strerror(errno));
  return copy;
}

bool Companion::has_ended() noexcept {
  if (child_ < 0) return true;
  const pid_t ended = waitpid(child_, nullptr, WNOHANG);
  if (ended == child_ || (ended < 0 && errno != EINTR)) child_ = -1;
  return child_ < 0;
}

Companion::~Companion() {
  // Also if a host in this process has a copy of the descriptor.
  shutdown(socket_, SHUT_WR);
  close(socket_);
  const auto deadline = std::chrono::steady_clock::now() + kClosingLimit;
  while (!has_ended()) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace playpen
