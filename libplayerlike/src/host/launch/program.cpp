// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/launch/supervisor.h"
#include "host/stepping/standstill_watch.h"
#include "playerlike/host/program_desk.h"
#include "process/debugger.h"
#include "sim/core/number_text.h"
#include "sim/world/realism.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

std::string in_quotes(const std::string& text) { return "'" + text + "'"; }

/// The reason why a path can't be run; nullopt if it can.
std::optional<std::string> obstacle_to_running(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) {
    return errno == ENOENT
               ? "there is no program " + in_quotes(path)
               : "the program " + in_quotes(path) + " can't be reached: " + std::strerror(errno);
  }
  if (S_ISDIR(info.st_mode)) return in_quotes(path) + " is a folder, not a program";
  if (!S_ISREG(info.st_mode) || access(path.c_str(), X_OK) != 0) {
    return in_quotes(path) +
           " is no executable file; is it the built program, or is chmod +x missing?";
  }
  return std::nullopt;
}

std::string absolute_path(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

using Clock = std::chrono::steady_clock;

// How long a program may continue after a request to end, or after its results are complete, before
// it is killed; as TimeGiven. The documented limit is two seconds; the rest is for writing the
// results.
constexpr std::chrono::milliseconds kTimeToEnd(1500);
constexpr std::chrono::milliseconds kPollPeriod(20);
constexpr std::chrono::milliseconds kSlowPollPeriod(200);
constexpr std::chrono::milliseconds kDoubtPeriod(2);  ///< while ProgramDesk::is_busy()

/// Blocks the relevant signals in this thread while a program runs, so that they can be read one by
/// one from a descriptor. Signals that this process ignores, as under nohup, stay ignored.
class HeldSignals {
 public:
  HeldSignals() {
    // If SIGCHLD were ignored, as inherited from some parents, the program's status would be lost.
    struct sigaction by_default {};
    by_default.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &by_default, &old_child_action_);
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
      struct sigaction present {};
      if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) {
        sigaddset(&held_, signal);
      }
    }
    sigset_t blocked = held_;
    sigaddset(&blocked, SIGCHLD);
    pthread_sigmask(SIG_BLOCK, &blocked, &old_mask_);
    descriptor_ = signalfd(-1, &held_, SFD_NONBLOCK | SFD_CLOEXEC);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() {
    // Signals that arrived too late for the program are dropped; this process ends anyway.
    while (take()) {
    }
    close(descriptor_);
    sigaction(SIGCHLD, &old_child_action_, nullptr);
    pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
  }

  /// The original mask, for the program.
  [[nodiscard]] const sigset_t& old_mask() const noexcept { return old_mask_; }

  struct Signal {
    int number = 0;
    bool from_system = false;  ///< from the terminal
  };
  /// The next pending signal.
  [[nodiscard]] std::optional<Signal> take() const {
    signalfd_siginfo info{};
    if (read(descriptor_, &info, sizeof info) != sizeof info) return std::nullopt;
    const bool from_process = info.ssi_code == SI_USER || info.ssi_code == SI_QUEUE;
    return Signal{static_cast<int>(info.ssi_signo), !from_process};
  }

  /// Waits until a signal is pending or a descriptor is readable, at most for a given time.
  void wait(const std::vector<int>& descriptors, Clock::duration at_most) const {
    std::vector<pollfd> polls = {{descriptor_, POLLIN, 0}};
    for (const int descriptor : descriptors) polls.push_back({descriptor, POLLIN, 0});
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
    static_cast<void>(
        poll(polls.data(), polls.size(), static_cast<int>(std::clamp<long long>(left, 0, 60'000))));
  }

 private:
  int descriptor_ = -1;
  sigset_t held_{};
  sigset_t old_mask_{};
  struct sigaction old_child_action_ {};
};

/// Tells copies of a request to end from further requests.
class EndRequests {
 public:
  enum class Meaning { kFirst, kCopy, kRepeated };

  Meaning note(int signal) {
    const Clock::time_point now = Clock::now();
    if (!first_) {
      first_ = signal;
      time_ = now;
      return Meaning::kFirst;
    }
    return is_same_request(*first_, signal, now - time_) ? Meaning::kCopy : Meaning::kRepeated;
  }
  [[nodiscard]] std::optional<int> first() const noexcept { return first_; }

 private:
  std::optional<int> first_;
  Clock::time_point time_;
};

/// Whether the program has received a signal too. The terminal's signals go to the whole foreground
/// group, except for SIGHUP, which goes to the session leader only.
bool is_programs_too(const HeldSignals::Signal& signal) {
  const bool leads_session = getsid(0) == getpid();
  return signal.from_system && !(signal.number == SIGHUP && leads_session);
}

/// The total size of the files in a folder; counting may stop beyond the limit.
std::uint64_t size_of(const std::string& folder, std::uint64_t limit) {
  std::uint64_t size = 0;
  std::error_code error;
  // Files that disappear meanwhile are no error.
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    struct stat info {};
    if (lstat(entry->path().c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
    // Size on disk, since a file may have holes.
    size += std::min(static_cast<std::uint64_t>(info.st_size),
                     static_cast<std::uint64_t>(info.st_blocks) * 512);
    if (size > limit) break;
  }
  return size;
}

/// A program in its own process group. The destructor kills it and all processes that it has
/// started.
class GroupedProgram {
 public:
  GroupedProgram(const ProgramJob& job, std::size_t index, const sigset_t& mask)
      : index_(index),
        folder_(job.folder),
        folder_limit_(job.folder_limit),
        program_(start_of(job, mask)) {}

  [[nodiscard]] std::size_t index() const noexcept { return index_; }
  [[nodiscard]] int descriptor() const noexcept { return program_.descriptor(); }

  /// How it ended; nullopt while it runs.
  [[nodiscard]] std::optional<JobEnd> poll() {
    const std::optional<ProgramEnd> end = program_.poll();
    if (!end) return std::nullopt;
    program_.release();
    return JobEnd{kind_, *end, std::chrono::duration<double>(Clock::now() - start_).count()};
  }

  /// Sends SIGTERM for this reason; the program is killed if it still runs after the grace period.
  void ask_to_end(JobEnd::Kind reason, Clock::duration grace) {
    if (kill_time_) return;
    kind_ = reason;
    kill_time_ = Clock::now() + grace;
    program_.send_signal(SIGTERM);
  }

  /// Applies the time limits.
  /// @param timeout  how long the program may run.
  /// @return when to call this again.
  Clock::time_point enforce_limits(Clock::duration timeout, Clock::duration grace) {
    const Clock::time_point now = Clock::now();
    if (now - start_ >= timeout) ask_to_end(JobEnd::Kind::kTimedOut, grace);
    if (!folder_.empty() && !kill_time_ && now >= next_check_) {
      next_check_ = now + kSlowPollPeriod;
      if (size_of(folder_, folder_limit_) > folder_limit_) {
        ask_to_end(JobEnd::Kind::kTooMuchOutput, Clock::duration::zero());
      }
    }
    if (kill_time_ && now >= *kill_time_ && !std::exchange(killed_, true)) program_.kill_all();
    if (kill_time_) return killed_ ? Clock::time_point::max() : *kill_time_;
    return folder_.empty() ? start_ + timeout : std::min(start_ + timeout, next_check_);
  }

  void end_grace() { kill_time_ = Clock::now(); }

 private:
  static SupervisedStart start_of(const ProgramJob& job, const sigset_t& mask) {
    SupervisedStart start;
    start.command = job.command;
    start.environment = job.environment;
    if (job.at_start) {
      for (auto& [name, value] : job.at_start()) start.environment[name] = value;
    }
    start.folder = job.working_folder;
    start.mask = mask;
    start.output_file = job.output_file;
    start.output_limit = job.output_limit;
    if (job.kept) start.printed = &job.kept().printed();
    return start;
  }

  std::size_t index_;
  std::string folder_;
  std::uint64_t folder_limit_;
  Clock::time_point next_check_ = Clock::now() + kSlowPollPeriod;
  SupervisedProgram program_;
  Clock::time_point start_ = Clock::now();
  JobEnd::Kind kind_ = JobEnd::Kind::kEnded;
  std::optional<Clock::time_point> kill_time_;  ///< set after the request to end
  bool killed_ = false;
};

std::optional<std::string> text_unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

void add_picture_settings(EnvironmentChanges& changes, const RunSettings& settings) {
  changes["PLAYPEN_RECORD_SIZE"] = text_unless_empty(film_size_text(settings.pictures));
  changes["PLAYPEN_FOLLOW"] = text_unless_empty(follow_text(settings.pictures));
  changes["PLAYPEN_CROP"] = text_unless_empty(crop_text(settings.pictures));
  changes["PLAYPEN_HIDE"] = text_unless_empty(hide_text(settings.pictures));
  changes["PLAYPEN_COLOUR_BY"] = text_unless_empty(colour_by_text(settings.pictures));
}

}  // namespace

std::string ProgramEnd::text() const {
  if (!signal) return "ended with status " + std::to_string(status);
  return "was ended by signal " + std::to_string(*signal) + " (" + strsignal(*signal) + ")";
}

std::string find_program(const std::string& name) {
  if (name.empty()) throw ProgramError("the program's name is empty");
  if (name.find('/') != std::string::npos) {
    if (const auto obstacle = obstacle_to_running(name)) throw ProgramError(*obstacle);
    return name;
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
  for (;;) {
    const std::size_t colon = rest.find(':');
    const std::string folder(rest.substr(0, colon));
    // An empty entry of PATH means the current folder.
    std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
    if (!obstacle_to_running(candidate)) return candidate;
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  std::string message = "there is no program " + in_quotes(name) + " on the PATH";
  if (!obstacle_to_running("./" + name)) {
    message += "; for the one in this folder write ./" + name;
  }
  throw ProgramError(message);
}

bool is_same_request(int first, int signal, std::chrono::nanoseconds age) noexcept {
  constexpr std::chrono::milliseconds kOneRequest(500);
  // A closed terminal may cause two SIGHUPs: one from the system and one from the shell.
  return signal == first && (signal == SIGHUP || age < kOneRequest);
}

EnvironmentChanges run_environment(const std::string& world_file, const RunSettings& settings) {
  const auto path_or_nothing = [](const std::string& path) {
    return path.empty() ? std::nullopt : std::optional(absolute_path(path));
  };
  EnvironmentChanges changes;
  changes["PLAYPEN_WORLD"] = path_or_nothing(world_file);
  changes["PLAYPEN_OUT"] = path_or_nothing(settings.output_folder);
  changes["PLAYPEN_RESULTS"] =
      settings.figures_only ? std::optional<std::string>("figures") : std::nullopt;
  changes["PLAYPEN_RECORD"] = path_or_nothing(settings.film);
  changes["PLAYPEN_VIEW"] =
      settings.view_socket ? std::optional(std::to_string(*settings.view_socket)) : std::nullopt;
  changes["PLAYPEN_PAGE"] =
      settings.page_socket ? std::optional(std::to_string(*settings.page_socket)) : std::nullopt;
  changes["PLAYPEN_PORT"] =
      settings.robot_port ? std::optional(std::to_string(*settings.robot_port)) : std::nullopt;
  changes["PLAYPEN_PLAYER_PORT"] =
      settings.player_port ? std::optional(std::to_string(*settings.player_port)) : std::nullopt;
  changes["PLAYPEN_GRADE"] =
      settings.grading.nonce.empty() ? std::nullopt : std::optional(settings.grading.nonce);
  const std::string rules = to_text(settings.grading.rules);
  changes["PLAYPEN_TASK"] = rules.empty() ? std::nullopt : std::optional(rules);
  const RunSettings defaults;
  const auto number_unless = [](double value, double by_default) {
    return value != by_default ? std::optional(sim::shortest_text(value)) : std::nullopt;
  };
  changes["PLAYPEN_RECORD_FPS"] = number_unless(settings.film_fps, defaults.film_fps);
  changes["PLAYPEN_RECORD_SPEED"] = number_unless(settings.film_speed, defaults.film_speed);
  changes["PLAYPEN_RECORD_FROM"] = number_unless(settings.film_from_s, defaults.film_from_s);
  changes["PLAYPEN_SNAPSHOT_EVERY"] =
      settings.snapshot_period_s ? std::optional(sim::shortest_text(*settings.snapshot_period_s))
                                 : std::nullopt;
  add_picture_settings(changes, settings);
  changes["PLAYPEN_VIEW_MODE"] =
      settings.view_mode ? std::optional(std::string(sim::to_string(*settings.view_mode)))
                         : std::nullopt;
  changes["PLAYPEN_REALISM"] = settings.realism
                                   ? std::optional(std::string(sim::to_string(*settings.realism)))
                                   : std::nullopt;
  changes["PLAYPEN_CLIENTS"] =
      settings.clients ? std::optional(std::to_string(*settings.clients)) : std::nullopt;
  std::string interfaces;
  for (const InterfaceChoice& choice : settings.interfaces) {
    interfaces += (interfaces.empty() ? "" : ",") + choice.text();
  }
  changes["PLAYPEN_INTERFACES"] = interfaces.empty() ? std::nullopt : std::optional(interfaces);
  std::string real_robots;
  for (const RealRobotChoice& choice : settings.real_robots) {
    real_robots += (real_robots.empty() ? "" : ",") + choice.text();
  }
  changes["PLAYPEN_REAL"] = text_unless_empty(real_robots);
  changes["PLAYPEN_TAKE_OVER"] =
      settings.take_over ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_SEED"] =
      settings.seed ? std::optional(std::to_string(*settings.seed)) : std::nullopt;
  changes["PLAYPEN_DURATION"] =
      settings.duration_s ? std::optional(sim::shortest_text(*settings.duration_s)) : std::nullopt;
  auto& time = changes["PLAYPEN_TIME"];
  if (settings.time_mode == sim::TimeMode::kLockstep) time = "lockstep";
  if (settings.time_mode == sim::TimeMode::kPaced) time = sim::shortest_text(settings.time_factor);
  changes["PLAYPEN_PROGRESS"] = settings.progress ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_VIRTUAL_TIME"] =
      settings.virtual_time ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_STATE"] = path_or_nothing(settings.kept_run);
  changes["PLAYPEN_START"] = path_or_nothing(settings.start_state);
  changes["PLAYPEN_UNTIL"] =
      settings.stop ? std::optional(sim::shortest_text(settings.stop->time_s)) : std::nullopt;
  changes["PLAYPEN_THEN"] =
      settings.stop ? std::optional<std::string>(
                          settings.stop->then == RunStop::Then::kView ? "view" : "debug")
                    : std::nullopt;
  changes["PLAYPEN_DESK"] = std::nullopt;
  changes["PLAYPEN_PREPARED"] = std::nullopt;
  changes["PLAYPEN_RUN"] = settings.quiet_end ? std::optional<std::string>("1") : std::nullopt;
  return changes;
}

ProgramEnd run_program(const std::vector<std::string>& command,
                       const EnvironmentChanges& environment, const RunWatch& watch) {
  const HeldSignals signals;
  SupervisedStart start;
  start.command = command;
  start.environment = environment;
  start.mask = signals.old_mask();
  start.on_orphaned = watch.on_end;
  if (watch.kept != nullptr) start.kept_descriptors.push_back(watch.kept->descriptor());
  SupervisedProgram program(start);
  EndRequests requests;
  StandstillWatch standstill(watch.standstill_s);
  bool killed = false;
  KeptRun::Phase phase = KeptRun::Phase::kNone;
  std::optional<TimeGiven> time_to_end;  // since the request to end, in one phase
  for (;;) {
    if (const std::optional<ProgramEnd> end = program.poll()) {
      ProgramEnd result = *end;
      result.request = requests.first();
      result.forced = killed;
      if (watch.on_end) watch.on_end(result);
      program.release();
      return result;
    }
    if (watch.desk != nullptr && watch.desk->conflict().empty()) {
      // The refused program may end the others, whose report must know of the conflict.
      watch.desk->handle(program.program(), [&watch] {
        if (watch.tell) watch.tell(watch.desk->conflict());
        if (watch.kept != nullptr) watch.kept->note_conflict();
      });
      if (!watch.desk->conflict().empty()) {
        static_cast<void>(requests.note(SIGTERM));
        program.send_signal(SIGTERM);
      }
    }
    if (program.take_stopped() && watch.tell) {
      watch.tell("the program has stopped itself (SIGSTOP): kill -CONT " +
                 std::to_string(program.program()) + " lets it go on, Ctrl-C ends the run");
    }
    if (watch.kept != nullptr && watch.tell) {
      if (const auto message = standstill.look(*watch.kept)) watch.tell(*message);
    }
    // Nonzero if the simulated run ends because of the signal, and not in a handler of the program.
    const int noted = watch.kept != nullptr ? watch.kept->interrupt_noted() : 0;
    while (const std::optional<HeldSignals::Signal> signal = signals.take()) {
      const bool is_key = signal->number == SIGINT || signal->number == SIGQUIT;
      if (watch.is_debugger && is_key && signal->from_system) continue;
      const EndRequests::Meaning meaning = requests.note(signal->number);
      if (meaning == EndRequests::Meaning::kCopy) continue;
      if (meaning == EndRequests::Meaning::kRepeated && noted != 0) {
        program.kill_all();
        killed = true;
      } else {
        program.send_signal(is_programs_too(*signal) ? SIGCONT : signal->number);
      }
    }
    const KeptRun::Phase now = watch.kept != nullptr ? watch.kept->phase() : KeptRun::Phase::kNone;
    if (now != phase) time_to_end.reset();
    phase = now;
    const bool goes_on = noted != 0 && !KeptRun::writes_results(now);
    // The signal may have been sent to the program only.
    if (noted != 0 && !requests.first()) static_cast<void>(requests.note(noted));
    if (requests.first() && goes_on) {
      if (!time_to_end) time_to_end.emplace(watch.kept->progress().process);
      if (tracer_of(watch.kept->progress().process) == 0) time_to_end->look();
      if (time_to_end->total() > kTimeToEnd && !std::exchange(killed, true)) program.kill_all();
    }
    std::vector<int> descriptors = {program.descriptor()};
    Clock::duration at_most = requests.first() && !killed ? kPollPeriod : kSlowPollPeriod;
    if (watch.desk != nullptr && watch.desk->conflict().empty()) {
      for (const int descriptor : watch.desk->descriptors()) descriptors.push_back(descriptor);
      if (watch.desk->is_busy()) at_most = kDoubtPeriod;
    }
    signals.wait(descriptors, at_most);
  }
}

std::vector<JobEnd> run_programs(const std::vector<ProgramJob>& jobs, const JobLimits& limits,
                                 const std::function<void(std::size_t)>& on_start,
                                 const std::function<void(std::size_t, const JobEnd&)>& on_end) {
  constexpr double kForEver_s = 1e9;  // 30 years
  const auto duration = [&](double seconds) {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(std::min(seconds, kForEver_s)));
  };
  const Clock::duration grace = duration(limits.grace_s);
  const Clock::duration timeout = duration(limits.timeout_s > 0.0 ? limits.timeout_s : kForEver_s);
  const auto at_once = static_cast<std::size_t>(std::max(limits.at_once, 1));

  const HeldSignals signals;
  std::vector<JobEnd> ends(jobs.size());
  std::vector<GroupedProgram> running;
  std::size_t next = 0;
  EndRequests requests;
  while (!running.empty() || (next < jobs.size() && !requests.first())) {
    while (!requests.first() && next < jobs.size() && running.size() < at_once) {
      running.emplace_back(jobs[next], next, signals.old_mask());
      if (on_start) on_start(next);
      ++next;
    }
    Clock::time_point wake = Clock::now() + std::chrono::minutes(1);
    std::vector<int> descriptors;
    for (GroupedProgram& program : running) {
      wake = std::min(wake, program.enforce_limits(timeout, grace));
      descriptors.push_back(program.descriptor());
    }
    signals.wait(descriptors, wake - Clock::now());
    while (const std::optional<HeldSignals::Signal> signal = signals.take()) {
      const EndRequests::Meaning meaning = requests.note(signal->number);
      for (GroupedProgram& program : running) {
        program.ask_to_end(JobEnd::Kind::kInterrupted, grace);
        if (meaning == EndRequests::Meaning::kRepeated) program.end_grace();
      }
    }
    for (auto program = running.begin(); program != running.end();) {
      const std::optional<JobEnd> end = program->poll();
      if (!end) {
        ++program;
        continue;
      }
      const std::size_t index = program->index();
      program = running.erase(program);
      ends[index] = *end;
      if (on_end) on_end(index, *end);
    }
  }
  return ends;
}

}  // namespace playerlike
