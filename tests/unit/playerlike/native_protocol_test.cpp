// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Playpen's own protocol, request by request and without sockets: the messages in both directions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

#include "patient_host.h"
#include "protocol/codec.h"
#include "server/native_handler.h"
#include "temporary_folder.h"

namespace playerlike::server {
namespace {

namespace fs = std::filesystem;
using protocol::Encoding;
using protocol::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kSecond_ns = sim::kNanosecondsPerSecond;

sim::WorldDescription two_robots(const std::string& simulation = R"("time": "lockstep")") {
  return sim::load_world_text(R"({"name": "two", "arena": {"size": [2, 1]}, "simulation": {)" +
                              simulation + R"(},
          "canvas": {"size": [100, 50], "cell_size": 0.02},
          "robots": [{"name": "r1", "pose": {"x": 0.3, "y": 0.3}},
                     {"name": "r2", "pose": {"x": 0.3, "y": 0.7}}]})");
}

/// A connection that stores the messages that it is sent.
class FakePeer final : public Peer {
 public:
  void send(std::string bytes) override { splitter_.add(bytes); }
  bool send_record(std::shared_ptr<const std::string> bytes) override {
    if (full) return false;
    splitter_.add(*bytes);
    records.push_back(std::move(bytes));
    return true;
  }
  void close(std::string farewell) override {
    splitter_.add(farewell);
    closed = true;
  }
  void set_in_flight(std::size_t requests) override { in_flight = requests; }
  void set_busy(bool now) override { busy = now; }
  void set_framing(protocol::Framing framing) override {
    // Decode earlier messages in the previous encoding.
    while (const auto message = splitter_.next()) earlier_.emplace_back(*message);
    splitter_.set_framing(framing);
  }
  [[nodiscard]] const std::string& name() const noexcept override { return name_; }
  void describe(const std::string& text) override { description = text; }

  /// The next message on the connection.
  std::optional<std::string> next() {
    if (!earlier_.empty()) {
      std::string message = std::move(earlier_.front());
      earlier_.pop_front();
      return message;
    }
    const auto message = splitter_.next();
    return message ? std::optional<std::string>(*message) : std::nullopt;
  }

  bool full = false;  ///< records are lost
  bool closed = false;
  std::size_t in_flight = 0;
  bool busy = false;
  std::string description;
  std::vector<std::shared_ptr<const std::string>> records;

 private:
  protocol::MessageSplitter splitter_{Encoding::kJson, std::size_t{1} << 30U};
  std::deque<std::string> earlier_;  ///< sent before the encoding changed
  std::string name_ = "fake:1";
};

/// A server without sockets and threads: posted tasks wait for run(), timers for fire().
class FakeHub final : public Hub {
 public:
  explicit FakeHub(std::shared_ptr<Host> host, AccessSettings access = {})
      : host_(std::move(host)), access_(access, host_->robots(), host_->own_sensors_only()) {}

  Host& host() noexcept override { return *host_; }
  const ServerSettings& settings() const noexcept override { return settings_; }
  const Access& access() const noexcept override { return access_; }
  void log(sim::LogLevel /*level*/, const std::string& text) override { ADD_FAILURE() << text; }
  void post(std::function<void()> task) override {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  std::uint64_t after(std::chrono::microseconds /*delay*/, std::function<void()> task) override {
    timers[++last_timer_] = std::move(task);
    return last_timer_;
  }
  void cancel(std::uint64_t timer) override { timers.erase(timer); }
  void work(Job job) override {
    jobs_.push_back(std::move(job));
    while (!work_waits && do_piece()) {
    }
  }
  std::shared_ptr<void> claim_room(std::size_t bytes) override {
    claimed += bytes;
    return {nullptr, [this, bytes](void*) { claimed -= bytes; }};
  }
  /// Does one turn of a worker thread. @return whether there was work.
  bool do_piece() {
    if (jobs_.empty()) return false;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    if (job.work()) jobs_.push_back(std::move(job));
    return true;
  }
  void pump() override {
    while (host_->advance(std::chrono::milliseconds(100))) {
    }
    run();
  }
  [[nodiscard]] const std::map<int, int>& player_ports() const noexcept override {
    return player_ports_;
  }
  int listen(int /*first*/, MakeHandler /*make*/) override { return 0; }
  void hand_over(Peer& peer, std::unique_ptr<Handler> handler) override {
    handlers[&peer] = std::move(handler);
  }
  void quit() override {}
  ThreadId thread_id(const std::string& process, std::uint64_t thread) override {
    ThreadId& id = thread_ids_[{process, thread}];
    if (id == 0) id = new_thread_id();
    return id;
  }

  void run() {
    std::deque<std::function<void()>> tasks;
    {
      const std::lock_guard lock(mutex_);
      tasks.swap(tasks_);
    }
    for (const auto& task : tasks) task();
  }
  [[nodiscard]] std::size_t connections() const noexcept override { return handlers.size(); }

  void fire() {
    const auto all = std::exchange(timers, {});
    for (const auto& timer : all) timer.second();
  }

  std::map<Peer*, std::unique_ptr<Handler>> handlers;
  std::map<std::uint64_t, std::function<void()>> timers;
  bool work_waits = false;  ///< for do_piece()
  std::size_t claimed = 0;

 private:
  std::deque<Job> jobs_;
  std::map<int, int> player_ports_;
  std::shared_ptr<Host> host_;
  ServerSettings settings_;
  Access access_;
  std::mutex mutex_;
  std::deque<std::function<void()>> tasks_;
  std::uint64_t last_timer_ = 0;
  std::map<std::pair<std::string, std::uint64_t>, ThreadId> thread_ids_;
};

/// The client's side of the protocol.
class Client {
 public:
  explicit Client(FakeHub& hub) : hub_(hub) {}
  Client(FakeHub& hub, Encoding agreed, json hello = json::object()) : hub_(hub) {
    hello["version"] = 1;
    hello["encoding"] = protocol::to_string(agreed);
    say_hello(hello);
    EXPECT_TRUE(answered_well) << welcome;
  }
  ~Client() { leave(); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// @return the answer to hello.
  json say_hello(const json& argument) {
    server::say_hello(peer, hub_, "7", argument);
    const std::string line = peer.next().value_or("");
    const std::string good = "7 SUCCESS ";
    const std::string bad = "7 FAILED ";
    answered_well = line.starts_with(good);
    EXPECT_TRUE(answered_well || line.starts_with(bad)) << line;
    welcome = json::parse(line.substr(answered_well ? good.size() : bad.size()));
    if (answered_well) {
      encoding = *protocol::parse_encoding(welcome["encoding"].get<std::string>());
    }
    return welcome;
  }
  void leave() {
    hub_.handlers.erase(&peer);
    hub_.pump();
  }
  void say(const json& message) {
    std::string bytes = protocol::encode(message, encoding);
    if (encoding == Encoding::kJson) bytes.pop_back();
    say_bytes(encoding == Encoding::kCbor ? bytes.substr(4) : bytes);
  }
  void say_bytes(const std::string& bytes) { hub_.handlers.at(&peer)->on_message(bytes); }
  /// The next message from the server; null if there is none.
  json hear() {
    const auto message = peer.next();
    return message ? protocol::decode(*message, encoding) : json();
  }
  /// Sends a request and returns its answer, which must arrive at once.
  json ask(const std::string& name, json request = json::object()) {
    request["do"] = name;
    request["id"] = ++last_id_;
    say(request);
    json answer = hear();
    EXPECT_EQ(answer.value("id", 0), last_id_) << name << ": " << answer;
    return answer;
  }
  /// The error in the answer to a request; "" if there is none.
  std::string error(const std::string& name, json request = json::object()) {
    return ask(name, std::move(request)).value("error", "");
  }
  json read(const std::string& wait, json request = json::object()) {
    request["wait"] = wait;
    return ask("read", std::move(request));
  }
  /// Pair of indices of a device.
  json device(const std::string& robot, const std::string& type) const {
    for (const json& r : welcome["robots"]) {
      if (r["name"] != robot) continue;
      for (const json& d : r["devices"]) {
        if (d["type"] == type) return d["device"];
      }
    }
    ADD_FAILURE() << "no " << type << " of " << robot;
    return {};
  }
  json drawing(int column, int row, sim::Colour colour, int layer = 0) const {
    sim::DrawOperation operation;
    operation.layer = layer;
    operation.x0 = column;
    operation.y0 = row;
    operation.value = sim::CellValue::of(colour);
    return protocol::encode_drawings({&operation, 1}, encoding);
  }
  sim::Colour colour_at(int column, int row, int layer = 0) {
    const json answer = ask("cell", {{"layer", layer}, {"column", column}, {"row", row}});
    return protocol::decode_cells(answer["cell"], encoding).at(0).colour();
  }
  std::vector<std::uint8_t> bytes(const json& object, const char* key) const {
    return protocol::require_bytes(object, key, encoding);
  }

  FakePeer peer;
  Encoding encoding = Encoding::kJson;
  json welcome;
  bool answered_well = false;

 private:
  FakeHub& hub_;
  int last_id_ = 0;
};

constexpr sim::Colour kRed{255, 0, 0, 255};
constexpr sim::Colour kNothing{0, 0, 0, 0};
constexpr sim::Colour kBlue{0, 0, 255, 255};

json twist(double v, double omega = 0.0) { return {{"kind", "twist"}, {"v", v}, {"omega", omega}}; }

std::string encoding_name(const testing::TestParamInfo<Encoding>& tested) {
  return std::string(protocol::to_string(tested.param));
}

/// Both encodings must carry the same content.
class NativeProtocol : public testing::TestWithParam<Encoding> {
 protected:
  explicit NativeProtocol(const std::string& simulation = R"("time": "lockstep")")
      : host(test::patient_host(two_robots(simulation))), hub(host) {}
  void SetUp() override { client.emplace(hub, GetParam()); }
  void TearDown() override {
    client.reset();
    EXPECT_THAT(hub.handlers, IsEmpty());
  }

  std::shared_ptr<Host> host;
  FakeHub hub;
  std::optional<Client> client;
};
INSTANTIATE_TEST_SUITE_P(Encodings, NativeProtocol,
                         testing::Values(Encoding::kJson, Encoding::kCbor), encoding_name);

// --- hello

TEST(NativeHello, Answer_DescribesServer) {
  FakeHub hub(test::patient_host(two_robots()));
  Client client(hub);
  const json answer =
      client.say_hello({{"version", 1}, {"port", 6666}, {"name", "walker"}, {"tokens", {"x"}}});
  ASSERT_TRUE(client.answered_well) << answer;
  EXPECT_EQ(answer["version"], 1);
  EXPECT_EQ(answer["encoding"], "json");
  EXPECT_EQ(answer["port"], 6666);
  EXPECT_EQ(answer["session"], 1);
  EXPECT_EQ(answer["server"]["name"], "playpen");
  EXPECT_THAT(answer["robots"], SizeIs(2));
  EXPECT_EQ(answer["canvas"]["width"], 100);
  EXPECT_EQ(answer["time"]["t"], 0);
  EXPECT_EQ(answer["limits"]["message_bytes"], 1 << 20);
  EXPECT_EQ(answer["limits"]["requests_in_flight"], 256);
  EXPECT_THAT(client.peer.description, HasSubstr("\"walker\""));

  const Client other(hub, Encoding::kCbor);
  EXPECT_EQ(other.welcome["session"], 2);
  EXPECT_EQ(other.welcome["port"], 4000);
  EXPECT_EQ(other.welcome["simulation"], answer["simulation"]);
  EXPECT_NE(other.welcome["key"], answer["key"]);
  EXPECT_THAT(other.welcome["key"].get<std::string>(), SizeIs(32));
}

TEST(NativeHello, UnknownHello_RefusedInMorseForm) {
  FakeHub hub(test::patient_host(two_robots()));
  const std::vector<std::pair<json, std::string>> bad = {
      {json::object(), "protocol/bad-value"},
      {json::array(), "protocol/bad-value"},
      {{{"version", 2}}, "protocol/version"},
      {{{"version", "1"}}, "protocol/bad-value"},
      {{{"version", 1}, {"encoding", "xml"}}, "protocol/bad-value"},
      {{{"version", 1}, {"port", 6667}}, "session/no-such-device"},
      {{{"version", 1}, {"port", -1}}, "protocol/bad-value"},
      {{{"version", 1}, {"tokens", "secret"}}, "protocol/bad-value"},
      {{{"version", 1}, {"tokens", {1}}}, "protocol/bad-value"},
      {{{"version", 1}, {"name", "two\nlines"}}, "protocol/bad-value"},
      {{{"version", 1}, {"name", std::string(65, 'x')}}, "protocol/bad-value"},
      {{{"version", 1}, {"process", 3}}, "protocol/bad-value"},
      {{{"version", 1}, {"follow", "nobody"}}, "access/denied"},
      {{{"version", 1}, {"watch", 1}}, "protocol/bad-value"},
      {{{"version", 1}, {"watch", true}, {"follow", "x"}}, "protocol/bad-value"},
      {{{"version", 1}, {"portt", 6665}}, "protocol/bad-value"},
  };
  Client client(hub);
  for (const auto& [argument, error] : bad) {
    const json answer = client.say_hello(argument);
    EXPECT_FALSE(client.answered_well) << argument;
    EXPECT_EQ(answer["error"], error) << argument << ": " << answer;
    EXPECT_THAT(hub.handlers, IsEmpty());
  }
  client.say_hello({{"version", 1}});
  EXPECT_TRUE(client.answered_well);
}

AccessSettings guarded() {
  AccessSettings access;
  access.server_token = "server-token";
  access.robot_tokens = {{"r2", "robot-token"}};
  return access;
}

TEST(NativeAccess, ServerAndRobotTokens_Required) {
  FakeHub hub(test::patient_host(two_robots()), guarded());
  Client stranger(hub);
  EXPECT_EQ(stranger.say_hello({{"version", 1}})["error"], "access/denied");
  EXPECT_EQ(stranger.say_hello({{"version", 1}, {"tokens", {"guess"}}})["error"], "access/denied");
  EXPECT_EQ(stranger.say_hello({{"version", 1}, {"watch", true}})["error"], "access/denied");

  Client client(hub, Encoding::kJson, {{"tokens", {"server-token"}}});
  const json r1 = {{"device", client.device("r1", "motion")}, {"command", twist(0.1)}};
  const json r2 = {{"device", client.device("r2", "motion")}, {"command", twist(0.1)}};
  EXPECT_EQ(client.error("command", r1), "");
  EXPECT_EQ(client.error("command", r2), "access/denied");
  EXPECT_EQ(client.error("read", {{"wait", "none"}, {"commands", {r1, r2}}}), "access/denied");
  const json place = {{"device", client.device("r2", "pose")},
                      {"command", {{"kind", "set_pose"}, {"x", 0}, {"y", 0}, {"yaw", 0}}}};
  EXPECT_EQ(client.error("command", place), "access/denied");
  // Drawing and looking do not need a robot's token.
  EXPECT_EQ(client.error("subscribe", {{"device", client.device("r2", "pose")}}), "");
  EXPECT_EQ(client.error("draw", {{"drawings", client.drawing(1, 1, kRed)}}), "");

  Client holder(hub, Encoding::kJson, {{"tokens", {"server-token", "robot-token"}}});
  EXPECT_EQ(holder.error("command", r2), "");
}

// The rule holds in both protocols, see also MorseProtocol.RobotToken_RequiredForItsCommands.
TEST(NativeAccess, ClientWithoutRobots_MayNotChangeSharedCanvas) {
  AccessSettings access;
  access.server_token = "server-token";
  access.robot_tokens = {{"r1", "r1-token"}, {"r2", "r2-token"}};
  FakeHub hub(test::patient_host(two_robots()), access);
  Client guest(hub, Encoding::kJson, {{"tokens", {"server-token"}}});
  const json red = guest.drawing(1, 1, kRed);
  EXPECT_EQ(guest.error("draw", {{"drawings", red}}), "access/denied");
  EXPECT_EQ(guest.error("read", {{"wait", "none"}, {"drawings", red}}), "access/denied");
  EXPECT_EQ(guest.error("resize_canvas", {{"width", 10}, {"height", 10}}), "access/denied");
  const json cells = {{"layer", 0}, {"rect", {0, 0, 1, 1}}, {"cells", "AAAAAA=="}};
  EXPECT_EQ(guest.error("set_cells", cells), "access/denied");
  EXPECT_EQ(guest.colour_at(1, 1), kNothing);
  // A client may change its own layers.
  const json made = guest.ask("create_layer", {{"kind", "colour"}, {"style", {{"name", "mine"}}}});
  const int layer = made["layer"].get<int>();
  EXPECT_EQ(guest.error("draw", {{"drawings", guest.drawing(1, 1, kRed, layer)}}), "");
  EXPECT_EQ(guest.colour_at(1, 1, layer), kRed);

  Client driver(hub, Encoding::kJson, {{"tokens", {"r2-token"}}});
  EXPECT_EQ(driver.error("draw", {{"drawings", red}}), "");
  EXPECT_EQ(driver.error("set_cells", cells), "");
  EXPECT_EQ(driver.error("resize_canvas", {{"width", 10}, {"height", 10}}), "");
}

TEST(NativeAccess, ClientWithoutAllRobots_MayNotChangeSharedState) {
  AccessSettings access;
  access.robot_tokens = {{"r1", "r1-token"}, {"r2", "r2-token"}};
  FakeHub hub(test::patient_host(two_robots()), access);
  const std::vector<std::pair<std::string, json>> requests = {
      {"save_state", {{"name", "s"}}},
      {"restore_state", {{"name", "s"}}},
      {"set_configuration", {{"name", "open"}}},
      {"set_block", {{"name", "gate"}, {"extended", true}}},
      {"set_timer", {{"name", "tick"}, {"enabled", true}}},
      {"set_trap", {{"name", "home"}, {"enabled", true}}}};
  Client driver(hub, Encoding::kJson, {{"tokens", {"r2-token"}}});
  Client referee(hub, Encoding::kJson, {{"tokens", {"r1-token", "r2-token"}}});
  for (const auto& [name, request] : requests) {
    EXPECT_EQ(driver.error(name, request), "access/denied") << name;
    EXPECT_NE(referee.error(name, request), "access/denied") << name;
  }
  EXPECT_EQ(referee.error("restore_state", {{"name", "s"}}), "");
}

TEST(NativeAccess, ClientWithoutRobots_MayNotSetBlackboard) {
  AccessSettings access;
  access.server_token = "server-token";
  access.robot_tokens = {{"r1", "r1-token"}, {"r2", "r2-token"}};
  FakeHub hub(test::patient_host(two_robots()), access);
  const json entry = {{"group", ""}, {"key", "k"}, {"type", 1}, {"subtype", 2}, {"data", "AAEC"}};
  Client guest(hub, Encoding::kJson, {{"tokens", {"server-token"}}});
  EXPECT_EQ(guest.error("set_blackboard", entry), "access/denied");
  EXPECT_EQ(guest.ask("blackboard", json::object())["entries"], json::array());
  Client driver(hub, Encoding::kJson, {{"tokens", {"r2-token"}}});
  EXPECT_EQ(driver.error("set_blackboard", entry), "");
  json found = entry;
  found["t"] = 0;
  found["change"] = 1;
  EXPECT_EQ(guest.ask("blackboard", json::object())["entries"], json::array({found}));
  json wrong = entry;
  wrong["type"] = 65536;
  EXPECT_EQ(driver.error("set_blackboard", wrong), "protocol/bad-value");
  wrong = entry;
  wrong["key"] = "";
  EXPECT_EQ(driver.error("set_blackboard", wrong), "session/bad-argument");
}

TEST(NativeAccess, PrivateWorld_SensorsNeedRobotToken) {
  AccessSettings access;
  access.server_token = "server-token";
  access.robot_tokens = {{"r1", "r1-token"}, {"r2", "r2-token"}};
  access.open_watching = true;
  FakeHub hub(test::patient_host(two_robots(R"("time": "lockstep", "privacy": "own")")), access);
  Client player(hub, Encoding::kJson, {{"tokens", {"r1-token"}}, {"port", 6666}});
  for (const char* type : {"pose", "laser", "odometry"}) {
    EXPECT_EQ(player.error("subscribe", {{"device", player.device("r1", type)}}), "") << type;
    EXPECT_EQ(player.error("subscribe", {{"device", player.device("r2", type)}}), "access/denied");
  }
  const std::vector<std::pair<std::string, json>> truths = {
      {"object_pose", {{"name", "r1"}}},
      {"place_object", {{"name", "r1"}, {"pose", {{"x", 1}, {"y", 0.3}, {"yaw", 0}}}}},
      {"object_property", {{"name", "r2"}, {"property", "size"}}},
      {"set_object_property", {{"name", "r1"}, {"property", "color"}, {"value", {255, 0, 0}}}},
      {"save_state", {{"name", "s"}}},
      {"restore_state", {{"name", "s"}}},
      {"blackboard", json::object()},
      {"world_map", {{"cell_size", 0.1}}},
      {"arena", json::object()},
      {"arena_events", {{"since", 0}}},
      {"set_configuration", {{"name", "open"}}},
      {"set_block", {{"name", "gate"}, {"extended", true}}},
      {"set_timer", {{"name", "tick"}, {"enabled", true}}},
      {"set_trap", {{"name", "home"}, {"enabled", true}}},
      {"watch", {{"rate", 10}}}};
  for (const auto& [name, request] : truths) {
    EXPECT_EQ(player.error(name, request), "access/denied") << name;
  }
  EXPECT_EQ(player.read("sleep", {{"timeout", 0.1}}).value("error", ""), "");

  Client guest(hub, Encoding::kJson, {{"tokens", {"server-token"}}, {"port", 6665}});
  EXPECT_EQ(guest.error("subscribe", {{"device", guest.device("r1", "pose")}}), "access/denied");
  Client stranger(hub);
  EXPECT_EQ(stranger.say_hello({{"version", 1}, {"watch", true}})["error"], "access/denied");

  Client referee(hub, Encoding::kJson, {{"tokens", {"r1-token", "r2-token"}}});
  EXPECT_EQ(referee.error("subscribe", {{"device", referee.device("r2", "pose")}}), "");
  for (const auto& [name, request] : truths) {
    EXPECT_NE(referee.error(name, request), "access/denied") << name;
  }
}

TEST(NativeAccess, PrivateWorldWithoutTokens_RobotOfPortOnly) {
  FakeHub hub(test::patient_host(two_robots(R"("time": "lockstep", "privacy": "own")")));
  Client client(hub, Encoding::kJson, {{"port", 6666}});
  EXPECT_EQ(client.error("subscribe", {{"device", client.device("r2", "pose")}}), "");
  EXPECT_EQ(client.error("subscribe", {{"device", client.device("r1", "pose")}}), "access/denied");
  EXPECT_EQ(client.error("object_pose", {{"name", "r2"}}), "access/denied");
}

TEST(PrivateWorlds, InProcessProgram_ReadsItsRobotOnly) {
  const auto host = test::patient_host(two_robots(R"("time": "lockstep", "privacy": "own")"));
  EXPECT_TRUE(host->own_sensors_only());
  const auto error_of = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const SessionError& e) {
      EXPECT_EQ(e.code(), SessionError::Code::kNotAvailable);
      return e.what();
    }
    return "";
  };
  const auto session = host->connect(6666);
  const auto all = host->connect(kMorsePort);
  for (const RobotInfo& robot : host->robots()) {
    const DeviceId device = find_interface(host->robots(), robot.port, "position2d", 0).reading;
    const std::string error = error_of([&] { session->request(SubscribeRequest{device}); });
    if (robot.port == 6666) {
      EXPECT_EQ(error, "");
    } else {
      EXPECT_THAT(error, AllOf(HasSubstr("privacy"), HasSubstr("r1"), HasSubstr("6666")));
    }
    EXPECT_THAT(error_of([&] { all->request(SubscribeRequest{device}); }), HasSubstr("privacy"));
  }
  EXPECT_THAT(error_of([&] { static_cast<void>(session->request(ObjectPoseRequest{"r2"})); }),
              HasSubstr("privacy"));
  EXPECT_THAT(error_of([&] {
                static_cast<void>(session->request(ObjectPropertyRequest{"r2", "size"}));
              }),
              HasSubstr("privacy"));
  EXPECT_THAT(error_of([&] {
                session->request(PlaceObjectRequest{"r2", {}});
              }),
              HasSubstr("privacy"));
  EXPECT_THAT(error_of([&] { static_cast<void>(session->request(WorldMapRequest{0.1}).map); }),
              HasSubstr("privacy"));
  EXPECT_FALSE(test::patient_host(two_robots())->own_sensors_only());
}

TEST(NativeAccess, Watchers_OnlyWatch) {
  AccessSettings access = guarded();
  access.open_watching = true;
  FakeHub hub(test::patient_host(two_robots()), access);
  Client watcher(hub, Encoding::kJson, {{"watch", true}});
  EXPECT_FALSE(watcher.welcome.contains("key"));
  EXPECT_EQ(watcher.welcome["canvas"]["height"], 50);
  EXPECT_EQ(watcher.error("watch", {{"rate", 10}}), "");
  EXPECT_EQ(watcher.ask("time")["time"]["t"], 0);
  EXPECT_EQ(watcher.error("read", {{"wait", "data"}}), "access/denied");
  EXPECT_EQ(watcher.error("canvas_image"), "access/denied");
  EXPECT_EQ(watcher.error("draw", {{"drawings", json::array()}}), "access/denied");
  EXPECT_EQ(watcher.error("bye"), "");
  EXPECT_TRUE(watcher.peer.closed);
}

TEST(NativeAccess, Followers_NeedKeyAndTokensOfLeader) {
  FakeHub hub(test::patient_host(two_robots()), guarded());
  const json both = {"server-token", "robot-token"};
  Client leader(hub, Encoding::kJson, {{"tokens", both}, {"port", 6666}});
  const std::string key = leader.welcome["key"];
  Client follower(hub);
  json hello = {{"version", 1}, {"tokens", both}, {"follow", key + "0"}};
  EXPECT_EQ(follower.say_hello(hello)["error"], "access/denied");
  hello["follow"] = key;
  hello["tokens"] = {"server-token"};
  EXPECT_EQ(follower.say_hello(hello)["error"], "access/denied");
  hello["tokens"] = both;
  hello["port"] = 6665;
  EXPECT_EQ(follower.say_hello(hello)["error"], "protocol/bad-value");
  hello.erase("port");
  EXPECT_EQ(follower.say_hello(hello)["port"], 6666);
  EXPECT_TRUE(follower.answered_well);
  leader.leave();
  Client late(hub);
  EXPECT_EQ(late.say_hello(hello)["error"], "access/denied");
}

// --- reading

TEST_P(NativeProtocol, Read_WaitsForSubscribedReadings) {
  const json pose = client->device("r1", "pose");
  const json laser = client->device("r1", "laser");
  EXPECT_EQ(client->error("subscribe", {{"device", pose}}), "");
  EXPECT_EQ(client->error("subscribe", {{"device", laser}}), "");
  const json first = client->read("data");
  EXPECT_EQ(first["t"], kSecond_ns / 10);  // both at 10 Hz
  EXPECT_EQ(first["data"], true);
  EXPECT_EQ(first["finished"], false);
  EXPECT_EQ(first["overflow"], 0);
  ASSERT_THAT(first["readings"], SizeIs(2));
  std::map<std::string, json> readings;
  for (const json& reading : first["readings"]) readings[reading["type"]] = reading;
  EXPECT_EQ(readings["pose"]["device"], pose);
  EXPECT_EQ(readings["pose"]["seq"], 1);
  EXPECT_EQ(readings["pose"]["t"], kSecond_ns / 10);
  EXPECT_EQ(readings["laser"]["device"], laser);
  EXPECT_THAT(protocol::require_doubles(readings["laser"], "ranges", GetParam()), SizeIs(682));

  EXPECT_EQ(client->error("unsubscribe", {{"device", laser}}), "");
  const json second = client->read("data");
  EXPECT_EQ(second["t"], kSecond_ns / 5);
  ASSERT_THAT(second["readings"], SizeIs(1));
  EXPECT_EQ(second["readings"][0]["seq"], 2);
}

TEST_P(NativeProtocol, ReadWithoutSubscriptions_TakesTenthOfSecond) {
  const json answer = client->read("data");
  EXPECT_EQ(answer["t"], kSecond_ns / 10);
  EXPECT_EQ(answer["data"], true);
  EXPECT_THAT(answer["readings"], IsEmpty());
}

TEST_P(NativeProtocol, Read_ExecutesCommandsAndDrawingsFirst) {
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  const json command = {{"device", client->device("r1", "motion")}, {"command", twist(0.2)}};
  const json answer =
      client->read("data", {{"commands", {command}}, {"drawings", client->drawing(3, 4, kRed)}});
  // Ten steps with limited acceleration: the robot has moved, but less than 0.1 s * 0.2 m/s.
  const double x_m = answer["readings"][0]["x"];
  EXPECT_GT(x_m, 0.3);
  EXPECT_LE(x_m, 0.32 + 1e-12);
  EXPECT_EQ(client->colour_at(3, 4), kRed);
}

TEST_P(NativeProtocol, FailedRead_HasNoEffect) {
  const json good = {{"device", client->device("r1", "motion")}, {"command", twist(0.2)}};
  const json unknown = {{"device", {0, 99}}, {"command", twist(0.2)}};
  const json drawings = client->drawing(3, 4, kRed);
  EXPECT_EQ(client->error(
                "read", {{"wait", "data"}, {"commands", {good, unknown}}, {"drawings", drawings}}),
            "session/no-such-device");
  EXPECT_EQ(client->error("read", {{"wait", "data"}, {"thread", -1}, {"drawings", drawings}}),
            "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "sleep"}, {"drawings", drawings}}),
            "protocol/bad-value");
  EXPECT_EQ(client->colour_at(3, 4).a, 0);
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  const json answer = client->read("data");
  EXPECT_EQ(answer["t"], kSecond_ns / 10);
  EXPECT_EQ(answer["readings"][0]["v"], 0.0);
}

json turns(std::int64_t until_ns, bool data, bool take) {
  return {{"until", until_ns}, {"data", data}, {"take", take}};
}

TEST_P(NativeProtocol, Turns_EndAtTimeOrData) {
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  // A step takes 10 ms, a reading of the pose comes every 100 ms.
  json answer = client->read("turns", turns(30'000'000, true, true));
  EXPECT_EQ(answer["t"], 30'000'000);
  EXPECT_EQ(answer["data"], false);
  EXPECT_EQ(answer["ready"], json::array());
  answer = client->read("turns", turns(1'000'000'000, true, true));
  EXPECT_EQ(answer["t"], 100'000'000);
  EXPECT_EQ(answer["readings"].size(), 1U);
  EXPECT_EQ(answer["ready"], json::array());
  // Without `take` the readings stay.
  answer = client->read("turns", turns(1'000'000'000, true, false));
  EXPECT_EQ(answer["t"], 200'000'000);
  EXPECT_EQ(answer["readings"], json::array());
  EXPECT_EQ(answer["ready"], json::array({client->welcome["session"]}));
  EXPECT_EQ(client->read("none")["readings"].size(), 1U);
}

TEST_P(NativeProtocol, Turns_EndWithDataOfProcessesOtherSessions) {
  client.reset();
  Client one(hub, GetParam(), {{"process", "program"}, {"thread", 1}});
  Client two(hub, GetParam(), {{"process", "program"}, {"thread", 2}});
  Client stranger(hub, GetParam(), {{"process", "another"}, {"thread", 1}});
  for (Client* each : {&one, &two, &stranger}) {
    each->ask("subscribe", {{"device", each->device("r1", "pose")}});
  }
  json request = turns(1'000'000'000, false, false);
  request["others"] = json::array({two.welcome["session"], stranger.welcome["session"]});
  request["joined"] = json::array({two.welcome["session"]});
  const json answer = one.read("turns", request);
  EXPECT_EQ(answer["alone"], false);
  EXPECT_EQ(answer["t"], 100'000'000);
  EXPECT_THAT(answer["ready"],
              testing::UnorderedElementsAre(one.welcome["session"], two.welcome["session"]));
}

TEST_P(NativeProtocol, Turns_AfterLeaveLetTimePass) {
  client.reset();
  Client program(hub, GetParam(), {{"process", "program"}});
  program.ask("command", {{"device", program.device("r1", "motion")}, {"command", twist(0.5)}});
  program.read("turns", turns(1'000'000'000, false, false));
  const double driven_m = program.ask("object_pose", {{"name", "r1"}})["pose"]["x"];
  EXPECT_EQ(program.error("leave"), "");
  EXPECT_EQ(program.read("turns", turns(5'000'000'000, false, false))["t"], 5'000'000'000);
  EXPECT_EQ(program.read("turns", turns(5'000'000'000, false, false))["alone"], true);
  // The robot stopped when its session ended.
  EXPECT_NEAR(program.ask("object_pose", {{"name", "r1"}})["pose"]["x"], driven_m, 0.05);
}

TEST_P(NativeProtocol, Turns_ReasonsReachReport) {
  json request = turns(0, false, false);
  request["unrepeatable"] = {"the moon", "the moon", "the tide"};
  client->read("turns", request);
  EXPECT_THAT(host->time().unrepeatable, testing::ElementsAre("the moon", "the tide"));
}

TEST_P(NativeProtocol, Turns_FaultyRequests_Refused) {
  struct Case {
    const char* key;
    json value;
  };
  for (const Case& c :
       {Case{"until", -1}, Case{"until", "soon"}, Case{"data", 1}, Case{"take", nullptr},
        Case{"others", "all"}, Case{"others", json::array({-1})},
        Case{"joined", json::array({"x"})}, Case{"others", std::vector<int>(257, 1)},
        Case{"unrepeatable", json::array({7})}, Case{"unrepeatable", json::array({"a\nb"})},
        Case{"unrepeatable", json::array({std::string(301, 'a')})}}) {
    json request = turns(10'000'000, false, false);
    request[c.key] = c.value;
    EXPECT_EQ(client->error("read", (request["wait"] = "turns", request)), "protocol/bad-value")
        << c.key << ": " << c.value;
  }
  EXPECT_EQ(client->error("read", {{"wait", "turns"}}), "protocol/bad-value");
  EXPECT_EQ(host->time().steps, 0U);
}

// --- select and step

/// A selection of r1's scan and pose, and of the speeds of both robots.
json both_driven(const Client& client) {
  return {{"numbers",
           {{{"device", client.device("r1", "laser")}, {"keys", {"ranges"}}},
            {{"device", client.device("r1", "pose")}, {"keys", {"x", "yaw", "v", "stalled"}}}}},
          {"motions", {client.device("r1", "motion"), client.device("r2", "motion")}}};
}

std::vector<double> numbers_of(const json& answer, Encoding encoding) {
  return protocol::require_doubles(answer, "numbers", encoding);
}

TEST_P(NativeProtocol, Step_DrivesAndReadsAsCommandsAndReadingsDo) {
  FakeHub other_hub(test::patient_host(two_robots()));
  Client reader(other_hub, GetParam());
  for (const char* type : {"laser", "pose"}) {
    reader.ask("subscribe", {{"device", reader.device("r1", type)}});
  }
  ASSERT_EQ(client->error("select", both_driven(*client)), "");
  for (int i = 0; i < 3; ++i) {
    const json answer = client->ask(
        "step", {{"twists", protocol::doubles(std::vector{0.2, 0.1, -0.1, 0.5}, GetParam())}});
    json commands;
    commands.push_back({{"device", reader.device("r1", "motion")}, {"command", twist(0.2, 0.1)}});
    commands.push_back({{"device", reader.device("r2", "motion")}, {"command", twist(-0.1, 0.5)}});
    const json round = reader.read("data", {{"commands", commands}});
    ASSERT_THAT(round["readings"], SizeIs(2));
    std::vector<double> expected =
        protocol::require_doubles(round["readings"][0], "ranges", GetParam());
    ASSERT_THAT(expected, SizeIs(682));
    const json& pose = round["readings"][1];
    expected.insert(expected.end(), {pose["x"], pose["yaw"], pose["v"], 0.0});
    EXPECT_EQ(numbers_of(answer, GetParam()), expected) << "step " << i;
    EXPECT_EQ(answer["t"], round["t"]);
    EXPECT_EQ(answer["finished"], false);
  }
  EXPECT_EQ(client->ask("object_pose", {{"name", "r2"}})["pose"],
            reader.ask("object_pose", {{"name", "r2"}})["pose"]);
}

TEST(NativeStep, DevicesWithOtherPeriods_WaitsForEachOfThem) {
  // In 1 s there are 10 poses, but only 5 scans.
  FakeHub hub(test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [2, 1]}, "robots": [{"pose": {"x": 0.3, "y": 0.3}, "devices":
          {"laser": {"frequency": 5, "beams": 10, "resolution_deg": 20}}}]})")));
  Client client(hub, Encoding::kCbor);
  ASSERT_EQ(client.error("select",
                         {{"numbers",
                           {{{"device", client.device("r1", "pose")}, {"keys", {"x"}}},
                            {{"device", client.device("r1", "laser")}, {"keys", {"ranges"}}}}}}),
            "");
  const std::int64_t first_ns = client.ask("step")["t"];
  const json answer = client.ask("step");
  EXPECT_EQ(answer["t"].get<std::int64_t>() - first_ns, kSecond_ns / 5);
  EXPECT_THAT(numbers_of(answer, Encoding::kCbor), SizeIs(11));
  // A device that has no more readings than the turn of the others lasts: the server is not
  // blocked.
  EXPECT_EQ(client.error("select", {{"numbers", json::array()}}), "");
  EXPECT_EQ(client.error("step"), "session/bad-argument");
}

TEST_P(NativeProtocol, Step_OtherSession_IsWaitedForInEachRound) {
  FakeHub slow_hub(test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [2, 1]}, "robots": [{"pose": {"x": 0.3, "y": 0.3}, "devices":
          {"laser": {"frequency": 5, "beams": 10, "resolution_deg": 20}}}]})")));
  Client program(slow_hub, GetParam());
  Client other(slow_hub, GetParam());
  other.ask("subscribe", {{"device", other.device("r1", "pose")}});
  other.read("join");
  ASSERT_EQ(
      program.error("select",
                    {{"numbers",
                      {{{"device", program.device("r1", "pose")}, {"keys", {"x"}}},
                       {{"device", program.device("r1", "laser")}, {"keys", {"range_max"}}}}}}),
      "");
  program.say({{"id", 90}, {"do", "step"}});
  EXPECT_EQ(other.read("data")["t"], kSecond_ns / 10);
  EXPECT_TRUE(program.hear().is_null());  // a pose, but no scan yet
  EXPECT_EQ(other.read("data")["t"], kSecond_ns / 5);
  slow_hub.run();
  const json answer = program.hear();
  EXPECT_EQ(answer["id"], 90) << answer;
  EXPECT_EQ(answer["t"], kSecond_ns / 5);
  EXPECT_EQ(numbers_of(answer, GetParam()).back(), 5.0);
}

TEST_P(NativeProtocol, Step_RareReading_OthersAreServedMeanwhile) {
  // 100 poses a second, and a reading of the thermometer in 100 s: 10 000 rounds for the second
  // one.
  FakeHub slow_hub(test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [2, 1]}, "robots": [{"pose": {"x": 0.3, "y": 0.3}, "devices":
          {"thermometer": {"frequency": 0.01}, "pose": {"frequency": 100}}}]})")));
  Client slow(slow_hub, GetParam());
  ASSERT_EQ(
      slow.error("select",
                 {{"numbers",
                   {{{"device", slow.device("r1", "pose")}, {"keys", {"x"}}},
                    {{"device", slow.device("r1", "thermometer")}, {"keys", {"temperature"}}}}}}),
      "");
  slow.say({{"id", 90}, {"do", "step"}});
  EXPECT_TRUE(slow.hear().is_null());
  EXPECT_EQ(slow.peer.in_flight, 1U);
  EXPECT_EQ(slow.error("step"), "protocol/busy");
  EXPECT_EQ(slow.error("read", {{"wait", "data"}}), "protocol/busy");
  EXPECT_EQ(slow.error("select", {{"numbers", json::array()}}), "protocol/busy");
  EXPECT_EQ(slow.error("time"), "");
  json answer;
  for (int i = 0; i < 1000 && (answer = slow.hear()).is_null(); ++i) slow_hub.run();
  EXPECT_EQ(answer["id"], 90) << answer;
  EXPECT_EQ(answer["t"], 100 * kSecond_ns);
  EXPECT_THAT(numbers_of(answer, GetParam()), SizeIs(2));
  EXPECT_EQ(slow.peer.in_flight, 0U);
}

TEST_P(NativeProtocol, Step_FaultyRequests_Refused) {
  EXPECT_EQ(client->error("step"), "session/bad-argument");
  const json laser = client->device("r1", "laser");
  const json good = both_driven(*client);
  struct Case {
    json numbers;
    json motions;
    const char* error;
    const char* message;
  };
  const json none = json::array();
  const auto pick = [](const json& device, const json& keys) {
    return json::array({{{"device", device}, {"keys", keys}}});
  };
  for (const Case& c : {
           Case{7, none, "protocol/bad-value", "numbers: expected a list"},
           Case{pick(laser, json::array({"rangs"})), none, "protocol/bad-value",
                "keys of numbers or doubles in the readings of a laser"},
           Case{pick(laser, none), none, "protocol/bad-value", "1 to 64 keys"},
           Case{pick(laser, "ranges"), none, "protocol/bad-value", "a list of keys"},
           Case{pick(json::array({0, 99}), json::array({"x"})), none, "session/no-such-device", ""},
           Case{pick(client->device("r1", "motion"), json::array({"x"})), none,
                "protocol/bad-value", ""},
           Case{good["numbers"], json::array({laser}), "protocol/bad-value", "motion devices"},
           Case{good["numbers"], json::array({json::array({5, 0})}), "session/no-such-device", ""},
       }) {
    const json answer = client->ask("select", {{"numbers", c.numbers}, {"motions", c.motions}});
    EXPECT_EQ(answer.value("error", ""), c.error) << answer;
    EXPECT_THAT(answer.value("message", ""), HasSubstr(c.message));
  }
  EXPECT_EQ(client->error("step"), "session/bad-argument");  // none of them had an effect

  ASSERT_EQ(client->error("select", good), "");
  const json answer =
      client->ask("step", {{"twists", protocol::doubles(std::vector{0.2}, GetParam())}});
  EXPECT_EQ(answer.value("error", ""), "protocol/bad-value");
  EXPECT_THAT(answer.value("message", ""), HasSubstr("expected 4 numbers"));
  EXPECT_EQ(client->error("step", {{"twists", "fast"}}), "protocol/bad-value");
  EXPECT_EQ(client->error("step", {{"speed", 1}}), "protocol/bad-value");
  EXPECT_EQ(host->time().steps, 0U);
}

TEST(NativeStep, RoundsOfOneSessionInsideWaitOfAnother_EachAnsweredOnce) {
  // The wait for a scan begins first. In its time the other step needs several rounds.
  FakeHub hub(test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [2, 1]}, "robots": [{"pose": {"x": 0.3, "y": 0.3}, "devices":
          {"laser": {"frequency": 5, "beams": 10, "resolution_deg": 20}}}]})")));
  Client rounds(hub, Encoding::kJson);
  Client scan(hub, Encoding::kJson);
  const json laser = {{"device", scan.device("r1", "laser")}, {"keys", {"range_max"}}};
  const json pose = {{"device", scan.device("r1", "pose")}, {"keys", {"x"}}};
  ASSERT_EQ(rounds.error("select", {{"numbers", {pose, laser}}}), "");
  ASSERT_EQ(scan.error("select", {{"numbers", {laser}}}), "");
  rounds.read("join");
  scan.read("join");
  for (int i = 1; i < 4; ++i) {
    rounds.say({{"id", i}, {"do", "step"}});
    scan.say({{"id", i}, {"do", "step"}});
    hub.run();
    for (Client* const client : {&rounds, &scan}) {
      const json answer = client->hear();
      EXPECT_EQ(answer["id"], i) << answer;
      EXPECT_EQ(answer["t"], i * kSecond_ns / 5);
      EXPECT_TRUE(client->hear().is_null()) << "an answer twice";
    }
  }
}

TEST(NativeStep, LargeSelections_Refused) {
  FakeHub hub(test::patient_host(sim::load_world_text(
      R"({"arena": {"size": [2, 1]}, "robots": [{"pose": {"x": 0.3, "y": 0.3}, "devices":
          {"laser": {"beams": 8192, "resolution_deg": 0.04}}}]})")));
  Client client(hub, Encoding::kCbor);
  const auto select = [&](std::size_t times, const char* type, const json& keys) {
    const json item = {{"device", client.device("r1", type)}, {"keys", keys}};
    return client.ask("select", {{"numbers", std::vector<json>(times, item)}}).value("message", "");
  };
  EXPECT_THAT(select(33, "laser", {"ranges"}),
              HasSubstr("at most 262144 numbers in an answer to step, found 270336"));
  EXPECT_THAT(select(513, "pose", std::vector<std::string>(64, "x")),
              HasSubstr("at most 32768 keys of all devices together"));
  EXPECT_EQ(client.error("step"), "session/bad-argument");  // none of them had an effect
  EXPECT_EQ(select(512, "pose", std::vector<std::string>(64, "x")), "");
  EXPECT_THAT(numbers_of(client.ask("step"), Encoding::kCbor), SizeIs(32768));
}

TEST_P(NativeProtocol, Step_AfterLeave_NeedsNewSelect) {
  ASSERT_EQ(client->error("select", both_driven(*client)), "");
  ASSERT_EQ(client->error("step"), "");
  ASSERT_EQ(client->error("leave"), "");
  EXPECT_EQ(client->error("step"), "session/bad-argument");
}

TEST(NativeStep, RobotOfAnother_CannotBeDriven) {
  AccessSettings access;
  access.robot_tokens = {{"r1", "one"}, {"r2", "two"}};
  FakeHub hub(test::patient_host(two_robots()), access);
  Client client(hub, Encoding::kJson, {{"tokens", {"one"}}});
  EXPECT_EQ(client.error("select", both_driven(client)), "access/denied");
}

TEST_P(NativeProtocol, Step_EndOfRun_IsAnError) {
  FakeHub short_hub(test::patient_host(two_robots(R"("time": "lockstep", "duration": 0.25)")));
  Client program(short_hub, GetParam());
  ASSERT_EQ(program.error("select", both_driven(program)), "");
  EXPECT_EQ(program.error("step"), "");
  EXPECT_EQ(program.error("step"), "");
  EXPECT_EQ(program.error("step"), "session/finished");
}

TEST_P(NativeProtocol, SleepAndJoin_KeepReadings) {
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  const json slept = client->read("sleep", {{"timeout", 0.25}});
  EXPECT_EQ(slept["t"], kSecond_ns / 4);
  EXPECT_THAT(slept["readings"], IsEmpty());
  EXPECT_THAT(client->read("join")["readings"], IsEmpty());
  const json answer = client->read("none");
  EXPECT_EQ(answer["t"], kSecond_ns / 4);
  EXPECT_EQ(answer["data"], true);
  ASSERT_THAT(answer["readings"], SizeIs(1));
  EXPECT_EQ(answer["readings"][0]["seq"], 2);
  const json again = client->read("none");
  EXPECT_EQ(again["data"], false);
  EXPECT_THAT(again["readings"], IsEmpty());
  EXPECT_EQ(client->error("read", {{"wait", "sleep"}, {"timeout", -1.0}}), "protocol/bad-value");
}

TEST_P(NativeProtocol, ReplaceRule_KeepsNewestOrAllReadings) {
  const json pose = client->device("r1", "pose");
  client->ask("subscribe", {{"device", pose}});
  EXPECT_EQ(client->error("replace", {{"device", pose}, {"replace", false}}), "");
  client->read("sleep", {{"timeout", 0.3}});
  EXPECT_THAT(client->read("data")["readings"], SizeIs(3));
  EXPECT_EQ(client->error("replace", {{"device", nullptr}, {"replace", true}}), "");
  client->read("sleep", {{"timeout", 0.3}});
  EXPECT_THAT(client->read("data")["readings"], SizeIs(1));
  // At most 1000 wait.
  client->ask("replace", {{"replace", false}});
  client->read("sleep", {{"timeout", 100.5}});
  const json answer = client->read("data");
  EXPECT_THAT(answer["readings"], SizeIs(1000));
  EXPECT_EQ(answer["overflow"], 5);
}

TEST_P(NativeProtocol, FirstPeek_TakesNoTimeAndFurtherOnesOneStep) {
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  EXPECT_EQ(client->read("peek")["t"], 0);
  const json second = client->read("peek", {{"timeout", 0}});
  EXPECT_EQ(second["t"], kSecond_ns / 100);  // a step of 10 ms
  EXPECT_EQ(second["data"], false);
  const json timed = client->read("peek", {{"timeout", 0.05}});
  EXPECT_EQ(timed["t"], 6 * kSecond_ns / 100);
  EXPECT_EQ(timed["data"], false);
  const json some = client->read("peek", {{"timeout", 0.5}});
  EXPECT_EQ(some["t"], kSecond_ns / 10);
  EXPECT_EQ(some["data"], true);
  EXPECT_THAT(some["readings"], SizeIs(1));
  EXPECT_EQ(client->read("peek")["t"], kSecond_ns / 10);
}

TEST_P(NativeProtocol, OtherRequests_AnsweredDuringRead) {
  Client other(hub, Encoding::kJson);
  EXPECT_EQ(other.read("join")["t"], 0);
  client->say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  EXPECT_EQ(client->hear(), json()) << "the other one thinks";
  EXPECT_EQ(client->peer.in_flight, 1U);
  EXPECT_EQ(client->ask("time")["time"]["t"], 0);
  EXPECT_EQ(client->error("read", {{"wait", "data"}}), "protocol/busy");
  EXPECT_EQ(client->error("read", {{"wait", "sleep"}, {"timeout", 1}}), "protocol/busy");
  EXPECT_EQ(client->error("read", {{"wait", "join"}}), "protocol/busy");
  EXPECT_EQ(client->error("read", {{"wait", "none"}}), "");
  // Both waits end with the same step.
  EXPECT_EQ(other.read("data")["t"], kSecond_ns / 10);
  hub.run();
  const json answer = client->hear();
  EXPECT_EQ(answer["id"], 100);
  EXPECT_EQ(answer["t"], kSecond_ns / 10);
  EXPECT_EQ(client->peer.in_flight, 0U);
}

TEST_P(NativeProtocol, CompletedRead_AnsweredInOrder) {
  Client other(hub, Encoding::kJson);
  other.read("join");
  client->say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  other.say({{"id", 1}, {"do", "read"}, {"wait", "data"}});
  // The hub has not yet told the client; the client sends another request first.
  client->say({{"id", 101}, {"do", "read"}, {"wait", "none"}});
  EXPECT_EQ(client->hear()["id"], 100);
  EXPECT_EQ(client->hear()["id"], 101);
  hub.run();
  EXPECT_EQ(client->hear(), json()) << "answered twice";
}

TEST_P(NativeProtocol, WaitingThread_BlocksNoneOfItsSessions) {
  Client first(hub, GetParam(), {{"process", "p"}});
  Client second(hub, GetParam(), {{"process", "p"}});
  EXPECT_EQ(first.read("data", {{"thread", 5}})["t"], kSecond_ns / 10);
  // The other session's tenth of a second is over, too, but not its second one.
  EXPECT_EQ(second.read("data", {{"thread", 5}})["t"], kSecond_ns / 10);
  EXPECT_EQ(second.read("data", {{"thread", 5}})["t"], kSecond_ns / 5);
  EXPECT_EQ(first.read("data", {{"thread", 5}})["t"], kSecond_ns / 5);
  // Another thread counts separately, until it ends.
  second.say({{"id", 100}, {"do", "read"}, {"wait", "data"}, {"thread", 6}});
  EXPECT_EQ(second.hear(), json());
  EXPECT_EQ(first.error("thread_ended", {{"thread", 5}}), "");
  hub.run();
  EXPECT_EQ(second.hear()["id"], 100);
}

TEST_P(NativeProtocol, Follower_HoldsTimeUntilItAnswers) {
  Client follower(hub, GetParam(), {{"follow", client->welcome["key"]}});
  EXPECT_EQ(follower.read("join")["t"], 0);
  client->say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  EXPECT_EQ(client->hear(), json());
  follower.say({{"id", 200}, {"do", "read"}, {"wait", "sleep"}, {"timeout", 100}});
  hub.run();
  EXPECT_EQ(client->hear()["t"], kSecond_ns / 10);
  EXPECT_EQ(follower.hear(), json());
  // Alone it does not advance time.
  client->leave();
  EXPECT_EQ(host->time().sim_time_ns, kSecond_ns / 10);
  EXPECT_EQ(follower.hear(), json());
}

TEST_P(NativeProtocol, ClientThatLeavesDuringWait_NotAwaited) {
  Client other(hub, Encoding::kCbor);
  other.read("join");
  client->say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  EXPECT_EQ(client->hear(), json());
  client->leave();
  EXPECT_EQ(other.read("data")["t"], kSecond_ns / 10);
  // The same for a client that leaves while others wait for it.
  Client third(hub, Encoding::kJson);
  third.read("join");
  other.say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  EXPECT_EQ(other.hear(), json());
  third.leave();
  EXPECT_EQ(other.hear()["id"], 100);
}

class NativeEnd : public NativeProtocol {
 protected:
  NativeEnd() : NativeProtocol(R"("time": "lockstep", "duration": 0.2)") {}
};
INSTANTIATE_TEST_SUITE_P(Encodings, NativeEnd, testing::Values(Encoding::kJson, Encoding::kCbor),
                         encoding_name);

TEST_P(NativeEnd, LastReadings_ReceivedBeforeEnd) {
  client->ask("subscribe", {{"device", client->device("r1", "pose")}});
  EXPECT_EQ(client->read("data")["finished"], false);
  const json last = client->read("data");
  EXPECT_EQ(last["t"], kSecond_ns / 5);
  EXPECT_EQ(last["finished"], true);
  EXPECT_THAT(last["readings"], SizeIs(1));
  EXPECT_EQ(client->error("read", {{"wait", "data"}}), "session/finished");
  const json slept = client->read("sleep", {{"timeout", 1}});
  EXPECT_EQ(slept["finished"], true);
  EXPECT_EQ(slept["t"], kSecond_ns / 5);
  const json looked = client->read("peek", {{"timeout", 1}});
  EXPECT_EQ(looked["data"], true) << "so that `data` is tried";
  EXPECT_THAT(looked["readings"], IsEmpty());
}

TEST_P(NativeEnd, InterruptedWait_Answered) {
  Client other(hub, Encoding::kJson);
  other.read("join");
  client->say({{"id", 100}, {"do", "read"}, {"wait", "data"}});
  EXPECT_EQ(client->hear(), json());
  host->finish();
  hub.run();
  const json answer = client->hear();
  EXPECT_EQ(answer["id"], 100);
  EXPECT_EQ(answer["error"], "session/finished");
}

// So slow that no step occurs during the test.
class NativePaced : public NativeProtocol {
 protected:
  NativePaced() : NativeProtocol(R"("time": 1e-6)") {}
};
INSTANTIATE_TEST_SUITE_P(Encodings, NativePaced, testing::Values(Encoding::kJson, Encoding::kCbor),
                         encoding_name);

TEST_P(NativePaced, Peek_EndsByWallClock) {
  EXPECT_EQ(client->read("peek")["data"], false);
  EXPECT_THAT(hub.timers, IsEmpty());
  client->say({{"id", 100}, {"do", "read"}, {"wait", "peek"}, {"timeout", 0.5}});
  EXPECT_EQ(client->hear(), json());
  ASSERT_THAT(hub.timers, SizeIs(1));
  hub.fire();
  const json answer = client->hear();
  EXPECT_EQ(answer["id"], 100);
  EXPECT_EQ(answer["data"], false);
  EXPECT_EQ(client->peer.in_flight, 0U);
  // The next request is another wait.
  client->say({{"id", 101}, {"do", "read"}, {"wait", "peek"}, {"timeout", 0.5}});
  EXPECT_EQ(client->hear(), json());
  EXPECT_THAT(hub.timers, SizeIs(1));
  client->leave();
  EXPECT_THAT(hub.timers, IsEmpty());
}

TEST_P(NativeProtocol, PreferRealTime_AppliesWithoutChosenModeOnly) {
  EXPECT_EQ(client->error("prefer_real_time", {{"reason", "a thread reads"}}), "");
  EXPECT_EQ(client->ask("time")["time"]["mode"], "lockstep");
  EXPECT_EQ(client->error("prefer_real_time", {{"reason", "a\nb"}}), "protocol/bad-value");
  FakeHub undecided(test::patient_host(two_robots("\"step\": 0.01")));
  Client other(undecided, GetParam());
  EXPECT_EQ(other.error("prefer_real_time", {{"reason", "a thread reads"}}), "");
  EXPECT_EQ(other.ask("time")["time"]["mode"], "paced");
}

// --- commands and the canvas

TEST_P(NativeProtocol, Command_MovesRobot) {
  client->ask("subscribe", {{"device", client->device("r2", "pose")}});
  const json motion = client->device("r2", "motion");
  EXPECT_EQ(client->error("command", {{"device", motion}, {"command", twist(0.1)}}), "");
  client->read("sleep", {{"timeout", 1}});
  EXPECT_GT(client->read("data")["readings"][0]["x"].get<double>(), 0.35);
  EXPECT_EQ(client->error("command", {{"device", {5, 0}}, {"command", twist(0.1)}}),
            "session/no-such-device");
  EXPECT_EQ(client->error("command", {{"device", motion}, {"command", {{"kind", "fly"}}}}),
            "protocol/bad-value");
  EXPECT_EQ(client->error("command", {{"device", motion}}), "protocol/bad-value");
  EXPECT_EQ(client->error("subscribe", {{"device", motion}}), "session/bad-argument");
}

TEST_P(NativeProtocol, Cells_DrawnAndRead) {
  EXPECT_EQ(client->error("draw", {{"drawings", client->drawing(2, 1, kRed)}}), "");
  EXPECT_EQ(client->colour_at(2, 1), kRed);
  EXPECT_EQ(client->ask("cell", {{"layer", 0}, {"column", -1}, {"row", 0}})["cell"], json());
  const std::vector<sim::CellValue> cells(6, sim::CellValue::of(kBlue));
  const json values = protocol::encode_cells(cells, GetParam());
  EXPECT_EQ(client->error("set_cells", {{"layer", 0}, {"rect", {1, 1, 3, 2}}, {"cells", values}}),
            "");
  EXPECT_EQ(client->colour_at(2, 1), kBlue);
  EXPECT_EQ(client->colour_at(3, 2), kBlue);
  EXPECT_EQ(client->colour_at(4, 2).a, 0);
  for (const json& rect : {json{1, 1, 3, 3}, json{1, 1, -3, -2}, json{1, 1, 3}, json{1, 1, 3, 2.5},
                           json{1, 1, 1 << 20, 1 << 20}, json("all"), json{1e300, 1, 3, 2}}) {
    const std::string error =
        client->error("set_cells", {{"layer", 0}, {"rect", rect}, {"cells", values}});
    EXPECT_TRUE(error == "session/bad-argument" || error == "protocol/bad-value") << rect << error;
  }
  const json all = client->ask("cells", {{"layer", 0}});
  EXPECT_THAT(protocol::decode_cells(all["cells"], GetParam()), SizeIs(100 * 50));
  const json picture = client->ask("canvas_image");
  EXPECT_THAT(client->bytes(picture, "image"), SizeIs(100 * 50 * 4));
  EXPECT_EQ(picture["canvas"]["width"], 100);
}

TEST_P(NativeProtocol, Layers_BelongToSession) {
  const int layer =
      client->ask("create_layer", {{"kind", "binary"}, {"style", {{"name", "seen"}}}})["layer"];
  json layers = client->ask("layers")["layers"];
  ASSERT_THAT(layers, SizeIs(2));
  EXPECT_EQ(layers[1]["layer"], layer);
  EXPECT_EQ(layers[1]["kind"], "binary");
  EXPECT_EQ(layers[1]["style"]["name"], "seen");
  EXPECT_EQ(client->error("set_layer_style", {{"layer", layer}, {"style", {{"name", "new"}}}}), "");
  EXPECT_EQ(client->ask("layers")["layers"][1]["style"]["name"], "new");

  Client other(hub, Encoding::kJson);
  EXPECT_EQ(other.error("remove_layer", {{"layer", layer}}), "session/bad-argument");
  EXPECT_EQ(other.error("cells", {{"layer", layer}}), "session/bad-argument");
  EXPECT_EQ(client->error("remove_layer", {{"layer", layer}}), "");
  EXPECT_EQ(client->error("remove_layer", {{"layer", 0}}), "session/not-available");
  EXPECT_EQ(client->error("create_layer", {{"kind", "round"}, {"style", json::object()}}),
            "protocol/bad-value");
}

TEST_P(NativeProtocol, CanvasResize_ReportedOnceToEveryClient) {
  Client other(hub, Encoding::kJson);
  EXPECT_FALSE(other.ask("time").contains("canvas"));
  const json resized = client->ask("resize_canvas", {{"width", 120}, {"height", 60}});
  EXPECT_EQ(resized["canvas"]["width"], 120);
  EXPECT_FALSE(client->ask("time").contains("canvas"));
  const json answer = other.read("none");
  EXPECT_EQ(answer["canvas"]["height"], 60);
  EXPECT_FALSE(other.read("none").contains("canvas"));
  EXPECT_EQ(client->error("resize_canvas", {{"width", 0}, {"height", 60}}), "session/bad-argument");
  const Client late(hub, Encoding::kJson);
  EXPECT_EQ(late.welcome["canvas"]["width"], 120);
}

TEST_P(NativeProtocol, ViewMode_ReadAndSet) {
  EXPECT_EQ(client->ask("view_mode")["mode"], "ground");
  EXPECT_EQ(client->error("set_view_mode", {{"mode", "mini-map"}}), "");
  EXPECT_EQ(client->ask("view_mode")["mode"], "mini-map");
  EXPECT_EQ(client->error("set_view_mode", {{"mode", "3d"}}), "protocol/bad-value");
}

TEST_P(NativeProtocol, WorldMap_ShowsFloor) {
  const json map = client->ask("world_map", {{"cell_size", 0.1}})["map"];
  const sim::OccupancyMap decoded = protocol::decode_map(map, GetParam());
  EXPECT_EQ(decoded.width, 20);
  EXPECT_EQ(decoded.height, 10);
  EXPECT_EQ(client->error("world_map", {{"cell_size", 0}}), "session/bad-argument");
  EXPECT_EQ(client->error("world_map", {{"cell_size", -1}}), "session/bad-argument");
  // 2 m x 1 m in cells of half a millimetre are 8 million.
  EXPECT_EQ(client->error("world_map", {{"cell_size", 0.0005}}), "session/bad-argument");
}

TEST(NativeFiles, Pictures_StayInsideOutputFolder) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path().string();
  FakeHub hub(test::patient_host(two_robots(), settings));
  Client client(hub, Encoding::kJson);
  EXPECT_EQ(client.error("save_image", {{"name", "now"}, {"scale", 2}}), "");
  EXPECT_TRUE(fs::exists(folder.path() / "now.png"));
  EXPECT_EQ(client.error("save_image", {{"name", "../now"}}), "session/bad-argument");
  EXPECT_EQ(client.error("save_image", {{"name", "now"}, {"scale", 1000}}), "session/bad-argument");
  EXPECT_EQ(client.error("save_image", {{"name", "floor"}, {"layer", 0}}), "");
  EXPECT_TRUE(fs::exists(folder.path() / "floor.png"));
  EXPECT_EQ(client.error("save_image", {{"name", "floor"}, {"layer", 7}}), "session/bad-argument");
  EXPECT_EQ(client.error("save_map", {{"name", "map"}, {"layer", 0}}), "session/bad-argument");
  EXPECT_EQ(client.error("save_map", {{"name", "map"}}), "protocol/bad-value");
  const json layer = client.ask("create_layer", {{"kind", "grey"}, {"style", {{"name", "map"}}}});
  EXPECT_EQ(client.error("save_map", {{"name", "map"}, {"layer", layer["layer"]}}), "");
  EXPECT_TRUE(fs::exists(folder.path() / "map.yaml"));
  EXPECT_TRUE(fs::exists(folder.path() / "map.pgm"));
  EXPECT_EQ(
      client.error("save_map", {{"name", "map"}, {"layer", layer["layer"]}, {"mode", "negative"}}),
      "protocol/bad-value");
}

// --- what is wrong

TEST_P(NativeProtocol, InvalidRequests_Refused) {
  EXPECT_EQ(client->error("dance"), "protocol/unknown-request");
  EXPECT_EQ(client->error("time", {{"now", true}}), "protocol/bad-value");
  EXPECT_EQ(client->error("read"), "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "forever"}}), "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "peek"}, {"timeout", "1"}}), "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "sleep"}, {"timeout", 1e10}}), "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "data"}, {"commands", {1}}}), "protocol/bad-value");
  EXPECT_EQ(client->error("read", {{"wait", "data"}, {"commands", 1}}), "protocol/bad-value");
  EXPECT_EQ(client->error("subscribe"), "protocol/bad-value");
  EXPECT_EQ(client->error("subscribe", {{"device", {0, 99}}}), "session/no-such-device");
  EXPECT_EQ(client->error("replace", {{"device", {7, 0}}, {"replace", true}}),
            "session/no-such-device");
  EXPECT_EQ(client->error("cell", {{"layer", 0}, {"column", 1e12}, {"row", 0}}),
            "protocol/bad-value");
  EXPECT_EQ(client->error("watch", {{"rate", 61}}), "protocol/bad-value");
  EXPECT_EQ(client->error("watch", {{"rate", 1e-9}}), "protocol/bad-value");
  EXPECT_EQ(client->error("thread_ended"), "protocol/bad-value");
  EXPECT_EQ(client->error("thread_ended", {{"thread", -1}}), "protocol/bad-value");
  EXPECT_EQ(client->error("time"), "") << "the connection goes on";
}

TEST_P(NativeProtocol, RequestWithoutId_FailureReportedOnly) {
  client->say({{"do", "draw"}, {"drawings", client->drawing(1, 1, kRed)}});
  EXPECT_EQ(client->hear(), json());
  client->say({{"do", "dance"}});
  const json event = client->hear();
  EXPECT_EQ(event["event"], "error");
  EXPECT_EQ(event["do"], "dance");
  EXPECT_EQ(event["error"], "protocol/unknown-request");
  client->say({{"do", "time"}, {"id", -1}});
  EXPECT_EQ(client->hear()["event"], "error");
  client->say({{"id", 5}});
  EXPECT_EQ(client->hear()["error"], "protocol/bad-value");
}

TEST_P(NativeProtocol, InvalidMessage_ReportedAndSkipped) {
  for (const std::string& garbage :
       {std::string("]["), std::string("\xff\x00\x01", 3), std::string(5000, '['), std::string()}) {
    client->say_bytes(garbage);
    EXPECT_EQ(client->hear()["event"], "error") << garbage.substr(0, 10);
  }
  client->say(json::array({1, 2}));
  EXPECT_EQ(client->hear()["error"], "protocol/not-an-object");
  EXPECT_EQ(client->error("time"), "");
  EXPECT_FALSE(client->peer.closed);
}

TEST_P(NativeProtocol, Bye_AnsweredAndClosed) {
  client->say({{"id", 100}, {"do", "read"}, {"wait", "sleep"}, {"timeout", 0}});
  EXPECT_EQ(client->hear()["id"], 100);
  EXPECT_EQ(client->error("bye"), "");
  EXPECT_TRUE(client->peer.closed);
  client->say({{"id", 1}, {"do", "time"}});
  EXPECT_EQ(client->hear(), json());
}

TEST_P(NativeProtocol, Farewell_NamesReason) {
  Handler& handler = *hub.handlers.at(&client->peer);
  client->peer.close(handler.farewell(protocol::ProtocolError("protocol/too-long", "too long")));
  const json event = client->hear();
  EXPECT_EQ(event["event"], "error");
  EXPECT_EQ(event["error"], "protocol/too-long");
  client->peer.close(handler.farewell(protocol::ProtocolError("server/closing", "it ends")));
  EXPECT_EQ(client->hear()["event"], "bye");
}

// --- watching

std::vector<std::uint8_t> picture(int width, int height) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 4, 0);
}
void set(std::vector<std::uint8_t>& rgba, int width, int column, int row) {
  rgba[static_cast<std::size_t>(row * width + column) * 4] ^= 1U;
}
std::vector<std::vector<int>> rects(const CanvasCopy& copy, std::uint64_t since) {
  std::vector<std::vector<int>> list;
  for (const sim::CellRect& r : copy.changed_since(since)) {
    list.push_back({r.column, r.row, r.width, r.height});
  }
  return list;
}
using Rect = std::vector<int>;

TEST(CanvasCopy, ReportsChangesSinceEachPicture) {
  // 40 x 35 cells: three tiles across (16, 16 and 8) and three down (16, 16 and 3).
  CanvasCopy copy;
  EXPECT_EQ(copy.count(), 0U);
  const CanvasInfo info{40, 35, 0.1, 0.0, 0.0};
  auto now = picture(40, 35);
  auto given = now;
  copy.take(info, given);
  EXPECT_EQ(copy.count(), 1U);
  EXPECT_THAT(rects(copy, 0), ElementsAre(Rect{0, 0, 40, 35}));
  EXPECT_THAT(rects(copy, 1), IsEmpty());

  given = now;
  copy.take(info, given);
  EXPECT_EQ(copy.count(), 1U) << "it is the same picture";

  set(now, 40, 0, 0);
  set(now, 40, 39, 34);
  given = now;
  copy.take(info, given);
  EXPECT_EQ(copy.count(), 2U);
  EXPECT_THAT(rects(copy, 1), ElementsAre(Rect{0, 0, 16, 16}, Rect{32, 32, 8, 3}));

  // A block of two by two tiles is one rectangle; an older picture misses more.
  for (const int column : {20, 33}) {
    for (const int row : {3, 20}) set(now, 40, column, row);
  }
  given = now;
  copy.take(info, given);
  EXPECT_THAT(rects(copy, 2), ElementsAre(Rect{16, 0, 24, 32}));
  EXPECT_THAT(rects(copy, 1),
              ElementsAre(Rect{0, 0, 40, 16}, Rect{16, 16, 24, 16}, Rect{32, 32, 8, 3}));
  const auto cells = copy.cells({33, 2, 2, 2});
  EXPECT_THAT(cells, SizeIs(16));
  EXPECT_EQ(cells[8], 1) << "cell (33, 3)";

  given = picture(20, 70);
  copy.take({20, 70, 0.1, 0.0, 0.0}, given);
  EXPECT_THAT(rects(copy, 3), ElementsAre(Rect{0, 0, 20, 70}));
  EXPECT_TRUE(copy.resized_since(3));
}

class NativeWatch : public NativeProtocol {
 protected:
  /// Sends events to all clients, whenever they are due.
  void tick() { hub.native_state->watching.tick(now_ += std::chrono::seconds(200)); }
  /// Applies an event to a viewer's copy of the canvas.
  void show(Client& viewer, const json& event, std::map<std::pair<int, int>, sim::Colour>& cells) {
    for (const json& part : event.value("canvas", json::array())) {
      const auto values = viewer.bytes(part, "cells");
      const int width = part["rect"][2];
      for (int i = 0; i < width * part["rect"][3].get<int>(); ++i) {
        const auto at = static_cast<std::size_t>(i) * 4;
        cells[{part["rect"][0].get<int>() + i % width, part["rect"][1].get<int>() + i / width}] = {
            values.at(at), values.at(at + 1), values.at(at + 2), values.at(at + 3)};
      }
    }
  }

 private:
  WatchHub::Clock::time_point now_ = WatchHub::Clock::now();
};
INSTANTIATE_TEST_SUITE_P(Encodings, NativeWatch, testing::Values(Encoding::kJson, Encoding::kCbor),
                         encoding_name);

TEST_P(NativeWatch, ReportsPosesAndCanvasChanges) {
  Client viewer(hub, GetParam(), {{"watch", true}});
  EXPECT_EQ(viewer.error("watch", {{"rate", 20}, {"canvas", true}}), "");
  EXPECT_EQ(viewer.hear(), json()) << "the answer comes first";
  hub.fire();  // the first event does not wait
  std::map<std::pair<int, int>, sim::Colour> seen;
  const json first = viewer.hear();
  EXPECT_EQ(first["event"], "watch");
  EXPECT_EQ(first["t"], 0);
  EXPECT_EQ(first["finished"], false);
  ASSERT_THAT(first["poses"], SizeIs(2));
  EXPECT_EQ(first["poses"][1], (json{0.3, 0.7, 0.0}));
  EXPECT_EQ(first["canvas_info"]["width"], 100);
  ASSERT_THAT(first["canvas"], SizeIs(1));
  EXPECT_EQ(first["canvas"][0]["rect"], (json{0, 0, 100, 50}));
  show(viewer, first, seen);
  EXPECT_THAT(seen, SizeIs(5000));

  tick();
  const json second = viewer.hear();
  EXPECT_FALSE(second.contains("canvas"));
  EXPECT_FALSE(second.contains("canvas_info"));

  client->ask("draw", {{"drawings", client->drawing(20, 18, kRed)}});
  client->read("data");
  tick();
  const json third = viewer.hear();
  EXPECT_EQ(third["t"], kSecond_ns / 10);
  ASSERT_THAT(third["canvas"], SizeIs(1));
  EXPECT_EQ(third["canvas"][0]["rect"], (json{16, 16, 16, 16}));
  show(viewer, third, seen);
  EXPECT_EQ((seen[{20, 18}]), kRed);

  client->ask("resize_canvas", {{"width", 90}, {"height", 40}});
  tick();
  const json fourth = viewer.hear();
  EXPECT_EQ(fourth["canvas_info"]["height"], 40);
  EXPECT_EQ(fourth["canvas"][0]["rect"], (json{0, 0, 90, 40}));

  EXPECT_EQ(viewer.error("watch", {{"rate", 0}}), "");
  tick();
  EXPECT_EQ(viewer.hear(), json());
  EXPECT_THAT(hub.timers, IsEmpty());
}

TEST_P(NativeWatch, LostRecord_WholeCanvasNext) {
  client->ask("watch", {{"rate", 20}, {"canvas", true}});
  hub.fire();
  EXPECT_THAT(client->hear()["canvas"], SizeIs(1));
  client->peer.full = true;
  client->ask("draw", {{"drawings", client->drawing(1, 1, kRed)}});
  client->ask("canvas_image");
  tick();
  EXPECT_EQ(client->hear(), json());
  client->peer.full = false;
  tick();
  EXPECT_EQ(client->hear()["canvas"][0]["rect"], (json{0, 0, 100, 50}));
}

TEST_P(NativeWatch, EqualRecords_ShareBytes) {
  std::deque<Client> viewers;
  for (int i = 0; i < 3; ++i) viewers.emplace_back(hub, GetParam(), json{{"watch", true}});
  const Encoding other = GetParam() == Encoding::kJson ? Encoding::kCbor : Encoding::kJson;
  viewers.emplace_back(hub, other, json{{"watch", true}});
  for (Client& viewer : viewers) viewer.ask("watch", {{"rate", 10}, {"canvas", true}});
  hub.fire();
  tick();
  for (const Client& viewer : viewers) ASSERT_THAT(viewer.peer.records, SizeIs(2));
  for (const std::size_t event : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_EQ(viewers[0].peer.records[event], viewers[1].peer.records[event]);
    EXPECT_EQ(viewers[0].peer.records[event], viewers[2].peer.records[event]);
    EXPECT_NE(viewers[0].peer.records[event], viewers[3].peer.records[event]);
  }
}

TEST_P(NativeWatch, Records_SentToDueWatchersOnly) {
  Client rare(hub, GetParam(), {{"watch", true}});
  client->ask("watch", {{"rate", 50}});
  rare.ask("watch", {{"rate", 0.01}});
  hub.fire();
  EXPECT_FALSE(client->hear().is_null());
  EXPECT_FALSE(rare.hear().is_null());
  // 50 Hz: due within 20 ms. The other viewer's period of 100 s has not passed after 90 s.
  hub.native_state->watching.tick(WatchHub::Clock::now() + std::chrono::milliseconds(25));
  EXPECT_FALSE(client->hear().contains("canvas")) << "not asked for";
  EXPECT_EQ(rare.hear(), json());
}

TEST_P(NativeWatch, LargeCanvas_SizeOnly) {
  client->ask("watch", {{"rate", 20}, {"canvas", true}});
  hub.fire();
  client->hear();
  client->ask("resize_canvas", {{"width", 2048}, {"height", 1024}});
  tick();
  const json event = client->hear();
  EXPECT_EQ(event["canvas_info"]["width"], 2048);
  EXPECT_FALSE(event.contains("canvas"));
  tick();
  EXPECT_FALSE(client->hear().contains("canvas_info"));
  client->ask("resize_canvas", {{"width", 100}, {"height", 50}});
  tick();
  EXPECT_EQ(client->hear()["canvas"][0]["rect"], (json{0, 0, 100, 50}));
}

TEST_P(NativeWatch, Watchers_NeitherAwaitedNorAdvanceTime) {
  Client viewer(hub, GetParam(), {{"watch", true}});
  viewer.ask("watch", {{"rate", 20}});
  hub.fire();
  viewer.hear();
  EXPECT_EQ(client->read("data")["t"], kSecond_ns / 10);
  tick();
  EXPECT_EQ(viewer.hear()["t"], kSecond_ns / 10);
  EXPECT_EQ(host->time().sim_time_ns, kSecond_ns / 10);
}

// --- Work that takes long

/// Lines across a canvas of 2048 x 1024 cells, 2048 cells each.
json long_lines(int count, sim::Colour colour, Encoding encoding) {
  std::vector<sim::DrawOperation> lines(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].kind = sim::DrawOperation::Kind::kLine;
    lines[i].x1 = 2047;
    lines[i].y0 = lines[i].y1 = static_cast<int>(i % 1024);
    lines[i].value = sim::CellValue::of(colour);
  }
  return protocol::encode_drawings(lines, encoding);
}

json fills(int count, Encoding encoding) {
  std::vector<sim::DrawOperation> fills(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < fills.size(); ++i) {
    fills[i].kind = sim::DrawOperation::Kind::kFill;
    fills[i].value = sim::CellValue::of(sim::Colour{static_cast<std::uint8_t>(i), 0, 0, 255});
  }
  return protocol::encode_drawings(fills, encoding);
}

/// A large canvas, and a worker thread that the test drives.
class NativeWork : public NativeProtocol {
 protected:
  void SetUp() override {
    NativeProtocol::SetUp();
    client->ask("resize_canvas", {{"width", 2048}, {"height", 1024}});
    hub.work_waits = true;
  }
  int do_all() {
    int pieces = 0;
    while (hub.do_piece()) ++pieces;
    return pieces;
  }
};
INSTANTIATE_TEST_SUITE_P(Encodings, NativeWork, testing::Values(Encoding::kJson, Encoding::kCbor),
                         encoding_name);

// A piece of work is 2^20 cells: 512 of these lines, and the rest of the last one.
TEST_P(NativeWork, LongDrawing_OthersAnsweredBetweenPieces) {
  Client other(hub, GetParam());
  client->say({{"id", 99}, {"do", "draw"}, {"drawings", long_lines(1500, kRed, GetParam())}});
  EXPECT_TRUE(client->peer.busy) << "nothing more is read from it";
  for (int piece = 0; piece < 3; ++piece) {
    EXPECT_EQ(client->hear(), json()) << "after " << piece << " pieces";
    EXPECT_EQ(other.ask("time")["time"]["t"], 0);
    // After each piece, 512 more lines are drawn, and no more.
    EXPECT_EQ(other.colour_at(7, 512 * piece % 1024), piece == 2 ? kRed : kNothing);
    ASSERT_TRUE(hub.do_piece());
    EXPECT_EQ(other.colour_at(7, 512 * piece % 1024), kRed);
  }
  EXPECT_EQ(client->hear()["id"], 99);
  EXPECT_FALSE(client->peer.busy);
  EXPECT_FALSE(hub.do_piece());
}

TEST_P(NativeWork, LongDrawings_SessionsTakeTurns) {
  Client other(hub, GetParam());
  client->say({{"id", 1}, {"do", "draw"}, {"drawings", long_lines(1000, kRed, GetParam())}});
  other.say({{"id", 2}, {"do", "draw"}, {"drawings", long_lines(1000, kBlue, GetParam())}});
  ASSERT_TRUE(hub.do_piece());
  ASSERT_TRUE(hub.do_piece());
  Client third(hub, GetParam());
  EXPECT_EQ(third.colour_at(0, 0), kBlue) << "the second one has had its turn";
  EXPECT_EQ(third.colour_at(0, 900), kNothing) << "neither is done";
  EXPECT_EQ(do_all(), 2);
  EXPECT_EQ(client->hear()["id"], 1);
  EXPECT_EQ(other.hear()["id"], 2);
}

TEST_P(NativeWork, OverlappingFills_PaintedOnce) {
  client->say({{"id", 1}, {"do", "draw"}, {"drawings", fills(5000, GetParam())}});
  // One fill of 2^21 cells. Each of 5000 takes two pieces.
  EXPECT_EQ(do_all(), 2);
  EXPECT_EQ(client->hear()["id"], 1);
  hub.work_waits = false;
  EXPECT_EQ(client->colour_at(0, 0), (sim::Colour{4999 % 256, 0, 0, 255}));
}

TEST_P(NativeWork, Read_StartsAfterItsDrawings) {
  client->say({{"id", 1},
               {"do", "read"},
               {"wait", "sleep"},
               {"timeout", 0.1},
               {"drawings", long_lines(600, kRed, GetParam())}});
  hub.pump();
  EXPECT_EQ(host->time().sim_time_ns, 0) << "its wait has not begun";
  EXPECT_EQ(do_all(), 2);
  hub.run();
  const json answer = client->hear();
  EXPECT_EQ(answer["id"], 1) << answer;
  EXPECT_EQ(answer["t"], kSecond_ns / 10);
}

TEST_P(NativeWork, LargeAnswers_MadeByHubInClaimedRoom) {
  client->say({{"id", 1}, {"do", "canvas_image"}});
  EXPECT_EQ(client->hear(), json());
  EXPECT_GE(hub.claimed, std::size_t{4} << 21U);
  EXPECT_EQ(do_all(), 1);
  const json answer = client->hear();
  EXPECT_EQ(answer["id"], 1);
  EXPECT_THAT(client->bytes(answer, "image"), SizeIs(std::size_t{4} << 21U));
  EXPECT_EQ(hub.claimed, 0U);
  client->say({{"id", 2}, {"do", "cells"}, {"layer", 77}});
  EXPECT_EQ(do_all(), 1);
  EXPECT_EQ(client->hear()["error"], "session/bad-argument");
  EXPECT_FALSE(client->peer.busy);
}

TEST_P(NativeWork, LeavingClient_CancelsWork) {
  client->say({{"do", "draw"}, {"drawings", long_lines(1500, kRed, GetParam())}});
  ASSERT_TRUE(hub.do_piece());
  Client other(hub, GetParam());
  client->leave();
  EXPECT_EQ(do_all(), 1) << "told that its session is closed";
  EXPECT_EQ(other.colour_at(0, 600), kNothing);
}

}  // namespace
}  // namespace playerlike::server
