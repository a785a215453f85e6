// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

/// Messages between a simulation's host and the process that shows its window (playpen-view).
///
/// Both processes run on one machine and are connected by a socketpair() of type SOCK_STREAM, so
/// numbers have the machine's byte order. The viewer sends kHello once its window is open. Then the
/// host sends a frame. It sends the next frame only after the viewer has sent kShown, so that a
/// slow or hanging viewer only loses frames. The host closes its end to close the window. Header
/// only: the viewer needs no other part of the client library.
namespace playerlike::view {

/// First word of every message; identifies the version of the protocol.
inline constexpr std::uint32_t kMagic = 0x31565050;  // "PPV1"

/// Types of messages from the viewer.
enum class ViewerMessageKind : std::uint32_t {
  kHello = 1,       ///< the window is open; a, b: maximum width and height of pictures [pixels]
  kShown = 2,       ///< a: number of the frame on the screen
  kKey = 3,         ///< a: X11 keysym; b: KeyFlag
  kReleaseAll = 4,  ///< the window has lost the keyboard focus: all keys count as released
  kClosed = 5,      ///< the user closed the window
};

/// Flags of a kKey message.
enum KeyFlag : std::uint32_t {
  kPressed = 1,  ///< the key was pressed; without this flag, released
  kControl = 2,  ///< a Ctrl key was held
};

/// A message from the viewer. All messages have this size.
struct ViewerMessage {
  std::uint32_t magic = kMagic;
  ViewerMessageKind kind = ViewerMessageKind::kHello;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};
static_assert(sizeof(ViewerMessage) == 16);

/// Minimum width and height of a picture [pixels].
inline constexpr std::uint32_t kLeastSide_px = 64;
/// Maximum width and height of a picture [pixels].
inline constexpr std::uint32_t kGreatestSide_px = 8192;
/// Maximum length of a frame's text [bytes].
inline constexpr std::uint32_t kGreatestText = 4096;

/// Header of a frame. It is followed by 3 * width * height RGB bytes, row-major from the top, and
/// by the text.
///
/// The text is ASCII, with lines ended by '\n': the status line, a temporary message for the status
/// line, and any number of help lines. In a help line, keys and their functions alternate,
/// separated by two or more spaces.
struct FrameHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t number = 0;  ///< number of the frame, from 1
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t text_bytes = 0;
  std::uint32_t robot_colour = 0;  ///< colour of the selected robot, 0xRRGGBB
  std::uint32_t paused = 0;        ///< 1: time is paused, and the status line is highlighted
};
static_assert(sizeof(FrameHeader) == 28);

/// Whether a header is valid.
[[nodiscard]] inline bool is_valid(const FrameHeader& header) noexcept {
  return header.magic == kMagic && header.width > 0 && header.width <= kGreatestSide_px &&
         header.height > 0 && header.height <= kGreatestSide_px &&
         header.text_bytes <= kGreatestText && header.paused <= 1;
}

/// Number of bytes that follow a valid header.
[[nodiscard]] inline std::size_t body_bytes(const FrameHeader& header) noexcept {
  return 3 * static_cast<std::size_t>(header.width) * header.height + header.text_bytes;
}

/// Extracts the first message from received bytes.
/// @param[in,out] received received bytes in order; the message's bytes are removed.
/// @param[out] garbage      set if the bytes are not a valid message; nothing is removed then.
/// @return the message; nullopt if it is incomplete or invalid.
[[nodiscard]] inline std::optional<ViewerMessage> take_message(std::string& received,
                                                               bool& garbage) {
  ViewerMessage message;
  if (received.size() < sizeof message) return std::nullopt;
  std::memcpy(&message, received.data(), sizeof message);
  const auto kind = static_cast<std::uint32_t>(message.kind);
  garbage = message.magic != kMagic ||
            kind < static_cast<std::uint32_t>(ViewerMessageKind::kHello) ||
            kind > static_cast<std::uint32_t>(ViewerMessageKind::kClosed);
  if (garbage) return std::nullopt;
  received.erase(0, sizeof message);
  return message;
}

}  // namespace playerlike::view
