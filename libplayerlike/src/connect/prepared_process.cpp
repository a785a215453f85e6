// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "connect/prepared_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "playerlike/host/prepared_program.h"

namespace playerlike {
namespace {

using prepared::kMagic;

bool read_all(int socket, void* to, std::size_t size) {
  auto* bytes = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t count = read(socket, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool send_number(int socket, std::uint32_t number) {
  return send(socket, &number, sizeof number, MSG_NOSIGNAL) == sizeof number;
}

// The output of a copy goes into a file.
void redirect_output(const char* file) {
  const int descriptor = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) return;
  dup2(descriptor, STDOUT_FILENO);
  dup2(descriptor, STDERR_FILENO);
  close(descriptor);
}

// Sets the environment of a copy: NAME=VALUE, each with a zero byte after it.
void become_copy(std::string_view variables) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit most{prepared::kGreatestFile, prepared::kGreatestFile};
  setrlimit(RLIMIT_FSIZE, &most);
  unsetenv("PLAYPEN_PREPARED");
  while (!variables.empty()) {
    const std::size_t end = variables.find('\0');
    const std::string entry(variables.substr(0, end));
    variables.remove_prefix(end == std::string_view::npos ? variables.size() : end + 1);
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos) continue;
    const std::string name = entry.substr(0, equals);
    if (name == prepared::kOutputVariable) {
      redirect_output(entry.c_str() + equals + 1);
    } else {
      setenv(name.c_str(), entry.c_str() + equals + 1, 1);
    }
  }
}

// Waits until a copy has ended. Kills it if the process that wants its status ends before.
void kill_if_left_alone(int socket, pid_t copy) {
  const auto process = static_cast<int>(syscall(SYS_pidfd_open, copy, 0));
  if (process < 0) return;                                 // an old kernel
  pollfd both[] = {{process, POLLIN, 0}, {socket, 0, 0}};  // of the socket, that it is hung up
  while (poll(both, 2, -1) < 0 && errno == EINTR) {
  }
  if (both[0].revents == 0) kill(-copy, SIGKILL);
  close(process);
}

// Serves the next request. @return false: there is none; true in a copy.
std::optional<bool> serve_one(int socket) {
  std::uint32_t size = 0;
  if (!read_all(socket, &size, sizeof size) || size > prepared::kGreatestRequest) return false;
  std::string variables(size, '\0');
  if (!read_all(socket, variables.data(), size)) return false;
  const pid_t copy = fork();
  if (copy == 0) {
    close(socket);
    become_copy(variables);
    return true;
  }
  if (copy > 0) setpgid(copy, copy);
  if (!send_number(socket, copy < 0 ? 0U : static_cast<std::uint32_t>(copy))) return false;
  if (copy < 0) return std::nullopt;
  kill_if_left_alone(socket, copy);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  kill(-copy, SIGKILL);  // what it has left behind
  if (!send_number(socket, static_cast<std::uint32_t>(status))) return false;
  return std::nullopt;
}

// After keep_library_functions() of libsim (101), and before virtual time begins, which a fork
// ends: register_hooks() in virtual_time.cpp.
__attribute__((constructor(102))) void serve_before_all() {
  static_cast<void>(serve_if_prepared());
}

}  // namespace

bool serve_if_prepared() noexcept {
  const char* const text = std::getenv("PLAYPEN_PREPARED");
  if (text == nullptr) return true;
  int socket = -1;
  const char* const end = text + std::strlen(text);
  if (std::from_chars(text, end, socket).ptr != end || socket < 3) return true;
  fcntl(socket, F_SETFD, FD_CLOEXEC);
  if (!send_number(socket, kMagic)) _exit(0);
  for (;;) {
    const std::optional<bool> served = serve_one(socket);
    if (!served) continue;
    if (*served) return true;
    _exit(0);
  }
}

}  // namespace playerlike
