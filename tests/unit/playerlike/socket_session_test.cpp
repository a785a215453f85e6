// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Cases that only sessions over a network meet: servers that do not exist, go away, fall silent or
// come back. host_test, host_canvas_test and others test what holds for all sessions.
#include "remote/socket_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "libplayerc++/playerc++.h"
#include "patient_host.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"
#include "raw_client.h"
#include "relay.h"
#include "sim/core/error.h"
#include "sim/devices/localization.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using std::chrono::milliseconds;
using test::ListeningSocket;
using test::Relay;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr auto kDisconnected = SessionError::Code::kDisconnected;
constexpr auto kBadArgument = SessionError::Code::kBadArgument;

sim::WorldDescription two_robots(const std::string& simulation = "{}") {
  return sim::load_world_text(R"({"name": "two", "arena": {"size": [20, 4]}, "simulation": )" +
                              simulation +
                              R"(, "canvas": {"size": [100, 50], "cell_size": 0.02},
                      "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}},
                      {"name": "r2", "pose": {"x": 1, "y": 3}}]})");
}

/// The error that an action throws.
template <typename Action>
SessionError error_of(Action action) {
  try {
    action();
  } catch (const SessionError& e) {
    return e;
  }
  ADD_FAILURE() << "no error";
  return {SessionError::Code::kFinished, ""};
}

struct Collector : ReadingSink {
  void on_reading(DeviceId /*device*/, const sim::SharedReading& reading) override {
    times_ns.push_back(reading->time_ns);
    if (const auto* pose = dynamic_cast<const sim::PoseReading*>(reading.get())) {
      x_m = pose->pose.x_m;
    }
  }
  std::vector<sim::SimTime> times_ns;
  double x_m = 0.0;
};

Collector read(Session& session) {
  Collector round;
  do {
    session.wait();
  } while (session.take(round) == 0);
  return round;
}

DeviceId subscribe_position(Session& session) {
  const auto binding = find_interface(session.robots(), session.port(), "position2d", 0);
  session.request(SubscribeRequest{binding.reading});
  return binding.motion.value();
}

/// A host with a server on any free port.
struct Served {
  explicit Served(const std::string& simulation = "{}", ServerSettings settings = {})
      : host(test::patient_host(two_robots(simulation))) {
    settings.port = 0;
    server = std::make_unique<Server>(host, std::move(settings));
  }
  [[nodiscard]] int port() const { return server->port(); }

  std::shared_ptr<Host> host;
  std::unique_ptr<Server> server;
};

SocketSettings settings_for(int tcp_port, int port = 6665) {
  SocketSettings settings;
  settings.server = {"127.0.0.1", tcp_port};
  settings.port = port;
  return settings;
}

std::unique_ptr<SocketSession> connect(int tcp_port, int port = 6665) {
  return std::make_unique<SocketSession>(settings_for(tcp_port, port));
}

/// Settings for a server of this machine.
SocketSettings settings_for(const std::string& address) {
  SocketSettings settings;
  settings.server = parse_server_address(address);
  settings.port = 6665;
  return settings;
}

// --- Names

TEST(ServerAddresses, ParsedInTheirForms) {
  struct Case {
    const char* text;
    const char* host;
    int port;
  };
  for (const Case& c :
       {Case{"tcp://lab", "lab", 4000}, Case{"tcp://lab:4001", "lab", 4001},
        Case{"lab.example.org", "lab.example.org", 4000}, Case{"10.0.0.7:99", "10.0.0.7", 99},
        Case{"tcp://[::1]", "::1", 4000}, Case{"[fe80::1%eth0]:5000", "fe80::1%eth0", 5000}}) {
    const ServerAddress address = parse_server_address(c.text);
    EXPECT_EQ(address.host, c.host) << c.text;
    EXPECT_EQ(address.tcp_port, c.port) << c.text;
  }
  EXPECT_EQ((ServerAddress{"::1", 4000}.text()), "[::1]:4000");
}

TEST(ServerAddresses, UnixSockets_ParsedInTheirForms) {
  const ServerAddress socket = parse_server_address("unix:/run/robots");
  EXPECT_EQ(socket.path, "/run/robots");
  EXPECT_TRUE(socket.is_local());
  EXPECT_EQ(socket.text(), "unix:/run/robots");
  const ServerAddress descriptor = parse_server_address("unix:fd=7");
  EXPECT_EQ(descriptor.descriptor, 7);
  EXPECT_EQ(descriptor.path, "");
  EXPECT_EQ(descriptor.text(), "unix:fd=7");
  EXPECT_EQ(parse_server_address("unix:" + std::string(protocol::kMaxUnixPath, 'a')).path.size(),
            protocol::kMaxUnixPath);
}

TEST(ServerAddresses, InvalidAddresses_RefusedWithReason) {
  struct Case {
    const char* text;
    const char* why;
  };
  for (const Case& c :
       {Case{"tcp://", "the host is missing"}, Case{"", "the host is missing"},
        Case{"tcp://:4000", "the host is missing"}, Case{"tcp://lab:", "the port must be"},
        Case{"lab:0", "the port must be"}, Case{"lab:65536", "the port must be"},
        Case{"lab:40x", "the port must be"}, Case{"tcp://lab:4000/", "the port must be"},
        Case{"http://lab", "only tcp:// and player:// are known"}, Case{"tcp://::1", "in brackets"},
        Case{"tcp://[::1", "not closed"}, Case{"[::1]4000", "a colon and a port"},
        Case{"my lab", "a name or an address"}, Case{"lab/x", "a name or an address"}}) {
    const SessionError error = error_of([&] { static_cast<void>(open_session(c.text, 6665)); });
    EXPECT_EQ(error.code(), kBadArgument) << c.text;
    EXPECT_THAT(error.what(), AllOf(HasSubstr(c.why), HasSubstr("tcp://HOST"))) << c.text;
  }
}

TEST(SocketSettingsTest, ReadFromEnvironment) {
  setenv("PLAYPEN_TOKEN", "first-token,,second-token", 1);
  setenv("PLAYPEN_ENCODING", "json", 1);
  const SocketSettings settings = SocketSettings::from_environment({"lab", 1}, 6666);
  EXPECT_THAT(settings.tokens, testing::ElementsAre("first-token", "second-token"));
  EXPECT_EQ(settings.encoding, protocol::Encoding::kJson);
  EXPECT_EQ(settings.port, 6666);
  setenv("PLAYPEN_ENCODING", "xml", 1);
  try {
    static_cast<void>(SocketSettings::from_environment({"lab", 1}, 6666));
    FAIL() << "no error";
  } catch (const sim::ConfigError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("PLAYPEN_ENCODING"), HasSubstr("\"xml\""),
                                HasSubstr("run/environment")));
  }
  unsetenv("PLAYPEN_ENCODING");
  unsetenv("PLAYPEN_TOKEN");
}

// --- Connecting

TEST(SocketSessions, RefusedConnection_NamesHostPortAndReason) {
  int port = 0;
  {
    const ListeningSocket socket;
    port = socket.port();
  }
  const SessionError error = error_of([&] { connect(port); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("127.0.0.1:" + std::to_string(port)),
                                  HasSubstr("connection refused"), HasSubstr("playpen serve")));
  // As in a program.
  try {
    PlayerCc::PlayerClient client("tcp://127.0.0.1:" + std::to_string(port), 6665);
    FAIL() << "no error";
  } catch (const PlayerCc::PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerCc::PlayerError::kDisconnected);
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("connection refused"));
  }
}

TEST(SocketSessions, UnknownHost_Named) {
  SocketSettings settings = settings_for(4000);
  settings.server.host = "no-such-host.invalid";
  settings.connect_timeout_s = 5.0;
  const SessionError error = error_of([&] { SocketSession session(settings); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), HasSubstr("no-such-host.invalid:4000"));
}

TEST(SocketSessions, UnresponsiveServer_TimesOut) {
  const ListeningSocket silent;
  SocketSettings settings = settings_for(silent.port());
  settings.connect_timeout_s = 0.1;
  const SessionError error = error_of([&] { SocketSession session(settings); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), HasSubstr("it does not answer"));
}

TEST(SocketSessions, OtherServers_Recognised) {
  for (const char* text :
       {"HTTP/1.1 400 Bad Request\r\n\r\n", "1 FAILED \"no such component\"\n", "1 SUCCESS {}\n",
        "1 SUCCESS [[[[\n", "1 SUCCESS {\"encoding\": \"xml\"}\n",
        "1 SUCCESS {\"encoding\": \"json\", \"limits\": {\"message_bytes\": -1}}\n"}) {
    Relay relay{std::string(text)};
    const SessionError error = error_of([&] { connect(relay.port()); });
    EXPECT_EQ(error.code(), kDisconnected) << text;
    EXPECT_THAT(error.what(), HasSubstr("there is no Playpen server")) << text;
  }
}

TEST(SocketSessions, RefusalByServer_Reported) {
  const Served served;
  const SessionError error = error_of([&] { connect(served.port(), 7000); });
  EXPECT_EQ(error.code(), SessionError::Code::kNoSuchDevice);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("7000"), HasSubstr("6666 (r2)")));
}

TEST(SocketSessions, Tokens_OpenServersAndRobots) {
  ServerSettings settings;
  settings.access.server_token = "open-sesame";
  settings.access.robot_tokens["r2"] = "second-robot";
  const Served served("{}", settings);
  EXPECT_THAT(error_of([&] { connect(served.port()); }).what(), HasSubstr("token"));
  SocketSettings with_token = settings_for(served.port(), kMorsePort);
  with_token.tokens = {"open-sesame"};
  SocketSession session(with_token);
  const auto second = find_interface(session.robots(), kMorsePort, "position2d", 1);
  session.request(SubscribeRequest{second.reading});
  // A command has no answer: the next call with an answer reports its error.
  session.send(*second.motion, sim::TwistCommand{{.v_mps = 0.5}});
  EXPECT_THAT(error_of([&] { read(session); }).what(), HasSubstr("r2"));
  EXPECT_EQ(read(session).x_m, 1.0);
  with_token.tokens.emplace_back("second-robot");
  SocketSession holder(with_token);
  holder.request(SubscribeRequest{second.reading});
  holder.send(*second.motion, sim::TwistCommand{{.v_mps = 0.5}});
  EXPECT_GT(read(holder).x_m, 1.0);
}

TEST(SocketSessions, Servers_ReachedByIpv6AndName) {
  try {
    const ListeningSocket probe(/*v6=*/true);
  } catch (const std::exception&) {
    GTEST_SKIP() << "this machine has no IPv6";
  }
  ServerSettings settings;
  settings.bind = "::1";
  const Served served("{}", settings);
  const auto session = open_session("tcp://[::1]:" + std::to_string(served.port()), 6665);
  subscribe_position(*session);
  EXPECT_EQ(read(*session).times_ns.front(), 100'000'000);
}

TEST(SocketSessions, SeveralAddresses_TriedInTurn) {
  const Served served;  // on 127.0.0.1 only, while localhost may be ::1 first
  const auto session = open_session("localhost:" + std::to_string(served.port()), 6665);
  EXPECT_TRUE(session->connected());
}

TEST(SocketSessions, Localhost_IsServerOfPlaypenWorld) {
  const Served served;
  setenv("PLAYPEN_WORLD", ("tcp://127.0.0.1:" + std::to_string(served.port())).c_str(), 1);
  const auto session = open_session("localhost", 6666);
  unsetenv("PLAYPEN_WORLD");
  EXPECT_EQ(session->robots().size(), 2U);
  EXPECT_EQ(session->port(), 6666);
}

TEST(SocketSessions, SimulationIdentity_SameForSameServer) {
  const Served one;
  const Served other;
  const auto a = connect(one.port());
  const auto b = connect(one.port(), 6666);
  const auto c = connect(other.port());
  EXPECT_EQ(a->simulation(), b->simulation());
  EXPECT_NE(a->simulation(), c->simulation());
}

// --- Servers that go away

TEST(SocketSessions, ServerEndDuringWait_EndsWait) {
  Served served(R"({"clients": 2})");  // the gate never opens
  const auto session = connect(served.port());
  subscribe_position(*session);
  std::thread stopper([&] { served.server->stop(); });
  EXPECT_EQ(error_of([&] { session->wait(); }).code(), kDisconnected);
  stopper.join();
  EXPECT_FALSE(session->connected());
  const DeviceId motion = find_interface(session->robots(), 6665, "position2d", 0).motion.value();
  EXPECT_EQ(error_of([&] { session->wait(); }).code(), kDisconnected);
  EXPECT_EQ(error_of([&] { static_cast<void>(session->peek(milliseconds(0))); }).code(),
            kDisconnected);
  EXPECT_EQ(error_of([&] { static_cast<void>(session->request(TimeRequest{})); }).code(),
            kDisconnected);
  EXPECT_EQ(error_of([&] { session->request(SleepRequest{1.0}); }).code(), kDisconnected);
  EXPECT_EQ(error_of([&] { session->send(motion, sim::MotorEnableCommand{true}); }).code(),
            kDisconnected);
  EXPECT_EQ(error_of([&] { session->request(FlushDrawingsRequest{}); }).code(), kDisconnected);
  EXPECT_EQ(error_of([&] {
              session->request(SetCellsRequest{sim::kBaseLayer, {}, {}});
            }).code(),
            kDisconnected);
  EXPECT_EQ(error_of([&] { static_cast<void>(session->request(LayersRequest{})); }).code(),
            kDisconnected);
}

TEST(SocketSessions, CutMessage_ConnectionLost) {
  const Served served;
  Relay relay(served.port());
  const auto session = connect(relay.port());
  subscribe_position(*session);
  read(*session);
  relay.cut_after(10);
  const SessionError error = error_of([&] { session->wait(); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), HasSubstr("127.0.0.1:" + std::to_string(relay.port())));
}

TEST(SocketSessions, SilentServerDuringWait_TimesOut) {
  const Served served;
  Relay relay(served.port());
  const auto session = connect(relay.port());
  subscribe_position(*session);
  read(*session);
  session->request(AnswerTimeoutRequest{0.1});
  relay.freeze();
  EXPECT_THAT(error_of([&] { session->wait(); }).what(), HasSubstr("has not answered for 0.1 s"));
  EXPECT_EQ(error_of([&] { static_cast<void>(session->request(TimeRequest{})); }).code(),
            kDisconnected);
}

TEST(SocketSessions, LongWait_ContinuesWhileServerLives) {
  const Served served(R"({"clients": 2})");
  const auto session = connect(served.port());
  session->request(AnswerTimeoutRequest{4.0});
  subscribe_position(*session);
  std::thread late([&] {
    std::this_thread::sleep_for(milliseconds(8000));  // twice what a request may take
    const auto other = connect(served.port(), 6666);
    subscribe_position(*other);
    read(*other);
  });
  EXPECT_EQ(read(*session).times_ns.front(), 100'000'000);
  late.join();
}

TEST(SocketSessions, Close_WakesWaiter) {
  const Served served(R"({"clients": 2})");
  const auto session = connect(served.port());
  std::vector<std::thread> waiters;
  std::atomic<int> woken{0};
  for (int i = 0; i < 3; ++i) {
    waiters.emplace_back([&] {
      if (error_of([&] { session->wait(); }).code() == kDisconnected) ++woken;
    });
  }
  session->close();
  for (std::thread& waiter : waiters) waiter.join();
  EXPECT_EQ(woken, 3);
}

// --- Coming back

TEST(SocketSessions, LostConnection_ReconnectsWithRetries) {
  auto served = std::make_unique<Served>();
  Relay relay(served->port());
  const auto session = connect(relay.port());
  const DeviceId motion = subscribe_position(*session);
  session->request(ReplaceRequest{std::nullopt, false});
  session->request(RetriesRequest{-1, 0.01});
  for (int i = 0; i < 3; ++i) read(*session);
  relay.set_server(0);  // and refuses for a while
  served.reset();
  std::thread repair([&] {
    while (relay.connections() < 4) std::this_thread::yield();
    served = std::make_unique<Served>();
    relay.set_server(served->port());
  });
  // Another run, from its beginning, with the same subscription and rule.
  Collector round = read(*session);
  repair.join();
  EXPECT_THAT(round.times_ns, testing::ElementsAre(100'000'000));
  EXPECT_TRUE(session->connected());
  session->request(SleepRequest{0.2});
  EXPECT_THAT(read(*session).times_ns, testing::ElementsAre(200'000'000, 300'000'000));
  session->send(motion, sim::TwistCommand{{.v_mps = 0.5}});
  EXPECT_GT(read(*session).x_m, 1.0);
}

TEST(SocketSessions, Retries_Limited) {
  auto served = std::make_unique<Served>();
  Relay relay(served->port());
  PlayerCc::PlayerClient client("tcp://127.0.0.1:" + std::to_string(relay.port()), 6665);
  client.SetRetryTime(0.01);
  client.SetRetryLimit(3);
  client.Read();
  relay.set_server(0);
  served.reset();
  try {
    client.Read();
    FAIL() << "no error";
  } catch (const PlayerCc::PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerCc::PlayerError::kDisconnected);
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("3 attempts to connect again failed"));
  }
  EXPECT_EQ(relay.connections(), 1 + 3);
}

TEST(SocketSessions, Close_EndsRetries) {
  auto served = std::make_unique<Served>();
  const auto session = connect(served->port());
  session->request(RetriesRequest{-1, 3600.0});
  served.reset();
  std::thread closer([&] {
    while (session->connected()) std::this_thread::yield();
    session->close();
  });
  EXPECT_EQ(error_of([&] { session->wait(); }).code(), kDisconnected);
  closer.join();
}

TEST(SocketSessions, OtherWorldAfterReconnect_Refused) {
  auto served = std::make_unique<Served>();
  Relay relay(served->port());
  const auto session = connect(relay.port());
  session->request(RetriesRequest{1, 0.01});
  served.reset();
  const auto other = test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"name": "x", "pose": {"x": 1, "y": 1}}]})"));
  ServerSettings settings;
  settings.port = 0;
  const Server server(other, settings);
  relay.set_server(server.port());
  EXPECT_THAT(error_of([&] { session->wait(); }).what(), HasSubstr("does not know"));
}

// --- Threads

TEST(SocketSessions, Threads_ShareSession) {
  const Served served(R"({"duration": 20})");
  const auto session = connect(served.port());
  const DeviceId motion = subscribe_position(*session);
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      sim::SimTime last_ns = 0;
      while (!stop) {
        const TimeStatistics time = session->request(TimeRequest{});
        EXPECT_GE(time.sim_time_ns, last_ns);
        last_ns = time.sim_time_ns;
        session->send(motion, sim::TwistCommand{{.v_mps = 0.1 * t}});
        EXPECT_TRUE(session->request(CellRequest{sim::kBaseLayer, t, t}).has_value());
        EXPECT_FALSE(session->request(CellRequest{sim::kBaseLayer, -1, t}).has_value());
      }
    });
  }
  // Two threads, both waiting for rounds.
  threads.emplace_back([&] {
    EXPECT_EQ(error_of([&] {
                while (true) read(*session);
              }).code(),
              SessionError::Code::kFinished);
  });
  EXPECT_EQ(error_of([&] {
              while (true) read(*session);
            }).code(),
            SessionError::Code::kFinished);
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(served.host->finished());
}

TEST(SocketSessions, Follower_HoldsClock) {
  const Served served;
  const auto session = connect(served.port());
  subscribe_position(*session);
  const std::unique_ptr<Session> follower = session->open_follower();
  EXPECT_EQ(follower->simulation(), session->simulation());
  subscribe_position(*follower);
  std::atomic<int> rounds{0};
  std::promise<void> joined;
  std::thread thread([&] {
    follower->request(JoinRequest{});
    joined.set_value();
    const SessionError end = error_of([&] {
      while (true) {
        read(*follower);
        ++rounds;
      }
    });
    EXPECT_EQ(end.code(), kDisconnected);
  });
  joined.get_future().wait();
  EXPECT_EQ(served.host->time().steps, 0U);
  for (int i = 0; i < 5; ++i) read(*session);
  // Whatever the threads do, it has received each round except the newest before time could
  // advance.
  EXPECT_GE(rounds, 4);
  follower->close();
  thread.join();
  EXPECT_EQ(served.host->time().steps, 50U);
}

TEST(SocketSessions, CommandsOfSession_ArriveBeforeOtherAdvances) {
  const Served served;
  const auto first = connect(served.port(), 6665);
  const auto second = connect(served.port(), 6666);
  const DeviceId motion = subscribe_position(*first);
  const DeviceId other_motion = subscribe_position(*second);
  double x_m = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double v = i % 2 == 0 ? 0.3 : -0.3;
    first->send(motion, sim::TwistCommand{{.v_mps = v}});
    second->send(other_motion, sim::TwistCommand{{.v_mps = v}});
    x_m += 0.1 * v;
    ASSERT_NEAR(read(*second).x_m, x_m, 1e-9) << i;
    ASSERT_NEAR(read(*first).x_m, x_m, 1e-9) << i;
  }
}

// --- The canvas

std::vector<std::uint8_t> picture_of(Session& session) {
  sim::LayerStyle style;
  style.name = "map";
  style.transparency = 0.25;
  const sim::LayerId layer = session.request(CreateLayerRequest{sim::LayerKind::kColour, style});
  std::vector<sim::DrawOperation> operations;
  for (int i = 0; i < 20'000; ++i) {
    sim::DrawOperation operation;
    operation.kind =
        i % 3 == 0 ? sim::DrawOperation::Kind::kLine : sim::DrawOperation::Kind::kPixel;
    operation.layer = i % 2 == 0 ? layer : sim::kBaseLayer;
    operation.x0 = i * 7 % 130 - 10;
    operation.y0 = i * 11 % 60 - 5;
    operation.x1 = i * 13 % 100;
    operation.y1 = i * 17 % 50;
    operation.value = sim::CellValue::of(sim::Colour{static_cast<std::uint8_t>(i % 256), 3,
                                                     static_cast<std::uint8_t>(i / 256),
                                                     static_cast<std::uint8_t>(i % 255)});
    operations.push_back(operation);
  }
  session.draw(operations);
  std::vector<sim::CellValue> cells;
  for (int i = 0; i < 90 * 40; ++i) {
    cells.push_back(sim::CellValue::of(sim::Colour{9, static_cast<std::uint8_t>(i % 256), 7, 255}));
  }
  session.request(SetCellsRequest{layer, {20, 20, 90, 40}, cells});
  return session.request(CanvasImageRequest{}).rgba;
}

/// An image of 3 x 2 cells of one colour.
SetCellsRequest image_of(sim::LayerId layer, std::uint8_t red) {
  return {layer, {0, 0, 3, 2}, {6, sim::CellValue::of(sim::Colour{red, 0, 0, 255})}};
}

// Images of a layer whose first image was answered.
TEST(SocketSessions, ImagesWithoutAnswer_SeenByOtherSessionsAtOnce) {
  const Served served;
  for (const auto encoding : {protocol::Encoding::kCbor, protocol::Encoding::kJson}) {
    SocketSettings settings = settings_for(served.port());
    settings.encoding = encoding;
    SocketSession artist(settings);
    SocketSession onlooker(settings);
    const sim::LayerId layer =
        artist.request(CreateLayerRequest{sim::LayerKind::kColour, {.name = "images"}});
    for (std::uint8_t red = 1; red < 20; ++red) {
      artist.request(image_of(layer, red));
      EXPECT_EQ(onlooker.request(CanvasImageRequest{}).rgba.front(), red);
    }
  }
}

TEST(SocketSessions, ImageOnRemovedLayer_RefusedByItsCall) {
  const Served served;
  const auto session = connect(served.port());
  const sim::LayerId layer =
      session->request(CreateLayerRequest{sim::LayerKind::kColour, {.name = "images"}});
  session->request(image_of(layer, 1));
  session->request(image_of(layer, 2));
  session->request(RemoveLayerRequest{layer});
  EXPECT_THROW(session->request(image_of(layer, 3)), SessionError);
}

TEST(SocketSessions, Drawings_SameAsInProcess) {
  const auto host = test::patient_host(two_robots());
  const std::vector<std::uint8_t> expected = picture_of(*host->connect(6665));
  ServerSettings small;
  small.limits.message_bytes = 1024;  // less than three rows: cut into many messages
  for (const auto& settings : {ServerSettings{}, small}) {
    for (const auto encoding : {protocol::Encoding::kCbor, protocol::Encoding::kJson}) {
      const Served served("{}", settings);
      SocketSettings client = settings_for(served.port());
      client.encoding = encoding;
      SocketSession session(client);
      EXPECT_TRUE(picture_of(session) == expected) << protocol::to_string(encoding);
    }
  }
}

TEST(SocketSessions, PacedDrawings_SentWithoutFurtherCall) {
  const Served served(R"({"time": "real"})");
  const auto session = connect(served.port());
  sim::DrawOperation dot;
  dot.value = sim::CellValue::of(sim::Colour{255, 0, 0, 255});
  session->draw({&dot, 1});
  const auto watcher = served.host->connect(6666);
  while (watcher->request(CellRequest{sim::kBaseLayer, 0, 0}) != dot.value) {
    std::this_thread::sleep_for(milliseconds(1));
  }
}

TEST(SocketSessions, PacedSleep_OtherThreadsRead) {
  const Served served(R"({"time": 20})");
  const auto session = connect(served.port());
  subscribe_position(*session);
  std::atomic<int> rounds{0};
  std::atomic<bool> stop{false};
  std::thread reader([&] {
    while (!stop) {
      read(*session);
      ++rounds;
    }
  });
  const double begin_s = sim::to_seconds(session->request(TimeRequest{}).sim_time_ns);
  session->request(SleepRequest{2.0});
  EXPECT_GE(sim::to_seconds(session->request(TimeRequest{}).sim_time_ns), begin_s + 2.0);
  stop = true;
  reader.join();
  EXPECT_GE(rounds, 2);
}

// --- Servers that send what no server should send

/// A server's answer to hello.
nlohmann::json welcome_of(const Served& served) {
  test_support::RawClient client("127.0.0.1", served.port());
  client.send("1 playpen hello [{\"version\": 1, \"port\": 6665}]\n");
  return nlohmann::json::parse(client.line().substr(std::string("1 SUCCESS ").size()));
}

/// The output of a server that sends all of this before any request.
std::string said(const nlohmann::json& welcome, const std::string& more = "") {
  return "1 SUCCESS " + welcome.dump() + '\n' + more;
}

/// A server on loopback with its own thread; the test decides how it answers each line.
class ScriptedServer {
 public:
  struct Reply {
    std::string text;
    bool then_close = false;
  };
  /// @param answer  called in the thread with the number of the connection, from 0, and a line.
  explicit ScriptedServer(std::function<Reply(int, const std::string&)> answer)
      : answer_(std::move(answer)), thread_([this] { run(); }) {}
  ScriptedServer(const ScriptedServer&) = delete;
  ScriptedServer& operator=(const ScriptedServer&) = delete;
  ~ScriptedServer() {
    stop_ = true;
    thread_.join();
  }
  [[nodiscard]] int port() const noexcept { return listening_.port(); }

 private:
  struct Link {
    int number;
    int socket;
    std::string input;
  };

  void run() {
    std::vector<Link> links;
    int count = 0;
    while (!stop_) {
      std::vector<pollfd> polled{{listening_.descriptor(), POLLIN, 0}};
      for (const Link& link : links) polled.push_back({link.socket, POLLIN, 0});
      if (poll(polled.data(), polled.size(), 5) <= 0) continue;
      for (std::size_t i = links.size(); i-- > 0;) {
        if (polled[i + 1].revents == 0 || serve(links[i])) continue;
        close(links[i].socket);
        links.erase(links.begin() + static_cast<std::ptrdiff_t>(i));
      }
      if (polled[0].revents == 0) continue;
      const int socket = accept(listening_.descriptor(), nullptr, nullptr);
      if (socket >= 0) links.push_back({count++, socket, ""});
    }
    for (const Link& link : links) close(link.socket);
  }

  bool serve(Link& link) {
    std::array<char, 65536> buffer;
    const ssize_t count = recv(link.socket, buffer.data(), buffer.size(), 0);
    if (count <= 0) return false;
    link.input.append(buffer.data(), static_cast<std::size_t>(count));
    for (std::size_t end = link.input.find('\n'); end != std::string::npos;
         end = link.input.find('\n')) {
      const Reply reply = answer_(link.number, link.input.substr(0, end));
      link.input.erase(0, end + 1);
      for (std::string_view rest = reply.text; !rest.empty();) {
        const ssize_t sent = send(link.socket, rest.data(), rest.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        rest.remove_prefix(static_cast<std::size_t>(sent));
      }
      if (reply.then_close) return false;
    }
    return true;
  }

  std::function<Reply(int, const std::string&)> answer_;
  ListeningSocket listening_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A request; null for hello.
nlohmann::json request_in(const std::string& line) {
  return line.starts_with("{") ? nlohmann::json::parse(line) : nlohmann::json();
}

/// The pointers to all values in a message, including nested ones.
void find_places(const nlohmann::json& value, const nlohmann::json::json_pointer& at,
                 std::vector<nlohmann::json::json_pointer>& places) {
  places.push_back(at);
  // One robot is enough, because the others are of the same kind, but all its devices.
  const std::size_t most = !at.empty() && at.back() == "robots" ? 1 : 100;
  for (std::size_t i = 0; value.is_array() && i < std::min(value.size(), most); ++i) {
    find_places(value[i], at / i, places);
  }
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) find_places(member, at / key, places);
}

TEST(LyingServers, FalseEvents_Explained) {
  const Served served;
  const nlohmann::json welcome = welcome_of(served);
  for (const std::string event : {R"({"event":"bye","message":5})",
                                  R"({"event":"bye"})",
                                  R"({"event":5})",
                                  R"({"event":{}})",
                                  R"({"event":"error","error":5,"message":{}})",
                                  R"({"event":"error","error":"x","message":5})",
                                  R"({"event":"error"})",
                                  R"([1,2])",
                                  R"(5)",
                                  R"({"id":"x"})",
                                  R"({"id":-1})",
                                  R"({"id":1,"error":"x","message":5})",
                                  R"({"id":1,"error":"session/finished","message":[]})",
                                  R"({"id":1})",
                                  R"({"id":1,"readings":5})",
                                  R"({"id":1,"readings":{"a":1}})",
                                  R"({"id":1,"readings":[5]})",
                                  R"({"id":1,"readings":[{"device":[0,0],"type":"laser"}]})",
                                  R"({"id":1,"overflow":"x"})",
                                  R"({"id":1,"overflow":-1})",
                                  R"({"id":1,"canvas":5})",
                                  R"({"id":1,"finished":1})",
                                  R"({"id":1,"data":"x"})"}) {
    const ScriptedServer server([&](int, const std::string& line) -> ScriptedServer::Reply {
      const nlohmann::json request = request_in(line);
      if (request.is_null()) return {said(welcome)};
      return {request["do"] == "read" ? event + '\n' : "", /*then_close=*/true};
    });
    const auto session = connect(server.port());
    try {
      session->wait();
      EXPECT_EQ(event, R"({"id":1})");
    } catch (const SessionError&) {
      // Correct; any other exception fails the test.
    }
  }
}

// Readings in CBOR, which the session decodes from the message's bytes. The answer to the first
// request follows the welcome at once.
TEST(LyingServers, FalseReadingsInCbor_Explained) {
  const Served served;
  nlohmann::json welcome = welcome_of(served);
  welcome["encoding"] = "cbor";
  sim::LaserReading scan;
  scan.ranges_m = {1.0, 2.0};
  std::string laser;
  protocol::append_cbor_reading({0, 0}, "laser", scan, laser);
  const std::string one = "\x81" + laser;
  const std::size_t ranges = one.find("ranges") + 6;  // tag 86 (two bytes), 16 bytes (one byte)
  const auto changed = [&](std::size_t at, char byte) {
    std::string bytes = one;
    bytes.at(at) = byte;
    return bytes;
  };
  const std::vector<std::string> lies = {
      changed(0, '\x82'),           // fewer readings than the list says
      changed(0, '\x80'),           // more
      changed(ranges + 1, '\x18'),  // another tag
      changed(ranges + 2, '\x4f'),  // no whole doubles
      changed(ranges + 2, '\x58'),  // a length beyond the end
      changed(ranges + 10, '\x7f').replace(ranges + 9, 1, "\xf0"),  // not finite
      changed(ranges - 1, 'x'),  // an unknown member instead of one that must be there
      one.substr(0, one.size() - 1),
      std::string("\x05"),
      std::string("\xa0"),
      std::string("\x81\x05"),
      std::string("\x81\xa0"),
      std::string("\x9f"),
      "\x9b" + std::string(8, '\x7f'),
      std::string(1000, '\x81'),
      ""};
  for (std::size_t i = 0; i <= lies.size(); ++i) {
    const std::string& readings = i < lies.size() ? lies[i] : one;
    const ScriptedServer server([&](int, const std::string&) -> ScriptedServer::Reply {
      nlohmann::json answer = {{"id", 1}, {"data", true}};
      answer["readings"] =
          nlohmann::json::binary({readings.begin(), readings.end()}, protocol::kEncodedItemTag);
      return {said(welcome) + protocol::encode(answer, protocol::Encoding::kCbor)};
    });
    const auto session = connect(server.port());
    std::string error;
    try {
      session->wait();
    } catch (const SessionError& e) {
      error = e.what();
    }
    EXPECT_EQ(error.empty(), i == lies.size()) << i << ": " << error;
  }
}

TEST(LyingServers, FalseWelcome_Explained) {
  const Served served;
  const nlohmann::json welcome = welcome_of(served);
  std::vector<nlohmann::json::json_pointer> places;
  find_places(welcome, nlohmann::json::json_pointer(), places);
  ASSERT_GT(places.size(), 30U);
  const std::vector<nlohmann::json> lies = {nullptr, -1, 1e300, "x", nlohmann::json::object()};
  int refused = 0;
  for (const auto& place : places) {
    for (const nlohmann::json& lie : lies) {
      nlohmann::json changed = welcome;
      changed[place] = lie;
      const ScriptedServer server([&](int, const std::string& line) -> ScriptedServer::Reply {
        const nlohmann::json request = request_in(line);
        if (request.is_null()) return {said(changed)};
        return {nlohmann::json{{"id", request.value("id", 0)}}.dump() + '\n'};
      });
      try {
        // Proxies read what the server reports about the devices.
        PlayerCc::PlayerClient client(connect(server.port()));
        PlayerCc::LaserProxy laser(&client, 0);
      } catch (const SessionError&) {
        ++refused;
      } catch (const PlayerCc::PlayerError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
}

// A thread that has its answer may record it late. This one must first destroy a hundred thousand
// lists. Meanwhile the other thread, which reads the connection, finds it closed and opens the next
// one.
TEST(SocketSessions, SubscriptionDuringReconnect_Kept) {
  const Served served;
  const nlohmann::json welcome = welcome_of(served);
  std::string chaff = ",\"chaff\":[[]";
  for (int i = 0; i < 300'000; ++i) chaff += ",[]";
  chaff += "]}\n";
  std::mutex mutex;
  std::vector<std::string> told;  // on the second connection
  std::promise<void> reading;
  std::promise<void> told_of_data;
  bool data_due = false;
  const ScriptedServer server(
      [&](int connection, const std::string& line) -> ScriptedServer::Reply {
        const nlohmann::json request = request_in(line);
        if (request.is_null()) return {said(welcome)};
        const std::string what = request["do"];
        std::string id = "{\"id\":" + std::to_string(request.value("id", 0));
        if (connection == 0 && what == "read") {
          reading.set_value();
          return {};
        }
        if (connection == 0 && what == "subscribe") return {id + chaff, /*then_close=*/true};
        const std::lock_guard lock(mutex);
        told.push_back(what);
        if (what == "read" && !data_due) {
          data_due = true;
          told_of_data.set_value();
        }
        if (what == "read") return {id + ",\"readings\":[],\"data\":true}\n"};
        return {id + "}\n"};
      });
  const auto session = connect(server.port());
  session->request(RetriesRequest{-1, 0.0});
  std::thread reader([&] { session->wait(); });
  reading.get_future().wait();
  session->request(SubscribeRequest{{0, 0}});
  reader.join();
  told_of_data.get_future().wait();
  const std::lock_guard lock(mutex);
  EXPECT_THAT(told, testing::Contains("subscribe"));
  EXPECT_EQ(std::count(told.begin(), told.end(), "subscribe"), 1);
}

TEST(SocketSessions, EarlyAnswer_ReadDespiteZeroTimeout) {
  const Served served;
  const nlohmann::json welcome = welcome_of(served);
  const nlohmann::json answer = {{"id", 1}, {"time", welcome["time"]}};
  // It came with the welcome, so it was there before it was requested.
  Relay relay(said(welcome, answer.dump() + '\n'));
  const auto session = connect(relay.port());
  session->request(AnswerTimeoutRequest{0.0});
  EXPECT_EQ(session->request(TimeRequest{}).sim_time_ns, 0);
}

// --- Unix sockets

TEST(UnixSockets, Session_DrivesAsByTcp) {
  const test_support::TemporaryFolder folder;
  ServerSettings listening;
  listening.unix_path = folder / "robots";
  const Served served("{}", listening);
  double by_tcp_m = 0.0;
  for (const bool tcp : {true, false}) {
    SocketSession session(tcp ? settings_for(served.port())
                              : settings_for("unix:" + listening.unix_path));
    const DeviceId motors = subscribe_position(session);
    session.send(motors, sim::TwistCommand{{.v_mps = 0.2}});
    const double begin_m = read(session).x_m;
    const double driven_m = read(session).x_m - begin_m;
    if (tcp) by_tcp_m = driven_m;
    EXPECT_GT(driven_m, 0.0);
  }
  EXPECT_GT(by_tcp_m, 0.0);
}

TEST(UnixSockets, HandedInDescriptor_ServesOneClient) {
  const Served served;
  int ends[2] = {-1, -1};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  served.server->adopt(ends[0]);
  const std::string address = "unix:fd=" + std::to_string(ends[1]);
  {
    SocketSession session(settings_for(address));
    subscribe_position(session);
    EXPECT_THAT(read(session).times_ns, testing::Not(testing::IsEmpty()));
  }
  const SessionError error = error_of([&] { SocketSession(settings_for(address)); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), AllOf(HasSubstr(address), HasSubstr("one client only")));
}

TEST(UnixSockets, NobodyListens_ErrorNamesPathAndCure) {
  const test_support::TemporaryFolder folder;
  const std::string address = "unix:" + (folder / "nothing");
  const SessionError error = error_of([&] { SocketSession(settings_for(address)); });
  EXPECT_EQ(error.code(), kDisconnected);
  EXPECT_THAT(error.what(), AllOf(HasSubstr(address), HasSubstr("playpen serve --unix")));
}

TEST(UnixSockets, InvalidNames_RefusedWithReason) {
  struct Case {
    const char* text;
    const char* why;
  };
  for (const Case& c :
       {Case{"unix:", "the path is missing"}, Case{"unix:@robots", "no permissions"},
        Case{"unix:fd=", "a whole number"}, Case{"unix:fd=-1", "a whole number"},
        Case{"unix:fd=7x", "a whole number"}}) {
    const SessionError error = error_of([&] { static_cast<void>(open_session(c.text, 6665)); });
    EXPECT_EQ(error.code(), kBadArgument) << c.text;
    EXPECT_THAT(error.what(), AllOf(HasSubstr(c.why), HasSubstr("unix:PATH"))) << c.text;
  }
}

TEST(UnixSockets, LongPath_RefusedWithItsLength) {
  const SessionError error = error_of([] {
    static_cast<void>(open_session("unix:/" + std::string(protocol::kMaxUnixPath, 'a'), 6665));
  });
  EXPECT_EQ(error.code(), kBadArgument);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("108 bytes"), HasSubstr("107")));
}

}  // namespace
}  // namespace playerlike
