// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/launch/supervisor.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include "host/launch/processes.h"
#include "host/results/kept_layout.h"
#include "process/end_of_program.h"
#include "sim/core/file.h"

namespace playerlike {
namespace {

using Clock = std::chrono::steady_clock;

// Time between SIGTERM and SIGKILL for processes that the program has left behind.
constexpr std::chrono::milliseconds kLeftoversGrace(1000);
// The same grace period for all processes, when the process that started the program is gone.
constexpr std::chrono::milliseconds kOrphansGrace(2000);
// How long to try to end processes that the system does not end.
constexpr std::chrono::seconds kPatience(10);

/// A message from the supervisor.
struct SupervisorEvent {
  enum Kind { kStarted, kFailed, kStopped, kEnded };
  int kind = kStarted;
  int value = 0;  ///< the program's process id, an errno, or a wait status
};

/// A message to the supervisor.
struct SupervisorCommand {
  enum Kind { kSignal, kKill, kRelease };
  int kind = kSignal;
  int value = 0;
};

std::string between_quotes(const std::string& text) { return "'" + text + "'"; }

}  // namespace

ProgramEnd program_end(int wait_state) {
  ProgramEnd end;
  if (WIFSIGNALED(wait_state)) {
    end.signal = WTERMSIG(wait_state);
  } else {
    end.status = WEXITSTATUS(wait_state);
  }
  return end;
}

std::vector<std::string> changed_environment(const EnvironmentChanges& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!changes.contains(std::string(text.substr(0, text.find('='))))) result.emplace_back(text);
  }
  for (const auto& [name, value] : changes) {
    if (value) result.push_back(name + "=" + *value);
  }
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::map<pid_t, ProcessState> living_processes() {
  std::map<pid_t, ProcessState> processes;
  DIR* const folder = opendir("/proc");
  if (folder == nullptr) return processes;
  while (const dirent* entry = readdir(folder)) {
    const auto number = static_cast<pid_t>(std::strtol(entry->d_name, nullptr, 10));
    if (number <= 0) continue;
    std::string text;
    // A process may vanish before its file is read: the error leaves the text empty.
    if (sim::read_whole_file("/proc/" + std::to_string(number) + "/stat", {}, text)) continue;
    // "PID (NAME) STATE PARENT ..."; the name may contain any characters.
    const std::size_t name_end = text.rfind(')');
    if (name_end == std::string::npos || text.size() < name_end + 5) continue;
    if (text[name_end + 2] == 'Z') continue;
    const long parent = std::strtol(text.c_str() + name_end + 4, nullptr, 10);
    processes[number] = {static_cast<pid_t>(parent), text[name_end + 2], text};
  }
  closedir(folder);
  return processes;
}

namespace {

/// The living descendants of this process, except for the spared children and their descendants.
std::vector<pid_t> descendants(const std::set<pid_t>& spared) {
  const std::map<pid_t, ProcessState> processes = living_processes();
  std::vector<pid_t> found = {getpid()};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const auto& [process, state] : processes) {
      if (state.parent == found[i] && !spared.contains(process)) found.push_back(process);
    }
  }
  found.erase(found.begin());
  return found;
}

/// Ends all descendants except for the spared children and theirs: with SIGTERM, and after the
/// grace period with SIGKILL. @pre SIGCHLD is blocked.
void end_descendants(const std::set<pid_t>& spared, Clock::duration grace) {
  const Clock::time_point begin = Clock::now();
  bool told = grace <= Clock::duration::zero();
  while (Clock::now() - begin < grace + kPatience) {
    const std::vector<pid_t> processes = descendants(spared);
    for (const pid_t process : processes) {
      int state = 0;
      if (waitpid(process, &state, WNOHANG) == process) continue;
      if (Clock::now() - begin >= grace) {
        kill(process, SIGKILL);
      } else if (!told) {
        kill(process, SIGTERM);
        kill(process, SIGCONT);
      }
    }
    told = true;
    if (processes.empty()) break;
    sigset_t children;
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    const timespec moment{0, 10'000'000};
    sigtimedwait(&children, nullptr, &moment);
  }
  if (!spared.empty()) return;  // other code waits for the spared children
  while (waitpid(-1, nullptr, WNOHANG) > 0) {
  }
}

void close_all_but(std::vector<int> kept) {
  std::sort(kept.begin(), kept.end());
  unsigned next = 3;
  for (const int descriptor : kept) {
    if (descriptor < static_cast<int>(next)) continue;
    const auto number = static_cast<unsigned>(descriptor);
    if (number > next) syscall(SYS_close_range, next, number - 1, 0);
    next = number + 1;
  }
  syscall(SYS_close_range, next, ~0U, 0);
}

/// Copies a pipe to a file, up to a limit.
class LimitedLog {
 public:
  /// @param printed  counts what was taken from the pipe; may be null.
  LimitedLog(int from, int file, std::uint64_t limit, PrintedCount* printed)
      : from_(from), file_(file), limit_(limit), printed_(printed) {
    if (from_ >= 0) fcntl(from_, F_SETFL, O_NONBLOCK);
  }

  [[nodiscard]] int descriptor() const noexcept { return from_; }

  /// Copies the available bytes.
  void copy() {
    std::array<char, 1 << 16> bytes{};
    while (from_ >= 0) {
      const ssize_t count = take(bytes);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count <= 0) {
        close(from_);
        from_ = -1;
        return;
      }
      const auto size = static_cast<std::uint64_t>(count);
      const std::uint64_t fitting = std::min(size, limit_ - std::min(limit_, taken_ - size));
      put({bytes.data(), static_cast<std::size_t>(fitting)});
      if (taken_ % (1 << 22) < size) return;  // now and then, to handle other events
    }
  }

  /// Copies the rest, and appends how much was dropped.
  void finish() {
    for (int i = 0; i < 1000 && from_ >= 0; ++i) {
      const std::uint64_t before = taken_;
      copy();
      if (taken_ == before) break;
    }
    if (taken_ <= limit_ || file_ < 0) return;
    put("\n[playpen: the program has printed more than " + std::to_string(limit_) +
        " bytes; the last " + std::to_string(taken_ - limit_) + " are left out]\n");
  }

 private:
  /// Reads from the pipe and counts the bytes. The program may write anything into the shared
  /// memory, so the count is not read from there.
  ssize_t take(std::array<char, 1 << 16>& bytes) {
    if (printed_ != nullptr) ++printed_->reads;
    const ssize_t count = read(from_, bytes.data(), bytes.size());
    const int error = errno;
    if (count > 0) taken_ += static_cast<std::uint64_t>(count);
    if (printed_ != nullptr) {
      printed_->taken = taken_;
      ++printed_->reads;
    }
    errno = error;
    return count;
  }

  void put(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(file_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return;  // a full disk must not block the program
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  int from_;
  int file_;
  std::uint64_t limit_;
  PrintedCount* printed_;
  std::uint64_t taken_ = 0;
};

/// Runs in the supervisor's process.
class Supervisor {
 public:
  Supervisor(const SupervisedStart& start, int channel, int output_file)
      : start_(start), channel_(channel), output_file_(output_file) {}

  void run() {
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, nullptr);
    // Writes beyond a file size limit must fail and not end the supervisor.
    old_limit_action_ = signal(SIGXFSZ, SIG_IGN);
    sigset_t children;
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    children_ = signalfd(-1, &children, SFD_NONBLOCK | SFD_CLOEXEC);
    if (!start_program()) return;
    std::vector<int> kept = {channel_, children_, output_file_, pipe_};
    kept.insert(kept.end(), start_.kept_descriptors.begin(), start_.kept_descriptors.end());
    close_all_but(std::move(kept));
    LimitedLog log(pipe_, output_file_, start_.output_limit, start_.printed);
    while (!end_) wait(log);
    const bool orphaned = channel_ < 0;
    // As a subreaper, this process is now the parent of all processes that the program has left
    // behind.
    if (waitpid(-1, nullptr, WNOHANG) >= 0) {
      end_descendants({}, killed_ || orphaned ? Clock::duration::zero() : kLeftoversGrace);
    }
    log.finish();
    if (!orphaned) {
      send(SupervisorEvent::kEnded, end_state_);
      if (is_released()) return;
    }
    if (start_.on_orphaned) start_.on_orphaned(*end_);
  }

 private:
  void send(int kind, int value) const {
    const SupervisorEvent event{kind, value};
    static_cast<void>(::send(channel_, &event, sizeof event, MSG_NOSIGNAL));
  }

  /// Waits for the other process's release() after the program's end. @return false if that process
  /// is gone.
  [[nodiscard]] bool is_released() const {
    for (;;) {
      SupervisorCommand command;
      const ssize_t size = recv(channel_, &command, sizeof command, 0);
      if (size < 0 && errno == EINTR) continue;
      if (size != static_cast<ssize_t>(sizeof command)) return false;
      if (command.kind == SupervisorCommand::kRelease) return true;
    }
  }

  bool start_program() {
    std::vector<std::string> command = start_.command;
    std::vector<std::string> environment = changed_environment(start_.environment);
    const std::vector<char*> arguments = pointers(command);
    const std::vector<char*> variables = pointers(environment);
    std::array<int, 2> output{-1, -1};
    std::array<int, 2> failure{-1, -1};
    std::array<int, 2> go{-1, -1};
    if (pipe2(failure.data(), O_CLOEXEC) != 0 || pipe2(go.data(), O_CLOEXEC) != 0 ||
        (start_.output_file && pipe2(output.data(), O_CLOEXEC) != 0)) {
      send(SupervisorEvent::kFailed, errno);
      return false;
    }
    if (start_.printed != nullptr) announce(output[0]);
    const pid_t supervisor = getpid();
    program_ = fork();
    if (program_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != supervisor) _exit(127);
      // The program must not end its process group before the supervisor has left that group.
      close(go[1]);
      char byte = 0;
      static_cast<void>(!read(go[0], &byte, 1));
      if (start_.output_file) {
        setpgid(0, 0);
        const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
        dup2(nothing, STDIN_FILENO);
        dup2(output[1], STDOUT_FILENO);
        dup2(output[1], STDERR_FILENO);
      }
      signal(SIGXFSZ, old_limit_action_);
      sigprocmask(SIG_SETMASK, &start_.mask, nullptr);
      if (start_.folder.empty() || chdir(start_.folder.c_str()) == 0) {
        execve(arguments.front(), arguments.data(), variables.data());
      }
      const int error = errno;
      static_cast<void>(!write(failure[1], &error, sizeof error));
      _exit(127);
    }
    const int fork_error = errno;
    setpgid(0, 0);  // not before: the program must join the group in which this process was
    close(go[0]);
    close(go[1]);
    close(failure[1]);
    if (output[1] >= 0) close(output[1]);
    pipe_ = output[0];
    int error = 0;
    if (program_ < 0) {
      error = fork_error;
    } else if (read(failure[0], &error, sizeof error) != sizeof error) {
      error = 0;
    }
    close(failure[0]);
    if (error == 0) {
      send(SupervisorEvent::kStarted, program_);
      return true;
    }
    if (program_ > 0) waitpid(program_, nullptr, 0);
    send(SupervisorEvent::kFailed, error);
    return false;
  }

  /// Tells the program by which pipe it prints.
  void announce(int pipe) const {
    struct stat info {};
    if (pipe < 0 || fstat(pipe, &info) != 0) return;
    start_.printed->limit = start_.output_limit;
    start_.printed->pipe = info.st_ino;
  }

  /// Waits for an event and handles it.
  void wait(LimitedLog& log) {
    std::array<pollfd, 3> polls{
        {{children_, POLLIN, 0}, {channel_, POLLIN, 0}, {log.descriptor(), POLLIN, 0}}};
    int timeout_ms = -1;
    if (kill_time_) {
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(*kill_time_ - Clock::now()).count();
      timeout_ms = static_cast<int>(std::max<long long>(left, 0));
    }
    static_cast<void>(::poll(polls.data(), polls.size(), timeout_ms));
    if (polls[2].revents != 0) log.copy();
    if (polls[1].revents != 0) take_order();
    if (kill_time_ && Clock::now() >= *kill_time_) {
      kill_time_.reset();
      kill_all();
    }
    signalfd_siginfo info{};
    while (read(children_, &info, sizeof info) == sizeof info) {
    }
    reap();
  }

  void reap() {
    for (;;) {
      int state = 0;
      const pid_t child = waitpid(-1, &state, WNOHANG | WUNTRACED);
      if (child <= 0) return;
      if (child != program_) continue;
      if (WIFSTOPPED(state)) {
        if (WSTOPSIG(state) == SIGSTOP) send(SupervisorEvent::kStopped, 0);
        continue;
      }
      // Before the pid is released for reuse.
      end_state_ = state;
      end_ = program_end(state);
      return;
    }
  }

  void take_order() {
    SupervisorCommand command;
    const ssize_t size = recv(channel_, &command, sizeof command, MSG_DONTWAIT);
    if (size == static_cast<ssize_t>(sizeof command)) {
      if (command.kind == SupervisorCommand::kKill) return kill_all();
      forward_signal(command.value);
      return;
    }
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    // The process that started the program is gone.
    close(channel_);
    channel_ = -1;
    for (const pid_t process : descendants({})) {
      kill(process, SIGTERM);
      kill(process, SIGCONT);
    }
    kill_time_ = Clock::now() + kOrphansGrace;
  }

  void forward_signal(int signal) const {
    if (start_.output_file) {
      kill(-program_, signal);
      kill(-program_, SIGCONT);
      return;
    }
    sigval mark{};
    mark.sival_int = kForwarded;
    if (signal != SIGCONT && sigqueue(program_, signal, mark) != 0) kill(program_, signal);
    kill(program_, SIGCONT);
  }

  void kill_all() {
    killed_ = true;
    if (start_.output_file) kill(-program_, SIGKILL);
    kill(program_, SIGKILL);
    for (const pid_t process : descendants({})) kill(process, SIGKILL);
  }

  const SupervisedStart& start_;
  int channel_;
  int output_file_;
  void (*old_limit_action_)(int) = SIG_DFL;
  int children_ = -1;
  int pipe_ = -1;
  pid_t program_ = 0;
  bool killed_ = false;
  std::optional<Clock::time_point> kill_time_;
  std::optional<ProgramEnd> end_;
  int end_state_ = 0;
};

/// The children of this process.
std::set<pid_t> children() {
  std::set<pid_t> found;
  const std::string self = std::to_string(getpid());
  if (std::ifstream file("/proc/self/task/" + self + "/children"); file) {
    for (pid_t child = 0; file >> child;) found.insert(child);
    return found;
  }
  for (const auto& [process, state] : living_processes()) {
    if (state.parent == getpid()) found.insert(process);
  }
  return found;
}

/// The supervisors of this process. For one thread.
std::set<pid_t>& supervisors() {
  static std::set<pid_t> all;
  return all;
}

}  // namespace

SupervisedProgram::SupervisedProgram(const SupervisedStart& start) {
  int output = -1;
  if (start.output_file) {
    output = open(start.output_file->c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (output < 0) {
      throw ProgramError("the file " + between_quotes(*start.output_file) +
                         " can't be made: " + std::strerror(errno));
    }
  }
  const auto refuse = [&](int error) {
    throw ProgramError("the program " + between_quotes(start.command.front()) +
                       " can't be started: " + std::strerror(error));
  };
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const int error = errno;
    if (output >= 0) close(output);
    refuse(error);
  }
  others_ = children();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  supervisor_ = fork();
  if (supervisor_ == 0) {
    // No destructors: they would end what belongs to the parent process.
    try {
      Supervisor supervisor(start, ends[1], output);
      close(ends[0]);
      supervisor.run();
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  const int fork_error = errno;
  close(ends[1]);
  if (output >= 0) close(output);
  channel_ = ends[0];
  if (supervisor_ < 0) {
    close(channel_);
    refuse(fork_error);
  }
  SupervisorEvent event{SupervisorEvent::kFailed, ECHILD};
  ssize_t size = 0;
  do {
    size = recv(channel_, &event, sizeof event, 0);
  } while (size < 0 && errno == EINTR);
  // Without a message the supervisor was killed, perhaps by the program; poll() reports it.
  if (size != static_cast<ssize_t>(sizeof event) || event.kind == SupervisorEvent::kStarted) {
    if (size == static_cast<ssize_t>(sizeof event)) program_ = event.value;
    supervisors().insert(supervisor_);
    return;
  }
  close(channel_);
  reap_supervisor();
  refuse(event.value);
}

SupervisedProgram::SupervisedProgram(SupervisedProgram&& other) noexcept
    : supervisor_(std::exchange(other.supervisor_, 0)),
      program_(other.program_),
      channel_(std::exchange(other.channel_, -1)),
      stopped_(other.stopped_),
      end_(other.end_),
      others_(std::move(other.others_)) {}

SupervisedProgram& SupervisedProgram::operator=(SupervisedProgram&& other) noexcept {
  std::swap(supervisor_, other.supervisor_);
  std::swap(program_, other.program_);
  std::swap(channel_, other.channel_);
  std::swap(stopped_, other.stopped_);
  std::swap(end_, other.end_);
  std::swap(others_, other.others_);
  return *this;
}

SupervisedProgram::~SupervisedProgram() {
  if (channel_ < 0) return;
  if (!end_) kill_all();
  while (!poll()) {
    pollfd event{channel_, POLLIN, 0};
    static_cast<void>(::poll(&event, 1, -1));
  }
  release();
}

void SupervisedProgram::release() {
  if (channel_ < 0) return;
  send(SupervisorCommand::kRelease, 0);
  close(std::exchange(channel_, -1));
  reap_supervisor();
}

void SupervisedProgram::send(int kind, int value) {
  const SupervisorCommand command{kind, value};
  static_cast<void>(::send(channel_, &command, sizeof command, MSG_NOSIGNAL));
}

void SupervisedProgram::send_signal(int signal) { send(SupervisorCommand::kSignal, signal); }
void SupervisedProgram::kill_all() { send(SupervisorCommand::kKill, 0); }

void SupervisedProgram::reap_supervisor() {
  while (waitpid(supervisor_, nullptr, 0) < 0 && errno == EINTR) {
  }
  supervisors().erase(std::exchange(supervisor_, 0));
}

bool SupervisedProgram::take_stopped() noexcept { return std::exchange(stopped_, false); }

std::optional<ProgramEnd> SupervisedProgram::poll() {
  while (!end_) {
    SupervisorEvent event;
    const ssize_t size = recv(channel_, &event, sizeof event, MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return std::nullopt;
    if (size == static_cast<ssize_t>(sizeof event)) {
      if (event.kind == SupervisorEvent::kStopped) stopped_ = true;
      if (event.kind != SupervisorEvent::kEnded) continue;
      end_ = program_end(event.value);
      continue;
    }
    // The supervisor was killed. This process ends what the supervisor would have ended.
    close(std::exchange(channel_, -1));
    reap_supervisor();
    std::set<pid_t> spared = supervisors();
    spared.insert(others_.begin(), others_.end());
    end_descendants(spared, Clock::duration::zero());
    end_.emplace().signal = SIGKILL;
  }
  return end_;
}

}  // namespace playerlike
