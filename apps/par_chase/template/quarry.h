// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_CHASE_QUARRY_H
#define PAR_CHASE_QUARRY_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "imr-h/logging.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// The fox: the program of the other robot. It is part of the task, so do not change it.
//
// The fox drives along the corridors, from one junction to the next. At each junction it chooses
// the next one at random, but does not turn back unless it is in a dead end. It never rests, and
// does not look out for the other robot. The noise of its first scan, which follows the run's seed,
// decides the sequence of random numbers, so equal runs have equal foxes.
class CQuarry : public imr::concurrent::CThread {
 public:
  CQuarry(const std::string& host, unsigned port)
      : client(new CCMorse::PlayerClient(host, port)),
        position(new CCMorse::Position2dProxy(client.get(), 0)),
        laser(new CCMorse::LaserProxy(client.get(), 0)) {
    // A client takes part in the run from its first Read() on.
    while (!position->IsFresh() || !laser->IsFresh()) client->Read();
    double sum = 0.0;
    for (unsigned i = 0; i < laser->GetCount(); i++) sum += (*laser)[i];
    random.seed(static_cast<std::uint32_t>(std::llround(sum * 1e6) % 1000000007));
  }

  ~CQuarry() {
    stop();
    join();
  }

  // Asks the thread to end after its next Read(). Any thread may call this.
  void stop() {
    const ScopedLock lk(mtx);
    quit = true;
  }

 protected:
  void threadBody() override {
    try {
      run();
    } catch (const CCMorse::MorseError& e) {
      DEBUG("The fox's run is over: " << e.GetErrorStr());
    }
    laser.reset();
    position.reset();
    client.reset();
  }

 private:
  struct Junction {
    double x, y;                    // [m]
    std::vector<std::size_t> next;  // where the corridors lead
  };

  static const std::vector<Junction>& junctions() {
    static const std::vector<Junction> all = {
        {1.20, 0.26, {1}},           // 0: the long corridor at the bottom, its left end
        {1.85, 0.28, {0, 2, 4}},     // 1
        {2.50, 0.26, {1, 3}},        // 2
        {3.15, 0.28, {2, 8}},        // 3
        {1.85, 0.90, {1, 5, 6}},     // 4: the room at the left
        {1.20, 0.95, {4}},           // 5
        {1.85, 1.60, {4, 7}},        // 6: the hall
        {1.85, 2.18, {6, 10}},       // 7
        {3.15, 0.90, {3, 9, 11}},    // 8: the room at the right
        {2.50, 0.90, {8}},           // 9
        {2.50, 2.18, {7, 12, 13}},   // 10
        {3.15, 1.60, {8, 12}},       // 11
        {3.15, 2.25, {10, 11, 15}},  // 12
        {2.42, 2.82, {10, 14, 16}},  // 13: around the diamond
        {2.83, 3.28, {13, 15}},      // 14
        {3.20, 2.82, {12, 14}},      // 15
        {1.80, 2.82, {13}},          // 16: the bay at the top
    };
    return all;
  }

  void run() {
    // The fox starts at the junction nearest to it.
    std::size_t goal = 0;
    for (std::size_t i = 1; i < junctions().size(); i++) {
      if (distanceTo(junctions()[i]) < distanceTo(junctions()[goal])) goal = i;
    }
    std::size_t last = goal;
    position->SetMotorEnable(true);
    bool q = false;
    while (!q) {
      if (distanceTo(junctions()[goal]) < 0.05) {
        std::vector<std::size_t> choices;
        for (const std::size_t next : junctions()[goal].next) {
          if (next != last) choices.push_back(next);
        }
        if (choices.empty()) choices.push_back(last);
        last = goal;
        goal = choices[random() % choices.size()];
      }
      const double direction = std::atan2(junctions()[goal].y - position->GetYPos(),
                                          junctions()[goal].x - position->GetXPos());
      const double angle = std::remainder(direction - position->GetYaw(), 2.0 * PI);
      position->SetSpeed(std::fabs(angle) < 0.3 ? SPEED : 0.0, 3.0 * angle);
      client->Read();
      const ScopedLock lk(mtx);
      q = quit;
    }
    position->SetSpeed(0.0, 0.0);
  }

  double distanceTo(const Junction& junction) const {
    return std::hypot(junction.x - position->GetXPos(), junction.y - position->GetYPos());
  }

  static constexpr double SPEED = 0.2;  // [m/s]

  // The order matters: members are destroyed in reverse order, and a proxy must be destroyed before
  // its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::minstd_rand random;

  bool quit = false;  // guarded by mtx
  Mutex mtx;
};

#endif
