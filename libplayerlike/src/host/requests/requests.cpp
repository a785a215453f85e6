// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The clients' requests, one function for each.
#include "playerlike/messages/requests.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core.h"
#include "host/requests/arena.h"
#include "host/requests/object_properties.h"
#include "session/checks.h"
#include "sim/devices/amcl.h"

namespace playerlike {
namespace {

CanvasInfo info_of(const sim::CanvasDescription& canvas) {
  return {canvas.width, canvas.height, canvas.cell_size_m, canvas.origin.x(), canvas.origin.y()};
}

WorldMap map_of(const sim::ArenaDescription& arena, const WorldMapRequest& what) {
  const sim::CanvasDescription grid = map_grid(arena, what.cell_size_m);
  if (!what.tile) return {sim::true_map(arena, grid), {}, {}, {}};
  const sim::CellRect& tile = *what.tile;
  const int right = std::clamp(tile.column + tile.width, 0, grid.width);
  const int bottom = std::clamp(tile.row + tile.height, 0, grid.height);
  const int left = std::clamp(tile.column, 0, right);
  const int top = std::clamp(tile.row, 0, bottom);
  sim::CanvasDescription part = grid;
  part.width = right - left;
  part.height = bottom - top;
  part.origin += what.cell_size_m * sim::Vec2(left, grid.height - bottom);
  sim::OccupancyMap map;
  if (part.width > 0 && part.height > 0) map = sim::true_map(arena, part);
  if (map.cells.empty()) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the map has no such tile: it has " + std::to_string(grid.width) + " x " +
                           std::to_string(grid.height) + " cells");
  }
  return {std::move(map), grid.width, grid.height,
          sim::Pose{grid.origin.x(), grid.origin.y(), 0.0}};
}

// Words of kWorldData.
constexpr std::string_view kMapData = "map";
constexpr std::string_view kObjectData = "objects";
constexpr std::string_view kArenaData = "arena";

}  // namespace

/// Answers requests of a client.
struct Host::Core::RequestHandler {
  Core& core;
  Client& client;

  // --- Readings and time

  void operator()(const SubscribeRequest& what) const {
    const DeviceInfo& info = require_device(core.robots_, what.device);
    const bool is_sensor = core.locked([&] {
      return core.simulation_.device(what.device.robot, what.device.device).sensor() != nullptr;
    });
    if (!is_sensor) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "device " + info.name + " is no sensor: it has no readings");
    }
    core.subscribe(client, what.device);
  }
  void operator()(const UnsubscribeRequest& what) const { core.unsubscribe(client, what.device); }
  void operator()(const ReplaceRequest& what) const {
    const Lock lock = core.lock_with_priority();
    client.require_open();
    core.clients_.set_replace(client, what.device, what.replace);
  }
  std::uint32_t operator()(const OverflowRequest&) const {
    const Lock lock = core.lock_with_priority();
    return client.overflow;
  }
  void operator()(const JoinRequest&) const { core.join(client, this_thread_id()); }
  void operator()(const SleepRequest& what) const { core.sleep(client, what.seconds); }
  TimeStatistics operator()(const TimeRequest&) const {
    return core.locked([this] { return core.time_locked(); });
  }
  void operator()(const PreferRealTimeRequest& what) const { core.prefer_real_time(what.reason); }
  void operator()(const NoteLooksRequest& what) const {
    core.count_data_reads(client, what.count, what.has_data);
  }
  Charge operator()(const TakeChargeRequest& what) const { return core.take_charge(client, what); }
  // An embedded simulation has no connection that could be slow or lost.
  void operator()(const AnswerTimeoutRequest&) const {}
  void operator()(const RetriesRequest&) const {}

  // --- The canvas

  void operator()(const FlushDrawingsRequest&) const {
    const Lock lock = core.lock_with_priority();
    client.require_open();
    client.touch();
    core.inputs_.apply_drawings(client);
    core.inputs_.reserve_drawings(client);
  }
  void operator()(const SetCellsRequest& what) const {
    require_cells(what.rect, what.cells.size());
    core.with_layers(client, [&](sim::LayerStack& layers, const LayerRegistry& registry) {
      registry.require(client.number, what.layer);
      layers.set_cells(what.layer, what.rect, what.cells);
    });
  }
  std::optional<sim::CellValue> operator()(const CellRequest& what) const {
    return core.with_layers(client, [&](sim::LayerStack& layers, const LayerRegistry& registry) {
      registry.require(client.number, what.layer);
      return layers.cell(what.layer, what.column, what.row);
    });
  }
  std::vector<sim::CellValue> operator()(const CellsRequest& what) const {
    return core.cells(client, what.layer);
  }
  sim::LayerId operator()(const CreateLayerRequest& what) const {
    return core.create_layer(client, what);
  }
  void operator()(const RemoveLayerRequest& what) const { core.remove_layer(client, what.layer); }
  void operator()(const SetLayerStyleRequest& what) const {
    core.with_layers(client, [&](sim::LayerStack& layers, LayerRegistry& registry) {
      registry.set_style(layers, client.number, what.layer, what.style);
    });
  }
  std::vector<sim::LayerInfo> operator()(const LayersRequest&) const {
    return core.with_layers(client,
                            [&](const sim::LayerStack& layers, const LayerRegistry& registry) {
                              return registry.list(layers, client.number);
                            });
  }
  CanvasImage operator()(const CanvasImageRequest&) const {
    sim::CanvasDescription canvas;
    std::vector<std::uint8_t> rgba = core.picture(client, std::nullopt, canvas);
    return {std::move(rgba), info_of(canvas)};
  }
  CanvasInfo operator()(const CanvasInfoRequest&) const {
    const Lock lock = core.lock_with_priority();
    return info_of(core.simulation_.layers().description());
  }
  CanvasInfo operator()(const ResizeCanvasRequest& what) const {
    core.resize_canvas(client, what.width, what.height);
    return (*this)(CanvasInfoRequest{});
  }

  // Files are written without the mutex, since this may take long.
  void operator()(const SaveImageRequest& what) const {
    const std::string file = picture_file(core.settings_.output_folder, what.name, what.scale);
    core.client_files_.require_room(client.number);
    sim::CanvasDescription canvas;
    const std::vector<std::uint8_t> rgba = core.picture(client, what.layer, canvas);
    write_picture(canvas, rgba, what.scale, file);
    core.client_files_.note(client.number, file);
  }
  void operator()(const SaveMapRequest& what) const {
    const std::string stem = map_stem(core.settings_.output_folder, what.name);
    core.client_files_.require_room(client.number);
    const sim::CanvasDescription canvas =
        core.with_layers(client, [&](sim::LayerStack& layers, const LayerRegistry& registry) {
          registry.require(client.number, what.layer);
          if (layers.kind(what.layer) != sim::LayerKind::kGrey) {
            throw SessionError(SessionError::Code::kBadArgument,
                               "only grey layers can be saved as maps, but \"" +
                                   layers.style(what.layer).name + "\" is of another kind");
          }
          return layers.description();
        });
    const sim::OccupancyMap map = occupancy_map(canvas, core.cells(client, what.layer));
    write_map_files(map, stem, what.mode);
    for (const char* ending : {".pgm", ".yaml"}) {
      core.client_files_.note(client.number, stem + ending);
    }
  }

  sim::ViewMode operator()(const ViewModeRequest&) const {
    const Lock lock = core.lock_with_priority();
    return core.simulation_.view_mode();
  }
  void operator()(const SetViewModeRequest& what) const {
    const Lock lock = core.lock_with_priority();
    client.require_open();
    if (const auto refusal = core.simulation_.set_view_mode(what.mode)) {
      throw SessionError(SessionError::Code::kNotAvailable, *refusal);
    }
  }
  WorldMap operator()(const WorldMapRequest& what) const {
    core.require_readable(client, -1);
    // A large map takes long, so it is made from a copy without the mutex.
    const sim::ArenaDescription arena = [&] {
      const Lock lock = core.lock_with_priority();
      core.require_permission(core.permissions_.forbids_world(kMapData));
      return core.simulation_.world().arena;
    }();
    return map_of(arena, what);
  }

  // --- Objects by name

  ObjectPose operator()(const ObjectPoseRequest& what) const {
    const Lock lock = lock_readable(kObjectData);
    return {require_object(core.simulation_, what.name).pose, core.simulation_.now_ns()};
  }
  void operator()(const PlaceObjectRequest& what) const {
    const Lock lock = lock_readable(kObjectData);
    static_cast<void>(require_object(core.simulation_, what.name));
    require_unlocked();
    place_object(core.simulation_, what.name, what.pose);
  }
  PropertyValue operator()(const ObjectPropertyRequest& what) const {
    const Lock lock = lock_readable(kObjectData);
    return object_property(core.simulation_, what.name, what.property);
  }
  void operator()(const SetObjectPropertyRequest& what) const {
    const Lock lock = lock_readable(kObjectData);
    static_cast<void>(object_property(core.simulation_, what.name, what.property));  // must exist
    require_unlocked();
    set_object_property(core.simulation_, what.name, what.property, what.value);
  }
  void operator()(const SetActiveRequest& what) const {
    const DeviceInfo& info = require_device(core.robots_, what.device);
    const Lock lock = core.lock_with_priority();
    client.require_open();
    if (core.stands_still()) {
      throw SessionError(SessionError::Code::kFinished, "the run is over");
    }
    core.simulation_.set_active(what.device, what.active);
    if (core.mirror_ && !what.active && moves_robot(info.type)) {
      core.mirror_->halt(what.device.robot);
    }
  }
  void operator()(const SetDynamicsRequest& what) const {
    const Lock lock = core.lock_with_priority();
    client.require_open();
    require_done(what.object ? core.simulation_.set_object_dynamics(*what.object, what.on)
                             : core.simulation_.set_dynamics(what.on));
  }
  void operator()(const ResetRequest&) const {
    const Lock lock = core.lock_with_priority();
    client.require_open();
    require_done(core.simulation_.reset());
  }
  // A state is that of one moment: the copy of the layers is complete when the rest is copied.
  void operator()(const SaveStateRequest& what) const {
    sim::LayerCopy copy;
    Lock lock = lock_changeable();
    core.saved_states_.require_place(what.name);
    core.copy_layers(lock, copy);
    sim::StateParts parts = core.simulation_.state_parts();
    lock.unlock();
    sim::LayerStack layers = copy.take();
    auto state = std::make_shared<const sim::Snapshot>(parts.snapshot(layers));
    const Lock again = core.lock_with_priority();  // released before `state` is freed
    core.saved_states_.save(what.name, state);
  }
  void operator()(const RestoreStateRequest& what) const {
    Lock lock = lock_changeable();
    if (const auto refusal = core.simulation_.refusal_of_mirrored()) {
      throw SessionError(SessionError::Code::kNotAvailable, *refusal);
    }
    const std::shared_ptr<const sim::Snapshot> snapshot = core.saved_states_.find(what.name);
    const sim::SnapshotReader reader = core.simulation_.snapshot_reader();
    const sim::CanvasDescription canvas = core.simulation_.layers().description();
    lock.unlock();
    sim::Simulation restored = reader.read(*snapshot);
    restored.layers().resize(canvas.width, canvas.height);
    lock = lock_changeable();
    core.require_not_writing();
    const sim::Simulation before =
        core.simulation_.replace_by(std::move(restored), sim::RestoreScope::kWorld);
    lock.unlock();  // before the state is freed
  }

  // --- The arena and its controller

  ArenaStatus operator()(const ArenaRequest&) const {
    const Lock lock = lock_readable(kArenaData);
    return arena_status(core.simulation_);
  }
  ArenaEventList operator()(const ArenaEventsRequest& what) const {
    const Lock lock = lock_readable(kArenaData);
    return arena_events(core.simulation_, what.since);
  }
  void operator()(const SetConfigurationRequest& what) const {
    const Lock lock = lock_readable(kArenaData);
    require_unlocked();
    set_configuration(core.simulation_, what.name);
  }
  void operator()(const SetBlockRequest& what) const {
    const Lock lock = lock_readable(kArenaData);
    require_unlocked();
    set_block(core.simulation_, what.name, what.extended);
  }
  void operator()(const SetTimerRequest& what) const {
    const Lock lock = lock_readable(kArenaData);
    require_unlocked();
    set_timer(core.simulation_, what.name, what.enabled);
  }
  void operator()(const SetTrapRequest& what) const {
    const Lock lock = lock_readable(kArenaData);
    require_unlocked();
    set_trap(core.simulation_, what.name, what.enabled);
  }

  // --- Goals and the log

  void operator()(const NoteGoalRequest& what) const {
    require_device(core.robots_, what.device);
    if (!what.goal_m.allFinite() || !std::isfinite(what.tolerance_m)) {
      throw SessionError(SessionError::Code::kBadArgument, "a goal's numbers must be finite");
    }
    const Lock lock = core.lock_with_priority();
    client.require_open();
    const int robot = what.device.robot;
    core.results_.note_goal(robot, core.simulation_.body(robot).X_WB * what.goal_m,
                            what.tolerance_m);
  }
  std::vector<LocalizationParticle> operator()(const ParticlesRequest& what) const {
    const DeviceInfo& info = require_device(core.robots_, what.device);
    core.require_readable(client, what.device.robot);
    std::vector<sim::Particle> particles;
    {
      const Lock lock = core.lock_with_priority();
      client.require_open();
      core.require_permission(core.permissions_.forbids_device(what.device));
      const auto* amcl = dynamic_cast<const sim::Amcl*>(
          &core.simulation_.device(what.device.robot, what.device.device));
      if (amcl == nullptr) {
        throw SessionError(SessionError::Code::kBadArgument,
                           "device " + info.name + " of type \"" + info.type +
                               "\" has no particles; amcl devices have them");
      }
      particles = amcl->localizer().particles();
    }
    std::vector<LocalizationParticle> answer;
    answer.reserve(particles.size());
    for (const sim::Particle& particle : particles) {
      answer.push_back({particle.pose, particle.weight});
    }
    return answer;
  }
  void operator()(const SetBlackboardRequest& what) const {
    const Lock lock = lock_readable();
    client.touch();
    const ThreadId thread = core.blackboard_thread(client);
    if (thread == 0) core.publish_blackboard();
    core.blackboard_.set(what, core.simulation_.now_ns(), thread);
  }
  std::vector<BlackboardEntry> operator()(const BlackboardRequest& what) const {
    const Lock lock = lock_readable();
    return core.blackboard_.find(what, core.blackboard_thread(client));
  }
  LogStatus operator()(const LogRequest& what) const {
    // A file to replay is read without the mutex: this may take seconds.
    std::optional<RunLog::Loaded> loaded;
    for (;;) {
      std::optional<std::string> file;
      {
        const Lock lock = core.lock_with_priority();
        client.require_open();
        if (what.running.value_or(false)) require_permission_to_log();
        RunLog& log = core.results_.logs
                          .try_emplace(client.port, core.settings_.output_folder, client.port,
                                       core.robots_, core.client_files_)
                          .first->second;
        file = log.file_to_read(what);
        if (!file || (loaded && loaded->path == *file)) {
          return log.control(what, core.simulation_, loaded ? &*loaded : nullptr);
        }
      }
      loaded = RunLog::read_file(*file, client.port, core.robots_);
    }
  }

 private:
  /// Throws if the run's task forbids a sensor whose readings the port's log would contain.
  void require_permission_to_log() const {
    for (const RobotInfo& robot : core.robots_) {
      if (client.port != kMorsePort && robot.port != client.port) continue;
      for (const DeviceInfo& device : robot.devices) {
        core.require_permission(core.permissions_.forbids_device(device.id));
      }
    }
  }
  /// Locks the host's mutex, and throws if the world is private.
  [[nodiscard]] Lock lock_readable() const {
    Lock lock = core.lock_with_priority();
    client.require_open();
    core.require_readable(client, -1);
    return lock;
  }
  /// As lock_readable(), for data that the run's task may forbid.
  /// @param data  one of kWorldData.
  [[nodiscard]] Lock lock_readable(std::string_view data) const {
    Lock lock = lock_readable();
    core.require_permission(core.permissions_.forbids_world(data));
    return lock;
  }
  /// As lock_readable(), for changes of the world: also applies the client's pending drawings.
  [[nodiscard]] Lock lock_changeable() const {
    Lock lock = lock_readable(kObjectData);
    require_unlocked();
    client.touch();
    core.inputs_.apply_drawings(client);
    return lock;
  }
  void require_unlocked() const {
    if (!core.simulation_.world().simulation.objects_locked) return;
    throw SessionError(SessionError::Code::kNotAvailable,
                       "this world locks its robots and obstacles "
                       "(\"lock_objects\" in its \"simulation\"): clients can only read them");
  }
};

Answer Host::Core::answer(Client& client, const Request& request) {
  return answer_by(RequestHandler{*this, client}, request);
}

}  // namespace playerlike
