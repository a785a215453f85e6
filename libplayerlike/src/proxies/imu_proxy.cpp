// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/imuproxy.h"
#include "proxies/link.h"
#include "session/player_values/imu.h"
#include "sim/devices/compass.h"
#include "sim/devices/imu.h"
#include "sim/devices/space_sensors.h"

namespace PlayerCc {

using sim::ImuReading;

ImuProxy::ImuProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_IMU_CODE, aIndex, "ImuProxy::ImuProxy");
}

ImuProxy::~ImuProxy() { ClientProxy::Unsubscribe(); }

player_pose3d_t ImuProxy::GetPose() const {
  // The device is a compass, an IMU, a gyroscope or an accelerometer; the readings of the other
  // types count as 0.
  const double yaw_rad = Look(&sim::CompassReading::heading_rad) + Look(&sim::ImuReading::yaw_rad) +
                         Look(&sim::GyroscopeReading::yaw_rad);
  return {0.0,
          0.0,
          0.0,
          Look(&sim::GyroscopeReading::roll_rad),
          Look(&sim::GyroscopeReading::pitch_rad),
          yaw_rad};
}
float ImuProxy::GetXAccel() { return GetRawValues().accel_x; }
float ImuProxy::GetYAccel() { return GetRawValues().accel_y; }
float ImuProxy::GetZAccel() { return GetRawValues().accel_z; }
float ImuProxy::GetXGyro() { return GetRawValues().gyro_x; }
float ImuProxy::GetYGyro() { return GetRawValues().gyro_y; }
float ImuProxy::GetZGyro() { return GetRawValues().gyro_z; }
float ImuProxy::GetXMagn() { return GetRawValues().magn_x; }
float ImuProxy::GetYMagn() { return GetRawValues().magn_y; }
float ImuProxy::GetZMagn() { return GetRawValues().magn_z; }
player_imu_data_calib_t ImuProxy::GetRawValues() const {
  auto values = Look<ImuReading>(
      [](const ImuReading& r) { return playerlike::to_players<player_imu_data_calib_t>(r); });
  const auto acceleration = Look(&sim::AccelerometerReading::acceleration_mps2);
  values.accel_x += static_cast<float>(acceleration[0]);
  values.accel_y += static_cast<float>(acceleration[1]);
  values.accel_z += static_cast<float>(acceleration[2]);
  return values;
}

void ImuProxy::SetDatatype(int aDatatype) {
  const char* fun = "ImuProxy::SetDatatype";
  const scoped_lock_t lock(LockData(fun));
  if (aDatatype < PLAYER_IMU_DATA_STATE || aDatatype > PLAYER_IMU_DATA_FULLSTATE) {
    playerlike::refuse(fun, "there is no type of data " + std::to_string(aDatatype) +
                                "; they are PLAYER_IMU_DATA_STATE (1) to _FULLSTATE (5)");
  }
}

void ImuProxy::ResetOrientation(int aValue) {
  static_cast<void>(aValue);
  ResetEuler(0.0F, 0.0F, 0.0F);
}

void ImuProxy::ResetEuler(float aRoll, float aPitch, float aYaw) {
  const char* fun = "ImuProxy::ResetEuler";
  playerlike::require_finite(fun, {{"the roll angle", static_cast<double>(aRoll)},
                                   {"the pitch angle", static_cast<double>(aPitch)},
                                   {"the yaw angle", static_cast<double>(aYaw)}});
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  mLink->send(fun,
              sim::SetPoseCommand{{0.0, 0.0, sim::normalize_angle(static_cast<double>(aYaw))}});
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::ImuProxy& c) {
  const player_imu_data_calib_t v = c.GetRawValues();
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#acceleration [m/s^2]\tturning rate [rad/s]\tmagnetic field [uT]\tyaw [rad]\n"
            << v.accel_x << '\t' << v.accel_y << '\t' << v.accel_z << '\t' << v.gyro_x << '\t'
            << v.gyro_y << '\t' << v.gyro_z << '\t' << v.magn_x << '\t' << v.magn_y << '\t'
            << v.magn_z << '\t' << c.GetPose().pyaw << '\n';
}

}  // namespace std
