// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/error.h"
#include "sim/core/fields.h"
#include "sim/core/pose.h"

namespace sim::io {

using sim::NumberRange;

/// A view of one JSON value of a file, with the place it stands at.
///
/// Every getter that finds something wrong records a ConfigIssue and gives back the default, so
/// that one pass reports all errors of a file. An object's Reader remembers which keys were
/// asked for; finish() records each key that nobody asked for, naming the nearest known one.
/// A handle on a document that outlives it; movable, not copyable. Not thread-safe.
///
/// Getters that take a key look at that member of this object and mark the key as known. A
/// missing member gives the fallback and no issue; so does a Reader that is no object (whoever
/// asked for an object has reported it).
class Reader {
 public:
  /// What all readers of one document share: the parsed value and the issues so far.
  struct Document;
  /// One parsed JSON value.
  struct Value;

  Reader(Document& document, const Value& value, std::string pointer);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  [[nodiscard]] bool has(std::string_view key);  ///< also marks the key as known
  /// Whether the member of that name, which must be there, is; if not, that is recorded.
  /// @param what  what it is to hold, for the message.
  [[nodiscard]] bool require(std::string_view key, const char* what);
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_string() const;
  [[nodiscard]] bool is_boolean() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_null() const;
  [[nodiscard]] const std::string& pointer() const;  ///< JSON pointer of this value
  [[nodiscard]] const std::string& file() const;     ///< as messages call it

  /// This value in words for a message, shortened: `3.5`, `"abc"`, `an object`, `a list of 2`.
  [[nodiscard]] std::string described() const;
  /// A text's content, a number as it is written in the file, "true" or "false"; else nullopt.
  [[nodiscard]] std::optional<std::string> scalar_text() const;
  /// Whether this is an object; if not, that is recorded.
  [[nodiscard]] bool expect_object();

  /// The member of that name; a missing one gives nullopt and no issue.
  [[nodiscard]] std::optional<Reader> child(std::string_view key);
  /// As child(), but the member must be an object; otherwise an issue and nullopt.
  [[nodiscard]] std::optional<Reader> object(std::string_view key);
  /// Elements of the member, which must be an array; otherwise an issue and none.
  [[nodiscard]] std::vector<Reader> array(std::string_view key);
  /// As array(key), but of more than `most` elements only the first so many, and an issue.
  [[nodiscard]] std::vector<Reader> array(std::string_view key, std::size_t most);
  [[nodiscard]] std::vector<Reader> elements() const;   ///< of an array; else none
  [[nodiscard]] std::vector<std::string> keys() const;  ///< of an object, in the file's order

  [[nodiscard]] double number(std::string_view key, double fallback, NumberRange range = {});
  /// A whole number from `min` to `max`; 3.0 is whole, 3.5 is not.
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                                     std::int64_t max);
  /// A whole number from 0 to 2^64 - 1.
  [[nodiscard]] std::uint64_t unsigned_integer(std::string_view key, std::uint64_t fallback);
  [[nodiscard]] bool boolean(std::string_view key, bool fallback);
  [[nodiscard]] std::string string(std::string_view key, std::string fallback);
  /// A name: letters, digits, _ and -, 1 to 64 of them.
  [[nodiscard]] std::string name(std::string_view key, std::string fallback);
  /// One of `choices`; a wrong word names the nearest.
  [[nodiscard]] std::string choice(std::string_view key, std::string fallback,
                                   const std::vector<std::string>& choices);
  [[nodiscard]] Colour colour(std::string_view key, Colour fallback);
  /// [x, y] in metres, each in `range`.
  [[nodiscard]] Vec2 vec2(std::string_view key, Vec2 fallback, NumberRange range = {});
  /// As vec2(), of this value itself.
  [[nodiscard]] Vec2 as_vec2(Vec2 fallback, NumberRange range = {});
  /// [columns, rows] or the like: two whole numbers, each from `min` to `max`.
  [[nodiscard]] std::array<std::int64_t, 2> integer_pair(std::string_view key,
                                                         std::array<std::int64_t, 2> fallback,
                                                         std::int64_t min, std::int64_t max);
  /// Degrees in the file (the key ends in _deg), radians out, whole turns kept.
  [[nodiscard]] double angle_deg(std::string_view key, double fallback_rad,
                                 NumberRange range_deg = {-3600.0, 3600.0, false, "degrees"});
  /// {"x", "y", "yaw_deg"}, each of which may be left out; yaw is brought into (-pi, pi].
  [[nodiscard]] Pose pose(std::string_view key, const Pose& fallback);
  /// As pose(), of this value itself, which must be an object.
  [[nodiscard]] Pose as_pose(const Pose& fallback);

  /// Records an issue at this value (or at its member `key`).
  void issue(std::string id, std::string expected, std::string found, std::string hint = "",
             std::string_view key = "");

  /// Records every key of this object that nobody asked for. A second call does nothing.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;

  [[nodiscard]] const Value* find(std::string_view key);
};

/// Whether `name` is made of 1 to 64 letters, digits, '_' and '-'.
[[nodiscard]] bool is_valid_name(std::string_view name) noexcept;

}  // namespace sim::io
