// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests and commands of Player's protocol that take long, without sockets and threads: they are
// done in pieces, in turn with those of other clients.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "libplayerinterface/player_constants.h"
#include "patient_host.h"
#include "player_wire_client.h"
#include "server/player_connection.h"

namespace playerlike::server {
namespace {

using test_support::PlayerMessage;
using test_support::PlayerWireClient;

/// A connection that keeps what it is sent.
class FakePeer final : public Peer {
 public:
  void send(std::string bytes) override { sent += bytes; }
  bool send_record(std::shared_ptr<const std::string> bytes) override {
    sent += *bytes;
    return true;
  }
  void close(std::string farewell) override { sent += farewell; }
  void set_in_flight(std::size_t requests) override { static_cast<void>(requests); }
  void set_busy(bool now) override { busy = now; }
  void set_framing(protocol::Framing framing) override { static_cast<void>(framing); }
  [[nodiscard]] const std::string& name() const noexcept override { return name_; }

  /// Takes all messages; the banner comes first.
  std::vector<PlayerMessage> take() {
    if (!std::exchange(greeted_, true)) sent.erase(0, player::kBannerBytes);
    std::vector<PlayerMessage> messages;
    while (!sent.empty()) {
      PlayerMessage message;
      message.header = player::decode<player::Msghdr>(sent.substr(0, player::kHeaderBytes));
      message.payload = sent.substr(player::kHeaderBytes, message.header.size);
      sent.erase(0, player::kHeaderBytes + message.header.size);
      messages.push_back(std::move(message));
    }
    return messages;
  }

  bool busy = false;
  std::string sent;

 private:
  bool greeted_ = false;
  std::string name_ = "fake:1";
};

/// A server whose worker thread works when the test says so.
class FakeHub final : public Hub {
 public:
  explicit FakeHub(std::shared_ptr<Host> host)
      : host_(std::move(host)), access_({}, host_->robots()) {}

  Host& host() noexcept override { return *host_; }
  const ServerSettings& settings() const noexcept override { return settings_; }
  const Access& access() const noexcept override { return access_; }
  void log(sim::LogLevel level, const std::string& text) override {
    static_cast<void>(level);
    ADD_FAILURE() << text;
  }
  void post(std::function<void()> task) override { static_cast<void>(task); }
  std::uint64_t after(std::chrono::microseconds delay, std::function<void()> task) override {
    static_cast<void>(delay);
    static_cast<void>(task);
    return 0;
  }
  void cancel(std::uint64_t timer) override { static_cast<void>(timer); }
  void work(Job job) override { jobs_.push_back(std::move(job)); }
  std::shared_ptr<void> claim_room(std::size_t bytes) override {
    static_cast<void>(bytes);
    return nullptr;
  }
  void pump() override {}
  [[nodiscard]] const std::map<int, int>& player_ports() const noexcept override {
    return player_ports_;
  }
  int listen(int first, MakeHandler make) override {
    static_cast<void>(first);
    static_cast<void>(make);
    return 0;
  }
  void hand_over(Peer& peer, std::unique_ptr<Handler> handler) override {
    static_cast<void>(peer);
    static_cast<void>(handler);
  }
  void quit() override {}
  ThreadId thread_id(const std::string& process, std::uint64_t thread) override {
    static_cast<void>(process);
    static_cast<void>(thread);
    return 1;
  }

  /// One turn of the worker thread. @return whether there was work.
  bool do_piece() {
    if (jobs_.empty()) return false;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    if (job.work()) jobs_.push_back(std::move(job));
    return true;
  }

 private:
  std::shared_ptr<Host> host_;
  ServerSettings settings_;
  Access access_;
  std::map<int, int> player_ports_;
  std::deque<Job> jobs_;
};

class PlayerWork : public testing::Test {
 protected:
  struct Client {
    explicit Client(FakeHub& hub) : connection(peer, hub, kPlayerPort, kPlayerPort) {}

    void send(int type, int interface, int subtype, std::string_view payload = "") {
      connection.on_message(PlayerWireClient::message(type, interface, 0, subtype, payload));
    }
    void open(int interface) {
      player::DeviceReq request;
      request.addr.interf = static_cast<std::uint16_t>(interface);
      request.access = PLAYER_OPEN_MODE;
      send(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DEV, player::encode(request));
      const auto answers = peer.take();
      ASSERT_EQ(answers.size(), 1U);
      EXPECT_TRUE(
          answers[0].is(PLAYER_MSGTYPE_RESP_ACK, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DEV));
    }
    /// Whether a request is answered at once.
    bool is_answered() {
      send(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, PLAYER_PLAYER_REQ_DEVLIST);
      return peer.take().size() == 1;
    }

    FakePeer peer;
    PlayerConnection connection;
  };

  // The map, with the canvas's cells, has 2048 x 1024 of them.
  const std::shared_ptr<Host> host_ = test::patient_host(sim::load_world_text(
      R"({"name": "one", "arena": {"size": [2.048, 1.024]}, "simulation": {"time": "lockstep"},
          "canvas": {"size": [2048, 1024], "cell_size": 0.001},
          "robots": [{"name": "r1", "pose": {"x": 0.3, "y": 0.3}}]})"));
  FakeHub hub_{host_};
  Client client_{hub_};
  Client other_{hub_};
};

TEST_F(PlayerWork, LargeMap_OthersAnsweredBetweenPieces) {
  client_.open(PLAYER_MAP_CODE);
  player::MapData part;
  part.width = 2048;
  part.height = 1024;
  client_.send(PLAYER_MSGTYPE_REQ, PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_DATA, player::encode(part));
  EXPECT_TRUE(client_.peer.busy) << "nothing more is read from it";
  EXPECT_TRUE(client_.peer.take().empty());
  EXPECT_TRUE(other_.is_answered());
  ASSERT_TRUE(hub_.do_piece());
  EXPECT_FALSE(client_.peer.busy);
  const auto answers = client_.peer.take();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_TRUE(answers[0].is(PLAYER_MSGTYPE_RESP_ACK, PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_DATA));
  EXPECT_EQ(answers[0].as<player::MapData>().width, 2048U);
  EXPECT_FALSE(hub_.do_piece());
  // A small part is answered at once, and one that the map does not have is refused.
  part.width = part.height = 100;
  client_.send(PLAYER_MSGTYPE_REQ, PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_DATA, player::encode(part));
  EXPECT_EQ(client_.peer.take().at(0).header.type, PLAYER_MSGTYPE_RESP_ACK);
  part.col = 2000;
  client_.send(PLAYER_MSGTYPE_REQ, PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_DATA, player::encode(part));
  EXPECT_EQ(client_.peer.take().at(0).header.type, PLAYER_MSGTYPE_RESP_NACK);
}

TEST_F(PlayerWork, LargePolygon_DrawnInPieces) {
  client_.open(PLAYER_GRAPHICS2D_CODE);
  // 10 000 corners, at the lower and the upper edge in turn: each row crosses all edges.
  player::Graphics2dCmdPolygon polygon;
  for (int i = 0; i < 10'000; ++i) {
    polygon.points.push_back({2.048 * i / 10'000, i % 2 == 0 ? 0.0 : 1.024});
  }
  polygon.color = polygon.fill_color = {0, 200, 0, 0};  // alpha, red, green, blue
  polygon.filled = 1;
  client_.send(PLAYER_MSGTYPE_CMD, PLAYER_GRAPHICS2D_CODE, PLAYER_GRAPHICS2D_CMD_POLYGON,
               player::encode(polygon));
  EXPECT_TRUE(client_.peer.busy);
  int pieces = 0;
  while (hub_.do_piece()) {
    ++pieces;
    if (pieces < 4) {
      EXPECT_TRUE(other_.is_answered());
    }
  }
  // 1024 rows with 10 000 corners are about 10 million comparisons, 2^20 in a piece.
  EXPECT_GE(pieces, 10);
  EXPECT_FALSE(client_.peer.busy);
  host_->with_simulation([](const sim::Simulation& simulation) {
    const auto layers = simulation.layers().layers();
    ASSERT_EQ(layers.size(), 2U);
    // The edges alone, five a cell, cover everything.
    const auto cell = simulation.layers().cell(layers[1].id, 1024, 1000);
    EXPECT_EQ(cell->colour(), (sim::Colour{200, 0, 0, 255}));
  });
}

TEST_F(PlayerWork, SmallDrawings_QueuedUpToLimit) {
  client_.open(PLAYER_GRAPHICS2D_CODE);
  player::Graphics2dCmdPolyline line;
  line.points = {{0.0, 0.5}, {2.047, 0.5}};
  // Each line writes 2048 cells; two sessions may queue 2^18 cells each.
  int lines = 0;
  for (; lines < 1000 && !client_.peer.busy; ++lines) {
    client_.send(PLAYER_MSGTYPE_CMD, PLAYER_GRAPHICS2D_CODE, PLAYER_GRAPHICS2D_CMD_POLYLINE,
                 player::encode(line));
  }
  EXPECT_EQ(lines, 129);
  EXPECT_TRUE(hub_.do_piece());
  EXPECT_FALSE(client_.peer.busy);
}

}  // namespace
}  // namespace playerlike::server
