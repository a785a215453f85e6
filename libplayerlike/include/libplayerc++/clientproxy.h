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

namespace PlayerCc {

/// What all proxies have in common: a device at an index of an interface on a client's port, and
/// flags that tell whether it has data.
///
/// The valid flag belongs to the library: up from the first reading on, down for good when the
/// client is gone. The fresh flag is raised by new data and lowered by the program with NotFresh().
///
/// A call on a proxy whose client is gone throws PlayerError kDisconnected, except for those
/// documented otherwise. Threads: as PlayerClient.
///
/// A copy is another proxy of the same device, with the data that there were; it goes its own way
/// from then on, without the subscribers of the read signal. No other thread may use the proxy, nor
/// read on its client, while it is copied. A Graphics2dProxy cannot be copied: it has a sheet of
/// its own.
class ClientProxy {
 public:
  typedef PlayerCc::read_signal_t read_signal_t;
  typedef PlayerCc::read_connection_t connection_t;
  typedef PlayerCc::mutex_t::scoped_lock scoped_lock_t;

  /// @throws PlayerError kDisconnected if the client is gone.
  ClientProxy(const ClientProxy& aOther);
  ClientProxy& operator=(const ClientProxy&) = delete;

  /// Ends the subscription. Waits for a subscriber of the read signal that runs in another thread.
  virtual ~ClientProxy();

  /// Whether a reading has arrived and the client is still there. Never throws.
  bool IsValid() const;
  /// Whether a reading has arrived since the last NotFresh(). Never throws.
  bool IsFresh() const;
  /// Lowers the fresh flag. Never throws.
  void NotFresh();

  /// Kind of device behind this proxy as world files name it, e.g. "pose"; "" if there is none.
  std::string GetDriverName() const;
  /// Simulated time of the newest reading [s]; 0 before the first.
  double GetDataTime() const;
  /// Simulated time between the newest reading and the one before it [s].
  double GetElapsedTime() const;

  /// The client; null once it is gone. Never throws.
  PlayerClient* GetPlayerClient() const;
  /// As given to the constructor. Never throws.
  uint32_t GetIndex() const;
  /// Interface code, e.g. PLAYER_LASER_CODE. Never throws.
  uint32_t GetInterface() const;
  /// Interface name, e.g. "laser". Never throws.
  std::string GetInterfaceStr() const;

  /// As PlayerClient::SetReplaceRule(), for this proxy's device.
  void SetReplaceRule(bool aReplace, int aType = -1, int aSubtype = -1);
  /// Whether the device understands, or sends, such messages: 1 if so, 0 if not.
  /// @param aType  PLAYER_MSGTYPE_DATA, _CMD or _REQ.
  int HasCapability(uint32_t aType, uint32_t aSubtype);

  // Properties are the device's numeric settings in the world, e.g. "frequency" or "range_max", in
  // SI units and radians. Each function returns 0 if it did what it should, else -1, and then
  // leaves the value as it was. Settings cannot be changed while a simulation runs, and none is a
  // text, so those functions always return -1.
  int GetBoolProp(char* aProperty, bool* aValue);  ///< A property that is 0 or 1.
  int SetBoolProp(char* aProperty, bool aValue);
  int GetIntProp(char* aProperty, int32_t* aValue);  ///< A property that is a whole number.
  int SetIntProp(char* aProperty, int32_t aValue);
  int GetDblProp(char* aProperty, double* aValue);  ///< Any property.
  int SetDblProp(char* aProperty, double aValue);
  int GetStrProp(char* aProperty, char** aValue);
  int SetStrProp(char* aProperty, char* aValue);

  /// Lets a function be called, without arguments, after each Read() that brought this proxy new
  /// data: in the thread that reads, with mMutex unlocked.
  /// @param aSubscriber  anything callable: a function, a lambda, the result of std::bind, ...
  template <typename T>
  connection_t ConnectReadSignal(T aSubscriber) {
    return mReadSignal.connect(std::function<void()>(aSubscriber));
  }
  /// Undoes ConnectReadSignal().
  void DisconnectReadSignal(connection_t aSubscriber) { mReadSignal.disconnect(aSubscriber); }

 protected:
  /// A proxy of no device yet.
  /// @throws PlayerError kBadArgument if the client is null.
  explicit ClientProxy(PlayerClient* aPc, uint32_t aIndex = 0);

  /// Called by the constructors of proxies; the base class subscribes to nothing.
  virtual void Subscribe(uint32_t aIndex);
  /// Called by the destructors of proxies; the base class ends whatever subscription there is.
  virtual void Unsubscribe();

  /// A copy of a variable of this proxy, made under the client's mutex.
  template <typename T>
  T GetVar(const T& aV) const {
    const scoped_lock_t lock(LockData());
    return aV;
  }
  /// Copies a range of this proxy's data, under the client's mutex.
  template <typename Iterator, typename Destination>
  void GetVarByRef(const Iterator aBegin, const Iterator aEnd, Destination aDest) const {
    const scoped_lock_t lock(LockData());
    std::copy(aBegin, aEnd, aDest);
  }

  // For the proxies of this library. What follows is called with mMutex locked unless said
  // otherwise, and functions with a parameter aFun throw PlayerError in that name.

  /// Finds the device at (interface, index) on the client's port and subscribes to it, unless it
  /// has no readings. Takes mMutex.
  void Attach(uint32_t aInterface, uint32_t aIndex, const char* aFun, bool aHasReadings = true);
  /// Locks mMutex.
  /// @throws PlayerError kDisconnected if the client is gone; kRunIsOver, see StartThread().
  scoped_lock_t LockData(const char* aFun = "ClientProxy") const;
  /// What aLook makes of the newest reading, of type Reading; before the first one, of one as it is
  /// made. Locks as LockData(). Defined in the library's own sources, as are the readings.
  template <typename Reading, typename Function>
  auto Look(Function aLook, const char* aFun = "ClientProxy") const
      -> decltype(aLook(std::declval<const Reading&>()));
  /// The same for a member of the reading.
  template <typename Reading, typename T>
  T Look(T Reading::*aMember, const char* aFun = "ClientProxy") const;
  /// The newest reading of the device is another one.
  virtual void HandleReading();
  /// After all new readings were handled: the place for commands that react to them.
  virtual void HandleRound();

  /// What the library knows of the device behind a proxy; for its own sources.
  struct Link;

  PlayerClient* mPc;          ///< null once the client is gone
  playerc_client_t* mClient;  ///< null: there is no C library below
  playerc_device_t* mInfo;    ///< never null
  bool mFresh;                ///< see IsFresh(); under mMutex
  std::unique_ptr<Link> mLink;
  mutable detail::Elements mElements;  ///< of proxies of rangefinders

 private:
  read_signal_t mReadSignal;
  uint32_t mIndex;
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags on one line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::ClientProxy& c);
}  // namespace std
