// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/build.h"

#include <elf.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sim/core/number_text.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrivate = "build";  // only this user gets into it
constexpr const char* kSource = "build/source";
constexpr const char* kLog = "build.log";
constexpr std::uint64_t kMostBuilt = 500'000'000;

// The shell's commands that compile a submission, in its folder. $1 is its archive, or empty.
constexpr const char* kScript = R"(set -e
if [ -n "$1" ]; then bsdtar -x --no-same-owner --no-same-permissions -f "$1"; fi
has() { for file in "$@"; do if [ -f "$file" ]; then return 0; fi; done; return 1; }
sources() { has *.cpp *.cc *.cxx *.c; }
makefile() { has GNUmakefile makefile Makefile; }
for level in 1 2 3 4; do
  if has CMakeLists.txt || makefile || sources; then break; fi
  folder=
  for entry in */; do
    case $entry in '*/' | __MACOSX/) continue ;; esac
    if [ -n "$folder" ]; then folder=; break; fi
    folder=$entry
  done
  if [ -z "$folder" ]; then break; fi
  cd "$folder"
done
build() {
  cmake -S "$1" -B playpen-build -DCMAKE_BUILD_TYPE=Release
  cmake --build playpen-build
}
if has CMakeLists.txt; then
  build .
elif makefile; then
  make -B
elif sources; then
  mkdir -p playpen-project
  cat > playpen-project/CMakeLists.txt <<'TEXT'
cmake_minimum_required(VERSION 3.22)
project(submission LANGUAGES C CXX)
find_package(playpen REQUIRED)
file(GLOB sources ../*.cpp ../*.cc ../*.cxx ../*.c)
add_executable(robot ${sources})
target_link_libraries(robot PRIVATE playpen::player m)
TEXT
  build playpen-project
else
  echo 'playpen: neither CMakeLists.txt, nor a makefile, nor sources (.cpp, .cc, .cxx, .c)'
  exit 1
fi
)";

/// The first bytes of a file that this machine can execute.
bool is_program(const fs::path& file) {
  const auto header_of = [](const fs::path& path) {
    Elf64_Ehdr header{};
    std::ifstream stream(path, std::ios::binary);
    stream.read(reinterpret_cast<char*>(&header), sizeof header);
    if (stream.gcount() != sizeof header) header = {};
    return header;
  };
  static const Elf64_Ehdr own = header_of("/proc/self/exe");
  const Elf64_Ehdr header = header_of(file);
  // A library has no interpreter, but to find that out takes more than the header; its name tells.
  return std::memcmp(header.e_ident, own.e_ident, EI_OSABI) == 0 &&
         header.e_machine == own.e_machine && (header.e_type == ET_EXEC || header.e_type == ET_DYN);
}

/// Removes a folder that a build has left, also if it has taken away the rights to do so.
void remove_tree(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error) return;
  if (!fs::is_symlink(folder, error)) {
    fs::permissions(folder, fs::perms::owner_all, fs::perm_options::add, error);
  }
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->symlink_status(error).type() != fs::file_type::directory) continue;
    fs::permissions(entry->path(), fs::perms::owner_all, fs::perm_options::add, error);
  }
  fs::remove_all(folder);
}

/// For the user of a sandbox of root, who is another one.
void let_everybody_write(const fs::path& folder) {
  constexpr fs::perms kReadAndWrite = fs::perms::owner_read | fs::perms::owner_write |
                                      fs::perms::group_read | fs::perms::group_write |
                                      fs::perms::others_read | fs::perms::others_write;
  fs::permissions(folder, fs::perms::all);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    fs::permissions(entry.path(), entry.is_directory() ? fs::perms::all : kReadAndWrite,
                    fs::perm_options::add);
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

SubmissionBuild::SubmissionBuild(const Submission& submission, fs::path folder,
                                 const BuildSettings& settings)
    : folder_(std::move(folder)), settings_(settings) {
  const fs::path source = folder_ / kSource;
  remove_tree(source);
  fs::create_directories(source);
  if (submission.is_archive) {
    archive_ = fs::absolute(submission.place);
  } else {
    obstacle_ = copy_sources(submission, source);
  }
  fs::permissions(folder_ / kPrivate, fs::perms::owner_all);
  if (geteuid() == 0) let_everybody_write(source);
  // The clock of the file system may be coarser than others.
  std::ofstream(folder_ / kLog, std::ios::trunc) << std::flush;
  start_ = fs::last_write_time(folder_ / kLog);
}

playerlike::ProgramJob SubmissionBuild::job() const {
  playerlike::ProgramJob job;
  if (settings_.launcher) {
    job.command =
        settings_.launcher(archive_.empty() ? std::vector<std::string>{}
                                            : std::vector<std::string>{archive_.string()});
  }
  job.command.insert(job.command.end(), {"/bin/sh", "-c", kScript, "build", archive_.string()});
  job.environment = settings_.environment;
  job.working_folder = fs::absolute(folder_ / kSource).string();
  job.output_file = (folder_ / kLog).string();
  job.output_limit = 1'000'000;
  job.folder = job.working_folder;
  job.folder_limit = kMostBuilt;
  return job;
}

Build SubmissionBuild::result(const playerlike::JobEnd& end) const {
  Build build;
  build.log = kLog;
  build.wall_time_s = end.wall_time_s;
  using Kind = playerlike::JobEnd::Kind;
  if (end.kind == Kind::kTimedOut) {
    build.reason = "compiling took more than " + sim::shortest_text(settings_.timeout_s) + " s";
  } else if (end.kind == Kind::kTooMuchOutput) {
    build.reason = "compiling wrote more than " + std::to_string(kMostBuilt / 1'000'000) + " MB";
    remove_tree(folder_ / kSource);
  } else if (end.kind != Kind::kEnded) {
    build.reason = "compiling was interrupted";
  } else if (!end.program.success()) {
    build.reason = "does not compile";
  }
  if (!build.reason.empty()) return build;
  std::vector<std::string> programs = find_programs(folder_ / kSource, start_);
  if (!settings_.program.empty()) {
    std::erase_if(programs, [this](const std::string& program) {
      return fs::path(program).filename() != settings_.program;
    });
  }
  if (programs.size() == 1) {
    build.built = true;
    build.program = (fs::path(kSource) / programs.front()).string();
  } else if (!programs.empty()) {
    build.reason = "compiles to several programs: " + listed(programs);
  } else if (settings_.program.empty()) {
    build.reason = "compiles, but to no program";
  } else {
    build.reason = "compiles, but to no program '" + settings_.program + "'";
  }
  return build;
}

fs::path source_folder(const fs::path& submission) { return submission / kSource; }

const char* build_commands() { return kScript; }

std::vector<std::string> find_programs(const fs::path& folder, fs::file_time_type oldest) {
  std::vector<std::string> programs;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::file_status status = entry->symlink_status(error);
    if (error) break;
    const std::string name = entry->path().filename().string();
    if (status.type() == fs::file_type::directory && name == "CMakeFiles") {
      entry.disable_recursion_pending();  // CMake tries compilers there
    }
    if (status.type() != fs::file_type::regular ||
        (status.permissions() & fs::perms::owner_exec) == fs::perms::none ||
        entry->last_write_time(error) < oldest || name.find(".so") != std::string::npos) {
      continue;
    }
    if (is_program(entry->path())) {
      programs.push_back(entry->path().lexically_relative(folder).string());
    }
  }
  std::sort(programs.begin(), programs.end());
  return programs;
}

}  // namespace playpen::course
