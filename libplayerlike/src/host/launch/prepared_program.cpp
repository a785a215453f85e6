// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/prepared_program.h"

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
#include <ctime>

#include "host/launch/processes.h"

namespace playerlike {
namespace {

constexpr int kPrepareLimit_ms = 30'000;
constexpr int kProgramDescriptor = 198;  // of the socket, in the program

// Receives a number. @return nullopt: the other end is closed, or nothing comes in time.
std::optional<std::uint32_t> receive_number(int socket, int limit_ms) {
  std::uint32_t number = 0;
  auto* const bytes = reinterpret_cast<char*>(&number);
  std::size_t got = 0;
  while (got < sizeof number) {
    pollfd readable{socket, POLLIN, 0};
    const int ready = poll(&readable, 1, limit_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return std::nullopt;
    const ssize_t count = recv(socket, bytes + got, sizeof number - got, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    got += static_cast<std::size_t>(count);
  }
  return number;
}

}  // namespace

PreparedProgram::PreparedProgram(const std::vector<std::string>& command,
                                 const EnvironmentChanges& environment) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw ProgramError(std::string("socketpair: ") + std::strerror(errno));
  }
  socket_ = ends[0];
  EnvironmentChanges changes = environment;
  changes["PLAYPEN_PREPARED"] = std::to_string(kProgramDescriptor);
  std::vector<std::string> variables = changed_environment(changes);
  std::vector<std::string> words = command;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kProgramDescriptor);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C is for this process only
  const int error = posix_spawn(&process_, words.front().c_str(), &actions, &attributes,
                                pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    close(socket_);
    throw ProgramError(command.front() + " cannot be started: " + std::strerror(error));
  }
  if (receive_number(socket_, kPrepareLimit_ms) == prepared::kMagic) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  close(socket_);
  throw ProgramError(command.front() +
                     " cannot be started many times: expected a program that is linked with "
                     "Playpen, found one that is not");
}

PreparedProgram::~PreparedProgram() {
  kill_copy();
  close(socket_);
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

void PreparedProgram::start(const std::vector<std::pair<std::string, std::string>>& variables,
                            const std::string& output_file) {
  std::string request;
  for (const auto& [name, value] : variables) request += name + '=' + value + '\0';
  request += std::string(prepared::kOutputVariable) + '=' + output_file + '\0';
  const auto size = static_cast<std::uint32_t>(request.size());
  request.insert(0, reinterpret_cast<const char*>(&size), sizeof size);
  const bool sent = send(socket_, request.data(), request.size(), MSG_NOSIGNAL) ==
                    static_cast<ssize_t>(request.size());
  const auto copy = sent ? receive_number(socket_, kPrepareLimit_ms) : std::nullopt;
  if (!copy || *copy == 0) throw ProgramError("the prepared program has died, or cannot be copied");
  copy_ = static_cast<pid_t>(*copy);
}

std::optional<ProgramEnd> PreparedProgram::poll() {
  pollfd readable{socket_, POLLIN, 0};
  if (::poll(&readable, 1, 0) != 1) return std::nullopt;
  const auto status = receive_number(socket_, kPrepareLimit_ms);
  copy_ = 0;
  if (!status) throw ProgramError("the prepared program has died");
  return program_end(static_cast<int>(*status));
}

void PreparedProgram::kill_copy() noexcept {
  if (copy_ > 0) kill(-copy_, SIGKILL);
}

double PreparedProgram::processor_time_s() const noexcept {
  clockid_t clock{};
  timespec spent{};
  if (copy_ <= 0 || clock_getcpuclockid(copy_, &clock) != 0 || clock_gettime(clock, &spent) != 0) {
    return 0.0;
  }
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

}  // namespace playerlike
