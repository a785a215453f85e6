// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/colour.h"

#include <array>
#include <cstddef>

#include "sim/core/number_text.h"

namespace sim {
namespace {

std::optional<int> hex_digit(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
  if (letter >= 'A' && letter <= 'F') return letter - 'A' + 10;
  return std::nullopt;
}

}  // namespace

std::optional<Colour> parse_colour(std::string_view text) {
  if (text.size() != 4 && text.size() != 7 && text.size() != 9) return std::nullopt;
  if (text.front() != '#') return std::nullopt;
  text.remove_prefix(1);
  const std::size_t digits_per_channel = text.size() == 3 ? 1 : 2;
  std::array<std::uint8_t, 4> channels = {0, 0, 0, 255};
  for (std::size_t channel = 0; channel * digits_per_channel < text.size(); ++channel) {
    const auto high = hex_digit(text[channel * digits_per_channel]);
    const auto low = hex_digit(text[channel * digits_per_channel + digits_per_channel - 1]);
    if (!high || !low) return std::nullopt;
    channels[channel] = static_cast<std::uint8_t>(*high * 16 + *low);
  }
  return Colour{channels[0], channels[1], channels[2], channels[3]};
}

std::string to_string(Colour colour) {
  std::string text = "#";
  for (const std::uint8_t channel : {colour.r, colour.g, colour.b}) {
    text += hexadecimal_text(channel, 2);
  }
  if (colour.a != 255) text += hexadecimal_text(colour.a, 2);
  return text;
}

}  // namespace sim
