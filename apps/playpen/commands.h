// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expect/expectation.h"
#include "fuzz/judgement.h"
#include "isolation.h"
#include "page_process.h"
#include "playerlike/host/run_settings.h"
#include "playerlike/server/server_settings.h"
#include "run_start.h"
#include "sim/core/log.h"
#include "sim/render/render.h"

/// The commands of `playpen`, without argument parsing. Each prints to the standard streams and
/// returns an exit status; other errors are thrown.
namespace playpen {

inline constexpr int kOk = 0;             ///< all went well
inline constexpr int kProgramFailed = 1;  ///< the client program failed
inline constexpr int kBadInput = 2;       ///< unusable arguments or world

/// What happens at a moment of a run.
struct RunUntil {
  double time_s = 0.0;  ///< simulated time, 0..1e9; the first step at or after it counts
  enum class Then { kDebug, kView, kSave } then = Then::kSave;
};

/// Arguments of `playpen run`.
struct RunRequest {
  std::string world;  ///< as the user wrote it, see find_world(); with `from`, "" is that run's
  std::optional<RunMoment> from;  ///< the world begins as it was at this moment
  playerlike::RunSettings settings;
  bool quiet = false;
  bool view = false;        ///< in a window, in real time unless the settings say otherwise
  PageRequest page;         ///< likewise for browsers
  bool real_sleep = false;  ///< the program's sleeps take wall time, not simulated time
  bool debug = false;       ///< in gdb
  std::string replay_file;  ///< .html; "": no replay is written
  double replay_megabytes = 5.0;
  std::optional<RunUntil> until;
  IsolationSettings isolation;
  std::vector<expect::Expectation> expectations;  ///< of its figures
  std::vector<std::string> command;               ///< program and arguments
  /// the call of `playpen run` up to "--", as the user wrote it, for advice
  std::vector<std::string> call;
};

/// Arguments of `playpen grade`.
struct GradeRequest {
  std::string task;                     ///< as the user wrote it, see load_task()
  std::vector<std::string> worlds;      ///< see find_world(); empty: those of the task
  std::vector<std::uint64_t> seeds;     ///< empty: those of the task
  int jobs = 1;                         ///< programs that run side by side, >= 1
  std::optional<double> timeout_s;      ///< empty: that of the task
  std::optional<sim::Realism> realism;  ///< empty: that of each world
  std::string output_folder;            ///< "": out/grade/TASK
  std::string json_file;                ///< "": grade.json in the output folder
  bool replays = false;                 ///< whether each run gets its replay, course::kReplayFile
  double replay_megabytes = 5.0;        ///< size of a replay
  IsolationSettings isolation;
  std::vector<std::string> command;  ///< program and arguments
  std::string invocation;            ///< how the user calls playpen, for advice
};

/// Runs a client program on the worlds of a task, grades it, prints a table and writes a JSON file.
/// @return kOk if all runs pass, else kProgramFailed.
/// @throws sim::ConfigError for a bad task or world, playerlike::ProgramError if the program can't
///         be started, std::exception if a folder or file can't be written.
[[nodiscard]] int grade_program(GradeRequest request);

/// Arguments of `playpen class`.
struct ClassRequest {
  std::vector<std::string> tasks;      ///< as the user wrote them, see load_task(); at least one
  std::string submissions_folder;      ///< "": there is only `submission`
  std::string submission;              ///< a folder or an archive; "": there is a folder of them
  std::string id;                      ///< of the person of `submission`; "": its name
  std::vector<std::string> baselines;  ///< folders and archives of programs that everybody knows
  bool individual = false;             ///< whether each person has conditions of their own
  bool replays = false;                ///< whether the runs on the pages get their replays
  bool must_pass = false;              ///< whether a run that does not pass is a failure
  std::string roster_file;             ///< "": none
  std::string output_folder;
  std::string program;               ///< name of the programs' file; "": any
  std::vector<std::uint64_t> seeds;  ///< empty: those of the tasks
  int jobs = 1;                      ///< programs that run side by side, >= 1
  std::optional<double> timeout_s;   ///< of a run; empty: that of the task
  std::optional<double> build_timeout_s;
  std::optional<sim::Realism> realism;  ///< empty: that of each world
  IsolationSettings isolation{Isolation::kRequired, {}};
};

/// Compiles and grades the submissions of a class, prints a table and writes the results.
/// @return kOk if everything was graded; kProgramFailed if a signal ended it before, or if all must
///         pass, but do not.
/// @throws sim::ConfigError for a bad task, world or roster, or a folder without submissions;
///         std::exception if a folder or file can't be written, or programs can't be isolated.
[[nodiscard]] int grade_class(const ClassRequest& request);

/// Who runs the units of a batch.
enum class Engine {
  kLocal,     ///< this process
  kSlurm,     ///< an array of jobs
  kParallel,  ///< GNU parallel
};

/// A part of a batch: the number `number` of `count`, 1 <= number <= count.
struct BatchPart {
  std::size_t number = 1;
  std::size_t count = 1;
};

/// Arguments of `playpen batch`.
struct BatchRequest {
  std::string plan;  ///< file; "": the batch that the output folder contains
  std::string output_folder;
  int jobs = 1;  ///< programs that run side by side, >= 1
  Engine engine = Engine::kLocal;
  std::size_t parts = 0;                    ///< for an engine; 0: chosen by the number of runs
  std::vector<std::string> engine_options;  ///< words for the engine's command
  bool wait = false;                        ///< until the engine has ended
  bool collect = false;                     ///< only collect results, run nothing
  bool failed = false;                      ///< run those again that did not end well
  std::optional<BatchPart> part;            ///< run only this part, and collect nothing
  std::string repeat;                       ///< id of a unit to run with a window; "": none
  IsolationSettings isolation;
  std::string invocation;  ///< how the user calls playpen, for advice
};

/// Runs the units of a plan, here or by an engine, and collects their results.
/// @return kOk if all units have results (or, without waiting, if the engine has got them);
///         kProgramFailed if some have none.
/// @throws sim::ConfigError for a bad plan, task or world, playerlike::ProgramError if a program
///         can't be started, std::exception if a folder or file can't be written or read.
[[nodiscard]] int run_batch(const BatchRequest& request);

/// Runs a client program on a world and prints a summary unless the request says quiet.
/// @throws sim::ConfigError for a bad world, playerlike::ProgramError if the program can't be
///         started, std::exception if the output folder can't be prepared or no window can be
///         opened.
[[nodiscard]] int run(RunRequest request);

/// Whether a "world" of `playpen run` is the server of one: "tcp://...", "player://..." or
/// "unix:...".
[[nodiscard]] bool names_server(const std::string& world);

/// Runs a client program in the world of a server, whose time is that of its sleeps, too, if the
/// server is a Playpen server in lockstep.
/// @return kOk if the program ends with status 0, else kProgramFailed.
/// @throws playerlike::ProgramError if the program can't be started.
[[nodiscard]] int run_at_server(const RunRequest& request);

/// Arguments of `playpen serve`.
struct ServeRequest {
  std::string world;  ///< as the user wrote it, see find_world()
  playerlike::RunSettings settings;
  playerlike::ServerSettings server;
  std::string token_file;         ///< "": no tokens
  std::optional<int> clients;     ///< clients that the start gate waits for, instead of the world's
  bool own_sensors_only = false;  ///< overrides the world's "privacy"
  sim::LogLevel log_level = sim::LogLevel::kInfo;
  bool quiet = false;
  bool view = false;  ///< in a window, in real time unless the settings say otherwise
  PageRequest page;   ///< likewise for browsers
};

/// Serves a simulation over TCP until a signal arrives, a client requests the end, or the run is
/// over and its clients have left. Prints the address, and a summary unless the request says quiet.
/// @return kOk, or kProgramFailed if results could not be written.
/// @throws sim::ConfigError for a bad world, token file, address or port; std::exception if the
///         output folder can't be prepared, or no window or page can be opened.
[[nodiscard]] int serve(ServeRequest request);

/// Validates worlds, tasks and robot models, given as files or names (see find_files()). Prints a
/// line for each valid one and every issue of the others.
[[nodiscard]] int check(const std::vector<std::string>& names);

/// Arguments of `playpen render`.
struct RenderRequest {
  std::string world;  ///< as the user wrote it, see find_world(); or a map_server file, .yaml
  std::string file;   ///< .png, or .yaml with `map`
  int size_px = 1000;
  std::optional<sim::ViewMode> view_mode;  ///< instead of the world's
  sim::render::RenderOptions pictures;     ///< contents and size (`size_px`) of the picture
  bool canvas = false;                     ///< draw only the canvas
  bool map = false;                        ///< draw the true map
};

/// Draws a world in its initial state, only its canvas, its true map, or a map file. Pictures of
/// cells use a whole number of pixels per cell, at least one; the longer side is at most `size_px`.
/// @throws sim::ConfigError for a bad world or map, std::runtime_error if the file can't be written
///         or the world lacks what the request asks for.
[[nodiscard]] int render(const RenderRequest& request);

/// Options of `playpen plot`.
struct PlotRequest {
  std::vector<std::string> folders;  ///< result folders, one per run
  std::string file = "plot.png";     ///< .png or .svg
};

/// Draws charts of runs. If the world of a run is unknown, a message on standard error gives the
/// reason and names the charts that are omitted.
/// @throws std::runtime_error naming the folder that does not contain a run, or the file that
///         cannot be written.
[[nodiscard]] int plot(const PlotRequest& request);

/// Arguments of `playpen diff`.
struct DiffRequest {
  std::string first;   ///< folder of results of a run or of a grade
  std::string second;  ///< the folder that is compared with it
  std::string file;    ///< .png or .svg; "": no picture
};

/// Compares two runs, or the runs of two grades that have the same names, and prints how they
/// differ. The picture shows the first runs that differ.
/// @return kOk if all runs are equal, else 1 (kProgramFailed).
/// @throws std::runtime_error naming the folder that does not contain a run, the file that cannot
///         be read or written, or the grades that have no runs of the same names.
[[nodiscard]] int compare_runs(const DiffRequest& request);

/// Arguments of `playpen fuzz`.
struct FuzzRequest {
  std::string world;                ///< or task, as the user wrote it
  std::string robot;                ///< name; "": that of the task, or the first
  std::optional<double> budget_s;   ///< wall time; none: a minute, unless there are `runs`
  std::optional<std::size_t> runs;  ///< of the search
  std::uint64_t seed = 1;           ///< of the search
  double duration_s = 30.0;         ///< simulated, of each run
  std::size_t most_findings = 5;
  int jobs = 1;                     ///< programs that run side by side, >= 1
  std::optional<double> timeout_s;  ///< of a run
  fuzz::Freedom freedom;            ///< what of the world may be changed
  std::vector<fuzz::Kind> kinds;    ///< that count; empty: all, as the task allows
  std::vector<expect::Expectation> expectations;
  bool random = false;  ///< instead of guided
  bool quiet = false;
  std::string output_folder;         ///< "": out/fuzz/NAME
  std::string keep_folder;           ///< "": findings are not kept elsewhere
  std::vector<std::string> command;  ///< program and arguments
};

/// Searches for worlds in which a program fails, prints and writes them.
/// @return kOk if nothing was found, else kProgramFailed.
/// @throws sim::ConfigError for a bad world or task, playerlike::ProgramError if the program can't
///         be started, std::exception if a folder or file can't be written.
[[nodiscard]] int fuzz_program(FuzzRequest request);

/// Arguments of `playpen expect`.
struct ExpectRequest {
  std::vector<expect::Expectation> expectations;  ///< at least one
  std::string folder;                             ///< of a run; "": only the form is checked
};

/// Prints what is not as expected in a run, or, without a run, the expectations.
/// @return kOk if all is as expected, else kProgramFailed.
/// @throws std::exception if the folder has no readable results.
[[nodiscard]] int check_expectations(const ExpectRequest& request);
/// Prints to the standard error what is not as expected in the results of a folder.
/// @return number of these lines. @throws std::exception as check_expectations().
[[nodiscard]] std::size_t print_unmet(const std::vector<expect::Expectation>& expectations,
                                      const std::string& folder);

/// Arguments of `playpen why`.
struct WhyRequest {
  std::string folder;     ///< folder of results of a run or of a grade
  std::string robot;      ///< name; "": chosen by the run
  std::string file;       ///< .png; "": why.png in the folder of the run
  std::string json_file;  ///< gets the reasons as data; "": none
};

/// Prints why a run failed, or each failed run of a grade, and draws the decisive moment.
/// @return kOk.
/// @throws std::runtime_error naming the folder that does not contain a run with a recording, the
///         robot that there is not, or the file that cannot be written.
[[nodiscard]] int explain(const WhyRequest& request);

/// Writes the replay of a run.
/// @param folder  of its results.
/// @param file    .html; "": course::kReplayFile in that folder.
/// @return the file. @throws as make_replay().
std::string write_replay(const std::string& folder, const std::string& file, double most_megabytes);

/// Arguments of `playpen replay`.
struct ReplayRequest {
  std::string first;             ///< folder of results of a run or of a grade
  std::string second;            ///< folder of a run to show with it; "": none
  std::string file;              ///< .html; "": course::kReplayFile in the folder of the first run
  std::optional<double> time_s;  ///< at which the printed address opens the page
  std::string robot;             ///< that it chooses; "": none
  double most_megabytes = 5.0;   ///< size of the page
  std::string mcap_file;         ///< .mcap, which is written instead of a page; "": none
};

/// Writes the replay of a run, of two runs in one page, or of each run of a grade.
/// @return kOk.
/// @throws std::runtime_error naming the folder that does not contain a run with a recording, or
///         the file that cannot be written.
[[nodiscard]] int make_replay(const ReplayRequest& request);

}  // namespace playpen
