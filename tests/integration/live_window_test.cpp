// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen run --view` on a separate display (Xvfb), with keys from xdotool; the tests check the
// window's content. Both programs are required: without them these tests fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "patience.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"
// Included last: X11's headers define macros with common names.
#include "x_window.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::Screenshot;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kBarHeight_px = 74;
// Longer than ctest's time limit.
constexpr std::chrono::hours kServerLimit{24};

/// Two robots in a room of 2 m x 2 m, without lasers, whose fans would tint the picture. The first
/// robot is orange, the second blue.
std::string two_robots(const std::string& view_mode = "ground", bool locked = false) {
  const json devices = {{"laser", nullptr}};
  const json world = {
      {"name", "window"},
      {"arena", {{"size", {2.0, 2.0}}}},
      {"canvas", {{"size", {100, 100}}, {"view_mode", view_mode}, {"lock_view_mode", locked}}},
      {"robots",
       {{{"name", "r1"},
         {"colour", "#ff8800"},
         {"pose", {{"x", 0.4}, {"y", 1.0}, {"yaw_deg", 0.0}}},
         {"devices", devices}},
        {{"name", "r2"},
         {"colour", "#2060ff"},
         {"pose", {{"x", 1.0}, {"y", 0.4}, {"yaw_deg", 0.0}}},
         {"devices", devices}}}}};
  return world.dump();
}

bool is_green(const Screenshot::Pixel& p) { return p.g > p.r + 80 && p.g > p.b + 80; }
constexpr Screenshot::Pixel kOrange{0xff, 0x88, 0x00};
constexpr Screenshot::Pixel kBlue{0x20, 0x60, 0xff};
bool is_border(const Screenshot::Pixel& p) { return p == Screenshot::Pixel{0x8c, 0x5e, 0x3c}; }

/// A display without a screen.
class XServer {
 public:
  XServer()
      // -noreset: the server does not restart after the last window of a test has closed. A restart
      // takes time, and clients that connect meanwhile may be disconnected.
      : server_({"Xvfb", "-displayfd", "1", "-noreset", "-screen", "0", "900x900x24", "-nolisten",
                 "tcp"},
                {.environment = {}, .folder = {}, .timeout = kServerLimit}) {
    if (!server_.read_until("\n")) throw std::runtime_error("Xvfb does not start (install xvfb)");
    name_ = ":" + server_.output().substr(0, server_.output().find('\n'));
  }
  ~XServer() {
    server_.send_signal(SIGTERM);  // unlike SIGKILL, this lets it remove its files
    static_cast<void>(server_.finish());
  }
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  Process server_;
  std::string name_;
};

class LiveWindow : public testing::Test {
 protected:
  static void SetUpTestSuite() { server = std::make_unique<XServer>(); }
  static void TearDownTestSuite() { server.reset(); }

  void SetUp() override {
    if (waited_in_vain) GTEST_SKIP() << "a test before waited in vain: this one might as well";
  }

  void open(const std::string& world_text = two_robots(),
            const std::vector<std::string>& view = {"--view"}) {
    const std::string world = folder.write("window.json", world_text);
    const ProcessOptions options{
        // Toolkits leak on purpose; leak checks of sanitizer builds are off for them.
        .environment = {{"DISPLAY", server->name()}, {"ASAN_OPTIONS", "detect_leaks=0"}},
        .folder = folder.path().string()};
    std::vector<std::string> call = {PLAYPEN_COMMAND, "run",        world, "--out",
                                     "out",           "--duration", "3600"};
    call.insert(call.end(), view.begin(), view.end());
    call.insert(call.end(), {"--", WINDOW_PROGRAM});
    run = std::make_unique<Process>(call, options);
    wait_until("the window is there", [&] {
      window = display.find("Playpen: window").value_or(None);
      return window != None;
    });
    wait_until("the program's picture is shown",
               [&] { return shot().share([](const auto& p) { return is_green(p); }) > 0.005; });
    // There is no window manager to give it the focus. The toolkit may also do it, but later.
    wait_until("the window has the keyboard", [&] {
      if (display.has_focus(window)) return true;
      display.focus(window);
      return false;
    });
  }

  void wait_until(const std::string& what, const std::function<bool()>& is_so) {
    const auto deadline = std::chrono::steady_clock::now() + test_support::patience();
    while (!is_so()) {
      if (std::chrono::steady_clock::now() > deadline) {
        waited_in_vain = true;
        throw std::runtime_error("waited in vain until " + what + "\n" + what_is_there());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  /// Presses a key until the window shows a message that disappears after a moment. On a loaded
  /// machine the message may have disappeared before the test looks.
  void press_until(const std::string& key, const std::string& what,
                   const std::function<bool()>& is_so) {
    wait_until(what, [&] {
      press(key);
      return is_so();
    });
  }

  /// Describes the window's content, for a failed test. Ends the run.
  [[nodiscard]] std::string what_is_there() {
    std::ostringstream text;
    if (const auto seen = display.capture(window)) {
      const auto [orange_x, orange_y] = middle_of(kOrange);
      const auto [blue_x, blue_y] = middle_of(kBlue);
      const Screenshot::Pixel bar = status_line().at(2, 2);
      text << "the window " << (display.has_focus(window) ? "has" : "does not have")
           << " the keyboard and shows " << seen->width << " x " << seen->height << " pixels, "
           << 100.0 * green() << " % of the picture green, orange at " << orange_x << ", "
           << orange_y << ", blue at " << blue_x << ", " << blue_y << ", status bar " << bar.r
           << ' ' << bar.g << ' ' << bar.b << "; ";
    } else {
      text << "no window can be seen; ";
    }
    const ProcessResult result = run->kill_now();
    text << "the run had ";
    if (result.status) {
      text << "ended with status " << *result.status;
    } else {
      text << "to be killed";
    }
    text << "\n--- its output\n" << result.out << "--- its errors\n" << result.err;
    return text.str();
  }

  void xdotool(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "xdotool");
    const ProcessResult result = test_support::run_process(
        arguments, {.environment = {{"DISPLAY", server->name()}}, .folder = {}});
    ASSERT_EQ(result.status, 0) << "xdotool (is it installed?): " << result.err;
  }
  void press(const std::string& key) const {
    ASSERT_TRUE(display.has_focus(window)) << "the keyboard is not with the window";
    xdotool({"key", key});
  }

  /// The window's current content.
  [[nodiscard]] Screenshot shot() const {
    auto captured = display.capture(window);
    if (!captured) throw std::runtime_error("the window has gone");
    return *std::move(captured);
  }
  [[nodiscard]] Screenshot picture() const {
    const Screenshot all = shot();
    return all.rows(0, all.height - kBarHeight_px);
  }
  /// The line with robot, time, speed and mode.
  [[nodiscard]] Screenshot status_line() const {
    const Screenshot all = shot();
    return all.rows(all.height - kBarHeight_px, all.height - kBarHeight_px + 32);
  }
  [[nodiscard]] double green() const {
    return picture().share([](const auto& p) { return is_green(p); });
  }
  [[nodiscard]] Screenshot::Pixel robot_dot() const { return status_line().at(20, 18); }

  /// Whether the bar has the colour of a paused run.
  [[nodiscard]] bool paused() const {
    return status_line().at(2, 2) == Screenshot::Pixel{0x63, 0x44, 0x20};
  }
  void pause() {
    press("space");
    wait_until("the run is paused", [&] { return paused(); });
  }

  /// Centre of the pixels with this colour in the picture; (-1, -1) if there are none.
  [[nodiscard]] std::pair<double, double> middle_of(const Screenshot::Pixel& colour) const {
    const Screenshot all = picture();
    double x_sum = 0.0;
    double y_sum = 0.0;
    int count = 0;
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        if (!(all.at(x, y) == colour)) continue;
        x_sum += x;
        y_sum += y;
        ++count;
      }
    }
    if (count == 0) return {-1.0, -1.0};
    return {x_sum / count, y_sum / count};
  }
  [[nodiscard]] double orange_x() const { return middle_of(kOrange).first; }

  /// Waits for the run's end. The run must succeed and have a report.
  json finished_run() {
    const ProcessResult result = run->finish();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("continues without")));
    // The process has ended, but the X server may not have noticed yet.
    wait_until("the window has gone", [&] { return !display.find("Playpen: window"); });
    return read_report(folder / "out");
  }

  static std::unique_ptr<XServer> server;
  static bool waited_in_vain;
  const TemporaryFolder folder;
  const test_support::XDisplay display{server->name()};
  std::unique_ptr<Process> run;
  Window window = None;
};

std::unique_ptr<XServer> LiveWindow::server;
bool LiveWindow::waited_in_vain = false;

TEST_F(LiveWindow, ShowsArenaCanvasAndRobots) {
  open();
  // On a screen of 900 x 900, the picture is square like the arena: at most 900 - 90 - 74.
  const Screenshot all = shot();
  EXPECT_LE(all.height, 900 - 90);
  EXPECT_GT(all.width, 600);
  // The floor takes most of the picture; the program has painted all but a 25th of it green.
  EXPECT_GT(green(), 0.6);
  EXPECT_GT(picture().share([](const auto& p) { return is_border(p); }), 0.01);
  // r1 stands at 0.4 m of 2 m, left of the centre.
  EXPECT_GT(orange_x(), 0.1 * all.width);
  EXPECT_LT(orange_x(), 0.4 * all.width);
  press("q");
  finished_run();
}

TEST_F(LiveWindow, Lockstep_SameRunAsWithoutWindow) {
  const std::string world = folder.write("window.json", two_robots());
  const ProcessOptions options{
      .environment = {{"DISPLAY", server->name()}, {"ASAN_OPTIONS", "detect_leaks=0"}},
      .folder = folder.path().string()};
  const auto files = [&](const std::string& out, const std::vector<std::string>& view) {
    std::vector<std::string> call = {PLAYPEN_COMMAND, "run",        world, "--quiet", "--time",
                                     "lockstep",      "--duration", "21",  "--out",   out};
    call.insert(call.end(), view.begin(), view.end());
    call.insert(call.end(), {"--", WINDOW_PROGRAM});
    const ProcessResult result = test_support::run_process(call, options);
    EXPECT_EQ(result.status, 0) << result.err;
    return test_support::files_of_run(folder / out);
  };
  test_support::expect_equal_files(files("viewed", {"--view", "--record-from", "20"}),
                                   files("plain", {}));
}

TEST_F(LiveWindow, Keys_SpacePausesAndSSavesPicture) {
  folder.write("out/view_000001.png", "of an earlier run, which makes room for ours");
  open();
  pause();
  const Screenshot first = shot();
  press_until("s", "the message is shown", [&] {
    return !(status_line() ==
             first.rows(first.height - kBarHeight_px, first.height - kBarHeight_px + 32));
  });
  // Only the message has changed; the picture, with the time in its corner, is unchanged.
  EXPECT_TRUE(picture() == first.rows(0, first.height - kBarHeight_px));

  const cv::Mat saved = cv::imread(folder / "out/view_000001.png", cv::IMREAD_COLOR);
  const Screenshot shown = picture();
  ASSERT_EQ(saved.cols, shown.width);
  ASSERT_EQ(saved.rows, shown.height);
  int different = 0;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      const auto& bgr = saved.at<cv::Vec3b>(y, x);
      if (!(shown.at(x, y) == Screenshot::Pixel{bgr[2], bgr[1], bgr[0]})) ++different;
    }
  }
  EXPECT_EQ(different, 0);

  press("space");
  wait_until("time goes on", [&] { return !paused() && !(picture() == shown); });
  press("q");
  finished_run();
}

TEST_F(LiveWindow, UntilTime_PausesThere) {
  open(two_robots(), {"--until", "600", "--then", "view"});  // ten minutes at full speed
  wait_until("the run pauses", [&] { return paused(); });
  press("q");
  EXPECT_EQ(finished_run().at("run").at("sim_time"), 600.0);
}

TEST_F(LiveWindow, CtrlArrows_ChangeViewMode) {
  open();
  const double on_the_floor = green();
  press("ctrl+Down");
  // The canvas is a small picture in a corner; the floor is empty.
  wait_until("the canvas is a mini-map", [&] { return green() < 0.3; });
  EXPECT_GT(green(), 0.005);
  EXPECT_GT(picture().share([](const auto& p) { return is_border(p); }), 0.01);
  press("ctrl+Down");
  wait_until("the canvas is there instead of the arena", [&] { return green() > 0.5; });
  EXPECT_EQ(picture().share([](const auto& p) { return is_border(p); }), 0.0);
  EXPECT_GT(orange_x(), 0.0);  // the robots stand on the floor
  press("ctrl+Up");
  press("ctrl+Up");
  wait_until("the canvas lies on the floor",
             [&] { return std::abs(green() - on_the_floor) < 0.01 && orange_x() > 0.0; });
  press("q");
  finished_run();
}

TEST_F(LiveWindow, LockedViewMode_Stays) {
  open(two_robots("full-screen", true));
  pause();
  const Screenshot before = shot();
  press_until("ctrl+Down", "the window says why not", [&] { return !(shot() == before); });
  EXPECT_TRUE(picture() == before.rows(0, before.height - kBarHeight_px));
  press("q");
  finished_run();
}

TEST_F(LiveWindow, HeldKey_DrivesRobot) {
  open();
  const double start_px = orange_x();
  xdotool({"keydown", "w"});
  // 0.5 m/s: 0.5 m are a quarter of the floor, in the picture some 150 pixels.
  wait_until("the robot has moved", [&] { return orange_x() > start_px + 100.0; });
  xdotool({"keyup", "w"});
  double last_px = -1.0;
  wait_until("the robot stands", [&] {
    const double before_px = std::exchange(last_px, orange_x());
    return before_px == last_px;
  });
  xdotool({"keydown", "Down"});
  wait_until("the robot has come back", [&] {
    const double x = orange_x();
    return x >= 0.0 && x < last_px - 20.0;
  });
  xdotool({"keyup", "Down"});
  press("q");
  const json report = finished_run();
  EXPECT_GT(report["robots"][0]["path_length"].get<double>(), 0.3);
  EXPECT_EQ(report["robots"][1]["path_length"], 0.0);
}

TEST_F(LiveWindow, Tab_SelectsRobotThatArrowsDrive) {
  open();
  EXPECT_EQ(robot_dot(), kOrange);
  // The middle fifth of the picture: it contains r1, but neither r2 nor the clock in the footer.
  const auto round_r1 = [this] {
    const Screenshot all = picture();
    return all.rows(all.height * 2 / 5, all.height * 3 / 5);
  };
  const Screenshot r1_marked = round_r1();
  press("Tab");
  wait_until("the other robot is chosen", [&] { return robot_dot() == kBlue; });
  EXPECT_FALSE(round_r1() == r1_marked);

  // The robot faces right: to move up in the picture it must turn and drive. Its lateral position
  // varies: it turns on the spot until the second key arrives, and circles until the test sees it.
  const double start_y = middle_of(kBlue).second;
  xdotool({"keydown", "Left", "keydown", "Up"});
  wait_until("the robot drives a bow to its left", [&] {
    const double y = middle_of(kBlue).second;
    return y >= 0.0 && y < start_y - 20.0;
  });
  xdotool({"keyup", "Left", "keyup", "Up"});
  press("q");
  const json report = finished_run();
  EXPECT_EQ(report["robots"][0]["path_length"], 0.0);
  EXPECT_GT(report["robots"][1]["path_length"].get<double>(), 0.0);
}

TEST_F(LiveWindow, PlusMinus_ChangeShownSpeed) {
  open();
  pause();
  const Screenshot once = status_line();
  press("plus");
  wait_until("another speed is shown", [&] { return !(status_line() == once); });
  const Screenshot twice = status_line();
  press("plus");
  wait_until("a third speed is shown", [&] {
    const Screenshot now = status_line();
    return !(now == once) && !(now == twice);
  });
  press("minus");
  wait_until("the second speed is back", [&] { return status_line() == twice; });
  press("KP_Subtract");
  wait_until("the first speed is back", [&] { return status_line() == once; });
  press("q");
  finished_run();
}

TEST_F(LiveWindow, Help_CanBeHidden) {
  open();
  const auto help = [&] {
    const Screenshot all = shot();
    return all.rows(all.height - kBarHeight_px + 34, all.height);
  };
  const Screenshot with_help = help();
  EXPECT_GT(with_help.share([](const auto& p) { return p.r > 0x80; }), 0.01);
  press("h");
  wait_until("the help is hidden",
             [&] { return help().share([](const auto& p) { return p.r > 0x80; }) == 0.0; });
  press("F1");
  wait_until("the help is back", [&] { return help() == with_help; });
  press("Escape");
  finished_run();
}

TEST_F(LiveWindow, ClosedWindow_EndsRunWithResults) {
  open();
  display.ask_to_close(window);
  const json report = finished_run();
  EXPECT_GT(report["run"]["sim_time"].get<double>(), 0.0);
  EXPECT_TRUE(fs::exists(folder / "out/scene.png"));
}

TEST_F(LiveWindow, PausedRun_EndsOnCtrlC) {
  open();
  pause();
  run->send_signal(SIGINT);
  finished_run();
}

// --- No window
// ----------------------------------------------------------------------------------

/// A run with --view for which no window can be opened.
class NoWindow : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& prefix, const std::string& command,
                    const std::vector<std::string>& options = {}) {
    std::vector<std::string> call = prefix;
    call.insert(call.end(), {command, "run", folder.write("window.json", two_robots()), "--view",
                             "--out", folder / "out"});
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", WINDOW_PROGRAM, folder / "started"});
    return test_support::run_process(call);
  }
  void expect_not_started(const ProcessResult& result) {
    EXPECT_EQ(result.status, 2);
    EXPECT_FALSE(fs::exists(folder / "started"));
    EXPECT_EQ(result.out, "");
  }

  const TemporaryFolder folder;
};

TEST_F(NoWindow, NoDisplay_ErrorSuggestsFilm) {
  const ProcessResult result =
      run({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY"}, PLAYPEN_COMMAND);
  expect_not_started(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr("DISPLAY"), HasSubstr("--record film.mp4")));
}

TEST_F(NoWindow, WaylandOnly_ErrorSaysThatXIsNeeded) {
  const ProcessResult result =
      run({"env", "-u", "DISPLAY", "WAYLAND_DISPLAY=wayland-0"}, PLAYPEN_COMMAND);
  expect_not_started(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr("Xwayland"), HasSubstr("--record film.mp4")));
}

TEST_F(NoWindow, UnreachableDisplay_Error) {
  // No server can have this number: X's port would be above 65535.
  const ProcessResult result = run({"env", "DISPLAY=:60000"}, PLAYPEN_COMMAND);
  expect_not_started(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr(":60000"), HasSubstr("--record film.mp4")));
}

TEST_F(NoWindow, MissingViewer_Error) {
  const std::string command = folder.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  const ProcessResult result = run({"env", "DISPLAY=:60000"}, command);
  expect_not_started(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr("playpen-view is missing"), HasSubstr("--record")));
}

// --- What programs load
// -------------------------------------------------------------------------

TEST(WindowToolkit, LoadedByViewerProcessOnly) {
  const auto libraries = [](const std::string& program) {
    const ProcessResult result = test_support::run_process({"ldd", program});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  for (const char* program : {PLAYPEN_COMMAND, WINDOW_PROGRAM}) {
    EXPECT_THAT(libraries(program), AllOf(HasSubstr("libbox2d"), Not(HasSubstr("opencv")),
                                          Not(HasSubstr("libQt")), Not(HasSubstr("libgtk"))))
        << program;
  }
  EXPECT_THAT(libraries(VIEW_PROGRAM), HasSubstr("highgui"));
}

}  // namespace
