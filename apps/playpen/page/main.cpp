// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// playpen-page: serves the page of `playpen run --page` and `playpen serve --page`, which start
// this program. Its standard input is a socket: a line of settings arrives there (page_settings.h),
// then the messages of the run's host (playerlike/page/protocol.h). playpen-page --version: says
// that it can be started.
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "page_server.h"

namespace {

constexpr int kSocket = STDIN_FILENO;

/// Ends this process, by SIGALRM, if the run does not end soon.
void end_soon(int) {
  constexpr unsigned kEndOfRun_s = 3;
  alarm(kEndOfRun_s);
}

/// Reads the first line of the socket and nothing after it.
std::string first_line() {
  constexpr std::size_t kMostBytes = 65536;
  std::string line;
  while (line.size() < kMostBytes) {
    char c = 0;
    const ssize_t count = recv(kSocket, &c, 1, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    if (c == '\n') return line;
    line += c;
  }
  throw std::runtime_error("the settings are missing");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--version") {
    std::cout << "playpen-page " << PLAYPEN_VERSION << '\n';
    return 0;
  }
  sockaddr address{};
  socklen_t length = sizeof address;
  if (argc != 1 || getsockname(kSocket, &address, &length) != 0) {
    std::cerr << "playpen-page is started by 'playpen run --page' and 'playpen serve --page'\n";
    return 2;
  }
  // Ctrl-C in a terminal reaches all processes of the run; this one ends when the run has ended,
  // and tells the browsers. Other signals may have been sent to it alone.
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, end_soon);
  signal(SIGHUP, end_soon);
  signal(SIGPIPE, SIG_IGN);
  try {
    const playpen::page::PageSettings settings = playpen::page::settings_of_line(first_line());
    playpen::page::PageServer server(
        settings, {}, fcntl(kSocket, F_DUPFD_CLOEXEC, 3),
        [](const std::string& text) { std::cerr << "playpen-page: " << text << '\n'; });
    close(kSocket);
    server.run();
  } catch (const std::exception& error) {
    // For the command, which waits for the first message and shows this one.
    const std::string text = error.what();
    [[maybe_unused]] const ssize_t sent = send(kSocket, text.data(), text.size(), MSG_NOSIGNAL);
    return 1;
  }
  return 0;
}
