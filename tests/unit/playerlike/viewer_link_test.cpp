// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The connection to a window; the test acts as the viewer.
#include "host/window/viewer_link.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "fake_viewer.h"
#include "patience.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using test_support::FakeViewer;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using view::ViewerMessageKind;

/// A run in which nothing moves; records the events that it receives.
class FakeRun final : public ViewedRun {
 public:
  FakeRun() : scene_(sim::Simulation(sim::load_world("")).snapshot()) {}

  ViewScene view_scene() override {
    const std::lock_guard lock(mutex_);
    ++scenes_;
    ViewScene view;
    view.scene = scene_;
    view.status = "all is well";
    view.help = {"one", "two"};
    view.robot_colour = 0x102030;
    view.finished = finished_;
    return view;
  }
  std::string on_key(std::uint32_t keysym, bool pressed, bool control) override {
    note(std::string(control ? "ctrl+" : "") + static_cast<char>(keysym) + (pressed ? "v" : "^"));
    return keysym == 's' ? save_to : "";
  }
  void on_keys_released() override { note("released"); }
  void on_saved(const std::string& /*file*/, const std::string& problem) override {
    note("saved " + problem);
  }
  void on_closed() override { note("closed"); }
  void on_lost(const std::string& reason) override { note("lost: " + reason); }

  void finish() {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  [[nodiscard]] int scenes() const {
    const std::lock_guard lock(mutex_);
    return scenes_;
  }
  /// Waits until this many events have arrived. @return all of them.
  [[nodiscard]] std::vector<std::string> told(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, test_support::patience(), [&] { return told_.size() >= count; });
    return told_;
  }

  std::string save_to;
  const sim::SceneSnapshot& scene() const { return scene_; }

 private:
  void note(const std::string& what) {
    const std::lock_guard lock(mutex_);
    told_.push_back(what);
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  sim::SceneSnapshot scene_;
  std::vector<std::string> told_;
  int scenes_ = 0;
  bool finished_ = false;
};

class ViewerLinkTest : public testing::Test {
 protected:
  FakeViewer viewer;
  FakeRun run;
  std::unique_ptr<ViewerLink> link = std::make_unique<ViewerLink>(viewer.socket_for_run(), run);
};

TEST_F(ViewerLinkTest, Scene_SentInRequestedSize) {
  viewer.hello(300);
  const auto frame = viewer.show();
  ASSERT_TRUE(frame);
  const sim::render::Image image = sim::render::draw_view(run.scene(), {.size_px = 300});
  EXPECT_EQ(frame->header.number, 1U);
  EXPECT_EQ(frame->header.width, static_cast<std::uint32_t>(image.width));
  EXPECT_EQ(frame->header.height, static_cast<std::uint32_t>(image.height));
  EXPECT_TRUE(frame->rgb == std::string(image.rgb.begin(), image.rgb.end()));
  EXPECT_EQ(frame->text, "all is well\n\none\ntwo\n");
  EXPECT_EQ(frame->header.robot_colour, 0x102030U);
  EXPECT_EQ(frame->header.paused, 0U);
}

TEST_F(ViewerLinkTest, NextPicture_DrawnAfterLastIsShown) {
  viewer.hello();
  const auto first = viewer.receive();
  ASSERT_TRUE(first);
  // A number that is not that of the frame does not count.
  viewer.say(ViewerMessageKind::kShown, first->header.number + 1);
  for (std::uint32_t i = 0; i < 5; ++i) {
    viewer.press('k');
    ASSERT_EQ(run.told(i + 1).size(), i + 1);
  }
  EXPECT_EQ(run.scenes(), 1);
  viewer.say(ViewerMessageKind::kShown, first->header.number);
  const auto second = viewer.receive();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->header.number, 2U);
}

TEST_F(ViewerLinkTest, BeforeWindowOpens_DrawsNothing) {
  viewer.press('k');
  EXPECT_THAT(run.told(1), ElementsAre("kv"));
  EXPECT_EQ(run.scenes(), 0);
}

TEST_F(ViewerLinkTest, InvalidSizes_Clamped) {
  viewer.hello(0);
  const auto frame = viewer.show();
  ASSERT_TRUE(frame);
  EXPECT_EQ(std::max(frame->header.width, frame->header.height), view::kLeastSide_px);
}

TEST_F(ViewerLinkTest, Messages_JoinedFromPieces) {
  const std::string bytes =
      FakeViewer::bytes_of(
          {.kind = ViewerMessageKind::kKey, .a = 'a', .b = view::kPressed | view::kControl}) +
      FakeViewer::bytes_of({.kind = ViewerMessageKind::kKey, .a = 'a', .b = 0}) +
      FakeViewer::bytes_of({.kind = ViewerMessageKind::kReleaseAll});
  for (const char byte : bytes) viewer.send_bytes(std::string(1, byte));
  EXPECT_THAT(run.told(3), ElementsAre("ctrl+av", "a^", "released"));
}

TEST_F(ViewerLinkTest, InvalidMessage_ClosesLink) {
  viewer.hello();
  ASSERT_TRUE(viewer.show());
  viewer.send_bytes(std::string(1000, 'x'));
  EXPECT_THAT(run.told(1), ElementsAre(HasSubstr("invalid message")));
  while (viewer.receive()) {
  }
  SUCCEED() << "the connection was closed";
}

TEST_F(ViewerLinkTest, UnknownMessage_ClosesLink) {
  viewer.say(static_cast<ViewerMessageKind>(99));
  EXPECT_THAT(run.told(1), ElementsAre(HasSubstr("invalid message")));
}

TEST_F(ViewerLinkTest, DeadViewer_Detected) {
  viewer.hello();
  ASSERT_TRUE(viewer.show());
  viewer.die();
  EXPECT_THAT(run.told(1), ElementsAre(HasSubstr("lost: ")));
  link.reset();
  EXPECT_EQ(run.told(1).size(), 1U);
}

TEST_F(ViewerLinkTest, ViewerThatDiesInMessage_Detected) {
  viewer.send_bytes("PPV1");
  viewer.die();
  EXPECT_THAT(run.told(1), ElementsAre(HasSubstr("lost: ")));
}

TEST_F(ViewerLinkTest, ClosedWindow_DistinguishedFromDeadViewer) {
  viewer.say(ViewerMessageKind::kClosed);
  viewer.die();
  EXPECT_THAT(run.told(1), ElementsAre("closed"));
  link.reset();
  EXPECT_EQ(run.told(1).size(), 1U);
}

TEST_F(ViewerLinkTest, ViewerThatReadsNothing_DoesNotBlockEnd) {
  // 800 x 870 x 3 bytes exceed a socket's buffer: the frame is sent only in part.
  viewer.hello(800);
  viewer.press('k');
  ASSERT_THAT(run.told(1), ElementsAre("kv"));
  link.reset();
  EXPECT_LE(run.scenes(), 1);
}

TEST_F(ViewerLinkTest, EndOfRun_ShowsLastPictureAndCloses) {
  viewer.hello();
  ASSERT_TRUE(viewer.show());
  run.finish();
  while (viewer.show()) {
  }
  EXPECT_GE(run.scenes(), 2);
  link.reset();
  EXPECT_THAT(run.told(0), IsEmpty());
}

TEST_F(ViewerLinkTest, Picture_SavedAsShown) {
  const test_support::TemporaryFolder folder;
  run.save_to = folder / "view.png";
  viewer.hello();
  const auto frame = viewer.receive();
  ASSERT_TRUE(frame);
  viewer.press('s');
  ASSERT_THAT(run.told(2), ElementsAre("sv", "saved "));
  const sim::render::Image shown{static_cast<int>(frame->header.width),
                                 static_cast<int>(frame->header.height),
                                 {frame->rgb.begin(), frame->rgb.end()}};
  sim::render::write_png(shown, folder / "expected.png");
  EXPECT_TRUE(test_support::read_bytes(folder / "view.png") ==
              test_support::read_bytes(folder / "expected.png"));
}

TEST_F(ViewerLinkTest, UnwritablePicture_Explained) {
  run.save_to = "/no/such/folder/view.png";
  viewer.press('s');
  EXPECT_THAT(run.told(2), ElementsAre("sv", HasSubstr("nothing is shown")));
  viewer.hello();
  ASSERT_TRUE(viewer.show());
  viewer.press('s');
  EXPECT_THAT(run.told(4), ElementsAre("sv", HasSubstr("nothing"), "sv", HasSubstr("/no/such")));
}

TEST(ViewerLinkSocket, NotInheritedByChildren) {
  FakeViewer viewer;
  const int socket = viewer.socket_for_run();
  fcntl(socket, F_SETFD, 0);
  FakeRun run;
  const ViewerLink link(socket, run);
  EXPECT_NE(fcntl(socket, F_GETFD) & FD_CLOEXEC, 0);
}

TEST(ViewerLinkSocket, OtherDescriptors_Refused) {
  FakeRun run;
  EXPECT_THROW(ViewerLink(-1, run), std::runtime_error);
  EXPECT_THROW(ViewerLink(STDERR_FILENO, run), std::runtime_error);
}

}  // namespace
}  // namespace playerlike
