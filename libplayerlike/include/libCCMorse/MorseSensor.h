// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "libCCMorse/MorseDevice.h"

namespace sim {
struct Reading;
}

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
  /// A new reading, valid during the call, with the client's data locked.
  virtual void HandleReading(const sim::Reading& aReading) = 0;

 private:
  struct Receiver;
  std::unique_ptr<Receiver> mReceiver;
};

}  // namespace CCMorse
