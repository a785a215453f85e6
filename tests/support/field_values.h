// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/degrees.h"
#include "sim/core/fields.h"

/// Structs filled and changed by their tables of fields, for tests of what is derived from tables.
namespace sim::test {

template <typename T>
[[nodiscard]] T& as(void* value) {
  return *static_cast<T*>(value);
}

void fill(const FieldTable& table, void* object);

inline void fill_list(const Field& field, void* list) {
  if (field.list->append == nullptr) return;  // a map
  for (std::size_t i = 0; i < std::max<std::size_t>(field.kinds.size(), 1); ++i) {
    void* element = field.list->append(list);
    if (!field.kinds.empty()) {
      fill(field.kinds[i].table(), field.kinds[i].make(element));
    } else if (field.table != nullptr) {
      fill(field.table(), element);
    }
  }
}

/// Gives a member a value in its range that is not the usual default.
inline void fill(const Field& field, void* value) {
  const double number = field.range.min + 0.25 * (field.range.max - field.range.min);
  switch (field.type) {
    case FieldType::kNumber:
      as<double>(value) = number * (field.is_angle ? kDegrees : 1.0);
      return;
    case FieldType::kInt:
      return set_integer(field, value, field.least + (field.greatest - field.least) / 4);
    case FieldType::kInt64:
      as<std::int64_t>(value) = 50'000'000;
      return;
    case FieldType::kUint32:
    case FieldType::kUint64:
    case FieldType::kChoice:
      return set_integer(field, value, 1);
    case FieldType::kBool:
      as<bool>(value) = !as<bool>(value);
      return;
    case FieldType::kText:
      as<std::string>(value) = "abc";
      return;
    case FieldType::kColour:
      as<Colour>(value) = {0x10, 0x20, 0x30, 0x40};
      return;
    case FieldType::kVec2:
      as<Vec2>(value) = {number, number + 0.5};
      return;
    case FieldType::kPose:
      as<Pose>(value) = {0.5, 0.25, 30.0 * kDegrees};
      return;
    case FieldType::kTexts:
      if (field.words.empty()) {
        as<std::vector<std::string>>(value) = {"abc", "def"};
      } else {
        as<std::vector<std::string>>(value) = {field.words.back()};
      }
      return;
    case FieldType::kPoints:
      as<std::vector<Vec2>>(value) = {{1.0, 2.0}, {3.0, 4.0}, {5.0, 7.0}};
      return;
    case FieldType::kPoses:
      as<std::vector<Pose>>(value) = {{0.5, 0.25, 30.0 * kDegrees}};
      return;
    case FieldType::kList:
    case FieldType::kMap:
      return fill_list(field, value);
    case FieldType::kStruct:
      return fill(field.table(), value);
    case FieldType::kVariant:
      return fill(field.kinds[0].table(), field.kinds[0].make(value));
    default:
      return;  // does not occur in worlds
  }
}

/// Fills all members of a struct. Lists get an element, or one of each kind; maps stay empty.
inline void fill(const FieldTable& table, void* object) {
  for_each_field(table, object, [](const Field& field, void* owner) {
    if (field.set != nullptr && field.type != FieldType::kCustom) fill(field, field.set(owner));
  });
}

/// Changes the value with one number of all those that tables of fields reach, in their order.
class OneChange {
 public:
  explicit OneChange(int number) : number_(number) {}

  /// Counts the values of a struct, and changes one of them if it has the wanted number.
  void visit(const FieldTable& table, void* object, const std::string& path = "",
             bool is_identity = true) {
    for_each_field(table, object, [&](const Field& field, void* owner) {
      if (field.set == nullptr || field.type == FieldType::kCustom) return;
      const std::string place = path + '/' + field.name;
      const bool counts = is_identity && field.is_identity;
      visit_value(field, field.set(owner), place, counts);
      if (field.drop != nullptr) leaf(place + " left out", counts, [&] { field.drop(owner); });
    });
  }

  [[nodiscard]] bool is_made() const { return count_ > number_; }
  [[nodiscard]] bool is_of_identity() const { return is_of_identity_; }
  [[nodiscard]] const std::string& place() const { return place_; }

 private:
  void leaf(const std::string& place, bool is_identity, const std::function<void()>& change) {
    if (count_++ != number_) return;
    place_ = place;
    is_of_identity_ = is_identity;
    change();
  }

  void visit_list(const Field& field, void* list, const std::string& place, bool counts) {
    for (std::size_t i = 0; i < field.list->size(list); ++i) {
      void* const element = const_cast<void*>(field.list->at(list, i));
      const std::string inner = place + '/' + std::to_string(i);
      if (!field.kinds.empty()) {
        visit_kind(field, element, inner, counts);
      } else if (field.element == nullptr) {
        visit(field.table(), element, inner, counts);
      }
    }
    leaf(place + " empty", counts, [&] { field.list->clear(list); });
  }

  void visit_kind(const Field& field, void* value, const std::string& place, bool counts) {
    for (std::size_t i = 0; i < field.kinds.size(); ++i) {
      void* const object = const_cast<void*>(field.kinds[i].find(value));
      if (object == nullptr) continue;
      visit(field.kinds[i].table(), object, place + '/' + field.kinds[i].word, counts);
      leaf(place + " of another kind", counts,
           [&] { field.kinds[(i + 1) % field.kinds.size()].make(value); });
      return;
    }
  }

  void visit_value(const Field& field, void* value, const std::string& place, bool counts) {
    const auto change = [&](const auto& how) { leaf(place, counts, how); };
    switch (field.type) {
      case FieldType::kNumber:
        return change([&] { as<double>(value) += 0.0625; });
      case FieldType::kInt:
      case FieldType::kInt64:
      case FieldType::kUint32:
      case FieldType::kUint64:
        return change([&] { set_integer(field, value, integer_at(field, value) ^ 1); });
      case FieldType::kChoice:
        return change([&] {
          const auto count = static_cast<std::int64_t>(field.words.size());
          set_integer(field, value, (integer_at(field, value) + 1) % count);
        });
      case FieldType::kBool:
        return change([&] { as<bool>(value) = !as<bool>(value); });
      case FieldType::kText:
        return change([&] { as<std::string>(value) += 'x'; });
      case FieldType::kColour:
        return change([&] {
          auto& colour = as<Colour>(value);
          colour.b = static_cast<std::uint8_t>(colour.b ^ 1U);
        });
      case FieldType::kVec2:
        change([&] { as<Vec2>(value).x() += 0.0625; });
        return change([&] { as<Vec2>(value).y() += 0.0625; });
      case FieldType::kPose:
        change([&] { as<Pose>(value).x_m += 0.0625; });
        change([&] { as<Pose>(value).y_m += 0.0625; });
        return change([&] { as<Pose>(value).yaw_rad += 0.0625; });
      case FieldType::kTexts:
        return change([&] { as<std::vector<std::string>>(value).back() += 'x'; });
      case FieldType::kPoints:
        return change([&] { as<std::vector<Vec2>>(value).back().y() += 0.0625; });
      case FieldType::kPoses:
        return change([&] { as<std::vector<Pose>>(value).back().yaw_rad += 0.0625; });
      case FieldType::kList:
      case FieldType::kMap:
        return visit_list(field, value, place, counts);
      case FieldType::kStruct:
        return visit(field.table(), value, place, counts);
      case FieldType::kVariant:
        return visit_kind(field, value, place, counts);
      default:
        return;  // does not occur in worlds
    }
  }

  int number_;
  int count_ = 0;
  bool is_of_identity_ = false;
  std::string place_;
};

}  // namespace sim::test
