// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/grade.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "commands.h"
#include "debugger_hint.h"
#include "grade/text.h"
#include "playerlike/host/program.h"
#include "playerlike/host/rerun.h"
#include "preload.h"
#include "shipped.h"
#include "sim/core/number_text.h"
#include "sim/world/realism.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

/// A progress line that overwrites itself, shown only on a terminal.
class ProgressLine {
 public:
  void show(const grade::Progress& progress) {
    if (!is_terminal_) return;
    std::cerr << "\r\033[K" << progress.ended << " of " << progress.runs << " runs ended, "
              << progress.running << " running" << std::flush;
  }
  void clear() const {
    if (is_terminal_) std::cerr << "\r\033[K" << std::flush;
  }

 private:
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
};

/// The name by which the user would call a world.
std::string short_name_of(const std::string& file) {
  const std::string name = grade::world_name(file);
  try {
    std::error_code error;
    return file.empty() || fs::equivalent(find_world(name), file, error) ? name : file;
  } catch (const std::exception&) {
    return file;  // no world has that name
  }
}

/// What an isolated program must not see: results, and what the task and its worlds consist of.
std::vector<std::string> hidden_files(const grade::GradeSettings& settings) {
  std::vector<std::string> files = {settings.output_folder, settings.task.file};
  for (const grade::TaskWorld& world : settings.task.worlds) files.push_back(world.file);
  return files;
}

/// What helps to find out why a run has failed.
class Advice {
 public:
  Advice(const GradeRequest& request, const grade::GradeSettings& settings)
      : request_(request), settings_(settings) {}

  [[nodiscard]] std::vector<std::string> operator()(const grade::GradedRun& run) const {
    if (run.ending == grade::Ending::kNotRun) return {};
    std::vector<std::string> lines;
    const fs::path folder = fs::path(settings_.output_folder) / run.folder;
    std::error_code error;
    if (const fs::path picture = folder / "scene.png"; fs::exists(picture, error)) {
      lines.push_back("picture: " + picture.string());
    }
    if (const fs::path log = folder / playerlike::kProgramLog;
        fs::file_size(log, error) > 0 && !error) {
      lines.push_back("what the program printed: " + log.string());
    }
    if (fs::exists(folder / playerlike::kRecordingFile, error) &&
        fs::exists(folder / "report.json", error)) {
      lines.push_back("why: " + shell_word(request_.invocation) + " why " +
                      shell_word(folder.string()));
    }
    const auto world =
        std::find_if(settings_.task.worlds.begin(), settings_.task.worlds.end(),
                     [&run](const auto& w) { return grade::world_name(w.file) == run.world; });
    if (world == settings_.task.worlds.end()) return lines;
    std::vector<std::string> program = request_.command;
    for (const auto* more : {&settings_.task.arguments, &world->arguments}) {
      program.insert(program.end(), more->begin(), more->end());
    }
    const std::vector<std::string> call = call_of_run(*world, run);
    std::string repeat;
    for (const std::string& word : call) repeat += shell_word(word) + ' ';
    repeat += "--";
    for (const std::string& word : program) repeat += ' ' + shell_word(word);
    lines.push_back("repeat: " + repeat);
    if (run.signal && is_crash(*run.signal)) {
      lines.push_back("to see where it happened: " + debugger_command(call, program));
    }
    return lines;
  }

 private:
  [[nodiscard]] std::vector<std::string> call_of_run(const grade::TaskWorld& world,
                                                     const grade::GradedRun& run) const {
    std::vector<std::string> call = {request_.invocation, "run", short_name_of(world.file),
                                     "--seed", std::to_string(run.seed)};
    if (settings_.task.duration_s) {
      call.insert(call.end(), {"--duration", sim::shortest_text(*settings_.task.duration_s)});
    }
    if (!settings_.launcher.empty()) call.emplace_back("--isolated=required");
    if (settings_.realism) {
      call.insert(call.end(), {"--realism", std::string(sim::to_string(*settings_.realism))});
    }
    return call;
  }

  const GradeRequest& request_;
  const grade::GradeSettings& settings_;
};

/// Writes the replay of each run that has results.
void write_replays(const grade::Grade& result, const std::string& out, double most_megabytes) {
  for (const grade::GradedRun& run : result.runs) {
    const fs::path folder = fs::path(out) / run.folder;
    std::error_code error;
    if (!fs::is_regular_file(folder / "report.json", error)) continue;
    std::cout << "replay: " << write_replay(folder.string(), "", most_megabytes) << '\n';
  }
}

}  // namespace

int grade_program(GradeRequest request) {
  const IsolatedPrograms isolated(request.isolation);
  grade::GradeSettings settings;
  settings.task = load_task(request.task);
  for (std::string& world : request.worlds) world = find_world(world);
  if (!request.worlds.empty()) grade::choose_worlds(settings.task, request.worlds);
  if (!request.seeds.empty()) settings.task.seeds = request.seeds;
  if (request.timeout_s) settings.task.timeout_s = *request.timeout_s;
  settings.realism = request.realism;
  settings.program = request.command;
  settings.program.front() = playerlike::find_program(request.command.front());
  settings.jobs = request.jobs;
  const PreloadedLibrary virtual_time;
  if (!isolated.isolated()) virtual_time.add_to(settings.environment);
  add_libraries_folder(settings.environment);
  settings.output_folder =
      request.output_folder.empty() ? "out/grade/" + settings.task.name : request.output_folder;
  settings.launcher = isolated.launcher(virtual_time.file(), hidden_files(settings));

  const fs::path file = request.json_file.empty() ? fs::path(settings.output_folder) / "grade.json"
                                                  : fs::path(request.json_file);
  ProgressLine line;
  std::size_t written = settings.task.worlds.size() * settings.task.seeds.size() + 1;
  grade::Grade result =
      grade::grade(settings, [&](const grade::Progress& progress, const grade::Grade& known) {
        line.show(progress);
        if (std::exchange(written, progress.ended) == progress.ended) return;  // no change
        grade::Grade present = known;
        present.program = request.command;
        grade::write_text_file(file, grade::json_text(present));
      });
  line.clear();
  result.program = request.command;  // as the user wrote it
  std::cout << grade::table(result, {.columns = terminal_columns(STDOUT_FILENO),
                                     .colour = shows_colour(STDOUT_FILENO),
                                     .advice = Advice(request, settings)});
  grade::write_text_file(file, grade::json_text(result));
  std::cout << "details: " << file.string() << '\n';
  if (request.replays) write_replays(result, settings.output_folder, request.replay_megabytes);
  return result.passed() == result.runs.size() ? kOk : kProgramFailed;
}

}  // namespace playpen
