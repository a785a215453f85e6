// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Writes the readings of the port's robots into a file, or lets such a file take the place of
/// their devices, so that a program meets a run once more (docs/log.md).
///
/// It is one for all clients of a port: index 0 on every port; on port 4000 of all robots. At first
/// it writes, is stopped, and its file is "log_PORT.jsonl" in the run's output folder. What is set
/// holds from the next step on.
///
/// Calls that set something throw PlayerError: kNotAvailable if the run has no output folder or the
/// file cannot be opened, kBadArgument for changes that a running log does not take, and for a file
/// that is no log (the text names the line); kDisconnected if the client is gone.
class LogProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index that is not 0, or a port without robots.
  LogProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LogProxy() override;

  /// PLAYER_LOG_TYPE_READ or _WRITE, as of the last call of another member; 0 before any.
  int GetType() const;
  /// 1 if it runs, 0 if it is stopped; as of the last call of another member.
  int GetState() const;
  /// Asks for type and state. A log that is read stops by itself where it ends.
  void QueryState();
  /// Starts (not 0) or stops it, to read or write as set last.
  void SetState(int aState);
  /// Makes it one that writes, and starts or stops it. A new start goes on in the same file.
  void SetWriteState(int aState);
  /// Makes it one that reads, and starts or stops it. A new start goes on where it stopped, and
  /// from the beginning once it has come to the end.
  void SetReadState(int aState);
  /// Begins anew, if it reads.
  void Rewind();
  /// @param aFilename  a plain file name in the run's output folder; ".jsonl" is added unless it is
  ///                   there.
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
