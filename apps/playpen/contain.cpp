// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "commands.h"
#include "end_signals.h"
#include "isolation.h"
#include "own_folders.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/process/log.h"
#include "playerlike/server/server.h"
#include "preload.h"
#include "sandbox.h"
#include "scratch_folder.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kLook_ms = 50;
constexpr auto kShortLook = std::chrono::milliseconds(1);
// How long the server may take to read what ended programs have sent.
constexpr auto kLastMessages = std::chrono::seconds(60);

/// A socket in a folder of this user, on which the program connects. Nothing answers before
/// accept().
class Door {
 public:
  explicit Door(const fs::path& file) : file_(file) {
    descriptor_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = file.string();
    bool good = descriptor_ >= 0 && name.size() < sizeof address.sun_path;
    if (good) {
      std::memcpy(address.sun_path, name.c_str(), name.size() + 1);
      constexpr int kWaiting = 64;
      good = bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
             chmod(name.c_str(), 0666) == 0 &&  // for the sandbox's user; others see no folder
             listen(descriptor_, kWaiting) == 0;
    }
    if (!good) throw std::runtime_error("the socket " + name + " cannot be opened");
  }
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  ~Door() { close(descriptor_); }

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] const fs::path& file() const noexcept { return file_; }
  /// The next connection; -1: none.
  [[nodiscard]] int accept() const {
    return accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  }

 private:
  fs::path file_;
  int descriptor_ = -1;
};

/// The simulation of the run and its server, made for the first connection: a program that makes
/// none has no run and no results.
class ServedRun {
 public:
  void serve(int connection) {
    if (!host_) {
      host_ = playerlike::open_host_of_run();
      playerlike::ServerSettings settings;
      settings.port.reset();
      // The program's terminal is not the place for a line about each connection.
      server_.emplace(host_, settings, playerlike::log_to_stderr(sim::LogLevel::kWarning));
    }
    server_->adopt(connection);
  }

  /// Handles what programs sent before their end, and closes the server. The simulation remains
  /// and writes its results when this process exits, or now if a signal has requested the end.
  void close(int signal) {
    if (!server_) return;
    if (signal != 0) {
      host_->note_end_request(signal);
      host_->finish();
    }
    const auto end = Clock::now() + kLastMessages;
    while (server_->connections() > 0 && Clock::now() < end) {
      std::this_thread::sleep_for(kShortLook);
    }
    server_.reset();
    host_.reset();
  }

 private:
  std::shared_ptr<playerlike::Host> host_;
  std::optional<playerlike::Server> server_;
};

/// The variables of this process that a program in the sandbox gets.
std::map<std::string, std::string> environment_of(const ContainRequest& request) {
  std::map<std::string, std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string name(text.substr(0, equals));
    const bool kept =
        name == "LANG" || name == "LANGUAGE" || name.starts_with("LC_") || name == "TZ" ||
        name == "TERM" || name.ends_with("SAN_OPTIONS") || name == "PLAYPEN_VIRTUAL_TIME" ||
        name == "PLAYPEN_LIBRARIES" || name == "PLAYPEN_SILENCE_LIMIT" ||
        (request.build &&
         std::find(kBuildVariables.begin(), kBuildVariables.end(), name) != kBuildVariables.end());
    if (kept) result.emplace(name, text.substr(equals + 1));
  }
  return result;
}

/// What programs and builds have in common.
SandboxSettings sandbox_of(const ContainRequest& request) {
  SandboxSettings settings;
  settings.command = request.command;
  settings.command.front() = fs::absolute(request.command.front()).lexically_normal();
  settings.folder = fs::current_path();
  settings.readable = request.readable;
  settings.hidden = request.hidden;
  settings.sized = !request.unsized;
  settings.environment = environment_of(request);
  const fs::path package = own_folders().at(1);
  std::error_code error;
  if (fs::exists(package / "CMakeCache.txt", error)) {
    settings.readable.push_back(package);  // a build, where libraries are in many folders
  }
  for (const fs::path& folder : library_folders()) {
    if (fs::is_directory(folder, error)) settings.readable.push_back(folder.parent_path());
  }
  return settings;
}

SandboxSettings sandbox_of_run(const ContainRequest& request, const Door& door) {
  SandboxSettings settings = sandbox_of(request);
  settings.socket = door.file();
  settings.environment["PLAYPEN_WORLD"] = std::string("unix:") + kSandboxSocket;
  settings.environment["PLAYPEN_RUN"] = "1";
  if (!request.preloaded.empty()) settings.environment["LD_PRELOAD"] = request.preloaded;
  // Otherwise the library that is loaded into the program would be missed in this process.
  unsetenv("PLAYPEN_VIRTUAL_TIME");
  return settings;
}

SandboxSettings sandbox_of_build(const ContainRequest& request) {
  SandboxSettings settings = sandbox_of(request);
  settings.writable.push_back(settings.folder);
  // What the package names: of an installation its folders, of a build folder those of the source
  // tree. The worlds are none of it, but their folder must exist.
  const std::vector<fs::path> own = own_folders();
  const fs::path& prefix = own.at(1);
  std::error_code error;
  const bool is_build = fs::exists(prefix / "CMakeCache.txt", error);
  const std::vector<fs::path> places =
      is_build ? std::vector{own.back() / "libplayerlike/include", own.back() / "libsim/include",
                             own.back() / "worlds"}
               : std::vector{prefix / "include", prefix / "share/cmake", prefix / "share/playpen"};
  for (const fs::path& place : places) {
    if (fs::is_directory(place, error)) settings.readable.push_back(place);
  }
  settings.hidden.push_back(is_build ? places.back() : places.back() / "worlds");
  return settings;
}

/// Waits for the end of the program.
/// @param door         -1: none. Otherwise a descriptor that becomes readable at connections.
/// @param at_the_door  called often.
/// @return its status in the form of a shell.
int wait_for_end(SandboxedProgram& program, int door, const std::function<void()>& at_the_door) {
  std::array<pollfd, 2> polls = {{{program.descriptor(), POLLIN, 0}, {door, POLLIN, 0}}};
  auto next_look = Clock::now();
  for (;;) {
    static_cast<void>(poll(polls.data(), polls.size(), kLook_ms));
    at_the_door();
    if (const std::optional<int> status = program.poll()) return *status;
    if (Clock::now() < next_look) continue;
    next_look = Clock::now() + std::chrono::milliseconds(kLook_ms);
    if (const std::string excess = program.excess(); !excess.empty()) {
      std::cerr << "playpen: the program uses " << excess << ", so it is ended\n";
      program.kill_all();
    }
  }
}

/// Ends this process as a signal ended the program, without results: the parent completes those
/// that the simulation has kept.
[[noreturn]] void end_by(int signal) {
  std::cout.flush();
  std::signal(signal, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  raise(signal);
  std::_Exit(kSignalStatus + signal);  // a signal that does not end a process
}

/// Kills a program when a signal asks this process to end.
class EndByRequest {
 public:
  explicit EndByRequest(SandboxedProgram& program, EndSignals& signals) {
    signals.listen(
        [this, &program](int signal) {
          signal_ = signal;
          program.kill_all();
        },
        [](int signal) { end_by(signal); });
  }
  /// The signal; 0: none.
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  std::atomic<int> signal_{0};
};

/// @return the program's status in the form of a shell; 0 if a signal has ended the run.
int run_contained(const ContainRequest& request) {
  sigset_t mask;
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  EndSignals signals;
  const ScratchFolder folder;
  const Door door(folder / "robots");
  SandboxedProgram program(sandbox_of_run(request, door), mask);
  const EndByRequest request_to_end(program, signals);
  ServedRun run;
  const int status = wait_for_end(program, door.descriptor(), [&] {
    for (int connection = door.accept(); connection >= 0; connection = door.accept()) {
      run.serve(connection);
    }
  });
  run.close(request_to_end.signal());
  return request_to_end.signal() != 0 ? kOk : status;
}

/// @return the command's status in the form of a shell.
int build_contained(const ContainRequest& request) {
  sigset_t mask;
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  EndSignals signals;
  SandboxedProgram program(sandbox_of_build(request), mask);
  const EndByRequest request_to_end(program, signals);
  return wait_for_end(program, -1, [] {});
}

}  // namespace

int contain(const ContainRequest& request) {
  const int status = request.build ? build_contained(request) : run_contained(request);
  if (status > kSignalStatus && status - kSignalStatus < NSIG) end_by(status - kSignalStatus);
  return status;
}

}  // namespace playpen
