// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Fiducial finder, satellite receiver, inertial unit and wireless card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"
#include "sim/devices/wifi.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = kPi / 180.0;

/// A room of 8 x 8 m.
WorldDescription room(const std::string& robots, const std::string& obstacles = "") {
  return load_world_text(R"({"arena": {"size": [8, 8], "obstacles": [)" + obstacles +
                         R"(]}, "robots": [)" + robots + "]}");
}

/// A robot with one device of a type, at (2, 4).
std::string bearer(const std::string& type, const std::string& settings, double yaw_deg = 0.0) {
  return R"({"name": "r1", "pose": {"x": 2, "y": 4, "yaw_deg": )" + fixed_text(yaw_deg, 6) +
         R"(}, "devices": {")" + type + "\": " + settings + "}}";
}

template <typename ReadingType>
const ReadingType& reading(const Simulation& simulation, const std::string& device) {
  const int index = simulation.find_device(0, device).value();
  return dynamic_cast<const ReadingType&>(
      dynamic_cast<const Sensor&>(simulation.device(0, index)).reading());
}

void drive(Simulation& simulation, double v, double omega) {
  const auto refusal = simulation.apply({0, simulation.find_device(0, "motion").value()},
                                        TwistCommand{{.v_mps = v, .omega_radps = omega}});
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

/// Compares mean and standard deviation of many numbers with their expected values, within four
/// standard errors: of a mean sigma / sqrt(n), of a deviation sigma / sqrt(2 n).
void expect_gaussian(const std::vector<double>& values, double mean, double sigma) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    sum += value - mean;
    squares += (value - mean) * (value - mean);
  }
  const auto n = static_cast<double>(values.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * sigma / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), sigma, 4.0 * sigma / std::sqrt(2.0 * n));
}

// --- fiducial

std::vector<int> ids(const Simulation& simulation) {
  std::vector<int> found;
  for (const auto& mark : reading<FiducialReading>(simulation, "fiducial").marks) {
    found.push_back(mark.id);
  }
  return found;
}

std::string block(double x, double y, const std::string& more) {
  return R"({"center": [)" + fixed_text(x, 6) + ", " + fixed_text(y, 6) +
         R"(], "size": [0.4, 0.4], )" + more + "}";
}

TEST(Fiducial, ReportsPositionsNearestFirst) {
  Simulation simulation(
      room(bearer("fiducial", R"({"pose": {"x": 0.1}})", 90.0) +
               R"(, {"name": "r2", "fiducial": 3, "pose": {"x": 2, "y": 7, "yaw_deg": 180}})",
           block(1.0, 5.1, R"("fiducial": 7, "yaw_deg": 135)")));
  run(simulation, 10);
  const auto& marks = reading<FiducialReading>(simulation, "fiducial").marks;
  ASSERT_THAT(ids(simulation), ElementsAre(7, 3));
  // The sensor is at (2, 4.1) and faces along y: the block is 1 m ahead and 1 m to the left.
  EXPECT_NEAR(marks[0].X_ST.x_m, 1.0, 1e-12);
  EXPECT_NEAR(marks[0].X_ST.y_m, 1.0, 1e-12);
  EXPECT_NEAR(marks[0].X_ST.yaw_rad, 45.0 * kDegrees, 1e-12);
  // The robot stands 2.9 m ahead and faces left.
  EXPECT_NEAR(marks[1].X_ST.x_m, 2.9, 1e-12);
  EXPECT_NEAR(marks[1].X_ST.y_m, 0.0, 1e-12);
  EXPECT_NEAR(marks[1].X_ST.yaw_rad, 90.0 * kDegrees, 1e-12);
}

TEST(Fiducial, RangeAndFieldOfView_Limit) {
  const std::string things = block(5, 4, R"("fiducial": 1)") + ", " +      // 3 m ahead
                             block(2, 6, R"("fiducial": 2)") + ", " +      // 2 m to the left
                             block(3.5, 2.5, R"("fiducial": 3)") + ", " +  // 45 degrees, 2.12 m
                             block(1, 4, R"("fiducial": 4)");              // behind
  const auto seen = [&](const std::string& settings) {
    Simulation simulation(room(bearer("fiducial", settings), things));
    run(simulation, 10);
    return ids(simulation);
  };
  EXPECT_THAT(seen("{}"), ElementsAre(2, 3, 1));
  EXPECT_THAT(seen(R"({"field_of_view_deg": 360})"), ElementsAre(4, 2, 3, 1));
  EXPECT_THAT(seen(R"({"field_of_view_deg": 89})"), ElementsAre(1));
  EXPECT_THAT(seen(R"({"range_max": 2.5})"), ElementsAre(2, 3));
  EXPECT_THAT(seen(R"({"range_max_id": 2.5})"), ElementsAre(2, 3, 0));
  EXPECT_THAT(seen(R"({"height": 0.16})"), ElementsAre(2, 3, 1));  // the height of their tops
  EXPECT_THAT(seen(R"({"height": 0.161})"), IsEmpty());
}

TEST(Fiducial, Solids_HideObjects) {
  const auto seen = [](const std::string& between) {
    Simulation simulation(
        room(bearer("fiducial", "{}"), block(5, 4, R"("fiducial": 1)") + ", " + between));
    run(simulation, 10);
    return ids(simulation);
  };
  EXPECT_THAT(seen(block(3.5, 4, R"("name": "wall")")), IsEmpty());
  EXPECT_THAT(seen(block(3.5, 4.21, R"("name": "beside")")), ElementsAre(1));
  EXPECT_THAT(seen(block(3.5, 4, R"("height": 0.099)")), ElementsAre(1));
  EXPECT_THAT(seen(block(3.5, 4, R"("type": "dynamic", "state": "retracted")")), ElementsAre(1));
  EXPECT_THAT(seen(block(3.5, 4, R"("type": "dynamic")")), IsEmpty());
  // A marked object hides others, too.
  EXPECT_THAT(seen(block(3.5, 4, R"("fiducial": 2)")), ElementsAre(2));
}

TEST(Fiducial, RetractedOrUnnumbered_NotSeen) {
  Simulation simulation(
      room(bearer("fiducial", "{}") + R"(, {"name": "r2", "pose": {"x": 3, "y": 3}})",
           block(5, 4, R"("fiducial": 5, "type": "dynamic", "name": "d")")));
  run(simulation, 10);
  EXPECT_THAT(ids(simulation), ElementsAre(5));
  ASSERT_FALSE(simulation.set_obstacle_state("d", ObstacleState::kRetracted));
  run(simulation, 10);
  EXPECT_THAT(ids(simulation), IsEmpty());
}

TEST(Fiducial, Noise_HasDeviation) {
  Simulation simulation(room(bearer("fiducial", R"({"frequency": 100, "noise": 0.05,
      "noise_bearing_deg": 2, "noise_yaw_deg": 3})"),
                             block(5, 4, R"("fiducial": 1)")));
  std::vector<double> distances;
  std::vector<double> bearings;
  std::vector<double> yaws;
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    const Pose X_ST = reading<FiducialReading>(simulation, "fiducial").marks.at(0).X_ST;
    distances.push_back(X_ST.position().norm());
    bearings.push_back(std::atan2(X_ST.y_m, X_ST.x_m));
    yaws.push_back(X_ST.yaw_rad);
  }
  expect_gaussian(distances, 3.0, 0.05);
  expect_gaussian(bearings, 0.0, 2.0 * kDegrees);
  expect_gaussian(yaws, 0.0, 3.0 * kDegrees);
}

// --- gps

TEST(Gps, RadiiOfCurvature_MatchTables) {
  // At 45 degrees M = 6 367 381.816 m and N = 6 388 838.290 m.
  const GeoPoint from{45.0 * kDegrees, 0.1};
  const GeoPoint to = shifted(from, 1000.0, 2000.0, 0.0);
  EXPECT_NEAR((to.latitude_rad - from.latitude_rad) * 6367381.816, 2000.0, 1e-5);
  EXPECT_NEAR((to.longitude_rad - from.longitude_rad) * 6388838.290 * std::sqrt(0.5), 1000.0, 1e-5);
  // 100 m higher, the same angle is longer by 100 m per radian.
  const GeoPoint high = shifted(from, 0.0, 2000.0, 100.0);
  EXPECT_NEAR((high.latitude_rad - from.latitude_rad) * 6367481.816, 2000.0, 1e-5);
  // Across the 180th meridian.
  EXPECT_LT(shifted({0.0, kPi - 1e-9}, 1000.0, 0.0, 0.0).longitude_rad, 0.0);
}

TEST(Gps, Projection_MatchesSnyderExample) {
  // P. 269: Clarke 1866, 40.5 N, 73.5 W, central meridian 75 W: x = 127 106.5, y = 4 484 124.4 m.
  const Vec2 p = transverse_mercator_m({40.5 * kDegrees, -73.5 * kDegrees}, -75.0 * kDegrees,
                                       0.9996, {6378206.4, 1.0 / 294.978698});
  EXPECT_NEAR(p.x(), 127106.5, 0.06);
  EXPECT_NEAR(p.y(), 4484124.4, 0.06);
}

TEST(Gps, UtmCoordinates_MatchKnownPlaces) {
  EXPECT_EQ(utm_zone(14.4178 * kDegrees), 33);
  EXPECT_EQ(utm_zone(-180.0 * kDegrees), 60);  // the same meridian as 180 degrees east
  EXPECT_EQ(utm_zone(-179.9 * kDegrees), 1);
  // The CN Tower: 43 38' 33.24" N, 79 23' 13.7" W is 17T 630084 4833438.
  const GeoPoint tower{(43.0 + 38.0 / 60.0 + 33.24 / 3600.0) * kDegrees,
                       -(79.0 + 23.0 / 60.0 + 13.7 / 3600.0) * kDegrees};
  ASSERT_EQ(utm_zone(tower.longitude_rad), 17);
  EXPECT_NEAR(utm_m(tower, 17).x(), 630084.0, 1.5);
  EXPECT_NEAR(utm_m(tower, 17).y(), 4833438.0, 1.5);
  // On the equator at the centre of a zone, and just south of it.
  EXPECT_NEAR(utm_m({0.0, 3.0 * kDegrees}, 31).x(), 500'000.0, 1e-6);
  EXPECT_NEAR(utm_m({0.0, 3.0 * kDegrees}, 31).y(), 0.0, 1e-6);
  EXPECT_NEAR(utm_m({-1e-12, 3.0 * kDegrees}, 31).y(), 1e7, 1e-4);
}

TEST(Gps, NoNoise_True) {
  // North along y: the robot is 2 m east and 4 m north of the origin.
  Simulation simulation(room(bearer("gps", "{}")));
  drive(simulation, 0.5, 0.0);
  run(simulation, 10);
  const auto& gps = reading<GpsReading>(simulation, "gps");
  const GpsParams params;
  const double x = simulation.body(0).X_WB.x_m;
  const GeoPoint place = shifted({params.latitude_rad, params.longitude_rad}, x, 4.0, 200.0);
  EXPECT_DOUBLE_EQ(gps.latitude_rad, place.latitude_rad);
  EXPECT_DOUBLE_EQ(gps.longitude_rad, place.longitude_rad);
  EXPECT_EQ(gps.altitude_m, 200.0);
  EXPECT_NEAR(gps.speed_mps, 0.5, 1e-9);
  EXPECT_NEAR(gps.course_rad, 0.5 * kPi, 1e-12);  // due east
  EXPECT_EQ(gps.satellites, 8);
  EXPECT_EQ(gps.quality, 1);
  // A motion of one metre ahead changes the easting by a metre times the scale (1 +- 4e-4), except
  // for the angle between grid north and true north: 0.4 degrees at 0.6 degrees from the zone's
  // centre.
  const double easting = gps.utm_easting_m;
  run(simulation, 200);
  EXPECT_NEAR(reading<GpsReading>(simulation, "gps").utm_easting_m - easting, 1.0, 5e-4);
  drive(simulation, 0.0, 0.0);
  run(simulation, 20);
  EXPECT_EQ(reading<GpsReading>(simulation, "gps").course_rad, 0.0);
}

TEST(Gps, North_FromWorld) {
  // North is along x: the robot faces and drives north; the world's y axis points west.
  Simulation simulation(room(bearer("gps", R"({"north_deg": 0})")));
  drive(simulation, -0.5, 0.0);
  run(simulation, 10);
  const auto& gps = reading<GpsReading>(simulation, "gps");
  const GpsParams params;
  const GeoPoint place = shifted({params.latitude_rad, params.longitude_rad}, -4.0,
                                 simulation.body(0).X_WB.x_m, 200.0);
  EXPECT_NEAR(gps.latitude_rad, place.latitude_rad, 1e-15);
  EXPECT_NEAR(gps.longitude_rad, place.longitude_rad, 1e-15);
  EXPECT_NEAR(gps.course_rad, kPi, 1e-12);  // backwards, so south
}

TEST(Gps, FewerThanFourSatellites_NoFix) {
  Simulation simulation(room(bearer("gps", R"({"satellites": 3})")));
  run(simulation, 10);
  const auto& gps = reading<GpsReading>(simulation, "gps");
  EXPECT_EQ(gps.satellites, 3);
  EXPECT_EQ(gps.quality, 0);
  EXPECT_EQ(gps.latitude_rad, 0.0);
}

TEST(Gps, Noise_HasDeviation) {
  Simulation simulation(
      room(bearer("gps", R"({"frequency": 100, "noise": 2, "noise_vertical": 3})")));
  std::vector<double> north;
  std::vector<double> east;
  std::vector<double> up;
  const GpsParams params;
  const GeoPoint origin{params.latitude_rad, params.longitude_rad};
  const GeoPoint metre = shifted(origin, 1.0, 1.0, 200.0);
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    const auto& gps = reading<GpsReading>(simulation, "gps");
    north.push_back((gps.latitude_rad - origin.latitude_rad) /
                    (metre.latitude_rad - origin.latitude_rad));
    east.push_back((gps.longitude_rad - origin.longitude_rad) /
                   (metre.longitude_rad - origin.longitude_rad));
    up.push_back(gps.altitude_m);
  }
  expect_gaussian(north, 4.0, 2.0);
  expect_gaussian(east, 2.0, 2.0);
  expect_gaussian(up, 200.0, 3.0);
}

// --- imu

TEST(Imu, AtRest_GravityAndEarthField) {
  Simulation simulation(room(bearer("imu", "{}", 30.0)));
  run(simulation, 10);
  const auto& imu = reading<ImuReading>(simulation, "imu");
  EXPECT_THAT(imu.acceleration_mps2, ElementsAre(0.0, 0.0, 9.80665));
  EXPECT_THAT(imu.rate_radps, ElementsAre(0.0, 0.0, 0.0));
  // North is 60 degrees to the left.
  EXPECT_NEAR(imu.field_ut[0], 10.0, 1e-12);
  EXPECT_NEAR(imu.field_ut[1], 20.0 * std::sqrt(0.75), 1e-12);
  EXPECT_EQ(imu.field_ut[2], -45.0);
  EXPECT_NEAR(imu.yaw_rad, 30.0 * kDegrees, 1e-12);
}

TEST(Imu, Circle_CentripetalAcceleration) {
  Simulation simulation(room(bearer("imu", "{}")));
  drive(simulation, 0.3, 0.6);
  run(simulation, 50);
  const auto& imu = reading<ImuReading>(simulation, "imu");
  EXPECT_NEAR(imu.acceleration_mps2[0], 0.0, 1e-9);
  EXPECT_NEAR(imu.acceleration_mps2[1], 0.18, 1e-9);  // v omega
  EXPECT_NEAR(imu.rate_radps[2], 0.6, 1e-9);
  EXPECT_NEAR(imu.yaw_rad, simulation.body(0).X_WB.yaw_rad, 1e-9);
  EXPECT_NEAR(imu.yaw_rad, 0.3, 1e-9);
}

TEST(Imu, Accelerations_SumToSpeed) {
  const std::string slow = R"({"name": "r1", "pose": {"x": 2, "y": 4},
      "devices": {"imu": {}, "motion": {"max_acceleration": 0.5}}})";
  Simulation simulation(room(slow));
  drive(simulation, 0.3, 0.0);
  double speed = 0.0;
  for (int i = 0; i < 10; ++i) {
    run(simulation, 10);
    const double a = reading<ImuReading>(simulation, "imu").acceleration_mps2[0];
    // 0.6 s to 0.3 m/s
    if (i < 5) {
      EXPECT_NEAR(a, 0.5, 1e-6) << i;
    }
    speed += 0.1 * a;
  }
  EXPECT_NEAR(speed, 0.3, 1e-9);
}

TEST(Imu, BiasAndNoise_Added) {
  Simulation simulation(room(bearer("imu", R"({"frequency": 100, "noise_acceleration": 0.2,
      "noise_rate_deg": 1, "noise_field": 0.5, "bias_acceleration": 1, "bias_rate_deg": 5})")));
  std::vector<double> a;
  std::vector<double> w;
  std::vector<double> b;
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    const auto& imu = reading<ImuReading>(simulation, "imu");
    a.push_back(imu.acceleration_mps2[0]);
    w.push_back(imu.rate_radps[2]);
    b.push_back(imu.field_ut[2]);
  }
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  };
  // The biases are present, and the noise is centred on them.
  EXPECT_GT(std::abs(mean(a)), 0.02);
  EXPECT_LT(std::abs(mean(a)), 4.0);
  EXPECT_GT(std::abs(mean(w)), 0.1 * kDegrees);
  EXPECT_LT(std::abs(mean(w)), 20.0 * kDegrees);
  expect_gaussian(a, mean(a), 0.2);
  expect_gaussian(w, mean(w), 1.0 * kDegrees);
  expect_gaussian(b, -45.0, 0.5);
}

TEST(Imu, Heading_Settable) {
  Simulation simulation(room(bearer("imu", "{}")));
  drive(simulation, 0.0, 0.5);
  run(simulation, 15);  // 5 steps after its reading
  const Simulation::DeviceId imu_id{0, simulation.find_device(0, "imu").value()};
  ASSERT_FALSE(simulation.apply(imu_id, SetPoseCommand{{7.0, 8.0, 1.0}}));
  run(simulation, 5);
  const auto& imu = reading<ImuReading>(simulation, "imu");
  EXPECT_NEAR(imu.yaw_rad, 1.0 + 0.05 * 0.5, 1e-9);
  EXPECT_NEAR(imu.rate_radps[2], 0.5, 1e-9);
  run(simulation, 10);
  EXPECT_NEAR(imu.yaw_rad, 1.0 + 0.15 * 0.5, 1e-9);
  EXPECT_TRUE(simulation.apply(imu_id, TwistCommand{}).has_value());
}

TEST(Imu, Placement_NotFelt) {
  Simulation simulation(room(R"({"name": "r1", "pose": {"x": 2, "y": 4},
      "devices": {"imu": {}, "teleport": {}}})"));
  run(simulation, 10);
  ASSERT_FALSE(simulation.apply({0, simulation.find_device(0, "teleport").value()},
                                PlaceCommand{{6.0, 6.0, 2.0}}));
  run(simulation, 10);
  const auto& imu = reading<ImuReading>(simulation, "imu");
  EXPECT_THAT(imu.acceleration_mps2, ElementsAre(0.0, 0.0, 9.80665));
  EXPECT_EQ(imu.rate_radps[2], 0.0);
}

// --- wifi

TEST(Wifi, Level_FollowsPathLossModel) {
  const WifiParams params;  // -40 dBm at 1 m, exponent 3
  EXPECT_DOUBLE_EQ(level_at_dbm(params, 1.0), -40.0);
  EXPECT_DOUBLE_EQ(level_at_dbm(params, 10.0), -70.0);
  EXPECT_DOUBLE_EQ(level_at_dbm(params, 0.0), -10.0);  // as at 0.1 m
  EXPECT_EQ(link_quality(-40.0), 100);
  EXPECT_EQ(link_quality(-70.0), 60);
  EXPECT_EQ(link_quality(-120.0), 0);
}

TEST(Wifi, Addresses_FromNamesAndPlaces) {
  // FNV-1a of "" is cbf29ce484222325, of "a" af63dc4c8601ec8c; the lowest byte comes first.
  EXPECT_EQ(mac_of(""), "02:25:23:22:84:e4");
  EXPECT_EQ(mac_of("a"), "02:8c:ec:01:86:4c");
  EXPECT_EQ(ip_of(false, 0), "10.0.0.1");
  EXPECT_EQ(ip_of(false, 250), "10.0.1.1");
  EXPECT_EQ(ip_of(true, 3), "10.1.0.4");
}

TEST(Wifi, CardsAndAccessPointsInReach_Heard) {
  const auto card = [](const char* name, double x, const char* devices) {
    return std::string(R"({"name": ")") + name + R"(", "pose": {"x": )" + fixed_text(x, 6) +
           R"(, "y": 4}, "devices": )" + devices + "}";
  };
  Simulation simulation(room(card("r1", 2, R"({"wifi": {"least": -60, "access_points": [
      {"name": "hall", "x": 2, "y": 5}, {"name": "far", "x": 60, "y": 4}]}})") +
                             ", " + card("deaf", 3, "{}") + ", " +
                             card("r3", 4, R"({"wifi": {}})")));
  run(simulation, 10);
  const auto& wifi = reading<WifiReading>(simulation, "wifi");
  EXPECT_EQ(wifi.own_ip, "10.0.0.1");
  ASSERT_EQ(wifi.links.size(), 2U);
  EXPECT_EQ(wifi.links[0].name, "r3");
  EXPECT_EQ(wifi.links[0].ip, "10.0.0.3");
  EXPECT_EQ(wifi.links[0].mac, mac_of("r3"));
  EXPECT_FALSE(wifi.links[0].access_point);
  EXPECT_NEAR(wifi.links[0].level_dbm, -40.0 - 30.0 * std::log10(2.0), 1e-12);
  EXPECT_EQ(wifi.links[1].name, "hall");
  EXPECT_TRUE(wifi.links[1].access_point);
  EXPECT_NEAR(wifi.links[1].level_dbm, -40.0, 1e-12);
}

TEST(Wifi, Noise_HasDeviation) {
  Simulation simulation(room(bearer("wifi", R"({"frequency": 100, "noise": 4,
      "access_points": [{"name": "hall", "x": 3, "y": 4}]})")));
  std::vector<double> levels;
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    levels.push_back(reading<WifiReading>(simulation, "wifi").links.at(0).level_dbm);
  }
  expect_gaussian(levels, -40.0, 4.0);
}

// --- numbers of objects, and settings

TEST(FiducialNumbers, WholeAndNotNegative) {
  for (const char* bad : {"-1", "1.5", "2147483648", "\"a\""}) {
    EXPECT_THROW(static_cast<void>(
                     room(bearer("gps", "{}"), block(5, 4, std::string(R"("fiducial": )") + bad))),
                 ConfigError)
        << bad;
    EXPECT_THROW(static_cast<void>(room(std::string(R"({"fiducial": )") + bad + "}")), ConfigError)
        << bad;
  }
}

TEST(Interfaces, NamesOfRobotDevices_Read) {
  const auto world = [](const std::string& interfaces) {
    return room(R"({"devices": {"sonar": {}, "rear": {"type": "sonar"}}, "interfaces": )" +
                interfaces + "}");
  };
  const WorldDescription good = world(R"({"ranger": ["rear", "laser"], "sonar": []})");
  EXPECT_THAT(good.robots[0].interfaces.at("ranger"), ElementsAre("rear", "laser"));
  EXPECT_THAT(good.robots[0].interfaces.at("sonar"), IsEmpty());
  const auto issue_of = [&](const std::string& interfaces) {
    try {
      static_cast<void>(world(interfaces));
    } catch (const ConfigError& error) {
      return error.issues().at(0).id + " " + error.issues().at(0).pointer;
    }
    return std::string("none");
  };
  EXPECT_EQ(issue_of(R"({"ranger": ["front"]})"),
            "world/unknown-device /robots/0/interfaces/ranger/0");
  EXPECT_EQ(issue_of(R"({"ranger": ["rear", 3]})"),
            "world/unknown-device /robots/0/interfaces/ranger/1");
  EXPECT_EQ(issue_of(R"({"ranger": ["rear", "rear"]})"),
            "world/duplicate-name /robots/0/interfaces/ranger/1");
  EXPECT_EQ(issue_of(R"({"ranger": "rear"})"), "world/wrong-type /robots/0/interfaces/ranger");
  EXPECT_EQ(issue_of("[]"), "world/wrong-type /robots/0/interfaces");
}

}  // namespace
}  // namespace sim
