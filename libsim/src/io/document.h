// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/reader.h"

namespace sim::io {

/// Limits of a document, far beyond any realistic world, to bound the use of memory.
inline constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;
inline constexpr int kMaxDepth = 32;
inline constexpr std::size_t kMaxValues = 2'000'000;
inline constexpr std::size_t kMaxIssues = 100;

/// A JSON value with details that nlohmann::json does not keep: the order of keys, duplicate keys,
/// the notation of a number, and the line in the file.
struct Reader::Value {
  enum class Kind : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };
  enum class NumberKind : std::uint8_t { kSigned, kUnsigned, kReal };

  Kind kind = Kind::kNull;
  NumberKind number_kind = NumberKind::kReal;
  bool boolean = false;
  int line = 0;                 ///< of its end (scalars) or opening bracket (objects, arrays)
  int key_line = 0;             ///< of its key, if it is a member
  double real = 0.0;            ///< of every number
  std::int64_t integer = 0;     ///< of a number of kind kSigned
  std::uint64_t natural = 0;    ///< of a number of kind kUnsigned
  std::string text;             ///< content of a string; notation of a number
  std::string key;              ///< if it is a member
  std::vector<Value> children;  ///< members or elements, in the file's order
};

struct Reader::Document {
  std::string file;
  std::string what = "world";  ///< what the file contains, for messages
  Value root;
  std::vector<ConfigIssue> issues;
  /// Whether messages may quote the text. False for a text that does not begin like a JSON object:
  /// a world may name any file as a model, and the content of such a file must not leak into
  /// messages.
  bool may_quote = true;
  /// Files that the document may name besides those on disk: name -> content. Null: none.
  const std::map<std::string, std::string>* files = nullptr;

  /// Adds an issue. After kMaxIssues it adds one last issue that says so, and ignores all later
  /// ones.
  void add(ConfigIssue issue);
  [[nodiscard]] bool full() const { return issues.size() > kMaxIssues; }

  /// Line of the value at `pointer`, or of the nearest enclosing one that exists; 0 if none.
  [[nodiscard]] int line_of(std::string_view pointer) const;

  /// Whether an issue of this file concerns the value at `pointer`, a part of it, or a value that
  /// contains it.
  [[nodiscard]] bool has_issue_at(std::string_view pointer) const;
};

/// Parses JSON with comments into document.root; document.file must be set before.
/// @return false if the text is not valid JSON; at least one issue then says why.
bool parse_document(std::string_view text, Reader::Document& document);

/// Where the name of a file comes from. Pipes are read only if the user has named them.
enum class NamedBy : std::uint8_t { kUser, kFile };

/// Reads a file's content.
/// @param what  the expected kind of file, for messages.
/// @return false, with an issue, if the file cannot be read.
bool read_file(const std::string& path, std::string& text, Reader::Document& document,
               const char* what = "a world file", NamedBy named_by = NamedBy::kUser);

/// The folder that relative names in a file refer to: its own folder, or the current one for a pipe
/// (/dev/stdin, /dev/fd/N).
[[nodiscard]] std::filesystem::path folder_of(const std::string& file);

/// Throws all issues, in the order of the file's lines; issues of other files that it names come
/// after its own. Returns if there are none.
void throw_issues(Reader::Document& document);

/// One part of a JSON pointer, with '~' and '/' escaped (RFC 6901, section 3).
std::string escape_pointer_part(std::string_view part);

/// A number in everyday notation: 2, 0.05, 1e+20.
std::string number_text(double value);

/// "a number greater than 0 and at most 100 m".
std::string describe_range(const NumberRange& range);

/// "a, b or c".
std::string list_text(const std::vector<std::string>& words, const char* last_joint = " or ");

/// Text in quotes, shortened to about 40 bytes.
std::string in_quotes(std::string_view text);

}  // namespace sim::io
