// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/runner.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/core/replace_file.h"

namespace playpen::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostPrinted = 1U << 16U;

std::string end_of(const fs::path& file) {
  std::string text;
  if (sim::read_whole_file(file.string(), {}, text)) return "";
  return text.size() > kMostPrinted ? text.substr(text.size() - kMostPrinted) : text;
}

}  // namespace

RunResult result_in(const fs::path& folder) {
  RunResult result;
  std::string text;
  if (sim::read_whole_file((folder / "report.json").string(), {}, text)) return result;
  try {
    result.report = playerlike::report_from(text);
    result.trajectories = grade::read_trajectories(folder / "trajectory.csv");
  } catch (const std::exception&) {
    result.report.reset();  // the program died while it was written
  }
  return result;
}

struct Runner::Slot {
  Slot(const RunnerSettings& settings, std::size_t number)
      : folder(settings.folder / ("slot" + std::to_string(number))),
        program(settings.program, settings.environment) {
    fs::create_directories(folder);
  }

  fs::path folder;
  playerlike::PreparedProgram program;
  std::optional<std::size_t> job;  ///< index of the world that it runs
  // The present part of the run, of which hangs() looks at the processor time.
  Clock::time_point part_begin;
  double spent_before_s = 0.0;
  bool killed = false;

  // Whether the run computes for longer than the limit, or waits for as long: it uses less than a
  // hundredth of the wall time. Beside other busy processes it takes longer by the wall clock.
  bool hangs(double limit_s) {
    const double spent_s = program.processor_time_s();
    if (spent_s > limit_s) return true;
    const auto now = Clock::now();
    const double part_s = std::chrono::duration<double>(now - part_begin).count();
    if (part_s < limit_s) return false;
    if (spent_s - spent_before_s < 0.01 * part_s) return true;
    part_begin = now;
    spent_before_s = spent_s;
    return false;
  }
};

Runner::Runner(RunnerSettings settings) : settings_(std::move(settings)) {
  for (std::size_t i = 0; i < settings_.jobs; ++i) {
    slots_.push_back(std::make_unique<Slot>(settings_, i));
  }
}

Runner::~Runner() = default;

void Runner::start(Slot& slot, const std::string& world) {
  const fs::path world_file = slot.folder / "world.json";
  const fs::path out = slot.folder / "out";
  fs::remove_all(out);
  if (const int error = sim::replace_file(world_file.string(), world); error != 0) {
    throw std::runtime_error(world_file.string() +
                             " cannot be written: " + std::generic_category().message(error));
  }
  slot.killed = false;
  slot.part_begin = Clock::now();
  slot.spent_before_s = 0.0;
  slot.program.start({{"PLAYPEN_WORLD", world_file.string()},
                      {"PLAYPEN_OUT", out.string()},
                      {"PLAYPEN_DURATION", sim::shortest_text(settings_.duration_s)}},
                     (slot.folder / "printed.txt").string());
}

std::optional<RunResult> Runner::poll(Slot& slot) {
  const auto end = slot.program.poll();
  if (!end) {
    if (!slot.killed && slot.hangs(settings_.limit_s)) {
      slot.killed = true;
      slot.program.kill_copy();
    }
    return std::nullopt;
  }
  RunResult result = result_in(slot.folder / "out");
  result.end = *end;
  result.hangs = slot.killed;
  result.printed = end_of(slot.folder / "printed.txt");
  return result;
}

std::vector<std::optional<RunResult>> Runner::run(const std::vector<std::string>& worlds,
                                                  const std::function<bool()>& is_over) {
  std::vector<std::optional<RunResult>> results(worlds.size());
  std::size_t next = 0;
  std::size_t running = 0;
  bool interrupted = false;
  for (;;) {
    if (!interrupted && settings_.is_interrupted && settings_.is_interrupted()) {
      interrupted = true;
      for (const auto& slot : slots_) slot->program.kill_copy();
    }
    for (const auto& slot : slots_) {
      if (slot->job || next == worlds.size() || interrupted || (is_over && is_over())) continue;
      slot->job = next;
      start(*slot, worlds[next++]);
      ++running;
    }
    if (running == 0) return results;
    std::vector<pollfd> polls;
    for (const auto& slot : slots_) {
      if (slot->job) polls.push_back({slot->program.descriptor(), POLLIN, 0});
    }
    constexpr int kLook_ms = 200;  // at the limits of time
    ::poll(polls.data(), polls.size(), kLook_ms);
    for (const auto& slot : slots_) {
      if (!slot->job) continue;
      if (auto result = poll(*slot)) {
        if (!interrupted) {
          results[*slot->job] = std::move(result);
          ++count_;
        }
        slot->job.reset();
        --running;
      }
    }
  }
}

}  // namespace playpen::fuzz
