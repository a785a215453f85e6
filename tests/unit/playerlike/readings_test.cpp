// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings are shared: a reading never changes, all clients get the same object, and any thread may
// read it.
#include <gtest/gtest.h>
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "fake_session.h"
#include "playerlike/host/host.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"

namespace playerlike {
namespace {

using PlayerCc::LaserProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using test::FakeSession;
using test::FakeWorld;

struct Keeper : ReadingSink {
  void on_reading(DeviceId /*device*/, const sim::SharedReading& reading) override {
    readings.push_back(reading);
  }
  std::vector<sim::SharedReading> readings;
};

sim::WorldDescription room() {
  return sim::load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}}]})");
}

DeviceId device_of(const Session& session, const char* name) {
  for (const DeviceInfo& device : session.robots().front().devices) {
    if (device.name == name) return device.id;
  }
  throw std::runtime_error("no such device");
}

std::vector<sim::SharedReading> next(Session& session) {
  session.wait();
  Keeper keeper;
  static_cast<void>(session.take(keeper));
  return keeper.readings;
}

TEST(SharedReading, ConstantAndSharedByAll) {
  const auto host = Host::create(room());
  const auto one = host->connect(6665);
  const auto other = host->connect(6665);
  const DeviceId laser = device_of(*one, "laser");
  one->request(SubscribeRequest{laser});
  other->request(SubscribeRequest{laser});
  one->send(device_of(*one, "motion"), sim::TwistCommand{{.v_mps = 0.4}});

  const auto first = next(*one);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(next(*other), first);  // the same object

  const auto& scan = dynamic_cast<const sim::LaserReading&>(*first[0]);
  const std::vector<double> ranges = scan.ranges_m;
  const auto second = next(*one);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NE(second[0], first[0]);
  EXPECT_EQ(scan.sequence, 1U);
  EXPECT_EQ(scan.ranges_m, ranges);
  EXPECT_NE(dynamic_cast<const sim::LaserReading&>(*second[0]).ranges_m, ranges);  // it drives
}

// A program that reads repeatedly needs two objects: the current one, and the next.
TEST(SharedReading, UnusedObjects_Reused) {
  const auto host = Host::create(room());
  const auto session = host->connect(6665);
  session->request(SubscribeRequest{device_of(*session, "laser")});
  std::vector<const sim::Reading*> seen;
  std::vector<sim::SharedReading> held;
  for (int i = 0; i < 10; ++i) {
    held = next(*session);
    ASSERT_EQ(held.size(), 1U);
    EXPECT_EQ(held[0]->sequence, static_cast<std::uint64_t>(i + 1));
    seen.push_back(held[0].get());
  }
  for (std::size_t i = 4; i < seen.size(); ++i) EXPECT_EQ(seen[i], seen[i - 2]) << i;
}

TEST(SharedReading, QueuedReadings_Distinct) {
  const auto host = Host::create(room());
  const auto session = host->connect(6665);
  session->request(ReplaceRequest{std::nullopt, false});
  session->request(SubscribeRequest{device_of(*session, "pose")});
  session->request(SleepRequest{1.0});
  const auto readings = next(*session);
  ASSERT_EQ(readings.size(), 10U);
  for (std::size_t i = 0; i < readings.size(); ++i) EXPECT_EQ(readings[i]->sequence, i + 1);
}

// A reading belongs to the step that made it, whatever happens before it is taken.
TEST(SharedReading, ResetBeforeTake_ReadingKept) {
  const auto host = Host::create(room());
  const auto session = host->connect(6665);
  session->request(SubscribeRequest{device_of(*session, "pose")});
  session->wait();
  session->request(ResetRequest{});
  Keeper keeper;
  ASSERT_EQ(session->take(keeper), 1);
  EXPECT_EQ(keeper.readings[0]->sequence, 1U);
  EXPECT_EQ(keeper.readings[0]->time_ns, sim::from_seconds(0.1));
}

// One handle for all threads, with the mutex, and one for the holder, without.
TEST(SharedReading, Proxy_HoldsTwoHandles) {
  const auto world = test::make_fake_world();
  const std::shared_ptr<sim::Reading> scan = test::scan(1, {1, 2, 3, 4, 5});
  world->add_round({{test::kLaser, scan}});
  world->add_round({{test::kLaser, test::scan(2, {1, 2, 3, 4, 5})}});
  PlayerClient client(std::make_unique<FakeSession>(world));
  const LaserProxy laser(&client, 0);
  client.Read();
  EXPECT_EQ(scan.use_count(), 3);
  client.Read();
  EXPECT_EQ(scan.use_count(), 1);
}

// --- Threads. Under ThreadSanitizer these tests prove that access without the mutex is free of
// races.

// Scans in which all beams contain the scan's number, so that torn scans would show.
class Looks : public testing::Test {
 protected:
  void add_scans(int count) {
    for (int i = 1; i <= count; ++i) {
      const double number = 0.001 * i;
      world->add_round({{test::kLaser, test::scan(i, std::vector<double>(5, number))},
                        {test::kPose, test::pose_reading(i, {number, number, number})}});
    }
  }
  // Reads all beams until it is stopped; the number never decreases.
  void look(const std::atomic<bool>& stop) const {
    double last = 0.0;
    double last_x = 0.0;
    while (!stop) {
      for (std::uint32_t i = 0; i < laser.GetCount(); ++i) {
        const double seen = laser[i];
        EXPECT_GE(seen, last);
        EXPECT_NEAR(laser.GetBearing(i), 0.5 * i - 1.0, 1e-12);
        EXPECT_EQ(laser.GetMaxRange(), 5.0);
        last = seen;
      }
      const double x = position.GetXPos();
      EXPECT_GE(x, last_x);
      last_x = x;
      EXPECT_GE(position.GetYaw(), x);
    }
  }

  std::shared_ptr<FakeWorld> world = test::make_fake_world();
  PlayerClient client{std::make_unique<FakeSession>(world)};
  LaserProxy laser{&client, 0};
  Position2dProxy position{&client, 0};
};

TEST_F(Looks, ReaderThread_OtherThreadSeesConsistentData) {
  constexpr int kScans = 2000;
  add_scans(kScans);
  std::atomic<bool> stop{false};
  std::thread other([&] { look(stop); });
  for (int i = 1; i <= kScans; ++i) {
    client.Read();
    for (std::uint32_t beam = 0; beam < 5; ++beam) EXPECT_EQ(laser[beam], 0.001 * i);
    EXPECT_EQ(position.GetYPos(), 0.001 * i);
  }
  stop = true;
  other.join();
}

TEST_F(Looks, ReaderThread_MayChange) {
  constexpr int kScans = 1000;
  add_scans(2 * kScans);
  for (int i = 1; i <= kScans; ++i) client.Read();
  std::atomic<bool> stop{false};
  std::thread other([&] {
    for (int i = 1; i <= kScans; ++i) {
      client.Read();
      EXPECT_EQ(laser[0], 0.001 * (kScans + i));
      EXPECT_EQ(laser.GetRange(4), 0.001 * (kScans + i));
    }
    stop = true;
  });
  look(stop);  // began without the mutex
  other.join();
  EXPECT_EQ(laser[0], 0.001 * 2 * kScans);
}

TEST_F(Looks, Threads_ReadInTurns) {
  constexpr int kScans = 1000;
  add_scans(2 * kScans);
  const auto read = [this] {
    double last = 0.0;
    try {
      for (int i = 0; i < kScans; ++i) {
        client.Read();
        const double seen = laser[2];
        EXPECT_GE(seen, last);
        last = seen;
      }
    } catch (const PlayerError& error) {  // the other thread has taken the last scan
      EXPECT_EQ(error.GetErrorCode(), PlayerError::kRunIsOver);
    }
  };
  std::thread one(read);
  std::thread other(read);
  one.join();
  other.join();
  EXPECT_GT(laser[2], 0.001 * kScans);
}

TEST_F(Looks, Configure_FromOtherThread) {
  add_scans(1);
  client.Read();
  EXPECT_EQ(laser.GetCount(), 5U);
  std::atomic<bool> stop{false};
  std::thread other([&] {
    laser.Configure(-0.6, 0.6, 0, 0, false, 10.0);
    stop = true;
  });
  while (!stop) EXPECT_EQ(laser[1], 0.001);
  other.join();
  EXPECT_EQ(laser.GetCount(), 3U);
  EXPECT_NEAR(laser.GetBearing(0), -0.5, 1e-12);
  EXPECT_EQ(laser[4], 0.0);  // beyond the window
}

TEST_F(Looks, HolderAndOthers_SameBearings) {
  add_scans(1);
  client.Read();
  const auto bearings = [this] {
    std::vector<double> all;
    for (std::uint32_t i = 0; i < 5; ++i) all.push_back(laser.GetBearing(i));
    return all;
  };
  const std::vector<double> alone = bearings();  // the first with the mutex, then from the table
  EXPECT_EQ(bearings(), alone);
  std::vector<double> elsewhere;
  std::thread([&] { elsewhere = bearings(); }).join();
  EXPECT_EQ(elsewhere, alone);
  laser.Configure(-0.6, 0.6, 0, 0, false, 10.0);  // no bearing of the old table is left
  EXPECT_EQ(bearings(), (std::vector<double>{alone[1], alone[2], alone[3], 0.0, 0.0}));
}

TEST_F(Looks, CopiesAndLateProxies_HaveOwnSnapshots) {
  add_scans(3);
  client.Read();
  LaserProxy copy(laser);
  EXPECT_EQ(copy[1], 0.001);
  LaserProxy late(&client, 0);
  EXPECT_EQ(late[1], 0.0);
  client.Read();
  for (const LaserProxy* proxy : {&laser, &copy, &late}) EXPECT_EQ((*proxy)[1], 0.002);
  std::thread([&] { client.Read(); }).join();
  for (const LaserProxy* proxy : {&laser, &copy, &late}) EXPECT_EQ((*proxy)[1], 0.003);
}

// Proxies whose elements the test reads without the mutex.
struct OpenLaser : LaserProxy {
  using LaserProxy::LaserProxy;
  using LaserProxy::mElements;
};
struct OpenPosition : Position2dProxy {
  using Position2dProxy::mElements;
  using Position2dProxy::Position2dProxy;
};

TEST_F(Looks, Copies_ShowElementsAtOnce) {
  add_scans(1);
  const OpenLaser whole(&client, 0);
  const OpenPosition there(&client, 0);
  client.Read();
  OpenLaser part(whole);
  part.Configure(-0.6, 0.6, 0, 0, false, 10.0);
  double value = 0.0;
  const OpenLaser of_whole(whole);
  ASSERT_TRUE(of_whole.mElements.Find(4, value));
  EXPECT_EQ(value, 0.001);
  OpenLaser of_part(part);
  ASSERT_TRUE(of_part.mElements.Find(2, value));
  EXPECT_FALSE(of_part.mElements.Find(4, value));  // beyond the window
  of_part.Configure(-M_PI, M_PI, 0, 0, false, 10.0);
  EXPECT_EQ(of_part.GetCount(), 5U);  // the copy knows the whole scan
  const OpenPosition of_there(there);
  ASSERT_TRUE(of_there.mElements.Find(1, value));
  EXPECT_EQ(value, 0.001);
  std::thread([&] {
    const OpenLaser elsewhere(whole);  // not by the holder
    EXPECT_FALSE(elsewhere.mElements.Find(1, value));
    EXPECT_EQ(elsewhere[1], 0.001);
  }).join();
  EXPECT_TRUE(whole.mElements.Find(1, value));  // it is the holder still
}

TEST_F(Looks, ThreadThatReads_NeedsNoMutex) {
  add_scans(4);
  const OpenLaser whole(&client, 0);
  const auto seen = [&](std::uint32_t beam) {
    double value = 0.0;
    return whole.mElements.Find(beam, value) ? value : -1.0;
  };
  client.Read();
  EXPECT_EQ(seen(1), 0.001);
  std::thread([&] {
    EXPECT_EQ(seen(1), -1.0);
    client.Read();
    EXPECT_EQ(seen(1), 0.002);
    client.Read();
    EXPECT_EQ(seen(1), 0.003);
  }).join();
  EXPECT_EQ(seen(1), -1.0);
  EXPECT_EQ(whole[1], 0.003);
  client.Read();
  EXPECT_EQ(seen(1), 0.004);
}

TEST_F(Looks, OldView_NotUsedWhenItsThreadIsHolderAgain) {
  add_scans(2);
  const OpenLaser whole(&client, 0);
  client.Read();
  std::thread([&] { client.Read(); }).join();
  LaserProxy(&client, 0).Configure(-0.6, 0.6, 0, 0, false, 10.0);  // another proxy's data change
  double value = 0.0;
  EXPECT_FALSE(whole.mElements.Find(1, value));
  EXPECT_EQ(whole[1], 0.002);
}

TEST_F(Looks, ThirdThread_TakesTurnsWithMutex) {
  add_scans(4);
  const OpenLaser whole(&client, 0);
  for (int i = 1; i <= 3; ++i) {
    std::thread([&] {
      client.Read();
      double value = 0.0;
      EXPECT_EQ(whole.mElements.Find(1, value), i < 3);
      EXPECT_EQ(whole[1], 0.001 * i);
    }).join();
  }
}

TEST(LooksAtTheEnd, ClosedClient_Throws) {
  const auto world = test::make_fake_world();
  world->add_round({{test::kLaser, test::scan(1, {1, 2, 3, 4, 5})}});
  auto client = std::make_unique<PlayerClient>(std::make_unique<FakeSession>(world));
  const LaserProxy laser(client.get(), 0);
  client->Read();
  EXPECT_EQ(laser[3], 4.0);
  std::thread([&] { client.reset(); }).join();
  try {
    static_cast<void>(laser[3]);
    FAIL() << "a beam of a client that is gone was shown";
  } catch (const PlayerError& error) {
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kDisconnected);
    EXPECT_EQ(error.GetErrorFun(), "LaserProxy::operator[]");
  }
}

TEST(MorseLooks, ReaderThread_OtherThreadSeesConsistentData) {
  constexpr int kScans = 1000;
  const auto world = test::make_fake_world();
  for (int i = 1; i <= kScans; ++i) {
    world->add_round({{test::kLaser, test::scan(i, std::vector<double>(5, 0.001 * i))}});
  }
  CCMorse::MorseClient client(std::make_unique<FakeSession>(world));
  const CCMorse::MorseLaser laser(client.GetRobot());
  client.Read();
  std::atomic<bool> stop{false};
  std::thread other([&] {
    double last = 0.0;
    while (!stop) {
      const double seen = laser[2];
      EXPECT_GE(seen, last);
      last = seen;
    }
  });
  for (int i = 2; i <= kScans; ++i) {
    client.Read();
    EXPECT_EQ(laser[0], 0.001 * i);
  }
  stop = true;
  other.join();
}

}  // namespace
}  // namespace playerlike
