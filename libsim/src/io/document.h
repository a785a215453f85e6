// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/reader.h"

namespace sim::io {

/// Limits of a document: no honest world comes near them, and nothing beyond them is worth the
/// memory.
inline constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;
inline constexpr int kMaxDepth = 32;
inline constexpr std::size_t kMaxValues = 2'000'000;
inline constexpr std::size_t kMaxIssues = 100;

/// A JSON value that remembers what nlohmann::json forgets: the order of keys, keys that occur
/// twice, how a number was written, and the line it stands in.
struct Reader::Value {
  enum class Kind : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };
  enum class NumberKind : std::uint8_t { kSigned, kUnsigned, kReal };

  Kind kind = Kind::kNull;
  NumberKind number_kind = NumberKind::kReal;
  bool boolean = false;
  int line = 0;                 ///< where it ends (scalars) or opens (objects, arrays)
  int key_line = 0;             ///< where its key stands, if it is a member
  double real = 0.0;            ///< of every number
  std::int64_t integer = 0;     ///< of a number of kind kSigned
  std::uint64_t natural = 0;    ///< of a number of kind kUnsigned
  std::string text;             ///< a string's content; a number as written
  std::string key;              ///< of a member
  std::vector<Value> children;  ///< members or elements, in the file's order
};

struct Reader::Document {
  std::string file;
  std::string what = "world";  ///< what the file holds, for messages
  Value root;
  std::vector<ConfigIssue> issues;
  /// Whether messages may show parts of the text. Not of a text that does not begin as a JSON
  /// object does: a world may name any file as a model, and what that holds must not be in the
  /// message.
  bool may_quote = true;

  /// Adds an issue; after kMaxIssues, one last that says so, and then none.
  void add(ConfigIssue issue);
  [[nodiscard]] bool full() const { return issues.size() > kMaxIssues; }

  /// Line of the value at `pointer`, or of the nearest enclosing one that exists; 0 if none.
  [[nodiscard]] int line_of(std::string_view pointer) const;

  /// Whether an issue of this file concerns the value at `pointer`: one within it, or of a whole it
  /// is in.
  [[nodiscard]] bool has_issue_at(std::string_view pointer) const;
};

/// Parses JSON with comments into document.root; document.file is set already.
/// @return false if the text is no JSON; then at least one issue says why.
bool parse_document(std::string_view text, Reader::Document& document);

/// Who has named a file: a pipe is read only if the user has named it.
enum class NamedBy : std::uint8_t { kUser, kFile };

/// Reads a file's content.
/// @param what  the file is expected to be, for messages.
/// @return false and an issue if it cannot be had.
bool read_file(const std::string& path, std::string& text, Reader::Document& document,
               const char* what = "a world file", NamedBy named_by = NamedBy::kUser);

/// The folder that names in a file are relative to: its own; of what came through a pipe
/// (/dev/stdin, /dev/fd/N), the current one.
[[nodiscard]] std::filesystem::path folder_of(const std::string& file);

/// Throws what was found, in the order of the file's lines, that of other files that it names after
/// its own; returns if that is nothing.
void throw_issues(Reader::Document& document);

/// One part of a JSON pointer, with '~' and '/' escaped (RFC 6901, section 3).
std::string escape_pointer_part(std::string_view part);

/// A number as a person writes it: 2, 0.05, 1e+20.
std::string number_text(double value);

/// "a, b or c".
std::string list_text(const std::vector<std::string>& words, const char* last_joint = " or ");

/// Text in quotes, shortened to about 40 bytes.
std::string in_quotes(std::string_view text);

}  // namespace sim::io
