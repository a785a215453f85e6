// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/viewer_link.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace playerlike {

ViewerLink::ViewerLink(int socket, ViewedRun& run) : FrameLink(socket, "the window"), run_(run) {
  start();
}

ViewerLink::~ViewerLink() { stop(); }

bool ViewerLink::handle_messages(std::string& received, bool& garbage) {
  while (const auto message = view::take_message(received, garbage)) {
    if (!handle(*message)) return false;
  }
  return true;
}

bool ViewerLink::handle(const view::ViewerMessage& message) {
  switch (message.kind) {
    case view::ViewerMessageKind::kHello: {
      const auto side =
          std::clamp(std::min(message.a, message.b), view::kLeastSide_px, view::kGreatestSide_px);
      renderer_.emplace(sim::render::RenderOptions{.size_px = static_cast<int>(side)});
      break;
    }
    case view::ViewerMessageKind::kShown:
      // Only a frame that was sent completely can be on the screen.
      if (message.a == number_ && is_sent() && shown_ != number_) {
        shown_ = number_;
        run_.on_shown();
      }
      break;
    case view::ViewerMessageKind::kKey: {
      const std::string file = run_.on_key(message.a, (message.b & view::kPressed) != 0,
                                           (message.b & view::kControl) != 0);
      if (!file.empty()) save_picture(file);
      break;
    }
    case view::ViewerMessageKind::kReleaseAll:
      run_.on_keys_released();
      break;
    case view::ViewerMessageKind::kClosed:
      run_.on_closed();
      return false;
  }
  return true;
}

std::string ViewerLink::make_frame() {
  const ViewScene view = run_.view_scene();
  image_ = renderer_->draw(view.scene);
  last_frame_ = view.finished;
  std::string text = view.status + '\n' + view.message + '\n';
  for (const std::string& line : view.help) text += line + '\n';
  text.resize(std::min<std::size_t>(text.size(), view::kGreatestText));
  const view::FrameHeader header{.number = ++number_,
                                 .width = static_cast<std::uint32_t>(image_.width),
                                 .height = static_cast<std::uint32_t>(image_.height),
                                 .text_bytes = static_cast<std::uint32_t>(text.size()),
                                 .robot_colour = view.robot_colour,
                                 .paused = view.paused ? 1U : 0U};
  std::string frame(sizeof header, '\0');
  std::memcpy(frame.data(), &header, sizeof header);
  frame.append(image_.rgb.begin(), image_.rgb.end());
  return frame + text;
}

void ViewerLink::save_picture(const std::string& file) {
  try {
    if (image_.rgb.empty()) throw std::runtime_error("nothing is shown yet");
    sim::render::write_png(image_, file);
    run_.on_saved(file, "");
  } catch (const std::exception& error) {
    run_.on_saved(file, error.what());
  }
}

}  // namespace playerlike
