// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Vision: blobfinder, camera, and the pan-tilt-zoom head.
#include <algorithm>
#include <string>
#include <vector>

#include "libplayerc++/blobfinderproxy.h"
#include "libplayerc++/cameraproxy.h"
#include "libplayerc++/ptzproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::copied;
using playerlike::clib::ProxyBacked;
using playerlike::clib::refuse;
using playerlike::clib::with_device;

class Blobfinder final : public ProxyBacked<playerc_blobfinder_t, PlayerCc::BlobfinderProxy> {
  void refresh() override {
    width = proxy_or_throw().GetWidth();
    height = proxy_or_throw().GetHeight();
    blobs_count = proxy_or_throw().GetCount();
    blobs = copied(blobs_, blobs_count, [this](uint32_t i) { return proxy_or_throw().GetBlob(i); });
  }

  std::vector<playerc_blobfinder_blob_t> blobs_;
};

class Camera final : public ProxyBacked<playerc_camera_t, PlayerCc::CameraProxy> {
 public:
  void require_image() const {
    if (image == nullptr) refuse("there is no picture yet");
  }
  void save(const char* file) const {
    require_image();
    if (file == nullptr || !PlayerCc::detail::write_ppm(file, pixels_, pixel_width(), rows())) {
      refuse("the picture " + std::string(file == nullptr ? "" : file) + " cannot be written");
    }
  }
  [[nodiscard]] const std::vector<uint8_t>& pixels() const { return pixels_; }
  [[nodiscard]] uint32_t pixel_width() const { return static_cast<uint32_t>(width); }
  [[nodiscard]] uint32_t rows() const { return static_cast<uint32_t>(height); }

 private:
  void refresh() override {
    width = static_cast<int>(proxy_or_throw().GetWidth());
    height = static_cast<int>(proxy_or_throw().GetHeight());
    bpp = static_cast<int>(proxy_or_throw().GetDepth());
    format = static_cast<int>(proxy_or_throw().GetFormat());
    fdiv = 1;
    compression = static_cast<int>(proxy_or_throw().GetCompression());
    pixels_.resize(proxy_or_throw().GetImageSize());
    if (!pixels_.empty()) proxy_or_throw().GetImage(pixels_.data());
    image_count = static_cast<int>(pixels_.size());
    image = pixels_.empty() ? nullptr : pixels_.data();
  }

  std::vector<uint8_t> pixels_;
};

class Ptz final : public ProxyBacked<playerc_ptz_t, PlayerCc::PtzProxy> {
 public:
  int mode = PLAYER_PTZ_POSITION_CONTROL;
  void refresh_status() { status = proxy_or_throw().GetStatus(); }

 private:
  void refresh() override {
    pan = proxy_or_throw().GetPan();
    tilt = proxy_or_throw().GetTilt();
    zoom = proxy_or_throw().GetZoom();
    refresh_status();
  }
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(blobfinder, Blobfinder, PLAYER_BLOBFINDER_CODE)
PLAYERLIKE_CLIB_FRAME(camera, Camera, PLAYER_CAMERA_CODE)
PLAYERLIKE_CLIB_FRAME(ptz, Ptz, PLAYER_PTZ_CODE)

void playerc_camera_decompress(playerc_camera_t* device) {
  with_device<Camera>(__func__, device, [](Camera& self) { self.require_image(); });
}

void playerc_camera_save(playerc_camera_t* device, const char* filename) {
  with_device<Camera>(__func__, device, [&](Camera& self) { self.save(filename); });
}

int playerc_camera_set_source(playerc_camera_t* device, int /*source*/, const char* /*norm*/) {
  return with_device<Camera>(__func__, device, [](Camera&) {
    refuse("a simulated camera has no sources to choose from");
  });
}

int playerc_camera_get_source(playerc_camera_t* device) {
  return with_device<Camera>(__func__, device, [](Camera&) {
    refuse("a simulated camera has no sources to choose from");
  });
}

int playerc_camera_get_image(playerc_camera_t* device) {
  return with_device<Camera>(__func__, device, [](Camera& self) { self.require_image(); });
}

void playerc_camera_copy_image(playerc_camera_t* device, void* dst, size_t dst_size) {
  with_device<Camera>(__func__, device, [&](Camera& self) {
    self.require_image();
    if (dst == nullptr) refuse("there is no place for the picture: it is a null pointer");
    std::copy_n(self.pixels().data(), std::min(dst_size, self.pixels().size()),
                static_cast<uint8_t*>(dst));
  });
}

unsigned playerc_camera_get_pixel_component(playerc_camera_t* device, unsigned int x,
                                            unsigned int y, int component) {
  unsigned value = 0;
  with_device<Camera>(__func__, device, [&](Camera& self) {
    self.require_image();
    if (x >= self.pixel_width() || y >= self.rows() || component < 0 || component > 2) {
      refuse("there is no pixel " + std::to_string(x) + ", " + std::to_string(y) +
             " with a component " + std::to_string(component));
    }
    value = self.pixels()[3 * (std::size_t{y} * self.pixel_width() + x) +
                          static_cast<std::size_t>(component)];
  });
  return value;
}

int playerc_ptz_set(playerc_ptz_t* device, double pan, double tilt, double zoom) {
  return with_device<Ptz>(__func__, device,
                          [&](Ptz& self) { self.proxy_or_throw().SetCam(pan, tilt, zoom); });
}

int playerc_ptz_query_status(playerc_ptz_t* device) {
  return with_device<Ptz>(__func__, device, [](Ptz& self) { self.refresh_status(); });
}

int playerc_ptz_set_ws(playerc_ptz_t* device, double pan, double tilt, double zoom, double panspeed,
                       double tiltspeed) {
  return with_device<Ptz>(__func__, device, [&](Ptz& self) {
    if (self.mode == PLAYER_PTZ_VELOCITY_CONTROL) {
      self.proxy_or_throw().SetSpeed(panspeed, tiltspeed);
    } else {
      self.proxy_or_throw().SetCam(pan, tilt, zoom, panspeed, tiltspeed);
    }
  });
}

int playerc_ptz_set_control_mode(playerc_ptz_t* device, int mode) {
  return with_device<Ptz>(__func__, device, [&](Ptz& self) {
    self.proxy_or_throw().SelectControlMode(static_cast<uint32_t>(mode));
    self.mode = mode;
  });
}
