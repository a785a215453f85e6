// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/errors.h"
#include "libCCMorse/MorseTime.h"
#include "proxies/link.h"

namespace CCMorse {

using playerlike::SessionError;
using playerlike::translated;

MorseTime::MorseTime(const MorseClient& aClient) : mCore(aClient.mCore) {}

MorseTime::MorseTime(const PlayerClient& aClient)
    : mCore(PlayerCc::detail::CoreAccess::get(aClient)) {}

MorseTimeStatistics MorseTime::Statistics() const {
  const playerlike::TimeStatistics t = translated("MorseTime::Statistics", [&] {
    if (mCore->closed()) mCore->require_usable();
    return mCore->session().request(playerlike::TimeRequest{});
  });
  MorseTimeStatistics s;
  s.sim_time = sim::to_seconds(t.sim_time_ns);
  s.steps = t.steps;
  s.step = t.step_s;
  s.wall_time = t.wall_time_s;
  s.real_time_factor = t.real_time_factor;
  s.duration = t.duration_s.value_or(-1.0);
  s.mode = t.mode == sim::TimeMode::kLockstep ? "lockstep" : "paced";
  s.finished = t.finished;
  return s;
}

double MorseTime::Now() const { return Statistics().sim_time; }
double MorseTime::Step() const { return Statistics().step; }
double MorseTime::RealTimeFactor() const { return Statistics().real_time_factor; }
std::string MorseTime::Mode() const { return Statistics().mode; }

void MorseTime::Sleep(double aSeconds) {
  translated("MorseTime::Sleep", [&] {
    mCore->require_usable();
    mCore->session().request(playerlike::SleepRequest{aSeconds});
    // A session wakes sleepers at the end of the run. A program that only sleeps gets the error
    // here.
    if (mCore->session().request(playerlike::TimeRequest{}).finished) {
      throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
    }
  });
}

}  // namespace CCMorse
