// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "canvas/png_codec.h"

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstring>

#include "canvas/make_room.h"

namespace sim {
namespace {

constexpr std::size_t kMostInterlaced = std::size_t{64} << 20;  // bytes

// libpng leaves a function by longjmp() on errors. Therefore everything with a destructor lives in
// these structs, outside the functions that call setjmp().

void ignore_warning(png_structp /*png*/, png_const_charp /*text*/) {}

[[noreturn]] void leave(png_structp png, png_const_charp /*text*/) { png_longjmp(png, 1); }

struct Decoder {
  explicit Decoder(const std::vector<std::uint8_t>& file) : bytes(file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, &leave, &ignore_warning);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }

  const std::vector<std::uint8_t>& bytes;
  std::size_t at = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint8_t> samples;  // one row, or the whole of an interlaced picture
};

void read_bytes(png_structp png, png_bytep out, std::size_t size) {
  auto& decoder = *static_cast<Decoder*>(png_get_io_ptr(png));
  if (decoder.bytes.size() - decoder.at < size) png_error(png, "the file is cut short");
  std::memcpy(out, decoder.bytes.data() + decoder.at, size);
  decoder.at += size;
}

bool decode(Decoder& decoder, std::uint32_t width, std::uint32_t height,
            const std::function<void(const PngRow&)>& visit) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_read_fn(decoder.png, &decoder, &read_bytes);
  png_read_info(decoder.png, decoder.info);
  if (png_get_image_width(decoder.png, decoder.info) != width ||
      png_get_image_height(decoder.png, decoder.info) != height) {
    return false;
  }
  png_set_expand(decoder.png);
  const int passes = png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  const std::size_t stride = png_get_rowbytes(decoder.png, decoder.info);
  PngRow row;
  row.width = static_cast<int>(width);
  row.channels = png_get_channels(decoder.png, decoder.info);
  row.bytes_per_sample = png_get_bit_depth(decoder.png, decoder.info) / 8;
  // A small file may claim to be a large interlaced picture, which must be kept as a whole.
  if (passes > 1 && stride * height > kMostInterlaced) return false;
  if (!make_room(decoder.samples, passes == 1 ? stride : stride * height)) return false;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t y = 0; y < height; ++y) {
      std::uint8_t* const samples = decoder.samples.data() + (passes == 1 ? 0 : y * stride);
      png_read_row(decoder.png, samples, nullptr);
      row.samples = samples;
      if (pass == passes - 1) visit(row);
    }
  }
  png_read_end(decoder.png, nullptr);
  return true;
}

}  // namespace

bool decode_png(const std::vector<std::uint8_t>& bytes, int width, int height,
                const std::function<void(const PngRow&)>& row) {
  Decoder decoder(bytes);
  return decoder.info != nullptr && decode(decoder, static_cast<std::uint32_t>(width),
                                           static_cast<std::uint32_t>(height), row);
}

}  // namespace sim
