// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/rerun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "host/results/recording_writer.h"
#include "playerlike/host/host.h"
#include "protocol/codec.h"
#include "random_fields.h"
#include "sim/core/error.h"
#include "sim/core/time.h"
#include "sim/devices/builtin.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kWorld = R"({
  "name": "recorded", "arena": {"size": [2, 2], "obstacles": [
    {"name": "gate", "center": [1.0, 1.6], "size": [0.2, 0.1], "height": 0.16, "type": "dynamic"}]},
  "canvas": {"size": [30, 20], "cell_size": 0.1}, "simulation": {"seed": 7},
  "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5, "yaw_deg": 0}},
             {"name": "r2", "pose": {"x": 1.5, "y": 0.5, "yaw_deg": 90}}]})";

class RerunTest : public testing::Test {
 protected:
  RerunTest() : world_(folder_.write("world.json", kWorld)) {
    settings_.output_folder = folder_.path().string();
    settings_.seed = 3;
    settings_.duration_s = 60.0;
  }
  [[nodiscard]] sim::Simulation simulation() const {
    sim::WorldDescription world = sim::load_world(world_);
    settings_.apply_to(world);
    return sim::Simulation(std::move(world));
  }
  /// Makes and records a run.
  /// @param act  called before each step, with its number.
  /// @return the hashes of the states after each step.
  std::vector<std::uint64_t> record(int steps,
                                    const std::function<void(sim::Simulation&, int)>& act,
                                    bool close = true) {
    sim::Simulation run = simulation();
    RecordingWriter writer(settings_, run);
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < steps; ++step) {
      act(run, step);
      run.step();
      EXPECT_EQ(writer.observe(), std::nullopt);
      hashes.push_back(run.state_parts().hash_without_canvas());
    }
    if (close) {
      EXPECT_EQ(writer.close(), std::nullopt);
    }
    last_cells_.clear();
    for (const sim::LayerInfo& layer : run.layers().layers()) {
      last_cells_.push_back(run.layers().picture(layer.id));
    }
    return hashes;
  }
  [[nodiscard]] std::string file() const { return folder_ / "recording.bin"; }
  Rerun rerun() const { return Rerun(folder_.path().string()); }

  TemporaryFolder folder_;
  std::string world_;
  RunSettings settings_;
  std::vector<std::vector<std::uint8_t>> last_cells_;
};

void drive(sim::Simulation& run, int step) {
  const int motors = run.find_device(0, "motion").value();
  if (step % 10 == 0) {
    const double v_mps = step < 200 ? 0.3 : 0.2 + 0.001 * step;
    EXPECT_EQ(run.apply({0, motors}, sim::TwistCommand{{v_mps, 0.4, 0.0}}), std::nullopt);
  }
  if (step % 35 == 0) {
    static_cast<void>(run.apply({1, motors}, sim::TwistCommand{{-0.1, 0.01 * step, 0.0}}));
  }
}

TEST_F(RerunTest, CommandsAndInterventions_SameStateAfterEachStep) {
  const auto hashes = record(1500, [](sim::Simulation& run, int step) {
    drive(run, step);
    if (step == 333) {
      EXPECT_EQ(run.place_object("r2", {0.4, 1.5, 0.5}), std::nullopt);
    }
    if (step == 400) {
      EXPECT_EQ(run.set_obstacle_state("gate", sim::ObstacleState::kRetracted), std::nullopt);
    }
    if (step == 700) run.set_active({0, run.find_device(0, "laser").value()}, false);
    if (step == 900) {
      EXPECT_EQ(run.reset(), std::nullopt);
    }
  });
  Rerun again = rerun();
  EXPECT_FALSE(again.complete());
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    ASSERT_TRUE(again.step());
    sim::Simulation copy = again.simulation().fork();
    ASSERT_EQ(copy.state_parts().hash_without_canvas(), hashes[i]) << i;
    EXPECT_EQ(again.commands().size(), (i % 10 == 0 ? 1U : 0U) + (i % 35 == 0 ? 1U : 0U)) << i;
  }
  EXPECT_FALSE(again.step());
  EXPECT_FALSE(again.step());
  EXPECT_TRUE(again.complete());
}

// How many clients a run waits for is no part of its recording.
TEST_F(RerunTest, StartGateOfRun_StatesCanBeRead) {
  settings_.clients = 2;
  const auto hashes = record(200, [](sim::Simulation& run, int step) {
    drive(run, step);
    if (step == 100) {
      EXPECT_EQ(run.place_object("r2", {0.4, 1.5, 0.5}), std::nullopt);
    }
  });
  Rerun again = rerun();
  while (again.step()) {
  }
  sim::Simulation copy = again.simulation().fork();
  EXPECT_EQ(copy.state_parts().hash_without_canvas(), hashes.back());
}

TEST_F(RerunTest, RepeatedCommand_TakesFewBytes) {
  const auto act = [](sim::Simulation& run, int) {
    const int motors = run.find_device(0, "motion").value();
    static_cast<void>(run.apply({0, motors}, sim::TwistCommand{{0.1, 0.0, 0.0}}));
  };
  record(100, act);
  const std::size_t first = read_bytes(file()).size();
  record(200, act);
  EXPECT_LT(read_bytes(file()).size() - first, 100 * 12U);
}

TEST_F(RerunTest, AdvanceTo_StopsThere) {
  record(300, drive);
  Rerun again = rerun();
  EXPECT_TRUE(again.advance_to(sim::from_seconds(1.5)));
  EXPECT_EQ(again.simulation().now_ns(), sim::from_seconds(1.5));
  EXPECT_FALSE(again.advance_to(sim::from_seconds(5.0)));
  EXPECT_EQ(again.simulation().now_ns(), sim::from_seconds(3.0));
}

TEST_F(RerunTest, EachKindOfCommand_Recorded) {
  test::RandomFields random(5);
  std::vector<sim::Command> commands;
  for (const auto& kind : sim::command_kinds()) {
    commands.push_back(kind.make());
    random.fill(kind.fields(), sim::object_in(commands.back()));
  }
  record(static_cast<int>(commands.size()), [&](sim::Simulation& run, int step) {
    // Most of them are refused by this device.
    static_cast<void>(run.apply({1, 0}, commands[static_cast<std::size_t>(step)]));
  });
  Rerun again = rerun();
  for (const sim::Command& command : commands) {
    ASSERT_TRUE(again.step());
    ASSERT_EQ(again.commands().size(), 1U);
    EXPECT_EQ(again.commands()[0].device, (sim::Simulation::DeviceId{1, 0}));
    EXPECT_EQ(protocol::encode_command(again.commands()[0].command).dump(),
              protocol::encode_command(command).dump());
  }
}

TEST_F(RerunTest, Layers_AsDrawn) {
  const auto draw = [grey = 0, binary = 0](sim::Simulation& run, int step) mutable {
    sim::LayerStack& layers = run.layers();
    if (step == 10) grey = layers.add(sim::LayerKind::kGrey, {.name = "map"}, 6665);
    if (step == 20) binary = layers.add(sim::LayerKind::kBinary, {.name = "old"}, 6665);
    if (step == 80) static_cast<void>(layers.remove(binary));
    if (step == 90) binary = layers.add(sim::LayerKind::kBinary, {.name = "path"}, 6665);
    if (step == 150) layers.resize(40, 25);
    if (step == 170) layers.set_style(grey, {.name = "map", .transparency = 0.5, .priority = 3});
    if (step < 20) return;
    const sim::CellValue occupied = sim::CellValue::of(0.01F * static_cast<float>(step % 100));
    layers.set_cells(grey, {step % 30, step % 20, 2, 2}, std::vector(4, occupied));
    layers.set_cells(binary, {3, step % 20, 5, 1}, std::vector(5, sim::CellValue::of(true)));
    layers.set_cells(sim::kBaseLayer, {step % 7, 0, 1, 1},
                     std::vector(1, sim::CellValue::of(sim::Colour{255, 0, 0, 128})));
  };
  record(237, draw);
  Rerun again = rerun();
  ASSERT_TRUE(again.advance_to(sim::from_seconds(0.5)));
  const std::uint64_t changes = again.layer_changes();
  EXPECT_GE(changes, 3U);
  EXPECT_FALSE(again.advance_to(sim::from_seconds(9.0)));
  EXPECT_GT(again.layer_changes(), changes);
  const std::vector<sim::LayerInfo> layers = again.layers().layers();
  ASSERT_EQ(layers.size(), last_cells_.size());
  EXPECT_EQ(layers.back().style.name, "map");
  EXPECT_EQ(again.layers().width(), 40);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_TRUE(again.layers().picture(layers[i].id) == last_cells_[i]) << layers[i].style.name;
  }
}

TEST_F(RerunTest, Reads_GivenWithNextStep) {
  sim::Simulation run = simulation();
  RecordingWriter writer(settings_, run);
  for (int step = 0; step < 20; ++step) {
    if (step == 15) writer.note_read(2, sim::from_seconds(0.1));
    if (step == 15) writer.note_read(3, sim::from_seconds(0.15));
    run.step();
    EXPECT_EQ(writer.observe(), std::nullopt);
  }
  EXPECT_EQ(writer.close(), std::nullopt);
  Rerun again = rerun();
  ASSERT_TRUE(again.advance_to(sim::from_seconds(0.15)));
  EXPECT_TRUE(again.reads().empty());
  ASSERT_TRUE(again.step());
  ASSERT_EQ(again.reads().size(), 2U);
  EXPECT_EQ(again.reads()[0].port, 2);
  EXPECT_EQ(again.reads()[0].age_ns, sim::from_seconds(0.05));
  EXPECT_EQ(again.reads()[1].age_ns, 0);
  ASSERT_TRUE(again.step());
  EXPECT_TRUE(again.reads().empty());
}

TEST_F(RerunTest, ProgramKilled_AllUntilLastTenth) {
  record(237, drive, /*close=*/false);
  Rerun again = rerun();
  EXPECT_FALSE(again.advance_to(sim::from_seconds(9.0)));
  EXPECT_FALSE(again.complete());
  EXPECT_GE(again.simulation().steps(), 230U);
}

TEST_F(RerunTest, SameRun_SameBytes) {
  record(200, drive);
  const std::string first = read_bytes(file());
  record(200, drive);
  EXPECT_TRUE(read_bytes(file()) == first);
}

TEST_F(RerunTest, WorldEdited_RunFromRecordedText) {
  record(20, drive);
  folder_.write("world.json", "{}");
  EXPECT_TRUE(rerun().advance_to(sim::from_seconds(0.2)));
}

TEST_F(RerunTest, UnusableRecording_Refused) {
  const auto refused = [this](const std::string& text) {
    return ThrowsMessage<RecordingError>(HasSubstr(text));
  };
  EXPECT_THAT([this] { rerun(); },
              refused("expected the recording of a run, found no file of that name"));
  folder_.write("recording.bin", "hello");
  EXPECT_THAT([this] { rerun(); }, refused("expected the head of a recording in its first line"));
  record(20, drive);
  const std::string good = read_bytes(file());
  std::string other = good;
  other.replace(other.find("\"version\":\"") + 11, 1, "9");
  folder_.write("recording.bin", other);
  EXPECT_THAT([this] { rerun(); }, refused("expected a recording of Playpen"));
  other = good;
  other.replace(other.find("world_hash\":\"") + 13, 4, "0000");
  folder_.write("recording.bin", other);
  EXPECT_THAT([this] { rerun(); }, refused("it or a file that it names has changed since"));
}

TEST_F(RerunTest, OtherRunThanRecorded_Noticed) {
  record(1200, drive);
  std::string bytes = read_bytes(file());
  const std::size_t head = bytes.find('\n');
  // The first command's speed, 0.3: its last byte but one.
  const double speed = 0.3;
  const std::string_view number(reinterpret_cast<const char*>(&speed), sizeof speed);
  const std::size_t place = bytes.find(number, head);
  ASSERT_NE(place, std::string::npos);
  bytes[place + 6] = static_cast<char>(bytes[place + 6] ^ 1);
  folder_.write("recording.bin", bytes);
  EXPECT_THAT([this] { rerun().advance_to(sim::from_seconds(12.0)); },
              ThrowsMessage<RecordingError>(HasSubstr("found another one by 10.00 s")));
}

TEST_F(RerunTest, DamagedBytes_NeverMoreThanError) {
  record(120, [](sim::Simulation& run, int step) {
    drive(run, step);
    if (step == 5) static_cast<void>(run.layers().add(sim::LayerKind::kGrey, {}, 1));
    if (step == 30) static_cast<void>(run.place_object("r2", {0.4, 1.5, 0.5}));
    run.layers().set_cells(sim::kBaseLayer, {step % 30, 3, 1, 1},
                           std::vector(1, sim::CellValue::of(sim::Colour{255, 0, 0, 255})));
  });
  const std::string good = read_bytes(file());
  const std::size_t head = good.find('\n');
  std::mt19937_64 random(1);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bad = good;
    const std::size_t place = head + 1 + random() % (good.size() - head - 1);
    if (i % 3 == 0) {
      bad.resize(place);
    } else {
      bad[place] = static_cast<char>(random());
    }
    folder_.write("recording.bin", bad);
    try {
      rerun().advance_to(sim::from_seconds(2.0));
    } catch (const RecordingError& e) {
      ++refused;
      EXPECT_THAT(e.what(), HasSubstr("recording.bin"));
    }
  }
  EXPECT_GT(refused, 20);
}

// --- Runs that begin in the state of another one

class StartedRunTest : public RerunTest {
 protected:
  /// Records 3 s and writes the state after one second, with which the settings then begin.
  /// @return hashes as record().
  std::vector<std::uint64_t> record_first() {
    auto hashes = record(300, [this](sim::Simulation& run, int step) {
      drive(run, step);
      if (step == 50) {
        EXPECT_EQ(run.set_obstacle_state("gate", sim::ObstacleState::kRetracted), std::nullopt);
        run.layers().set_cells(sim::kBaseLayer, {2, 3, 1, 1}, std::vector(1, kRed));
        static_cast<void>(run.layers().add(sim::LayerKind::kGrey, {.name = "map"}, 6665));
      }
    });
    Rerun first = rerun();
    EXPECT_TRUE(first.advance_to(kStart_ns));
    const sim::Snapshot state = first.state();
    settings_.start_state = second_.write("state", std::string(state.begin(), state.end()));
    settings_.output_folder = second_.path().string();
    return hashes;
  }
  [[nodiscard]] sim::Simulation restored() const {
    sim::Simulation run = simulation();
    run.restore(Bytes(read_bytes(settings_.start_state)).all);
    return run;
  }
  struct Bytes {
    template <typename Text>
    explicit Bytes(const Text& text) : all(text.begin(), text.end()) {}
    std::vector<std::uint8_t> all;
  };

  static constexpr sim::SimTime kStart_ns = sim::kNanosecondsPerSecond;
  const sim::CellValue kRed = sim::CellValue::of(sim::Colour{255, 0, 0, 255});
  TemporaryFolder second_;
};

TEST_F(StartedRunTest, SameCommands_SameRun) {
  const auto hashes = record_first();
  sim::Simulation run = restored();
  RecordingWriter writer(settings_, run);
  for (int step = 100; step < 300; ++step) {
    drive(run, step);
    run.step();
    EXPECT_EQ(writer.observe(), std::nullopt);
    ASSERT_EQ(run.state_parts().hash_without_canvas(), hashes[static_cast<std::size_t>(step)]);
  }
}

TEST_F(StartedRunTest, State_HasBaseCanvasOnly) {
  static_cast<void>(record_first());
  const sim::Simulation run = restored();
  EXPECT_EQ(run.now_ns(), kStart_ns);
  EXPECT_EQ(run.steps(), 100U);
  EXPECT_EQ(run.layers().layers().size(), 1U);
  EXPECT_EQ(run.layers().cell(sim::kBaseLayer, 2, 3), kRed);
}

TEST_F(StartedRunTest, RecordedAgain_CanBeMadeAgain) {
  static_cast<void>(record_first());
  std::uint64_t hash = 0;
  {
    sim::Simulation run = restored();
    RecordingWriter writer(settings_, run);
    for (int step = 0; step < 1500; ++step) {  // more than one hash is recorded
      drive(run, step);
      run.step();
      EXPECT_EQ(writer.observe(), std::nullopt);
    }
    EXPECT_EQ(writer.close(), std::nullopt);
    hash = run.state_parts().hash_without_canvas();
  }
  Rerun again(settings_.output_folder);
  EXPECT_EQ(again.simulation().now_ns(), kStart_ns);
  EXPECT_EQ(again.world_file(), world_);
  EXPECT_EQ(again.settings().seed, 3U);
  while (again.step()) {
  }
  EXPECT_TRUE(again.complete());
  EXPECT_EQ(again.simulation().now_ns(), 16 * sim::kNanosecondsPerSecond);
  sim::Simulation copy = again.simulation().fork();
  EXPECT_EQ(copy.state_parts().hash_without_canvas(), hash);
  EXPECT_EQ(again.layers().cell(sim::kBaseLayer, 2, 3), kRed);
}

TEST_F(StartedRunTest, Host_BeginsAtItsTime) {
  static_cast<void>(record_first());
  const auto host = Host::create(sim::load_world(world_), settings_);
  EXPECT_EQ(host->now_ns(), kStart_ns);
  host->set_step_credit(25);
  while (host->advance(std::chrono::seconds(1))) {
  }
  EXPECT_EQ(host->time().steps, 125U);
  host->finish();
  const auto bytes = read_bytes(second_ / "trajectory.csv");
  std::vector<std::string> times;
  std::istringstream rows(std::string(bytes.begin(), bytes.end()));
  for (std::string row; std::getline(rows, row);) {
    if (row.find(",r1,") != std::string::npos) times.push_back(row.substr(0, 5));
  }
  EXPECT_EQ(times, (std::vector<std::string>{"1.000", "1.100", "1.200"}));
}

TEST_F(StartedRunTest, UnusableState_Refused) {
  static_cast<void>(record_first());
  const auto create = [this] {
    static_cast<void>(Host::create(sim::load_world(world_), settings_));
  };
  settings_.seed = 4;
  EXPECT_THAT(create, ThrowsMessage<sim::ConfigError>(
                          AllOf(HasSubstr("run/start"), HasSubstr("seed 4"), HasSubstr("seed 3"))));
  settings_.start_state = second_ / "none";
  EXPECT_THAT(create, ThrowsMessage<sim::ConfigError>(HasSubstr("no file of that name")));
}

TEST(CellChanges, AnyChanges_AppliedExactly) {
  std::mt19937_64 random(2);
  for (const std::uint32_t kinds : {2U, 40U, 100'000U}) {
    sim::LayerStack stack(sim::CanvasDescription{.width = 37, .height = 23});
    sim::LayerStack copy(sim::CanvasDescription{.width = 37, .height = 23});
    for (int change = 0; change < 20; ++change) {
      std::vector<sim::CellValue> cells = stack.cells(sim::kBaseLayer);
      for (sim::CellValue& cell : cells) {
        if (random() % 3 == 0) cell.bits = static_cast<std::uint32_t>(random() % kinds);
      }
      stack.set_cells(sim::kBaseLayer, {0, 0, 37, 23}, cells);
      CellChanges::between(copy.bytes(sim::kBaseLayer), stack.bytes(sim::kBaseLayer), 37)
          .apply(copy, sim::kBaseLayer);
      ASSERT_TRUE(copy.cells(sim::kBaseLayer) == stack.cells(sim::kBaseLayer));
    }
  }
}

}  // namespace
}  // namespace playerlike
