// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace playerlike {

/// Decides where the world of a run is. The programs of the run, which the library makes known here
/// when it is loaded, ask before they connect for the first time (connect/run_desk.h).
///
/// A single program has the world in its own process. Several programs that are there at the same
/// time share a world, which this process serves. A program that comes while another one has the
/// world in its process is refused. In doubt (a shell may be about to start a second program), an
/// answer waits until the other processes of the run have slept for a moment, at most 0.5 s.
class ProgramDesk {
 public:
  static constexpr char kAsks = '?';       ///< message: where is the world?
  static constexpr char kHasForked = 'f';  ///< message: a child will make itself known
  /// @param expects_several  whether a program other than the started one always gets a served
  ///                         world, because other programs may come later.
  /// @param serve  starts a server in this process and returns its TCP port; called at most once
  ///               unless it throws.
  /// @throws std::runtime_error if the system provides no socket.
  ProgramDesk(bool expects_several, std::function<int()> serve);
  ProgramDesk(const ProgramDesk&) = delete;
  ProgramDesk& operator=(const ProgramDesk&) = delete;
  ~ProgramDesk();

  /// Value of PLAYPEN_DESK for the programs.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Readable when handle() has work.
  [[nodiscard]] std::vector<int> descriptors() const;
  /// Whether an answer waits, so that handle() must be called again soon.
  [[nodiscard]] bool is_busy() const noexcept;
  /// Answers questions.
  /// @param program  process id of the program that the run has started.
  /// @param on_conflict  called when a program is refused, before it hears of that, if set.
  void handle(pid_t program, const std::function<void()>& on_conflict = {});
  /// Why a program was refused; "" if none was.
  [[nodiscard]] const std::string& conflict() const noexcept { return conflict_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// A process with the library. It sends kAsks or kHasForked.
  struct Known {
    int descriptor = -1;
    pid_t process = 0;
    bool asks = false;
    bool has_forked = false;  ///< its children may not be known yet
    Clock::time_point asked{};
  };

  void accept_new();
  void read_messages();
  /// @return the answer; "" if it is too early to tell.
  [[nodiscard]] std::string answer_to(const Known& known, pid_t program);
  [[nodiscard]] std::string share();

  const bool expects_several_;
  const std::function<int()> serve_;
  std::string name_;
  std::string conflict_;
  int listener_ = -1;
  int port_ = 0;     ///< of the server; 0: none
  pid_t owner_ = 0;  ///< has the world in its process; 0: none
  std::vector<Known> known_;
  std::string activity_;             ///< of the other processes of the run, when last looked at
  Clock::time_point quiet_since_{};  ///< when it last changed
};

}  // namespace playerlike
