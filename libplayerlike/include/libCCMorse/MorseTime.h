// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "libCCMorse/MorseClient.h"
#include "libCCMorse/PlayerClient.h"

namespace CCMorse {

/// How far a simulation is.
struct MorseTimeStatistics {
  double sim_time;          ///< simulated time [s]
  uint64_t steps;           ///< steps made
  double step;              ///< length of a step [s]
  double wall_time;         ///< since the first step [s]
  double real_time_factor;  ///< simulated over wall time; 0 before the first step
  double duration;          ///< of the run [s]; negative if it has no end
  std::string mode;         ///< "lockstep" or "paced"
  bool finished;            ///< the run is over
};

/// Simulated time.
class MorseTime {
 public:
  explicit MorseTime(const MorseClient& aClient);
  explicit MorseTime(const PlayerClient& aClient);

  double Now() const;             ///< simulated time [s]
  double Step() const;            ///< length of a step [s]
  double RealTimeFactor() const;  ///< simulated over wall time; 0 before the first step
  std::string Mode() const;       ///< "lockstep" or "paced"
  MorseTimeStatistics Statistics() const;

  /// Sleeps for a span of simulated time; in lockstep this lets time pass. Readings that arrive
  /// meanwhile wait for Read().
  /// @param aSeconds  in [0, 1e9].
  /// @throws MorseError kRunIsOver if the run ends meanwhile, kBadArgument for another number.
  void Sleep(double aSeconds);

 private:
  std::shared_ptr<playerlike::ClientCore> mCore;
};

}  // namespace CCMorse
