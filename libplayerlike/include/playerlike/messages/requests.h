// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/canvas/layers.h"
#include "sim/io/map_file.h"
#include "sim/world/occupancy_map.h"
#include "sim/world/view_mode.h"

/// What a client may ask of a simulation besides readings: a struct for each request.
///
/// A request that Playpen's protocol has, also has
/// - `kName`: its name there; one without never leaves the process;
/// - `kFields`: its members as messages have them, in the order in which a wrong key is told which
///   keys there are;
/// - `kAnswer`: the key of its result in the answer, unless the result has `kFields` itself;
/// - `kTellsTruth`: a private world (sim::SimulationDescription::own_sensors_only) answers it only
///   for those who may command all robots.
///
/// All of them happen at once. They throw SessionError kDisconnected on a closed session, but for
/// those that only look at time, canvas size, view mode and overflow.
namespace playerlike {

/// Whether a message has a field.
enum class Presence {
  kAlways,    ///< must be there
  kOptional,  ///< may be left out: then the member stays as it is
  kNullable,  ///< null if the member has no value; may also be left out
};

/// The whole numbers that a field may hold.
struct WholeRange {
  std::int64_t least = 0;
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};
/// Columns, rows and sides in cells.
inline constexpr WholeRange kCellRange{-(1 << 30), 1 << 30};
/// Numbers of layers.
inline constexpr WholeRange kLayerRange{0, 1 << 30};
/// Sides of a canvas or a map in cells.
inline constexpr WholeRange kMapSideRange{1, 8192};

/// A member of a struct as messages have it.
template <typename Struct, typename Value>
struct MessageField {
  const char* key;
  Value Struct::*member;
  Presence presence;
  WholeRange range;
};
/// A row of `kFields`. @param range  of a whole number.
template <typename Struct, typename Value>
constexpr MessageField<Struct, Value> field(const char* key, Value Struct::*member,
                                            WholeRange range = {},
                                            Presence presence = Presence::kAlways) {
  return {key, member, presence, range};
}
/// The same of what is no whole number.
template <typename Struct, typename Value>
constexpr MessageField<Struct, Value> field(const char* key, Value Struct::*member,
                                            Presence presence) {
  return {key, member, presence, {}};
}

/// @name Readings and time
/// @{

/// Asks for a device's readings, as often as an UnsubscribeRequest follows later.
/// @throws SessionError kNoSuchDevice; kBadArgument for a device without readings; kNotAvailable
///         for another robot's in a private world.
struct SubscribeRequest {
  using Result = void;
  static constexpr const char* kName = "subscribe";
  DeviceId device{-1, -1};
  static constexpr std::tuple kFields{field("device", &SubscribeRequest::device)};
};

/// Takes back a SubscribeRequest; readings that wait are gone with the last one.
struct UnsubscribeRequest {
  using Result = void;
  static constexpr const char* kName = "unsubscribe";
  DeviceId device{-1, -1};
  static constexpr std::tuple kFields{field("device", &UnsubscribeRequest::device)};
};

/// Whether a newer reading replaces an older one that was not taken yet (default), or queues
/// behind it (at most 1000; then the oldest is dropped and counted as overflow).
struct ReplaceRequest {
  using Result = void;
  static constexpr const char* kName = "replace";
  std::optional<DeviceId> device =
      std::nullopt;  ///< none: all devices, also those subscribed to later
  bool replace = true;
  static constexpr std::tuple kFields{field("device", &ReplaceRequest::device, Presence::kNullable),
                                      field("replace", &ReplaceRequest::replace)};
};

/// How many readings were dropped so far.
struct OverflowRequest {
  using Result = std::uint32_t;
};

/// Takes part in the lockstep from now on, with the calling thread as the session's owner, as after
/// Session::wait(), but without waiting: simulated time stands until this thread waits. So a
/// thread can join before the one that started it goes on. Also undoes being silent for too long.
struct JoinRequest {
  using Result = void;
};

/// Lets simulated time pass (lockstep), or waits (paced).
/// @throws SessionError kBadArgument unless it is in 0..1e9.
struct SleepRequest {
  using Result = void;
  double seconds = 0.0;
};

/// How far the simulation is.
struct TimeRequest {
  using Result = TimeStatistics;
  static constexpr const char* kName = "time";
  static constexpr const char* kAnswer = "time";
};

/// For clients that read in the background: switches a lockstep simulation whose time mode nobody
/// chose to real time, once, with a warning. See docs/architecture.md.
struct PreferRealTimeRequest {
  using Result = void;
  static constexpr const char* kName = "prefer_real_time";
  std::string reason;
  static constexpr std::tuple kFields{field("reason", &PreferRealTimeRequest::reason)};
};

/// Notes that the program has looked at readings. A session whose simulated time passes only while
/// the program waits warns one that goes on looking or commanding without ever waiting.
struct NoteLooksRequest {
  using Result = void;
  int count = 0;          ///< times that it has looked since the last such request
  bool has_data = false;  ///< whether the device it looked at last has had a reading
};

/// How long an answer may take before the connection counts as lost. Nothing changes where requests
/// are no messages. Waiting for simulated time is not limited by it.
struct AnswerTimeoutRequest {
  using Result = void;
  double seconds = 10.0;  ///< > 0
};

/// What is done about a lost connection: the call that meets the loss tries to connect again. The
/// new connection has the same subscriptions, and no layers. Nothing changes where there is none to
/// lose.
struct RetriesRequest {
  using Result = void;
  int limit = 0;        ///< attempts; < 0: for ever
  double time_s = 0.0;  ///< between them, >= 0
};
/// @}

/// @name The canvas and its layers
///
/// The session's drawings that wait in its queue are carried out first, see Session.
/// A layer belongs to the session that made it; only this one may name it. It stays when the
/// session ends, until one on the same port makes a layer of the same name. Who names a layer that
/// is not the base layer or its own gets SessionError kBadArgument.
/// @{

/// Carries out what waits in the draw queue, and gives it its first room.
struct FlushDrawingsRequest {
  using Result = void;
};

/// Gives each cell of a rectangle its value, row-major from the top, without blending; clipped.
/// @throws SessionError kBadArgument unless there are as many values as the rectangle has cells.
struct SetCellsRequest {
  using Result = void;
  static constexpr const char* kName = "set_cells";
  sim::LayerId layer = sim::kBaseLayer;
  sim::CellRect rect;
  std::vector<sim::CellValue> cells;
  static constexpr std::tuple kFields{field("layer", &SetCellsRequest::layer, kLayerRange),
                                      field("rect", &SetCellsRequest::rect),
                                      field("cells", &SetCellsRequest::cells)};
};

/// Value of a cell; nullopt outside.
struct CellRequest {
  using Result = std::optional<sim::CellValue>;
  static constexpr const char* kName = "cell";
  static constexpr const char* kAnswer = "cell";
  sim::LayerId layer = sim::kBaseLayer;
  int column = 0;
  int row = 0;
  static constexpr std::tuple kFields{field("layer", &CellRequest::layer, kLayerRange),
                                      field("column", &CellRequest::column, kCellRange),
                                      field("row", &CellRequest::row, kCellRange)};
};

/// All cells of a layer, row-major from the top.
struct CellsRequest {
  using Result = std::vector<sim::CellValue>;
  static constexpr const char* kName = "cells";
  static constexpr const char* kAnswer = "cells";
  sim::LayerId layer = sim::kBaseLayer;
  static constexpr std::tuple kFields{field("layer", &CellsRequest::layer, kLayerRange)};
};

/// Makes a layer. One of the same name that an ended session of this port left is taken out.
/// @throws SessionError kBadArgument for a name that is not 1 to kMaxLayerName printable bytes
///         (UTF-8 may be among them) or that this session has already, "canvas" among them;
///         kNotAvailable if it has kMaxLayers, or all layers together would hold more than
///         kMaxLayerCells cells.
struct CreateLayerRequest {
  using Result = sim::LayerId;
  static constexpr const char* kName = "create_layer";
  static constexpr const char* kAnswer = "layer";
  sim::LayerKind kind = sim::LayerKind::kColour;
  sim::LayerStyle style;
  static constexpr std::tuple kFields{field("kind", &CreateLayerRequest::kind),
                                      field("style", &CreateLayerRequest::style)};
};

/// Takes one of this session's layers out. @throws SessionError kNotAvailable for the base layer.
struct RemoveLayerRequest {
  using Result = void;
  static constexpr const char* kName = "remove_layer";
  sim::LayerId layer = sim::kBaseLayer;
  static constexpr std::tuple kFields{field("layer", &RemoveLayerRequest::layer, kLayerRange)};
};

/// Changes how a layer is drawn over others. The base layer's may be changed too (by any session),
/// but for its name.
/// @throws SessionError kBadArgument for a name as in CreateLayerRequest; kNotAvailable for another
///         name of the base layer.
struct SetLayerStyleRequest {
  using Result = void;
  static constexpr const char* kName = "set_layer_style";
  sim::LayerId layer = sim::kBaseLayer;
  sim::LayerStyle style;
  static constexpr std::tuple kFields{field("layer", &SetLayerStyleRequest::layer, kLayerRange),
                                      field("style", &SetLayerStyleRequest::style)};
};

/// The base layer and this session's own, lowest first.
struct LayersRequest {
  using Result = std::vector<sim::LayerInfo>;
  static constexpr const char* kName = "layers";
  static constexpr const char* kAnswer = "layers";
};

/// A picture of the canvas.
struct CanvasImage {
  std::vector<std::uint8_t> rgba;  ///< row-major from the top
  CanvasInfo canvas;
  static constexpr std::tuple kFields{field("image", &CanvasImage::rgba),
                                      field("canvas", &CanvasImage::canvas)};
};
/// All visible layers of all clients over one another.
struct CanvasImageRequest {
  using Result = CanvasImage;
  static constexpr const char* kName = "canvas_image";
};

/// Size and place of the canvas now.
struct CanvasInfoRequest {
  using Result = CanvasInfo;
};

/// Gives the canvas, with all layers of all clients, another number of columns and rows. What is
/// drawn stays where it is in the world.
/// @throws SessionError kBadArgument for sides outside 1..8192; kNotAvailable if all layers
///         together would hold more than kMaxLayerCells cells.
struct ResizeCanvasRequest {
  using Result = CanvasInfo;
  static constexpr const char* kName = "resize_canvas";
  static constexpr const char* kAnswer = "canvas";
  int width = 0;
  int height = 0;
  static constexpr std::tuple kFields{field("width", &ResizeCanvasRequest::width, kCellRange),
                                      field("height", &ResizeCanvasRequest::height, kCellRange)};
};

/// Writes the canvas image as a PNG into the run's output folder.
/// @throws SessionError kBadArgument for a name that is not plain or a scale outside 1..64;
///         kNotAvailable if the run has no output folder, or the file cannot be written.
struct SaveImageRequest {
  using Result = void;
  static constexpr const char* kName = "save_image";
  std::string name;  ///< a plain file name; ".png" is added unless it is there
  int scale = 1;     ///< scale x scale pixels a cell
  std::optional<sim::LayerId> layer =
      std::nullopt;  ///< this one alone instead, also if it is hidden
  static constexpr std::tuple kFields{
      field("name", &SaveImageRequest::name),
      field("scale", &SaveImageRequest::scale, kCellRange, Presence::kOptional),
      field("layer", &SaveImageRequest::layer, kLayerRange, Presence::kOptional)};
};

/// Writes a grey layer as the pair of files that ROS's map_server reads, NAME.yaml and NAME.pgm,
/// into the run's output folder: see sim::io::write_map().
/// @throws SessionError as SaveImageRequest, also kBadArgument for a layer of another kind.
struct SaveMapRequest {
  using Result = void;
  static constexpr const char* kName = "save_map";
  sim::LayerId layer = sim::kBaseLayer;
  std::string name;  ///< a plain file name, with or without ".yaml"
  sim::io::MapMode mode = sim::io::MapMode::kTrinary;
  static constexpr std::tuple kFields{field("layer", &SaveMapRequest::layer, kLayerRange),
                                      field("name", &SaveMapRequest::name),
                                      field("mode", &SaveMapRequest::mode, Presence::kOptional)};
};

/// How pictures show the canvas now.
struct ViewModeRequest {
  using Result = sim::ViewMode;
  static constexpr const char* kName = "view_mode";
  static constexpr const char* kAnswer = "mode";
};

/// @throws SessionError kNotAvailable if the world has locked another mode.
struct SetViewModeRequest {
  using Result = void;
  static constexpr const char* kName = "set_view_mode";
  sim::ViewMode mode = sim::ViewMode::kGround;
  static constexpr std::tuple kFields{field("mode", &SetViewModeRequest::mode)};
};
/// @}

/// The map of an arena's floor, or a tile of it.
struct WorldMap {
  sim::OccupancyMap map;
  // Of a tile: what it is a tile of.
  std::optional<int> width = std::nullopt;         ///< columns
  std::optional<int> height = std::nullopt;        ///< rows
  std::optional<sim::Pose> origin = std::nullopt;  ///< X_WM of the bottom left corner
  static constexpr std::tuple kFields{
      field("map", &WorldMap::map),
      field("width", &WorldMap::width, kMapSideRange, Presence::kOptional),
      field("height", &WorldMap::height, kMapSideRange, Presence::kOptional),
      field("origin", &WorldMap::origin, Presence::kOptional)};
};
/// The true map of the arena's floor with its obstacles as they stand now, see sim::true_map().
/// Across a network it is fetched in tiles.
/// @throws SessionError kBadArgument if the cell size is not a positive number, or the map would
///         have more than 8192 cells along a side, or has no such tile.
struct WorldMapRequest {
  using Result = WorldMap;
  static constexpr const char* kName = "world_map";
  static constexpr bool kTellsTruth = true;
  double cell_size_m = 0.0;
  std::optional<sim::CellRect> tile = std::nullopt;  ///< what of it lies outside the map is cut off
  static constexpr std::tuple kFields{field("cell_size", &WorldMapRequest::cell_size_m),
                                      field("tile", &WorldMapRequest::tile, Presence::kOptional)};
};

/// @name Robots and obstacles by name, and the log
///
/// Names are those of the world's robots, obstacles and dock separators, "border" and "wall". Where
/// somebody else is told to watch over a robot (a server's tokens) only those who may command it
/// may move or change it, and only those who may command all robots may do so with obstacles.
/// A name or property that is not there throws SessionError kBadArgument, which tells what is;
/// so does what cannot be done (a place that is taken). kNotAvailable: the world has locked its
/// objects, see sim::SimulationDescription::objects_locked.
/// @{

/// Where a robot or an obstacle is.
struct ObjectPose {
  sim::Pose pose;            ///< X_WB of a robot; the middle of anything else, in W
  sim::SimTime time_ns = 0;  ///< now
  static constexpr std::tuple kFields{field("pose", &ObjectPose::pose),
                                      field("t", &ObjectPose::time_ns)};
};
/// Where a robot or an obstacle is. @throws SessionError kBadArgument if there is none of that
/// name.
struct ObjectPoseRequest {
  using Result = ObjectPose;
  static constexpr const char* kName = "object_pose";
  static constexpr bool kTellsTruth = true;
  std::string name;
  static constexpr std::tuple kFields{field("name", &ObjectPoseRequest::name)};
};

/// Puts a robot or a block somewhere, see sim::Simulation::place_object().
struct PlaceObjectRequest {
  using Result = void;
  static constexpr const char* kName = "place_object";
  static constexpr bool kTellsTruth = true;
  std::string name;
  sim::Pose pose;
  static constexpr std::tuple kFields{field("name", &PlaceObjectRequest::name),
                                      field("pose", &PlaceObjectRequest::pose)};
};

/// A property, see docs/simulation.md for those there are.
struct ObjectPropertyRequest {
  using Result = PropertyValue;
  static constexpr const char* kName = "object_property";
  static constexpr const char* kAnswer = "value";
  static constexpr bool kTellsTruth = true;
  std::string name;
  std::string property;
  static constexpr std::tuple kFields{field("name", &ObjectPropertyRequest::name),
                                      field("property", &ObjectPropertyRequest::property)};
};

/// Changes a property, see docs/simulation.md for those there are.
/// @throws SessionError kBadArgument for what is not there or cannot be; kNotAvailable if objects
/// are locked.
struct SetObjectPropertyRequest {
  using Result = void;
  static constexpr const char* kName = "set_object_property";
  static constexpr bool kTellsTruth = true;
  std::string name;
  std::string property;
  PropertyValue value;
  static constexpr std::tuple kFields{field("name", &SetObjectPropertyRequest::name),
                                      field("property", &SetObjectPropertyRequest::property),
                                      field("value", &SetObjectPropertyRequest::value)};
};

/// Saves the state of the whole simulation under a name, in place of the one that had it: robots,
/// obstacles, devices with their noise and commands, and the canvas. All clients have saved states
/// in common; they end with the simulation. Of this client's commands, those that wait for the next
/// step are not part of it.
/// @throws SessionError kBadArgument for a name that is not 1 to 64 printable bytes; kNotAvailable
///         if objects are locked, 64 states are there, or all together would have more than
///         256 MiB.
struct SaveStateRequest {
  using Result = void;
  static constexpr const char* kName = "save_state";
  static constexpr bool kTellsTruth = true;
  std::string name;
  static constexpr std::tuple kFields{field("name", &SaveStateRequest::name)};
};

/// Lets the world go back to a saved state, at once and for all clients. Time does not: clock,
/// duration, report, film and log go on, as sim::RestoreScope::kWorld has it. Readings that wait
/// are still handed out, commands that wait are carried out in the next step.
/// @throws SessionError kBadArgument if no state was saved under that name; kNotAvailable if
///         objects are locked.
struct RestoreStateRequest {
  using Result = void;
  static constexpr const char* kName = "restore_state";
  static constexpr bool kTellsTruth = true;
  std::string name;
  static constexpr std::tuple kFields{field("name", &RestoreStateRequest::name)};
};

/// Tells the simulation where a robot is to drive by commands that do not say so, as those of a
/// program that avoids obstacles: report and pictures show the goal. Nothing else follows from it.
/// @throws SessionError kNoSuchDevice; kBadArgument for numbers that are not finite.
struct NoteGoalRequest {
  using Result = void;
  static constexpr const char* kName = "note_goal";
  DeviceId device{-1, -1};               ///< any device of the robot
  sim::Vec2 goal_m = sim::Vec2::Zero();  ///< in the robot's frame B as it stands now [m]
  double tolerance_m = 0.0;              ///< the robot has arrived when it is so near [m]
  static constexpr std::tuple kFields{field("device", &NoteGoalRequest::device),
                                      field("goal", &NoteGoalRequest::goal_m),
                                      field("tolerance", &NoteGoalRequest::tolerance_m)};
};

/// Changes what the log of this session's port does, in the order of the members, or (without
/// changes) only tells it. The log has the readings of that port's robots, see docs/log.md. All
/// sessions of a port have it in common.
/// @throws SessionError kBadArgument for a name that is not plain, a file that is no log, or
///         changes of file or direction while it runs; kNotAvailable if the run has no output
///         folder, or the file cannot be opened.
struct LogRequest {
  using Result = LogStatus;
  static constexpr const char* kName = "log";
  static constexpr const char* kAnswer = "log";
  std::optional<std::string> file =
      std::nullopt;  ///< a plain name; ".jsonl" is added unless it is there
  std::optional<bool> replay = std::nullopt;
  std::optional<bool> rewind = std::nullopt;  ///< true: a replay begins anew
  std::optional<bool> running = std::nullopt;
  static constexpr std::tuple kFields{field("file", &LogRequest::file, Presence::kOptional),
                                      field("replay", &LogRequest::replay, Presence::kOptional),
                                      field("rewind", &LogRequest::rewind, Presence::kOptional),
                                      field("running", &LogRequest::running, Presence::kOptional)};
};
/// @}

/// Any request.
using Request =
    std::variant<SubscribeRequest, UnsubscribeRequest, ReplaceRequest, OverflowRequest, JoinRequest,
                 SleepRequest, TimeRequest, PreferRealTimeRequest, NoteLooksRequest,
                 AnswerTimeoutRequest, RetriesRequest, FlushDrawingsRequest, SetCellsRequest,
                 CellRequest, CellsRequest, CreateLayerRequest, RemoveLayerRequest,
                 SetLayerStyleRequest, LayersRequest, CanvasImageRequest, CanvasInfoRequest,
                 ResizeCanvasRequest, SaveImageRequest, SaveMapRequest, ViewModeRequest,
                 SetViewModeRequest, WorldMapRequest, ObjectPoseRequest, PlaceObjectRequest,
                 ObjectPropertyRequest, SetObjectPropertyRequest, SaveStateRequest,
                 RestoreStateRequest, NoteGoalRequest, LogRequest>;

/// The result of any request; std::monostate for those without.
using Answer =
    std::variant<std::monostate, std::uint32_t, sim::LayerId, std::optional<sim::CellValue>,
                 std::vector<sim::CellValue>, std::vector<sim::LayerInfo>, CanvasImage, CanvasInfo,
                 sim::ViewMode, WorldMap, ObjectPose, PropertyValue, LogStatus, TimeStatistics>;

/// What `visitor` makes of a request; its functions return the `Result` of what they are given.
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
