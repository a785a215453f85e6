// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "libCCMorse/MorseDevice.h"
#include "libplayerc++/elements.h"

namespace CCMorse {

/// A device that makes readings, which MorseClient::Read() brings.
///
/// The valid flag belongs to the library: up from the first reading on, down when the client is
/// gone. The fresh flag is raised by new data and lowered by the program with NotFresh().
class MorseSensor : public MorseDevice {
 public:
  ~MorseSensor() override;

  bool IsValid() const;  ///< Never throws.
  bool IsFresh() const;  ///< Never throws.
  void NotFresh();       ///< Never throws.
  /// Simulated time of the newest reading [s]; 0 before the first.
  double GetTime() const;
  /// Readings a simulated second [Hz].
  double GetFrequency() const;

 protected:
  MorseSensor(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

  /// Starts and ends the flow of readings: called by constructors and destructors of sensors.
  void Attach();
  void Detach();
  /// The newest reading is another one; called with the client's data locked.
  virtual void HandleReading();
  /// What aLook makes of the newest reading, of type Reading; before the first one, of one as it is
  /// made. Locks as Lock(). Defined in the library's own sources, as are the readings.
  template <typename Reading, typename Function>
  auto Look(const char* aFunction, Function aLook) const
      -> decltype(aLook(std::declval<const Reading&>()));
  /// The same for a member of the reading.
  template <typename Reading, typename T>
  T Look(const char* aFunction, T Reading::*aMember) const;

  struct Receiver;
  mutable PlayerCc::detail::Elements mElements;  ///< of rangefinders; mReceiver binds it
  std::unique_ptr<Receiver> mReceiver;
};

}  // namespace CCMorse
