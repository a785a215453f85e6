// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "playerlike/messages/arena_requests.h"
#include "playerlike/messages/messages.h"
#include "sim/canvas/layers.h"
#include "sim/io/map_file.h"
#include "sim/world/occupancy_map.h"
#include "sim/world/view_mode.h"

/// Requests from a client to a simulation, besides readings and commands: one struct per request.
///
/// A request of Playpen's protocol also has
/// - `kName`: its name in the protocol. A request without it never leaves the process;
/// - a table of its fields and one of its answer's, in src/protocol/request_fields.cpp;
/// - `kTellsTruth`: a private world (sim::SimulationDescription::own_sensors_only) answers it only
///   for clients that may command all robots.
///
/// All requests are executed immediately. On a closed session they throw SessionError
/// kDisconnected, except those that only read time, canvas size, view mode or overflow.
namespace playerlike {

/// @name Readings and time
/// @{

/// Subscribes to a device's readings. Subscriptions are counted: each needs its own
/// UnsubscribeRequest.
/// @throws SessionError kNoSuchDevice; kBadArgument for a device without readings; kNotAvailable
///         for a device of another robot in a private world.
struct SubscribeRequest {
  using Result = void;
  static constexpr const char* kName = "subscribe";
  DeviceId device{-1, -1};
};

/// Ends a subscription. The last one discards the device's waiting readings.
struct UnsubscribeRequest {
  using Result = void;
  static constexpr const char* kName = "unsubscribe";
  DeviceId device{-1, -1};
};

/// Sets whether a new reading replaces an older one that was not taken (default), or is queued
/// behind it. A queue has at most 1000 readings; when it is full, the oldest one is dropped and
/// counted as overflow.
struct ReplaceRequest {
  using Result = void;
  static constexpr const char* kName = "replace";
  std::optional<DeviceId> device =
      std::nullopt;  ///< none: all devices, including later subscriptions
  bool replace = true;
};

/// Returns the number of dropped readings.
struct OverflowRequest {
  using Result = std::uint32_t;
};

/// Joins the lockstep without waiting. The calling thread becomes the session's owner, as after
/// Session::wait(), and simulated time stands still until this thread waits. A thread can thus join
/// before the thread that started it continues. The request also readmits a client that was silent
/// for too long.
struct JoinRequest {
  using Result = void;
};

/// Advances simulated time (lockstep), or waits (paced).
/// @throws SessionError kBadArgument if seconds is outside 0..1e9.
struct SleepRequest {
  using Result = void;
  double seconds = 0.0;
};

/// Returns the progress of the simulation.
struct TimeRequest {
  using Result = TimeStatistics;
  static constexpr const char* kName = "time";
};

/// For clients that read in the background: if no time mode was chosen, switches a lockstep
/// simulation to real time, once, with a warning. See docs/architecture.md.
struct PreferRealTimeRequest {
  using Result = void;
  static constexpr const char* kName = "prefer_real_time";
  std::string reason;
};

/// Notes that the program has accessed readings. If simulated time advances only while the program
/// waits, the session warns a program that keeps reading or commanding without ever waiting.
struct NoteLooksRequest {
  using Result = void;
  int count = 0;          ///< number of accesses since the last such request
  bool has_data = false;  ///< whether the last accessed device has had a reading
};

/// Sets the timeout of an answer, after which the connection counts as lost. It has no effect
/// inside a process, where requests are not messages. It does not limit waiting for simulated time.
struct AnswerTimeoutRequest {
  using Result = void;
  double seconds = 10.0;  ///< > 0
};

/// Configures reconnecting: the call that detects a lost connection tries to reconnect. The new
/// connection has the same subscriptions, but no layers. It has no effect inside a process, which
/// has no connection.
struct RetriesRequest {
  using Result = void;
  int limit = 0;        ///< maximum number of attempts; < 0: no limit
  double time_s = 0.0;  ///< time between attempts, >= 0
};
/// @}

/// @name The canvas and its layers
///
/// These requests first execute the session's queued drawings; see Session. A layer belongs to the
/// session that created it, and only this session may access it. It remains after the end of the
/// session, until a session on the same port creates a layer of the same name. A request for a
/// layer that is neither the base layer nor the session's own throws SessionError kBadArgument.
/// @{

/// Executes the queued drawings, and allocates the draw queue's buffers if necessary.
struct FlushDrawingsRequest {
  using Result = void;
};

/// Sets the cells of a rectangle, row-major from the top, without blending. The rectangle is
/// clipped to the canvas.
/// @throws SessionError kBadArgument if the number of values differs from the number of the
///         rectangle's cells.
struct SetCellsRequest {
  using Result = void;
  static constexpr const char* kName = "set_cells";
  sim::LayerId layer = sim::kBaseLayer;
  sim::CellRect rect;
  std::vector<sim::CellValue> cells;
};

/// Returns the value of a cell; nullopt outside the canvas.
struct CellRequest {
  using Result = std::optional<sim::CellValue>;
  static constexpr const char* kName = "cell";
  sim::LayerId layer = sim::kBaseLayer;
  int column = 0;
  int row = 0;
};

/// Returns all cells of a layer, row-major from the top.
struct CellsRequest {
  using Result = std::vector<sim::CellValue>;
  static constexpr const char* kName = "cells";
  sim::LayerId layer = sim::kBaseLayer;
};

/// Creates a layer. Removes a layer of the same name that an ended session on this port has left.
/// @throws SessionError kBadArgument for a name that is not 1 to kMaxLayerName printable bytes
///         (UTF-8 is allowed), that is "canvas", or that another layer of this session has;
///         kNotAvailable if the session has kMaxLayers layers, or all layers together would have
///         more than kMaxLayerCells cells.
struct CreateLayerRequest {
  using Result = sim::LayerId;
  static constexpr const char* kName = "create_layer";
  sim::LayerKind kind = sim::LayerKind::kColour;
  sim::LayerStyle style;
};

/// Removes one of this session's layers.
/// @throws SessionError kNotAvailable for the base layer.
struct RemoveLayerRequest {
  using Result = void;
  static constexpr const char* kName = "remove_layer";
  sim::LayerId layer = sim::kBaseLayer;
};

/// Changes the style of a layer. Any session may change the base layer's style, except its name.
/// @throws SessionError kBadArgument for an invalid name, as in CreateLayerRequest; kNotAvailable
///         for a new name of the base layer.
struct SetLayerStyleRequest {
  using Result = void;
  static constexpr const char* kName = "set_layer_style";
  sim::LayerId layer = sim::kBaseLayer;
  sim::LayerStyle style;
};

/// Returns the base layer and this session's layers, lowest first.
struct LayersRequest {
  using Result = std::vector<sim::LayerInfo>;
  static constexpr const char* kName = "layers";
};

/// An image of the canvas.
struct CanvasImage {
  std::vector<std::uint8_t> rgba;  ///< row-major from the top
  CanvasInfo canvas;
};
/// Returns the composition of all visible layers of all clients.
struct CanvasImageRequest {
  using Result = CanvasImage;
  static constexpr const char* kName = "canvas_image";
};

/// Returns the current size and position of the canvas.
struct CanvasInfoRequest {
  using Result = CanvasInfo;
};

/// Changes the numbers of columns and rows of the canvas, with all layers of all clients. Drawings
/// keep their positions in the world.
/// @throws SessionError kBadArgument for a width or height outside 1..8192; kNotAvailable if all
///         layers together would have more than kMaxLayerCells cells.
struct ResizeCanvasRequest {
  using Result = CanvasInfo;
  static constexpr const char* kName = "resize_canvas";
  int width = 0;
  int height = 0;
};

/// Writes the canvas image as a PNG file to the run's output folder.
/// @throws SessionError kBadArgument for a name that is not a plain file name or a scale outside
///         1..64; kNotAvailable if the run has no output folder, or the file cannot be written.
struct SaveImageRequest {
  using Result = void;
  static constexpr const char* kName = "save_image";
  std::string name;  ///< a plain file name; ".png" is appended if it is missing
  int scale = 1;     ///< scale x scale pixels per cell
  std::optional<sim::LayerId> layer =
      std::nullopt;  ///< writes only this layer, even if it is hidden
};

/// Writes a grey layer as a map for ROS's map_server, NAME.yaml and NAME.pgm, to the run's output
/// folder; see sim::io::write_map().
/// @throws SessionError for the same errors as SaveImageRequest; also kBadArgument for a layer of
///         another kind.
struct SaveMapRequest {
  using Result = void;
  static constexpr const char* kName = "save_map";
  sim::LayerId layer = sim::kBaseLayer;
  std::string name;  ///< a plain file name, with or without ".yaml"
  sim::io::MapMode mode = sim::io::MapMode::kTrinary;
};

/// Returns how pictures currently show the canvas.
struct ViewModeRequest {
  using Result = sim::ViewMode;
  static constexpr const char* kName = "view_mode";
};

/// @throws SessionError kNotAvailable if the world file has locked another mode.
struct SetViewModeRequest {
  using Result = void;
  static constexpr const char* kName = "set_view_mode";
  sim::ViewMode mode = sim::ViewMode::kGround;
};
/// @}

/// A map of an arena's floor, or a tile of that map.
struct WorldMap {
  sim::OccupancyMap map;
  // For a tile: size and origin of the whole map.
  std::optional<int> width = std::nullopt;         ///< number of columns
  std::optional<int> height = std::nullopt;        ///< number of rows
  std::optional<sim::Pose> origin = std::nullopt;  ///< X_WM of the bottom left corner
};
/// Returns the true map of the arena's floor with the current obstacles; see sim::true_map().
/// Clients of a server fetch it in tiles.
/// @throws SessionError kBadArgument if the cell size is not a positive number, if the map would
///         have more than 8192 cells along a side, or if the tile lies outside the map.
struct WorldMapRequest {
  using Result = WorldMap;
  static constexpr const char* kName = "world_map";
  static constexpr bool kTellsTruth = true;
  double cell_size_m = 0.0;
  std::optional<sim::CellRect> tile = std::nullopt;  ///< clipped to the map
};

/// @name Robots and obstacles by name, and the log
///
/// Names are those of the world's robots, obstacles and dock separators, and "border" and "wall".
///
/// Permissions: if a server requires tokens, only clients that may command a robot may move or
/// change it, and only clients that may command all robots may move or change obstacles.
///
/// Errors: SessionError kBadArgument for an unknown name or property (the text lists the known
/// ones) and for an impossible request, e.g. an occupied place; kNotAvailable if the world has
/// locked its objects, see sim::SimulationDescription::objects_locked.
/// @{

/// Pose of a robot or an obstacle.
struct ObjectPose {
  sim::Pose pose;            ///< X_WB of a robot; for other objects, pose of the centre in W
  sim::SimTime time_ns = 0;  ///< current simulated time
};
/// Returns the pose of a robot or an obstacle.
/// @throws SessionError kBadArgument for an unknown name.
struct ObjectPoseRequest {
  using Result = ObjectPose;
  static constexpr const char* kName = "object_pose";
  static constexpr bool kTellsTruth = true;
  std::string name;
};

/// Moves a robot or a block to a pose; see sim::Simulation::place_object().
struct PlaceObjectRequest {
  using Result = void;
  static constexpr const char* kName = "place_object";
  static constexpr bool kTellsTruth = true;
  std::string name;
  sim::Pose pose;
};

/// Returns a property; docs/simulation.md lists them.
struct ObjectPropertyRequest {
  using Result = PropertyValue;
  static constexpr const char* kName = "object_property";
  static constexpr bool kTellsTruth = true;
  std::string name;
  std::string property;
};

/// Changes a property; docs/simulation.md lists them.
/// @throws SessionError kBadArgument for an unknown name or property or an invalid value;
///         kNotAvailable if objects are locked.
struct SetObjectPropertyRequest {
  using Result = void;
  static constexpr const char* kName = "set_object_property";
  static constexpr bool kTellsTruth = true;
  std::string name;
  std::string property;
  PropertyValue value;
};

/// Switches a device on or off; see sim::Simulation::set_active(). A real robot whose motors are
/// switched off stops.
/// @throws SessionError kNoSuchDevice; kFinished if the run is over.
struct SetActiveRequest {
  using Result = void;
  DeviceId device{-1, -1};
  bool active = true;
};

/// Suspends or resumes the dynamics of a robot or an obstacle, or of all; see
/// sim::Simulation::set_dynamics().
/// @throws SessionError kBadArgument for an object that cannot move by itself, and for robots that
///         mirror real ones.
struct SetDynamicsRequest {
  using Result = void;
  std::optional<std::string> object = std::nullopt;  ///< none: all
  bool on = true;
};

/// Puts the world back to its start; see sim::Simulation::reset().
/// @throws SessionError kBadArgument if a robot mirrors a real one.
struct ResetRequest {
  using Result = void;
};

/// Saves the state of the whole simulation under a name: robots, obstacles, devices with their
/// noise and commands, and the canvas. It replaces an earlier state of this name. All clients share
/// the saved states, which exist until the end of the simulation. This client's queued commands for
/// the next step are not saved.
/// @throws SessionError kBadArgument for a name that is not 1 to 64 printable bytes; kNotAvailable
///         if objects are locked, if 64 states exist, or if all states together would exceed 256
///         MiB.
struct SaveStateRequest {
  using Result = void;
  static constexpr const char* kName = "save_state";
  static constexpr bool kTellsTruth = true;
  std::string name;
};

/// Restores a saved state of the world immediately, for all clients. Time is not restored: clock,
/// duration, report, film and log continue; see sim::RestoreScope::kWorld. Waiting readings are
/// still delivered, and queued commands are executed in the next step.
/// @throws SessionError kBadArgument if no state has this name; kNotAvailable if objects are
///         locked.
struct RestoreStateRequest {
  using Result = void;
  static constexpr const char* kName = "restore_state";
  static constexpr bool kTellsTruth = true;
  std::string name;
};

/// Announces the goal of a robot whose commands do not contain it, for example of a program that
/// avoids obstacles. The report and pictures show the goal. The request has no other effect.
/// @throws SessionError kNoSuchDevice; kBadArgument for numbers that are not finite.
struct NoteGoalRequest {
  using Result = void;
  static constexpr const char* kName = "note_goal";
  DeviceId device{-1, -1};               ///< any device of the robot
  sim::Vec2 goal_m = sim::Vec2::Zero();  ///< in the robot's current frame B [m]
  double tolerance_m = 0.0;              ///< distance within which the goal is reached [m]
};

/// How a server keeps watch over a robot; see TakeChargeRequest.
struct Charge {
  bool watched = false;  ///< the server stops the robot if the session falls silent
  bool stopped = false;  ///< it has done so since the session's last such request
};
/// Takes charge of a robot, for a session whose robot must not drive without it: that of a mirror
/// (docs/mirror.md). From then on the robot stops when the session that is in charge and has
/// commanded it last ends, or sends no such request for `watchdog_s` of wall-clock time. Sessions
/// that are not in charge may command the robot, too. A session keeps its charge until it ends; it
/// repeats the request to show that it is there.
/// @throws SessionError kNoSuchDevice; kBadArgument for a number outside of kLeastWatchdog_s to
///         kMostWatchdog_s, or a name that is not at most 200 printable bytes; kNotAvailable if
///         another session is in charge, or has taken over.
struct TakeChargeRequest {
  using Result = Charge;
  static constexpr const char* kName = "take_charge";
  static constexpr double kLeastWatchdog_s = 0.05;
  static constexpr double kMostWatchdog_s = 600.0;
  DeviceId device{-1, -1};  ///< any device of the robot
  double watchdog_s = 0.4;
  bool take_over = false;  ///< from another session, whose commands are refused from then on
  std::string name = {};   ///< of the client, for messages to others
};

/// A possible pose of a robot, from its localisation.
struct LocalizationParticle {
  sim::Pose pose;       ///< X_WB
  double weight = 0.0;  ///< the weights of all particles add up to 1
};
/// Returns the present particles of a localisation (amcl).
/// @throws SessionError kNoSuchDevice; kBadArgument for a device without particles; kNotAvailable
///         for a device of another robot in a private world.
struct ParticlesRequest {
  using Result = std::vector<LocalizationParticle>;
  static constexpr const char* kName = "particles";
  DeviceId device{-1, -1};
};

/// An entry of the blackboard, which all clients of a host share (docs/blackboard.md).
struct BlackboardEntry {
  std::string group;               ///< at most 255 printable bytes; "" is a group, too
  std::string key;                 ///< 1 to 255 printable bytes, unique in its group
  int type = 0;                    ///< in [0, 65535]; has a meaning for programs only
  int subtype = 0;                 ///< in [0, 65535]; has a meaning for programs only
  std::vector<std::uint8_t> data;  ///< at most 65536 bytes
  sim::SimTime time_ns = 0;        ///< simulated time of the last change
  /// Number of the entry's last change. The changes of all entries are numbered together, from 1.
  std::int64_t change = 0;
};

/// Sets an entry of the blackboard, with the present time.
///
/// Usually the change takes effect immediately. If several threads or programs take part in the
/// lockstep and time is not virtual, it takes effect for the other threads with the next step.
/// @throws SessionError kBadArgument for a group, key or data that exceed the limits of
///         BlackboardEntry; kNotAvailable if the blackboard is full, or in a private world.
struct SetBlackboardRequest {
  using Result = void;
  static constexpr const char* kName = "set_blackboard";
  static constexpr bool kTellsTruth = true;
  std::string group;
  std::string key;
  int type = 0;
  int subtype = 0;
  std::vector<std::uint8_t> data;
};

/// Returns entries of the blackboard, in the order of their changes.
///
/// A request with group and key, but without `after`, returns at most one entry. It includes a
/// change of the asking thread that the others do not see yet. Such an entry has the number of the
/// newest change that all see.
/// @throws SessionError kNotAvailable in a private world.
struct BlackboardRequest {
  using Result = std::vector<BlackboardEntry>;
  static constexpr const char* kName = "blackboard";
  static constexpr bool kTellsTruth = true;
  std::int64_t after = 0;  ///< only entries whose last change has a greater number
  std::optional<std::string> group = std::nullopt;  ///< only entries of this group
  std::optional<std::string> key = std::nullopt;    ///< only entries with this key
};

/// Configures the log of this session's port and returns its state. Changes are applied in the
/// order of the members; a request without members set changes nothing. The log contains the
/// readings of the port's robots; see docs/log.md. All sessions of a port share it.
/// @throws SessionError kBadArgument for a name that is not a plain file name, for a file that is
///         not a log, or for changes of file or direction while the log runs; kNotAvailable if the
///         run has no output folder, or the file cannot be opened.
struct LogRequest {
  using Result = LogStatus;
  static constexpr const char* kName = "log";
  std::optional<std::string> file =
      std::nullopt;  ///< a plain file name; ".jsonl" is appended if it is missing
  std::optional<bool> replay = std::nullopt;
  std::optional<bool> rewind = std::nullopt;  ///< true: restarts a replay from the beginning
  std::optional<bool> running = std::nullopt;
};
/// @}

/// Any request.
using Request = std::variant<
    SubscribeRequest, UnsubscribeRequest, ReplaceRequest, OverflowRequest, JoinRequest,
    SleepRequest, TimeRequest, PreferRealTimeRequest, NoteLooksRequest, AnswerTimeoutRequest,
    RetriesRequest, FlushDrawingsRequest, SetCellsRequest, CellRequest, CellsRequest,
    CreateLayerRequest, RemoveLayerRequest, SetLayerStyleRequest, LayersRequest, CanvasImageRequest,
    CanvasInfoRequest, ResizeCanvasRequest, SaveImageRequest, SaveMapRequest, ViewModeRequest,
    SetViewModeRequest, WorldMapRequest, ObjectPoseRequest, PlaceObjectRequest,
    ObjectPropertyRequest, SetObjectPropertyRequest, SaveStateRequest, RestoreStateRequest,
    NoteGoalRequest, ParticlesRequest, LogRequest, SetBlackboardRequest, BlackboardRequest,
    ArenaRequest, ArenaEventsRequest, SetConfigurationRequest, SetBlockRequest, SetTimerRequest,
    SetTrapRequest, TakeChargeRequest, SetActiveRequest, SetDynamicsRequest, ResetRequest>;

/// The result of any request; std::monostate for requests without a result.
using Answer =
    std::variant<std::monostate, std::uint32_t, sim::LayerId, std::optional<sim::CellValue>,
                 std::vector<sim::CellValue>, std::vector<sim::LayerInfo>, CanvasImage, CanvasInfo,
                 sim::ViewMode, WorldMap, ObjectPose, PropertyValue, LogStatus, TimeStatistics,
                 std::vector<LocalizationParticle>, std::vector<BlackboardEntry>, ArenaStatus,
                 ArenaEventList, Charge>;

/// Calls the function of `visitor` for the type of a request. The function returns the `Result` of
/// the request's type.
template <typename Visitor>
Answer answer_by(Visitor&& visitor, const Request& request) {
  return std::visit(
      [&]<typename One>(const One& what) -> Answer {
        if constexpr (std::is_void_v<typename One::Result>) {
          visitor(what);
          return {};
        } else {
          return Answer(std::in_place_type<typename One::Result>, visitor(what));
        }
      },
      request);
}

}  // namespace playerlike
