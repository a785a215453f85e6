// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Robots of real Stage and their rangers, for the programs of this folder that link libstage.
#pragma once

#include <pthread.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <stage.hh>
#include <vector>

namespace interop {

using Stg::Model;
using Stg::ModelPosition;
using Stg::ModelRanger;
using Stg::Pose;

/// A robot with its rangers, in the order in which Player gives them their indices; some may have
/// no sensor.
struct Robot {
  ModelPosition* body;
  std::vector<ModelRanger*> rangers;
};

inline void find_rangers(Model* model, std::vector<ModelRanger*>& found) {
  for (Model* child : model->GetChildren()) {
    auto* ranger = dynamic_cast<ModelRanger*>(child);
    if (ranger != nullptr) found.push_back(ranger);
    find_rangers(child, found);
  }
}

/// Whether a robot has a ranger with a sensor.
inline bool sees(const Robot& robot) {
  return std::any_of(robot.rangers.begin(), robot.rangers.end(),
                     [](ModelRanger* ranger) { return !ranger->GetSensors().empty(); });
}

/// @param blind_ones  also those without rangers.
inline std::vector<Robot> find_robots(Stg::World& world, bool blind_ones = false) {
  std::vector<Robot> robots;
  for (Model* model : world.GetAllModels()) {
    auto* body = dynamic_cast<ModelPosition*>(model);
    if (body == nullptr || dynamic_cast<ModelPosition*>(body->Parent()) != nullptr) continue;
    Robot robot{body, {}};
    find_rangers(body, robot.rangers);
    if (blind_ones || sees(robot)) robots.push_back(robot);
  }
  // The set of models is ordered by address.
  std::sort(robots.begin(), robots.end(),
            [](const Robot& a, const Robot& b) { return a.body->GetId() < b.body->GetId(); });
  return robots;
}

/// Advances simulated time until all rangers have measured from the present pose: they do so every
/// 100 ms, unless the world says otherwise.
inline void measure(Stg::World& world) {
  const Stg::usec_t until = world.SimTimeNow() + 300000;
  int updates = 0;
  for (; updates < 4 || world.SimTimeNow() < until; ++updates) world.Update();
}

/// Angle of a beam from the middle of a sensor's field of view.
inline double bearing(const ModelRanger::Sensor& sensor, std::size_t beam) {
  if (sensor.ranges.size() < 2) return 0.0;
  const double beams = static_cast<double>(sensor.ranges.size());
  return sensor.fov * (static_cast<double>(beam) / (beams - 1.0) - 0.5);
}

/// Subscribes to all of a robot and switches the noise off.
inline void switch_on(Robot& robot) {
  robot.body->Subscribe();
  for (ModelRanger* ranger : robot.rangers) {
    ranger->Subscribe();
    for (auto& sensor : ranger->GetSensorsMutable()) {
      sensor.angle_noise = sensor.range_noise = sensor.range_noise_const = 0.0;
    }
  }
}

/// Updates all models in the caller's thread: a worker per update takes most of the time, and races
/// with the robots' moves. Call it after World::Load(), in a program without access control and
/// with the pthread_create() below.
inline void run_alone(Stg::World& world) {
  world.worker_threads = 0;
  for (Model* model : world.GetAllModels()) model->event_queue_num = 0;
  for (std::size_t i = 1; i < world.event_queues.size(); ++i) {
    for (; !world.event_queues[i].empty(); world.event_queues[i].pop()) {
      world.event_queues[0].push(world.event_queues[i].top());
    }
  }
}

/// Loads a world and starts it without Stage's threads; std::cout is as before. Stage writes about
/// its progress to the standard output. @return whether Stage can load it.
inline bool start(Stg::World& world, const char* path) {
  std::streambuf* const out = std::cout.rdbuf();
  if (!world.Load(path)) return false;
  run_alone(world);
  world.Start();
  std::cout.rdbuf(out);
  std::cout.precision(9);
  return true;
}

}  // namespace interop

/// Takes the place of the C library's: Stage starts its workers with it, and they must not exist.
extern "C" int pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) {
  return 0;
}
