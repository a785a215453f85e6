// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "canvas/image_file.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "canvas/bmp_codec.h"
#include "canvas/jpeg_codec.h"
#include "canvas/png_codec.h"
#include "sim/core/file.h"

namespace sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": " + reason);
}

Bytes read_bytes(const std::string& path) {
  std::string bytes;
  if (const auto problem = read_whole_file(path, {.most_bytes = kMaxGreyImageBytes}, bytes)) {
    fail(path, "cannot read the picture: " + problem->found);
  }
  if (bytes.empty()) fail(path, "the file is empty, expected a PNG or PGM picture");
  return {bytes.begin(), bytes.end()};
}

bool starts_with(const Bytes& bytes, std::string_view start) {
  return bytes.size() >= start.size() && std::memcmp(bytes.data(), start.data(), start.size()) == 0;
}

void check_size(const std::string& path, std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0) fail(path, "the picture has no pixels");
  if (width > kMaxGreyImageSide || height > kMaxGreyImageSide) {
    fail(path, "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels, at most " + std::to_string(kMaxGreyImageSide) +
                   " a side are supported");
  }
  if (std::size_t{width} * height > kMaxGreyImagePixels) {
    fail(path, "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels, at most " + std::to_string(kMaxGreyImagePixels) + " are supported");
  }
}

// BT.601 luma over a white background, 8 bits per channel.
std::uint8_t grey(std::uint32_t r, std::uint32_t g, std::uint32_t b, std::uint32_t alpha) {
  const std::uint32_t luma = (299 * r + 587 * g + 114 * b + 500) / 1000;
  return static_cast<std::uint8_t>((luma * alpha + 255 * (255 - alpha) + 127) / 255);
}

// A sample of 8 or 16 bits, scaled to 8 bits.
std::uint8_t to_8_bits(const std::uint8_t* sample, int bytes) {
  if (bytes == 1) return *sample;
  return static_cast<std::uint8_t>((sample[0] * 256u + sample[1] + 128u) / 257u);
}

std::uint8_t grey_of_pixel(const std::uint8_t* samples, int channels, int bytes) {
  const auto sample = [&](int channel) {
    return std::uint32_t{to_8_bits(samples + channel * bytes, bytes)};
  };
  switch (channels) {
    case 1:
      return static_cast<std::uint8_t>(sample(0));
    case 2:
      return grey(sample(0), sample(0), sample(0), sample(1));
    default:
      return grey(sample(0), sample(1), sample(2), channels == 4 ? sample(3) : 255u);
  }
}

/// Which number of a pixel an image keeps.
enum class Keep : std::uint8_t { kLuma, kFirstSample };

GreyImage load_png(const std::string& path, const Bytes& bytes, Keep keep) {
  // The signature of 8 bytes is followed by the chunk IHDR with length, name, width and height, of
  // 4 bytes each (PNG specification, W3C 2003, 5.2 and 11.2.2).
  if (bytes.size() < 24) fail(path, "the PNG is cut short");
  const auto number_at = [&](std::size_t at) {
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
           std::uint32_t{bytes[at + 2]} << 8 | std::uint32_t{bytes[at + 3]};
  };
  check_size(path, number_at(16), number_at(20));
  GreyImage image{static_cast<int>(number_at(16)), static_cast<int>(number_at(20)), {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
  auto out = image.pixels.begin();
  const bool whole = decode_png(bytes, image.width, image.height, [&](const PngRow& row) {
    const std::uint8_t* samples = row.samples;
    for (int x = 0; x < row.width; ++x, samples += row.channels * row.bytes_per_sample) {
      *out++ = keep == Keep::kLuma ? grey_of_pixel(samples, row.channels, row.bytes_per_sample)
                                   : to_8_bits(samples, row.bytes_per_sample);
    }
  });
  if (!whole)
    fail(path, "the PNG is damaged, or interlaced and too large: save it without interlacing");
  return image;
}

GreyImage load_visited(const std::string& path, const Bytes& bytes,
                       std::string (*decode)(const Bytes&, const PictureVisitor&)) {
  GreyImage image;
  std::string too_large;
  PictureVisitor visitor;
  visitor.begin = [&](std::uint32_t width, std::uint32_t height) {
    try {
      check_size(path, width, height);
      image.pixels.reserve(std::size_t{width} * height);
    } catch (const std::runtime_error& error) {
      too_large = error.what();
      return false;
    } catch (const std::bad_alloc&) {
      too_large = path + ": no memory for the picture";
      return false;
    }
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    return true;
  };
  visitor.row = [&](const std::uint8_t* samples, int channels) {
    for (int x = 0; x < image.width; ++x) image.pixels.push_back(samples[x * channels]);
  };
  const std::string reason = decode(bytes, visitor);
  if (!too_large.empty()) throw std::runtime_error(too_large);
  if (!reason.empty()) fail(path, reason);
  return image;
}

// Reads the numbers of a PGM, which are separated by white space and by comments from # to the end
// of the line.
class PgmReader {
 public:
  PgmReader(const std::string& path, const Bytes& bytes) : path_(path), bytes_(bytes) {}

  std::uint32_t number(const char* what) {
    skip_space();
    std::uint32_t value = 0;
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = std::min<std::uint32_t>(value * 10 + (bytes_[at_] - '0'), 100'000'000);
    }
    if (at_ == begin) {
      fail(path_, std::string(at_ == bytes_.size() ? "the PGM is cut short: no "
                                                   : "the PGM is damaged: expected a number as ") +
                      what);
    }
    return value;
  }

  // A digit 0 or 1 of a PBM; blanks between the digits are not needed.
  bool bit() {
    skip_space();
    if (at_ >= bytes_.size()) fail(path_, "the PBM is cut short");
    const std::uint8_t digit = bytes_[at_++];
    if (digit != '0' && digit != '1') fail(path_, "the PBM is damaged: expected 0 or 1");
    return digit == '1';
  }

  // Raw samples follow one white-space character.
  const std::uint8_t* raw(std::size_t size) {
    ++at_;
    if (at_ > bytes_.size() || bytes_.size() - at_ < size) fail(path_, "the PGM is cut short");
    return bytes_.data() + at_;
  }

 private:
  void skip_space() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else if (bytes_[at_] == ' ' || (bytes_[at_] >= '\t' && bytes_[at_] <= '\r')) {
        ++at_;
      } else {
        return;
      }
    }
  }

  const std::string& path_;
  const Bytes& bytes_;
  std::size_t at_ = 2;  // after P2 or P5
};

// Netpbm's PGM, https://netpbm.sourceforge.net/doc/pgm.html
GreyImage load_pgm(const std::string& path, const Bytes& bytes) {
  PgmReader reader(path, bytes);
  const std::uint32_t width = reader.number("width");
  const std::uint32_t height = reader.number("height");
  check_size(path, width, height);
  const std::uint32_t maximum = reader.number("greatest value");
  if (maximum == 0 || maximum > 65535) {
    fail(path, "the PGM is damaged: its greatest value must be in 1..65535");
  }
  const std::size_t count = std::size_t{width} * height;
  const auto scaled = [&](std::uint32_t sample) {
    return static_cast<std::uint8_t>((std::min(sample, maximum) * 255 + maximum / 2) / maximum);
  };
  GreyImage image{static_cast<int>(width), static_cast<int>(height), {}};
  if (bytes[1] == '2') {
    // Each sample takes at least a digit and a space, so a short file cannot claim much memory.
    if (bytes.size() < 2 * count - 1) fail(path, "the PGM is cut short");
    image.pixels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) image.pixels.push_back(scaled(reader.number("pixel")));
    return image;
  }
  const bool wide = maximum > 255;
  const std::uint8_t* const raw = reader.raw(wide ? 2 * count : count);
  image.pixels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    image.pixels[i] = scaled(wide ? raw[2 * i] * 256u + raw[2 * i + 1] : raw[i]);
  }
  return image;
}

// Netpbm's PBM, https://netpbm.sourceforge.net/doc/pbm.html: 1 is black.
GreyImage load_pbm(const std::string& path, const Bytes& bytes) {
  PgmReader reader(path, bytes);
  const std::uint32_t width = reader.number("width");
  const std::uint32_t height = reader.number("height");
  check_size(path, width, height);
  GreyImage image{static_cast<int>(width), static_cast<int>(height), {}};
  image.pixels.reserve(std::size_t{width} * height);
  if (bytes[1] == '1') {
    if (bytes.size() < std::size_t{width} * height) fail(path, "the PBM is cut short");
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
      image.pixels.push_back(reader.bit() ? 0 : 255);
    }
    return image;
  }
  const std::size_t stride = (std::size_t{width} + 7) / 8;
  const std::uint8_t* row = reader.raw(stride * height);
  for (std::uint32_t y = 0; y < height; ++y, row += stride) {
    for (std::uint32_t x = 0; x < width; ++x) {
      image.pixels.push_back((row[x / 8] >> (7 - x % 8) & 1) != 0 ? 0 : 255);
    }
  }
  return image;
}

// The red samples of Netpbm's PPM, https://netpbm.sourceforge.net/doc/ppm.html
GreyImage load_ppm(const std::string& path, const Bytes& bytes) {
  PgmReader reader(path, bytes);
  const std::uint32_t width = reader.number("width");
  const std::uint32_t height = reader.number("height");
  check_size(path, width, height);
  const std::uint32_t maximum = reader.number("greatest value");
  if (maximum == 0 || maximum > 65535) {
    fail(path, "the PPM is damaged: its greatest value must be in 1..65535");
  }
  const std::size_t count = std::size_t{width} * height;
  const auto scaled = [&](std::uint32_t sample) {
    return static_cast<std::uint8_t>((std::min(sample, maximum) * 255 + maximum / 2) / maximum);
  };
  GreyImage image{static_cast<int>(width), static_cast<int>(height), {}};
  image.pixels.reserve(count);
  if (bytes[1] == '3') {
    if (bytes.size() < 6 * count - 1) fail(path, "the PPM is cut short");
    for (std::size_t i = 0; i < count; ++i) {
      image.pixels.push_back(scaled(reader.number("red")));
      static_cast<void>(reader.number("green"));
      static_cast<void>(reader.number("blue"));
    }
    return image;
  }
  const std::size_t wide = maximum > 255 ? 2 : 1;
  const std::uint8_t* const raw = reader.raw(3 * wide * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const red = raw + 3 * wide * i;
    image.pixels.push_back(scaled(wide == 2 ? red[0] * 256u + red[1] : red[0]));
  }
  return image;
}

bool is_png(const Bytes& bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }
bool is_pgm(const Bytes& bytes) { return starts_with(bytes, "P2") || starts_with(bytes, "P5"); }

}  // namespace

GreyImage decode_grey_image(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (is_png(bytes)) return load_png(name, bytes, Keep::kLuma);
  if (is_pgm(bytes)) return load_pgm(name, bytes);
  fail(name, "not a PNG or PGM picture");
}

GreyImage load_grey_image(const std::string& path) {
  return decode_grey_image(read_bytes(path), path);
}

GreyImage load_first_samples(const std::string& path) {
  const Bytes bytes = read_bytes(path);
  if (is_png(bytes)) return load_png(path, bytes, Keep::kFirstSample);
  if (is_pgm(bytes)) return load_pgm(path, bytes);
  if (starts_with(bytes, "P1") || starts_with(bytes, "P4")) return load_pbm(path, bytes);
  if (starts_with(bytes, "P3") || starts_with(bytes, "P6")) return load_ppm(path, bytes);
  if (starts_with(bytes, "\xff\xd8\xff")) return load_visited(path, bytes, decode_jpeg);
  if (starts_with(bytes, "BM")) return load_visited(path, bytes, decode_bmp);
  fail(path, "not a PNG, JPEG, BMP, PBM, PGM or PPM picture");
}

}  // namespace sim
