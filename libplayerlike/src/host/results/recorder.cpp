// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/recorder.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "host/results/kept_layout.h"
#include "host/results/outputs.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

constexpr sim::SimTime kRowPeriod_ns = sim::kNanosecondsPerSecond / 10;

}  // namespace

Recorder::Recorder(const RunSettings& settings, const sim::Simulation& simulation,
                   const Mirror* mirror, const CommandBook* commands)
    : mirror_(mirror),
      commands_(commands),
      active_(!settings.output_folder.empty() || !settings.film.empty()) {
  const fs::path folder(settings.output_folder);
  next_row_ns_ = simulation.now_ns();
  if (!settings.output_folder.empty()) {
    trajectory_file_ = (folder / "trajectory.csv").string();
    trajectory_.open(trajectory_file_, std::ios::trunc);
    if (!trajectory_) throw std::runtime_error("cannot write " + trajectory_file_);
    write_to_trajectory("time,robot,x,y,yaw,v,omega,stalled" +
                            std::string(mirror_ != nullptr ? Mirror::column_names() : "") + '\n',
                        0);
  }
  std::unique_ptr<sim::render::FilmWriter> film;
  if (!settings.film.empty()) {
    film = std::make_unique<sim::render::FilmWriter>(settings.film, settings.film_fps);
    film_clock_ = Clock(settings.film_speed / settings.film_fps,
                        std::max(settings.film_from_s, sim::to_seconds(simulation.now_ns())));
    film_begin_s_ = settings.film_from_s;
  }
  if (settings.snapshot_period_s && !settings.output_folder.empty()) {
    snapshot_folder_ = (folder / kSnapshotFolder).string();
    remove_snapshots(settings.output_folder);
    fs::create_directories(snapshot_folder_);
    snapshot_clock_ = Clock(*settings.snapshot_period_s);
  }
  if (film || !snapshot_folder_.empty()) {
    pictures_ =
        std::make_unique<PictureThread>(std::move(film), settings.film_limit, settings.pictures);
  }
  trails_.resize(static_cast<std::size_t>(simulation.robot_count()));
  if (const auto robot = simulation.find_robot(settings.grading.rules.seen_by)) {
    seen_floor_.emplace(simulation, *robot);
  }
  observe(simulation);
}

std::uint64_t Recorder::Clock::due(sim::SimTime now_ns) {
  if (period_s_ <= 0.0) return 0;
  // The tolerance covers rounding errors; it is far smaller than a step.
  const double periods = (sim::to_seconds(now_ns) - from_s_) / period_s_ * (1.0 + 1e-12) + 1e-9;
  if (periods < 0.0) return 0;
  const std::uint64_t past = static_cast<std::uint64_t>(periods) + 1;
  const std::uint64_t count = past - std::min(reported_, past);
  reported_ = past;
  return count;
}

std::string Recorder::picture_file(sim::SimTime now_ns) const {
  constexpr std::size_t kDigits = 10;  // leading zeros make the names sort by time
  const std::string time = sim::fixed_text(sim::to_seconds(now_ns), 3);
  const std::string zeros(kDigits - std::min(kDigits, time.size()), '0');
  return (fs::path(snapshot_folder_) / ("scene_" + zeros + time + "s.png")).string();
}

void Recorder::observe(const sim::Simulation& simulation) {
  if (!active_) return;
  const sim::SimTime now_ns = simulation.now_ns();
  extend_trails(simulation);
  if (seen_floor_) seen_floor_->observe(simulation);
  goals_.observe(simulation);
  if (trajectory_.is_open() && now_ns >= next_row_ns_) {
    next_row_ns_ += kRowPeriod_ns;
    write_to_trajectory(rows(simulation), now_ns);
  }
  if (!pictures_) return;
  // A step that is longer than a frame's period fills several frames.
  const auto frames = static_cast<int>(film_clock_.due(now_ns));
  const bool picture = snapshot_clock_.due(now_ns) > 0;
  if (frames == 0 && !picture) return;
  if (frames > 0) film_begin_s_.reset();
  pictures_->add({.scene = scene(simulation),
                  .film_frames = frames,
                  .picture = picture ? picture_file(now_ns) : std::string()});
}

void Recorder::extend_trails(const sim::Simulation& simulation) {
  const sim::SimTime step_ns = simulation.world().simulation.step_ns;
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    Trail& trail = trails_[i];
    const sim::BodyState& body = simulation.body(static_cast<int>(i));
    if (body.commanded != sim::Twist{}) trail.driven_ns += step_ns;
    const sim::Vec2 p = body.X_WB.position();
    trail.travel.observe(p, simulation.statistics(static_cast<int>(i)).path_length_m);
    if (!trail.points.empty() && (p - trail.points.back()).norm() < trail.spacing_m) continue;
    trail.points.push_back(p);
    if (trail.points.size() < kMostTrailPoints) continue;
    for (std::size_t k = 0; 2 * k < trail.points.size(); ++k) trail.points[k] = trail.points[2 * k];
    trail.points.resize((trail.points.size() + 1) / 2);
    trail.spacing_m *= 2.0;
  }
}

std::string Recorder::rows(const sim::Simulation& simulation) const {
  std::string all;
  const std::string time = sim::fixed_text(sim::to_seconds(simulation.now_ns()), 3);
  for (int i = 0; i < simulation.robot_count(); ++i) {
    const sim::BodyState& body = simulation.body(i);
    // The world reader refuses commas in robot names.
    std::string line = time + ',' + simulation.world().robots[static_cast<std::size_t>(i)].name;
    sim::Twist twist = body.twist;
    if (mirror_ != nullptr) twist = mirror_->twist_of(static_cast<std::size_t>(i)).value_or(twist);
    for (const double value :
         {body.X_WB.x_m, body.X_WB.y_m, body.X_WB.yaw_rad, twist.v_mps, twist.omega_radps}) {
      line += ',' + sim::fixed_text(value, 6);
    }
    line += body.stalled ? ",1" : ",0";
    if (mirror_ != nullptr) line += mirror_->columns(static_cast<std::size_t>(i));
    all += line + '\n';
  }
  return all;
}

void Recorder::write_to_trajectory(const std::string& rows, sim::SimTime now_ns) {
  if (!trajectory_problem_.empty()) return;
  errno = 0;
  trajectory_ << rows;
  trajectory_.flush();  // the program may be killed at any time
  if (trajectory_) {
    trajectory_size_ += rows.size();
    return;
  }
  const int error = errno != 0 ? errno : EIO;
  trajectory_problem_ = trajectory_file_ + " ends before " +
                        sim::fixed_text(sim::to_seconds(now_ns), 2) + " s: " + std::strerror(error);
}

sim::SceneSnapshot Recorder::scene(const sim::Simulation& simulation, bool with_canvas) const {
  sim::SceneSnapshot snapshot = simulation.snapshot(with_canvas);
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    snapshot.robots[i].trail = trails_[i].points;
    if (!trails_[i].points.empty()) {
      snapshot.robots[i].trail.push_back(snapshot.robots[i].X_WB.position());
    }
  }
  for (const sim::Collision& collision : simulation.collisions()) {
    snapshot.collisions.push_back(
        {collision.robot, collision.place, sim::to_seconds(collision.time_ns)});
  }
  snapshot.goals = goals_.marks();
  if (mirror_ != nullptr) mirror_->show(snapshot);
  return snapshot;
}

void Recorder::close_trajectory() {
  if (!trajectory_.is_open()) return;
  trajectory_.close();
  if (trajectory_problem_.empty()) return;
  std::error_code ignored;  // otherwise, half a row remains
  fs::resize_file(trajectory_file_, trajectory_size_, ignored);
  throw std::runtime_error(trajectory_problem_);
}

void Recorder::close_film() {
  // The thread is released even if finish() throws; a second call does nothing.
  const std::unique_ptr<PictureThread> pictures = std::move(pictures_);
  if (pictures) pictures->finish();
  if (!pictures || !film_begin_s_) return;
  throw std::runtime_error("no film was recorded: the run ended before the film's start at " +
                           sim::shortest_text(*film_begin_s_) + " s (--record-from)");
}

}  // namespace playerlike
