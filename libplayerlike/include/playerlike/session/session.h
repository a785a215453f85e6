// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "playerlike/session/draw_queue.h"
#include "sim/canvas/layers.h"
#include "sim/io/map_file.h"
#include "sim/world/occupancy_map.h"

namespace playerlike {

inline constexpr std::size_t kMaxLayers = 64;     ///< of a session, without the base layer
inline constexpr std::size_t kMaxLayerName = 64;  ///< bytes
/// Of all layers of a simulation together: 256 MiB.
inline constexpr std::size_t kMaxLayerCells = std::size_t{1} << 26U;

/// Receives the readings of a round.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  /// `reading` is valid during the call only. Must not call the session back.
  virtual void on_reading(DeviceId device, const sim::Reading& reading) = 0;
};

/// A client's end of a connection to a simulation: the one seam between the client library and
/// whatever runs the world. Proxies cannot tell what stands behind it.
///
/// All members may be called from any thread. In lockstep a session belongs to the thread that
/// last waited on it, and simulated time stands still until every such thread waits again.
/// Calls on a closed session throw SessionError kDisconnected, but for those marked noexcept.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  /// The world's robots and devices; constant over a session's life.
  [[nodiscard]] virtual const std::vector<RobotInfo>& robots() const noexcept = 0;
  /// The port this session was opened on.
  [[nodiscard]] virtual int port() const noexcept = 0;
  [[nodiscard]] virtual bool connected() const noexcept = 0;

  /// Asks for a device's readings, as often as unsubscribe() is called later.
  virtual void subscribe(DeviceId device) = 0;
  virtual void unsubscribe(DeviceId device) = 0;
  /// Whether a newer reading replaces an older one that was not taken yet (default), or queues
  /// behind it (at most 1000; then the oldest is dropped and counted as overflow).
  /// @param device  nullopt: all devices, also those subscribed to later.
  virtual void set_replace(std::optional<DeviceId> device, bool replace) = 0;
  [[nodiscard]] virtual std::uint32_t overflow_count() const = 0;

  /// Waits until at least one subscribed device has a reading that was not taken yet; without
  /// any subscription, until a tenth of a simulated second has passed. In lockstep this is what
  /// lets simulated time go on.
  /// @throws SessionError kFinished when the run is over and nothing is left to take.
  virtual void wait() = 0;
  /// Hands over all readings that were not taken yet, oldest first, in order of device.
  /// @return how many; 0 too for a round without subscriptions.
  virtual int take(ReadingSink& sink) = 0;
  /// Whether a reading waits (or the run is over, so that take() must be tried).
  /// Lockstep: with timeout 0, the first call after a take() only looks; further ones in a row
  /// each let one step pass. With a timeout, up to that much simulated time passes.
  /// Paced: waits up to the timeout of wall time.
  [[nodiscard]] virtual bool peek(std::chrono::milliseconds timeout) = 0;

  /// Queues a command for the next step.
  virtual void send(DeviceId device, const sim::Command& command) = 0;
  /// Notes that the program has looked at readings so many times. A session whose simulated time
  /// passes only while the program waits warns one that goes on looking or commanding without ever
  /// waiting.
  /// @param has_data  whether the device it looked at last has had a reading.
  virtual void note_looks(int count, bool has_data) {
    static_cast<void>(count);
    static_cast<void>(has_data);
  }

  /// Takes part in the lockstep from now on, with the calling thread as this session's owner, as
  /// after a wait(), but without waiting: simulated time stands until this thread waits. So a
  /// thread can join before the one that started it goes on. Also undoes being silent for too long.
  virtual void join() = 0;

  /// Opens a further session of the same simulation and port, for a driver that a program runs in
  /// a thread of its own. In lockstep such a follower holds simulated time while its thread thinks,
  /// as any session, but never lets it go on by itself: time stands while no other session takes
  /// part. It does not count for the start gate, and its commands are carried out before those
  /// of other sessions, so that a program has the last word.
  [[nodiscard]] virtual std::unique_ptr<Session> open_follower() = 0;
  /// The same for all sessions of one simulation, and different for others that exist now.
  [[nodiscard]] virtual const void* simulation() const noexcept = 0;

  /// @name The canvas and its layers
  ///
  /// Drawings go through a queue of this session. It is emptied, in order, before each step (the
  /// clients in the order in which they connected), when it is full, and before any other call
  /// here that concerns the canvas: so this session sees its drawings at once, others from the next
  /// step on at the latest. Everything else here happens at once.
  ///
  /// A layer belongs to the session that made it; only this one may name it. It stays when the
  /// session ends, until one on the same port makes a layer of the same name.
  /// @{

  /// The queue, for those who draw cell by cell: push() onto it is draw() without a virtual call.
  /// A push that fails is tried again after flush_drawings().
  [[nodiscard]] virtual DrawQueue& draw_queue() noexcept = 0;
  /// Carries out what waits in the queue, and gives it its first room.
  virtual void flush_drawings() = 0;
  /// Draws on the canvas (layer kBaseLayer) and on this session's layers, in order. What lies
  /// outside is clipped; what names another layer, also another session's, is left out.
  void draw(std::span<const sim::DrawOperation> operations);
  /// Gives each cell of a rectangle its value, row-major from the top, without blending; clipped.
  /// @throws SessionError kBadArgument if there are not as many values as the rectangle has cells,
  ///         or for a layer that is not this session's.
  virtual void draw_cells(sim::LayerId layer, const sim::CellRect& rect,
                          std::span<const sim::CellValue> values) = 0;
  /// Value of a cell; nullopt outside. @throws SessionError kBadArgument as draw_cells().
  [[nodiscard]] virtual std::optional<sim::CellValue> cell(sim::LayerId layer, int column,
                                                           int row) = 0;
  /// All cells of a layer, row-major from the top. @throws SessionError kBadArgument as above.
  [[nodiscard]] virtual std::vector<sim::CellValue> cells(sim::LayerId layer) = 0;

  /// Makes a layer. One of the same name that an ended session of this port left is taken out.
  /// @throws SessionError kBadArgument for a name that is not 1 to kMaxLayerName printable bytes
  ///         (UTF-8 may be among them) or that this session has already, "canvas" among them;
  ///         kNotAvailable if it has kMaxLayers, or all layers together would hold more than
  ///         kMaxLayerCells cells.
  virtual sim::LayerId create_layer(sim::LayerKind kind, sim::LayerStyle style) = 0;
  /// Takes one of this session's layers out.
  /// @throws SessionError kBadArgument if it is not; kNotAvailable for the base layer.
  virtual void remove_layer(sim::LayerId layer) = 0;
  /// Changes how a layer is drawn over others. The base layer's may be changed too (by any
  /// session), but for its name.
  /// @throws SessionError kBadArgument for a layer that is not this session's or a name as in
  ///         create_layer(); kNotAvailable for another name of the base layer.
  virtual void set_layer_style(sim::LayerId layer, sim::LayerStyle style) = 0;
  /// The base layer and this session's own, lowest first.
  [[nodiscard]] virtual std::vector<sim::LayerInfo> layers() = 0;

  /// All visible layers of all clients over one another, as RGBA bytes, row-major from the top.
  [[nodiscard]] virtual std::vector<std::uint8_t> canvas_image() = 0;
  /// Gives the canvas, with all layers of all clients, another number of columns and rows. What is
  /// drawn stays where it is in the world.
  /// @throws SessionError kBadArgument for sides outside 1..8192; kNotAvailable if all layers
  ///         together would hold more than kMaxLayerCells cells.
  virtual void resize_canvas(int width, int height) = 0;
  /// Size and place of the canvas now. Does not throw on a closed session.
  [[nodiscard]] virtual CanvasInfo canvas_info() const = 0;
  /// How often the canvas was resized, by anyone: while this stays the same, so does
  /// canvas_info(). Cheap.
  [[nodiscard]] virtual std::uint64_t canvas_generation() const noexcept = 0;
  /// Writes canvas_image() as a PNG, scale x scale pixels a cell, into the run's output folder.
  /// @param name   a plain file name; ".png" is added unless it is there.
  /// @param layer  this one alone instead, also if it is hidden.
  /// @throws SessionError kBadArgument for any other name, a scale outside 1..64, or a layer that
  ///         is not this session's; kNotAvailable if the run has no output folder, or the file
  ///         cannot be written.
  virtual void save_image(const std::string& name, int scale = 1,
                          std::optional<sim::LayerId> layer = std::nullopt) = 0;
  /// Writes a grey layer as the pair of files that ROS's map_server reads, NAME.yaml and NAME.pgm,
  /// into the run's output folder: see sim::io::write_map().
  /// @param name  a plain file name, with or without ".yaml".
  /// @throws SessionError as save_image(), also kBadArgument for a layer of another kind.
  virtual void save_map(sim::LayerId layer, const std::string& name, sim::io::MapMode mode) = 0;

  [[nodiscard]] virtual sim::ViewMode view_mode() const = 0;
  /// @throws SessionError kNotAvailable if the world has locked another mode.
  virtual void set_view_mode(sim::ViewMode mode) = 0;
  /// @}

  /// The true map of the arena's floor with its obstacles as they stand now, see sim::true_map().
  /// Across a network it is fetched in tiles.
  /// @throws SessionError kBadArgument if the cell size is not a positive number, or the map would
  ///         have more than 8192 cells along a side.
  [[nodiscard]] virtual sim::OccupancyMap world_map(double cell_size_m) = 0;

  /// @name Robots and obstacles by name, and the log
  ///
  /// All of it happens at once. Names are those of the world's robots, obstacles and dock
  /// separators, "border" and "wall". Where somebody else is told to watch over a robot (a server's
  /// tokens) only those who may command it may move or change it, and only those who may command
  /// all robots may do so with obstacles.
  /// A name or property that is not there throws SessionError kBadArgument, which tells what is;
  /// so does what cannot be done (a place that is taken). kNotAvailable: the world has locked its
  /// objects, see sim::SimulationDescription::objects_locked.
  /// @{
  [[nodiscard]] virtual ObjectPose object_pose(const std::string& name);
  /// Puts a robot or a block somewhere, see sim::Simulation::place_object().
  virtual void place_object(const std::string& name, const sim::Pose& pose);
  /// A property, see docs/simulation.md for those there are.
  [[nodiscard]] virtual PropertyValue object_property(const std::string& name,
                                                      const std::string& property);
  virtual void set_object_property(const std::string& name, const std::string& property,
                                   const PropertyValue& value);
  /// Changes what the log of this session's port does, or (without changes) only tells it. The log
  /// has the readings of that port's robots, see docs/log.md. All sessions of a port have it in
  /// common.
  /// @throws SessionError kBadArgument for a name that is not plain, a file that is no log, or
  ///         changes of file or direction while it runs; kNotAvailable if the run has no output
  ///         folder, or the file cannot be opened.
  virtual LogStatus control_log(const LogControl& changes);
  /// @}

  [[nodiscard]] virtual TimeStatistics time() const = 0;
  /// Lets simulated time pass (lockstep), or waits (paced). seconds >= 0.
  virtual void sleep(double seconds) = 0;
  /// For clients that read in the background: switches a lockstep simulation whose time mode
  /// nobody chose to real time, once, with a warning. See docs/architecture.md.
  virtual void prefer_real_time(const std::string& reason) = 0;

  /// How long an answer may take [s], > 0, before the connection counts as lost. Nothing changes
  /// where calls are no messages. Waiting for simulated time is not limited by it.
  virtual void set_request_timeout(double seconds) { static_cast<void>(seconds); }
  /// What is done about a lost connection: up to `limit` attempts (< 0: for ever; 0, at first:
  /// none) to connect again, `time_s` apart (>= 0), by the call that meets the loss. The new
  /// connection has the same subscriptions, and no layers. Nothing changes where there is none to
  /// lose.
  virtual void set_retries(int limit, double time_s) {
    static_cast<void>(limit);
    static_cast<void>(time_s);
  }

  /// Ends the connection; the client no longer holds up others. Waiting threads throw.
  virtual void close() noexcept = 0;
};

}  // namespace playerlike
