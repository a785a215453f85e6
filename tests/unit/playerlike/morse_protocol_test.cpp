// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// MORSE's protocol, service by service and stream by stream, on a real server with raw sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "patience.h"
#include "patient_host.h"
#include "playerlike/server/server.h"
#include "playerlike/server/token_throttle.h"
#include "raw_client.h"
#include "server/morse_services.h"
#include "sim/core/number_text.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using nlohmann::json;
using test_support::RawClient;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

/// An answer: its id, status and JSON (null: none).
struct Answer {
  std::string id;
  std::string status;
  json result;
};

Answer parse(const std::string& line) {
  const auto first = line.find(' ');
  const auto second = line.find(' ', first + 1);
  Answer answer{line.substr(0, first), line.substr(first + 1, second - first - 1), nullptr};
  if (second != std::string::npos) answer.result = json::parse(line.substr(second + 1));
  return answer;
}

/// A client of MORSE.
class MorseClient {
 public:
  explicit MorseClient(int port) : socket_("127.0.0.1", port) {}

  void send(const std::string& line) { socket_.send(line + '\n'); }
  Answer receive() { return parse(socket_.line()); }
  /// Sends a request and waits for the next answer, which must have the request's id.
  Answer ask(const std::string& request) {
    const std::string id = std::to_string(++last_id_);
    send(id + ' ' + request);
    const Answer answer = receive();
    EXPECT_EQ(answer.id, id) << request;
    return answer;
  }
  /// The result of a request that must succeed.
  json get(const std::string& request) {
    const Answer answer = ask(request);
    EXPECT_EQ(answer.status, "SUCCESS") << request << ": " << answer.result;
    return answer.result;
  }
  /// The error of a request that must fail.
  std::string refusal(const std::string& request) {
    const Answer answer = ask(request);
    EXPECT_EQ(answer.status, "FAILED") << request << ": " << answer.result;
    return answer.result.is_string() ? answer.result.get<std::string>() : answer.result.dump();
  }
  void sleep(double seconds) { get("time sleep [" + sim::shortest_text(seconds) + "]"); }
  /// The result of a sensor's get_local_data; an empty object before its first reading.
  json data(const std::string& component) {
    const Answer answer = ask(component + " get_local_data");
    return answer.status == "SUCCESS" ? answer.result : json::object();
  }

 private:
  RawClient socket_;
  int last_id_ = 0;
};

class MorseProtocol : public testing::Test {
 protected:
  MorseProtocol() {
    settings.port = 0;
    settings.stream_port = 0;
  }
  ~MorseProtocol() override {
    if (server) server->stop();
  }

  MorseClient start(RunSettings run = {}) {
    sim::WorldDescription world =
        sim::load_world(std::string(PLAYPEN_SOURCE_DIR "/worlds/examples/") + world_name + ".json");
    world.simulation.own_sensors_only = own_sensors_only;
    world.simulation.objects_locked = objects_locked;
    host = test::patient_host(std::move(world), std::move(run));
    server = std::make_unique<Server>(host, settings, [this](sim::LogLevel, std::string_view text) {
      const std::lock_guard lock(mutex_);
      log_ += std::string(text) + '\n';
    });
    return connect();
  }
  [[nodiscard]] MorseClient connect() const { return MorseClient(server->port()); }
  /// A connection to a component's stream, after the server has accepted it.
  RawClient stream(MorseClient& client, const std::string& component) {
    return accepted(client.get("simulation get_stream_port [\"" + component + "\"]"));
  }
  /// A connection to a port, after the server has accepted it.
  RawClient accepted(int port) {
    const std::size_t before = server->connections();
    RawClient connection("127.0.0.1", port);
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while (server->connections() <= before && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    EXPECT_GT(server->connections(), before);
    return connection;
  }
  std::string logged() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

  ServerSettings settings;
  std::shared_ptr<Host> host;
  std::unique_ptr<Server> server;
  std::string world_name = "remote";
  bool own_sensors_only = false;
  bool objects_locked = false;

 private:
  std::mutex mutex_;
  std::string log_;
};

// --- Requests

TEST_F(MorseProtocol, Lines_ParsedAsInMorse) {
  MorseClient client = start();
  client.send("  a1   simulation \t list_robots  \r");
  Answer answer = client.receive();
  EXPECT_EQ(answer.id, "a1");
  EXPECT_EQ(answer.result, json::parse(R"(["r1", "r2"])"));
  EXPECT_EQ(client.get("simulation list_robots []"), answer.result);
  EXPECT_EQ(client.get("simulation list_robots null"), answer.result);
  // Nothing that needs an answer.
  client.send("\n   \n");
  EXPECT_EQ(client.get("time now"), 0.0);
}

TEST_F(MorseProtocol, InvalidRequest_AnsweredAndConnectionStays) {
  MorseClient client = start();
  for (const auto& [line, id, part] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {"x", "x", "Malformed request! "},
           {"x simulation", "x", "Malformed request"},
           {"x nothing at_all", "x", "there is no component \"nothing\""},
           {"x simulation nothing", "x", "nothing has not been registered for simulation; it has"},
           {"x r1.pose goto [1, 2, 3]", "x", "goto has not been registered for r1.pose"},
           {"x simulation details [", "x",
            "Invalid request syntax: error while parsing the parameters: <[>. "},
           {"x simulation details {\"a\": 1}", "x", "arguments are a JSON list, found object"},
           {"x simulation details 3", "x", "found number"},
           {"x simulation details [1e999]", "x", "protocol/"},
           {"x simulation details [1]", "x", "wrong # of parameters"},
           {"x r1.motion set_speed", "x", "parameters expected"},
           {"x r1.motion set_speed [1, 2, 3]", "x", "expected 2 (v, w), found 3"},
           {"x r1.waypoint goto [1, 2]", "x", "wrong # of parameters"},
           {"x r1.motion set_speed [true, 0]", "x", "argument 1 of set_speed(v, w)"},
           {"x r1.motion set_speed [0, \"fast\"]", "x", "found \"fast\""},
           {"x time sleep [-1]", "x", "expected a number from 0"},
           {"x playpen nothing", "x", "only hello and token"},
           {"x playpen hello [1, 2]", "x", "wrong # of parameters"},
           {"x playpen token [1]", "x", "expected the token"},
           {"\xff simulation details", "-", "an id is"},
           {"\x01 simulation details", "-", "an id is"},
           {std::string(81, 'i') + " simulation details", "-", "an id is"},
       }) {
    client.send(line);
    const Answer answer = client.receive();
    EXPECT_EQ(answer.id, id) << line;
    EXPECT_EQ(answer.status, "FAILED") << line;
    EXPECT_THAT(answer.result.get<std::string>(), HasSubstr(part)) << line;
  }
  EXPECT_EQ(client.get("time now"), 0.0);
}

TEST_F(MorseProtocol, Ids_MayBeUtf8) {
  MorseClient client = start();
  client.send("\u00e41 time now");
  EXPECT_EQ(client.receive().id, "\u00e41");
}

TEST_F(MorseProtocol, InvalidUtf8_RefusedOrReplaced) {
  MorseClient client = start();
  client.send("1 simulation get_stream_port [\"\xff\xfe\"]");
  EXPECT_EQ(client.receive().status, "FAILED");
  client.send("2 \xff\xfe now");
  EXPECT_THAT(client.receive().result.get<std::string>(), HasSubstr("\xef\xbf\xbd"));
}

TEST_F(MorseProtocol, LongLine_AnsweredAndClosed) {
  settings.limits.message_bytes = 1000;
  start();
  RawClient client("127.0.0.1", server->port());
  static_cast<void>(client.send_if_open(std::string(5000, 'x')));
  EXPECT_THAT(client.rest(), StartsWith("- FAILED \"protocol/too-long"));
}

// --- simulation

TEST_F(MorseProtocol, Details_ListComponentsServicesAndStreams) {
  MorseClient client = start();
  const json details = client.get("simulation details");
  EXPECT_EQ(details["environment"], "remote");
  ASSERT_THAT(details["robots"], SizeIs(2));
  const json& robot = details["robots"][0];
  EXPECT_EQ(robot["name"], "r1");
  EXPECT_EQ(robot["type"], "s1r");
  const json& components = robot["components"];
  EXPECT_THAT(components, SizeIs(15));
  const json& pose = components["r1.pose"];
  EXPECT_EQ(pose["type"], "Pose");
  EXPECT_EQ(pose["stream_interfaces"], json::parse(R"([["socket", "OUT"]])"));
  EXPECT_EQ(pose["services"], json::parse(R"(["get_local_data", "get_configurations",
                                              "get_properties", "set_property"])"));
  const json& waypoint = components["r1.waypoint"];
  EXPECT_EQ(waypoint["stream_interfaces"], json::parse(R"([["socket", "IN"]])"));
  EXPECT_THAT(waypoint["services"].get<std::vector<std::string>>(),
              AllOf(Contains("goto"), Contains("resume"), Not(Contains("get_local_data"))));
  EXPECT_FALSE(components["r1.pen"].contains("stream_interfaces"));
  EXPECT_EQ(components["r1.increments"]["type"], "Odometry");
  EXPECT_EQ(components["r1.robot_properties"]["stream_interfaces"][0][1], "OUT");
  EXPECT_FALSE(details["robots"][1]["components"].contains("r2.sonar"));
}

TEST_F(MorseProtocol, StreamPorts_Stable) {
  MorseClient client = start();
  const auto names = client.get("simulation list_streams").get<std::vector<std::string>>();
  EXPECT_THAT(names, AllOf(Contains("r1.pose"), Contains("r2.motion"), Not(Contains("r1.pen"))));
  const json ports = client.get("simulation get_all_stream_ports");
  EXPECT_THAT(ports, SizeIs(names.size()));
  EXPECT_EQ(client.get("simulation get_stream_port [\"r1.pose\"]"), ports["r1.pose"]);
  EXPECT_NE(ports["r1.pose"], ports["r2.pose"]);
  EXPECT_THAT(client.refusal("simulation get_stream_port [\"r1.pen\"]"),
              HasSubstr("Stream unavailable for component r1.pen"));
  EXPECT_THAT(client.refusal("simulation get_stream_port [3]"), HasSubstr("expected a text"));
}

TEST_F(MorseProtocol, StreamPorts_CountUpFromFirst) {
  settings.stream_port = 42'000;  // whether or not it is free: the server uses the next free ones
  MorseClient client = start();
  const int first = client.get("simulation get_stream_port [\"r2.pose\"]");
  const int second = client.get("simulation get_stream_port [\"r1.pose\"]");
  EXPECT_GE(first, 42'000);
  EXPECT_GT(second, first);
}

TEST_F(MorseProtocol, Reset_RestoresRobotsAndEndsGotos) {
  MorseClient client = start();
  client.get("r1.motion set_speed [0.3, 0]");
  client.get("r1.pen set_pixel [3, 4, 1, 2, 3]");
  client.sleep(1.0);
  EXPECT_NEAR(client.get("r1.pose get_local_data")["x"], 1.1, 0.01);
  // It must not arrive before.
  client.get("simulation set_object_dynamics [\"r1\", false]");
  client.send("g r1.waypoint goto [2, 1, 0]");
  client.send("r simulation reset_objects");
  EXPECT_EQ(client.receive().result, "Objects restored to initial position");
  const Answer end = client.receive();
  EXPECT_EQ(end.id, "g");
  EXPECT_EQ(end.status, "PREEMPTED");
  client.sleep(0.2);
  EXPECT_DOUBLE_EQ(client.get("r1.pose get_local_data")["x"], 0.8);
  EXPECT_EQ(client.get("r1.pen get_pixel [3, 4]"), json::parse("[0, 0, 0, 0]"));
}

TEST_F(MorseProtocol, QuitAndTerminate_AnswerAndEndServer) {
  for (const std::string service : {"quit", "terminate"}) {
    MorseClient client = start();
    EXPECT_FALSE(server->done());
    EXPECT_EQ(client.get("simulation " + service), nullptr);
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while (!server->done() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_TRUE(server->done()) << service;
    server.reset();
  }
}

TEST_F(MorseProtocol, DeactivatedComponent_IdleUntilActivated) {
  MorseClient client = start();
  client.get("simulation deactivate [\"r1.pose\"]");
  client.get("simulation deactivate [\"r1.motion\"]");
  client.sleep(0.5);
  EXPECT_THAT(client.refusal("r1.pose get_local_data"), HasSubstr("no reading yet"));
  EXPECT_THAT(client.refusal("r1.motion set_speed [1, 0]"), Not(IsEmpty()));
  client.get("simulation activate [\"r1.pose\"]");
  client.sleep(0.5);
  EXPECT_DOUBLE_EQ(client.get("r1.pose get_local_data")["timestamp"], 1.0);
  EXPECT_THAT(client.refusal("simulation activate [\"r1.nothing\"]"), HasSubstr("no component"));
  EXPECT_THAT(client.refusal("simulation activate [\"r1.robot_properties\"]"),
              HasSubstr("is no device"));
}

TEST_F(MorseProtocol, SuspendedDynamics_HoldRobots) {
  MorseClient client = start();
  client.get("r1.motion set_speed [0.3, 0]");
  EXPECT_EQ(client.get("simulation suspend_dynamics"), "Physics is suspended");
  client.sleep(1.0);
  EXPECT_DOUBLE_EQ(client.get("r1.pose get_local_data")["x"], 0.8);
  EXPECT_EQ(client.get("simulation restore_dynamics"), "Physics is resumed");
  EXPECT_EQ(client.get("simulation set_object_dynamics [\"r1\", false]"), false);
  client.sleep(1.0);
  EXPECT_DOUBLE_EQ(client.get("r1.pose get_local_data")["x"], 0.8);
  EXPECT_EQ(client.get("simulation set_object_dynamics [\"r1\", true]"), true);
  client.sleep(1.0);
  EXPECT_GT(client.get("r1.pose get_local_data")["x"], 1.0);
  EXPECT_THAT(client.refusal("simulation set_object_dynamics [\"nobody\", true]"), Not(IsEmpty()));
  EXPECT_THAT(client.refusal("simulation set_object_dynamics [\"r1\", 1]"),
              HasSubstr("expected true or false"));
}

TEST_F(MorseProtocol, SceneObjects_ListedWithVisibility) {
  MorseClient client = start();
  json objects = client.get("simulation get_scene_objects");
  EXPECT_EQ(objects["r1"], json::parse("[{}, [0.8, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]"));
  EXPECT_TRUE(objects.contains("pillar"));
  EXPECT_TRUE(objects.contains("gate"));
  const auto visibility = [&](const std::string& name, const std::string& visible) {
    return client.get("simulation set_object_visibility [\"" + name + "\", " + visible +
                      ", false]");
  };
  const auto gate_is_up = [&] {
    return host->with_simulation([](const sim::Simulation& simulation) {
      return simulation.find_object("gate").value().extended;
    });
  };
  EXPECT_FALSE(gate_is_up());
  EXPECT_EQ(visibility("gate", "true"), true);
  EXPECT_TRUE(gate_is_up());
  EXPECT_EQ(visibility("gate", "false"), false);
  EXPECT_FALSE(gate_is_up());
  // It cannot be hidden, and a message says so.
  EXPECT_EQ(visibility("pillar", "false"), true);
  EXPECT_EQ(visibility("r1", "false"), true);
  EXPECT_THAT(client.refusal("simulation set_object_visibility [\"ghost\", true, false]"),
              HasSubstr("does not appear in the scene"));
  // A robot stands where the block would come up.
  client.get("r1.teleport translate [2.2, -0.4]");
  EXPECT_THAT(client.refusal("simulation set_object_visibility [\"gate\", true, false]"),
              HasSubstr("a robot stands on it"));
}

TEST_F(MorseProtocol, DebugLogLevel_LogsRequestsOfComponent) {
  MorseClient client = start();
  client.get("r1.motion stop");
  EXPECT_THAT(logged(), Not(HasSubstr("r1.motion stop")));
  EXPECT_EQ(client.get("simulation set_log_level [\"r1.motion\", \"DEBUG\"]"), nullptr);
  client.get("r1.motion stop");
  EXPECT_THAT(logged(), HasSubstr("r1.motion stop []"));
  client.get("simulation set_log_level [\"time\", 10]");
  client.get("time now");
  EXPECT_THAT(logged(), HasSubstr("time now"));
  EXPECT_THAT(client.refusal("simulation set_log_level [\"time\", \"LOUD\"]"),
              HasSubstr("expected DEBUG, INFO"));
  EXPECT_THAT(client.refusal("simulation set_log_level [\"nothing\", 10]"),
              HasSubstr("no component"));
}

// --- time

TEST_F(MorseProtocol, TimeAndSleep_ReportAndAdvance) {
  MorseClient client = start();
  EXPECT_EQ(client.get("time now"), 0.0);
  EXPECT_EQ(client.get("time mode"), "Fixed Simulation Step");
  client.sleep(1.25);
  EXPECT_DOUBLE_EQ(client.get("time now"), 1.25);
  const json statistics = client.get("time statistics");
  EXPECT_EQ(statistics["steps"], 125);
  EXPECT_EQ(statistics["mode"], "lockstep");
  EXPECT_GT(statistics["mean_time"], 0.0);
  EXPECT_THAT(client.refusal("time set_time_scale [2]"), HasSubstr("lockstep"));
  EXPECT_THAT(client.refusal("time set_time_scale [0]"), HasSubstr("expected a number"));
}

TEST_F(MorseProtocol, TimeScale_ChangesPacedSpeed) {
  RunSettings run;
  run.time_mode = sim::TimeMode::kPaced;
  run.time_factor = 1e-3;
  run.start_at_once = true;
  MorseClient client = start(run);
  EXPECT_EQ(client.get("time set_time_scale [1000]"), true);
  client.sleep(5.0);  // at the first factor it would take more than an hour
  EXPECT_GE(client.get("time now"), 5.0);
  EXPECT_EQ(client.get("time statistics")["mode"], "paced");
}

TEST_F(MorseProtocol, Sleeps_RunInParallel) {
  settings.sync_port = 0;  // time stands until all of them wait
  MorseClient client = start();
  MorseClient other = connect();
  // Both are accepted when they have answers: the next connection is the clock's.
  client.get("time now");
  other.get("time now");
  RawClient clock = accepted(server->sync_port());
  client.send("long time sleep [3]");
  client.send("short time sleep [1]");
  client.get("time now");
  other.send("short time sleep [2]");
  other.get("time now");
  clock.send(std::string(300, '\n'));
  EXPECT_EQ(client.receive().id, "short");
  EXPECT_EQ(other.receive().status, "SUCCESS");
  const Answer answer = client.receive();
  EXPECT_EQ(answer.id, "long");
  EXPECT_EQ(answer.status, "SUCCESS");
  EXPECT_EQ(answer.result, nullptr);
}

TEST_F(MorseProtocol, CancelledSleep_PreemptedAndUnknownIdsIgnored) {
  RunSettings run;  // in lockstep, the sleep would end before the cancel arrives
  run.time_mode = sim::TimeMode::kPaced;
  MorseClient client = start(run);
  MorseClient other = connect();
  client.send("a time sleep [1000]");
  other.send("a cancel");  // the id `a` of another connection: not this one
  EXPECT_EQ(other.ask("time mode").status, "SUCCESS");
  client.send("b cancel\na cancel");
  const Answer answer = client.receive();
  EXPECT_EQ(answer.id, "a");
  EXPECT_EQ(answer.status, "PREEMPTED");
  client.send("a cancel");  // no longer
  client.get("time mode");
}

TEST_F(MorseProtocol, EndOfRun_FailsPendingRequests) {
  RunSettings run;
  run.duration_s = 1.0;
  MorseClient client = start(run);
  EXPECT_THAT(client.refusal("time sleep [5]"), HasSubstr("session/finished"));
  EXPECT_THAT(client.refusal("time sleep [5]"), HasSubstr("session/finished"));
  EXPECT_THAT(client.refusal("r1.waypoint goto [2, 1, 0]"), HasSubstr("session/finished"));
  EXPECT_THAT(client.refusal("r1.motion set_speed [1, 0]"), HasSubstr("session/finished"));
  EXPECT_DOUBLE_EQ(client.get("time now"), 1.0);
}

// --- arena

TEST_F(MorseProtocol, Arena_ChangesOnCommand) {
  world_name = "living_arena";
  MorseClient client = start();
  EXPECT_EQ(client.get("arena list_configurations"), json::parse(R"(["closed", "open"])"));
  EXPECT_EQ(client.get("arena get_configuration"), "");
  EXPECT_EQ(client.get("arena set_configuration [\"open\"]"), nullptr);
  EXPECT_EQ(client.get("arena get_configuration"), "open");
  json state = client.get("arena get_state");
  EXPECT_EQ(state["timestamp"], 0.0);
  EXPECT_EQ(state["configuration"], "open");
  EXPECT_EQ(state["blocks"]["gate"], json::parse(R"({"state": "sinking", "height": 0.16})"));
  EXPECT_EQ(state["blocks"]["side"]["state"], "extended");
  EXPECT_EQ(state["timers"]["opening"], json::parse(R"({"enabled": true, "count": 0})"));
  EXPECT_EQ(state["traps"]["goal"]["enabled"], true);
  EXPECT_EQ(state["scores"], json::parse(R"({"runner": 0.0, "chaser": 0.0})"));
  EXPECT_EQ(state["verdict"], nullptr);
  EXPECT_EQ(client.get("arena extend [\"gate\"]"), "rising");
  EXPECT_EQ(client.get("arena retract [\"gate\"]"), "sinking");
  EXPECT_EQ(client.get("arena retract [\"side\"]"), "retracted");
  client.get("arena disable [\"goal\"]");
  client.get("arena disable [\"opening\"]");
  client.get("arena enable [\"closing\"]");
  client.sleep(3.0);
  state = client.get("arena get_state");
  EXPECT_EQ(state["blocks"]["gate"], json::parse(R"({"state": "retracted", "height": 0.0})"));
  EXPECT_EQ(state["traps"]["goal"]["enabled"], false);
  EXPECT_EQ(state["timers"]["opening"]["enabled"], false);
  EXPECT_NEAR(state["timers"]["closing"]["time_left"].get<double>(), 5.0, 1e-9);
}

TEST_F(MorseProtocol, Arena_ReportsEventsAndVerdict) {
  world_name = "living_arena";
  MorseClient client = start();
  EXPECT_EQ(client.get("arena events"), json::parse(R"({"events": [], "newest": 0, "lost": 0})"));
  client.get("arena set_configuration [\"open\"]");
  client.sleep(2.0);
  const json events = client.get("arena events [3]");
  const json last = json::parse(R"({"number": 5, "timestamp": 1.6, "kind": "retracted",
      "what": "gate", "who": "", "text": "", "value": 0.0})");
  EXPECT_EQ(events["newest"], 5);
  EXPECT_EQ(events["events"].size(), 2U);
  EXPECT_EQ(events["events"].back(), last);
  client.get("runner.motion set_speed [0.5, 0]");
  EXPECT_THAT(client.refusal("time sleep [60]"), HasSubstr("over"));
  const json verdict = client.get("arena get_state")["verdict"];
  EXPECT_EQ(verdict["passed"], true);
  EXPECT_EQ(verdict["reason"], "the runner is at the goal");
  EXPECT_GT(verdict["timestamp"], 2.0);
  EXPECT_EQ(client.get("arena get_state")["scores"]["runner"], 10.0);
}

TEST_F(MorseProtocol, Arena_RefusesInvalidRequests) {
  world_name = "living_arena";
  MorseClient client = start();
  for (const auto& [request, part] : std::vector<std::pair<std::string, std::string>>{
           {"set_configuration [\"opne\"]", "did you mean \"open\"? this world has: closed, open"},
           {"set_configuration [3]", "argument 1 of set_configuration(name): expected a text"},
           {"set_configuration", "parameters expected"},
           {"extend [\"gaet\"]", "did you mean \"gate\"?"},
           {"extend [\"wall1\"]", "static"},
           {"retract [\"nothing\"]", "there is no dynamic block named \"nothing\""},
           {"enable [\"openign\"]",
            "there is no timer or trap named \"openign\"; did you mean \"opening\"?"},
           {"disable [\"x\"]", "this world has: opening, closing, plate, caught, goal"},
           {"events [-1]", "expected a whole number from 0"},
           {"close", "close has not been registered for arena; it has: list_configurations"}}) {
    EXPECT_THAT(client.refusal("arena " + request), HasSubstr(part)) << request;
  }
  EXPECT_EQ(client.get("arena events")["newest"], 0);
  client.get("simulation set_log_level [\"arena\", 10]");
  client.get("arena get_configuration");
  EXPECT_THAT(logged(), HasSubstr("arena get_configuration"));
}

TEST_F(MorseProtocol, ArenaWithoutController_HasBlocks) {
  MorseClient client = start();
  EXPECT_EQ(client.get("arena list_configurations"), json::array());
  EXPECT_EQ(client.get("arena extend [\"gate\"]"), "extended");
  EXPECT_THAT(client.refusal("arena set_configuration [\"open\"]"),
              HasSubstr("this world has none"));
  EXPECT_THAT(client.refusal("arena enable [\"t\"]"), HasSubstr("this world has none"));
}

TEST_F(MorseProtocol, LockedArena_ReadOnly) {
  world_name = "living_arena";
  objects_locked = true;
  MorseClient client = start();
  for (const std::string request :
       {"set_configuration [\"open\"]", "extend [\"side\"]", "retract [\"gate\"]",
        "enable [\"closing\"]", "disable [\"goal\"]"}) {
    EXPECT_THAT(client.refusal("arena " + request), HasSubstr("lock_objects"));
  }
  EXPECT_THAT(client.refusal("simulation set_object_visibility [\"gate\", false, false]"),
              HasSubstr("lock_objects"));
  EXPECT_EQ(client.get("arena get_state")["blocks"]["gate"]["state"], "extended");
}

TEST_F(MorseProtocol, Arena_AcceptsTokensOfAllRobots) {
  world_name = "living_arena";
  own_sensors_only = true;
  settings.access.robot_tokens = {{"runner", "first"}, {"chaser", "second"}};
  MorseClient client = start();
  client.get("playpen token [\"first\"]");
  for (const std::string request :
       {"set_configuration [\"open\"]", "extend [\"side\"]", "enable [\"closing\"]", "get_state",
        "events", "list_configurations", "get_configuration"}) {
    EXPECT_THAT(client.refusal("arena " + request), HasSubstr("access/denied")) << request;
  }
  client.get("playpen token [\"second\"]");
  client.get("arena set_configuration [\"open\"]");
  EXPECT_EQ(client.get("arena events")["newest"], 4);
}

// --- Actuators

TEST_F(MorseProtocol, Motion_DrivesAndStops) {
  MorseClient client = start();
  EXPECT_EQ(client.get("r1.motion set_speed [0.2, 0]"), nullptr);
  client.sleep(1.0);
  EXPECT_NEAR(client.get("r1.pose get_local_data")["x"], 1.0, 1e-9);
  client.get("r1.motion stop");
  client.sleep(1.0);
  EXPECT_NEAR(client.get("r1.pose get_local_data")["x"], 1.0, 1e-9);
}

TEST_F(MorseProtocol, Goto_AnsweredOnArrival) {
  MorseClient client = start();
  EXPECT_EQ(client.get("r1.waypoint get_status"), "Arrived");
  const Answer answer = client.ask("r1.waypoint goto [2, 1.5, 0, 0.1, 0.5]");
  EXPECT_EQ(answer.status, "SUCCESS");
  EXPECT_EQ(answer.result, "Arrived");
  EXPECT_EQ(client.get("r1.waypoint get_status"), "Arrived");
  client.sleep(0.1);
  const json pose = client.get("r1.pose get_local_data");
  EXPECT_LT(std::hypot(pose["x"].get<double>() - 2.0, pose["y"].get<double>() - 1.5), 0.1);
}

TEST_F(MorseProtocol, Goto_PreemptedByOtherConnection) {
  RunSettings run;
  run.time_mode = sim::TimeMode::kPaced;
  MorseClient client = start(run);
  MorseClient other = connect();
  client.send("first r1.waypoint goto [3.5, 1, 0]");
  client.get("r1.waypoint get_status");
  other.send("first r1.waypoint goto [3, 1, 0]");
  Answer answer = client.receive();
  EXPECT_EQ(answer.id, "first");
  EXPECT_EQ(answer.status, "PREEMPTED");
  EXPECT_EQ(answer.result, nullptr);
  // setdest also sets a new goal.
  EXPECT_EQ(client.get("r1.waypoint setdest [3.5, 1, 0, 0.1]"), true);
  answer = other.receive();
  EXPECT_EQ(answer.status, "PREEMPTED");
  EXPECT_EQ(client.get("r1.waypoint setdest [0.8, 1, 0, 2]"), false);  // there already
  EXPECT_EQ(client.get("r1.waypoint get_status"), "Transit");
}

TEST_F(MorseProtocol, CancelledGoto_StopsRobot) {
  RunSettings run;
  run.time_mode = sim::TimeMode::kPaced;
  MorseClient client = start(run);
  client.send("g r1.waypoint goto [3.5, 1, 0]");
  client.send("g cancel");
  const Answer answer = client.receive();
  EXPECT_EQ(answer.id, "g");
  EXPECT_EQ(answer.status, "PREEMPTED");
  EXPECT_EQ(client.get("r1.waypoint get_status"), "Stop");
}

TEST_F(MorseProtocol, StoppedGoto_WaitsForResume) {
  MorseClient client = start();
  MorseClient other = connect();
  client.get("simulation set_object_dynamics [\"r1\", false]");  // or it would be there at once
  client.send("g r1.waypoint goto [1.5, 1, 0]");
  client.get("r1.waypoint get_status");
  EXPECT_EQ(other.get("r1.waypoint stop"), "Stop");
  other.get("simulation set_object_dynamics [\"r1\", true]");
  other.sleep(1.0);
  EXPECT_EQ(other.get("r1.waypoint get_status"), "Stop");
  EXPECT_EQ(other.get("r1.waypoint resume"), "Transit");
  const Answer answer = client.receive();
  EXPECT_EQ(answer.status, "SUCCESS");
  EXPECT_EQ(answer.result, "Arrived");
}

TEST_F(MorseProtocol, Goto_ContinuesAfterClientLeaves) {
  MorseClient client = start();
  {
    MorseClient leaving = connect();
    leaving.get("simulation set_object_dynamics [\"r1\", false]");
    leaving.send("g r1.waypoint goto [1.5, 1, 0]");
    leaving.get("r1.waypoint get_status");
  }
  client.get("simulation set_object_dynamics [\"r1\", true]");
  client.sleep(10.0);
  EXPECT_EQ(client.get("r1.waypoint get_status"), "Arrived");
  EXPECT_GT(client.get("r1.pose get_local_data")["x"], 1.3);
}

TEST_F(MorseProtocol, Waypoint_ChecksArguments) {
  MorseClient client = start();
  EXPECT_THAT(client.refusal("r1.waypoint goto [1, 1, \"z\"]"), HasSubstr("argument 3 of goto"));
  EXPECT_THAT(client.refusal("r1.waypoint goto [1, 1, 0, 0]"), HasSubstr("argument 4 of goto"));
  EXPECT_THAT(client.refusal("r1.waypoint goto [1, 1, 0, 0.1, -1]"),
              HasSubstr("argument 5 of goto"));
  EXPECT_THAT(client.refusal("r1.waypoint resume"), Not(IsEmpty()));  // nothing to go on to
}

TEST_F(MorseProtocol, Teleport_MovesTurnsOrExplains) {
  MorseClient client = start();
  client.get("r1.teleport translate [0.5]");
  client.get("r1.teleport translate [0, -0.25, 0]");
  client.get("r1.teleport rotate [0, 0, 1.5]");
  client.sleep(0.1);
  const json pose = client.get("r1.pose get_local_data");
  EXPECT_NEAR(pose["x"], 1.3, 1e-9);
  EXPECT_NEAR(pose["y"], 0.75, 1e-9);
  EXPECT_NEAR(pose["yaw"], 1.5, 1e-9);
  EXPECT_THAT(client.refusal("r1.teleport translate [50]"), Not(IsEmpty()));
  EXPECT_THAT(client.refusal("r1.teleport translate [0, 0, 1]"), HasSubstr("the floor is flat"));
  EXPECT_THAT(client.refusal("r1.teleport rotate [1]"), HasSubstr("by yaw only"));
}

// --- The pen

TEST_F(MorseProtocol, Pen_DrawsAndReads) {
  MorseClient client = start();
  client.get("r1.pen set_pixel [1, 2, 10, 20, 30]");
  EXPECT_EQ(client.get("r1.pen get_pixel [1, 2]"), json::parse("[10, 20, 30, 255]"));
  client.get("r1.pen set_line [0, 0, 0, 3, 1, 2, 3, 255]");
  EXPECT_EQ(client.get("r2.pen get_pixel [0, 3]"), json::parse("[1, 2, 3, 255]"));
  EXPECT_EQ(client.get("r1.pen get_pixel [-1, 0]"), nullptr);
  client.get("r1.pen update_image_data [[[5, 5, 9, 8, 7], [6, 5, 1, 1, 1, 0]]]");
  EXPECT_EQ(client.get("r1.pen get_pixel [5, 5]"), json::parse("[9, 8, 7, 255]"));
  EXPECT_EQ(client.get("r1.pen get_pixel [6, 5]"), json::parse("[0, 0, 0, 0]"));
  client.get("r1.pen clear");
  EXPECT_EQ(client.get("r1.pen get_pixel [5, 5]"), json::parse("[0, 0, 0, 0]"));
  for (const char* bad :
       {"set_pixel [1, 2, 256, 0, 0]", "set_pixel [1.5, 2, 0, 0, 0]",
        "set_pixel [3000000000, 2, 0, 0, 0]", "update_image_data [[[1, 2, 3]]]",
        "update_image_data [[[1, 2, 3, 4, 5.5]]]", "update_image_data [[[1, 2, 3, 4, 700]]]",
        "update_image_data [[3]]", "update_image_data [3]", "set_image_data [[1, 2]]"}) {
    EXPECT_THAT(client.refusal("r1.pen " + std::string(bad)), HasSubstr("expected")) << bad;
  }
}

TEST_F(MorseProtocol, Pen_TransfersWholeImages) {
  MorseClient client = start();
  EXPECT_EQ(client.get("r1.pen resize_canvas [3, 2]"), json::parse("[3, 2]"));
  EXPECT_EQ(client.get("r1.pen get_canvas_size"), json::parse("[3, 2]"));
  json image = json::array();
  for (int i = 0; i < 18; ++i) image.push_back(i * 10);
  client.get("r1.pen set_image_data [" + image.dump() + "]");
  EXPECT_EQ(client.get("r1.pen get_image_data"), image);
  EXPECT_EQ(client.get("r1.pen get_pixel [2, 1]"), json::parse("[150, 160, 170, 255]"));
  json with_alpha = json::array();
  for (int i = 0; i < 24; ++i) with_alpha.push_back(i);
  client.get("r1.pen set_image_data [" + with_alpha.dump() + "]");
  EXPECT_EQ(client.get("r1.pen get_image_data [4]"), with_alpha);
  image[0] = 256;
  EXPECT_THAT(client.refusal("r1.pen set_image_data [" + image.dump() + "]"),
              HasSubstr("but there is 256"));
  EXPECT_THAT(client.refusal("r1.pen resize_canvas [0, 2]"), HasSubstr("from 1 to 8192"));
  EXPECT_EQ(client.get("r1.pen get_cell_size"), 0.02);
}

TEST_F(MorseProtocol, Pen_SavesIntoOutputFolderOnly) {
  const test_support::TemporaryFolder folder;
  RunSettings run;
  run.output_folder = folder.path();
  MorseClient client = start(run);
  client.get("r1.pen save_image_copy [\"mine\"]");
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(folder.path()) / "mine.png"));
  EXPECT_THAT(client.refusal("r1.pen save_image_copy [\"../mine\"]"),
              HasSubstr("session/bad-argument"));
  EXPECT_EQ(client.get("r1.pen get_view_mode"), "ground");
  client.get("r1.pen set_view_mode [\"mini-map\"]");
  EXPECT_EQ(client.get("r1.pen get_view_mode"), "mini-map");
  EXPECT_THAT(client.refusal("r1.pen set_view_mode [\"upside-down\"]"), HasSubstr("mini-map"));
}

// --- Sensors

TEST_F(MorseProtocol, Sensors_ReportData) {
  MorseClient client = start();
  EXPECT_THAT(client.refusal("r1.pose get_local_data"), HasSubstr("no reading yet"));
  client.get("r1.motion set_speed [0.2, 0]");
  client.sleep(1.0);
  const auto data = [&](const std::string& name) {
    return client.get("r1." + name + " get_local_data");
  };
  const json pose = data("pose");
  EXPECT_NEAR(pose["x"], 1.0, 1e-9);
  for (const char* zero : {"z", "pitch", "roll"}) EXPECT_EQ(pose[zero], 0.0);
  EXPECT_DOUBLE_EQ(pose["timestamp"], 1.0);
  EXPECT_FALSE(pose.contains("vx"));
  const json odometry = data("odometry");
  EXPECT_NEAR(odometry["x"], 0.2, 1e-9);
  EXPECT_NEAR(odometry["vx"], 0.2, 1e-9);
  EXPECT_NEAR(odometry["wz"], 0.0, 1e-9);
  const json increments = data("increments");
  EXPECT_NEAR(increments["dx"], 0.02, 1e-9);  // a tenth of a second of 0.2 m/s
  EXPECT_FALSE(increments.contains("x"));
  EXPECT_NEAR(data("way")["dS"], 0.02, 1e-9);
  const json laser = data("laser");
  ASSERT_THAT(laser["range_list"], SizeIs(682));
  ASSERT_THAT(laser["point_list"], SizeIs(682));
  // The middle beams look at the right border, 4 m - (1 m + 0.035 m) away.
  EXPECT_NEAR(laser["range_list"][340], 2.965, 0.01);
  EXPECT_NEAR(laser["point_list"][340][0], 2.965, 0.01);
  const json infrared = data("infrared");
  EXPECT_THAT(infrared["range_list"], SizeIs(infrared["point_list"].size()));
  EXPECT_FALSE(data("sonar")["range_list"].empty());
  const json collision = data("collision");
  EXPECT_EQ(collision["collision"], false);
  EXPECT_EQ(collision["objects"], "");
  const json battery = data("battery");
  EXPECT_LT(battery["charge"], 80.0);
  EXPECT_EQ(battery["status"], "Discharging");
  EXPECT_NEAR(data("proximity")["near_objects"]["r2"], std::hypot(0.2, 1.2), 1e-9);
  const json properties = data("robot_properties");
  EXPECT_EQ(properties["name"], "r1");
  EXPECT_EQ(properties["port"], 6665);
  EXPECT_EQ(properties["initial_pose"]["x"], 0.8);
  EXPECT_EQ(properties["devices"]["laser"]["properties"]["beams"], 682.0);
}

TEST_F(MorseProtocol, Collision_NamesTouchedObjects) {
  MorseClient client = start();
  client.get("r1.teleport rotate [0, 0, 3.14159]");
  client.get("r1.motion set_speed [0.5, 0]");
  client.sleep(3.0);
  const json collision = client.get("r1.collision get_local_data");
  EXPECT_EQ(collision["collision"], true);
  EXPECT_EQ(collision["objects"], "border");
}

TEST_F(MorseProtocol, RangesWithoutEcho_HavePointZero) {
  MorseClient client = start();
  client.sleep(0.1);
  const json infrared = client.get("r1.infrared get_local_data");
  ASSERT_FALSE(infrared["range_list"].empty());
  // There is nothing within 0.8 m ahead.
  EXPECT_DOUBLE_EQ(infrared["range_list"][0], 0.8);
  EXPECT_EQ(infrared["point_list"][0], json::parse("[0.0, 0.0, 0.0]"));
}

TEST_F(MorseProtocol, Properties_ConstantFromWorld) {
  MorseClient client = start();
  const json properties = client.get("r1.laser get_properties")["properties"];
  EXPECT_EQ(properties["range_max"][0], 5.0);
  EXPECT_EQ(properties["range_max"][3], "range_max");
  const json configurations = client.get("r1.laser get_configurations")["configurations"];
  EXPECT_EQ(configurations["beams"], 682.0);
  EXPECT_EQ(configurations["object_to_robot"]["translation"], json::parse("[0.035, 0.0, 0.125]"));
  EXPECT_EQ(client.get("r1.laser set_property [\"range_max\", 5]"), nullptr);
  EXPECT_THAT(client.refusal("r1.laser set_property [\"range_max\", 6]"),
              HasSubstr("does not change during a run"));
  EXPECT_THAT(client.refusal("r1.laser set_property [\"colour\", 6]"), HasSubstr("does not exist"));
  EXPECT_THAT(client.get("r1.robot_properties get_properties")["properties"], IsEmpty());
}

// --- Streams

TEST_F(MorseProtocol, SensorStreams_HaveEachReading) {
  MorseClient client = start();
  RawClient pose = stream(client, "r1.pose");
  RawClient second = stream(client, "r1.pose");
  RawClient laser = stream(client, "r1.laser");
  client.get("r1.motion set_speed [0.2, 0]");
  client.sleep(0.5);
  for (int i = 1; i <= 5; ++i) {
    const std::string line = pose.line();
    const json record = json::parse(line);
    EXPECT_NEAR(record["timestamp"], 0.1 * i, 1e-9);
    EXPECT_NEAR(record["x"], 0.8 + 0.02 * i, 1e-9);
    EXPECT_EQ(second.line(), line);
    EXPECT_THAT(json::parse(laser.line())["range_list"], SizeIs(682));
  }
  // A later connection gets only later data.
  RawClient late = stream(client, "r1.pose");
  pose.close();
  client.sleep(0.1);
  EXPECT_NEAR(json::parse(late.line())["timestamp"], 0.6, 1e-9);
}

TEST_F(MorseProtocol, DisabledSensors_WriteNothing) {
  MorseClient client = start();
  RawClient pose = stream(client, "r1.pose");
  client.get("simulation deactivate [\"r1.pose\"]");
  client.sleep(1.0);
  client.get("simulation activate [\"r1.pose\"]");
  client.get("simulation reset_objects");
  client.sleep(0.5);
  EXPECT_GT(json::parse(pose.line())["timestamp"], 1.0);
}

TEST_F(MorseProtocol, Properties_StreamedEachSecond) {
  MorseClient client = start();
  RawClient properties = stream(client, "r1.robot_properties");
  properties.send("ignored\n");
  client.sleep(5.0);
  const json record = json::parse(properties.line());
  EXPECT_EQ(record["name"], "r1");
  EXPECT_GE(record["timestamp"], 1.0);
}

TEST_F(MorseProtocol, EndOfRun_ClosesStreams) {
  RunSettings run;
  run.duration_s = 2.0;
  MorseClient client = start(run);
  RawClient pose = stream(client, "r1.pose");
  EXPECT_THAT(client.refusal("time sleep [5]"), HasSubstr("session/finished"));
  const std::string records = pose.rest();
  EXPECT_EQ(std::count(records.begin(), records.end(), '\n'), 20);
}

/// Advances time until a condition holds: data written to a stream's port may arrive later than the
/// effect of a request on another connection.
template <typename Condition>
::testing::AssertionResult comes_true(MorseClient& client, Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return ::testing::AssertionSuccess();
    client.sleep(0.1);
  }
  return ::testing::AssertionFailure();
}

TEST_F(MorseProtocol, MotionStream_TakesNewestLine) {
  MorseClient client = start();
  RawClient motion = stream(client, "r1.motion");
  motion.send("{\"v\": 0.4, \"w\": 0.0}\n{\"v\": 0, \"w\": 0.5, \"timestamp\": 3}\n\n");
  EXPECT_TRUE(
      comes_true(client, [&] { return client.data("r1.odometry").value("wz", 0.0) == 0.5; }));
  EXPECT_NEAR(client.get("r1.pose get_local_data")["x"], 0.8, 1e-6);
}

TEST_F(MorseProtocol, WaypointAndTeleportStreams_Command) {
  MorseClient client = start();
  client.sleep(0.1);
  RawClient teleport = stream(client, "r1.teleport");
  teleport.send(R"({"x": 1, "y": 1.5, "z": 7, "yaw": 0, "pitch": 1, "roll": 1})"
                "\n");
  EXPECT_TRUE(comes_true(client, [&] { return client.get("r1.pose get_local_data")["y"] == 1.5; }));
  RawClient waypoint = stream(client, "r1.waypoint");
  waypoint.send("{\"x\": 2, \"y\": 1.5, \"z\": 0, \"tolerance\": 0.1, \"speed\": 0.5}\n");
  EXPECT_TRUE(comes_true(client, [&] { return client.get("r1.pose get_local_data")["x"] > 1.85; }));
}

TEST_F(MorseProtocol, InvalidStreamLines_LoggedOnce) {
  MorseClient client = start();
  RawClient motion = stream(client, "r1.motion");
  motion.send("[1, 2]\n{\"v\": 1}\nrubbish\n{\"v\": \"x\", \"w\": 0}\n");
  motion.send("{\"v\": 0, \"w\": 0.5}\n");
  EXPECT_TRUE(
      comes_true(client, [&] { return client.data("r1.odometry").value("wz", 0.0) == 0.5; }));
  EXPECT_THAT(logged(), HasSubstr("stream of r1.motion: expected an object, found array"));
  EXPECT_THAT(logged(), Not(HasSubstr("rubbish")));
}

// --- Tokens

TEST_F(MorseProtocol, ServerToken_RequiredForAllRequests) {
  settings.access.server_token = "open sesame";
  MorseClient client = start();
  EXPECT_THAT(client.refusal("time now"), HasSubstr("access/denied"));
  EXPECT_THAT(client.refusal("playpen token [\"wrong\"]"), HasSubstr("access/denied"));
  client.get("playpen token [\"open sesame\"]");
  EXPECT_EQ(client.get("time now"), 0.0);
  RawClient silent = stream(client, "r1.pose");
  RawClient reader = stream(client, "r1.pose");
  reader.send("{\"playpen_token\": \"open sesame\"}\n");
  RawClient writer = stream(client, "r1.motion");
  writer.send("{\"playpen_token\": \"open sesame\"}\n{\"v\": 0, \"w\": 0.5}\n");
  EXPECT_TRUE(
      comes_true(client, [&] { return client.data("r1.odometry").value("wz", 0.0) == 0.5; }));
  EXPECT_THAT(reader.line(), HasSubstr("timestamp"));
  server->stop();
  EXPECT_EQ(silent.rest(), "");
}

// Without the delay, 24 000 guesses per second went through one connection.
TEST_F(MorseProtocol, WrongTokens_DelayedLoggedAndClosed) {
  settings.access.server_token = "open sesame";
  MorseClient guesser = start();
  std::string guesses;
  for (int i = 1; i <= 20; ++i) {
    guesses += std::to_string(i) +
               (i % 2 == 0 ? " playpen token [\"guess\"]\n"
                           : " playpen hello [{\"version\": 1, \"tokens\": [\"x\"]}]\n");
  }
  RawClient stubborn("127.0.0.1", server->port());
  stubborn.send(guesses);
  // Other clients are not delayed; with the right token, neither are those at this address.
  guesser.get("playpen token [\"open sesame\"]");
  EXPECT_EQ(guesser.get("time now"), 0.0);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_THAT(stubborn.line(),
                AllOf(StartsWith(std::to_string(i) + " FAILED"), HasSubstr("access/denied")));
  }
  EXPECT_THAT(stubborn.rest(), HasSubstr("access/slow-down")) << "and no answer to the sixth";
  EXPECT_THAT(logged(),
              AllOf(HasSubstr("a wrong token, 1 from this address"),
                    HasSubstr("a wrong token, 4 from this address"), Not(HasSubstr("guess"))));
}

// A regression: right tokens from the guesser's address were once refused for a minute, so that one
// guesser kept all new clients of that machine out.
TEST_F(MorseProtocol, RightTokens_AcceptedLateBesideWrongOnes) {
  settings.access.server_token = "open sesame";
  MorseClient client = start();
  client.get("playpen token [\"open sesame\"]");
  std::vector<RawClient> guessers;
  const int port = client.get("simulation get_stream_port [\"r1.pose\"]");
  for (int i = 0; i < server::TokenThrottle::kMostOfAnAddress; ++i) {
    guessers.emplace_back("127.0.0.1", port).send("{\"playpen_token\": \"wrong\"}\n");
  }
  // A stream has one try: it is closed after its delay. By then all of them count.
  EXPECT_EQ(guessers.back().rest(), "");
  MorseClient newcomer = connect();
  RawClient reader("127.0.0.1", port);
  reader.send("{\"playpen_token\": \"open sesame\"}\n");
  RawClient writer("127.0.0.1", client.get("simulation get_stream_port [\"r1.motion\"]"));
  writer.send("{\"playpen_token\": \"open sesame\"}\n{\"v\": 0, \"w\": 0.5}\n");
  RawClient native("127.0.0.1", server->port());
  native.send("1 playpen hello [{\"version\": 1, \"tokens\": [\"open sesame\"]}]\n");
  newcomer.get("playpen token [\"open sesame\"]");
  EXPECT_THAT(native.line(), StartsWith("1 SUCCESS"));
  auto record = std::async(std::launch::async, [&] { return reader.line(); });
  const auto is_there = [&] {
    return record.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!is_there() || newcomer.data("r1.odometry").value("wz", 0.0) != 0.5) newcomer.sleep(0.1);
  EXPECT_THAT(record.get(), HasSubstr("timestamp"));
}

TEST_F(MorseProtocol, RobotToken_RequiredForItsCommands) {
  settings.access.robot_tokens = {{"r1", "mine"}};
  MorseClient client = start();
  EXPECT_THAT(client.refusal("r1.motion set_speed [1, 0]"),
              AllOf(HasSubstr("access/denied"), HasSubstr("r1")));
  EXPECT_THAT(client.refusal("simulation reset_objects"), HasSubstr("access/denied"));
  EXPECT_THAT(client.refusal("simulation deactivate [\"r1.pose\"]"), HasSubstr("access/denied"));
  EXPECT_THAT(client.refusal("simulation set_object_dynamics [\"r1\", false]"),
              HasSubstr("access/denied"));
  client.get("r2.motion set_speed [0.1, 0]");
  client.sleep(0.2);
  client.get("r1.pose get_local_data");
  RawClient stranger = stream(client, "r1.motion");
  stranger.send("{\"v\": 0, \"w\": 0.7}\n");
  RawClient owner = stream(client, "r1.motion");
  owner.send("{\"playpen_token\": \"mine\"}\n{\"v\": 0, \"w\": 0.5}\n");
  EXPECT_TRUE(comes_true(client, [&] {
    return client.data("r1.odometry").value("wz", 0.0) == 0.5 &&
           logged().find("access/denied") != std::string::npos;
  }));
  client.get("playpen token [\"mine\"]");
  EXPECT_THAT(client.refusal("playpen token [\"mine\"]"), HasSubstr("access/denied"));
  client.get("r1.motion stop");
  client.get("simulation reset_objects");
}

TEST_F(MorseProtocol, PrivateWorld_SensorsNeedRobotToken) {
  own_sensors_only = true;
  settings.access.robot_tokens = {{"r1", "first"}, {"r2", "second"}};
  MorseClient client = start();
  client.get("playpen token [\"first\"]");
  client.sleep(0.2);
  client.get("r1.pose get_local_data");
  EXPECT_THAT(client.refusal("r2.pose get_local_data"),
              AllOf(HasSubstr("access/denied"), HasSubstr("r2")));
  EXPECT_THAT(client.refusal("simulation get_scene_objects"), HasSubstr("access/denied"));
  RawClient reader = stream(client, "r2.pose");
  reader.send("{\"playpen_token\": \"first\"}\n");
  RawClient owner = stream(client, "r2.pose");
  owner.send("{\"playpen_token\": \"second\"}\n");
  client.sleep(0.3);
  EXPECT_THAT(owner.line(), HasSubstr("timestamp"));
  client.get("playpen token [\"second\"]");
  client.get("r2.pose get_local_data");
  client.get("simulation get_scene_objects");
  server->stop();
  EXPECT_EQ(reader.rest(), "");
}

// --- The clock synchronisation

// A regression: one message of 400 kB once blocked everybody for minutes, and the server's end,
// too.
TEST_F(MorseProtocol, LargeFills_DoNotDelayOthers) {
  MorseClient other = start();
  RawClient painter("127.0.0.1", server->port());
  painter.send("1 playpen hello [{\"version\": 1, \"port\": 6665}]\n");
  ASSERT_THAT(painter.line(), StartsWith("1 SUCCESS"));
  painter.send("{\"id\": 1, \"do\": \"resize_canvas\", \"width\": 4096, \"height\": 4096}\n");
  ASSERT_THAT(painter.line(), HasSubstr("4096"));
  std::string fills = "{\"id\": 2, \"do\": \"draw\", \"drawings\": [";
  for (int i = 0; i < 20'000; ++i) fills += "[\"fill\", 0, " + std::to_string(i % 255) + "],";
  painter.send(fills + "[\"fill\", 0, 255]]}\n");
  EXPECT_EQ(other.ask("simulation list_robots").status, "SUCCESS");
  EXPECT_THAT(painter.line(), HasSubstr("\"id\":2"));
  // Lines cannot be skipped: this is work for minutes. The server drops it when it ends.
  std::string lines = "{\"do\": \"draw\", \"drawings\": [";
  for (int i = 0; i < 20'000; ++i) lines += "[\"line\", 0, 0, 0, 4095, 4095, 1],";
  lines += "[\"pixel\", 0, 0, 0, 1]]}\n";
  std::thread writer([&] {
    while (painter.send_if_open(lines)) {
    }
  });
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(other.ask("simulation list_robots").status, "SUCCESS");
  }
  server->stop();
  writer.join();
}

TEST_F(MorseProtocol, SynchronisedClock_StepsPerMessage) {
  settings.sync_port = 0;
  MorseClient client = start();
  RawClient clock = accepted(server->sync_port());
  clock.send("s");
  while (client.get("time now") == 0.0) std::this_thread::yield();
  EXPECT_DOUBLE_EQ(client.get("time now"), 0.01);
  client.send("held time sleep [0.05]");
  client.send("q time now");
  EXPECT_DOUBLE_EQ(client.receive().result, 0.01);  // and not the sleep's answer
  clock.send("\n\n\n\n\n");
  EXPECT_EQ(client.receive().id, "held");
  EXPECT_DOUBLE_EQ(client.get("time now"), 0.06);
  clock.close();
  // The server has noticed the disconnection when other clients advance time again.
  client.sleep(1.0);
  EXPECT_DOUBLE_EQ(client.get("time now"), 1.06);
}

// --- The page

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(MorsePage, HasRowForEachService) {
  const std::string page = text_of(PLAYPEN_SOURCE_DIR "/docs/morse.md");
  int services = 0;
  for (const char* kind :
       {"simulation", "time", "arena", "motion", "MotionXYW", "waypoint", "teleport", "pen", "ptz",
        "posture", "proximity", "communication", "sensor", "component"}) {
    for (const server::MorseService& service : server::morse_services(kind)) {
      ++services;
      const std::string call =
          std::string(service.name) + '(' + std::string(service.arguments) + ')';
      EXPECT_THAT(page, HasSubstr("| `" + call + "` |")) << kind;
    }
  }
  EXPECT_GT(services, 40);
}

// The telnet session of docs/remote.md: sends the lines with "> " and expects the others.
TEST_F(MorseProtocol, DialogueOfGuide_Works) {
  const std::string page = text_of(PLAYPEN_SOURCE_DIR "/docs/remote.md");
  static const std::regex kBlock("<!-- dialogue: \\S+ -->\n```text\n([^`]*)```");
  std::smatch block;
  ASSERT_TRUE(std::regex_search(page, block, kBlock));
  start();
  RawClient client("127.0.0.1", server->port());
  std::istringstream lines(block[1]);
  int answers = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("> ")) {
      client.send(line.substr(2) + '\n');
    } else {
      EXPECT_EQ(client.line(), line);
      ++answers;
    }
  }
  EXPECT_GE(answers, 10);
}

}  // namespace
}  // namespace playerlike
