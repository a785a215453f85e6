// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "canvas/jpeg_codec.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
// After <cstdio>, whose FILE it needs.
#include <jerror.h>
#include <jpeglib.h>

#include "canvas/make_room.h"

namespace sim {
namespace {

// A progressive picture is kept as a whole, and a small file may claim to be a large one.
constexpr std::size_t kMostProgressive = std::size_t{16} << 20;  // pixels
// A picture of many scans may take libjpeg very long, although its file is small.
constexpr int kMostScans = 100;

// libjpeg leaves a function by longjmp() on errors. Therefore everything with a destructor lives in
// this struct, outside the function that calls setjmp().
struct JpegDecoder {
  JpegDecoder() {
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr common) { leave(common); };
    errors.emit_message = [](j_common_ptr common, int level) {
      // Viewers show pictures with other warnings, and so does Stage.
      if (level < 0 && common->err->msg_code == JWRN_JPEG_EOF) of(common).cut_short = true;
    };
    errors.output_message = [](j_common_ptr) {};
    progress.progress_monitor = [](j_common_ptr common) {
      JpegDecoder& decoder = of(common);
      if (common->is_decompressor != 0 && decoder.jpeg.input_scan_number > kMostScans) {
        leave(common);
      }
    };
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  ~JpegDecoder() {
    if (created) jpeg_destroy_decompress(&jpeg);
  }

  static JpegDecoder& of(j_common_ptr common) {
    return *static_cast<JpegDecoder*>(common->client_data);
  }
  [[noreturn]] static void leave(j_common_ptr common) { std::longjmp(of(common).back, 1); }

  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf back{};
  bool created = false;
  bool cut_short = false;
  std::vector<std::uint8_t> samples;  // one row
};

constexpr const char* kDamagedJpeg = "the JPEG is damaged or cut short";

const char* decode_rows(JpegDecoder& decoder, const std::vector<std::uint8_t>& bytes,
                        const PictureVisitor& visitor) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  if (setjmp(decoder.back) != 0) return kDamagedJpeg;
  jpeg_create_decompress(&jpeg);
  decoder.created = true;
  jpeg.client_data = &decoder;
  jpeg.progress = &decoder.progress;
  jpeg_mem_src(&jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
  static_cast<void>(jpeg_read_header(&jpeg, TRUE));
  if (jpeg.num_components != 1 && jpeg.num_components != 3) {
    return "the JPEG has neither grey nor RGB colours";
  }
  jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  if (!visitor.begin(jpeg.image_width, jpeg.image_height)) return "";
  if (jpeg_has_multiple_scans(&jpeg) != 0 &&
      std::size_t{jpeg.image_width} * jpeg.image_height > kMostProgressive) {
    return "the JPEG is progressive and too large: save it as a baseline JPEG";
  }
  static_cast<void>(jpeg_start_decompress(&jpeg));
  const std::size_t stride =
      std::size_t{jpeg.output_width} * static_cast<std::size_t>(jpeg.output_components);
  if (!make_room(decoder.samples, stride)) return "no memory for the JPEG";
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = decoder.samples.data();
    static_cast<void>(jpeg_read_scanlines(&jpeg, &row, 1));
    visitor.row(decoder.samples.data(), jpeg.output_components);
  }
  static_cast<void>(jpeg_finish_decompress(&jpeg));
  return decoder.cut_short ? kDamagedJpeg : "";
}

}  // namespace

std::string decode_jpeg(const std::vector<std::uint8_t>& bytes, const PictureVisitor& visitor) {
  JpegDecoder decoder;
  return decode_rows(decoder, bytes, visitor);
}

}  // namespace sim
