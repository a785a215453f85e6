// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program_desk.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <utility>

#include "host/launch/processes.h"

namespace playerlike {
namespace {

// How long the other processes of the run must have done nothing before a single program gets the
// world, and how long it waits for that at most.
constexpr std::chrono::milliseconds kQuiet(10);
constexpr std::chrono::milliseconds kLongestDoubt(500);

// What the processes of the run do that have not loaded the library; "" if one of them runs.
std::string activity(pid_t program, const std::vector<pid_t>& known) {
  const std::map<pid_t, ProcessState> processes = living_processes();
  const auto started = processes.find(program);
  const pid_t supervisor = started == processes.end() ? program : started->second.parent;
  const auto is_of_run = [&](pid_t process) {
    auto at = processes.find(process);
    while (at != processes.end() && at->first != supervisor) {
      at = processes.find(at->second.parent);
    }
    return at != processes.end() && process != supervisor;
  };
  std::string text = "processes:\n";
  for (const auto& [process, state] : processes) {
    if (std::find(known.begin(), known.end(), process) != known.end() || !is_of_run(process)) {
      continue;
    }
    if (state.letter == 'R' || state.letter == 'D') return "";
    text += state.text;
  }
  return text;
}

}  // namespace

ProgramDesk::ProgramDesk(bool expects_several, std::function<int()> serve)
    : expects_several_(expects_several),
      serve_(std::move(serve)),
      listener_(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  // Bound to no name, the socket gets a free one in the abstract namespace: five hexadecimal
  // digits.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socklen_t size = sizeof(sa_family_t);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (listener_ < 0 || bind(listener_, any, size) != 0 || listen(listener_, 64) != 0 ||
      (size = sizeof address, getsockname(listener_, any, &size)) != 0) {
    const std::string reason = std::strerror(errno);
    if (listener_ >= 0) close(listener_);
    throw std::runtime_error("no socket for the programs of the run: " + reason);
  }
  name_.assign(address.sun_path + 1, size - offsetof(sockaddr_un, sun_path) - 1);
}

ProgramDesk::~ProgramDesk() {
  for (const Known& known : known_) close(known.descriptor);
  close(listener_);
}

std::vector<int> ProgramDesk::descriptors() const {
  std::vector<int> all = {listener_};
  for (const Known& known : known_) all.push_back(known.descriptor);
  return all;
}

bool ProgramDesk::is_busy() const noexcept {
  return std::any_of(known_.begin(), known_.end(), [](const Known& known) { return known.asks; });
}

void ProgramDesk::handle(pid_t program, const std::function<void()>& on_conflict) {
  accept_new();
  read_messages();
  for (Known& known : known_) {
    if (!known.asks) continue;
    const bool agreed = conflict_.empty();
    const std::string answer = answer_to(known, program);
    if (answer.empty()) continue;
    if (agreed && !conflict_.empty() && on_conflict) on_conflict();
    known.asks = false;
    static_cast<void>(send(known.descriptor, answer.data(), answer.size(), MSG_NOSIGNAL));
  }
}

void ProgramDesk::accept_new() {
  for (;;) {
    const int descriptor = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (descriptor < 0) return;
    ucred peer{};
    socklen_t size = sizeof peer;
    if (getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0 ||
        peer.uid != geteuid()) {
      close(descriptor);
      continue;
    }
    known_.push_back({descriptor, peer.pid, false, false, {}});
  }
}

void ProgramDesk::read_messages() {
  std::array<char, 16> message{};
  for (Known& known : known_) {
    ssize_t size = 0;
    while ((size = recv(known.descriptor, message.data(), message.size(), 0)) > 0) {
      if (message[0] == kHasForked) known.has_forked = true;
      if (message[0] == kAsks && !std::exchange(known.asks, true)) known.asked = Clock::now();
    }
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    // The process has ended, or runs another program.
    close(std::exchange(known.descriptor, -1));
    if (known.process == owner_) owner_ = 0;
  }
  std::erase_if(known_, [](const Known& known) { return known.descriptor < 0; });
}

std::string ProgramDesk::answer_to(const Known& known, pid_t program) {
  if (port_ != 0) return share();
  if (owner_ == known.process) return "own";
  if (owner_ != 0) {
    conflict_ = "process " + std::to_string(owner_) +
                " has the world of this run in its own memory, and process " +
                std::to_string(known.process) +
                " came later. Programs that are started together share the world; for programs "
                "that come later, give --clients N or --time real, or start a server (playpen "
                "serve) and then the programs with PLAYPEN_WORLD=tcp://localhost";
    return "no " + conflict_;
  }
  std::vector<pid_t> processes;
  for (const Known& other : known_) processes.push_back(other.process);
  const bool alone = std::all_of(processes.begin(), processes.end(),
                                 [&](pid_t process) { return process == known.process; });
  if (!alone) return share();
  if (known.process != program || known.has_forked) {
    if (expects_several_) return share();
    const Clock::time_point now = Clock::now();
    std::string seen = activity(program, processes);
    if (seen.empty() || seen != activity_) {
      activity_ = std::move(seen);
      quiet_since_ = now;
    }
    if (now - quiet_since_ < kQuiet && now - known.asked < kLongestDoubt) return "";
  }
  owner_ = known.process;
  return "own";
}

std::string ProgramDesk::share() {
  try {
    if (port_ == 0) port_ = serve_();
    return "tcp " + std::to_string(port_);
  } catch (const std::exception& e) {
    return "no " + std::string(e.what());
  }
}

}  // namespace playerlike
