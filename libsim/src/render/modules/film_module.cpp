// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "render/modules/module_interface.h"
#include "render/modules/yuv_converter.h"

namespace sim::render::modules {
namespace {

// Why a call of FFmpeg has failed, which it says by a negative number; empty if it has not.
std::string problem_of(int result, const std::string& what) {
  if (result >= 0) return "";
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  return what + ": " + text.data();
}

void require(int result, const std::string& what) {
  const std::string problem = problem_of(result, what);
  if (!problem.empty()) throw std::runtime_error(problem);
}

template <typename T>
T* made(T* thing, const char* name) {
  if (thing == nullptr) throw std::runtime_error(std::string("no memory for ") + name);
  return thing;
}

struct Free {
  void operator()(AVFormatContext* file) const {
    avio_closep(&file->pb);
    avformat_free_context(file);
  }
  void operator()(AVCodecContext* encoder) const { avcodec_free_context(&encoder); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

// Browsers play H.264. FFmpeg may be built without it.
const AVCodec* codec_of(bool motion_jpeg) {
  if (motion_jpeg) return avcodec_find_encoder(AV_CODEC_ID_MJPEG);
  const AVCodec* const h264 = avcodec_find_encoder_by_name("libx264");
  return h264 != nullptr ? h264 : avcodec_find_encoder(AV_CODEC_ID_MPEG4);
}

}  // namespace

struct FilmEncoder {
  FilmEncoder(const char* path, bool motion_jpeg, double frames_per_second, int width, int height)
      : converter_(width, height, motion_jpeg) {
    const AVCodec* const codec = codec_of(motion_jpeg);
    if (codec == nullptr) throw std::runtime_error("FFmpeg has no encoder for it on this computer");
    AVFormatContext* made_file = nullptr;
    require(avformat_alloc_output_context2(&made_file, nullptr, motion_jpeg ? "avi" : "mp4", path),
            "FFmpeg cannot make such a file");
    file_.reset(made_file);
    encoder_.reset(made(avcodec_alloc_context3(codec), "an encoder"));
    encoder_->width = width;
    encoder_->height = height;
    constexpr int kMostParts = 60'000;  // a file of MPEG-4 Part 2 has 16 bits for its unit of time
    encoder_->framerate = av_d2q(frames_per_second, kMostParts);
    encoder_->time_base = {encoder_->framerate.den, encoder_->framerate.num};
    encoder_->pix_fmt = motion_jpeg ? AV_PIX_FMT_YUVJ420P : AV_PIX_FMT_YUV420P;
    encoder_->color_range = motion_jpeg ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    encoder_->colorspace = AVCOL_SPC_SMPTE170M;  // BT.601, as below
    // A step waits for its frame, and a second thread of the encoder keeps frames of its own.
    encoder_->thread_count = 1;
    encoder_->log_level_offset = AV_LOG_TRACE;  // errors are returned; nothing else is printed
    if ((file_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    AVDictionary* options = nullptr;
    if (codec->id == AV_CODEC_ID_H264) {
      // What more search would find is not in films of drawings (docs/decisions/speed.md).
      av_dict_set(&options, "preset", "veryfast", 0);
      av_dict_set(&options, "crf", "23", 0);
      av_dict_set(&options, "x264-params", "subme=1:bframes=0:weightp=0:rc-lookahead=7", 0);
    } else {
      encoder_->flags |= AV_CODEC_FLAG_QSCALE;
      encoder_->global_quality = 3 * FF_QP2LAMBDA;
    }
    const int opened = avcodec_open2(encoder_.get(), codec, &options);
    av_dict_free(&options);
    require(opened, "FFmpeg's encoder cannot be started");
    stream_ = made(avformat_new_stream(file_.get(), codec), "a stream");
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    require(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()), "no parameters");
    require(avio_open(&file_->pb, path, AVIO_FLAG_WRITE), "the file cannot be opened");
    require(avformat_write_header(file_.get(), nullptr), "the file's begin cannot be written");
    frame_.reset(made(av_frame_alloc(), "a frame"));
    frame_->format = encoder_->pix_fmt;
    frame_->width = width;
    frame_->height = height;
    frame_->quality = encoder_->global_quality;
    require(av_frame_get_buffer(frame_.get(), 0), "no memory for a frame");
    packet_.reset(made(av_packet_alloc(), "a packet"));
  }

  /// Adds a frame. After a frame that could not be written (is the disk full?), further ones are
  /// dropped: finish() throws the reason.
  void add(const std::uint8_t* rgb, std::size_t stride) {
    if (!problem_.empty()) return;
    require(av_frame_make_writable(frame_.get()), "no memory for a frame");
    converter_.convert(rgb, stride,
                       {{frame_->data[0], frame_->data[1], frame_->data[2]},
                        {frame_->linesize[0], frame_->linesize[1], frame_->linesize[2]}});
    frame_->pts = frames_++;
    require(avcodec_send_frame(encoder_.get(), frame_.get()), "a frame cannot be encoded");
    write_packets();
  }

  void finish() {
    require(avcodec_send_frame(encoder_.get(), nullptr), "the last frames cannot be encoded");
    write_packets();
    if (!problem_.empty()) throw std::runtime_error(problem_);
    require(av_write_trailer(file_.get()), "the file's end cannot be written");
    require(avio_closep(&file_->pb), "the file cannot be written");
  }

 private:
  void write_packets() {
    for (;;) {
      const int result = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      require(result, "a frame cannot be encoded");
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      problem_ = problem_of(av_interleaved_write_frame(file_.get(), packet_.get()),
                            "a frame cannot be written");
      if (!problem_.empty()) return;
    }
  }

  Owned<AVFormatContext> file_;
  Owned<AVCodecContext> encoder_;
  AVStream* stream_ = nullptr;  // owned by file_
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  YuvConverter converter_;
  std::int64_t frames_ = 0;
  std::string problem_;  // why the file ends before the film
};

namespace {

// Calls a function, and writes what it throws into `problem`.
template <typename Function>
bool tried(const Function& function, char* problem, std::size_t problem_size) {
  try {
    function();
    return true;
  } catch (const std::exception& error) {
    std::snprintf(problem, problem_size, "%s", error.what());
    return false;
  }
}

FilmEncoder* open(const char* path, bool motion_jpeg, double frames_per_second, int width,
                  int height, char* problem, std::size_t problem_size) {
  FilmEncoder* film = nullptr;
  tried([&] { film = new FilmEncoder(path, motion_jpeg, frames_per_second, width, height); },
        problem, problem_size);
  return film;
}

bool add(FilmEncoder* film, const std::uint8_t* rgb, std::size_t stride, char* problem,
         std::size_t problem_size) {
  return tried([&] { film->add(rgb, stride); }, problem, problem_size);
}

bool close(FilmEncoder* film, char* problem, std::size_t problem_size) {
  const std::unique_ptr<FilmEncoder> owned(film);
  return tried([&] { film->finish(); }, problem, problem_size);
}

}  // namespace
}  // namespace sim::render::modules

extern "C" __attribute__((visibility("default"))) const sim::render::modules::FilmFunctions*
playpen_film_functions() {
  namespace modules = sim::render::modules;
  static const modules::FilmFunctions kFunctions = {PLAYPEN_VERSION, &modules::open, &modules::add,
                                                    &modules::close};
  return &kFunctions;
}
