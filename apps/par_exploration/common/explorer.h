// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_EXPLORER_H
#define PAR_EXPLORATION_EXPLORER_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "collector.h"
#include "guard.h"
#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "layers.h"
#include "libCCMorse/CCMorse.h"
#include "par_common/frontiers.h"
#include "par_common/occupancy_grid.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"
#include "shared_map.h"

// A robot that explores an unknown arena. This class does everything except one decision: which
// frontier to visit next. A solution derives a class from it and implements that decision in
// choose().
//
// There are two threads: a CCollector updates the map; this thread plans on it and drives. Each has
// its own client of the same robot.
//
// This thread repeats ten times a simulated second: wait for the current map; if it is time to
// plan, or the path is blocked, plan; then command a speed. Planning means: inflate the obstacles,
// find the frontiers, find for each the best place to observe it from, choose one, plan the path,
// and smooth it.
//
// The exploration ends when no frontier is left that can be seen from a reachable place. (A
// solution for an arena that changes can delay the end, and make the robot look at places again:
// lookAhead(), lookAgain().) Each frontier is tried only once. If a frontier remains after the
// robot has observed it, or if the robot does not reach it in time, its cells are given up for
// good. This guarantees that the exploration ends.
class CExplorer : public imr::concurrent::CThread {
 public:
  // How the exploration ended.
  enum Outcome {
    RUNNING,        // it has not ended yet
    EXPLORED,       // no frontier is left that can be reached
    NO_WAY_BEGINS,  // the map has no free cell near the robot
    TIME_IS_OVER,   // --time-limit has passed
    RUN_IS_OVER,    // the simulation ended first
    FAILED          // an error
  };

  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CExplorer(imr::CConfig& cfg);
  // Derived classes must call stop() and join() in their own destructor, because the thread calls
  // choose().
  ~CExplorer() override;

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();
  // How the exploration ended; call it after the thread has ended. Prints a summary.
  Outcome summary() const;

 protected:
  // A frontier that can be reached.
  struct Candidate {
    const par::Frontier* frontier;
    par::Cell place;  // where to go to observe it
    double way;       // length of the path to it [m]
  };

  // The decision: returns the index of the candidate to go to, less than candidates.size(). There
  // is at least one candidate. `states` is the state of each cell of the map.
  virtual std::size_t choose(const std::vector<Candidate>& candidates,
                             const par::Grid<par::CellState>& states) = 0;

  // Called before each plan, that is, at least twice a second. Returns whether the exploration may
  // end if there is nothing left to explore now.
  virtual bool lookAhead() { return true; }
  // Forgets the map of an area, where something has changed, and tries all frontiers once more.
  // Only lookAhead() may call it.
  void lookAgain(const Area& area);
  // The client of the thread that calls choose() and lookAhead().
  CCMorse::PlayerClient* getClient() const { return client.get(); }

  void threadBody() override;

 private:
  // The current target.
  struct Target {
    std::vector<par::Cell> cells;  // cells of the frontier; empty: there is no target
    par::Cell centre;              // centre of the frontier
    par::Cell place;               // where to observe it from
    double deadline = 0.0;         // time by which the robot should have arrived [s]
    bool reached = false;          // the robot has arrived and turns towards the frontier
    double lookedFor = 0.0;        // how long the frontier has been in view from there [s]
  };

  void explore();
  bool mustPlan() const;
  Outcome plan();
  void keepOrDropTarget(const par::Mask& frontier);
  bool chooseTarget(const std::vector<par::Frontier>& frontiers, const par::Mask& hidden,
                    const par::Cell& start);
  std::vector<Candidate> findCandidates(const std::vector<par::Frontier>& frontiers,
                                        const par::DistanceField& ways,
                                        const par::Mask& hidden) const;
  void giveUp();
  void dropTarget();
  bool findWay(const par::Grid<double>& distance);
  par::Velocity decideSpeeds();
  void noteProgress(const par::Velocity& wanted);
  Surroundings lookAround() const;
  par::Cell robotCell() const;
  bool isOver();
  void end(Outcome how);

  // Two connections to the robot, one per thread. The order matters: members are destroyed in
  // reverse order, and each needs the members above it.
  std::unique_ptr<CCMorse::PlayerClient> dataClient;
  std::unique_ptr<CLayers> layers;
  std::unique_ptr<CSharedMap> map;
  std::unique_ptr<CCollector> collector;
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double timeLimit;  // simulated [s]; 0: none
  par::PathFollower follower;
  CGuard guard;

  Observation now;         // the observation of this iteration
  double startTime = 0.0;  // time of the first iteration [s]
  double planTime = 0.0;   // time of the last plan [s]
  double wayTime = 0.0;    // time of the last path planning [s]
  int nothingFound = 0;    // consecutive plans without a target
  int noStart = 0;         // consecutive plans without a free cell near the robot

  par::Grid<par::CellState> known;  // state of each cell
  par::Mask blocked;                // inflated obstacles and unknown cells
  par::Grid<std::uint8_t> tries;    // how often a cell was part of a target
  Target target;
  std::vector<par::Cell> way;  // path to the target: the cells where it turns

  par::Pose last;           // pose in the previous iteration
  double driven = 0.0;      // driven distance [m]
  par::Pose stuckPose;      // pose at the last progress
  double stuckSince = 0.0;  // time of the last progress [s]
  int targets = 0;          // number of targets so far
  int given = 0;            // number of targets given up

  mutable Mutex mtx;  // guards what follows
  bool quit = false;
  Outcome outcome = RUNNING;
};

#endif
