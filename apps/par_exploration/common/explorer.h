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

// A robot that explores an arena it knows nothing of. This is all of it but for one decision: which
// frontier to go to next. A solution derives a class from it that makes that decision, in choose().
//
// Two threads: a CCollector learns the map; this one plans on it and drives. Each has its own
// client of the same robot.
//
// The thread's turn, ten times a simulated second: wait for the map of this moment; if it is time,
// or the way is blocked, plan; then command a speed. Planning is: inflate what is occupied; find
// the frontiers; for each the best place to look at it from; choose one; find the way; straighten
// it.
//
// It ends when no frontier is left that can be seen from a place the robot can reach. Each
// frontier is tried once only: if the robot has looked at it, and it is still there, or if it has
// not got there in time, its cells are given up for good. So the exploration ends for certain.
class CExplorer : public imr::concurrent::CThread {
 public:
  // How it ended.
  enum Outcome {
    RUNNING,        // not yet
    EXPLORED,       // no frontier is left that can be reached
    NO_WAY_BEGINS,  // the robot stands where the map has no free cell near it
    TIME_IS_OVER,   // of --time-limit
    RUN_IS_OVER,    // the simulation ended first
    FAILED          // a fault
  };

  // Declares the settings that can be given on the command line, with their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CExplorer(imr::CConfig& cfg);
  // Derived classes must stop() and join() in their own destructor: the thread calls choose().
  ~CExplorer() override;

  // Asks the thread to end after its current turn; may be called from any thread.
  void stop();
  // When the thread has ended: how. Prints what the robot has done.
  Outcome summary() const;

 protected:
  // A frontier that can be reached.
  struct Candidate {
    const par::Frontier* frontier;
    par::Cell place;  // where to go, to look at it
    double way;       // how far that is [m]
  };

  // The decision: which of these to go to. candidates has at least one element, and the result must
  // be less than candidates.size(). states: what is known of each cell.
  virtual std::size_t choose(const std::vector<Candidate>& candidates,
                             const par::Grid<par::CellState>& states) = 0;

  void threadBody() override;

 private:
  // What the robot has in mind.
  struct Target {
    std::vector<par::Cell> cells;  // of the frontier; empty: there is no target
    par::Cell centre;              // of the frontier
    par::Cell place;               // to look at it from
    double deadline = 0.0;         // time by which the robot should have been there [s]
    bool reached = false;          // it is there, and turns towards the frontier
    double lookedFor = 0.0;        // so long it has seen the frontier from there [s]
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

  // Two connections to the robot, for two threads. The order matters: what is declared last is
  // destroyed first, and each needs what is above it to the end.
  std::unique_ptr<CCMorse::PlayerClient> dataClient;
  std::unique_ptr<CLayers> layers;
  std::unique_ptr<CSharedMap> map;
  std::unique_ptr<CCollector> collector;
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double timeLimit;  // simulated [s]; 0: none
  par::PathFollower follower;
  CGuard guard;

  Observation now;         // of this turn
  double startTime = 0.0;  // of the first one [s]
  double planTime = 0.0;   // when it planned last [s]
  double wayTime = 0.0;    // when it last looked for a way [s]
  int nothingFound = 0;    // plans in a row that found no target
  int noStart = 0;         // plans in a row that found no free cell near the robot

  par::Grid<par::CellState> known;  // what is known of each cell
  par::Mask blocked;                // where the robot's centre must not go, or nobody knows
  par::Grid<std::uint8_t> tries;    // how often a cell was part of a target
  Target target;
  std::vector<par::Cell> way;  // to it: the cells where it turns

  par::Pose last;           // where the robot was in the turn before
  double driven = 0.0;      // its way so far [m]
  par::Pose stuckPose;      // where it was when it last got on
  double stuckSince = 0.0;  // and when that was [s]
  int targets = 0;          // that it has had
  int given = 0;            // of these, given up

  mutable Mutex mtx;  // guards what follows
  bool quit = false;
  Outcome outcome = RUNNING;
};

#endif
