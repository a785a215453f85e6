// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/mirror.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <typeinfo>

#include "host/mirror/ghost.h"
#include "host/mirror/mirror_layers.h"
#include "host/mirror/real_link.h"
#include "host/mirror/reconnection.h"
#include "host/mirror/scan_difference.h"
#include "host/stepping/commanders.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/core/pose.h"
#include "sim/devices/amcl.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace playerlike {
namespace {

using Drive = sim::RealRobotDescription::Drive;
using OnLost = sim::RealRobotDescription::OnLost;

/// Mean and maximum of a series.
class Series {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    greatest_ = std::max(greatest_, value);
    last_ = value;
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double last() const noexcept { return last_; }
  [[nodiscard]] std::optional<SeriesReport> report() const {
    if (count_ == 0) return std::nullopt;
    return SeriesReport{sum_ / static_cast<double>(count_), greatest_};
  }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double greatest_ = 0.0;
  double last_ = 0.0;
};

double seconds(WallClock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// For messages to others who want to command the robot.
std::string name_of_mirror() {
  std::array<char, 65> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host = {"?"};
  std::string name =
      std::string("the mirror on ") + host.data() + ", process " + std::to_string(getpid());
  std::erase_if(name, [](char c) { return c < ' ' || c > '~'; });
  return name;
}

std::string address_text(const std::string& interface, int index) {
  return interface + ':' + std::to_string(index);
}

}  // namespace

/// A robot of the world and its real counterpart.
class Mirror::Robot {
 public:
  Robot(sim::Simulation& simulation, const std::vector<RobotInfo>& robots, int index,
        const OpenRealRobot& open, const Warn& warn);

  std::optional<Executed> take_command(int device, const sim::Command& command);
  void before_step(std::vector<Given>& given);
  [[nodiscard]] std::optional<Loss> after_step();
  void halt();
  void stop() noexcept;

  [[nodiscard]] std::optional<RealMotors> motors() const {
    if (!binding_.motors) return std::nullopt;
    return RealMotors{description_.name, real_.server, port(), *binding_.motors};
  }
  [[nodiscard]] bool replaces(int device) const {
    return binding_.feeds[static_cast<std::size_t>(device)].has_value();
  }
  [[nodiscard]] const sim::SharedReading& newest(int device) const {
    return newest_[static_cast<std::size_t>(device)];
  }
  [[nodiscard]] const std::string& loss() const noexcept { return loss_; }
  /// Whether the connection will not be made again.
  [[nodiscard]] bool lost_for_good() const noexcept {
    return !loss_.empty() && real_.on_lost != OnLost::kReconnect;
  }
  void show(sim::SceneSnapshot& scene) const;
  void note_scene_taken();
  void note_scene_shown();
  [[nodiscard]] std::optional<sim::Twist> twist() const noexcept { return twist_; }
  [[nodiscard]] std::string columns() const;
  [[nodiscard]] MirrorReport report() const;

 private:
  /// The devices of the real robot that belong to those of this one.
  struct Binding {
    std::vector<std::optional<DeviceId>> commanded;  ///< the real device of each device's commands
    std::vector<std::optional<DeviceId>> feeds;      ///< the real device of each device's readings
    DeviceId pose{-1, -1};                           ///< device that tells the pose
    std::optional<DeviceId> motors;
    bool operator==(const Binding&) const = default;
  };

  /// @throws SessionError if the real robot has no device that tells its pose.
  [[nodiscard]] Binding bind(const Session& session) const;
  /// Opens a session again; the devices must be the same. @throws SessionError.
  [[nodiscard]] std::unique_ptr<Session> reopen() const;
  /// Subscribes to the bound devices and takes charge. @throws SessionError.
  [[nodiscard]] std::unique_ptr<RealLink> link(std::unique_ptr<Session> session,
                                               bool take_over) const;
  void warn_of_simulated() const;
  [[nodiscard]] std::optional<sim::Command> translated(const sim::Command& command) const;
  [[nodiscard]] static std::shared_ptr<const sim::PoseReading> pose_in(
      const sim::SharedReading& reading);
  void note_pose(const sim::PoseReading& reading);
  void note_scan(const sim::LaserReading& scan, WallClock::time_point at);
  [[nodiscard]] bool fits(int device, const sim::Reading& reading);
  /// Player port of the real robot.
  [[nodiscard]] int port() const noexcept {
    return real_.port == 0 ? description_.port : real_.port;
  }
  [[nodiscard]] sim::Pose pose() const { return simulation_.body(index_).X_WB; }

  sim::Simulation& simulation_;
  const int index_;
  const sim::RobotDescription& description_;
  const sim::RealRobotDescription real_;
  const std::vector<RobotInfo>& robots_;
  const OpenRealRobot open_;
  const Warn warn_;
  Binding binding_;
  std::vector<sim::SharedReading> newest_;  ///< by device; null: none from the real robot
  std::unique_ptr<RealLink> link_;
  std::unique_ptr<Reconnection> reconnection_;  ///< while the connection is lost
  std::uint64_t reconnections_ = 0;
  std::optional<int> laser_;  ///< first laser with real readings
  std::set<int> misfits_;     ///< devices with a warning of fits()
  std::string loss_;          ///< "": it is connected
  std::string last_loss_;     ///< also after a reconnection
  sim::SimTime lost_ns_ = 0;

  bool placed_ = false;
  bool pose_refused_ = false;
  std::optional<sim::Twist> twist_;
  std::shared_ptr<const sim::LaserReading> scan_;  ///< the newest one
  sim::Pose X_WL_scan_;                            ///< where it was made
  WallClock::time_point scan_at_{};
  bool scan_taken_ = false;  ///< by the window
  std::optional<WallClock::time_point> scan_in_window_;
  std::unique_ptr<Ghost> ghost_;
  bool ghost_placed_ = false;
  std::optional<MirrorLayers> layers_;

  std::uint64_t readings_ = 0;
  std::uint64_t poses_ = 0;
  Series latency_;
  Series screen_latency_;
  Series ghost_distance_;
  Series ghost_heading_;
  Series scan_mean_;
  Series scan_share_;
};

// --- Connecting

Mirror::Robot::Robot(sim::Simulation& simulation, const std::vector<RobotInfo>& robots, int index,
                     const OpenRealRobot& open, const Warn& warn)
    : simulation_(simulation),
      index_(index),
      description_(simulation.world().robots[static_cast<std::size_t>(index)]),
      real_(*description_.real),
      robots_(robots),
      open_(open),
      warn_(warn) {
  std::unique_ptr<Session> session = open_({real_.server, port()});
  binding_ = bind(*session);
  newest_.resize(binding_.feeds.size());
  link_ = link(std::move(session), real_.take_over);
  for (const DeviceInfo& device : robots[static_cast<std::size_t>(index)].devices) {
    if (device.type == "laser" && !laser_ && replaces(device.id.device)) {
      laser_ = device.id.device;
    }
  }
  const bool has_ghost = real_.drive == Drive::kBoth;
  if (has_ghost) {
    ghost_ = std::make_unique<Ghost>(simulation.world(), static_cast<std::size_t>(index));
  }
  layers_.emplace(simulation.layers(), description_.name, description_.port, has_ghost);
  warn_of_simulated();
  if (link_->watched()) return;
  warn_("the server of the real robot of " + description_.name + " at " + real_.server +
        " has no watchdog: if the network fails, the robot drives on");
}

std::unique_ptr<Session> Mirror::Robot::reopen() const {
  std::unique_ptr<Session> session = open_({real_.server, port(), Reconnection::kAttempt_s});
  if (!(bind(*session) == binding_)) {
    throw SessionError(SessionError::Code::kNotAvailable, "the robot has other devices now");
  }
  // The end of the run waits for an attempt to connect again.
  session->request(AnswerTimeoutRequest{Reconnection::kAttempt_s});
  return session;
}

std::unique_ptr<RealLink> Mirror::Robot::link(std::unique_ptr<Session> session,
                                              bool take_over) const {
  std::set<std::pair<int, int>> subscribed;
  const auto subscribe = [&](DeviceId device) {
    if (subscribed.insert({device.robot, device.device}).second) {
      session->request(SubscribeRequest{device});
    }
  };
  subscribe(binding_.pose);
  for (const auto& device : binding_.feeds) {
    if (device) subscribe(*device);
  }
  TakeChargeRequest charge{binding_.motors.value_or(binding_.pose), real_.watchdog_s, take_over,
                           name_of_mirror()};
  return std::make_unique<RealLink>(std::move(session), binding_.motors, std::move(charge));
}

// Binds devices that have an address in common. The list of addresses is in alphabetical order of
// interfaces; "localize" comes last, because it shows the same device as position2d.
Mirror::Robot::Binding Mirror::Robot::bind(const Session& session) const {
  const std::vector<RobotInfo>& real_robots = session.robots();
  const int real_port = session.port();
  const auto& devices = robots_[static_cast<std::size_t>(index_)].devices;
  Binding bound;
  bound.pose =
      find_interface(real_robots, real_port, real_.pose_interface, real_.pose_index).reading;
  bound.commanded.resize(devices.size());
  bound.feeds.resize(devices.size());
  const std::vector<InterfaceAddress> real = list_interfaces(real_robots, real_port);
  std::vector<InterfaceAddress> own = list_interfaces(robots_, description_.port);
  std::stable_partition(own.begin(), own.end(), [](const InterfaceAddress& address) {
    return address.interface != "localize";
  });
  for (const InterfaceAddress& address : own) {
    if (address.robot != description_.name) continue;
    const bool both = std::any_of(real.begin(), real.end(), [&](const InterfaceAddress& other) {
      return other.interface == address.interface && other.index == address.index;
    });
    if (!both) continue;
    const InterfaceBinding mine =
        find_interface(robots_, description_.port, address.interface, address.index);
    const InterfaceBinding its =
        find_interface(real_robots, real_port, address.interface, address.index);
    if (its.is_world() || its.reading.robot < 0) continue;
    const auto device = static_cast<std::size_t>(mine.reading.device);
    const bool is_sensor = simulation_.device(index_, mine.reading.device).sensor() != nullptr;
    if (is_sensor && !bound.feeds[device]) bound.feeds[device] = its.reading;
    if (!bound.commanded[device]) bound.commanded[device] = its.reading;
    if (address.interface != "position2d" || !mine.motion || !its.motion) continue;
    auto& motors = bound.commanded[static_cast<std::size_t>(mine.motion->device)];
    if (!motors) motors = *its.motion;
  }
  for (const DeviceInfo& device : devices) {
    if (device.type == "motion") {
      bound.motors = bound.commanded[static_cast<std::size_t>(device.id.device)];
    }
  }
  return bound;
}

void Mirror::Robot::warn_of_simulated() const {
  std::string names;
  for (const DeviceInfo& device : robots_[static_cast<std::size_t>(index_)].devices) {
    if (replaces(device.id.device) ||
        binding_.commanded[static_cast<std::size_t>(device.id.device)]) {
      continue;
    }
    names += (names.empty() ? "" : ", ") + device.name;
  }
  if (names.empty()) return;
  warn_("the real robot of " + description_.name + " at " + real_.server +
        " has no counterpart of: " + names + "; these devices stay simulated");
}

std::unique_ptr<Mirror> Mirror::open(sim::Simulation& simulation,
                                     const std::vector<RobotInfo>& robots,
                                     const OpenRealRobot& open, const Warn& warn) {
  const auto& described = simulation.world().robots;
  if (std::none_of(described.begin(), described.end(), [](const auto& r) { return r.real; })) {
    return nullptr;
  }
  std::unique_ptr<Mirror> mirror(new Mirror);
  std::vector<sim::ConfigIssue> issues;
  for (std::size_t i = 0; i < described.size(); ++i) {
    mirror->robots_.emplace_back();
    if (!described[i].real) continue;
    try {
      if (!open) {
        throw SessionError(SessionError::Code::kNotAvailable,
                           "this program has no way to connect to real robots");
      }
      mirror->robots_.back() =
          std::make_unique<Robot>(simulation, robots, static_cast<int>(i), open, warn);
    } catch (const SessionError& error) {
      const std::string& file = simulation.world().file;
      issues.push_back(
          {"run/real-robot", file.empty() ? simulation.world().name : file,
           "/robots/" + std::to_string(i) + "/real",
           "the real robot of " + described[i].name + " at " + described[i].real->server,
           error.what(), ""});
    }
  }
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
  return mirror;
}

Mirror::Mirror() = default;
Mirror::~Mirror() = default;

// --- Commands

std::optional<Mirror::Executed> Mirror::Robot::take_command(int device,
                                                            const sim::Command& command) {
  const sim::Device& simulated = simulation_.device(index_, device);
  const std::optional<DeviceId>& real = binding_.commanded[static_cast<std::size_t>(device)];
  if (!real && !moves_robot(simulated.type())) {
    if (ghost_ && loss_.empty()) ghost_->apply(device, command);
    return std::nullopt;
  }
  if (!simulation_.active({index_, device})) return simulation_.apply({index_, device}, command);
  if (!real) {
    return "robot " + description_.name +
           " mirrors a real robot, which has no counterpart of its " + simulated.type() + " " +
           simulated.name() + ": that device cannot move it";
  }
  if (!loss_.empty()) return loss_;
  const std::optional<sim::Command> sent = translated(command);
  if (!sent) {
    return "the command names a frame of robot " + description_.name +
           " that its real robot does not have";
  }
  if (ghost_) ghost_->apply(device, command);
  link_->send(*real, *sent);
  return Executed();
}

// Commands that name a frame: the real robot knows those of its own devices only.
std::optional<sim::Command> Mirror::Robot::translated(const sim::Command& command) const {
  const auto frame_of = [this](int frame) -> std::optional<int> {
    if (frame < 0) return binding_.pose.device;
    const auto device = static_cast<std::size_t>(frame);
    if (device >= binding_.feeds.size() || !binding_.feeds[device]) return std::nullopt;
    return binding_.feeds[device]->device;
  };
  if (const auto* heading = std::get_if<sim::HeadingCommand>(&command)) {
    const std::optional<int> frame = frame_of(heading->frame);
    if (!frame) return std::nullopt;
    sim::HeadingCommand sent = *heading;
    sent.frame = *frame;
    if (heading->frame < 0) sent.yaw_rad -= real_.X_WF.yaw_rad;
    return sent;
  }
  if (const auto* position = std::get_if<sim::PositionCommand>(&command)) {
    const std::optional<int> frame = frame_of(position->frame);
    if (!frame) return std::nullopt;
    sim::PositionCommand sent = *position;
    sent.frame = *frame;
    if (position->frame < 0) sent.goal = real_.X_WF.inverse() * position->goal;
    return sent;
  }
  return command;
}

void Mirror::Robot::halt() {
  if (ghost_) ghost_->stop();
  for (int i = 0; i < simulation_.device_count(index_); ++i) {
    const auto& motors = binding_.commanded[static_cast<std::size_t>(i)];
    if (motors && simulation_.device(index_, i).type() == "motion") {
      link_->send(*motors, sim::TwistCommand{});
    }
  }
}

// --- Readings

void Mirror::Robot::stop() noexcept {
  reconnection_.reset();
  link_->stop();
}

void Mirror::Robot::before_step(std::vector<Given>& given) {
  if (reconnection_) {
    std::unique_ptr<RealLink> link = reconnection_->take();
    if (!link) return;
    reconnection_.reset();
    link_ = std::move(link);
    loss_.clear();
    ++reconnections_;
    warn_("the connection to the real robot of " + description_.name + " is there again");
  }
  const std::vector<RealLink::Arrival> arrivals = link_->take();
  const auto now = WallClock::now();
  for (const RealLink::Arrival& arrival : arrivals) {
    ++readings_;
    latency_.add(seconds(now - arrival.at));
    // First the pose: a scan of the same round is drawn from there.
    if (!(arrival.device == binding_.pose)) continue;
    if (const auto pose = pose_in(arrival.reading)) {
      note_pose(*pose);
    } else if (!std::exchange(pose_refused_, true)) {
      warn_(address_text(real_.pose_interface, real_.pose_index) + " of the real robot of " +
            description_.name + " gives no poses, so " + description_.name + " stays where it is");
    }
  }
  for (const RealLink::Arrival& arrival : arrivals) {
    for (std::size_t i = 0; i < binding_.feeds.size(); ++i) {
      if (binding_.feeds[i] != arrival.device) continue;
      const auto device = static_cast<int>(i);
      if (!simulation_.active({index_, device})) continue;
      sim::SharedReading reading = arrival.reading;
      if (simulation_.device(index_, device).type() == "pose") {
        if (auto pose = pose_in(reading)) reading = std::move(pose);
      }
      if (!fits(device, *reading)) continue;
      newest_[i] = reading;
      given.emplace_back(DeviceId{index_, device}, reading);
      if (laser_ != device) continue;
      scan_ = std::dynamic_pointer_cast<const sim::LaserReading>(arrival.reading);
      if (scan_) note_scan(*scan_, arrival.at);
    }
  }
}

// The pose in a reading: measured, or the most likely one of a localisation.
std::shared_ptr<const sim::PoseReading> Mirror::Robot::pose_in(const sim::SharedReading& reading) {
  if (auto measured = std::dynamic_pointer_cast<const sim::PoseReading>(reading)) return measured;
  const auto* filtered = dynamic_cast<const sim::AmclReading*>(reading.get());
  if (filtered == nullptr || filtered->hypotheses.empty()) return nullptr;
  auto pose = std::make_shared<sim::PoseReading>();
  pose->time_ns = filtered->time_ns;
  pose->sequence = filtered->sequence;
  pose->pose = filtered->hypotheses.front().mean;
  return pose;
}

// Proxies expect the kind of reading that the simulated device makes.
bool Mirror::Robot::fits(int device, const sim::Reading& reading) {
  const sim::Device& simulated = simulation_.device(index_, device);
  const sim::Reading& expected = simulated.sensor()->reading();
  if (typeid(expected) == typeid(reading)) return true;
  if (misfits_.insert(device).second) {
    warn_("the real robot of " + description_.name + " gives other readings than its device " +
          simulated.name() + ", a " + simulated.type() + ": they are ignored");
  }
  return false;
}

void Mirror::Robot::note_pose(const sim::PoseReading& reading) {
  const sim::Pose X_WB = real_.X_WF * reading.pose;
  if (const auto refusal = simulation_.follow_real(index_, X_WB)) {
    if (!std::exchange(pose_refused_, true)) {
      warn_("the pose of the real robot of " + description_.name + " is invalid: " + *refusal);
    }
    return;
  }
  ++poses_;
  placed_ = true;
  twist_ = reading.twist;
  if (!ghost_) return;
  if (!ghost_placed_) {
    ghost_placed_ = ghost_->place(X_WB);
    if (!ghost_placed_) return;
  }
  const sim::Pose& X_WG = ghost_->pose();
  ghost_distance_.add((X_WB.position() - X_WG.position()).norm());
  ghost_heading_.add(std::abs(sim::normalize_angle(X_WB.yaw_rad - X_WG.yaw_rad)));
  layers_->add_distance(X_WB.position(), X_WG.position());
}

void Mirror::Robot::note_scan(const sim::LaserReading& scan, WallClock::time_point at) {
  const auto& laser = dynamic_cast<const sim::Laser&>(simulation_.device(index_, *laser_));
  X_WL_scan_ = pose() * laser.params().X_BL;
  scan_at_ = at;
  scan_taken_ = false;
  if (!placed_) return;  // nobody knows where it was made
  const auto predicted = simulation_.ideal_scan({index_, *laser_});
  const ScanDifference difference = compare_scans(scan, *predicted);
  if (difference.beams == 0) return;
  scan_mean_.add(difference.mean_m);
  scan_share_.add(difference.share);
  layers_->show_scan(difference, X_WL_scan_);
}

std::optional<Mirror::Loss> Mirror::Robot::after_step() {
  if (ghost_placed_) ghost_->step(simulation_.world());
  if (!loss_.empty()) return std::nullopt;
  if (link_->take_stopped()) {
    warn_("the server of the real robot of " + description_.name +
          " has stopped it, since it had heard nothing for " +
          sim::rounded_text(real_.watchdog_s, 3) + " s");
  }
  const std::optional<std::string> reason = link_->lost();
  if (!reason) return std::nullopt;
  lost_ns_ = simulation_.now_ns();
  loss_ = "the connection to the real robot of " + description_.name + " at " + real_.server +
          " is lost: " + *reason;
  twist_.reset();
  if (ghost_) ghost_->stop();
  last_loss_ = loss_;
  if (real_.on_lost == OnLost::kReconnect) {
    reconnection_ =
        std::make_unique<Reconnection>([this] { return link(reopen(), /*take_over=*/false); });
  }
  return Loss{index_, loss_, real_.on_lost == OnLost::kEnd, real_.on_lost == OnLost::kReconnect};
}

// --- Results

void Mirror::Robot::show(sim::SceneSnapshot& scene) const {
  sim::RobotSnapshot& shot = scene.robots[static_cast<std::size_t>(index_)];
  if (laser_) {
    shot.scan_points.clear();
    shot.scan_origin = X_WL_scan_.position();
  }
  if (scan_ && placed_ && loss_.empty()) {
    for (std::size_t beam = 0; beam < scan_->ranges_m.size(); ++beam) {
      const double angle = scan_->angle_min_rad + scan_->resolution_rad * static_cast<double>(beam);
      const double range_m = scan_->ranges_m[beam];
      if (!std::isfinite(range_m)) continue;
      shot.scan_points.push_back(X_WL_scan_ * (range_m * sim::unit_vector(angle)));
    }
  }
  if (!loss_.empty()) shot.says = "connection lost";
  if (ghost_placed_) scene.ghosts.push_back(ghost_->snapshot());
}

void Mirror::Robot::note_scene_taken() {
  if (!scan_ || std::exchange(scan_taken_, true)) return;
  scan_in_window_ = scan_at_;
}

void Mirror::Robot::note_scene_shown() {
  if (!scan_in_window_) return;
  screen_latency_.add(seconds(WallClock::now() - *scan_in_window_));
  scan_in_window_.reset();
}

std::string Mirror::Robot::columns() const {
  std::string line;
  const auto add = [&line](bool known, double value) {
    line += ',';
    if (known) line += sim::fixed_text(value, 6);
  };
  const sim::Pose X_WG = ghost_placed_ ? ghost_->pose() : sim::Pose{};
  for (const double value : {X_WG.x_m, X_WG.y_m, X_WG.yaw_rad}) add(ghost_placed_, value);
  add(ghost_distance_.count() > 0, ghost_distance_.last());
  add(scan_mean_.count() > 0, scan_mean_.last());
  add(scan_share_.count() > 0, scan_share_.last());
  return line;
}

MirrorReport Mirror::Robot::report() const {
  MirrorReport report;
  report.robot = description_.name;
  report.server = real_.server;
  report.drive = ghost_ ? "both" : "real";
  report.connected = loss_.empty();
  if (!last_loss_.empty()) report.lost = {sim::to_seconds(lost_ns_), last_loss_};
  report.reconnections = reconnections_;
  report.readings = readings_;
  report.poses = poses_;
  report.scans = scan_mean_.count();
  report.latency_s = latency_.report();
  report.screen_latency_s = screen_latency_.report();
  if (scan_mean_.count() > 0)
    report.scan_difference = {*scan_mean_.report(), *scan_share_.report()};
  if (ghost_distance_.count() > 0) {
    report.ghost = {*ghost_distance_.report(), ghost_distance_.last(), *ghost_heading_.report()};
  }
  return report;
}

// --- All robots

Mirror::Robot* Mirror::robot_at(int robot) const {
  return robots_[static_cast<std::size_t>(robot)].get();
}

std::optional<Mirror::Executed> Mirror::take_command(DeviceId device, const sim::Command& command) {
  Robot* const robot = robot_at(device.robot);
  return robot == nullptr ? std::nullopt : robot->take_command(device.device, command);
}

void Mirror::before_step() {
  given_.clear();
  for (const auto& robot : robots_) {
    if (robot) robot->before_step(given_);
  }
}

std::vector<Mirror::Loss> Mirror::after_step() {
  std::vector<Loss> losses;
  for (const auto& robot : robots_) {
    if (!robot) continue;
    if (auto loss = robot->after_step()) losses.push_back(*std::move(loss));
  }
  return losses;
}

void Mirror::halt() {
  for (const auto& robot : robots_) {
    if (robot) robot->halt();
  }
}

void Mirror::halt(int robot) {
  if (Robot* const mirrored = robot_at(robot)) mirrored->halt();
}

void Mirror::stop() noexcept {
  for (const auto& robot : robots_) {
    if (robot) robot->stop();
  }
}

bool Mirror::has_lost(int robot) const {
  const Robot* const mirrored = robot_at(robot);
  return mirrored != nullptr && !mirrored->loss().empty();
}

sim::SharedReading Mirror::newest(DeviceId device) const {
  return robot_at(device.robot)->newest(device.device);
}

bool Mirror::replaces(DeviceId device) const {
  const Robot* const robot = robot_at(device.robot);
  return robot != nullptr && robot->replaces(device.device);
}

const std::string& Mirror::loss_of(DeviceId device) const {
  static const std::string kNone;
  const bool waits_in_vain = replaces(device) && robot_at(device.robot)->lost_for_good();
  return waits_in_vain ? robot_at(device.robot)->loss() : kNone;
}

std::vector<RealMotors> Mirror::motors() const {
  std::vector<RealMotors> all;
  for (const auto& robot : robots_) {
    if (const auto motors = robot ? robot->motors() : std::nullopt) all.push_back(*motors);
  }
  return all;
}

void Mirror::show(sim::SceneSnapshot& scene) const {
  for (const auto& robot : robots_) {
    if (robot) robot->show(scene);
  }
}

void Mirror::note_scene_taken() {
  for (const auto& robot : robots_) {
    if (robot) robot->note_scene_taken();
  }
}

void Mirror::note_scene_shown() {
  for (const auto& robot : robots_) {
    if (robot) robot->note_scene_shown();
  }
}

std::optional<sim::Twist> Mirror::twist_of(std::size_t robot) const {
  return robots_[robot] ? robots_[robot]->twist() : std::nullopt;
}

const char* Mirror::column_names() noexcept {
  return ",ghost_x,ghost_y,ghost_yaw,ghost_distance,scan_difference,scan_difference_share";
}

std::string Mirror::columns(std::size_t robot) const {
  return robots_[robot] ? robots_[robot]->columns() : ",,,,,,";
}

std::vector<MirrorReport> Mirror::report() const {
  std::vector<MirrorReport> all;
  for (const auto& robot : robots_) {
    if (robot) all.push_back(robot->report());
  }
  return all;
}

}  // namespace playerlike
