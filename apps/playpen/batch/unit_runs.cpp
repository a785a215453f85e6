// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/unit_runs.h"

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "grade/run_record.h"
#include "grade/runs.h"
#include "grade/text.h"
#include "sim/core/file.h"

namespace playpen::batch {
namespace {

namespace fs = std::filesystem;
using playerlike::JobEnd;

constexpr const char* kRecord = "unit.json";
constexpr const char* kUnitsFolder = "units";
// Worlds are loaded for this many units at a time, since a plan may have more than fit in memory.
constexpr std::size_t kUnitsAtATime = 500;

/// The folder in which this process works. The destructor removes it.
class OwnFolder {
 public:
  explicit OwnFolder(const fs::path& out) : all_(out / "work") {
    std::array<char, 256> host{};
    if (gethostname(host.data(), host.size() - 1) != 0) std::strcpy(host.data(), "host");
    const std::string prefix = std::string(host.data()) + '-';
    remove_those_of_killed(prefix);
    path_ = all_ / (prefix + std::to_string(getpid()));
    std::error_code ignored;
    fs::remove_all(path_, ignored);  // of a killed process with the same number
    fs::create_directories(path_);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::remove(all_, ignored);  // unless others work in it
  }

  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  void remove_those_of_killed(const std::string& prefix) const {
    std::error_code ignored;
    std::vector<fs::path> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(all_, ignored)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(prefix)) continue;
      const int process = std::atoi(name.c_str() + prefix.size());
      if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry.path());
    }
    for (const fs::path& folder : left) fs::remove_all(folder, ignored);
  }

  fs::path all_;
  fs::path path_;
};

/// The units of one program under one condition, and their runs.
struct UnitGroup {
  std::size_t program = 0;
  std::size_t condition = 0;
  std::map<std::uint64_t, const Unit*> units;  ///< by seed
  std::optional<grade::PreparedTask> task;
  grade::GradeSettings settings;
  grade::Grade grade;
  std::optional<grade::ProgramRuns> runs;
};

/// Gives a unit its results: the folder of its run gets the unit's name. The first one wins.
void publish(const fs::path& out, const Unit& unit, const fs::path& run_folder,
             const grade::GradedRun& run) {
  grade::write_text_file(run_folder / kRecord, grade::run_text(run) + '\n');
  std::error_code error;
  fs::create_directories(out / kUnitsFolder, error);
  const fs::path place = folder_of(out, unit);
  fs::rename(run_folder, place, error);
  if (error && !read_unit(out, unit)) {
    forget_unit(out, unit);  // a folder without a record, such as one that was copied in part
    fs::rename(run_folder, place, error);
  }
  if (error && !read_unit(out, unit)) {
    throw std::runtime_error("the results of a run cannot be moved to '" + place.string() +
                             "': " + error.message());
  }
}

/// Runs units, as many as a machine's memory holds at a time.
class UnitRuns {
 public:
  UnitRuns(const Batch& batch, const UnitRunSettings& settings,
           const std::function<void(const UnitProgress&)>& on_progress)
      : batch_(batch), settings_(settings), on_progress_(on_progress), own_(settings.out) {}

  bool run(const std::vector<std::size_t>& units) {
    std::vector<const Unit*> missing;
    for (const std::size_t index : units) {
      const Unit& unit = batch_.units.at(index);
      if (read_unit(settings_.out, unit)) {
        ++progress_.known;
      } else {
        missing.push_back(&unit);
      }
    }
    progress_.all = missing.size();
    tell();
    for (std::size_t begin = 0; begin < missing.size(); begin += kUnitsAtATime) {
      const std::size_t end = std::min(begin + kUnitsAtATime, missing.size());
      if (!run_some({missing.begin() + static_cast<std::ptrdiff_t>(begin),
                     missing.begin() + static_cast<std::ptrdiff_t>(end)})) {
        return false;
      }
    }
    return true;
  }

 private:
  void tell() const {
    if (on_progress_) on_progress_(progress_);
  }

  bool run_some(const std::vector<const Unit*>& units) {
    std::map<std::pair<std::size_t, std::size_t>, UnitGroup> groups;
    for (const Unit* unit : units) {
      UnitGroup& group = groups[{unit->program, unit->condition}];
      group.program = unit->program;
      group.condition = unit->condition;
      group.units.emplace(unit->seed, unit);
    }
    std::vector<playerlike::ProgramJob> jobs;
    std::vector<std::pair<UnitGroup*, std::size_t>> places;
    for (auto& [key, group] : groups) {
      prepare(group);
      for (std::size_t job = 0; job < group.runs->jobs().size(); ++job) {
        jobs.push_back(group.runs->jobs()[job]);
        places.emplace_back(&group, job);
      }
    }
    playerlike::JobLimits limits;
    limits.at_once = settings_.jobs;
    limits.timeout_s = groups.begin()->second.task->task().timeout_s;
    const std::vector<JobEnd> ends =
        playerlike::run_programs(jobs, limits, {}, [&](std::size_t index, const JobEnd& end) {
          const auto& [group, job] = places[index];
          const grade::GradedRun& run = group->runs->judge(job, end);
          if (end.kind == JobEnd::Kind::kInterrupted) return;
          publish(settings_.out, *group->units.at(run.seed),
                  fs::path(group->settings.output_folder) / run.folder, run);
          ++progress_.ended;
          tell();
        });
    return std::all_of(ends.begin(), ends.end(), [](const JobEnd& end) {
      return end.kind != JobEnd::Kind::kInterrupted && end.kind != JobEnd::Kind::kNotStarted;
    });
  }

  void prepare(UnitGroup& group) {
    const Condition& condition = batch_.conditions[group.condition];
    grade::Task task = task_of(batch_, condition);
    task.seeds.clear();
    for (const auto& [seed, unit] : group.units) task.seeds.push_back(seed);
    group.task.emplace(std::move(task));
    group.settings.program = batch_.programs[group.program].command;
    group.settings.output_folder =
        (own_.path() / (std::to_string(group.program) + '-' + std::to_string(group.condition)))
            .string();
    group.settings.realism = batch_.realism;
    group.settings.environment = settings_.environment;
    if (settings_.launcher) group.settings.launcher = settings_.launcher(condition);
    group.runs.emplace(*group.task, group.settings, group.grade);
  }

  const Batch& batch_;
  const UnitRunSettings& settings_;
  const std::function<void(const UnitProgress&)>& on_progress_;
  OwnFolder own_;
  UnitProgress progress_;
};

}  // namespace

fs::path folder_of(const fs::path& out, const Unit& unit) { return out / kUnitsFolder / unit.id; }

std::optional<grade::GradedRun> read_unit(const fs::path& out, const Unit& unit) {
  std::string text;
  if (sim::read_whole_file((folder_of(out, unit) / kRecord).string(), {}, text)) {
    return std::nullopt;
  }
  return grade::read_run(text);
}

void forget_unit(const fs::path& out, const Unit& unit) {
  std::error_code ignored;
  const fs::path place = folder_of(out, unit);
  fs::remove(place / kRecord, ignored);  // first, so that what remains counts as no result
  fs::remove_all(place, ignored);
}

bool run_units(const Batch& batch, const std::vector<std::size_t>& units,
               const UnitRunSettings& settings,
               const std::function<void(const UnitProgress&)>& on_progress) {
  return UnitRuns(batch, settings, on_progress).run(units);
}

}  // namespace playpen::batch
