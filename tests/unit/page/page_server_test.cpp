// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The server of the live page, with clients that are plain sockets; the test acts as the host. All
// is done in one thread: whoever waits lets the server work.
#include "page_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "page_client.h"
#include "playerlike/page/protocol.h"

namespace playpen::page {
namespace {

using playerlike::page::HostKind;
using playerlike::page::PageKind;
using playerlike::page::PageMessage;
using std::chrono::milliseconds;
using test_support::PageClient;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kCommandToken = "aaaaaaaaaaaaaaaa";
constexpr const char* kWatchToken = "bbbbbbbbbbbbbbbb";

// The run's end of the connection.
class FakeHost {
 public:
  FakeHost() {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()) != 0) {
      throw std::runtime_error("socketpair failed");
    }
  }
  FakeHost(const FakeHost&) = delete;
  FakeHost& operator=(const FakeHost&) = delete;
  ~FakeHost() { leave(); }
  void leave() {
    if (ends_[0] >= 0) close(ends_[0]);
    ends_[0] = -1;
  }
  [[nodiscard]] int socket_for_page() const { return ends_[1]; }

  void send_bytes(const std::string& bytes, const std::function<void()>& pump) const {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count =
          send(ends_[0], bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) sent += static_cast<std::size_t>(count);
      if (count < 0 && errno != EAGAIN) throw std::runtime_error("the page process is gone");
      pump();
    }
  }

  // The next message, if it has come.
  std::optional<PageMessage> take() {
    std::array<char, 4096> some{};
    const ssize_t count = recv(ends_[0], some.data(), some.size(), MSG_DONTWAIT);
    if (count > 0) received_.append(some.data(), static_cast<std::size_t>(count));
    bool is_garbage = false;
    auto message = playerlike::page::take_page_message(received_, is_garbage);
    if (is_garbage) throw std::runtime_error("an invalid message");
    return message;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  std::string received_;
};

class PageServerTest : public testing::Test {
 protected:
  PageServerTest() {
    settings.port = 0;
    settings.command_token = kCommandToken;
    settings.watch_token = kWatchToken;
    settings.title_markup = "Playpen: a &lt; b";
    // No verdict by the wall clock: a test that is about one of these times sets it.
    limits.queued_time = limits.request_time = limits.answer_time = limits.greeting_time =
        limits.stalled_time = limits.idle_time = limits.whole_period = milliseconds(0);
    limits.closing_time = std::chrono::hours(1);
    limits.message_period = std::chrono::hours(1);
    limits.look_period = milliseconds(1);
  }

  void start() {
    server.emplace(settings, limits, host.socket_for_page(),
                   [this](const std::string& text) { told += text + '\n'; });
    EXPECT_EQ(await(PageKind::kReady).contents.substr(0, std::to_string(server->port()).size()),
              std::to_string(server->port()));
  }
  void pump() {
    while (server->poll()) {
    }
  }
  PageClient client() {
    return PageClient(server->port(), [this] { pump(); });
  }
  // A client whose greeting is answered.
  PageClient watcher(const std::string& greeting = "{}") {
    PageClient one = client();
    EXPECT_THAT(one.upgrade(), StartsWith("HTTP/1.1 101"));
    one.text(greeting);
    EXPECT_THAT(one.message().contents, HasSubstr("rights"));
    return one;
  }
  PageClient commander() { return watcher(R"({"token": "aaaaaaaaaaaaaaaa"})"); }

  void say(HostKind kind, const std::string& contents, std::uint32_t client = 0) {
    host.send_bytes(
        playerlike::page::header_bytes({.kind = static_cast<std::uint32_t>(kind),
                                        .client = client,
                                        .length = static_cast<std::uint32_t>(contents.size())}) +
            contents,
        [this] { pump(); });
    pump();
  }
  // The next message for the host.
  PageMessage next() {
    const auto end = std::chrono::steady_clock::now() + test_support::patience();
    for (;;) {
      pump();
      if (auto message = host.take()) return *message;
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("nothing for the host");
    }
  }
  PageMessage await(PageKind kind) {
    PageMessage message = next();
    EXPECT_EQ(message.kind, kind);
    return message;
  }
  // What has come for the host when the server has nothing left to do.
  std::vector<PageKind> all_for_host() {
    pump();
    std::vector<PageKind> kinds;
    while (const auto message = host.take()) kinds.push_back(message->kind);
    return kinds;
  }

  PageSettings settings;
  PageLimits limits;
  FakeHost host;
  std::string told;
  std::optional<PageServer> server;
};

// --- The page

TEST_F(PageServerTest, Page_ServedWithItsHeaders) {
  start();
  PageClient browser = client();
  browser.request("GET /", "Host: localhost:8080");
  const std::string answer = browser.rest();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
  for (const char* line :
       {"Content-Type: text/html; charset=utf-8", "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer", "Cache-Control: no-store",
        "Cross-Origin-Resource-Policy: same-origin", "Connection: close",
        "Content-Security-Policy: default-src 'none'; script-src 'sha256-"}) {
    EXPECT_THAT(answer, HasSubstr(std::string("\r\n") + line));
  }
  EXPECT_THAT(answer, HasSubstr("connect-src 'self' ws://localhost:8080 wss://localhost:8080; "
                                "frame-ancestors 'none'\r\n"));
  EXPECT_THAT(answer, HasSubstr("<title>Playpen: a &lt; b</title>"));
}

TEST_F(PageServerTest, Head_HeadersOnly) {
  start();
  PageClient browser = client();
  browser.request("HEAD /", "Host: localhost");
  EXPECT_THAT(browser.rest(), AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), Not(HasSubstr("<"))));
}

TEST_F(PageServerTest, OtherRequests_Refused) {
  start();
  const auto answer = [this](const std::string& first, const std::string& fields) {
    PageClient browser = client();
    browser.request(first, fields);
    return browser.rest();
  };
  EXPECT_THAT(answer("GET /", "Host: evil.com"), StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(answer("GET /", "Host: localhost\r\nOrigin: http://evil.com"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer("GET /x", "Host: localhost"), StartsWith("HTTP/1.1 404 "));
  EXPECT_THAT(answer("POST /", "Host: localhost\r\nContent-Length: 3\r\n\r\nabc"),
              StartsWith("HTTP/1.1 413 "));
  EXPECT_THAT(answer("PUT /", "Host: localhost"), StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(answer("GET /", "X: y"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answer("GET /live", "Host: localhost"), StartsWith("HTTP/1.1 426 "));
  EXPECT_THAT(answer("GET /", "Host: localhost\r\nX: " + std::string(9000, 'x')),
              StartsWith("HTTP/1.1 431 "));
  EXPECT_THAT(answer("\x16\x03\x01 garbage", ""), StartsWith("HTTP/1.1 400 "));
}

TEST_F(PageServerTest, FurtherName_Accepted) {
  settings.names = {"robots.lab"};
  start();
  PageClient browser = client();
  browser.request("GET /", "Host: robots.lab");
  EXPECT_THAT(browser.rest(), StartsWith("HTTP/1.1 200 "));
}

TEST_F(PageServerTest, RequestOfOtherOrigin_NoWebSocket) {
  start();
  PageClient browser = client();
  EXPECT_THAT(browser.upgrade("Host: localhost\r\nOrigin: http://evil.com"),
              StartsWith("HTTP/1.1 403 "));
  PageClient same = client();
  EXPECT_THAT(same.upgrade("Host: localhost:80\r\nOrigin: http://localhost:80"),
              StartsWith("HTTP/1.1 101 "));
}

// --- Rights

TEST_F(PageServerTest, NoToken_WatchesButCannotCommand) {
  start();
  PageClient one = client();
  one.upgrade();
  one.text("{}");
  EXPECT_EQ(one.message().contents, R"({"rights": {"command": false}})");
  one.text(R"({"pause": true})");
  EXPECT_THAT(one.message().contents, HasSubstr("commands need the token"));
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kWantWhole));
}

TEST_F(PageServerTest, WatchToken_CannotCommand) {
  start();
  PageClient one = watcher(R"({"token": "bbbbbbbbbbbbbbbb"})");
  one.text(R"({"pause": true})");
  EXPECT_THAT(one.message().contents, HasSubstr("refused"));
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kWantWhole));
}

TEST_F(PageServerTest, Commands_ForwardedWithClientNumber) {
  start();
  PageClient first = commander();
  PageClient second = commander();
  await(PageKind::kWantWhole);
  first.text(R"({"pause": true})");
  const PageMessage of_first = await(PageKind::kCommand);
  EXPECT_EQ(of_first.contents, R"({"pause": true})");
  second.text(R"({"pause": false})");
  const PageMessage of_second = await(PageKind::kCommand);
  EXPECT_NE(of_first.client, of_second.client);
  first.leave();
  EXPECT_EQ(await(PageKind::kGone).client, of_first.client);
}

TEST_F(PageServerTest, WrongToken_RefusedAndClosed) {
  start();
  PageClient one = client();
  one.upgrade();
  one.text(R"({"token": "aaaaaaaaaaaaaaab"})");
  EXPECT_EQ(one.message().contents, R"({"refused":"the token is wrong"})");
  EXPECT_EQ(one.close_code(), 1008);
  EXPECT_TRUE(all_for_host().empty());
  EXPECT_THAT(told, AllOf(HasSubstr("a wrong token"), Not(HasSubstr("aaaa"))));
}

TEST_F(PageServerTest, OtherAddressThanLoopback_NeedsToken) {
  settings.bind = "0.0.0.0";
  start();
  PageClient one = client();
  one.upgrade();
  one.text("{}");
  EXPECT_THAT(one.message().contents, HasSubstr("watching needs a token"));
  EXPECT_EQ(one.close_code(), 1008);
  PageClient two = watcher(R"({"token": "bbbbbbbbbbbbbbbb"})");
}

TEST_F(PageServerTest, OtherAddressButOpen_NeedsNoToken) {
  settings.bind = "0.0.0.0";
  settings.open = true;
  start();
  PageClient one = watcher();
}

TEST_F(PageServerTest, OtherFirstMessage_Closed) {
  start();
  PageClient one = client();
  one.upgrade();
  one.text(R"({"pause": true})");
  EXPECT_THAT(one.message().contents, HasSubstr("refused"));
  EXPECT_EQ(one.close_code(), 1008);
}

// --- Wholes and parts

TEST_F(PageServerTest, Joining_WholeAndThenParts) {
  start();
  PageClient one = watcher();
  await(PageKind::kWantWhole);
  say(HostKind::kPart, "p1");  // before the whole
  await(PageKind::kTaken);
  say(HostKind::kWhole, "w1");
  PageClient two = watcher();
  await(PageKind::kWantWhole);
  say(HostKind::kPart, "p2");
  say(HostKind::kWhole, "w2");
  say(HostKind::kPart, "p3");
  for (const char* expected : {"w1", "p2", "p3"}) {
    const PageClient::Message message = one.message();
    EXPECT_EQ(message.contents, expected);
    EXPECT_EQ(message.kind, 2);
  }
  EXPECT_EQ(two.message().contents, "w2");
  EXPECT_EQ(two.message().contents, "p3");
}

TEST_F(PageServerTest, Anew_WholeForAll) {
  start();
  PageClient one = watcher();
  say(HostKind::kWhole, "w1");
  PageClient two = watcher();
  say(HostKind::kAnew, "w2");
  EXPECT_EQ(one.message().contents, "w1");
  EXPECT_EQ(one.message().contents, "w2");
  EXPECT_EQ(two.message().contents, "w2");
}

TEST_F(PageServerTest, NobodyWatches_PartNotTakenUntilSomebodyDoes) {
  start();
  say(HostKind::kPart, "p1");
  EXPECT_TRUE(all_for_host().empty());
  PageClient one = watcher();
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kTaken, PageKind::kWantWhole));
}

TEST_F(PageServerTest, ManyJoinAtOnce_OneWholeAskedFor) {
  start();
  PageClient one = watcher();
  PageClient two = watcher();
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kWantWhole));
  say(HostKind::kWhole, "w");
  EXPECT_EQ(one.message().contents, "w");
  EXPECT_EQ(two.message().contents, "w");
  EXPECT_TRUE(all_for_host().empty());
}

TEST_F(PageServerTest, WholesTooOften_AskedForLater) {
  limits.whole_period = std::chrono::hours(1);
  start();
  PageClient one = watcher();
  say(HostKind::kWhole, "w");
  PageClient two = watcher();
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kWantWhole));
}

TEST_F(PageServerTest, Answer_ForItsClientOnly) {
  start();
  PageClient one = commander();
  PageClient two = commander();
  await(PageKind::kWantWhole);
  two.text(R"({"speed": 2})");
  const std::uint32_t number = await(PageKind::kCommand).client;
  say(HostKind::kAnswer, R"({"refused": "no"})", number);
  say(HostKind::kAnswer, R"({"refused": "nobody"})", 4711);
  say(HostKind::kWhole, "w");
  const PageClient::Message answer = two.message();
  EXPECT_EQ(answer.contents, R"({"refused": "no"})");
  EXPECT_EQ(answer.kind, 1);
  EXPECT_EQ(one.message().contents, "w");
}

TEST_F(PageServerTest, LargeWhole_ArrivesAsOneMessage) {
  start();
  PageClient one = watcher();
  std::string whole(1'000'000, 'w');
  whole.back() = 'x';
  say(HostKind::kWhole, whole);
  EXPECT_TRUE(one.message().contents == whole);
}

// --- Slow clients

TEST_F(PageServerTest, SlowClient_SkipsPartsAndOthersGetAll) {
  limits.queued_bytes = 1000;
  start();
  PageClient fast = watcher();
  PageClient slow = watcher();
  await(PageKind::kWantWhole);
  // More than the kernel keeps for the one that does not read.
  const std::string whole(20'000'000, 'w');
  say(HostKind::kWhole, whole);
  EXPECT_EQ(fast.message().contents.size(), whole.size());
  for (int i = 0; i < 20; ++i) {
    say(HostKind::kPart, std::string(100, 'p') + std::to_string(i));
    await(PageKind::kTaken);
    EXPECT_EQ(fast.message().contents, std::string(100, 'p') + std::to_string(i));
  }
  EXPECT_EQ(slow.message().contents.size(), whole.size());
  await(PageKind::kWantWhole);
  say(HostKind::kWhole, "again");
  say(HostKind::kPart, "next");
  EXPECT_EQ(slow.message().contents, "again");
  EXPECT_EQ(slow.message().contents, "next");
  EXPECT_EQ(fast.message().contents, "next");
}

TEST_F(PageServerTest, ClientThatTakesNothing_Dropped) {
  limits.stalled_time = milliseconds(20);
  start();
  PageClient stalled = commander();
  await(PageKind::kWantWhole);
  stalled.text(R"({"pause": true})");
  await(PageKind::kCommand);
  say(HostKind::kWhole, std::string(20'000'000, 'w'));
  await(PageKind::kGone);
}

TEST_F(PageServerTest, AsksAndNeverReads_Dropped) {
  limits.queued_bytes = 10'000;
  limits.messages = std::numeric_limits<int>::max();
  start();
  PageClient one = commander();
  one.text("{}");
  await(PageKind::kWantWhole);
  const std::uint32_t number = await(PageKind::kCommand).client;
  const std::string answer(5000, 'a');
  bool is_gone = false;
  for (int i = 0; i < 100'000 && !is_gone; ++i) {
    say(HostKind::kAnswer, answer, number);
    const auto message = host.take();
    is_gone = message && message->kind == PageKind::kGone;
  }
  EXPECT_TRUE(is_gone);
}

TEST_F(PageServerTest, HostTakesNoCommands_ClientRefused) {
  limits.host_bytes = 1000;
  limits.messages = std::numeric_limits<int>::max();
  start();
  PageClient one = commander();
  // The kernel keeps some for the host, which reads nothing.
  const std::string command = "{}" + std::string(1000, ' ');
  bool is_refused = false;
  for (int i = 0; i < 10'000 && !is_refused; ++i) {
    one.text(command);
    pump();
    is_refused = one.has_received();
  }
  EXPECT_THAT(one.message().contents, HasSubstr("takes no commands at the moment"));
}

// --- Messages against the rules

TEST_F(PageServerTest, TooLongMessage_TooBigCode) {
  start();
  PageClient one = commander();
  one.text(std::string(1025, ' '));
  EXPECT_EQ(one.close_code(), 1009);
}

TEST_F(PageServerTest, TooLongInFragments_TooBigCode) {
  start();
  PageClient one = commander();
  one.frame(0x01, std::string(1000, ' '));
  one.frame(0x00, std::string(1000, ' '));
  EXPECT_EQ(one.close_code(), 1009);
}

TEST_F(PageServerTest, LongestMessage_Forwarded) {
  start();
  PageClient one = commander();
  await(PageKind::kWantWhole);
  const std::string command = "{}" + std::string(1022, ' ');
  one.text(command);
  EXPECT_EQ(await(PageKind::kCommand).contents, command);
}

TEST_F(PageServerTest, TooManyMessages_RefusedOnceAndClosed) {
  limits.messages = 4;  // the greeting is one of them
  start();
  PageClient one = commander();
  await(PageKind::kWantWhole);
  for (int i = 0; i < 10; ++i) one.text(R"({"pause": true})");
  EXPECT_THAT(one.message().contents, HasSubstr("more than 4 messages a second"));
  EXPECT_EQ(one.close_code(), 1008);
  EXPECT_THAT(all_for_host(), testing::ElementsAre(PageKind::kCommand, PageKind::kCommand,
                                                   PageKind::kCommand, PageKind::kGone));
}

TEST_F(PageServerTest, TooManyPings_Dropped) {
  limits.messages = 4;
  start();
  PageClient one = watcher();
  for (int i = 0; i < 10; ++i) one.frame(0x89, "");
  while (one.receive()) {
  }
}

TEST_F(PageServerTest, NoJson_Closed) {
  start();
  PageClient one = commander();
  await(PageKind::kWantWhole);
  one.text("pause");
  EXPECT_THAT(one.message().contents, HasSubstr("commands are JSON objects"));
  EXPECT_EQ(one.close_code(), 1007);
  EXPECT_TRUE(all_for_host().empty());
}

TEST_F(PageServerTest, DeeplyNestedJson_Harmless) {
  start();
  PageClient one = commander();
  one.text(R"({"a":)" + std::string(1000, '['));
  EXPECT_THAT(one.message().contents, HasSubstr("refused"));
}

TEST_F(PageServerTest, BrokenFrames_ClosedWithTheirCodes) {
  start();
  const auto code = [this](int first_byte, const std::string& contents, bool masked) {
    PageClient one = commander();
    one.frame(first_byte, contents, masked);
    return one.close_code();
  };
  EXPECT_EQ(code(0x81, "{}", false), 1002);                  // without a mask
  EXPECT_EQ(code(0xC1, "{}", true), 1002);                   // a reserved bit
  EXPECT_EQ(code(0x83, "{}", true), 1002);                   // an unknown kind
  EXPECT_EQ(code(0x80, "{}", true), 1002);                   // continues nothing
  EXPECT_EQ(code(0x09, "", true), 1002);                     // a ping in fragments
  EXPECT_EQ(code(0x89, std::string(126, 'p'), true), 1002);  // a long ping
  EXPECT_EQ(code(0x81, "{\"\xff\": 1}", true), 1007);        // no UTF-8
  EXPECT_EQ(code(0x82, "{}", true), 1003);                   // binary
}

TEST_F(PageServerTest, FragmentsAndPings_PutTogether) {
  start();
  PageClient one = commander();
  await(PageKind::kWantWhole);
  one.frame(0x01, R"({"pau)");
  one.frame(0x89, "are you there?");
  one.frame(0x80, R"(se": true})");
  EXPECT_EQ(await(PageKind::kCommand).contents, R"({"pause": true})");
  const PageClient::Message pong = one.message();
  EXPECT_EQ(pong.kind, 10);
  EXPECT_EQ(pong.contents, "are you there?");
}

TEST_F(PageServerTest, Close_Answered) {
  start();
  PageClient one = watcher();
  one.frame(0x88, "\x03\xe8");
  EXPECT_EQ(one.close_code(), 1000);
  while (one.receive()) {
  }
}

TEST_F(PageServerTest, BytesAfterUpgradeRequest_Refused) {
  start();
  PageClient one = client();
  one.request("GET /live",
              "Host: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\nxx");
  EXPECT_THAT(one.rest(), StartsWith("HTTP/1.1 413 "));
}

// --- Limits of connections and time

TEST_F(PageServerTest, TooManyConnections_NoMoreServed) {
  limits.connections = 2;
  start();
  PageClient one = watcher();
  PageClient two = watcher();
  PageClient three = client();
  three.request("GET /", "Host: localhost");
  EXPECT_THAT(three.rest(), StartsWith("HTTP/1.1 503 "));
  one.leave();
  pump();
  PageClient four = watcher();
}

TEST_F(PageServerTest, TooManyStrangers_RefusedButWatchersStay) {
  limits.strangers = 2;
  start();
  PageClient friendly = watcher();
  PageClient silent = client();
  PageClient greets_nobody = client();
  EXPECT_THAT(greets_nobody.upgrade(), StartsWith("HTTP/1.1 101"));
  PageClient third = client();
  third.request("GET /", "Host: localhost");
  EXPECT_THAT(third.rest(), StartsWith("HTTP/1.1 503 "));
  say(HostKind::kWhole, "w");
  EXPECT_EQ(friendly.message().contents, "w");
}

TEST_F(PageServerTest, FarTooManyConnections_ClosedWithoutAnswer) {
  limits.strangers = 1;
  limits.refused_connections = 1;
  start();
  PageClient one = client();
  pump();
  PageClient two = client();
  pump();
  PageClient three = client();
  EXPECT_EQ(three.rest(), "");
}

TEST_F(PageServerTest, SlowRequest_Closed) {
  limits.request_time = milliseconds(20);
  start();
  PageClient one = client();
  one.send("GET / HTTP/1.1\r\n");
  EXPECT_EQ(one.rest(), "");
}

TEST_F(PageServerTest, NoGreeting_Closed) {
  limits.greeting_time = milliseconds(20);
  start();
  PageClient one = client();
  EXPECT_THAT(one.upgrade(), StartsWith("HTTP/1.1 101"));
  while (one.receive()) {
  }
}

TEST_F(PageServerTest, SilentClient_PingedAndDropped) {
  limits.idle_time = milliseconds(50);
  start();
  PageClient one = watcher();
  const PageClient::Message ping = one.message();
  EXPECT_EQ(ping.kind, 9);
  while (one.receive()) {
  }
}

// --- The end, and the beginning

TEST_F(PageServerTest, EndOfRun_ToldAndClosed) {
  start();
  PageClient one = watcher();
  PageClient stranger = client();
  stranger.upgrade();
  PageClient requests = client();
  say(HostKind::kWhole, "w");
  say(HostKind::kPart, "last");
  host.leave();
  EXPECT_EQ(one.message().contents, "w");
  EXPECT_EQ(one.message().contents, "last");
  EXPECT_EQ(one.message().contents, R"({"over": true})");
  const PageClient::Message end = one.message();
  EXPECT_EQ(end.close_code(), 1001);
  one.frame(0x88, "\x03\xe9");
  EXPECT_EQ(stranger.close_code(), 1001);
  stranger.frame(0x88, "\x03\xe9");
  EXPECT_EQ(requests.rest(), "");
  one.leave();
  stranger.leave();
  server->run();  // ends
}

TEST_F(PageServerTest, EndOfRunAndSilentClient_EndsAllTheSame) {
  limits.closing_time = milliseconds(20);
  start();
  PageClient one = watcher();
  say(HostKind::kWhole, std::string(20'000'000, 'w'));
  host.leave();
  server->run();  // ends
}

TEST_F(PageServerTest, InvalidMessageOfHost_Ends) {
  start();
  host.send_bytes(std::string(16, 'x'), [this] { pump(); });
  server->run();  // ends
}

TEST_F(PageServerTest, PortTaken_NextOneOrError) {
  start();
  FakeHost other;
  PageSettings second = settings;
  second.port = server->port();
  second.ports = 100;
  const PageServer next(second, limits, other.socket_for_page(), {});
  EXPECT_NE(next.port(), server->port());
  FakeHost third;
  second.ports = 1;
  try {
    const PageServer none(second, limits, third.socket_for_page(), {});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--page-port: expected a free TCP port, found " +
                                              std::to_string(server->port()) + ", taken"),
                                    HasSubstr("[server/port-taken]")));
  }
}

TEST_F(PageServerTest, BadAddress_Error) {
  for (const char* bind : {"no such name", "192.0.2.7", "::g"}) {
    FakeHost other;
    settings.bind = bind;
    try {
      const PageServer none(settings, limits, other.socket_for_page(), {});
      ADD_FAILURE() << "no error: " << bind;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("--page-bind: expected "), HasSubstr(bind),
                                      HasSubstr("[server/address]")));
    }
  }
}

}  // namespace
}  // namespace playpen::page
