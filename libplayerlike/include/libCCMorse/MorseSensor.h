// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "libCCMorse/MorseDevice.h"
#include "libplayerc++/elements.h"

namespace CCMorse {

/// Base class of devices that produce readings. MorseClient::Read() updates them.
///
/// The library sets the valid flag at the first reading and clears it when the client is gone. New
/// data sets the fresh flag; the program clears it with NotFresh().
class MorseSensor : public MorseDevice {
 public:
  ~MorseSensor() override;

  bool IsValid() const;  ///< Never throws.
  bool IsFresh() const;  ///< Never throws.
  void NotFresh();       ///< Never throws.
  /// Simulated time of the newest reading [s]; 0 before the first.
  double GetTime() const;
  /// Number of readings per simulated second [Hz].
  double GetFrequency() const;

 protected:
  MorseSensor(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

  /// Attach() subscribes to readings, Detach() unsubscribes. Constructors and destructors of
  /// sensors call them.
  void Attach();
  void Detach();
  /// Called for each new reading, with the client's data locked.
  virtual void HandleReading();
  /// Returns the result of aLook for the newest reading, of type Reading; before the first reading,
  /// for a default-constructed one. Calls Lock(). Defined in the library's sources, like the
  /// reading types.
  template <typename Reading, typename Function>
  auto Look(const char* aFunction, Function aLook) const
      -> decltype(aLook(std::declval<const Reading&>()));
  /// Returns a member of the newest reading; see above.
  template <typename Reading, typename T>
  T Look(const char* aFunction, T Reading::*aMember) const;

  struct Receiver;
  mutable PlayerCc::detail::Elements mElements;  ///< beams of rangefinders; set by mReceiver
  std::unique_ptr<Receiver> mReceiver;
};

}  // namespace CCMorse
