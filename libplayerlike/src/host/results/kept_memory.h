// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/results/kept_layout.h"

namespace playerlike {

/// The memory of a KeptRun, which may contain anything.
class KeptMemory {
 public:
  explicit KeptMemory(int descriptor) {
    struct stat info {};
    if (fstat(descriptor, &info) != 0 || info.st_size < static_cast<off_t>(kKeptHeaderSize)) return;
    size_ = static_cast<std::size_t>(info.st_size);
    void* const memory = mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor, 0);
    if (memory != MAP_FAILED) bytes_ = static_cast<const std::byte*>(memory);
  }
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;
  ~KeptMemory() {
    if (bytes_ != nullptr) munmap(const_cast<std::byte*>(bytes_), size_);
  }

  /// @return null unless `count` objects fit into the memory at this place.
  template <typename T>
  [[nodiscard]] const T* at(std::uint64_t place, std::uint64_t count = 1) const {
    if (bytes_ == nullptr || place % alignof(T) != 0 || place > size_ ||
        count > (size_ - place) / sizeof(T)) {
      return nullptr;
    }
    return reinterpret_cast<const T*>(bytes_ + place);
  }

  /// The text in this place; empty if there is none.
  [[nodiscard]] std::string_view text(std::uint64_t text) const {
    const char* const bytes = at<char>(place_of_text(text), size_of_text(text));
    if (text == 0 || bytes == nullptr) return {};
    return {bytes, static_cast<std::size_t>(size_of_text(text))};
  }
  /// @return null unless this place holds valid JSON.
  [[nodiscard]] nlohmann::json json(std::uint64_t place) const {
    return nlohmann::json::parse(text(place), nullptr, /*allow_exceptions=*/false);
  }

 private:
  const std::byte* bytes_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace playerlike
