// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Elements past the end of each proxy's lists read 0 with one warning and without an exception.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "playerlike/host/host.h"
#include "reachable_host.h"

namespace {

using namespace PlayerCc;
using test::Transport;
using testing::HasSubstr;

constexpr const char* kWorld = R"({
  "arena": {"size": [4, 4], "obstacles": [
    {"name": "b", "center": [3, 2], "size": [0.4, 0.4], "fiducial": 7, "colour": "#ff8000"}]},
  "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 2}, "devices": {
      "pose": {}, "motion": {}, "laser": {"beams": 181, "resolution_deg": 1},
      "sonar": {"mounts": [{"x": 0.1}, {"x": -0.1, "yaw_deg": 180}]},
      "infrared": {"mounts": [{"x": 0.1}]}, "bumper": {}, "wifi": {},
      "fiducial": {}, "blobfinder": {"height": 0.1},
      "dio": {"inputs": [true, true], "outputs": 4}, "aio": {"inputs": [5], "outputs": 2}}},
    {"name": "r2", "pose": {"x": 1, "y": 3}, "devices": {"wifi": {}}}]})";

/// Returns the standard error of an action that must not throw.
template <typename Action>
std::string warning_of(Action action) {
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(action());
  return testing::internal::GetCapturedStderr();
}

/// Expects that the action prints this warning the first time and nothing the second time.
template <typename Action>
void expect_one_warning(Action action, const std::string& text) {
  const std::string warning = warning_of(action);
  EXPECT_THAT(warning, HasSubstr(text));
  EXPECT_EQ(std::count(warning.begin(), warning.end(), '\n'), 1) << warning;
  EXPECT_EQ(warning_of(action), "");
}

struct PastTheEnd : testing::TestWithParam<Transport> {
  PastTheEnd()
      : host(playerlike::Host::create(sim::load_world_text(kWorld)), GetParam()),
        client(host.connect(6665)) {}

  test::ReachableHost host;
  PlayerClient client;
};

INSTANTIATE_TEST_SUITE_P(Transports, PastTheEnd,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(PastTheEnd, Rangefinders_ReadZero) {
  LaserProxy laser(&client);
  RangerProxy ranger(&client, 0);
  RangerProxy sonars(&client, 1);
  SonarProxy sonar(&client);
  IrProxy ir(&client);
  EXPECT_EQ(warning_of([&] {  // programs access elements before their first Read()
              EXPECT_EQ(laser[9] + ranger[9] + ir[9] + ir.GetVoltage(9), 0.0);
              EXPECT_EQ(sonar[9], -1.0);
            }),
            "");
  client.Read();
  expect_one_warning([&] { EXPECT_EQ(laser[181], 0.0); },
                     "LaserProxy::operator[]: there is no beam 181: the scan has 181, counted from "
                     "0; beams beyond the last read 0");
  expect_one_warning([&] { EXPECT_EQ(ranger.GetRange(181), 0.0); },
                     "RangerProxy::GetRange: there is no range 181: there are 181, counted from 0; "
                     "ranges beyond the last read 0");
  EXPECT_EQ(ranger.GetPoint(4000000000U).px, 0.0);
  EXPECT_EQ(ranger.GetElementPose(1).px, 0.0);
  EXPECT_EQ(ranger.GetElementSize(1).sl, 0.0);
  EXPECT_EQ(ranger.GetIntensity(0), 0.0);
  expect_one_warning([&] { EXPECT_EQ(sonars.GetElementPose(2).px, 0.0); }, "no element 2");
  RangerProxy dark(&client, 0);
  expect_one_warning([&] { EXPECT_EQ(dark.GetIntensity(3), 0.0); }, "measure ranges only");
  expect_one_warning([&] { EXPECT_EQ(sonar.GetScan(2), -1.0); },
                     "there is no transducer 2: there are 2, counted from 0; transducers beyond "
                     "the last read -1");
  EXPECT_EQ(sonar.GetPose(2).px, 0.0);
  expect_one_warning([&] { EXPECT_EQ(ir[1], 0.0); }, "IrProxy::GetRange: there is no transducer 1");
  EXPECT_EQ(ir.GetVoltage(8), 0.0);
  EXPECT_EQ(ir.GetPose(8).px, 0.0);
}

TEST_P(PastTheEnd, SeenObjects_Zero) {
  BumperProxy bumper(&client);
  FiducialProxy fiducials(&client);
  BlobfinderProxy blobs(&client);
  WiFiProxy wifi(&client);
  LocalizeProxy localize(&client);
  client.Read();
  ASSERT_EQ(bumper.GetCount(), 8U);  // one per side of the octagon
  expect_one_warning([&] { EXPECT_FALSE(bumper[8]); }, "there is no segment 8: there are 8");
  EXPECT_EQ(bumper.GetPose(8).length, 0.0F);
  ASSERT_EQ(fiducials.GetCount(), 1U);
  expect_one_warning([&] { EXPECT_EQ(fiducials[1].id, 0); }, "there is no thing in view 1");
  ASSERT_EQ(blobs.GetCount(), 1U);
  expect_one_warning([&] { EXPECT_EQ(blobs[1].area, 0U); }, "there is no blob 1: there are 1");
  ASSERT_EQ(wifi.GetLinkCount(), 1);
  expect_one_warning([&] { EXPECT_STREQ(wifi.GetLinkIP(1), ""); }, "there is no link 1");
  EXPECT_STREQ(wifi.GetLinkESSID(-1), "");
  EXPECT_STREQ(wifi.GetLinkMAC(-1), "");
  EXPECT_EQ(wifi.GetLinkFreq(7) + wifi.GetLinkMode(7) + wifi.GetLinkEncrypt(7), 0.0);
  EXPECT_EQ(wifi.GetLinkQuality(7) + wifi.GetLinkLevel(7) + wifi.GetLinkNoise(7), 0);
  EXPECT_EQ(wifi.GetLink(7), nullptr);
  ASSERT_EQ(localize.GetHypothCount(), 1U);
  expect_one_warning([&] { EXPECT_EQ(localize.GetHypoth(localize.GetHypothCount()).alpha, 0.0); },
                     "there is no hypothesis 1: there are 1, counted from 0; hypotheses beyond");
  ASSERT_EQ(localize.GetParticles(), 0);
  EXPECT_EQ(localize.GetParticlePose(-1).px, 0.0);
  EXPECT_EQ(localize.GetParticlePose(1).px, 0.0);
}

TEST_P(PastTheEnd, MapOutside_Unknown) {
  MapProxy map(&client);
  map.RequestMap();
  expect_one_warning([&] { EXPECT_EQ(map.GetCell(-1, 0), 0); }, "there is no cell (-1, 0)");
}

TEST_P(PastTheEnd, Inputs_ReadZeroAndExistingOutputsAreSet) {
  DioProxy dio(&client);
  AioProxy aio(&client);
  client.Read();
  expect_one_warning([&] { EXPECT_EQ(dio[2], 0U); }, "there is no digital input 2: there are 2");
  expect_one_warning([&] { EXPECT_EQ(aio[1], 0.0); }, "there is no analog input 1: there are 1");
  DioProxy outputs(&client);
  expect_one_warning([&] { outputs.SetOutput(9, 0x1ff); },
                     "9 outputs are to be set, but there are 4; the others have no effect");
  AioProxy voltages(&client);
  expect_one_warning([&] { voltages.SetVoltage(2, 1.0); },
                     "there is no analog output 2: there are 2, counted from 0; setting it has no "
                     "effect");
  client.Read();  // a command that the device refuses would end the run
}

TEST_P(PastTheEnd, CopiesOfProxy_WarnOnce) {
  IrProxy ir(&client);
  client.Read();
  const auto look = [](IrProxy copy) { return copy[8]; };  // programs pass proxies by value
  expect_one_warning([&] { EXPECT_EQ(look(ir), 0.0); }, "there is no transducer 8");
}

}  // namespace
