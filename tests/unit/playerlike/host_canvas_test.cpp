// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The canvas and its layers over a host: drawings, their order, and the lifetime of layers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "patient_host.h"
#include "playerlike/host/event_client.h"
#include "playerlike/host/host.h"
#include "playerlike/host/kept_results.h"
#include "reachable_host.h"
#include "sim/core/number_text.h"
#include "sim/io/map_file.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using nlohmann::json;
using sim::CellValue;
using sim::Colour;
using sim::DrawOperation;
using sim::LayerId;
using sim::LayerKind;
using std::chrono::milliseconds;

constexpr Colour kRed{255, 0, 0, 255};
constexpr Colour kBlue{0, 0, 255, 255};

sim::WorldDescription two_robots(const std::string& more = "") {
  return sim::load_world_text(
      R"({"name": "two", "arena": {"size": [2, 1], "obstacles": [
           {"name": "box", "type": "static", "center": [1.5, 0.5], "size": [0.2, 0.2]}]},
          "canvas": {"size": [100, 50], "cell_size": 0.02)" +
      more +
      R"(}, "robots": [{"name": "r1", "pose": {"x": 0.3, "y": 0.3}},
                       {"name": "r2", "pose": {"x": 0.3, "y": 0.7}}]})");
}

sim::LayerStyle named(const std::string& name) {
  sim::LayerStyle style;
  style.name = name;
  return style;
}

void dot(Session& session, int column, int row, Colour colour, LayerId layer = sim::kBaseLayer) {
  DrawOperation operation;
  operation.layer = layer;
  operation.x0 = column;
  operation.y0 = row;
  operation.value = CellValue::of(colour);
  session.draw({&operation, 1});
}

Colour at(Session& session, int column, int row, LayerId layer = sim::kBaseLayer) {
  const auto value = session.request(CellRequest{layer, column, row});
  EXPECT_TRUE(value.has_value());
  return value ? value->colour() : Colour{};
}

Colour composed_at(Session& session, int column, int row) {
  const std::vector<std::uint8_t> rgba = session.request(CanvasImageRequest{}).rgba;
  const std::size_t i =
      4 * static_cast<std::size_t>(row * session.request(CanvasInfoRequest{}).width + column);
  return {rgba.at(i), rgba.at(i + 1), rgba.at(i + 2), rgba.at(i + 3)};
}

template <typename Action>
std::optional<SessionError::Code> refusal(Action action) {
  try {
    action();
  } catch (const SessionError& e) {
    return e.code();
  }
  return std::nullopt;
}
class HostCanvas : public testing::TestWithParam<test::Transport> {
 protected:
  std::shared_ptr<test::ReachableHost> create(sim::WorldDescription world,
                                              RunSettings settings = {}) {
    hosts.push_back(std::make_shared<test::ReachableHost>(
        test::patient_host(std::move(world), std::move(settings)), GetParam()));
    return hosts.back();
  }

  std::vector<std::shared_ptr<test::ReachableHost>> hosts;
};

INSTANTIATE_TEST_SUITE_P(Transports, HostCanvas,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor,
                                         test::Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

constexpr auto kBadArgument = SessionError::Code::kBadArgument;
constexpr auto kNotAvailable = SessionError::Code::kNotAvailable;

TEST_P(HostCanvas, Drawings_VisibleToOthersFromNextStep) {
  const auto host = create(two_robots());
  const auto first = host->connect(6665);
  const auto second = host->connect(6666);
  dot(*first, 4, 5, kRed);
  EXPECT_EQ(at(*second, 4, 5).a, 0);
  EXPECT_EQ(at(*first, 4, 5), kRed) << "their own client sees them at once";
  dot(*first, 6, 5, kRed);
  second->wait();
  EXPECT_EQ(at(*second, 6, 5), kRed);
}

TEST_P(HostCanvas, FullQueue_KeepsOrder) {
  const auto host = create(two_robots());
  const auto session = host->connect(6665);
  constexpr int kCount = 3 * static_cast<int>(DrawQueue::kCapacity) + 7;
  for (int i = 0; i < kCount; ++i) {
    dot(*session, i % 100, i / 100 % 50, {0, static_cast<std::uint8_t>(i % 256), 1, 255});
  }
  for (int i = kCount - 5000; i < kCount; ++i) {
    ASSERT_EQ(at(*session, i % 100, i / 100 % 50).g, i % 256) << i;
  }
}

TEST_P(HostCanvas, Cells_SetInOrderOfDrawings) {
  const auto host = create(two_robots());
  const auto session = host->connect(6665);
  dot(*session, 0, 0, kRed);
  const std::vector<CellValue> blue(4, CellValue::of(kBlue));
  session->request(SetCellsRequest{sim::kBaseLayer, {0, 0, 2, 2}, blue});
  dot(*session, 1, 1, kRed);
  EXPECT_EQ(at(*session, 0, 0), kBlue);
  EXPECT_EQ(at(*session, 1, 1), kRed);
  session->request(SetCellsRequest{sim::kBaseLayer, {-1, 49, 2, 2}, blue});  // clipped
  EXPECT_EQ(at(*session, 0, 49), kBlue);
  EXPECT_EQ(refusal([&] {
              session->request(SetCellsRequest{sim::kBaseLayer, {0, 0, 3, 2}, blue});
            }),
            kBadArgument);
  EXPECT_EQ(refusal([&] {
              session->request(SetCellsRequest{sim::kBaseLayer, {0, 0, -2, -2}, blue});
            }),
            kBadArgument);
}

TEST_P(HostCanvas, Layers_BelongToSession) {
  const auto host = create(two_robots());
  const auto first = host->connect(6665);
  const auto second = host->connect(6666);
  const LayerId layer = first->request(CreateLayerRequest{LayerKind::kColour, named("map")});
  const LayerId other = second->request(CreateLayerRequest{LayerKind::kGrey, named("map")});
  EXPECT_NE(layer, other);
  EXPECT_EQ(first->request(LayersRequest{}).size(), 2U);
  EXPECT_EQ(refusal([&] { second->request(RemoveLayerRequest{layer}); }), kBadArgument);
  EXPECT_EQ(refusal([&] {
              second->request(SetLayerStyleRequest{layer, named("x")});
            }),
            kBadArgument);
  EXPECT_EQ(refusal([&] { static_cast<void>(second->request(CellsRequest{layer})); }),
            kBadArgument);
  EXPECT_EQ(refusal([&] {
              static_cast<void>(second->request(CellRequest{layer, 0, 0}));
            }),
            kBadArgument);
  EXPECT_EQ(refusal([&] { second->request(SetCellsRequest{layer, {}, {}}); }), kBadArgument);
  EXPECT_EQ(refusal([&] {
              first->request(CreateLayerRequest{LayerKind::kColour, named("map")});
            }),
            kBadArgument);
  EXPECT_EQ(refusal([&] { first->request(RemoveLayerRequest{sim::kBaseLayer}); }), kNotAvailable);
  EXPECT_EQ(refusal([&] {
              first->request(SetLayerStyleRequest{sim::kBaseLayer, named("x")});
            }),
            kNotAvailable);
  sim::LayerStyle odd = named("odd");
  odd.transparency = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([&] {
              first->request(CreateLayerRequest{LayerKind::kColour, odd});
            }),
            kBadArgument);
  first->request(RemoveLayerRequest{layer});
  EXPECT_EQ(first->request(LayersRequest{}).size(), 1U);
}

TEST_P(HostCanvas, DrawingsOnForeignLayers_Ignored) {
  const auto host = create(two_robots());
  const auto first = host->connect(6665);
  const auto second = host->connect(6666);
  const LayerId theirs = first->request(CreateLayerRequest{LayerKind::kColour, named("map")});
  const LayerId own = second->request(CreateLayerRequest{LayerKind::kColour, named("map")});
  dot(*second, 1, 1, kRed, theirs);
  dot(*second, 1, 1, kRed, own);
  dot(*second, 2, 1, kRed, theirs);
  dot(*second, 1, 1, kRed);
  second->wait();
  EXPECT_EQ(at(*first, 1, 1, theirs).a, 0);
  EXPECT_EQ(at(*first, 2, 1, theirs).a, 0);
  EXPECT_EQ(at(*second, 1, 1, own), kRed);
  EXPECT_EQ(at(*first, 1, 1), kRed);
}

TEST_P(HostCanvas, EqualPriorities_StackedByPort) {
  for (const bool swapped : {false, true}) {
    const auto host = create(two_robots());
    const auto one = host->connect(swapped ? 6666 : 6665);
    const auto two = host->connect(swapped ? 6665 : 6666);
    for (const auto& session : {one.get(), two.get()}) {
      const LayerId layer = session->request(CreateLayerRequest{LayerKind::kColour, named("map")});
      dot(*session, 3, 3, session->port() == 6665 ? kRed : kBlue, layer);
      EXPECT_TRUE(session->request(CellRequest{layer, 3, 3})) << "it was executed";
    }
    EXPECT_EQ(composed_at(*one, 3, 3), kBlue) << swapped;
  }
}

TEST_P(HostCanvas, Layers_OutliveSessionUntilRecreated) {
  const auto host = create(two_robots());
  const auto watcher = host->connect(kMorsePort);
  {
    const auto session = host->connect(6665);
    dot(*session, 3, 3, kRed,
        session->request(CreateLayerRequest{LayerKind::kColour, named("map")}));
  }
  EXPECT_EQ(composed_at(*watcher, 3, 3), kRed);
  const auto elsewhere = host->connect(6666);
  elsewhere->request(CreateLayerRequest{LayerKind::kColour, named("map")});
  EXPECT_EQ(composed_at(*watcher, 3, 3), kRed);
  const auto session = host->connect(6665);
  EXPECT_EQ(session->request(LayersRequest{}).size(), 1U) << "it is nobody's";
  session->request(CreateLayerRequest{LayerKind::kBinary, named("map")});
  EXPECT_EQ(composed_at(*watcher, 3, 3).a, 0);
}

TEST_P(HostCanvas, Resize_VisibleToAll) {
  const auto host = create(two_robots());
  const auto first = host->connect(6665);
  const auto second = host->connect(6666);
  const std::uint64_t before = second->canvas_generation();
  dot(*second, 0, 49, kRed);  // queued while the canvas has 50 rows: bottom left
  first->request(ResizeCanvasRequest{120, 30});
  static_cast<void>(second->request(TimeRequest{}));  // any answer informs the session about it
  EXPECT_NE(second->canvas_generation(), before);
  EXPECT_EQ(second->request(CanvasInfoRequest{}).width, 120);
  EXPECT_EQ(second->request(CanvasInfoRequest{}).height, 30);
  EXPECT_EQ(at(*second, 0, 29), kRed);
  EXPECT_EQ(refusal([&] { first->request(ResizeCanvasRequest{0, 30}); }), kBadArgument);
  EXPECT_EQ(first->request(CanvasInfoRequest{}).width, 120);
}

TEST_P(HostCanvas, LockedViewMode_Stays) {
  const auto free = create(two_robots())->connect(6665);
  free->request(SetViewModeRequest{sim::ViewMode::kMiniMap});
  EXPECT_EQ(free->request(ViewModeRequest{}), sim::ViewMode::kMiniMap);
  const auto host = create(two_robots(R"(, "view_mode": "full-screen", "lock_view_mode": true)"));
  const auto locked = host->connect(6665);
  EXPECT_EQ(refusal([&] { locked->request(SetViewModeRequest{sim::ViewMode::kGround}); }),
            kNotAvailable);
  locked->request(SetViewModeRequest{sim::ViewMode::kFullScreen});
  EXPECT_EQ(locked->request(ViewModeRequest{}), sim::ViewMode::kFullScreen);
}

TEST_P(HostCanvas, Pictures_StayInsideOutputFolder) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = (folder.path() / "out").string();
  const auto host = create(two_robots(), settings);
  const auto session = host->connect(6665);
  session->request(SaveImageRequest{"map"});
  session->request(SaveImageRequest{"large.png", 3});
  const std::filesystem::path out(settings.output_folder);
  EXPECT_TRUE(std::filesystem::exists(out / "map.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "large.png"));
  for (const char* name : {"", "../map", "/tmp/map.png", "a/b.png", "..", ".", ".hidden.png",
                           "a\\b.png", "a\nb.png"}) {
    EXPECT_EQ(refusal([&] { session->request(SaveImageRequest{name}); }), kBadArgument) << name;
  }
  EXPECT_EQ(refusal([&] { session->request(SaveImageRequest{"map", 0}); }), kBadArgument);
  EXPECT_EQ(refusal([&] { session->request(SaveImageRequest{"map", 65}); }), kBadArgument);
  std::filesystem::create_symlink(folder.path() / "elsewhere.png", out / "link.png");
  EXPECT_EQ(refusal([&] { session->request(SaveImageRequest{"link"}); }), kNotAvailable);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "elsewhere.png"));
  const auto nowhere = create(two_robots());
  EXPECT_EQ(refusal([&] { nowhere->connect(6665)->request(SaveImageRequest{"map"}); }),
            kNotAvailable);
}

TEST_P(HostCanvas, ClientFiles_Limited) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path().string();
  settings.client_files_limit = 1;
  settings.all_files_limit = 1000;
  const auto host = create(two_robots(), settings);
  const auto one = host->connect(6665);
  LogRequest logging;
  logging.running = true;
  one->request(SaveImageRequest{"a"});  // succeeds; the next requests are refused
  EXPECT_EQ(refusal([&] { one->request(SaveImageRequest{"b"}); }), kNotAvailable);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.png"));
  EXPECT_EQ(refusal([&] { one->request(logging); }), std::nullopt)
      << "a log has a limit of its own";
  const auto two = host->connect(6665);
  EXPECT_EQ(refusal([&] { two->request(SaveImageRequest{"b", 64}); }), std::nullopt);
  ASSERT_GT(std::filesystem::file_size(folder.path() / "b.png"), 1000U);
  const auto three = host->connect(6666);
  EXPECT_EQ(refusal([&] { three->request(SaveImageRequest{"c"}); }), kNotAvailable);
  EXPECT_EQ(refusal([&] { three->request(logging); }), kNotAvailable);
}

TEST_P(HostCanvas, Layers_SavedOneByOne) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path().string();
  const auto host = create(two_robots(R"(, "origin": [0.5, 0.25])"), settings);
  const auto session = host->connect(6665);
  const LayerId map = session->request(CreateLayerRequest{LayerKind::kGrey, named("map")});
  const LayerId dots = session->request(CreateLayerRequest{LayerKind::kColour, named("dots")});
  dot(*session, 3, 4, kRed, dots);
  dot(*session, 5, 6, kBlue);  // on the canvas
  const std::vector<CellValue> occupancies = {CellValue::of(0.0F), CellValue::of(0.3F),
                                              CellValue::of(1.0F)};
  session->request(SetCellsRequest{map, {0, 49, 3, 1}, occupancies});

  session->request(SaveImageRequest{"dots", 1, dots});
  // Read as a map by map_server: red is dark enough to be occupied, white is free.
  std::ofstream(folder.path() / "dots.yaml")
      << "{image: dots.png, resolution: 0.02, origin: [0, 0, 0], negate: 0, "
         "occupied_thresh: 0.65, free_thresh: 0.196}";
  const sim::OccupancyMap picture = sim::io::read_map((folder.path() / "dots.yaml").string());
  ASSERT_EQ(picture.width, 100);
  ASSERT_EQ(picture.height, 50);
  EXPECT_EQ(picture.at(3, 4), 1.0F);
  EXPECT_EQ(picture.at(5, 6), 0.0F) << "the canvas's are not there";

  session->request(SaveMapRequest{map, "plan", sim::io::MapMode::kTrinary});
  session->request(SaveMapRequest{map, "shades.yaml", sim::io::MapMode::kScale});
  for (const char* file : {"plan.yaml", "plan.pgm", "shades.yaml", "shades.pgm"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
  }
  const sim::OccupancyMap plan = sim::io::read_map((folder.path() / "plan.yaml").string());
  EXPECT_EQ(plan.width, 100);
  EXPECT_EQ(plan.height, 50);
  EXPECT_DOUBLE_EQ(plan.cell_size_m, 0.02);
  EXPECT_DOUBLE_EQ(plan.origin.x(), 0.5);
  EXPECT_DOUBLE_EQ(plan.origin.y(), 0.25);
  EXPECT_EQ(plan.at(0, 49), 0.0F);
  EXPECT_EQ(plan.at(1, 49), 0.5F) << "neither free nor occupied";
  EXPECT_EQ(plan.at(2, 49), 1.0F);
  EXPECT_EQ(plan.at(3, 49), 0.5F);
  const sim::OccupancyMap shades = sim::io::read_map((folder.path() / "shades.yaml").string());
  EXPECT_NEAR(shades.at(1, 49), 0.3F, 1.0 / 500.0);

  const auto save_map = [&](LayerId layer, const char* name) {
    return refusal([&] {
      session->request(SaveMapRequest{layer, name, sim::io::MapMode::kTrinary});
    });
  };
  EXPECT_EQ(save_map(dots, "dots"), kBadArgument) << "no occupancies";
  EXPECT_EQ(save_map(99, "plan"), kBadArgument);
  EXPECT_EQ(save_map(map, "../plan"), kBadArgument);
  EXPECT_EQ(save_map(map, ""), kBadArgument);
  EXPECT_EQ(refusal([&] { session->request(SaveImageRequest{"dots", 1, 99}); }), kBadArgument);
  const auto other = host->connect(6666);
  EXPECT_EQ(refusal([&] {
              other->request(SaveImageRequest{"dots", 1, dots});
            }),
            kBadArgument)
      << "somebody else's";
  std::filesystem::create_symlink(folder.path() / "elsewhere", folder.path() / "link.pgm");
  EXPECT_EQ(save_map(map, "link"), kNotAvailable);
  const auto nowhere = create(two_robots())->connect(6665);
  const LayerId lost = nowhere->request(CreateLayerRequest{LayerKind::kGrey, named("map")});
  EXPECT_EQ(refusal([&] {
              nowhere->request(SaveMapRequest{lost, "map", sim::io::MapMode::kTrinary});
            }),
            kNotAvailable);
}

TEST_P(HostCanvas, WorldMap_ShowsArena) {
  const auto host = create(two_robots());
  const auto session = host->connect(6665);
  const sim::OccupancyMap map = session->request(WorldMapRequest{0.1}).map;
  ASSERT_EQ(map.width, 20);
  ASSERT_EQ(map.height, 10);
  // The box spans x 1.4 .. 1.6, y 0.4 .. 0.6: columns 14 and 15, rows 4 and 5.
  EXPECT_EQ(map.at(14, 4), 1.0F);
  EXPECT_EQ(map.at(15, 5), 1.0F);
  EXPECT_EQ(map.at(12, 4), 0.0F);
  for (const double cell_m : {0.0, -1.0, 1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(refusal([&] { static_cast<void>(session->request(WorldMapRequest{cell_m}).map); }),
              kBadArgument);
  }
}

TEST_P(HostCanvas, Join_HoldsClockUntilThreadWaits) {
  const auto host = create(two_robots());
  const auto first = host->connect(6665);
  const auto second = host->connect(6666);
  second->request(JoinRequest{});
  std::atomic<bool> read{false};
  std::thread other([&] {
    first->wait();
    read = true;
  });
  // Time stands still, however long this takes, because the other thread waits for this one's
  // client.
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(host->time().steps, 0U);
    ASSERT_FALSE(read);
    std::this_thread::yield();
  }
  second->wait();
  other.join();
  EXPECT_EQ(host->time().steps, 10U);
}

TEST_P(HostCanvas, ClosedSession_RefusesDrawings) {
  const auto host = create(two_robots());
  const auto session = host->connect(6665);
  dot(*session, 1, 1, kRed);
  session->close();
  EXPECT_EQ(refusal([&] { dot(*session, 2, 2, kRed); }), SessionError::Code::kDisconnected);
  EXPECT_EQ(refusal([&] { static_cast<void>(session->request(LayersRequest{})); }),
            SessionError::Code::kDisconnected);
  EXPECT_EQ(session->request(CanvasInfoRequest{}).width, 100);
  EXPECT_EQ(at(*host->connect(6665), 1, 1), kRed) << "what was drawn before is there";
}

// Also for ThreadSanitizer: threads draw on one session while its owner reads, another thread reads
// the canvas, and layers come and go.
TEST_P(HostCanvas, ManyThreads_ShareSession) {
  const auto host = create(two_robots());
  const auto session = host->connect(6665);
  const LayerId layer = session->request(CreateLayerRequest{LayerKind::kColour, named("shared")});
  constexpr int kRounds = 20000;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kRounds; ++i) dot(*session, i % 100, t, kRed, layer);
    });
  }
  threads.emplace_back([&] {
    for (int i = 0; i < 50; ++i) {
      const LayerId mine = session->request(CreateLayerRequest{LayerKind::kGrey, named("mine")});
      static_cast<void>(session->request(CanvasImageRequest{}).rgba);
      session->request(ResizeCanvasRequest{100, 50 + i % 2});
      static_cast<void>(session->request(CanvasInfoRequest{}));
      session->request(RemoveLayerRequest{mine});
    }
    session->request(ResizeCanvasRequest{100, 50});
  });
  for (int i = 0; i < 20; ++i) session->wait();
  for (std::thread& thread : threads) thread.join();
  // Resizing moves drawings only by whole rows, so every thread's last row exists.
  for (int t = 0; t < 3; ++t) dot(*session, 0, t, kBlue, layer);
  for (int t = 0; t < 3; ++t) EXPECT_EQ(at(*session, 0, t, layer), kBlue);
}

// The pictures of 2 million cells take a while. The thread that makes steps for others does not
// write them; the clients learn of the end when they are there.
TEST(HostEnd, LastPicturesOfLargeCanvas_WrittenWithoutBlockingServer) {
  const test_support::TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path();
  settings.duration_s = 0.05;
  const auto host = test::patient_host(two_robots(), settings);
  const auto client = host->connect_events(6665, [] {});
  client->session().request(ResizeCanvasRequest{2048, 1024});
  dot(client->session(), 5, 6, kRed);
  EXPECT_EQ(client->begin_sleep(1, 10.0), EventClient::Outcome::kWaiting);
  while (host->advance(milliseconds(1))) {
  }
  EXPECT_EQ(host->time().steps, 5U);
  EXPECT_EQ(at(client->session(), 5, 6), kRed) << "others are answered meanwhile";
  while (client->outcome() == EventClient::Outcome::kWaiting) std::this_thread::yield();
  EXPECT_EQ(client->outcome(), EventClient::Outcome::kFinished);
  EXPECT_TRUE(host->finished());
  const json report = json::parse(test_support::read_bytes(folder / "report.json"));
  EXPECT_EQ(report.at("run").at("state_hash"), sim::hexadecimal_text(host->state_hash(), 16));
  EXPECT_TRUE(std::filesystem::exists(folder / "canvas.png"));
}

TEST(HostEnd, TakenOverResults_CompletedFromMemory) {
  const test_support::TemporaryFolder folder;
  const KeptRun kept(std::size_t{1} << 22U);
  RunSettings settings;
  settings.output_folder = folder.path();
  settings.kept_run = kept.file();
  const auto host = test::patient_host(two_robots(), settings);
  const auto session = host->connect(6665);
  session->request(SleepRequest{0.2});
  host->note_end_request(SIGTERM);
  EXPECT_TRUE(host->take_over_results());
  EXPECT_FALSE(host->take_over_results());
  host->finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "canvas.png")) << "the host writes none";
  ProgramEnd end;
  end.request = SIGTERM;
  EXPECT_TRUE(complete_results(kept, two_robots(), settings, end));
  const json report = json::parse(test_support::read_bytes(folder / "report.json"));
  EXPECT_EQ(report.at("run").at("steps"), 20);
  EXPECT_EQ(report.at("run").at("state_hash"), nullptr);
  EXPECT_EQ(report.at("ended").at("signal"), "SIGTERM");
  EXPECT_TRUE(std::filesystem::exists(folder / "canvas.png"));
}

TEST(HostCanvasSize, ControllerThatFillsCanvas_BoundsSize) {
  const auto host = test::patient_host(two_robots(
      R"(}, "controller": {"timers": [{"every": 1, "do": [{"canvas": {"colour": "#ff0000"}}]}])"));
  const auto session = host->connect(6665);
  session->request(ResizeCanvasRequest{1500, 1500});
  try {
    session->request(ResizeCanvasRequest{8192, 8192});
    ADD_FAILURE() << "accepted";
  } catch (const SessionError& error) {
    EXPECT_EQ(error.code(), SessionError::Code::kNotAvailable);
    EXPECT_THAT(error.what(), testing::HasSubstr("the arena controller fills the canvas"));
  }
}

}  // namespace
}  // namespace playerlike
