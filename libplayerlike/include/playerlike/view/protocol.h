// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

/// What passes between a simulation's host and the process that shows its window (playpen-view).
///
/// Both run on one machine, at the ends of a socketpair() of type SOCK_STREAM, so numbers keep the
/// machine's byte order. The viewer speaks first: kHello, once its window is open. Then the host
/// sends a frame, and the next one only after the viewer has said kShown: a viewer that is slow, or
/// hangs, costs frames and nothing else. The host ends the window by closing its end.
/// Header only: the viewer needs nothing else of the client library.
namespace playerlike::view {

/// Begins every message; also tells versions apart.
inline constexpr std::uint32_t kMagic = 0x31565050;  // "PPV1"

/// Kinds of messages that the viewer sends.
enum class ViewerMessageKind : std::uint32_t {
  kHello = 1,       ///< the window is open; a, b: width and height that pictures may have [pixels]
  kShown = 2,       ///< a: number of the frame that is on the screen now
  kKey = 3,         ///< a: X11 keysym; b: KeyFlag
  kReleaseAll = 4,  ///< the window has lost the keyboard: no key counts as pressed any more
  kClosed = 5,      ///< the user closed the window
};

/// Flags of a kKey message.
enum KeyFlag : std::uint32_t {
  kPressed = 1,  ///< went down; else it was released
  kControl = 2,  ///< with a Ctrl key held
};

/// A message of the viewer; all are of this size.
struct ViewerMessage {
  std::uint32_t magic = kMagic;
  ViewerMessageKind kind = ViewerMessageKind::kHello;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};
static_assert(sizeof(ViewerMessage) == 16);

/// Least side of a picture that a viewer may ask for [pixels].
inline constexpr std::uint32_t kLeastSide_px = 64;
/// Greatest one [pixels].
inline constexpr std::uint32_t kGreatestSide_px = 8192;
/// Bound of a frame's text [bytes].
inline constexpr std::uint32_t kGreatestText = 4096;

/// A frame: this, then 3 * width * height RGB bytes, row-major from the top, then the text.
///
/// The text is ASCII, lines ended by '\n': what stands in the status line, a passing message for
/// it, and any number of lines of help, in each of which keys and what they do alternate, two or
/// more blanks apart.
struct FrameHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t number = 0;  ///< counts frames from 1
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t text_bytes = 0;
  std::uint32_t robot_colour = 0;  ///< of the chosen robot, 0xRRGGBB
  std::uint32_t paused = 0;        ///< 1: time stands still, so the status line stands out
};
static_assert(sizeof(FrameHeader) == 28);

/// Whether a header is one that the host may have sent.
[[nodiscard]] inline bool is_valid(const FrameHeader& header) noexcept {
  return header.magic == kMagic && header.width > 0 && header.width <= kGreatestSide_px &&
         header.height > 0 && header.height <= kGreatestSide_px &&
         header.text_bytes <= kGreatestText && header.paused <= 1;
}

/// Bytes that follow a sound header.
[[nodiscard]] inline std::size_t body_bytes(const FrameHeader& header) noexcept {
  return 3 * static_cast<std::size_t>(header.width) * header.height + header.text_bytes;
}

/// Takes the first message out of what was received.
/// @param[in,out] received  bytes in order; those of the message are removed.
/// @param[out] garbage      set if these bytes are no message of a viewer; nothing is removed then.
/// @return the message; nullopt if there is no whole one yet, or garbage.
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
