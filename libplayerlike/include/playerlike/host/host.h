// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "playerlike/host/run_settings.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Runs a simulation for clients, in lockstep or paced (DESIGN section 3).
///
/// Lockstep: no thread is started; the thread that waits last steps the world. Paced: one thread
/// of the host steps it against the wall clock. All members may be called from any thread.
class Host : public std::enable_shared_from_this<Host> {
 public:
  /// @throws sim::ConfigError if the world is not sound; std::runtime_error if the output folder
  ///         cannot be made.
  [[nodiscard]] static std::shared_ptr<Host> create(sim::WorldDescription world,
                                                    RunSettings settings = {},
                                                    sim::LogHook log = {});
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Opens a session on a robot's Player port or on port 4000.
  /// @throws SessionError kNoSuchDevice if no robot has that port; the message lists the ports.
  [[nodiscard]] std::unique_ptr<Session> connect(int port);

  /// Ends the run: stops the clock, writes report and pictures (once). Sessions then report
  /// kFinished. Called at the end of the duration, by the destructor and at the program's end.
  void finish() noexcept;
  [[nodiscard]] bool finished() const;

  [[nodiscard]] TimeStatistics time() const;
  /// Forgets that a thread takes part in the lockstep. Called by sessions when a thread ends.
  void thread_ended(std::thread::id thread) noexcept;

  /// What a robot has been through so far. @param robot  its index in the world; it must exist.
  [[nodiscard]] sim::RobotStatistics statistics(int robot) const;

  /// Hash of the simulation's state, see sim::Simulation::state_hash.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  friend class InProcessSession;
  class Core;
  explicit Host(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace playerlike
