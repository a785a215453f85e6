// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/reading_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>

#include "protocol/codec.h"
#include "random_fields.h"
#include "sim/devices/builtin.h"
#include "sim/devices/laser.h"

namespace playerlike {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Why a value does not match a schema; "" if it does. An object may have stated members only.
std::string mismatch(const json& value, const json& schema, const std::string& path) {
  if (value.is_null() || !schema.contains("type")) return "";
  const std::string type = schema.at("type");
  const bool fits = type == "object"    ? value.is_object()
                    : type == "array"   ? value.is_array()
                    : type == "string"  ? value.is_string()
                    : type == "boolean" ? value.is_boolean()
                    : type == "integer" ? value.is_number_integer()
                                        : value.is_number();
  if (!fits) return path + " is no " + type + ": " + value.dump();
  if (schema.contains("enum") && schema.at("enum").count(value) == 0 &&
      std::ranges::find(schema.at("enum"), value) == schema.at("enum").end()) {
    return path + " is no word of " + schema.at("enum").dump();
  }
  std::string wrong;
  for (const auto& [key, member] : value.items()) {
    if (value.is_array()) wrong += mismatch(member, schema.at("items"), path + "[]");
    if (!value.is_object() || !schema.contains("properties")) continue;
    wrong += schema.at("properties").contains(key)
                 ? mismatch(member, schema.at("properties").at(key), path + '.' + key)
                 : path + " has no member " + key + ". ";
  }
  return wrong;
}

TEST(ReadingJson, EachKindOfReading_MatchesItsSchema) {
  test::RandomFields random(3);
  int kinds = 0;
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    if (kind.reading.fields == nullptr) continue;
    ++kinds;
    const std::string type = kind.name;
    const json schema = json::parse(reading_schema(type));
    std::set<std::string> seen;
    for (int i = 0; i < 20; ++i) {
      const auto reading = kind.reading.make();
      random.fill(*kind.reading.fields, kind.reading.object(*reading));
      reading->sequence = 7;
      reading->time_ns = 123'456'789'012;
      const json value = json::parse(reading_json(type, *reading));
      ASSERT_EQ(mismatch(value, schema, type), "");
      EXPECT_EQ(value.at("seq"), 7);
      EXPECT_EQ(value.at("t"), 123'456'789'012);
      for (const auto& [key, member] : value.items()) seen.insert(key);
    }
    for (const auto& [key, member] : schema.at("properties").items()) {
      EXPECT_TRUE(seen.contains(key)) << type << " never has " << key;
    }
  }
  EXPECT_GT(kinds, 20);
}

TEST(ReadingJson, LaserReading_ExactNumbersAndUnits) {
  sim::LaserReading scan;
  scan.ranges_m = {0.1, 1.0 / 3.0};
  scan.range_max_m = 5.0;
  const json value = json::parse(reading_json("laser", scan));
  EXPECT_EQ(value.at("ranges").get<std::vector<double>>(), scan.ranges_m);
  const json ranges = json::parse(reading_schema("laser")).at("properties").at("ranges");
  EXPECT_EQ(ranges.at("type"), "array");
  EXPECT_THAT(ranges.at("description").get<std::string>(), HasSubstr("[m]"));
}

TEST(ReadingJson, DeviceWithoutReadings_Refused) {
  const auto refused =
      ThrowsMessage<std::runtime_error>(HasSubstr("expected a type of device that makes readings"));
  EXPECT_THAT([] { static_cast<void>(reading_schema("pen")); }, refused);
  EXPECT_THAT([] { static_cast<void>(reading_json("none", sim::LaserReading())); }, refused);
}

TEST(ReadingJson, Command_AsInProtocol) {
  const sim::Command command = sim::TwistCommand{{0.25, -0.5, 0.0}};
  EXPECT_EQ(json::parse(command_json(command)), protocol::encode_command(command));
}

}  // namespace
}  // namespace playerlike
