// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/submission.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/hash.h"
#include "sim/core/number_text.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

/// The values of a CSV text (RFC 4180), line by line.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // as spreadsheets write it
    const std::string_view first = text_.substr(0, text_.find('\n'));
    if (first.find(',') == std::string_view::npos) separator_ = ';';
  }

  [[nodiscard]] int line() const noexcept { return line_; }

  /// The next line that is not empty; nullopt: there is none.
  std::optional<std::vector<std::string>> next() {
    while (at_ < text_.size()) {
      std::vector<std::string> values = read_line();
      if (values.size() > 1 || !values.front().empty()) return values;
    }
    return std::nullopt;
  }

 private:
  std::vector<std::string> read_line() {
    line_ += 1 + breaks_;
    breaks_ = 0;
    std::vector<std::string> values(1);
    for (bool quoted = false; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (quoted && c == '"' && text_.substr(at_ + 1).starts_with('"')) {
        values.back() += text_[++at_];
      } else if (c == '"') {
        quoted = !quoted;
      } else if (quoted) {
        breaks_ += c == '\n' ? 1 : 0;
        values.back() += c;
      } else if (c == separator_) {
        values.emplace_back();
      } else if (c == '\n') {
        ++at_;
        break;
      } else if (c != '\r') {
        values.back() += c;
      }
    }
    return values;
  }

  std::string_view text_;
  char separator_ = ',';
  std::size_t at_ = 0;
  int line_ = 0;
  int breaks_ = 0;  ///< line breaks in values of the last line
};

std::string trimmed(std::string text) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(std::find_if_not(text.rbegin(), text.rend(), is_blank).base(), text.end());
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
  return text;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a name contains an id, not as a part of a longer word.
bool contains_word(const std::string& name, const std::string& id) {
  for (std::size_t at = name.find(id); at != std::string::npos; at = name.find(id, at + 1)) {
    const std::size_t end = at + id.size();
    if ((at == 0 || !is_word_character(name[at - 1])) &&
        (end == name.size() || !is_word_character(name[end]))) {
      return true;
    }
  }
  return false;
}

/// The name of an archive without its suffix; nullopt: it is none.
std::optional<std::string> stem_of_archive(const std::string& name) {
  for (const std::string& suffix : archive_suffixes()) {
    if (name.size() > suffix.size() && lower(name).ends_with(suffix)) {
      return name.substr(0, name.size() - suffix.size());
    }
  }
  return std::nullopt;
}

/// A name that is good for a folder, and for links to it.
std::string folder_name(const std::string& id) {
  std::string name;
  for (const char c : id) {
    name += is_word_character(c) || c == '-' || c == '_' || (c == '.' && !name.empty()) ? c : '_';
  }
  return name.empty() ? "_" : name;
}

[[noreturn]] void fail(const char* code, const fs::path& file, std::string expected,
                       std::string found, std::string hint = {}, int line = 0) {
  throw sim::ConfigError(sim::ConfigIssue{code, file.string(), "", std::move(expected),
                                          std::move(found), std::move(hint), line});
}

/// The person of the roster that the name of a submission belongs to.
const Person* find_person(const std::vector<Person>& roster, const std::string& name) {
  const Person* found = nullptr;
  for (const Person& person : roster) {
    if (person.id == name) return &person;
    const bool longer = found == nullptr || person.id.size() > found->id.size();
    if (longer && contains_word(name, person.id)) found = &person;
  }
  return found;
}

/// Calls a function with each regular file of a submission's folder and its path there, in the
/// order of their paths.
template <typename Function>
void for_each_file(const Submission& submission, const Function& function) {
  const fs::path& folder = submission.place;
  std::error_code error;
  std::vector<std::pair<std::string, fs::path>> files;
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::file_status status = entry->symlink_status();
    if (status.type() == fs::file_type::directory &&
        (entry->path().filename() == ".git" ||
         (!submission.left_out.empty() &&
          fs::equivalent(entry->path(), submission.left_out, error)))) {
      entry.disable_recursion_pending();
    }
    if (status.type() != fs::file_type::regular) continue;
    files.emplace_back(entry->path().lexically_relative(folder).string(), entry->path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& [name, file] : files) function(name, file);
}

}  // namespace

const std::vector<std::string>& archive_suffixes() {
  static const std::vector<std::string> suffixes = {".zip",    ".tar",     ".tar.gz", ".tgz",
                                                    ".tar.xz", ".tar.bz2", ".tar.zst"};
  return suffixes;
}

std::vector<Person> read_roster(const fs::path& file) {
  std::string text;
  if (const auto error = sim::read_whole_file(file.string(), {}, text)) {
    fail("class/roster", file, "a CSV file with the people of the class", error->found);
  }
  return read_roster_text(text, file.string());
}

std::vector<Person> read_roster_text(const std::string& text, const std::string& file) {
  CsvReader reader(text);
  std::vector<std::string> columns = reader.next().value_or(std::vector<std::string>{});
  for (std::string& column : columns) column = lower(trimmed(column));
  const auto place_of = [&columns](const char* name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  const std::size_t id = place_of("id");
  const std::size_t name = place_of("name");
  if (id == columns.size()) {
    fail("class/roster", file, "a first line that names the columns, one of them \"id\"",
         columns.empty() ? "an empty file" : "no column \"id\"", "for example: id,name", 1);
  }
  std::vector<Person> people;
  std::map<std::string, int> lines;
  while (const auto values = reader.next()) {
    Person person;
    if (id < values->size()) person.id = trimmed((*values)[id]);
    if (name < values->size()) person.name = trimmed((*values)[name]);
    if (person.id.empty()) fail("class/roster", file, "an id", "none", {}, reader.line());
    const auto [known, is_new] = lines.emplace(person.id, reader.line());
    if (!is_new) {
      fail("class/roster", file, "different ids",
           "'" + person.id + "', which line " + std::to_string(known->second) + " has, too", {},
           reader.line());
    }
    people.push_back(std::move(person));
  }
  return people;
}

std::vector<Submission> find_submissions(const fs::path& folder,
                                         const std::vector<Person>& roster) {
  std::error_code error;
  std::map<std::string, Submission> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::string name = entry->path().filename().string();
    const fs::file_type type = entry->symlink_status().type();
    Submission submission;
    submission.place = entry->path();
    if (name.starts_with('.')) continue;
    if (type == fs::file_type::regular) {
      const std::optional<std::string> stem = stem_of_archive(name);
      if (!stem) continue;
      name = *stem;
      submission.is_archive = true;
    } else if (type != fs::file_type::directory) {
      continue;
    }
    const Person* person = find_person(roster, name);
    submission.person = person != nullptr ? *person : Person{name, ""};
    const std::string id = submission.person.id;
    const auto [known, is_new] = found.emplace(id, std::move(submission));
    if (!is_new) {
      fail("class/same-id", folder, "one submission of each person",
           "'" + known->second.place.filename().string() + "' and '" +
               entry->path().filename().string() + "', both of '" + id + "'");
    }
  }
  if (error) {
    fail("class/submissions", folder, "a folder with submissions", error.message());
  }
  if (found.empty()) {
    fail("class/submissions", folder, "a folder or an archive for each submission", "none",
         "archives are .zip and .tar files");
  }
  for (const Person& person : roster)
    found.emplace(person.id, Submission{person, {}, {}, false, {}});
  std::vector<Submission> submissions;
  for (auto& [id, submission] : found) submissions.push_back(std::move(submission));
  name_folders(submissions);
  return submissions;
}

void name_folders(std::vector<Submission>& submissions) {
  std::set<std::string> taken;
  for (Submission& submission : submissions) {
    const std::string name = folder_name(submission.person.id);
    submission.folder = name;
    for (int i = 2; !taken.insert(lower(submission.folder)).second; ++i) {
      submission.folder = name + "_" + std::to_string(i);
    }
  }
}

Submission one_submission(const fs::path& place, const std::string& id, const fs::path& left_out) {
  std::error_code error;
  Submission submission;
  submission.place = fs::canonical(place, error);
  submission.left_out = left_out;
  std::string name = submission.place.filename().string();
  const std::optional<std::string> stem = stem_of_archive(name);
  if (fs::is_regular_file(submission.place, error) && stem) {
    submission.is_archive = true;
    name = *stem;
  } else if (!fs::is_directory(submission.place, error)) {
    fail("class/submissions", place, "a folder or an archive",
         error ? error.message() : "another file", "archives are .zip and .tar files");
  }
  submission.person.id = id.empty() ? name : id;
  submission.folder = folder_name(submission.person.id);
  return submission;
}

std::string fingerprint_of(const Submission& submission) {
  sim::StateHash hash;
  const auto add = [&hash](const std::string& name, const fs::path& file) {
    hash.add(std::string_view(name));
    std::string content;
    sim::FileLimits limits;
    limits.most_bytes = kMostSubmittedBytes;
    // An unreadable file of a submission is found by whoever copies it.
    if (sim::read_whole_file(file.string(), limits, content)) content = "unreadable";
    hash.add(std::string_view(content));
  };
  if (submission.is_archive) {
    add(submission.place.filename().string(), submission.place);
  } else if (!submission.place.empty()) {
    for_each_file(submission, add);
  }
  return sim::hexadecimal_text(hash.value(), 16);
}

std::string copy_sources(const Submission& submission, const fs::path& to) {
  std::uintmax_t bytes = 0;
  std::size_t files = 0;
  std::string problem;
  try {
    for_each_file(submission, [&](const std::string& name, const fs::path& file) {
      if (!problem.empty()) return;
      bytes += fs::file_size(file);
      if (bytes > kMostSubmittedBytes || ++files > kMostSubmittedFiles) {
        problem = "more than " + std::to_string(kMostSubmittedBytes / 1'000'000) + " MB or " +
                  std::to_string(kMostSubmittedFiles) + " files";
        return;
      }
      fs::create_directories((to / name).parent_path());
      fs::copy_file(file, to / name, fs::copy_options::overwrite_existing);
      fs::last_write_time(to / name, fs::last_write_time(file));
    });
  } catch (const fs::filesystem_error& error) {
    problem = std::string("a file cannot be read: ") + error.what();
  }
  return problem;
}

}  // namespace playpen::course
