// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "libCCMorse/MorseClient.h"
#include "libCCMorse/PlayerClient.h"

namespace CCMorse {

/// Progress of a simulation.
struct MorseTimeStatistics {
  double sim_time;          ///< simulated time [s]
  uint64_t steps;           ///< number of completed steps
  double step;              ///< length of a step [s]
  double wall_time;         ///< wall time since the first step [s]
  double real_time_factor;  ///< simulated time / wall time; 0 before the first step
  double duration;          ///< simulated duration of the run [s]; negative if unlimited
  std::string mode;         ///< "lockstep" or "paced"
  bool finished;            ///< whether the run is over
};

/// The simulation's clock.
class MorseTime {
 public:
  explicit MorseTime(const MorseClient& aClient);
  explicit MorseTime(const PlayerClient& aClient);

  double Now() const;             ///< simulated time [s]
  double Step() const;            ///< length of a step [s]
  double RealTimeFactor() const;  ///< simulated time / wall time; 0 before the first step
  std::string Mode() const;       ///< "lockstep" or "paced"
  MorseTimeStatistics Statistics() const;

  /// Sleeps for a span of simulated time. In lockstep, simulated time advances meanwhile. Readings
  /// that arrive during the sleep are queued for Read().
  /// @param aSeconds  duration [s], in [0, 1e9].
  /// @throws MorseError kRunIsOver if the run ends meanwhile; kBadArgument for a value outside the
  ///         range.
  void Sleep(double aSeconds);

 private:
  std::shared_ptr<playerlike::ClientCore> mCore;
};

}  // namespace CCMorse
