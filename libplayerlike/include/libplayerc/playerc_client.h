// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Clients, errors, and what is common to all devices of Player's C client library; programs
/// include libplayerc/playerc.h. It works on the same simulations as libplayerc++.
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

#ifdef __cplusplus
}
#endif
