// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Access to robots and obstacles by name: their true poses and their properties.
///
/// All robots share one simulation device, with index 0 on every port. Names are those of the
/// world's robots, obstacles and dock separators, and "border" and "wall". Poses are in the world
/// frame W [m, rad]; the reference point is the centre of the axle for a robot, and the centre for
/// any other object.
///
/// A change takes effect before the call returns. A robot's motors continue with their last
/// command. No member advances simulated time.
///
/// A request that fails does not throw, as in Player, because programs use names of their own
/// worlds. It changes nothing, leaves output arguments unchanged, and prints a warning to standard
/// error. Reasons are: an unknown name or property (the warning lists the known ones), an obstacle
/// at a robot's new place, a value_len that does not fit, or a request that the world or the server
/// does not allow. Each proxy prints each warning once.
///
/// Errors: all members throw PlayerError kBadArgument for a null pointer or a number that is not
/// finite; kDisconnected if the client is gone.
class SimulationProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index other than 0, or on a port without robots.
  SimulationProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~SimulationProxy() override;

  /// Moves a robot, or an obstacle that is not part of the walls, to a pose.
  void SetPose2d(char* identifier, double x, double y, double a);
  void GetPose2d(char* identifier, double& x, double& y, double& a);
  /// Same as SetPose2d(). The world is flat, so z, roll and pitch are ignored.
  void SetPose3d(char* identifier, double x, double y, double z, double roll, double pitch,
                 double yaw);
  /// Same as GetPose2d(). z, roll and pitch are 0.
  /// @param time  simulated time [s].
  void GetPose3d(char* identifier, double& x, double& y, double& z, double& roll, double& pitch,
                 double& yaw, double& time);

  /// Copies a property; docs/simulation.md lists the properties and their formats.
  /// @param value      receives the property.
  /// @param value_len  size of value [bytes]; it selects the format, e.g. 4 for a colour as
  ///                   0xAARRGGBB.
  void GetProperty(char* identifier, char* name, void* value, size_t value_len);
  /// Changes a property; the formats are those of GetProperty().
  void SetProperty(char* identifier, char* name, void* value, size_t value_len);

  /// Saves the state of the whole simulation under a name; replaces an earlier state of this name.
  /// Use it in programs that try several alternatives. Extension to Player.
  /// @param name  1 to 64 printable bytes.
  void SaveState(const std::string& name);
  /// Restores a saved state immediately, for all clients. Simulated time is not reset.
  /// docs/simulation.md describes the details.
  void RestoreState(const std::string& name);

  // Overloads for names that are string literals.
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
  // Templates, because either name may be a string literal.
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

  std::vector<std::string> mTold;  // guarded by the client's mutex

  static char* Text(const char* aText) { return const_cast<char*>(aText); }
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags, like every proxy.
std::ostream& operator<<(std::ostream& os, const PlayerCc::SimulationProxy& c);
}  // namespace std
