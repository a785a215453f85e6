// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/session/device_graphics.h"
#include "playerlike/session/device_planners.h"
#include "playerlike/session/device_properties.h"
#include "playerlike/session/session.h"
#include "remote/player_link.h"
#include "remote/player_readings.h"

namespace playerlike {

/// How to open a session with a Player server.
struct PlayerSettings {
  ServerAddress server;
  std::vector<std::string> tokens;  ///< keys for the server's authentication; tried in turn
  double connect_timeout_s = 10.0;  ///< of the whole attempt
  double banner_timeout_s = 10.0;   ///< of the server's greeting
  double request_timeout_s = 5.0;   ///< of an answer, see AnswerTimeoutRequest
};

class PlayerWorld;
struct ListedDevice;
struct PlayerCommand;

/// A session whose other end is a Player server: a real robot, Player with Stage, or a simulation
/// of `playpen serve --player-port`. docs/from_simulation_to_robot.md describes what is different.
///
/// The server's devices appear as one robot, each under the server's own address
/// (RobotInfo::addresses). A device is opened at its first subscription, command or request; then
/// its geometry and settings are requested, too, so the properties of a device, and the size of the
/// robot, change at that moment.
///
/// The time of readings is the server's. The server never waits for its clients in this class's
/// view: JoinRequest and NoteLooksRequest do nothing, and SleepRequest takes wall time. There is no
/// canvas: CanvasInfoRequest returns an empty one, and requests to draw throw kNotAvailable.
/// Devices of the server's interface graphics2d draw (DeviceGraphics), those of planner plan
/// (DevicePlanners).
///
/// It has no thread: a thread that waits reads the socket, see PlayerLink. A request that the
/// server refuses or does not answer in time throws SessionError kNotAvailable; the connection goes
/// on.
class PlayerSession final : public Session,
                            public DeviceGraphics,
                            public DevicePlanners,
                            public DeviceProperties,
                            private PlayerLink::Receiver {
 public:
  /// Connects. @throws SessionError as PlayerLink::open(), and if the server refuses.
  explicit PlayerSession(PlayerSettings settings);
  ~PlayerSession() override;

  const std::vector<RobotInfo>& robots() const noexcept override { return robots_; }
  int port() const noexcept override { return settings_.server.tcp_port; }
  bool connected() const noexcept override;

  void wait() override;
  int take(ReadingSink& sink) override;
  bool peek(std::chrono::milliseconds timeout) override;
  void send(DeviceId device, const sim::Command& command) override;
  Answer answer(const Request& request) override;
  DrawQueue& draw_queue() noexcept override { return drawings_; }
  std::uint64_t canvas_generation() const noexcept override { return 0; }
  std::unique_ptr<Session> open_follower() override;
  const void* simulation() const noexcept override { return simulation_; }
  void close() noexcept override;
  void draw(unsigned index, const DeviceDrawing& drawing) override;
  void set_planner_goal(unsigned index, const sim::Pose& goal) override;
  void set_planner_start(unsigned index, const sim::Pose& start) override;
  void enable_planner(unsigned index, bool on) override;
  [[nodiscard]] Path planner_path(unsigned index) override;
  [[nodiscard]] std::optional<Value> property(unsigned interface, unsigned index,
                                              const std::string& name, const Value& kind) override;
  [[nodiscard]] bool set_property(unsigned interface, unsigned index, const std::string& name,
                                  const Value& value) override;

 private:
  friend class PlayerWorld;
  using Lock = std::unique_lock<std::mutex>;
  struct RequestHandler;

  /// One address of the server, and what this session has done with it. Guarded by `mutex_` unless
  /// constant.
  struct Address {
    player::Devaddr at;  ///< constant; for messages to the device
    std::string name;    ///< constant; "laser:0"
    int device = -1;     ///< constant; index of the device of the readings, -1: none
    bool opened = false;
    bool completed = false;  ///< geometry and settings were requested
    int subscriptions = 0;
    std::optional<bool> replace;          ///< nothing: as by default
    PlayerReadings readings{0};           ///< used by the link's leader only
    std::optional<double> period_s = {};  ///< of a light, as last set
    std::optional<double> duty_cycle = {};
  };
  struct Waiting {
    Address* address;
    sim::SharedReading reading;
    std::size_t bytes;  ///< of the message
  };

  void on_data(const player::Msghdr& header, std::string_view payload) override;
  void on_round(std::uint32_t dropped) override;

  void require_open() const;
  [[nodiscard]] std::shared_ptr<PlayerLink> link() const;
  [[nodiscard]] std::shared_ptr<PlayerLink> connect();
  /// Calls read(); an error in the server's bytes ends the connection.
  template <typename Read>
  static auto understood_by(PlayerLink& link, Read read) -> decltype(read());
  /// Calls use(link); repeats it after a reconnection if the connection is lost.
  template <typename Use>
  auto with_link(Use use);
  /// Replaces a lost connection. @return whether there is one now.
  bool recover(const std::shared_ptr<PlayerLink>& lost);
  /// Opens all devices on a new connection that were open on the last one.
  void resume(PlayerLink& link);
  /// Waits, but not longer than the session is open. @return whether it is open.
  bool pause(double seconds);

  /// Requests the list of devices with their drivers.
  [[nodiscard]] static std::vector<ListedDevice> list_devices(PlayerLink& link);
  void make_addresses(const std::vector<ListedDevice>& devices);
  /// The address of a device: of its readings, or of its motors. @throws SessionError
  /// kNoSuchDevice.
  [[nodiscard]] Address& address_of(DeviceId device);
  /// The first address of an interface; null if the server has none.
  [[nodiscard]] Address* address_of(unsigned interface);
  /// The address of a device of an interface. @throws SessionError kNoSuchDevice.
  [[nodiscard]] Address& address_of(unsigned interface, unsigned index);
  /// Opens a device unless it is open, and requests its geometry. @throws SessionError.
  void open(PlayerLink& link, Address& address);
  void complete(PlayerLink& link, Address& address);
  static void send_open(PlayerLink& link, const Address& address, std::uint8_t mode);
  /// Sends a request to a device. @return the answer's payload. @throws SessionError kNotAvailable
  /// for NACK and if there is no answer in time.
  std::string ask(PlayerLink& link, const Address& address, std::uint8_t subtype,
                  std::string_view payload);

  /// As above, to an address that is opened before, and again after a reconnection.
  std::string ask(Address& address, std::uint8_t subtype, std::string_view payload);
  /// Sends a command, or a request whose answer does not matter, as ask() does.
  void tell(Address& address, const PlayerCommand& message);
  /// As ask(), but without an answer if the device refuses or does not answer.
  std::optional<std::string> try_to_ask(Address& address, std::uint8_t subtype,
                                        std::string_view payload);
  /// Requests the particles of a localisation.
  std::vector<LocalizationParticle> particles(DeviceId device);
  /// Playpen's servers have a property for it (docs/player_wire_interfaces.md), others do not.
  Charge take_charge(const TakeChargeRequest& what);
  /// Ends the connection, since an answer cannot be understood. @throws SessionError kDisconnected.
  [[noreturn]] static void refuse_bytes(PlayerLink& link, const std::string& why);

  void subscribe(DeviceId device);
  void unsubscribe(DeviceId device);
  void set_replace(const ReplaceRequest& what);
  void sleep(double seconds);
  [[nodiscard]] TimeStatistics time();
  /// Waits for a round at most until the deadline; without one, as long as the server is alive.
  void await_round(PlayerLink& link, std::optional<SocketClock::time_point> deadline);
  /// Whether a complete round waits. The caller holds `mutex_`.
  [[nodiscard]] bool has_round() const;
  [[nodiscard]] bool subscribes_to_nothing();

  const PlayerSettings settings_;
  const void* const simulation_;
  const SocketClock::time_point began_;
  std::vector<RobotInfo> robots_;
  // The next three are constant after the constructor.
  std::vector<std::unique_ptr<Address>> addresses_;
  std::map<std::pair<unsigned, unsigned>, Address*> by_interface_;  ///< interface and index
  std::vector<Address*> by_device_;                                 ///< index of the device
  std::unique_ptr<PlayerWorld> world_;  ///< requests about the world and the blackboard
  DrawQueue drawings_;                  ///< never has room
  std::atomic<bool> closed_{false};
  std::atomic<double> request_timeout_s_;
  std::atomic<int> retry_limit_{0};
  std::atomic<double> retry_time_s_{0.0};
  std::optional<bool> has_watchdog_;  ///< used by take_charge() only; nothing: not asked yet
  std::mutex recover_mutex_;          ///< allows one reconnection at a time
  std::mutex open_mutex_;  ///< allows one opening of a device at a time; locked before `mutex_`

  /// Guards the members below and the addresses; a leaf mutex, never held while waiting.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<PlayerLink> link_;
  bool replace_by_default_ = true;
  bool round_ = false;               ///< a round is complete and was not taken yet
  std::uint64_t rounds_ = 0;         ///< rounds of the server so far, also those without readings
  SocketClock::time_point first_{};  ///< when the oldest reading of the round has arrived
  std::deque<Waiting> waiting_;      ///< readings that were not taken, oldest first
  std::size_t waiting_bytes_ = 0;
  std::uint32_t overflow_ = 0;
  sim::SimTime time_ns_ = 0;  ///< newest time of data
};

}  // namespace playerlike
