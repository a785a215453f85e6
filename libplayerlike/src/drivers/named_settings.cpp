// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/named_settings.h"

#include <cmath>
#include <limits>

#include "core/errors.h"
#include "playerlike/messages/driver_settings.h"

namespace playerlike {

namespace {

const sim::Field& find_setting(const std::string& fun, const sim::FieldTable& table,
                               const IsSetting& is_setting, const std::string& name) {
  std::string known;
  for (const sim::Field& field : table.fields) {
    if (!is_setting(field)) continue;
    if (field.name == name) return field;
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  }
  refuse(fun, "there is no setting \"" + name + "\"; there are: " + known);
}

}  // namespace

void set_named(const std::string& fun, const sim::FieldTable& table, const IsSetting& is_setting,
               void* object, const std::string& name, double value) {
  const sim::Field& field = find_setting(fun, table, is_setting, name);
  if (field.type == sim::FieldType::kInt) {
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
      refuse(fun, name + " must be a whole number");
    }
    sim::set_integer(field, field.set(object), static_cast<int>(value));
  } else {
    *static_cast<double*>(field.set(object)) = value * unit_of_setting(field);
  }
}

double get_named(const std::string& fun, const sim::FieldTable& table, const IsSetting& is_setting,
                 const void* object, const std::string& name) {
  const sim::Field& field = find_setting(fun, table, is_setting, name);
  const void* const value = field.get(object);
  if (value == nullptr) return std::numeric_limits<double>::quiet_NaN();
  if (field.type == sim::FieldType::kInt) {
    return static_cast<double>(sim::integer_at(field, value));
  }
  return *static_cast<const double*>(value) / unit_of_setting(field);
}

}  // namespace playerlike
