// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/class_runs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "grade/fingerprint.h"
#include "grade/grade.h"
#include "grade/individual.h"
#include "grade/rubric.h"
#include "grade/run_record.h"
#include "grade/runs.h"
#include "grade/text.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using playerlike::JobEnd;

std::string read_text(const fs::path& file) {
  std::string text;
  if (sim::read_whole_file(file.string(), {}, text)) return {};
  return text;
}

/// Whether a process had its end, not one that this process gave it because of a signal.
bool counts(const JobEnd& end) {
  return end.kind != JobEnd::Kind::kInterrupted && end.kind != JobEnd::Kind::kNotStarted;
}

/// What an earlier call has written with a key; null: nothing, or with another key.
json read_record(const fs::path& file, const std::string& key) {
  const json record = json::parse(read_text(file), nullptr, /*allow_exceptions=*/false);
  if (!record.is_object() || record.value("key", json()) != key) return nullptr;
  return record.value("value", json());
}

void write_record(const fs::path& file, const std::string& key, json value) {
  const json record = {{"key", key}, {"value", std::move(value)}};
  grade::write_text_file(file, record.dump(-1, ' ', false, json::error_handler_t::replace) + '\n');
}

json to_json(const Build& build) {
  return {{"built", build.built},
          {"reason", build.reason},
          {"program", build.program},
          {"log", build.log},
          {"wall_time", build.wall_time_s}};
}

std::optional<Build> build_from(const json& value) {
  try {
    return Build{value.at("built"), value.at("reason"), value.at("program"), value.at("log"),
                 value.at("wall_time")};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

/// The folder in which a program runs: that of its project.
fs::path project_folder(const fs::path& source) {
  fs::path folder = source;
  for (;;) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::file_type type = entry->symlink_status().type();
      if (type == fs::file_type::regular) return folder;
      if (type == fs::file_type::directory && entry->path().filename() != "__MACOSX") {
        folders.push_back(entry->path());
      }
    }
    if (folders.size() != 1) return folder;
    folder = folders.front();
  }
}

/// Grades a class: the state between its steps.
class ClassGrading {
 public:
  ClassGrading(const ClassSettings& settings,
               const std::function<void(const ClassProgress&)>& on_progress)
      : settings_(settings), on_progress_(on_progress), out_(settings.output_folder) {
    result_.tasks = settings.tasks;
    result_.isolated = settings.isolated;
    for (const auto* all : {&settings.submissions, &settings.baselines}) {
      const char* const folder = all == &settings.submissions ? "submissions/" : "baselines/";
      for (const Submission& submission : *all) {
        SubmissionResult one;
        one.id = submission.person.id;
        one.name = submission.person.name;
        one.folder = folder + submission.folder;
        one.handed_in = !submission.place.empty();
        if (!one.handed_in) one.build.reason = "nothing was handed in";
        result_.submissions.push_back(std::move(one));
        submissions_.push_back(&submission);
      }
    }
    build_keys_.resize(submissions_.size());
  }

  ClassResult grade() {
    // A task that cannot be used is found before anything is compiled.
    for (const grade::Task& task : settings_.tasks) {
      tasks_.push_back(std::make_unique<grade::PreparedTask>(task));
    }
    build_all();
    for (const auto& task : tasks_) run_all(*task);
    for (SubmissionResult& one : result_.submissions) {
      for (const grade::Task& task : result_.tasks) one.most_points += maximum_points(task);
      for (const grade::Grade& grade : one.grades) one.points += mean_points(grade);
    }
    const auto first_baseline =
        result_.submissions.begin() + static_cast<std::ptrdiff_t>(settings_.submissions.size());
    std::move(first_baseline, result_.submissions.end(), std::back_inserter(result_.baselines));
    result_.submissions.erase(first_baseline, result_.submissions.end());
    return std::move(result_);
  }

 private:
  void tell() const {
    if (on_progress_) on_progress_(progress_);
  }

  /// Runs the processes of a step.
  /// @param on_end  called with the index of a job and how it ended.
  /// @return how all of them ended.
  std::vector<JobEnd> run(const std::vector<playerlike::ProgramJob>& jobs, double timeout_s,
                          const std::function<void(std::size_t, const JobEnd&)>& on_end) {
    playerlike::JobLimits limits;
    limits.at_once = settings_.jobs;
    limits.timeout_s = timeout_s;
    progress_.all = jobs.size();
    progress_.ended = 0;
    progress_.running = 0;
    tell();
    std::vector<JobEnd> ends;
    if (result_.complete) {
      ends = playerlike::run_programs(
          jobs, limits,
          [this](std::size_t /*index*/) {
            ++progress_.running;
            tell();
          },
          [&](std::size_t index, const JobEnd& end) {
            on_end(index, end);
            --progress_.running;
            ++progress_.ended;
            tell();
          });
    }
    ends.resize(jobs.size());
    result_.complete &= std::all_of(ends.begin(), ends.end(), counts);
    return ends;
  }

  void build_all() {
    progress_ = {};
    std::vector<std::unique_ptr<SubmissionBuild>> builds;
    std::vector<std::size_t> submission_of;
    std::vector<playerlike::ProgramJob> jobs;
    for (std::size_t i = 0; i < submissions_.size(); ++i) {
      SubmissionResult& result = result_.submissions[i];
      if (!result.handed_in) continue;
      const fs::path folder = out_ / result.folder;
      build_keys_[i] = grade::fingerprint_of_texts(
          {fingerprint_of(*submissions_[i]), settings_.version, build_commands(),
           settings_.build.program, sim::shortest_text(settings_.build.timeout_s)});
      const std::optional<Build> known =
          build_from(read_record(record_of_build(i), build_keys_[i]));
      if (known && (!known->built || fs::is_regular_file(folder / known->program))) {
        result.build = *known;
        ++progress_.known;
        continue;
      }
      auto build = std::make_unique<SubmissionBuild>(*submissions_[i], folder, settings_.build);
      if (!build->obstacle().empty()) {
        result.build.reason = build->obstacle();
        continue;
      }
      jobs.push_back(build->job());
      builds.push_back(std::move(build));
      submission_of.push_back(i);
      result.build.reason = "not compiled yet";
    }
    static_cast<void>(run(jobs, settings_.build.timeout_s, [&](std::size_t job, const JobEnd& end) {
      const std::size_t i = submission_of[job];
      Build& build = result_.submissions[i].build;
      build = builds[job]->result(end);
      if (counts(end)) write_record(record_of_build(i), build_keys_[i], to_json(build));
    }));
  }

  void run_all(const grade::PreparedTask& task) {
    progress_ = {};
    progress_.step = ClassProgress::Step::kRun;
    progress_.task = task.task().name;
    const std::string task_key = grade::fingerprint_of_texts(
        {grade::fingerprint_of(task.task()), sim::shortest_text(task.task().timeout_s)});
    for (std::size_t i = 0; i < result_.submissions.size(); ++i) {
      if (result_.submissions[i].build.built) prepare_runs(i, task, task_key);
    }
    std::vector<playerlike::ProgramJob> jobs;
    std::vector<std::pair<Runs*, std::size_t>> places;
    for (const auto& runs : runs_) {
      for (std::size_t job = 0; job < runs->runs->jobs().size(); ++job) {
        jobs.push_back(runs->runs->jobs()[job]);
        places.emplace_back(runs.get(), job);
      }
    }
    const std::vector<JobEnd> ends =
        run(jobs, task.task().timeout_s, [&](std::size_t index, const JobEnd& end) {
          auto& [runs, job] = places[index];
          const grade::GradedRun& graded = runs->runs->judge(job, end);
          if (counts(end)) {
            write_record(runs->records / (graded.folder + ".json"), run_key(runs->key, graded),
                         json::parse(grade::run_text(graded)));
          }
        });
    for (std::size_t index = 0; index < ends.size(); ++index) {
      if (ends[index].kind == JobEnd::Kind::kNotStarted) {
        places[index].first->runs->judge_unstarted(places[index].second, ends[index]);
      }
    }
    for (const auto& runs : runs_) {
      result_.submissions[runs->submission].grades.push_back(std::move(runs->grade));
    }
    runs_.clear();
  }

  /// The runs of one submission on the task at hand.
  struct Runs {
    std::size_t submission = 0;
    std::string key;
    fs::path records;
    std::optional<grade::PreparedTask> own_task;  ///< with this person's conditions
    grade::GradeSettings settings;
    grade::Grade grade;
    std::unique_ptr<grade::ProgramRuns> runs;
  };

  void prepare_runs(std::size_t submission, const grade::PreparedTask& common_task,
                    const std::string& task_key) {
    SubmissionResult& result = result_.submissions[submission];
    const fs::path folder = fs::absolute(out_ / result.folder);
    const fs::path program = folder / result.build.program;
    const fs::path source = source_folder(folder);
    runs_.push_back(std::make_unique<Runs>());
    Runs& runs = *runs_.back();
    if (settings_.individual) {
      grade::IndividualTask own =
          individual_task(common_task.task(), result.id,
                          (folder / "conditions" / common_task.task().name).string());
      runs.own_task.emplace(std::move(own.task));
      for (const std::string& sentence : own.sentences) {
        result.note += (result.note.empty() ? "" : "; ") + sentence;
      }
    }
    const grade::PreparedTask& task = runs.own_task ? *runs.own_task : common_task;
    runs.submission = submission;
    runs.key = grade::fingerprint_of_texts(
        {build_keys_[submission], task_key, settings_.isolated ? "1" : "0"});
    runs.settings.program = {program.string()};
    runs.settings.output_folder = (folder / task.task().name).string();
    runs.records = folder / "records" / task.task().name;
    runs.settings.realism = settings_.realism;
    runs.settings.environment = settings_.environment;
    runs.settings.working_folder = project_folder(source).string();
    if (settings_.launcher) {
      runs.settings.launcher = settings_.launcher(task.task(), source.string());
    }
    runs.grade = {task.task(), {program.string()}, {}, settings_.isolated};
    runs.runs = std::make_unique<grade::ProgramRuns>(
        task, runs.settings, runs.grade, [this, &runs](const grade::GradedRun& prepared) {
          const json value =
              read_record(runs.records / (prepared.folder + ".json"), run_key(runs.key, prepared));
          std::optional<grade::GradedRun> known = grade::read_run(value.dump());
          if (!known) return known;
          known->asked = prepared.asked;  // the record has only what came of it
          ++progress_.known;
          return known;
        });
  }

  [[nodiscard]] static std::string run_key(const std::string& key, const grade::GradedRun& run) {
    return grade::fingerprint_of_texts(
        {key, run.folder, std::to_string(run.asked.world), std::to_string(run.asked.seed),
         run.asked.realism,
         run.asked.duration_s ? sim::shortest_text(*run.asked.duration_s) : "-"});
  }

  [[nodiscard]] fs::path record_of_build(std::size_t submission) const {
    return out_ / result_.submissions[submission].folder / "records" / "build.json";
  }

  const ClassSettings& settings_;
  const std::function<void(const ClassProgress&)>& on_progress_;
  const fs::path out_;
  ClassResult result_;  ///< until the end, with baselines among its submissions
  std::vector<const Submission*> submissions_;  ///< in the same order
  ClassProgress progress_;
  std::vector<std::unique_ptr<grade::PreparedTask>> tasks_;
  std::vector<std::string> build_keys_;  ///< by submission; "": nothing to build
  std::vector<std::unique_ptr<Runs>> runs_;
};

}  // namespace

ClassResult grade_class(const ClassSettings& settings,
                        const std::function<void(const ClassProgress&)>& on_progress) {
  return ClassGrading(settings, on_progress).grade();
}

}  // namespace playpen::course
