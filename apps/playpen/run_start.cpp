// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "run_start.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "parsed_option.h"
#include "playerlike/host/rerun.h"
#include "shipped.h"
#include "sim/core/number_text.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStateFile = "state";

[[noreturn]] void refuse_start(const RunMoment& moment, const std::string& reason) {
  throw std::runtime_error("--from " + moment.folder + '@' + sim::shortest_text(moment.time_s) +
                           ": " + reason);
}

std::string seconds_text(double time_s) { return sim::shortest_text(time_s) + " s"; }

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return a == b || (!a.empty() && !b.empty() && fs::equivalent(a, b, error));
}

std::string world_text(const std::string& file) {
  return file.empty() ? "the default world" : file;
}

playerlike::Rerun recorded_run(const RunMoment& moment) {
  try {
    return playerlike::Rerun(moment.folder);
  } catch (const playerlike::RecordingError& e) {
    refuse_start(moment, e.what());
  }
}

/// The run reads its world from the file, which may differ from the one in the recording.
void require_recorded_world(const RunMoment& moment, const playerlike::Rerun& run) {
  sim::WorldDescription world = load_found_world(run.world_file());
  run.settings().apply_to(world);
  try {
    sim::Simulation(std::move(world)).restore(run.state());
  } catch (const sim::SnapshotError& e) {
    refuse_start(moment, world_text(run.world_file()) +
                             ": the world has changed since the run: " + e.what());
  }
}

void advance(const RunMoment& moment, playerlike::Rerun& run) {
  const auto now_s = [&run] { return sim::to_seconds(run.simulation().now_ns()); };
  if (now_s() > moment.time_s) {
    refuse_start(moment, "the run begins at " + seconds_text(now_s()));
  }
  try {
    if (!run.advance_to(sim::from_seconds(moment.time_s))) {
      refuse_start(moment, "the run ends at " + seconds_text(now_s()));
    }
  } catch (const playerlike::RecordingError& e) {
    refuse_start(moment, e.what());
  }
  if (run.simulation().verdict()) {
    refuse_start(moment, "the world has ended the run at " + seconds_text(now_s()));
  }
}

/// The duration of the new run: the one given; the recorded one, unless it is over; the world's.
std::optional<double> duration_of(const RunMoment& moment, const std::string& world_file,
                                  const std::optional<double>& recorded_s,
                                  const std::optional<double>& given_s, double start_s) {
  if (given_s) {
    if (*given_s > start_s) return given_s;
    refuse_start(moment, "a duration of " + seconds_text(*given_s) +
                             " is over then, since the clock of the run begins at " +
                             seconds_text(start_s));
  }
  if (recorded_s && *recorded_s > start_s) return recorded_s;
  const auto worlds = load_found_world(world_file).simulation.duration_ns;
  if (worlds && sim::to_seconds(*worlds) <= start_s) {
    refuse_start(moment, "the world's duration of " + seconds_text(sim::to_seconds(*worlds)) +
                             " is over then: give a longer one by --duration");
  }
  return std::nullopt;
}

}  // namespace

bool parse_run_moment(const std::string& text, RunMoment& moment) {
  const std::size_t at = text.rfind('@');
  if (at == 0 || at == std::string::npos) return false;
  RunMoment read{text.substr(0, at), 0.0};
  if (!playerlike::parse_stop_time(text.substr(at + 1), read.time_s)) return false;
  moment = std::move(read);
  return true;
}

StartState::StartState(const RunMoment& moment, const std::string& named_world,
                       playerlike::RunSettings& settings) {
  playerlike::Rerun run = recorded_run(moment);
  world_file_ = run.world_file();
  if (!named_world.empty()) {
    const std::string named = find_world(named_world);
    if (!is_same_file(named, world_file_)) {
      refuse_start(moment, "the run's world is " + world_text(world_file_) + ", not " +
                               world_text(named) + "; the world's name can be left out");
    }
  }
  advance(moment, run);
  require_recorded_world(moment, run);
  time_s_ = sim::to_seconds(run.simulation().now_ns());
  const playerlike::RunSettings& recorded = run.settings();
  settings.duration_s =
      duration_of(moment, world_file_, recorded.duration_s, settings.duration_s, time_s_);
  settings.seed = recorded.seed;
  settings.realism = recorded.realism;
  settings.view_mode = recorded.view_mode;
  settings.interfaces = recorded.interfaces;
  settings.robot_port = recorded.robot_port;
  settings.clients = recorded.clients;
  settings.start_state = (folder_ / kStateFile).string();
  const sim::Snapshot state = run.state();
  std::ofstream file(settings.start_state, std::ios::binary);
  file.write(reinterpret_cast<const char*>(state.data()),
             static_cast<std::streamsize>(state.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + settings.start_state);
}

void refuse_same_folder(const RunMoment& moment, const std::string& output_folder) {
  if (!is_same_file(moment.folder, output_folder)) return;
  refuse_start(moment,
               "the results of this run would replace those of that run: choose another "
               "folder by --out");
}

}  // namespace playpen
