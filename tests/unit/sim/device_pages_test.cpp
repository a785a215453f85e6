// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Each device type has a page, a world and consistent defaults; each shipped world runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "field_pages.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/builtin.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {

/// Prints the name of a kind of device in GoogleTest's output.
void PrintTo(const DeviceKind& kind, std::ostream* os) { *os << kind.name; }

namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using testing::Contains;

const fs::path kRoot(PLAYPEN_SOURCE_DIR);

/// A row of a page's table of settings, without backticks.
struct Setting {
  std::string key;
  std::string unit;
  std::string range;  ///< "(0, 1000]", or "–"
  std::string default_value;
};

std::string trimmed(std::string text) {
  std::erase(text, '`');
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The rows of the table under "## Settings".
std::vector<Setting> settings_of(const std::string& page) {
  std::vector<Setting> settings;
  std::istringstream lines(page);
  std::string line;
  bool in_section = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("## ")) in_section = line == "## Settings";
    if (!in_section || !line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
    cells.resize(std::max<std::size_t>(cells.size(), 4));
    settings.push_back({cells[0], cells[1], cells[2], cells[3]});
  }
  return settings;
}

/// A world with one robot, which has an additional device of a type with these settings.
std::string world_with(const std::string& type, const std::string& settings) {
  return R"({"robots": [{"devices": {"example": {"type": ")" + type + "\"" +
         (settings.empty() ? "" : ", " + settings) + "}}}]}";
}

std::vector<ConfigIssue> issues_of(const std::string& type, const std::string& settings) {
  try {
    static_cast<void>(load_world_text(world_with(type, settings)));
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

/// The device's numeric settings after reading, as clients get them.
std::map<std::string, double> read_properties(const DeviceKind& kind, const std::string& settings) {
  const WorldDescription world = load_world_text(world_with(kind.name, settings));
  for (const DeviceDescription& device : world.robots.at(0).devices) {
    if (device.name == "example") return kind.properties(device.params);
  }
  ADD_FAILURE() << "the device was not read";
  return {};
}

/// Whether the reader refuses a number for a key as out of range.
bool out_of_range(const std::string& type, const std::string& key, const std::string& value) {
  std::vector<std::string> found;
  for (const ConfigIssue& issue : issues_of(type, "\"" + key + "\": " + value)) {
    if (issue.pointer == "/robots/0/devices/example/" + key) found.push_back(issue.id);
  }
  return std::find(found.begin(), found.end(), "world/out-of-range") != found.end();
}

class DevicePage : public testing::TestWithParam<DeviceKind> {
 protected:
  [[nodiscard]] static const std::string& type() { return GetParam().name; }
  [[nodiscard]] static fs::path page_file() { return kRoot / "docs/devices" / (type() + ".md"); }
  [[nodiscard]] static fs::path world_file() {
    return kRoot / "worlds/devices" / (type() + ".json");
  }
  [[nodiscard]] static std::vector<Setting> settings() {
    return settings_of(read_bytes(page_file()));
  }
};

INSTANTIATE_TEST_SUITE_P(All, DevicePage, testing::ValuesIn(device_kinds()),
                         [](const auto& row) { return row.param.name; });

TEST_P(DevicePage, ExistsForEachType) {
  ASSERT_TRUE(fs::exists(page_file())) << page_file();
  EXPECT_TRUE(read_bytes(page_file()).starts_with("# " + type() + "\n"));
}

TEST_P(DevicePage, TableMatchesFields) {
  const std::string made = test::settings_table(GetParam());
  if (made.empty()) return;
  EXPECT_TRUE(test::is_table_of_page(page_file().string(), "## Settings", made))
      << "PLAYPEN_WRITE_PAGES=1 writes it anew\n"
      << made;
}

TEST_P(DevicePage, ListsKeysOfReaderOnly) {
  std::vector<std::string> expected;
  for (const ConfigIssue& issue : issues_of(type(), "\"zz\": 0")) {
    if (issue.id == "world/unknown-key") expected.push_back(issue.expected);
  }
  ASSERT_EQ(expected.size(), 1U);
  // "one of the keys a, b or c", "no key but type"
  std::string list = expected[0];
  if (list.rfind("one of ", 0) == 0) list.erase(0, 7);  // a key may be named "of"
  std::replace(list.begin(), list.end(), ',', ' ');
  std::istringstream words(list);
  std::set<std::string> known;
  for (std::string word; words >> word;) known.insert(word);
  for (const char* word : {"the", "keys", "or", "no", "key", "but"}) known.erase(word);
  ASSERT_EQ(known.erase("type"), 1U) << expected[0];

  std::set<std::string> listed;
  for (const Setting& setting : settings()) listed.insert(setting.key);
  EXPECT_EQ(listed, known);
}

TEST_P(DevicePage, DefaultsMatchReader) {
  const auto defaults = GetParam().properties(GetParam().defaults());
  for (const Setting& setting : settings()) {
    const auto read =
        read_properties(GetParam(), "\"" + setting.key + "\": " + setting.default_value);
    ASSERT_EQ(read.size(), defaults.size());
    for (const auto& [name, value] : defaults) {
      // The page has at least 9 digits if a number is not short.
      EXPECT_NEAR(read.at(name), value, 1e-9 * std::max(1.0, std::abs(value)))
          << setting.key << ": " << setting.default_value << " makes another " << name;
    }
  }
}

/// A number of a page, independent of the locale.
double number_of(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST_P(DevicePage, RangesMatchReader) {
  const std::regex kRange(R"(([\[(])([-0-9.]+), ([-0-9.]+)([\])]))");
  for (const Setting& setting : settings()) {
    std::smatch range;
    if (!std::regex_match(setting.range, range, kRange)) {
      EXPECT_EQ(setting.range, "–") << setting.key;
      continue;
    }
    const std::string low = range[2];
    const std::string high = range[3];
    EXPECT_EQ(out_of_range(type(), setting.key, low), range[1] == "(") << setting.key;
    EXPECT_EQ(out_of_range(type(), setting.key, high), range[4] == ")") << setting.key;
    EXPECT_TRUE(out_of_range(type(), setting.key, shortest_text(number_of(low) - 1.0)))
        << setting.key;
    EXPECT_TRUE(out_of_range(type(), setting.key, shortest_text(number_of(high) + 1.0)))
        << setting.key;
  }
}

TEST_P(DevicePage, SchemaHasSameKeys) {
  const auto schema = nlohmann::json::parse(read_bytes(kRoot / "worlds/schema/world.schema.json"));
  std::set<std::string> in_schema;
  const auto& settings_object = schema.at("$defs").at("device_" + type()).at("oneOf").at(0);
  for (const auto& [key, value] : settings_object.at("properties").items()) in_schema.insert(key);
  in_schema.erase("type");
  std::set<std::string> listed;
  for (const Setting& setting : settings()) listed.insert(setting.key);
  EXPECT_EQ(in_schema, listed);
  EXPECT_TRUE(schema.at("$defs")
                  .at("robot")
                  .at("properties")
                  .at("devices")
                  .at("properties")
                  .contains(type()));
}

TEST_P(DevicePage, EmptySettings_GiveDefaults) {
  EXPECT_EQ(read_properties(GetParam(), ""), GetParam().properties(GetParam().defaults()));
  EXPECT_EQ(GetParam().properties({}), GetParam().properties(GetParam().defaults()));
}

TEST_P(DevicePage, ExampleWorldSetsEachSetting) {
  ASSERT_TRUE(fs::exists(world_file())) << world_file();
  Simulation simulation(load_world(world_file().string()));
  int devices = 0;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    for (int device = 0; device < simulation.device_count(robot); ++device) {
      if (simulation.device(robot, device).type() == type()) ++devices;
    }
  }
  EXPECT_GT(devices, 0);
  const std::string text = read_bytes(world_file());
  for (const Setting& setting : settings()) {
    EXPECT_NE(text.find("\"" + setting.key + "\":"), std::string::npos)
        << setting.key << " is not shown in " << world_file();
  }
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_EQ(simulation.steps(), 100U);
}

/// Compares the table of a page that begins with `head`, or writes it anew.
void expect_table(const std::string& name, const std::string& head, const std::string& made) {
  const fs::path file = kRoot / "docs" / name;
  const std::string page = read_bytes(file);
  const std::size_t first = page.find(head);
  ASSERT_NE(first, std::string::npos) << name;
  const std::size_t last = std::min(page.find("\n\n", first) + 1, page.size());
  if (test::writes_pages()) {
    test::write_page(file.string(), page.substr(0, first) + made + page.substr(last));
  } else {
    EXPECT_EQ(page.substr(first, last - first), made) << "PLAYPEN_WRITE_PAGES=1 writes it anew";
  }
}

TEST(RealismPage, TableMatchesFields) {
  expect_table("realism.md", "| device | setting |", test::realism_table());
}

TEST(ProtocolPage, ReadingsMatchFields) {
  expect_table("protocol.md", "| type | key | value |", test::readings_table());
}

/// The first sentence of a device's page, without links.
std::string first_sentence(const std::string& type) {
  std::string text = read_bytes(kRoot / "docs/devices" / (type + ".md"));
  text = text.substr(text.find("\n\n") + 2);
  text = text.substr(0, text.find("\n\n"));
  std::replace(text.begin(), text.end(), '\n', ' ');
  text = text.substr(0, text.find(". "));
  return std::regex_replace(text, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1");
}

TEST(IndexPage, ListsDevices) {
  std::map<std::string, std::string> devices;
  for (const DeviceKind& kind : device_kinds()) devices[kind.name] = first_sentence(kind.name);
  std::string table = "| device | what it is |\n|---|---|\n";
  for (const auto& [type, sentence] : devices) {
    table += "| [" + type + "](devices/" + type + ".md) | " + sentence + " |\n";
  }
  expect_table("index.md", "| device | what it is |", table);
}

TEST(DevicePages, KnownTypesOnly) {
  std::set<std::string> types;
  for (const DeviceKind& kind : device_kinds()) types.insert(kind.name);
  for (const char* folder : {"docs/devices", "worlds/devices"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / folder)) {
      EXPECT_THAT(types, Contains(entry.path().stem().string())) << entry.path();
    }
  }
}

TEST(ShippedWorlds, LoadAndStep) {
  int worlds = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / "worlds")) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".json") || file.ends_with(".schema.json") ||
        file.ends_with(".task.json") || entry.path().parent_path().filename() == "models") {
      continue;
    }
    ++worlds;
    std::optional<Simulation> simulation;
    ASSERT_NO_THROW(simulation.emplace(load_world(file))) << file;
    for (int i = 0; i < 100; ++i) simulation->step();
    EXPECT_EQ(simulation->steps(), 100U) << file;
  }
  EXPECT_GE(worlds, 10);
}

// A test of the page's reader itself: one that finds nothing must fail.
TEST(DevicePageTable, ReadFromItsSectionOnly) {
  const std::vector<Setting> settings = settings_of(
      "# x\n| `a` | m | – | `1` | no |\n## Settings\n| key | unit | range | default |\n|---|---|\n"
      "| `b` | m | (0, 1] | `2` | yes |\n## Reading\n| `c` | m | [0, 1] | `3` | no |\n");
  ASSERT_EQ(settings.size(), 1U);
  EXPECT_EQ(settings[0].key, "b");
  EXPECT_EQ(settings[0].range, "(0, 1]");
  EXPECT_EQ(settings[0].default_value, "2");
}

}  // namespace
}  // namespace sim
