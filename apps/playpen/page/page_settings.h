// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The live page: a web server for the pages of a run, see docs/page.md and
/// docs/decisions/page.md.
namespace playpen::page {

/// What the page process is told by the command that starts it.
struct PageSettings {
  std::string bind = "127.0.0.1";  ///< an IPv4 or IPv6 address, or a name of this machine
  int port = 8080;                 ///< 0: any free one
  int ports = 1;                   ///< number of ports from `port` on that are tried, >= 1
  /// Names of this machine by which browsers may ask for the page, beside its host name.
  std::vector<std::string> names;
  bool open = false;  ///< watching needs no token, also on an address other than loopback
  std::string command_token;
  std::string watch_token;
  std::string title_markup;  ///< the page's title as HTML, so with character references
};

/// Limits of the page process. A client that exceeds one is refused or closed; others are not
/// affected. A time of 0: no limit.
struct PageLimits {
  using Time = std::chrono::milliseconds;
  std::size_t connections = 64;  ///< at once
  std::size_t strangers = 16;    ///< of these, such that have not yet been let in
  /// Further connections that get the answer 503. Beyond, they are closed without an answer.
  std::size_t refused_connections = 16;
  std::size_t header_bytes = 8192;       ///< of an HTTP request
  std::size_t message_bytes = 1024;      ///< of a client's message
  int messages = 60;                     ///< of a client in `message_period`
  Time message_period{1000};             ///< > 0
  std::size_t queued_bytes = 4U << 20U;  ///< that wait for a client
  Time queued_time{2000};                ///< that a part may wait for a client
  std::size_t host_bytes = 1U << 20U;    ///< that wait for the host
  Time request_time{5000};               ///< for an HTTP request
  Time answer_time{30'000};              ///< for its answer
  Time greeting_time{5000};              ///< for a client's first message
  Time stalled_time{10'000};             ///< in which a client takes nothing of a message
  Time idle_time{30'000};                ///< in which a client answers no ping
  Time whole_period{250};                ///< between two wholes that the host is asked for
  Time closing_time{1000};               ///< for the end of a connection
  Time look_period{100};                 ///< between two looks at these times, > 0
};

/// The settings as one line of JSON with a line break.
/// @pre all texts are valid UTF-8.
[[nodiscard]] std::string to_line(const PageSettings& settings);

/// The settings of such a line.
/// @throws std::runtime_error if it is no such line.
[[nodiscard]] PageSettings settings_of_line(std::string_view line);

}  // namespace playpen::page
