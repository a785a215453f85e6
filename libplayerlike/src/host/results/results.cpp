// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/results.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "host/results/file_limit_errors.h"
#include "host/results/make_report.h"
#include "process/end_of_program.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

// Minimum period of writing the result files during the run.
constexpr std::chrono::seconds kKeepingPeriod(1);
// Minimum period of KeptWriter::keep_looks(); the state is stored after each step.
constexpr std::chrono::milliseconds kLooksPeriod(50);
// How much the report may grow between two writes of the results.
constexpr std::uint64_t kReportGrowth = 64 << 10;

}  // namespace

Results::Results(const RunSettings& settings, sim::Simulation& simulation,
                 std::function<TimeStatistics()> time, Warn warn, const CommandBook& commands,
                 const Mirror* mirror)
    : settings_(settings),
      simulation_(simulation),
      time_(std::move(time)),
      warn_(std::move(warn)),
      mirror_(mirror),
      report_room_(settings.output_folder) {
  if (!settings.output_folder.empty()) std::filesystem::create_directories(settings.output_folder);
  recorder_ = std::make_unique<Recorder>(settings, simulation, mirror, &commands);
  // What a real robot does cannot be made again.
  if (!settings.output_folder.empty() && mirror == nullptr && !settings.figures_only) {
    recording_ = std::make_unique<RecordingWriter>(settings, simulation);
  }
  kept_ = KeptWriter::open(settings.kept_run);
  if (kept_ && mirror != nullptr) kept_->keep_motors(mirror->motors());
  if (kept_ && !settings.output_folder.empty()) {
    kept_->keep_looks(text_of_report(make_report(simulation_, *recorder_, {}, {})), simulation_);
    kept_->keep_step({}, *recorder_, simulation_);
  }
  if (!settings.output_folder.empty()) hold_room_for({});
  if (settings.quiet_end) note_interrupts(kept_ ? &kept_->noted() : nullptr);
}

void Results::observe() {
  recorder_->observe(simulation_);
  if (recording_) {
    if (const auto problem = recording_->observe()) warn_(*problem);
  }
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

void Results::note_read(const Client& client,
                        const std::vector<std::pair<DeviceId, sim::SharedReading>>& taken) {
  if (!recording_ || taken.empty() || client.onlooker || client.follower) return;
  sim::SimTime oldest_ns = taken.front().second->time_ns;
  for (const auto& [device, reading] : taken) oldest_ns = std::min(oldest_ns, reading->time_ns);
  recording_->note_read(client.port, oldest_ns);
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
    const std::string report = signed_report(report_now(), settings_.grading);
    write_report(settings_.output_folder, report);
    hold_room_for(report);
  } catch (const std::exception& e) {
    if (!std::exchange(write_failure_warned_, true)) {
      warn_(std::string("results of the run cannot be written at present: ") + e.what());
    }
  }
}

/// What is written into the output folder at the end: a copy of all that the mutex guards.
struct Results::Last {
  Report report;
  sim::StateParts state;
  sim::LayerStack layers;
  sim::SceneSnapshot scene;
};

namespace {

constexpr const char* kMissingResults = "results of the run are missing: ";

/// Does an action; a failure is a warning.
template <typename Action>
void attempt(const Warn& warn, const char* problem, const Action& action) {
  try {
    action();
  } catch (const std::exception& e) {
    warn(std::string(problem) + e.what());
  }
}

}  // namespace

std::function<void()> Results::prepare(std::optional<sim::LayerStack> layers) {
  const FileLimitErrors limit_errors;
  attempt(warn_, kMissingResults, [&] { recorder_->close_trajectory(); });
  if (recording_) {
    if (const auto problem = recording_->close()) warn_(*problem);
  }
  for (auto& [port, log] : logs) {
    if (const auto problem = log.close()) warn_(*problem);
  }
  std::shared_ptr<Last> last;
  if (!settings_.output_folder.empty()) {
    const TimeStatistics time = time_();
    last = std::make_shared<Last>(Last{make_report(simulation_, *recorder_, time, reason_of_end()),
                                       simulation_.state_parts(), std::move(layers.value()),
                                       recorder_->scene(simulation_, /*with_canvas=*/false)});
    if (kept_) {
      kept_->keep_step(time, *recorder_, simulation_);
      kept_->keep_looks(text_of_report(last->report), simulation_);
    }
  }
  return [this, last] { write(last.get()); };
}

// The most important result comes first, and a failure does not prevent the others.
void Results::write(Last* last) {
  if (claimed_.exchange(true)) return;
  const FileLimitErrors limit_errors;
  const std::string& folder = settings_.output_folder;
  if (last != nullptr) {
    attempt(warn_, kMissingResults, [&] {
      last->report.run.state_hash = sim::hexadecimal_text(last->state.hash(last->layers), 16);
      report_room_.release();
      write_report(folder, signed_report(text_of_report(last->report), settings_.grading));
    });
  }
  set_phase(KeptRun::Phase::kReported);
  if (last != nullptr && !settings_.figures_only) {
    attempt(warn_, kMissingResults, [&] {
      last->scene.canvas = last->layers.take_composed();
      last->scene.layers = last->layers.layers();
      write_pictures(folder, last->layers, last->scene, settings_.pictures);
    });
  }
  attempt(warn_, "the recording is not complete: ", [&] { recorder_->close_film(); });
  set_phase(KeptRun::Phase::kDone);
}

void Results::hold_room_for(const std::string& report) {
  // Without the room, the last report is written if it fits.
  static_cast<void>(report_room_.hold(2 * report.size() + kReportGrowth));
}

std::string Results::report_now() const {
  return text_of_report(make_report(simulation_, *recorder_, time_(), {}));
}

RunEnd Results::reason_of_end() const {
  if (simulation_.verdict()) return {.by = RunEnd::By::kVerdict};
  if (simulation_.finished()) return {.by = RunEnd::By::kDuration};
  const int noted = end_request_;
  const int request = noted != 0 ? noted : settings_.quiet_end ? interrupted() : 0;
  if (request != 0) return {.by = RunEnd::By::kRequest, .signal = signal_name(request)};
  if (real_robot_lost) return {.by = RunEnd::By::kRealRobot};
  if (window_closed) return {.by = RunEnd::By::kWindow};
  return {.by = RunEnd::By::kProgram, .status = program_status};
}

void Results::set_phase(KeptRun::Phase phase) noexcept {
  if (kept_) kept_->set_phase(phase);
}

}  // namespace playerlike
