// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files of Stage and configuration files of Player as people write them: what Stage reads in
// its own way, what older versions had, and what is left out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include "sim/core/error.h"
#include "sim/core/utf8.h"
#include "sim/devices/builtin.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class StageFiles : public testing::Test {
 protected:
  WorldDescription read(const std::string& text) {
    return load_world(folder_.write("w.world", text));
  }

  ConfigIssue issue_of(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const ConfigError& error) {
      return error.issues().front();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
  }

  /// A PGM of one shade.
  void write_dark_picture(const std::string& name, int width, int height) {
    std::string text = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    text.append(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\0');
    folder_.write(name, text);
  }

  static const RobotModel& model(const WorldDescription& world, std::size_t robot) {
    return *find_robot_model(world, world.robots.at(robot).model);
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(StageFiles, NonUtf8_ReadAsLatin1) {
  // 0xE9 is an e with an acute accent; as UTF-8 it has two bytes, and names have _ for each.
  folder_.write("w.world",
                "position ( name \"caf\xe9\" pose [ 0 0 0 0 ] ranger ( sensor ( "
                "range [ 0 5 ] samples 5 fov 180 ) ) )");
  const WorldDescription world = load_world(folder_.write(
      "w.cfg",
      "driver ( name \"stage\" provides [ \"simulation:0\" ] worldfile \"w.world\" )\n"
      "driver ( name \"stage\" provides [ \"position2d:0\" \"ranger:0\" ] model "
      "\"caf\xe9\" )\n"
      "driver ( name \"rangertolaser\" provides [ \"l\xe4s:0\" ] requires [ "
      "\"ranger:0\" ] )\n"));
  ASSERT_THAT(world.robots, SizeIs(1));
  EXPECT_EQ(world.robots[0].name, "caf__");
}

TEST_F(StageFiles, FirstDefinition_Counts) {
  const WorldDescription world = read(
      "define bot position ( size [0.4 0.4 0.2] mass 3 )\n"
      "define bot position ( size [0.8 0.8 0.2] mass 9 )\n"
      "bot ( )\n");
  EXPECT_EQ(model(world, 0).mass_kg, 3.0);
  EXPECT_THAT(world.notes, Contains(AllOf(HasSubstr("w.world:2: this definition of \"bot\""),
                                          HasSubstr("w.world:1"))));
}

TEST_F(StageFiles, RepeatedInclude_Accepted) {
  folder_.write("bot.inc", "define bot position ( size [0.4 0.4 0.2] )\n");
  const WorldDescription world = read("include \"bot.inc\"\ninclude \"bot.inc\"\nbot ( )\n");
  EXPECT_THAT(world.notes, IsEmpty());
}

TEST_F(StageFiles, Numbers_ReadAsInStage) {
  const WorldDescription world = read(
      "position ( size [0.4.1 \"0.4\" 0.2] mass \"12.5\" name 7 pose [1 +2 0 0] drive \"tank\" "
      ")\n");
  const Polygon& footprint = model(world, 0).footprint;
  ASSERT_THAT(footprint, SizeIs(4));
  EXPECT_NEAR(area_m2(footprint), 0.16, 1e-9);
  EXPECT_EQ(model(world, 0).mass_kg, 12.5);
  EXPECT_EQ(world.robots[0].name, "7");
  EXPECT_EQ(world.robots[0].pose.y_m, 2.0);
  EXPECT_THAT(world.notes, Contains(HasSubstr("0.4.1 is read as 0.4, as in Stage")));
  EXPECT_EQ(model(world, 0).drive.kind, DriveKind::kDifferential);
  EXPECT_THAT(world.notes, Contains(HasSubstr("\"diff\" is used, as in Stage")));
}

TEST_F(StageFiles, LineEndsBlanksAndComments_Ignored) {
  const std::string lines =
      "\xef\xbb\xbf# a comment (with a bracket\r\nposition#here\r\n(\t#\"\r\n\tsize [0.4 "
      "0.4\t0.2]#]\r\n"
      "name \"r\xe9\" # Latin-1\r\n)# no end of line";
  const WorldDescription world = read(lines);
  ASSERT_THAT(world.robots, SizeIs(1));
  EXPECT_THAT(world.notes, IsEmpty());
}

TEST_F(StageFiles, Gazebo_RefusedByName) {
  for (const char* text :
       {"<?xml version=\"1.0\"?>\n<sdf/>", "\xef\xbb\xbf\n  <sdf version='1.6'>"}) {
    const ConfigIssue issue = issue_of(text);
    EXPECT_EQ(issue.id, "stage/gazebo");
    EXPECT_THAT(issue.found, HasSubstr("Gazebo"));
  }
}

TEST_F(StageFiles, Stage1Models_RefusedByName) {
  const ConfigIssue issue = issue_of("environment ( file \"cave.pnm\" )");
  EXPECT_EQ(issue.id, "stage/unknown-model");
  EXPECT_THAT(issue.hint, HasSubstr("Stage 1"));
}

TEST_F(StageFiles, Stage2DevicesWithoutCounterpart_LeftOut) {
  const WorldDescription world = read("position ( size [0.4 0.4 0.2] speech ( ) audio ( ) )\n");
  EXPECT_THAT(world.notes, ElementsAre(HasSubstr("speech of Stage 2"), HasSubstr("audio of")));
}

TEST_F(StageFiles, Stage2Bodies_ArePolygons) {
  const WorldDescription world = read(R"(
position (
  size [0.4 0.4]
  polygons 1
  polygon[0].points 3
  polygon[0].point[0] [0 0]
  polygon[0].point[1] [10 0]
  polygon[0].point[2] [0 10]
  polygon[0].filled 1
)
)");
  EXPECT_THAT(model(world, 0).footprint, SizeIs(3));
  EXPECT_NEAR(area_m2(model(world, 0).footprint), 0.08, 1e-9);
  EXPECT_THAT(world.notes, ElementsAre(HasSubstr("flat")));
}

TEST_F(StageFiles, SolidAroundRobot_Hollow) {
  const WorldDescription world = read(R"(
model ( name "room" size [6 4 1] pose [1 0 0 90] )
model ( name "box" size [1 1 1] pose [1 2 0 0] )
position ( name "r0" size [0.4 0.4 0.2] pose [1 0 0 0] )
)");
  EXPECT_EQ(world.robots[0].pose.x_m, 1.0);
  EXPECT_THAT(world.notes, Contains(HasSubstr("solids are hollow in Stage")));
  ASSERT_THAT(world.arena.obstacles, SizeIs(5));  // four walls and the box
  EXPECT_EQ(world.arena.obstacles[0].name, "room_side");
  EXPECT_EQ(world.arena.obstacles[4].name, "box");
  // The room turns by 90 degrees: its walls end at x = 1 +- 2 and y = +-3.
  double most_x_m = 0.0;
  double most_y_m = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (const Vec2& corner : corners_of(world.arena.obstacles[i])) {
      most_x_m = std::max(most_x_m, corner.x());
      most_y_m = std::max(most_y_m, corner.y());
    }
  }
  EXPECT_NEAR(most_x_m, 3.0, 1e-6);
  EXPECT_NEAR(most_y_m, 3.0, 1e-6);
}

TEST_F(StageFiles, ForeignPaths_SearchedBesideWorld) {
  folder_.write("bot.inc", "define bot position ( size [0.4 0.4 0.2] )\n");
  write_dark_picture("plan.pgm", 4, 4);
  const WorldDescription world = read(
      "include \"/nowhere/at/all/bot.inc\"\n"
      "model ( bitmap \"/nowhere/at/all/plan.pgm\" size [4 4 1] pose [5 0 0 0] )\n"
      "bot ( )\n");
  EXPECT_THAT(world.robots, SizeIs(1));
  EXPECT_THAT(world.arena.walls, SizeIs(1));
}

TEST_F(StageFiles, SmallPixels_Coarsened) {
  write_dark_picture("fine.pgm", 400, 1);
  const WorldDescription world = read(
      "model ( bitmap \"fine.pgm\" size [0.2 5 1] pose [3 0 0 0] )\n"  // 0.5 mm a pixel
      "position ( size [0.4 0.4 0.2] )\n");
  EXPECT_THAT(world.arena.walls, Not(IsEmpty()));
}

TEST_F(StageFiles, Bmp_Accepted) {
  // 2 x 2 pixels from the lower left: dark and light, then light and light.
  const auto bmp = [](int bits, const std::string& palette, const std::string& rows) {
    const auto number = [](std::size_t value, int bytes) {
      std::string text;
      for (int i = 0; i < bytes; ++i, value >>= 8U) text += static_cast<char>(value & 0xff);
      return text;
    };
    const std::size_t offset = 54 + palette.size();
    return "BM" + number(offset + rows.size(), 4) + number(0, 4) + number(offset, 4) +
           number(40, 4) + number(2, 4) + number(2, 4) + number(1, 2) +
           number(static_cast<std::size_t>(bits), 2) + number(0, 24) + palette + rows;
  };
  const std::string light = "\xff\xff\xff";
  const std::string dark(3, '\0');
  const std::string end(2, '\0');
  const std::string colours = dark + '\0' + light + '\0';
  const std::string files[] = {
      bmp(24, "", dark + light + end + light + light + end),
      bmp(1, colours, std::string("\x40\0\0\0\xc0\0\0\0", 8)),
      bmp(8, colours, std::string("\0\1\0\0\1\1\0\0", 8)),
  };
  for (const std::string& file : files) {
    folder_.write("plan.bmp", file);
    const WorldDescription world = read(
        "model ( bitmap \"plan.bmp\" size [4 4 1] )\nposition ( size [0.4 0.4 0.2] pose [5 0 0 0] "
        ")\n");
    // The only dark pixel is stretched to the size, as in Stage.
    ASSERT_THAT(world.arena.walls, SizeIs(1));
    EXPECT_NEAR(std::abs(area_m2(world.arena.walls[0].vertices)), 16.0, 1e-6);
  }
  folder_.write("plan.bmp", files[0].substr(0, 60));
  EXPECT_EQ(issue_of("model ( bitmap \"plan.bmp\" )").id, "stage/bitmap");
  folder_.write("plan.bmp", "BM");
  EXPECT_EQ(issue_of("model ( bitmap \"plan.bmp\" )").id, "stage/bitmap");
}

TEST_F(StageFiles, PicturesAbove8192Pixels_Accepted) {
  write_dark_picture("wide.pgm", 9000, 2);
  const WorldDescription world = read(
      "model ( bitmap \"wide.pgm\" size [90 1 1] pose [0 3 0 0] )\n"
      "position ( size [0.4 0.4 0.2] )\n");
  EXPECT_THAT(world.arena.walls, Not(IsEmpty()));
}

TEST_F(StageFiles, RobotsOnSamePort_HaveDevicesOfFile) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["6665:position2d:0" "6665:ranger:0"] model "a" )
driver ( name "stage" provides ["6665:position2d:1" "6665:ranger:1"] model "b" )
)");
  const std::string text = R"(
define bot position ( size [0.4 0.4 0.2]
  ranger ( sensor ( samples 16 fov 90 ) ) ranger ( sensor ( samples 1 ) sensor ( samples 1 ) ) )
bot ( name "a" ) bot ( name "b" pose [2 0 0 0] )
)";
  const WorldDescription world = read(text);
  EXPECT_EQ(world.robots_on_port, 6665);
  for (const RobotDescription& robot : world.robots) {
    EXPECT_THAT(robot.interfaces.at("position2d"), ElementsAre("pose"));
    EXPECT_THAT(robot.interfaces.at("ranger"), ElementsAre("laser"));
    for (const DeviceDescription& one : model(world, 0).devices) {
      EXPECT_NE(one.name, "odometry");
      EXPECT_NE(one.name, "sonar");
    }
  }
  EXPECT_EQ(world.robots[1].proxies.at("ranger"), 1);
}

TEST_F(StageFiles, Model_HasOnePosition) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["position2d:0" "position2d:1"] model "a" )
)");
  const WorldDescription world = read("position ( name \"a\" size [0.4 0.4 0.2] )\n");
  EXPECT_EQ(world.robots[0].port, 6665);
  EXPECT_THAT(world.notes, Contains(HasSubstr("that offers \"position2d\"")));
}

TEST_F(StageFiles, InterfacesWithoutModel_LeftOut) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["opaque:0"] worldfile "w.world" )
driver ( name "stage" provides ["position2d:0"] model "a" )
)");
  const WorldDescription world = read("position ( name \"a\" size [0.4 0.4 0.2] )\n");
  EXPECT_THAT(world.notes, Contains(HasSubstr("the interface \"opaque\" is left out")));
}

TEST_F(StageFiles, ConfigurationFile_FoundInWorkingDirectory) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["6670:position2d:0"] model "a" )
)");
  folder_.write("w.world", "position ( name \"a\" size [0.4 0.4 0.2] )\n");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  const WorldDescription world = load_world("w.world");
  std::filesystem::current_path(before);
  EXPECT_EQ(world.robots[0].port, 6670);
}

TEST_F(StageFiles, Cars_SteeredBySecondNumberOfSpeed) {
  const WorldDescription world =
      read("position ( size [0.4 0.4 0.2] drive \"car\" wheelbase 0.5 )\n");
  EXPECT_THAT(world.notes, IsEmpty());
  Simulation simulation(world);
  const auto motion = simulation.find_device(0, "motion");
  ASSERT_TRUE(motion);
  ASSERT_FALSE(simulation.apply({0, *motion}, TwistCommand{{.v_mps = 0.8, .omega_radps = 0.4}}));
  for (int i = 0; i < 100; ++i) simulation.step();
  // libstage/model_position.cc of Stage 4: v cos(angle), v sin(angle) / wheelbase.
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.8 * std::cos(0.4), 1e-9);
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.8 * std::sin(0.4) / 0.5, 1e-9);
}

// A byte sequence of ASCII text in UTF-16.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes;
  for (const char c : text) {
    if (big_endian) bytes += '\0';
    bytes += c;
    if (!big_endian) bytes += '\0';
  }
  return bytes;
}

constexpr const char* kSmallRobot = "position ( name \"a\" size [0.4 0.4 0.2] )\n";

TEST_F(StageFiles, Utf16_RefusedByNameOfEncoding) {
  for (const bool big_endian : {false, true}) {
    for (const bool mark : {false, true}) {
      for (const char* text : {kSmallRobot, "# a comment\nposition ( )\n"}) {
        const std::string begin = mark ? (big_endian ? "\xfe\xff" : "\xff\xfe") : "";
        const std::string bytes = begin + utf16(text, big_endian);
        const std::string encoding = big_endian ? "UTF-16BE" : "UTF-16LE";
        for (const char* name : {"w.world", "w.cfg"}) {
          try {
            static_cast<void>(load_world(folder_.write(name, bytes)));
            ADD_FAILURE() << name << " is accepted";
          } catch (const ConfigError& error) {
            EXPECT_EQ(error.issues().front().id, "stage/encoding");
            EXPECT_THAT(error.issues().front().found, HasSubstr(encoding));
            EXPECT_EQ(find_invalid_utf8(error.what()), std::string::npos);
          }
          std::filesystem::remove(folder_ / name);
        }
        folder_.write("part.inc", bytes);
        const ConfigIssue issue = issue_of("include \"part.inc\"\n");
        EXPECT_EQ(issue.id, "stage/encoding");
        EXPECT_THAT(issue.file, testing::EndsWith("part.inc"));
      }
    }
  }
}

TEST_F(StageFiles, OldMacLineEnds_SameLines) {
  const std::string text = "# a comment\rposition (\r  name \"a\"\r  size [0.4 0.4 0.2]\r)\r";
  EXPECT_EQ(read(text).robots[0].name, "a");
  EXPECT_EQ(issue_of("# a comment\r# another\rposition ( size ,\r)\r").line, 3);
  folder_.write("w.cfg",
                "# ports\rdriver ( name \"stage\" provides [\"simulation:0\"] worldfile "
                "\"w.world\" )\rdriver ( name \"stage\" provides [\"6670:position2d:0\"] model "
                "\"a\" )\rdriver ( name \"odd\" )\r");
  const WorldDescription world = read(text);
  EXPECT_EQ(world.robots[0].port, 6670);
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:4: the driver \"odd\"")));
}

TEST_F(StageFiles, TypographicCharacters_Named) {
  struct Case {
    const char* text;
    const char* found;
    const char* hint;
  };
  constexpr Case kCases[] = {
      {"name \xe2\x80\x9cr0\xe2\x80\x9d", "U+201C (left double quotation mark)",
       "write \" instead"},
      {"name \xe2\x80\x98r0\xe2\x80\x99", "U+2018 (left single quotation mark)",
       "write \" instead"},
      {"name \"r0\xe2\x80\x9d", "the end of the line",
       "U+201D (right double quotation mark) does not end it; write \" instead"},
      {"name 'r0'", "U+0027 (apostrophe)", "write \" instead"},
      {"pose [\xe2\x88\x92"
       "1 0 0 0]",
       "U+2212 (minus sign)", "write - instead"},
      {"pose [\xe2\x80\x93"
       "1 0 0 0]",
       "U+2013 (en dash)", "write - instead"},
      {"pose [1\xc2\xa0"
       "0 0 0]",
       "U+00A0 (no-break space)", "write a blank instead"},
      {"name \x93r0\x94", "the byte 0x93, in Windows-1252 the character U+201C",
       "write \" instead"},
      {"pose [1\xa0"
       "0 0 0]",
       "the byte 0xa0, in Windows-1252 the character U+00A0", "write a blank instead"},
      {"\xef\xbb\xbfname \"r0\"", "U+FEFF (byte order mark)", "write nothing instead"},
      {"\xf0\x9f\xa4\x96 7", "U+01F916", ""},
      {"\xfe 7", "the byte 0xfe", ""},
      {"name; 7", "\";\"", ""},
  };
  for (const Case& one : kCases) {
    for (const char* name : {"w.world", "w.cfg", "part.inc"}) {
      const std::string section = std::string("driver (\n  ") + one.text + "\n)\n";
      folder_.write(name, section);
      std::string path = folder_ / name;
      if (std::string(name) == "part.inc") path = folder_.write("x.cfg", "include \"part.inc\"\n");
      try {
        static_cast<void>(load_world(path));
        ADD_FAILURE() << section << " is accepted";
      } catch (const ConfigError& error) {
        const ConfigIssue& issue = error.issues().front();
        EXPECT_EQ(issue.id, "stage/syntax");
        EXPECT_EQ(issue.line, 2) << section;
        EXPECT_THAT(issue.file, testing::EndsWith(name));
        EXPECT_THAT(issue.found, HasSubstr(one.found));
        EXPECT_THAT(issue.hint, HasSubstr(one.hint));
        EXPECT_EQ(find_invalid_utf8(error.what()), std::string::npos) << section;
      }
    }
  }
  // In comments and texts they are no mistake.
  EXPECT_EQ(read("# \xe2\x80\x9cquoted\xe2\x80\x9d \x93 \xa0\n" + std::string(kSmallRobot))
                .robots[0]
                .name,
            "a");
}

TEST_F(StageFiles, EmptyFile_Reported) {
  for (const char* text : {"", "\n \t\r\n", "# only a comment\n", "# a comment\r"}) {
    const ConfigIssue issue = issue_of(text);
    EXPECT_EQ(issue.id, "stage/empty") << text;
    EXPECT_THAT(issue.found, HasSubstr("an empty file"));
    try {
      static_cast<void>(load_world(folder_.write("x.cfg", text)));
      ADD_FAILURE() << "accepted: " << text;
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.issues().front().id, "stage/no-world");
      EXPECT_THAT(error.issues().front().found, HasSubstr("an empty file"));
    }
  }
  folder_.write("empty.inc", "");
  EXPECT_NO_THROW(static_cast<void>(read("include \"empty.inc\"\n" + std::string(kSmallRobot))));
}

// U+00E4 is an a with diaeresis: C3 A4 in UTF-8, E4 in ISO 8859-1.
TEST_F(StageFiles, NamesWithBlanksAndUmlauts_Found) {
  for (const char* on_disk : {"my m\xc3\xa4p", "my m\xe4p"}) {
    for (const char* in_file : {"my m\xc3\xa4p", "my m\xe4p"}) {
      const test_support::TemporaryFolder folder;
      std::string picture = "P5 2 2 255\n";
      picture.append(4, '\0');
      folder.write(std::string(on_disk) + ".pgm", picture);
      folder.write(std::string(on_disk) + ".inc", "define bot position ( size [0.4 0.4 0.2] )\n");
      const std::string text = "include \"" + std::string(in_file) + ".inc\"\nmodel ( bitmap \"" +
                               in_file + ".pgm\" size [2 2 1] pose [5 0 0 0] )\nbot ( name \"" +
                               in_file + "\" )\n";
      const std::string path = folder.write(std::string(on_disk) + ".world", text);
      const std::string config =
          "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"" +
          std::string(in_file) + ".world\" )\n" +
          "driver ( name \"stage\" provides [\"6670:position2d:0\"] model \"" + in_file + "\" )\n";
      const std::string config_path = folder.write(std::string(on_disk) + ".cfg", config);
      for (const std::string& one : {path, config_path}) {
        const WorldDescription world = load_world(one);
        ASSERT_THAT(world.robots, SizeIs(1)) << one;
        EXPECT_EQ(world.robots[0].port, 6670) << one;
        EXPECT_THAT(world.arena.obstacles, SizeIs(1));
        EXPECT_THAT(world.notes, IsEmpty());
        // A program asks by the name in the file, in UTF-8.
        EXPECT_TRUE(Simulation(world).find_object("my m\xc3\xa4p"));
      }
    }
  }
}

TEST_F(StageFiles, NotesAndErrorsOfLatin1_InUtf8) {
  folder_.write("m\xe4p.inc", "position ( odd 1 )\n");
  const WorldDescription world = read("include \"m\xe4p.inc\"\n");
  EXPECT_THAT(world.notes, ElementsAre(HasSubstr("m\xc3\xa4p.inc:1: the property \"odd\"")));
  folder_.write("m\xe4p.inc", "position ( odd )\n");
  EXPECT_THAT(issue_of("include \"m\xe4p.inc\"\n").file, testing::EndsWith("m\xc3\xa4p.inc"));
}

TEST_F(StageFiles, ForeignIncludes_ReplacedWithNote) {
  std::filesystem::create_directories(folder_ / "far");
  folder_.write("far/other.inc", "define bot position ( size [0.4 0.4 0.2] mass 4 )\n");
  setenv("STAGEPATH", (folder_ / "far").c_str(), 1);
  const WorldDescription world =
      read("include \"/home/x/maps/other.inc\"\ninclude \"/usr/share/other/map.inc\"\nbot ( )\n");
  EXPECT_EQ(model(world, 0).mass_kg, 4.0);
  EXPECT_THAT(
      world.notes,
      ElementsAre(AllOf(HasSubstr("w.world:1: there is no file \"/home/x/maps/other.inc\""),
                        HasSubstr("far/other.inc")),
                  AllOf(HasSubstr("w.world:2: there is no file \"/usr/share/other/map.inc\""),
                        HasSubstr("playpen:stage/map.inc"))));
  // The user's file comes before the one that Playpen has.
  folder_.write("far/map.inc", "define floorplan position ( mass 7 )\n");
  EXPECT_EQ(model(read("include \"/usr/share/other/map.inc\"\nfloorplan ( )\n"), 0).mass_kg, 7.0);
  EXPECT_EQ(model(read("include \"map.inc\"\nfloorplan ( )\n"), 0).mass_kg, 7.0);
  folder_.write("map.inc", "define floorplan position ( mass 8 )\n");
  EXPECT_EQ(model(read("include \"map.inc\"\nfloorplan ( )\n"), 0).mass_kg, 8.0);
  folder_.write("sub/map.inc", "define floorplan position ( mass 9 )\n");
  folder_.write("sub/part.inc", "include \"map.inc\"\n");
  EXPECT_EQ(model(read("include \"sub/part.inc\"\nfloorplan ( )\n"), 0).mass_kg, 9.0)
      << "beside the file that includes it";
  unsetenv("STAGEPATH");
}

TEST_F(StageFiles, IncludeInsideModel_Accepted) {
  folder_.write("body.inc", "size [0.4 0.4 0.2]\nmass 3\n");
  EXPECT_EQ(model(read("position (\n  include \"body.inc\"\n  name \"a\"\n)\n"), 0).mass_kg, 3.0);
}

TEST_F(StageFiles, PlayerIncludes_Followed) {
  folder_.write("w.world",
                "position ( name \"a\" size [0.4 0.4 0.2] )\n"
                "position ( name \"b\" size [0.4 0.4 0.2] pose [2 0 0 0] )\n");
  folder_.write("sub/robots.cfg",
                "include \"first.cfg\"\n"
                "define far driver ( name \"stage\" provides [\"6680:position2d:0\"] )\n"
                "far ( model \"b\" )\n");
  folder_.write(
      "sub/first.cfg",
      "driver ( name \"stage\" provides [\"6670:position2d:0\"] model \"a\" usegui no )\n");
  const std::string path =
      folder_.write("x.cfg",
                    "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"w.world\" )\n"
                    "include \"sub/robots.cfg\"\n"
                    "driver ( name \"odd\" )\n");
  // Directly, and as the file that names the world.
  for (const std::string& one : {path, folder_ / "w.world"}) {
    const WorldDescription world = load_world(one);
    EXPECT_EQ(world.robots[0].port, 6670) << one;
    EXPECT_EQ(world.robots[1].port, 6680) << one;
    EXPECT_THAT(world.notes, ElementsAre(HasSubstr("x.cfg:3: the driver \"odd\" is left out")));
  }
  folder_.write("x.cfg", "include \"nowhere.cfg\"\ninclude \"map.inc\"\n");
  try {
    static_cast<void>(load_world(path));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "stage/include");
    EXPECT_EQ(error.issues().front().line, 1);
  }
}

// Each of 29 files includes the next one twice: 2^28 times the last one.
TEST_F(StageFiles, IncludeCycle_Refused) {
  for (int i = 1; i < 29; ++i) {
    const std::string next = "include \"f" + std::to_string(i + 1) + ".inc\"\n";
    folder_.write("f" + std::to_string(i) + ".inc", next + next);
  }
  folder_.write("f29.inc", "");
  try {
    static_cast<void>(read("include \"f1.inc\"\n" + std::string(kSmallRobot)));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "stage/include");
    EXPECT_THAT(error.issues().front().expected, HasSubstr("at most 1000 files"));
    EXPECT_THAT(error.issues().front().file, HasSubstr(".inc"));
  }
}

// 900 times 20 kB.
TEST_F(StageFiles, IncludedText_Limited) {
  folder_.write("long.inc", "#" + std::string(20'000, '-') + "\n");
  std::string text;
  for (int i = 0; i < 900; ++i) text += "include \"long.inc\"\n";
  try {
    static_cast<void>(read(text + kSmallRobot));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "stage/too-large");
    EXPECT_EQ(error.issues().front().line, 839) << "16 MiB / 20 002 bytes";
  }
}

// Ten definitions, each with the next one twice: 1024 robots.
TEST_F(StageFiles, TooManyRobots_RefusedAtFirstExcess) {
  std::string text;
  for (int i = 1; i <= 12; ++i) {
    const std::string next = "d" + std::to_string(i + 1) + " ()";
    text += "define d" + std::to_string(i) + " model ( " + next + ' ' + next + " )\n";
  }
  text += "define d13 position ()\nd1 ()\n";
  try {
    static_cast<void>(read(text));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "world/too-many");
    EXPECT_EQ(error.issues().front().line, 12);
  }
}

TEST_F(StageFiles, InvalidConfigurationFile_HasLine) {
  folder_.write("w.cfg", "driver ( name \"stage\" provides [\"simulation:0\"]\n");
  const WorldDescription world = read(kSmallRobot);
  EXPECT_THAT(world.notes, ElementsAre(AllOf(HasSubstr("w.cfg:2: the configuration file"),
                                             HasSubstr("is left out"))));
  // One about something else has none.
  std::filesystem::rename(folder_ / "w.cfg", folder_ / "other.cfg");
  EXPECT_THAT(read(kSmallRobot).notes, IsEmpty());
}

TEST_F(StageFiles, ForeignWorldPath_SearchedBesideConfiguration) {
  folder_.write("w.world", kSmallRobot);
  const WorldDescription world = load_world(folder_.write(
      "x.cfg",
      "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"/home/x/w.world\" )\n"
      "driver ( name \"stage\" provides [\"6670:position2d:0\"] model \"a\" )\n"));
  EXPECT_EQ(world.robots[0].port, 6670);
  EXPECT_THAT(world.notes, ElementsAre(HasSubstr("x.cfg:1: there is no file \"/home/x/w.world\"")));
}

TEST_F(StageFiles, BundledStage2Models_BuiltIn) {
  const WorldDescription world = read(R"(
include "sick.inc"
include "roomba.inc"
include "p3dx.inc"
include "walle.inc"
include "pucktarget.inc"
position ( name "a" size [0.4 0.4] sick_laser ( ) pose [0 5 90] )
roomba ( name "b" )
pioneer3dx ( name "c" pose [5 0 0] )
walle ( name "d" pose [0 -5 0] )
position ( name "e" size [0.4 0.4] pucktarget ( ) pose [5 5 0] )
)");
  ASSERT_THAT(world.robots, SizeIs(5));
  const auto laser_of = [&](std::size_t robot) {
    for (const DeviceDescription& device : model(world, robot).devices) {
      if (device.type == "laser") return std::any_cast<LaserParams>(device.params);
    }
    return LaserParams{};
  };
  // worlds/sick.inc of Stage 2.1: 361 samples over 180 degrees up to 8 m.
  EXPECT_EQ(laser_of(0).beam_count, 361);
  EXPECT_NEAR(laser_of(0).range_max_m, 8.0, 1e-9);
  EXPECT_EQ(laser_of(2).beam_count, 361);
  // 16 corners on a circle of 0.33 m, of which a body keeps at least 8: the area is between those
  // of the octagon, 2 sqrt(2) r^2, and of the circle.
  constexpr double kSquare_m2 = 0.165 * 0.165;
  EXPECT_GT(area_m2(model(world, 1).footprint), 2.0 * std::numbers::sqrt2 * kSquare_m2 - 1e-6);
  EXPECT_LT(area_m2(model(world, 1).footprint), std::numbers::pi * kSquare_m2);
  EXPECT_EQ(model(world, 2).mass_kg, 23.0);
}

// Each property of a world file has an effect or a line, in every kind of model.
TEST_F(StageFiles, PropertiesWithoutEffect_HaveLine) {
  constexpr const char* kKinds[] = {"model", "position"};
  constexpr const char* kParts[] = {
      "model",  "ranger", "laser",        "fiducial",       "fiducialfinder", "blobfinder",
      "bumper", "camera", "blinkenlight", "lightindicator", "actuator",       "gripper",
      "ptz",    "wifi",   "position",     "power",          "speech",         "audio"};
  const auto expect_line = [&](const std::string& text, int line) {
    EXPECT_THAT(read(text).notes,
                Contains(AllOf(HasSubstr("w.world:" + std::to_string(line) + ": "),
                               HasSubstr("no_such_thing"), HasSubstr("is left out"))))
        << text;
  };
  const std::string odd = "\nno_such_thing 1\n";
  const std::string robot = "\nposition ( size [0.4 0.4 0.2] pose [5 5 0 0] )\n";
  expect_line(odd + robot, 2);
  for (const char* kind : kKinds) expect_line(std::string(kind) + " (" + odd + ")" + robot, 2);
  for (const char* part : kParts) {
    expect_line("position ( size [0.4 0.4 0.2] " + std::string(part) + " (" + odd + ") )\n", 2);
  }
  expect_line(
      "position ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1]" + odd + ") )\n",
      2);
  expect_line("position ( ranger ( sensor ( samples 9 fov 90" + odd + ") ) )\n", 2);
  EXPECT_THAT(read("window (" + odd + ")" + robot).notes,
              Contains(HasSubstr("w.world:1: the look of Stage's window is left out")));
}

TEST_F(StageFiles, WindowSpeed_IsOption) {
  EXPECT_THAT(read("speedup 1\n" + std::string(kSmallRobot)).notes, IsEmpty());
  EXPECT_THAT(read("\nspeedup 10\n" + std::string(kSmallRobot)).notes,
              ElementsAre(AllOf(HasSubstr("w.world:2: speedup has no effect"),
                                HasSubstr("unless --time 10 gives"))));
  EXPECT_THAT(read("speedup -1\n" + std::string(kSmallRobot)).notes,
              ElementsAre(AllOf(HasSubstr("speedup has no effect"), Not(HasSubstr("--time")))));
  // Stage 2: interval_sim every interval_real; 100 ms every 50 ms are twice real time.
  EXPECT_THAT(read("interval_sim 100 interval_real 50\n" + std::string(kSmallRobot)).notes,
              ElementsAre(HasSubstr("unless --time 2 gives")));
}

TEST_F(StageFiles, DuplicateAddress_Refused) {
  const std::string robots =
      "position ( name \"a\" size [0.4 0.4 0.2] )\n"
      "position ( name \"b\" size [0.4 0.4 0.2] pose [2 0 0 0] )\n";
  const std::string config =
      folder_.write("w.cfg",
                    "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"w.world\" )\n"
                    "driver ( name \"stage\" provides [\"position2d:0\"] model \"a\" )\n"
                    "driver ( name \"stage\" provides [\"position2d:0\"] model \"b\" )\n");
  const WorldDescription world = read(robots);
  EXPECT_EQ(world.robots[0].port, 6665);
  EXPECT_EQ(world.robots[1].port, 6666);
  EXPECT_THAT(
      world.notes,
      ElementsAre(HasSubstr("w.cfg:3: the address \"position2d:0\" is left out: a has it")));
  // Player refuses the file itself (libplayercore/devicetable.cc: "duplicate device addr").
  try {
    static_cast<void>(load_world(config));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "stage/bad-address");
    EXPECT_EQ(error.issues().front().line, 3);
  }
}

}  // namespace
}  // namespace sim
