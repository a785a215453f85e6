// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Speech, lights, wires and messages of robots, and blocks that move while a simulation runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/devices/aio.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/dio.h"
#include "sim/devices/laser.h"
#include "sim/devices/opaque.h"
#include "sim/devices/speech.h"
#include "sim/render/render.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

// A floor of 4 x 2 m with a dock at its right end; the robots are r1 at (1, 1) and r2 at (2, 1).
Simulation two_robots(const std::string& first, const std::string& second = "",
                      const std::string& arena = "", const LogHook& log = {}) {
  const std::string text =
      R"({"arena": {"size": [4, 2], "docks": [{"name": "d", "pose": {"x": 3.5, "y": 1}}])" + arena +
      R"(}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {)" + first +
      R"(}}, {"name": "r2", "pose": {"x": 2, "y": 1}, "devices": {)" + second + "}}]}";
  return Simulation(load_world_text(text), log);
}

Simulation::DeviceId id_of(const Simulation& simulation, int robot, const std::string& name) {
  return {robot, simulation.find_device(robot, name).value()};
}

template <typename Type>
const Type& device(const Simulation& simulation, int robot, const std::string& name) {
  return dynamic_cast<const Type&>(simulation.device(robot, *simulation.find_device(robot, name)));
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

std::string wiring_error(const std::string& first) {
  try {
    static_cast<void>(two_robots(first));
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "device/wiring");
    return error.what();
  }
  return "";
}

// --- digital lines

TEST(Dio, ConstantsAndRobotState_Read) {
  Simulation simulation = two_robots(R"("dio": {"inputs": [true, false, "dock", "contact"]})");
  run(simulation, 10);
  const Dio& dio = device<Dio>(simulation, 0, "dio");
  EXPECT_EQ(dio.reading().input_count, 4);
  EXPECT_EQ(dio.reading().inputs, 0b0001U);
  ASSERT_FALSE(simulation.place_object("r1", {3.5, 1.0, 0.0}));
  run(simulation, 10);
  EXPECT_EQ(dio.reading().inputs, 0b0101U);
  // It drives into the right border and touches it.
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "motion"), TwistCommand{{.v_mps = 0.5}}));
  run(simulation, 200);
  EXPECT_EQ(dio.reading().inputs & 0b1000U, 0b1000U);
}

TEST(Dio, FirstOutputs_SetAndOthersKept) {
  Simulation simulation = two_robots(R"("dio": {"outputs": 3})");
  const auto id = id_of(simulation, 0, "dio");
  ASSERT_FALSE(simulation.apply(id, DigitalOutputCommand{3, 0b101U}));
  ASSERT_FALSE(simulation.apply(id, DigitalOutputCommand{2, 0xfffffffeU}));
  run(simulation, 10);
  EXPECT_EQ(device<Dio>(simulation, 0, "dio").reading().outputs, 0b110U);
  EXPECT_THAT(simulation.apply(id, DigitalOutputCommand{4, 0}).value(),
              HasSubstr("has 3 digital outputs"));
}

// A robot's output appears at the other's input in the same step, in either order of robots.
TEST(Dio, Wires_ConnectRobots) {
  Simulation simulation =
      two_robots(R"("dio": {"inputs": ["r2.dio.1"], "frequency": 100})",
                 R"("dio": {"inputs": ["r1.dio.0", "dio.1"], "frequency": 100})");
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "dio"), DigitalOutputCommand{1, 1}));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 1, "dio"), DigitalOutputCommand{2, 0b10U}));
  run(simulation, 1);
  EXPECT_EQ(device<Dio>(simulation, 0, "dio").reading().inputs, 0b1U);
  EXPECT_EQ(device<Dio>(simulation, 1, "dio").reading().inputs, 0b11U);
  simulation.reset();
  run(simulation, 1);
  EXPECT_EQ(device<Dio>(simulation, 1, "dio").reading().inputs, 0U);
}

TEST(Dio, WiresToNothing_Refused) {
  EXPECT_THAT(wiring_error(R"("dio": {"inputs": ["r2.dio.0"]})"),
              HasSubstr("/robots/0/devices/dio"));
  EXPECT_THAT(wiring_error(R"("dio": {"inputs": ["dio.8"]})"), HasSubstr("dio.8"));
  EXPECT_THAT(wiring_error(R"("dio": {"inputs": ["laser.0"]})"), HasSubstr("laser.0"));
  EXPECT_THAT(wiring_error(R"("aio": {"inputs": ["battery"]})"), HasSubstr("battery"));
  EXPECT_THAT(wiring_error(R"("aio": {"inputs": ["laser.682"]})"), HasSubstr("laser.682"));
  EXPECT_THAT(wiring_error(R"("opaque": {"from": ["nobody"]})"), HasSubstr("nobody"));
  for (const char* bad : {R"("dio": {"inputs": ["up"]})", R"("dio": {"inputs": ["dio."]})",
                          R"("dio": {"inputs": [".1"]})", R"("dio": {"inputs": ["a.b.c.1"]})",
                          R"("dio": {"inputs": [1]})", R"("aio": {"inputs": [true]})",
                          R"("aio": {"inputs": ["r1.aio.x"]})", R"("opaque": {"from": [3]})"}) {
    try {
      static_cast<void>(two_robots(bad));
      ADD_FAILURE() << bad << " was read";
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.issues().front().id, "device/input") << bad;
    }
  }
}

// --- analog lines

TEST(Aio, ConstantsSpeedsBatteryRangesAndOutputs_Read) {
  Simulation simulation = two_robots(
      R"("battery": {"initial_charge": 100, "idle_power": 0}, "abc": {"type": "aio", "inputs":
         [5, "speed", "battery", "laser.341", "abc.1", "r2.aio.0", "turn_rate"]})",
      R"("aio": {})");
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "abc"), AnalogOutputCommand{1, -2.5}));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 1, "aio"), AnalogOutputCommand{0, 1.25}));
  run(simulation, 10);
  const std::vector<double>& volts = device<Aio>(simulation, 0, "abc").reading().inputs_v;
  ASSERT_EQ(volts.size(), 7U);
  EXPECT_EQ(volts[0], 5.0);
  EXPECT_EQ(volts[1], 0.0);
  EXPECT_DOUBLE_EQ(volts[2], 12.6);  // full
  // From the laser at x = 1.035 to the body of r2, whose back is at 2 - 0.087.
  EXPECT_NEAR(volts[3], 2.0 - 0.087 - 1.035, 1e-3);
  EXPECT_EQ(volts[4], -2.5);
  EXPECT_EQ(volts[5], 1.25);
  EXPECT_EQ(volts[6], 0.0);
  EXPECT_THAT(simulation.apply(id_of(simulation, 1, "aio"), AnalogOutputCommand{2, 0.0}).value(),
              HasSubstr("no output 2"));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "motion"),
                                TwistCommand{{.v_mps = 0.2, .omega_radps = 0.5}}));
  run(simulation, 10);
  EXPECT_NEAR(device<Aio>(simulation, 0, "abc").reading().inputs_v[1], 0.2, 1e-9);
  EXPECT_NEAR(device<Aio>(simulation, 0, "abc").reading().inputs_v[6], 0.5, 1e-9);
}

TEST(Aio, Noise_HasDeviation) {
  Simulation simulation =
      two_robots(R"("aio": {"inputs": [3, 3], "noise": 0.2, "frequency": 100})");
  constexpr int kReadings = 10000;
  double sum = 0.0;
  double squares = 0.0;
  double products = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    simulation.step();
    const std::vector<double>& volts = device<Aio>(simulation, 0, "aio").reading().inputs_v;
    const double error = volts[0] - 3.0;
    sum += error;
    squares += error * error;
    products += error * (volts[1] - 3.0);
  }
  // Four standard errors: of a mean sigma / sqrt(n), of a deviation sigma / sqrt(2 n), of the mean
  // product of two independent ones sigma^2 / sqrt(n).
  constexpr double kSigma = 0.2;
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 * kSigma / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), kSigma, 4.0 * kSigma / std::sqrt(2.0 * kReadings));
  EXPECT_NEAR(products / kReadings, 0.0, 4.0 * kSigma * kSigma / std::sqrt(kReadings));
}

// --- speech

TEST(Speech, ShownOverRobotForItsTime) {
  std::vector<std::string> log;
  Simulation simulation =
      two_robots(R"("speech": {"shown": 0.5})", "", "",
                 [&](LogLevel, std::string_view text) { log.emplace_back(text); });
  run(simulation, 5);
  const auto id = id_of(simulation, 0, "speech");
  ASSERT_FALSE(simulation.apply(id, SayCommand{"hello"}));
  EXPECT_EQ(simulation.snapshot().robots[0].says, "hello");
  EXPECT_EQ(simulation.snapshot().robots[1].says, "");
  run(simulation, 50);  // 0.5 s
  EXPECT_EQ(simulation.snapshot().robots[0].says, "hello");
  run(simulation, 1);
  EXPECT_EQ(simulation.snapshot().robots[0].says, "");
  ASSERT_EQ(simulation.spoken_texts().size(), 1U);
  EXPECT_EQ(simulation.spoken_texts()[0].time_ns, from_seconds(0.05));
  EXPECT_EQ(simulation.spoken_texts()[0].robot, 0);
  EXPECT_EQ(simulation.spoken_texts()[0].text, "hello");
  EXPECT_THAT(log, ElementsAre("robot r1 says: hello"));

  ASSERT_FALSE(simulation.apply(id, SayCommand{"one"}));
  ASSERT_FALSE(simulation.apply(id, SayCommand{""}));
  EXPECT_EQ(simulation.snapshot().robots[0].says, "");
  EXPECT_EQ(simulation.spoken_texts().size(), 2U);  // silence does not count as speech
  EXPECT_THAT(simulation.apply(id, SayCommand{std::string(256, 'x')}).value(), HasSubstr("255"));
}

// --- lights

TEST(Blinkenlight, LitForDutyCycleOfEachPeriod) {
  const auto ms = [](int t) { return from_seconds(t / 1000.0); };
  EXPECT_TRUE(is_lit(0.5, 0.4, ms(0)));
  EXPECT_TRUE(is_lit(0.5, 0.4, ms(199)));
  EXPECT_FALSE(is_lit(0.5, 0.4, ms(200)));
  EXPECT_FALSE(is_lit(0.5, 0.4, ms(499)));
  EXPECT_TRUE(is_lit(0.5, 0.4, ms(500)));
  EXPECT_TRUE(is_lit(0.0, 0.4, ms(300)));  // does not blink
  EXPECT_FALSE(is_lit(0.5, 0.0, ms(0)));   // never
  EXPECT_TRUE(is_lit(0.5, 1.0, ms(499)));  // always
}

TEST(Blinkenlight, Commands_ChangeGivenPartsOnly) {
  Simulation simulation = two_robots(R"("blinkenlight": {"period": 0, "colour": "#010203"})");
  const auto id = id_of(simulation, 0, "blinkenlight");
  const Blinkenlight& light = device<Blinkenlight>(simulation, 0, "blinkenlight");
  EXPECT_FALSE(light.lit(0));
  LightCommand on;
  on.enabled = true;
  ASSERT_FALSE(simulation.apply(id, on));
  LightCommand blink;
  blink.period_s = 0.2;
  blink.duty_cycle = 0.5;
  ASSERT_FALSE(simulation.apply(id, blink));
  run(simulation, 10);  // it has just been switched off at 0.1 s
  EXPECT_TRUE(light.reading().enabled);
  EXPECT_EQ(light.reading().colour, (Colour{1, 2, 3, 255}));
  EXPECT_DOUBLE_EQ(light.reading().period_s, 0.2);
  EXPECT_FALSE(light.reading().lit);
  run(simulation, 10);
  EXPECT_TRUE(light.reading().lit);
  ASSERT_EQ(simulation.snapshot().robots[0].lights.size(), 1U);
  EXPECT_TRUE(simulation.snapshot().robots[0].lights[0].lit);
  LightCommand bad;
  bad.duty_cycle = 1.5;
  EXPECT_THAT(simulation.apply(id, bad).value(), HasSubstr("0..1"));
}

// --- messages

std::string text_of(const OpaqueReading& reading) {
  return {reading.data.begin(), reading.data.end()};
}

OpaqueCommand message(const std::string& text) { return {{text.begin(), text.end()}}; }

TEST(Opaque, SentMessage_EchoedUnlessConnected) {
  Simulation simulation = two_robots(R"("opaque": {})", R"("opaque": {"from": ["r1"]})");
  const Opaque& first = device<Opaque>(simulation, 0, "opaque");
  const Opaque& second = device<Opaque>(simulation, 1, "opaque");
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "opaque"), message("a")));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "opaque"), message("b")));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 1, "opaque"), message("nobody hears this")));
  // One message per reading, at both ends.
  for (const char* expected : {"a", "b", ""}) {
    run(simulation, 10);
    EXPECT_EQ(text_of(first.reading()), expected);
    EXPECT_EQ(text_of(second.reading()), expected);
  }
  EXPECT_EQ(second.reading().number, 2U);
  EXPECT_EQ(second.reading().lost, 0U);
}

TEST(Opaque, Arrival_InSameStepInAnyOrder) {
  Simulation simulation = two_robots(R"("opaque": {"from": ["r2"], "frequency": 100})",
                                     R"("opaque": {"from": ["r1.opaque"], "frequency": 100})");
  for (int i = 0; i < 5; ++i) {
    const std::string text = std::to_string(i);
    ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "opaque"), message("from 1: " + text)));
    ASSERT_FALSE(simulation.apply(id_of(simulation, 1, "opaque"), message("from 2: " + text)));
    run(simulation, 1);
    EXPECT_EQ(text_of(device<Opaque>(simulation, 0, "opaque").reading()), "from 2: " + text);
    EXPECT_EQ(text_of(device<Opaque>(simulation, 1, "opaque").reading()), "from 1: " + text);
  }
}

TEST(Opaque, FullQueue_DropsOldest) {
  Simulation simulation = two_robots(R"("opaque": {})");
  const auto id = id_of(simulation, 0, "opaque");
  for (std::size_t i = 0; i < Opaque::kMaxQueue + 3; ++i) {
    ASSERT_FALSE(simulation.apply(id, message(std::to_string(i))));
  }
  run(simulation, 10);
  EXPECT_EQ(text_of(device<Opaque>(simulation, 0, "opaque").reading()), "3");
  EXPECT_EQ(device<Opaque>(simulation, 0, "opaque").reading().lost, 3U);
  EXPECT_THAT(simulation.apply(id, OpaqueCommand{std::vector<std::uint8_t>(65537)}).value(),
              HasSubstr("65536"));
}

// --- moving blocks

constexpr const char* kBlock =
    R"(, "obstacles": [{"name": "b", "center": [1.5, 1], "size": [0.2, 0.4], "type": "dynamic"}])";

double range_ahead(Simulation& simulation) {
  run(simulation, 10);
  return device<Laser>(simulation, 0, "laser").reading().ranges_m[341];
}

TEST(PlaceObject, MovedBlock_AffectsSensorsAndWheels) {
  Simulation simulation = two_robots("", "", kBlock);
  const std::uint64_t before = simulation.state_hash();
  // The laser is at 1.035, the block's near side at 1.4. Beam 341 is 0.2 degrees off straight
  // ahead.
  EXPECT_NEAR(range_ahead(simulation), 0.365, 1e-4);
  ASSERT_FALSE(simulation.place_object("b", {1.6, 1.0, 0.5 * kPi}));
  // After the rotation, its half length of 0.2 is along x.
  EXPECT_NEAR(range_ahead(simulation), 1.4 - 1.035, 1e-4);
  ASSERT_FALSE(simulation.place_object("b", {1.7, 1.0, 0.0}));
  EXPECT_NEAR(range_ahead(simulation), 1.6 - 1.035, 1e-4);
  ASSERT_FALSE(simulation.set_block_size("b", {0.4, 0.2}, 0.16));
  EXPECT_NEAR(range_ahead(simulation), 1.5 - 1.035, 1e-4);
  ASSERT_FALSE(simulation.place_object("b", {3.0, 0.5, 0.0}));
  EXPECT_NEAR(range_ahead(simulation), 2.0 - 0.087 - 1.035, 1e-3);  // r2, which was behind it
  // A block stops robots at its new place, and not at its old place.
  ASSERT_FALSE(simulation.place_object("r2", {3.5, 1.5, 0.0}));
  ASSERT_FALSE(simulation.place_object("b", {2.0, 1.0, 0.0}));
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "motion"), TwistCommand{{.v_mps = 0.5}}));
  run(simulation, 400);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.8 - 0.087, 2e-3);
  EXPECT_EQ(simulation.collisions().back().partner, "b");
  EXPECT_NE(simulation.state_hash(), before);
  simulation.reset();
  EXPECT_EQ(simulation.find_object("b")->pose, (Pose{1.5, 1.0, 0.0}));
  EXPECT_NEAR(range_ahead(simulation), 0.365, 1e-4);
}

TEST(PlaceObject, InvalidPlaces_Refused) {
  Simulation simulation = two_robots("", "", kBlock);
  EXPECT_THAT(simulation.place_object("b", {1.0, 1.0, 0.0}).value(), HasSubstr("robot r1"));
  EXPECT_THAT(simulation.place_object("b", {4.0, 1.0, 0.0}).value(), HasSubstr("right side"));
  EXPECT_THAT(simulation.place_object("r1", {1.5, 1.0, 0.0}).value(), HasSubstr("obstacle b"));
  EXPECT_THAT(simulation.place_object("border", {0.0, 0.0, 0.0}).value(), HasSubstr("stands fast"));
  EXPECT_THAT(simulation.place_object("zz", {0.0, 0.0, 0.0}).value(),
              HasSubstr("r1, r2, b, border"));
  EXPECT_THAT(simulation.set_block_size("b", {0.0, 1.0}, 0.1).value(), HasSubstr("0.001"));
  EXPECT_THAT(simulation.set_block_size("b", {0.2, 1e-4}, 0.1).value(), HasSubstr("0.001"));
  EXPECT_THAT(simulation.set_block_size("b", {0.2, 0.2}, 1e-300).value(), HasSubstr("0.001"));
  for (const double x_m : {1e30, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(simulation.place_object("b", {x_m, 1.0, 0.0})) << x_m;
    EXPECT_TRUE(simulation.place_object("r1", {x_m, 1.0, 0.0})) << x_m;
    EXPECT_TRUE(simulation.place_object("r1", {1.0, 1.0, x_m * 1e300})) << x_m;
  }
  EXPECT_THAT(simulation.set_block_size("r1", {1.0, 1.0}, 0.1).value(), HasSubstr("keeps"));
  EXPECT_THAT(simulation.set_object_colour("border", {}).value(), HasSubstr("keeps"));
  EXPECT_EQ(simulation.find_object("b")->pose, (Pose{1.5, 1.0, 0.0}));
  // A retracted block may be placed under a robot, but may not come up there.
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  ASSERT_FALSE(simulation.place_object("b", {1.0, 1.0, 0.0}));
  EXPECT_THAT(simulation.set_obstacle_state("b", ObstacleState::kExtended).value(),
              HasSubstr("stands on it"));
}

TEST(Fiducials, Reset_RestoresNumbers) {
  Simulation simulation = two_robots("", "", kBlock);
  const std::uint64_t before = simulation.state_hash();
  ASSERT_FALSE(simulation.set_object_fiducial("b", 5));
  const std::uint64_t block = simulation.state_hash();
  EXPECT_NE(block, before);
  ASSERT_FALSE(simulation.set_object_fiducial("r2", 5));
  EXPECT_NE(simulation.state_hash(), block);
  EXPECT_THAT(simulation.set_object_fiducial("r2", -1).value(), HasSubstr("at least 0"));
  EXPECT_THAT(simulation.set_object_fiducial("border", 1).value(), HasSubstr("bears no"));
  EXPECT_THAT(simulation.set_object_fiducial("zz", 1).value(), HasSubstr("r1, r2, b, border"));
  simulation.reset();
  EXPECT_EQ(simulation.state_hash(), before);
}

TEST(PlaceObject, Motors_KeepDriving) {
  Simulation simulation = two_robots("");
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "motion"), TwistCommand{{.v_mps = 0.2}}));
  run(simulation, 10);
  ASSERT_FALSE(simulation.place_object("r1", {0.5, 0.5, 0.0}));
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{0.5, 0.5, 0.0}));
  run(simulation, 100);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 0.7, 1e-6);
}

// --- pictures

// Number of pixels in which two pictures differ.
int changed(const render::Image& a, const render::Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    count += a.rgb[i] != b.rgb[i] || a.rgb[i + 1] != b.rgb[i + 1] || a.rgb[i + 2] != b.rgb[i + 2];
  }
  return count;
}

bool has_colour(const render::Image& image, Colour colour) {
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    if (image.rgb[i] == colour.r && image.rgb[i + 1] == colour.g && image.rgb[i + 2] == colour.b) {
      return true;
    }
  }
  return false;
}

TEST(Pictures, ShowSpeechAndLights) {
  Simulation simulation = two_robots(R"("speech": {}, "blinkenlight": {"period": 0})", "", kBlock);
  const render::Image quiet = render::draw_view(simulation.snapshot(), {.size_px = 600});
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "speech"), SayCommand{"hello"}));
  const render::Image hello = render::draw_view(simulation.snapshot(), {.size_px = 600});
  EXPECT_GT(changed(quiet, hello), 600);  // a bubble of some 20 x 30 pixels at least
  // A long text makes a bubble of two lines that is narrower than the picture.
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "speech"),
                                SayCommand{std::string(120, 'w') + ' ' + std::string(120, 'm')}));
  const render::Image longer = render::draw_view(simulation.snapshot(), {.size_px = 600});
  EXPECT_LT(changed(quiet, longer), longer.width * longer.height / 10);
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "speech"), SayCommand{""}));
  EXPECT_EQ(changed(quiet, render::draw_view(simulation.snapshot(), {.size_px = 600})), 0);

  LightCommand on;
  on.enabled = true;
  on.colour = Colour{0, 255, 0, 255};
  ASSERT_FALSE(simulation.apply(id_of(simulation, 0, "blinkenlight"), on));
  EXPECT_GT(changed(quiet, render::draw_view(simulation.snapshot(), {.size_px = 600})), 20);
}

TEST(Pictures, ShowBlockColour) {
  Simulation simulation = two_robots("", "", kBlock);
  render::SceneRenderer renderer({.size_px = 600});
  constexpr Colour kOwn{0x12, 0x34, 0x56, 0xff};
  EXPECT_FALSE(has_colour(renderer.draw(simulation.snapshot()), kOwn));
  ASSERT_FALSE(simulation.set_object_colour("b", kOwn));
  EXPECT_TRUE(has_colour(renderer.draw(simulation.snapshot()), kOwn));
}

// Pictures must cope with any text at any place.
TEST(Pictures, AnyText_Drawn) {
  Simulation simulation = two_robots(R"("speech": {})");
  SceneSnapshot scene = simulation.snapshot();
  for (const std::string& text :
       {std::string(" "), std::string("\xff\xfe\x01"), std::string(255, 'W'), std::string(200, ' '),
        std::string("P\xc5\x99\xc3\xadli\xc5\xa1"), std::string(3000, 'a')}) {
    for (const Vec2& place : {Vec2(0, 0), Vec2(4, 2), Vec2(-1, 5), Vec2(1e12, 0)}) {
      scene.robots[0].says = text;
      scene.robots[0].X_WB = {place.x(), place.y(), 0.3};
      for (const int size_px : {64, 200, 500}) {
        EXPECT_EQ(render::draw_view(scene, {.size_px = size_px}).rgb.size() % 3, 0U);
      }
    }
  }
}

}  // namespace
}  // namespace sim
