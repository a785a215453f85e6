// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of a host, each tested alone: clients, lockstep, pace, inputs and so on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "host/launch/processes.h"
#include "host/requests/blackboard.h"
#include "host/results/results.h"
#include "host/stepping/alarms.h"
#include "host/stepping/clients.h"
#include "host/stepping/inputs.h"
#include "host/stepping/lockstep.h"
#include "host/stepping/pace.h"
#include "host/stepping/progress.h"
#include "host/stepping/stalled_time_warning.h"
#include "sim/devices/localization.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Two robots side by side in an empty room; poses are measured at 10 Hz.
class HostPartsTest : public testing::Test {
 protected:
  [[nodiscard]] DeviceId device(int robot, const std::string& name) const {
    return {robot, simulation.find_device(robot, name).value()};
  }
  [[nodiscard]] std::vector<int> numbers() const {
    std::vector<int> all;
    for (const auto& client : clients) all.push_back(client->number);
    return all;
  }
  void run(double duration_s) {
    const sim::SimTime end_ns = simulation.now_ns() + sim::from_seconds(duration_s);
    while (simulation.now_ns() < end_ns) {
      simulation.step();
      clients.distribute({});
    }
  }

  sim::Simulation simulation{sim::load_world_text(
      R"({"name": "two", "arena": {"size": [20, 4]}, "robots": [
          {"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 1, "y": 3}}]})")};
  const std::vector<RobotInfo> robots = describe_robots(simulation);
  Clients clients{simulation, robots, /*by_creator=*/false};
  const DeviceId pose = device(0, "pose");
  std::vector<std::string> warnings;
  const Warn warn = [this](const std::string& text) { warnings.push_back(text); };
};

// --- Clients

using ClientsTest = HostPartsTest;

TEST_F(ClientsTest, FollowersFirstAndOnlookersLast) {
  clients.add(6665, EventRole::kOnlooker, {});
  EXPECT_FALSE(clients.any_but_onlookers());
  clients.add(6665, EventRole::kParticipant, {});
  clients.add(6665, EventRole::kFollower, {});
  clients.add(6665, EventRole::kParticipant, {});
  const auto last = clients.add(6665, EventRole::kFollower, {});
  clients.add(6665, EventRole::kOnlooker, {});
  EXPECT_THAT(numbers(), ElementsAre(2, 4, 1, 3, 0, 5));
  clients.remove(*last);
  EXPECT_THAT(numbers(), ElementsAre(2, 1, 3, 0, 5));
  EXPECT_TRUE(clients.any_but_onlookers());
}

TEST_F(ClientsTest, Readings_SentToSubscribers) {
  const auto reader = clients.add(6665, EventRole::kParticipant, {});
  const auto other = clients.add(6666, EventRole::kParticipant, {});
  clients.subscribe(*reader, pose);
  clients.subscribe(*other, device(1, "pose"));
  run(0.25);
  const auto taken = clients.take(*reader);
  ASSERT_EQ(taken.size(), 1U) << "the newest replaces the one before";
  EXPECT_EQ(taken[0].first, pose);
  EXPECT_THAT(clients.take(*reader), IsEmpty());
  clients.unsubscribe(*other, device(1, "pose"));
  EXPECT_FALSE(other->has_data);
  clients.remove(*reader);
  run(0.5);  // the subscriptions of the session that has left have no effect
  EXPECT_THAT(clients.take(*other), IsEmpty());
}

TEST_F(ClientsTest, Subscriptions_Counted) {
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  clients.subscribe(*client, pose);
  clients.subscribe(*client, pose);
  clients.unsubscribe(*client, pose);
  run(0.25);
  EXPECT_EQ(clients.take(*client).size(), 1U);
  clients.unsubscribe(*client, pose);
  EXPECT_TRUE(client->subscriptions.empty());
}

TEST_F(ClientsTest, RoundWithoutSubscriptions_TakesTenthOfSecond) {
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  run(0.09);
  EXPECT_FALSE(client->has_data);
  run(0.01);
  EXPECT_TRUE(client->has_data);
  clients.take(*client);
  run(0.09);
  EXPECT_FALSE(client->has_data);
}

TEST_F(ClientsTest, Queue_KeepsThousandReadings) {
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  clients.set_replace(*client, std::nullopt, false);
  clients.subscribe(*client, pose);
  run(100.35);
  const std::uint32_t lost = client->overflow;
  EXPECT_GT(lost, 0U);
  const auto taken = clients.take(*client);
  ASSERT_EQ(taken.size(), 1000U);
  EXPECT_LT(taken[0].second->time_ns, taken[1].second->time_ns);
}

TEST_F(ClientsTest, RuleChange_KeepsNewestReading) {
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  clients.set_replace(*client, std::nullopt, false);
  clients.subscribe(*client, pose);
  run(0.35);
  EXPECT_GT(client->subscriptions.at(0).unread.size(), 1U);
  clients.set_replace(*client, pose, true);
  EXPECT_EQ(clients.take(*client).size(), 1U) << "the newest";
  run(0.35);
  EXPECT_EQ(client->subscriptions.at(0).unread.size(), 1U);
  clients.set_replace(*client, pose, false);
  EXPECT_EQ(clients.take(*client).size(), 1U);
}

// --- Lockstep

class LockstepTest : public HostPartsTest {
 protected:
  std::shared_ptr<Client> join(ThreadId thread_id) {
    auto client = clients.add(6665, EventRole::kParticipant, {});
    lockstep.adopt(*client, thread_id);
    return client;
  }
  Lockstep lockstep{clients, /*gate=*/2, /*silence_limit_s=*/5.0, warn};
};

TEST_F(LockstepTest, Gate_OpensOnce) {
  const auto first = join(1);
  EXPECT_FALSE(lockstep.gate_open());
  EXPECT_EQ(lockstep.silence_limit(), WallClock::duration::max());
  lockstep.note_silence(WallClock::now() + seconds(6));
  EXPECT_THAT(warnings, ElementsAre("the start gate waits for 2 clients; 1 have joined so far"));
  const auto second = join(2);
  EXPECT_TRUE(lockstep.gate_open());
  clients.remove(*second);
  EXPECT_TRUE(lockstep.gate_open());
  EXPECT_EQ(lockstep.silence_limit(), seconds(5));
}

TEST_F(LockstepTest, Thread_WaitsIfOneOfItsClientsWaits) {
  const auto a = join(1);
  const auto b = join(1);
  const auto c = join(2);
  EXPECT_FALSE(lockstep.somebody_waits());
  a->waiting = true;
  EXPECT_FALSE(lockstep.all_wait()) << "the thread of c thinks";
  EXPECT_TRUE(lockstep.several_owners());
  c->waiting = true;
  EXPECT_TRUE(lockstep.all_wait());
  c->waiting = false;
  lockstep.forget(2);
  EXPECT_TRUE(lockstep.all_wait()) << "nobody waits for a thread that has ended";
}

TEST_F(LockstepTest, SilentClients_NotAwaited) {
  const auto waits = join(1);
  const auto thinks = join(2);
  ASSERT_TRUE(lockstep.gate_open());
  waits->waiting = true;
  EXPECT_EQ(lockstep.silence_deadline(thinks->seen() + seconds(1)), thinks->seen() + seconds(5));
  lockstep.note_silence(thinks->seen() + milliseconds(4999));
  EXPECT_FALSE(lockstep.silence_noted());
  lockstep.note_silence(thinks->seen() + seconds(5));
  EXPECT_TRUE(lockstep.silence_noted());
  EXPECT_TRUE(lockstep.all_wait());
  EXPECT_THAT(warnings,
              ElementsAre("client 2 (port 6665) has not called Read() for 5 s of wall time; "
                          "simulated time advances without it until it does"));
  lockstep.adopt(*thinks, 2);
  EXPECT_FALSE(lockstep.all_wait());
}

class DebuggedLockstepTest : public LockstepTest {
 protected:
  /// Two threads, one of which thinks for this time. @return its client.
  std::shared_ptr<Client> think() {
    debugged.adopt(*clients.add(6665, EventRole::kParticipant, {}), 1);
    auto thinking = clients.add(6666, EventRole::kParticipant, {});
    debugged.adopt(*thinking, 2);
    EXPECT_TRUE(debugged.gate_open());
    return thinking;
  }
  bool is_debugged = true;
  Lockstep debugged{clients, /*gate=*/2, /*silence_limit_s=*/5.0, warn,
                    [this](Client& /*client*/) { return is_debugged; }};
};

TEST_F(DebuggedLockstepTest, TimeUnderDebugger_DoesNotCount) {
  const auto thinking = think();
  const auto begin = thinking->seen();
  for (int minute = 1; minute <= 10; ++minute) debugged.note_silence(begin + minute * seconds(60));
  EXPECT_EQ(thinking->seen(), begin + seconds(600));
  // Looked for from half of the limit on, so that a debugger that leaves leaves at least the rest.
  EXPECT_EQ(debugged.silence_deadline(begin + seconds(601)), begin + milliseconds(602'500));
  is_debugged = false;
  debugged.note_silence(begin + milliseconds(602'500));
  EXPECT_EQ(debugged.silence_deadline(begin + seconds(603)), begin + seconds(605));
  debugged.note_silence(begin + milliseconds(604'999));
  EXPECT_FALSE(debugged.silence_noted());
  EXPECT_THAT(warnings, IsEmpty());
  debugged.note_silence(begin + seconds(605));
  EXPECT_TRUE(debugged.silence_noted());
}

TEST_F(DebuggedLockstepTest, StoppedProcess_LimitBeginsAnew) {
  const auto thinking = think();
  const auto begin = thinking->seen();
  is_debugged = false;  // the debugger has left before anybody looked
  debugged.note_silence(begin + seconds(600), begin + milliseconds(2500));
  EXPECT_FALSE(debugged.silence_noted());
  EXPECT_EQ(thinking->seen(), begin + seconds(600));
  debugged.note_silence(begin + seconds(605), begin + milliseconds(604'900));
  EXPECT_TRUE(debugged.silence_noted()) << "a tenth of a second late only";
}

TEST_F(DebuggedLockstepTest, ClosedGate_NoWarning) {
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  debugged.adopt(*client, 1);
  EXPECT_FALSE(debugged.gate_open());
  debugged.note_silence(WallClock::now() + seconds(6));
  EXPECT_THAT(warnings, IsEmpty());
  is_debugged = false;
  debugged.note_silence(WallClock::now() + seconds(12));
  EXPECT_THAT(warnings, SizeIs(1));
}

TEST_F(LockstepTest, TimeAdvancesForProgramsOnly) {
  const auto follower = clients.add(6665, EventRole::kFollower, {});
  lockstep.adopt(*follower, 1);
  EXPECT_FALSE(lockstep.program_takes_part());
  const auto program = join(2);
  EXPECT_TRUE(lockstep.program_takes_part());
  EXPECT_FALSE(lockstep.several_owners()) << "followers are Playpen's own";
}

// --- Pace

TEST(Pace, Steps_NeitherDriftNorCatchUp) {
  Pace pace(0.01, 2.0);  // a step takes 5 ms
  const Pace::Time t0{seconds(1000)};
  pace.begin_at(t0);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(pace.due(), t0 + i * milliseconds(5));
    pace.begin_step(t0 + i * milliseconds(5) + milliseconds(2));  // late by 2 ms each time
  }
  EXPECT_EQ(pace.due(), t0 + milliseconds(20));
  // 200 ms of lateness are caught up, more are not.
  pace.begin_step(t0 + milliseconds(220));
  EXPECT_EQ(pace.due(), t0 + milliseconds(25));
  pace.begin_step(t0 + milliseconds(226));
  EXPECT_EQ(pace.due(), t0 + milliseconds(226 + 10));
}

TEST(Pace, NewSpeed_CountsFromNewestStep) {
  Pace pace(0.01, 1.0);
  const Pace::Time t0{seconds(1000)};
  pace.begin_at(t0);
  pace.begin_step(pace.due());
  const int changes = pace.changes();
  pace.set_factor(0.5);
  EXPECT_NE(pace.changes(), changes);
  EXPECT_EQ(pace.due(), t0 + milliseconds(10) + milliseconds(20));
}

TEST(Pace, Limit_UsedUpStepByStep) {
  Pace pace(0.01, 1.0);
  pace.add_to_limit(3);
  EXPECT_FALSE(pace.limited()) << "there is none to add to";
  pace.set_limit(1);
  pace.add_to_limit(1);
  pace.count_step();
  EXPECT_FALSE(pace.step_limit_reached());
  pace.count_step();
  EXPECT_TRUE(pace.step_limit_reached());
  // A step that was waited for is run at once; one that is not due yet is not.
  const Pace::Time t0{seconds(1000)};
  pace.begin_at(t0);
  pace.skip_lost_time(t0 + milliseconds(4));
  EXPECT_EQ(pace.due(), t0 + milliseconds(10));
  pace.skip_lost_time(t0 + milliseconds(60));
  EXPECT_EQ(pace.due(), t0 + milliseconds(60));
}

// --- Inputs

using InputsTest = HostPartsTest;

TEST_F(InputsTest, RepeatedCommands_LastApplied) {
  Inputs inputs(simulation, describe_robots(simulation), warn);
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  const DeviceId motion = device(0, "motion");
  EXPECT_FALSE(inputs.add(*client, motion, sim::TwistCommand{{.v_mps = 0.1}}));
  EXPECT_FALSE(inputs.add(*client, motion, sim::TwistCommand{{.v_mps = 0.3}}));
  EXPECT_FALSE(inputs.add(*client, motion, sim::MotorEnableCommand{true}));
  EXPECT_FALSE(inputs.add(*client, motion, sim::TwistCommand{{.v_mps = 0.2}}));
  EXPECT_EQ(client->commands.size(), 3U);
  inputs.before_step(clients);
  EXPECT_TRUE(client->commands.empty());
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(InputsTest, RefusedCommands_Warn) {
  Inputs inputs(simulation, describe_robots(simulation), warn);
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  static_cast<void>(inputs.add(*client, pose, sim::TwistCommand{}));
  inputs.before_step(clients);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("pose")));
}

TEST_F(InputsTest, CommandQueue_Limited) {
  Inputs inputs(simulation, describe_robots(simulation), warn);
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  const DeviceId motion = device(0, "motion");
  int added = 0;
  bool full = false;
  while (!full) {
    full = inputs.add(*client, motion, sim::TwistCommand{}) ||
           inputs.add(*client, motion, sim::MotorEnableCommand{true});
    added += 2;
    ASSERT_LE(added, 4100);
  }
  inputs.apply(*client);
  EXPECT_TRUE(client->commands.empty());
}

TEST_F(InputsTest, ForeignLayers_DrawingsIgnored) {
  Inputs inputs(simulation, describe_robots(simulation), warn);
  const auto owner = clients.add(6665, EventRole::kParticipant, {});
  const auto other = clients.add(6666, EventRole::kParticipant, {});
  const sim::LayerId layer = inputs.registry.create(simulation.layers(), owner->number, owner->port,
                                                    sim::LayerKind::kBinary, {.name = "own"});
  inputs.reserve_drawings(*owner);
  inputs.reserve_drawings(*other);
  const auto pixel = [&](int column, std::uint32_t value) {
    sim::DrawOperation drawing;
    drawing.layer = layer;
    drawing.x0 = column;
    drawing.value.bits = value;
    return drawing;
  };
  ASSERT_TRUE(owner->drawings.push(pixel(1, 1)));
  ASSERT_TRUE(other->drawings.push(pixel(2, 1)));
  inputs.before_step(clients);
  EXPECT_EQ(simulation.layers().cell(layer, 1, 0)->bits, 1U);
  EXPECT_EQ(simulation.layers().cell(layer, 2, 0)->bits, 0U);
}

// --- Alarms

using AlarmsTest = HostPartsTest;

TEST_F(AlarmsTest, RingOnceInOrder) {
  Alarms alarms;
  std::string rung;
  const auto alarm = [&](char name, sim::SimTime until_ns) {
    return Alarm{until_ns, {}, false, [&rung, name] { rung += name; }};
  };
  alarms.set(alarm('a', sim::from_seconds(0.1)));
  alarms.set(alarm('b', sim::from_seconds(9.0)));
  const AlarmId c = alarms.set(alarm('c', 0));
  alarms.set(Alarm{std::nullopt, [](const sim::Simulation& all) { return all.steps() > 0; },
                   /*lets_time_pass=*/true, [&] { rung += 'd'; }});
  EXPECT_TRUE(alarms.cancel(c));
  EXPECT_FALSE(alarms.cancel(c));
  alarms.ring(simulation, false);
  EXPECT_EQ(rung, "");
  EXPECT_TRUE(alarms.let_time_pass());
  run(0.1);
  alarms.ring(simulation, false);
  EXPECT_EQ(rung, "ad");
  EXPECT_FALSE(alarms.let_time_pass());
  alarms.ring(simulation, true);  // the run is over
  EXPECT_EQ(rung, "adb");
}

// --- Standing time

using StandingTimeTest = HostPartsTest;

TEST_F(StandingTimeTest, CommandsOnly_ReportedOnce) {
  StalledTimeWarning standing(robots.size(), /*sleeps_count=*/true, 5.0, warn);
  EXPECT_TRUE(standing.note_needs_time());
  EXPECT_FALSE(standing.note_needs_time());
  const auto client = clients.add(6665, EventRole::kParticipant, {});
  int looks = 0;
  for (int i = 0; i < 100'000; ++i) {
    if (!standing.note_command(*client, 0)) continue;
    standing.check(*client, 0, /*may_advance=*/++looks == 1);
    ASSERT_TRUE(looks > 1 || warnings.empty());
  }
  EXPECT_GT(looks, 1);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("it does not call Read()"));
  EXPECT_THAT(warnings[0], HasSubstr(", or sleep"));
  standing.note_end();
  EXPECT_EQ(warnings.size(), 1U) << "it knows";
}

TEST_F(StandingTimeTest, EndBeforeFirstStep_Reported) {
  StalledTimeWarning standing(robots.size(), /*sleeps_count=*/false, 5.0, warn);
  standing.note_end();
  EXPECT_THAT(warnings, IsEmpty()) << "it has not wanted anything";
  static_cast<void>(standing.note_needs_time());
  standing.note_end();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("nothing was simulated"));
}

// --- Progress

TEST(Progress, ReportsRemainingTime) {
  TimeStatistics time;
  time.sim_time_ns = sim::from_seconds(2.5);
  time.real_time_factor = 100.0;
  EXPECT_EQ(Progress::line(time), "      2.5 s simulated, 100 x real time ");
  time.duration_s = 10.0;  // a quarter is done; 7.5 s at 100 times real time are 0.075 s
  EXPECT_EQ(
      Progress::line(time),
      "[#######.......................]     2.5 / 10 s simulated, 100 x real time, 1 s left ");
  time.duration_s = 2.0;
  EXPECT_THAT(Progress::line(time), HasSubstr("[##############################]"));
}

TEST(Progress, CountsFromFirstStep) {
  Progress progress;
  TimeStatistics time;
  time.sim_time_ns = sim::from_seconds(6.0);
  progress.add_times(time, true);
  EXPECT_EQ(time.wall_time_s, 0.0);
  const WallClock::time_point t0{seconds(1000)};
  EXPECT_TRUE(progress.note_step(t0));
  EXPECT_FALSE(progress.note_step(t0 + seconds(3)));
  progress.add_times(time, true);
  EXPECT_EQ(time.wall_time_s, 3.0);
  EXPECT_EQ(time.real_time_factor, 2.0);
}

// --- Results

using ResultsTest = HostPartsTest;

TEST_F(ResultsTest, Report_FollowsRunAndNamesEnd) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder / "out";
  const CommandBook commands(robots.size());
  Results results(
      settings, simulation,
      [this] {
        TimeStatistics time;
        time.sim_time_ns = simulation.now_ns();
        return time;
      },
      warn, commands);
  const auto report = [&] {
    std::ifstream in(settings.output_folder + "/report.json");
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const WallClock::time_point t0{seconds(1000)};
  results.keep(t0);
  EXPECT_EQ(report(), "") << "it is written once a second of wall time";
  simulation.step();
  results.observe();
  results.keep(t0 + seconds(1));
  EXPECT_THAT(report(), HasSubstr("\"ended\": null"));
  results.program_status = 3;
  sim::LayerCopy copy;
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  while (simulation.layers().copy_some(copy, kAll) != sim::LayerStack::CopyState::kComplete) {
    copy.allocate();
  }
  results.prepare(copy.take())();
  EXPECT_THAT(report(), HasSubstr("\"status\": 3"));
  EXPECT_TRUE(std::filesystem::exists(settings.output_folder + "/scene.png"));
  EXPECT_THAT(warnings, IsEmpty());
}

// --- The blackboard

SetBlackboardRequest change(const std::string& key, std::size_t bytes, std::uint8_t value = 0) {
  return {"g", key, 1, 2, std::vector<std::uint8_t>(bytes, value)};
}
std::vector<std::string> keys(const std::vector<BlackboardEntry>& entries) {
  std::vector<std::string> all;
  for (const BlackboardEntry& entry : entries) all.push_back(entry.key);
  return all;
}

TEST(BlackboardTest, Entries_OrderedByLastChange) {
  Blackboard board;
  board.set(change("a", 1), 5);
  board.set(change("b", 1), 6);
  board.set({"other", "a", 1, 2, {}}, 7);
  board.set(change("a", 2), 8);
  EXPECT_THAT(keys(board.find({})), ElementsAre("b", "a", "a"));
  EXPECT_THAT(keys(board.find({2, {}, {}})), ElementsAre("a", "a"));
  EXPECT_THAT(keys(board.find({0, "g", {}})), ElementsAre("b", "a"));
  EXPECT_THAT(keys(board.find({0, {}, "b"})), ElementsAre("b"));
  EXPECT_THAT(board.find({4, {}, {}}), IsEmpty());
  const BlackboardEntry entry = board.find({0, "g", "a"}).at(0);
  EXPECT_EQ(entry.time_ns, 8);
  EXPECT_EQ(entry.change, 4);
  EXPECT_EQ(entry.data.size(), 2U);
}

TEST(BlackboardTest, PendingChanges_VisibleToTheirThreadOnly) {
  constexpr ThreadId kOne = 7;
  constexpr ThreadId kTwo = 3;
  Blackboard board;
  board.set(change("old", 1), 0);
  board.set(change("a", 1, 1), 1, kOne);
  board.set(change("b", 1), 1, kOne);
  board.set(change("a", 1, 2), 2, kTwo);
  EXPECT_TRUE(board.has_waiting_changes());
  EXPECT_THAT(keys(board.find({}, kOne)), ElementsAre("old")) << "a list has published changes";
  EXPECT_EQ(board.find({0, "g", "a"}, kOne).at(0).data.at(0), 1);
  EXPECT_EQ(board.find({0, "g", "a"}, kOne).at(0).change, 1) << "that of the newest that all see";
  EXPECT_EQ(board.find({0, "g", "a"}, kTwo).at(0).data.at(0), 2);
  EXPECT_THAT(board.find({0, "g", "b"}, kTwo), IsEmpty());
  EXPECT_THAT(keys(board.find({0, "g", "b"})), ElementsAre("b")) << "a thread of no client";
  board.publish({kOne, kTwo, kOne});
  EXPECT_FALSE(board.has_waiting_changes());
  EXPECT_THAT(keys(board.find({}, kTwo)), ElementsAre("old", "b", "a"));
  EXPECT_EQ(board.find({0, "g", "a"}).at(0).data.at(0), 2) << "the last one in the order";
}

TEST(BlackboardTest, ThreadsWithoutClients_ChangesPublished) {
  Blackboard board;
  board.set(change("a", 1), 0, 9);
  board.set(change("b", 1), 0, 8);
  board.set(change("c", 1), 0, 5);
  board.publish({9});
  EXPECT_THAT(keys(board.find({})), ElementsAre("a", "c", "b"));
}

TEST(BlackboardTest, PendingChanges_ReserveRoom) {
  constexpr std::size_t kNameBytes = 2;
  Blackboard board;
  for (char c = 'a'; c < 'h'; ++c) board.set(change({c}, Blackboard::kMostData), 0);
  // There is room for one more entry, without its name.
  EXPECT_THROW(board.set(change("z", Blackboard::kMostData), 0, 1), SessionError);
  const std::size_t room = Blackboard::kMostData - 8 * kNameBytes;
  for (int i = 0; i < 3; ++i) board.set(change("z", room), 0, 1);  // replaces its own change
  EXPECT_THROW(board.set(change("y", 1), 0, 2), SessionError);
  board.set(change("z", 5), 0, 1);
  board.set(change("y", room - 5 - kNameBytes), 0, 2);
  EXPECT_THROW(board.set(change("x", 1), 0, 2), SessionError);
  board.set(change("a", Blackboard::kMostData), 0, 2);  // not larger than before
  board.publish({1, 2});
  EXPECT_EQ(board.find({}).size(), 9U);
  EXPECT_THROW(board.set(change("x", 1), 0), SessionError);
  board.set(change("y", 0), 0);
  board.set(change("x", 1), 0);
}

TEST(BlackboardTest, HoldsAtMost1024Entries) {
  Blackboard board;
  for (int i = 0; i < 1023; ++i) board.set(change(std::to_string(i), 1), 0);
  board.set(change("last", 1), 0, 1);
  EXPECT_THROW(board.set(change("more", 1), 0, 2), SessionError);
  board.set(change("0", 1), 0, 2);
  board.publish({});
  EXPECT_THROW(board.set(change("more", 1), 0), SessionError);
}

// The system gives an error when a process ends between the opening and the reading of its file,
// which happens in some of 100 listings here.
TEST(ProcessesTest, SomeEndMeanwhile_OthersAreListed) {
  std::atomic<bool> over{false};
  std::thread births([&over] {
    while (!over) {
      std::array<pid_t, 8> children{};
      for (pid_t& child : children) {
        child = fork();
        if (child == 0) _exit(0);
      }
      for (const pid_t child : children) waitpid(child, nullptr, 0);
    }
  });
  for (int i = 0; i < 300; ++i) {
    EXPECT_NO_THROW(EXPECT_EQ(living_processes().at(getpid()).parent, getppid()));
  }
  over = true;
  births.join();
}

}  // namespace
}  // namespace playerlike
