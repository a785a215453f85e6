// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "canvas/png_codec.h"

namespace sim {
namespace {

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

  [[nodiscard]] const std::vector<std::uint8_t>& rgb() const { return rgb_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int bit_depth() const {
    return size_ <= 2 ? 1 : size_ <= 4 ? 2 : size_ <= 16 ? 4 : 8;
  }

 private:
  static constexpr int kMostColours = 256;  // of a PNG
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
      if (size_ == kMostColours) return -1;
      keys_[slot] = colour;
      index_in_slot_[slot] = size_;
      for (const unsigned shift : {0U, 8U, 16U}) {
        rgb_.push_back(static_cast<std::uint8_t>(colour >> shift & 0xffU));
      }
      return size_++;
    }
    return index_in_slot_[slot];
  }

  std::vector<std::uint8_t> rgb_;  // of the colours
  int size_ = 0;
  std::array<std::uint32_t, kSlots> keys_ = [] {
    std::array<std::uint32_t, kSlots> keys{};
    keys.fill(kNoColour);
    return keys;
  }();
  std::array<int, kSlots> index_in_slot_{};
};

// The measurements behind these levels and the filter are in docs/decisions/speed.md.
constexpr int kLevelOfColours = 3;
constexpr int kLevelOfIndices = 6;

// Writes the chunks of a PNG (PNG specification, W3C 2003, sections 5 and 11) into a buffer.
class PngWriter {
 public:
  enum class ColourType : std::uint8_t { kRgb = 2, kPalette = 3 };

  PngWriter(int width, int height, int bit_depth, ColourType type) {
    add_bytes("\x89PNG\r\n\x1a\n");
    begin_chunk("IHDR");
    add_number(static_cast<std::uint32_t>(width));
    add_number(static_cast<std::uint32_t>(height));
    // Without compression, filter or interlacing methods other than the usual ones.
    for (const int byte : {bit_depth, static_cast<int>(type), 0, 0, 0}) {
      bytes_.push_back(static_cast<std::uint8_t>(byte));
    }
    end_chunk();
  }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { deflateEnd(&stream_); }

  void add_palette(const std::vector<std::uint8_t>& rgb) {
    begin_chunk("PLTE");
    bytes_.insert(bytes_.end(), rgb.begin(), rgb.end());
    end_chunk();
  }

  /// Begins the pixels. @throws std::bad_alloc if there is no memory.
  void begin_rows(std::size_t row_bytes, int level) {
    constexpr int kWindowBits = 15;
    constexpr int kMemoryLevel = 8;
    if (deflateInit2(&stream_, level, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_FILTERED) != Z_OK) {
      throw std::bad_alloc();
    }
    begin_chunk("IDAT");
    last_.assign(row_bytes, 0);
    filtered_.assign(row_bytes + 1, kUp);
  }
  /// Adds a row of pixels.
  void add_row(const std::uint8_t* row) {
    const std::size_t size = last_.size();
    std::uint8_t* const last = last_.data();
    std::uint8_t* const out = filtered_.data() + 1;
    for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(row[i] - last[i]);
    std::copy_n(row, size, last);
    compress(Z_NO_FLUSH);
  }
  /// Adds the last row once more.
  void repeat_row() {
    std::fill(filtered_.begin() + 1, filtered_.end(), std::uint8_t{0});
    compress(Z_NO_FLUSH);
  }

  /// The whole file.
  [[nodiscard]] std::vector<std::uint8_t> finish() {
    filtered_.clear();
    compress(Z_FINISH);
    end_chunk();
    begin_chunk("IEND");
    end_chunk();
    return std::move(bytes_);
  }

 private:
  static constexpr std::uint8_t kUp = 2;  // the filter: differences from the row above

  void add_bytes(std::string_view bytes) {
    for (const char byte : bytes) bytes_.push_back(static_cast<std::uint8_t>(byte));
  }
  void add_number(std::uint32_t value) {
    bytes_.resize(bytes_.size() + 4);
    write_number(value, bytes_.size() - 4);
  }
  // Big-endian.
  void write_number(std::uint32_t value, std::size_t at) {
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
      bytes_[at++] = static_cast<std::uint8_t>(value >> shift & 0xffU);
    }
  }

  void begin_chunk(std::string_view type) {
    chunk_ = bytes_.size();
    add_number(0);  // its length, which end_chunk() writes
    add_bytes(type);
  }
  void end_chunk() {
    constexpr std::size_t kBeforeType = 4;
    constexpr std::size_t kBeforeData = 8;
    const std::size_t checked = bytes_.size() - chunk_ - kBeforeType;
    write_number(static_cast<std::uint32_t>(bytes_.size() - chunk_ - kBeforeData), chunk_);
    add_number(static_cast<std::uint32_t>(
        crc32(0, bytes_.data() + chunk_ + kBeforeType, static_cast<uInt>(checked))));
  }

  // Compresses the filtered row.
  void compress(int flush) {
    stream_.next_in = filtered_.data();
    stream_.avail_in = static_cast<uInt>(filtered_.size());
    do {
      stream_.next_out = compressed_.data();
      stream_.avail_out = static_cast<uInt>(compressed_.size());
      deflate(&stream_, flush);
      bytes_.insert(bytes_.end(), compressed_.data(), stream_.next_out);
    } while (stream_.avail_out == 0);
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t chunk_ = 0;  // where the present chunk begins
  z_stream stream_{};
  std::vector<std::uint8_t> last_;      // the last row
  std::vector<std::uint8_t> filtered_;  // the filter's number and the filtered row
  std::array<std::uint8_t, 1 << 14> compressed_{};
};

std::vector<std::uint8_t> encode(const Pixels& picture) {
  PngWriter writer(picture.width, picture.height, 8, PngWriter::ColourType::kRgb);
  writer.begin_rows(picture.stride(), kLevelOfColours);
  for (int y = 0; y < picture.height; ++y) {
    if (picture.repeats(y)) {
      writer.repeat_row();
    } else {
      writer.add_row(picture.row(y));
    }
  }
  return writer.finish();
}

// Packs indices of `bits` bits each into bytes, the leftmost in the highest bits.
void pack(const std::vector<std::uint8_t>& indices, int bits, std::vector<std::uint8_t>& packed) {
  std::fill(packed.begin(), packed.end(), std::uint8_t{0});
  const int in_byte = 8 / bits;
  for (std::size_t x = 0; x < indices.size(); ++x) {
    const auto each = static_cast<std::size_t>(in_byte);
    const int shift = bits * (in_byte - 1 - static_cast<int>(x % each));
    packed[x / each] = static_cast<std::uint8_t>(packed[x / each] | indices[x] << shift);
  }
}

std::vector<std::uint8_t> encode(const Pixels& picture, Palette& palette) {
  const int bits = palette.bit_depth();
  PngWriter writer(picture.width, picture.height, bits, PngWriter::ColourType::kPalette);
  writer.add_palette(palette.rgb());
  std::vector<std::uint8_t> indices(static_cast<std::size_t>(picture.width));
  std::vector<std::uint8_t> packed((indices.size() * static_cast<std::size_t>(bits) + 7) / 8);
  writer.begin_rows(packed.size(), kLevelOfIndices);
  for (int y = 0; y < picture.height; ++y) {
    if (picture.repeats(y)) {
      writer.repeat_row();
      continue;
    }
    palette.index_row(picture, y, indices.data());
    pack(indices, bits, packed);
    writer.add_row(packed.data());
  }
  return writer.finish();
}

}  // namespace

std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb, int copies) {
  const Pixels picture{width, height * copies, rgb, copies};
  try {
    Palette palette;
    return palette.add_all(picture) ? encode(picture, palette) : encode(picture);
  } catch (const std::bad_alloc&) {
    return {};
  }
}

}  // namespace sim
