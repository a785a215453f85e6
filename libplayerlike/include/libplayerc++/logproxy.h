// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Writes the readings of the port's robots to a log file, or replays such a file instead of the
/// readings of their devices (docs/log.md).
///
/// All clients of a port share one log. It has index 0 on every port; on port 4000 it covers all
/// robots. Initially it is in write mode, stopped, and its file is "log_PORT.jsonl" in the run's
/// output folder. Settings take effect at the next step.
///
/// Errors: setters throw PlayerError kNotAvailable if the run has no output folder or the file
/// cannot be opened; kBadArgument for changes that are not possible while the log runs, and for a
/// file that is not a log (the text names the line); kDisconnected if the client is gone.
class LogProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index other than 0, or on a port without robots.
  LogProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LogProxy() override;

  /// PLAYER_LOG_TYPE_READ or _WRITE at the last call of another member; 0 before the first such
  /// call.
  int GetType() const;
  /// 1 if the log ran at the last call of another member, 0 if it was stopped.
  int GetState() const;
  /// Requests type and state. A replayed log stops automatically at its end.
  void QueryState();
  /// Starts (not 0) or stops (0) the log in its current mode.
  void SetState(int aState);
  /// Selects write mode, and starts or stops the log. A restart appends to the same file.
  void SetWriteState(int aState);
  /// Selects read mode, and starts or stops the replay. A restart continues where the replay
  /// stopped, or at the beginning if it had reached the end.
  void SetReadState(int aState);
  /// In read mode, continues at the beginning of the log.
  void Rewind();
  /// @param aFilename  a plain file name in the run's output folder; ".jsonl" is appended if it is
  ///                   missing.
  void SetFilename(const std::string aFilename);

 private:
  struct Change;
  void Control(const char* aFun, const Change& aChange);

  // Guarded by the client's mutex.
  int mType = 0;
  int mState = 0;
};

}  // namespace PlayerCc

namespace std {
/// Prints type and state.
std::ostream& operator<<(std::ostream& os, const PlayerCc::LogProxy& c);
}  // namespace std
