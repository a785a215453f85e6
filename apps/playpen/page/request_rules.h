// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace playpen::page {

/// The parts of an HTTP request on which the answer depends.
struct RequestParts {
  std::string_view method;
  std::string_view target;
  std::vector<std::string_view> hosts;    ///< the values of all Host fields
  std::vector<std::string_view> origins;  ///< the values of all Origin fields
  bool has_body = false;
  bool is_upgrade = false;  ///< to a WebSocket
};

/// The kind of answer to a request.
struct Verdict {
  int status = 200;      ///< of HTTP; 200: the page; 101: the WebSocket; else `reason`
  std::string reason{};  ///< for the user who sees it in the browser, one line of ASCII
};

/// Decides on a request, before anything of it has an effect.
///
/// A browser lets any site send requests to this server. The field Host is the name in the
/// address that the browser shows: a site whose name suddenly means this machine (DNS rebinding)
/// has its own name there. Origin is the site whose script opens a WebSocket; only the page itself
/// may do that.
/// @param names  by which this machine may be called, beside IP addresses and localhost.
[[nodiscard]] Verdict judge(const RequestParts& request, const std::vector<std::string>& names);

/// Whether a value of the field Host, such as "127.0.0.1:8080", "[::1]" or "robots.lab:80", names
/// this machine: its name is an IP address, localhost or one of the names, in any case of letters.
[[nodiscard]] bool is_own_host(std::string_view host, const std::vector<std::string>& names);

}  // namespace playpen::page
