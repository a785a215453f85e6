// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "doctor_checks.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "environment.h"
#include "own_folders.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/program.h"
#include "preload.h"
#include "project.h"
#include "sandbox.h"
#include "scratch_folder.h"
#include "shipped.h"
#include "sim/core/error.h"
#include "sim/core/hash.h"
#include "sim/core/math.h"
#include "sim/render/render.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

/// Of some values of sim/core/math.h.
constexpr std::uint64_t kHashOfMathematics = 0xa5147b32faf33eULL;

constexpr const char* kInstallAgain =
    "install Playpen again: cmake --install BUILD --prefix PREFIX";

/// The output of a program, and whether it ended with status 0.
struct Outcome {
  bool success = false;
  std::string output;
};

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Runs a program to its end. command[0] is looked up in PATH.
Outcome outcome_of(std::vector<std::string> command, const fs::path& log,
                   const playerlike::EnvironmentChanges& environment = {}) {
  Outcome outcome;
  try {
    command.front() = playerlike::find_program(command.front());
    playerlike::ProgramJob job;
    job.command = std::move(command);
    job.environment = environment;
    job.output_file = log.string();
    const std::vector<playerlike::JobEnd> ends = playerlike::run_programs({job}, {});
    outcome.success =
        ends.front().kind == playerlike::JobEnd::Kind::kEnded && ends.front().program.success();
    outcome.output = read_bytes(log);
    if (!outcome.success && outcome.output.empty()) outcome.output = ends.front().program.text();
  } catch (const playerlike::ProgramError& error) {
    outcome.output = error.what();
  }
  return outcome;
}

std::string own_file() { return fs::read_symlink("/proc/self/exe").string(); }

std::optional<std::string> found_program(const std::string& name) {
  try {
    return playerlike::find_program(name);
  } catch (const playerlike::ProgramError&) {
    return std::nullopt;
  }
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t start = text.rfind('\n');
  return start == std::string::npos ? text : text.substr(start + 1);
}

/// The lines of a build's output that name an error; its last line if none does.
std::string reasons(const std::string& output) {
  constexpr std::size_t kMostLines = 3;
  std::string text;
  std::size_t count = 0;
  std::istringstream lines(output);
  for (std::string line; count < kMostLines && std::getline(lines, line);) {
    constexpr std::string_view kTelling[] = {"Could NOT",  "Could not find", "could not be found",
                                             "error:",     "cannot find",    "No such file",
                                             "install lib"};
    const auto tells = [&line](std::string_view words) {
      return line.find(words) != std::string::npos;
    };
    if (std::none_of(std::begin(kTelling), std::end(kTelling), tells)) continue;
    text += (text.empty() ? "" : " | ") + line;
    ++count;
  }
  return text.empty() ? last_line(output) : text;
}

// --- Building -----------------------------------------------------------------------------------

/// A program that a build needs, under one of several names, and the package that contains it.
struct Tool {
  const char* what;
  std::vector<std::string> names;
  const char* package;
};

/// The compiler that a variable names, or else the first of these that is installed.
Tool compiler_tool(const char* what, const char* chosen_by, std::vector<std::string> names,
                   const char* package) {
  const std::string chosen = variable(chosen_by);
  if (!chosen.empty()) names = {chosen.substr(0, chosen.find(' '))};
  return {what, std::move(names), package};
}

/// What CMake needs to build a program in C++.
std::vector<Tool> building_tools() {
  return {compiler_tool("C++ compiler", "CXX", {"c++", "g++", "clang++"}, "g++"),
          {"CMake", {"cmake"}, "cmake"},
          {"make", {"make", "ninja"}, "make"}};
}

bool is_installed(const Tool& tool) {
  return std::any_of(tool.names.begin(), tool.names.end(),
                     [](const std::string& name) { return found_program(name).has_value(); });
}

/// @return whether the tool is installed.
bool look_for(const Tool& tool, const fs::path& log, Findings& findings) {
  for (const std::string& name : tool.names) {
    if (const std::optional<std::string> file = found_program(name)) {
      const Outcome version = outcome_of({*file, "--version"}, log);
      findings.push_back({Health::kGood,
                          std::string(tool.what) + ": " + *file +
                              (version.success ? ", " + first_line(version.output) : ""),
                          ""});
      return true;
    }
  }
  findings.push_back({Health::kWarning, std::string(tool.what) + ": none", "",
                      std::string("sudo apt install ") + tool.package});
  return false;
}

void check_pkgconfig(const fs::path& log, Findings& findings) {
  const std::optional<fs::path> folder = pkgconfig_folder();
  if (!folder) {
    findings.push_back({Health::kNote,
                        "makefiles that use pkg-config: playerc++.pc is not beside this command",
                        "they need an installed Playpen: cmake --install BUILD --prefix PREFIX"});
    return;
  }
  const std::vector<std::string> query = {"pkg-config", "--exists", "playerc++", "playerc"};
  if (outcome_of(query, log).success) {
    findings.push_back({Health::kGood, "pkg-config finds playerc++ and playerc", ""});
  } else if (outcome_of(query, log, {{"PKG_CONFIG_PATH", folder->string()}}).success) {
    findings.push_back({Health::kNote,
                        "pkg-config finds playerc++ and playerc only if it is told where to look",
                        "", "export PKG_CONFIG_PATH=" + shell_word(folder->string())});
  } else {
    findings.push_back({Health::kWarning,
                        "pkg-config does not take " + (*folder / "playerc++.pc").string(),
                        kInstallAgain});
  }
}

/// Builds the smallest client program with CMake.
Finding trial_build(const ScratchFolder& scratch) {
  const fs::path project = scratch / "client";
  const std::string build = (project / "build").string();
  try {
    fs::create_directories(project);
    copy_template(project_template("client"), project);
  } catch (const std::runtime_error& error) {
    return {Health::kWarning, std::string("no program could be built: ") + error.what(), ""};
  }
  const Outcome configured =
      outcome_of({"cmake", "-S", project.string(), "-B", build}, scratch / "configure.log");
  if (!configured.success) {
    return {Health::kWarning,
            "a client program cannot be configured by CMake: " + reasons(configured.output),
            "install the packages that are named; in Playpen's source tree, "
            "apps/install_dependencies.sh does"};
  }
  const Outcome built = outcome_of({"cmake", "--build", build}, scratch / "build.log");
  if (!built.success) {
    return {Health::kWarning, "a client program cannot be built: " + reasons(built.output),
            "install the packages that are named; in Playpen's source tree, "
            "apps/install_dependencies.sh does"};
  }
  return {Health::kGood, "a client program was configured and built by CMake", ""};
}

// --- Probes -------------------------------------------------------------------------------------

constexpr int kProbeRounds = 9;  // of 0.1 s

/// Counts laser readings.
class Readings : public playerlike::ReadingSink {
 public:
  void on_reading(playerlike::DeviceId /*device*/, const sim::SharedReading& /*reading*/) override {
    ++count_;
  }
  [[nodiscard]] int count() const noexcept { return count_; }

 private:
  int count_ = 0;
};

/// Does what the client library does for a program that reads a laser.
int probe_run() {
  constexpr int kPort = 6665;
  const std::unique_ptr<playerlike::Session> session = playerlike::open_session("localhost", kPort);
  for (const playerlike::DeviceInfo& device : session->robots().front().devices) {
    if (device.type == "laser") session->request(playerlike::SubscribeRequest{device.id});
  }
  Readings readings;
  for (int round = 0; round < kProbeRounds; ++round) {
    session->wait();
    static_cast<void>(session->take(readings));
  }
  if (readings.count() != kProbeRounds) {
    std::cerr << "the laser gave " << readings.count() << " readings in " << kProbeRounds
              << " rounds\n";
    return 1;
  }
  return 0;
}

int probe_film(const std::string& file) {
  constexpr int kSide_px = 64;
  constexpr int kFrames = 5;
  sim::render::Image frame;
  frame.width = kSide_px;
  frame.height = kSide_px;
  sim::render::FilmWriter film(file, 25.0);
  for (int i = 0; i < kFrames; ++i) {
    frame.rgb.assign(std::size_t{3} * kSide_px * kSide_px, static_cast<std::uint8_t>(40 * i));
    film.add(frame);
  }
  film.finish();
  return 0;
}

}  // namespace

int probe(const std::string& what, const std::string& file) {
  if (what == "run") return probe_run();
  if (what == "film") return probe_film(file);
  throw std::runtime_error("doctor has no probe '" + what + "'");
}

Findings check_installation() {
  Findings findings;
  const fs::path folder = own_folders().front();
  findings.push_back({Health::kGood, "playpen " PLAYPEN_VERSION ", the program " + own_file(), ""});

  std::map<FileKind, int> counts;
  for (const ShippedFile& file : shipped_files()) ++counts[file.kind];
  if (const std::optional<fs::path> worlds = worlds_folder()) {
    findings.push_back({Health::kGood,
                        std::to_string(counts[FileKind::kWorld]) + " worlds, " +
                            std::to_string(counts[FileKind::kTask]) + " tasks and " +
                            std::to_string(counts[FileKind::kModel]) + " robot models in " +
                            worlds->string(),
                        ""});
  } else {
    findings.push_back(
        {Health::kBroken, "the folder of worlds, share/playpen/worlds, is missing", kInstallAgain});
  }

  try {
    const PreloadedLibrary library;
    findings.push_back({Health::kGood, "virtual time: " + library.file(), ""});
  } catch (const std::runtime_error& error) {
    findings.push_back({Health::kBroken, error.what(), kInstallAgain});
  }

  const auto look_for = [&](const char* name, const char* what, const char* option) {
    const fs::path program = folder / name;
    if (access(program.c_str(), X_OK) == 0) {
      findings.push_back(
          {Health::kGood, std::string("the program of the ") + what + ": " + program.string(), ""});
    } else {
      findings.push_back({Health::kWarning,
                          std::string(option) + " lacks its program, " + program.string(),
                          kInstallAgain});
    }
  };
  look_for("playpen-view", "live window", "--view");
  look_for("playpen-page", "live page", "--page");

  std::string missing;
  for (const ProjectTemplate& kind : kProjectTemplates) {
    if (!template_folder(kind)) missing += std::string(missing.empty() ? "" : ", ") + kind.name;
  }
  if (missing.empty()) {
    findings.push_back({Health::kGood, "the templates of 'playpen new' are there", ""});
  } else {
    findings.push_back(
        {Health::kWarning, "'playpen new' lacks the templates " + missing, kInstallAgain});
  }
  return findings;
}

Findings check_run() {
  try {
    const ScratchFolder scratch;
    const PreloadedLibrary library;
    playerlike::RunSettings settings;
    settings.output_folder = (scratch / "out").string();
    settings.virtual_time = true;
    settings.quiet_end = true;
    fs::create_directories(settings.output_folder);
    playerlike::EnvironmentChanges environment = playerlike::run_environment("", settings);
    library.add_to(environment);
    const Outcome run =
        outcome_of({own_file(), "doctor", "--probe", "run"}, scratch / "run.log", environment);
    if (!run.success) {
      return {{Health::kBroken, "a program in the default world failed: " + last_line(run.output),
               "if the message does not help, please report it"}};
    }
    for (const char* result : {"report.json", "scene.png", "canvas.png", "trajectory.csv"}) {
      if (read_bytes(fs::path(settings.output_folder) / result).empty()) {
        return {{Health::kBroken, std::string("a run left no ") + result + ": " + run.output,
                 "is the disk full? If not, please report this"}};
      }
    }
    return {{Health::kGood,
             "a program read a laser in the default world; pictures and report are "
             "written",
             ""}};
  } catch (const std::exception& error) {
    return {{Health::kBroken, std::string("a run cannot be tried: ") + error.what(), ""}};
  }
}

Findings check_building() {
  Findings findings;
  try {
    const ScratchFolder scratch;
    const fs::path log = scratch / "version.log";
    bool complete = true;
    for (const Tool& tool : building_tools()) {
      complete = look_for(tool, log, findings) && complete;
    }
    const bool pkgconfig =
        look_for({"pkg-config, for makefiles", {"pkg-config"}, "pkg-config"}, log, findings);
    if (pkgconfig) check_pkgconfig(log, findings);
    const std::optional<fs::path> prefix = package_prefix();
    if (!prefix) {
      findings.push_back({Health::kWarning,
                          "the CMake package of Playpen is not beside this program",
                          kInstallAgain});
    } else if (complete) {
      findings.push_back(trial_build(scratch));
    }
  } catch (const std::exception& error) {
    findings.push_back(
        {Health::kWarning, std::string("building cannot be tried: ") + error.what(), ""});
  }
  return findings;
}

Findings check_class() {
  Findings findings;
  try {
    const ScratchFolder scratch;
    const fs::path log = scratch / "version.log";
    look_for({"bsdtar, for submissions that are archives", {"bsdtar"}, "libarchive-tools"}, log,
             findings);
    look_for(compiler_tool("C compiler", "CC", {"cc", "gcc", "clang"}, "gcc"), log, findings);
    for (const Tool& tool : building_tools()) {
      if (is_installed(tool)) continue;
      findings.push_back({Health::kWarning,
                          std::string("submissions do not compile: no ") + tool.what, "",
                          std::string("sudo apt install ") + tool.package});
    }
  } catch (const std::exception& error) {
    findings.push_back(
        {Health::kWarning, std::string("the tools cannot be tried: ") + error.what(), ""});
  }
  return findings;
}

Findings check_display() {
  constexpr const char* kFilmInstead =
      "without a display, record a film: playpen run ... --record film.mp4";
  if (variable("DISPLAY").empty()) {
    return {{Health::kWarning,
             variable("WAYLAND_DISPLAY").empty()
                 ? "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set"
                 : "the window needs an X display, and DISPLAY is not set; Xwayland sets it",
             kFilmInstead}};
  }
  try {
    const ScratchFolder scratch;
    const fs::path viewer = own_folders().front() / "playpen-view";
    const Outcome outcome = outcome_of({viewer.string(), "--check"}, scratch / "view.log");
    if (outcome.success) {
      return {{Health::kGood,
               "the display " + variable("DISPLAY") + " can be used, " + last_line(outcome.output),
               ""}};
    }
    return {{Health::kWarning,
             "the display " + variable("DISPLAY") + " cannot be used: " + last_line(outcome.output),
             kFilmInstead}};
  } catch (const std::exception& error) {
    return {{Health::kWarning, std::string("the display cannot be tried: ") + error.what(), ""}};
  }
}

Findings check_films() {
  constexpr const char* kInstead =
      "a film can also be an .avi, or a folder of pictures: --record pictures/";
  try {
    const ScratchFolder scratch;
    const fs::path film = scratch / "film.mp4";
    const Outcome outcome = outcome_of(
        {own_file(), "doctor", "--probe", "film", "--file", film.string()}, scratch / "film.log");
    const std::string bytes = read_bytes(film);
    if (!outcome.success || bytes.empty()) {
      return {{Health::kWarning, "no .mp4 can be written: " + last_line(outcome.output), kInstead}};
    }
    // The name of the codec in the film's table of contents (ISO 14496-15, ISO 14496-14).
    if (bytes.find("avc1") != std::string::npos) {
      return {{Health::kGood, "an .mp4 was written as H.264, which browsers play", ""}};
    }
    return {
        {Health::kWarning,
         "an .mp4 was written, but not as H.264: FFmpeg has no encoder of it, so browsers do not "
         "play the film",
         "install FFmpeg's libraries with libx264 (Debian: sudo apt install libavcodec-extra), "
         "or convert films: ffmpeg -i film.mp4 -c:v libx264 other.mp4"}};
  } catch (const std::exception& error) {
    return {{Health::kWarning, std::string("no film can be tried: ") + error.what(), ""}};
  }
}

Findings check_isolation() {
  const IsolationAbility ability = try_isolation();
  if (ability.obstacle.empty()) return {{Health::kGood, "bubblewrap makes a sandbox", ""}};
  return {{Health::kWarning, "programs cannot be isolated: " + ability.obstacle,
           "playpen doc isolation explains what it needs"}};
}

Findings check_core_dumps() {
  rlimit limit{};
  if (getrlimit(RLIMIT_CORE, &limit) != 0) return {};
  const std::string pattern = first_line(read_bytes("/proc/sys/kernel/core_pattern"));
  const bool is_piped = pattern.starts_with('|');
  // If core_pattern is a pipe, the kernel ignores the limit, except for 1.
  if (limit.rlim_cur == 0 && !is_piped) {
    return {{Health::kNote, "a program that crashes leaves no core dump: 'ulimit -c' is 0",
             "to look at a crash: ulimit -c unlimited, run the program again, then gdb PROGRAM "
             "CORE"}};
  }
  if (pattern.find("systemd-coredump") != std::string::npos) {
    return {
        {Health::kGood, "core dumps go to systemd-coredump", "coredumpctl gdb shows the last one"}};
  }
  if (is_piped) {
    return {{Health::kNote, "core dumps go to the program " + pattern.substr(1),
             "to have them as files: sudo sysctl kernel.core_pattern=core.%p"}};
  }
  const bool is_limited = limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur != 0;
  return {{is_limited ? Health::kNote : Health::kGood,
           "a program that crashes leaves a core dump, named by the pattern '" + pattern + "'" +
               (is_limited ? ", of at most " + std::to_string(limit.rlim_cur) + " bytes" : ""),
           is_limited ? "ulimit -c unlimited" : "gdb PROGRAM CORE looks at it"}};
}

Findings check_mathematics() {
  constexpr int kArguments = 100'000;
  const auto argument = [](int i) { return 1e-4 * i - 2.0; };
  sim::StateHash hash;
  for (int i = 0; i < kArguments; i += 100) {
    const double x = argument(i);
    for (const double y : {sim::math::sin(x), sim::math::exp(x), sim::math::atan2(x, 1.3)})
      hash.add(y);
  }
  if (hash.value() != kHashOfMathematics) {
    return {{Health::kWarning, "this machine computes other bits than Playpen's tests expect",
             "results differ from those of other machines; please report this"}};
  }
  Findings findings;
  if (!sim::math::bound()) {
    findings.push_back(
        {Health::kNote,
         "a program's own calls of sin, cos and their kind go to the C library of this "
         "system, which may round otherwise than that of other machines",
         "playpen doc trust: what is equal everywhere"});
  }
  const std::unique_ptr<void, int (*)(void*)> library(dlopen("libm.so.6", RTLD_LAZY), &dlclose);
  void* const found = library == nullptr ? nullptr : dlsym(library.get(), "sin");
  if (found != nullptr) {
    auto* const c_sin = reinterpret_cast<double (*)(double)>(found);
    int others = 0;
    for (int i = 0; i < kArguments; ++i) {
      if (c_sin(argument(i)) != sim::math::sin(argument(i))) ++others;
    }
    findings.push_back({Health::kGood,
                        "the last bits are as everywhere; the C library's sin has others for " +
                            std::to_string(others) + " of 100 000 arguments",
                        ""});
  }
  return findings;
}

Findings check_variables() {
  Findings findings;
  std::vector<std::string> known;
  for (const EnvironmentVariable& one : environment_variables()) {
    known.emplace_back(one.name);
    const char* const value = std::getenv(one.name);
    if (value == nullptr) continue;
    findings.push_back(
        {Health::kNote, std::string(one.name) + '=' + value + ": " + one.meaning,
         one.run_sets ? "holds for programs that are started without 'playpen run'" : ""});
  }
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    if (!name.starts_with("PLAYPEN_")) continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = sim::nearest_word(name, known);
    findings.push_back({Health::kWarning, name + " is set, but Playpen has no such variable",
                        near.empty() ? "unset " + name : "did you mean " + near + "?"});
  }
  try {
    static_cast<void>(playerlike::RunSettings::from_environment());
  } catch (const sim::ConfigError& error) {
    findings.push_back({Health::kWarning, error.what(), "set it to what is expected, or unset it"});
  }
  if (findings.empty()) findings.push_back({Health::kGood, "none of Playpen's is set", ""});
  return findings;
}

}  // namespace playpen
