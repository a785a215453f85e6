// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What is derived from the tables of fields of worlds.
#include "world/world_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "field_pages.h"
#include "field_values.h"
#include "io/document.h"
#include "sim/io/field_reader.h"
#include "sim/simulation/world_hash.h"

namespace sim {
namespace {

using test::OneChange;

/// A world with a value in each of its fields, and a robot of a model of its own.
WorldDescription full_world() {
  WorldDescription world;
  test::fill(fields_of<WorldDescription>(), &world);
  RobotDescription& robot = world.robots.at(0);
  robot.proxies["laser"] = 1;
  robot.interfaces["laser"] = {"laser"};
  robot.drivers.at(0).settings["speed"] = "1";
  robot.model = "own";
  RobotModel model;
  test::fill(fields_of<RobotModel>(), &model);
  world.models["own"] = std::make_shared<const RobotModel>(model);
  return world;
}

/// Changes one value after another and expects another hash exactly for those that are part of a
/// world's identity.
/// @param change  makes a change in a world.
/// @return the number of changes.
template <typename Change>
int expect_other_hashes(const WorldDescription& world, const Change& change) {
  const std::uint64_t hash = world_hash(world);
  for (int number = 0;; ++number) {
    OneChange one(number);
    WorldDescription changed = world;
    change(changed, one);
    if (!one.is_made()) return number;
    EXPECT_EQ(world_hash(changed) != hash, one.is_of_identity()) << one.place();
  }
}

TEST(WorldHash, ChangedField_ChangesHash) {
  const int changes = expect_other_hashes(full_world(), [](WorldDescription& world, auto& one) {
    one.visit(fields_of<WorldDescription>(), &world);
  });
  EXPECT_GT(changes, 300);
}

TEST(WorldHash, ChangedFieldOfModel_ChangesHash) {
  const int changes = expect_other_hashes(full_world(), [](WorldDescription& world, auto& one) {
    RobotModel model = *world.models.at("own");
    one.visit(fields_of<RobotModel>(), &model);
    world.models["own"] = std::make_shared<const RobotModel>(std::move(model));
  });
  EXPECT_GT(changes, 15);
}

TEST(WorldHash, ChangedSettingOfDevice_ChangesHash) {
  for (const DeviceKind& kind : device_kinds()) {
    WorldDescription world = full_world();
    DeviceDescription& device = world.robots.at(0).devices.emplace_back();
    device = {"example", kind.name, kind.defaults(), {}};
    test::fill(*kind.settings, const_cast<void*>(kind.settings_in(device.params)));
    expect_other_hashes(world, [&kind](WorldDescription& changed, auto& one) {
      std::any& params = changed.robots.at(0).devices.at(0).params;
      one.visit(*kind.settings, const_cast<void*>(kind.settings_in(params)), kind.name);
    });
  }
}

TEST(WorldHash, UnchangedWorld_KeepsHash) {
  EXPECT_EQ(world_hash(full_world()), world_hash(full_world()));
}

/// Writes a filled struct, reads it into another one and expects the same text.
/// @param make  returns a struct of default values.
template <typename Make>
void expect_read_as_written(const FieldTable& table, const Make& make, const std::string& what) {
  const auto text_of = [&table](const void* object) {
    return test::line_of_json(test::object_json(table, object));
  };
  void* object = make();
  test::fill(table, object);
  const std::string written = text_of(object);
  io::Reader::Document document;
  ASSERT_TRUE(io::parse_document(written, document)) << written;
  io::Reader reader(document, document.root, "");
  object = make();
  io::read_fields(reader, table, object);
  reader.finish();
  for (const ConfigIssue& issue : document.issues) ADD_FAILURE() << what << issue.message();
  EXPECT_EQ(text_of(object), written) << what;
}

template <typename Struct>
void expect_read_as_written(const std::string& what) {
  Struct object;
  const auto make = [&object]() -> void* {
    object = Struct();
    return &object;
  };
  expect_read_as_written(fields_of<Struct>(), make, what);
}

template <typename Variant>
void expect_read_as_written(const Field& list, const std::string& without) {
  Variant variant;
  for (const Kind& kind : list.kinds) {
    if (kind.word == without) continue;
    expect_read_as_written(
        kind.table(), [&]() -> void* { return kind.make(&variant); }, kind.word);
  }
}

TEST(WorldFields, WrittenStruct_IsReadAsWritten) {
  expect_read_as_written<DockDescription>("dock");
  expect_read_as_written<Elevation>("elevation");
  expect_read_as_written<SocialForce>("force");
  expect_read_as_written<ObstacleMotion::Area>("area");
  expect_read_as_written<SimulationDescription>("simulation");
  expect_read_as_written<ArenaConfiguration>("configuration");
}

TEST(WorldFields, WrittenConditionOrAction_IsReadAsWritten) {
  const FieldTable& timer = fields_of<TimerDescription>();
  expect_read_as_written<ArenaCondition>(field_named(timer, "if"), "");
  // "move" has a format of its own.
  expect_read_as_written<ArenaAction>(field_named(timer, "do"), "move");
}

}  // namespace
}  // namespace sim
