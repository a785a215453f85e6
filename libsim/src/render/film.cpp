// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>

#include "sim/render/render.h"

namespace sim::render {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write the film: " + reason);
}

std::string lower_case_ending(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') return "";
  std::string ending = path.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

int fourcc_of(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".mp4") return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  if (ending == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  fail(path, ending.empty() ? "its name must end in .mp4 or .avi"
                            : "unknown ending \"" + ending + "\", expected .mp4 or .avi");
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

struct FilmWriter::Impl {
  std::string path;
  double frames_per_second = 0.0;
  int fourcc = 0;
  int frame_width = 0;  // as given; the film's own size is `bgr`'s
  int frame_height = 0;
  cv::Mat bgr;
  cv::VideoWriter writer;  // opened with the first frame, which tells the size

  ~Impl() {
    writer.release();
    if (frame_width == 0) std::remove(path.c_str());  // no film: leave no empty file
  }

  void open(const Image& frame) {
    const int width = frame.width & ~1;
    const int height = frame.height & ~1;
    if (width < 2 || height < 2) {
      fail(path, "a frame of " + size_text(frame.width, frame.height) + " pixels is too small");
    }
    // FFmpeg encodes on this thread with these codecs; OpenCV's own writer of MJPG would use its
    // pool of threads, and is the second choice where OpenCV was built without FFmpeg.
    const cv::Size size(width, height);
    try {
      if (!writer.open(path, cv::CAP_FFMPEG, fourcc, frames_per_second, size)) {
        writer.open(path, fourcc, frames_per_second, size);
      }
    } catch (const cv::Exception& error) {
      fail(path, error.what());
    }
    if (!writer.isOpened()) fail(path, "OpenCV has no encoder for it on this computer");
    frame_width = frame.width;
    frame_height = frame.height;
    bgr.create(height, width, CV_8UC3);
  }

  void add(const Image& frame) {
    if (frame.rgb.size() !=
        3 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height)) {
      fail(path, "a frame has not as many pixels as its size says");
    }
    if (frame_width == 0) open(frame);
    if (frame.width != frame_width || frame.height != frame_height) {
      fail(path, "a frame is " + size_text(frame.width, frame.height) +
                     " pixels, those before were " + size_text(frame_width, frame_height));
    }
    for (int y = 0; y < bgr.rows; ++y) {
      const std::uint8_t* rgb = frame.rgb.data() + 3 * static_cast<std::size_t>(y) *
                                                       static_cast<std::size_t>(frame.width);
      std::uint8_t* out = bgr.ptr(y);
      for (int x = 0; x < bgr.cols; ++x, rgb += 3, out += 3) {
        out[0] = rgb[2];
        out[1] = rgb[1];
        out[2] = rgb[0];
      }
    }
    try {
      writer.write(bgr);
    } catch (const cv::Exception& error) {
      fail(path, error.what());
    }
  }
};

FilmWriter::FilmWriter(const std::string& path, double frames_per_second) {
  const int fourcc = fourcc_of(path);
  if (!(frames_per_second >= 1.0 && frames_per_second <= 1000.0)) {
    fail(path, "frames per second must be in 1..1000");
  }
  // OpenCV only says that it failed. Opening the file here tells why, and before a run, not after.
  errno = 0;
  if (!std::ofstream(path, std::ios::binary | std::ios::trunc)) {
    fail(path, errno != 0 ? std::strerror(errno) : "unknown reason");
  }
  impl_ = std::make_unique<Impl>();
  impl_->path = path;
  impl_->frames_per_second = frames_per_second;
  impl_->fourcc = fourcc;
}

FilmWriter::~FilmWriter() = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;

void FilmWriter::add(const Image& frame) { impl_->add(frame); }

}  // namespace sim::render
