// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/results/client_files.h"
#include "playerlike/messages/messages.h"
#include "playerlike/messages/requests.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class Mirror;

/// The log of a port: writes the readings of the port's robots to a file, or replays such a file in
/// place of their devices. The files are JSON lines; docs/log.md describes them.
class RunLog {
 public:
  /// A reading in a file.
  struct Entry {
    sim::SimTime offset_ns = 0;  ///< since the beginning of the log
    DeviceId device{-1, -1};
    std::shared_ptr<sim::Reading> reading;
    bool given = false;  ///< whether clients have received it
  };

  /// @param folder  of the run's results; "": none.
  /// @param robots  all robots of the world; must outlive this object.
  /// @param files   limits what is written; must outlive this object.
  RunLog(std::string folder, int port, const std::vector<RobotInfo>& robots, ClientFiles& files);

  /// The contents of a file, or the error of reading it.
  struct Loaded {
    std::string path;
    sim::SimTime begin_ns = 0;   ///< beginning of the log, in its own time
    std::vector<Entry> entries;  ///< oldest first
    std::optional<SessionError> problem;
  };

  /// The file that must be read before control() can make these changes; nullopt: none.
  [[nodiscard]] std::optional<std::string> file_to_read(const LogRequest& changes) const;
  /// Reads a file with readings of the port's robots. It may take seconds, so no mutex should be
  /// held.
  [[nodiscard]] static Loaded read_file(const std::string& path, int port,
                                        const std::vector<RobotInfo>& robots);
  /// Makes changes in the order of LogRequest's members. @return the state afterwards.
  /// @param loaded  the file that file_to_read() has named; may be null if none.
  /// @throws SessionError as LogRequest; earlier changes stay in effect.
  LogStatus control(const LogRequest& changes, const sim::Simulation& simulation, Loaded* loaded);

  /// Called after each step: writes the step's readings, or finds the readings that are due.
  /// @param mirror  whose readings replace those of the simulation; null: there is none. They get
  ///                the time of the step.
  /// @return an error, once; it stops the log.
  std::optional<std::string> observe(const sim::Simulation& simulation,
                                     const Mirror* mirror = nullptr);

  /// Whether readings now come from due() instead of the devices.
  [[nodiscard]] bool replaying() const noexcept { return replaying_step_; }
  /// The readings that were due in the last step, oldest first, with time stamps of the present
  /// run.
  [[nodiscard]] const std::vector<const Entry*>& due() const noexcept { return due_; }

  /// Completes the file. @return the error, if there is one.
  std::optional<std::string> close();

 private:
  [[nodiscard]] std::string path() const;
  [[nodiscard]] std::string path_of(const std::string& file) const;
  void start(const sim::Simulation& simulation, Loaded* loaded);
  void write(const sim::Simulation& simulation, const Mirror* mirror);
  void write(DeviceId id, const sim::Reading& reading, sim::SimTime time_ns);
  void find_due(sim::SimTime now_ns);

  std::string folder_;
  int port_;
  const std::vector<RobotInfo>* robots_;
  ClientFiles* files_;
  LogStatus status_;
  std::ofstream out_;
  std::size_t written_ = 0;  ///< bytes
  std::vector<Entry> entries_;
  std::size_t next_ = 0;        ///< index in entries_
  sim::SimTime begin_ns_ = 0;   ///< beginning of the log, in its own time
  sim::SimTime played_ns_ = 0;  ///< time since then
  bool replaying_step_ = false;
  std::vector<const Entry*> due_;
};

}  // namespace playerlike
