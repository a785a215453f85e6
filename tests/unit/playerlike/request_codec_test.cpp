// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests and their answers as messages, in both encodings: they survive coding, and have the
// format of docs/protocol.md.
#include "protocol/request_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "print_encoding.h"
#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "protocol/request_fields.h"
#include "random_fields.h"

namespace playerlike::protocol {

namespace {

using test::field_of_key;
using test::FieldText;
using test::may_be_missing;
using test::RandomFields;
using testing::HasSubstr;

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

/// Calls a function for each type of request that is sent.
void for_each_kind(const std::function<void(std::size_t type, const RequestKind& kind)>& visit) {
  std::size_t count = 0;
  for (std::size_t type = 0; type < request_kinds().size(); ++type) {
    const RequestKind& kind = request_kinds()[type];
    if (kind.name.empty()) continue;
    visit(type, kind);
    ++count;
  }
  EXPECT_GT(count, 30U);
}

Request any_request(const RequestKind& kind, RandomFields& fields) {
  Request request = kind.make();
  fields.fill(kind.fields(), sim::object_in(request));
  return request;
}

TEST_P(RequestMessages, RoundTrip) {
  RandomFields fields(1);
  for_each_kind([&](std::size_t type, const RequestKind& kind) {
    EXPECT_EQ(find_request(kind.name), type);
    for (int i = 0; i < 20; ++i) {
      const Request request = any_request(kind, fields);
      const json message = sent(encode_request(request, GetParam()));
      EXPECT_EQ(message.at("do"), kind.name);
      const Request decoded = decode_request(type, message, GetParam());
      ASSERT_EQ(decoded.index(), type);
      EXPECT_EQ(FieldText::of(kind.fields(), sim::object_in(decoded)),
                FieldText::of(kind.fields(), sim::object_in(request)))
          << kind.name;
    }
  });
  EXPECT_FALSE(find_request(""));
  EXPECT_FALSE(find_request("nonsense"));
}

TEST_P(RequestMessages, Answers_RoundTrip) {
  RandomFields fields(2);
  for_each_kind([&](std::size_t, const RequestKind& kind) {
    for (int i = 0; i < 5; ++i) {
      Answer answer = kind.make_answer();
      fields.fill(kind.answer(), sim::object_in(answer));
      const json message = sent(encode_answer(kind.make(), answer, GetParam()));
      const Answer decoded = decode_answer(kind.make(), message, GetParam());
      ASSERT_EQ(decoded.index(), answer.index()) << message;
      EXPECT_EQ(FieldText::of(kind.answer(), sim::object_in(decoded)),
                FieldText::of(kind.answer(), sim::object_in(answer)))
          << kind.name;
    }
  });
}

// The formats of docs/protocol.md, as bytes.
TEST(RequestCodec, Samples_AreEncodedAsInTheReference) {
  const auto line = [](const Request& request) {
    return encode(encode_request(request, Encoding::kJson), Encoding::kJson);
  };
  EXPECT_EQ(line(SetCellsRequest{3, {-1, 2, 2, 1}, {{0U}, {4278190335U}}}),
            R"({"cells":"AAAAAP8AAP8=","do":"set_cells","layer":3,"rect":[-1,2,2,1]})"
            "\n");
  EXPECT_EQ(line(ReplaceRequest{}), "{\"device\":null,\"do\":\"replace\",\"replace\":true}\n");
  EXPECT_EQ(line(NoteGoalRequest{{1, 2}, {-0.5, 0.25}, 0.05}),
            R"({"device":[1,2],"do":"note_goal","goal_x":-0.5,"goal_y":0.25,"tolerance":0.05})"
            "\n");
  EXPECT_EQ(line(LogRequest{.running = true}), "{\"do\":\"log\",\"running\":true}\n");
  EXPECT_EQ(line(CreateLayerRequest{sim::LayerKind::kGrey, {.name = "way"}}),
            R"({"do":"create_layer","kind":"grey","style":{"colour":"#000000","name":"way",)"
            R"("priority":0,"transparency":0.0,"transparent_colour":null,"visible":true}})"
            "\n");
  const auto answer = [](const Request& request, const Answer& result) {
    return encode(encode_answer(request, result, Encoding::kJson), Encoding::kJson);
  };
  EXPECT_EQ(answer(CellRequest{}, std::optional<sim::CellValue>()), "{\"cell\":null}\n");
  EXPECT_EQ(answer(SubscribeRequest{}, {}), "{}\n");
  EXPECT_EQ(answer(ViewModeRequest{}, sim::ViewMode::kMiniMap), "{\"mode\":\"mini-map\"}\n");
  EXPECT_EQ(answer(TakeChargeRequest{}, Charge{true, false}),
            "{\"stopped\":false,\"watched\":true}\n");
}

TEST_P(RequestMessages, OptionalMembers_HaveDefaults) {
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

TEST(RequestCodec, AreRefusedWhenAnythingIsMissingWrongOrUnknown) {
  RandomFields fields(3);
  for_each_kind([&](std::size_t, const RequestKind& kind) {
    json whole = encode_request(any_request(kind, fields), Encoding::kJson);
    for (const std::string& key : keys_of(kind.fields())) {
      const bool optional = may_be_missing(field_of_key(kind.fields(), key));
      EXPECT_TRUE(optional || whole.contains(key)) << whole << " without " << key;
      json changed = whole;
      changed.erase(key);
      EXPECT_EQ(refusal(changed).empty(), optional) << changed;
      changed[key] = {{"wrong", nullptr}};  // of no type
      EXPECT_NE(refusal(changed), "") << changed;
    }
    EXPECT_EQ(refusal(whole), "");
    whole["unknown"] = 1;
    EXPECT_THAT(refusal(whole), HasSubstr("the unknown key \"unknown\""));
  });
}

TEST(RequestCodec, InvalidMembers_RefusedByName) {
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

TEST(RequestCodec, InvalidArenaAnswers_Refused) {
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
TEST(RequestCodec, MatchReference) {
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
  for_each_kind([&](std::size_t, const RequestKind& kind) {
    const std::vector<std::string> keys = keys_of(kind.fields());
    const auto row_of_request = told.find(std::string(kind.name));
    ASSERT_NE(row_of_request, told.end()) << kind.name;
    EXPECT_EQ(row_of_request->second, std::set(keys.begin(), keys.end())) << kind.name;
  });
}

}  // namespace
}  // namespace playerlike::protocol
