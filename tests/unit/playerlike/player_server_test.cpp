// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The server of Player's protocol, with raw sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "patience.h"
#include "patient_host.h"
#include "player_wire_client.h"
#include "playerlike/server/server.h"
#include "process/local_process.h"
#include "sim/core/error.h"

namespace playerlike::server {
namespace {

using test_support::PlayerMessage;
using test_support::PlayerWireClient;
using test_support::RawClient;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

std::shared_ptr<Host> make_host(const std::string& simulation = "{}") {
  return test::patient_host(sim::load_world_text(
      R"({"name": "room", "arena": {"size": [20, 4]}, "simulation": )" + simulation +
      R"(, "robots": [
        {"name": "r1", "pose": {"x": 1, "y": 1}},
        {"name": "r2", "pose": {"x": 1, "y": 3}, "devices": {"laser": null}}]})"));
}

class PlayerServer : public testing::Test {
 protected:
  PlayerServer() {
    settings.port = 0;
    settings.player_port = 0;
  }

  Server& start(std::shared_ptr<Host> with_host = make_host()) {
    host = std::move(with_host);
    server = std::make_unique<Server>(host, settings, [this](sim::LogLevel, std::string_view text) {
      const std::lock_guard lock(mutex);
      lines.emplace_back(text);
    });
    return *server;
  }
  [[nodiscard]] int port(int robot_port = 6665) const {
    return server->player_ports().at(robot_port);
  }
  /// A client in PULL mode that has opened devices.
  [[nodiscard]] PlayerWireClient reader(const std::vector<int>& interfaces,
                                        int robot_port = 6665) const {
    PlayerWireClient client(port(robot_port));
    client.set_mode(PLAYER_DATAMODE_PULL);
    for (const int interface : interfaces) {
      EXPECT_EQ(client.open(interface).header.type, PLAYER_MSGTYPE_RESP_ACK);
    }
    return client;
  }
  void wait_until_empty() const {
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while (server->connections() > 0 && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(server->connections(), 0U);
  }
  [[nodiscard]] bool has_logged(const std::string& part) {
    const std::lock_guard lock(mutex);
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(part) != line.npos; });
  }
  /// Waits for a line of the log.
  void expect_log(const std::string& part) {
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while (!has_logged(part) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(has_logged(part)) << part;
  }
  void expect_alive() const {
    PlayerWireClient client(port());
    EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DEVLIST).header.type, PLAYER_MSGTYPE_RESP_ACK);
  }

  ServerSettings settings;
  std::mutex mutex;
  std::vector<std::string> lines;
  std::shared_ptr<Host> host;
  std::unique_ptr<Server> server;
};

std::vector<int> interfaces_of(const std::vector<PlayerMessage>& round) {
  std::vector<int> interfaces;
  for (const PlayerMessage& message : round) interfaces.push_back(message.header.addr.interf);
  return interfaces;
}

std::string velocity(double v_mps, double omega_radps = 0.0) {
  return player::encode(player::Position2dCmdVel{{v_mps, 0.0, omega_radps}, 1});
}

// --- Ports

TEST_F(PlayerServer, OffByDefault) {
  settings.player_port.reset();
  EXPECT_THAT(start().player_ports(), IsEmpty());
}

TEST_F(PlayerServer, RobotPorts_HaveTcpPorts) {
  start();
  EXPECT_THAT(server->player_ports(),
              ElementsAre(Pair(6665, testing::Gt(0)), Pair(6666, testing::Gt(0))));
  EXPECT_NE(port(6665), port(6666));
}

TEST_F(PlayerServer, Ports_KeepDistancesOfWorld) {
  // Two ports in a row that were free a moment ago; another program may take one meanwhile.
  for (int attempt = 0; attempt < 20; ++attempt) {
    settings.player_port = 0;
    start();
    settings.player_port = port();
    server.reset();
    try {
      start();
    } catch (const sim::ConfigError&) {
      continue;
    }
    EXPECT_EQ(port(6665), *settings.player_port);
    EXPECT_EQ(port(6666), *settings.player_port + 1);
    return;
  }
  FAIL() << "no free ports in a row";
}

TEST_F(PlayerServer, InvalidPorts_Refused) {
  settings.player_port = 65535;
  try {
    Server::check(settings, {"r1", "r2"}, {6665, 6666});
    FAIL() << "expected an error";
  } catch (const sim::ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "server/port-range");
    EXPECT_THAT(error.issues().front().expected, HasSubstr("1 to 65534"));
  }
}

TEST_F(PlayerServer, PortInUse_Refused) {
  start();
  ServerSettings second = settings;
  second.player_port = port();
  try {
    Server::check(second, {"r1"}, {6665});
    FAIL() << "expected an error";
  } catch (const sim::ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "server/port-taken");
    EXPECT_EQ(error.issues().front().pointer, "player_port");
  }
}

// --- The interface player

TEST_F(PlayerServer, Connection_GetsBanner) {
  start();
  PlayerWireClient client(port());
  EXPECT_EQ(client.banner, player::banner());
  EXPECT_THAT(client.banner, testing::StartsWith("Player v.3"));
}

TEST_F(PlayerServer, Devices_Listed) {
  start();
  PlayerWireClient client(port());
  const PlayerMessage answer = client.request(PLAYER_PLAYER_REQ_DEVLIST);
  EXPECT_TRUE(answer.is(PLAYER_MSGTYPE_RESP_ACK, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DEVLIST));
  EXPECT_EQ(answer.header.seq, 0U);
  std::vector<int> interfaces;
  for (const player::Devaddr& address : answer.as<player::DeviceDevlist>().devices) {
    EXPECT_EQ(address.host, 0x0100007FU);  // 127.0.0.1 as it lies in memory
    EXPECT_EQ(address.robot, static_cast<std::uint32_t>(port()));
    interfaces.push_back(address.interf);
  }
  EXPECT_THAT(interfaces, Contains(PLAYER_POSITION2D_CODE));
  EXPECT_THAT(interfaces, Contains(PLAYER_LASER_CODE));
  PlayerWireClient other(port(6666));
  for (const player::Devaddr& address :
       other.request(PLAYER_PLAYER_REQ_DEVLIST).as<player::DeviceDevlist>().devices) {
    EXPECT_NE(address.interf, PLAYER_LASER_CODE);
  }
}

TEST_F(PlayerServer, ListedDevices_OpenAndClose) {
  start(test::patient_host(sim::load_world(PLAYPEN_SOURCE_DIR "/worlds/cave.json")));
  PlayerWireClient client(server->player_ports().begin()->second);
  client.set_mode(PLAYER_DATAMODE_PULL);
  const auto devices =
      client.request(PLAYER_PLAYER_REQ_DEVLIST).as<player::DeviceDevlist>().devices;
  EXPECT_THAT(devices, SizeIs(testing::Gt(5U)));
  for (const player::Devaddr& address : devices) {
    for (const int mode : {PLAYER_OPEN_MODE, PLAYER_CLOSE_MODE}) {
      const PlayerMessage answer = client.access(address.interf, address.index, mode);
      EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK) << address.interf;
      EXPECT_EQ(answer.as<player::DeviceReq>().access, mode) << address.interf;
    }
  }
}

TEST_F(PlayerServer, Drivers_Named) {
  start();
  PlayerWireClient client(port());
  player::DeviceDriverinfo asked;
  asked.addr.interf = PLAYER_LASER_CODE;
  const PlayerMessage answer = client.request(PLAYER_PLAYER_REQ_DRIVERINFO, player::encode(asked));
  EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(answer.as<player::DeviceDriverinfo>().driver_name, player::text_bytes("laser"));
  asked.addr.index = 7;
  const PlayerMessage none = client.request(PLAYER_PLAYER_REQ_DRIVERINFO, player::encode(asked));
  EXPECT_EQ(none.header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(none.header.size, 0U);
}

TEST_F(PlayerServer, Devices_OpenAndClose) {
  start();
  PlayerWireClient client(port());
  PlayerMessage answer = client.open(PLAYER_LASER_CODE);
  EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK);
  auto device = answer.as<player::DeviceReq>();
  EXPECT_EQ(device.access, PLAYER_OPEN_MODE);
  EXPECT_EQ(device.driver_name, player::text_bytes("laser"));
  EXPECT_EQ(device.addr.robot, static_cast<std::uint32_t>(port()));
  EXPECT_EQ(client.request(PLAYER_LASER_CODE, 0, PLAYER_LASER_REQ_GET_GEOM).header.type,
            PLAYER_MSGTYPE_RESP_ACK);
  device = client.access(PLAYER_LASER_CODE, 0, PLAYER_CLOSE_MODE).as<player::DeviceReq>();
  EXPECT_EQ(device.access, PLAYER_CLOSE_MODE);
  // Requests to a device that is not open are refused, not kept.
  EXPECT_EQ(client.request(PLAYER_LASER_CODE, 0, PLAYER_LASER_REQ_GET_GEOM).header.type,
            PLAYER_MSGTYPE_RESP_NACK);
  // Closing it again fails as in Player.
  answer = client.access(PLAYER_LASER_CODE, 0, PLAYER_CLOSE_MODE);
  EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(answer.as<player::DeviceReq>().access, PLAYER_ERROR_MODE);
}

TEST_F(PlayerServer, UnknownDevices_Refused) {
  start();
  PlayerWireClient client(port());
  for (const auto& [interface, index] :
       {std::pair(PLAYER_LASER_CODE, 1), std::pair(PLAYER_SONAR_CODE, 0), std::pair(999, 0),
        std::pair(PLAYER_PLAYER_CODE, 0)}) {
    const PlayerMessage answer = client.open(interface, index);
    EXPECT_TRUE(answer.is(PLAYER_MSGTYPE_RESP_NACK, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DEV));
    EXPECT_EQ(answer.header.size, 28U);
    EXPECT_EQ(answer.as<player::DeviceReq>().access, PLAYER_ERROR_MODE);
  }
}

TEST_F(PlayerServer, Robots_FoundByName) {
  start();
  PlayerWireClient client(port());
  const std::string name = player::text_bytes("r2");
  player::DeviceNameserviceReq asked;
  asked.name.assign(name.begin(), name.end());
  const PlayerMessage answer = client.request(PLAYER_PLAYER_REQ_NAMESERVICE, player::encode(asked));
  EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(answer.as<player::DeviceNameserviceReq>().port, port(6666));
  asked.name[1] = '7';
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_NAMESERVICE, player::encode(asked)).header.type,
            PLAYER_MSGTYPE_RESP_NACK);
}

TEST_F(PlayerServer, UnknownRequestsAndModes_Refused) {
  start();
  PlayerWireClient client(port());
  EXPECT_EQ(client.request(77).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.set_mode(9).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DATAMODE, "x").header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.set_mode(PLAYER_DATAMODE_PULL).header.type, PLAYER_MSGTYPE_RESP_ACK);
}

TEST_F(PlayerServer, CapabilitiesAndProperties_Reported) {
  start();
  PlayerWireClient client(port());
  client.open(PLAYER_LASER_CODE);
  const auto asks = [&](std::uint32_t type, std::uint32_t subtype) {
    return client
        .request(PLAYER_LASER_CODE, 0, PLAYER_CAPABILITIES_REQ,
                 player::encode(player::CapabilitiesReq{type, subtype}))
        .header.type;
  };
  EXPECT_EQ(asks(PLAYER_MSGTYPE_REQ, PLAYER_LASER_REQ_GET_GEOM), PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(asks(PLAYER_MSGTYPE_REQ, 99), PLAYER_MSGTYPE_RESP_NACK);
  player::DblpropReq property;
  property.key = player::text_bytes("range_max");
  const PlayerMessage known =
      client.request(PLAYER_LASER_CODE, 0, PLAYER_GET_DBLPROP_REQ, player::encode(property));
  EXPECT_EQ(known.header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_GT(known.as<player::DblpropReq>().value, 0.0);
  property.key = player::text_bytes("beauty");
  for (const int subtype : {PLAYER_GET_DBLPROP_REQ, PLAYER_SET_DBLPROP_REQ}) {
    EXPECT_EQ(client.request(PLAYER_LASER_CODE, 0, subtype, player::encode(property)).header.type,
              PLAYER_MSGTYPE_RESP_NACK);
  }
}

// --- Rounds

TEST_F(PlayerServer, Pull_RoundsInLockstep) {
  start();
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE});
  for (int i = 1; i <= 5; ++i) {
    client.begin_round();
    const PlayerMessage ack = client.receive();
    EXPECT_TRUE(ack.is(PLAYER_MSGTYPE_RESP_ACK, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DATA));
    const auto round = client.end_round();
    EXPECT_THAT(interfaces_of(round),
                UnorderedElementsAre(PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE));
    for (const PlayerMessage& message : round) {
      EXPECT_NEAR(message.header.timestamp, 0.1 * i, 1e-9);  // both devices measure at 10 Hz
      EXPECT_EQ(message.header.addr.robot, static_cast<std::uint32_t>(port()));
    }
  }
  // Time stands still while the client does not ask.
  EXPECT_NEAR(sim::to_seconds(host->now_ns()), 0.5, 1e-9);
}

TEST_F(PlayerServer, Commands_MoveRobot) {
  start();
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE});
  client.command(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_CMD_VEL, velocity(0.2));
  double x_m = 0.0;
  for (int i = 0; i < 20; ++i) {
    for (const PlayerMessage& message : client.round()) {
      x_m = message.as<player::Position2dData>().pos.px;
    }
  }
  EXPECT_GT(x_m, 1.2);
  EXPECT_LT(x_m, 1.45);
}

TEST_F(PlayerServer, RoundWithoutDevices_AdvancesTime) {
  start();
  PlayerWireClient client = reader({});
  EXPECT_THAT(client.round(), IsEmpty());
  EXPECT_NEAR(sim::to_seconds(host->now_ns()), 0.1, 1e-9);
}

TEST_F(PlayerServer, Requests_AnsweredDuringDataRequest) {
  settings.limits.requests_in_flight = 256;
  start();
  PlayerWireClient one = reader({PLAYER_POSITION2D_CODE});
  PlayerWireClient two(port(6666));
  // A client that has its own thread and holds the lockstep.
  const auto holder = host->connect(6666);
  holder->request(JoinRequest{});
  one.begin_round();
  EXPECT_EQ(one.receive().header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(one.request(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_REQ_GET_GEOM).header.type,
            PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_THAT(one.data, IsEmpty());
  EXPECT_EQ(host->now_ns(), 0);
  holder->close();  // its end lets time advance
  EXPECT_THAT(one.end_round(), SizeIs(1));
}

TEST_F(PlayerServer, Push_SendsNewData) {
  start();
  PlayerWireClient client(port());
  client.open(PLAYER_POSITION2D_CODE);
  double last_s = 0.0;
  for (int i = 0; i < 5; ++i) {
    const PlayerMessage message = client.receive();
    EXPECT_TRUE(
        message.is(PLAYER_MSGTYPE_DATA, PLAYER_POSITION2D_CODE, PLAYER_POSITION2D_DATA_STATE));
    EXPECT_GT(message.header.timestamp, last_s);
    last_s = message.header.timestamp;
  }
  // The mode can change at any time.
  EXPECT_EQ(client.set_mode(PLAYER_DATAMODE_PULL).header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_THAT(client.round(), Not(IsEmpty()));
}

TEST_F(PlayerServer, Data_QueuedUnlessReplaced) {
  start();
  PlayerWireClient fast = reader({PLAYER_POSITION2D_CODE});
  PlayerWireClient slow = reader({PLAYER_POSITION2D_CODE});
  // Both belong to this process, so time does not wait for the slow one.
  for (int i = 0; i < 3; ++i) EXPECT_THAT(fast.round(), SizeIs(1));
  EXPECT_THAT(slow.round(), SizeIs(3));
  const auto add_rule = [&](int interface, int replace) {
    return slow
        .request(PLAYER_PLAYER_REQ_ADD_REPLACE_RULE,
                 player::encode(
                     player::AddReplaceRuleReq{interface, -1, PLAYER_MSGTYPE_DATA, -1, replace}))
        .header.type;
  };
  EXPECT_EQ(add_rule(PLAYER_POSITION2D_CODE, PLAYER_PLAYER_MSG_REPLACE_RULE_REPLACE),
            PLAYER_MSGTYPE_RESP_ACK);
  for (int i = 0; i < 3; ++i) EXPECT_THAT(fast.round(), SizeIs(1));
  EXPECT_THAT(slow.round(), SizeIs(1));
  EXPECT_EQ(add_rule(PLAYER_POSITION2D_CODE, PLAYER_PLAYER_MSG_REPLACE_RULE_IGNORE),
            PLAYER_MSGTYPE_RESP_ACK);
  for (int i = 0; i < 3; ++i) EXPECT_THAT(fast.round(), SizeIs(1));
  EXPECT_THAT(slow.round(), IsEmpty());
  EXPECT_EQ(add_rule(PLAYER_POSITION2D_CODE, 7), PLAYER_MSGTYPE_RESP_NACK);
  // The number of rules is limited.
  int accepted = 0;
  for (int interface = 1000; interface < 2000; ++interface) {
    accepted += add_rule(interface, 1) == PLAYER_MSGTYPE_RESP_ACK ? 1 : 0;
  }
  EXPECT_EQ(accepted, 255);
}

TEST_F(PlayerServer, ConnectionsOfProcess_CountAsOneThread) {
  start();
  // This thread reads them in turn; if they were two threads, the first round would never end.
  PlayerWireClient one = reader({PLAYER_POSITION2D_CODE});
  PlayerWireClient two = reader({PLAYER_POSITION2D_CODE}, 6666);
  for (int i = 0; i < 5; ++i) {
    EXPECT_THAT(one.round(), Not(IsEmpty()));
    EXPECT_THAT(two.round(), Not(IsEmpty()));
  }
}

TEST_F(PlayerServer, Commands_AppliedBeforeRoundOfOtherConnection) {
  start();
  PlayerWireClient one = reader({PLAYER_POSITION2D_CODE});
  PlayerWireClient two = reader({PLAYER_POSITION2D_CODE}, 6666);
  static_cast<void>(one.round());
  double x_m = two.round().back().as<player::Position2dData>().pos.px;
  // The position is the arena's localisation, without noise, every 0.1 s. The server handles 64
  // messages of a connection before it serves others, so the last command is not in the first turn.
  for (int i = 0; i < 20; ++i) {
    const double v_mps = i % 2 == 0 ? 0.2 : -0.2;
    std::string commands;
    for (int k = 0; k <= 150; ++k) {
      commands +=
          PlayerWireClient::message(PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CODE, 0,
                                    PLAYER_POSITION2D_CMD_VEL, velocity(k < 150 ? 0.0 : v_mps));
    }
    two.socket.send(commands);
    static_cast<void>(one.round());
    const double now_m = two.round().back().as<player::Position2dData>().pos.px;
    EXPECT_NEAR(now_m - x_m, v_mps * 0.1, 1e-9) << "round " << i;
    x_m = now_m;
  }
}

TEST_F(PlayerServer, TimeWaitsForOtherProcesses) {
  int to_parent[2];
  int to_child[2];
  ASSERT_EQ(pipe(to_parent), 0);
  ASSERT_EQ(pipe(to_child), 0);
  // Forked while this process has one thread only.
  const pid_t child = fork();
  if (child == 0) {
    try {
      int tcp_port = 0;
      char byte = 'x';
      if (read(to_child[0], &tcp_port, sizeof tcp_port) != sizeof tcp_port) _exit(1);
      PlayerWireClient other(tcp_port);
      other.set_mode(PLAYER_DATAMODE_PULL);
      other.open(PLAYER_POSITION2D_CODE);
      if (other.round().empty()) _exit(2);
      if (write(to_parent[1], &byte, 1) != 1 || read(to_child[0], &byte, 1) != 1) _exit(3);
      _exit(0);  // its death must let time advance
    } catch (...) {
      _exit(4);
    }
  }
  start();
  PlayerWireClient mine = reader({PLAYER_POSITION2D_CODE});
  const int tcp_port = port(6666);
  ASSERT_EQ(write(to_child[1], &tcp_port, sizeof tcp_port), ssize_t{sizeof tcp_port});
  std::atomic<bool> over{false};
  std::thread reading([&] {
    while (!over) EXPECT_THAT(mine.round(), SizeIs(1));
  });
  // The child's round has ended, and it holds time until its death.
  char byte = 0;
  EXPECT_EQ(read(to_parent[0], &byte, 1), 1);
  const auto before_ns = host->now_ns();
  PlayerWireClient onlooker = reader({PLAYER_POSITION2D_CODE});
  EXPECT_EQ(onlooker.request(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_REQ_GET_GEOM).header.type,
            PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(host->now_ns(), before_ns);
  over = true;
  EXPECT_EQ(write(to_child[1], &byte, 1), 1);
  reading.join();
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_THAT(mine.round(), SizeIs(1));
  for (const int file : {to_parent[0], to_parent[1], to_child[0], to_child[1]}) close(file);
}

TEST_F(PlayerServer, PacedTime_FollowsClock) {
  start(make_host(R"({"time": 50})"));
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE});
  double last_s = 0.0;
  for (int i = 0; i < 5; ++i) {
    const auto round = client.round();
    ASSERT_THAT(round, Not(IsEmpty()));
    EXPECT_GT(round.back().header.timestamp, last_s);
    last_s = round.back().header.timestamp;
  }
}

TEST_F(PlayerServer, EndOfRun_ClosesConnections) {
  start(make_host(R"({"duration": 0.25})"));
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE});
  EXPECT_THAT(client.round(), SizeIs(1));
  EXPECT_THAT(client.round(), SizeIs(1));
  client.begin_round();
  EXPECT_EQ(client.receive().header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(client.socket.rest(), "");
  expect_log("the simulated run is over");
  wait_until_empty();
}

// --- Rights

TEST_F(PlayerServer, ServerToken_Authenticates) {
  settings.access.server_token = kToken;
  start();
  PlayerWireClient client(port());
  // libplayerc sets the mode at once, and gives up if it cannot.
  EXPECT_EQ(client.set_mode(PLAYER_DATAMODE_PULL).header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DEVLIST).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DATA).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.open(PLAYER_POSITION2D_CODE).header.type, PLAYER_MSGTYPE_RESP_NACK);
  const auto authenticate = [&](const std::string& token) {
    player::DeviceAuthReq request;
    request.auth_key.assign(token.begin(), token.end());
    return client.request(PLAYER_PLAYER_REQ_AUTH, player::encode(request)).header.type;
  };
  EXPECT_EQ(authenticate("a wrong one"), PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DEVLIST).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_AUTH, "xyz").header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_EQ(authenticate(kToken), PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_DEVLIST).header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(client.open(PLAYER_POSITION2D_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_THAT(client.round(), SizeIs(1));
}

TEST_F(PlayerServer, RobotToken_RequiredForCommands) {
  settings.access.robot_tokens = {{"r1", kToken}};
  start();
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE});
  const auto drive = [&] {
    client.command(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_CMD_VEL, velocity(0.2));
    double speed_mps = 0.0;
    for (int i = 0; i < 5; ++i) {
      for (const PlayerMessage& message : client.round()) {
        speed_mps = message.as<player::Position2dData>().vel.px;
      }
    }
    return speed_mps;
  };
  EXPECT_NEAR(drive(), 0.0, 1e-9);
  expect_log("r1 obeys only");
  EXPECT_EQ(client
                .request(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_REQ_MOTOR_POWER,
                         player::encode(player::Position2dPowerConfig{1}))
                .header.type,
            PLAYER_MSGTYPE_RESP_NACK);
  // A robot without a token obeys everybody.
  PlayerWireClient other = reader({PLAYER_POSITION2D_CODE}, 6666);
  EXPECT_EQ(other
                .request(PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_REQ_MOTOR_POWER,
                         player::encode(player::Position2dPowerConfig{1}))
                .header.type,
            PLAYER_MSGTYPE_RESP_ACK);
  const std::string token = kToken;
  player::DeviceAuthReq request;
  request.auth_key.assign(token.begin(), token.end());
  EXPECT_EQ(client.request(PLAYER_PLAYER_REQ_AUTH, player::encode(request)).header.type,
            PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_GT(drive(), 0.1);
}

// --- Hostile clients

TEST_F(PlayerServer, InvalidMessages_CloseConnection) {
  start();
  const std::string header = PlayerWireClient::message(PLAYER_MSGTYPE_REQ, 1, 0, 1);
  std::string huge = header;
  huge.replace(36, 4, "\xff\xff\xff\xff");
  const std::string no_type = PlayerWireClient::message(0, PLAYER_POSITION2D_CODE, 0, 1);
  const std::string type_200 = PlayerWireClient::message(200, PLAYER_POSITION2D_CODE, 0, 1);
  for (const std::string& bytes : {huge, no_type, type_200, std::string(100, 'G')}) {
    PlayerWireClient client(port());
    client.socket.send(bytes);
    EXPECT_EQ(client.socket.rest(), "");
    expect_alive();
  }
  wait_until_empty();
  expect_log("protocol/too-long");
  expect_log("player/type");
}

TEST_F(PlayerServer, PartialMessagesAndSilentConnections_Closed) {
  settings.limits.partial_request_s = 0.1;
  settings.limits.first_request_s = 0.1;
  start();
  PlayerWireClient half(port());
  half.socket.send(PlayerWireClient::message(PLAYER_MSGTYPE_REQ, 1, 0, 1).substr(0, 20));
  EXPECT_EQ(half.socket.rest(), "");
  PlayerWireClient silent(port());
  EXPECT_EQ(silent.socket.rest(), "");
  wait_until_empty();
}

TEST_F(PlayerServer, InvalidPayloads_AnsweredAndConnectionStays) {
  start();
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE});
  const std::string lies("\0\0\0\x40\x7f\xff\xff\xff", 8);  // counts of arrays
  for (const int subtype : {PLAYER_PLAYER_REQ_DEV, PLAYER_PLAYER_REQ_DRIVERINFO,
                            PLAYER_PLAYER_REQ_DATAMODE, PLAYER_PLAYER_REQ_AUTH,
                            PLAYER_PLAYER_REQ_NAMESERVICE, PLAYER_PLAYER_REQ_ADD_REPLACE_RULE}) {
    for (const std::string& payload :
         {std::string(), std::string("abc"), lies, lies + lies, std::string(1000, '\xff')}) {
      EXPECT_EQ(client.request(subtype, payload).header.type, PLAYER_MSGTYPE_RESP_NACK) << subtype;
    }
  }
  for (int subtype = 1; subtype < 256; ++subtype) {
    for (const int interface : {PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE}) {
      const PlayerMessage answer = client.request(interface, 0, subtype, lies);
      EXPECT_TRUE(answer.header.type == PLAYER_MSGTYPE_RESP_ACK ||
                  answer.header.type == PLAYER_MSGTYPE_RESP_NACK);
      EXPECT_EQ(answer.header.subtype, subtype);
      client.command(interface, 0, subtype, lies);
    }
  }
  // Messages for nobody, and of types that only servers send.
  client.command(PLAYER_SONAR_CODE, 3, 1, "");
  client.command(60000, 3, 1, "");
  client.send(PLAYER_MSGTYPE_DATA, PLAYER_LASER_CODE, 0, 1);
  client.send(PLAYER_MSGTYPE_SYNCH, PLAYER_PLAYER_CODE, 0, 1);
  EXPECT_EQ(client.request(60000, 1, 1).header.type, PLAYER_MSGTYPE_RESP_NACK);
  EXPECT_THAT(client.round(), Not(IsEmpty()));
}

TEST_F(PlayerServer, ManyShortConnections_LeakNothing) {
  start();
  PlayerWireClient driver = reader({PLAYER_POSITION2D_CODE, PLAYER_LASER_CODE});
  constexpr int kClients = 1000;
  const std::string wish =
      PlayerWireClient::message(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, 0,
                                PLAYER_PLAYER_REQ_DATAMODE, std::string("\0\0\0\2", 4)) +
      PlayerWireClient::message(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, 0, PLAYER_PLAYER_REQ_DATA);
  for (int i = 0; i < kClients; ++i) {
    RawClient client("127.0.0.1", port(i % 2 == 0 ? 6665 : 6666));
    if (i % 3 == 1) client.send(wish.substr(0, static_cast<std::size_t>(i) % wish.size()));
    if (i % 3 == 2) client.send(wish);
    if (i % 5 == 0) {
      client.reset();
    } else {
      client.close();
    }
    if (i % 10 == 0) {
      const auto round = driver.round();
      EXPECT_THAT(round, SizeIs(testing::Ge(2U))) << i;
    }
  }
  driver.socket.close();
  wait_until_empty();
  expect_alive();
}

TEST_F(PlayerServer, DeadClient_NotAwaited) {
  start();
  PlayerWireClient client = reader({PLAYER_POSITION2D_CODE});
  const auto holder = host->connect(6666);
  holder->request(JoinRequest{});
  {
    PlayerWireClient waiting = reader({PLAYER_POSITION2D_CODE}, 6666);
    waiting.begin_round();
    EXPECT_EQ(waiting.receive().header.type, PLAYER_MSGTYPE_RESP_ACK);
    waiting.socket.reset();
  }
  client.begin_round();
  EXPECT_EQ(client.receive().header.type, PLAYER_MSGTYPE_RESP_ACK);
  EXPECT_EQ(host->now_ns(), 0);
  holder->close();
  EXPECT_THAT(client.end_round(), SizeIs(1));
}

TEST_F(PlayerServer, SlowPushReader_LosesDataOnly) {
  settings.limits.queued_bytes = 20'000;
  start();
  PlayerWireClient slow(port());
  slow.open(PLAYER_LASER_CODE);
  // Time advances although the client reads nothing: it loses scans once all buffers are full.
  const auto end = std::chrono::steady_clock::now() + test_support::patience();
  while (host->now_ns() < sim::from_seconds(2000.0) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(slow.set_mode(PLAYER_DATAMODE_PULL).header.type, PLAYER_MSGTYPE_RESP_ACK);
  double last_s = 0.0;
  for (const PlayerMessage& message : slow.data) {
    EXPECT_GT(message.header.timestamp, last_s);
    last_s = message.header.timestamp;
  }
  EXPECT_LT(slow.data.size(), 20'000U);
}

// The queue of a device holds 1000 readings. The next SYNCH message tells how many more there were.
TEST_F(PlayerServer, SlowPullReader_LossReported) {
  start();
  PlayerWireClient slow = reader({PLAYER_LASER_CODE});
  {
    const auto other = host->connect(6666);
    other->request(SleepRequest{123.4});  // 1234 scans
  }
  for (const std::uint32_t dropped : {234U, 0U}) {
    slow.begin_round();
    std::size_t scans = 0;
    PlayerMessage message = slow.receive();
    for (; message.header.type != PLAYER_MSGTYPE_SYNCH; message = slow.receive()) {
      if (message.header.type == PLAYER_MSGTYPE_DATA) ++scans;
    }
    EXPECT_EQ(scans, dropped > 0 ? 1000U : 1U);
    EXPECT_EQ(message.header.subtype,
              dropped > 0 ? PLAYER_PLAYER_SYNCH_OVERFLOW : PLAYER_PLAYER_SYNCH_OK);
    EXPECT_EQ(message.payload,
              dropped > 0 ? player::encode(player::Uint32{dropped}) : std::string());
  }
}

// --- Recordings of real clients

std::string file_bytes(const std::string& name) {
  std::ifstream file(PLAYPEN_SOURCE_DIR "/tests/golden/player_wire/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Sends the bytes of a real client at once: every request gets one answer of its kind, in order.
TEST_F(PlayerServer, RecordedRequests_Answered) {
  start();
  for (const char* name : {"connect", "modes", "position2d_fixture", "position2d_stage",
                           "laser_fixture", "laser_stage", "blackboard", "map_tiny", "gps",
                           "simulation_stage", "ranger_fixture", "actarray", "opaque"}) {
    const std::string bytes = file_bytes(name + std::string(".client.bin"));
    ASSERT_FALSE(bytes.empty()) << name;
    std::vector<std::pair<int, int>> requests;  // interface and subtype
    std::size_t at = 0;
    while (at < bytes.size()) {
      const auto header =
          player::decode<player::Msghdr>(std::string_view(bytes).substr(at, player::kHeaderBytes));
      if (header.type == PLAYER_MSGTYPE_REQ) {
        requests.emplace_back(header.addr.interf, header.subtype);
      }
      at += player::kHeaderBytes + header.size;
    }
    PlayerWireClient client(port());
    client.socket.send(bytes);
    for (const auto& [interface, subtype] : requests) {
      PlayerMessage answer = client.receive();
      while (answer.header.type == PLAYER_MSGTYPE_DATA ||
             answer.header.type == PLAYER_MSGTYPE_SYNCH) {
        answer = client.receive();
      }
      EXPECT_TRUE(answer.is(PLAYER_MSGTYPE_RESP_ACK, interface, subtype) ||
                  answer.is(PLAYER_MSGTYPE_RESP_NACK, interface, subtype))
          << name << ": " << interface << ' ' << subtype;
      EXPECT_EQ(answer.header.seq, 0U);
      if (interface == PLAYER_PLAYER_CODE && subtype != PLAYER_PLAYER_REQ_DEV &&
          subtype != PLAYER_PLAYER_REQ_DRIVERINFO) {
        EXPECT_EQ(answer.header.type, PLAYER_MSGTYPE_RESP_ACK) << name << ' ' << subtype;
      }
      static_cast<void>(player::visit_payload(
          answer.header.addr.interf, answer.header.type, answer.header.subtype,
          [&]<typename Payload> { static_cast<void>(answer.as<Payload>()); }));
    }
    expect_alive();
  }
}

// --- The process of a client

TEST(PeerProcess, FindsThisProcessForIpv4AndIpv6) {
  for (const char* const address : {"127.0.0.1", "::1"}) {
    const bool ipv6 = address[0] == ':';
    if (ipv6 && !RawClient::has_ipv6()) continue;
    const auto host = make_host();
    ServerSettings settings;
    settings.port = 0;
    settings.bind = address;
    settings.player_port = 0;
    const Server server(host, settings);
    RawClient client(address, server.player_ports().at(6665));
    EXPECT_THAT(client.bytes(player::kBannerBytes), SizeIs(player::kBannerBytes));
    // Both ends belong to this process.
    EXPECT_EQ(peer_process(client.descriptor()), getpid());
  }
}

TEST(PeerProcess, Search_NeedsNoSocket) {
  std::array<int, 2> ends{};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  const auto search = peer_process_search(ends[0]);
  for (const int end : ends) close(end);
  EXPECT_EQ(search(), getpid());
}

TEST(PeerProcess, OtherSockets_Unknown) {
  const RawClient unconnected{RawClient::Unconnected{}};
  EXPECT_EQ(peer_process(unconnected.descriptor()), std::nullopt);
  EXPECT_EQ(peer_process(-1), std::nullopt);
}

}  // namespace
}  // namespace playerlike::server
