// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/state_archive.h"

#include <algorithm>
#include <utility>

#include "sim/core/assert.h"

namespace sim {

std::vector<std::uint8_t> StateArchive::take() {
  written_.resize(std::exchange(end_, 0));
  return std::exchange(written_, {});
}

void StateArchive::grow(std::size_t by) {
  constexpr std::size_t kLeast = 4096;
  written_.resize(std::max({kLeast, 2 * written_.size(), end_ + by}));
}

void StateArchive::refuse(const char* what) { throw SnapshotError(what, "other bytes"); }

void StateArchive::table(const FieldTable& table, void* object) {
  for (const Field& field : table.fields) {
    if (field.drop != nullptr) {
      bool there = field.get(object) != nullptr;
      member(there);
      if (!there && reading_) field.drop(object);
      if (!there) continue;
    }
    value(field, reading_ ? field.set(object) : const_cast<void*>(field.get(object)));
  }
}

void StateArchive::value(const Field& field, void* value) {
  switch (field.type) {
    case FieldType::kNumber:
      return member(*static_cast<double*>(value));
    case FieldType::kInt:
      return member(*static_cast<int*>(value));
    case FieldType::kInt64:
      return member(*static_cast<std::int64_t*>(value));
    case FieldType::kUint32:
      return member(*static_cast<std::uint32_t*>(value));
    case FieldType::kUint64:
      return member(*static_cast<std::uint64_t*>(value));
    case FieldType::kBool:
      return member(*static_cast<bool*>(value));
    case FieldType::kText:
      return member(*static_cast<std::string*>(value));
    case FieldType::kChoice: {
      auto number = static_cast<int>(integer_at(field, value));
      index(number, field.words.size());
      if (reading_) set_integer(field, value, number);
      return;
    }
    case FieldType::kColour:
      return member(*static_cast<Colour*>(value));
    case FieldType::kVec2:
      return member(*static_cast<Vec2*>(value));
    case FieldType::kPose:
      return member(*static_cast<Pose*>(value));
    case FieldType::kVec3:
      return member(*static_cast<std::array<double, 3>*>(value));
    case FieldType::kBytes:
    case FieldType::kOctets:
      return member(*static_cast<std::vector<std::uint8_t>*>(value));
    case FieldType::kNumbers:
      return member(*static_cast<std::vector<double>*>(value));
    case FieldType::kTexts:
      return member(*static_cast<std::vector<std::string>*>(value));
    case FieldType::kPoses:
      return member(*static_cast<std::vector<Pose>*>(value));
    case FieldType::kList: {
      std::uint64_t count = field.list->size(value);
      member(count);
      expect(count <= left_.size(), "a list that ends");
      if (reading_) field.list->clear(value);
      for (std::uint64_t i = 0; i < count; ++i) {
        table(field.table(),
              reading_ ? field.list->append(value) : const_cast<void*>(field.list->at(value, i)));
      }
      return;
    }
    case FieldType::kStruct:
    case FieldType::kInclude:
      return table(field.table(), value);
    case FieldType::kPoints:
    case FieldType::kMap:
    case FieldType::kVariant:
    case FieldType::kCustom:
    case FieldType::kForm:
      SIM_ASSERT(false);  // occurs in settings or messages only, never in states
  }
}

}  // namespace sim
