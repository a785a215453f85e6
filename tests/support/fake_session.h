// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "libplayerc++/playererror.h"
#include "player_errors.h"
#include "playerlike/session/layer_registry.h"
#include "playerlike/session/session.h"
#include "sim/canvas/layers.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace test {

/// The backend of a FakeSession: a world without physics. A test defines its readings beforehand,
/// and it records the commands it receives. It outlives the session, so that a test can check what
/// a client left behind.
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
  bool watches = true;  ///< as the server of a real robot; see playerlike::Charge
  bool stopped = false;
  std::string in_charge;    ///< who has taken charge last
  int charges = 0;          ///< times that somebody has taken charge
  bool closed = false;      ///< the server is gone
  bool has_closed = false;  ///< a session has been closed
  std::size_t drawn = 0;    ///< drawings executed
  int cell_calls = 0;       ///< of draw_cells()
  int flushes = 0;
  sim::LayerStack layers{sim::CanvasDescription{}};
  playerlike::LayerRegistry registry;
  int clients = 0;  ///< number of sessions so far
  std::atomic<std::uint64_t> resizes{0};
  sim::ViewMode view_mode = sim::ViewMode::kGround;
  bool view_mode_locked = false;
  std::vector<playerlike::SaveImageRequest> saved;
  std::vector<playerlike::SaveMapRequest> saved_maps;
  int joins = 0;
  int looks = 0;  ///< accesses to readings that were noted
  sim::SimTime slept_ns = 0;
  playerlike::TimeStatistics time;

  void add_round(Round round) {
    const std::lock_guard lock(mutex);
    rounds.push_back(std::move(round));
    changed.notify_all();
  }
};

// Device numbers of the fake robot.
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
        {"height", 0.125},
        {"size_x", 0.05},
        {"size_y", 0.06},
        {"size_height", 0.07}}},
      {kMotion, "motion", "motion", {{"max_speed", 0.4}, {"max_turn_rate", 2.0}}},
      {kOdometry, "odometry", "odometry", {{"frequency", 10.0}, {"noise", 0.0}}},
      {kPen, "pen", "pen", {{"trail", 0.0}}},
      {kPose, "pose", "pose", {{"frequency", 10.0}, {"noise", 0.0}}},
  };
  world->robots.push_back(robot);
  return world;
}

/// A reading of a localisation device at the given time.
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

/// A scan of the fake laser: beam i points to -1 + 0.5 i [rad].
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

/// A session that returns a FakeWorld's readings, one round per wait().
class FakeSession final : public playerlike::Session {
 public:
  explicit FakeSession(std::shared_ptr<FakeWorld> world)
      : world_(std::move(world)), number_(world_->clients++) {}
  ~FakeSession() override { FakeSession::close(); }

  const std::vector<playerlike::RobotInfo>& robots() const noexcept override {
    return world_->robots;
  }
  int port() const noexcept override { return world_->port; }
  bool connected() const noexcept override {
    const std::lock_guard lock(world_->mutex);
    return !is_closed();
  }

  void wait() override {
    std::unique_lock lock(world_->mutex);
    world_->changed.wait(
        lock, [this] { return is_closed() || !world_->rounds.empty() || world_->over_when_empty; });
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
      sink.on_reading(device, reading);
      ++count;
    }
    return count;
  }
  bool peek(std::chrono::milliseconds timeout) override {
    std::unique_lock lock(world_->mutex);
    const auto ready = [this] {
      return is_closed() || !world_->rounds.empty() || world_->over_when_empty;
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

  playerlike::Answer answer(const playerlike::Request& request) override {
    return playerlike::answer_by(*this, request);
  }
  std::unique_ptr<playerlike::Session> open_follower() override {
    return std::make_unique<FakeSession>(world_);
  }
  const void* simulation() const noexcept override { return world_.get(); }
  playerlike::DrawQueue& draw_queue() noexcept override { return queue_; }
  std::uint64_t canvas_generation() const noexcept override { return world_->resizes; }

  void close() noexcept override {
    const std::lock_guard lock(world_->mutex);
    closed_ = true;
    world_->has_closed = true;
    execute_drawings();
    queue_.close();
    world_->registry.leave(number_);
    world_->changed.notify_all();
  }

  // --- Requests

  void operator()(const playerlike::SubscribeRequest& what) {
    const auto lock = lock_open();
    ++world_->subscriptions[what.device.device];
  }
  void operator()(const playerlike::UnsubscribeRequest& what) {
    const auto lock = lock_open();
    --world_->subscriptions[what.device.device];
  }
  void operator()(const playerlike::ReplaceRequest& what) {
    const auto lock = lock_open();
    world_->replace[what.device ? what.device->device : -1] = what.replace;
  }
  std::uint32_t operator()(const playerlike::OverflowRequest&) const { return 3; }
  void operator()(const playerlike::JoinRequest&) {
    const auto lock = lock_open();
    ++world_->joins;
  }
  void operator()(const playerlike::SleepRequest& what) {
    const auto lock = lock_open();
    world_->slept_ns += sim::from_seconds(what.seconds);
  }
  playerlike::TimeStatistics operator()(const playerlike::TimeRequest&) const {
    const std::lock_guard lock(world_->mutex);
    return world_->time;
  }
  void operator()(const playerlike::PreferRealTimeRequest& what) {
    const std::lock_guard lock(world_->mutex);
    world_->real_time_reasons.push_back(what.reason);
  }
  void operator()(const playerlike::NoteLooksRequest& what) {
    const std::lock_guard lock(world_->mutex);
    world_->looks += what.count;
  }
  void operator()(const playerlike::AnswerTimeoutRequest&) {}
  void operator()(const playerlike::RetriesRequest&) {}
  void operator()(const playerlike::FlushDrawingsRequest&) {
    with_layers([this](sim::LayerStack&, playerlike::LayerRegistry&) {
      ++world_->flushes;
      queue_.reserve();
    });
  }
  void operator()(const playerlike::SetCellsRequest& what) {
    playerlike::require_cells(what.rect, what.cells.size());
    with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.require(number_, what.layer);
      ++world_->cell_calls;
      layers.set_cells(what.layer, what.rect, what.cells);
    });
  }
  std::optional<sim::CellValue> operator()(const playerlike::CellRequest& what) {
    return with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.require(number_, what.layer);
      return layers.cell(what.layer, what.column, what.row);
    });
  }
  std::vector<sim::CellValue> operator()(const playerlike::CellsRequest& what) {
    return with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.require(number_, what.layer);
      return layers.cells(what.layer);
    });
  }
  sim::LayerId operator()(const playerlike::CreateLayerRequest& what) {
    return with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      return registry.create(layers, number_, world_->port, what.kind, what.style);
    });
  }
  void operator()(const playerlike::RemoveLayerRequest& what) {
    with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.remove(layers, number_, what.layer);
    });
  }
  void operator()(const playerlike::SetLayerStyleRequest& what) {
    with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.set_style(layers, number_, what.layer, what.style);
    });
  }
  std::vector<sim::LayerInfo> operator()(const playerlike::LayersRequest&) {
    return with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      return registry.list(layers, number_);
    });
  }
  playerlike::CanvasImage operator()(const playerlike::CanvasImageRequest&) {
    return with_layers([](sim::LayerStack& layers, playerlike::LayerRegistry&) {
      return playerlike::CanvasImage{layers.composed(), {}};
    });
  }
  playerlike::CanvasInfo operator()(const playerlike::ResizeCanvasRequest& what) {
    with_layers([&](sim::LayerStack& layers, playerlike::LayerRegistry& registry) {
      registry.require_size(layers, what.width, what.height);
      layers.resize(what.width, what.height);
      ++world_->resizes;
    });
    return (*this)(playerlike::CanvasInfoRequest{});
  }
  playerlike::CanvasInfo operator()(const playerlike::CanvasInfoRequest&) const {
    const std::lock_guard lock(world_->mutex);
    const sim::CanvasDescription c = world_->layers.description();
    return {c.width, c.height, c.cell_size_m, c.origin.x(), c.origin.y()};
  }
  void operator()(const playerlike::SaveImageRequest& what) {
    const auto lock = lock_open();
    world_->saved.push_back(what);
  }
  void operator()(const playerlike::SaveMapRequest& what) {
    const auto lock = lock_open();
    world_->saved_maps.push_back(what);
  }
  sim::ViewMode operator()(const playerlike::ViewModeRequest&) const {
    const std::lock_guard lock(world_->mutex);
    return world_->view_mode;
  }
  void operator()(const playerlike::SetViewModeRequest& what) {
    const auto lock = lock_open();
    if (world_->view_mode_locked && what.mode != world_->view_mode) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kNotAvailable,
                                     "the view mode is locked");
    }
    world_->view_mode = what.mode;
  }
  /// The map of an empty room of one square metre.
  playerlike::WorldMap operator()(const playerlike::WorldMapRequest& what) const {
    if (!(what.cell_size_m > 1e-3)) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kBadArgument,
                                     "the cell size is no positive number");
    }
    sim::OccupancyMap map;
    map.width = map.height = static_cast<int>(std::ceil(1.0 / what.cell_size_m - 1e-6));
    map.cell_size_m = what.cell_size_m;
    map.cells.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
                     0.0F);
    return {std::move(map)};
  }
  playerlike::Charge operator()(const playerlike::TakeChargeRequest& what) {
    const auto lock = lock_open();
    if (!world_->in_charge.empty() && world_->in_charge != what.name && !what.take_over) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kNotAvailable,
                                     world_->in_charge + " is in charge");
    }
    world_->in_charge = what.name;
    ++world_->charges;
    return {world_->watches, std::exchange(world_->stopped, false)};
  }
  template <typename Other>
  typename Other::Result operator()(const Other&) const {
    throw playerlike::SessionError(playerlike::SessionError::Code::kNotAvailable,
                                   "this kind of session has no such thing");
  }

 private:
  [[nodiscard]] std::unique_lock<std::mutex> lock_open() const {
    std::unique_lock lock(world_->mutex);
    require_open();
    return lock;
  }
  // The caller holds the world's mutex.
  [[nodiscard]] bool is_closed() const { return closed_ || world_->closed; }
  void require_open() const {
    if (is_closed()) {
      throw playerlike::SessionError(playerlike::SessionError::Code::kDisconnected,
                                     "the connection is closed");
    }
  }

  // The caller holds the world's mutex.
  void execute_drawings() {
    queue_.drain([this](std::span<const sim::DrawOperation> operations) {
      world_->drawn += operations.size();
      world_->layers.draw(operations);
    });
  }
  template <typename Action>
  std::invoke_result_t<Action, sim::LayerStack&, playerlike::LayerRegistry&> with_layers(
      Action action) {
    const std::lock_guard lock(world_->mutex);
    require_open();
    execute_drawings();
    return action(world_->layers, world_->registry);
  }

  std::shared_ptr<FakeWorld> world_;
  int number_;
  bool closed_ = false;
  playerlike::DrawQueue queue_;
};

/// A new session of that world.
inline std::unique_ptr<playerlike::Session> fake_session(std::shared_ptr<FakeWorld> world) {
  return std::make_unique<FakeSession>(std::move(world));
}

}  // namespace test
