// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A paced run with a window; the test acts as the viewer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <thread>

#include "fake_viewer.h"
#include "patience.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using test_support::FakeViewer;
using testing::HasSubstr;
using testing::Not;
using view::ViewerMessageKind;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kDown = 0xff54;
constexpr std::uint32_t kTab = 0xff09;

struct NewestPose : ReadingSink {
  void on_reading(DeviceId /*device*/, const sim::SharedReading& reading) override {
    if (const auto* p = dynamic_cast<const sim::PoseReading*>(reading.get())) pose = p->pose;
  }
  sim::Pose pose;
};

class ViewedHostTest : public testing::Test {
 protected:
  static sim::WorldDescription world(const std::string& canvas = "{}", double factor = 1.0) {
    return sim::load_world_text(R"({"name": "two", "arena": {"size": [20, 4]}, "canvas": )" +
                                canvas + R"(, "simulation": {"time": )" +
                                sim::shortest_text(factor) +
                                R"(}, "robots": [{"name": "r1", "pose": {"x": 5, "y": 1}},
                         {"name": "r2", "pose": {"x": 5, "y": 3}}]})");
  }
  void start(sim::WorldDescription description = world()) {
    RunSettings settings;
    settings.view_socket = viewer.socket_for_run();
    settings.output_folder = folder / "out";
    host = Host::create(std::move(description), std::move(settings),
                        [this](sim::LogLevel, std::string_view text) {
                          const std::lock_guard lock(log_mutex);
                          log += std::string(text) + '\n';
                          logged.notify_all();
                        });
    session = host->connect(6665);
    position = find_interface(session->robots(), session->port(), "position2d", 0);
    session->request(SubscribeRequest{position.reading});
    viewer.hello();
  }
  void TearDown() override {
    session.reset();
    host.reset();
  }
  // One Read() of the program; returns the robot's pose.
  sim::Pose read() {
    NewestPose newest;
    session->wait();
    static_cast<void>(session->take(newest));
    return newest.pose;
  }
  // Shows frames until the text of one contains the words.
  FakeViewer::Frame show_until(const std::string& words) const {
    for (;;) {
      const auto frame = viewer.show();
      if (!frame) throw std::runtime_error("the run closed the window before: " + words);
      if (frame->text.find(words) != std::string::npos) return *frame;
    }
  }
  std::string wait_for_log(const std::string& words) {
    std::unique_lock lock(log_mutex);
    logged.wait_for(lock, test_support::patience(),
                    [&] { return log.find(words) != std::string::npos; });
    return log;
  }
  sim::SimTime now_ns() const { return host->time().sim_time_ns; }

  const test_support::TemporaryFolder folder;
  FakeViewer viewer;
  std::shared_ptr<Host> host;
  std::unique_ptr<Session> session;
  InterfaceBinding position;
  std::mutex log_mutex;
  std::condition_variable logged;
  std::string log;
};

TEST_F(ViewedHostTest, ShowsRobotTimeSpeedAndMode) {
  start();
  const FakeViewer::Frame frame = show_until("r1");
  EXPECT_THAT(frame.text, HasSubstr("x 1 "));
  EXPECT_THAT(frame.text, HasSubstr("ground"));
  EXPECT_THAT(frame.text, HasSubstr("Space"));  // the help
  EXPECT_EQ(frame.header.robot_colour, 0xff8800U);
  viewer.press('h');
  while (show_until("r1").text.find("Space") != std::string::npos) {
  }
}

TEST_F(ViewedHostTest, Space_PausesAndContinues) {
  start();
  read();
  viewer.press(' ');
  while (show_until("r1").header.paused == 0) {
  }
  const sim::SimTime stopped_ns = now_ns();
  // Ten frames take a third of a second, in which 33 steps would be due.
  for (int i = 0; i < 10; ++i) EXPECT_THAT(show_until("r1").text, HasSubstr("paused"));
  EXPECT_EQ(now_ns(), stopped_ns);
  viewer.release(' ');
  viewer.press(' ');
  read();
  EXPECT_GT(now_ns(), stopped_ns);
}

TEST_F(ViewedHostTest, Pause_NotCaughtUp) {
  start();
  read();
  viewer.press(' ');
  while (show_until("r1").header.paused == 0) {
  }
  const sim::SimTime stopped_ns = now_ns();
  for (int i = 0; i < 15; ++i) static_cast<void>(show_until("paused"));  // half a second
  const auto resumed = Clock::now();
  viewer.press(' ');
  read();
  read();
  const double simulated_s = sim::to_seconds(now_ns() - stopped_ns);
  const double wall_s = std::chrono::duration<double>(Clock::now() - resumed).count();
  // At factor 1, simulated time is never ahead of wall time, except by one step that was in
  // progress.
  EXPECT_LE(simulated_s, wall_s + 0.02);
}

TEST_F(ViewedHostTest, SpeedChanges_NeverRunAhead) {
  start();
  read();
  const auto begin = Clock::now();
  const sim::SimTime begin_ns = now_ns();
  // Ten times faster and slower again: never above x 2, so never more than twice the wall time.
  for (int i = 0; i < 10; ++i) {
    viewer.press('+');
    static_cast<void>(show_until("x 2 "));
    viewer.press('-');
    static_cast<void>(show_until("x 1 "));
  }
  const double simulated_s = sim::to_seconds(now_ns() - begin_ns);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  EXPECT_LE(simulated_s, 2.0 * wall_s + 0.04);
  EXPECT_GT(simulated_s, 0.0);
}

TEST_F(ViewedHostTest, Speed_Bounded) {
  start(world("{}", 64.0));
  viewer.press('+');
  static_cast<void>(show_until("no faster than x 64"));
}

TEST_F(ViewedHostTest, Keys_DriveRobotAgainstProgram) {
  start(world("{}", 8.0));
  const auto stand_still = [&] {
    session->send(position.motion.value(), sim::TwistCommand{});
    return read();
  };
  const double x_m = stand_still().x_m;
  viewer.press('w');
  while (stand_still().x_m < x_m + 0.5) {
  }
  static_cast<void>(show_until("by hand"));
  viewer.release('w');
  sim::Pose last = stand_still();
  // The robot stands after the first round without motion.
  for (sim::Pose next = stand_still(); next != last; next = stand_still()) last = next;
  SUCCEED();
}

TEST_F(ViewedHostTest, Tab_SelectsNextRobot) {
  start();
  viewer.press(kTab);
  static_cast<void>(show_until("r2"));
  viewer.press(kTab);
  static_cast<void>(show_until("r1"));
}

TEST_F(ViewedHostTest, CtrlArrows_ChangeViewMode) {
  start();
  const FakeViewer::Frame ground = show_until("ground");
  viewer.press(kDown, true);
  static_cast<void>(show_until("mini-map"));
  viewer.press(kDown, true);
  static_cast<void>(show_until("full-screen"));
  viewer.press(kDown, true);
  static_cast<void>(show_until("ground"));
  viewer.press(0xff52, true);
  static_cast<void>(show_until("full-screen"));
}

TEST_F(ViewedHostTest, LockedViewMode_StaysWithMessage) {
  start(world(R"({"view_mode": "full-screen", "lock_view_mode": true})"));
  viewer.press(kDown, true);
  const FakeViewer::Frame frame = show_until("lock");
  EXPECT_THAT(frame.text, HasSubstr("full-screen"));
  EXPECT_THAT(frame.text, Not(HasSubstr("ground\n")));
}

TEST_F(ViewedHostTest, Pictures_NumberedWithoutReplacingOthers) {
  start();
  static_cast<void>(show_until("r1"));
  folder.write("out/view_000001.png", "of somebody else");
  viewer.press('s');
  static_cast<void>(show_until("saved view_000002.png"));
  viewer.press('s');
  static_cast<void>(show_until("saved view_000003.png"));
  EXPECT_EQ(test_support::read_bytes(folder / "out/view_000001.png"), "of somebody else");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/view_000003.png"));
}

TEST_F(ViewedHostTest, ClosedWindow_EndsRunWithResults) {
  start();
  read();
  viewer.say(ViewerMessageKind::kClosed);
  EXPECT_THROW(
      {
        for (;;) read();
      },
      SessionError);
  EXPECT_TRUE(host->finished());
  EXPECT_TRUE(std::filesystem::exists(folder / "out/report.json"));
}

TEST_F(ViewedHostTest, Q_EndsRunAlsoDuringPause) {
  start();
  viewer.press(' ');
  static_cast<void>(show_until("paused"));
  viewer.press('q');
  while (viewer.show()) {
  }
  EXPECT_TRUE(host->finished());
}

TEST_F(ViewedHostTest, DeadViewer_RunContinues) {
  start();
  viewer.press(' ');
  static_cast<void>(show_until("paused"));
  viewer.die();
  EXPECT_THAT(wait_for_log("continues"), HasSubstr("the window is lost"));
  const sim::SimTime before_ns = now_ns();
  read();
  read();
  EXPECT_GT(now_ns(), before_ns);
}

TEST_F(ViewedHostTest, HangingViewer_RunContinues) {
  start();
  viewer.hello(800);
  const sim::SimTime before_ns = now_ns();
  for (int i = 0; i < 5; ++i) read();
  EXPECT_GE(now_ns() - before_ns, 4 * sim::kNanosecondsPerSecond / 10);
}

TEST_F(ViewedHostTest, InvalidMessage_RunContinues) {
  start();
  viewer.send_bytes("this is no message of a viewer");
  EXPECT_THAT(wait_for_log("continues"), HasSubstr("invalid message"));
  read();
  read();
}

// A run in lockstep with a window or without one, by a program of one thread.
class WatchedLockstep : public testing::Test {
 protected:
  void start(RunSettings settings) {
    host = Host::create(sim::load_world(""), std::move(settings));
    session = host->connect(6665);
    const auto position = find_interface(session->robots(), session->port(), "position2d", 0);
    motors = position.motion.value();
    session->request(SubscribeRequest{position.reading});
  }
  void start_watched(double from_s = 0.0) {
    RunSettings settings;
    settings.view_socket = viewer.socket_for_run();
    settings.film_from_s = from_s;
    start(std::move(settings));
    viewer.hello();
  }
  void drive(int reads) const {
    NewestPose newest;
    for (int i = 0; i < reads; ++i) {
      session->wait();
      static_cast<void>(session->take(newest));
      session->send(motors, sim::TwistCommand{{.v_mps = 0.2, .omega_radps = 0.1 * i}});
    }
  }
  std::string shown_with(const std::string& words) const {
    std::string text;
    while (text.find(words) == std::string::npos) text = viewer.show().value().text;
    return text;
  }
  void TearDown() override {
    session.reset();
    host.reset();
  }

  FakeViewer viewer;
  std::shared_ptr<Host> host;
  std::unique_ptr<Session> session;
  DeviceId motors;
};

TEST_F(WatchedLockstep, SameRunAtSpeedOfViewers) {
  start({});
  drive(5);
  const std::uint64_t hash = host->state_hash();
  const sim::SimTime end_ns = host->now_ns();
  TearDown();
  const auto begin = Clock::now();
  start_watched();
  drive(5);
  EXPECT_EQ(host->state_hash(), hash);
  EXPECT_EQ(host->now_ns(), end_ns);
  EXPECT_EQ(host->time().mode, sim::TimeMode::kLockstep);
  EXPECT_TRUE(host->time().unrepeatable.empty());
  // The first step is due at once.
  EXPECT_GE(std::chrono::duration<double>(Clock::now() - begin).count(),
            sim::to_seconds(end_ns) - 0.02);
  EXPECT_THAT(shown_with("lockstep"), HasSubstr("x 1 "));
}

TEST_F(WatchedLockstep, BeforeView_FullSpeed) {
  // Ten minutes, in which a run at the viewers' speed would exceed all patience.
  start_watched(600.0);
  drive(100);
  EXPECT_THAT(shown_with("lockstep"), HasSubstr("full speed"));
}

TEST_F(WatchedLockstep, PauseAndSpeed_Work) {
  start_watched();
  viewer.press(' ');
  static_cast<void>(shown_with("paused"));
  const sim::SimTime paused_ns = host->now_ns();
  viewer.press('+');
  static_cast<void>(shown_with("x 2 "));
  EXPECT_EQ(host->now_ns(), paused_ns);
  viewer.press(' ');
  drive(2);
  EXPECT_GT(host->now_ns(), paused_ns);
}

TEST_F(WatchedLockstep, StopAtTime_PausedAfterFullSpeed) {
  RunSettings settings;
  settings.view_socket = viewer.socket_for_run();
  settings.stop = {600.0, RunStop::Then::kView};
  start(std::move(settings));
  viewer.hello();
  std::thread program([this] { drive(6010); });  // ten minutes and one second
  static_cast<void>(shown_with("paused"));
  EXPECT_EQ(host->now_ns(), 600 * sim::kNanosecondsPerSecond);
  viewer.press(' ');
  program.join();
  EXPECT_GT(host->now_ns(), 600 * sim::kNanosecondsPerSecond);
}

TEST_F(WatchedLockstep, ClosedWindow_FullSpeed) {
  start_watched();
  for (int i = 0; i < 4; ++i) viewer.press('-');
  static_cast<void>(shown_with("x 0.0625"));
  viewer.press(' ');
  static_cast<void>(shown_with("paused"));
  viewer.die();
  drive(600);  // a minute, which would take 16
  EXPECT_GE(host->now_ns(), 59 * sim::kNanosecondsPerSecond);
}

TEST(ViewedHost, ChildPrograms_DoNotInheritWindow) {
  const FakeViewer viewer;
  setenv("PLAYPEN_VIEW", std::to_string(viewer.socket_for_run()).c_str(), 1);
  {
    const std::unique_ptr<Session> session = open_session("localhost", 6665);
    EXPECT_EQ(std::getenv("PLAYPEN_VIEW"), nullptr);
    viewer.hello();
    EXPECT_TRUE(viewer.show());
  }
  close_embedded_hosts();
}

TEST(ViewedHost, InvalidDescriptor_Refused) {
  for (const char* text : {"two", "-1", "2", "7x"}) {
    setenv("PLAYPEN_VIEW", text, 1);
    EXPECT_THROW(static_cast<void>(RunSettings::from_environment()), sim::ConfigError) << text;
  }
  unsetenv("PLAYPEN_VIEW");
}

}  // namespace
}  // namespace playerlike
