// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace playpen {

/// While an object exists, a stream passes on valid UTF-8 only: messages quote names of files,
/// programs and arguments, which may contain any bytes. Other bytes appear as "\xNN".
class Utf8Stream : private std::streambuf {
 public:
  /// @param stream  must outlive this object.
  explicit Utf8Stream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}
  Utf8Stream(const Utf8Stream&) = delete;
  Utf8Stream& operator=(const Utf8Stream&) = delete;
  ~Utf8Stream() override;

 private:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override { return target_->pubsync(); }
  /// Number of bytes at the end of a text that may be the beginning of a character.
  static std::size_t incomplete_end(std::string_view text) noexcept;
  /// Passes on the characters that are complete.
  bool pass_on();

  std::ostream& stream_;
  std::streambuf* target_;
  std::string waiting_;  ///< the bytes of an incomplete character
};

}  // namespace playpen
