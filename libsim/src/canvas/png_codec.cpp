// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "canvas/png_codec.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <utility>

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

// An RGB picture.
struct Pixels {
  int width;
  int height;  // of the encoded picture
  const std::uint8_t* rgb;
  int copies;  // rows of the encoded picture for each row of `rgb`

  [[nodiscard]] std::size_t stride() const { return 3 * static_cast<std::size_t>(width); }
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return rgb + stride() * static_cast<std::size_t>(y / copies);
  }
  // Whether a row equals the one above; each cell of a canvas covers many rows.
  [[nodiscard]] bool repeats(int y) const {
    return y % copies != 0 || (y > 0 && std::memcmp(row(y), row(y - 1), stride()) == 0);
  }
};

// The colours of a picture, in the order in which they appear.
class Palette {
 public:
  // @return false if there are more than a palette can hold.
  [[nodiscard]] bool add_all(const Pixels& picture) {
    for (int y = 0; y < picture.height; ++y) {
      if (picture.repeats(y)) continue;
      const auto found = visit_row(picture, y, [](std::size_t /*x*/, int /*index*/) {});
      if (!found) return false;
    }
    return true;
  }
  // The index of each pixel's colour. @pre add_all() returned true for this picture.
  void index_row(const Pixels& picture, int y, std::uint8_t* indices) {
    visit_row(picture, y,
              [&](std::size_t x, int index) { indices[x] = static_cast<std::uint8_t>(index); });
  }

  [[nodiscard]] const png_color* colours() const { return colours_.data(); }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int bit_depth() const {
    return size_ <= 2 ? 1 : size_ <= 4 ? 2 : size_ <= 16 ? 4 : 8;
  }

 private:
  static constexpr unsigned kSlotBits = 10;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  static constexpr std::uint32_t kNoColour = 0xffffffff;

  // Calls visit(x, index) for each pixel of a row. @return false if there are too many colours.
  template <typename Visit>
  bool visit_row(const Pixels& picture, int y, Visit visit) {
    const std::uint8_t* rgb = picture.row(y);
    std::uint32_t last = kNoColour;
    int index = 0;
    for (std::size_t x = 0; x < static_cast<std::size_t>(picture.width); ++x, rgb += 3) {
      const std::uint32_t colour =
          rgb[0] | std::uint32_t{rgb[1]} << 8U | std::uint32_t{rgb[2]} << 16U;
      if (colour != last) {
        index = index_of(colour);
        if (index < 0) return false;
        last = colour;
      }
      visit(x, index);
    }
    return true;
  }

  // The index of a colour, which is added if it is new; -1 if there is no room. A hash table with
  // open addressing, in which at most a quarter of the slots is in use.
  int index_of(std::uint32_t colour) {
    std::size_t slot = (colour * 0x9e3779b1U) >> (32U - kSlotBits);
    for (; keys_[slot] != colour; slot = (slot + 1) % kSlots) {
      if (keys_[slot] != kNoColour) continue;
      if (size_ == PNG_MAX_PALETTE_LENGTH) return -1;
      keys_[slot] = colour;
      index_in_slot_[slot] = size_;
      colours_[static_cast<std::size_t>(size_)] = {static_cast<png_byte>(colour & 0xffU),
                                                   static_cast<png_byte>(colour >> 8U & 0xffU),
                                                   static_cast<png_byte>(colour >> 16U)};
      return size_++;
    }
    return index_in_slot_[slot];
  }

  std::array<png_color, PNG_MAX_PALETTE_LENGTH> colours_{};
  int size_ = 0;
  std::array<std::uint32_t, kSlots> keys_ = [] {
    std::array<std::uint32_t, kSlots> keys{};
    keys.fill(kNoColour);
    return keys;
  }();
  std::array<int, kSlots> index_in_slot_{};
};

struct Encoder {
  Encoder() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, &leave, &ignore_warning);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() { png_destroy_write_struct(&png, &info); }

  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint8_t> bytes;
};

void write_bytes(png_structp png, png_bytep in, std::size_t size) {
  auto& bytes = static_cast<Encoder*>(png_get_io_ptr(png))->bytes;
  const std::size_t begin = bytes.size();
  if (!make_room(bytes, begin + size)) png_error(png, "no memory");
  std::memcpy(bytes.data() + begin, in, size);
}

// The measurements behind these levels and filters are in docs/decisions/speed.md.
constexpr int kLevelOfColours = 3;
constexpr int kLevelOfIndices = 6;

void begin(Encoder& encoder, const Pixels& picture, int bit_depth, int colour_type, int level) {
  png_set_write_fn(encoder.png, &encoder, &write_bytes, nullptr);
  png_set_IHDR(encoder.png, encoder.info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), bit_depth, colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(encoder.png, level);
  // libpng's own choice of a filter for each row would take longer than the compression.
  png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
}

bool encode(Encoder& encoder, const Pixels& picture) {
  if (setjmp(png_jmpbuf(encoder.png)) != 0) return false;
  begin(encoder, picture, 8, PNG_COLOR_TYPE_RGB, kLevelOfColours);
  png_write_info(encoder.png, encoder.info);
  for (int y = 0; y < picture.height; ++y) png_write_row(encoder.png, picture.row(y));
  png_write_end(encoder.png, nullptr);
  return true;
}

// @param row  room for a row of indices.
bool encode(Encoder& encoder, const Pixels& picture, Palette& palette, std::uint8_t* row) {
  if (setjmp(png_jmpbuf(encoder.png)) != 0) return false;
  begin(encoder, picture, palette.bit_depth(), PNG_COLOR_TYPE_PALETTE, kLevelOfIndices);
  png_set_PLTE(encoder.png, encoder.info, palette.colours(), palette.size());
  png_write_info(encoder.png, encoder.info);
  png_set_packing(encoder.png);
  for (int y = 0; y < picture.height; ++y) {
    if (!picture.repeats(y)) palette.index_row(picture, y, row);
    png_write_row(encoder.png, row);
  }
  png_write_end(encoder.png, nullptr);
  return true;
}

}  // namespace

bool decode_png(const std::vector<std::uint8_t>& bytes, int width, int height,
                const std::function<void(const PngRow&)>& row) {
  Decoder decoder(bytes);
  return decoder.info != nullptr && decode(decoder, static_cast<std::uint32_t>(width),
                                           static_cast<std::uint32_t>(height), row);
}

std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb, int copies) {
  const Pixels picture{width, height * copies, rgb, copies};
  Encoder encoder;
  if (encoder.info == nullptr) return {};
  Palette palette;
  std::vector<std::uint8_t> row;
  if (!make_room(row, static_cast<std::size_t>(width))) return {};
  const bool done = palette.add_all(picture) ? encode(encoder, picture, palette, row.data())
                                             : encode(encoder, picture);
  if (!done) return {};
  return std::move(encoder.bytes);
}

}  // namespace sim
