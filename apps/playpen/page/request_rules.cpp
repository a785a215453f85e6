// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "request_rules.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

namespace playpen::page {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

bool is_address(int family, std::string_view text) {
  std::array<unsigned char, 16> address{};
  return inet_pton(family, std::string(text).c_str(), address.data()) == 1;
}

bool is_port(std::string_view text) {
  constexpr std::size_t kMostDigits = 5;
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Cuts a port off. @return whether what follows the name is a port or nothing.
bool cut_port(std::string_view& host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') : host.find(':');
  if (end == std::string_view::npos) return !host.starts_with('[');
  const std::size_t colon = host[end] == ']' ? end + 1 : end;
  if (colon == host.size()) return true;
  if (host[colon] != ':' || !is_port(host.substr(colon + 1))) return false;
  host = host.substr(0, colon);
  return true;
}

// "http://robots.lab:8080" of Host "robots.lab:8080", also behind a proxy that adds TLS.
bool is_origin_of(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) return equal_words(origin.substr(scheme.size()), host);
  }
  return false;
}

}  // namespace

bool is_own_host(std::string_view host, const std::vector<std::string>& names) {
  // inet_pton() ends at a zero byte.
  if (host.find('\0') != std::string_view::npos || !cut_port(host) || host.empty()) return false;
  if (host.front() == '[') return is_address(AF_INET6, host.substr(1, host.size() - 2));
  return is_address(AF_INET, host) || equal_words(host, "localhost") ||
         std::any_of(names.begin(), names.end(),
                     [host](const std::string& name) { return equal_words(host, name); });
}

Verdict judge(const RequestParts& request, const std::vector<std::string>& names) {
  if (request.hosts.size() != 1 || request.origins.size() > 1) {
    return {400, "The request has no field Host, or two of a kind."};
  }
  if (!is_own_host(request.hosts.front(), names)) {
    return {421,
            "This page is not offered under the name in your browser's address line. If the name "
            "belongs to this machine, start playpen with --page-name NAME."};
  }
  if (!request.origins.empty() && !is_origin_of(request.origins.front(), request.hosts.front())) {
    return {403, "Another site may not use this page."};
  }
  if (request.has_body) return {413, "Requests have no body here."};
  if (request.target != "/" && request.target != "/live") {
    return {404, "There is only / here, the page of the run."};
  }
  if (request.target == "/") {
    if (request.method == "GET" || request.method == "HEAD") return {200};
    return {405, "Only GET and HEAD are possible."};
  }
  if (request.method != "GET") return {405, "Only GET is possible."};
  if (!request.is_upgrade) return {426, "Only a WebSocket is here."};
  return {101};
}

}  // namespace playpen::page
