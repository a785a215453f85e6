// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <list>
#include <memory>
#include <string>

#include "libplayerc++/boostnames.h"
#include "libplayerc++/mutex.h"
#include "libplayerc++/playerc++config.h"
#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "libplayerc++/utility.h"

namespace playerlike {
class ClientCore;
class Session;
}  // namespace playerlike

namespace PlayerCc {

namespace detail {
struct CoreAccess;
}

/// A client's connection to a simulation or to a server's robots. Proxies of devices are
/// constructed with a pointer to it, and Read() updates them.
///
/// Host names:
/// - "localhost" and "127.0.0.1": the simulation of this process. The environment variable
///   PLAYPEN_WORLD names its world file; the default is the SyRoTek arena. If PLAYPEN_WORLD is
///   "tcp://HOST[:PORT]" or "player://HOST[:PORT]", it is that server.
/// - "sim:FILE": a simulation of that world file in this process; a new one when all clients of the
///   earlier one are gone.
/// - "tcp://HOST[:PORT]" or "HOST:PORT": a Playpen server (`playpen serve`), by default on TCP port
///   4000. "unix:PATH": the one at that Unix socket. PLAYPEN_WORLD may be this, too.
/// - "player://HOST[:PORT]": a Player server, e.g. of a real robot; the default TCP port is that of
///   the client.
/// - any other host name: the server there, of Player on the client's port or else of Playpen. If
///   PLAYPEN_WORLD is set, it means "localhost" instead, and a warning says so.
///
/// Ports: each robot has its own port (6665, 6666, ... in order). On that port, index 0 of an
/// interface is the robot's first device. Port 4000 gives access to all robots; there, the world's
/// proxies table defines the index of a device, which is by default the robot's number.
///
/// Time: in lockstep (default), simulated time advances only inside Read() and stands still while
/// the program computes. A lockstep client belongs to the thread that last called Read() on it.
///
/// Errors: every member except the destructor may throw PlayerError; its GetErrorFun() is the
/// member's name.
///
/// Threads: all members may be called from any thread. mMutex is locked only briefly, never while
/// waiting.
///
/// Lifetime: clients may be global variables, and they may be destroyed before or after their
/// proxies. A proxy without a client is invalid, and its members throw PlayerError.
class PlayerClient {
 public:
  typedef PlayerCc::mutex_t mutex_t;

  /// Connects to a simulation or server.
  /// @param aPort      Player port: a robot's port, or 4000 for all robots; not the TCP port of a
  ///                   server.
  /// @param transport  PLAYERC_TRANSPORT_TCP or PLAYERC_TRANSPORT_UDP; it has no effect.
  /// @throws PlayerError with the session's error: kNoSuchDevice for a port that no robot has,
  ///         kBadWorld for an invalid world file, kDisconnected for a server that cannot be
  ///         reached, ...
  PlayerClient(const std::string aHostname = PLAYER_HOSTNAME, uint32_t aPort = PLAYER_PORTNUM,
               int transport = PLAYERC_TRANSPORT_TCP);

  /// Creates a client for a session that the program has opened itself
  /// (playerlike/session/session.h), e.g. a session of its own host, or a test double.
  /// GetHostname() is "".
  /// @param aSession  must not be null.
  explicit PlayerClient(std::unique_ptr<playerlike::Session> aSession);

  /// Creates another handle to the same client. Reading on any handle updates all proxies. The
  /// client stays connected until the last handle is destroyed.
  PlayerClient(const PlayerClient& aOther);
  PlayerClient& operator=(const PlayerClient&) = delete;

  /// Disconnects and ends the thread of StartThread(), unless there are copies. Threads that wait
  /// in Read() get a PlayerError.
  ~PlayerClient();

  /// Whether the connection is open.
  bool Connected();

 private:
  std::shared_ptr<playerlike::ClientCore> mCore;  // declared before mMutex, which refers to a part
                                                  // of it

 public:
  /// Guards the data of this client's proxies. Read() locks it while it updates them, and every
  /// member of a proxy locks it. A program that holds it must therefore not call proxies.
  mutex_t& mMutex;

  /// Starts a thread that calls Read() until StopThread(), the end of the run, or this client's
  /// destruction. Does nothing if the thread is already running.
  ///
  /// If no time mode was chosen, a lockstep simulation switches to real time, because programs with
  /// such a thread rely on the wall clock. After the end of the run, members of this client's
  /// proxies throw PlayerError kRunIsOver until StopThread() is called, so that a program that
  /// never calls Read() notices the end.
  void StartThread();
  /// Ends the thread of StartThread(). Proxies no longer change when it returns. A subscriber of a
  /// read signal may call it too.
  void StopThread();
  /// Calls Read() in the calling thread until a subscriber or another thread calls Stop().
  /// @param aTimeout  longest single wait for data [ms].
  /// @throws PlayerError kRunIsOver at the end of the run.
  void Run(uint32_t aTimeout = 10);
  /// Asks Run() and the thread of StartThread() to end; does not wait for them.
  void Stop();

  /// Returns whether data is available (or the run is over), so that Read() returns immediately. In
  /// lockstep, the first Peek(0) after a Read() only checks; each further Peek(0) in a row advances
  /// simulated time by one step.
  /// @param timeout  longest time to wait for data [ms]: simulated time in lockstep, otherwise wall
  ///                 time.
  bool Peek(uint32_t timeout = 0);
  /// Waits until at least one subscribed device has new data, then updates all proxies with new
  /// data and marks them fresh. In lockstep, simulated time advances meanwhile. If the client has
  /// no proxies, simulated time advances by 0.1 s.
  /// @throws PlayerError kRunIsOver with the text "the simulated run is over" at the end of the
  ///         run; kDisconnected if the client is destroyed meanwhile.
  void Read();
  /// Calls Read() if Peek(0) returns true.
  void ReadIfWaiting();

  /// Sets the timeout for a server's answers; initially 10 s. After the timeout the server counts
  /// as disconnected, and the call throws PlayerError kDisconnected. Read() may wait longer while
  /// the server sends signs of life. Has no effect for a simulation in this process, which answers
  /// immediately.
  /// @param seconds  [s]; 0 counts as 1.
  void SetRequestTimeout(uint32_t seconds);
  /// Sets how often a call tries to reconnect to a lost server before it throws. -1: without limit;
  /// 0 (initial value): never. Proxies continue to work with the new connection; layers and
  /// drawings may be lost. For a simulation in this process the value is stored but has no effect.
  void SetRetryLimit(int limit);
  int GetRetryLimit();
  /// Sets the time between two attempts [s]; initially 10. Stored like the limit above.
  void SetRetryTime(double time);
  double GetRetryTime();

  /// Accepts PLAYER_DATAMODE_PULL (default) and PLAYER_DATAMODE_PUSH. Both have the same effect:
  /// Read() delivers all data that has arrived.
  /// @throws PlayerError kBadArgument for any other mode.
  void SetDataMode(uint32_t aMode);
  /// @deprecated Player 2.0: sets how often the server sends data. It changes nothing here, because
  /// the world file sets the frequency of each device.
  /// @param aFreq  [Hz].
  void SetFrequency(uint32_t aFreq);
  /// Sets whether a new reading replaces an unread one (default) or is queued behind it. A queue
  /// holds at most 1000 readings per device; Read() delivers them in order, and a proxy then shows
  /// the newest. Rules for message types other than data, or for subtypes that a device does not
  /// send, have no effect, because only readings are queued.
  /// @param aType     PLAYER_MSGTYPE_DATA, or -1 for all.
  /// @param aInterf   interface code, or -1 for all. The rule also applies to later subscriptions.
  void SetReplaceRule(bool aReplace, int aType = -1, int aSubtype = -1, int aInterf = -1);
  /// @deprecated Player 2.0: SetReplaceRule() with another order of parameters. The rule applies to
  /// all indexes of the interface.
  /// @param aReplace  0 for false, anything else for true.
  void SetReplaceRule(int aInterf, int aIndex, int aType, int aSubtype, int aReplace) {
    static_cast<void>(aIndex);
    SetReplaceRule(aReplace != 0, aType, aSubtype, aInterf);
  }

  /// Requests the list of devices on this client's port.
  void RequestDeviceList();
  /// Returns the list from the last RequestDeviceList(); empty before the first.
  std::list<playerc_device_info_t> GetDeviceList();

  std::string GetHostname() const;
  uint32_t GetPort() const;

  /// Code of an interface by its name, e.g. 6 for "laser"; -1 for an unknown name.
  int LookupCode(std::string aName) const;
  /// Name of an interface by its code, e.g. "laser" for 6; "unknown" for an unknown code.
  std::string LookupName(int aCode) const;

  /// Number of readings that were dropped because a queue was full; see SetReplaceRule().
  uint32_t GetOverflowCount();

 private:
  friend class ClientProxy;
  friend struct detail::CoreAccess;
  struct Impl;
  PlayerClient(std::unique_ptr<playerlike::Session> aSession, const std::string& aHostname,
               uint32_t aPort);
  std::shared_ptr<Impl> mImpl;
};

}  // namespace PlayerCc

namespace std {
/// Prints host, port, state of the connection, and the devices of the port, one per line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerClient& c);
}  // namespace std
