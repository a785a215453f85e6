// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The core of the server: ports, connections and their limits, with a handler that understands a
// few words, and raw sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "patience.h"
#include "patient_host.h"
#include "raw_client.h"
#include "server/server_hub.h"
#include "sim/core/error.h"
#include "temporary_folder.h"

namespace playerlike::server {
namespace {

using test_support::RawClient;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::shared_ptr<Host> make_host(const std::string& simulation = "{}") {
  return test::patient_host(sim::load_world_text(
      R"({"name": "room", "arena": {"size": [20, 4]}, "simulation": )" + simulation +
      R"(, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}},
                      {"name": "r2", "pose": {"x": 1, "y": 3}}]})"));
}

/// Answers lines that consist of a word and a number.
class WordHandler final : public Handler {
 public:
  WordHandler(Peer& peer, Hub& hub, std::atomic<int>& alive, bool silent = false)
      : peer_(peer),
        hub_(hub),
        alive_(alive),
        silent_(silent),
        self_(std::make_shared<WordHandler*>(this)) {
    ++alive_;
  }
  ~WordHandler() override { --alive_; }

  void on_message(std::string_view message) override {
    const std::string text(message);
    if (bytes_) return peer_.send(text);
    const auto blank = text.find(' ');
    const std::string word = text.substr(0, blank);
    const int number = blank == std::string::npos ? 0 : std::atoi(text.c_str() + blank);
    if (word == "echo") {
      peer_.send(text + '\n');
    } else if (word == "fill") {
      peer_.send(std::string(static_cast<std::size_t>(number), 'x') + '\n');
    } else if (word == "flood") {  // many answers to one request
      for (int i = 0; i < number; ++i) peer_.send(std::string(100'000, 'x') + '\n');
    } else if (word == "records") {
      const auto record = std::make_shared<const std::string>(std::string(99'999, 'r') + '\n');
      int sent = 0;
      for (int i = 0; i < number; ++i) sent += peer_.send_record(record) ? 1 : 0;
      peer_.send("sent " + std::to_string(sent) + '\n');
    } else if (word == "hold") {
      peer_.set_in_flight(static_cast<std::size_t>(++held_));
      peer_.send("held " + std::to_string(held_) + '\n');
    } else if (word == "later") {  // holds until the timer expires
      peer_.set_in_flight(static_cast<std::size_t>(++held_));
      hub_.after(std::chrono::milliseconds(number), [this, self = std::weak_ptr(self_)] {
        if (self.expired()) return;
        peer_.set_in_flight(static_cast<std::size_t>(--held_));
        peer_.send("later\n");
      });
    } else if (word == "name") {
      peer_.describe("a\nname" + std::string(1000, 'x'));
      peer_.send("named\n");
    } else if (word == "next") {
      hub_.hand_over(peer_, std::make_unique<WordHandler>(peer_, hub_, alive_));
      peer_.send("next\n");
    } else if (word == "frames") {
      peer_.set_framing(protocol::Framing::kFrames);
    } else if (word == "bytes") {
      bytes_ = true;
      peer_.send("bytes\n");
    } else if (word == "bye") {
      peer_.close("bye\n");
    } else if (word == "break") {
      throw std::runtime_error("broken");
    } else if (word == "refuse") {
      throw protocol::ProtocolError("protocol/test", "refused");
    } else if (word == "join") {
      client_ = hub_.host().connect_events(6665, [this, self = std::weak_ptr(self_)] {
        hub_.post([this, self] {
          if (!self.expired()) answer_wait();
        });
      });
      client_->session().request(SubscribeRequest{
          find_interface(client_->session().robots(), 6665, "position2d", 0).reading});
      peer_.send("joined\n");
    } else if (word == "read") {
      const auto thread_id = hub_.thread_id("test", static_cast<std::uint64_t>(number));
      if (client_->begin_wait(thread_id) != EventClient::Outcome::kWaiting) return answer_wait();
      hub_.pump();
    } else if (word == "quit") {
      hub_.quit();
    } else if (word == "open") {
      const int port = hub_.listen(number, [this](Peer& peer, Hub& hub) {
        return std::make_unique<WordHandler>(peer, hub, alive_, true);
      });
      peer_.send("open " + std::to_string(port) + '\n');
    } else {
      peer_.send("what? " + std::to_string(text.size()) + '\n');
    }
  }

  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override {
    return "closed: " + error.id() + '\n';
  }
  [[nodiscard]] bool takes_bytes() const noexcept override { return bytes_; }
  [[nodiscard]] bool may_be_silent() const noexcept override { return silent_; }

 private:
  void answer_wait() {
    struct Nothing : ReadingSink {
      void on_reading(DeviceId, const sim::SharedReading&) override {}
    } sink;
    if (client_->outcome() == EventClient::Outcome::kFinished) return peer_.send("finished\n");
    const auto count = client_->session().take(sink);
    peer_.send(std::to_string(client_->session().request(TimeRequest{}).sim_time_ns / 1'000'000) +
               " ms, " + std::to_string(count) + '\n');
  }

  Peer& peer_;
  Hub& hub_;
  std::atomic<int>& alive_;
  bool silent_;
  bool bytes_ = false;
  std::shared_ptr<WordHandler*> self_;  ///< observed by calls that may come after its end
  int held_ = 0;
  std::unique_ptr<EventClient> client_;
};

/// A log hook's messages; any thread can wait for one.
class Log {
 public:
  [[nodiscard]] sim::LogHook hook() {
    return [this](sim::LogLevel level, std::string_view text) {
      const std::lock_guard lock(mutex_);
      if (level >= sim::LogLevel::kInfo) lines_.emplace_back(text);
      changed_.notify_all();
    };
  }
  /// Waits for the first line that contains a text; "" if that takes too long.
  [[nodiscard]] std::string wait_for(const std::string& part) {
    std::unique_lock lock(mutex_);
    std::string found;
    changed_.wait_for(lock, test_support::patience(), [&] {
      for (const std::string& line : lines_) {
        if (line.find(part) != std::string::npos) found = line;
      }
      return !found.empty();
    });
    return found;
  }
  [[nodiscard]] std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

class ServerTest : public testing::Test {
 protected:
  ServerTest() { settings.port = 0; }

  ServerHub& start(std::shared_ptr<Host> with_host = make_host()) {
    host = std::move(with_host);
    hub = std::make_unique<ServerHub>(host, settings, log.hook(), [this](Peer& peer, Hub& body) {
      return std::make_unique<WordHandler>(peer, body, handlers);
    });
    return *hub;
  }
  [[nodiscard]] RawClient connect() const { return RawClient("127.0.0.1", hub->port()); }
  /// Waits until all clients' handlers are destroyed.
  void wait_until_empty() const {
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while ((hub->connections() > 0 || handlers > 0) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(hub->connections(), 0U);
    EXPECT_EQ(handlers, 0);
  }
  /// The server still answers.
  void expect_alive() const {
    RawClient client = connect();
    client.send("echo 1\n");
    EXPECT_EQ(client.line(), "echo 1");
  }

  ServerSettings settings;
  Log log;
  std::atomic<int> handlers{0};
  std::shared_ptr<Host> host;
  std::unique_ptr<ServerHub> hub;
};

TEST_F(ServerTest, Connections_HaveOwnHandlers) {
  start();
  EXPECT_GT(hub->port(), 0);
  RawClient one = connect();
  RawClient two = connect();
  one.send("echo 1\n");
  two.send("echo 2\n");
  EXPECT_EQ(one.line(), "echo 1");
  EXPECT_EQ(two.line(), "echo 2");
  EXPECT_EQ(hub->connections(), 2U);
  EXPECT_EQ(handlers, 2);
}

TEST_F(ServerTest, Messages_SplitInAnyPieces) {
  start();
  RawClient client = connect();
  client.send("echo 1\necho 2\r\nec");
  EXPECT_EQ(client.line(), "echo 1");
  EXPECT_EQ(client.line(), "echo 2");
  client.send("ho 3\n");
  EXPECT_EQ(client.line(), "echo 3");
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "echo " + std::to_string(i) + '\n';
  client.send(many);
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(client.line(), "echo " + std::to_string(i));
}

TEST_F(ServerTest, HalfClosedConnection_PendingRequestsAnswered) {
  start();
  RawClient client = connect();
  client.send("echo 1\necho 2\nec");
  client.stop_sending();
  EXPECT_EQ(client.rest(), "echo 1\necho 2\n");
  EXPECT_THAT(log.wait_for("closed"),
              AllOf(HasSubstr("127.0.0.1:"), HasSubstr("it left"), HasSubstr("2 requests")));
  wait_until_empty();
}

TEST_F(ServerTest, ClientNames_EscapedInLog) {
  start();
  RawClient client = connect();
  client.send("name\n");
  EXPECT_EQ(client.line(), "named");
  client.close();
  const std::string line = log.wait_for("closed");
  EXPECT_THAT(line, AllOf(HasSubstr("(a?name"), Not(HasSubstr("\n"))));
  EXPECT_LT(line.size(), 400U);
}

TEST_F(ServerTest, Handover_MayChangeEncoding) {
  start();
  RawClient client = connect();
  // Two handlers are never in charge of one connection: input held by the first one is discarded.
  client.send("hold\nnext\nhold\n");
  EXPECT_EQ(client.line(), "held 1");
  EXPECT_EQ(client.line(), "next");
  EXPECT_EQ(client.line(), "held 1");
  EXPECT_EQ(handlers, 1);
  // A frame of six bytes, in the same packet as the line that announces frames.
  client.send(std::string("frames\n\0\0\0\6echo 5", 17));
  EXPECT_EQ(client.line(), "echo 5");
}

TEST_F(ServerTest, Handler_ClosesWithFarewell) {
  start();
  RawClient client = connect();
  client.send("echo 1\nbye\necho 2\n");
  EXPECT_EQ(client.rest(), "echo 1\nbye\n");
  wait_until_empty();
}

TEST_F(ServerTest, FaultyHandler_EndsItsConnectionOnly) {
  start();
  RawClient other = connect();
  RawClient broken = connect();
  broken.send("break\n");
  EXPECT_EQ(broken.rest(), "closed: server/internal\n");
  RawClient refused = connect();
  refused.send("refuse\n");
  EXPECT_EQ(refused.rest(), "closed: protocol/test\n");
  other.send("echo 1\n");
  EXPECT_EQ(other.line(), "echo 1");
}

TEST_F(ServerTest, Ipv6AndHostNames_Accepted) {
  if (!RawClient::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
  settings.bind = "::1";
  start();
  RawClient six("::1", hub->port());
  six.send("echo 6\n");
  EXPECT_EQ(six.line(), "echo 6");
  six.close();
  EXPECT_THAT(log.wait_for("closed"), HasSubstr("[::1]:"));

  settings.bind = "localhost";
  start();
  RawClient four("127.0.0.1", hub->port());
  four.send("echo 4\n");
  EXPECT_EQ(four.line(), "echo 4");
}

// --- Ports and addresses

std::vector<sim::ConfigIssue> issues_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const sim::ConfigError& error) {
    return error.issues();
  }
  return {};
}

TEST_F(ServerTest, PortInUse_ErrorNamesIt) {
  start();
  settings.port = hub->port();
  const auto issues = issues_of([&] { ServerHub second(make_host(), settings, {}, {}); });
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "server/port-taken");
  EXPECT_THAT(issues[0].found, HasSubstr(std::to_string(hub->port())));
  EXPECT_THAT(issues[0].hint, HasSubstr("port 0"));
  expect_alive();
}

TEST_F(ServerTest, UnixSocket_OwnersOnlyAndRemovedAtEnd) {
  const TemporaryFolder folder;
  settings.unix_path = folder / "robots";
  settings.port.reset();
  start();
  struct stat status {};
  ASSERT_EQ(lstat(settings.unix_path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  hub.reset();
  EXPECT_FALSE(std::filesystem::exists(settings.unix_path));
}

TEST_F(ServerTest, UnixSocket_ReplacedOnlyIfNobodyListens) {
  const TemporaryFolder folder;
  settings.unix_path = folder / "robots";
  // A process that was killed leaves its socket.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  settings.unix_path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int left = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(bind(left, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(left);
  ASSERT_TRUE(std::filesystem::exists(settings.unix_path));
  start();
  const auto issues = issues_of([&] { ServerHub second(make_host(), settings, {}, {}); });
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "server/unix-socket");
  EXPECT_THAT(issues[0].found, HasSubstr("a server listens there"));
  expect_alive();
  EXPECT_TRUE(std::filesystem::exists(settings.unix_path));
}

TEST_F(ServerTest, UnixSocket_UnusablePaths_Refused) {
  const TemporaryFolder folder;
  struct Case {
    std::string path;
    const char* found;
  };
  for (const Case& c : {Case{folder.write("file", "text"), "a file that is no socket"},
                        Case{folder / "no/such/folder", "No such file"},
                        Case{std::string(108, 'a'), "108 bytes"}}) {
    settings.unix_path = c.path;
    const auto issues = issues_of([&] { ServerHub refused(make_host(), settings, {}, {}); });
    ASSERT_THAT(issues, SizeIs(1)) << c.path;
    EXPECT_EQ(issues[0].id, "server/unix-socket");
    EXPECT_THAT(issues[0].found, HasSubstr(c.found));
  }
  EXPECT_EQ(test_support::read_bytes(folder / "file"), "text");
}

TEST_F(ServerTest, ClosedPort_FreeAtOnce) {
  start();
  RawClient client = connect();
  client.send("echo 1\n");
  EXPECT_EQ(client.line(), "echo 1");
  settings.port = hub->port();
  hub.reset();  // closes first, so its end of the connection stays in TIME_WAIT
  start();
  expect_alive();
}

TEST_F(ServerTest, ForeignAddress_ErrorNamesIt) {
  settings.open = true;
  for (const char* address : {"203.0.113.7", "no.such.name.invalid", "", "1.2.3"}) {
    settings.bind = address;
    const auto issues = issues_of([&] { start(); });
    ASSERT_THAT(issues, SizeIs(1)) << address;
    EXPECT_EQ(issues[0].id, "server/address") << address;
  }
}

TEST_F(ServerTest, OtherMachines_NeedToken) {
  settings.bind = "0.0.0.0";
  const auto issues = issues_of([&] { start(); });
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "server/token-needed");
  EXPECT_THAT(issues[0].hint, HasSubstr("--open"));
  settings.access.server_token = "a long secret";
  start();
  expect_alive();
  settings.access.server_token.clear();
  settings.open = true;
  start();
  expect_alive();
}

TEST_F(ServerTest, FurtherPorts_CountUpFromFirst) {
  start();
  RawClient client = connect();
  client.send("open 0\n");
  const int first = std::stoi(client.line().substr(5));
  RawClient stream("127.0.0.1", first);
  stream.send("echo 1\n");
  EXPECT_EQ(stream.line(), "echo 1");
  client.send("open " + std::to_string(first) + '\n');
  EXPECT_GT(std::stoi(client.line().substr(5)), first);
}

TEST_F(ServerTest, ClockSynchronisation_StepsPerMessage) {
  settings.sync_port = 0;
  start();
  ASSERT_GT(hub->sync_port(), 0);
  RawClient clock("127.0.0.1", hub->sync_port());
  clock.send("\n\n\n");
  const auto steps = [&](std::uint64_t wanted) {
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    while (host->time().steps < wanted && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return host->time().steps;
  };
  EXPECT_EQ(steps(3), 3U);
  clock.send("x");
  EXPECT_EQ(steps(4), 4U);
}

// --- Time

TEST_F(ServerTest, Lockstep_AdvancesWhenClientWaits) {
  start();
  RawClient client = connect();
  client.send("join\n");
  EXPECT_EQ(client.line(), "joined");
  for (int i = 1; i <= 50; ++i) {
    client.send("read\n");
    EXPECT_EQ(client.line(), std::to_string(100 * i) + " ms, 1");
  }
  EXPECT_EQ(host->time().steps, 500U);
}

TEST_F(ServerTest, Lockstep_AwaitsEachConnectedClient) {
  start(make_host(R"({"clients": 2})"));
  RawClient one = connect();
  RawClient two = connect();
  one.send("join\nread 1\n");
  EXPECT_EQ(one.line(), "joined");
  two.send("join\nread 2\n");
  EXPECT_EQ(two.line(), "joined");
  EXPECT_EQ(one.line(), "100 ms, 1");
  EXPECT_EQ(two.line(), "100 ms, 1");
  one.send("read 1\n");
  two.close();
  EXPECT_EQ(one.line(), "200 ms, 1");
}

TEST_F(ServerTest, EndOfRun_SentToWaitingClients) {
  start(make_host(R"({"duration": 0.25})"));
  RawClient client = connect();
  client.send("join\nread\n");
  EXPECT_EQ(client.line(), "joined");
  EXPECT_EQ(client.line(), "100 ms, 1");
  client.send("read\n");  // not earlier: a second read joins a wait that goes on
  EXPECT_EQ(client.line(), "200 ms, 1");
  client.send("read\n");
  EXPECT_EQ(client.line(), "finished");
  EXPECT_FALSE(hub->done());
  client.close();
  wait_until_empty();
  EXPECT_TRUE(hub->done());
}

TEST_F(ServerTest, PacedTime_AnswersFromItsThread) {
  start(make_host(R"({"time": "real"})"));
  RawClient client = connect();
  client.send("join\nread\nread\n");
  EXPECT_EQ(client.line(), "joined");
  EXPECT_THAT(client.line(), HasSubstr(" ms, 1"));
}

TEST_F(ServerTest, Quit_EndsServer) {
  start();
  RawClient client = connect();
  EXPECT_FALSE(hub->done());
  client.send("quit\necho 1\n");
  EXPECT_EQ(client.line(), "echo 1");
  EXPECT_TRUE(hub->done());
}

TEST_F(ServerTest, Stop_SendsGoodbye) {
  start();
  RawClient client = connect();
  RawClient silent = connect();
  client.send("echo 1\nhold\n");
  EXPECT_EQ(client.line(), "echo 1");
  EXPECT_EQ(client.line(), "held 1");
  hub->stop();
  EXPECT_EQ(client.rest(), "closed: server/closing\n");
  EXPECT_EQ(handlers, 0);
  hub->stop();
}

// --- Limits

TEST_F(ServerTest, LongMessage_ClosesItsConnection) {
  settings.limits.message_bytes = 1000;
  start();
  RawClient client = connect();
  client.send(std::string(999, 'y') + "\n" + std::string(5000, 'z'));
  EXPECT_EQ(client.rest(), "what? 999\nclosed: protocol/too-long\n");
  EXPECT_THAT(log.wait_for("closed"), HasSubstr("protocol/too-long"));
  expect_alive();
}

TEST_F(ServerTest, FurtherConnections_RefusedWithLine) {
  settings.limits.connections = 2;
  start();
  RawClient one = connect();
  RawClient two = connect();
  one.send("echo 1\n");
  EXPECT_EQ(one.line(), "echo 1");
  RawClient three = connect();
  three.send("echo 3\n");
  EXPECT_THAT(three.rest(), AllOf(HasSubstr("- FAILED \"server/full"), HasSubstr(" 2 ")));
  EXPECT_THAT(log.wait_for("in use"), Not(IsEmpty()));
  two.close();
  // Its slot is free after the server has noticed.
  for (std::string answer; answer != "echo 4";) {
    RawClient four = connect();
    four.send("echo 4\n");
    answer = four.line();
    ASSERT_TRUE(answer == "echo 4" || answer.starts_with("- FAILED")) << answer;
  }
}

TEST_F(ServerTest, RequestsInFlight_Limited) {
  settings.limits.requests_in_flight = 3;
  start();
  RawClient client = connect();
  client.send("hold\nhold\nlater 100\necho 1\n");
  EXPECT_EQ(client.line(), "held 1");
  EXPECT_EQ(client.line(), "held 2");
  EXPECT_EQ(client.line(), "later");  // before this answer, no other input is read
  EXPECT_EQ(client.line(), "echo 1");
}

TEST_F(ServerTest, ClientThatLeavesWithRequestsInFlight_Detected) {
  settings.limits.requests_in_flight = 1;
  start();
  RawClient client = connect();
  client.send("hold\necho 1\n");
  EXPECT_EQ(client.line(), "held 1");
  client.close();
  wait_until_empty();
}

TEST_F(ServerTest, FirstRequest_HasTimeLimit) {
  settings.limits.first_request_s = 0.2;
  start();
  RawClient client = connect();
  EXPECT_EQ(client.rest(), "closed: server/first-request\n");
  wait_until_empty();
}

TEST_F(ServerTest, PartialRequest_HasTimeLimit) {
  settings.limits.partial_request_s = 0.2;
  start();
  RawClient client = connect();
  client.send("echo 1\nech");
  EXPECT_EQ(client.line(), "echo 1");
  EXPECT_EQ(client.rest(), "closed: server/partial-request\n");
  wait_until_empty();
}

TEST_F(ServerTest, SlowBytes_DoNotExtendTimeLimit) {
  settings.limits.partial_request_s = 0.3;
  start();
  RawClient client = connect();
  // Sends until the server closes the connection.
  while (client.send_if_open("y")) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  wait_until_empty();
  EXPECT_THAT(log.wait_for("closed"), HasSubstr("server/partial-request"));
}

TEST_F(ServerTest, IdleClients_ClosedIfRequested) {
  settings.limits.idle_s = 0.2;
  start();
  RawClient client = connect();
  client.send("later 500\n");
  EXPECT_EQ(client.line(), "later");  // a client that waits for an answer is not idle
  EXPECT_EQ(client.rest(), "closed: server/idle\n");
}

TEST_F(ServerTest, Handlers_MayAllowSilence) {
  settings.limits.first_request_s = 0.2;
  start();
  std::optional<RawClient> client;
  std::string opened;
  while (!opened.starts_with("open ")) {  // on a loaded machine this request may come too late, too
    client.emplace(connect());
    if (client->send_if_open("open 0\n")) opened = client->line();
  }
  RawClient stream("127.0.0.1", std::stoi(opened.substr(5)));
  RawClient silent = connect();
  // the time has also passed for all others
  EXPECT_EQ(silent.rest(), "closed: server/first-request\n");
  stream.send("echo 1\n");
  EXPECT_EQ(stream.line(), "echo 1");
}

TEST_F(ServerTest, Handlers_MayTakeRawBytes) {
  settings.limits.message_bytes = 10;
  settings.limits.partial_request_s = 0.1;
  start();
  RawClient client = connect();
  client.send("bytes\n");
  EXPECT_EQ(client.line(), "bytes");
  for (int i = 0; i < 100; ++i) {
    client.send("no line, and too long");
    ASSERT_EQ(client.bytes(21), "no line, and too long");
  }
}

TEST_F(ServerTest, SlowReader_LosesRecords) {
  settings.limits.queued_bytes = 1 << 20;
  start();
  RawClient client = connect();
  // 500 times 100 kB exceed the queue and the system's buffers of both ends.
  client.send("records 500\n");
  std::size_t records = 0;
  std::string line = client.line();
  for (; line.starts_with('r'); line = client.line()) {
    EXPECT_EQ(line.size(), 99'999U);
    ++records;
  }
  EXPECT_EQ(line, "sent " + std::to_string(records));
  EXPECT_LT(records, 500U);
  EXPECT_GE(records, 10U);  // the queue's
  client.close();
  EXPECT_THAT(log.wait_for("closed"), HasSubstr(std::to_string(500 - records) + " records lost"));
}

TEST_F(ServerTest, UnreadAnswers_CloseConnection) {
  settings.limits.queued_bytes = 1 << 20;
  start();
  RawClient client = connect();
  client.send("flood 500\n");
  EXPECT_THAT(log.wait_for("closed"), HasSubstr("server/slow-reader"));
  EXPECT_LT(client.rest().size(), 500U * 100'001U);
  expect_alive();
}

TEST_F(ServerTest, SlowReader_RequestsHeldBack) {
  settings.limits.queued_bytes = 1 << 20;
  start();
  RawClient client = connect();
  std::string requests;
  for (int i = 0; i < 200; ++i) requests += "fill 400000\n";
  client.send(requests);
  // 80 MB, all of which arrive although they exceed every buffer.
  for (int i = 0; i < 200; ++i) ASSERT_EQ(client.line().size(), 400'000U) << i;
}

TEST_F(ServerTest, SingleAnswer_MayExceedQueue) {
  settings.limits.queued_bytes = 1 << 16;
  start();
  RawClient client = connect();
  client.send("fill 20000000\n");
  EXPECT_EQ(client.line().size(), 20'000'000U);
}

TEST_F(ServerTest, ClientThatReadsNothing_BlocksNobody) {
  start();
  RawClient stuck = connect();
  stuck.send("flood 100\n");
  RawClient other = connect();
  other.send("join\nread\n");
  EXPECT_EQ(other.line(), "joined");
  EXPECT_EQ(other.line(), "100 ms, 1");
}

TEST_F(ServerTest, RandomBytes_AnsweredOrClosedWithoutEffectOnOthers) {
  settings.limits.message_bytes = 4096;
  start();
  RawClient other = connect();
  std::string junk;
  for (int i = 0; i < 20'000; ++i) junk += static_cast<char>(i * 37 + i / 251);
  RawClient client = connect();
  client.send(junk);
  client.stop_sending();
  EXPECT_THAT(client.rest(), HasSubstr("what?"));
  RawClient killed = connect();
  killed.send("frames\n");
  killed.send(std::string("\0\0\1\0half", 8));
  killed.reset();
  other.send("echo 1\n");
  EXPECT_EQ(other.line(), "echo 1");
  other.close();
  wait_until_empty();
}

// When descriptors run out, new connections wait: none is lost, and the server does not spin.
TEST_F(ServerTest, NoDescriptors_WaitsForFreeOnes) {
  start();
  RawClient before = connect();
  before.send("echo 0\n");
  EXPECT_EQ(before.line(), "echo 0");
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlim_t usual = limit.rlim_cur;
  // The client's end takes the last descriptor.
  RawClient late(RawClient::Unconnected{});
  limit.rlim_cur = static_cast<rlim_t>(late.descriptor()) + 1;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  late.connect("127.0.0.1", hub->port());
  late.send("echo 2\n");
  EXPECT_THAT(log.wait_for("can be accepted"), Not(IsEmpty()));
  before.send("echo 1\n");
  EXPECT_EQ(before.line(), "echo 1");
  limit.rlim_cur = usual;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(late.line(), "echo 2");
}

TEST_F(ServerTest, ManyConnections_LeaveNothing) {
  settings.limits.connections = 300;
  start(make_host(R"({"time": "real"})"));
  expect_alive();
  wait_until_empty();
  const std::size_t files = RawClient::open_files();
  std::vector<std::thread> threads;
  std::atomic<int> answered{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 10; ++i) {
        std::vector<RawClient> clients;
        for (int c = 0; c < 25; ++c) {
          clients.push_back(connect());
          // Some send nothing, some half a message, some join, and all of them disconnect.
          if (c % 5 == 1) clients.back().send("ech");
          if (c % 5 == 2) clients.back().send("join\nread " + std::to_string(t) + '\n');
          if (c % 5 == 3) clients.back().send("fill 1000000\n");
          if (c % 5 != 4) continue;
          clients.back().send("echo 1\n");
          if (clients.back().line() == "echo 1") ++answered;
        }
        for (RawClient& client : clients) {
          if (i % 2 == 0) client.reset();
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(answered, 4 * 10 * 5);
  wait_until_empty();
  expect_alive();
  wait_until_empty();
  EXPECT_EQ(RawClient::open_files(), files);
}

// --- Tokens

RobotInfo robot(const std::string& name) {
  RobotInfo info;
  info.name = name;
  return info;
}

TEST(Access, NoTokens_AllowsEverything) {
  const Rights rights = Access({}, {robot("r1"), robot("r2")}).rights({});
  EXPECT_TRUE(rights.connect);
  EXPECT_TRUE(rights.watch);
  EXPECT_THAT(rights.command, ElementsAre(true, true));
  EXPECT_TRUE(rights.command_all());
}

TEST(Access, ServerToken_CoversRobotsWithoutToken) {
  AccessSettings settings;
  settings.server_token = "the server's";
  settings.robot_tokens = {{"r2", "the robot's"}};
  const Access access(settings, {robot("r1"), robot("r2")});

  const Rights nobody = access.rights({"another one", "the server'", "the server's "});
  EXPECT_FALSE(nobody.connect);
  EXPECT_FALSE(nobody.watch);
  EXPECT_THAT(nobody.command, ElementsAre(false, false));

  const Rights student = access.rights({"the server's"});
  EXPECT_TRUE(student.connect);
  EXPECT_TRUE(student.watch);
  EXPECT_THAT(student.command, ElementsAre(true, false));
  EXPECT_FALSE(student.command_all());

  const Rights holder = access.rights({"the robot's"});
  EXPECT_TRUE(holder.connect);
  EXPECT_THAT(holder.command, ElementsAre(false, true));

  EXPECT_TRUE(access.rights({"the robot's", "the server's"}).command_all());
}

TEST(Access, Watching_MayBeOpen) {
  AccessSettings settings;
  settings.server_token = "the server's";
  settings.open_watching = true;
  const Rights rights = Access(settings, {robot("r1")}).rights({});
  EXPECT_FALSE(rights.connect);
  EXPECT_TRUE(rights.watch);
  EXPECT_FALSE(rights.command_all());
}

TEST(Access, LongTokenList_NotReadToEnd) {
  AccessSettings settings;
  settings.server_token = "the server's";
  std::vector<std::string> tokens(1000, "a guess..");
  tokens.emplace_back("the server's");
  EXPECT_FALSE(Access(settings, {robot("r1")}).rights(tokens).connect);
}

TEST(Access, UnknownRobots_Error) {
  AccessSettings settings;
  settings.file = "tokens.json";
  settings.robot_tokens = {{"r1", "12345678"}, {"R2", "12345678"}};
  const auto issues = issues_of([&] { Access access(settings, {robot("r1"), robot("r2")}); });
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "access/unknown-robot");
  EXPECT_EQ(issues[0].file, "tokens.json");
  EXPECT_EQ(issues[0].pointer, "/robots/R2");
  EXPECT_THAT(issues[0].expected, HasSubstr("r1, r2"));
}

TEST(TokenFile, Read) {
  const TemporaryFolder folder;
  const AccessSettings settings = read_token_file(folder.write(
      "tokens.json",
      R"({"server": "12345678", /* mine */ "robots": {"r1": "abcd-efgh"}, "open_watching": true})"));
  EXPECT_EQ(settings.server_token, "12345678");
  EXPECT_THAT(settings.robot_tokens, ElementsAre(std::pair("r1", "abcd-efgh")));
  EXPECT_TRUE(settings.open_watching);
}

TEST(TokenFile, Faults_ReportedWithoutTokens) {
  const TemporaryFolder folder;
  const std::string file = folder.write("tokens.json", R"({"server": "short",
    "robots": {"r1": "with blank", "r2": 12345678}, "open_watching": 1, "sever": "x"})");
  const auto issues = issues_of([&] { static_cast<void>(read_token_file(file)); });
  std::set<std::pair<std::string, std::string>> found;
  for (const sim::ConfigIssue& issue : issues) {
    found.emplace(issue.id, issue.pointer);
    EXPECT_THAT(issue.message(), AllOf(Not(HasSubstr("\"short\"")), Not(HasSubstr("with blank"))));
  }
  EXPECT_THAT(
      found,
      ElementsAre(std::pair("access/token", "/robots/r1"), std::pair("access/token", "/robots/r2"),
                  std::pair("access/token", "/server"), std::pair("world/unknown-key", "/sever"),
                  std::pair("world/wrong-type", "/open_watching")));
  EXPECT_EQ(issues_of([&] { static_cast<void>(read_token_file(folder / "none.json")); })[0].id,
            "file/missing");
}

TEST(TokenFile, ShortTokens_WarnWithoutShowingThem) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "tokens.json",
      R"({"server": "1234567890abcdef", "robots": {"r1": "abcd-efgh", "r2": "fifteen-letters"}})");
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  Log log;
  static_cast<void>(read_token_file(file, log.hook()));
  EXPECT_THAT(log.lines(),
              ElementsAre(AllOf(HasSubstr("the robot r1 has 9 characters"),
                                HasSubstr("playpen token"), Not(HasSubstr("abcd-efgh"))),
                          HasSubstr("the robot r2 has 15 characters")));
}

TEST(TokenFile, GeneratedTokens_LongAndDistinct) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(make_token());
  EXPECT_THAT(tokens, SizeIs(100));
  for (const std::string& token : tokens) {
    EXPECT_THAT(token, SizeIs(32));
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

TEST(TokenGuards, WrongTokens_DelayLaterTries) {
  using std::chrono::milliseconds;
  TokenThrottle guard;
  auto now = TokenThrottle::Clock::now();
  int told = 0;
  milliseconds waited{0};
  for (int i = 1; i <= TokenThrottle::kMostOfAnAddress; ++i) {
    EXPECT_EQ(guard.delay_of_right("10.0.0.7:" + std::to_string(i), now), milliseconds(0));
    const TokenThrottle::Cost cost = guard.note_wrong("10.0.0.7:" + std::to_string(i), now);
    EXPECT_EQ(cost.count, i) << "whatever the connection";
    EXPECT_EQ(cost.delay,
              std::min(milliseconds(25) * (1 << std::min(i - 1, 10)), milliseconds(5000)));
    waited += cost.delay;
    told += cost.tell ? 1 : 0;
    now += milliseconds(1);
  }
  EXPECT_EQ(told, 6) << "1, 2, 4, 8, 16, 32";
  EXPECT_GT(waited, std::chrono::minutes(4)) << "for 60 guesses one after the other";
  EXPECT_EQ(guard.delay_of_right("10.0.0.7:99", now), milliseconds(5000));
  EXPECT_EQ(guard.note_wrong("10.0.0.7:98", now).delay, milliseconds(5000))
      << "so that the time does not tell right from wrong";
  EXPECT_EQ(guard.delay_of_right("10.0.0.8:99", now), milliseconds(0));
  EXPECT_EQ(guard.delay_of_right("[10.0.0.7::1]:99", now), milliseconds(0));
  now += TokenThrottle::kMemory;
  EXPECT_EQ(guard.delay_of_right("10.0.0.7:99", now), milliseconds(0));
  EXPECT_EQ(guard.note_wrong("10.0.0.7:99", now).count, 1);
}

TEST(TokenGuards, Addresses_Limited) {
  TokenThrottle guard;
  auto now = TokenThrottle::Clock::now();
  for (std::size_t i = 0; i <= TokenThrottle::kMostAddresses; ++i) {
    now += std::chrono::microseconds(1);
    static_cast<void>(guard.note_wrong(std::to_string(i) + ":1", now));
  }
  EXPECT_EQ(guard.note_wrong("1:1", now).count, 2);
  EXPECT_EQ(guard.note_wrong("0:1", now).count, 1) << "the oldest one has made room";
}

TEST(TokenFile, ReadableByOthers_Warns) {
  const TemporaryFolder folder;
  const std::string file = folder.write("tokens.json", R"({"server": "1234567890abcdef"})");
  Log log;
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  static_cast<void>(read_token_file(file, log.hook()));
  EXPECT_THAT(log.lines(), IsEmpty());
  std::filesystem::permissions(file, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  static_cast<void>(read_token_file(file, log.hook()));
  EXPECT_THAT(log.lines(), ElementsAre(AllOf(HasSubstr(file), HasSubstr("chmod 600"))));
}

}  // namespace
}  // namespace playerlike::server
