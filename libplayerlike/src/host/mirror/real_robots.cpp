// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/real_robots.h"

#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/results/kept_memory.h"

namespace playerlike {
namespace {

using nlohmann::json;

constexpr double kAttempt_s = 1.0;
// More are no robots of a run, but damaged memory.
constexpr std::size_t kMostRobots = 256;

/// The motors that the program's host has kept; none if the memory is damaged.
std::vector<RealMotors> kept_motors(const KeptRun& kept) {
  const KeptMemory memory(kept.descriptor());
  const auto* const header = memory.at<KeptHeader>(0);
  if (header == nullptr) return {};
  const json list = memory.json(header->motors);
  std::vector<RealMotors> motors;
  if (!list.is_array() || list.size() > kMostRobots) return motors;
  for (const json& one : list) {
    const bool is_valid = one.is_array() && one.size() == 5 && one[0].is_string() &&
                          one[1].is_string() && one[2].is_number_integer() &&
                          one[3].is_number_integer() && one[4].is_number_integer();
    if (!is_valid) return {};
    motors.push_back({one[0].get<std::string>(), one[1].get<std::string>(), one[2].get<int>(),
                      DeviceId{one[3].get<int>(), one[4].get<int>()}});
  }
  return motors;
}

void stop(const RealMotors& motors, const OpenRealRobot& open) {
  const std::unique_ptr<Session> session = open({motors.server, motors.port, kAttempt_s});
  session->request(AnswerTimeoutRequest{kAttempt_s});
  session->send(motors.device, sim::TwistCommand{});
  // An answer means that the server has the command.
  static_cast<void>(session->request(TimeRequest{}));
}

}  // namespace

void stop_real_robots(const KeptRun& kept, const OpenRealRobot& open,
                      const std::function<void(const std::string&)>& tell) {
  if (kept.phase() != KeptRun::Phase::kRunning) return;
  std::mutex tell_mutex;  // guards tell
  std::vector<std::thread> threads;
  for (const RealMotors& motors : kept_motors(kept)) {
    threads.emplace_back([&tell_mutex, &open, &tell, motors] {
      try {
        stop(motors, open);
      } catch (const std::exception& e) {
        const std::lock_guard lock(tell_mutex);
        tell("the real robot of " + motors.robot + " at " + motors.server +
             " could not be stopped: " + e.what());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace playerlike
