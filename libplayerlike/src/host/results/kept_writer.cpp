// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/kept_writer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "sim/devices/laser.h"

namespace playerlike {
namespace {

using nlohmann::json;

json to_json(const sim::Vec2& p) { return {p.x(), p.y()}; }
json to_json(const sim::Pose& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }
json to_json(const sim::Colour& c) { return {c.r, c.g, c.b, c.a}; }
json to_json(const std::optional<sim::Colour>& c) { return c ? to_json(*c) : json(nullptr); }

json to_json(const std::vector<sim::Vec2>& points) {
  json all = json::array();
  for (const sim::Vec2& p : points) all.push_back(to_json(p));
  return all;
}

/// The appearance of a robot's devices in pictures, except for its laser.
json looks_of(const sim::RobotSnapshot& robot) {
  json looks = {{"says", robot.says}};
  for (const sim::LightSnapshot& light : robot.lights) {
    looks["lights"].push_back({to_json(light.p_BL), to_json(light.colour), light.lit});
  }
  for (const sim::ConeSnapshot& cone : robot.cones) {
    looks["cones"].push_back({to_json(cone.X_WS), cone.range_m, cone.field_of_view_rad, cone.met});
  }
  for (const sim::BumperSnapshot& bumper : robot.bumpers) {
    looks["bumpers"].push_back({to_json(bumper.line), bumper.pressed});
  }
  for (const auto& [from, to] : robot.sights) {
    looks["sights"].push_back({to_json(from), to_json(to)});
  }
  for (const sim::Polygon& paddle : robot.paddles) {
    looks["paddles"].push_back(to_json(paddle));
  }
  for (const std::vector<sim::Vec2>& arm : robot.arms) looks["arms"].push_back(to_json(arm));
  return looks;
}

json looks_of(const sim::ObstacleDescription& o) {
  return {to_json(o.center),         to_json(o.size),   o.yaw_rad,   o.height_m,
          static_cast<int>(o.state), to_json(o.colour), o.carried_by};
}

}  // namespace

std::unique_ptr<KeptWriter> KeptWriter::open(const std::string& file) {
  if (file.empty()) return nullptr;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  struct stat info {};
  void* memory = MAP_FAILED;
  std::size_t size = 0;
  if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
      info.st_size >= static_cast<off_t>(kKeptHeaderSize)) {
    size = static_cast<std::size_t>(info.st_size);
    memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  close(descriptor);
  if (memory == MAP_FAILED) return nullptr;
  auto* const header = static_cast<KeptHeader*>(memory);
  // A program may start other programs that simulate too. The memory holds one run at a time.
  std::int32_t owner = header->process;
  const bool done = header->phase == static_cast<std::uint32_t>(KeptRun::Phase::kDone);
  const bool is_free = owner == 0 || done || (kill(owner, 0) != 0 && errno == ESRCH);
  if (header->magic != kKeptMagic || !is_free ||
      !header->process.compare_exchange_strong(owner, getpid())) {
    munmap(memory, size);
    return nullptr;
  }
  header->noted = 0;
  header->made_steps = 0;
  header->now_ns = 0;
  header->robots = 0;
  header->report = 0;
  header->scene = 0;
  header->phase = static_cast<std::uint32_t>(KeptRun::Phase::kRunning);
  return std::unique_ptr<KeptWriter>(new KeptWriter(header, size));
}

// The header stays mapped, since a signal handler may write to it at any time.
KeptWriter::~KeptWriter() {
  if (size_ > kKeptHeaderSize) munmap(at<std::byte>(kKeptHeaderSize), size_ - kKeptHeaderSize);
}

void KeptWriter::set_phase(KeptRun::Phase phase) noexcept {
  header_->phase = static_cast<std::uint32_t>(phase);
}

std::uint64_t KeptWriter::allocate(std::uint64_t size) noexcept {
  constexpr std::uint64_t kAlignment = 64;
  const std::uint64_t place = (used_ + kAlignment - 1) / kAlignment * kAlignment;
  if (size > size_ || place > size_ - size) return 0;
  used_ = place + size;
  return place;
}

void KeptWriter::begin(const sim::Simulation& simulation) {
  begun_ = true;
  const auto robots = static_cast<std::size_t>(simulation.robot_count());
  for (std::uint64_t& place : header_->steps) {
    place = allocate(sizeof(KeptStep) + robots * sizeof(KeptRobot));
  }
  header_->trails = allocate(robots * kMostTrailPoints * 2 * sizeof(double));
  header_->scans = allocate(robots * 2 * sizeof(KeptScan));
  if (robots == 0 || header_->steps[0] == 0 || header_->steps[1] == 0 || header_->trails == 0 ||
      header_->scans == 0) {
    return;
  }
  trail_points_.assign(robots, 0);
  scan_sequences_.assign(robots, 0);
  lasers_.assign(robots, -1);
  for (std::size_t i = 0; i < robots; ++i) {
    const int robot = static_cast<int>(i);
    for (int device = 0; device < simulation.device_count(robot) && lasers_[i] < 0; ++device) {
      if (dynamic_cast<const sim::Laser*>(&simulation.device(robot, device)) != nullptr) {
        lasers_[i] = device;
      }
    }
    for (const std::uint64_t place : header_->steps) {
      at<KeptRobot>(place + sizeof(KeptStep))[i] = KeptRobot{};
    }
  }
  revision_ = simulation.layers().revision() + 1;  // so that the first step stores the layers
  header_->robots = static_cast<std::uint32_t>(robots);
}

namespace {

void keep_achievements(const Recorder& recorder, std::size_t robot, KeptRobot& kept) {
  if (const TravelMeter* const travel = recorder.travel(robot)) {
    kept.distance_m = travel->distance_m();
    kept.visited_area_m2 = travel->visited_area_m2();
  }
  if (recorder.commands() == nullptr) return;
  const CommandBook::Entry& entry = recorder.commands()->of(robot);
  kept.commands = entry.count;
  kept.first_command_ns = entry.first_ns.value_or(0);
  std::size_t ports = 0;
  for (const int port : entry.ports) {
    if (ports < kept.ports.size()) kept.ports.at(ports++) = port;
  }
}

}  // namespace

void KeptWriter::keep_step(const TimeStatistics& time, const Recorder& recorder,
                           sim::Simulation& simulation) {
  if (!begun_) begin(simulation);
  header_->made_steps = simulation.steps();
  header_->now_ns = simulation.now_ns();
  if (lasers_.empty()) return;
  keep_cells(simulation);
  const std::uint32_t next = 1 - std::min<std::uint32_t>(header_->step, 1);
  KeptStep& step = *at<KeptStep>(header_->steps[next]);
  step = {simulation.steps(), simulation.now_ns(), time.wall_time_s, time.real_time_factor};
  auto* const robots = at<KeptRobot>(header_->steps[next] + sizeof(KeptStep));
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    const int robot = static_cast<int>(i);
    const sim::RobotStatistics& statistics = simulation.statistics(robot);
    const sim::BodyState& body = simulation.body(robot);
    KeptRobot& kept = robots[i];
    kept.path_length_m = statistics.path_length_m;
    kept.least_clearance_m = statistics.least_clearance_m;
    kept.stalled_time_s = statistics.stalled_time_s;
    kept.driven_time_s = recorder.driven_time_s(i).value_or(0.0);
    keep_achievements(recorder, i, kept);
    kept.collisions = statistics.collisions;
    kept.x_m = body.X_WB.x_m;
    kept.y_m = body.X_WB.y_m;
    kept.yaw_rad = body.X_WB.yaw_rad;
    kept.stalled = body.stalled ? 1 : 0;
    kept.forward_mps = body.twist.v_mps;
    kept.left_mps = body.twist.lateral_mps;
    kept.turn_radps = body.twist.omega_radps;
    keep_trail(i, recorder.trail(i), kept);
    kept.scan = at<KeptRobot>(header_->steps[1 - next] + sizeof(KeptStep))[i].scan;
    keep_scan(i, simulation, kept);
  }
  header_->step.store(next, std::memory_order_release);
}

void KeptWriter::keep_trail(std::size_t robot, const std::vector<sim::Vec2>& points,
                            KeptRobot& kept) {
  auto* const to = at<double>(header_->trails) + robot * kMostTrailPoints * 2;
  const std::size_t count = std::min(points.size(), kMostTrailPoints);
  std::size_t& done = trail_points_[robot];
  if (count < done) done = 0;  // the trail was thinned
  for (; done < count; ++done) {
    to[2 * done] = points[done].x();
    to[2 * done + 1] = points[done].y();
  }
  kept.trail_points = static_cast<std::uint32_t>(count);
}

void KeptWriter::keep_scan(std::size_t robot, const sim::Simulation& simulation, KeptRobot& kept) {
  if (lasers_[robot] < 0) return;
  const auto& laser =
      static_cast<const sim::Laser&>(simulation.device(static_cast<int>(robot), lasers_[robot]));
  const sim::LaserReading& reading = laser.reading();
  if (reading.sequence == scan_sequences_[robot]) return;
  scan_sequences_[robot] = reading.sequence;
  const std::uint32_t next = kept.scan == 1 ? 1 : 0;
  KeptScan& scan = at<KeptScan>(header_->scans)[robot * 2 + next];
  const sim::Pose X_WL = reading.X_WB * laser.params().X_BL;
  scan.x_m = X_WL.x_m;
  scan.y_m = X_WL.y_m;
  scan.yaw_rad = X_WL.yaw_rad;
  scan.angle_min_rad = reading.angle_min_rad;
  scan.resolution_rad = reading.resolution_rad;
  scan.count = std::min(reading.ranges_m.size(), kMostKeptBeams);
  std::copy_n(reading.ranges_m.begin(), scan.count, scan.ranges_m.begin());
  kept.scan = next + 1;
}

// Assigns memory to each layer, and copies all cells of layers with new memory.
void KeptWriter::place_layers(const sim::LayerStack& layers) {
  for (const auto& [layer, cells] : cells_) free_cells_.push_back(cells);
  cells_.clear();
  for (const sim::LayerInfo& info : layers.layers()) {
    const std::span<const std::uint8_t> bytes = layers.bytes(info.id);
    const auto room = std::find_if(free_cells_.begin(), free_cells_.end(),
                                   [&](const Cells& c) { return c.size >= bytes.size(); });
    Cells cells{0, bytes.size()};
    if (room != free_cells_.end()) {
      cells = *room;
      free_cells_.erase(room);
    } else {
      cells.place = allocate(bytes.size());
    }
    if (cells.place == 0) continue;  // too large to store
    std::memcpy(at<std::byte>(cells.place), bytes.data(), bytes.size());
    cells_[info.id] = cells;
  }
}

void KeptWriter::keep_cells(sim::Simulation& simulation) {
  sim::LayerStack& layers = simulation.layers();
  const std::size_t row_size = static_cast<std::size_t>(layers.width()) * sizeof(sim::CellValue);
  if (layers.revision() != revision_) {
    revision_ = layers.revision();
    place_layers(layers);
    keep_scene(simulation);
  }
  layers.take_written([&](sim::LayerId layer, const sim::CellRect& rect) {
    const auto found = cells_.find(layer);
    if (found == cells_.end()) return;
    const std::span<const std::uint8_t> bytes = layers.bytes(layer);
    for (int row = rect.row; row < rect.row + rect.height; ++row) {
      const std::size_t first = static_cast<std::size_t>(row) * row_size +
                                static_cast<std::size_t>(rect.column) * sizeof(sim::CellValue);
      std::memcpy(at<std::byte>(found->second.place + first), bytes.data() + first,
                  static_cast<std::size_t>(rect.width) * sizeof(sim::CellValue));
    }
  });
}

void KeptWriter::keep_looks(const std::string& report, const sim::Simulation& simulation) {
  if (!begun_) begin(simulation);
  keep_text(header_->report, report_, report);
  if (!lasers_.empty()) keep_scene(simulation);
}

void KeptWriter::keep_motors(const std::vector<RealMotors>& motors) {
  json list = json::array();
  for (const RealMotors& one : motors) {
    list.push_back({one.robot, one.server, one.port, one.device.robot, one.device.device});
  }
  keep_text(header_->motors, motors_, list.dump(-1, ' ', false, json::error_handler_t::replace));
}

void KeptWriter::keep_scene(const sim::Simulation& simulation) {
  const sim::LayerStack& stack = simulation.layers();
  json layers = json::array();
  for (const sim::LayerInfo& info : stack.layers()) {
    const auto cells = cells_.find(info.id);
    layers.push_back({{"id", info.id},
                      {"kind", static_cast<int>(info.kind)},
                      {"owner", info.owner},
                      {"name", info.style.name},
                      {"colour", to_json(info.style.colour)},
                      {"transparency", info.style.transparency},
                      {"transparent_colour", to_json(info.style.transparent_colour)},
                      {"priority", info.style.priority},
                      {"visible", info.style.visible},
                      {"cells", cells == cells_.end() ? 0 : cells->second.place}});
  }
  json obstacles = json::array();
  for (const auto& o : simulation.world().arena.obstacles) obstacles.push_back(looks_of(o));
  json robots = json::array();
  for (int i = 0; i < simulation.robot_count(); ++i) {
    robots.push_back(looks_of(simulation.robot_snapshot(i)));
  }
  const json scene = {{"view_mode", static_cast<int>(simulation.view_mode())},
                      {"width", stack.width()},
                      {"height", stack.height()},
                      {"layers", std::move(layers)},
                      {"obstacles", std::move(obstacles)},
                      {"robots", std::move(robots)}};
  keep_text(header_->scene, scene_, scene.dump(-1, ' ', false, json::error_handler_t::replace));
}

void KeptWriter::keep_text(std::atomic<std::uint64_t>& where, Text& text,
                           const std::string& content) {
  std::uint64_t& place = text.places.at(text.next);
  std::uint64_t& room = text.sizes.at(text.next);
  if (content.size() > room) {
    room = std::max<std::uint64_t>(4096, 2 * content.size());
    place = allocate(room);
    if (place == 0) room = 0;
  }
  if (place == 0) return;
  std::memcpy(at<char>(place), content.data(), content.size());
  where.store(kept_text(place, content.size()), std::memory_order_release);
  text.next = 1 - text.next;
}

}  // namespace playerlike
