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

/// A client's connection to a simulation, or to the robots of a server. Proxies of devices are made
/// with a pointer to it, and Read() fills them.
///
/// Hosts: "localhost" and "127.0.0.1" are the simulation of this process, of the world file that
/// the environment variable PLAYPEN_WORLD names, else of the default arena; "sim:FILE" is the
/// simulation of that world file; "tcp://HOST[:PORT]", or any other host, is the server there
/// (`playpen serve`), on TCP port 4000 unless told otherwise, as is "localhost" if PLAYPEN_WORLD is
/// "tcp://HOST[:PORT]". Ports: each robot has its own (6665, 6666, ... in order); on it,
/// index 0 of an interface is that robot's first device. On port 4000 all robots are seen, and a
/// device's index is the one the world's proxies table gives, by default the robot's number.
///
/// Time: in lockstep, the default, simulated time stands still while the program thinks and
/// goes on in Read(). A lockstep client belongs to the thread that last called Read() on it.
///
/// Errors: every member but the destructor may throw PlayerError, with the member's name as
/// GetErrorFun().
///
/// Threads: all members may be called from any thread. mMutex is held for short moments only, never
/// while waiting. Clients may be at namespace scope, and may be destroyed before or after their
/// proxies; proxies without client are invalid and their calls throw PlayerError.
class PlayerClient {
 public:
  typedef PlayerCc::mutex_t mutex_t;

  /// Connects.
  /// @param aPort      Player port: of a robot, or 4000 for all; not the TCP port of a server.
  /// @param transport  PLAYERC_TRANSPORT_TCP or PLAYERC_TRANSPORT_UDP; it makes no difference.
  /// @throws PlayerError with what the session said: kNoSuchDevice for a port that no robot has,
  ///         kBadWorld for a world file that is not sound, kDisconnected for a server that is not
  ///         there, ...
  PlayerClient(const std::string aHostname = PLAYER_HOSTNAME, uint32_t aPort = PLAYER_PORTNUM,
               int transport = PLAYERC_TRANSPORT_TCP);

  /// A client of a session that the program has opened itself (playerlike/session/session.h), e.g.
  /// of a host it runs, or of a substitute in a test. GetHostname() is "".
  /// @param aSession  must not be null.
  explicit PlayerClient(std::unique_ptr<playerlike::Session> aSession);

  /// Another name of the same client: whichever of them reads, all proxies get their data, and it
  /// is connected until the last of them is destroyed.
  PlayerClient(const PlayerClient& aOther);
  PlayerClient& operator=(const PlayerClient&) = delete;

  /// Disconnects and ends the thread of StartThread(), unless there are copies. Threads waiting in
  /// Read() throw PlayerError.
  ~PlayerClient();

  /// Whether the connection is open.
  bool Connected();

 private:
  std::shared_ptr<playerlike::ClientCore> mCore;  // before mMutex, which is part of it

 public:
  /// Protects the data of this client's proxies. Held by Read() while it fills them, and by every
  /// call of a proxy, so a program that holds it must not call proxies meanwhile.
  mutex_t& mMutex;

  /// Starts a thread that calls Read() until StopThread(), the end of the run, or this client's
  /// destruction. A lockstep simulation whose time mode nobody chose goes over to real time, since
  /// a program that does so counts on the wall clock. After the run has ended this way, calls of
  /// this client's proxies throw PlayerError kRunIsOver, so that a program that never reads itself
  /// notices it, until StopThread() is called. Nothing happens if the thread runs already.
  void StartThread();
  /// Ends that thread; when it returns no proxy changes any more. Callable in a subscriber of a
  /// read signal too.
  void StopThread();
  /// Calls Read() in this thread until Stop() is called, by a subscriber or another thread.
  /// @param aTimeout  longest single wait for data [ms].
  /// @throws PlayerError kRunIsOver at the end of the run.
  void Run(uint32_t aTimeout = 10);
  /// Lets Run(), or the thread of StartThread(), end soon; does not wait for it.
  void Stop();

  /// Whether data waits (or the run is over), so that Read() returns at once. In lockstep
  /// Peek(0) right after a Read() only looks, and each further one in a row lets one step pass.
  /// @param timeout  how long to wait for data [ms]: of simulated time in lockstep, else of wall
  ///                 time.
  bool Peek(uint32_t timeout = 0);
  /// Waits until at least one subscribed device has new data, then fills all proxies that have some
  /// and marks them fresh. In lockstep this is what lets time pass. Without any proxy it lets a
  /// tenth of a simulated second pass.
  /// @throws PlayerError kRunIsOver, text "the simulated run is over", at the end of the run;
  ///         kDisconnected when the client is destroyed meanwhile.
  void Read();
  /// Read() if Peek(0), else nothing.
  void ReadIfWaiting();

  /// How long a server may take to answer, 10 s at first; one that takes longer counts as gone, and
  /// the call throws PlayerError kDisconnected. Read() may wait longer, as long as the server shows
  /// that it lives. Without effect inside a process, where answers come at once.
  /// @param seconds  [s]; 0 counts as 1.
  void SetRequestTimeout(uint32_t seconds);
  /// How often to try again to connect when a server is gone, before a call throws; -1: for ever;
  /// 0, at first: not at all. Proxies go on with the new connection; layers and what was drawn may
  /// be lost. Kept, without effect, inside a process.
  void SetRetryLimit(int limit);
  int GetRetryLimit();
  /// Time between two tries [s], 10 at first; kept, as above.
  void SetRetryTime(double time);
  double GetRetryTime();

  /// PLAYER_DATAMODE_PULL (default) or PLAYER_DATAMODE_PUSH; both are accepted and do the same:
  /// Read() hands over all that has arrived.
  /// @throws PlayerError kBadArgument for another mode.
  void SetDataMode(uint32_t aMode);
  /// @deprecated Of Player 2.0, where clients chose how often data are sent. Here each device has a
  /// frequency of its own, which the world sets, so this changes nothing.
  /// @param aFreq  [Hz].
  void SetFrequency(uint32_t aFreq);
  /// Whether a newer reading replaces one that was not read yet (the default), or all of them are
  /// kept (at most 1000 a device) and Read() hands them over in order; a proxy then shows the
  /// newest. Rules for message types other than data, or for subtypes that a device does not send,
  /// change nothing: only readings ever wait.
  /// @param aType     PLAYER_MSGTYPE_DATA, or -1 for all.
  /// @param aInterf   interface code, or -1 for all. Devices subscribed to later obey too.
  void SetReplaceRule(bool aReplace, int aType = -1, int aSubtype = -1, int aInterf = -1);
  /// @deprecated Of Player 2.0: the same in another order. A rule for an index holds for all of
  /// the interface's.
  /// @param aReplace  0: no, else yes.
  void SetReplaceRule(int aInterf, int aIndex, int aType, int aSubtype, int aReplace) {
    static_cast<void>(aIndex);
    SetReplaceRule(aReplace != 0, aType, aSubtype, aInterf);
  }

  /// Asks for the list of devices on this client's port.
  void RequestDeviceList();
  /// The list as of the last RequestDeviceList(); empty before.
  std::list<playerc_device_info_t> GetDeviceList();

  std::string GetHostname() const;
  uint32_t GetPort() const;

  /// Code of an interface by its name, e.g. 6 for "laser"; -1 for a name that is none.
  int LookupCode(std::string aName) const;
  /// Name of an interface by its code, e.g. "laser" for 6; "unknown" for a code that is none.
  std::string LookupName(int aCode) const;

  /// How many readings were dropped since they waited too long; see SetReplaceRule().
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
/// Prints host, port, whether connected, and the devices of the port, one a line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerClient& c);
}  // namespace std
