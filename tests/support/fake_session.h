// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libplayerc++/playererror.h"
#include "playerlike/session/session.h"
#include "sim/canvas/canvas.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace test {

/// What stands behind a FakeSession: a world without physics, whose readings a test writes down
/// beforehand, and which remembers what it was told. Outlives the session, so that a test can look
/// at what a client left behind.
struct FakeWorld {
  using Round = std::vector<std::pair<playerlike::DeviceId, std::shared_ptr<sim::Reading>>>;
  using Sent = std::pair<playerlike::DeviceId, sim::Command>;

  std::mutex mutex;
  std::condition_variable changed;
  std::vector<playerlike::RobotInfo> robots;
  int port = 6665;
  std::vector<Round> rounds;  ///< still to come
  bool over_when_empty = true;
  std::vector<Sent> sent;
  std::map<int, int> subscriptions;  ///< device number -> count
  std::map<int, bool> replace;       ///< device number (-1: all) -> rule
  std::vector<std::string> real_time_reasons;
  bool closed = false;
  int draw_calls = 0;
  sim::Canvas canvas{sim::CanvasDescription{}};
  sim::SimTime slept_ns = 0;
  playerlike::TimeStatistics time;

  void add_round(Round round) {
    const std::lock_guard lock(mutex);
    rounds.push_back(std::move(round));
    changed.notify_all();
  }
};

// Numbers of the devices of the fake robot.
inline constexpr playerlike::DeviceId kLaser{0, 0};
inline constexpr playerlike::DeviceId kMotion{0, 1};
inline constexpr playerlike::DeviceId kOdometry{0, 2};
inline constexpr playerlike::DeviceId kPen{0, 3};
inline constexpr playerlike::DeviceId kPose{0, 4};

/// A world with one robot "r1" of the size of an S1R, with a laser of 5 beams, 0.5 rad apart.
inline std::shared_ptr<FakeWorld> make_fake_world() {
  auto world = std::make_shared<FakeWorld>();
  playerlike::RobotInfo robot;
  robot.name = "r1";
  robot.model = "s1r";
  robot.colour = {0xff, 0x88, 0x00, 0xff};
  robot.initial_pose = {0.5, 0.4, 1.5};
  robot.port = 6665;
  robot.length_m = 0.174;
  robot.width_m = 0.162;
  robot.height_m = 0.18;
  robot.max_speed_mps = 0.5;
  robot.max_turn_rate_radps = 3.0;
  robot.proxies = {{"laser", 7}};
  robot.drivers = {{"snd", {{"goal_distance", "0.1"}}}};
  robot.devices = {
      {kLaser,
       "laser",
       "laser",
       {{"frequency", 10.0},
        {"noise", 0.0},
        {"beams", 5.0},
        {"resolution", 0.5},
        {"range_max", 5.0},
        {"mount_x", 0.035},
        {"mount_y", 0.01},
        {"mount_yaw", 0.1},
        {"height", 0.125}}},
      {kMotion, "motion", "motion", {{"max_speed", 0.4}, {"max_turn_rate", 2.0}}},
      {kOdometry, "odometry", "odometry", {{"frequency", 10.0}, {"noise", 0.0}}},
      {kPen, "pen", "pen", {{"trail", 0.0}}},
      {kPose, "pose", "pose", {{"frequency", 10.0}, {"noise", 0.0}}},
  };
  world->robots.push_back(robot);
  return world;
}

/// A reading of a localisation device at a time.
inline std::shared_ptr<sim::Reading> pose_reading(double time_s, sim::Pose pose,
                                                  sim::Twist twist = {}, bool stalled = false) {
  auto reading = std::make_shared<sim::PoseReading>();
  reading->time_ns = sim::from_seconds(time_s);
  reading->sequence = 1;
  reading->pose = pose;
  reading->twist = twist;
  reading->stalled = stalled;
  return reading;
}

/// A scan of the fake laser: beam i looks at -1 + 0.5 i [rad].
inline std::shared_ptr<sim::Reading> scan(double time_s, std::vector<double> ranges_m) {
  auto reading = std::make_shared<sim::LaserReading>();
  reading->time_ns = sim::from_seconds(time_s);
  reading->sequence = 1;
  reading->resolution_rad = 0.5;
  reading->angle_min_rad = -0.25 * static_cast<double>(ranges_m.size() - 1);
  reading->range_max_m = 5.0;
  reading->ranges_m = std::move(ranges_m);
  return reading;
}

/// A session that hands out a FakeWorld's readings, one round a wait().
class FakeSession final : public playerlike::Session {
 public:
  explicit FakeSession(std::shared_ptr<FakeWorld> world) : world_(std::move(world)) {}
  ~FakeSession() override { FakeSession::close(); }

  const std::vector<playerlike::RobotInfo>& robots() const noexcept override {
    return world_->robots;
  }
  int port() const noexcept override { return world_->port; }
  bool connected() const noexcept override {
    const std::lock_guard lock(world_->mutex);
    return !world_->closed;
  }

  void subscribe(playerlike::DeviceId device) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    ++world_->subscriptions[device.device];
  }
  void unsubscribe(playerlike::DeviceId device) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    --world_->subscriptions[device.device];
  }
  void set_replace(std::optional<playerlike::DeviceId> device, bool replace) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    world_->replace[device ? device->device : -1] = replace;
  }
  std::uint32_t overflow_count() const override { return 3; }

  void wait() override {
    std::unique_lock lock(world_->mutex);
    world_->changed.wait(lock, [this] {
      return world_->closed || !world_->rounds.empty() || world_->over_when_empty;
    });
    require_open();
    if (world_->rounds.empty()) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kFinished,
                                     "the simulated run is over");
    }
  }
  int take(playerlike::ReadingSink& sink) override {
    FakeWorld::Round round;
    {
      const std::lock_guard lock(world_->mutex);
      require_open();
      if (world_->rounds.empty()) return 0;
      round = std::move(world_->rounds.front());
      world_->rounds.erase(world_->rounds.begin());
    }
    int count = 0;
    for (const auto& [device, reading] : round) {
      sink.on_reading(device, *reading);
      ++count;
    }
    return count;
  }
  bool peek(std::chrono::milliseconds timeout) override {
    std::unique_lock lock(world_->mutex);
    const auto ready = [this] {
      return world_->closed || !world_->rounds.empty() || world_->over_when_empty;
    };
    world_->changed.wait_for(lock, timeout, ready);
    require_open();
    return ready();
  }

  void send(playerlike::DeviceId device, const sim::Command& command) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    world_->sent.emplace_back(device, command);
  }

  void draw(std::span<const sim::CanvasOperation> operations) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    ++world_->draw_calls;
    for (const auto& operation : operations) operation.draw(world_->canvas);
  }
  playerlike::CanvasInfo canvas_info() const override {
    const sim::Canvas& c = world_->canvas;
    return {c.width(), c.height(), c.cell_size_m(), c.origin().x(), c.origin().y()};
  }
  std::optional<sim::Colour> pixel(int column, int row) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    return world_->canvas.pixel(column, row);
  }
  std::vector<std::uint8_t> canvas_image() override {
    const std::lock_guard lock(world_->mutex);
    return world_->canvas.data();
  }

  playerlike::TimeStatistics time() const override {
    const std::lock_guard lock(world_->mutex);
    return world_->time;
  }
  void sleep(double seconds) override {
    const std::lock_guard lock(world_->mutex);
    require_open();
    world_->slept_ns += sim::from_seconds(seconds);
  }
  void prefer_real_time(const std::string& reason) override {
    const std::lock_guard lock(world_->mutex);
    world_->real_time_reasons.push_back(reason);
  }

  void close() noexcept override {
    const std::lock_guard lock(world_->mutex);
    world_->closed = true;
    world_->changed.notify_all();
  }

 private:
  void require_open() const {
    if (world_->closed) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kDisconnected,
                                     "the connection is closed");
    }
  }

  std::shared_ptr<FakeWorld> world_;
};

/// A new session of that world.
inline std::unique_ptr<playerlike::Session> fake_session(std::shared_ptr<FakeWorld> world) {
  return std::make_unique<FakeSession>(std::move(world));
}

/// Code of the PlayerError that an action throws; 0 if it throws none.
template <typename Action>
int error_code_of(Action action) {
  try {
    action();
  } catch (const PlayerCc::PlayerError& e) {
    return e.GetErrorCode();
  }
  return 0;
}

}  // namespace test
