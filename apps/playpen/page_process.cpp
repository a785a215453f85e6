// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "page_process.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "grade/text.h"
#include "page_settings.h"
#include "playerlike/page/protocol.h"
#include "playerlike/server/server_settings.h"
#include "sim/core/utf8.h"

namespace playpen {
namespace {

namespace wire = playerlike::page;

constexpr std::chrono::seconds kPageLimit{30};
constexpr int kUsualPort = 8080;
// How many ports from the usual one on are tried, so that several runs can have their pages.
constexpr int kUsualPorts = 100;

std::runtime_error no_page(const std::string& reason) {
  return std::runtime_error("--page cannot offer the page: " + reason);
}

/// The name of this machine in links.
std::string name_for_links(const PageRequest& request) {
  if (!request.names.empty()) return request.names.front();
  std::array<char, 256> name{};
  const bool is_any = request.bind == "0.0.0.0" || request.bind == "::";
  if (is_any && gethostname(name.data(), name.size() - 1) == 0) return name.data();
  return request.bind.find(':') == std::string::npos ? request.bind : '[' + request.bind + ']';
}

/// All that comes until the process closes its end.
std::string last_words(int socket) {
  std::string text;
  std::array<char, 1024> some{};
  for (;;) {
    const ssize_t count = recv(socket, some.data(), some.size(), 0);
    if (count <= 0) return text;
    text.append(some.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

PageProcess::PageProcess(const PageRequest& request, const std::string& title,
                         const sim::LogHook& log)
    : request_(request) {
  playerlike::PageTokens tokens;
  if (!request.token_file.empty()) tokens = playerlike::read_page_tokens(request.token_file, log);
  command_token_ = tokens.command.empty() ? playerlike::make_token() : tokens.command;
  watch_token_ = tokens.watch.empty() ? playerlike::make_token() : tokens.watch;
  page::PageSettings settings;
  settings.bind = sim::escape_invalid_utf8(request.bind);
  settings.port = request.port.value_or(kUsualPort);
  settings.ports = request.port ? 1 : kUsualPorts;
  settings.names = request.names;
  settings.open = request.open;
  settings.command_token = command_token_;
  settings.watch_token = watch_token_;
  settings.title_markup = grade::markup_escaped(sim::escape_invalid_utf8(title));
  const std::string line = page::to_line(settings);
  try {
    companion_.emplace("playpen-page", std::vector<std::string>());
  } catch (const std::runtime_error& error) {
    throw no_page(error.what());
  }
  // The tokens are not among its arguments, which other users could see.
  if (send(socket(), line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size())) {
    throw no_page("playpen-page has ended");
  }
  wait_until_ready();
}

// The process's first message names the port. It stays in the socket, for the host. If there is
// another text, it is the reason for its end.
void PageProcess::wait_until_ready() {
  const Companion::News news = companion_->wait(kPageLimit);
  if (news == Companion::News::kNothing) throw no_page("playpen-page does not answer");
  wire::Header header;
  constexpr std::size_t kMostContents = 7;  // "65535 1"
  std::array<char, sizeof header + kMostContents> first{};
  const ssize_t count = recv(socket(), first.data(), first.size(), MSG_PEEK);
  std::string received(first.data(), count < 0 ? 0 : static_cast<std::size_t>(count));
  bool is_garbage = false;
  const auto message = wire::take_page_message(received, is_garbage);
  if (message && message->kind == wire::PageKind::kReady) {
    const char* const end = message->contents.data() + message->contents.size();
    const auto [rest, error] = std::from_chars(message->contents.data(), end, port_);
    is_open_ = std::string_view(rest, end) == " 1";
    if (error == std::errc()) return;
  }
  const std::string reason = last_words(socket());
  throw no_page(reason.empty() ? "playpen-page has ended" : reason);
}

PageProcess::~PageProcess() {
  if (companion_ && companion_->has_ended()) {
    std::cerr << "playpen: playpen-page ended before the run, so the page was lost\n";
  }
}

std::string PageProcess::links() const {
  const std::string page = "http://" + name_for_links(request_) + ':' + std::to_string(port_) + '/';
  return "page: " + page + (is_open_ ? "" : "#token=" + watch_token_) + "\ncommands: " + page +
         "#token=" + command_token_;
}

}  // namespace playpen
