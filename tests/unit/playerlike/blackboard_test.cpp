// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The blackboard that all clients of a host share: BlackBoardProxy, and the C library's functions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>
#include <libplayerc/playerc.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "player_errors.h"
#include "playerlike/host/host.h"
#include "reachable_host.h"
#include "sim/simulation/simulation.h"

namespace {

using PlayerCc::BlackBoardProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using test::error_code_of;
using test::Transport;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kWorld = R"({"arena": {"size": [4, 4]}, "robots": [
  {"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 3, "y": 3}}]})";

/// An entry that the library has handed out.
struct Freed {
  void operator()(player_blackboard_entry_t* entry) const {
    for (void* part : {static_cast<void*>(entry->key), static_cast<void*>(entry->group),
                       static_cast<void*>(entry->data), static_cast<void*>(entry)}) {
      std::free(part);
    }
  }
};
using Entry = std::unique_ptr<player_blackboard_entry_t, Freed>;

std::string text_of(const player_blackboard_entry_t& entry) {
  return std::string(entry.group) + '/' + entry.key + '=' +
         std::string(reinterpret_cast<const char*>(entry.data), entry.data_count);
}

void set(BlackBoardProxy& board, std::string group, std::string key, std::string value,
         uint16_t type = 1) {
  player_blackboard_entry_t entry = {};
  entry.group = group.data();
  entry.key = key.data();
  entry.type = type;
  entry.subtype = 7;
  entry.data = reinterpret_cast<uint8_t*>(value.data());
  entry.data_count = static_cast<uint32_t>(value.size());
  board.SetEntry(entry);
}

std::vector<std::string> heard;
void hear(playerc_blackboard_t* none, player_blackboard_entry_t entry) {
  EXPECT_EQ(none, nullptr);
  heard.push_back(text_of(entry));
}

struct Blackboard : testing::TestWithParam<Transport> {
  Blackboard()
      : host(playerlike::Host::create(sim::load_world_text(kWorld)), GetParam()),
        first(host.connect(6665)),
        second(host.connect(6666)) {
    heard.clear();
  }

  test::ReachableHost host;
  PlayerClient first;
  PlayerClient second;
};

INSTANTIATE_TEST_SUITE_P(Transports, Blackboard,
                         testing::Values(Transport::kInProcess, Transport::kCbor, Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(Blackboard, Entry_VisibleToOtherClients) {
  BlackBoardProxy one(&first, 0);
  BlackBoardProxy two(&second, 0);
  EXPECT_EQ(one.GetInterfaceStr(), "blackboard");
  EXPECT_EQ(one.HasCapability(PLAYER_MSGTYPE_DATA, PLAYER_BLACKBOARD_DATA_UPDATE), 1);
  const Entry none(two.GetEntry("k", "g"));
  EXPECT_EQ(text_of(*none), "/=") << "as in Player, an entry that was never set has no name";
  EXPECT_EQ(none->type, 0);
  const Entry named(two.SubscribeToKey("k", "g"));
  EXPECT_EQ(text_of(*named), "g/k=");
  set(one, "g", "k", std::string("a\0\xff", 3), 2);
  set(one, "", "k", "other group");
  const Entry found(two.GetEntry("k", "g"));
  EXPECT_EQ(text_of(*found), "g/k=" + std::string("a\0\xff", 3));
  EXPECT_EQ(found->type, 2);
  EXPECT_EQ(found->subtype, 7);
  EXPECT_EQ(found->key_count, 2U);
  EXPECT_EQ(text_of(*Entry(one.GetEntry("k", ""))), "/k=other group");
}

TEST_P(Blackboard, SubscribedChanges_Reported) {
  BlackBoardProxy one(&first, 0);
  BlackBoardProxy two(&second, 0);
  Position2dProxy position(&second, 0);
  two.SetEventHandler(hear);
  set(one, "g", "before", "0");
  const Entry now(two.SubscribeToKey("before", "g"));
  EXPECT_EQ(text_of(*now), "g/before=0");
  two.SubscribeToGroup("team");
  set(one, "g", "unheard", "1");
  set(one, "team", "a", "2");
  set(one, "g", "before", "3");
  set(one, "team", "a", "4");  // only the newest value is reported
  EXPECT_TRUE(heard.empty());
  second.Read();
  EXPECT_THAT(heard, ElementsAre("g/before=3", "team/a=4"));
  EXPECT_TRUE(two.IsFresh());
  two.NotFresh();
  second.Read();
  EXPECT_EQ(heard.size(), 2U);
  EXPECT_FALSE(two.IsFresh());
  two.UnsubscribeFromKey("before", "g");
  set(two, "g", "before", "5");
  set(two, "team", "b", "6");  // its own changes are reported, too
  second.Read();
  EXPECT_EQ(heard.back(), "team/b=6");
  EXPECT_EQ(heard.size(), 3U);
  two.UnsubscribeFromGroup("team");
  two.UnsubscribeFromGroup("team");
  set(one, "team", "b", "7");
  second.Read();
  EXPECT_EQ(heard.size(), 3U);
}

TEST_P(Blackboard, Groups_ReportEntriesWithTime) {
  BlackBoardProxy one(&first, 0);
  Position2dProxy position(&first, 0);
  for (int i = 0; i < 5; ++i) first.Read();
  const double now_s = position.GetDataTime();
  set(one, "team", "a", "1");
  one.SetEventHandler(hear);
  one.SubscribeToGroup("team");
  first.Read();
  EXPECT_THAT(heard, ElementsAre("team/a=1"));
  const Entry entry(one.GetEntry("a", "team"));
  EXPECT_NEAR(entry->timestamp_sec + 1e-6 * entry->timestamp_usec, now_s, 1e-6);
  EXPECT_NEAR(one.GetDataTime(), now_s, 1e-6);
}

TEST_P(Blackboard, ProgramWithoutSensors_Works) {
  BlackBoardProxy one(&first, 0);
  one.SetEventHandler(hear);
  one.SubscribeToGroup("");
  set(one, "", "a", "1");
  first.Read();
  EXPECT_THAT(heard, ElementsAre("/a=1"));
}

TEST_P(Blackboard, NullPointersAndLongValues_Refused) {
  BlackBoardProxy one(&first, 0);
  const auto code = [&](auto action) { return error_code_of(action); };
  EXPECT_EQ(code([&] { one.GetEntry(nullptr, ""); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { one.SubscribeToGroup(nullptr); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { one.SetEntry({}); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { set(one, "", "", "x"); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { set(one, "", "a\nb", "x"); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { set(one, "", std::string(256, 'k'), "x"); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { set(one, "", "k", std::string(65537, 'x')); }), PlayerError::kBadArgument);
  set(one, "", "k", std::string(65536, 'x'));
  for (int i = 1; i < 7; ++i) set(one, "", std::to_string(i), std::string(65536, 'x'));
  const PlayerError error = test::error_of([&] { set(one, "", "last", std::string(65536, 'x')); });
  EXPECT_EQ(error.GetErrorCode(), PlayerError::kNotAvailable);
  EXPECT_THAT(error.GetErrorStr(), HasSubstr("the blackboard is full"));
  set(one, "", "k", "x");  // a shorter value makes room
  set(one, "", "last", std::string(65000, 'x'));
}

TEST_P(Blackboard, FullBlackboard_Delivered) {
  BlackBoardProxy one(&first, 0);
  BlackBoardProxy two(&second, 0);
  for (int i = 0; i < 1024; ++i) set(one, "", std::to_string(i), std::string(500, 'x'));
  EXPECT_EQ(error_code_of([&] { set(one, "", "more", ""); }), PlayerError::kNotAvailable);
  std::size_t bytes = 0;
  int count = 0;
  two.SetEventFunction([&](const player_blackboard_entry_t& entry) {
    bytes += entry.data_count;
    ++count;
  });
  two.SubscribeToGroup("");
  second.Read();
  EXPECT_EQ(count, 1024);
  EXPECT_EQ(bytes, 1024U * 500U);
}

TEST_P(Blackboard, RestoredState_KeepsEntries) {
  BlackBoardProxy one(&first, 0);
  PlayerCc::SimulationProxy simulation(&first, 0);
  simulation.SaveState("before");
  set(one, "g", "k", "1");
  simulation.RestoreState("before");
  EXPECT_EQ(text_of(*Entry(one.GetEntry("k", "g"))), "g/k=1");
}

TEST_P(Blackboard, Handler_MayDeleteProxy) {
  BlackBoardProxy one(&first, 0);
  auto two = std::make_unique<BlackBoardProxy>(&second, 0);
  int count = 0;
  two->SetEventFunction([&](const player_blackboard_entry_t&) {
    ++count;
    two.reset();
  });
  two->SubscribeToGroup("g");
  set(one, "g", "a", "1");
  set(one, "g", "b", "2");
  second.Read();
  EXPECT_EQ(count, 1);
  second.Read();
}

TEST_P(Blackboard, BackgroundThread_GetsChanges) {
  BlackBoardProxy one(&first, 0);
  BlackBoardProxy two(&second, 0);
  std::promise<std::string> reported;
  two.SetEventFunction([&](const player_blackboard_entry_t& entry) {
    if (std::string(entry.key) == "last") reported.set_value(text_of(entry));
  });
  two.SubscribeToGroup("g");
  second.StartThread();
  for (int i = 0; i < 100; ++i) {
    set(one, "g", std::to_string(i), "x");
    EXPECT_EQ(two.GetInterfaceStr(), "blackboard");
  }
  set(one, "g", "last", "y");
  EXPECT_EQ(reported.get_future().get(), "g/last=y");
  second.StopThread();
}

/// A program that sets its own entry and one that all programs share, and reads another's entry.
struct Program {
  static constexpr int kRounds = 50;

  explicit Program(std::unique_ptr<playerlike::Session> session)
      : client(std::move(session)), position(&client, 0), board(&client, 0) {}

  void run(const std::string& own, const std::string& other) {
    std::string event = "none";
    board.SetEventFunction([&](const player_blackboard_entry_t& entry) {
      if (entry.key == other) event = text_of(entry);
    });
    board.SubscribeToGroup("");
    const auto value = [&](const std::string& key) {
      return text_of(*Entry(board.GetEntry(key.c_str(), "")));
    };
    for (int i = 0; i < kRounds; ++i) {
      client.Read();
      rounds.push_back(event + ' ' + value(other) + ' ' + value("shared"));
      set(board, "", own, std::to_string(i));
      set(board, "", "shared", own);
      rounds.back() += ' ' + value(own) + ' ' + value("shared") + ' ' + value(other);
    }
    board.SetEventHandler(nullptr);
  }

  PlayerClient client;
  Position2dProxy position;
  BlackBoardProxy board;
  std::vector<std::string> rounds;
};

std::vector<std::string> rounds_of(const std::string& own, const std::string& other) {
  std::vector<std::string> rounds{"none /= /= /" + own + "=0 /shared=" + own + " /="};
  for (int i = 1; i < Program::kRounds; ++i) {
    const std::string others_value = '/' + other + '=' + std::to_string(i - 1);
    rounds.push_back(others_value + ' ' + others_value + " /shared=b /" + own + '=' +
                     std::to_string(i) + " /shared=" + own + ' ' + others_value);
  }
  return rounds;
}

struct BlackboardInLockstep : testing::TestWithParam<Transport> {};

INSTANTIATE_TEST_SUITE_P(Transports, BlackboardInLockstep,
                         testing::Values(Transport::kInProcess, Transport::kCbor, Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

// The threads compute side by side between two steps. What one of them reads must not depend on
// how fast the other one is. The last change of the shared entry is that of the newer client.
TEST_P(BlackboardInLockstep, ChangesOfOtherThreads_VisibleFromNextStep) {
  const test::ReachableHost host(
      playerlike::Host::create(sim::load_world_text(R"({"simulation": {"clients": 2},
          "arena": {"size": [4, 4]}, "robots": [{"pose": {"x": 1, "y": 1}},
                                                  {"pose": {"x": 3, "y": 3}}]})")),
      GetParam());
  Program a(host.connect(6665));
  Program b(host.connect(6666));
  std::thread thread([&] { a.run("a", "b"); });
  b.run("b", "a");
  thread.join();
  EXPECT_EQ(a.rounds, rounds_of("a", "b"));
  EXPECT_EQ(b.rounds, rounds_of("b", "a"));
}

TEST(BlackboardOfAPrivateWorld, Closed) {
  const auto host = playerlike::Host::create(
      sim::load_world_text(R"({"simulation": {"privacy": "own"}, "robots": [{}, {}]})"));
  PlayerClient client(host->connect(6665));
  BlackBoardProxy board(&client, 0);
  EXPECT_EQ(error_code_of([&] { set(board, "", "k", "x"); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { board.GetEntry("k", ""); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { board.SubscribeToKey("k"); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { board.SubscribeToGroup("g"); }), PlayerError::kNotAvailable);
  board.UnsubscribeFromGroup("g");
  client.Read();  // a subscription that was refused has no effect
}

std::vector<std::string> heard_by_c;
void hear_in_c(playerc_blackboard_t* board, player_blackboard_entry_t entry) {
  EXPECT_NE(board, nullptr);
  heard_by_c.push_back(text_of(entry));
}

TEST(BlackboardOfTheCLibrary, SetsGetsAndReports) {
  heard_by_c.clear();
  const test::ReachableHost host(playerlike::Host::create(sim::load_world_text(kWorld)),
                                 Transport::kCbor);
  playerc_client_t* const client = playerc_client_create(nullptr, host.name().c_str(), 6665);
  ASSERT_EQ(playerc_client_connect(client), 0) << playerc_error_str();
  playerc_blackboard_t* const board = playerc_blackboard_create(client, 0);
  ASSERT_EQ(playerc_blackboard_subscribe(board, PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  board->on_blackboard_event = hear_in_c;
  ASSERT_EQ(playerc_blackboard_subscribe_to_group(board, "g"), 0);
  ASSERT_EQ(playerc_blackboard_set_string(board, "s", "g", "text"), 0);
  ASSERT_EQ(playerc_blackboard_set_int(board, "i", "", 42), 0);
  ASSERT_EQ(playerc_blackboard_set_double(board, "d", "", 0.5), 0);
  player_blackboard_entry_t* entry = nullptr;
  ASSERT_EQ(playerc_blackboard_subscribe_to_key(board, "d", "", &entry), 0);
  double half = 0.0;
  ASSERT_EQ(entry->data_count, sizeof half);
  std::memcpy(&half, entry->data, sizeof half);
  EXPECT_EQ(half, 0.5);
  EXPECT_EQ(entry->type, 1);
  EXPECT_EQ(entry->subtype, 3);
  ASSERT_EQ(playerc_blackboard_set_entry(board, entry), 0);
  Freed{}(entry);
  ASSERT_NE(playerc_client_read(client), nullptr) << playerc_error_str();
  ASSERT_EQ(heard_by_c.size(), 2U);
  EXPECT_EQ(heard_by_c[0], std::string("g/s=text") + '\0');
  EXPECT_THAT(heard_by_c[1], HasSubstr("/d="));
  ASSERT_EQ(playerc_blackboard_get_entry(board, "i", "", &entry), 0);
  int number = 0;
  std::memcpy(&number, entry->data, sizeof number);
  EXPECT_EQ(number, 42);
  Freed{}(entry);
  EXPECT_EQ(playerc_blackboard_get_entry(board, nullptr, "", &entry), -1);
  EXPECT_EQ(playerc_blackboard_set_entry(board, nullptr), -1);
  EXPECT_EQ(playerc_blackboard_unsubscribe_from_key(board, "d", ""), 0);
  EXPECT_EQ(playerc_blackboard_unsubscribe_from_group(board, "g"), 0);
  EXPECT_EQ(playerc_blackboard_unsubscribe(board), 0);
  playerc_blackboard_destroy(board);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
}

// The library must not access what the program's function has destroyed; the sanitizer builds check
// this.
TEST(BlackboardOfTheCLibrary, Callback_MayDestroyDeviceAndClient) {
  const test::ReachableHost host(playerlike::Host::create(sim::load_world_text(kWorld)),
                                 Transport::kCbor);
  static playerc_client_t* client = nullptr;
  static int events = 0;
  for (const bool client_too : {false, true}) {
    client = playerc_client_create(nullptr, host.name().c_str(), 6665);
    ASSERT_EQ(playerc_client_connect(client), 0) << playerc_error_str();
    playerc_blackboard_t* const board = playerc_blackboard_create(client, 0);
    ASSERT_EQ(playerc_blackboard_subscribe(board, PLAYERC_OPEN_MODE), 0) << playerc_error_str();
    events = 0;
    board->on_blackboard_event = [](playerc_blackboard_t* device, player_blackboard_entry_t) {
      ++events;
      playerc_blackboard_destroy(device);
    };
    if (client_too) {
      board->on_blackboard_event = [](playerc_blackboard_t* device, player_blackboard_entry_t) {
        ++events;
        playerc_blackboard_destroy(device);
        playerc_client_destroy(client);
      };
    }
    ASSERT_EQ(playerc_blackboard_subscribe_to_group(board, "g"), 0);
    ASSERT_EQ(playerc_blackboard_set_int(board, "a", "g", 1), 0);
    ASSERT_EQ(playerc_blackboard_set_int(board, "b", "g", 2), 0);
    while (events == 0) ASSERT_NE(playerc_client_read(client), nullptr) << playerc_error_str();
    EXPECT_EQ(events, 1);
    if (!client_too) playerc_client_destroy(client);
  }
}

}  // namespace
