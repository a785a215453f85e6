// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/recorder.h"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace playerlike {
namespace {

constexpr sim::SimTime kRowPeriod_ns = sim::kNanosecondsPerSecond / 10;
constexpr double kFramesPerSecond = 25.0;
constexpr sim::SimTime kFramePeriod_ns = sim::kNanosecondsPerSecond / 25;
constexpr int kFilmSize_px = 800;
// A trail that reaches this many points is thinned to every other one.
constexpr std::size_t kMaxTrailPoints = 8192;

}  // namespace

Recorder::Recorder(const std::string& trajectory_file, const std::string& film_file,
                   const sim::Simulation& simulation)
    : active_(!trajectory_file.empty() || !film_file.empty()), trajectory_file_(trajectory_file) {
  if (!trajectory_file.empty()) {
    trajectory_.open(trajectory_file, std::ios::trunc);
    if (!trajectory_) throw std::runtime_error("cannot write " + trajectory_file);
    trajectory_ << "time,robot,x,y,yaw,v,omega,stalled\n";
  }
  if (!film_file.empty()) {
    film_ = std::make_unique<sim::render::FilmWriter>(film_file, kFramesPerSecond);
  }
  trails_.resize(static_cast<std::size_t>(simulation.robot_count()));
  observe(simulation);
}

void Recorder::observe(const sim::Simulation& simulation) {
  if (!active_) return;
  const sim::SimTime now_ns = simulation.now_ns();
  extend_trails(simulation);
  if (trajectory_.is_open() && now_ns >= next_row_ns_) {
    next_row_ns_ += kRowPeriod_ns;
    write_rows(simulation);
  }
  if (film_ && now_ns >= next_frame_ns_) {
    const sim::render::Image frame =
        sim::render::draw_scene(scene(simulation), {.size_px = kFilmSize_px});
    // A step longer than a frame's time fills more than one frame.
    for (; now_ns >= next_frame_ns_; next_frame_ns_ += kFramePeriod_ns) film_->add(frame);
  }
}

void Recorder::extend_trails(const sim::Simulation& simulation) {
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    Trail& trail = trails_[i];
    const sim::Vec2 p = simulation.body(static_cast<int>(i)).X_WB.position();
    if (!trail.points.empty() && (p - trail.points.back()).norm() < trail.spacing_m) continue;
    trail.points.push_back(p);
    if (trail.points.size() < kMaxTrailPoints) continue;
    for (std::size_t k = 0; 2 * k < trail.points.size(); ++k) trail.points[k] = trail.points[2 * k];
    trail.points.resize((trail.points.size() + 1) / 2);
    trail.spacing_m *= 2.0;
  }
}

void Recorder::write_rows(const sim::Simulation& simulation) {
  for (int i = 0; i < simulation.robot_count(); ++i) {
    const sim::BodyState& body = simulation.body(i);
    std::array<char, 256> line{};
    // Robot names hold no comma (the world reader sees to it).
    std::snprintf(line.data(), line.size(), ",%.6f,%.6f,%.6f,%.6f,%.6f,%d\n", body.X_WB.x_m,
                  body.X_WB.y_m, body.X_WB.yaw_rad, body.twist.v_mps, body.twist.omega_radps,
                  body.stalled ? 1 : 0);
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.3f,", sim::to_seconds(simulation.now_ns()));
    trajectory_ << time.data() << simulation.world().robots[static_cast<std::size_t>(i)].name
                << line.data();
  }
}

sim::SceneSnapshot Recorder::scene(const sim::Simulation& simulation) const {
  sim::SceneSnapshot snapshot = simulation.snapshot();
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    snapshot.robots[i].trail = trails_[i].points;
    if (!trails_[i].points.empty()) {
      snapshot.robots[i].trail.push_back(snapshot.robots[i].X_WB.position());
    }
  }
  return snapshot;
}

void Recorder::close() {
  film_.reset();
  if (!trajectory_.is_open()) return;
  trajectory_.close();
  if (trajectory_.fail()) throw std::runtime_error("cannot write " + trajectory_file_);
}

}  // namespace playerlike
