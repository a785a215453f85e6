// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests and their answers as messages, in both encodings: they survive coding, and have the
// format of docs/protocol.md.
#include "protocol/request_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "print_encoding.h"
#include "protocol/codec.h"

namespace playerlike::protocol {

namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class RequestMessages : public testing::TestWithParam<Encoding> {
 protected:
  /// A message as the other end receives it.
  static json sent(const json& message) {
    MessageSplitter splitter(GetParam(), 1U << 20U);
    splitter.add(encode(message, GetParam()));
    return decode(splitter.next().value(), GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Encodings, RequestMessages,
                         testing::Values(Encoding::kJson, Encoding::kCbor), [](const auto& test) {
                           return test.param == Encoding::kCbor ? "cbor" : "json";
                         });

const std::vector<sim::CellValue> kCells{{0U}, {4278190335U}, {0xffffffffU}};
const sim::LayerStyle kStyle{.name = "way \u00e9",
                             .colour = {0x34, 0xaa, 0xff, 0x80},
                             .transparency = 0.1,
                             .transparent_colour = sim::Colour{1, 2, 3, 4},
                             .priority = -5,
                             .visible = false};

/// At least one example of each named request, with and without optional members.
std::vector<Request> examples() {
  return {SubscribeRequest{{1, 2}},
          UnsubscribeRequest{{0, 0}},
          ReplaceRequest{DeviceId{1, 2}, false},
          ReplaceRequest{std::nullopt, true},
          TimeRequest{},
          PreferRealTimeRequest{"a \"reason\""},
          SetCellsRequest{3, {-1, 2, 3, 1}, kCells},
          CellRequest{0, -7, 1 << 30},
          CellsRequest{1 << 30},
          CreateLayerRequest{sim::LayerKind::kGrey, kStyle},
          RemoveLayerRequest{4},
          SetLayerStyleRequest{0, {}},
          LayersRequest{},
          CanvasImageRequest{},
          ResizeCanvasRequest{0, -3},
          SaveImageRequest{"a", 1},
          SaveImageRequest{"b", 64, 2},
          SaveMapRequest{1, "c", sim::io::MapMode::kScale},
          ViewModeRequest{},
          SetViewModeRequest{sim::ViewMode::kFullScreen},
          WorldMapRequest{0.1},
          WorldMapRequest{std::numeric_limits<double>::min(), sim::CellRect{0, 1024, 5, 6}},
          ObjectPoseRequest{"r1"},
          PlaceObjectRequest{"r1", {1.0 / 3.0, -2.0, 0.1}},
          ObjectPropertyRequest{"r1", "size"},
          SetObjectPropertyRequest{"r1", "size", std::vector{0.1, 1e300}},
          SetObjectPropertyRequest{"r1", "colour", "red"},
          SaveStateRequest{"before the door"},
          RestoreStateRequest{"s"},
          NoteGoalRequest{{1, 2}, {-0.5, 1.0 / 3.0}, 0.05},
          ParticlesRequest{{0, 3}},
          TakeChargeRequest{{0, 3}, 0.25, true, "m"},
          LogRequest{},
          LogRequest{"f", true, false, true},
          SetBlackboardRequest{"g", "k", 1, 65535, {0, 255, 10}},
          BlackboardRequest{},
          BlackboardRequest{7, "", "k"},
          ArenaRequest{},
          ArenaEventsRequest{std::uint64_t{1} << 62U},
          SetConfigurationRequest{"open"},
          SetBlockRequest{"gate", true},
          SetTimerRequest{"tick", false},
          SetTrapRequest{"home", true}};
}

/// A state of the arena without empty members.
ArenaStatus arena_status() {
  ArenaStatus status;
  status.time_ns = 5;
  status.configurations = {"open", "closed"};
  status.configuration = "closed";
  status.blocks = {{"gate", "rising", 0.1}, {"side", "retracted", 0.0}};
  status.timers = {{"tick", true, 3, 0.25}, {"late", false, 0, std::nullopt}};
  status.traps = {{"home", true, std::uint64_t{1} << 62U, std::nullopt}};
  status.scores = {{"r1", -1.0 / 3.0}};
  status.verdict = sim::Verdict{true, "\"at\" home", 7};
  status.newest = 12;
  return status;
}

std::vector<sim::ArenaEvent> all_kinds_of_events() {
  std::vector<sim::ArenaEvent> events;
  for (int i = 0; i <= static_cast<int>(sim::kLastArenaEventKind); ++i) {
    sim::ArenaEvent& event = events.emplace_back();
    event.number = 22 + static_cast<std::uint64_t>(i);
    event.time_ns = std::int64_t{1} << 62U;
    event.kind = static_cast<sim::ArenaEventKind>(i);
    event.what = "gate";
    event.who = "r1";
    event.text = "to\u00fc wide";
    event.value = 0.1;
  }
  return events;
}

/// Names of all requests that are sent as messages.
template <typename... One>
std::set<std::string> names(std::type_identity<std::variant<One...>>) {
  std::set<std::string> all;
  const auto note = [&]<typename R>(std::type_identity<R>) {
    if constexpr (requires { R::kName; }) all.insert(R::kName);
  };
  (note(std::type_identity<One>{}), ...);
  return all;
}

TEST_P(RequestMessages, ComeOutAsTheyWentIn) {
  std::set<std::string> seen;
  for (const Request& request : examples()) {
    const json message = sent(encode_request(request, GetParam()));
    const auto name = message.at("do").get<std::string>();
    const auto type = find_request(name);
    ASSERT_EQ(type, request.index()) << name;
    const Request decoded = decode_request(*type, message, GetParam());
    ASSERT_EQ(decoded.index(), request.index());
    EXPECT_EQ(encode_request(decoded, GetParam()), encode_request(request, GetParam())) << name;
    seen.insert(name);
  }
  EXPECT_EQ(seen, names(std::type_identity<Request>{})) << "examples() has one of each";
  EXPECT_FALSE(find_request(""));
  EXPECT_FALSE(find_request("nonsense"));
}

TEST_P(RequestMessages, AnswersComeOutAsTheyWentIn) {
  const sim::OccupancyMap map{2, 1, 0.5, {1.0, -1.0}, {0.0F, 1.0F}};
  TimeStatistics time;
  time.sim_time_ns = 5;
  time.duration_s = 7.5;
  const std::vector<std::pair<Request, Answer>> all{
      {SubscribeRequest{}, {}},
      {CellRequest{}, std::optional(kCells[1])},
      {CellRequest{}, std::optional<sim::CellValue>()},
      {CellsRequest{}, kCells},
      {CreateLayerRequest{}, sim::LayerId{7}},
      {LayersRequest{}, std::vector<sim::LayerInfo>{{3, sim::LayerKind::kBinary, 6665, kStyle}}},
      {CanvasImageRequest{}, CanvasImage{{1, 2, 3, 255}, {1, 1, 0.02, -1.0, 2.0}}},
      {ResizeCanvasRequest{}, CanvasInfo{8192, 1, 0.02, -1.0, 2.0}},
      {ViewModeRequest{}, sim::ViewMode::kMiniMap},
      {WorldMapRequest{}, WorldMap{map}},
      {WorldMapRequest{}, WorldMap{map, 100, 200, sim::Pose{1.0, 2.0, 0.0}}},
      {ObjectPoseRequest{}, ObjectPose{{0.1, 0.2, 0.3}, std::int64_t{1} << 62U}},
      {ObjectPropertyRequest{}, PropertyValue("text")},
      {ObjectPropertyRequest{}, PropertyValue(std::vector{0.1, -0.0})},
      {LogRequest{}, LogStatus{true, false, "f"}},
      {ArenaRequest{}, ArenaStatus{}},
      {ArenaRequest{}, arena_status()},
      {ArenaEventsRequest{}, ArenaEventList{}},
      {ArenaEventsRequest{}, ArenaEventList{all_kinds_of_events(), 40, 21}},
      {ParticlesRequest{}, std::vector<LocalizationParticle>{}},
      {ParticlesRequest{},
       std::vector<LocalizationParticle>{{{0.1, -2.0, 1.0 / 3.0}, 0.25}, {{}, 0.75}}},
      {TakeChargeRequest{}, Charge{true, false}},
      {BlackboardRequest{}, std::vector<BlackboardEntry>{{"", "k", 1, 2, {0, 255}, 5, 6}}},
      {TimeRequest{}, time}};
  for (const auto& [request, answer] : all) {
    const json message = encode_answer(request, answer, GetParam());
    const Answer decoded = decode_answer(request, sent(message), GetParam());
    ASSERT_EQ(decoded.index(), answer.index()) << message;
    EXPECT_EQ(encode_answer(request, decoded, GetParam()), message);
  }
}

TEST_P(RequestMessages, HaveDefaultsForWhatMayBeLeftOut) {
  const auto read = [](const json& message) {
    const Encoding encoding = GetParam();
    return decode_request(find_request(message.at("do").get<std::string>()).value(), message,
                          encoding);
  };
  EXPECT_EQ(std::get<SaveImageRequest>(read({{"do", "save_image"}, {"name", "a"}})).scale, 1);
  EXPECT_EQ(std::get<SaveMapRequest>(read({{"do", "save_map"}, {"layer", 1}, {"name", "a"}})).mode,
            sim::io::MapMode::kTrinary);
  EXPECT_FALSE(std::get<ReplaceRequest>(read({{"do", "replace"}, {"replace", false}})).device);
  EXPECT_FALSE(std::get<LogRequest>(read({{"do", "log"}})).running);
  EXPECT_EQ(std::get<ArenaEventsRequest>(read({{"do", "arena_events"}})).since, 0U);
}

std::string refusal(const json& message) {
  try {
    static_cast<void>(decode_request(find_request(message.at("do").get<std::string>()).value(),
                                     message, Encoding::kJson));
  } catch (const ProtocolError& error) {
    return error.id() + ": " + error.what();
  }
  return "";
}

TEST(RequestCodec, AreRefusedForWhatIsWrongByName) {
  EXPECT_EQ(refusal({{"do", "object_pose"}}), "protocol/bad-value: the key \"name\" is missing");
  EXPECT_EQ(refusal({{"do", "object_pose"}, {"name", 3}}),
            "protocol/bad-value: name: expected a text, found 3");
  EXPECT_EQ(refusal({{"do", "save_image"}, {"name", "a"}, {"size", 3}}),
            "protocol/bad-value: this request has the unknown key \"size\"; it may have: id, do, "
            "name, scale, layer");
  EXPECT_EQ(refusal({{"do", "save_image"}, {"name", "a"}, {"layer", nullptr}}),
            "protocol/bad-value: layer: expected a whole number from 0 to 1073741824, found null");
  EXPECT_EQ(refusal({{"do", "cell"}, {"layer", 0}, {"column", 0.5}, {"row", 0}}),
            "protocol/bad-value: column: expected a whole number from -1073741824 to 1073741824, "
            "found 0.5");
  EXPECT_EQ(refusal({{"do", "set_view_mode"}, {"mode", "upside-down"}}),
            "protocol/bad-value: mode: expected ground, mini-map or full-screen, found "
            "\"upside-down\"");
  EXPECT_THAT(refusal({{"do", "set_cells"}, {"layer", 0}, {"rect", {0, 0, 1}}, {"cells", ""}}),
              HasSubstr("[column, row, width, height]"));
}

TEST(RequestCodec, RefuseWrongAnswersAboutTheArena) {
  const auto refusal_of = [](const Request& request, const json& answer) -> std::string {
    try {
      static_cast<void>(decode_answer(request, answer, Encoding::kJson));
    } catch (const ProtocolError& error) {
      return error.what();
    }
    return "";
  };
  json events = encode_answer(ArenaEventsRequest{}, ArenaEventList{all_kinds_of_events(), 40, 21},
                              Encoding::kJson);
  events["events"][0]["kind"] = "party";
  EXPECT_EQ(refusal_of(ArenaEventsRequest{}, events),
            "kind: expected a kind of event, found \"party\"");
  events["events"] = 3;
  EXPECT_EQ(refusal_of(ArenaEventsRequest{}, events), "events: expected a list, found 3");
  json status = encode_answer(ArenaRequest{}, arena_status(), Encoding::kJson);
  status["timers"][0]["count"] = -1;
  EXPECT_THAT(refusal_of(ArenaRequest{}, status), HasSubstr("count: expected a whole number"));
  EXPECT_EQ(refusal({{"do", "set_block"}, {"name", "gate"}, {"extended", 1}}),
            "protocol/bad-value: extended: expected true or false, found 1");
  EXPECT_THAT(refusal({{"do", "arena_events"}, {"since", -1}}),
              HasSubstr("since: expected a whole number from 0"));
  EXPECT_THAT(refusal({{"do", "arena"}, {"since", 1}}), HasSubstr("the unknown key \"since\""));
}

// The table of docs/protocol.md: | `NAME` | `key`, `key`... | ... |
TEST(RequestCodec, AreThoseOfTheReference) {
  std::ifstream page(PLAYPEN_SOURCE_DIR "/docs/protocol.md");
  ASSERT_TRUE(page);
  std::map<std::string, std::set<std::string>> told;
  const std::regex row(R"(^\| `(\w+)` \|([^|]*)\|)");
  const std::regex key(R"(`(\w+)`)");
  bool requests = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) requests = line == "## Requests";
    std::smatch match;
    if (!requests || !std::regex_search(line, match, row)) continue;
    const std::string keys = match[2];
    for (std::sregex_iterator it(keys.begin(), keys.end(), key), end; it != end; ++it) {
      told[match[1]].insert(it->str(1));
    }
    told[match[1]];
  }
  for (const Request& request : examples()) {
    const json message = encode_request(request, Encoding::kJson);
    const auto name = message.at("do").get<std::string>();
    ASSERT_TRUE(told.contains(name)) << name;
    std::set<std::string> keys;
    for (const auto& [k, value] : message.items()) {
      if (k != "do") keys.insert(k);
    }
    EXPECT_THAT(told[name], IsSupersetOf(keys)) << name;
  }
}

}  // namespace
}  // namespace playerlike::protocol
