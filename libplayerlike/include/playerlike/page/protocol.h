// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

/// Messages between a simulation's host and the process that serves its live page (playpen-page).
///
/// Both processes run on one machine and are connected by a socketpair() of type SOCK_STREAM, so
/// numbers have the machine's byte order. Every message is a Header and `length` bytes after it.
/// The page process sends kReady once it listens. Then the host sends a part. It sends the next one
/// only after the page process has sent kTaken, so that a slow or hanging page process only loses
/// parts. That process also withholds kTaken while nobody watches. The page process passes the
/// contents on to browsers without reading them. The host closes its end when the run is over.
/// Header only: the page process needs no other part of the client library.
namespace playerlike::page {

/// First word of every message; identifies the version of the protocol.
inline constexpr std::uint32_t kMagic = 0x314C5050;  // "PPL1"

/// Kinds of messages from the host.
enum class HostKind : std::uint32_t {
  kWhole = 1,   ///< the whole run up to now, for all clients that wait for one; client 0
  kPart = 2,    ///< what is new since the last kPart, for all clients that have had a whole; client
                ///< 0. A whole of the same moment comes after the part, and contains it.
  kAnswer = 3,  ///< a JSON text for one client only
  kAnew = 4,    ///< a whole for all clients: the simulation has gone back to an earlier time
};

/// Kinds of messages from the page process.
enum class PageKind : std::uint32_t {
  kReady = 1,      ///< it listens; client 0; contents, for the command that has started it: the TCP
                   ///< port, a blank, and 1 if watching needs no token, otherwise 0
  kTaken = 2,      ///< it has read one kPart: the host may send the next; client 0
  kWantWhole = 3,  ///< a client waits for a whole; client 0. The host answers with the next part
                   ///< and a whole after it.
  kCommand = 4,    ///< a JSON object from a client that may command
  kGone = 5,       ///< a client that has sent a command has left: its steering ends
};

/// Header of a message; `length` bytes follow.
struct Header {
  std::uint32_t magic = kMagic;
  std::uint32_t kind = 0;    ///< a HostKind or a PageKind
  std::uint32_t client = 0;  ///< number of the client, from 1, never used again; 0: no client
  std::uint32_t length = 0;  ///< of the contents [bytes]
};
static_assert(sizeof(Header) == 16);

/// Maximum length of the contents of a message from the host [bytes].
inline constexpr std::uint32_t kGreatestHostLength = 64U << 20U;
/// Maximum length of the contents of a message from the page process [bytes].
inline constexpr std::uint32_t kGreatestPageLength = 4096;

/// Whether a header is a valid one from the host.
[[nodiscard]] inline bool is_from_host(const Header& header) noexcept {
  const bool is_answer = header.kind == static_cast<std::uint32_t>(HostKind::kAnswer);
  return header.magic == kMagic && header.kind >= static_cast<std::uint32_t>(HostKind::kWhole) &&
         header.kind <= static_cast<std::uint32_t>(HostKind::kAnew) &&
         (header.client != 0) == is_answer && header.length <= kGreatestHostLength;
}

/// Whether a header is a valid one from the page process.
[[nodiscard]] inline bool is_from_page(const Header& header) noexcept {
  const bool is_of_client = header.kind == static_cast<std::uint32_t>(PageKind::kCommand) ||
                            header.kind == static_cast<std::uint32_t>(PageKind::kGone);
  return header.magic == kMagic && header.kind >= static_cast<std::uint32_t>(PageKind::kReady) &&
         header.kind <= static_cast<std::uint32_t>(PageKind::kGone) &&
         (header.client != 0) == is_of_client && header.length <= kGreatestPageLength;
}

/// The bytes of a header, as they are sent.
[[nodiscard]] inline std::string header_bytes(const Header& header) {
  std::string bytes(sizeof header, '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

/// A whole message of the page process, as it is sent.
/// @pre contents.size() <= kGreatestPageLength.
[[nodiscard]] inline std::string page_message(PageKind kind, std::uint32_t client = 0,
                                              std::string_view contents = {}) {
  std::string bytes = header_bytes({.kind = static_cast<std::uint32_t>(kind),
                                    .client = client,
                                    .length = static_cast<std::uint32_t>(contents.size())});
  return bytes.append(contents);
}

/// A message from the page process.
struct PageMessage {
  PageKind kind = PageKind::kReady;
  std::uint32_t client = 0;
  std::string contents;
};

/// Extracts the first message of the page process from received bytes.
/// @param[in,out] received received bytes in order; the message's bytes are removed.
/// @param[out] garbage      set if the bytes are not a valid message; nothing is removed then.
/// @return the message; nullopt if it is incomplete or invalid.
[[nodiscard]] inline std::optional<PageMessage> take_page_message(std::string& received,
                                                                  bool& garbage) {
  Header header;
  if (received.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, received.data(), sizeof header);
  garbage = !is_from_page(header);
  if (garbage || received.size() < sizeof header + header.length) return std::nullopt;
  PageMessage message{static_cast<PageKind>(header.kind), header.client,
                      received.substr(sizeof header, header.length)};
  received.erase(0, sizeof header + header.length);
  return message;
}

}  // namespace playerlike::page
