// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "utf8_stream.h"

#include "sim/core/utf8.h"

namespace playpen {

std::size_t Utf8Stream::incomplete_end(std::string_view text) noexcept {
  constexpr std::size_t kLongest = 4;
  for (std::size_t size = 1; size < kLongest && size <= text.size(); ++size) {
    const auto byte = static_cast<unsigned char>(text[text.size() - size]);
    if ((byte & 0xc0U) == 0x80U) continue;  // a later byte of a character
    const std::size_t whole = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 1;
    return size < whole ? size : 0;
  }
  return 0;
}

Utf8Stream::~Utf8Stream() {
  const std::string rest = sim::escape_invalid_utf8(waiting_);
  target_->sputn(rest.data(), static_cast<std::streamsize>(rest.size()));
  stream_.rdbuf(target_);
}

Utf8Stream::int_type Utf8Stream::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof()))
    return traits_type::not_eof(character);
  waiting_ += traits_type::to_char_type(character);
  return pass_on() ? character : traits_type::eof();
}

std::streamsize Utf8Stream::xsputn(const char* text, std::streamsize size) {
  waiting_.append(text, static_cast<std::size_t>(size));
  return pass_on() ? size : 0;
}

bool Utf8Stream::pass_on() {
  const std::size_t kept = incomplete_end(waiting_);
  const std::string_view complete = std::string_view(waiting_).substr(0, waiting_.size() - kept);
  const std::string text = sim::escape_invalid_utf8(complete);
  waiting_.erase(0, complete.size());
  const auto size = static_cast<std::streamsize>(text.size());
  return target_->sputn(text.data(), size) == size;
}

}  // namespace playpen
