// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/fields.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"

namespace sim {

/// A snapshot was refused. what() is one sentence: "snapshot: expected X, found Y".
class SnapshotError : public std::runtime_error {
 public:
  SnapshotError(const std::string& expected, const std::string& found)
      : std::runtime_error("snapshot: expected " + expected + ", found " + found) {}
};

/// Writes a state as bytes, or reads it back.
///
/// A class with state lists its members once, for both directions, in a function
/// archive(StateArchive&). For example, Battery has:
///
///     SensorOf::archive(archive);  // the newest reading, and what all sensors have
///     archive(energy_j_, power_w_, docked_);
///
/// An object that is read was constructed from the same settings as the one that was written.
/// Numbers are stored in the machine's own representation. Reading trusts nothing: counts are
/// compared with the remaining bytes, floating-point numbers must be finite, and expect() checks
/// the rest.
class StateArchive {
 public:
  /// An archive for writing.
  StateArchive() = default;
  /// An archive for reading; the caller keeps the bytes alive.
  explicit StateArchive(std::span<const std::uint8_t> bytes) : reading_(true), left_(bytes) {}

  [[nodiscard]] bool reading() const noexcept { return reading_; }
  /// Returns the bytes written so far and leaves the archive without memory.
  [[nodiscard]] std::vector<std::uint8_t> take();
  /// Makes room for so many bytes more, so that they are written without copying earlier ones.
  void reserve(std::size_t size) {
    if (written_.size() - end_ < size) grow(size);
  }
  /// The bytes written so far.
  [[nodiscard]] std::span<const std::uint8_t> written() const noexcept {
    return {written_.data(), end_};
  }
  /// Number of bytes not yet read.
  [[nodiscard]] std::size_t left() const noexcept { return left_.size(); }

  /// Writes or reads members in this order. Supported are numbers, enumerations (see choice()),
  /// texts, poses and similar types, any class with a function archive(StateArchive&), and
  /// std::optional, std::vector, std::deque and std::array of these.
  /// @throws SnapshotError if the bytes are invalid or end too early.
  template <typename... Members>
  void operator()(Members&... members) {
    (member(members), ...);
  }

  /// A number that may be infinite.
  void unbounded(double& number) {
    raw(&number, sizeof number);
    if (reading_) expect(!std::isnan(number), "a number");
  }
  /// A point in time or a duration [ns], limited so that arithmetic on it cannot overflow.
  void time(SimTime& time_ns) {
    member(time_ns);
    constexpr SimTime kMost_ns = SimTime{1} << 61;
    expect(-kMost_ns <= time_ns && time_ns <= kMost_ns, "a time");
  }
  /// An enumeration whose values count from 0.
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void choice(Enum& value, Enum last) {
    auto number = reading_ ? 0 : static_cast<std::int32_t>(value);
    member(number);
    if (!reading_) return;
    expect(number >= 0 && number <= static_cast<std::int32_t>(last), "a choice that there is");
    value = static_cast<Enum>(number);
  }
  /// An index with least <= index < end.
  template <std::integral Number>
  void index(Number& number, std::size_t end, Number least = 0) {
    member(number);
    if (reading_) {
      expect(number >= least && (number < 0 || static_cast<std::size_t>(number) < end),
             "an index of something that there is");
    }
  }
  /// A list whose elements are archived by one(element).
  template <typename List, typename One>
  void list(List& list, One one) {
    std::uint64_t count = list.size();
    member(count);
    if (!reading_) {
      for (auto& element : list) one(element);
      return;
    }
    expect(count <= left_.size(), "a list that ends");
    list.clear();
    for (; count > 0; --count) one(list.emplace_back());
  }
  /// All fields of a struct that has a FieldTable.
  template <typename Struct>
  void fields(Struct& object) {
    table(fields_of<Struct>(), &object);
  }
  void table(const FieldTable& table, void* object);
  /// Raw bytes.
  /// @param data  may be null if there are none.
  void raw(void* data, std::size_t size) {
    if (size == 0) return;  // std::memcpy() must not get a null pointer
    if (reading_) {
      expect(size <= left_.size(), "more bytes");
      std::memcpy(data, left_.data(), size);
      left_ = left_.subspan(size);
      return;
    }
    if (written_.size() - end_ < size) grow(size);
    std::memcpy(written_.data() + end_, data, size);
    end_ += size;
  }

  /// While reading, refuses the snapshot unless a condition holds.
  /// @param what  what was expected, for the message.
  void expect(bool holds, const char* what) const {
    if (reading_ && !holds) refuse(what);
  }

 private:
  [[noreturn]] static void refuse(const char* what);
  void grow(std::size_t by);
  void value(const Field& field, void* value);

  template <typename Number>
  requires(std::integral<Number> && !std::same_as<Number, bool>) void member(Number& number) {
    raw(&number, sizeof number);
  }
  template <std::floating_point Number>
  void member(Number& number) {
    raw(&number, sizeof number);
    expect(std::isfinite(number), "a finite number");
  }
  void member(bool& flag) {
    std::uint8_t byte = !reading_ && flag ? 1 : 0;
    raw(&byte, 1);
    expect(byte <= 1, "0 or 1");
    if (reading_) flag = byte != 0;  // a reading that is shared is never written to
  }
  void member(Vec2& p) { (*this)(p.x(), p.y()); }
  void member(Pose& pose) { (*this)(pose.x_m, pose.y_m, pose.yaw_rad); }
  void member(Twist& twist) { (*this)(twist.v_mps, twist.omega_radps, twist.lateral_mps); }
  void member(Colour& colour) { (*this)(colour.r, colour.g, colour.b, colour.a); }
  void member(std::string& text) { packed(text); }
  template <typename T>
  void member(std::optional<T>& value) {
    bool there = value.has_value();
    member(there);
    if (reading_) value.reset();
    if (!there) return;
    if (reading_) value.emplace();
    member(*value);
  }
  template <typename T>
  void member(std::vector<T>& list) {
    if constexpr (std::is_arithmetic_v<T>) {
      packed(list);
      if constexpr (std::floating_point<T>) {
        for (const T& number : list) expect(std::isfinite(number), "a finite number");
      }
    } else {
      this->list(list, [this](T& element) { member(element); });
    }
  }
  template <typename T>
  void member(std::deque<T>& list) {
    this->list(list, [this](T& element) { member(element); });
  }
  template <typename T, std::size_t kSize>
  void member(std::array<T, kSize>& elements) {
    for (T& element : elements) member(element);
  }
  template <typename T>
  requires requires(T& object, StateArchive& archive) { object.archive(archive); }
  void member(T& object) { object.archive(*this); }

  /// A list of numbers, copied in one block.
  template <typename List>
  void packed(List& list) {
    using Element = typename List::value_type;
    std::uint64_t count = list.size();
    member(count);
    if (reading_) {
      expect(count <= left_.size() / sizeof(Element), "a list that ends");
      list.resize(count);
    }
    if (count > 0) raw(list.data(), count * sizeof(Element));
  }

  bool reading_ = false;
  std::span<const std::uint8_t> left_;
  std::vector<std::uint8_t> written_;  // only the first end_ bytes are in use
  std::size_t end_ = 0;
};

}  // namespace sim
