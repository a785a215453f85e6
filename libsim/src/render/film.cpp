// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cinttypes>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "render/modules/module_file.h"
#include "sim/core/replace_file.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

[[noreturn]] void refuse_film(const std::string& path, const std::string& reason) {
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

namespace fs = std::filesystem;

enum class FilmKind { kMp4, kAvi, kPictures };

std::optional<FilmKind> kind_of(const std::string& path) {
  if (path.empty()) return std::nullopt;
  std::error_code error;
  if (path.ends_with('/') || fs::is_directory(path, error)) return FilmKind::kPictures;
  const std::string ending = lower_case_ending(path);
  if (ending == ".mp4") return FilmKind::kMp4;
  if (ending == ".avi") return FilmKind::kAvi;
  return ending.empty() ? std::optional(FilmKind::kPictures) : std::nullopt;
}

FilmKind required_kind_of(const std::string& path) {
  const std::optional<FilmKind> kind = kind_of(path);
  if (kind) return *kind;
  refuse_film(path, path.empty() ? "it has no name"
                                 : "unknown ending \"" + lower_case_ending(path) +
                                       "\", expected .mp4, .avi, or none for a folder of pictures");
}

// Whether a file has the name of a frame, e.g. frame_000001.png.
bool is_frame(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view kStart = "frame_";
  constexpr std::string_view kEnd = ".png";
  if (!name.starts_with(kStart) || !name.ends_with(kEnd)) return false;
  const std::string digits = name.substr(kStart.size(), name.size() - kStart.size() - kEnd.size());
  return digits.size() >= 6 && digits.find_first_not_of("0123456789") == std::string::npos;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

struct FilmWriter::Impl {
  explicit Impl(std::string name) : path(std::move(name)) {}
  virtual ~Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void add(const Image& frame) {
    if (frame.rgb.size() !=
        3 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height)) {
      refuse_film(path, "a frame has not as many pixels as its size says");
    }
    if (frame_count == 0) {
      frame_width = frame.width;
      frame_height = frame.height;
    } else if (frame.width != frame_width || frame.height != frame_height) {
      refuse_film(path, "a frame is " + size_text(frame.width, frame.height) +
                            " pixels, those before were " + size_text(frame_width, frame_height));
    }
    write(frame);
    ++frame_count;
  }

  /// Completes the film and checks whether it is complete on disk.
  virtual void finish() {}
  /// Number of bytes written to the disk so far.
  [[nodiscard]] virtual std::uint64_t size() const = 0;

  std::string path;
  std::uint64_t frame_count = 0;
  int frame_width = 0;
  int frame_height = 0;

 private:
  /// Writes a frame of the same size as the previous ones.
  virtual void write(const Image& frame) = 0;
};

namespace {

const modules::FilmFunctions& film_functions(const std::string& path) {
  try {
    return modules::film_functions();
  } catch (const std::runtime_error& error) {
    refuse_film(path, error.what());
  }
}

class Video final : public FilmWriter::Impl {
 public:
  Video(const std::string& name, double frames_per_second, FilmKind kind)
      : Impl(name),
        functions_(film_functions(name)),
        frames_per_second_(frames_per_second),
        kind_(kind),
        part_(name) {
    // Opening the file here gives the reason of a failure before the run instead of after it.
    struct stat info {};
    // A pipe or a device cannot be replaced by a file.
    if (lstat(path.c_str(), &info) != 0 || S_ISREG(info.st_mode)) part_ = part_file_name(path);
    errno = 0;
    if (!std::ofstream(part_, std::ios::binary | std::ios::trunc)) {
      refuse_film(path, errno != 0 ? std::strerror(errno) : "unknown reason");
    }
  }
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;
  ~Video() override {
    try {
      finish();
    } catch (const std::exception&) {
      // Callers who need the error call finish().
    }
    if (frame_count == 0) std::remove(part_.c_str());  // without frames, leave no empty file
  }

  [[nodiscard]] std::uint64_t size() const override {
    std::error_code error;
    const std::uint64_t size = fs::file_size(finished_ ? path : part_, error);
    return error ? 0 : size;
  }

  void finish() override {
    if (std::exchange(finished_, true) || encoder_ == nullptr) return;
    const bool is_whole = functions_.close(encoder_, problem_.data(), problem_.size());
    if (frame_count == 0) return;
    if (!is_whole) {
      // It cannot be played, and its disk space may be needed.
      if (part_ != path) std::remove(part_.c_str());
      refuse_film(path, std::string("it is not whole: ") + problem_.data());
    }
    if (part_ == path) return;
    if (const int error = rename_part_file(path)) refuse_film(path, std::strerror(error));
  }

 private:
  void open(const Image& frame) {
    const int width = frame.width & ~1;
    const int height = frame.height & ~1;
    if (width < 2 || height < 2) {
      refuse_film(path,
                  "a frame of " + size_text(frame.width, frame.height) + " pixels is too small");
    }
    encoder_ = functions_.open(part_.c_str(), kind_ == FilmKind::kAvi, frames_per_second_, width,
                               height, problem_.data(), problem_.size());
    if (encoder_ == nullptr) refuse_film(path, problem_.data());
  }

  void write(const Image& frame) override {
    if (frame_count == 0) open(frame);
    if (!functions_.add(encoder_, frame.rgb.data(), 3 * static_cast<std::size_t>(frame.width),
                        problem_.data(), problem_.size())) {
      refuse_film(path, problem_.data());
    }
  }

  const modules::FilmFunctions& functions_;
  double frames_per_second_;
  FilmKind kind_;
  std::string part_;  // temporary name while it is written; renamed when complete
  bool finished_ = false;
  modules::FilmEncoder* encoder_ = nullptr;  // opened with the first frame, which determines the
                                             // size
  std::array<char, 1024> problem_{};
};

class Pictures final : public FilmWriter::Impl {
 public:
  explicit Pictures(const std::string& name) : Impl(name) {
    std::error_code error;
    made_ = fs::create_directories(path, error);
    if (error || !fs::is_directory(path, error)) {
      refuse_film(path, error ? error.message() : "it is there, and no folder");
    }
    try {
      for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
        if (is_frame(entry.path())) fs::remove(entry.path());
      }
    } catch (const fs::filesystem_error& problem) {
      refuse_film(path, problem.code().message());
    }
  }
  ~Pictures() override {
    std::error_code ignored;
    if (made_ && frame_count == 0) fs::remove(path, ignored);
  }

  [[nodiscard]] std::uint64_t size() const override { return size_; }

 private:
  void write(const Image& frame) override {
    const std::uint64_t number = frame_count + 1;
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%06" PRIu64 ".png", number);
    const fs::path file = fs::path(path) / name.data();
    write_png(frame, file.string());
    std::error_code error;
    const std::uint64_t size = fs::file_size(file, error);
    if (!error) size_ += size;
  }

  std::uint64_t size_ = 0;
  bool made_ = false;
};

}  // namespace

FilmWriter::FilmWriter(const std::string& path, double frames_per_second) {
  const FilmKind kind = required_kind_of(path);
  if (!(frames_per_second >= 1.0 && frames_per_second <= 1000.0)) {
    refuse_film(path, "frames per second must be in 1..1000");
  }
  if (kind == FilmKind::kPictures) {
    impl_ = std::make_unique<Pictures>(path);
  } else {
    impl_ = std::make_unique<Video>(path, frames_per_second, kind);
  }
}

bool FilmWriter::is_film_name(const std::string& path) { return kind_of(path).has_value(); }

FilmWriter::~FilmWriter() = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;

void FilmWriter::add(const Image& frame) { impl_->add(frame); }

std::uint64_t FilmWriter::size() const { return impl_->size(); }

void FilmWriter::finish() { impl_->finish(); }

}  // namespace sim::render
