// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A run with a live page; the test acts as the process that serves it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>

#include "patience.h"
#include "playerlike/host/host.h"
#include "playerlike/page/protocol.h"
#include "sim/core/error.h"

namespace playerlike {
namespace {

using nlohmann::json;
using page::HostKind;
using page::PageKind;
using testing::HasSubstr;

// The page process's end of the connection.
class FakePage {
 public:
  struct Message {
    HostKind kind = HostKind::kPart;
    std::uint32_t client = 0;
    std::string contents;
    // The JSON text of a part or a whole, or an answer.
    [[nodiscard]] json head() const {
      if (kind == HostKind::kAnswer) return json::parse(contents);
      std::uint32_t length = 0;
      std::memcpy(&length, contents.data(), sizeof length);
      return json::parse(contents.substr(sizeof length, length));
    }
  };

  FakePage() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw std::runtime_error("socketpair failed");
    }
    ours_ = ends[0];
    theirs_ = ends[1];
  }
  FakePage(const FakePage&) = delete;
  FakePage& operator=(const FakePage&) = delete;
  ~FakePage() { die(); }
  void die() {
    if (ours_ >= 0) close(ours_);
    ours_ = -1;
  }
  [[nodiscard]] int socket_for_run() const { return theirs_; }

  void send_bytes(const std::string& bytes) const {
    EXPECT_EQ(send(ours_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  void say(PageKind kind, std::uint32_t client = 0, const std::string& contents = "") const {
    send_bytes(page::page_message(kind, client, contents));
  }
  void command(const std::string& text, std::uint32_t client = 1) const {
    say(PageKind::kCommand, client, text);
  }

  // The next message, of which parts are taken; nullopt at the end of the connection.
  // @param take  whether to say that.
  [[nodiscard]] std::optional<Message> next(bool take = true) const {
    page::Header header;
    std::string bytes;
    if (!read(sizeof header, bytes)) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (!page::is_from_host(header)) throw std::runtime_error("an invalid message");
    Message message{static_cast<HostKind>(header.kind), header.client, ""};
    if (!read(header.length, message.contents)) return std::nullopt;
    if (take && message.kind == HostKind::kPart) {
      const std::string taken = page::page_message(PageKind::kTaken);
      static_cast<void>(send(ours_, taken.data(), taken.size(), MSG_NOSIGNAL));  // or it is over
    }
    return message;
  }
  // The next message of this kind for which `is_it` holds.
  template <typename IsIt>
  json await(HostKind kind, const IsIt& is_it) const {
    for (;;) {
      const auto message = next();
      if (!message) throw std::runtime_error("the run has closed the connection");
      if (message->kind == kind && is_it(message->head())) return message->head();
    }
  }
  json await(HostKind kind) const {
    return await(kind, [](const json&) { return true; });
  }
  std::string refusal() const { return await(HostKind::kAnswer).at("refused"); }

 private:
  [[nodiscard]] bool read(std::size_t count, std::string& bytes) const {
    bytes.resize(count);
    std::size_t got = 0;
    while (got < count) {
      pollfd readable{ours_, POLLIN, 0};
      if (poll(&readable, 1,
               static_cast<int>(std::chrono::milliseconds(test_support::patience()).count())) <=
          0) {
        throw std::runtime_error("the run sends nothing");
      }
      const ssize_t part = recv(ours_, bytes.data() + got, count - got, 0);
      if (part <= 0) return false;
      got += static_cast<std::size_t>(part);
    }
    return true;
  }

  int ours_ = -1;
  int theirs_ = -1;
};

class PagedHostTest : public testing::Test {
 protected:
  void start(const std::string& simulation = R"({"time": "real"})") {
    RunSettings settings;
    settings.page_socket = page.socket_for_run();
    settings.start_at_once = true;
    host = Host::create(
        sim::load_world_text(R"({"name": "two", "arena": {"size": [20, 4], "obstacles": [
              {"name": "gate", "center": [15, 2], "size": [1, 1], "type": "dynamic",
               "state": "retracted"}]},
            "robots": [{"name": "r1", "pose": {"x": 5, "y": 1}},
                       {"name": "r2", "pose": {"x": 5, "y": 3}}], "simulation": )" +
                             simulation + "}"),
        std::move(settings), [this](sim::LogLevel, std::string_view text) {
          const std::lock_guard lock(log_mutex);
          log += std::string(text) + '\n';
          logged.notify_all();
        });
    page.say(PageKind::kReady, 0, "8080");
  }
  sim::Pose place(int robot) const {
    return host->with_simulation([&](const sim::Simulation& all) { return all.body(robot).X_WB; });
  }
  std::string gate() const {
    return host->with_simulation([](const sim::Simulation& all) {
      return std::string(all.world().arena.obstacles[0].state == sim::ObstacleState::kRetracted
                             ? "retracted"
                             : "extended");
    });
  }
  std::string wait_for_log(const std::string& words) {
    std::unique_lock lock(log_mutex);
    logged.wait_for(lock, test_support::patience(),
                    [&] { return log.find(words) != std::string::npos; });
    return log;
  }
  // Waits until the run has executed all commands before.
  void synchronise() const {
    page.command("{}", 99);
    const auto is_answer = [](const json&) { return true; };
    static_cast<void>(page.await(HostKind::kAnswer, is_answer));
  }

  FakePage page;
  std::shared_ptr<Host> host;
  std::mutex log_mutex;
  std::condition_variable logged;
  std::string log;
};

TEST_F(PagedHostTest, Viewer_GetsWholeAndThenParts) {
  start();
  page.say(PageKind::kWantWhole);
  const json whole = page.await(HostKind::kWhole);
  EXPECT_FALSE(whole.contains("part"));
  EXPECT_EQ(whole["runs"][0]["world"], "two");
  EXPECT_EQ(whole["runs"][0]["robots"].size(), 2U);
  EXPECT_EQ(whole["live"]["can"]["blocks"], json::array({"gate"}));
  EXPECT_EQ(whole["live"]["can"]["place"], true);
  EXPECT_TRUE(whole["live"].contains("waiting_for"));
  std::int64_t end = whole["runs"][0]["end"];
  for (int i = 0; i < 3; ++i) {
    const json part = page.await(HostKind::kPart);
    EXPECT_EQ(part["part"], true);
    EXPECT_FALSE(part["runs"][0].contains("arena"));
    EXPECT_GT(part["runs"][0]["end"], end);
    end = part["runs"][0]["end"];
  }
}

// Who comes later sees the trails of the time before.
TEST_F(PagedHostTest, NobodyTakesParts_HistoryGoesOn) {
  start();
  const auto first = page.next(/*take=*/false);
  ASSERT_TRUE(first);
  const sim::SimTime begin_ns = host->now_ns();
  const auto end = std::chrono::steady_clock::now() + test_support::patience();
  while (host->now_ns() < begin_ns + 2 * sim::kNanosecondsPerSecond &&
         std::chrono::steady_clock::now() < end) {
    usleep(1000);
  }
  page.say(PageKind::kTaken);
  page.say(PageKind::kWantWhole);
  for (;;) {
    const auto message = page.next();
    ASSERT_TRUE(message);
    // Viewers that were only late begin anew, since parts are missing.
    if (message->kind != HostKind::kAnew && message->kind != HostKind::kWhole) continue;
    EXPECT_EQ(message->kind, HostKind::kAnew);
    const json head = message->head();
    const auto frames = head["columns"][head["runs"][0]["frames"].get<std::size_t>()][1];
    EXPECT_GE(frames, 4);  // each 0.2 s
    break;
  }
}

TEST_F(PagedHostTest, Stick_DrivesUntilItsClientLeaves) {
  start();
  page.command(R"({"steer": {"robot": 1, "ahead": 1, "left": 0}})");
  const auto drives = [](const json& head) { return head["live"]["steered"] == json::array({1}); };
  static_cast<void>(page.await(HostKind::kPart, drives));
  page.say(PageKind::kGone, 1);
  static_cast<void>(page.await(HostKind::kPart,
                               [](const json& head) { return head["live"]["steered"].empty(); }));
  EXPECT_GT(place(1).x_m, 5.0);
  EXPECT_EQ(place(0).x_m, 5.0);
}

TEST_F(PagedHostTest, StickWithoutRepetition_EndsByItself) {
  start();
  page.command(R"({"steer": {"robot": 0, "ahead": 0.5, "left": 0.5}})");
  const auto drives = [](const json& head) { return head["live"]["steered"] == json::array({0}); };
  static_cast<void>(page.await(HostKind::kPart, drives));
  static_cast<void>(page.await(HostKind::kPart,
                               [](const json& head) { return head["live"]["steered"].empty(); }));
  EXPECT_NE(place(0).yaw_rad, 0.0);
}

TEST_F(PagedHostTest, Pause_StopsTimeAndShowsWhatPeopleMove) {
  start();
  page.command(R"({"pause": true})");
  static_cast<void>(
      page.await(HostKind::kPart, [](const json& head) { return head["live"]["paused"] == true; }));
  const sim::SimTime now_ns = host->now_ns();
  page.command(R"({"block": {"name": "gate", "up": true}})");
  page.command(R"({"place": {"robot": 0, "x": 1.5, "y": 2.5, "a": 1}})");
  synchronise();
  EXPECT_EQ(gate(), "extended");
  EXPECT_EQ(place(0).x_m, 1.5);
  static_cast<void>(page.await(
      HostKind::kPart, [](const json& head) { return head["runs"][0]["obstacles"].size() == 1; }));
  EXPECT_EQ(host->now_ns(), now_ns);
  page.command(R"({"pause": false})");
  static_cast<void>(page.await(HostKind::kPart,
                               [](const json& head) { return head["live"]["paused"] == false; }));
}

TEST_F(PagedHostTest, Speed_Changes) {
  start();
  page.command(R"({"speed": 4})");
  static_cast<void>(
      page.await(HostKind::kPart, [](const json& head) { return head["live"]["factor"] == 4; }));
}

TEST_F(PagedHostTest, BadCommands_AreRefusedWithTheReason) {
  start();
  const std::pair<const char*, const char*> cases[] = {
      {"[", "parse error"},
      {"{}", "one member"},
      {R"({"jump": 1})", "no command \"jump\""},
      {R"({"pause": 1})", "true or false"},
      {R"({"speed": "fast"})", "finite number"},
      {R"({"speed": 1e9})", "[0.0625, 64]"},
      {R"({"steer": {"robot": 7, "ahead": 1, "left": 0}})", "no robot 7"},
      {R"({"steer": {"robot": 0.5, "ahead": 1, "left": 0}})", "no robot 0.5"},
      {R"({"steer": {"robot": -1e300, "ahead": 1, "left": 0}})", "no robot"},
      {R"({"steer": {"robot": 0, "ahead": 2, "left": 0}})", "\"ahead\" must be in [-1, 1]"},
      {R"({"steer": {"robot": 0, "ahead": 1}})", "\"left\" is missing"},
      {R"({"steer": 3})", "is missing"},
      {R"({"block": {"name": "door", "up": true}})", "door"},
      {R"({"block": {"name": 4, "up": true}})", "text"},
      {R"({"place": {"robot": 9, "x": 1, "y": 1, "a": 0}})", "no robot 9"},
      {R"({"place": {"robot": 0, "x": 1e9, "y": 1, "a": 0}})", "pose"},
      {R"({"place": {"robot": 0, "x": 5, "y": 3, "a": 0}})", "r2"}};
  std::uint32_t client = 1;
  for (const auto& [command, words] : cases) {
    page.command(command, ++client);
    for (;;) {
      const auto message = page.next();
      ASSERT_TRUE(message);
      if (message->kind != HostKind::kAnswer) continue;
      EXPECT_EQ(message->client, client) << command;
      EXPECT_THAT(message->head()["refused"].get<std::string>(), HasSubstr(words)) << command;
      break;
    }
  }
  EXPECT_EQ(place(0).x_m, 5.0);
}

TEST_F(PagedHostTest, LockedWorld_NothingIsMoved) {
  start(R"({"time": "real", "lock_objects": true})");
  page.say(PageKind::kWantWhole);
  const json whole = page.await(HostKind::kWhole);
  EXPECT_THAT(whole["live"]["can"]["place"].get<std::string>(), HasSubstr("lock_objects"));
  EXPECT_EQ(whole["live"]["can"]["blocks"], json::array());
  page.command(R"({"block": {"name": "gate", "up": true}})");
  EXPECT_THAT(page.refusal(), HasSubstr("lock_objects"));
  EXPECT_EQ(gate(), "retracted");
}

TEST_F(PagedHostTest, Lockstep_CanBePausedAndSlowed) {
  start(R"({"time": "lockstep"})");
  const std::unique_ptr<Session> session = host->connect(6665);
  static_cast<void>(page.await(HostKind::kPart,
                               [](const json& head) { return head["live"]["waiting_for"] == 1; }));
  page.command(R"({"speed": 0.5})");
  page.command(R"({"pause": true})");
  synchronise();
  const json part =
      page.await(HostKind::kPart, [](const json& head) { return head["live"]["paused"] == true; });
  EXPECT_EQ(part["live"]["factor"], 0.5);
  EXPECT_EQ(part["live"]["paced"], false);
}

TEST_F(PagedHostTest, EndOfRun_LastPartSaysSo) {
  start();
  static_cast<void>(page.await(HostKind::kPart));
  host->finish();
  bool over = false;
  while (const auto message = page.next()) {
    if (message->kind == HostKind::kPart) over = message->head()["live"]["over"];
  }
  EXPECT_TRUE(over);
}

TEST_F(PagedHostTest, PageProcessEnds_RunGoesOnUnpaused) {
  start();
  page.command(R"({"pause": true})");
  synchronise();
  page.die();
  EXPECT_THAT(wait_for_log("the live page is lost"), HasSubstr("run continues"));
  const sim::SimTime now_ns = host->now_ns();
  const auto end = std::chrono::steady_clock::now() + test_support::patience();
  while (host->now_ns() == now_ns && std::chrono::steady_clock::now() < end) usleep(1000);
  EXPECT_GT(host->now_ns(), now_ns);
}

TEST_F(PagedHostTest, Garbage_PageIsLost) {
  start();
  page.send_bytes(std::string(64, 'x'));
  EXPECT_THAT(wait_for_log("the live page is lost"), HasSubstr("invalid message"));
}

TEST(PagedHost, DescriptorIsNoSocket_Error) {
  RunSettings settings;
  settings.page_socket = STDIN_FILENO;
  EXPECT_THROW(static_cast<void>(Host::create(
                   sim::load_world_text(R"({"arena": {"size": [2, 2]}, "robots": []})"), settings)),
               std::runtime_error);
}

}  // namespace
}  // namespace playerlike
