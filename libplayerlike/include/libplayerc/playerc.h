// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's C client library: what programs in C include, and C++ programs that look below the
/// proxies. Works on the same simulations as libplayerc++.
///
/// Functions return 0 for success and -1 for an error, unless said otherwise, those that return
/// pointers null; playerc_error_str() then says why. A device that a call needs and that is null or
/// not subscribed to is an error too. Arrays belong to the struct that points to them, until the
/// device is destroyed; they may move with each new reading.
///
/// Threads: a client and its devices are used by one thread at a time; different clients are
/// independent of each other.

#include <netinet/in.h>
#include <poll.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "libplayercommon/playercommon.h"
#include "libplayerinterface/interface_util.h"
#include "libplayerinterface/player.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Messages that a client keeps until they are read, at most.
#define PLAYERC_QUEUE_RING_SIZE 512

/// Number of a cell of a map (playerc_map_t*) in its array, by column and row.
#define PLAYERC_MAP_INDEX(dev, i, j) (((dev)->width) * (j) + (i))

struct _playerc_client_t;
struct _playerc_device_t;

/// Receives a message of a device. Never called here, since no messages are sent in this process.
typedef void (*playerc_putmsg_fn_t)(void* device, char* header, char* data);
/// Is called with its own data after a device has new data.
typedef void (*playerc_callback_fn_t)(void* data);
/// How a message is packed; opaque, since nothing is packed here.
typedef struct playerxdr_function playerxdr_function_t;
/// Reader of features of a vector map; opaque.
typedef struct playerwkbprocessor* playerwkbprocessor_t;
/// A blob of one colour in a camera's image.
typedef player_blobfinder_blob_t playerc_blobfinder_blob_t;
/// A point of a cloud.
typedef player_pointcloud3d_element_t playerc_pointcloud3d_element_t;
/// A point that a stereo camera sees, with its colour.
typedef player_pointcloud3d_stereo_element_t playerc_pointcloud3d_stereo_element_t;

/// A message that waits in a client. Not used here: what is new lies in the devices.
typedef struct playerc_client_item {
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_msghdr_t header;
  void* data;
  /// @}
} playerc_client_item_t;

/// Several clients that are read together by one thread.
typedef struct _playerc_mclient_t {
  int client_count;                       ///< how many
  struct _playerc_client_t* client[128];  ///< the clients, in the order in which they came
  struct pollfd* pollfd;                  ///< not used: null
  double time;                            ///< data time of the newest data that were read [s]
} playerc_mclient_t;

/// A device in the list of what a port offers.
typedef struct playerc_device_info {
  player_devaddr_t addr;                          ///< robot is the port
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];  ///< kind of device, as world files name it
} playerc_device_info_t;

/// A client: the connection to one port of a simulation.
typedef struct _playerc_client_t {
  void* id;                   ///< this client, as playerc_client_read() returns it
  char* host;                 ///< as given
  int port;                   ///< as given
  int transport;              ///< as set; it makes no difference
  struct sockaddr_in server;  ///< not used
  int connected;              ///< 1 between connect and disconnect
  int retry_limit;            ///< see playerc_client_set_retry_limit()
  double retry_time;          ///< see playerc_client_set_retry_time() [s]
  uint32_t overflow_count;    ///< readings dropped since they waited too long
  int sock;                   ///< not used: -1
  uint8_t mode;               ///< PLAYERC_DATAMODE_PUSH (at first) or PLAYERC_DATAMODE_PULL
  int data_requested;         ///< not used
  int data_received;          ///< not used
  playerc_device_info_t
      devinfos[PLAYER_MAX_DEVICES];  ///< devices of the port, after playerc_client_get_devlist()
  int devinfo_count;                 ///< how many
  struct _playerc_device_t* device[PLAYER_MAX_DEVICES];  ///< devices that were made for this client
  int device_count;                                      ///< how many
  playerc_client_item_t qitems[PLAYERC_QUEUE_RING_SIZE];  ///< not used
  int qfirst;                                             ///< not used
  int qlen;                 ///< devices with data that playerc_client_read() has not returned yet
  int qsize;                ///< not used
  char* data;               ///< not used
  char* read_xdrdata;       ///< not used
  size_t read_xdrdata_len;  ///< not used
  double datatime;          ///< simulated time of the newest data that were read [s]
  double lasttime;          ///< the same of the data before [s]
  double request_timeout;   ///< see playerc_client_set_request_timeout() [s]
} playerc_client_t;

/// What all devices have in common. Proxies of libplayerc++ keep the fields up to fresh current
/// too, for subclasses that look at them (client is then null).
typedef struct _playerc_device_t {
  void* id;  ///< the struct that this one begins, as playerc_client_read() returns it
  playerc_client_t* client;  ///< null once it is destroyed
  player_devaddr_t addr;     ///< interface and index; robot is the port, after subscribing
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];  ///< kind of device, as world files name it
  int subscribed;                                 ///< whether it is
  double datatime;                                ///< simulated time of the newest data [s]
  double lasttime;                                ///< the same of the data before [s]
  int fresh;                          ///< set to 1 by new data; the program sets it to 0
  int freshgeom;                      ///< set to 1 by get_geom; the program sets it to 0
  int freshconfig;                    ///< set to 1 by get_config; the program sets it to 0
  playerc_putmsg_fn_t putmsg;         ///< as given to playerc_device_init(); never called
  void* user_data;                    ///< the program's
  int callback_count;                 ///< how many callbacks there are
  playerc_callback_fn_t callback[4];  ///< see playerc_client_addcallback()
  void* callback_data[4];             ///< what they are called with
} playerc_device_t;

/// Analog inputs and outputs.
typedef struct playerc_aio {
  playerc_device_t info;   ///< common to all devices
  uint8_t voltages_count;  ///< how many inputs
  float* voltages;         ///< what they read [V]
} playerc_aio_t;

/// An actarray device, which no world has.
typedef struct playerc_actarray {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint32_t actuators_count;
  player_actarray_actuator_t* actuators_data;
  uint32_t actuators_geom_count;
  player_actarray_actuatorgeom_t* actuators_geom;
  uint8_t motor_state;
  player_point_3d_t base_pos;
  player_orientation_3d_t base_orientation;
  /// @}
} playerc_actarray_t;

/// An audio device, which no world has.
typedef struct playerc_audio {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_audio_mixer_channel_list_detail_t channel_details_list;
  player_audio_wav_t wav_data;
  player_audio_seq_t seq_data;
  player_audio_mixer_channel_list_t mixer_data;
  uint32_t state;
  int last_index;
  /// @}
} playerc_audio_t;

/// A blackboard device, which no world has.
typedef struct playerc_blackboard {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  void (*on_blackboard_event)(struct playerc_blackboard*, player_blackboard_entry_t);
  void* py_private;
  /// @}
} playerc_blackboard_t;

/// A light.
typedef struct playerc_blinkenlight {
  playerc_device_t info;  ///< common to all devices
  uint32_t enabled;       ///< whether it is on
  double duty_cycle;      ///< part of a period in which it is on, 0 to 1
  double period;          ///< of blinking [s]
  uint8_t red;            ///< 0 to 255
  uint8_t green;          ///< 0 to 255
  uint8_t blue;           ///< 0 to 255
} playerc_blinkenlight_t;

/// Blobs of colour in view.
typedef struct playerc_blobfinder {
  playerc_device_t info;             ///< common to all devices
  unsigned int width;                ///< of the picture [pixels]
  unsigned int height;               ///< [pixels]
  unsigned int blobs_count;          ///< how many are in view
  playerc_blobfinder_blob_t* blobs;  ///< from right to left
} playerc_blobfinder_t;

/// Bumpers.
typedef struct playerc_bumper {
  playerc_device_t info;          ///< common to all devices
  int pose_count;                 ///< how many have a pose
  player_bumper_define_t* poses;  ///< where they are; after get_geom
  int bumper_count;               ///< how many
  uint8_t* bumpers;               ///< 1: pressed
} playerc_bumper_t;

/// A camera.
typedef struct playerc_camera {
  playerc_device_t info;  ///< common to all devices
  int width;              ///< [pixels]
  int height;             ///< [pixels]
  int bpp;                ///< bits a pixel: 24
  int format;             ///< PLAYER_CAMERA_FORMAT_RGB888
  int fdiv;               ///< 1
  int compression;        ///< PLAYER_CAMERA_COMPRESS_RAW
  int image_count;        ///< [bytes]
  uint8_t* image;         ///< red, green and blue of each pixel, row by row from the top
  char norm[16];          ///< empty
  int source;             ///< 0
} playerc_camera_t;

/// A coopobject device, which no world has.
typedef struct playerc_coopobject {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  int messageType;
  uint8_t origin;
  uint16_t id;
  uint16_t parent_id;
  uint16_t RSSIsender;
  uint16_t RSSIvalue;
  uint16_t RSSIstamp;
  uint32_t RSSInodeTimeHigh;
  uint32_t RSSInodeTimeLow;
  float x;
  float y;
  float z;
  uint8_t status;
  uint32_t sensor_data_count;
  player_coopobject_sensor_t* sensor_data;
  uint32_t alarm_data_count;
  player_coopobject_sensor_t* alarm_data;
  uint32_t user_data_count;
  uint8_t* user_data;
  uint8_t command;
  uint8_t request;
  uint32_t parameters_count;
  uint8_t* parameters;
  /// @}
} playerc_coopobject_t;

/// Digital inputs and outputs.
typedef struct playerc_dio {
  playerc_device_t info;  ///< common to all devices
  uint8_t count;          ///< how many inputs
  uint32_t digin;         ///< a bit an input, the lowest is input 0
} playerc_dio_t;

/// A finder of marked things.
typedef struct playerc_fiducial {
  playerc_device_t info;                 ///< common to all devices
  player_fiducial_geom_t fiducial_geom;  ///< after get_geom
  int fiducials_count;                   ///< how many are in view
  player_fiducial_item_t* fiducials;     ///< in the frame of the device
} playerc_fiducial_t;

/// A receiver of satellites' signals.
typedef struct playerc_gps {
  playerc_device_t info;  ///< common to all devices
  double utc_time;        ///< [s]
  double lat;             ///< latitude [degrees], north is positive
  double lon;             ///< longitude [degrees], east is positive
  double alt;             ///< altitude [m]
  double speed;           ///< over ground [m/s]
  double course;          ///< direction of motion
  double utm_e;           ///< easting [m]
  double utm_n;           ///< northing [m]
  double hdop;            ///< horizontal dilution of precision
  double vdop;            ///< vertical dilution of precision
  double err_horz;        ///< horizontal error [m]
  double err_vert;        ///< vertical error [m]
  int quality;            ///< 0: no fix, 1: fix
  int sat_count;          ///< satellites in view
} playerc_gps_t;

/// A sheet over the arena to draw on.
typedef struct playerc_graphics2d {
  playerc_device_t info;  ///< common to all devices
  player_color_t color;   ///< of what is drawn next
} playerc_graphics2d_t;

/// A graphics3d device, which no world has.
typedef struct playerc_graphics3d {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_color_t color;
  /// @}
} playerc_graphics3d_t;

/// A gripper; see playerc_gripper_get_geom() for what tells of its geometry.
typedef struct playerc_gripper {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_pose3d_t pose;
  player_bbox3d_t outer_size;
  player_bbox3d_t inner_size;
  uint8_t num_beams;
  uint8_t capacity;
  uint8_t state;
  uint32_t beams;
  uint8_t stored;
  /// @}
} playerc_gripper_t;

/// A health device, which no world has.
typedef struct playerc_health {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_health_cpu_t cpu_usage;
  player_health_memory_t mem;
  player_health_memory_t swap;
  /// @}
} playerc_health_t;

/// Infra-red rangers.
typedef struct playerc_ir {
  playerc_device_t info;   ///< common to all devices
  player_ir_data_t data;   ///< ranges [m] and voltages [V]
  player_ir_pose_t poses;  ///< where they are; after get_geom
} playerc_ir_t;

/// A joystick device, which no world has.
typedef struct playerc_joystick {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  int32_t axes_count;
  int32_t pos[8];
  uint32_t buttons;
  int* axes_max;
  int* axes_min;
  double* scale_pos;
  /// @}
} playerc_joystick_t;

/// A scanning laser range finder. Beams are counted counter-clockwise: 0 is the rightmost.
typedef struct playerc_laser {
  playerc_device_t info;  ///< common to all devices
  double pose[3];         ///< pose of the device on its robot: x, y [m], yaw [rad]; after get_geom
  double size[2];         ///< length and width [m]; after get_geom
  double robot_pose[3];   ///< where the robot was: x, y [m], yaw [rad]
  int intensity_on;       ///< whether there are intensities: 0
  int scan_count;         ///< beams; 0 before the first scan
  double scan_start;      ///< bearing of the first beam [rad]
  double scan_res;        ///< between neighbouring beams [rad]
  double range_res;       ///< [m]
  double max_range;       ///< [m]
  double scanning_frequency;  ///< [Hz]
  double* ranges;             ///< [m]; max_range where nothing is met
  double (*scan)[2];          ///< range [m] and bearing [rad]
  player_point_2d_t* point;   ///< where the beams end, in the frame of the laser [m]
  int* intensity;             ///< all 0
  int scan_id;                ///< grows by one a scan
  int laser_id;               ///< after get_id
  double min_right;           ///< least range of the right half of the beams [m]
  double min_left;            ///< least range of the left half [m]
} playerc_laser_t;

/// A limb device, which no world has.
typedef struct playerc_limb {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  player_limb_data_t data;
  player_limb_geom_req_t geom;
  /// @}
} playerc_limb_t;

/// A sample of where a robot may be.
typedef struct playerc_localize_particle {
  double pose[3];  ///< x, y [m], yaw [rad]
  double weight;   ///< of the sample
} playerc_localize_particle_t;

/// A localiser: where the robot may be.
typedef struct playerc_localize {
  playerc_device_t info;                   ///< common to all devices
  int map_size_x;                          ///< 0: no map is used, see playerc_map_t
  int map_size_y;                          ///< 0
  double map_scale;                        ///< 0
  int map_tile_x;                          ///< 0
  int map_tile_y;                          ///< 0
  int8_t* map_cells;                       ///< null
  int pending_count;                       ///< readings that wait to be looked at: 0
  double pending_time;                     ///< simulated time of the last one looked at [s]
  int hypoth_count;                        ///< poses that are thought possible
  player_localize_hypoth_t* hypoths;       ///< the poses
  double mean[3];                          ///< the best: x, y [m], yaw [rad]; after get_particles
  double variance;                         ///< its variance, of x and of y [m^2]
  int num_particles;                       ///< samples; after get_particles
  playerc_localize_particle_t* particles;  ///< the samples
} playerc_localize_t;

/// A recorder.
typedef struct playerc_log {
  playerc_device_t info;  ///< common to all devices
  int type;               ///< PLAYER_LOG_TYPE_READ or _WRITE
  int state;              ///< whether it is at work
} playerc_log_t;

/// The map of the world, as a grid. Column 0 is the leftmost, row 0 the lowest.
typedef struct playerc_map {
  playerc_device_t info;  ///< common to all devices
  double resolution;      ///< side of a cell [m]
  int width;              ///< columns
  int height;             ///< rows
  double origin[2];       ///< x and y of the lower left corner [m]
  int8_t data_range;      ///< value of occupied cells
  char* cells;       ///< -data_range: free, 0: unknown, data_range: occupied; see PLAYERC_MAP_INDEX
  double vminx;      ///< not used
  double vminy;      ///< not used
  double vmaxx;      ///< not used
  double vmaxy;      ///< not used
  int num_segments;  ///< 0
  player_segment_t* segments;  ///< null
} playerc_map_t;

/// A vectormap device, which no world has.
typedef struct playerc_vectormap {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint32_t srid;
  player_extent2d_t extent;
  uint32_t layers_count;
  player_vectormap_layer_data_t** layers_data;
  player_vectormap_layer_info_t** layers_info;
  playerwkbprocessor_t wkbprocessor;
  /// @}
} playerc_vectormap_t;

/// Bytes that only programs understand.
typedef struct playerc_opaque {
  playerc_device_t info;  ///< common to all devices
  int data_count;         ///< how many
  uint8_t* data;          ///< the newest
} playerc_opaque_t;

/// A planner device, which no world has.
typedef struct playerc_planner {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  int path_valid;
  int path_done;
  double px;
  double py;
  double pa;
  double gx;
  double gy;
  double ga;
  double wx;
  double wy;
  double wa;
  int curr_waypoint;
  int waypoint_count;
  double (*waypoints)[3];
  double waypoint_distance;
  /// @}
} playerc_planner_t;

/// A position1d device, which no world has.
typedef struct playerc_position1d {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  double pose[3];
  double size[2];
  double pos;
  double vel;
  int stall;
  int status;
  /// @}
} playerc_position1d_t;

/// A mobile base: odometry or localisation, and motors.
typedef struct playerc_position2d {
  playerc_device_t info;  ///< common to all devices
  double pose[3];         ///< pose of the device on its robot: x, y [m], yaw [rad]; after get_geom
  double size[2];         ///< length and width [m]; after get_geom
  double px;              ///< x [m]
  double py;              ///< y [m]
  double pa;              ///< yaw [rad]
  double vx;              ///< forward speed [m/s]
  double vy;              ///< speed to the left [m/s]
  double va;              ///< turn rate [rad/s]
  int stall;              ///< 1: the motors strive in vain
} playerc_position2d_t;

/// A position3d device, which no world has.
typedef struct playerc_position3d {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  double pose[3];
  double size[2];
  double pos_x;
  double pos_y;
  double pos_z;
  double pos_roll;
  double pos_pitch;
  double pos_yaw;
  double vel_x;
  double vel_y;
  double vel_z;
  double vel_roll;
  double vel_pitch;
  double vel_yaw;
  int stall;
  /// @}
} playerc_position3d_t;

/// A battery.
typedef struct playerc_power {
  playerc_device_t info;  ///< common to all devices
  int valid;              ///< which values there are: PLAYER_POWER_MASK_...
  double charge;          ///< [V]
  double percent;         ///< of a full battery
  double joules;          ///< what is left [J]
  double watts;           ///< what goes out [W]; in, if negative
  int charging;           ///< 1: in a dock
} playerc_power_t;

/// A head that pans, tilts and zooms.
typedef struct playerc_ptz {
  playerc_device_t info;  ///< common to all devices
  double pan;             ///< to the left [rad]
  double tilt;            ///< upwards [rad]
  double zoom;            ///< field of view [rad]
  int status;             ///< 1: on its way
} playerc_ptz_t;

/// Any range finder: a laser, sonars, infra-red rangers.
typedef struct playerc_ranger {
  playerc_device_t info;   ///< common to all devices
  uint32_t element_count;  ///< sensors; after get_geom
  double min_angle;        ///< of the first beam [rad], with the other settings after get_config
  double max_angle;        ///< of the last [rad]
  double angular_res;      ///< between beams [rad]
  double min_range;        ///< [m]
  double max_range;        ///< [m]
  double range_res;        ///< [m]
  double frequency;        ///< [Hz]
  player_pose3d_t device_pose;     ///< on the robot
  player_bbox3d_t device_size;     ///< [m]
  player_pose3d_t* element_poses;  ///< of each sensor
  player_bbox3d_t* element_sizes;  ///< of each sensor [m]
  uint32_t ranges_count;           ///< how many
  double* ranges;                  ///< [m]
  uint32_t intensities_count;      ///< how many
  double* intensities;             ///< of echoes
  uint32_t bearings_count;         ///< how many
  double* bearings;                ///< of each range [rad]
  uint32_t points_count;           ///< how many
  player_point_3d_t* points;       ///< where the ranges end [m]
} playerc_ranger_t;

/// Sonars.
typedef struct playerc_sonar {
  playerc_device_t info;   ///< common to all devices
  int pose_count;          ///< how many have a pose
  player_pose3d_t* poses;  ///< where they are; after get_geom
  int scan_count;          ///< how many ranges
  double* scan;            ///< [m]
} playerc_sonar_t;

/// A link to another station.
typedef struct playerc_wifi_link {
  uint8_t mac[32];    ///< its address
  uint8_t ip[32];     ///< its address
  uint8_t essid[32];  ///< name of the network
  int mode;           ///< PLAYER_WIFI_MODE_...
  int encrypt;        ///< whether it is encrypted
  double freq;        ///< [MHz]
  int qual;           ///< quality
  int level;          ///< signal
  int noise;          ///< noise
} playerc_wifi_link_t;

/// A radio.
typedef struct playerc_wifi {
  playerc_device_t info;       ///< common to all devices
  playerc_wifi_link_t* links;  ///< stations in reach
  int link_count;              ///< how many
  char ip[32];                 ///< own address
} playerc_wifi_t;

/// The simulation itself.
typedef struct playerc_simulation {
  playerc_device_t info;  ///< common to all devices
} playerc_simulation_t;

/// A voice.
typedef struct playerc_speech {
  playerc_device_t info;  ///< common to all devices
} playerc_speech_t;

/// A speechrecognition device, which no world has.
typedef struct playerc_speechrecognition {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  char* rawText;
  char** words;
  int wordCount;
  /// @}
} playerc_speechrecognition_t;

/// A tag that was read.
typedef struct playerc_rfidtag {
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint32_t type;
  uint32_t guid_count;
  uint8_t* guid;
  /// @}
} playerc_rfidtag_t;

/// A rfid device, which no world has.
typedef struct playerc_rfid {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint16_t tags_count;
  playerc_rfidtag_t* tags;
  /// @}
} playerc_rfid_t;

/// A pointcloud3d device, which no world has.
typedef struct playerc_pointcloud3d {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint16_t points_count;
  playerc_pointcloud3d_element_t* points;
  /// @}
} playerc_pointcloud3d_t;

/// A stereo device, which no world has.
typedef struct playerc_stereo {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  playerc_camera_t left_channel;
  playerc_camera_t right_channel;
  playerc_camera_t disparity;
  uint32_t points_count;
  playerc_pointcloud3d_stereo_element_t* points;
  /// @}
} playerc_stereo_t;

/// An inertial measurement unit.
typedef struct playerc_imu {
  playerc_device_t info;               ///< common to all devices
  player_pose3d_t pose;                ///< orientation [rad] (and position, where known [m])
  player_pose3d_t vel;                 ///< turn rates about x, y and z [rad/s]
  player_pose3d_t acc;                 ///< acceleration along x, y and z [m/s^2]
  player_imu_data_calib_t calib_data;  ///< acceleration [m/s^2], turn rates [rad/s], magnetic field
  float q0;                            ///< orientation as a quaternion: real part
  float q1;                            ///< x
  float q2;                            ///< y
  float q3;                            ///< z
} playerc_imu_t;

/// A wsn device, which no world has.
typedef struct playerc_wsn {
  playerc_device_t info;  ///< common to all devices
  /// @{
  /// As in the messages of the interface (libplayerinterface/player_structs.h).
  uint32_t node_type;
  uint32_t node_id;
  uint32_t node_parent_id;
  player_wsn_node_data_t data_packet;
  /// @}
} playerc_wsn_t;

/// @name Errors and messages
/// @{

/// Why the last call of this thread failed, a sentence for a person: "" if none has. Valid until
/// the next call that fails.
const char* playerc_error_str(void);
/// Fails: nothing is packed into messages here, so there is no table of ways to do it.
int playerc_add_xdr_ftable(playerxdr_function_t* flist, int replace);
/// @}

/// @name Several clients at once
/// @{

/// Makes a list of clients that are read together. @return null if there is no memory left.
playerc_mclient_t* playerc_mclient_create(void);
/// Forgets the list; its clients stay.
void playerc_mclient_destroy(playerc_mclient_t* mclient);
/// Adds a client. @return 0, or -1 if there are 128 already.
int playerc_mclient_addclient(playerc_mclient_t* mclient, struct _playerc_client_t* client);
/// Whether any of the clients has data, waiting for so long [ms] (< 0: until there are some).
/// Simulated time, in lockstep; as many steps pass as it takes.
/// @return 1 if so, 0 if not, -1 if there is no client that is connected.
int playerc_mclient_peek(playerc_mclient_t* mclient, int timeout);
/// As playerc_mclient_peek(), then reads one device of each client that has data, as
/// playerc_client_read() does.
/// @return how many clients were read, 0 if none has data, -1 if none could be read.
int playerc_mclient_read(playerc_mclient_t* mclient, int timeout);
/// @}

/// @name Clients
/// @{

/// Makes a client; nothing is connected yet. Hosts and ports mean what they mean to PlayerClient.
/// @param mclient  the list it becomes part of, or null.
/// @return null if there is no memory left.
playerc_client_t* playerc_client_create(playerc_mclient_t* mclient, const char* host, int port);
/// Disconnects. Its devices stay until they are destroyed, and get no more data.
void playerc_client_destroy(playerc_client_t* client);
/// PLAYERC_TRANSPORT_TCP or PLAYERC_TRANSPORT_UDP; it makes no difference.
void playerc_client_set_transport(playerc_client_t* client, unsigned int transport);
/// Connects. @return -1 for a port that no robot has, a world file that is not sound, a server that
/// is not there, ...
int playerc_client_connect(playerc_client_t* client);
/// Disconnects, and ends the subscriptions of all devices.
int playerc_client_disconnect(playerc_client_t* client);
/// Connects anew, as often as playerc_client_set_retry_limit() says, and subscribes to what was
/// subscribed to.
int playerc_client_disconnect_retry(playerc_client_t* client);
/// PLAYERC_DATAMODE_PUSH (at first) or PLAYERC_DATAMODE_PULL: whether playerc_client_read() also
/// tells that a round of data is complete.
int playerc_client_datamode(playerc_client_t* client, uint8_t mode);
/// Asks for a round of data. Nothing has to be done for that here.
int playerc_client_requestdata(playerc_client_t* client);
/// Whether newer data replace older ones that wait (the default), or all are kept (at most 1000 a
/// device); then a device shows the newest. Each -1 stands for all; types other than
/// PLAYER_MSGTYPE_DATA and subtypes change nothing.
int playerc_client_set_replace_rule(playerc_client_t* client, int interf, int index, int type,
                                    int subtype, int replace);
/// Adds a device to the list of the client; playerc_device_init() does it.
int playerc_client_adddevice(playerc_client_t* client, struct _playerc_device_t* device);
/// The reverse. @return -1 if it is not in the list.
int playerc_client_deldevice(playerc_client_t* client, struct _playerc_device_t* device);
/// Lets a function be called with its own data whenever playerc_client_read() returns the device.
/// @return -1 if there are four already.
int playerc_client_addcallback(playerc_client_t* client, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data);
/// Undoes playerc_client_addcallback().
int playerc_client_delcallback(playerc_client_t* client, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data);
/// Fills devinfos and devinfo_count.
int playerc_client_get_devlist(playerc_client_t* client);
/// Subscribes the client's device at an address or, if it has none there, only looks whether there
/// is one. @param drivername  room for len bytes, for the kind of device; may be null.
int playerc_client_subscribe(playerc_client_t* client, int code, int index, int access,
                             char* drivername, size_t len);
/// The reverse.
int playerc_client_unsubscribe(playerc_client_t* client, int code, int index);
/// Fails: there are no messages here. Call the functions of the device.
int playerc_client_request(playerc_client_t* client, struct _playerc_device_t* device,
                           uint8_t reqtype, const void* req_data, void** rep_data);
/// Whether data wait, waiting for so long [ms] (< 0: until there are some); simulated time, in
/// lockstep. With 0, the first call after playerc_client_read() only looks, each further one in a
/// row lets a step pass. @return 1 if so (or the run is over), 0 if not, -1 for errors.
int playerc_client_peek(playerc_client_t* client, int timeout);
/// The same.
int playerc_client_internal_peek(playerc_client_t* client, int timeout);
/// Waits until some device has new data, takes them over into its struct, and calls its callbacks.
/// Each call does this for one device, in order; when no data are left, simulated time goes on.
/// @return the struct of the device (e.g. the playerc_laser_t); the client when a round is complete
/// (PLAYERC_DATAMODE_PULL, or no device is subscribed to); null for errors and at the end of the
/// run.
void* playerc_client_read(playerc_client_t* client);
/// The same, if data wait. @return 1 if so, 0 if not, -1 for errors.
int playerc_client_read_nonblock(playerc_client_t* client);
/// The same. @param proxy  is given what playerc_client_read() would return; may be null.
int playerc_client_read_nonblock_withproxy(playerc_client_t* client, void** proxy);
/// How long a server may take to answer [s].
void playerc_client_set_request_timeout(playerc_client_t* client, uint32_t seconds);
/// How often to try again to connect to a server that is gone; < 0: for ever; 0, at first: not at
/// all.
void playerc_client_set_retry_limit(playerc_client_t* client, int limit);
/// Time between two tries [s].
void playerc_client_set_retry_time(playerc_client_t* client, double time);
/// Fails, as playerc_client_request().
int playerc_client_write(playerc_client_t* client, struct _playerc_device_t* device,
                         uint8_t subtype, void* cmd, double* timestamp);
/// @}

/// @name All devices
/// @{

/// Fills a device's common part and adds it to the client. Only devices that playerc_X_create()
/// made can be subscribed to.
void playerc_device_init(playerc_device_t* device, playerc_client_t* client, int code, int index,
                         playerc_putmsg_fn_t putmsg);
/// The reverse: takes it out of the client.
void playerc_device_term(playerc_device_t* device);
/// Subscribes to a device. @param access  PLAYERC_OPEN_MODE.
/// @return -1 if there is no such device; the reason names those that there are.
int playerc_device_subscribe(playerc_device_t* device, int access);
/// The reverse.
int playerc_device_unsubscribe(playerc_device_t* device);
/// Whether the device understands, or sends, such messages: 1 or 0.
/// @param type  PLAYER_MSGTYPE_DATA, _CMD or _REQ.
int playerc_device_hascapability(playerc_device_t* device, uint32_t type, uint32_t subtype);
/// Properties are the device's numeric settings in the world, such as "frequency", in SI units and
/// radians. They cannot be changed while a simulation runs, and none is a text. @return -1 if there
/// is none of the name and type.
int playerc_device_get_boolprop(playerc_device_t* device, char* property, BOOL* value);
int playerc_device_set_boolprop(playerc_device_t* device, char* property, BOOL value);
int playerc_device_get_intprop(playerc_device_t* device, char* property, int32_t* value);
int playerc_device_set_intprop(playerc_device_t* device, char* property, int32_t value);
int playerc_device_get_dblprop(playerc_device_t* device, char* property, double* value);
int playerc_device_set_dblprop(playerc_device_t* device, char* property, double value);
int playerc_device_get_strprop(playerc_device_t* device, char* property, char** value);
int playerc_device_set_strprop(playerc_device_t* device, char* property, char* value);
/// @}

/// @name aio
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_aio_t* playerc_aio_create(playerc_client_t* client, int index);
void playerc_aio_destroy(playerc_aio_t* device);
int playerc_aio_subscribe(playerc_aio_t* device, int access);
int playerc_aio_unsubscribe(playerc_aio_t* device);
/// Sets the voltage of an output [V].
int playerc_aio_set_output(playerc_aio_t* device, uint8_t id, float volt);
/// What an input reads [V]; 0 for one that there is not.
float playerc_aio_get_data(playerc_aio_t* device, uint32_t index);
/// @}

/// @name actarray
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_actarray_t* playerc_actarray_create(playerc_client_t* client, int index);
void playerc_actarray_destroy(playerc_actarray_t* device);
int playerc_actarray_subscribe(playerc_actarray_t* device, int access);
int playerc_actarray_unsubscribe(playerc_actarray_t* device);
player_actarray_actuator_t playerc_actarray_get_actuator_data(playerc_actarray_t* device,
                                                              uint32_t index);
player_actarray_actuatorgeom_t playerc_actarray_get_actuator_geom(playerc_actarray_t* device,
                                                                  uint32_t index);
int playerc_actarray_get_geom(playerc_actarray_t* device);
int playerc_actarray_position_cmd(playerc_actarray_t* device, int joint, float position);
int playerc_actarray_multi_position_cmd(playerc_actarray_t* device, float* positions,
                                        int positions_count);
int playerc_actarray_speed_cmd(playerc_actarray_t* device, int joint, float speed);
int playerc_actarray_multi_speed_cmd(playerc_actarray_t* device, float* speeds, int speeds_count);
int playerc_actarray_home_cmd(playerc_actarray_t* device, int joint);
int playerc_actarray_current_cmd(playerc_actarray_t* device, int joint, float current);
int playerc_actarray_multi_current_cmd(playerc_actarray_t* device, float* currents,
                                       int currents_count);
int playerc_actarray_power(playerc_actarray_t* device, uint8_t enable);
int playerc_actarray_brakes(playerc_actarray_t* device, uint8_t enable);
int playerc_actarray_speed_config(playerc_actarray_t* device, int joint, float speed);
int playerc_actarray_accel_config(playerc_actarray_t* device, int joint, float accel);
/// @}

/// @name audio
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_audio_t* playerc_audio_create(playerc_client_t* client, int index);
void playerc_audio_destroy(playerc_audio_t* device);
int playerc_audio_subscribe(playerc_audio_t* device, int access);
int playerc_audio_unsubscribe(playerc_audio_t* device);
int playerc_audio_wav_play_cmd(playerc_audio_t* device, uint32_t data_count, uint8_t data[],
                               uint32_t format);
int playerc_audio_wav_stream_rec_cmd(playerc_audio_t* device, uint8_t state);
int playerc_audio_sample_play_cmd(playerc_audio_t* device, int index);
int playerc_audio_seq_play_cmd(playerc_audio_t* device, player_audio_seq_t* tones);
int playerc_audio_mixer_multchannels_cmd(playerc_audio_t* device,
                                         player_audio_mixer_channel_list_t* levels);
int playerc_audio_mixer_channel_cmd(playerc_audio_t* device, uint32_t index, float amplitude,
                                    uint8_t active);
int playerc_audio_wav_rec(playerc_audio_t* device);
int playerc_audio_sample_load(playerc_audio_t* device, int index, uint32_t data_count,
                              uint8_t data[], uint32_t format);
int playerc_audio_sample_retrieve(playerc_audio_t* device, int index);
int playerc_audio_sample_rec(playerc_audio_t* device, int index, uint32_t length);
int playerc_audio_get_mixer_levels(playerc_audio_t* device);
int playerc_audio_get_mixer_details(playerc_audio_t* device);
/// @}

/// @name blackboard
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_blackboard_t* playerc_blackboard_create(playerc_client_t* client, int index);
void playerc_blackboard_destroy(playerc_blackboard_t* device);
int playerc_blackboard_subscribe(playerc_blackboard_t* device, int access);
int playerc_blackboard_unsubscribe(playerc_blackboard_t* device);
int playerc_blackboard_subscribe_to_key(playerc_blackboard_t* device, const char* key,
                                        const char* group, player_blackboard_entry_t** entry);
int playerc_blackboard_get_entry(playerc_blackboard_t* device, const char* key, const char* group,
                                 player_blackboard_entry_t** entry);
int playerc_blackboard_unsubscribe_from_key(playerc_blackboard_t* device, const char* key,
                                            const char* group);
int playerc_blackboard_subscribe_to_group(playerc_blackboard_t* device, const char* group);
int playerc_blackboard_unsubscribe_from_group(playerc_blackboard_t* device, const char* group);
int playerc_blackboard_set_entry(playerc_blackboard_t* device, player_blackboard_entry_t* entry);
int playerc_blackboard_set_string(playerc_blackboard_t* device, const char* key, const char* group,
                                  const char* value);
int playerc_blackboard_set_int(playerc_blackboard_t* device, const char* key, const char* group,
                               const int value);
int playerc_blackboard_set_double(playerc_blackboard_t* device, const char* key, const char* group,
                                  const double value);
/// @}

/// @name blinkenlight
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_blinkenlight_t* playerc_blinkenlight_create(playerc_client_t* client, int index);
void playerc_blinkenlight_destroy(playerc_blinkenlight_t* device);
int playerc_blinkenlight_subscribe(playerc_blinkenlight_t* device, int access);
int playerc_blinkenlight_unsubscribe(playerc_blinkenlight_t* device);
/// Lights up (1) or goes out (0).
int playerc_blinkenlight_enable(playerc_blinkenlight_t* device, uint32_t enable);
/// Sets the colour, 0 to 255 each. @param id  0: there is one lamp.
int playerc_blinkenlight_color(playerc_blinkenlight_t* device, uint32_t id, uint8_t red,
                               uint8_t green, uint8_t blue);
/// Lets it blink. @param id  0. @param period  [s]. @param duty_cycle  part in which it is on, 0 to
/// 1.
int playerc_blinkenlight_blink(playerc_blinkenlight_t* device, uint32_t id, float period,
                               float duty_cycle);
/// @}

/// @name blobfinder
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_blobfinder_t* playerc_blobfinder_create(playerc_client_t* client, int index);
void playerc_blobfinder_destroy(playerc_blobfinder_t* device);
int playerc_blobfinder_subscribe(playerc_blobfinder_t* device, int access);
int playerc_blobfinder_unsubscribe(playerc_blobfinder_t* device);
/// @}

/// @name bumper
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_bumper_t* playerc_bumper_create(playerc_client_t* client, int index);
void playerc_bumper_destroy(playerc_bumper_t* device);
int playerc_bumper_subscribe(playerc_bumper_t* device, int access);
int playerc_bumper_unsubscribe(playerc_bumper_t* device);
/// Fills poses.
int playerc_bumper_get_geom(playerc_bumper_t* device);
/// @}

/// @name camera
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_camera_t* playerc_camera_create(playerc_client_t* client, int index);
void playerc_camera_destroy(playerc_camera_t* device);
int playerc_camera_subscribe(playerc_camera_t* device, int access);
int playerc_camera_unsubscribe(playerc_camera_t* device);
/// Nothing: pictures are not compressed.
void playerc_camera_decompress(playerc_camera_t* device);
/// Writes the newest picture as a binary PPM.
void playerc_camera_save(playerc_camera_t* device, const char* filename);
/// Fails: there is nothing to choose.
int playerc_camera_set_source(playerc_camera_t* device, int source, const char* norm);
/// Fails as well.
int playerc_camera_get_source(playerc_camera_t* device);
/// Fails before the first picture; the newest one is there without asking.
int playerc_camera_get_image(playerc_camera_t* device);
/// Copies the newest picture, at most dst_size bytes of it.
void playerc_camera_copy_image(playerc_camera_t* device, void* dst, size_t dst_size);
/// A pixel's red (component 0), green (1) or blue (2); 0 where there is none.
unsigned playerc_camera_get_pixel_component(playerc_camera_t* device, unsigned int x,
                                            unsigned int y, int component);
/// @}

/// @name coopobject
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_coopobject_t* playerc_coopobject_create(playerc_client_t* client, int index);
void playerc_coopobject_destroy(playerc_coopobject_t* device);
int playerc_coopobject_subscribe(playerc_coopobject_t* device, int access);
int playerc_coopobject_unsubscribe(playerc_coopobject_t* device);
int playerc_coopobject_send_position(playerc_coopobject_t* device, uint16_t node_id,
                                     uint16_t source_id, player_pose2d_t pos, uint8_t status);
int playerc_coopobject_send_data(playerc_coopobject_t* device, int node_id, int source_id,
                                 int data_type, int data_size, unsigned char* extradata);
int playerc_coopobject_send_cmd(playerc_coopobject_t* device, int node_id, int source_id, int cmd,
                                int parameters_size, unsigned char* parameters);
int playerc_coopobject_send_req(playerc_coopobject_t* device, int node_id, int source_id, int req,
                                int parameters_size, unsigned char* parameters);
/// @}

/// @name dio
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_dio_t* playerc_dio_create(playerc_client_t* client, int index);
void playerc_dio_destroy(playerc_dio_t* device);
int playerc_dio_subscribe(playerc_dio_t* device, int access);
int playerc_dio_unsubscribe(playerc_dio_t* device);
/// Sets so many outputs. @param digout  a bit an output, the lowest is output 0.
int playerc_dio_set_output(playerc_dio_t* device, uint8_t output_count, uint32_t digout);
/// @}

/// @name fiducial
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_fiducial_t* playerc_fiducial_create(playerc_client_t* client, int index);
void playerc_fiducial_destroy(playerc_fiducial_t* device);
int playerc_fiducial_subscribe(playerc_fiducial_t* device, int access);
int playerc_fiducial_unsubscribe(playerc_fiducial_t* device);
/// Fills fiducial_geom.
int playerc_fiducial_get_geom(playerc_fiducial_t* device);
/// @}

/// @name gps
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_gps_t* playerc_gps_create(playerc_client_t* client, int index);
void playerc_gps_destroy(playerc_gps_t* device);
int playerc_gps_subscribe(playerc_gps_t* device, int access);
int playerc_gps_unsubscribe(playerc_gps_t* device);
/// @}

/// @name graphics2d
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_graphics2d_t* playerc_graphics2d_create(playerc_client_t* client, int index);
void playerc_graphics2d_destroy(playerc_graphics2d_t* device);
int playerc_graphics2d_subscribe(playerc_graphics2d_t* device, int access);
int playerc_graphics2d_unsubscribe(playerc_graphics2d_t* device);
/// Sets the colour of what is drawn next.
int playerc_graphics2d_setcolor(playerc_graphics2d_t* device, player_color_t col);
/// Draws points; all coordinates in the world [m].
int playerc_graphics2d_draw_points(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                   int count);
/// Draws lines from each point to the next.
int playerc_graphics2d_draw_polyline(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                     int count);
/// Draws a line from each first to each second point.
int playerc_graphics2d_draw_multiline(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                      int count);
/// Draws an outline, and fills it if told to.
int playerc_graphics2d_draw_polygon(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                    int count, int filled, player_color_t fill_color);
/// Takes away what was drawn.
int playerc_graphics2d_clear(playerc_graphics2d_t* device);
/// @}

/// @name graphics3d
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_graphics3d_t* playerc_graphics3d_create(playerc_client_t* client, int index);
void playerc_graphics3d_destroy(playerc_graphics3d_t* device);
int playerc_graphics3d_subscribe(playerc_graphics3d_t* device, int access);
int playerc_graphics3d_unsubscribe(playerc_graphics3d_t* device);
int playerc_graphics3d_setcolor(playerc_graphics3d_t* device, player_color_t col);
int playerc_graphics3d_draw(playerc_graphics3d_t* device, player_graphics3d_draw_mode_t mode,
                            player_point_3d_t pts[], int count);
int playerc_graphics3d_clear(playerc_graphics3d_t* device);
int playerc_graphics3d_translate(playerc_graphics3d_t* device, double x, double y, double z);
int playerc_graphics3d_rotate(playerc_graphics3d_t* device, double a, double x, double y, double z);
/// @}

/// @name gripper
///
/// What the commands do is told of PlayerCc::GripperProxy. @return 0, or -1 on an error.
/// @{

/// See playerc_device_subscribe().
playerc_gripper_t* playerc_gripper_create(playerc_client_t* client, int index);
void playerc_gripper_destroy(playerc_gripper_t* device);
int playerc_gripper_subscribe(playerc_gripper_t* device, int access);
int playerc_gripper_unsubscribe(playerc_gripper_t* device);
int playerc_gripper_open_cmd(playerc_gripper_t* device);
int playerc_gripper_close_cmd(playerc_gripper_t* device);
int playerc_gripper_stop_cmd(playerc_gripper_t* device);
int playerc_gripper_store_cmd(playerc_gripper_t* device);
int playerc_gripper_retrieve_cmd(playerc_gripper_t* device);
void playerc_gripper_printout(playerc_gripper_t* device, const char* prefix);
int playerc_gripper_get_geom(playerc_gripper_t* device);
/// @}

/// @name health
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_health_t* playerc_health_create(playerc_client_t* client, int index);
void playerc_health_destroy(playerc_health_t* device);
int playerc_health_subscribe(playerc_health_t* device, int access);
int playerc_health_unsubscribe(playerc_health_t* device);
/// @}

/// @name ir
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_ir_t* playerc_ir_create(playerc_client_t* client, int index);
void playerc_ir_destroy(playerc_ir_t* device);
int playerc_ir_subscribe(playerc_ir_t* device, int access);
int playerc_ir_unsubscribe(playerc_ir_t* device);
/// Fills poses.
int playerc_ir_get_geom(playerc_ir_t* device);
/// @}

/// @name joystick
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_joystick_t* playerc_joystick_create(playerc_client_t* client, int index);
void playerc_joystick_destroy(playerc_joystick_t* device);
int playerc_joystick_subscribe(playerc_joystick_t* device, int access);
int playerc_joystick_unsubscribe(playerc_joystick_t* device);
/// @}

/// @name laser
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_laser_t* playerc_laser_create(playerc_client_t* client, int index);
void playerc_laser_destroy(playerc_laser_t* device);
int playerc_laser_subscribe(playerc_laser_t* device, int access);
int playerc_laser_unsubscribe(playerc_laser_t* device);
/// Chooses what is shown of each scan, as LaserProxy::Configure().
/// @param min_angle, max_angle  window [rad]. @param resolution  between beams [rad], 0: all beams.
/// @param range_res  ranges are rounded to it [m], 0: as they are.
/// @param intensity, scanning_frequency  ignored: a simulated laser keeps its own.
int playerc_laser_set_config(playerc_laser_t* device, double min_angle, double max_angle,
                             double resolution, double range_res, unsigned char intensity,
                             double scanning_frequency);
/// Tells what is shown, units as above. Null pointers are left out.
int playerc_laser_get_config(playerc_laser_t* device, double* min_angle, double* max_angle,
                             double* resolution, double* range_res, unsigned char* intensity,
                             double* scanning_frequency);
/// Fills pose and size.
int playerc_laser_get_geom(playerc_laser_t* device);
/// Fills laser_id.
int playerc_laser_get_id(playerc_laser_t* device);
/// Prints the scan on standard output, each line after the prefix.
void playerc_laser_printout(playerc_laser_t* device, const char* prefix);
/// @}

/// @name limb
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_limb_t* playerc_limb_create(playerc_client_t* client, int index);
void playerc_limb_destroy(playerc_limb_t* device);
int playerc_limb_subscribe(playerc_limb_t* device, int access);
int playerc_limb_unsubscribe(playerc_limb_t* device);
int playerc_limb_get_geom(playerc_limb_t* device);
int playerc_limb_home_cmd(playerc_limb_t* device);
int playerc_limb_stop_cmd(playerc_limb_t* device);
int playerc_limb_setpose_cmd(playerc_limb_t* device, float pX, float pY, float pZ, float aX,
                             float aY, float aZ, float oX, float oY, float oZ);
int playerc_limb_setposition_cmd(playerc_limb_t* device, float pX, float pY, float pZ);
int playerc_limb_vecmove_cmd(playerc_limb_t* device, float x, float y, float z, float length);
int playerc_limb_power(playerc_limb_t* device, uint32_t enable);
int playerc_limb_brakes(playerc_limb_t* device, uint32_t enable);
int playerc_limb_speed_config(playerc_limb_t* device, float speed);
/// @}

/// @name localize
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_localize_t* playerc_localize_create(playerc_client_t* client, int index);
void playerc_localize_destroy(playerc_localize_t* device);
int playerc_localize_subscribe(playerc_localize_t* device, int access);
int playerc_localize_unsubscribe(playerc_localize_t* device);
/// Tells where to begin. The simulated localiser cannot be lost, so nothing changes; where a robot
/// stands is set with playerc_simulation_set_pose2d().
int playerc_localize_set_pose(playerc_localize_t* device, double pose[3], double cov[6]);
/// Fills mean, variance and particles.
int playerc_localize_get_particles(playerc_localize_t* device);
/// @}

/// @name log
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_log_t* playerc_log_create(playerc_client_t* client, int index);
void playerc_log_destroy(playerc_log_t* device);
int playerc_log_subscribe(playerc_log_t* device, int access);
int playerc_log_unsubscribe(playerc_log_t* device);
/// Starts (1) or ends (0) writing.
int playerc_log_set_write_state(playerc_log_t* device, int state);
/// Starts (1) or halts (0) reading.
int playerc_log_set_read_state(playerc_log_t* device, int state);
/// Begins reading anew.
int playerc_log_set_read_rewind(playerc_log_t* device);
/// Fills type and state.
int playerc_log_get_state(playerc_log_t* device);
/// Sets the name of the file that is written; not while it is.
int playerc_log_set_filename(playerc_log_t* device, const char* fname);
/// @}

/// @name map
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_map_t* playerc_map_create(playerc_client_t* client, int index);
void playerc_map_destroy(playerc_map_t* device);
int playerc_map_subscribe(playerc_map_t* device, int access);
int playerc_map_unsubscribe(playerc_map_t* device);
/// Fills resolution, size, origin and cells.
int playerc_map_get_map(playerc_map_t* device);
/// Fails: the map is a grid.
int playerc_map_get_vector(playerc_map_t* device);
/// @}

/// @name vectormap
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_vectormap_t* playerc_vectormap_create(playerc_client_t* client, int index);
void playerc_vectormap_destroy(playerc_vectormap_t* device);
int playerc_vectormap_subscribe(playerc_vectormap_t* device, int access);
int playerc_vectormap_unsubscribe(playerc_vectormap_t* device);
int playerc_vectormap_get_map_info(playerc_vectormap_t* device);
int playerc_vectormap_get_layer_data(playerc_vectormap_t* device, unsigned layer_index);
int playerc_vectormap_write_layer(playerc_vectormap_t* device,
                                  const player_vectormap_layer_data_t* data);
void playerc_vectormap_cleanup(playerc_vectormap_t* device);
uint8_t* playerc_vectormap_get_feature_data(playerc_vectormap_t* device, unsigned layer_index,
                                            unsigned feature_index);
size_t playerc_vectormap_get_feature_data_count(playerc_vectormap_t* device, unsigned layer_index,
                                                unsigned feature_index);
/// @}

/// @name opaque
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_opaque_t* playerc_opaque_create(playerc_client_t* client, int index);
void playerc_opaque_destroy(playerc_opaque_t* device);
int playerc_opaque_subscribe(playerc_opaque_t* device, int access);
int playerc_opaque_unsubscribe(playerc_opaque_t* device);
/// Sends bytes.
int playerc_opaque_cmd(playerc_opaque_t* device, player_opaque_data_t* data);
/// Fails: nothing answers at once. Send by playerc_opaque_cmd(), and read what comes back.
int playerc_opaque_req(playerc_opaque_t* device, player_opaque_data_t* request,
                       player_opaque_data_t** reply);
/// @}

/// @name planner
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_planner_t* playerc_planner_create(playerc_client_t* client, int index);
void playerc_planner_destroy(playerc_planner_t* device);
int playerc_planner_subscribe(playerc_planner_t* device, int access);
int playerc_planner_unsubscribe(playerc_planner_t* device);
int playerc_planner_set_cmd_pose(playerc_planner_t* device, double gx, double gy, double ga);
int playerc_planner_set_cmd_start(playerc_planner_t* device, double sx, double sy, double sa);
int playerc_planner_get_waypoints(playerc_planner_t* device);
int playerc_planner_enable(playerc_planner_t* device, int state);
/// @}

/// @name position1d
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_position1d_t* playerc_position1d_create(playerc_client_t* client, int index);
void playerc_position1d_destroy(playerc_position1d_t* device);
int playerc_position1d_subscribe(playerc_position1d_t* device, int access);
int playerc_position1d_unsubscribe(playerc_position1d_t* device);
int playerc_position1d_enable(playerc_position1d_t* device, int enable);
int playerc_position1d_get_geom(playerc_position1d_t* device);
int playerc_position1d_set_cmd_vel(playerc_position1d_t* device, double vel, int state);
int playerc_position1d_set_cmd_pos(playerc_position1d_t* device, double pos, int state);
int playerc_position1d_set_cmd_pos_with_vel(playerc_position1d_t* device, double pos, double vel,
                                            int state);
int playerc_position1d_set_odom(playerc_position1d_t* device, double odom);
/// @}

/// @name position2d
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_position2d_t* playerc_position2d_create(playerc_client_t* client, int index);
void playerc_position2d_destroy(playerc_position2d_t* device);
int playerc_position2d_subscribe(playerc_position2d_t* device, int access);
int playerc_position2d_unsubscribe(playerc_position2d_t* device);
/// Switches the motors on (1) or off (0).
int playerc_position2d_enable(playerc_position2d_t* device, int enable);
/// Fills pose and size.
int playerc_position2d_get_geom(playerc_position2d_t* device);
/// Drives: forward and to the left [m/s], turning [rad/s]. @param state  ignored, see
/// playerc_position2d_enable().
int playerc_position2d_set_cmd_vel(playerc_position2d_t* device, double vx, double vy, double va,
                                   int state);
/// Drives to a pose, no faster than vel; 0: as fast as it can.
int playerc_position2d_set_cmd_pose_with_vel(playerc_position2d_t* device, player_pose2d_t pos,
                                             player_pose2d_t vel, int state);
/// Drives, and keeps a heading [rad].
int playerc_position2d_set_cmd_vel_head(playerc_position2d_t* device, double vx, double vy,
                                        double pa, int state);
/// Drives to a pose: x, y [m], yaw [rad].
int playerc_position2d_set_cmd_pose(playerc_position2d_t* device, double gx, double gy, double ga,
                                    int state);
/// Drives as a car: speed [m/s], angle of its steering [rad].
int playerc_position2d_set_cmd_car(playerc_position2d_t* device, double vx, double a);
/// Lets the present pose read as given.
int playerc_position2d_set_odom(playerc_position2d_t* device, double ox, double oy, double oa);
/// @}

/// @name position3d
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_position3d_t* playerc_position3d_create(playerc_client_t* client, int index);
void playerc_position3d_destroy(playerc_position3d_t* device);
int playerc_position3d_subscribe(playerc_position3d_t* device, int access);
int playerc_position3d_unsubscribe(playerc_position3d_t* device);
int playerc_position3d_enable(playerc_position3d_t* device, int enable);
int playerc_position3d_get_geom(playerc_position3d_t* device);
int playerc_position3d_set_velocity(playerc_position3d_t* device, double vx, double vy, double vz,
                                    double vr, double vp, double vt, int state);
int playerc_position3d_set_speed(playerc_position3d_t* device, double vx, double vy, double vz,
                                 int state);
int playerc_position3d_set_pose(playerc_position3d_t* device, double gx, double gy, double gz,
                                double gr, double gp, double gt);
int playerc_position3d_set_pose_with_vel(playerc_position3d_t* device, player_pose3d_t pos,
                                         player_pose3d_t vel);
int playerc_position3d_set_cmd_pose(playerc_position3d_t* device, double gx, double gy, double gz);
int playerc_position3d_set_vel_mode(playerc_position3d_t* device, int mode);
int playerc_position3d_set_odom(playerc_position3d_t* device, double ox, double oy, double oz,
                                double oroll, double opitch, double oyaw);
int playerc_position3d_reset_odom(playerc_position3d_t* device);
/// @}

/// @name power
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_power_t* playerc_power_create(playerc_client_t* client, int index);
void playerc_power_destroy(playerc_power_t* device);
int playerc_power_subscribe(playerc_power_t* device, int access);
int playerc_power_unsubscribe(playerc_power_t* device);
/// @}

/// @name ptz
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_ptz_t* playerc_ptz_create(playerc_client_t* client, int index);
void playerc_ptz_destroy(playerc_ptz_t* device);
int playerc_ptz_subscribe(playerc_ptz_t* device, int access);
int playerc_ptz_unsubscribe(playerc_ptz_t* device);
/// As PlayerCc::PtzProxy::SetCam().
int playerc_ptz_set(playerc_ptz_t* device, double pan, double tilt, double zoom);
/// Brings status up to date.
int playerc_ptz_query_status(playerc_ptz_t* device);
/// The same at speeds for pan and tilt [rad/s], 0: as fast as it can. In
/// PLAYER_PTZ_VELOCITY_CONTROL it turns at these speeds until told otherwise, and the angles mean
/// nothing.
int playerc_ptz_set_ws(playerc_ptz_t* device, double pan, double tilt, double zoom, double panspeed,
                       double tiltspeed);
/// @param mode  PLAYER_PTZ_POSITION_CONTROL, as at the start, or PLAYER_PTZ_VELOCITY_CONTROL.
int playerc_ptz_set_control_mode(playerc_ptz_t* device, int mode);
/// @}

/// @name ranger
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_ranger_t* playerc_ranger_create(playerc_client_t* client, int index);
void playerc_ranger_destroy(playerc_ranger_t* device);
int playerc_ranger_subscribe(playerc_ranger_t* device, int access);
int playerc_ranger_unsubscribe(playerc_ranger_t* device);
/// Fills the poses and sizes.
int playerc_ranger_get_geom(playerc_ranger_t* device);
/// Switches the sensors on or off.
int playerc_ranger_power_config(playerc_ranger_t* device, uint8_t value);
/// Switches intensities on or off.
int playerc_ranger_intns_config(playerc_ranger_t* device, uint8_t value);
/// Chooses what is shown, as RangerProxy::Configure(): angles [rad], ranges [m], frequency [Hz].
int playerc_ranger_set_config(playerc_ranger_t* device, double min_angle, double max_angle,
                              double angular_res, double min_range, double max_range,
                              double range_res, double frequency);
/// Tells what is shown. Null pointers are left out.
int playerc_ranger_get_config(playerc_ranger_t* device, double* min_angle, double* max_angle,
                              double* angular_res, double* min_range, double* max_range,
                              double* range_res, double* frequency);
/// @}

/// @name sonar
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_sonar_t* playerc_sonar_create(playerc_client_t* client, int index);
void playerc_sonar_destroy(playerc_sonar_t* device);
int playerc_sonar_subscribe(playerc_sonar_t* device, int access);
int playerc_sonar_unsubscribe(playerc_sonar_t* device);
/// Fills poses.
int playerc_sonar_get_geom(playerc_sonar_t* device);
/// @}

/// @name wifi
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_wifi_t* playerc_wifi_create(playerc_client_t* client, int index);
void playerc_wifi_destroy(playerc_wifi_t* device);
int playerc_wifi_subscribe(playerc_wifi_t* device, int access);
int playerc_wifi_unsubscribe(playerc_wifi_t* device);
/// A link by its number. @return null if there is none.
playerc_wifi_link_t* playerc_wifi_get_link(playerc_wifi_t* device, int link);
/// @}

/// @name simulation
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_simulation_t* playerc_simulation_create(playerc_client_t* client, int index);
void playerc_simulation_destroy(playerc_simulation_t* device);
int playerc_simulation_subscribe(playerc_simulation_t* device, int access);
int playerc_simulation_unsubscribe(playerc_simulation_t* device);
/// Puts a robot or an obstacle somewhere, by its name: x, y [m], yaw [rad].
int playerc_simulation_set_pose2d(playerc_simulation_t* device, char* name, double gx, double gy,
                                  double ga);
/// Where it is.
int playerc_simulation_get_pose2d(playerc_simulation_t* device, char* identifier, double* x,
                                  double* y, double* a);
/// The same in space.
int playerc_simulation_set_pose3d(playerc_simulation_t* device, char* name, double gx, double gy,
                                  double gz, double groll, double gpitch, double gyaw);
/// The same in space. @param time  simulated [s].
int playerc_simulation_get_pose3d(playerc_simulation_t* device, char* identifier, double* x,
                                  double* y, double* z, double* roll, double* pitch, double* yaw,
                                  double* time);
/// Sets a property of a robot or an obstacle.
int playerc_simulation_set_property(playerc_simulation_t* device, char* name, char* property,
                                    void* value, size_t value_len);
/// The reverse.
int playerc_simulation_get_property(playerc_simulation_t* device, char* name, char* property,
                                    void* value, size_t value_len);
/// Fails: the clients decide when time goes on.
int playerc_simulation_pause(playerc_simulation_t* device);
/// Fails: a run cannot begin anew.
int playerc_simulation_reset(playerc_simulation_t* device);
/// Fails: a world cannot be written.
int playerc_simulation_save(playerc_simulation_t* device);
/// @}

/// @name speech
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_speech_t* playerc_speech_create(playerc_client_t* client, int index);
void playerc_speech_destroy(playerc_speech_t* device);
int playerc_speech_subscribe(playerc_speech_t* device, int access);
int playerc_speech_unsubscribe(playerc_speech_t* device);
/// Says a text.
int playerc_speech_say(playerc_speech_t* device, char*);
/// @}

/// @name speechrecognition
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_speechrecognition_t* playerc_speechrecognition_create(playerc_client_t* client, int index);
void playerc_speechrecognition_destroy(playerc_speechrecognition_t* device);
int playerc_speechrecognition_subscribe(playerc_speechrecognition_t* device, int access);
int playerc_speechrecognition_unsubscribe(playerc_speechrecognition_t* device);
/// @}

/// @name rfid
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_rfid_t* playerc_rfid_create(playerc_client_t* client, int index);
void playerc_rfid_destroy(playerc_rfid_t* device);
int playerc_rfid_subscribe(playerc_rfid_t* device, int access);
int playerc_rfid_unsubscribe(playerc_rfid_t* device);
/// @}

/// @name pointcloud3d
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_pointcloud3d_t* playerc_pointcloud3d_create(playerc_client_t* client, int index);
void playerc_pointcloud3d_destroy(playerc_pointcloud3d_t* device);
int playerc_pointcloud3d_subscribe(playerc_pointcloud3d_t* device, int access);
int playerc_pointcloud3d_unsubscribe(playerc_pointcloud3d_t* device);
/// @}

/// @name stereo
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_stereo_t* playerc_stereo_create(playerc_client_t* client, int index);
void playerc_stereo_destroy(playerc_stereo_t* device);
int playerc_stereo_subscribe(playerc_stereo_t* device, int access);
int playerc_stereo_unsubscribe(playerc_stereo_t* device);
/// @}

/// @name imu
/// @{

/// Makes the struct for a device, subscribes to it, and the reverse; see
/// playerc_device_subscribe().
playerc_imu_t* playerc_imu_create(playerc_client_t* client, int index);
void playerc_imu_destroy(playerc_imu_t* device);
int playerc_imu_subscribe(playerc_imu_t* device, int access);
int playerc_imu_unsubscribe(playerc_imu_t* device);
/// Chooses what the readings hold, as ImuProxy::SetDatatype().
int playerc_imu_datatype(playerc_imu_t* device, int value);
/// Lets the present orientation be zero.
int playerc_imu_reset_orientation(playerc_imu_t* device, int value);
/// Lets the present orientation read as given [rad].
int playerc_imu_reset_euler(playerc_imu_t* device, float roll, float pitch, float yaw);
/// @}

/// @name wsn
///
/// No world has such a device: create makes the struct, everything else fails.
/// @{

/// See playerc_device_subscribe().
playerc_wsn_t* playerc_wsn_create(playerc_client_t* client, int index);
void playerc_wsn_destroy(playerc_wsn_t* device);
int playerc_wsn_subscribe(playerc_wsn_t* device, int access);
int playerc_wsn_unsubscribe(playerc_wsn_t* device);
int playerc_wsn_set_devstate(playerc_wsn_t* device, int node_id, int group_id, int devnr,
                             int state);
int playerc_wsn_power(playerc_wsn_t* device, int node_id, int group_id, int value);
int playerc_wsn_datatype(playerc_wsn_t* device, int value);
int playerc_wsn_datafreq(playerc_wsn_t* device, int node_id, int group_id, double frequency);
/// @}

#ifdef __cplusplus
}
#endif
