// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sim {

/// A colour with 8 bits per channel; alpha 255 is opaque.
struct Colour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// Reads "#RGB", "#RRGGBB" or "#RRGGBBAA" (either case); nullopt for anything else.
[[nodiscard]] std::optional<Colour> parse_colour(std::string_view text);

/// "#rrggbb", or "#rrggbbaa" where alpha is not 255.
[[nodiscard]] std::string to_string(Colour colour);

}  // namespace sim
