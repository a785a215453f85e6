// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <vector>

#include "core/errors.h"
#include "drivers/local_driver_start.h"
#include "drivers/named_settings.h"
#include "libCCMorse/LocalDriver.h"
#include "proxies/link.h"

namespace playerlike {

const RobotInfo* robot_of_position(ClientCore& core, std::uint32_t position) {
  const std::vector<RobotInfo>& robots = core.session().robots();
  const InterfaceBinding binding =
      find_interface(robots, core.session().port(), "position2d", static_cast<int>(position));
  return binding.robot < 0 ? nullptr : &robots.at(static_cast<std::size_t>(binding.robot));
}

}  // namespace playerlike

namespace CCMorse {

using playerlike::GoalState;
using playerlike::translated;

namespace {

// The default settings of a kind for a robot.
template <typename Settings>
playerlike::GoalDriverSettings defaults_for(const playerlike::RobotInfo* robot) {
  if (robot == nullptr) return Settings{};
  return playerlike::default_settings<Settings>(robot->radius_m, robot->max_speed_mps,
                                                robot->max_turn_rate_radps);
}

const sim::FieldTable& table_of(const playerlike::GoalDriverSettings& settings) {
  return playerlike::goal_driver_kinds()[settings.index()].fields();
}

}  // namespace

LocalDriver::LocalDriver(const char* aName, PlayerClient* aClient, uint32_t aPosition,
                         uint32_t aLaser, const Start& aStart)
    : mName(aName), mPosition(aPosition) {
  const std::string fun = Fun(aName);
  if (aClient == nullptr) {
    playerlike::refuse(fun, "a driver needs a client, but it is a null pointer");
  }
  mCore = PlayerCc::detail::CoreAccess::get(*aClient);
  translated(fun.c_str(), [&] {
    mCore->require_usable();
    mThread = std::make_unique<playerlike::GoalThread>(
        mCore->session().open_follower(), static_cast<int>(aPosition), static_cast<int>(aLaser),
        aStart.settings(playerlike::robot_of_position(*mCore, aPosition)), fun.c_str());
  });
}

LocalDriver::~LocalDriver() = default;

std::string LocalDriver::Fun(const char* aMember) const {
  return std::string(mName) + "::" + aMember;
}

void LocalDriver::SetGoal(double aX, double aY) {
  const std::string fun = Fun("SetGoal");
  playerlike::require_finite(fun.c_str(), {{"the goal's x", aX}, {"the goal's y", aY}});
  translated(fun.c_str(), [&] {
    mCore->require_usable();
    mThread->go_to({{aX, aY}, {}, {}, {}});
  });
}

void LocalDriver::SetGoal(double aX, double aY, double aYaw) {
  const std::string fun = Fun("SetGoal");
  playerlike::require_finite(
      fun.c_str(), {{"the goal's x", aX}, {"the goal's y", aY}, {"the goal's heading", aYaw}});
  translated(fun.c_str(), [&] {
    mCore->require_usable();
    mThread->go_to({{aX, aY}, sim::normalize_angle(aYaw), {}, {}});
  });
}

void LocalDriver::Cancel() {
  translated(Fun("Cancel").c_str(), [&] {
    mCore->require_usable();
    mThread->cancel();
    playerlike::Session& session = mCore->session();
    const playerlike::InterfaceBinding binding = playerlike::find_interface(
        session.robots(), session.port(), "position2d", static_cast<int>(mPosition));
    session.send(binding.motion.value(), sim::TwistCommand{});
  });
}

LocalDriver::Status LocalDriver::GetStatus() const {
  return translated(Fun("GetStatus").c_str(), [&] {
    mCore->require_usable();
    switch (mThread->state()) {
      case GoalState::kIdle:
        break;
      case GoalState::kMoving:
        return MOVING;
      case GoalState::kReached:
        return REACHED;
      case GoalState::kBlocked:
        return BLOCKED;
    }
    return IDLE;
  });
}

LocalDriver::Status LocalDriver::WaitForGoal(double aTimeout) {
  const std::string fun = Fun("WaitForGoal");
  playerlike::require_finite(fun.c_str(), {{"the timeout", aTimeout}});
  return translated(fun.c_str(), [&] {
    const auto now_s = [&] {
      return sim::to_seconds(mCore->session().request(playerlike::TimeRequest{}).sim_time_ns);
    };
    const double start_s = now_s();
    Status status = GetStatus();
    while (status == MOVING && (aTimeout < 0.0 || now_s() - start_s < aTimeout)) {
      mCore->read();
      status = GetStatus();
    }
    return status;
  });
}

void LocalDriver::Set(const std::string& aName, double aValue) {
  const std::string fun = Fun("Set");
  playerlike::GoalDriverSettings settings = mThread->settings();
  const sim::FieldTable& table = table_of(settings);
  void* const object = sim::object_in(settings);
  playerlike::set_named(fun, table, playerlike::is_number, object, aName, aValue);
  const std::string fault = playerlike::fault_of(table, object);
  if (!fault.empty()) playerlike::refuse(fun, fault);
  translated(fun.c_str(), [&] {
    mCore->require_usable();
    mThread->set_settings(settings);
  });
}

double LocalDriver::Get(const std::string& aName) const {
  const playerlike::GoalDriverSettings settings = mThread->settings();
  return playerlike::get_named(Fun("Get"), table_of(settings), playerlike::is_number,
                               sim::object_in(settings), aName);
}

VfhDriver::VfhDriver(PlayerClient* aClient, uint32_t aPosition, uint32_t aLaser)
    : LocalDriver("VfhDriver", aClient, aPosition, aLaser,
                  {defaults_for<playerlike::VfhSettings>}) {}

NdDriver::NdDriver(PlayerClient* aClient, uint32_t aPosition, uint32_t aLaser)
    : LocalDriver("NdDriver", aClient, aPosition, aLaser, {defaults_for<playerlike::NdSettings>}) {}

}  // namespace CCMorse
