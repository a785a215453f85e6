// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Clients, errors, and the common part of all devices of Player's C client library. Programs
/// include libplayerc/playerc.h. The library works with the same simulations as libplayerc++.
///
/// Unless documented otherwise, functions return 0 for success and -1 for an error; functions that
/// return a pointer return null for an error. playerc_error_str() then returns the reason. A
/// required device that is null or not subscribed is an error too. Arrays belong to the struct that
/// points to them, until the device is destroyed; each new reading may move them.
///
/// Threads: only one thread at a time may use a client and its devices; different clients are
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

/// Maximum number of unread messages that a client keeps.
#define PLAYERC_QUEUE_RING_SIZE 512

/// Index of a map's cell (playerc_map_t*) in its array, from column and row.
#define PLAYERC_MAP_INDEX(dev, i, j) (((dev)->width) * (j) + (i))

struct _playerc_client_t;
struct _playerc_device_t;

/// Callback for a device's message. Never called, because this library sends no messages.
typedef void (*playerc_putmsg_fn_t)(void* device, char* header, char* data);
/// Callback for new data of a device; called with its user data.
typedef void (*playerc_callback_fn_t)(void* data);
/// Packing of a message; opaque, because this library packs no messages.
typedef struct playerxdr_function playerxdr_function_t;
/// Reader of a vector map's features; opaque.
typedef struct playerwkbprocessor* playerwkbprocessor_t;
/// A blob of one colour in a camera's image.
typedef player_blobfinder_blob_t playerc_blobfinder_blob_t;
/// A point of a point cloud.
typedef player_pointcloud3d_element_t playerc_pointcloud3d_element_t;
/// A point with colour, from a stereo camera.
typedef player_pointcloud3d_stereo_element_t playerc_pointcloud3d_stereo_element_t;

/// A message in a client's queue. Not used: new data is stored in the devices.
typedef struct playerc_client_item {
  /// @{
  /// Same as in the interface's messages (libplayerinterface/player_structs.h).
  player_msghdr_t header;
  void* data;
  /// @}
} playerc_client_item_t;

/// Several clients that one thread reads together.
typedef struct _playerc_mclient_t {
  int client_count;                       ///< number of clients
  struct _playerc_client_t* client[128];  ///< the clients, in the order of their addition
  struct pollfd* pollfd;                  ///< not used: null
  double time;                            ///< time of the newest data that was read [s]
} playerc_mclient_t;

/// A device in the list of a port's devices.
typedef struct playerc_device_info {
  player_devaddr_t addr;                          ///< robot is the port
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];  ///< device type, as in world files
} playerc_device_info_t;

/// A client: the connection to one port of a simulation.
typedef struct _playerc_client_t {
  void* id;                   ///< this client, as playerc_client_read() returns it
  char* host;                 ///< as given
  int port;                   ///< as given
  int transport;              ///< as set; it has no effect
  struct sockaddr_in server;  ///< not used
  int connected;              ///< 1 between connect and disconnect
  int retry_limit;            ///< see playerc_client_set_retry_limit()
  double retry_time;          ///< see playerc_client_set_retry_time() [s]
  uint32_t overflow_count;    ///< number of readings dropped because the queue was full
  int sock;                   ///< not used: -1
  uint8_t mode;               ///< PLAYERC_DATAMODE_PULL (once connected) or PLAYERC_DATAMODE_PUSH
  int data_requested;         ///< not used
  int data_received;          ///< not used
  playerc_device_info_t
      devinfos[PLAYER_MAX_DEVICES];  ///< devices of the port, after playerc_client_get_devlist()
  int devinfo_count;                 ///< number of devices in devinfos
  struct _playerc_device_t* device[PLAYER_MAX_DEVICES];   ///< devices created for this client
  int device_count;                                       ///< number of devices in device
  playerc_client_item_t qitems[PLAYERC_QUEUE_RING_SIZE];  ///< not used
  int qfirst;                                             ///< not used
  int qlen;                 ///< number of devices with data that is not yet read
  int qsize;                ///< not used
  char* data;               ///< not used
  char* read_xdrdata;       ///< not used
  size_t read_xdrdata_len;  ///< not used
  double datatime;          ///< simulated time of the newest data that was read [s]
  double lasttime;          ///< simulated time of the data before that [s]
  double request_timeout;   ///< see playerc_client_set_request_timeout() [s]
} playerc_client_t;

/// Common part of all devices. The proxies of libplayerc++ also maintain the fields from the first
/// to fresh, for subclasses that read them (client is then null).
typedef struct _playerc_device_t {
  void* id;  ///< the device's struct, which begins with this one; playerc_client_read() returns it
  playerc_client_t* client;  ///< null after the client is destroyed
  player_devaddr_t addr;     ///< interface and index; robot is the port, after subscribing
  char drivername[PLAYER_MAX_DRIVER_STRING_LEN];  ///< device type, as in world files
  int subscribed;                                 ///< whether the device is subscribed
  double datatime;                                ///< simulated time of the newest data [s]
  double lasttime;                                ///< simulated time of the data before that [s]
  int fresh;                          ///< set to 1 by new data; the program sets it to 0
  int freshgeom;                      ///< set to 1 by get_geom; the program sets it to 0
  int freshconfig;                    ///< set to 1 by get_config; the program sets it to 0
  playerc_putmsg_fn_t putmsg;         ///< as given to playerc_device_init(); never called
  void* user_data;                    ///< for use by the program
  int callback_count;                 ///< number of callbacks
  playerc_callback_fn_t callback[4];  ///< see playerc_client_addcallback()
  void* callback_data[4];             ///< arguments of the callbacks
} playerc_device_t;

/// @name Errors and messages
/// @{

/// Error text of the last failed call of this thread; "" if no call has failed. Valid until the
/// next call that fails.
const char* playerc_error_str(void);
/// Always fails, because this library packs no messages.
int playerc_add_xdr_ftable(playerxdr_function_t* flist, int replace);
/// @}

/// @name Reading several clients
/// @{

/// Creates a list of clients that are read together.
/// @return null if memory runs out.
playerc_mclient_t* playerc_mclient_create(void);
/// Destroys the list; its clients continue to exist.
void playerc_mclient_destroy(playerc_mclient_t* mclient);
/// Adds a client.
/// @return 0, or -1 if the list already has 128 clients.
int playerc_mclient_addclient(playerc_mclient_t* mclient, struct _playerc_client_t* client);
/// Checks whether any of the clients has data. Waits for data for at most timeout [ms]; < 0:
/// without limit. In lockstep the timeout is simulated time, which advances step by step.
/// @return 1 if data is available, 0 if not, -1 if no client is connected.
int playerc_mclient_peek(playerc_mclient_t* mclient, int timeout);
/// Waits like playerc_mclient_peek(), then calls playerc_client_read() once for each client that
/// has data.
/// @return the number of clients that were read, 0 if none has data, -1 if none could be read.
int playerc_mclient_read(playerc_mclient_t* mclient, int timeout);
/// @}

/// @name Clients
/// @{

/// Creates a client that is not yet connected. Hosts and ports are those of PlayerClient.
/// @param mclient  list to which the client is added, or null.
/// @return null if memory runs out.
playerc_client_t* playerc_client_create(playerc_mclient_t* mclient, const char* host, int port);
/// Disconnects and destroys the client. Its devices exist until they are destroyed, but get no more
/// data.
void playerc_client_destroy(playerc_client_t* client);
/// Accepts PLAYERC_TRANSPORT_TCP or PLAYERC_TRANSPORT_UDP; it has no effect.
void playerc_client_set_transport(playerc_client_t* client, unsigned int transport);
/// Connects.
/// @return -1 for a port that no robot has, an invalid world file, a server that cannot be reached,
///         ...
int playerc_client_connect(playerc_client_t* client);
/// Disconnects and ends all subscriptions.
int playerc_client_disconnect(playerc_client_t* client);
/// Reconnects, with at most as many attempts as playerc_client_set_retry_limit() allows, and renews
/// all subscriptions.
int playerc_client_disconnect_retry(playerc_client_t* client);
/// Sets PLAYERC_DATAMODE_PULL (which playerc_client_connect() sets) or PLAYERC_DATAMODE_PUSH:
/// whether playerc_client_read() delivers a round of data or one device.
int playerc_client_datamode(playerc_client_t* client, uint8_t mode);
/// Requests a round of data. Does nothing here, because data needs no request.
int playerc_client_requestdata(playerc_client_t* client);
/// Sets whether new data replaces unread data (default) or is queued (at most 1000 readings per
/// device; a device shows the newest). -1 stands for all. Types other than PLAYER_MSGTYPE_DATA, and
/// subtypes, have no effect.
int playerc_client_set_replace_rule(playerc_client_t* client, int interf, int index, int type,
                                    int subtype, int replace);
/// Adds a device to the client's list; playerc_device_init() calls it.
int playerc_client_adddevice(playerc_client_t* client, struct _playerc_device_t* device);
/// Removes a device from the client's list.
/// @return -1 if it is not in the list.
int playerc_client_deldevice(playerc_client_t* client, struct _playerc_device_t* device);
/// Registers a function that is called with data whenever playerc_client_read() delivers the
/// device.
/// @return -1 if the device already has four callbacks.
int playerc_client_addcallback(playerc_client_t* client, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data);
/// Removes a callback added by playerc_client_addcallback().
int playerc_client_delcallback(playerc_client_t* client, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data);
/// Fills devinfos and devinfo_count.
int playerc_client_get_devlist(playerc_client_t* client);
/// Subscribes the client's device at an address. If the client has no device object for this
/// address, only checks whether the device exists.
/// @param drivername  receives the device type, at most len bytes; may be null.
int playerc_client_subscribe(playerc_client_t* client, int code, int index, int access,
                             char* drivername, size_t len);
/// Ends a subscription; the reverse of playerc_client_subscribe().
int playerc_client_unsubscribe(playerc_client_t* client, int code, int index);
/// Always fails, because this library sends no messages. Call the functions of the device instead.
int playerc_client_request(playerc_client_t* client, struct _playerc_device_t* device,
                           uint8_t reqtype, const void* req_data, void** rep_data);
/// Checks whether data is available. Waits for data for at most timeout [ms]; < 0: without limit.
/// In lockstep the timeout is simulated time. With timeout 0, the first call after
/// playerc_client_read() only checks; each further call in a row advances simulated time by one
/// step.
/// @return 1 if data is available or the run is over, 0 if not, -1 for errors.
int playerc_client_peek(playerc_client_t* client, int timeout);
/// Same as playerc_client_peek().
int playerc_client_internal_peek(playerc_client_t* client, int timeout);
/// Waits until devices have new data, copies the data to the devices' structs, and calls their
/// callbacks. With PLAYERC_DATAMODE_PULL each call handles a round of data: all devices. With
/// PLAYERC_DATAMODE_PUSH each call handles one device, in order. When no unread data is left,
/// simulated time advances.
/// @return the client (PULL, or if no device is subscribed); the device's struct, e.g. the
/// playerc_laser_t (PUSH); null for errors and at the end of the run.
void* playerc_client_read(playerc_client_t* client);
/// Calls playerc_client_read() if data is available.
/// @return 1 if data was read, 0 if not, -1 for errors.
int playerc_client_read_nonblock(playerc_client_t* client);
/// Same as playerc_client_read_nonblock().
/// @param proxy  receives the return value of playerc_client_read(); may be null.
int playerc_client_read_nonblock_withproxy(playerc_client_t* client, void** proxy);
/// Sets the timeout for a server's answers [s].
void playerc_client_set_request_timeout(playerc_client_t* client, uint32_t seconds);
/// Sets the maximum number of attempts to reconnect to a lost server; < 0: without limit; 0
/// (initially): none.
void playerc_client_set_retry_limit(playerc_client_t* client, int limit);
/// Sets the time between two attempts [s].
void playerc_client_set_retry_time(playerc_client_t* client, double time);
/// Always fails, like playerc_client_request().
int playerc_client_write(playerc_client_t* client, struct _playerc_device_t* device,
                         uint8_t subtype, void* cmd, double* timestamp);
/// @}

/// @name All devices
/// @{

/// Initializes a device's common part and adds it to the client. Only devices created by
/// playerc_X_create() can be subscribed.
void playerc_device_init(playerc_device_t* device, playerc_client_t* client, int code, int index,
                         playerc_putmsg_fn_t putmsg);
/// Removes the device from the client.
void playerc_device_term(playerc_device_t* device);
/// Subscribes to a device.
/// @param access  PLAYERC_OPEN_MODE.
/// @return -1 if the device does not exist; the error text names the existing ones.
int playerc_device_subscribe(playerc_device_t* device, int access);
/// Ends the subscription.
int playerc_device_unsubscribe(playerc_device_t* device);
/// Returns 1 if the device accepts or sends messages of this type, otherwise 0.
/// @param type  PLAYER_MSGTYPE_DATA, _CMD or _REQ.
int playerc_device_hascapability(playerc_device_t* device, uint32_t type, uint32_t subtype);
/// Properties are the device's numeric settings in the world, such as "frequency", in SI units and
/// radians. They cannot be changed during a run, and none is a string.
/// @return -1 if there is no property of this name and type.
int playerc_device_get_boolprop(playerc_device_t* device, char* property, BOOL* value);
int playerc_device_set_boolprop(playerc_device_t* device, char* property, BOOL value);
int playerc_device_get_intprop(playerc_device_t* device, char* property, int32_t* value);
int playerc_device_set_intprop(playerc_device_t* device, char* property, int32_t value);
int playerc_device_get_dblprop(playerc_device_t* device, char* property, double* value);
int playerc_device_set_dblprop(playerc_device_t* device, char* property, double value);
int playerc_device_get_strprop(playerc_device_t* device, char* property, char** value);
int playerc_device_set_strprop(playerc_device_t* device, char* property, char* value);
/// @}

#ifdef __cplusplus
}
#endif
