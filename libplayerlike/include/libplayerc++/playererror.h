// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace PlayerCc {

/// The exception class of the client library: error text, function name and code.
///
/// CCMorse programs call this class MorseError. Like Player's class, it does not derive from
/// std::exception: many programs catch it by value, and compilers warn about that for classes with
/// virtual functions. An uncaught PlayerError is printed before the program aborts.
class PlayerError {
 public:
  /// Error codes. All are negative; -1 is Player's default.
  enum Code {
    kFailed = -1,     ///< any error without a code of its own
    kRunIsOver = -2,  ///< the simulated duration is over; the text says "the simulated run is over"
    kDisconnected = -3,  ///< the connection is lost, or a proxy's client is gone
    kNoSuchDevice = -4,  ///< the world has no such port or device; the text names the existing ones
    kNotAvailable = -5,  ///< not possible with this kind of simulation or device
    kBadArgument = -6,   ///< an invalid value: NaN, an index out of range, ...
    kBadWorld = -7,      ///< the world file is invalid; the text lists every issue, one per line
  };

  /// @param aFun   name of the function that failed, e.g. "LaserProxy::GetRange".
  /// @param aStr   error text for the user.
  /// @param aCode  one of Code, or a code defined by the program.
  PlayerError(const std::string aFun = "", const std::string aStr = "", const int aCode = -1);

  /// Error text: valid UTF-8. Bytes of names that are not appear as "\xNN".
  std::string GetErrorStr() const { return mStr; }
  /// Name of the function that failed.
  std::string GetErrorFun() const { return mFun; }
  /// Error code, usually one of Code.
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
