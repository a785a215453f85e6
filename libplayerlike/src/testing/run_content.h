// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/testing/run.h"
#include "testing/record.h"

namespace playpen::testing {

struct Moment::Content {
  sim::WorldDescription world;
  std::shared_ptr<const playerlike::HostState> state;  ///< null: the world's beginning
  std::vector<GoalState> goals;
  double time_s = 0.0;
};

struct TestRun::Content {
  /// @throws Error if the world is wrong.
  explicit Content(const Moment::Content& start);
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;
  ~Content();

  /// Index of a robot; "" is the only one. @throws Error.
  [[nodiscard]] int robot(const std::string& name) const;
  /// Indices of a robot, or of all if the name is "". @throws Error.
  [[nodiscard]] std::vector<int> robots(const std::string& name) const;
  /// @param path  "ROBOT.DEVICE", or "DEVICE" of the only robot. @throws Error.
  [[nodiscard]] playerlike::DeviceId device(const std::string& path) const;
  /// Changes the simulation. @throws Error with the reason that `act` returns.
  void change(const std::string& what,
              const std::function<std::optional<std::string>(sim::Simulation&)>& act);
  /// Looks at simulation and record between two steps.
  template <typename Look>
  auto look(const Look& look) const {
    return host->with_simulation([&](const sim::Simulation& s) { return look(s, *record); });
  }

  sim::WorldDescription world;
  std::shared_ptr<playerlike::Host> host;
  std::shared_ptr<Record> record;  ///< guarded by the host's mutex
  std::string name;                ///< of the host
  bool is_localhost = false;
};

/// Access to a run's content for checks and pictures.
struct Judge {
  static const TestRun::Content& content(const TestRun& run) { return *run.content_; }
};

}  // namespace playpen::testing
