// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgproc.hpp>

#include "render/modules/module_interface.h"

#ifdef PLAYPEN_FREETYPE
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#endif

namespace {

using sim::render::modules::OutlineSink;

#ifdef PLAYPEN_FREETYPE

// Paths of the font on Debian and Ubuntu, Fedora and Arch, and after a manual installation.
constexpr const char* kFontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/local/share/fonts/DejaVuSans.ttf",
    "/Library/Fonts/DejaVuSans.ttf",
};
constexpr double kCapHeight = 1493.0;  // height of a capital letter of DejaVu Sans [font units]

/// The font. Outlines are read unscaled and without hinting, so they do not depend on the version
/// of FreeType.
class Font {
 public:
  Font() {
    if (FT_Init_FreeType(&library_) != 0) return;
    for (const char* const file : kFontFiles) {
      if (FT_New_Face(library_, file, 0, &face_) == 0) return;
      face_ = nullptr;
    }
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() {
    if (face_ != nullptr) FT_Done_Face(face_);
    if (library_ != nullptr) FT_Done_FreeType(library_);
  }

  bool outline(std::uint32_t code_point, const OutlineSink& sink, double* advance) {
    if (face_ == nullptr) return false;
    const FT_UInt glyph = FT_Get_Char_Index(face_, code_point);
    if (glyph == 0 || FT_Load_Glyph(face_, glyph, FT_LOAD_NO_SCALE) != 0 ||
        face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE) {
      return false;
    }
    *advance = static_cast<double>(face_->glyph->metrics.horiAdvance) / kCapHeight;
    FT_Outline_Funcs functions{};
    functions.move_to = [](const FT_Vector* to, void* user) {
      const auto& told = *static_cast<const OutlineSink*>(user);
      told.start(told.context, units(to->x), units(to->y));
      return 0;
    };
    functions.line_to = [](const FT_Vector* to, void* user) {
      const auto& told = *static_cast<const OutlineSink*>(user);
      told.line(told.context, units(to->x), units(to->y));
      return 0;
    };
    functions.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* user) {
      const auto& told = *static_cast<const OutlineSink*>(user);
      told.curve(told.context, units(control->x), units(control->y), units(to->x), units(to->y));
      return 0;
    };
    // TrueType fonts contain only parabolas.
    functions.cubic_to = [](const FT_Vector*, const FT_Vector*, const FT_Vector*, void*) {
      return 1;
    };
    OutlineSink copy = sink;
    return FT_Outline_Decompose(&face_->glyph->outline, &functions, &copy) == 0;
  }

 private:
  static double units(FT_Pos position) { return static_cast<double>(position) / kCapHeight; }

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

// FreeType is not thread-safe, so each thread has its own font. A handler of std::atexit() may draw
// a picture after the destruction of the main thread's variables. The font is then loaded again.
thread_local Font* font = nullptr;
struct FontOwner {
  FontOwner() = default;
  FontOwner(const FontOwner&) = delete;
  FontOwner& operator=(const FontOwner&) = delete;
  ~FontOwner() {
    delete font;
    font = nullptr;
  }
  void load() const {
    if (font == nullptr) font = new Font;
  }
};
thread_local FontOwner owner;

bool outline(std::uint32_t code_point, const OutlineSink& sink, double* advance) {
  owner.load();
  return font->outline(code_point, sink, advance);
}

#else

bool outline(std::uint32_t /*code_point*/, const OutlineSink& /*sink*/, double* /*advance*/) {
  return false;
}

#endif

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

int width(const char* text, double scale, int stroke) {
  try {
    int baseline = 0;
    return cv::getTextSize(text, kFont, scale, stroke, &baseline).width;
  } catch (const std::exception&) {
    return 0;
  }
}

bool draw(const char* text, int x, int y, double scale, int stroke, std::uint8_t* raster, int width,
          int height) {
  try {
    cv::Mat picture(height, width, CV_8UC1, raster);
    cv::putText(picture, text, {x, y}, kFont, scale, cv::Scalar(255), stroke, cv::LINE_AA);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const sim::render::modules::TextFunctions*
playpen_text_functions() {
  static const sim::render::modules::TextFunctions kFunctions = {PLAYPEN_VERSION, &width, &draw,
                                                                 &outline};
  return &kFunctions;
}
