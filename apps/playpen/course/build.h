// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "course/class_result.h"
#include "course/submission.h"
#include "playerlike/host/program.h"

namespace playpen::course {

/// How submissions are compiled.
struct BuildSettings {
  double timeout_s = 300.0;                    ///< wall-clock limit of each
  std::string program;                         ///< file name of the program; "": any
  playerlike::EnvironmentChanges environment;  ///< by which build tools find Playpen
  /// Words before a command that compiles something in its working folder, and may read these
  /// files besides: a sandbox. No words: none.
  std::function<std::vector<std::string>(const std::vector<std::string>& readable)> launcher;
};

/// Compiles a submission: copies its files, or unpacks them, into a folder of its own, and builds
/// the project that it finds there:
/// - a file CMakeLists.txt: with CMake;
/// - otherwise a makefile: with make;
/// - otherwise sources (.cpp, .cc, .cxx, .c): as one program that is linked with Playpen.
/// If the uppermost folder contains none of these, but a single folder, that one is looked at.
class SubmissionBuild {
 public:
  /// @param folder      of the submission's files; gets "build" and "build.log".
  /// @param settings    must outlive this object.
  /// @throws std::exception if the folder cannot be prepared.
  SubmissionBuild(const Submission& submission, std::filesystem::path folder,
                  const BuildSettings& settings);

  /// Why it cannot even be tried; "": it can.
  [[nodiscard]] const std::string& obstacle() const noexcept { return obstacle_; }
  /// What compiles it, for playerlike::run_programs().
  [[nodiscard]] playerlike::ProgramJob job() const;
  /// What came of it.
  [[nodiscard]] Build result(const playerlike::JobEnd& end) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path archive_;  ///< "": none
  std::string obstacle_;
  const BuildSettings& settings_;
  std::filesystem::file_time_type start_;
};

/// The folder of the sources of a submission, and of what they are compiled to.
[[nodiscard]] std::filesystem::path source_folder(const std::filesystem::path& submission);

/// The shell's commands that compile a submission.
[[nodiscard]] const char* build_commands();

/// The programs below a folder that this machine can run, except for those that are older than a
/// time: paths from the folder, in order. Links are not followed.
[[nodiscard]] std::vector<std::string> find_programs(const std::filesystem::path& folder,
                                                     std::filesystem::file_time_type oldest);

}  // namespace playpen::course
