// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/stalled_time_warning.h"

#include <algorithm>
#include <mutex>

#include "host/launch/busy_alarm.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

// Limits of commands and of accesses to data, while simulated time stands still, before the
// warning; see PollingDetector. Before the first Read() few programs need many. Later a program may
// send a command for each beam of a scan and read each beam many times. kDataReadsInAStep is below
// the three million accesses after which virtual_time::count_data_reads() lets time advance.
constexpr double kCommandsBeforeFirstStep = 1000.0;
constexpr double kCommandsInAStep = 10'000.0;
constexpr double kCommandsAfterSleeps = 20.0;  // per robot; also the least of the limits above
constexpr double kDataReadsWithoutData = 1000.0;
constexpr double kDataReadsInAStep = 2'000'000.0;

}  // namespace

StalledTimeWarning::StalledTimeWarning(std::size_t robots, bool sleeps_count, double limit_s,
                                       Warn warn)
    : robots_(static_cast<double>(robots)),
      sleeps_count_(sleeps_count),
      limit_s_(limit_s),
      warn_(std::move(warn)) {}

bool StalledTimeWarning::note_command(Client& client, sim::SimTime now_ns) const {
  const double weight = 1.0 / std::max(now_ns == 0 ? kCommandsBeforeFirstStep : kCommandsInAStep,
                                       kCommandsAfterSleeps * robots_);
  return sleeps_count_ ? client.polling_detector.note(now_ns, weight)
                       : client.polling_detector.note_command(
                             now_ns, weight, 1.0 / (kCommandsAfterSleeps * robots_));
}

bool StalledTimeWarning::count_data_reads(Client& client, sim::SimTime now_ns, int count,
                                          bool has_data) {
  return client.polling_detector.note(
      now_ns, count / (has_data ? kDataReadsInAStep : kDataReadsWithoutData));
}

void StalledTimeWarning::check(Client& client, sim::SimTime now_ns, bool may_advance) {
  {
    const std::lock_guard input(client.input_mutex);
    if (warned_ || may_advance) return client.polling_detector.postpone();
    if (!client.polling_detector.check(now_ns)) return;
  }
  warned_ = true;
  dismiss_alarm();
  warn_(
      "the program goes on commanding robots or looking at their data, but simulated time stands "
      "still: it does not call Read(). " +
      cure());
}

void StalledTimeWarning::set_alarm() const {
  if (!watches_) return;
  set_busy_alarm(limit_s_, "the program has been busy for " + sim::rounded_text(limit_s_, 6) +
                               " s of processor time, but no simulated time has passed: it has "
                               "not called Read(). " +
                               cure());
}

void StalledTimeWarning::note_first_step(bool lockstep) const {
  dismiss_alarm();
  if (!watches_ || !alone_ || !lockstep) return;
  set_standstill_alarm(limit_s_,
                       "the program has computed for " + sim::rounded_text(limit_s_, 6) +
                           " s of processor time without calling Read(), and simulated time "
                           "stands still at ",
                       " s. If this is an endless loop, Ctrl-C ends the program");
}

void StalledTimeWarning::dismiss_alarm() const noexcept {
  if (watches_) dismiss_busy_alarm();
}

void StalledTimeWarning::note_end() const {
  if (warned_ || busy_alarm_rang() || !wants_time_) return;
  warn_("nothing was simulated: the program has ended without calling Read(). " + cure());
}

std::string StalledTimeWarning::cure() const {
  return std::string(
             "Time passes only while the program waits in Read(): call client.Read() in each turn "
             "of its loop (in C: playerc_client_read(client))") +
         (sleeps_count_ ? ", or sleep" : "; its sleeps count only under `playpen run`");
}

}  // namespace playerlike
