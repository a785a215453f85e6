// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace PlayerCc {

/// What the client library throws: what went wrong, in which function, and a code.
///
/// In CCMorse programs the same class is called MorseError. It is no std::exception, as Player's is
/// none: programs catch it by value as often as by reference, and compilers warn of that for
/// classes with virtual functions. One that nobody catches is printed before the program aborts.
class PlayerError {
 public:
  /// Codes by which a program can tell errors apart. All are negative; -1 is Player's own default.
  enum Code {
    kFailed = -1,     ///< anything without a code of its own
    kRunIsOver = -2,  ///< the simulated duration is over; the text says "the simulated run is over"
    kDisconnected = -3,  ///< the connection, or the client of a proxy, is gone
    kNoSuchDevice = -4,  ///< the world has no such port or device; the text names those it has
    kNotAvailable = -5,  ///< not possible with this kind of simulation or device
    kBadArgument = -6,   ///< a value that cannot be meant: NaN, an index beyond the end, ...
    kBadWorld = -7,      ///< the world file is not sound; the text holds every issue, one a line
  };

  /// @param aFun   function that failed, e.g. "LaserProxy::GetRange".
  /// @param aStr   what is wrong, a sentence for a person.
  /// @param aCode  one of Code, or a program's own.
  PlayerError(const std::string aFun = "", const std::string aStr = "", const int aCode = -1);

  /// What is wrong.
  std::string GetErrorStr() const { return mStr; }
  /// The function that failed.
  std::string GetErrorFun() const { return mFun; }
  /// One of Code.
  int GetErrorCode() const { return mCode; }

 private:
  std::string mFun;
  std::string mStr;
  int mCode;
};

}  // namespace PlayerCc

namespace std {
/// Prints function, text and code on one line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerError& e);
}  // namespace std
