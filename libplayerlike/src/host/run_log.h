// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/client_files.h"
#include "playerlike/messages/messages.h"
#include "playerlike/messages/requests.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The log of a port: writes the readings of the port's robots into a file, or lets such a file
/// take the place of their devices. Lines of JSON; docs/log.md tells what is in them.
class RunLog {
 public:
  /// A reading of a file.
  struct Entry {
    sim::SimTime offset_ns = 0;  ///< after the log's beginning
    DeviceId device{-1, -1};
    std::shared_ptr<sim::Reading> reading;
    bool given = false;  ///< to whoever was there when it was last due
  };

  /// @param folder  of the run's results; "": there is none.
  /// @param robots  all of the world; must live as long as this.
  /// @param files   has a limit for what is written; must live as long as this.
  RunLog(std::string folder, int port, const std::vector<RobotInfo>& robots, ClientFiles& files);

  /// A file of readings as it was read, or why it could not be.
  struct Loaded {
    std::string path;
    sim::SimTime begin_ns = 0;   ///< of the log, in its own time
    std::vector<Entry> entries;  ///< oldest first
    std::optional<SessionError> problem;
  };

  /// The file that has to be read before control() can make these changes; nullopt if none.
  [[nodiscard]] std::optional<std::string> file_to_read(const LogRequest& changes) const;
  /// Reads a file of readings of the port's robots, which may take seconds: not under a lock.
  [[nodiscard]] static Loaded read_file(const std::string& path, int port,
                                        const std::vector<RobotInfo>& robots);
  /// Makes changes, in the order that LogRequest lists them in, and tells what is then.
  /// @param loaded  the file that file_to_read() has named; may be null if none.
  /// @throws SessionError as LogRequest; what came before the change in question is
  /// done.
  LogStatus control(const LogRequest& changes, const sim::Simulation& simulation, Loaded* loaded);

  /// Called after each step: writes the step's readings, or finds those that are due.
  /// @return what has gone wrong, once; the log is then stopped.
  std::optional<std::string> observe(const sim::Simulation& simulation);

  /// Whether readings are to come from due() now, and not from the devices.
  [[nodiscard]] bool replaying() const noexcept { return replaying_step_; }
  /// Readings that were due in the last step, oldest first, stamped with the present run's time.
  [[nodiscard]] const std::vector<const Entry*>& due() const noexcept { return due_; }

  /// Completes the file. @return what has gone wrong.
  std::optional<std::string> close();

 private:
  [[nodiscard]] std::string path() const;
  [[nodiscard]] std::string path_of(const std::string& file) const;
  void start(const sim::Simulation& simulation, Loaded* loaded);
  void write(const sim::Simulation& simulation);
  void find_due(sim::SimTime now_ns);

  std::string folder_;
  int port_;
  const std::vector<RobotInfo>* robots_;
  ClientFiles* files_;
  LogStatus status_;
  std::ofstream out_;
  std::size_t written_ = 0;  ///< bytes
  std::vector<Entry> entries_;
  std::size_t next_ = 0;        ///< of entries_
  sim::SimTime begin_ns_ = 0;   ///< of the log, in its own time
  sim::SimTime played_ns_ = 0;  ///< since then
  bool replaying_step_ = false;
  std::vector<const Entry*> due_;
};

}  // namespace playerlike
