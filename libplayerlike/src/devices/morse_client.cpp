// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <utility>

#include "core/client_core.h"
#include "core/errors.h"
#include "libCCMorse/MorseClient.h"
#include "libCCMorse/MorseProperties.h"
#include "playerlike/connect/open_session.h"
#include "sim/core/math.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::ClientCore;
using playerlike::RobotInfo;
using playerlike::translated;
using playerlike::translated_all;

namespace {

bool is_visible(int port, const RobotInfo& robot) {
  return port == playerlike::kMorsePort || port == robot.port;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

const RobotInfo& info_of(const std::shared_ptr<ClientCore>& core, std::size_t index) {
  return core->robots().at(index);
}

MorseDeviceInfo device_info(const playerlike::DeviceInfo& device) {
  return {device.name, device.type, device.properties};
}

player_pose2d_t initial_pose(const RobotInfo& robot) {
  const sim::Pose& pose = robot.initial_pose;
  return {pose.x_m, pose.y_m, pose.yaw_rad};
}

}  // namespace

// --- MorseClient

MorseClient::MorseClient(const std::string& aHostname, uint32_t aPort) {
  mCore = translated_all("MorseClient::MorseClient", [&] {
    playerlike::prepare_for_uncaught_errors();
    constexpr uint32_t kMaxPort = 65535;
    return playerlike::make_core(
        playerlike::open_session(aHostname, static_cast<int>(std::min(aPort, kMaxPort))));
  });
}

MorseClient::MorseClient(std::unique_ptr<playerlike::Session> aSession) {
  mCore = translated_all("MorseClient::MorseClient", [&] {
    playerlike::prepare_for_uncaught_errors();
    return playerlike::make_core(std::move(aSession));
  });
}

MorseClient::~MorseClient() { mCore->close(); }

bool MorseClient::Connected() const { return !mCore->closed() && mCore->session().connected(); }

void MorseClient::Read() {
  translated("MorseClient::Read", [&] { mCore->read(); });
}

bool MorseClient::Peek(uint32_t aTimeout) {
  return translated("MorseClient::Peek",
                    [&] { return mCore->peek(std::chrono::milliseconds(aTimeout)); });
}

void MorseClient::ReadIfWaiting() {
  if (Peek(0)) Read();
}

std::vector<std::string> MorseClient::GetRobotNames() const {
  std::vector<std::string> names;
  const int port = mCore->session().port();
  for (const RobotInfo& robot : mCore->robots()) {
    if (is_visible(port, robot)) names.push_back(robot.name);
  }
  return names;
}

bool MorseClient::HasRobot(const std::string& aName) const {
  const std::vector<std::string> names = GetRobotNames();
  return std::find(names.begin(), names.end(), aName) != names.end();
}

MorseRobot MorseClient::GetRobot(const std::string& aName) const {
  const int port = mCore->session().port();
  const auto& robots = mCore->robots();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!is_visible(port, robots[i])) continue;
    if (aName.empty() || robots[i].name == aName) return MorseRobot(mCore, i);
  }
  throw PlayerError("MorseClient::GetRobot",
                    "there is no robot \"" + aName + "\" on port " + std::to_string(port) +
                        "; robots there: " + joined(GetRobotNames()),
                    PlayerError::kNoSuchDevice);
}

// --- MorseRobot

MorseRobot::MorseRobot(std::shared_ptr<ClientCore> aCore, std::size_t aIndex)
    : mCore(std::move(aCore)), mIndex(aIndex) {}

std::string MorseRobot::GetName() const { return info_of(mCore, mIndex).name; }
std::string MorseRobot::GetModel() const { return info_of(mCore, mIndex).model; }
uint32_t MorseRobot::GetPort() const { return static_cast<uint32_t>(info_of(mCore, mIndex).port); }
player_pose2d_t MorseRobot::GetInitialPose() const { return initial_pose(info_of(mCore, mIndex)); }
double MorseRobot::GetLength() const { return info_of(mCore, mIndex).length_m; }
double MorseRobot::GetWidth() const { return info_of(mCore, mIndex).width_m; }
double MorseRobot::GetHeight() const { return info_of(mCore, mIndex).height_m; }
double MorseRobot::GetWeight() const { return info_of(mCore, mIndex).mass_kg; }
double MorseRobot::GetMaxSpeed() const { return info_of(mCore, mIndex).max_speed_mps; }
double MorseRobot::GetMaxTurnRate() const { return info_of(mCore, mIndex).max_turn_rate_radps; }

std::vector<std::string> MorseRobot::GetDeviceNames() const {
  std::vector<std::string> names;
  for (const auto& device : info_of(mCore, mIndex).devices) names.push_back(device.name);
  return names;
}

bool MorseRobot::HasDevice(const std::string& aName) const {
  const std::vector<std::string> names = GetDeviceNames();
  return std::find(names.begin(), names.end(), aName) != names.end();
}

MorseDeviceInfo MorseRobot::GetDevice(const std::string& aName) const {
  for (const auto& device : info_of(mCore, mIndex).devices) {
    if (device.name == aName) return device_info(device);
  }
  throw PlayerError("MorseRobot::GetDevice",
                    "robot " + GetName() + " has no device \"" + aName +
                        "\"; devices it has: " + joined(GetDeviceNames()),
                    PlayerError::kNoSuchDevice);
}

std::vector<MorseDeviceInfo> MorseRobot::GetDevices() const {
  std::vector<MorseDeviceInfo> devices;
  for (const auto& device : info_of(mCore, mIndex).devices) {
    devices.push_back(device_info(device));
  }
  return devices;
}

namespace {

// @throws PlayerError kNotAvailable in the name of `fun` if the robot has no motors.
playerlike::DeviceId motors_of(const char* fun, const RobotInfo& robot) {
  for (const auto& device : robot.devices) {
    if (device.type == "motion") return device.id;
  }
  throw PlayerError(fun,
                    "robot " + robot.name + " has no motors (a device of type \"motion\"), so it " +
                        "takes no position goal",
                    PlayerError::kNotAvailable);
}

}  // namespace

void MorseRobot::SetPositionGoal(double aX, double aY, double aYaw) {
  const char* fun = "MorseRobot::SetPositionGoal";
  playerlike::require_finite(fun, {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const playerlike::DeviceId motors = motors_of(fun, info_of(mCore, mIndex));
  const sim::Pose goal{aX, aY, sim::normalize_angle(aYaw)};
  const PlayerCc::mutex_t::scoped_lock lock(mCore->mutex());
  mCore->send(fun, motors, sim::PositionCommand{goal});
  mCore->position_goals()[static_cast<int>(mIndex)] = goal;
}

void MorseRobot::SetPositionGoal(double aX, double aY) {
  sim::Pose from = info_of(mCore, mIndex).initial_pose;
  {
    const PlayerCc::mutex_t::scoped_lock lock(mCore->mutex());
    from = mCore->last_pose(static_cast<int>(mIndex)).value_or(from);
  }
  SetPositionGoal(aX, aY, sim::math::atan2(aY - from.y_m, aX - from.x_m));
}

bool MorseRobot::HasPositionGoal() const {
  const PlayerCc::mutex_t::scoped_lock lock(mCore->mutex());
  return mCore->position_goals().contains(static_cast<int>(mIndex));
}

player_pose2d_t MorseRobot::GetPositionGoal() const {
  const PlayerCc::mutex_t::scoped_lock lock(mCore->mutex());
  const auto goal = mCore->position_goals().find(static_cast<int>(mIndex));
  if (goal == mCore->position_goals().end()) {
    throw PlayerError("MorseRobot::GetPositionGoal",
                      "robot " + GetName() + " has no position goal; SetPositionGoal() sets one",
                      PlayerError::kNotAvailable);
  }
  return {goal->second.x_m, goal->second.y_m, goal->second.yaw_rad};
}

void MorseRobot::ClearPositionGoal() {
  const char* fun = "MorseRobot::ClearPositionGoal";
  const playerlike::DeviceId motors = motors_of(fun, info_of(mCore, mIndex));
  const PlayerCc::mutex_t::scoped_lock lock(mCore->mutex());
  mCore->send(fun, motors, sim::TwistCommand{});
  mCore->position_goals().erase(static_cast<int>(mIndex));
}

// --- MorseProperties

MorseProperties::MorseProperties(const MorseRobot& aRobot) : mRobot(aRobot) {}

std::string MorseProperties::GetModel() const { return mRobot.GetModel(); }
uint32_t MorseProperties::GetPort() const { return mRobot.GetPort(); }

ImageColour_t MorseProperties::GetColour() const {
  const sim::Colour& c = info_of(mRobot.mCore, mRobot.mIndex).colour;
  return {c.r, c.g, c.b, c.a};
}

player_pose2d_t MorseProperties::GetInitialPose() const { return mRobot.GetInitialPose(); }

player_bbox3d_t MorseProperties::GetSize() const {
  return {mRobot.GetWidth(), mRobot.GetLength(), mRobot.GetHeight()};
}

std::map<std::string, int> MorseProperties::GetProxyIndexes() const {
  std::map<std::string, int> indexes;
  const std::string name = mRobot.GetName();
  for (const auto& address :
       playerlike::list_interfaces(mRobot.mCore->robots(), playerlike::kMorsePort)) {
    if (address.robot == name) indexes.emplace(address.interface, address.index);
  }
  return indexes;
}

int MorseProperties::GetProxyIndex(const std::string& aInterface) const {
  const auto indexes = GetProxyIndexes();
  const auto it = indexes.find(aInterface);
  return it == indexes.end() ? -1 : it->second;
}

std::vector<std::string> MorseProperties::GetDriverNames() const {
  std::vector<std::string> names;
  for (const auto& driver : info_of(mRobot.mCore, mRobot.mIndex).drivers) {
    names.push_back(driver.type);
  }
  return names;
}

std::map<std::string, std::string> MorseProperties::GetDriverSettings(
    const std::string& aDriver) const {
  for (const auto& driver : info_of(mRobot.mCore, mRobot.mIndex).drivers) {
    if (driver.type == aDriver) return driver.settings;
  }
  throw PlayerError("MorseProperties::GetDriverSettings",
                    "robot " + mRobot.GetName() + " has no driver \"" + aDriver +
                        "\"; drivers it has: " + joined(GetDriverNames()),
                    PlayerError::kNoSuchDevice);
}

}  // namespace CCMorse

namespace std {

std::ostream& operator<<(std::ostream& os, const CCMorse::MorseClient& c) {
  os << "#MorseClient " << (c.Connected() ? "connected" : "not connected")
     << "\n#robot\tdevice\ttype\n";
  for (const std::string& name : c.GetRobotNames()) {
    for (const auto& device : c.GetRobot(name).GetDevices()) {
      os << name << '\t' << device.name << '\t' << device.type << '\n';
    }
  }
  return os;
}

}  // namespace std
