// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// playpen-view TITLE: the window of `playpen run --view`, which starts this program. It shows the
// frames that arrive on its standard input, a socket, and sends keys back
// (playerlike/view/protocol.h).
// playpen-view --check: reports whether there is a display, and its size.
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "key_watch.h"
#include "playerlike/view/protocol.h"
#include "status_bar.h"

namespace {

namespace view = playerlike::view;

constexpr int kSocket = STDIN_FILENO;
constexpr int kTick_ms = 10;
// Maximum picture size. It leaves room on the screen for the window's frame and the desktop's bars.
constexpr int kLargestPicture_px = 900;
constexpr int kRoomBeside_px = 20;
constexpr int kRoomAbove_px = 90;

/// The socket is at its end: the run is over.
struct EndOfRun {};

void send_message(view::ViewerMessageKind kind, std::uint32_t a = 0, std::uint32_t b = 0) {
  const view::ViewerMessage message{.kind = kind, .a = a, .b = b};
  if (send(kSocket, &message, sizeof message, MSG_NOSIGNAL) != sizeof message) throw EndOfRun{};
}

/// Assembles frames from the data of the socket.
class FrameReader {
 public:
  /// Reads the available data, up to the end of a frame.
  /// @return whether the frame is complete.
  bool read_some() {
    for (;;) {
      const bool in_header = got_ < sizeof header_;
      if (!in_header && got_ == total()) return true;
      char* const to = in_header ? reinterpret_cast<char*>(&header_) + got_
                                 : body_.data() + (got_ - sizeof header_);
      const std::size_t wanted = (in_header ? sizeof header_ : total()) - got_;
      const ssize_t count = recv(kSocket, to, wanted, MSG_DONTWAIT);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return false;
      if (count <= 0) throw EndOfRun{};
      got_ += static_cast<std::size_t>(count);
      if (in_header && got_ == sizeof header_) {
        if (!view::is_valid(header_)) throw EndOfRun{};
        body_.resize(view::body_bytes(header_));
      }
    }
  }

  [[nodiscard]] const view::FrameHeader& header() const { return header_; }

  /// The window's picture of the frame, BGR.
  [[nodiscard]] cv::Mat picture() {
    const int width = static_cast<int>(header_.width);
    const int height = static_cast<int>(header_.height);
    cv::Mat all(height + kStatusBarHeight_px, width, CV_8UC3);
    cv::cvtColor(cv::Mat(height, width, CV_8UC3, body_.data()), all.rowRange(0, height),
                 cv::COLOR_RGB2BGR);
    const std::string text(body_.data() + 3 * static_cast<std::size_t>(width) * header_.height,
                           header_.text_bytes);
    draw_status_bar(all.rowRange(height, all.rows),
                    StatusText::parse(text, header_.robot_colour, header_.paused != 0));
    return all;
  }

  /// Prepares for the next frame.
  void next() { got_ = 0; }

 private:
  [[nodiscard]] std::size_t total() const { return sizeof header_ + view::body_bytes(header_); }

  view::FrameHeader header_;
  std::vector<char> body_;
  std::size_t got_ = 0;
};

/// The picture before the first frame.
cv::Mat waiting_picture(int side_px) {
  cv::Mat picture(side_px + kStatusBarHeight_px, side_px, CV_8UC3, cv::Scalar(0xea, 0xef, 0xf1));
  StatusText text;
  text.status = "waiting for the program to connect ...";
  text.robot_colour = 0x808080;
  draw_status_bar(picture.rowRange(side_px, picture.rows), text);
  return picture;
}

bool is_open(const std::string& title) {
  return cv::getWindowProperty(title, cv::WND_PROP_VISIBLE) > 0.0;
}

/// Waits until the window system knows the window.
/// @return whether it does.
bool attach(KeyWatch& keys, const std::string& title) {
  for (int tries = 0; tries < 500; ++tries) {
    cv::waitKey(kTick_ms);
    if (keys.attach(title)) return true;
  }
  return false;
}

void serve(KeyWatch& keys, const std::string& title) {
  FrameReader frames;
  for (;;) {
    std::array<pollfd, 2> polls{pollfd{kSocket, POLLIN, 0}, pollfd{keys.descriptor(), POLLIN, 0}};
    poll(polls.data(), polls.size(), kTick_ms);
    keys.poll(
        [](std::uint32_t keysym, bool pressed, bool control) {
          send_message(view::ViewerMessageKind::kKey, keysym,
                       (pressed ? view::kPressed : 0U) | (control ? view::kControl : 0U));
        },
        [] { send_message(view::ViewerMessageKind::kReleaseAll); });
    const bool whole = frames.read_some();
    if (whole) cv::imshow(title, frames.picture());
    cv::waitKey(1);  // lets highgui process events: it draws the picture
    // imshow would open a closed window again, so check at once.
    if (!is_open(title)) {
      send_message(view::ViewerMessageKind::kClosed);
      return;
    }
    if (whole) {
      send_message(view::ViewerMessageKind::kShown, frames.header().number);
      frames.next();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "playpen-view is started by 'playpen run --view'\n";
    return 2;
  }
  // Ctrl-C in a terminal reaches all processes of the run; this one ends when the run has ended.
  signal(SIGINT, SIG_IGN);
  try {
    const std::string title = argv[1];
    KeyWatch keys;
    if (title == "--check") {  // 'playpen doctor' checks whether there is a display
      std::cout << keys.screen_width_px() << " x " << keys.screen_height_px() << " pixels\n";
      return 0;
    }
    // KeyWatch reads keys from X, so the toolkit must show its window there, and (GTK) must not
    // take events away from other clients. Qt's warnings are meaningless to users.
    setenv("QT_QPA_PLATFORM", "xcb", 1);
    setenv("QT_LOGGING_RULES", "*=false", 0);
    setenv("GDK_BACKEND", "x11", 1);
    setenv("GDK_CORE_DEVICE_EVENTS", "1", 1);
    cv::setNumThreads(1);
    const int side_px = std::min({kLargestPicture_px, keys.screen_width_px() - kRoomBeside_px,
                                  keys.screen_height_px() - kRoomAbove_px - kStatusBarHeight_px});
    if (side_px < static_cast<int>(view::kLeastSide_px)) {
      std::cerr << "playpen-view: the screen is too small\n";
      return 1;
    }
    cv::namedWindow(title, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    cv::imshow(title, waiting_picture(side_px));
    if (!attach(keys, title)) {
      std::cerr << "playpen-view: the window did not appear\n";
      return 1;
    }
    const auto side = static_cast<std::uint32_t>(side_px);
    send_message(view::ViewerMessageKind::kHello, side, side);
    serve(keys, title);
  } catch (const EndOfRun&) {
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "playpen-view: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
