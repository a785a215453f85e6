// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/check_ranges.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/document.h"
#include "sim/core/degrees.h"
#include "sim/io/field_reader.h"
#include "sim/world/limits.h"

namespace sim::io {
namespace {

class RangeCheck {
 public:
  explicit RangeCheck(const std::function<void(SolidError)>& report) : report_(report) {}

  void check(const FieldTable& table, const void* object, const std::string& place,
             std::initializer_list<std::string_view> only) {
    for_each_field(table, object, [&](const Field& field, const void* owner) {
      if (only.size() > 0 && std::find(only.begin(), only.end(), field.name) == only.end()) return;
      if (field.set == nullptr || field.get(owner) == nullptr) return;
      const bool is_apart = field.custom != nullptr && field.custom->keys != nullptr;
      if (is_apart) return check(field.custom->keys(), field.get(owner), place, {});
      check_value(field, field.get(owner), *field.name == '\0' ? place : place + '/' + field.name);
    });
  }

 private:
  template <typename T>
  static const T& as(const void* value) {
    return *static_cast<const T*>(value);
  }

  void check_number(const Field& field, double value, const std::string& place) {
    const NumberRange& range = field.range;
    const bool may_be_left_out =
        *field.default_text != '\0' && field.custom == nullptr && field.drop == nullptr;
    const bool is_left_out =
        may_be_left_out && (range.min > 0.0 ? value == 0.0 : std::isinf(value));
    const bool is_high_enough = range.min_exclusive ? value > range.min : value >= range.min;
    if (is_left_out || (is_high_enough && value <= range.max)) return;
    const bool is_thin = range.min == kLeastLength_m && value < range.min;
    const std::string unit = range.unit;
    report_({place, describe_range(range), number_text(value) + (unit.empty() ? "" : ' ' + unit),
             is_thin ? "the physics cannot build anything thinner" : ""});
  }

  void check_count(const Field& field, std::size_t count, const std::string& place) {
    const bool is_left_out = count == 0 && field.needed_for == nullptr;
    if (is_left_out || (count >= field.min_count && count <= field.max_count)) return;
    report_({place,
             field.type == FieldType::kText
                 ? "a text of at most " + std::to_string(field.max_count) + " bytes"
             : field.issue_expected != nullptr ? field.issue_expected
                                               : "a list of " + std::to_string(field.min_count) +
                                                     " to " + std::to_string(field.max_count),
             std::to_string(count) + (field.type == FieldType::kText ? " bytes" : ""), ""});
  }

  void check_point(const Field& field, const Vec2& point, const std::string& place) {
    check_number(field, point.x(), place + "/0");
    check_number(field, point.y(), place + "/1");
  }

  /// @param place  of the list's element, or of the variant's owner if the kind's key is there.
  void check_kind(const Field& field, const void* value, const std::string& place) {
    for (const Kind& kind : field.kinds) {
      const void* const object = kind.find(value);
      if (object == nullptr) continue;
      const std::string above =
          kind.is_beside ? place.substr(0, place.size() - std::string_view(field.name).size() - 1)
                         : place;
      return check(kind.table(), object, kind.is_bare ? above : above + '/' + kind.word, {});
    }
  }

  void check_list(const Field& field, const void* list, const std::string& place) {
    const std::size_t count = field.list->size(list);
    check_count(field, count, place);
    for (std::size_t i = 0; i < count; ++i) {
      const void* const element = field.list->at(list, i);
      if (!field.kinds.empty()) {
        check_kind(field, element, place + '/' + std::to_string(i));
      } else if (field.is_keyed) {
        const auto& name = as<std::string>(field.table().fields.front().get(element));
        check(field.table(), element, place + '/' + escape_pointer_part(name), {});
      } else if (field.element == nullptr) {
        check(field.table(), element, place + '/' + std::to_string(i), {});
      }
    }
  }

  void check_value(const Field& field, const void* value, const std::string& place) {
    switch (field.type) {
      case FieldType::kNumber:
        return check_number(field, as<double>(value) / (field.is_angle ? kDegrees : 1.0), place);
      case FieldType::kInt:
        return check_number(field, static_cast<double>(integer_at(field, value)), place);
      case FieldType::kChoice: {
        const auto index = static_cast<std::size_t>(integer_at(field, value));
        if (index < field.words.size()) return;
        return report_(
            {place, list_text({field.words.begin(), field.words.end()}), "another value", ""});
      }
      case FieldType::kText:
        return check_count(field, as<std::string>(value).size(), place);
      case FieldType::kTexts:
        return check_count(field, as<std::vector<std::string>>(value).size(), place);
      case FieldType::kVec2:
        return check_point(field, as<Vec2>(value), place);
      case FieldType::kPoints: {
        const auto& points = as<std::vector<Vec2>>(value);
        check_count(field, points.size(), place);
        for (std::size_t i = 0; i < points.size(); ++i) {
          check_point(field, points[i], place + '/' + std::to_string(i));
        }
        return;
      }
      case FieldType::kList:
        return check_list(field, value, place);
      case FieldType::kStruct:
        return check(field.table(), value, place, {});
      case FieldType::kVariant:
        return check_kind(field, value, place);
      default:
        return;  // any value is possible
    }
  }

  const std::function<void(SolidError)>& report_;
};

}  // namespace

void check_ranges(const FieldTable& table, const void* object, const std::string& place,
                  const std::function<void(SolidError)>& report,
                  std::initializer_list<std::string_view> only) {
  RangeCheck(report).check(table, object, place, only);
}

std::optional<SolidError> out_of_range(const FieldTable& table, const void* object,
                                       std::initializer_list<std::string_view> only) {
  std::optional<SolidError> first;
  const std::function<void(SolidError)> keep = [&first](SolidError error) {
    if (!first) first = std::move(error);
  };
  check_ranges(table, object, "", keep, only);
  return first;
}

}  // namespace sim::io
