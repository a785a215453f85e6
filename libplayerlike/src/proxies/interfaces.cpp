// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "proxies/link.h"

namespace PlayerCc {
namespace {

struct InterfaceRow {
  int code;
  const char* name;
};
constexpr InterfaceRow kInterfaceNames[] = {
    {PLAYER_PLAYER_CODE, "player"},
    {PLAYER_POWER_CODE, "power"},
    {PLAYER_GRIPPER_CODE, "gripper"},
    {PLAYER_POSITION2D_CODE, "position2d"},
    {PLAYER_SONAR_CODE, "sonar"},
    {PLAYER_LASER_CODE, "laser"},
    {PLAYER_BLOBFINDER_CODE, "blobfinder"},
    {PLAYER_PTZ_CODE, "ptz"},
    {PLAYER_AUDIO_CODE, "audio"},
    {PLAYER_FIDUCIAL_CODE, "fiducial"},
    {PLAYER_SPEECH_CODE, "speech"},
    {PLAYER_GPS_CODE, "gps"},
    {PLAYER_BUMPER_CODE, "bumper"},
    {PLAYER_DIO_CODE, "dio"},
    {PLAYER_AIO_CODE, "aio"},
    {PLAYER_IR_CODE, "ir"},
    {PLAYER_WIFI_CODE, "wifi"},
    {PLAYER_LOCALIZE_CODE, "localize"},
    {PLAYER_POSITION3D_CODE, "position3d"},
    {PLAYER_SIMULATION_CODE, "simulation"},
    {PLAYER_BLINKENLIGHT_CODE, "blinkenlight"},
    {PLAYER_CAMERA_CODE, "camera"},
    {PLAYER_MAP_CODE, "map"},
    {PLAYER_PLANNER_CODE, "planner"},
    {PLAYER_LOG_CODE, "log"},
    {PLAYER_JOYSTICK_CODE, "joystick"},
    {PLAYER_SPEECH_RECOGNITION_CODE, "speech_recognition"},
    {PLAYER_OPAQUE_CODE, "opaque"},
    {PLAYER_POSITION1D_CODE, "position1d"},
    {PLAYER_ACTARRAY_CODE, "actarray"},
    {PLAYER_LIMB_CODE, "limb"},
    {PLAYER_GRAPHICS2D_CODE, "graphics2d"},
    {PLAYER_RFID_CODE, "rfid"},
    {PLAYER_WSN_CODE, "wsn"},
    {PLAYER_GRAPHICS3D_CODE, "graphics3d"},
    {PLAYER_HEALTH_CODE, "health"},
    {PLAYER_IMU_CODE, "imu"},
    {PLAYER_POINTCLOUD3D_CODE, "pointcloud3d"},
    {PLAYER_RANGER_CODE, "ranger"},
    {PLAYER_VECTORMAP_CODE, "vectormap"},
    {PLAYER_BLACKBOARD_CODE, "blackboard"},
    {PLAYER_STEREO_CODE, "stereo"},
    {PLAYER_COOPOBJECT_CODE, "coopobject"},
};

}  // namespace

const char* interface_name(int code) noexcept {
  for (const InterfaceRow& row : kInterfaceNames) {
    if (row.code == code) return row.name;
  }
  return nullptr;
}

std::optional<int> interface_code(const std::string& name) noexcept {
  for (const InterfaceRow& row : kInterfaceNames) {
    if (name == row.name) return row.code;
  }
  return std::nullopt;
}

}  // namespace PlayerCc
