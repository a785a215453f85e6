// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/replay_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "playerlike/replay/columns.h"
#include "playerlike/replay/field_values.h"
#include "playerlike/replay/replay_encoder.h"
#include "replay/replay_page.h"
#include "sim/core/base64.h"
#include "sim/simulation/simulation.h"

namespace {

using nlohmann::json;
using playerlike::replay::cell_runs;
using playerlike::replay::DeviceLog;
using playerlike::replay::encoded;
using playerlike::replay::encoded_part;
using playerlike::replay::encoded_whole;
using playerlike::replay::has_news;
using playerlike::replay::ReplayBuilder;
using playerlike::replay::ReplayRun;
using playerlike::replay::text_of;
using playerlike::replay::Thinning;
using playpen::replay::html;
using sim::Simulation;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::ThrowsMessage;

constexpr sim::SimTime kSecond_ns = sim::kNanosecondsPerSecond;

// A robot at (0.5, 0.5) that looks along x, with a laser of 10 Hz, three sonars and a battery, in a
// room of 2 m x 1 m.
constexpr const char* kWorld = R"({
  "arena": {"size": [2, 1], "obstacles": [
    {"name": "gate", "center": [1.5, 0.2], "size": [0.1, 0.1], "type": "dynamic"}]},
  "canvas": {"size": [20, 10], "cell_size": 0.1},
  "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5, "yaw_deg": 0}, "devices": {
    "laser": {"type": "laser"}, "motion": {"type": "motion"}, "sonar": {"type": "sonar"},
    "battery": {"type": "battery"}, "waypoint": {"type": "waypoint"}}}]
})";

Simulation room() { return Simulation(sim::load_world_text(kWorld)); }

Simulation::DeviceId id_of(const Simulation& simulation, const std::string& device) {
  return {0, simulation.find_device(0, device).value()};
}

const DeviceLog& log_of(const ReplayRun& run, const std::string& device) {
  for (const DeviceLog& log : run.devices) {
    if (log.name == device) return log;
  }
  throw std::out_of_range(device);
}

// Drives forward for a while. @param before  called before each step.
template <typename Before>
ReplayRun driven(double seconds, Before before) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation, {.name = "run"});
  builder.observe(simulation);
  while (simulation.now_ns() < sim::from_seconds(seconds)) {
    before(simulation, builder);
    simulation.step();
    builder.observe(simulation);
  }
  return builder.finish(simulation);
}

ReplayRun driven(double seconds) {
  return driven(seconds, [](Simulation& simulation, ReplayBuilder&) {
    simulation.apply(id_of(simulation, "motion"), sim::TwistCommand{{.v_mps = 0.1}});
  });
}

// The JSON text of encoded runs.
json head_of(const std::string& bytes) {
  std::size_t length = 0;
  for (int i = 3; i >= 0; --i)
    length = 256 * length + static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
  return json::parse(bytes.substr(4, length));
}

TEST(ReplayBuilder, PosesComeAtTwentyHertzAndAtTheEnd) {
  // Frames at 0, 50, ..., 1000 ms, and the last step, 1.02 s.
  const ReplayRun run = driven(1.02);
  ASSERT_THAT(run.frames_ns, SizeIs(22));
  EXPECT_EQ(run.frames_ns[1], 50'000'000);
  EXPECT_EQ(run.frames_ns.back(), 1'020'000'000);
  EXPECT_EQ(run.end_ns, 1'020'000'000);
  ASSERT_THAT(run.robots, SizeIs(1));
  EXPECT_THAT(run.robots[0].X_WB, SizeIs(22));
  EXPECT_GT(run.robots[0].X_WB.back().x_m, 0.55);
}

TEST(ReplayBuilder, RangeSensorsHaveBeamsAndOthersSeries) {
  const ReplayRun run = driven(1.0);
  const DeviceLog& laser = log_of(run, "laser");
  ASSERT_TRUE(laser.beams.has_value());
  EXPECT_GT(laser.beams->resolution_rad, 0.0);
  ASSERT_THAT(laser.lists, SizeIs(1));
  EXPECT_THAT(laser.times_ns, SizeIs(laser.lists[0].counts.size()));
  EXPECT_THAT(laser.X_WB, SizeIs(laser.times_ns.size()));
  EXPECT_EQ(log_of(run, "sonar").lists[0].counts.at(0), 3);
  const DeviceLog& battery = log_of(run, "battery");
  EXPECT_FALSE(battery.beams.has_value());
  ASSERT_THAT(battery.series, Not(testing::IsEmpty()));
  for (const auto& series : battery.series)
    EXPECT_THAT(series.values, SizeIs(battery.times_ns.size()));
}

TEST(ReplayBuilder, ObstaclesAreNotedWhenTheyChange) {
  const ReplayRun run = driven(1.0, [](Simulation& simulation, ReplayBuilder&) {
    if (simulation.steps() == 50)
      simulation.set_obstacle_state("gate", sim::ObstacleState::kRetracted);
  });
  ASSERT_THAT(run.obstacles, SizeIs(1));
  EXPECT_THAT(run.obstacles[0].times_ns(), ElementsAre(0, 550'000'000));
  EXPECT_EQ(run.obstacles[0].common_length(), 9U);
}

TEST(ReplayBuilder, GoalsOfWaypointsAreReached) {
  const ReplayRun run = driven(6.0, [](Simulation& simulation, ReplayBuilder&) {
    if (simulation.steps() > 0) return;
    simulation.apply(id_of(simulation, "waypoint"),
                     sim::GotoCommand{.goal_m = {1.2, 0.5}, .tolerance_m = 0.1, .speed_mps = 0.3});
  });
  ASSERT_THAT(run.goals, SizeIs(1));
  EXPECT_EQ(run.goals[0].place, sim::Vec2(1.2, 0.5));
  ASSERT_TRUE(run.goals[0].reached_ns.has_value());
  EXPECT_GT(*run.goals[0].reached_ns, kSecond_ns);
}

TEST(ReplayBuilder, CollisionsAreNotedOnce) {
  const ReplayRun run = driven(8.0, [](Simulation& simulation, ReplayBuilder&) {
    simulation.apply(id_of(simulation, "motion"), sim::TwistCommand{{.v_mps = 0.3}});
  });
  ASSERT_THAT(run.collisions, Not(testing::IsEmpty()));
  EXPECT_EQ(run.collisions[0].partner, "border");
  for (std::size_t i = 1; i < run.collisions.size(); ++i) {
    EXPECT_GE(run.collisions[i].time_ns, run.collisions[i - 1].time_ns);
  }
}

TEST(ReplayBuilder, EqualCommandsAreOneNote) {
  const ReplayRun run = driven(0.1, [](Simulation& simulation, ReplayBuilder& builder) {
    builder.note_command(simulation.now_ns(), id_of(simulation, "motion"),
                         sim::TwistCommand{{.v_mps = simulation.steps() < 5 ? 0.1 : 0.2}});
  });
  ASSERT_THAT(run.commands, SizeIs(2));
  EXPECT_EQ(run.commands[1].time_ns, 50'000'000);
  EXPECT_THAT(run.command_texts, ElementsAre("twist v=0.1 omega=0", "twist v=0.2 omega=0"));
}

TEST(ReplayBuilder, MostCommandsAndOutputAreBounded) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation, {.name = "r", .most_commands = 3, .most_output_bytes = 10});
  for (int i = 0; i < 5; ++i) {
    builder.note_command(i, id_of(simulation, "motion"), sim::TwistCommand{{.v_mps = 0.1 * i}});
    builder.note_output(i, "1234\n", false);
  }
  const ReplayRun run = builder.finish(simulation);
  EXPECT_THAT(run.commands, SizeIs(3));
  EXPECT_THAT(run.command_texts, SizeIs(3));
  EXPECT_THAT(run.output, SizeIs(2));
  EXPECT_THAT(run.notes,
              ElementsAre(HasSubstr("Commands after the first 3"), HasSubstr("Printed")));
}

TEST(ReplayBuilder, OutputIsDividedIntoLines) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation);
  builder.note_output(7, "one\n\ntwo", true);
  builder.note_output(8, "\xff", false);
  const ReplayRun run = builder.finish(simulation);
  ASSERT_THAT(run.output, SizeIs(4));
  EXPECT_EQ(run.output[0].text, "one");
  EXPECT_EQ(run.output[1].text, "");
  EXPECT_EQ(run.output[2].text, "two");
  EXPECT_TRUE(run.output[2].is_error);
  EXPECT_EQ(run.output[3].text, "\\xff");
}

TEST(ReplayBuilder, DrawingsOfTheSimulationAreWatched) {
  const ReplayRun run = driven(0.2, [](Simulation& simulation, ReplayBuilder&) {
    if (simulation.steps() != 6) return;
    const sim::DrawOperation line{.kind = sim::DrawOperation::Kind::kLine,
                                  .layer = sim::kBaseLayer,
                                  .x0 = 2,
                                  .y0 = 1,
                                  .x1 = 4,
                                  .y1 = 1,
                                  .value = sim::CellValue::of(sim::Colour{255, 0, 0, 255})};
    simulation.layers().draw({&line, 1});
  });
  ASSERT_THAT(run.layers, SizeIs(1));
  ASSERT_THAT(run.layers[0].changes, SizeIs(1));
  EXPECT_EQ(run.layers[0].changes[0].time_ns, 100'000'000);
  ASSERT_THAT(run.layers[0].changes[0].runs, SizeIs(1));
  // Row 1 of a canvas with 20 columns begins with cell 20.
  EXPECT_EQ(run.layers[0].changes[0].runs[0].first, 22U);
  EXPECT_EQ(run.layers[0].changes[0].runs[0].count, 3U);
}

TEST(ReplayBuilder, CanvasResized_LayersOfEachSize) {
  const ReplayRun run = driven(0.3, [](Simulation& simulation, ReplayBuilder&) {
    const auto paint = [&](int column) {
      simulation.layers().set_cells(
          sim::kBaseLayer, {column, 0, 1, 1},
          std::vector(1, sim::CellValue::of(sim::Colour{255, 0, 0, 255})));
    };
    if (simulation.steps() == 6) paint(2);
    if (simulation.steps() == 16) simulation.layers().resize(30, 12);
    if (simulation.steps() == 26) paint(29);
  });
  ASSERT_THAT(run.layers, SizeIs(2));
  EXPECT_EQ(run.layers[0].width, 20);
  EXPECT_EQ(run.layers[1].width, 30);
  EXPECT_EQ(run.layers[1].height, 12);
  EXPECT_EQ(run.layers[0].name, run.layers[1].name);
  ASSERT_THAT(run.layers[0].changes, SizeIs(2));  // drawn, then blank
  EXPECT_EQ(run.layers[0].changes[1].time_ns, 200'000'000);
  EXPECT_EQ(run.layers[0].changes[1].runs[0].colour.a, 0);
  ASSERT_THAT(run.layers[1].changes, SizeIs(2));
  EXPECT_EQ(run.layers[1].changes[0].time_ns, 200'000'000);
  // The bottom left corner stays, so the cell of row 0 is now in row 2.
  EXPECT_EQ(run.layers[1].changes[0].runs[0].first, 2U * 30U + 2U);
  EXPECT_EQ(run.layers[1].changes[1].runs[0].first, 29U);
  EXPECT_THAT(run.notes, testing::IsEmpty());
}

TEST(ReplayBuilder, CanvasResizedOften_Noted) {
  const ReplayRun run = driven(2.0, [](Simulation& simulation, ReplayBuilder&) {
    simulation.layers().resize(20 + static_cast<int>(simulation.steps() / 5), 10);
  });
  EXPECT_THAT(run.notes, ElementsAre(HasSubstr("more than 16 times; drawings after that")));
  EXPECT_LE(run.layers.size(), 17U);
}

TEST(ReplayBuilder, CellRunsJoinEqualNeighbours) {
  const std::vector<std::uint8_t> before(16, 0);
  std::vector<std::uint8_t> now(16, 0);
  now[3] = now[7] = 255;  // two black cells, then two that have a colour but are transparent
  now[8] = 9;
  const auto runs = cell_runs(before, now);
  ASSERT_THAT(runs, SizeIs(1));
  EXPECT_EQ(runs[0].first, 0U);
  EXPECT_EQ(runs[0].count, 2U);
  EXPECT_THAT(cell_runs(now, now), testing::IsEmpty());
}

TEST(ReplayBuilder, WrongUseIsRefused) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation);
  EXPECT_THAT(
      [&] {
        builder.note_command(0, {0, 9}, sim::StopCommand{});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("no device 9")));
  EXPECT_THROW(builder.note_command(0, {7, 0}, sim::StopCommand{}), std::invalid_argument);
  EXPECT_THROW(builder.note_command(0, {-1, 0}, sim::StopCommand{}), std::invalid_argument);
  const Simulation before = simulation.fork();
  simulation.step();
  builder.observe(simulation);
  EXPECT_THAT([&] { builder.observe(before); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("after 10000000 ns")));
  EXPECT_THROW(static_cast<void>(html({})), std::invalid_argument);
}

TEST(ReplayEncoder, TextsOfCommandsComeFromTheirFields) {
  EXPECT_EQ(text_of(sim::StopCommand{}), "stop");
  EXPECT_EQ(text_of(sim::SayCommand{"hi"}), "say text=\"hi\"");
  EXPECT_EQ(text_of(sim::GripCommand{sim::GripCommand::Action::kClose}), "grip action=close");
  EXPECT_EQ(text_of(sim::GotoCommand{.goal_m = {1.23456, 2.0}}),
            "goto x=1.235 y=2 tolerance=0.5 speed=1");
}

TEST(ReplayEncoder, ThinningKeepsEveryNth) {
  const ReplayRun run = driven(2.0);
  const json whole = head_of(encoded({run}, {}));
  const json thin = head_of(encoded({run}, {.beams = 2, .scans = 2, .samples = 4}));
  EXPECT_EQ(whole["thinned"], "");
  EXPECT_THAT(thin["thinned"].get<std::string>(),
              AllOf(HasSubstr("every second laser beam"), HasSubstr("4th pose")));
  const auto count = [](const json& head, const json& column) {
    return head["columns"][column.get<std::size_t>()][1].get<std::size_t>();
  };
  // 41 frames: 0, 4, ..., 40.
  EXPECT_EQ(count(whole, whole["runs"][0]["frames"]), 41U);
  EXPECT_EQ(count(thin, thin["runs"][0]["frames"]), 11U);
  const auto laser = [](const json& head) {
    for (const json& device : head["runs"][0]["devices"]) {
      if (device["name"] == "laser") return device;
    }
    return json();
  };
  EXPECT_DOUBLE_EQ(laser(thin)["beams"]["step"].get<double>(),
                   2.0 * laser(whole)["beams"]["step"].get<double>());
  const std::size_t scans = count(whole, laser(whole)["t"]);
  EXPECT_EQ(count(thin, laser(thin)["t"]), (scans + 1) / 2);
  const std::size_t beams = count(whole, laser(whole)["lists"][0]["v"]) / scans;
  EXPECT_EQ(count(thin, laser(thin)["lists"][0]["v"]), (scans + 1) / 2 * ((beams + 1) / 2));
}

TEST(ReplayPage, LargePagesAreThinned) {
  const ReplayRun run = driven(4.0);
  const std::size_t whole = html({run}).size();
  const std::size_t least = html({run}, {.most_bytes = 0}).size();
  EXPECT_LT(least, whole);
  for (const std::size_t most : {whole - 1, (whole + least) / 2, least}) {
    EXPECT_LE(html({run}, {.most_bytes = most}).size(), most);
  }
}

TEST(ReplayPage, PageTooLargeInAnyCase_SaysSo) {
  const ReplayRun run = driven(1.0);
  const std::string said =
      encoded({run}, playerlike::replay::thinning_steps().back(),
              "Nothing more can be left out, so it is still larger than the limit of 0.02 MB.");
  EXPECT_THAT(said, HasSubstr("no drawings. Nothing more can be left out"));
  EXPECT_THAT(html({run}, {.most_bytes = 20'000}),
              HasSubstr(sim::to_base64(playpen::replay::deflated(said))));
}

TEST(ReplayPage, TextsAreNoMarkup) {
  Simulation simulation = room();
  const std::string evil = "</script><script>alert(1)</script><!--\xff";
  ReplayBuilder builder(simulation, {.name = evil});
  builder.note_output(0, evil, false);
  builder.note_command(0, id_of(simulation, "motion"), sim::SayCommand{evil});
  const ReplayRun run = builder.finish(simulation);
  const std::string page = html({run});
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script&gt;&lt;script&gt;alert(1)"));
  EXPECT_THAT(page, Not(HasSubstr("<!--")));
  // The page's own elements: the data, and one script.
  std::size_t scripts = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos;
       at = page.find("<script", at + 1)) {
    ++scripts;
  }
  EXPECT_EQ(scripts, 2U);
  EXPECT_THAT(page, HasSubstr("default-src 'none'; script-src 'sha256-"));
}

TEST(ReplayPage, EqualRunsGiveEqualPages) { EXPECT_EQ(html({driven(1.0)}), html({driven(1.0)})); }

// A part's readings, poses and so on after those of an earlier part.
void append(ReplayRun& run, const ReplayRun& part) {
  const auto add = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(run.frames_ns, part.frames_ns);
  for (std::size_t i = 0; i < part.robots.size(); ++i) add(run.robots[i].X_WB, part.robots[i].X_WB);
  for (std::size_t i = 0; i < part.devices.size(); ++i) {
    DeviceLog& device = run.devices[i];
    add(device.times_ns, part.devices[i].times_ns);
    EXPECT_EQ(part.devices[i].known_series, device.series.size());
    for (std::size_t k = 0; k < part.devices[i].series.size(); ++k) {
      if (k == device.series.size()) device.series.push_back({"", "", {}, {}});
      add(device.series[k].values, part.devices[i].series[k].values);
    }
    for (std::size_t k = 0; k < part.devices[i].lists.size(); ++k) {
      if (k == device.lists.size()) device.lists.push_back({"", "", {}, {}});
      add(device.lists[k].counts, part.devices[i].lists[k].counts);
      add(device.lists[k].values, part.devices[i].lists[k].values);
    }
  }
  for (std::size_t i = 0; i < part.obstacles.size(); ++i) {
    for (std::size_t k = 0; k < part.obstacles[i].times_ns().size(); ++k) {
      const std::vector<std::int64_t>& values = part.obstacles[i].values();
      const auto at = values.begin() + static_cast<std::ptrdiff_t>(9 * k);
      run.obstacles[i].note(part.obstacles[i].times_ns()[k], {at, at + 9});
    }
  }
  for (std::size_t i = 0; i < part.layers.size(); ++i) {
    EXPECT_EQ(part.layers[i].is_known, i < run.layers.size());
    if (i == run.layers.size())
      run.layers.push_back(part.layers[i]);
    else
      add(run.layers[i].changes, part.layers[i].changes);
  }
  for (const auto& command : part.commands) {
    run.commands.push_back(
        {command.time_ns, command.robot, command.device, run.command_texts.size()});
    run.command_texts.push_back(part.command_texts[command.text]);
  }
}

TEST(ReplayParts, AddUpToWhatOnePartHas) {
  Simulation simulation = room();
  ReplayBuilder often(simulation, {.live = true});
  ReplayBuilder once(simulation, {.live = true});
  ReplayRun sum;
  sum.robots.resize(1);
  sum.devices.resize(static_cast<std::size_t>(simulation.device_count(0)));
  sum.obstacles.resize(1);
  for (int step = 0; step < 200; ++step) {
    const sim::Command command = sim::TwistCommand{{.v_mps = 0.1 + 0.01 * (step / 50)}};
    simulation.apply(id_of(simulation, "motion"), command);
    if (step == 60) {
      ASSERT_FALSE(simulation.set_obstacle_state("gate", sim::ObstacleState::kRetracted));
    }
    if (step % 30 == 0) simulation.layers().base().set_pixel(step / 30, 1, {255, 0, 0, 255});
    simulation.step();
    for (ReplayBuilder* const builder : {&often, &once}) {
      builder->note_command(simulation.now_ns(), id_of(simulation, "motion"), command);
      builder->observe(simulation);
    }
    if (step % 7 == 3) append(sum, often.take());
  }
  append(sum, often.take());
  const ReplayRun all = once.take();
  EXPECT_EQ(sum.frames_ns, all.frames_ns);
  EXPECT_THAT(all.frames_ns, SizeIs(200));
  EXPECT_EQ(sum.robots[0].X_WB, all.robots[0].X_WB);
  for (std::size_t i = 0; i < all.devices.size(); ++i) {
    EXPECT_EQ(sum.devices[i].times_ns, all.devices[i].times_ns) << all.devices[i].name;
    for (std::size_t k = 0; k < all.devices[i].series.size(); ++k) {
      EXPECT_EQ(sum.devices[i].series[k].values, all.devices[i].series[k].values);
    }
    for (std::size_t k = 0; k < all.devices[i].lists.size(); ++k) {
      EXPECT_EQ(sum.devices[i].lists[k].values, all.devices[i].lists[k].values);
    }
  }
  EXPECT_THAT(log_of(all, "laser").times_ns, SizeIs(20));
  EXPECT_EQ(sum.obstacles[0].times_ns(), all.obstacles[0].times_ns());
  EXPECT_THAT(all.obstacles[0].times_ns(), SizeIs(2));
  ASSERT_EQ(sum.layers.size(), 1U);
  EXPECT_EQ(sum.layers[0].changes.size(), all.layers[0].changes.size());
  EXPECT_THAT(sum.commands, SizeIs(4));
  EXPECT_EQ(sum.command_texts.back(), all.command_texts[all.commands.back().text]);
  EXPECT_FALSE(has_news(once.take()));
}

TEST(ReplayParts, Whole_HasTheWorldAndItsPresentState) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation, {.live = true});
  simulation.apply(id_of(simulation, "motion"), sim::TwistCommand{{.v_mps = 0.1}});
  for (int step = 0; step < 300; ++step) {
    if (step % 100 == 0) simulation.layers().base().set_pixel(step / 100, 2, {255, 0, 0, 255});
    simulation.step();
    builder.observe(simulation);
    static_cast<void>(builder.take());
  }
  const ReplayRun whole = builder.whole();
  EXPECT_EQ(whole.end_ns, simulation.now_ns());
  // The history has a pose each 0.2 s, and the newest one.
  EXPECT_THAT(whole.frames_ns, SizeIs(16));
  EXPECT_EQ(whole.frames_ns.back(), simulation.now_ns());
  EXPECT_EQ(whole.robots[0].X_WB.back(), simulation.body(0).X_WB);
  EXPECT_EQ(whole.robots[0].start.name, "r1");
  EXPECT_THAT(log_of(whole, "laser").times_ns, SizeIs(1));
  EXPECT_EQ(log_of(whole, "laser").known_series, 0U);
  ASSERT_THAT(whole.layers, SizeIs(1));
  ASSERT_THAT(whole.layers[0].changes, SizeIs(1));
  std::uint32_t cells = 0;
  for (const auto& run : whole.layers[0].changes[0].runs) cells += run.count;
  EXPECT_EQ(cells, 3U);
  EXPECT_THAT(whole.obstacles[0].times_ns(), SizeIs(1));
  EXPECT_GT(encoded_whole(whole, "{}").size(), encoded_part(builder.take(), "{}").size());
}

TEST(ReplayParts, LongRun_HistoryIsThinned) {
  Simulation simulation = room();
  ReplayBuilder builder(simulation, {.live = true});
  for (int i = 0; i < 9000; ++i) {
    for (int step = 0; step < 20; ++step) simulation.step();
    builder.observe(simulation);
    static_cast<void>(builder.take());
  }
  const ReplayRun whole = builder.whole();
  EXPECT_LE(whole.frames_ns.size(), 4001U);
  EXPECT_GE(whole.frames_ns.size(), 2000U);
  EXPECT_LE(whole.frames_ns.front(), kSecond_ns);
  EXPECT_EQ(whole.frames_ns.back(), simulation.now_ns());
}

}  // namespace
