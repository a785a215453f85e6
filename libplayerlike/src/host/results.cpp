// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results.h"

#include <filesystem>
#include <utility>

#include "host/file_limit_errors.h"
#include "process/end_of_program.h"

namespace playerlike {
namespace {

// Minimum period of writing the result files during the run.
constexpr std::chrono::seconds kKeepingPeriod(1);
// Minimum period of KeptWriter::keep_looks(); the state is stored after each step.
constexpr std::chrono::milliseconds kLooksPeriod(50);

}  // namespace

Results::Results(const RunSettings& settings, sim::Simulation& simulation,
                 std::function<TimeStatistics()> time, Warn warn, const CommandBook& commands,
                 const Mirror* mirror)
    : settings_(settings),
      simulation_(simulation),
      time_(std::move(time)),
      warn_(std::move(warn)),
      mirror_(mirror) {
  if (!settings.output_folder.empty()) std::filesystem::create_directories(settings.output_folder);
  recorder_ = std::make_unique<Recorder>(settings, simulation, mirror, &commands);
  kept_ = KeptWriter::open(settings.kept_run);
  if (kept_ && !settings.output_folder.empty()) {
    kept_->keep_looks(report_text(simulation_, *recorder_, {}, RunEnd{}), simulation_);
    kept_->keep_step({}, *recorder_, simulation_);
  }
  if (settings.quiet_end) note_interrupts(kept_ ? &kept_->noted() : nullptr);
}

void Results::observe() {
  recorder_->observe(simulation_);
  for (auto& [port, log] : logs) {
    if (const auto problem = log.observe(simulation_, mirror_)) warn_(*problem);
  }
}

void Results::keep(WallClock::time_point now) {
  if (settings_.output_folder.empty()) return;
  if (kept_) {
    kept_->keep_step(time_(), *recorder_, simulation_);
    const std::uint64_t events = simulation_.arena_events().count;
    if (now - last_looks_ >= kLooksPeriod || events != kept_events_) {
      last_looks_ = now;
      kept_events_ = events;  // no event may get lost
      kept_->keep_looks(report_now(), simulation_);
    }
  }
  keep_report(now);
}

void Results::note_refusal(const std::string& what) {
  if (!recorder_->refusals().note(what, simulation_.now_ns())) return;
  if (kept_ && !settings_.output_folder.empty()) kept_->keep_looks(report_now(), simulation_);
}

void Results::keep_report(WallClock::time_point now) {
  if (!last_kept_) last_kept_ = now;
  if (now - *last_kept_ < kKeepingPeriod) return;
  last_kept_ = now;
  try {
    const FileLimitErrors limit_errors;
    write_report(settings_.output_folder, signed_report(report_now(), settings_.grading));
  } catch (const std::exception& e) {
    if (!std::exchange(write_failure_warned_, true)) {
      warn_(std::string("results of the run cannot be written at present: ") + e.what());
    }
  }
}

// The most important result comes first, and a failure does not prevent the others.
void Results::write() {
  const FileLimitErrors limit_errors;
  const auto attempt = [this](const char* problem, const auto& write) {
    try {
      write();
    } catch (const std::exception& e) {
      warn_(std::string(problem) + e.what());
    }
  };
  constexpr const char* kMissingResults = "results of the run are missing: ";
  const std::string& folder = settings_.output_folder;
  attempt(kMissingResults, [&] { recorder_->close_trajectory(); });
  if (!folder.empty()) {
    const TimeStatistics time = time_();
    const std::string report = report_text(simulation_, *recorder_, time, reason_of_end());
    if (kept_) {
      kept_->keep_step(time, *recorder_, simulation_);
      kept_->keep_looks(report, simulation_);
    }
    attempt(kMissingResults,
            [&] { write_report(folder, signed_report(report, settings_.grading)); });
  }
  set_phase(KeptRun::Phase::kReported);
  for (auto& [port, log] : logs) {
    if (const auto problem = log.close()) warn_(*problem);
  }
  if (!folder.empty()) {
    attempt(kMissingResults,
            [&] { write_pictures(folder, simulation_.layers(), scene(), settings_.pictures); });
  }
  attempt("the recording is not complete: ", [&] { recorder_->close_film(); });
  set_phase(KeptRun::Phase::kDone);
}

std::string Results::report_now() const {
  return report_text(simulation_, *recorder_, time_(), RunEnd{});
}

RunEnd Results::reason_of_end() const {
  if (simulation_.verdict()) return {.by = RunEnd::By::kVerdict};
  if (simulation_.finished()) return {.by = RunEnd::By::kDuration};
  const int request = end_request != 0 ? end_request : settings_.quiet_end ? interrupted() : 0;
  if (request != 0) return {.by = RunEnd::By::kRequest, .signal = request};
  if (real_robot_lost) return {.by = RunEnd::By::kRealRobot};
  if (window_closed) return {.by = RunEnd::By::kWindow};
  return {.by = RunEnd::By::kProgram, .status = program_status};
}

void Results::set_phase(KeptRun::Phase phase) noexcept {
  if (kept_) kept_->set_phase(phase);
}

}  // namespace playerlike
