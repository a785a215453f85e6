// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Every member of the classes that exist so far, with its exact type, as Player has them. It only
// has to compile; the standard and the compiler are those of client programs.
#include <type_traits>

#include "libplayerc++/playerc++.h"

namespace {

using namespace PlayerCc;

// Has a value if Class::member can be named with exactly this type.
template <typename Type, Type kMember>
struct member {
  static constexpr bool exists = true;
};

// PlayerError
static_assert(member<std::string (PlayerError::*)() const, &PlayerError::GetErrorStr>::exists, "");
static_assert(member<std::string (PlayerError::*)() const, &PlayerError::GetErrorFun>::exists, "");
static_assert(member<int (PlayerError::*)() const, &PlayerError::GetErrorCode>::exists, "");

// PlayerClient
static_assert(member<bool (PlayerClient::*)(), &PlayerClient::Connected>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::StartThread>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::StopThread>::exists, "");
static_assert(member<void (PlayerClient::*)(uint32_t), &PlayerClient::Run>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::Stop>::exists, "");
static_assert(member<bool (PlayerClient::*)(uint32_t), &PlayerClient::Peek>::exists, "");
static_assert(member<void (PlayerClient::*)(uint32_t), &PlayerClient::SetRequestTimeout>::exists,
              "");
static_assert(member<void (PlayerClient::*)(int), &PlayerClient::SetRetryLimit>::exists, "");
static_assert(member<int (PlayerClient::*)(), &PlayerClient::GetRetryLimit>::exists, "");
static_assert(member<void (PlayerClient::*)(double), &PlayerClient::SetRetryTime>::exists, "");
static_assert(member<double (PlayerClient::*)(), &PlayerClient::GetRetryTime>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::Read>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::ReadIfWaiting>::exists, "");
static_assert(member<void (PlayerClient::*)(uint32_t), &PlayerClient::SetDataMode>::exists, "");
static_assert(
    member<void (PlayerClient::*)(bool, int, int, int), &PlayerClient::SetReplaceRule>::exists, "");
static_assert(member<void (PlayerClient::*)(), &PlayerClient::RequestDeviceList>::exists, "");
static_assert(member<std::list<playerc_device_info_t> (PlayerClient::*)(),
                     &PlayerClient::GetDeviceList>::exists,
              "");
static_assert(member<std::string (PlayerClient::*)() const, &PlayerClient::GetHostname>::exists,
              "");
static_assert(member<uint32_t (PlayerClient::*)() const, &PlayerClient::GetPort>::exists, "");
static_assert(member<int (PlayerClient::*)(std::string) const, &PlayerClient::LookupCode>::exists,
              "");
static_assert(member<std::string (PlayerClient::*)(int) const, &PlayerClient::LookupName>::exists,
              "");
static_assert(member<uint32_t (PlayerClient::*)(), &PlayerClient::GetOverflowCount>::exists, "");

// ClientProxy
static_assert(member<bool (ClientProxy::*)() const, &ClientProxy::IsValid>::exists, "");
static_assert(member<bool (ClientProxy::*)() const, &ClientProxy::IsFresh>::exists, "");
static_assert(member<void (ClientProxy::*)(), &ClientProxy::NotFresh>::exists, "");
static_assert(member<std::string (ClientProxy::*)() const, &ClientProxy::GetDriverName>::exists,
              "");
static_assert(member<double (ClientProxy::*)() const, &ClientProxy::GetDataTime>::exists, "");
static_assert(member<double (ClientProxy::*)() const, &ClientProxy::GetElapsedTime>::exists, "");
static_assert(member<PlayerClient* (ClientProxy::*)() const, &ClientProxy::GetPlayerClient>::exists,
              "");
static_assert(member<uint32_t (ClientProxy::*)() const, &ClientProxy::GetIndex>::exists, "");
static_assert(member<uint32_t (ClientProxy::*)() const, &ClientProxy::GetInterface>::exists, "");
static_assert(member<std::string (ClientProxy::*)() const, &ClientProxy::GetInterfaceStr>::exists,
              "");
static_assert(member<void (ClientProxy::*)(bool, int, int), &ClientProxy::SetReplaceRule>::exists,
              "");
static_assert(member<int (ClientProxy::*)(uint32_t, uint32_t), &ClientProxy::HasCapability>::exists,
              "");
static_assert(member<int (ClientProxy::*)(char*, bool*), &ClientProxy::GetBoolProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, bool), &ClientProxy::SetBoolProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, int32_t*), &ClientProxy::GetIntProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, int32_t), &ClientProxy::SetIntProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, double*), &ClientProxy::GetDblProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, double), &ClientProxy::SetDblProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, char**), &ClientProxy::GetStrProp>::exists, "");
static_assert(member<int (ClientProxy::*)(char*, char*), &ClientProxy::SetStrProp>::exists, "");
static_assert(member<void (ClientProxy::*)(ClientProxy::connection_t),
                     &ClientProxy::DisconnectReadSignal>::exists,
              "");

// LaserProxy
static_assert(member<uint32_t (LaserProxy::*)() const, &LaserProxy::GetCount>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetMaxRange>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetScanRes>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetRangeRes>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetScanningFrequency>::exists,
              "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetMinAngle>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetMaxAngle>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetConfMinAngle>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetConfMaxAngle>::exists, "");
static_assert(member<bool (LaserProxy::*)() const, &LaserProxy::IntensityOn>::exists, "");
static_assert(
    member<player_point_2d_t (LaserProxy::*)(uint32_t) const, &LaserProxy::GetPoint>::exists, "");
static_assert(member<double (LaserProxy::*)(uint32_t) const, &LaserProxy::GetRange>::exists, "");
static_assert(member<double (LaserProxy::*)(uint32_t) const, &LaserProxy::GetBearing>::exists, "");
static_assert(member<int (LaserProxy::*)(uint32_t) const, &LaserProxy::GetIntensity>::exists, "");
static_assert(member<int (LaserProxy::*)() const, &LaserProxy::GetID>::exists, "");
static_assert(member<void (LaserProxy::*)(double, double, uint32_t, uint32_t, bool, double),
                     &LaserProxy::Configure>::exists,
              "");
static_assert(member<void (LaserProxy::*)(), &LaserProxy::RequestConfigure>::exists, "");
static_assert(member<void (LaserProxy::*)(), &LaserProxy::RequestID>::exists, "");
static_assert(member<void (LaserProxy::*)(), &LaserProxy::RequestGeom>::exists, "");
static_assert(member<player_pose3d_t (LaserProxy::*)(), &LaserProxy::GetPose>::exists, "");
static_assert(member<player_pose3d_t (LaserProxy::*)(), &LaserProxy::GetRobotPose>::exists, "");
static_assert(member<player_bbox3d_t (LaserProxy::*)(), &LaserProxy::GetSize>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetMinLeft>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::GetMinRight>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::MinLeft>::exists, "");
static_assert(member<double (LaserProxy::*)() const, &LaserProxy::MinRight>::exists, "");

// MapProxy
static_assert(member<void (MapProxy::*)(), &MapProxy::RequestMap>::exists, "");
static_assert(member<int (MapProxy::*)(int, int) const, &MapProxy::GetCellIndex>::exists, "");
static_assert(member<int8_t (MapProxy::*)(int, int) const, &MapProxy::GetCell>::exists, "");
static_assert(member<double (MapProxy::*)() const, &MapProxy::GetResolution>::exists, "");
static_assert(member<uint32_t (MapProxy::*)() const, &MapProxy::GetWidth>::exists, "");
static_assert(member<uint32_t (MapProxy::*)() const, &MapProxy::GetHeight>::exists, "");
static_assert(member<double (MapProxy::*)() const, &MapProxy::GetOriginX>::exists, "");
static_assert(member<double (MapProxy::*)() const, &MapProxy::GetOriginY>::exists, "");
static_assert(member<int8_t (MapProxy::*)() const, &MapProxy::GetDataRange>::exists, "");
static_assert(member<void (MapProxy::*)(int8_t*) const, &MapProxy::GetMap>::exists, "");
static_assert(std::is_constructible<MapProxy, PlayerClient*>::value, "");
static_assert(std::is_constructible<MapProxy, PlayerClient*, uint32_t>::value, "");

// Position2dProxy
static_assert(
    member<void (Position2dProxy::*)(double, double, double), &Position2dProxy::SetSpeed>::exists,
    "");
static_assert(member<void (Position2dProxy::*)(double, double), &Position2dProxy::SetSpeed>::exists,
              "");
static_assert(
    member<void (Position2dProxy::*)(player_pose2d_t), &Position2dProxy::SetSpeed>::exists, "");
static_assert(
    member<void (Position2dProxy::*)(double, double, double), &Position2dProxy::SetVelHead>::exists,
    "");
static_assert(
    member<void (Position2dProxy::*)(double, double), &Position2dProxy::SetVelHead>::exists, "");
static_assert(member<void (Position2dProxy::*)(player_pose2d_t, player_pose2d_t),
                     &Position2dProxy::GoTo>::exists,
              "");
static_assert(member<void (Position2dProxy::*)(player_pose2d_t), &Position2dProxy::GoTo>::exists,
              "");
static_assert(
    member<void (Position2dProxy::*)(double, double, double), &Position2dProxy::GoTo>::exists, "");
static_assert(
    member<void (Position2dProxy::*)(double, double), &Position2dProxy::SetCarlike>::exists, "");
static_assert(member<void (Position2dProxy::*)(), &Position2dProxy::RequestGeom>::exists, "");
static_assert(member<player_pose3d_t (Position2dProxy::*)(), &Position2dProxy::GetOffset>::exists,
              "");
static_assert(member<player_bbox3d_t (Position2dProxy::*)(), &Position2dProxy::GetSize>::exists,
              "");
static_assert(member<void (Position2dProxy::*)(bool), &Position2dProxy::SetMotorEnable>::exists,
              "");
static_assert(member<void (Position2dProxy::*)(), &Position2dProxy::ResetOdometry>::exists, "");
static_assert(member<void (Position2dProxy::*)(double, double, double),
                     &Position2dProxy::SetOdometry>::exists,
              "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetXPos>::exists, "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetYPos>::exists, "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetYaw>::exists, "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetXSpeed>::exists, "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetYSpeed>::exists, "");
static_assert(member<double (Position2dProxy::*)() const, &Position2dProxy::GetYawSpeed>::exists,
              "");
static_assert(member<bool (Position2dProxy::*)() const, &Position2dProxy::GetStall>::exists, "");

static_assert(member < double(LaserProxy::*)(uint32_t) const, &LaserProxy::operator[]> ::exists,
              "");
static_assert(
    member<void (PlayerClient::*)(int, int, int, int, int), &PlayerClient::SetReplaceRule>::exists,
    "");
static_assert(std::is_constructible<PlayerClient>::value, "");
static_assert(std::is_constructible<PlayerClient, const char*, int>::value, "");
static_assert(std::is_constructible<PlayerClient, std::string, uint32_t, int>::value, "");
static_assert(std::is_constructible<LaserProxy, PlayerClient*>::value, "");
static_assert(std::is_constructible<LaserProxy, PlayerClient*, int>::value, "");
static_assert(std::is_constructible<Position2dProxy, PlayerClient*, uint32_t>::value, "");
static_assert(std::is_base_of<ClientProxy, LaserProxy>::value, "");
static_assert(std::is_base_of<ClientProxy, Position2dProxy>::value, "");
static_assert(std::is_copy_constructible<LaserProxy>::value, "");
static_assert(std::is_copy_constructible<Position2dProxy>::value, "");
static_assert(std::is_copy_constructible<PlayerClient>::value, "");

// Graphics2dProxy
static_assert(std::is_constructible<Graphics2dProxy, PlayerClient*, uint32_t>::value, "");
static_assert(member<void (Graphics2dProxy::*)(player_color_t), &Graphics2dProxy::Color>::exists,
              "");
static_assert(member<void (Graphics2dProxy::*)(uint8_t, uint8_t, uint8_t, uint8_t),
                     &Graphics2dProxy::Color>::exists,
              "");
static_assert(member<void (Graphics2dProxy::*)(), &Graphics2dProxy::Clear>::exists, "");
static_assert(member<void (Graphics2dProxy::*)(player_point_2d_t[], int),
                     &Graphics2dProxy::DrawPoints>::exists,
              "");
static_assert(member<void (Graphics2dProxy::*)(player_point_2d_t[], int, bool, player_color_t),
                     &Graphics2dProxy::DrawPolygon>::exists,
              "");
static_assert(member<void (Graphics2dProxy::*)(player_point_2d_t[], int),
                     &Graphics2dProxy::DrawPolyline>::exists,
              "");
static_assert(member<void (Graphics2dProxy::*)(player_point_2d_t[], int),
                     &Graphics2dProxy::DrawMultiline>::exists,
              "");

}  // namespace
