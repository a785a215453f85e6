// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// A view of one JSON value of a file and its position in the document.
///
/// A getter that finds an error records a ConfigIssue and returns the default, so one pass reports
/// all errors of a file. The Reader of an object remembers which keys were requested; finish()
/// records each key that was not, and suggests the nearest known key. A Reader refers to a document
/// that must outlive it. Movable, not copyable. Not thread-safe.
///
/// Getters with a key read that member of this object and mark the key as known. A missing member
/// gives the fallback without an issue. So does a Reader of something other than an object, since
/// that error was recorded when the object was requested.
class Reader {
 public:
  /// The state that all readers of one document share: the parsed value and the issues so far.
  struct Document;
  /// One parsed JSON value.
  struct Value;

  Reader(Document& document, const Value& value, std::string pointer);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  [[nodiscard]] bool has(std::string_view key);  ///< also marks the key as known
  /// Whether the required member exists; if not, records an issue.
  /// @param what  what the member should contain, for the message.
  [[nodiscard]] bool require(std::string_view key, const char* what);
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_string() const;
  [[nodiscard]] bool is_boolean() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_null() const;
  [[nodiscard]] const std::string& pointer() const;  ///< JSON pointer of this value
  [[nodiscard]] const std::string& file() const;     ///< the file's name in messages

  /// This value in words for a message, shortened: `3.5`, `"abc"`, `an object`, `a list of 2`.
  [[nodiscard]] std::string description_for_message() const;
  /// The content of a text, a number as written in the file, "true" or "false"; otherwise nullopt.
  [[nodiscard]] std::optional<std::string> scalar_text() const;
  /// Whether this value is an object; if not, records an issue.
  [[nodiscard]] bool expect_object();

  /// The member of that name; nullopt and no issue if it is missing.
  [[nodiscard]] std::optional<Reader> child(std::string_view key);
  /// Like child(), but a member that is not an object gives an issue and nullopt.
  [[nodiscard]] std::optional<Reader> object(std::string_view key);
  /// Elements of the member; if it is not an array, an issue and no elements.
  [[nodiscard]] std::vector<Reader> array(std::string_view key);
  /// Like array(key), but returns at most the first `most` elements and records an issue if there
  /// are more.
  [[nodiscard]] std::vector<Reader> array(std::string_view key, std::size_t most);
  [[nodiscard]] std::vector<Reader> elements() const;   ///< of an array; otherwise none
  [[nodiscard]] std::vector<std::string> keys() const;  ///< of an object, in the file's order

  [[nodiscard]] double number(std::string_view key, double fallback, NumberRange range = {});
  /// A whole number from `min` to `max`; 3.0 is accepted, 3.5 is not.
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                                     std::int64_t max);
  /// A whole number from 0 to 2^64 - 1.
  [[nodiscard]] std::uint64_t unsigned_integer(std::string_view key, std::uint64_t fallback);
  [[nodiscard]] bool boolean(std::string_view key, bool fallback);
  [[nodiscard]] std::string string(std::string_view key, std::string fallback);
  /// A name: letters, digits, _ and -, 1 to 64 of them.
  [[nodiscard]] std::string name(std::string_view key, std::string fallback);
  /// One of `choices`; the issue for a wrong word suggests the nearest.
  [[nodiscard]] std::string choice(std::string_view key, std::string fallback,
                                   const std::vector<std::string>& choices);
  [[nodiscard]] Colour colour(std::string_view key, Colour fallback);
  /// [x, y] in metres, each in `range`.
  [[nodiscard]] Vec2 vec2(std::string_view key, Vec2 fallback, NumberRange range = {});
  /// Like vec2(), of this value itself.
  [[nodiscard]] Vec2 as_vec2(Vec2 fallback, NumberRange range = {});
  /// Two whole numbers, e.g. [columns, rows], each from `min` to `max`.
  [[nodiscard]] std::array<std::int64_t, 2> integer_pair(std::string_view key,
                                                         std::array<std::int64_t, 2> fallback,
                                                         std::int64_t min, std::int64_t max);
  /// An angle in degrees in the file (the key ends in _deg), returned in radians and not wrapped.
  [[nodiscard]] double angle_deg(std::string_view key, double fallback_rad,
                                 NumberRange range_deg = {-3600.0, 3600.0, false, "degrees"});
  /// {"x", "y", "yaw_deg"}, all optional; yaw is wrapped into (-pi, pi].
  [[nodiscard]] Pose pose(std::string_view key, const Pose& fallback);
  /// Like pose(), of this value itself, which must be an object.
  [[nodiscard]] Pose as_pose(const Pose& fallback);

  /// Records an issue at this value (or at its member `key`).
  void issue(std::string id, std::string expected, std::string found, std::string hint = "",
             std::string_view key = "");

  /// Sets the hint of finish() for an unknown key; if it is "", finish() suggests the nearest key.
  void explain_unknown_keys(std::function<std::string(std::string_view)> hint_of);

  /// Records every key of this object that was not requested. A second call does nothing.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;

  [[nodiscard]] const Value* find(std::string_view key);
};

/// Whether `name` consists of 1 to 64 letters, digits, '_' and '-'.
[[nodiscard]] bool is_valid_name(std::string_view name) noexcept;

}  // namespace sim::io
