// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "connect/run_desk.h"

#include <pthread.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <string_view>

#include "playerlike/host/program_desk.h"
#include "playerlike/session/session.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

// The calls go to the system directly: programs may define functions named connect or send.

/// The connection to the desk. Without destructor, because clients at namespace scope may outlive
/// any static object.
struct Desk {
  std::mutex mutex;
  int descriptor = -1;                            ///< -1: there is no desk
  bool is_own = false;                            ///< the desk has given the world to this process
  char name[sizeof(sockaddr_un::sun_path)] = {};  ///< PLAYPEN_DESK

  void connect() noexcept {
    const std::size_t length = std::strlen(name);
    if (length == 0) return;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy_n(name, length, address.sun_path + 1);  // an abstract name begins with a zero
    const long opened = syscall(SYS_socket, AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (opened < 0) return;
    const std::size_t size = offsetof(sockaddr_un, sun_path) + 1 + length;
    if (syscall(SYS_connect, opened, &address, size) == 0) {
      descriptor = static_cast<int>(opened);
    } else {
      syscall(SYS_close, opened);
    }
  }

  /// Whether the descriptor is still that of the connection; a program may have closed all.
  [[nodiscard]] bool is_open() const noexcept {
    int type = 0;
    socklen_t size = sizeof type;
    return descriptor >= 0 &&
           syscall(SYS_getsockopt, descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
           type == SOCK_SEQPACKET;
  }

  /// Sends a message to the desk. @return whether it was sent.
  [[nodiscard]] bool send(char message) const noexcept {
    return syscall(SYS_sendto, descriptor, &message, 1, MSG_NOSIGNAL, nullptr, 0) == 1;
  }

  static Desk& instance() {
    static Desk* const desk = [] {
      auto* made = new Desk;
      const char* const value = std::getenv("PLAYPEN_DESK");
      if (value != nullptr && std::strlen(value) + 1 < sizeof made->name) {
        std::copy_n(value, std::strlen(value) + 1, made->name);
      }
      made->connect();
      if (made->descriptor >= 0) pthread_atfork(before_fork, after_fork, after_fork_in_child);
      return made;
    }();
    return *desk;
  }

 private:
  static void before_fork() {
    const virtual_time::Inside inside;
    instance().mutex.lock();
  }
  static void after_fork() {
    const virtual_time::Inside inside;
    Desk& desk = instance();
    if (desk.is_open()) static_cast<void>(desk.send(ProgramDesk::kHasForked));
    desk.mutex.unlock();
  }
  // The child is a process of its own, which has no world yet.
  static void after_fork_in_child() {
    const virtual_time::Inside inside;
    Desk& desk = instance();
    if (desk.is_open()) syscall(SYS_close, desk.descriptor);
    desk.descriptor = -1;
    desk.is_own = false;
    desk.connect();
    desk.mutex.unlock();
  }
};

[[maybe_unused]] const bool kIsKnown = Desk::instance().descriptor >= 0;

}  // namespace

std::optional<int> served_world_port() {
  Desk& desk = Desk::instance();
  const std::lock_guard lock(desk.mutex);
  if (desk.is_own || !desk.is_open()) return std::nullopt;
  std::array<char, 1024> answer{};
  long size = -1;
  if (desk.send(ProgramDesk::kAsks)) {
    do {
      size =
          syscall(SYS_recvfrom, desk.descriptor, answer.data(), answer.size(), 0, nullptr, nullptr);
    } while (size < 0 && errno == EINTR);
  }
  if (size <= 0) return std::nullopt;  // `playpen run` was killed, and ends this process, too
  const std::string_view text(answer.data(), static_cast<std::size_t>(size));
  if (text.starts_with("tcp ")) return std::atoi(text.data() + 4);
  if (text.starts_with("no ")) {
    throw SessionError(SessionError::Code::kNotAvailable, std::string(text.substr(3)));
  }
  desk.is_own = true;
  return std::nullopt;
}

}  // namespace playerlike
