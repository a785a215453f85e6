// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The rules of time (docs/architecture.md), as sessions see them.
#include "playerlike/host/host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <mutex>
#include <thread>

#include "patient_host.h"
#include "reachable_host.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace playerlike {
namespace {

using std::chrono::milliseconds;
using test::ReachableHost;
using test::Transport;
using testing::HasSubstr;

// Stores the times of the readings of a round, and the newest pose.
struct Collector : ReadingSink {
  void on_reading(DeviceId device, const sim::SharedReading& reading) override {
    devices.push_back(device);
    times_ns.push_back(reading->time_ns);
    readings.push_back(reading);
    if (const auto* pose = dynamic_cast<const sim::PoseReading*>(reading.get())) {
      x_m = pose->pose.x_m;
    }
  }
  std::vector<DeviceId> devices;
  std::vector<sim::SimTime> times_ns;
  std::vector<sim::SharedReading> readings;
  double x_m = 0.0;
};

// Two robots side by side in an empty room, driving along x.
sim::WorldDescription two_robots(const std::string& simulation = "{}") {
  return sim::load_world_text(R"({"name": "two", "arena": {"size": [20, 4]}, "simulation": )" +
                              simulation +
                              R"(, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}},
                      {"name": "r2", "pose": {"x": 1, "y": 3}}]})");
}

class HostTest : public testing::Test {
 protected:
  // The host under test; destroy its sessions before starting the next one.
  std::shared_ptr<ReachableHost> start(sim::WorldDescription world, RunSettings settings = {}) {
    reachable.reset();
    host = test::patient_host(std::move(world), std::move(settings),
                              [this](sim::LogLevel, std::string_view text) {
                                const std::lock_guard lock(log_mutex);
                                log += std::string(text) + '\n';
                              });
    reachable = std::make_shared<ReachableHost>(host, transport);
    return reachable;
  }
  std::string logged() {
    const std::lock_guard lock(log_mutex);
    return log;
  }

  static InterfaceBinding position2d(Session& session, int index = 0) {
    return find_interface(session.robots(), session.port(), "position2d", index);
  }
  static InterfaceBinding subscribe_position(Session& session, int index = 0) {
    const InterfaceBinding binding = position2d(session, index);
    session.request(SubscribeRequest{binding.reading});
    return binding;
  }
  static void drive(Session& session, const InterfaceBinding& binding, double v) {
    session.send(binding.motion.value(), sim::TwistCommand{{.v_mps = v}});
  }
  static std::optional<sim::Colour> colour_at(Session& session, int column, int row) {
    const auto value = session.request(CellRequest{sim::kBaseLayer, column, row});
    return value ? std::optional(value->colour()) : std::nullopt;
  }
  // One Read() of a client.
  static Collector read(Session& session) {
    Collector round;
    do {
      session.wait();
    } while (session.take(round) == 0);
    return round;
  }

  Transport transport = Transport::kInProcess;
  std::mutex log_mutex;
  std::string log;
  std::shared_ptr<Host> host;
  std::shared_ptr<ReachableHost> reachable;
};

// Properties of sessions that hold with function calls and with messages.
class HostOverTest : public HostTest, public testing::WithParamInterface<Transport> {
 protected:
  HostOverTest() { transport = GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Transports, HostOverTest,
                         testing::Values(Transport::kInProcess, Transport::kCbor, Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(HostOverTest, Read_TakesTenthOfSecond) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  for (int i = 1; i <= 20; ++i) {
    EXPECT_THAT(read(*session).times_ns, testing::ElementsAre(i * 100'000'000));
    EXPECT_EQ(host->time().steps, static_cast<std::uint64_t>(10 * i));
  }
}

TEST_P(HostOverTest, BetweenReads_TimeStands) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  read(*session);
  std::this_thread::yield();
  EXPECT_EQ(session->request(TimeRequest{}).steps, 10U);
  EXPECT_EQ(session->request(TimeRequest{}).steps, 10U);
}

TEST_P(HostOverTest, Command_AppliesFromNextStepAndHolds) {
  const auto session = start(two_robots())->connect(6665);
  const InterfaceBinding binding = subscribe_position(*session);
  drive(*session, binding, 0.5);
  EXPECT_NEAR(read(*session).x_m, 1.05, 1e-9);
  EXPECT_NEAR(read(*session).x_m, 1.10, 1e-9);
}

TEST_P(HostOverTest, ReadWithoutSubscriptions_TakesTenthOfSecond) {
  const auto session = start(two_robots())->connect(6665);
  Collector none;
  session->wait();
  EXPECT_EQ(session->take(none), 0);
  EXPECT_EQ(host->time().steps, 10U);
  session->wait();
  EXPECT_EQ(session->take(none), 0);
  EXPECT_EQ(host->time().steps, 20U);
}

TEST_P(HostOverTest, FirstPeek_TakesNoTimeAndFurtherOnesOneStep) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  read(*session);
  EXPECT_FALSE(session->peek(milliseconds(0)));
  EXPECT_EQ(host->time().steps, 10U);
  for (int i = 1; i < 10; ++i) {
    EXPECT_FALSE(session->peek(milliseconds(0)));
    EXPECT_EQ(host->time().steps, 10U + static_cast<unsigned>(i));
  }
  EXPECT_TRUE(session->peek(milliseconds(0)));
  EXPECT_TRUE(session->peek(milliseconds(0)));
  EXPECT_EQ(host->time().steps, 20U);
  EXPECT_EQ(read(*session).times_ns.front(), 200'000'000);
  EXPECT_FALSE(session->peek(milliseconds(0)));
}

TEST_P(HostOverTest, PeekWithTimeout_WaitsInSimulatedTime) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  read(*session);
  EXPECT_FALSE(session->peek(milliseconds(50)));
  EXPECT_EQ(host->time().steps, 15U);
  EXPECT_TRUE(session->peek(milliseconds(1000)));
  EXPECT_EQ(host->time().steps, 20U);
}

TEST_P(HostOverTest, NewReading_ReplacesOldUnlessQueued) {
  const auto world = start(two_robots());
  const auto session = world->connect(6665);
  const auto other = world->connect(6666);
  const InterfaceBinding mine = subscribe_position(*session);
  subscribe_position(*other);
  // One thread: three reads of the other client make three rounds pass here.
  for (int i = 0; i < 3; ++i) read(*other);
  EXPECT_THAT(read(*session).times_ns, testing::ElementsAre(300'000'000));
  session->request(ReplaceRequest{mine.reading, false});
  for (int i = 0; i < 3; ++i) read(*other);
  EXPECT_THAT(read(*session).times_ns, testing::ElementsAre(400'000'000, 500'000'000, 600'000'000));
}

TEST_P(HostOverTest, OneThread_ReadsSeveralClientsInTurn) {
  const auto world = start(two_robots());
  const auto first = world->connect(6665);
  const auto second = world->connect(6666);
  drive(*first, subscribe_position(*first), 0.1);
  drive(*second, subscribe_position(*second), 0.2);
  for (int i = 1; i <= 50; ++i) {
    EXPECT_NEAR(read(*first).x_m, 1.0 + 0.01 * i, 1e-9);
    EXPECT_NEAR(read(*second).x_m, 1.0 + 0.02 * i, 1e-9);
  }
  EXPECT_EQ(host->time().steps, 500U);
}

// Two threads; each drives its robot by its readings.
std::uint64_t two_threads_run(const std::shared_ptr<ReachableHost>& host) {
  const auto program = [&host](int port) {
    const auto session = host->connect(port);
    const auto binding = find_interface(session->robots(), port, "position2d", 0);
    session->request(SubscribeRequest{binding.reading});
    try {
      for (int i = 0;; ++i) {
        Collector round;
        session->wait();
        session->take(round);
        session->send(*binding.motion, sim::TwistCommand{{.v_mps = 0.2 + 0.1 * std::sin(round.x_m),
                                                          .omega_radps = 0.3 * (i % 7 - 3)}});
      }
    } catch (const SessionError& e) {
      EXPECT_EQ(e.code(), SessionError::Code::kFinished);
    }
  };
  std::thread one(program, 6665);
  std::thread two(program, 6666);
  one.join();
  two.join();
  return host->state_hash();
}

TEST_P(HostOverTest, TwoThreadsInLockstep_Repeatable) {
  const std::string simulation = R"({"duration": 20, "clients": 2})";
  const std::uint64_t first = two_threads_run(start(two_robots(simulation)));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(two_threads_run(start(two_robots(simulation))), first);
}

TEST_P(HostOverTest, StartGate_HoldsClockUntilAllJoin) {
  const auto world = start(two_robots(R"({"clients": 2})"));
  const auto first = world->connect(6665);
  const auto second = world->connect(6666);
  subscribe_position(*first);
  subscribe_position(*second);
  std::thread early([&] { EXPECT_EQ(read(*first).times_ns.front(), 100'000'000); });
  EXPECT_EQ(host->time().steps, 0U);  // independent of the other thread
  EXPECT_EQ(read(*second).times_ns.front(), 100'000'000);
  early.join();
  EXPECT_EQ(host->time().steps, 10U);
}

TEST_P(HostOverTest, DestroyedClient_NotAwaited) {
  const auto world = start(two_robots());
  const auto session = world->connect(6665);
  subscribe_position(*session);
  auto other = world->connect(6666);
  subscribe_position(*other);
  std::promise<void> joined;
  std::promise<void> leave;
  std::thread thread([&] {
    read(*other);
    joined.set_value();
    leave.get_future().wait();
    other.reset();
  });
  joined.get_future().wait();
  leave.set_value();
  read(*session);  // the first round may have been taken already, the second needs the other client
  for (int i = 0; i < 5; ++i) read(*session);
  thread.join();
  EXPECT_GE(host->time().steps, 60U);
}

TEST_P(HostOverTest, EndedThread_NotAwaited) {
  const auto world = start(two_robots());
  const auto session = world->connect(6665);
  subscribe_position(*session);
  const auto other = world->connect(6666);
  subscribe_position(*other);
  std::thread([&] { read(*other); }).join();
  for (int i = 0; i < 5; ++i) read(*session);
  EXPECT_GE(host->time().steps, 50U);
  EXPECT_EQ(logged(), "");  // the silence limit was not reached
}

TEST_P(HostOverTest, ClientWithoutReads_NotAwaited) {
  const auto world = start(two_robots());
  const auto reader = world->connect(6665);
  subscribe_position(*reader);
  const auto sender = world->connect(6666);
  drive(*sender, position2d(*sender), 0.5);
  for (int i = 0; i < 10; ++i) read(*reader);
  const auto all = world->connect(kMorsePort);
  subscribe_position(*all, 1);
  EXPECT_NEAR(read(*all).x_m, 1.55, 1e-9);
}

TEST_P(HostOverTest, ClientThatOnlyCommands_LastCommandApplied) {
  const auto session = start(two_robots())->connect(6665);
  const InterfaceBinding binding = position2d(*session);
  for (int i = 0; i < 20'001; ++i) {  // more than the queue holds
    session->send(*binding.motion, sim::MotorEnableCommand{true});
    drive(*session, binding, i % 2 == 0 ? 0.4 : -0.4);
  }
  session->request(SubscribeRequest{binding.reading});
  EXPECT_NEAR(read(*session).x_m, 1.04, 1e-9);
}

TEST_P(HostOverTest, SilentClient_NamedAndSkippedUntilNextRead) {
  RunSettings settings;
  settings.silence_limit_s = 0.05;
  const auto world = start(two_robots(), settings);
  const auto session = world->connect(6665);
  subscribe_position(*session);
  const auto other = world->connect(6666);
  subscribe_position(*other);
  std::promise<void> joined;
  std::promise<void> back;
  std::thread thread([&] {
    read(*other);
    joined.set_value();
    back.get_future().wait();  // computes for as long as the others need
    read(*other);
  });
  joined.get_future().wait();
  for (int i = 0; i < 5; ++i) read(*session);
  EXPECT_THAT(logged(), HasSubstr("port 6666"));
  back.set_value();
  thread.join();
  for (int i = 0; i < 3; ++i) read(*session);
}

TEST_P(HostOverTest, Commands_AllowedFromOtherThread) {
  const auto session = start(two_robots(R"({"duration": 30})"))->connect(6665);
  const InterfaceBinding binding = subscribe_position(*session);
  std::atomic<bool> stop{false};
  std::thread sender([&] {
    for (int i = 0; !stop; ++i) {
      drive(*session, binding, 0.001 * (i % 100));
      if (i % 64 == 0) static_cast<void>(session->request(CellRequest{sim::kBaseLayer, 3, 3}));
      if (i % 16 == 0) {
        const sim::DrawOperation dot{
            .x0 = i % 100, .y0 = 5, .value = sim::CellValue::of(sim::Colour{255, 0, 0, 255})};
        session->draw({&dot, 1});
      }
    }
  });
  EXPECT_THROW(while (true) read(*session), SessionError);
  stop = true;
  sender.join();
  EXPECT_TRUE(host->finished());
}

TEST_P(HostOverTest, EndOfRun_ReportedAfterLastReadings) {
  const auto session = start(two_robots(R"({"duration": 0.3})"))->connect(6665);
  subscribe_position(*session);
  for (int i = 0; i < 3; ++i) read(*session);
  EXPECT_TRUE(session->peek(milliseconds(0)));  // so that polling programs notice it
  try {
    read(*session);
    FAIL() << "expected the end of the run";
  } catch (const SessionError& e) {
    EXPECT_EQ(e.code(), SessionError::Code::kFinished);
  }
}

TEST_P(HostOverTest, Sleep_AdvancesTimeAndKeepsReadings) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  session->request(SleepRequest{0.25});
  EXPECT_EQ(host->time().steps, 25U);
  EXPECT_EQ(read(*session).times_ns.front(), 200'000'000);
  EXPECT_EQ(host->time().steps, 25U);
  EXPECT_THROW(session->request(SleepRequest{-1.0}), SessionError);
  EXPECT_THROW(session->request(SleepRequest{std::numeric_limits<double>::quiet_NaN()}),
               SessionError);
}

TEST_P(HostOverTest, ClosedSession_ThrowsAndWakesWaiter) {
  const auto world = start(two_robots(R"({"clients": 2})"));
  const auto session = world->connect(6665);
  subscribe_position(*session);
  std::thread closer([&] { session->close(); });
  EXPECT_THROW(read(*session), SessionError);  // the gate never opens
  closer.join();
  EXPECT_FALSE(session->connected());
  EXPECT_THROW(read(*session), SessionError);
  EXPECT_THROW(drive(*session, position2d(*session), 0.1), SessionError);
}

// --- Clients of event loops

using Outcome = EventClient::Outcome;
constexpr std::chrono::seconds kLong{60};

// A client of an event loop, on robot 1 or 2.
struct Looped {
  Looped(Host& host, int port, EventRole role = EventRole::kParticipant)
      : client(host.connect_events(
            port, [count = calls] { ++*count; }, role)) {}

  Session& session() { return client->session(); }

  std::shared_ptr<std::atomic<int>> calls = std::make_shared<std::atomic<int>>(0);
  std::unique_ptr<EventClient> client;
  ThreadId thread_id = new_thread_id();
};

TEST_F(HostTest, EventLoop_ReadsLikeThread) {
  start(two_robots());
  Looped loop(*host, 6665);
  const InterfaceBinding binding = subscribe_position(loop.session());
  drive(loop.session(), binding, 0.5);
  for (int i = 1; i <= 20; ++i) {
    EXPECT_EQ(loop.client->begin_wait(loop.thread_id), Outcome::kWaiting);
    EXPECT_EQ(*loop.calls, i - 1);
    EXPECT_FALSE(host->advance(kLong));
    EXPECT_EQ(*loop.calls, i);
    EXPECT_EQ(loop.client->outcome(), Outcome::kData);
    EXPECT_FALSE(host->advance(kLong)) << "it thinks";
    Collector round;
    EXPECT_EQ(loop.session().take(round), 1);
    EXPECT_THAT(round.times_ns, testing::ElementsAre(i * 100'000'000));
    EXPECT_NEAR(round.x_m, 1.0 + 0.05 * i, 1e-9);
  }
}

TEST_F(HostTest, Watchers_NeitherAwaitedNorAdvanceTime) {
  start(two_robots());
  Looped onlooker(*host, 6665, EventRole::kOnlooker);
  subscribe_position(onlooker.session());
  EXPECT_EQ(onlooker.client->begin_wait(onlooker.thread_id), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(host->now_ns(), 0) << "nobody else takes part";

  const auto session = host->connect(6665);
  subscribe_position(*session);
  session->wait();
  EXPECT_EQ(host->now_ns(), 100'000'000);
  EXPECT_EQ(*onlooker.calls, 1);
  EXPECT_EQ(onlooker.client->outcome(), Outcome::kData);
  Collector seen;
  EXPECT_EQ(onlooker.session().take(seen), 1);
  // It does not wait now.
  for (int i = 0; i < 5; ++i) {
    Collector round;
    EXPECT_EQ(session->take(round), 1);
    session->wait();
  }
  EXPECT_EQ(host->now_ns(), 600'000'000);
  EXPECT_EQ(*onlooker.calls, 1);
  EXPECT_TRUE(host->time().unrepeatable.empty());
  host->note_onlooker_acts();
  EXPECT_EQ(host->time().unrepeatable.size(), 1U);
}

TEST_F(HostTest, WatcherCommands_AppliedAfterThoseOfPrograms) {
  start(two_robots());
  Looped onlooker(*host, 6665, EventRole::kOnlooker);
  const auto session = host->connect(6665);  // connected later
  const InterfaceBinding binding = subscribe_position(*session);
  drive(onlooker.session(), binding, 0.2);
  drive(*session, binding, 0.5);
  session->wait();
  EXPECT_NEAR(host->statistics(0).path_length_m, 0.02, 1e-9);
}

TEST_F(HostTest, EventLoop_PeeksSleepsAndGetsEnd) {
  start(two_robots(R"({"duration": 0.3})"));
  Looped loop(*host, 6665);
  subscribe_position(loop.session());
  EXPECT_EQ(loop.client->outcome(), Outcome::kIdle);
  EXPECT_EQ(loop.client->begin_peek(loop.thread_id, milliseconds(0)), Outcome::kTime)
      << "only looks";
  EXPECT_EQ(loop.client->begin_peek(loop.thread_id, milliseconds(0)), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(loop.client->outcome(), Outcome::kTime);
  EXPECT_EQ(host->time().steps, 1U);
  EXPECT_EQ(loop.client->begin_peek(loop.thread_id, milliseconds(50)), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(loop.client->outcome(), Outcome::kTime);
  EXPECT_EQ(host->time().steps, 6U);
  EXPECT_EQ(loop.client->begin_sleep(loop.thread_id, 0.1), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(loop.client->outcome(), Outcome::kTime);
  EXPECT_EQ(host->time().steps, 16U);
  EXPECT_EQ(loop.client->begin_wait(loop.thread_id), Outcome::kData) << "of 0.1 s, not taken yet";
  Collector round;
  loop.session().take(round);
  EXPECT_EQ(loop.client->begin_sleep(loop.thread_id, 10.0), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(loop.client->outcome(), Outcome::kFinished);
  EXPECT_EQ(loop.client->begin_wait(loop.thread_id), Outcome::kData);
  loop.session().take(round);
  EXPECT_THAT(round.times_ns, testing::ElementsAre(100'000'000, 300'000'000));
  EXPECT_EQ(loop.client->begin_wait(loop.thread_id), Outcome::kFinished);
  EXPECT_EQ(loop.client->begin_peek(loop.thread_id, milliseconds(5)), Outcome::kFinished);
  EXPECT_THROW(loop.client->begin_sleep(loop.thread_id, -1.0), SessionError);
}

TEST_F(HostTest, Advance_StopsAtIntervals) {
  start(two_robots());
  Looped loop(*host, 6665);
  EXPECT_EQ(loop.client->begin_sleep(loop.thread_id, 3600.0), Outcome::kWaiting);
  EXPECT_TRUE(host->advance(std::chrono::microseconds(0)));
  EXPECT_EQ(host->time().steps, 1U);
  loop.client->cancel();
  EXPECT_EQ(loop.client->outcome(), Outcome::kIdle);
  EXPECT_FALSE(host->advance(kLong)) << "it thinks";
  EXPECT_EQ(host->time().steps, 1U);
}

// The reader steps the simulation to the time at which the sleeper goes on, and must wait for it
// then.
TEST_F(HostTest, SteppingThread_WakesShorterSleeper) {
  const auto world = start(two_robots(R"({"clients": 2})"));
  const auto reader = world->connect(6665);
  const auto sleeper = world->connect(6666);
  subscribe_position(*reader);
  std::thread other([&] {
    for (int i = 0; i < 2; ++i) sleeper->request(SleepRequest{0.35});
  });
  for (int i = 1; i <= 7; ++i) {
    EXPECT_THAT(read(*reader).times_ns, testing::ElementsAre(i * 100'000'000));
  }
  other.join();
  EXPECT_EQ(host->time().steps, 70U);
  EXPECT_EQ(logged(), "") << "nobody was silent";
}

TEST_F(HostTest, ClientsOfThread_DoNotBlockEachOther) {
  start(two_robots());
  Looped a(*host, 6665);
  Looped b(*host, 6666);
  subscribe_position(a.session());
  subscribe_position(b.session());
  a.client->begin_wait(a.thread_id);
  b.client->begin_wait(b.thread_id);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(a.client->outcome(), Outcome::kData);
  EXPECT_EQ(b.client->outcome(), Outcome::kData);
  Collector round;
  a.session().take(round);
  EXPECT_EQ(a.client->begin_wait(a.thread_id), Outcome::kWaiting);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(a.client->outcome(), Outcome::kWaiting) << "b thinks";
  // Thread a takes over b's client while it waits.
  b.client->join(a.thread_id);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(a.client->outcome(), Outcome::kData);
  EXPECT_EQ(host->time().steps, 20U);
  // A thread that has ended takes no part.
  b.client->join(b.thread_id);
  a.session().take(round);
  a.client->begin_wait(a.thread_id);
  host->thread_ended(b.thread_id);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(a.client->outcome(), Outcome::kData);
}

TEST_F(HostTest, EventLoopAndThread_ShareLockstep) {
  start(two_robots(R"({"clients": 2})"));
  Looped loop(*host, 6665);
  subscribe_position(loop.session());
  std::thread thread([&] {
    const auto session = host->connect(6666);
    subscribe_position(*session);
    for (int i = 1; i <= 5; ++i) EXPECT_EQ(read(*session).times_ns.back(), i * 100'000'000);
  });
  for (int i = 1; i <= 5; ++i) {
    loop.client->begin_wait(loop.thread_id);
    while (loop.client->outcome() == Outcome::kWaiting) {
      host->advance(std::chrono::microseconds(100));
      std::this_thread::yield();
    }
    Collector round;
    loop.session().take(round);
    EXPECT_EQ(round.times_ns.back(), i * 100'000'000);
  }
  loop.client.reset();
  thread.join();
  EXPECT_EQ(host->time().steps, 50U);
}

TEST_F(HostTest, SilentEventClient_NamedAndSkipped) {
  RunSettings settings;
  settings.silence_limit_s = 0.02;
  start(two_robots(), settings);
  Looped waiting(*host, 6665);
  Looped silent(*host, 6666);
  subscribe_position(waiting.session());
  silent.client->join(silent.thread_id);
  waiting.client->begin_wait(waiting.thread_id);
  while (waiting.client->outcome() == Outcome::kWaiting) {
    host->advance(std::chrono::microseconds(100));
    host->check_silence();
    std::this_thread::yield();
  }
  EXPECT_THAT(logged(), HasSubstr("client 2 (port 6666) has not called Read() for"));
}

TEST_F(HostTest, Alarms_RingOnceAndAdvanceLockstep) {
  start(two_robots(R"({"duration": 3})"));
  std::vector<std::string> rung;
  const auto alarm = [&](const std::string& name) {
    Alarm made;
    made.notify = [&rung, name] { rung.push_back(name); };
    return made;
  };
  Alarm patient = alarm("patient");
  patient.until_ns = sim::from_seconds(0.2);
  host->set_alarm(patient);
  EXPECT_FALSE(host->advance(kLong)) << "nobody for whom time would go on";
  EXPECT_EQ(host->time().steps, 0U);

  Alarm driving = alarm("moving");
  driving.lets_time_pass = true;
  driving.condition = [](const sim::Simulation& simulation) { return simulation.steps() == 50; };
  host->set_alarm(driving);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(host->time().steps, 50U);
  EXPECT_THAT(rung, testing::ElementsAre("patient", "moving"));

  Alarm now = alarm("past");
  now.until_ns = 0;
  host->set_alarm(now);
  EXPECT_EQ(rung.back(), "past");

  Alarm never = alarm("cancelled");
  never.until_ns = sim::from_seconds(1.0);
  const AlarmId id = host->set_alarm(never);
  EXPECT_TRUE(host->cancel_alarm(id));
  EXPECT_FALSE(host->cancel_alarm(id));
  never = alarm("at the end");
  never.lets_time_pass = true;
  never.until_ns = sim::from_seconds(100.0);
  host->set_alarm(never);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_THAT(rung, testing::ElementsAre("patient", "moving", "past", "at the end"));
  EXPECT_TRUE(host->finished());
  host->set_alarm(alarm("after the end"));
  EXPECT_EQ(rung.back(), "after the end");
}

TEST_F(HostTest, StepCredit_LimitsLockstep) {
  start(two_robots());
  host->set_step_credit(3);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(host->time().steps, 3U);
  Looped loop(*host, 6665);
  subscribe_position(loop.session());
  EXPECT_EQ(loop.client->begin_wait(loop.thread_id), Outcome::kWaiting);
  host->add_step_credit(2);
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(loop.client->outcome(), Outcome::kWaiting);
  EXPECT_EQ(host->time().steps, 5U);
  host->set_step_credit(std::nullopt);
  host->add_step_credit(100);  // without a limit, this has no effect
  EXPECT_FALSE(host->advance(kLong));
  EXPECT_EQ(host->time().steps, 10U);
}

TEST_F(HostTest, StepCredit_HoldsPacedTime) {
  RunSettings settings;
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 100.0;
  start(two_robots(), settings);
  host->set_step_credit(0);
  Looped loop(*host, 6665);  // the clock waits for its first client
  host->add_step_credit(4);
  while (host->time().steps < 4) std::this_thread::yield();
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_EQ(host->time().steps, 4U);
  EXPECT_FALSE(host->advance(kLong)) << "the pacer steps";
  host->set_step_credit(std::nullopt);
  while (host->time().steps < 10) std::this_thread::yield();
}

TEST_F(HostTest, Speed_OnlyInPacedTime) {
  start(two_robots());
  EXPECT_THAT(host->set_time_factor(2.0).value(), HasSubstr("lockstep"));
  RunSettings settings;
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 1e-6;
  settings.start_at_once = true;
  start(two_robots(), settings);
  EXPECT_THAT(host->set_time_factor(0.0).value(), HasSubstr("greater than 0"));
  EXPECT_EQ(host->set_time_factor(1000.0), std::nullopt);
  while (host->time().steps < 10) std::this_thread::yield();
}

TEST_F(HostTest, UnknownPortsAndDevices_ErrorListsExisting) {
  const auto world = start(two_robots());
  try {
    static_cast<void>(world->connect(1234));
    FAIL();
  } catch (const SessionError& e) {
    EXPECT_THAT(e.what(), HasSubstr("6665 (r1)"));
    EXPECT_THAT(e.what(), HasSubstr("4000"));
  }
  const auto session = world->connect(6665);
  try {
    static_cast<void>(find_interface(session->robots(), 6665, "laser", 3));
    FAIL();
  } catch (const SessionError& e) {
    EXPECT_THAT(e.what(), HasSubstr("laser:0 (r1.laser)"));
  }
  EXPECT_THROW(session->request(SubscribeRequest{{7, 0}}), SessionError);
  EXPECT_THROW(session->request(SubscribeRequest{position2d(*session).motion.value()}),
               SessionError);
}

TEST_F(HostTest, Port4000_IndexIsRobotNumberUnlessWorldSetsIt) {
  const auto session = start(two_robots())->connect(kMorsePort);
  EXPECT_EQ(position2d(*session, 0).robot, 0);
  EXPECT_EQ(position2d(*session, 1).robot, 1);
  sim::WorldDescription world = two_robots();
  world.robots[0].proxies["position2d"] = 7;
  const auto renamed = start(world)->connect(kMorsePort);
  EXPECT_EQ(position2d(*renamed, 7).robot, 0);
  EXPECT_THROW(position2d(*renamed, 0), SessionError);
}

TEST_F(HostTest, NotANumber_Refused) {
  const auto session = start(two_robots())->connect(6665);
  EXPECT_THROW(drive(*session, position2d(*session), std::numeric_limits<double>::quiet_NaN()),
               SessionError);
}

TEST_F(HostTest, Drawings_VisibleAtOnceToClientInOrderOfClients) {
  const auto world = start(two_robots());
  const auto first = world->connect(6665);
  const auto second = world->connect(6666);
  const auto dot = [](Session& s, sim::Colour colour) {
    const sim::DrawOperation operation{.x0 = 4, .y0 = 5, .value = sim::CellValue::of(colour)};
    s.draw({&operation, 1});
  };
  dot(*second, {0, 0, 255, 255});
  dot(*first, {255, 0, 0, 255});
  first->wait();
  EXPECT_EQ(colour_at(*first, 4, 5),
            (sim::Colour{0, 0, 255, 255}));  // the second client draws last
  dot(*first, {255, 0, 0, 255});
  EXPECT_EQ(colour_at(*first, 4, 5), (sim::Colour{255, 0, 0, 255}));
  EXPECT_FALSE(first->request(CellRequest{sim::kBaseLayer, -1, 0}).has_value());
}

TEST_F(HostTest, PacedTime_RunsByItselfBehindClock) {
  const auto begin = std::chrono::steady_clock::now();
  const auto session = start(two_robots(R"({"time": 200, "duration": 4})"))->connect(6665);
  const InterfaceBinding binding = subscribe_position(*session);
  drive(*session, binding, 0.5);
  double last_x_m = 0.0;
  try {
    while (true) last_x_m = read(*session).x_m;
  } catch (const SessionError& e) {
    EXPECT_EQ(e.code(), SessionError::Code::kFinished);
  }
  const TimeStatistics time = host->time();
  EXPECT_EQ(time.mode, sim::TimeMode::kPaced);
  EXPECT_EQ(time.steps, 400U);
  EXPECT_GT(last_x_m, 1.0);
  // 4 s at 200 times real time are 20 ms, counted from the first client's connection. The host
  // catches up with late steps but runs none early. Load can only make it longer.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(20));
}

TEST_P(HostOverTest, BackgroundReader_SwitchesToPacedTime) {
  const auto session = start(two_robots())->connect(6665);
  subscribe_position(*session);
  session->request(PreferRealTimeRequest{"a test"});
  read(*session);
  EXPECT_EQ(session->request(TimeRequest{}).mode, sim::TimeMode::kPaced);
  EXPECT_THAT(logged(), HasSubstr("a test"));
}

TEST_P(HostOverTest, TimeModeOfWorld_Kept) {
  const auto session = start(two_robots(R"({"time": "lockstep"})"))->connect(6665);
  subscribe_position(*session);
  session->request(PreferRealTimeRequest{"a test"});
  read(*session);
  EXPECT_EQ(session->request(TimeRequest{}).mode, sim::TimeMode::kLockstep);
  EXPECT_EQ(logged(), "");
}

TEST_P(HostOverTest, Results_WrittenOnceAtEnd) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "playpen_host_test";
  std::filesystem::remove_all(folder);
  RunSettings settings;
  settings.output_folder = folder.string();
  settings.duration_s = 1.0;
  settings.seed = 99;
  const auto session = start(two_robots(), settings)->connect(6665);
  const InterfaceBinding binding = subscribe_position(*session);
  drive(*session, binding, 0.5);
  EXPECT_THROW(while (true) read(*session), SessionError);
  for (const char* name : {"scene.png", "canvas.png", "report.json", "trajectory.csv"}) {
    EXPECT_GT(std::filesystem::file_size(folder / name), 100U) << name;
  }
  std::ifstream stream(folder / "report.json");
  const std::string report((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_THAT(report, HasSubstr(R"("world": "two")"));
  EXPECT_THAT(report, HasSubstr(R"("seed": 99)"));
  EXPECT_THAT(report, HasSubstr(R"("steps": 100)"));
  EXPECT_THAT(report, HasSubstr(R"("name": "r2")"));
  std::ifstream rows(folder / "trajectory.csv");
  std::string line;
  int count = 0;
  while (std::getline(rows, line)) ++count;
  EXPECT_EQ(count, 1 + 2 * 11);  // a header, then both robots at 0, 0.1, ..., 1 s
  std::filesystem::remove_all(folder);
}

TEST_F(HostTest, Interrupt_EndsRun) {
  RunSettings settings;
  settings.quiet_end = true;  // as under playpen run
  const auto session = start(two_robots(), settings)->connect(6665);
  subscribe_position(*session);
  read(*session);
  std::raise(SIGINT);
  try {
    read(*session);
    FAIL() << "expected the end of the run";
  } catch (const SessionError& e) {
    EXPECT_EQ(e.code(), SessionError::Code::kFinished);
  }
}

TEST_F(HostTest, UnwritableOutputFolder_ErrorNamesIt) {
  RunSettings settings;
  settings.output_folder = "/proc/no/such/folder";
  EXPECT_THROW(start(two_robots(), settings), std::exception);
}

}  // namespace
}  // namespace playerlike
