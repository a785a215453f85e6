// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "libplayerc++/playerconstants.h"

/// @file
/// Player's data types as C programs know them: plain structs in the global namespace, under their
/// tags (struct player_pose2d) and with _t. Lengths in metres, angles in radians, angles
/// counter-clockwise. None has constructors, so they are initialised by braces: {x, y, a}.

/// Address of a device: robot is its port, interf an interface code, index counts from 0.
typedef struct player_devaddr {
  uint32_t host;
  uint32_t robot;
  uint16_t interf;
  uint16_t index;
} player_devaddr_t;

/// What every Player message begins with.
typedef struct player_msghdr {
  player_devaddr_t addr;
  uint8_t type;
  uint8_t subtype;
  double timestamp;
  uint32_t seq;
  uint32_t size;
} player_msghdr_t;

/// Point in a plane [m].
typedef struct player_point_2d {
  double px;
  double py;
} player_point_2d_t;

/// Point in space [m].
typedef struct player_point_3d {
  double px;
  double py;
  double pz;
} player_point_3d_t;

/// Orientation in space: roll, pitch, yaw [rad].
typedef struct player_orientation_3d {
  double proll;
  double ppitch;
  double pyaw;
} player_orientation_3d_t;

/// Pose in a plane, or velocity: position [m] and angle [rad].
typedef struct player_pose2d {
  double px;
  double py;
  double pa;
} player_pose2d_t;

/// Pose in space: position [m] and roll, pitch, yaw [rad].
typedef struct player_pose3d {
  double px;
  double py;
  double pz;
  double proll;
  double ppitch;
  double pyaw;
} player_pose3d_t;

/// Size of a rectangle: width (along y) and length (along x) [m].
typedef struct player_bbox2d {
  double sw;
  double sl;
} player_bbox2d_t;

/// Size of a box: width (along y), length (along x) and height [m].
typedef struct player_bbox3d {
  double sw;
  double sl;
  double sh;
} player_bbox3d_t;

/// Line segment between two points [m].
typedef struct player_segment {
  double x0;
  double y0;
  double x1;
  double y1;
} player_segment_t;

/// Rectangle between two corners [m].
typedef struct player_extent2d {
  double x0;
  double y0;
  double x1;
  double y1;
} player_extent2d_t;

/// Colour, 8 bits a channel; alpha 255 is opaque.
typedef struct player_color {
  uint8_t alpha;
  uint8_t red;
  uint8_t green;
  uint8_t blue;
} player_color_t;

/// A truth value.
typedef struct player_bool {
  uint8_t state;
} player_bool_t;

/// A whole number.
typedef struct player_uint32 {
  uint32_t value;
} player_uint32_t;

/// Reading of a position2d device.
typedef struct player_position2d_data {
  player_pose2d_t pos;
  player_pose2d_t vel;
  uint8_t stall;
} player_position2d_data_t;

/// Geometry of a robot.
typedef struct player_position2d_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
} player_position2d_geom_t;

/// Scan of a laser.
typedef struct player_laser_data {
  float min_angle;
  float max_angle;
  float resolution;
  float max_range;
  uint32_t ranges_count;
  float* ranges;
  uint32_t intensity_count;
  uint8_t* intensity;
  uint32_t id;
} player_laser_data_t;

/// Geometry of a laser.
typedef struct player_laser_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
} player_laser_geom_t;

/// Settings of a laser.
typedef struct player_laser_config {
  float min_angle;
  float max_angle;
  float resolution;
  float max_range;
  float range_res;
  uint8_t intensity;
  float scanning_frequency;
} player_laser_config_t;

/// A device in the list that PlayerClient::GetDeviceList() returns.
typedef struct playerc_device_info {
  player_devaddr_t addr;
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];
} playerc_device_info_t;

/// A connection, to Player's C client library. Opaque: the C library itself is not here.
typedef struct _playerc_client_t playerc_client_t;
/// Receives a message in Player's C client library; not called here.
typedef void (*playerc_putmsg_fn_t)(void* device, char* header, char* data);

/// What Player's C client library knows of a subscribed device. ClientProxy keeps the fields up to
/// fresh current for subclasses that look at them; client is always null.
typedef struct _playerc_device_t {
  void* id;
  playerc_client_t* client;
  player_devaddr_t addr;
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];
  int subscribed;
  double datatime;  ///< of the newest reading [s of simulated time]; 0 before the first
  double lasttime;  ///< of the one before it
  int fresh;
  int freshgeom;
  int freshconfig;
  playerc_putmsg_fn_t putmsg;
  void* user_data;
} playerc_device_t;
