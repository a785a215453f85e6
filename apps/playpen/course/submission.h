// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace playpen::course {

/// A person of a class.
struct Person {
  std::string id;
  std::string name;  ///< "": unknown
};

/// What one person has handed in.
struct Submission {
  Person person;
  std::filesystem::path place;  ///< a folder, or an archive; "": the person has handed in nothing
  std::string folder;           ///< name for a folder of its files, different for each
  bool is_archive = false;
  std::filesystem::path left_out;  ///< a folder in it that is no part of it; "": none
};

/// The suffixes of archives: ".zip", ".tar", ".tar.gz" and others.
[[nodiscard]] const std::vector<std::string>& archive_suffixes();

/// Reads a roster: a CSV file with the columns "id" and, if names are known, "name". Its first line
/// names the columns; others are ignored. Commas or semicolons separate values, which may be in
/// double quotes (RFC 4180).
/// @throws sim::ConfigError with file, line and problem.
[[nodiscard]] std::vector<Person> read_roster(const std::filesystem::path& file);
/// The same for a text; `file` is its name in messages.
[[nodiscard]] std::vector<Person> read_roster_text(const std::string& text,
                                                   const std::string& file);

/// Finds the submissions in a folder: each folder and each archive directly in it. Hidden entries,
/// symbolic links and other files are none. The id is the one of the roster that the name of the
/// folder or archive contains as a word ("Ada_Byron_4711_assignsubmission_file" contains 4711), or
/// else the name itself. Who is in the roster without a submission is in the result, too.
/// @return ordered by id.
/// @throws sim::ConfigError if the folder cannot be read or has no submission, or if two
///         submissions have the same id.
[[nodiscard]] std::vector<Submission> find_submissions(const std::filesystem::path& folder,
                                                       const std::vector<Person>& roster);

/// The submission of one person: a folder or an archive.
/// @param id        "": the name of the folder or archive.
/// @param left_out  a folder in it that is no part of it, such as that of the results.
/// @throws sim::ConfigError if it is neither.
[[nodiscard]] Submission one_submission(const std::filesystem::path& place, const std::string& id,
                                        const std::filesystem::path& left_out);

/// Gives each submission a name for its folder that differs from those of the others.
void name_folders(std::vector<Submission>& submissions);

/// A text that is different if any name or content of a submission is. Symbolic links and special
/// files do not count.
/// @throws std::runtime_error if a file cannot be read.
[[nodiscard]] std::string fingerprint_of(const Submission& submission);

/// Limits of a submission's own files.
inline constexpr std::uintmax_t kMostSubmittedBytes = 100'000'000;
inline constexpr std::size_t kMostSubmittedFiles = 10'000;

/// Copies the regular files of a submission that is a folder. Symbolic links and special files, and
/// folders called ".git", are left out.
/// @return what was wrong, for people; "": all is there.
[[nodiscard]] std::string copy_sources(const Submission& submission,
                                       const std::filesystem::path& to);

}  // namespace playpen::course
