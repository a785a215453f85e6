// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace playerlike {

/// Keeps the memory of a large list for the next one. A large list that is freed goes back to the
/// system, and each page of the next one then costs more time than its content. Not thread-safe.
template <typename Element>
class Spare {
 public:
  /// Lists with more memory are not kept [bytes].
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

  /// The list that was kept, with its old content; empty if there is none.
  [[nodiscard]] std::vector<Element> take() { return std::exchange(list_, {}); }

  /// Keeps a list that is no longer needed, unless it is too large, or smaller than the one kept.
  void keep(std::vector<Element>&& list) {
    const std::size_t room = list.capacity();
    if (room > list_.capacity() && room <= kMostBytes / sizeof(Element)) list_ = std::move(list);
  }

 private:
  std::vector<Element> list_;
};

}  // namespace playerlike
