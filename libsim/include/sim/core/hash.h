// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace sim {

/// Running hash of a simulation's state: 64-bit FNV-1a
/// (http://www.isthe.com/chongo/tech/comp/fnv/), applied to 8-byte words instead of bytes.
///
/// Serves to compare runs; it does not resist an adversary. add(double) treats -0.0 as
/// 0.0; add_bytes() tells them apart.
class StateHash {
 public:
  void add(std::uint64_t word) noexcept {
    value_ = (value_ ^ word) * 0x100000001b3ULL;
    value_ ^= value_ >> 29;
  }
  template <std::integral T>
  void add(T number) noexcept {
    add(static_cast<std::uint64_t>(number));
  }
  void add(double number) noexcept { add(std::bit_cast<std::uint64_t>(number + 0.0)); }
  void add(std::string_view text) noexcept { add_bytes(text.data(), text.size()); }
  void add_bytes(const void* data, std::size_t size) noexcept {
    const auto* bytes = static_cast<const unsigned char*>(data);
    add(static_cast<std::uint64_t>(size));
    for (; size >= 8; bytes += 8, size -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, 8);
      add(word);
    }
    std::uint64_t tail = 0;
    if (size > 0) std::memcpy(&tail, bytes, size);  // data may be null if it is empty
    add(tail);
  }

  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace sim
