// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Robots and obstacles by name: where they are, in truth and not as any sensor has it, and how
/// they look.
///
/// It is one for all robots: index 0 on every port. Names are those of the world's robots,
/// obstacles and dock separators, "border" and "wall". Poses are in the world W [m, rad]: of the
/// middle of a robot's axle, and of the middle of anything else. What is set is so at once, before
/// the call returns; a robot's motors go on as they were told last. Nothing here lets simulated
/// time pass.
///
/// What cannot be done is left undone, and a warning on standard error tells why: there is no such
/// name or property (it lists what there is), an obstacle stands where the robot was to be put, the
/// value_len does not fit, the world or the server does not allow it. It does not throw, as
/// Player's does not: programs name things of worlds of their own. Where something was asked for,
/// what is there stays as it is. A proxy tells each such thing once.
///
/// All calls throw PlayerError: kBadArgument for a null pointer, and a number that is none;
/// kDisconnected if the client is gone.
class SimulationProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index that is not 0, or a port without robots.
  SimulationProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~SimulationProxy() override;

  /// Puts a robot, or an obstacle that is no part of the walls, somewhere.
  void SetPose2d(char* identifier, double x, double y, double a);
  void GetPose2d(char* identifier, double& x, double& y, double& a);
  /// The same: the world is flat, so z, roll and pitch do not matter.
  void SetPose3d(char* identifier, double x, double y, double z, double roll, double pitch,
                 double yaw);
  /// z, roll and pitch are 0. @param time  simulated [s].
  void GetPose3d(char* identifier, double& x, double& y, double& z, double& roll, double& pitch,
                 double& yaw, double& time);

  /// Copies a property; docs/simulation.md lists them, and the forms that each has.
  /// @param value      room for it.
  /// @param value_len  of that room [bytes]: it tells the form, e.g. 4 for a colour as 0xAARRGGBB.
  void GetProperty(char* identifier, char* name, void* value, size_t value_len);
  /// Changes a property; forms as for GetProperty().
  void SetProperty(char* identifier, char* name, void* value, size_t value_len);

  /// Saves the state of the whole simulation under a name, in place of the one that had it: for
  /// programs that try something and then something else. Player has no such call.
  /// @param name  1 to 64 printable bytes.
  void SaveState(const std::string& name);
  /// Lets the world go back to a saved state, at once and for all clients; time goes on. See
  /// docs/simulation.md for what that means.
  void RestoreState(const std::string& name);

  // The same for names that are literals.
  void SetPose2d(const char* identifier, double x, double y, double a) {
    SetPose2d(const_cast<char*>(identifier), x, y, a);
  }
  void GetPose2d(const char* identifier, double& x, double& y, double& a) {
    GetPose2d(const_cast<char*>(identifier), x, y, a);
  }
  void SetPose3d(const char* identifier, double x, double y, double z, double roll, double pitch,
                 double yaw) {
    SetPose3d(const_cast<char*>(identifier), x, y, z, roll, pitch, yaw);
  }
  void GetPose3d(const char* identifier, double& x, double& y, double& z, double& roll,
                 double& pitch, double& yaw, double& time) {
    GetPose3d(const_cast<char*>(identifier), x, y, z, roll, pitch, yaw, time);
  }
  // Templates, as either name may be a literal.
  template <typename Identifier, typename Name, typename Value>
  void GetProperty(Identifier identifier, Name name, Value* value, size_t value_len) {
    GetProperty(Text(identifier), Text(name), static_cast<void*>(value), value_len);
  }
  template <typename Identifier, typename Name, typename Value>
  void SetProperty(Identifier identifier, Name name, Value* value, size_t value_len) {
    SetProperty(Text(identifier), Text(name), const_cast<void*>(static_cast<const void*>(value)),
                value_len);
  }

 private:
  template <typename Action>
  void Try(const char* aFun, Action aAction);
  void Tell(const char* aFun, const std::string& aWhy);

  std::vector<std::string> mTold;  // under the client's mutex

  static char* Text(const char* aText) { return const_cast<char*>(aText); }
};

}  // namespace PlayerCc

namespace std {
/// Prints what every proxy prints.
std::ostream& operator<<(std::ostream& os, const PlayerCc::SimulationProxy& c);
}  // namespace std
