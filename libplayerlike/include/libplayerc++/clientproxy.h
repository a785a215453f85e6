// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <utility>

#include "libplayerc++/elements.h"
#include "libplayerc++/mutex.h"
#include "libplayerc++/playerclient.h"
#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "libplayerc++/readsignal.h"

namespace playerlike {
struct NewReading;
}  // namespace playerlike

namespace PlayerCc {

/// Common base of all proxies. A proxy represents the device at an index of an interface on a
/// client's port; its flags show whether it has data.
///
/// The library sets the valid flag at the first reading and clears it for good when the client is
/// gone. New data sets the fresh flag; the program clears it with NotFresh().
///
/// Members of a proxy whose client is gone throw PlayerError kDisconnected, unless documented
/// otherwise. Threads: as for PlayerClient.
///
/// A copy is an independent proxy of the same device. It starts with the data of the original, but
/// without the subscribers of its read signal. During the copy, no other thread may use the proxy
/// or call Read() on its client. A Graphics2dProxy, which owns a layer, and a
/// BlackBoardProxy cannot be copied.
class ClientProxy {
 public:
  typedef PlayerCc::read_signal_t read_signal_t;
  typedef PlayerCc::read_connection_t connection_t;
  typedef PlayerCc::mutex_t::scoped_lock scoped_lock_t;

  /// @throws PlayerError kDisconnected if the client is gone.
  ClientProxy(const ClientProxy& aOther);
  ClientProxy& operator=(const ClientProxy&) = delete;

  /// Ends the subscription. Waits for a subscriber of the read signal that is running in another
  /// thread.
  virtual ~ClientProxy();

  /// Whether a reading has arrived and the client still exists. Never throws.
  bool IsValid() const;
  /// Whether a reading has arrived since the last NotFresh(). Never throws.
  bool IsFresh() const;
  /// Clears the fresh flag. Never throws.
  void NotFresh();

  /// Type of this proxy's device in world files, e.g. "pose"; "" if there is no device.
  std::string GetDriverName() const;
  /// Simulated time of the newest reading [s]; 0 before the first.
  double GetDataTime() const;
  /// Simulated time between the two newest readings [s].
  double GetElapsedTime() const;

  /// The client; null once it is gone. Never throws.
  PlayerClient* GetPlayerClient() const;
  /// Index given to the constructor. Never throws.
  uint32_t GetIndex() const;
  /// Interface code, e.g. PLAYER_LASER_CODE. Never throws.
  uint32_t GetInterface() const;
  /// Interface name, e.g. "laser". Never throws.
  std::string GetInterfaceStr() const;

  /// Calls PlayerClient::SetReplaceRule() for this proxy's device.
  void SetReplaceRule(bool aReplace, int aType = -1, int aSubtype = -1);
  /// Returns 1 if the device accepts or sends messages of this type, otherwise 0.
  /// @param aType  PLAYER_MSGTYPE_DATA, _CMD or _REQ.
  int HasCapability(uint32_t aType, uint32_t aSubtype);

  // Properties are the device's numeric settings in the world, e.g. "frequency" or "range_max", in
  // SI units and radians, and the strings "name", "type" and "robot". Each function returns 0 on
  // success. On failure it returns -1 and leaves the value unchanged. In a world of Playpen,
  // properties cannot be changed during a run, so the Set functions return -1. The properties of a
  // Player server's devices are those of its drivers.
  int GetBoolProp(char* aProperty, bool* aValue);  ///< Property with value 0 or 1.
  int SetBoolProp(char* aProperty, bool aValue);
  int GetIntProp(char* aProperty, int32_t* aValue);  ///< Property with an integer value.
  int SetIntProp(char* aProperty, int32_t aValue);
  int GetDblProp(char* aProperty, double* aValue);  ///< Any property.
  int SetDblProp(char* aProperty, double aValue);
  /// A string property. The text is allocated with malloc(); the caller frees it.
  int GetStrProp(char* aProperty, char** aValue);
  int SetStrProp(char* aProperty, char* aValue);

  /// Registers a function that is called without arguments after each Read() with new data for this
  /// proxy. It runs in the reading thread, with mMutex unlocked.
  /// @param aSubscriber  any callable: a function, a lambda, the result of std::bind, ...
  template <typename T>
  connection_t ConnectReadSignal(T aSubscriber) {
    return mReadSignal.connect(std::function<void()>(aSubscriber));
  }
  /// Removes a function registered by ConnectReadSignal().
  void DisconnectReadSignal(connection_t aSubscriber) { mReadSignal.disconnect(aSubscriber); }

 protected:
  /// Creates a proxy that has no device yet.
  /// @throws PlayerError kBadArgument if the client is null.
  explicit ClientProxy(PlayerClient* aPc, uint32_t aIndex = 0);

  /// Called by the constructors of proxies. The implementation of the base class does nothing.
  virtual void Subscribe(uint32_t aIndex);
  /// Called by the destructors of proxies. The implementation of the base class ends the
  /// subscription.
  virtual void Unsubscribe();

  /// Copies a variable of this proxy, with the client's mutex locked.
  template <typename T>
  T GetVar(const T& aV) const {
    const scoped_lock_t lock(LockData());
    return aV;
  }
  /// Copies a range of this proxy's data, with the client's mutex locked.
  template <typename Iterator, typename Destination>
  void GetVarByRef(const Iterator aBegin, const Iterator aEnd, Destination aDest) const {
    const scoped_lock_t lock(LockData());
    std::copy(aBegin, aEnd, aDest);
  }

  // For the proxies of this library. The following functions are called with mMutex locked, unless
  // documented otherwise. Functions with a parameter aFun throw PlayerError with that function
  // name.

  /// Finds the device at (interface, index) on the client's port and subscribes to it, unless it
  /// has no readings. Locks mMutex.
  void Attach(uint32_t aInterface, uint32_t aIndex, const char* aFun, bool aHasReadings = true);
  /// Locks mMutex.
  /// @throws PlayerError kDisconnected if the client is gone; kRunIsOver as described at
  ///         PlayerClient::StartThread().
  scoped_lock_t LockData(const char* aFun = "ClientProxy") const;
  /// Returns the result of aLook for the newest reading, of type Reading; before the first reading,
  /// for a default-constructed one. Calls LockData(). Defined in the library's sources, like the
  /// reading types.
  template <typename Reading, typename Function>
  auto Look(Function aLook, const char* aFun = "ClientProxy") const
      -> decltype(aLook(std::declval<const Reading&>()));
  /// Returns a member of the newest reading; see above.
  template <typename Reading, typename T>
  T Look(T Reading::*aMember, const char* aFun = "ClientProxy") const;
  /// Called for each new reading of the device. The implementation of the base class lets the
  /// getters return it.
  virtual void HandleReading(const playerlike::NewReading& aNew);
  /// Calls HandlePoll() in each round from now on. For proxies of the world, which have no
  /// readings.
  void Poll();
  /// Requests new data from the session. Returns whether there are any.
  virtual bool HandlePoll();
  /// Called after all new readings were handled. Send commands that react to readings here.
  virtual void HandleRound();

  /// The library's internal data about the proxy's device.
  struct Link;

  PlayerClient* mPc;                   ///< null once the client is gone
  playerc_client_t* mClient;           ///< always null: this library is not built on the C library
  playerc_device_t* mInfo;             ///< never null
  bool mFresh;                         ///< see IsFresh(); guarded by mMutex
  mutable detail::Elements mElements;  ///< beams; for proxies of rangefinders; set by mLink
  std::unique_ptr<Link> mLink;

 private:
  read_signal_t mReadSignal;
  uint32_t mIndex;
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags on one line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::ClientProxy& c);
}  // namespace std
