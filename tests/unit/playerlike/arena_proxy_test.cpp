// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Clients that command the arena and its controller, by ArenaProxy and SimulationProxy, over all
// transports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "player_errors.h"
#include "playerlike/host/run_settings.h"
#include "reachable_host.h"
#include "token_server.h"

namespace {

using namespace PlayerCc;
using CCMorse::ArenaEvent;
using CCMorse::ArenaProxy;
using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// The gate takes 0.5 s. Robot r1 stands on the seat and in both traps, robot r2 on the stool.
constexpr const char* kWorld = R"({
  "arena": {"size": [4, 2], "obstacles": [
    {"name": "gate", "center": [2, 1], "size": [0.1, 1], "height": 0.2, "type": "dynamic", "rise_speed": 0.4},
    {"name": "side", "center": [3, 0.4], "size": [0.2, 0.2], "type": "dynamic", "state": "retracted"},
    {"name": "seat", "center": [1, 1], "size": [0.2, 0.2], "type": "dynamic", "state": "retracted",
     "when_blocked": "wait"},
    {"name": "stool", "center": [3, 1], "size": [0.2, 0.2], "type": "dynamic", "state": "retracted"},
    {"name": "pillar", "center": [3.5, 1.5], "size": [0.2, 0.2]}]},
  "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 3, "y": 1}}],
  "controller": {
    "configurations": {
      "open": {"retracted": ["gate"]},
      "closed": {"extended": ["gate"], "retracted": ["side"]},
      "crowded": {"extended": ["stool", "side"]}},
    "timers": [
      {"name": "tick", "every": 0.5, "enabled": false,
       "do": [{"score": {"robot": "r1", "points": 2}}, {"message": "tick"}]},
      {"name": "fast", "every": 0.001, "enabled": false}],
    "traps": [
      {"name": "home", "region": {"circle": {"center": [1, 1], "radius": 0.3}}, "enabled": false,
       "do": [{"message": "at home"}]},
      {"name": "goal", "region": {"circle": {"center": [1, 1], "radius": 0.3}}, "enabled": false,
       "do": [{"end": {"verdict": "passed", "reason": "r1 is there"}}]}]}})";

constexpr const char* kPlainWorld = R"({
  "arena": {"size": [4, 2], "obstacles": [
    {"name": "d", "center": [3, 0.5], "size": [0.2, 0.2], "type": "dynamic"}]},
  "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}]})";

/// "TIME KIND WHAT WHO TEXT" of each event, without empty parts.
std::vector<std::string> lines_of(const std::vector<ArenaEvent>& events) {
  std::vector<std::string> lines;
  for (const ArenaEvent& event : events) {
    std::ostringstream line;
    line << event.time << ' ' << event.kind;
    for (const std::string& part : {event.what, event.who, event.text}) {
      if (!part.empty()) line << ' ' << part;
    }
    lines.push_back(line.str());
  }
  return lines;
}

class Arena : public testing::TestWithParam<test::Transport> {
 protected:
  explicit Arena(const char* world = kWorld)
      : host_(playerlike::Host::create(sim::load_world_text(world)), GetParam()) {}

  [[nodiscard]] std::unique_ptr<PlayerClient> connect() const {
    return std::make_unique<PlayerClient>(host_.connect(6665));
  }
  /// Lets time pass; a read without devices takes 0.1 s.
  void pass(int tenths) {
    for (int i = 0; i < tenths; ++i) client_->Read();
  }

  test::ReachableHost host_;
  std::unique_ptr<PlayerClient> client_ = connect();
  ArenaProxy arena_{client_.get()};
};
class PlainArena : public Arena {
 protected:
  PlainArena() : Arena(kPlainWorld) {}
};

const auto kTransports =
    testing::Values(test::Transport::kInProcess, test::Transport::kCbor, test::Transport::kJson);
const auto kTransportName = [](const auto& instance) { return transport_name(instance.param); };
INSTANTIATE_TEST_SUITE_P(Transports, Arena, kTransports, kTransportName);
INSTANTIATE_TEST_SUITE_P(Transports, PlainArena, kTransports, kTransportName);

TEST_P(Arena, ListsParts) {
  EXPECT_EQ(arena_.GetConfigurationCount(), 3U);
  EXPECT_THAT(arena_.GetConfigurationNames(), ElementsAre("open", "closed", "crowded"));
  EXPECT_EQ(arena_.GetConfigurationName(1), "closed");
  EXPECT_EQ(arena_.GetConfiguration(), "");
  EXPECT_THAT(arena_.GetBlockNames(), ElementsAre("gate", "side", "seat", "stool"));
  EXPECT_EQ(arena_.GetBlockState("gate"), "extended");
  EXPECT_EQ(arena_.GetBlockHeight("gate"), 0.2);
  EXPECT_EQ(arena_.GetBlockState("side"), "retracted");
  EXPECT_EQ(arena_.GetBlockHeight("side"), 0.0);
  EXPECT_THAT(arena_.GetTimerNames(), ElementsAre("tick", "fast"));
  EXPECT_FALSE(arena_.IsTimerEnabled("tick"));
  EXPECT_LT(arena_.GetTimeLeft("tick"), 0.0);
  EXPECT_THAT(arena_.GetTrapNames(), ElementsAre("home", "goal"));
  EXPECT_FALSE(arena_.IsTrapEnabled("home"));
  EXPECT_EQ(arena_.GetActCount("tick"), 0U);
  EXPECT_EQ(arena_.GetActCount("home"), 0U);
  EXPECT_EQ(arena_.GetScore("r2"), 0.0);
  EXPECT_FALSE(arena_.HasVerdict());
  EXPECT_EQ(error_of([&] { arena_.GetVerdict(); }).GetErrorCode(), PlayerError::kNotAvailable);
  EXPECT_THAT(arena_.GetEvents(), IsEmpty());
  EXPECT_EQ(host_.time().steps, 0U) << "questions take no simulated time";
}

TEST_P(Arena, Configuration_Changes) {
  arena_.SetConfiguration("open");
  EXPECT_EQ(arena_.GetConfiguration(), "open");
  EXPECT_EQ(arena_.GetBlockState("gate"), "sinking");
  EXPECT_EQ(host_.time().steps, 0U);
  pass(3);
  EXPECT_NEAR(arena_.GetBlockHeight("gate"), 0.2 - 0.3 * 0.4, 1e-9);
  pass(3);
  EXPECT_EQ(arena_.GetBlockState("gate"), "retracted");
  EXPECT_EQ(arena_.GetBlockHeight("gate"), 0.0);
  std::vector<ArenaEvent> events = arena_.GetEvents();
  EXPECT_THAT(lines_of(events),
              ElementsAre("0 configuration open", "0 sinking gate", "0.5 retracted gate"));
  EXPECT_EQ(events.front().number, 1U);
  EXPECT_EQ(events.back().number, 3U);
  EXPECT_THAT(arena_.GetEvents(), IsEmpty()) << "only those since the last look";
  arena_.SetConfiguration("closed");
  EXPECT_EQ(arena_.GetBlockState("gate"), "rising");
  EXPECT_THAT(lines_of(arena_.GetEvents()),
              ElementsAre("0.6 configuration closed", "0.6 rising gate"));
  EXPECT_THAT(ArenaProxy(client_.get()).GetEvents(), SizeIs(5)) << "each proxy looks for itself";
  // The other blocks change nevertheless.
  const PlayerError error = error_of([&] { arena_.SetConfiguration("crowded"); });
  EXPECT_EQ(error.GetErrorCode(), PlayerError::kBadArgument);
  EXPECT_THAT(error.GetErrorStr(), AllOf(HasSubstr("stool"), HasSubstr("a robot stands on it")));
  EXPECT_EQ(arena_.GetBlockState("side"), "extended");
  EXPECT_EQ(arena_.GetConfiguration(), "crowded");
}

TEST_P(Arena, SingleBlocks_Move) {
  arena_.ExtendBlock("side");
  EXPECT_EQ(arena_.GetBlockState("side"), "extended");
  arena_.RetractBlock("side");
  EXPECT_EQ(arena_.GetBlockState("side"), "retracted");
  arena_.ExtendBlock("seat");
  EXPECT_EQ(arena_.GetBlockState("seat"), "waiting");
  EXPECT_EQ(arena_.GetBlockHeight("seat"), 0.0);
  SimulationProxy(client_.get(), 0).SetPose2d("r1", 1.0, 1.5, 0.0);
  pass(1);
  EXPECT_EQ(arena_.GetBlockState("seat"), "extended");
  const PlayerError error = error_of([&] { arena_.ExtendBlock("stool"); });
  EXPECT_EQ(error.GetErrorFun(), "ArenaProxy::ExtendBlock");
  EXPECT_EQ(error.GetErrorCode(), PlayerError::kBadArgument);
  EXPECT_THAT(error.GetErrorStr(), HasSubstr("a robot stands on it"));
  EXPECT_EQ(arena_.GetBlockState("stool"), "retracted");
  EXPECT_THAT(lines_of(arena_.GetEvents()),
              ElementsAre("0 extended side", "0 retracted side", HasSubstr("0 waiting seat r1"),
                          "0.01 extended seat", HasSubstr("0.1 refused stool r2")));
}

TEST_P(Arena, TimersAndTraps_Switched) {
  arena_.EnableTimer("tick");
  EXPECT_TRUE(arena_.IsTimerEnabled("tick"));
  EXPECT_NEAR(arena_.GetTimeLeft("tick"), 0.5, 1e-9);
  pass(12);
  EXPECT_EQ(arena_.GetActCount("tick"), 2U);
  EXPECT_EQ(arena_.GetScore("r1"), 4.0);
  EXPECT_NEAR(arena_.GetTimeLeft("tick"), 0.3, 1e-9);
  arena_.DisableTimer("tick");
  EXPECT_FALSE(arena_.IsTimerEnabled("tick"));
  pass(5);
  EXPECT_EQ(arena_.GetActCount("tick"), 2U);
  EXPECT_LT(arena_.GetTimeLeft("tick"), 0.0);
  EXPECT_THAT(arena_.GetEvents(), SizeIs(2 + 2 * 3));

  arena_.EnableTrap("home");
  EXPECT_TRUE(arena_.IsTrapEnabled("home"));
  pass(1);
  EXPECT_EQ(arena_.GetActCount("home"), 1U);
  arena_.DisableTrap("home");
  EXPECT_FALSE(arena_.IsTrapEnabled("home"));
  EXPECT_THAT(lines_of(arena_.GetEvents()),
              ElementsAre("1.7 enabled home", "1.71 trap home r1 enter",
                          "1.71 message home at home", "1.8 disabled home"));
}

TEST_P(Arena, Verdict_ReadAfterRun) {
  arena_.EnableTrap("goal");
  EXPECT_EQ(error_of([&] { pass(100); }).GetErrorCode(), PlayerError::kRunIsOver);
  ASSERT_TRUE(arena_.HasVerdict());
  EXPECT_TRUE(arena_.GetVerdict().passed);
  EXPECT_EQ(arena_.GetVerdict().reason, "r1 is there");
  EXPECT_EQ(arena_.GetVerdict().time, 0.0) << "traps spring before the first step";
  EXPECT_EQ(arena_.GetEvents().back().kind, "end");
}

TEST_P(Arena, UnknownNames_Refused) {
  const auto refused = [](const char* function, const char* part, auto action) {
    const PlayerError error = error_of(action);
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kBadArgument) << function;
    EXPECT_EQ(error.GetErrorFun(), std::string("ArenaProxy::") + function);
    EXPECT_THAT(error.GetErrorStr(), HasSubstr(part)) << function;
  };
  refused("SetConfiguration",
          "there is no configuration named \"opne\"; did you mean \"open\"? this world has: open, "
          "closed, crowded",
          [&] { arena_.SetConfiguration("opne"); });
  refused("GetConfigurationName", "there is no configuration 3; this world has 3",
          [&] { arena_.GetConfigurationName(3); });
  const char* gate = "there is no dynamic block named \"gaet\"; did you mean \"gate\"?";
  refused("ExtendBlock", gate, [&] { arena_.ExtendBlock("gaet"); });
  refused("RetractBlock", gate, [&] { arena_.RetractBlock("gaet"); });
  refused("GetBlockState", gate, [&] { arena_.GetBlockState("gaet"); });
  refused("GetBlockHeight", gate, [&] { arena_.GetBlockHeight("gaet"); });
  refused("RetractBlock", "static", [&] { arena_.RetractBlock("pillar"); });
  refused("GetBlockState", "\"pillar\"", [&] { arena_.GetBlockState("pillar"); });
  const char* tick = "there is no timer named \"tik\"; did you mean \"tick\"?";
  refused("EnableTimer", tick, [&] { arena_.EnableTimer("tik"); });
  refused("DisableTimer", tick, [&] { arena_.DisableTimer("tik"); });
  refused("IsTimerEnabled", tick, [&] { arena_.IsTimerEnabled("tik"); });
  refused("GetTimeLeft", tick, [&] { arena_.GetTimeLeft("tik"); });
  refused("EnableTimer", "there is no timer named \"home\"; this world has: tick, fast",
          [&] { arena_.EnableTimer("home"); });
  const char* home = "there is no trap named \"hone\"; did you mean \"home\"?";
  refused("EnableTrap", home, [&] { arena_.EnableTrap("hone"); });
  refused("DisableTrap", home, [&] { arena_.DisableTrap("hone"); });
  refused("IsTrapEnabled", home, [&] { arena_.IsTrapEnabled("hone"); });
  refused("GetActCount", "there is no timer or trap named \"hone\"; did you mean \"home\"?",
          [&] { arena_.GetActCount("hone"); });
  refused("GetScore", "there is no robot named \"x\"; this world has: r1, r2",
          [&] { arena_.GetScore("x"); });
  EXPECT_THAT(arena_.GetEvents(), IsEmpty());
}

TEST_P(Arena, DroppedEvents_Counted) {
  arena_.EnableTimer("fast");
  pass(15);
  const std::vector<ArenaEvent> events = arena_.GetEvents();
  ASSERT_THAT(events, SizeIs(1024));
  EXPECT_GT(events.front().number, 400U);
  EXPECT_EQ(arena_.GetLostEventCount(), events.front().number - 1);
  pass(1);
  EXPECT_EQ(arena_.GetEvents().front().number, events.back().number + 1);
  EXPECT_EQ(arena_.GetLostEventCount(), events.front().number - 1);
}

TEST_P(Arena, Event_DeliveredToOneThread) {
  arena_.EnableTimer("fast");
  pass(5);
  std::vector<std::vector<ArenaEvent>> parts(4);
  std::vector<std::thread> threads;
  for (auto& part : parts) {
    threads.emplace_back([&] {
      for (int i = 0; i < 10; ++i) {
        for (const ArenaEvent& event : arena_.GetEvents()) part.push_back(event);
        if (i == 0) arena_.RetractBlock("side");
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::size_t count = arena_.GetEvents().size();
  for (const auto& part : parts) count += part.size();
  EXPECT_EQ(count, ArenaProxy(client_.get()).GetEvents().size());
}

TEST_P(Arena, MorseClients_ServedAndOutlived) {
  auto morse = std::make_unique<CCMorse::MorseClient>(host_.connect(4000));
  ArenaProxy arena(*morse);
  arena.SetConfiguration("open");
  EXPECT_EQ(arena_.GetConfiguration(), "open") << "all clients share the arena";
  std::ostringstream text;
  text << arena;
  EXPECT_THAT(text.str(), AllOf(HasSubstr("#arena open"), HasSubstr("gate\tsinking\t0.2"),
                                HasSubstr("tick\t0\t0"), HasSubstr("home\t0\t0")));
  std::ostringstream event;
  event << arena.GetEvents().front();
  EXPECT_EQ(event.str(), "1\t0\tconfiguration\topen\t\t\t0");
  morse.reset();
  EXPECT_EQ(error_of([&] { arena.GetEvents(); }).GetErrorCode(), PlayerError::kDisconnected);
  EXPECT_EQ(error_of([&] { arena.SetConfiguration("open"); }).GetErrorCode(),
            PlayerError::kDisconnected);
  const auto none = [] { const ArenaProxy nobodys(static_cast<PlayerClient*>(nullptr)); };
  EXPECT_EQ(error_of(none).GetErrorCode(), PlayerError::kBadArgument);
}

// A restored state has the configuration of that state; events continue.
TEST_P(Arena, RestoredWorld_RestoresArena) {
  SimulationProxy simulation(client_.get(), 0);
  arena_.SetConfiguration("open");
  pass(1);
  simulation.SaveState("s");
  arena_.SetConfiguration("closed");
  arena_.EnableTimer("tick");
  pass(1);
  simulation.RestoreState("s");
  EXPECT_EQ(arena_.GetConfiguration(), "open");
  EXPECT_EQ(arena_.GetBlockState("gate"), "sinking");
  EXPECT_NEAR(arena_.GetBlockHeight("gate"), 0.16, 1e-9);
  EXPECT_FALSE(arena_.IsTimerEnabled("tick"));
  EXPECT_EQ(arena_.GetEvents().back().kind, "reset");
}

TEST_P(PlainArena, HasBlocksOnly) {
  EXPECT_EQ(arena_.GetConfigurationCount(), 0U);
  EXPECT_THAT(arena_.GetTimerNames(), IsEmpty());
  EXPECT_THAT(arena_.GetTrapNames(), IsEmpty());
  arena_.RetractBlock("d");
  EXPECT_EQ(arena_.GetBlockState("d"), "retracted");
  EXPECT_EQ(arena_.GetScore("r1"), 0.0);
  EXPECT_FALSE(arena_.HasVerdict());
  EXPECT_THAT(arena_.GetEvents(), IsEmpty());
  const auto refusal = [](auto action) { return error_of(action).GetErrorStr(); };
  EXPECT_THAT(refusal([&] { arena_.SetConfiguration("open"); }),
              HasSubstr("there is no configuration named \"open\"; this world has none"));
  EXPECT_THAT(refusal([&] { arena_.EnableTimer("t"); }), HasSubstr("this world has none"));
  EXPECT_THAT(refusal([&] { arena_.DisableTrap("t"); }), HasSubstr("this world has none"));
}

// --- Where changes are not allowed

std::string with_simulation(const std::string& settings) {
  return R"({"simulation": {)" + settings + "}, " + std::string(kWorld).substr(1);
}

class ClosedArena : public testing::TestWithParam<test::Transport> {};
INSTANTIATE_TEST_SUITE_P(Transports, ClosedArena, kTransports, kTransportName);

/// Expects kNotAvailable with this text from all changes.
void expect_no_change(ArenaProxy& arena, const char* part) {
  const auto refused = [part](auto action) {
    const PlayerError error = error_of(action);
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kNotAvailable) << error;
    EXPECT_THAT(error.GetErrorStr(), HasSubstr(part));
  };
  refused([&] { arena.SetConfiguration("open"); });
  refused([&] { arena.ExtendBlock("side"); });
  refused([&] { arena.RetractBlock("gate"); });
  refused([&] { arena.EnableTimer("tick"); });
  refused([&] { arena.DisableTimer("tick"); });
  refused([&] { arena.EnableTrap("home"); });
  refused([&] { arena.DisableTrap("home"); });
}

TEST_P(ClosedArena, LockedWorld_ReadOnly) {
  const test::ReachableHost host(
      playerlike::Host::create(sim::load_world_text(with_simulation(R"("lock_objects": true)"))),
      GetParam());
  PlayerClient client(host.connect(6665));
  ArenaProxy arena(&client);
  expect_no_change(arena, "lock_objects");
  EXPECT_EQ(arena.GetBlockState("gate"), "extended");
  EXPECT_FALSE(arena.IsTimerEnabled("tick"));
  EXPECT_THAT(arena.GetEvents(), IsEmpty());
  SimulationProxy simulation(&client, 0);
  testing::internal::CaptureStderr();
  simulation.SetProperty("arena", "configuration", "open", 5);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("lock_objects"));
  EXPECT_EQ(arena.GetConfiguration(), "");
}

// Events and waiting blocks would tell where the other robots are.
TEST_P(ClosedArena, PrivateWorld_Hidden) {
  const test::ReachableHost host(
      playerlike::Host::create(sim::load_world_text(with_simulation(R"("privacy": "own")"))),
      GetParam());
  PlayerClient client(host.connect(6665));
  ArenaProxy arena(&client);
  expect_no_change(arena, "privacy");
  for (const auto& action : std::vector<std::function<void()>>{
           [&] { arena.GetEvents(); }, [&] { arena.GetBlockState("gate"); },
           [&] { arena.GetScore("r2"); }, [&] { arena.HasVerdict(); }}) {
    EXPECT_EQ(error_of(action).GetErrorCode(), PlayerError::kNotAvailable);
  }
}

TEST(ArenaOfAServer, Changes_NeedTokensOfAllRobots) {
  const test::TokenServer server(kWorld);
  const auto some = server.client(test::TokenServer::kServerToken);
  ArenaProxy arena(some.get());
  expect_no_change(arena, "all robots");
  EXPECT_EQ(arena.GetBlockState("gate"), "extended");
  EXPECT_THAT(arena.GetEvents(), IsEmpty());
  const auto all = server.client(test::TokenServer::kBothTokens);
  ArenaProxy(all.get()).SetConfiguration("open");
  EXPECT_EQ(arena.GetConfiguration(), "open");
  EXPECT_EQ(arena.GetEvents().front().what, "open");
}

// --- SimulationProxy

TEST_P(Arena, Properties_MatchSimulationProxy) {
  SimulationProxy simulation(client_.get(), 0);
  char text[64] = {};
  const auto property = [&](const char* object, const char* name) -> std::string {
    simulation.GetProperty(object, name, text, sizeof text);
    return text;
  };
  EXPECT_EQ(property("arena", "kind"), "arena");
  EXPECT_EQ(property("arena", "configurations"), "open, closed, crowded");
  EXPECT_EQ(property("arena", "configuration"), "");
  EXPECT_EQ(property("arena", "event"), "");
  EXPECT_EQ(property("arena", "verdict"), "");
  EXPECT_EQ(property("gate", "phase"), "extended");
  EXPECT_EQ(property("pillar", "phase"), "extended");
  simulation.SetProperty("arena", "configuration", "open", 5);
  EXPECT_EQ(property("arena", "configuration"), "open");
  EXPECT_EQ(property("arena", "event"), "block gate is sinking");
  std::int32_t events = 0;
  simulation.GetProperty("arena", "events", &events, sizeof events);
  EXPECT_EQ(events, 2);
  pass(3);
  EXPECT_EQ(property("gate", "phase"), "sinking");
  EXPECT_EQ(property("gate", "state"), "extended") << "robots cannot enter its place";
  double height = 0.0;
  simulation.GetProperty("gate", "height", &height, sizeof height);
  EXPECT_NEAR(height, 0.08, 1e-9);
  pass(3);
  EXPECT_EQ(property("gate", "state"), "retracted");
  simulation.GetProperty("pillar", "height", &height, sizeof height);
  EXPECT_EQ(height, 0.16);
  arena_.EnableTrap("goal");
  EXPECT_EQ(error_of([&] { pass(100); }).GetErrorCode(), PlayerError::kRunIsOver);
  ArenaProxy after(client_.get());
  EXPECT_TRUE(after.HasVerdict());
}

TEST_P(Arena, UnknownProperty_Warns) {
  SimulationProxy simulation(client_.get(), 0);
  char value[64] = {};
  const auto warning_of = [](auto action) {
    testing::internal::CaptureStderr();
    EXPECT_NO_THROW(action());
    return testing::internal::GetCapturedStderr();
  };
  const auto get = [&](const char* object, const char* property, std::size_t length) {
    return warning_of([&] { simulation.GetProperty(object, property, value, length); });
  };
  EXPECT_THAT(get("arena", "pose", 24),
              HasSubstr("the arena has no property \"pose\"; it has: configuration, "
                        "configurations, event, events, kind, verdict"));
  EXPECT_THAT(get("gate", "height", 4), HasSubstr("a double (8 bytes)"));
  EXPECT_THAT(get("arena", "configurations", 4), HasSubstr("needs 22 bytes"));
  const auto set = [&](const char* object, const char* property, const std::string& text) {
    return warning_of(
        [&] { simulation.SetProperty(object, property, text.c_str(), text.size() + 1); });
  };
  EXPECT_THAT(set("arena", "configuration", "opne"), HasSubstr("did you mean \"open\"?"));
  EXPECT_THAT(set("arena", "verdict", "passed"), HasSubstr("of the arena cannot be changed"));
  EXPECT_THAT(set("gate", "phase", "rising"), HasSubstr("cannot be changed"));
  EXPECT_THAT(warning_of([&] { simulation.SetPose2d("arena", 1.0, 1.0, 0.0); }),
              HasSubstr("there is no robot or obstacle named \"arena\""));
  EXPECT_EQ(arena_.GetConfiguration(), "");
}

// Worlds may have an obstacle of this name.
TEST(ArenaProperties, ObstacleOfSameName_HasProperties) {
  const auto host = playerlike::Host::create(sim::load_world_text(R"({
      "arena": {"size": [4, 2], "obstacles": [{"name": "arena", "center": [3, 1], "size": [0.2, 0.2]}]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}]})"));
  PlayerClient client(host->connect(6665));
  SimulationProxy simulation(&client, 0);
  char kind[16] = {};
  simulation.GetProperty("arena", "kind", kind, sizeof kind);
  EXPECT_STREQ(kind, "block");
}

}  // namespace
