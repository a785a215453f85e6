// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
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

/// Takes variables for the program out of this process's environment, and adds those that it needs
/// in the sandbox.
std::map<std::string, std::string> environment_of_program(const std::string& preloaded) {
  std::map<std::string, std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string name(text.substr(0, equals));
    const bool kept = name == "LANG" || name == "LANGUAGE" || name.starts_with("LC_") ||
                      name == "TZ" || name == "TERM" || name.ends_with("SAN_OPTIONS") ||
                      name == "PLAYPEN_VIRTUAL_TIME" || name == "PLAYPEN_LIBRARIES" ||
                      name == "PLAYPEN_SILENCE_LIMIT";
    if (kept) result.emplace(name, text.substr(equals + 1));
  }
  result["PLAYPEN_WORLD"] = std::string("unix:") + kSandboxSocket;
  result["PLAYPEN_RUN"] = "1";
  if (!preloaded.empty()) result["LD_PRELOAD"] = preloaded;
  // Otherwise the library that is loaded into the program would be missed in this process.
  unsetenv("PLAYPEN_VIRTUAL_TIME");
  return result;
}

SandboxSettings sandbox_of(const ContainRequest& request, const Door& door) {
  SandboxSettings settings;
  settings.command = request.command;
  settings.command.front() = fs::absolute(request.command.front()).lexically_normal();
  settings.socket = door.file();
  settings.folder = fs::current_path();
  settings.readable = request.readable;
  settings.hidden = request.hidden;
  settings.sized = !request.unsized;
  settings.environment = environment_of_program(request.preloaded);
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

/// Waits for the end of the program, and meanwhile hands its connections to the run.
/// @return its status in the form of a shell.
int wait_for_end(SandboxedProgram& program, const Door& door, ServedRun& run) {
  std::array<pollfd, 2> polls = {
      {{program.descriptor(), POLLIN, 0}, {door.descriptor(), POLLIN, 0}}};
  auto next_look = Clock::now();
  for (;;) {
    static_cast<void>(poll(polls.data(), polls.size(), kLook_ms));
    for (int connection = door.accept(); connection >= 0; connection = door.accept()) {
      run.serve(connection);
    }
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

/// @return the program's status in the form of a shell; 0 if a signal has ended the run.
int run_contained(const ContainRequest& request) {
  sigset_t mask;
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  EndSignals signals;
  const ScratchFolder folder;
  const Door door(folder / "robots");
  SandboxedProgram program(sandbox_of(request, door), mask);
  std::atomic<int> end_request{0};
  signals.listen(
      [&](int signal) {
        end_request = signal;
        program.kill_all();
      },
      [](int signal) { end_by(signal); });
  ServedRun run;
  const int status = wait_for_end(program, door, run);
  run.close(end_request);
  return end_request != 0 ? kOk : status;
}

}  // namespace

int contain(const ContainRequest& request) {
  const int status = run_contained(request);
  if (status > kSignalStatus && status - kSignalStatus < NSIG) end_by(status - kSignalStatus);
  return status;
}

}  // namespace playpen
