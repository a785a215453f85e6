// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/gripperproxy.h"
#include "libplayerc++/playerconstants.h"
#include "proxies/link.h"
#include "session/player_values/gripper.h"
#include "sim/devices/gripper.h"

namespace PlayerCc {

using sim::GripperReading;

GripperProxy::GripperProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "GripperProxy::GripperProxy";
  Attach(PLAYER_GRIPPER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mGeom = playerlike::gripper_geometry<player_gripper_geom_t>(mLink->info().properties);
}

GripperProxy::~GripperProxy() { ClientProxy::Unsubscribe(); }

void GripperProxy::RequestGeometry() {
  const scoped_lock_t lock(LockData("GripperProxy::RequestGeometry"));
}

uint32_t GripperProxy::GetState() const {
  const scoped_lock_t lock(LockData());
  const auto* reading = mLink->newest.find<GripperReading>();
  return reading == nullptr ? 0 : playerlike::gripper_state_code(reading->state);
}
uint32_t GripperProxy::GetBeams() const {
  return Look<GripperReading>([](const auto& r) { return playerlike::broken_beams(r); });
}
player_pose3d_t GripperProxy::GetPose() const { return GetVar(mGeom.pose); }
player_bbox3d_t GripperProxy::GetOuterSize() const { return GetVar(mGeom.outer_size); }
player_bbox3d_t GripperProxy::GetInnerSize() const { return GetVar(mGeom.inner_size); }
uint32_t GripperProxy::GetNumBeams() const { return GetVar(mGeom.num_beams); }
uint32_t GripperProxy::GetCapacity() const { return GetVar(mGeom.capacity); }
uint32_t GripperProxy::GetStored() const {
  return static_cast<uint32_t>(Look(&GripperReading::stored));
}

void GripperProxy::Grip(const char* aFun, int aAction) {
  const scoped_lock_t lock(mLink->lock_for_command(aFun));
  mLink->send(
      aFun,
      sim::GripCommand{playerlike::grip_action(aAction).value_or(sim::GripCommand::Action::kStop)});
}

void GripperProxy::Open() { Grip("GripperProxy::Open", PLAYER_GRIPPER_CMD_OPEN); }
void GripperProxy::Close() { Grip("GripperProxy::Close", PLAYER_GRIPPER_CMD_CLOSE); }
void GripperProxy::Stop() { Grip("GripperProxy::Stop", PLAYER_GRIPPER_CMD_STOP); }
void GripperProxy::Store() { Grip("GripperProxy::Store", PLAYER_GRIPPER_CMD_STORE); }
void GripperProxy::Retrieve() { Grip("GripperProxy::Retrieve", PLAYER_GRIPPER_CMD_RETRIEVE); }

uint32_t GripperProxy::GetOuterBreakBeam() const {
  return (GetBeams() & playerlike::kOuterBeam) != 0 ? 1 : 0;
}
uint32_t GripperProxy::GetInnerBreakBeam() const {
  return (GetBeams() & playerlike::kInnerBeam) != 0 ? 1 : 0;
}
uint32_t GripperProxy::GetPaddlesOpen() const {
  return GetState() == PLAYER_GRIPPER_STATE_OPEN ? 1 : 0;
}
uint32_t GripperProxy::GetPaddlesClosed() const {
  return GetState() == PLAYER_GRIPPER_STATE_CLOSED ? 1 : 0;
}
uint32_t GripperProxy::GetPaddlesMoving() const {
  return GetState() == PLAYER_GRIPPER_STATE_MOVING ? 1 : 0;
}
uint32_t GripperProxy::GetGripperError() const {
  return GetState() == PLAYER_GRIPPER_STATE_ERROR ? 1 : 0;
}

void GripperProxy::SetGrip(uint8_t aCmd, uint8_t /*aArg*/) {
  const char* fun = "GripperProxy::SetGrip";
  switch (aCmd) {  // command numbers of the Pioneer manuals
    case 1:
      return Grip(fun, PLAYER_GRIPPER_CMD_OPEN);
    case 2:
      return Grip(fun, PLAYER_GRIPPER_CMD_CLOSE);
    case 3:
    case 15:
      return Grip(fun, PLAYER_GRIPPER_CMD_STOP);
    case 7:
      return Grip(fun, PLAYER_GRIPPER_CMD_STORE);
    case 8:
      return Grip(fun, PLAYER_GRIPPER_CMD_RETRIEVE);
    case 4:
    case 5:
    case 6:
    case 16:
    case 17:
      throw PlayerError(fun, "this gripper has no lift, and its pressure cannot be set",
                        PlayerError::kNotAvailable);
    default:
      playerlike::refuse(fun, "there is no command " + std::to_string(aCmd) + " of a gripper");
  }
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::GripperProxy& c) {
  const char* state = c.GetPaddlesOpen() != 0     ? "open"
                      : c.GetPaddlesClosed() != 0 ? "closed"
                      : c.GetPaddlesMoving() != 0 ? "moving"
                      : c.GetGripperError() != 0  ? "error"
                                                  : "unknown";
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#state\touter beam\tinner beam\tstored\n"
            << state << '\t' << c.GetOuterBreakBeam() << '\t' << c.GetInnerBreakBeam() << '\t'
            << c.GetStored() << '\n';
}

}  // namespace std
