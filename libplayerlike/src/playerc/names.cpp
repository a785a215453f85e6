// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "libplayerinterface/addr_util.h"
#include "libplayerinterface/interface_util.h"
#include "proxies/link.h"

namespace {

constexpr const char* kUnknown = "unknown";
constexpr std::uint16_t kNoInterface = 0xFFFF;
constexpr std::uint8_t kNoMessageType = 0xFF;
// Indexed by code, from PLAYER_MSGTYPE_DATA on.
constexpr std::array<const char*, 6> kMessageTypes{"data",     "command", "request",
                                                   "resp_ack", "sync",    "resp_nack"};

int fill(player_interface_t* interf, int code) {
  const char* name = PlayerCc::interface_name(code);
  if (interf == nullptr || name == nullptr) return -1;
  // The field of Player's struct is not const, but programs must not write through it.
  *interf = {static_cast<std::uint16_t>(code), const_cast<char*>(name)};
  return 0;
}

}  // namespace

int itable_init() { return 0; }

void itable_destroy() {}

int lookup_interface(const char* name, player_interface_t* interf) {
  const std::uint16_t code = str_to_interf(name);
  return code == kNoInterface ? -1 : fill(interf, code);
}

int lookup_interface_code(int code, player_interface_t* interf) { return fill(interf, code); }

const char* lookup_interface_name(unsigned int startpos, int code) {
  if (code < 0 || static_cast<unsigned int>(code) < startpos) return nullptr;
  return PlayerCc::interface_name(code);
}

const char* interf_to_str(uint16_t code) {
  const char* name = PlayerCc::interface_name(code);
  return name == nullptr ? kUnknown : name;
}

uint16_t str_to_interf(const char* name) {
  if (name == nullptr) return kNoInterface;
  const std::optional<int> code = PlayerCc::interface_code(name);
  return code ? static_cast<std::uint16_t>(*code) : kNoInterface;
}

const char* msgtype_to_str(uint8_t code) {
  return code >= 1 && code <= kMessageTypes.size() ? kMessageTypes[code - 1U] : kUnknown;
}

uint8_t str_to_msgtype(const char* name) {
  for (std::size_t i = 0; name != nullptr && i < kMessageTypes.size(); ++i) {
    if (std::string_view(name) == kMessageTypes[i]) return static_cast<std::uint8_t>(i + 1);
  }
  return kNoMessageType;
}

void packedaddr_to_dottedip(char* dest, size_t len, uint32_t addr) {
  if (dest == nullptr || len == 0) return;
  std::array<char, INET_ADDRSTRLEN> text{};
  const in_addr address{addr};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  std::strncpy(dest, text.data(), len - 1);
  dest[len - 1] = '\0';
}

int hostname_to_packedaddr(uint32_t* dest, const char* hostname) {
  if (dest == nullptr || hostname == nullptr) return -1;
  addrinfo hints{};
  hints.ai_family = AF_INET;
  addrinfo* found = nullptr;
  if (getaddrinfo(hostname, nullptr, &hints, &found) != 0) return -1;
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  freeaddrinfo(found);
  *dest = address.sin_addr.s_addr;
  return 0;
}
