// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "io/document.h"
#include "sim/world/limits.h"

namespace sim::io {

std::string describe_range(const NumberRange& range) {
  std::string text = "a number";
  const bool has_min = range.min > -1e9;
  const bool has_max = range.max < 1e9;
  if (has_min && range.min_exclusive) {
    text += " greater than " + number_text(range.min);
    if (has_max) text += " and at most " + number_text(range.max);
  } else if (has_min && has_max) {
    text += " from " + number_text(range.min) + " to " + number_text(range.max);
  } else if (has_min) {
    text += " of at least " + number_text(range.min);
  } else if (has_max) {
    text += " of at most " + number_text(range.max);
  }
  if (range.unit != nullptr && *range.unit != '\0') text += std::string(" ") + range.unit;
  return text;
}

namespace {

using Kind = Reader::Value::Kind;
using NumberKind = Reader::Value::NumberKind;

// The least number that a range "greater than 0" accepts.
constexpr double kLeastPositive = 1e-9;

std::string describe(const Reader::Value& value) {
  switch (value.kind) {
    case Kind::kNull:
      return "null";
    case Kind::kBoolean:
      return value.boolean ? "true" : "false";
    case Kind::kNumber:
      return value.text.size() > 40 ? value.text.substr(0, 40) + "..." : value.text;
    case Kind::kString:
      return "the text " + in_quotes(value.text);
    case Kind::kArray:
      return value.children.empty() ? "an empty list"
                                    : "a list of " + std::to_string(value.children.size());
    case Kind::kObject:
      return "an object {...}";
  }
  return "";
}

bool looks_like_number(const std::string& text) {
  double ignored = 0.0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, ignored);
  return result.ec == std::errc() && result.ptr == end;
}

std::string type_hint(const Reader::Value& value) {
  return value.kind == Kind::kString && looks_like_number(value.text)
             ? "a number stands without quotes"
             : "";
}

/// The value as an integer, if it is whole and fits into 64 bits.
std::optional<std::int64_t> as_integer(const Reader::Value& value) {
  if (value.number_kind == NumberKind::kSigned) return value.integer;
  if (value.number_kind == NumberKind::kUnsigned) {
    if (value.natural > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return std::nullopt;
    }
    return static_cast<std::int64_t>(value.natural);
  }
  // 2^53: beyond it, a double cannot represent every integer.
  if (std::abs(value.real) <= 9007199254740992.0 && value.real == std::floor(value.real)) {
    return static_cast<std::int64_t>(value.real);
  }
  return std::nullopt;
}

bool is_whole(const Reader::Value& value) {
  return value.kind == Kind::kNumber &&
         (value.number_kind != NumberKind::kReal || value.real == std::floor(value.real));
}

std::string integer_range_text(std::int64_t min, std::int64_t max) {
  return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

}  // namespace

struct Reader::State {
  Document* document;
  const Value* value;
  std::string pointer;
  std::vector<std::string> known;
  bool finished = false;
  std::function<std::string(std::string_view)> hint_of{};  // for an unknown key

  void add(std::string id, std::string place, std::string expected, std::string found,
           std::string hint, int line) const {
    ConfigIssue issue{std::move(id),       document->file,   std::move(place),
                      std::move(expected), std::move(found), std::move(hint)};
    issue.line = line;
    document->add(std::move(issue));
  }

  void wrong_type(const std::string& place, const Value& found, std::string expected) const {
    add("world/wrong-type", place, std::move(expected), describe(found), type_hint(found),
        found.line);
  }

  /// The number if it is in range; otherwise an issue and nullopt.
  [[nodiscard]] std::optional<double> number(const Value& found, const std::string& place,
                                             const NumberRange& range) const {
    if (found.kind != Kind::kNumber) {
      wrong_type(place, found, describe_range(range));
      return std::nullopt;
    }
    const double v = found.real;
    // Divisors must not be so small that the quotient is infinite.
    const bool tiny = range.min_exclusive && range.min == 0.0 && v > 0.0 && v < kLeastPositive;
    if (v < range.min || v > range.max || (range.min_exclusive && v == range.min) || tiny) {
      const bool huge = range.min <= -1e9 && range.max >= 1e9;
      std::string hint;
      if (tiny) {
        hint = "a number below " + number_text(kLeastPositive) + " counts as 0";
      } else if (range.min == kLeastLength_m && v >= 0.0 && v < range.min) {
        hint =
            "the physics cannot build anything thinner than 1 mm: make it larger or leave it out";
      }
      add("world/out-of-range", place, huge ? "a number from -1e9 to 1e9" : describe_range(range),
          describe(found), std::move(hint), found.line);
      return std::nullopt;
    }
    return v;
  }

  [[nodiscard]] std::optional<std::int64_t> integer(const Value& found, const std::string& place,
                                                    std::int64_t min, std::int64_t max) const {
    if (!is_whole(found)) {
      wrong_type(place, found, integer_range_text(min, max));
      return std::nullopt;
    }
    const std::optional<std::int64_t> v = as_integer(found);
    if (!v || *v < min || *v > max) {
      add("world/out-of-range", place, integer_range_text(min, max), describe(found), "",
          found.line);
      return std::nullopt;
    }
    return v;
  }

  [[nodiscard]] std::string place_of(std::string_view key) const {
    return pointer + '/' + escape_pointer_part(key);
  }
};

bool is_valid_name(std::string_view name) noexcept {
  constexpr std::size_t kLongestName = 64;
  return !name.empty() && name.size() <= kLongestName &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '-';
         });
}

Reader::Reader(Document& document, const Value& value, std::string pointer)
    : state_(std::make_unique<State>(State{&document, &value, std::move(pointer), {}, false})) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

const Reader::Value* Reader::find(std::string_view key) {
  if (std::find(state_->known.begin(), state_->known.end(), key) == state_->known.end()) {
    state_->known.emplace_back(key);
  }
  if (!is_object()) return nullptr;
  const std::vector<Value>& members = state_->value->children;
  const auto member = std::find_if(members.begin(), members.end(),
                                   [key](const Value& value) { return value.key == key; });
  return member == members.end() ? nullptr : &*member;
}

bool Reader::has(std::string_view key) { return find(key) != nullptr; }
bool Reader::is_object() const { return state_->value->kind == Kind::kObject; }
bool Reader::is_array() const { return state_->value->kind == Kind::kArray; }
bool Reader::is_string() const { return state_->value->kind == Kind::kString; }
bool Reader::is_boolean() const { return state_->value->kind == Kind::kBoolean; }
bool Reader::is_number() const { return state_->value->kind == Kind::kNumber; }
bool Reader::is_null() const { return state_->value->kind == Kind::kNull; }
const std::string& Reader::pointer() const { return state_->pointer; }
const std::string& Reader::file() const { return state_->document->file; }
std::string Reader::description_for_message() const { return describe(*state_->value); }

std::optional<std::string> Reader::scalar_text() const {
  const Value& value = *state_->value;
  switch (value.kind) {
    case Kind::kString:
    case Kind::kNumber:
      return value.text;
    case Kind::kBoolean:
      return value.boolean ? "true" : "false";
    default:
      return std::nullopt;
  }
}

bool Reader::require(std::string_view key, const char* what) {
  if (has(key)) return true;
  issue("world/missing-key", "the key \"" + std::string(key) + "\": " + what, "none");
  return false;
}

bool Reader::expect_object() {
  if (is_object()) return true;
  state_->wrong_type(state_->pointer, *state_->value, "an object {...}");
  return false;
}

std::optional<Reader> Reader::child(std::string_view key) {
  const Value* found = find(key);
  if (found == nullptr) return std::nullopt;
  return Reader(*state_->document, *found, state_->place_of(key));
}

std::optional<Reader> Reader::object(std::string_view key) {
  std::optional<Reader> member = child(key);
  if (member && !member->expect_object()) return std::nullopt;
  return member;
}

std::vector<Reader> Reader::array(std::string_view key) {
  const std::optional<Reader> member = child(key);
  if (!member) return {};
  if (!member->is_array()) {
    state_->wrong_type(member->pointer(), *member->state_->value, "a list [...]");
    return {};
  }
  return member->elements();
}

std::vector<Reader> Reader::array(std::string_view key, std::size_t most) {
  std::vector<Reader> elements = array(key);
  if (elements.size() > most) {
    issue("world/too-many", "at most " + std::to_string(most) + " of them",
          std::to_string(elements.size()), "", key);
    elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(most), elements.end());
  }
  return elements;
}

std::vector<Reader> Reader::elements() const {
  std::vector<Reader> readers;
  if (!is_array()) return readers;
  const std::vector<Value>& values = state_->value->children;
  readers.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    readers.emplace_back(*state_->document, values[i], state_->pointer + '/' + std::to_string(i));
  }
  return readers;
}

std::vector<std::string> Reader::keys() const {
  std::vector<std::string> names;
  if (!is_object()) return names;
  std::unordered_set<std::string_view> seen;
  for (const Value& member : state_->value->children) {
    // Of a duplicate key (the parser reports it), the first counts.
    if (seen.insert(member.key).second) names.push_back(member.key);
  }
  return names;
}

double Reader::number(std::string_view key, double fallback, NumberRange range) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  return state_->number(*found, state_->place_of(key), range).value_or(fallback);
}

std::int64_t Reader::integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                             std::int64_t max) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  return state_->integer(*found, state_->place_of(key), min, max).value_or(fallback);
}

std::uint64_t Reader::unsigned_integer(std::string_view key, std::uint64_t fallback) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  constexpr const char* kExpected = "a whole number from 0 to 18446744073709551615";
  if (!is_whole(*found)) {
    state_->wrong_type(state_->place_of(key), *found, kExpected);
    return fallback;
  }
  if (found->number_kind == NumberKind::kUnsigned) return found->natural;
  const std::optional<std::int64_t> v = as_integer(*found);
  if (!v || *v < 0) {
    state_->add("world/out-of-range", state_->place_of(key), kExpected, describe(*found), "",
                found->line);
    return fallback;
  }
  return static_cast<std::uint64_t>(*v);
}

bool Reader::boolean(std::string_view key, bool fallback) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  if (found->kind != Kind::kBoolean) {
    state_->wrong_type(state_->place_of(key), *found, "true or false");
    return fallback;
  }
  return found->boolean;
}

std::string Reader::string(std::string_view key, std::string fallback) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  if (found->kind != Kind::kString) {
    state_->wrong_type(state_->place_of(key), *found, "a text in double quotes");
    return fallback;
  }
  return found->text;
}

std::string Reader::name(std::string_view key, std::string fallback) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  constexpr const char* kExpected = "a name of 1 to 64 letters, digits, _ or -";
  if (found->kind != Kind::kString) {
    state_->wrong_type(state_->place_of(key), *found, kExpected);
    return fallback;
  }
  if (!is_valid_name(found->text)) {
    state_->add("world/bad-name", state_->place_of(key), kExpected, in_quotes(found->text),
                "English letters only, no blanks", found->line);
    return fallback;
  }
  return found->text;
}

std::string Reader::choice(std::string_view key, std::string fallback,
                           const std::vector<std::string>& choices) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  std::vector<std::string> choices_in_quotes;
  for (const std::string& word : choices) choices_in_quotes.push_back(in_quotes(word));
  const std::string expected = list_text(choices_in_quotes);
  if (found->kind != Kind::kString) {
    state_->wrong_type(state_->place_of(key), *found, expected);
    return fallback;
  }
  if (std::find(choices.begin(), choices.end(), found->text) == choices.end()) {
    const std::string near = nearest_word(found->text, choices);
    state_->add("world/unknown-value", state_->place_of(key), expected, in_quotes(found->text),
                near.empty() ? "" : "did you mean " + in_quotes(near) + "?", found->line);
    return fallback;
  }
  return found->text;
}

Colour Reader::colour(std::string_view key, Colour fallback) {
  const Value* found = find(key);
  if (found == nullptr) return fallback;
  constexpr const char* kExpected = "a colour like \"#ff8800\", \"#f80\" or \"#ff880080\"";
  if (found->kind != Kind::kString) {
    state_->wrong_type(state_->place_of(key), *found, kExpected);
    return fallback;
  }
  const std::optional<Colour> colour = parse_colour(found->text);
  if (!colour) {
    state_->add("world/bad-colour", state_->place_of(key), kExpected, in_quotes(found->text),
                "# and then red, green and blue in hexadecimal digits", found->line);
    return fallback;
  }
  return *colour;
}

Vec2 Reader::vec2(std::string_view key, Vec2 fallback, NumberRange range) {
  std::optional<Reader> member = child(key);
  return member ? member->as_vec2(fallback, range) : fallback;
}

Vec2 Reader::as_vec2(Vec2 fallback, NumberRange range) {
  const Value& value = *state_->value;
  if (value.kind != Kind::kArray || value.children.size() != 2) {
    state_->wrong_type(pointer(), value, "a list of two numbers [x, y]");
    return fallback;
  }
  const std::optional<double> x = state_->number(value.children[0], pointer() + "/0", range);
  const std::optional<double> y = state_->number(value.children[1], pointer() + "/1", range);
  return x && y ? Vec2(*x, *y) : fallback;
}

std::array<std::int64_t, 2> Reader::integer_pair(std::string_view key,
                                                 std::array<std::int64_t, 2> fallback,
                                                 std::int64_t min, std::int64_t max) {
  const std::optional<Reader> member = child(key);
  if (!member) return fallback;
  const Value& value = *member->state_->value;
  if (value.kind != Kind::kArray || value.children.size() != 2) {
    state_->wrong_type(member->pointer(), value, "a list of two whole numbers");
    return fallback;
  }
  const auto a = state_->integer(value.children[0], member->pointer() + "/0", min, max);
  const auto b = state_->integer(value.children[1], member->pointer() + "/1", min, max);
  return a && b ? std::array<std::int64_t, 2>{*a, *b} : fallback;
}

double Reader::angle_deg(std::string_view key, double fallback_rad, NumberRange range_deg) {
  const Value* found = find(key);
  if (found == nullptr) return fallback_rad;
  const std::optional<double> degrees = state_->number(*found, state_->place_of(key), range_deg);
  return degrees ? *degrees * (std::numbers::pi / 180.0) : fallback_rad;
}

Pose Reader::pose(std::string_view key, const Pose& fallback) {
  std::optional<Reader> member = child(key);
  return member ? member->as_pose(fallback) : fallback;
}

Pose Reader::as_pose(const Pose& fallback) {
  if (!expect_object()) return fallback;
  constexpr NumberRange kPosition{-kFarthest_m, kFarthest_m, false, "m"};
  Pose pose;
  pose.x_m = number("x", fallback.x_m, kPosition);
  pose.y_m = number("y", fallback.y_m, kPosition);
  pose.yaw_rad = normalize_angle(angle_deg("yaw_deg", fallback.yaw_rad));
  finish();
  return pose;
}

void Reader::issue(std::string id, std::string expected, std::string found, std::string hint,
                   std::string_view key) {
  int line = state_->value->line;
  std::string place = state_->pointer;
  if (!key.empty()) {
    place = state_->place_of(key);
    if (const Value* member = find(key)) line = member->line;
  }
  state_->add(std::move(id), std::move(place), std::move(expected), std::move(found),
              std::move(hint), line);
}

void Reader::explain_unknown_keys(std::function<std::string(std::string_view)> hint_of) {
  state_->hint_of = std::move(hint_of);
}

void Reader::finish() {
  if (state_->finished || !is_object()) return;
  state_->finished = true;
  std::unordered_set<std::string_view> seen;
  for (const Value& member : state_->value->children) {
    if (std::find(state_->known.begin(), state_->known.end(), member.key) != state_->known.end() ||
        !seen.insert(member.key).second) {
      continue;
    }
    if (state_->document->full()) return;
    std::string hint = state_->hint_of ? state_->hint_of(member.key) : "";
    if (const std::string near = nearest_word(member.key, state_->known);
        hint.empty() && !near.empty()) {
      hint = "did you mean " + in_quotes(near) + "?";
    }
    state_->add("world/unknown-key", state_->place_of(member.key),
                state_->known.empty()       ? "no key here"
                : state_->known.size() == 1 ? "no key but " + state_->known.front()
                                            : "one of the keys " + list_text(state_->known),
                "the unknown key " + in_quotes(member.key), std::move(hint), member.key_line);
  }
}

}  // namespace sim::io
