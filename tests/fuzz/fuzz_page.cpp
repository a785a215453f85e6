// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Bytes of a browser for the server of the live page: a request, or frames of a WebSocket. The
// first byte says what comes before them and how they are cut; see Plan.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "page_server.h"
#include "playerlike/page/protocol.h"

namespace {

using playerlike::page::HostKind;
using playerlike::page::PageKind;

constexpr const char* kUpgrade =
    "GET /live HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
// Texts with the mask 0.
const std::string kWatch = std::string("\x81\x9d\0\0\0\0", 6) + R"({"token": "watch-0123456789"})";
const std::string kCommand =
    std::string("\x81\x9f\0\0\0\0", 6) + R"({"token": "command-0123456789"})";

/// What the first byte of an input says.
struct Plan {
  bool upgrades = false;
  bool watches = false;
  bool commands = false;
  bool host_speaks = false;  ///< it sends wholes, parts and answers in between
  std::size_t cut = 0;       ///< bytes that are sent at once

  explicit Plan(std::uint8_t byte)
      : upgrades((byte & 3U) != 0),
        watches((byte & 3U) == 2),
        commands((byte & 3U) == 3),
        host_speaks((byte & 4U) != 0),
        cut(std::array<std::size_t, 4>{1, 7, 125, std::string::npos}[(byte >> 3U) & 3U]) {}
};

struct Pair {
  std::array<int, 2> ends{-1, -1};
  Pair() {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) std::abort();
  }
  void send(std::string_view bytes) const {
    static_cast<void>(::send(ends[0], bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  [[nodiscard]] std::string receive() const {
    std::string all;
    std::array<char, 65536> some{};
    for (;;) {
      const ssize_t count = recv(ends[0], some.data(), some.size(), MSG_DONTWAIT);
      if (count <= 0) return all;
      all.append(some.data(), static_cast<std::size_t>(count));
    }
  }
};

void say(const Pair& host, HostKind kind, std::uint32_t client, const std::string& contents) {
  host.send(
      playerlike::page::header_bytes({.kind = static_cast<std::uint32_t>(kind),
                                      .client = client,
                                      .length = static_cast<std::uint32_t>(contents.size())}) +
      contents);
}

void work(playpen::page::PageServer& server) {
  while (server.poll()) {
  }
}

/// What the host gets is always in order, and commands come from those who may command.
void check(std::string received, const Plan& plan) {
  bool is_garbage = false;
  while (const auto message = playerlike::page::take_page_message(received, is_garbage)) {
    if (message->kind != PageKind::kCommand) continue;
    if (!plan.commands || message->client != 1 || message->contents.size() > 1024 ||
        message->contents.find('{') == std::string::npos) {
      std::abort();
    }
  }
  if (is_garbage || !received.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Plan plan(data[0]);
  std::string_view rest(reinterpret_cast<const char*>(data + 1), size - 1);
  playpen::page::PageSettings settings;
  settings.port = 0;
  settings.command_token = "command-0123456789";
  settings.watch_token = "watch-0123456789";
  playpen::page::PageLimits limits;
  limits.look_period = std::chrono::hours(1);
  limits.message_period = std::chrono::hours(1);
  limits.whole_period = std::chrono::milliseconds(0);
  const Pair host;
  const Pair browser;
  {
    playpen::page::PageServer server(settings, limits, host.ends[1], {});
    server.adopt(browser.ends[1]);
    if (plan.upgrades) browser.send(kUpgrade);
    work(server);  // who speaks before the answer is refused
    if (plan.watches) browser.send(kWatch);
    if (plan.commands) browser.send(kCommand);
    while (!rest.empty()) {
      browser.send(rest.substr(0, plan.cut));
      rest.remove_prefix(std::min(plan.cut, rest.size()));
      work(server);
      static_cast<void>(browser.receive());
      if (!plan.host_speaks) continue;
      say(host, HostKind::kPart, 0, "part");
      say(host, HostKind::kWhole, 0, std::string(300, 'w'));
      say(host, HostKind::kAnswer, 1, "{}");
    }
    shutdown(browser.ends[0], SHUT_WR);
    work(server);
    shutdown(host.ends[0], SHUT_WR);
    work(server);
    check(host.receive(), plan);
  }
  close(host.ends[0]);
  close(browser.ends[0]);
  return 0;
}
