// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/run_mcap.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/results/recording_writer.h"
#include "playerlike/host/rerun.h"
#include "read_mcap.h"
#include "sim/core/time.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playpen::replay {
namespace {

using nlohmann::json;
using test::McapFile;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::ThrowsMessage;

// r1 has a device whose topic would be that of its texts.
constexpr const char* kWorld = R"({
  "name": "exported", "arena": {"size": [2, 2], "obstacles": [
    {"name": "block", "center": [1.0, 0.5], "size": [0.2, 0.4], "height": 0.16},
    {"name": "gate", "center": [1.0, 1.6], "size": [0.2, 0.1], "height": 0.16, "type": "dynamic"}]},
  "controller": {"timers": [{"name": "opener", "at": 0.3, "do": [{"retract": ["gate"]}]}]},
  "robots": [
    {"name": "r1", "pose": {"x": 0.6, "y": 0.5, "yaw_deg": 0}, "devices": {
      "motion": {}, "laser": {}, "speech": {}, "said": {"type": "pose"}}},
    {"name": "r2", "pose": {"x": 1.5, "y": 0.5, "yaw_deg": 90}}]})";

/// Lets this process print into a file.
class Redirected {
 public:
  explicit Redirected(const std::string& file) {
    std::fflush(stdout);
    const int to = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(to, STDOUT_FILENO);
    close(to);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() {
    std::fflush(stdout);
    dup2(before_, STDOUT_FILENO);
    close(before_);
  }

 private:
  int before_ = dup(STDOUT_FILENO);
};

class RunMcap : public testing::Test {
 protected:
  /// A run of 1 s, in which r1 drives against the block.
  RunMcap() {
    const std::string world = folder_.write("world.json", kWorld);
    playerlike::RunSettings settings;
    settings.output_folder = folder_.path().string();
    const Redirected redirected(folder_ / "program.log");
    sim::Simulation run(sim::load_world(world));
    playerlike::RecordingWriter writer(settings, run);
    const int motors = run.find_device(0, "motion").value();
    const int laser = run.find_device(0, "laser").value();
    const int speech = run.find_device(0, "speech").value();
    poses_.push_back(run.body(0).X_WB);
    for (int step = 0; step < 103; ++step) {
      if (step == 5) static_cast<void>(run.apply({0, motors}, sim::TwistCommand{{0.5, 0.25, 0.0}}));
      if (step == 20) static_cast<void>(run.apply({0, speech}, sim::SayCommand{"\"hello\""}));
      if (step == 31) std::printf("one\n\ntwo \xff\nthr");
      run.step();
      EXPECT_EQ(writer.observe(), std::nullopt);
      poses_.push_back(run.body(0).X_WB);
      const auto& scan = static_cast<const sim::Laser&>(run.device(0, laser)).reading();
      if (scan.sequence > scans_.size()) scans_.push_back(scan);
    }
    EXPECT_EQ(writer.close(), std::nullopt);
    collisions_ = run.collisions();
  }
  void write(const std::string& file) const {
    playerlike::Rerun rerun(folder_.path().string());
    write_mcap(rerun, file);
  }
  [[nodiscard]] McapFile exported() const {
    write(folder_ / "run.mcap");
    return test::read_mcap(read_bytes(folder_ / "run.mcap"));
  }

  TemporaryFolder folder_;
  std::vector<sim::Pose> poses_;
  std::vector<sim::LaserReading> scans_;
  std::vector<sim::Collision> collisions_;
};

TEST_F(RunMcap, Poses_EachTwentiethAndLast) {
  const McapFile file = exported();
  const auto poses = file.of("/r1/true_pose");
  const auto in_frame = file.of("/r1/true_pose/in_frame");
  ASSERT_EQ(poses.size(), 22U);  // 0, 0.05 s, ..., 1 s, and the end at 1.03 s
  ASSERT_EQ(in_frame.size(), 22U);
  EXPECT_EQ(file.of("/r2/true_pose").size(), 22U);
  EXPECT_EQ(poses.back().log_ns, 1'030'000'000U);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& pose = poses_[poses[i].log_ns / 10'000'000];
    const json message = json::parse(poses[i].data);
    EXPECT_EQ(message.at("x"), pose.x_m);
    EXPECT_EQ(message.at("yaw"), pose.yaw_rad);
    const json framed = json::parse(in_frame[i].data);
    EXPECT_EQ(framed.at("pose").at("position").at("x"), pose.x_m);
    EXPECT_EQ(framed.at("timestamp").at("sec"), i < 20 ? 0 : 1);
  }
  EXPECT_EQ(json::parse(poses.back().data).at("stalled"), true);
}

TEST_F(RunMcap, Readings_ExactWithMeasuredTime) {
  const McapFile file = exported();
  const auto readings = file.of("/r1/laser");
  const auto in_space = file.of("/r1/laser/scan");
  ASSERT_EQ(readings.size(), scans_.size());
  ASSERT_EQ(in_space.size(), scans_.size());
  ASSERT_GT(scans_.size(), 8U);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const json message = json::parse(readings[i].data);
    EXPECT_EQ(message.at("ranges").get<std::vector<double>>(), scans_[i].ranges_m);
    EXPECT_EQ(message.at("seq"), scans_[i].sequence);
    EXPECT_EQ(readings[i].publish_ns, static_cast<std::uint64_t>(scans_[i].time_ns));
    const json scan = json::parse(in_space[i].data);
    EXPECT_THAT(scan.at("ranges").get<std::vector<double>>(),
                testing::Pointwise(testing::DoubleNear(0.00005001), scans_[i].ranges_m));
    EXPECT_NEAR(scan.at("end_angle").get<double>(), -scan.at("start_angle").get<double>(), 0.01);
    // The S1R's laser is 0.035 m ahead of its middle.
    EXPECT_NEAR(scan.at("pose").at("position").at("x").get<double>(),
                scans_[i].X_WB.x_m + 0.035 * std::cos(scans_[i].X_WB.yaw_rad), 1e-12);
  }
  EXPECT_EQ(file.channels.at(in_space[0].channel).schema_name, "foxglove.LaserScan");
}

TEST_F(RunMcap, CommandsAndEvents_EachInItsTopic) {
  const McapFile file = exported();
  const auto commands = file.of("/r1/commands");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].log_ns, 50'000'000U);
  const json command = json::parse(commands[0].data);
  EXPECT_EQ(command.at("device"), "motion");
  EXPECT_EQ(command.at("command").at("kind"), "twist");
  EXPECT_EQ(command.at("command").at("v"), 0.5);
  const auto said = file.of("/r1/said");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(json::parse(said[0].data).at("text"), "\"hello\"");
  const auto events = file.of("/arena/events");
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(json::parse(events[0].data).at("what"), "opener");
  const auto collisions = file.of("/arena/collisions");
  ASSERT_EQ(collisions.size(), collisions_.size());
  ASSERT_FALSE(collisions.empty());
  EXPECT_EQ(json::parse(collisions[0].data).at("partner"), "block");
  EXPECT_EQ(collisions[0].publish_ns, static_cast<std::uint64_t>(collisions_[0].time_ns));
}

TEST_F(RunMcap, PrintedLines_ToTenthOfSecond) {
  const auto lines = exported().of("/program/log");
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(json::parse(lines[0].data).at("message"), "one");
  EXPECT_EQ(json::parse(lines[1].data).at("message"), "");
  EXPECT_EQ(json::parse(lines[2].data).at("message"), "two \\xff");
  EXPECT_EQ(json::parse(lines[3].data).at("message"), "thr");
  EXPECT_EQ(lines[0].log_ns, 400'000'000U);
  EXPECT_EQ(lines[3].log_ns, 1'030'000'000U);  // its end never came
}

TEST_F(RunMcap, LogTimes_NeverDecrease) {
  std::uint64_t last_ns = 0;
  for (const McapFile::Message& message : exported().messages) {
    EXPECT_GE(message.log_ns, last_ns);
    last_ns = message.log_ns;
  }
}

TEST_F(RunMcap, EqualTopics_ToldApart) {
  const McapFile file = exported();
  EXPECT_TRUE(json::parse(file.of("/r1/said_").front().data).contains("seq"));
}

TEST_F(RunMcap, SameRun_SameBytes) {
  write(folder_ / "one.mcap");
  write(folder_ / "two.mcap");
  EXPECT_TRUE(read_bytes(folder_ / "one.mcap") == read_bytes(folder_ / "two.mcap"));
}

TEST_F(RunMcap, FileNotWritable_Refused) {
  EXPECT_THAT([this] { write(folder_ / "none/run.mcap"); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("run.mcap: cannot write the MCAP file: No such file or directory")));
}

TEST_F(RunMcap, DamagedRecording_NoFile) {
  std::string bytes = read_bytes(folder_ / "recording.bin");
  const std::size_t head = bytes.find('\n');
  bytes[head + (bytes.size() - head) / 2] = '\x7f';
  folder_.write("recording.bin", bytes);
  EXPECT_THROW(write(folder_ / "run.mcap"), playerlike::RecordingError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.mcap"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.part.mcap"));
}

}  // namespace
}  // namespace playpen::replay
