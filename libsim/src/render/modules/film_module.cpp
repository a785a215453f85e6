// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/videoio.hpp>
#include <vector>

#include "render/modules/module_interface.h"

namespace sim::render::modules {

struct FilmEncoder {
  cv::VideoWriter writer;
  cv::Mat bgr;  // a frame in OpenCV's order of channels
};

}  // namespace sim::render::modules

namespace {

using sim::render::modules::FilmEncoder;

struct Codec {
  int api;
  int name;
};

// Browsers play H.264. FFmpeg may be built without it, and OpenCV without FFmpeg.
std::vector<Codec> codecs(bool motion_jpeg) {
  const int h264 = cv::VideoWriter::fourcc('a', 'v', 'c', '1');
  const int mpeg4 = cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  const int mjpg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  if (motion_jpeg) return {{cv::CAP_FFMPEG, mjpg}, {cv::CAP_ANY, mjpg}};
  return {{cv::CAP_FFMPEG, h264}, {cv::CAP_FFMPEG, mpeg4}, {cv::CAP_ANY, mpeg4}};
}

FilmEncoder* open(const char* path, bool motion_jpeg, double frames_per_second, int width,
                  int height, char* problem, std::size_t problem_size) {
  try {
    auto film = std::make_unique<FilmEncoder>();
    film->bgr.create(height, width, CV_8UC3);
    for (const Codec& codec : codecs(motion_jpeg)) {
      if (film->writer.open(path, codec.api, codec.name, frames_per_second, {width, height})) {
        return film.release();
      }
    }
    std::snprintf(problem, problem_size, "OpenCV has no encoder for it on this computer");
  } catch (const std::exception& error) {
    std::snprintf(problem, problem_size, "%s", error.what());
  }
  return nullptr;
}

bool add(FilmEncoder* film, const std::uint8_t* rgb, std::size_t stride, char* problem,
         std::size_t problem_size) {
  // Channels are swapped here, because cv::cvtColor may use OpenCV's thread pool.
  for (int y = 0; y < film->bgr.rows; ++y) {
    const std::uint8_t* in = rgb + static_cast<std::size_t>(y) * stride;
    std::uint8_t* out = film->bgr.ptr(y);
    for (int x = 0; x < film->bgr.cols; ++x, in += 3, out += 3) {
      out[0] = in[2];
      out[1] = in[1];
      out[2] = in[0];
    }
  }
  try {
    film->writer.write(film->bgr);
    return true;
  } catch (const std::exception& error) {
    std::snprintf(problem, problem_size, "%s", error.what());
    return false;
  }
}

void close(FilmEncoder* film) { delete film; }

}  // namespace

extern "C" __attribute__((visibility("default"))) const sim::render::modules::FilmFunctions*
playpen_film_functions() {
  static const sim::render::modules::FilmFunctions kFunctions = {PLAYPEN_VERSION, &open, &add,
                                                                 &close};
  return &kFunctions;
}
