// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace sim::io {
namespace {

using Value = Reader::Value;

/// Passes the text to the parser and records how far it has read, since SAX events carry no
/// position.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}

  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *furthest_ = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) {
    return a.at_ == b.at_;
  }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) { return !(a == b); }

 private:
  const char* at_;
  const char** furthest_;
};

/// Position of the byte at `offset`: line and column from 1.
std::pair<int, int> line_and_column(std::string_view text, std::size_t offset) {
  offset = std::min(offset, text.size());
  int line = 1;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < offset; ++i) {
    if (text[i] == '\n') {
      ++line;
      line_start = i + 1;
    }
  }
  return {line, static_cast<int>(offset - line_start) + 1};
}

/// The line that contains `offset`, without indentation; for a long line, the part around `offset`.
std::string line_text(std::string_view text, std::size_t offset) {
  constexpr std::size_t kAround = 40;
  offset = std::min(offset, text.size());
  std::size_t begin = offset;
  while (begin > 0 && text[begin - 1] != '\n' && offset - begin < kAround) --begin;
  std::size_t end = offset;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r' && end - offset < kAround) {
    ++end;
  }
  // Do not start in the middle of a UTF-8 sequence.
  while (begin < end && (static_cast<unsigned char>(text[begin]) & 0xC0U) == 0x80U) ++begin;
  while (begin < end && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
  while (end < text.size() && end > begin &&
         (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
    --end;
  }
  return std::string(text.substr(begin, end - begin));
}

/// Whether a character may be part of a word or number.
bool is_word_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '+' || c == '-' || c == '.';
}

/// The first 40 bytes or fewer, in whole characters.
std::string shortened(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.size() <= kLongest) return std::string(text);
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return std::string(text.substr(0, end)) + "...";
}

/// Builds the document from the parser's events.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(std::string_view text, const char** furthest, Reader::Document& document)
      : text_(text), furthest_(furthest), document_(document), counted_(text.data()) {}

  bool null() override { return put({}) != nullptr; }

  bool boolean(bool value) override {
    Value v;
    v.kind = Value::Kind::kBoolean;
    v.boolean = value;
    return put(std::move(v)) != nullptr;
  }

  bool number_integer(number_integer_t value) override {
    Value v;
    v.kind = Value::Kind::kNumber;
    v.number_kind = Value::NumberKind::kSigned;
    v.integer = value;
    v.real = static_cast<double>(value);
    v.text = std::to_string(value);
    return put(std::move(v), true) != nullptr;
  }

  bool number_unsigned(number_unsigned_t value) override {
    Value v;
    v.kind = Value::Kind::kNumber;
    v.number_kind = Value::NumberKind::kUnsigned;
    v.natural = value;
    v.real = static_cast<double>(value);
    v.text = std::to_string(value);
    return put(std::move(v), true) != nullptr;
  }

  bool number_float(number_float_t value, const string_t& as_written) override {
    Value v;
    v.kind = Value::Kind::kNumber;
    v.real = value;
    v.text = as_written;
    // The parser replaces JSON's point by the separator of the program's locale, e.g. a comma.
    for (char& c : v.text) {
      if (std::string_view("0123456789+-eE").find(c) == std::string_view::npos) c = '.';
    }
    return put(std::move(v), true) != nullptr;
  }

  bool string(string_t& value) override {
    Value v;
    v.kind = Value::Kind::kString;
    v.text = std::move(value);
    return put(std::move(v)) != nullptr;
  }

  bool binary(binary_t& /*value*/) override { return false; }  // does not occur in text

  bool start_object(std::size_t /*elements*/) override { return open(Value::Kind::kObject); }
  bool start_array(std::size_t /*elements*/) override { return open(Value::Kind::kArray); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    Level& level = levels_.back();
    key_ = std::move(value);
    key_line_ = current_line(false);
    if (!level.keys.insert(key_).second) {
      const auto first = std::find_if(level.value->children.begin(), level.value->children.end(),
                                      [this](const Value& member) { return member.key == key_; });
      ConfigIssue issue{"json/duplicate-key",
                        document_.file,
                        pointer_here(),
                        "each key once in an object",
                        in_quotes(key_) + " a second time (first in line " +
                            std::to_string(first->key_line) + ")",
                        "keep one of the two"};
      issue.line = key_line_;
      document_.add(std::move(issue));
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::json::exception& error) override {
    // The parser counts a line break that it has read after a number; the token ends before it.
    std::size_t at = position == 0 ? 0 : position - 1;
    const std::string what = error.what();
    ConfigIssue issue;
    issue.file = document_.file;
    if (dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr) {
      issue.id = "json/number-overflow";
      issue.pointer = pointer_here();
      issue.expected = "a number that a computer can hold (up to about 1.8e308)";
      issue.found = shortened(token);
    } else if (complete_) {
      issue.id = "json/trailing-garbage";
      issue.expected = "the end of the file after the outermost }";
      issue.found = "more text: " + line_text(text_, at);
      issue.hint = "a " + document_.what + " file holds one object; delete what follows it";
    } else if (!started_ && what.find("end of input") != std::string::npos) {
      issue.id = "file/empty";
      issue.expected = document_.what == "world"
                           ? "a world, for example {} (the default arena with one robot)"
                           : "a " + document_.what;
      issue.found = "nothing but blanks and comments";
      at = text_.size();
    } else {
      issue.id = "json/syntax";
      explain_syntax(what, token, at, issue);
    }
    if (issue.id != "file/empty") {
      std::tie(issue.line, issue.column) = line_and_column(text_, at);
      if (!document_.may_quote) {
        issue.found = "a text that does not begin with '{'";
        issue.hint = "is this a " + document_.what + " file? Its lines are not shown";
      }
    }
    document_.add(std::move(issue));
    return false;
  }

 private:
  struct Level {
    Value* value;
    std::unordered_set<std::string> keys;  ///< of an object, read so far
  };

  /// Line of the last byte read. The parser reads one byte past a number to see its end.
  int current_line(bool past_end) {
    const char* end = *furthest_;
    if (past_end && end > text_.data() && end[-1] == '\n') --end;
    if (end > counted_) {
      line_ += static_cast<int>(std::count(counted_, end, '\n'));
      counted_ = end;
    }
    return line_;
  }

  /// Pointer of the next value.
  [[nodiscard]] std::string pointer_here() const {
    std::string pointer;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const Value& container = *levels_[i].value;
      const bool innermost = i + 1 == levels_.size();
      if (container.kind == Value::Kind::kArray) {
        const std::size_t count = container.children.size();
        pointer += '/' + std::to_string(innermost ? count : count - 1);
      } else {
        pointer += '/' + escape_pointer_part(innermost ? key_ : container.children.back().key);
      }
    }
    return pointer;
  }

  Value* put(Value value, bool past_end = false) {
    started_ = true;
    if (++count_ > kMaxValues) {
      ConfigIssue issue{"file/too-large",
                        document_.file,
                        "",
                        "at most " + std::to_string(kMaxValues) + " values",
                        "more",
                        ""};
      document_.add(std::move(issue));
      return nullptr;
    }
    value.line = current_line(past_end);
    if (levels_.empty()) {
      document_.root = std::move(value);
      complete_ = true;
      return &document_.root;
    }
    Value& container = *levels_.back().value;
    if (container.kind == Value::Kind::kObject) {
      value.key = std::move(key_);
      value.key_line = key_line_;
    }
    container.children.push_back(std::move(value));
    return &container.children.back();
  }

  bool open(Value::Kind kind) {
    if (levels_.size() == static_cast<std::size_t>(kMaxDepth)) {
      ConfigIssue issue{
          "json/too-deep", document_.file,
          pointer_here(),  "at most " + std::to_string(kMaxDepth) + " levels of { and [",
          "one more",      "no part of a " + document_.what + " needs so many"};
      issue.line = current_line(false);
      document_.add(std::move(issue));
      return false;
    }
    Value v;
    v.kind = kind;
    Value* placed = put(std::move(v));
    if (placed == nullptr) return false;
    levels_.push_back({placed, {}});
    complete_ = false;
    return true;
  }

  bool close() {
    levels_.pop_back();
    complete_ = levels_.empty();
    return true;
  }

  /// Translates the parser's message into plain words.
  void explain_syntax(const std::string& what, const std::string& token, std::size_t at,
                      ConfigIssue& issue) const {
    const auto says = [&what](const char* words) { return what.find(words) != std::string::npos; };
    const bool in_key = says("while parsing object key");
    const bool in_value = says("while parsing value");
    bool wants_comma = false;
    if (in_key) {
      issue.expected = "a key in double quotes";
    } else if (says("while parsing object separator")) {
      issue.expected = "':' after the key";
    } else if (in_value) {
      issue.expected = "a value: a number, \"text\", true, false, null, {...} or [...]";
    } else if (says("while parsing array")) {
      issue.expected = "',' or ']' after an element";
      wants_comma = true;
    } else if (says("while parsing object")) {
      issue.expected = "',' or '}' after a value";
      wants_comma = true;
    } else {
      issue.expected = "correct JSON";
    }

    if (says("unexpected end of input") || at >= text_.size()) {
      issue.found = "the end of the file";
      if (!levels_.empty()) {
        issue.hint = "is a } or ] missing? The innermost that is open was opened in line " +
                     std::to_string(levels_.back().value->line);
      }
      return;
    }
    if (text_[at] == '\n' || text_[at] == '\r') {
      issue.found = "the end of the line: " + line_text(text_, at);
      issue.hint = "a text ends with a double quote in the same line";
      return;
    }
    // In a wrong word ("tru"), the error position is the first wrong letter or the character after
    // it.
    if (says("invalid literal") && at > 0 && !is_word_part(text_[at]) &&
        is_word_part(text_[at - 1])) {
      --at;
    }
    // The parser's last token includes preceding brackets, so the token is determined here.
    const bool is_text = says("unexpected string literal");
    std::size_t begin = at;
    std::size_t end = at + 1;
    if (is_text) {
      begin = at + 1 >= token.size() ? at + 1 - token.size() : 0;
    } else if (is_word_part(text_[at])) {
      while (begin > 0 && is_word_part(text_[begin - 1])) --begin;
      while (end < text_.size() && is_word_part(text_[end])) ++end;
    }
    issue.found = is_text ? shortened(text_.substr(begin, end - begin))
                          : "'" + shortened(text_.substr(begin, end - begin)) + "'";
    issue.found += " in the line: " + line_text(text_, at);
    std::size_t before = begin;
    while (before > 0 && std::string_view(" \t\r\n").find(text_[before - 1]) != std::string::npos) {
      --before;
    }
    const char last = before > 0 ? text_[before - 1] : '\0';
    const char first = text_[begin];
    if (last == ',' && (first == '}' || first == ']')) {
      issue.hint = "remove the comma before it";
    } else if (first == '\'') {
      issue.hint = "JSON has double quotes only";
    } else if (wants_comma &&
               (first == '"' || first == '{' || first == '[' || is_word_part(first))) {
      issue.hint = "is a comma missing before it?";
    } else if (wants_comma && (first == '}' || first == ']')) {
      issue.hint = std::string("the ") + (first == '}' ? '[' : '{') + " of line " +
                   std::to_string(levels_.back().value->line) + " is still open";
    } else if (in_value && (first == 'N' || first == 'n' || first == 'I' || first == 'i')) {
      issue.hint = "NaN and Infinity are no numbers of JSON";
    }
  }

  std::string_view text_;
  const char** furthest_;
  Reader::Document& document_;
  std::vector<Level> levels_;
  std::string key_;
  int key_line_ = 0;
  const char* counted_;
  int line_ = 1;
  std::size_t count_ = 0;
  bool started_ = false;
  bool complete_ = false;
};

/// JSON files in the folder of `path`, sorted by name.
std::vector<std::string> neighbours(const std::filesystem::path& path) {
  constexpr std::size_t kMaxLooked = 1000;
  std::set<std::string> names;
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::size_t looked = 0;
  for (std::filesystem::directory_iterator it(folder, error), end;
       !error && it != end && looked < kMaxLooked; it.increment(error), ++looked) {
    if (it->path().extension() == ".json") names.insert(it->path().filename().string());
  }
  return {names.begin(), names.end()};
}

}  // namespace

void Reader::Document::add(ConfigIssue issue) {
  if (full()) return;
  if (issues.size() == kMaxIssues) {
    issues.push_back({"file/too-many-errors", file, "", "a file with fewer errors",
                      "more than " + std::to_string(kMaxIssues) + "; the rest is not shown",
                      "mend the first ones and check again"});
    return;
  }
  issues.push_back(std::move(issue));
}

int Reader::Document::line_of(std::string_view pointer) const {
  const Value* value = &root;
  int line = value->line;
  while (!pointer.empty()) {
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    const std::string_view part = pointer.substr(1, end - 1);
    pointer.remove_prefix(end);
    const Value* next = nullptr;
    if (value->kind == Value::Kind::kObject) {
      for (const Value& member : value->children) {
        if (escape_pointer_part(member.key) == part) {
          next = &member;
          break;
        }
      }
    } else if (value->kind == Value::Kind::kArray) {
      std::size_t index = 0;
      const auto [ptr, error] = std::from_chars(part.data(), part.data() + part.size(), index);
      if (error == std::errc() && index < value->children.size()) next = &value->children[index];
    }
    if (next == nullptr) break;
    value = next;
    line = value->line;
  }
  return line;
}

bool Reader::Document::has_issue_at(std::string_view pointer) const {
  const auto encloses = [](std::string_view outer, std::string_view inner) {
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
  };
  return std::any_of(issues.begin(), issues.end(), [&](const ConfigIssue& issue) {
    // Issues of other files that this one names have pointers into those files.
    return issue.file == file &&
           (encloses(pointer, issue.pointer) || encloses(issue.pointer, pointer));
  });
}

namespace {

/// Whether a text looks like a JSON object: the first character after blanks and comments is '{'.
bool begins_as_object(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    at = text.find_first_not_of(" \t\r\n", at);
    if (at == std::string_view::npos) return false;
    const std::string_view rest = text.substr(at);
    std::size_t end = 0;
    if (rest.starts_with("//")) {
      end = rest.find('\n');
    } else if (rest.starts_with("/*")) {
      end = rest.find("*/", 2);
      if (end != std::string_view::npos) end += 2;
    } else {
      return rest.front() == '{';
    }
    if (end == std::string_view::npos) return false;
    at += end;
  }
}

}  // namespace

bool parse_document(std::string_view text, Reader::Document& document) {
  if (const std::size_t bad = find_invalid_utf8(text); bad != std::string_view::npos) {
    const auto byte = static_cast<unsigned char>(text[bad]);
    ConfigIssue issue{"json/invalid-utf8",
                      document.file,
                      "",
                      "text in UTF-8",
                      "the byte 0x" + hexadecimal_text(byte, 2) + ", which begins no character",
                      "save the file with the encoding UTF-8"};
    std::tie(issue.line, issue.column) = line_and_column(text, bad);
    document.add(std::move(issue));
    return false;
  }
  document.may_quote = begins_as_object(text);
  const char* furthest = text.data();
  Builder builder(text, &furthest, document);
  // "strict" refuses text after the value; the parser skips comments.
  const bool sound =
      nlohmann::json::sax_parse(CountingIterator(text.data(), &furthest),
                                CountingIterator(text.data() + text.size(), &furthest), &builder,
                                nlohmann::json::input_format_t::json, true, true);
  // A text or a number as the whole document would be quoted in messages.
  if (!document.may_quote) document.root.text = "...";
  return sound;
}

bool read_file(const std::string& path, std::string& text, Reader::Document& document,
               const char* what, NamedBy named_by) {
  namespace fs = std::filesystem;
  const auto fail = [&](const char* id, const char* expected, std::string found, std::string hint) {
    document.add({id, document.file, "", expected, std::move(found), std::move(hint)});
    return false;
  };
  const auto problem = read_whole_file(
      path, {.most_bytes = kMaxFileBytes, .pipes = named_by == NamedBy::kUser}, text);
  if (!problem) return true;
  std::error_code error;
  switch (problem->fault) {
    case FileFault::kMissing: {
      const std::string near = nearest_word(fs::path(path).filename().string(), neighbours(path));
      return fail("file/missing", what, "no file of that name",
                  near.empty() ? "the name is relative to the folder " +
                                     in_quotes(fs::current_path(error).string())
                               : "did you mean \"" + near + "\"?");
    }
    case FileFault::kFolder: {
      const std::vector<std::string> names = neighbours(fs::path(path) / "x");
      return fail(
          "file/not-a-file", what, "a folder",
          names.empty() ? "" : "name a file in it, for example " + in_quotes(names.front()));
    }
    case FileFault::kNotRegular:
      return fail("file/not-a-file", what, problem->found,
                  named_by == NamedBy::kFile
                      ? "a file that another one names must be a regular file"
                      : "name a regular file, or a pipe as in <(program)");
    case FileFault::kNoPermission:
      return fail("file/unreadable", "a file that can be read", problem->found,
                  "look at its owner and mode with ls -l");
    case FileFault::kLinkLoop:
      return fail("file/unreadable", "a file that can be read", problem->found,
                  "ls -l shows where each link leads; replace one of them by the file");
    case FileFault::kTooLarge:
      return fail("file/too-large", "a file of at most 16 MiB", "a larger one",
                  std::string("is this ") + what + '?');
    case FileFault::kSilent:
      return fail("file/unreadable", what, problem->found,
                  "does the program that writes into it still run?");
    case FileFault::kOther:
      break;
  }
  return fail("file/unreadable", "a file that can be read", problem->found, "");
}

std::filesystem::path folder_of(const std::string& file) {
  std::filesystem::path folder = std::filesystem::path(file).parent_path();
  const bool through_pipe =
      folder == "/dev/fd" || folder == "/proc/self/fd" || file == "/dev/stdin";
  return through_pipe ? std::filesystem::path() : folder;
}

void throw_issues(Reader::Document& document) {
  if (document.issues.empty()) return;
  const auto line = [](const ConfigIssue& issue) {
    return issue.line == 0 ? std::numeric_limits<int>::max() : issue.line;
  };
  std::stable_sort(document.issues.begin(), document.issues.end(),
                   [&](const ConfigIssue& a, const ConfigIssue& b) {
                     const bool other_a = a.file != document.file;
                     const bool other_b = b.file != document.file;
                     if (other_a != other_b) return other_b;
                     if (other_a && a.file != b.file) return a.file < b.file;
                     return line(a) < line(b);
                   });
  throw ConfigError(std::move(document.issues));
}

std::string escape_pointer_part(std::string_view part) {
  std::string escaped;
  for (const char c : part) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string number_text(double value) {
  char buffer[64];
  // Use no exponent for numbers that people write without one.
  const double magnitude = std::abs(value);
  const bool plain = value == 0.0 || (magnitude >= 1e-6 && magnitude < 1e15);
  const auto result =
      plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
            : std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

std::string list_text(const std::vector<std::string>& words, const char* last_joint) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? last_joint : ", ";
    text += words[i];
  }
  return text;
}

std::string in_quotes(std::string_view text) { return '"' + shortened(text) + '"'; }

}  // namespace sim::io
