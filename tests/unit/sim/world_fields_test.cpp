// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What is derived from the tables of fields of worlds.
#include "world/world_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "field_pages.h"
#include "field_values.h"
#include "io/check_ranges.h"
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

/// Sets each number of each kind above its range, one at a time, and expects an error there.
/// @return the number of numbers.
template <typename Variant>
int expect_checked(const Field& list) {
  int count = 0;
  for (const Kind& kind : list.kinds) {
    Variant variant;
    for_each_field(kind.table(), kind.make(&variant), [&](const Field& field, void* owner) {
      if (field.type != FieldType::kNumber || field.set == nullptr) return;
      const double before = *static_cast<const double*>(field.set(owner));
      *static_cast<double*>(field.set(owner)) =
          (2.0 * field.range.max + 1.0) * (field.is_angle ? kDegrees : 1.0);
      const auto error = io::out_of_range(kind.table(), owner, {field.name});
      EXPECT_TRUE(error && error->key == std::string("/") + field.name) << kind.word << field.name;
      *static_cast<double*>(field.set(owner)) = before;
      EXPECT_FALSE(io::out_of_range(kind.table(), owner, {field.name})) << kind.word << field.name;
      ++count;
    });
  }
  return count;
}

TEST(CheckRanges, NumberAboveRange_IsReported) {
  const FieldTable& timer = fields_of<TimerDescription>();
  EXPECT_GE(expect_checked<ArenaCondition>(field_named(timer, "if")), 10);
  EXPECT_GE(expect_checked<ArenaAction>(field_named(timer, "do")), 2);
  EXPECT_GE(expect_checked<TrapRegion>(field_named(fields_of<TrapDescription>(), "region")), 3);
}

TEST(CheckRanges, WrongPartsOfController_AreReportedWithTheirPlaces) {
  ControllerDescription controller;
  TimerDescription& timer = controller.timers.emplace_back();
  timer.every_s = 1e-4;
  timer.at_s = std::numeric_limits<double>::infinity();
  MoveAction move;
  move.motion.speed_mps = std::numeric_limits<double>::quiet_NaN();
  move.motion.points = {{0.0, 2e4}};
  timer.actions = {MessageAction{std::string(201, 'x')}, move};
  controller.traps.resize(2);
  controller.traps[0].region = NearRegion{"r1", 0.0};
  controller.traps[1].region = PolygonRegion{};
  std::vector<std::string> found;
  io::check_ranges(fields_of<ControllerDescription>(), &controller, "/controller",
                   [&found](const io::SolidError& error) {
                     found.push_back(error.key + ": " + error.expected);
                   });
  EXPECT_THAT(
      found, testing::ElementsAre(
                 "/controller/timers/0/every: a number from 0.001 to 100000000 s",
                 "/controller/timers/0/at: a number from 0 to 100000000 s",
                 "/controller/timers/0/do/0/message: a text of at most 200 bytes",
                 "/controller/timers/0/do/1/move/speed: a number greater than 0 and at most 10 m/s",
                 "/controller/timers/0/do/1/move/path/0/1: a number from -10000 to 10000 m",
                 "/controller/traps/0/near/distance: a number greater than 0 and at most 10000 m",
                 "/controller/traps/1/region/polygon: at least 3 corners"));
}

}  // namespace
}  // namespace sim
