// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>

#include "messages/player_interfaces.h"
#include "proxies/link.h"

namespace PlayerCc {
namespace {

/// The messages that the proxies of an interface receive or send.
struct MessageRow {
  uint32_t interface;
  uint32_t type;
  std::uint64_t subtypes;  ///< a bit set
};

constexpr std::uint64_t subtypes_of(std::initializer_list<unsigned> subtypes) {
  std::uint64_t all = 0;
  for (const unsigned subtype : subtypes) all |= std::uint64_t{1} << subtype;
  return all;
}
constexpr std::uint64_t subtypes_between(unsigned first, unsigned last) {
  std::uint64_t all = 0;
  for (unsigned subtype = first; subtype <= last; ++subtype) all |= subtypes_of({subtype});
  return all;
}

constexpr uint32_t kDataMessage = PLAYER_MSGTYPE_DATA;
constexpr uint32_t kCommandMessage = PLAYER_MSGTYPE_CMD;
constexpr uint32_t kRequestMessage = PLAYER_MSGTYPE_REQ;
constexpr MessageRow kMessages[] = {
    {PLAYER_ACTARRAY_CODE, kDataMessage, subtypes_of({PLAYER_ACTARRAY_DATA_STATE})},
    {PLAYER_ACTARRAY_CODE, kCommandMessage,
     subtypes_between(PLAYER_ACTARRAY_CMD_POS, PLAYER_ACTARRAY_CMD_MULTI_CURRENT)},
    {PLAYER_ACTARRAY_CODE, kRequestMessage,
     subtypes_between(PLAYER_ACTARRAY_REQ_POWER, PLAYER_ACTARRAY_REQ_ACCEL)},
    {PLAYER_AIO_CODE, kDataMessage, subtypes_of({PLAYER_AIO_DATA_STATE})},
    {PLAYER_AIO_CODE, kCommandMessage, subtypes_of({PLAYER_AIO_CMD_STATE})},
    {PLAYER_BLACKBOARD_CODE, kDataMessage, subtypes_of({PLAYER_BLACKBOARD_DATA_UPDATE})},
    {PLAYER_BLACKBOARD_CODE, kRequestMessage,
     subtypes_between(PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_KEY, PLAYER_BLACKBOARD_REQ_GET_ENTRY)},
    {PLAYER_BLINKENLIGHT_CODE, kDataMessage, subtypes_of({PLAYER_BLINKENLIGHT_DATA_STATE})},
    {PLAYER_BLINKENLIGHT_CODE, kCommandMessage,
     subtypes_between(PLAYER_BLINKENLIGHT_CMD_STATE, PLAYER_BLINKENLIGHT_CMD_FLASH)},
    {PLAYER_BLOBFINDER_CODE, kDataMessage, subtypes_of({PLAYER_BLOBFINDER_DATA_BLOBS})},
    {PLAYER_BUMPER_CODE, kDataMessage, subtypes_of({PLAYER_BUMPER_DATA_STATE})},
    {PLAYER_BUMPER_CODE, kRequestMessage, subtypes_of({PLAYER_BUMPER_REQ_GET_GEOM})},
    {PLAYER_CAMERA_CODE, kDataMessage, subtypes_of({PLAYER_CAMERA_DATA_STATE})},
    {PLAYER_DIO_CODE, kDataMessage, subtypes_of({PLAYER_DIO_DATA_VALUES})},
    {PLAYER_DIO_CODE, kCommandMessage, subtypes_of({PLAYER_DIO_CMD_VALUES})},
    {PLAYER_FIDUCIAL_CODE, kDataMessage, subtypes_of({PLAYER_FIDUCIAL_DATA_SCAN})},
    {PLAYER_FIDUCIAL_CODE, kRequestMessage, subtypes_of({PLAYER_FIDUCIAL_REQ_GET_GEOM})},
    {PLAYER_GPS_CODE, kDataMessage, subtypes_of({PLAYER_GPS_DATA_STATE})},
    {PLAYER_GRAPHICS2D_CODE, kCommandMessage,
     subtypes_between(PLAYER_GRAPHICS2D_CMD_CLEAR, PLAYER_GRAPHICS2D_CMD_MULTILINE)},
    {PLAYER_GRIPPER_CODE, kDataMessage, subtypes_of({PLAYER_GRIPPER_DATA_STATE})},
    {PLAYER_GRIPPER_CODE, kRequestMessage, subtypes_of({PLAYER_GRIPPER_REQ_GET_GEOM})},
    {PLAYER_GRIPPER_CODE, kCommandMessage,
     subtypes_between(PLAYER_GRIPPER_CMD_OPEN, PLAYER_GRIPPER_CMD_RETRIEVE)},
    {PLAYER_IMU_CODE, kDataMessage, subtypes_of({PLAYER_IMU_DATA_STATE, PLAYER_IMU_DATA_CALIB})},
    {PLAYER_IMU_CODE, kRequestMessage,
     subtypes_of({PLAYER_IMU_REQ_SET_DATATYPE, PLAYER_IMU_REQ_RESET_ORIENTATION,
                  PLAYER_IMU_REQ_RESET_EULER})},
    {PLAYER_IR_CODE, kDataMessage, subtypes_of({PLAYER_IR_DATA_RANGES})},
    {PLAYER_IR_CODE, kRequestMessage, subtypes_of({PLAYER_IR_REQ_POSE})},
    {PLAYER_LASER_CODE, kDataMessage, subtypes_of({PLAYER_LASER_DATA_SCAN})},
    {PLAYER_LASER_CODE, kRequestMessage,
     subtypes_of({PLAYER_LASER_REQ_GET_GEOM, PLAYER_LASER_REQ_SET_CONFIG,
                  PLAYER_LASER_REQ_GET_CONFIG, PLAYER_LASER_REQ_GET_ID})},
    {PLAYER_LOCALIZE_CODE, kDataMessage, subtypes_of({PLAYER_LOCALIZE_DATA_HYPOTHS})},
    {PLAYER_LOCALIZE_CODE, kRequestMessage,
     subtypes_of({PLAYER_LOCALIZE_REQ_SET_POSE, PLAYER_LOCALIZE_REQ_GET_PARTICLES})},
    {PLAYER_LOG_CODE, kRequestMessage,
     subtypes_between(PLAYER_LOG_REQ_SET_WRITE_STATE, PLAYER_LOG_REQ_SET_FILENAME)},
    {PLAYER_MAP_CODE, kRequestMessage,
     subtypes_of({PLAYER_MAP_REQ_GET_INFO, PLAYER_MAP_REQ_GET_DATA})},
    {PLAYER_OPAQUE_CODE, kDataMessage, subtypes_of({PLAYER_OPAQUE_DATA_STATE})},
    {PLAYER_OPAQUE_CODE, kCommandMessage, subtypes_of({PLAYER_OPAQUE_CMD_DATA})},
    {PLAYER_OPAQUE_CODE, kRequestMessage, subtypes_of({PLAYER_OPAQUE_REQ_DATA})},
    {PLAYER_PLANNER_CODE, kDataMessage, subtypes_of({PLAYER_PLANNER_DATA_STATE})},
    {PLAYER_PLANNER_CODE, kCommandMessage,
     subtypes_of({PLAYER_PLANNER_CMD_GOAL, PLAYER_PLANNER_CMD_START})},
    {PLAYER_PLANNER_CODE, kRequestMessage,
     subtypes_of({PLAYER_PLANNER_REQ_GET_WAYPOINTS, PLAYER_PLANNER_REQ_ENABLE})},
    {PLAYER_POSITION2D_CODE, kDataMessage, subtypes_of({PLAYER_POSITION2D_DATA_STATE})},
    {PLAYER_POSITION2D_CODE, kCommandMessage,
     subtypes_of({PLAYER_POSITION2D_CMD_VEL, PLAYER_POSITION2D_CMD_POS, PLAYER_POSITION2D_CMD_CAR,
                  PLAYER_POSITION2D_CMD_VEL_HEAD})},
    {PLAYER_POSITION2D_CODE, kRequestMessage,
     subtypes_of({PLAYER_POSITION2D_REQ_GET_GEOM, PLAYER_POSITION2D_REQ_SET_ODOM,
                  PLAYER_POSITION2D_REQ_RESET_ODOM, PLAYER_POSITION2D_REQ_MOTOR_POWER})},
    {PLAYER_POWER_CODE, kDataMessage, subtypes_of({PLAYER_POWER_DATA_STATE})},
    {PLAYER_PTZ_CODE, kDataMessage, subtypes_of({PLAYER_PTZ_DATA_STATE})},
    {PLAYER_PTZ_CODE, kCommandMessage, subtypes_of({PLAYER_PTZ_CMD_STATE})},
    {PLAYER_PTZ_CODE, kRequestMessage,
     subtypes_of({PLAYER_PTZ_REQ_CONTROL_MODE, PLAYER_PTZ_REQ_STATUS})},
    {PLAYER_RANGER_CODE, kDataMessage, subtypes_of({PLAYER_RANGER_DATA_RANGE})},
    {PLAYER_RANGER_CODE, kRequestMessage,
     subtypes_of(
         {PLAYER_RANGER_REQ_GET_GEOM, PLAYER_RANGER_REQ_SET_CONFIG, PLAYER_RANGER_REQ_GET_CONFIG})},
    {PLAYER_SIMULATION_CODE, kRequestMessage,
     subtypes_between(PLAYER_SIMULATION_REQ_GET_POSE2D, PLAYER_SIMULATION_REQ_SET_PROPERTY)},
    {PLAYER_SONAR_CODE, kDataMessage, subtypes_of({PLAYER_SONAR_DATA_RANGES})},
    {PLAYER_SONAR_CODE, kRequestMessage, subtypes_of({PLAYER_SONAR_REQ_GET_GEOM})},
    {PLAYER_SPEECH_CODE, kCommandMessage, subtypes_of({PLAYER_SPEECH_CMD_SAY})},
    {PLAYER_WIFI_CODE, kDataMessage, subtypes_of({PLAYER_WIFI_DATA_STATE})},
};

}  // namespace

bool has_message(uint32_t interface, uint32_t type, uint32_t subtype) noexcept {
  return std::any_of(std::begin(kMessages), std::end(kMessages), [&](const MessageRow& row) {
    return row.interface == interface && row.type == type && subtype < 64 &&
           ((row.subtypes >> subtype) & 1U) != 0;
  });
}

const char* interface_name(int code) noexcept { return playerlike::player_interface_name(code); }

std::optional<int> interface_code(const std::string& name) noexcept {
  return playerlike::player_interface_code(name);
}

}  // namespace PlayerCc
