// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's data types as C programs know them: plain structs in the global namespace, under their
/// tags (struct player_pose2d) and with _t. Lengths in metres, angles in radians, angles
/// counter-clockwise. None has constructors, so they are initialised by braces: {x, y, a}. A field
/// X_count says how many elements X has.

#include <stddef.h>
#include <stdint.h>

#include "libplayerinterface/player_constants.h"

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

/// A value of a blackboard under its key and group, with the time of its last change.
typedef struct player_blackboard_entry {
  uint32_t key_count;
  char* key;
  uint32_t group_count;
  char* group;
  uint16_t type;
  uint16_t subtype;
  uint32_t data_count;
  uint8_t* data;
  uint32_t timestamp_sec;
  uint32_t timestamp_usec;
} player_blackboard_entry_t;

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

/// Asks whether a device knows a message of this type and subtype (PLAYER_CAPABILITIES_REQ).
typedef struct player_capabilities_req {
  uint32_t type;
  uint32_t subtype;
} player_capabilities_req_t;

/// Asks for a property that is a truth value, or sets it, by its name.
typedef struct player_boolprop_req {
  uint32_t key_count;
  char* key;
  char value;
} player_boolprop_req_t;

/// Asks for a property that is a whole number, or sets it, by its name.
typedef struct player_intprop_req {
  uint32_t key_count;
  char* key;
  int32_t value;
} player_intprop_req_t;

/// Asks for a property that is a number, or sets it, by its name.
typedef struct player_dblprop_req {
  uint32_t key_count;
  char* key;
  double value;
} player_dblprop_req_t;

/// Asks for a property that is a text, or sets it, by its name.
typedef struct player_strprop_req {
  uint32_t key_count;
  char* key;
  uint32_t value_count;
  char* value;
} player_strprop_req_t;

/// Addresses of all devices of a server.
typedef struct player_device_devlist {
  uint32_t devices_count;
  player_devaddr_t devices[PLAYER_MAX_DEVICES];
} player_device_devlist_t;

/// Name of the driver behind a device.
typedef struct player_device_driverinfo {
  player_devaddr_t addr;
  uint32_t driver_name_count;
  char driver_name[PLAYER_MAX_DRIVER_STRING_LEN];
} player_device_driverinfo_t;

/// Asks for access to a device, or gives it back; the answer has the driver's name.
typedef struct player_device_req {
  player_devaddr_t addr;
  uint8_t access;
  uint32_t driver_name_count;
  char driver_name[PLAYER_MAX_DRIVER_STRING_LEN];
} player_device_req_t;

/// Asks for data whenever there are some, or on request: PLAYER_DATAMODE_PUSH or _PULL.
typedef struct player_device_datamode_req {
  uint8_t mode;
} player_device_datamode_req_t;

/// A password.
typedef struct player_device_auth_req {
  uint32_t auth_key_count;
  uint8_t auth_key[PLAYER_KEYLEN];
} player_device_auth_req_t;

/// Asks for the port of a robot by its name.
typedef struct player_device_nameservice_req {
  uint32_t name_count;
  uint8_t name[PLAYER_MAX_DRIVER_STRING_LEN];
  uint16_t port;
} player_device_nameservice_req_t;

/// Sets whether messages of a kind replace older ones that wait; -1 stands for any.
typedef struct player_add_replace_rule_req {
  int32_t interf;
  int32_t index;
  int32_t type;
  int32_t subtype;
  int32_t replace;
} player_add_replace_rule_req_t;

/// State of a battery: which fields are valid (bits PLAYER_POWER_MASK_...), voltage [V], charge [%]
/// and [J], power taken [W], whether it is being charged.
typedef struct player_power_data {
  uint32_t valid;
  float volts;
  float percent;
  float joules;
  float watts;
  int32_t charging;
} player_power_data_t;

/// Sets whether a battery may be charged, and may charge others.
typedef struct player_power_chargepolicy_config {
  uint8_t enable_input;
  uint8_t enable_output;
} player_power_chargepolicy_config_t;

/// Pose [m, rad] and sizes [m] of a gripper, and how many break beams and places to store things it
/// has.
typedef struct player_gripper_geom {
  player_pose3d_t pose;
  player_bbox3d_t outer_size;
  player_bbox3d_t inner_size;
  uint8_t num_beams;
  uint8_t capacity;
} player_gripper_geom_t;

/// Pose [m, rad] and velocity [m/s, rad/s] of a robot, and whether it is stuck.
typedef struct player_position2d_data {
  player_pose2d_t pos;
  player_pose2d_t vel;
  uint8_t stall;
} player_position2d_data_t;

/// Sets velocities [m/s, rad/s], and whether the motors are on.
typedef struct player_position2d_cmd_vel {
  player_pose2d_t vel;
  uint8_t state;
} player_position2d_cmd_vel_t;

/// Sets a pose to go to [m, rad], the velocity to go with, and whether the motors are on.
typedef struct player_position2d_cmd_pos {
  player_pose2d_t pos;
  player_pose2d_t vel;
  uint8_t state;
} player_position2d_cmd_pos_t;

/// Sets the speed [m/s] and the steering angle [rad] of a car.
typedef struct player_position2d_cmd_car {
  double velocity;
  double angle;
} player_position2d_cmd_car_t;

/// Sets the speed [m/s] and the heading [rad] to turn to.
typedef struct player_position2d_cmd_vel_head {
  double velocity;
  double angle;
} player_position2d_cmd_vel_head_t;

/// Geometry of a robot.
typedef struct player_position2d_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
} player_position2d_geom_t;

/// Switches the motors on or off.
typedef struct player_position2d_power_config {
  uint8_t state;
} player_position2d_power_config_t;

/// Selects how velocities are kept.
typedef struct player_position2d_velocity_mode_config {
  uint32_t value;
} player_position2d_velocity_mode_config_t;

/// Selects between control of velocity (0) and of position (1).
typedef struct player_position2d_position_mode_req {
  uint32_t state;
} player_position2d_position_mode_req_t;

/// Sets the odometry to a pose [m, rad].
typedef struct player_position2d_set_odom_req {
  player_pose2d_t pose;
} player_position2d_set_odom_req_t;

/// Sets the factors of the controller of velocity.
typedef struct player_position2d_speed_pid_req {
  float kp;
  float ki;
  float kd;
} player_position2d_speed_pid_req_t;

/// Sets the factors of the controller of position.
typedef struct player_position2d_position_pid_req {
  float kp;
  float ki;
  float kd;
} player_position2d_position_pid_req_t;

/// Sets the greatest speed and acceleration on the way to a pose.
typedef struct player_position2d_speed_prof_req {
  float speed;
  float acc;
} player_position2d_speed_prof_req_t;

/// Ranges of a ring of sonars [m].
typedef struct player_sonar_data {
  uint32_t ranges_count;
  float* ranges;
} player_sonar_data_t;

/// Poses of the sonars of a ring on the robot [m, rad].
typedef struct player_sonar_geom {
  uint32_t poses_count;
  player_pose3d_t* poses;
} player_sonar_geom_t;

/// Switches the sonars on or off.
typedef struct player_sonar_power_config {
  uint8_t state;
} player_sonar_power_config_t;

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

/// Scan of a laser with the pose of the robot at that time [m, rad].
typedef struct player_laser_data_scanpose {
  player_laser_data_t scan;
  player_pose2d_t pose;
} player_laser_data_scanpose_t;

/// Scan of a laser with beams at any angles [rad].
typedef struct player_laser_data_scanangle {
  float max_range;
  uint32_t ranges_count;
  float* ranges;
  uint32_t angles_count;
  float* angles;
  uint32_t intensity_count;
  uint8_t* intensity;
  uint32_t id;
} player_laser_data_scanangle_t;

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

/// Switches a laser on or off.
typedef struct player_laser_power_config {
  uint8_t state;
} player_laser_power_config_t;

/// Serial number of a laser.
typedef struct player_laser_get_id_config {
  uint32_t serial_number;
} player_laser_get_id_config_t;

/// Sets how ranges are filtered.
typedef struct player_laser_set_filter_config {
  uint8_t filter_type;
  uint32_t parameters_count;
  float parameters[PLAYER_LASER_MAX_FILTER_PARAMS];
} player_laser_set_filter_config_t;

/// A blob of one colour in an image: middle, edges and area [pixels], range [m].
typedef struct player_blobfinder_blob {
  uint32_t id;
  uint32_t color;
  uint32_t area;
  uint32_t x;
  uint32_t y;
  uint32_t left;
  uint32_t right;
  uint32_t top;
  uint32_t bottom;
  float range;
} player_blobfinder_blob_t;

/// Blobs that a camera sees, and the size of its image [pixels].
typedef struct player_blobfinder_data {
  uint32_t width;
  uint32_t height;
  uint32_t blobs_count;
  player_blobfinder_blob_t* blobs;
} player_blobfinder_data_t;

/// Sets the range of colours that a channel looks for.
typedef struct player_blobfinder_color_config {
  uint32_t channel;
  uint32_t rmin;
  uint32_t rmax;
  uint32_t gmin;
  uint32_t gmax;
  uint32_t bmin;
  uint32_t bmax;
} player_blobfinder_color_config_t;

/// Sets brightness, contrast and the like of the camera.
typedef struct player_blobfinder_imager_config {
  int32_t brightness;
  int32_t contrast;
  int32_t colormode;
  int32_t autogain;
} player_blobfinder_imager_config_t;

/// Where a camera looks [rad], how fast it turns [rad/s], and its state.
typedef struct player_ptz_data {
  float pan;
  float tilt;
  float zoom;
  float panspeed;
  float tiltspeed;
  uint32_t status;
} player_ptz_data_t;

/// Sets where a camera looks [rad], or how fast it turns [rad/s].
typedef struct player_ptz_cmd {
  float pan;
  float tilt;
  float zoom;
  float panspeed;
  float tiltspeed;
} player_ptz_cmd_t;

/// State of a camera that turns.
typedef struct player_ptz_req_status {
  uint32_t status;
} player_ptz_req_status_t;

/// Pose [m, rad] and size [m] of a camera that turns.
typedef struct player_ptz_geom {
  player_pose3d_t pos;
  player_bbox3d_t size;
} player_ptz_geom_t;

/// Words for the camera itself, and its answer.
typedef struct player_ptz_req_generic {
  uint32_t config_count;
  uint32_t* config;
} player_ptz_req_generic_t;

/// Selects between control of position and of velocity.
typedef struct player_ptz_req_control_mode {
  uint32_t mode;
} player_ptz_req_control_mode_t;

/// A sound, in a format PLAYER_AUDIO_FORMAT_...
typedef struct player_audio_wav {
  uint32_t data_count;
  uint8_t* data;
  uint32_t format;
} player_audio_wav_t;

/// A tone: frequency [Hz], duration [s], amplitude 0 to 1, and whether the next one follows without
/// a break.
typedef struct player_audio_seq_item {
  float freq;
  float duration;
  float amplitude;
  player_bool_t link;
} player_audio_seq_item_t;

/// A sequence of tones.
typedef struct player_audio_seq {
  uint32_t tones_count;
  player_audio_seq_item_t* tones;
} player_audio_seq_t;

/// Level of a channel of a mixer, 0 to 1, and whether it is on.
typedef struct player_audio_mixer_channel {
  float amplitude;
  player_bool_t active;
  uint32_t index;
} player_audio_mixer_channel_t;

/// Levels of several channels of a mixer.
typedef struct player_audio_mixer_channel_list {
  uint32_t channels_count;
  player_audio_mixer_channel_t* channels;
} player_audio_mixer_channel_list_t;

/// Name of a channel of a mixer, and what it can do.
typedef struct player_audio_mixer_channel_detail {
  uint32_t name_count;
  char* name;
  uint8_t caps;
} player_audio_mixer_channel_detail_t;

/// All channels of a mixer, and those used by default.
typedef struct player_audio_mixer_channel_list_detail {
  uint32_t details_count;
  player_audio_mixer_channel_detail_t* details;
  int32_t default_output;
  int32_t default_input;
} player_audio_mixer_channel_list_detail_t;

/// A sound to be stored in a device, or fetched from it.
typedef struct player_audio_sample {
  player_audio_wav_t sample;
  int32_t index;
} player_audio_sample_t;

/// Number of a sound stored in a device.
typedef struct player_audio_sample_item {
  int32_t index;
} player_audio_sample_item_t;

/// Asks for a sound to be recorded into a device, of this length [ms].
typedef struct player_audio_sample_rec_req {
  int32_t index;
  uint32_t length;
} player_audio_sample_rec_req_t;

/// What a device of sound does: bits PLAYER_AUDIO_STATE_...
typedef struct player_audio_state {
  uint32_t state;
} player_audio_state_t;

/// A fiducial that is seen: number (-1: unknown), pose in the sensor's frame [m, rad], and how sure
/// that is.
typedef struct player_fiducial_item {
  int32_t id;
  player_pose3d_t pose;
  player_pose3d_t upose;
} player_fiducial_item_t;

/// Fiducials that are seen.
typedef struct player_fiducial_data {
  uint32_t fiducials_count;
  player_fiducial_item_t* fiducials;
} player_fiducial_data_t;

/// Pose [m, rad] and size [m] of a sensor of fiducials, and size of the fiducials [m].
typedef struct player_fiducial_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
  player_bbox2d_t fiducial_size;
} player_fiducial_geom_t;

/// Ranges [m] and angle of view [rad] of a sensor of fiducials.
typedef struct player_fiducial_fov {
  float min_range;
  float max_range;
  float view_angle;
} player_fiducial_fov_t;

/// Number of the fiducial that stands for the robot itself.
typedef struct player_fiducial_id {
  uint32_t id;
} player_fiducial_id_t;

/// A text to be said.
typedef struct player_speech_cmd {
  uint32_t string_count;
  char* string;
} player_speech_cmd_t;

/// Where a receiver is on the Earth: time [s, us], latitude and longitude [1e-7 degrees], altitude
/// [mm], UTM [m], and how good that is.
typedef struct player_gps_data {
  uint32_t time_sec;
  uint32_t time_usec;
  int32_t latitude;
  int32_t longitude;
  int32_t altitude;
  double speed;
  double course;
  double utm_e;
  double utm_n;
  uint32_t quality;
  uint32_t num_sats;
  uint32_t hdop;
  uint32_t vdop;
  double err_horz;
  double err_vert;
} player_gps_data_t;

/// Which bumpers are pressed: one byte each.
typedef struct player_bumper_data {
  uint32_t bumpers_count;
  uint8_t* bumpers;
} player_bumper_data_t;

/// Pose of a bumper's middle on the robot [m, rad], its length [m] and radius [m]; radius 0 is
/// straight.
typedef struct player_bumper_define {
  player_pose3d_t pose;
  float length;
  float radius;
} player_bumper_define_t;

/// Poses and shapes of all bumpers.
typedef struct player_bumper_geom {
  uint32_t bumper_def_count;
  player_bumper_define_t* bumper_def;
} player_bumper_geom_t;

/// Digital inputs: how many, and a bit each.
typedef struct player_dio_data {
  uint32_t count;
  uint32_t bits;
} player_dio_data_t;

/// Sets digital outputs: how many, and a bit each.
typedef struct player_dio_cmd {
  uint32_t count;
  uint32_t digout;
} player_dio_cmd_t;

/// Voltages of analogue inputs [V].
typedef struct player_aio_data {
  uint32_t voltages_count;
  float* voltages;
} player_aio_data_t;

/// Sets the voltage of an analogue output [V].
typedef struct player_aio_cmd {
  uint32_t id;
  float voltage;
} player_aio_cmd_t;

/// Voltages [V] and ranges [m] of infra-red sensors.
typedef struct player_ir_data {
  uint32_t voltages_count;
  float* voltages;
  uint32_t ranges_count;
  float* ranges;
} player_ir_data_t;

/// Poses of infra-red sensors on the robot [m, rad].
typedef struct player_ir_pose {
  uint32_t poses_count;
  player_pose3d_t* poses;
} player_ir_pose_t;

/// Switches infra-red sensors on or off.
typedef struct player_ir_power_req {
  uint8_t state;
} player_ir_power_req_t;

/// A radio link: addresses, name, mode, frequency, and quality, level and noise in the units that
/// the data say.
typedef struct player_wifi_link {
  uint32_t mac_count;
  uint8_t mac[32];
  uint32_t ip_count;
  uint8_t ip[32];
  uint32_t essid_count;
  uint8_t essid[32];
  uint32_t mode;
  uint32_t freq;
  uint32_t encrypt;
  uint32_t qual;
  uint32_t level;
  uint32_t noise;
} player_wifi_link_t;

/// Radio links that are heard, and which units their figures have.
typedef struct player_wifi_data {
  uint32_t links_count;
  player_wifi_link_t* links;
  uint32_t throughput;
  uint32_t bitrate;
  uint32_t mode;
  uint32_t qual_type;
  uint32_t maxqual;
  uint32_t maxlevel;
  uint32_t maxnoise;
  char ap[32];
} player_wifi_data_t;

/// Asks for the address of the radio itself; nothing to say with it.
typedef struct player_wifi_mac_req {
  uint32_t mac_count;
  uint8_t mac[32];
} player_wifi_mac_req_t;

/// Address of a radio to be watched.
typedef struct player_wifi_iwspy_addr_req {
  char address[32];
} player_wifi_iwspy_addr_req_t;

/// A pose that is thought possible [m, rad], its covariance (xx, yy, aa, xy, ya, xa) [m^2, rad^2, m
/// rad], and its weight, 0 to 1.
typedef struct player_localize_hypoth {
  player_pose2d_t mean;
  double cov[6];
  double alpha;
} player_localize_hypoth_t;

/// Poses that are thought possible, and how many readings wait to be looked at.
typedef struct player_localize_data {
  uint32_t pending_count;
  double pending_time;
  uint32_t hypoths_count;
  player_localize_hypoth_t* hypoths;
} player_localize_data_t;

/// Sets the pose [m, rad] and its covariance.
typedef struct player_localize_set_pose {
  player_pose2d_t mean;
  double cov[6];
} player_localize_set_pose_t;

/// A particle: pose [m, rad] and weight.
typedef struct player_localize_particle {
  player_pose2d_t pose;
  double alpha;
} player_localize_particle_t;

/// All particles, with their mean and variance.
typedef struct player_localize_get_particles {
  player_pose2d_t mean;
  double variance;
  uint32_t particles_count;
  player_localize_particle_t* particles;
} player_localize_get_particles_t;

/// Pose [m, rad] and velocity [m/s, rad/s] in space, and whether the robot is stuck.
typedef struct player_position3d_data {
  player_pose3d_t pos;
  player_pose3d_t vel;
  uint8_t stall;
} player_position3d_data_t;

/// Sets a pose to go to [m, rad] and a velocity to go with.
typedef struct player_position3d_cmd_pos {
  player_pose3d_t pos;
  player_pose3d_t vel;
  uint8_t state;
} player_position3d_cmd_pos_t;

/// Sets velocities [m/s, rad/s].
typedef struct player_position3d_cmd_vel {
  player_pose3d_t vel;
  uint8_t state;
} player_position3d_cmd_vel_t;

/// Pose [m, rad] and size [m] of a robot in space.
typedef struct player_position3d_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
} player_position3d_geom_t;

/// Switches the motors on or off.
typedef struct player_position3d_power_config {
  uint8_t state;
} player_position3d_power_config_t;

/// Selects between control of velocity (0) and of position (1).
typedef struct player_position3d_position_mode_req {
  uint32_t value;
} player_position3d_position_mode_req_t;

/// Selects how velocities are kept.
typedef struct player_position3d_velocity_mode_config {
  uint32_t value;
} player_position3d_velocity_mode_config_t;

/// Sets the odometry to a pose [m, rad].
typedef struct player_position3d_set_odom_req {
  player_pose3d_t pos;
} player_position3d_set_odom_req_t;

/// Sets the factors of the controller of velocity.
typedef struct player_position3d_speed_pid_req {
  float kp;
  float ki;
  float kd;
} player_position3d_speed_pid_req_t;

/// Sets the factors of the controller of position.
typedef struct player_position3d_position_pid_req {
  float kp;
  float ki;
  float kd;
} player_position3d_position_pid_req_t;

/// Sets the greatest speed and acceleration on the way to a pose.
typedef struct player_position3d_speed_prof_req {
  float speed;
  float acc;
} player_position3d_speed_prof_req_t;

/// Data of a simulation: none that means anything.
typedef struct player_simulation_data {
  uint8_t data;
} player_simulation_data_t;

/// A command to a simulation: none that means anything.
typedef struct player_simulation_cmd {
  uint8_t cmd;
} player_simulation_cmd_t;

/// Asks for the pose of a thing by its name [m, rad], or sets it.
typedef struct player_simulation_pose2d_req {
  uint32_t name_count;
  char* name;
  player_pose2d_t pose;
} player_simulation_pose2d_req_t;

/// Asks for the pose in space of a thing by its name [m, rad], or sets it; with the simulated time
/// [s].
typedef struct player_simulation_pose3d_req {
  uint32_t name_count;
  char* name;
  player_pose3d_t pose;
  double simtime;
} player_simulation_pose3d_req_t;

/// Asks for a property of a thing by their names, or sets it; what its bytes mean is the property's
/// matter.
typedef struct player_simulation_property_req {
  uint32_t name_count;
  char* name;
  uint32_t prop_count;
  char* prop;
  uint32_t index;
  uint32_t value_count;
  char* value;
} player_simulation_property_req_t;

/// State of a light: whether it is on, period [s], part of it that it shines, colour.
typedef struct player_blinkenlight_data {
  uint8_t enable;
  float period;
  float dutycycle;
  player_color_t color;
} player_blinkenlight_data_t;

/// Sets all of a light: whether it is on, period [s], part of it that it shines, colour.
typedef struct player_blinkenlight_cmd {
  uint16_t id;
  uint8_t enable;
  float period;
  float dutycycle;
  player_color_t color;
} player_blinkenlight_cmd_t;

/// Switches a light on or off.
typedef struct player_blinkenlight_cmd_power {
  uint16_t id;
  uint8_t enable;
} player_blinkenlight_cmd_power_t;

/// Sets the colour of a light.
typedef struct player_blinkenlight_cmd_color {
  uint16_t id;
  player_color_t color;
} player_blinkenlight_cmd_color_t;

/// Lets a light flash: period [s], and the part of it that it shines.
typedef struct player_blinkenlight_cmd_flash {
  uint16_t id;
  float period;
  float dutycycle;
} player_blinkenlight_cmd_flash_t;

/// An image: size [pixels], bits a pixel, PLAYER_CAMERA_FORMAT_... and PLAYER_CAMERA_COMPRESS_...
typedef struct player_camera_data {
  uint32_t width;
  uint32_t height;
  uint32_t bpp;
  uint32_t format;
  uint32_t fdiv;
  uint32_t compression;
  uint32_t image_count;
  uint8_t* image;
} player_camera_data_t;

/// Selects the norm and the input of a camera.
typedef struct player_camera_source {
  uint32_t norm_count;
  char* norm;
  int32_t source;
} player_camera_source_t;

/// Size of a map [cells], side of a cell [m], and pose of its lower left corner [m, rad].
typedef struct player_map_info {
  float scale;
  uint32_t width;
  uint32_t height;
  player_pose2d_t origin;
} player_map_info_t;

/// A tile of a map: its place and size [cells], and for each cell -1 free, 0 unknown, 1 occupied,
/// or as data_range says.
typedef struct player_map_data {
  uint32_t col;
  uint32_t row;
  uint32_t width;
  uint32_t height;
  uint32_t data_count;
  int8_t data_range;
  int8_t* data;
} player_map_data_t;

/// A map as line segments [m].
typedef struct player_map_data_vector {
  float minx;
  float maxx;
  float miny;
  float maxy;
  uint32_t segments_count;
  player_segment_t* segments;
} player_map_data_vector_t;

/// State of a planner: whether there is a way, whether it is done, pose, goal and next point [m,
/// rad].
typedef struct player_planner_data {
  uint8_t valid;
  uint8_t done;
  player_pose2d_t pos;
  player_pose2d_t goal;
  player_pose2d_t waypoint;
  int32_t waypoint_idx;
  uint32_t waypoints_count;
} player_planner_data_t;

/// Sets the goal [m, rad].
typedef struct player_planner_cmd {
  player_pose2d_t goal;
} player_planner_cmd_t;

/// The points of the way [m, rad], and its length [m].
typedef struct player_planner_waypoints_req {
  double waypoints_distance;
  uint32_t waypoints_count;
  player_pose2d_t* waypoints;
} player_planner_waypoints_req_t;

/// Lets the robot drive, or stops it.
typedef struct player_planner_enable_req {
  uint8_t state;
} player_planner_enable_req_t;

/// Starts or stops writing a log.
typedef struct player_log_set_write_state {
  uint8_t state;
} player_log_set_write_state_t;

/// Starts or stops reading a log.
typedef struct player_log_set_read_state {
  uint8_t state;
} player_log_set_read_state_t;

/// Whether a log is read or written (PLAYER_LOG_TYPE_...), and whether that goes on.
typedef struct player_log_get_state {
  uint8_t type;
  uint8_t state;
} player_log_get_state_t;

/// Sets the file of a log.
typedef struct player_log_set_filename {
  uint32_t filename_count;
  char filename[256];
} player_log_set_filename_t;

/// Axes of a joystick with their scales, and a bit for each button.
typedef struct player_joystick_data {
  int32_t pos[8];
  int32_t scale[8];
  uint32_t buttons;
  uint32_t axes_count;
} player_joystick_data_t;

/// What somebody said.
typedef struct player_speech_recognition_data {
  uint32_t text_count;
  char* text;
} player_speech_recognition_data_t;

/// Bytes whose meaning is the devices' and programs' own matter.
typedef struct player_opaque_data {
  uint32_t data_count;
  uint8_t* data;
} player_opaque_data_t;

/// Position and velocity of a single axis [m or rad, and each second], whether it is stuck, and
/// bits PLAYER_POSITION1D_STATUS_...
typedef struct player_position1d_data {
  float pos;
  float vel;
  uint8_t stall;
  uint8_t status;
} player_position1d_data_t;

/// Sets the velocity [m/s or rad/s].
typedef struct player_position1d_cmd_vel {
  float vel;
  uint8_t state;
} player_position1d_cmd_vel_t;

/// Sets a position to go to [m or rad] and a velocity to go with.
typedef struct player_position1d_cmd_pos {
  float pos;
  float vel;
  uint8_t state;
} player_position1d_cmd_pos_t;

/// Pose [m, rad] and size [m] of a single axis.
typedef struct player_position1d_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
} player_position1d_geom_t;

/// Switches the motor on or off.
typedef struct player_position1d_power_config {
  uint8_t state;
} player_position1d_power_config_t;

/// Selects how the velocity is kept.
typedef struct player_position1d_velocity_mode_config {
  uint32_t value;
} player_position1d_velocity_mode_config_t;

/// Sets the position to 0.
typedef struct player_position1d_reset_odom_config {
  uint32_t value;
} player_position1d_reset_odom_config_t;

/// Selects between control of velocity (0) and of position (1).
typedef struct player_position1d_position_mode_req {
  uint32_t state;
} player_position1d_position_mode_req_t;

/// Sets what the present position is called [m or rad].
typedef struct player_position1d_set_odom_req {
  float pos;
} player_position1d_set_odom_req_t;

/// Sets the factors of the controller of velocity.
typedef struct player_position1d_speed_pid_req {
  float kp;
  float ki;
  float kd;
} player_position1d_speed_pid_req_t;

/// Sets the factors of the controller of position.
typedef struct player_position1d_position_pid_req {
  float kp;
  float ki;
  float kd;
} player_position1d_position_pid_req_t;

/// Sets the greatest speed and acceleration on the way to a position.
typedef struct player_position1d_speed_prof_req {
  float speed;
  float acc;
} player_position1d_speed_prof_req_t;

/// State of an actuator: position [m or rad], speed, acceleration, current [A], and
/// PLAYER_ACTARRAY_ACTSTATE_...
typedef struct player_actarray_actuator {
  float position;
  float speed;
  float acceleration;
  float current;
  uint8_t state;
} player_actarray_actuator_t;

/// State of all actuators of a row, and whether they are on.
typedef struct player_actarray_data {
  uint32_t actuators_count;
  player_actarray_actuator_t* actuators;
  uint8_t motor_state;
} player_actarray_data_t;

/// Kind, size, axis and limits of an actuator [m or rad].
typedef struct player_actarray_actuatorgeom {
  uint8_t type;
  float length;
  player_orientation_3d_t orientation;
  player_point_3d_t axis;
  float min;
  float centre;
  float max;
  float home;
  float config_speed;
  uint8_t hasbrakes;
} player_actarray_actuatorgeom_t;

/// Kinds and sizes of all actuators of a row, and where it begins [m, rad].
typedef struct player_actarray_geom {
  uint32_t actuators_count;
  player_actarray_actuatorgeom_t* actuators;
  player_point_3d_t base_pos;
  player_orientation_3d_t base_orientation;
} player_actarray_geom_t;

/// Sends an actuator to a position [m or rad]; joint -1: all.
typedef struct player_actarray_position_cmd {
  int32_t joint;
  float position;
} player_actarray_position_cmd_t;

/// Sends the first actuators to positions [m or rad].
typedef struct player_actarray_multi_position_cmd {
  uint32_t positions_count;
  float* positions;
} player_actarray_multi_position_cmd_t;

/// Moves an actuator at a speed [m/s or rad/s]; joint -1: all.
typedef struct player_actarray_speed_cmd {
  int32_t joint;
  float speed;
} player_actarray_speed_cmd_t;

/// Moves the first actuators at speeds [m/s or rad/s].
typedef struct player_actarray_multi_speed_cmd {
  uint32_t speeds_count;
  float* speeds;
} player_actarray_multi_speed_cmd_t;

/// Sends an actuator home; joint -1: all.
typedef struct player_actarray_home_cmd {
  int32_t joint;
} player_actarray_home_cmd_t;

/// Sets the current of an actuator [A]; joint -1: all.
typedef struct player_actarray_current_cmd {
  int32_t joint;
  float current;
} player_actarray_current_cmd_t;

/// Sets the currents of the first actuators [A].
typedef struct player_actarray_multi_current_cmd {
  uint32_t currents_count;
  float* currents;
} player_actarray_multi_current_cmd_t;

/// Switches all actuators on or off.
typedef struct player_actarray_power_config {
  uint8_t value;
} player_actarray_power_config_t;

/// Puts all brakes on or off.
typedef struct player_actarray_brakes_config {
  uint8_t value;
} player_actarray_brakes_config_t;

/// Sets the speed of an actuator for going to positions; joint -1: all.
typedef struct player_actarray_speed_config {
  int32_t joint;
  float speed;
} player_actarray_speed_config_t;

/// Sets the acceleration of an actuator; joint -1: all.
typedef struct player_actarray_accel_config {
  int32_t joint;
  float accel;
} player_actarray_accel_config_t;

/// Position of an arm's end [m], the vectors along which and how turned it is, and
/// PLAYER_LIMB_STATE_...
typedef struct player_limb_data {
  player_point_3d_t position;
  player_point_3d_t approach;
  player_point_3d_t orientation;
  uint8_t state;
} player_limb_data_t;

/// Moves an arm's end to a position [m] with an approach and an orientation.
typedef struct player_limb_setpose_cmd {
  player_point_3d_t position;
  player_point_3d_t approach;
  player_point_3d_t orientation;
} player_limb_setpose_cmd_t;

/// Moves an arm's end to a position [m], however turned.
typedef struct player_limb_setposition_cmd {
  player_point_3d_t position;
} player_limb_setposition_cmd_t;

/// Moves an arm's end along a direction by a length [m].
typedef struct player_limb_vecmove_cmd {
  player_point_3d_t direction;
  float length;
} player_limb_vecmove_cmd_t;

/// Switches an arm on or off.
typedef struct player_limb_power_req {
  uint8_t value;
} player_limb_power_req_t;

/// Puts an arm's brakes on or off.
typedef struct player_limb_brakes_req {
  uint8_t value;
} player_limb_brakes_req_t;

/// Where an arm stands on the robot [m].
typedef struct player_limb_geom_req {
  player_point_3d_t basePos;
} player_limb_geom_req_t;

/// Sets the speed of an arm's end [m/s].
typedef struct player_limb_speed_req {
  float speed;
} player_limb_speed_req_t;

/// Draws points [m] in a colour.
typedef struct player_graphics2d_cmd_points {
  uint32_t points_count;
  player_point_2d_t* points;
  player_color_t color;
} player_graphics2d_cmd_points_t;

/// Draws a line through points [m] in a colour.
typedef struct player_graphics2d_cmd_polyline {
  uint32_t points_count;
  player_point_2d_t* points;
  player_color_t color;
} player_graphics2d_cmd_polyline_t;

/// Draws a polygon [m] with the colours of its edge and its inside, if that is filled.
typedef struct player_graphics2d_cmd_polygon {
  uint32_t points_count;
  player_point_2d_t* points;
  player_color_t color;
  player_color_t fill_color;
  uint8_t filled;
} player_graphics2d_cmd_polygon_t;

/// Draws a line between every two points [m] in a colour.
typedef struct player_graphics2d_cmd_multiline {
  uint32_t points_count;
  player_point_2d_t* points;
  player_color_t color;
} player_graphics2d_cmd_multiline_t;

/// A radio tag: its kind and its number as bytes.
typedef struct player_rfid_tag {
  uint32_t type;
  uint32_t guid_count;
  char* guid;
} player_rfid_tag_t;

/// Radio tags in reach.
typedef struct player_rfid_data {
  uint32_t tags_count;
  player_rfid_tag_t* tags;
} player_rfid_data_t;

/// Readings of a node of a sensor network; -1 for what it does not measure.
typedef struct player_wsn_node_data {
  float light;
  float mic;
  float accel_x;
  float accel_y;
  float accel_z;
  float magn_x;
  float magn_y;
  float magn_z;
  float temperature;
  float battery;
} player_wsn_node_data_t;

/// Kind and numbers of a node of a sensor network, with its readings.
typedef struct player_wsn_data {
  uint32_t node_type;
  uint32_t node_id;
  uint32_t node_parent_id;
  player_wsn_node_data_t data_packet;
} player_wsn_data_t;

/// Switches a device of nodes on or off.
typedef struct player_wsn_cmd {
  int32_t node_id;
  int32_t group_id;
  uint32_t device;
  uint8_t enable;
} player_wsn_cmd_t;

/// Switches nodes on or off.
typedef struct player_wsn_power_config {
  int32_t node_id;
  int32_t group_id;
  uint8_t value;
} player_wsn_power_config_t;

/// Selects whether readings are raw (0) or in SI units (1).
typedef struct player_wsn_datatype_config {
  uint8_t value;
} player_wsn_datatype_config_t;

/// Sets how often nodes tell of their readings [Hz].
typedef struct player_wsn_datafreq_config {
  int32_t node_id;
  int32_t group_id;
  double frequency;
} player_wsn_datafreq_config_t;

/// What the points of a drawing in space are joined to.
typedef enum player_graphics3d_draw_mode {
  PLAYER_DRAW_POINTS,
  PLAYER_DRAW_LINES,
  PLAYER_DRAW_LINE_STRIP,
  PLAYER_DRAW_LINE_LOOP,
  PLAYER_DRAW_TRIANGLES,
  PLAYER_DRAW_TRIANGLE_STRIP,
  PLAYER_DRAW_TRIANGLE_FAN,
  PLAYER_DRAW_QUADS,
  PLAYER_DRAW_QUAD_STRIP,
  PLAYER_DRAW_POLYGON
} player_graphics3d_draw_mode_t;

/// Draws points in space [m], or lines and faces between them, in a colour.
typedef struct player_graphics3d_cmd_draw {
  uint32_t draw_mode;
  uint32_t points_count;
  player_point_3d_t* points;
  player_color_t color;
} player_graphics3d_cmd_draw_t;

/// Moves the frame of what is drawn [m].
typedef struct player_graphics3d_cmd_translate {
  double x;
  double y;
  double z;
} player_graphics3d_cmd_translate_t;

/// Turns the frame of what is drawn by an angle [rad] about an axis.
typedef struct player_graphics3d_cmd_rotate {
  double a;
  double x;
  double y;
  double z;
} player_graphics3d_cmd_rotate_t;

/// Load of a processor [%].
typedef struct player_health_cpu {
  float idle;
  float system;
  float user;
} player_health_cpu_t;

/// Memory of a machine [kB].
typedef struct player_health_memory {
  int64_t total;
  int64_t used;
  int64_t free;
} player_health_memory_t;

/// Load of a machine: processor, memory and swap space.
typedef struct player_health_data {
  player_health_cpu_t cpu_usage;
  player_health_memory_t mem;
  player_health_memory_t swap;
} player_health_data_t;

/// Pose as an inertial unit knows it [m, rad].
typedef struct player_imu_data_state {
  player_pose3d_t pose;
} player_imu_data_state_t;

/// Accelerations [m/s^2], rates of turn [rad/s] and magnetic field along the axes of an inertial
/// unit.
typedef struct player_imu_data_calib {
  float accel_x;
  float accel_y;
  float accel_z;
  float gyro_x;
  float gyro_y;
  float gyro_z;
  float magn_x;
  float magn_y;
  float magn_z;
} player_imu_data_calib_t;

/// The same with the orientation as a quaternion: w, x, y, z.
typedef struct player_imu_data_quat {
  player_imu_data_calib_t calib_data;
  float q0;
  float q1;
  float q2;
  float q3;
} player_imu_data_quat_t;

/// The same with the orientation as roll, pitch and yaw [rad].
typedef struct player_imu_data_euler {
  player_imu_data_calib_t calib_data;
  player_orientation_3d_t orientation;
} player_imu_data_euler_t;

/// Pose, velocity and acceleration in space [m, rad, s].
typedef struct player_imu_data_fullstate {
  player_pose3d_t pose;
  player_pose3d_t vel;
  player_pose3d_t acc;
} player_imu_data_fullstate_t;

/// Selects the kind of data that are sent, by its subtype.
typedef struct player_imu_datatype_config {
  uint8_t value;
} player_imu_datatype_config_t;

/// Resets the orientation.
typedef struct player_imu_reset_orientation_config {
  uint32_t value;
} player_imu_reset_orientation_config_t;

/// Sets the orientation [rad].
typedef struct player_imu_reset_euler_config {
  player_pose3d_t orientation;
} player_imu_reset_euler_config_t;

/// A point in space [m] with its colour.
typedef struct player_pointcloud3d_element {
  player_point_3d_t point;
  player_color_t color;
} player_pointcloud3d_element_t;

/// Points in space.
typedef struct player_pointcloud3d_data {
  uint32_t points_count;
  player_pointcloud3d_element_t* points;
} player_pointcloud3d_data_t;

/// Settings of a ranger: angles [rad], ranges [m], their resolutions, and frequency [Hz].
typedef struct player_ranger_config {
  double min_angle;
  double max_angle;
  double angular_res;
  double min_range;
  double max_range;
  double range_res;
  double frequency;
} player_ranger_config_t;

/// Pose [m, rad] and size [m] of a ranger, and of each of its elements.
typedef struct player_ranger_geom {
  player_pose3d_t pose;
  player_bbox3d_t size;
  uint32_t element_poses_count;
  player_pose3d_t* element_poses;
  uint32_t element_sizes_count;
  player_bbox3d_t* element_sizes;
} player_ranger_geom_t;

/// Ranges [m].
typedef struct player_ranger_data_range {
  uint32_t ranges_count;
  double* ranges;
} player_ranger_data_range_t;

/// Ranges [m] with the geometry and the settings that they were measured with, where those changed.
typedef struct player_ranger_data_rangestamped {
  player_ranger_data_range_t data;
  uint8_t have_geom;
  player_ranger_geom_t geom;
  uint8_t have_config;
  player_ranger_config_t config;
} player_ranger_data_rangestamped_t;

/// Intensities of what came back.
typedef struct player_ranger_data_intns {
  uint32_t intensities_count;
  double* intensities;
} player_ranger_data_intns_t;

/// Intensities with the geometry and the settings that they were measured with, where those
/// changed.
typedef struct player_ranger_data_intnsstamped {
  player_ranger_data_intns_t data;
  uint8_t have_geom;
  player_ranger_geom_t geom;
  uint8_t have_config;
  player_ranger_config_t config;
} player_ranger_data_intnsstamped_t;

/// Switches a ranger on or off.
typedef struct player_ranger_power_config {
  uint8_t state;
} player_ranger_power_config_t;

/// Sets whether intensities are measured.
typedef struct player_ranger_intns_config {
  uint8_t state;
} player_ranger_intns_config_t;

/// A feature of a map: its name, its shape as well-known binary, and its attributes.
typedef struct player_vectormap_feature_data {
  uint32_t name_count;
  char* name;
  uint32_t wkb_count;
  uint8_t* wkb;
  uint32_t attrib_count;
  char* attrib;
} player_vectormap_feature_data_t;

/// Name and extent of a map's layer [m].
typedef struct player_vectormap_layer_info {
  uint32_t name_count;
  char* name;
  player_extent2d_t extent;
} player_vectormap_layer_info_t;

/// All features of a map's layer.
typedef struct player_vectormap_layer_data {
  uint32_t name_count;
  char* name;
  uint32_t features_count;
  player_vectormap_feature_data_t* features;
} player_vectormap_layer_data_t;

/// All layers of a map, and its frame by number.
typedef struct player_vectormap_info {
  uint32_t srid;
  uint32_t layers_count;
  player_vectormap_layer_info_t* layers;
  player_extent2d_t extent;
} player_vectormap_info_t;

/// A point that a stereo camera sees [m], with its colour.
typedef struct player_pointcloud3d_stereo_element {
  float px;
  float py;
  float pz;
  uint8_t red;
  uint8_t green;
  uint8_t blue;
} player_pointcloud3d_stereo_element_t;

/// Images of a stereo camera, their difference, and the points found in them.
typedef struct player_stereo_data {
  player_camera_data_t left_channel;
  player_camera_data_t right_channel;
  player_camera_data_t disparity;
  uint32_t points_count;
  player_pointcloud3d_stereo_element_t* points;
  uint32_t mode;
} player_stereo_data_t;

/// Which node of a sensor network a message comes from.
typedef struct player_coopobject_header {
  uint8_t origin;
  uint16_t id;
  uint16_t parent_id;
} player_coopobject_header_t;

/// Strength of a node's signal, with the time of the measurement and the place of the node [m].
typedef struct player_coopobject_rssi {
  player_coopobject_header_t header;
  uint16_t sender_id;
  uint16_t rssi;
  uint16_t stamp;
  uint32_t nodeTimeHigh;
  uint32_t nodeTimeLow;
  float x;
  float y;
  float z;
} player_coopobject_rssi_t;

/// Place [m] and state of a node.
typedef struct player_coopobject_position {
  player_coopobject_header_t header;
  float x;
  float y;
  float z;
  uint8_t status;
} player_coopobject_position_t;

/// A reading of a node's sensor, or an alarm.
typedef struct player_coopobject_sensor {
  uint8_t type;
  int16_t value;
} player_coopobject_sensor_t;

/// Readings, or alarms, of a node.
typedef struct player_coopobject_data_sensor {
  player_coopobject_header_t header;
  uint32_t data_count;
  player_coopobject_sensor_t* data;
} player_coopobject_data_sensor_t;

/// Bytes of a node whose meaning is the programs' own matter.
typedef struct player_coopobject_data_userdefined {
  player_coopobject_header_t header;
  uint8_t type;
  uint32_t data_count;
  uint8_t* data;
} player_coopobject_data_userdefined_t;

/// A request to a node with its parameters.
typedef struct player_coopobject_req {
  player_coopobject_header_t header;
  uint8_t request;
  uint32_t parameters_count;
  uint8_t* parameters;
} player_coopobject_req_t;

/// A command to a node with its parameters.
typedef struct player_coopobject_cmd {
  player_coopobject_header_t header;
  uint8_t command;
  uint32_t parameters_count;
  uint8_t* parameters;
} player_coopobject_cmd_t;

// Names of Player 2.0.

/// @deprecated Player 2.0's name of player_pose2d_t.
typedef player_pose2d_t player_pose_t;
/// @deprecated Player 2.0's name of player_bbox2d_t.
typedef player_bbox2d_t player_bbox_t;
