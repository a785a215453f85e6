// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Choices of devices for indices of an interface (--interface).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/host/run_settings.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace playerlike {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// r1 has three rangers, r2 only a laser.
constexpr const char* kWorld = R"({
  "arena": {"size": [4, 4]},
  "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 1},
     "devices": {"pose": {}, "laser": {"beams": 91}, "sonar": {}, "infrared": {}}},
    {"name": "r2", "pose": {"x": 3, "y": 3}, "devices": {"pose": {}, "laser": {"beams": 91}}}]})";

std::vector<InterfaceChoice> choices(std::initializer_list<const char*> texts) {
  std::vector<InterfaceChoice> all;
  for (const char* text : texts) {
    all.emplace_back();
    EXPECT_TRUE(parse_interface_choice(text, all.back())) << text;
  }
  return all;
}

/// Returns the rangers of a robot after the choices were applied.
std::vector<std::string> rangers(std::size_t robot, std::initializer_list<const char*> texts) {
  sim::WorldDescription world = sim::load_world_text(kWorld);
  apply_interface_choices(world, choices(texts));
  return device_order(world.robots[robot], "ranger");
}

std::string error_of(std::initializer_list<const char*> texts) {
  sim::WorldDescription world = sim::load_world_text(kWorld);
  try {
    apply_interface_choices(world, choices(texts));
  } catch (const sim::ConfigError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(InterfaceChoices, DeviceMovesToIndexAndOthersKeepOrder) {
  EXPECT_THAT(rangers(0, {}), ElementsAre("laser", "sonar", "infrared"));
  EXPECT_THAT(rangers(0, {"ranger:0=sonar"}), ElementsAre("sonar", "laser", "infrared"));
  EXPECT_THAT(rangers(0, {"r1.ranger:2=laser"}), ElementsAre("sonar", "infrared", "laser"));
  EXPECT_THAT(rangers(0, {"r1.ranger:2=laser", "ranger:0=infrared"}),
              ElementsAre("infrared", "sonar", "laser"));
}

TEST(InterfaceChoices, NoRobot_AppliesToEachWithDevice) {
  EXPECT_THAT(rangers(1, {"ranger:0=sonar"}), ElementsAre("laser"));
  EXPECT_THAT(rangers(1, {"ranger:0=laser"}), ElementsAre("laser"));
  EXPECT_THAT(rangers(0, {"r1.ranger:0=infrared"}), ElementsAre("infrared", "laser", "sonar"));
  EXPECT_THAT(rangers(0, {"r2.ranger:0=laser"}), ElementsAre("laser", "sonar", "infrared"));
}

TEST(InterfaceChoices, ProgramsSeeThem) {
  RunSettings settings;
  settings.interfaces = choices({"ranger:0=sonar"});
  const auto host = Host::create(sim::load_world_text(kWorld), settings);
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::RangerProxy sonars(&client, 0);
  PlayerCc::RangerProxy laser(&client, 1);
  EXPECT_EQ(sonars.GetDriverName(), "sonar");
  EXPECT_EQ(laser.GetDriverName(), "laser");
  client.Read();
  EXPECT_EQ(laser.GetRangeCount(), 91U);
}

TEST(InterfaceChoices, UnknownRobotInterfaceOrDevice_ErrorListsExisting) {
  EXPECT_EQ(error_of({"r3.ranger:0=laser"}),
            "--interface r3.ranger:0=laser: expected a robot of this world: r1, r2, found \"r3\" "
            "(did you mean \"r1\"?) [run/interface]");
  EXPECT_THAT(error_of({"rangers:0=laser"}),
              AllOf(HasSubstr("an interface that devices have: "), HasSubstr("\"rangers\""),
                    HasSubstr("did you mean \"ranger\"?")));
  EXPECT_EQ(error_of({"ranger:0=lasers"}),
            "--interface ranger:0=lasers: expected a device with the interface ranger of a robot "
            "of this world: laser, sonar, infrared, found \"lasers\" (did you mean \"laser\"?) "
            "[run/interface]");
  EXPECT_THAT(error_of({"r2.ranger:0=sonar"}), HasSubstr("of r2: laser, found \"sonar\""));
  EXPECT_THAT(error_of({"ranger:0=pose"}), HasSubstr("found \"pose\""));
}

TEST(InterfaceChoices, IndexBeyondDevices_Refused) {
  EXPECT_EQ(error_of({"r1.ranger:3=laser"}),
            "--interface r1.ranger:3=laser: expected an index from 0 to 2: r1 has 3 devices with "
            "the interface ranger, found 3 [run/interface]");
  EXPECT_THAT(error_of({"ranger:1=laser"}),
              HasSubstr("expected an index from 0 to 0: r2 has 1 device with"));
}

TEST(InterfaceChoices, DuplicateIndexOrDevice_Refused) {
  EXPECT_EQ(error_of({"ranger:0=laser", "r1.ranger:0=sonar"}),
            "--interface r1.ranger:0=sonar: expected each index and each device of an interface "
            "once, found ranger:0 again, for r1 [run/interface]");
  EXPECT_THAT(error_of({"r1.ranger:0=laser", "r1.ranger:1=laser"}),
              HasSubstr("found laser again, for r1"));
}

TEST(InterfaceChoices, Syntax_Checked) {
  InterfaceChoice choice;
  for (const char* text : {"", "ranger", "ranger:0", "ranger=laser", "ranger:=laser", ":0=laser",
                           "ranger:0=", "ranger:-1=laser", "ranger:x=laser", ".ranger:0=laser",
                           "ranger:0=laser,ranger:1=sonar", "ranger:0 =laser"}) {
    EXPECT_FALSE(parse_interface_choice(text, choice)) << text;
  }
  EXPECT_TRUE(parse_interface_choice("r.1.ranger:12=front_laser", choice));
  EXPECT_EQ(choice.robot, "r.1");
  EXPECT_EQ(choice.interface, "ranger");
  EXPECT_EQ(choice.index, 12);
  EXPECT_EQ(choice.device, "front_laser");
}

}  // namespace
}  // namespace playerlike
