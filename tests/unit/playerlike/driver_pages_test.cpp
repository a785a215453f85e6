// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The tables of settings in the drivers' pages, and their part of the schema, are those of the
// fields. PLAYPEN_WRITE_PAGES=1 writes them anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "field_schema.h"
#include "playerlike/messages/driver_settings.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using sim::test::Json;

const std::string kRoot(PLAYPEN_SOURCE_DIR);

struct Page {
  std::string type;
  std::string file;  // in docs
  std::string description;
};
const std::vector<Page>& pages() {
  static const std::vector<Page> kPages = {
      {"snd", "snd.md",
       "Smooth Nearness-Diagram navigation: a position2d whose GoTo() avoids obstacles."},
      {"vfh", "vfh.md", "VFH+: a position2d whose GoTo() avoids obstacles."},
      {"nd", "nd.md", "Nearness-Diagram navigation: a position2d whose GoTo() avoids obstacles."},
      {"goto", "drivers.md", "A position2d whose GoTo() drives straight to the goal."},
      {"wavefront", "wavefront.md", "A planner that drives the robot along paths on the map."},
      {"lasercspace", "lasercspace.md",
       "A laser whose ranges end at the border of the free configuration space."},
      {"laserposeinterpolator", "laserposeinterpolator.md",
       "A laser whose scans have the robot's pose."},
      {"lasertoranger", "drivers.md", "Changes nothing: every laser is a ranger, too."},
      {"rangertolaser", "drivers.md", "Changes nothing: every ranger of a laser is a laser, too."},
      {"localbb", "drivers.md", "Changes nothing: every port has blackboard:0."}};
  return kPages;
}

// Calls visit(type, object with its defaults) for each driver.
template <typename Visit>
void for_each_driver(Visit visit) {
  for (const DriverType& type : driver_types()) {
    const auto& kinds = goal_driver_kinds();
    const auto kind = std::ranges::find_if(
        kinds, [&](const GoalDriverKind& known) { return type.name == known.name; });
    const auto& scans = scan_driver_kinds();
    const auto scan = std::ranges::find_if(
        scans, [&](const ScanDriverKind& known) { return type.name == known.name; });
    if (kind != kinds.end()) {
      const GoalDriverSettings defaults = kind->make();
      visit(type, sim::object_in(defaults));
    } else if (scan != scans.end()) {
      const ScanDriverSettings defaults = scan->make();
      visit(type, sim::object_in(defaults));
    } else {
      const WavefrontSettings defaults;  // converters have no table of their own
      visit(type, static_cast<const void*>(&defaults));
    }
  }
}

const Page& page_of(const DriverType& type) {
  return *std::ranges::find(pages(), type.name, &Page::type);
}

// Whether the default of a field depends on other settings or on the robot.
bool has_own_default(const sim::Field& field, const void* defaults) {
  const void* const value = field.get(defaults);
  if (value == nullptr) return false;
  return field.type != sim::FieldType::kInt || sim::integer_at(field, value) >= field.least;
}

std::string table_of(const DriverType& type, const void* defaults) {
  std::string table = sim::test::kFieldTableHead;
  for (const sim::Field& field : type.settings->fields) {
    table += sim::test::field_row(
        field, sim::test::range_text(field),
        has_own_default(field, defaults)
            ? "`" + sim::test::line_of_json(sim::test::value_json(field, defaults)) + "`"
            : "–");
  }
  return table;
}

TEST(DriverPages, ExistsForEachDriver) {
  std::vector<std::string> types;
  for (const DriverType& type : driver_types()) types.push_back(type.name);
  std::vector<std::string> described;
  for (const Page& page : pages()) described.push_back(page.type);
  EXPECT_EQ(types, described);
}

TEST(DriverPages, Tables_MatchFields) {
  for_each_driver([](const DriverType& type, const void* defaults) {
    if (type.settings->fields.empty()) return;
    const std::string file = kRoot + "/docs/" + page_of(type).file;
    const std::string page = test_support::read_bytes(file);
    if (type.name == "snd") {  // its table also names the fields of SndSettings
      for (const sim::Field& field : type.settings->fields) {
        const std::string row = "\n| `" + std::string(field.name) + "` | `";
        const std::size_t at = page.find(row);
        ASSERT_NE(at, std::string::npos) << field.name;
        EXPECT_NE(page.substr(at, page.find('\n', at + 1) - at).find(sim::test::range_text(field)),
                  std::string::npos)
            << field.name;
      }
      return;
    }
    const std::string made = table_of(type, defaults);
    const std::string heading = type.name == "goto" ? "## goto" : "## Settings";
    EXPECT_TRUE(sim::test::is_table_of_page(file, heading, made))
        << file << ": PLAYPEN_WRITE_PAGES=1 writes it anew\n"
        << made;
  });
}

Json index_schema(const std::string& description, std::optional<int> by_default) {
  Json schema = {
      {"description", description}, {"type", "integer"}, {"minimum", 0}, {"maximum", 65535}};
  if (by_default) schema["default"] = *by_default;
  return schema;
}

// The interface that a driver provides; null: none.
const char* interface_of(const DriverType& type) {
  switch (type.use) {
    case DriverUse::kDrives:
      return "position2d";
    case DriverUse::kPlans:
      return "planner";
    case DriverUse::kScans:
      return "laser";
    case DriverUse::kConverts:
      break;
  }
  return nullptr;
}

Json with_drivers(Json schema) {
  Json made = Json::object();
  Json choices = Json::array();
  for_each_driver([&](const DriverType& type, const void* defaults) {
    Json properties = {{"type", {{"description", "The driver."}, {"const", type.name}}}};
    if (const char* const interface = interface_of(type)) {
      properties["index"] = index_schema(std::string("Index of its ") + interface +
                                             " on the robot's port; by default the first free one.",
                                         std::nullopt);
    }
    if (type.use == DriverUse::kDrives) {
      properties["position"] =
          index_schema("Index of the robot's position2d that measures its pose.", 0);
    }
    if (type.use != DriverUse::kPlans && type.name != "localbb") {
      properties["laser"] = index_schema("Index of the robot's laser.", 0);
    }
    for (const sim::Field& field : type.settings->fields) {
      sim::test::add_schema(field, has_own_default(field, defaults) ? defaults : nullptr,
                            properties);
    }
    made["driver_" + type.name] = {
        {"description", page_of(type).description + " See docs/" + page_of(type).file + "."},
        {"type", "object"},
        {"properties", properties},
        {"required", {"type"}},
        {"additionalProperties", false}};
    choices.push_back({{"if", {{"properties", {{"type", {{"const", type.name}}}}}}},
                       {"then", {{"$ref", "#/$defs/driver_" + type.name}}}});
  });
  Json definitions = Json::object();
  for (const auto& [key, value] : schema.at("$defs").items()) {
    if (key.starts_with("driver_")) continue;
    definitions[key] = value;
    if (key != "driver") continue;
    definitions[key].erase("if");
    definitions[key].erase("then");
    definitions[key]["allOf"] = choices;
    for (const auto& [name, driver] : made.items()) definitions[name] = driver;
  }
  schema["$defs"] = definitions;
  return schema;
}

TEST(DriverPages, Schema_MatchesFields) {
  const std::string file = kRoot + "/worlds/schema/world.schema.json";
  const std::string now = test_support::read_bytes(file);
  const std::string made = sim::test::json_text(with_drivers(Json::parse(now))) + "\n";
  if (sim::test::writes_pages()) sim::test::write_page(file, made);
  EXPECT_TRUE(now == made || sim::test::writes_pages())
      << file << " is not what the fields say: set PLAYPEN_WRITE_PAGES=1 to write it anew";
}

}  // namespace
}  // namespace playerlike
