// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Player's messages as bytes: recorded conversations decode to the values noted beside them and
// encode to the same bytes; invalid payloads get an error that says what is wrong.
#include "protocol/player_xdr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "player_recordings.h"

namespace playerlike::player {
namespace {

using nlohmann::json;
using playpen::test::PlayerRecording;
using testing::HasSubstr;

/// Shows a payload's fields as the recordings describe them.
class JsonWriter {
 public:
  template <typename T>
  void value(const char* name, const T& field) {
    out_[name] = to_json(field);
  }
  template <typename Array>
  void count(const char* name, const Array& array) {
    out_[name] = array.size();
  }
  template <typename Array>
  void elements(const char* name, const Array& array, std::size_t /*limit*/) {
    value(name, array);
  }
  template <typename T>
  static json to_json(const T& field) {
    if constexpr (std::is_same_v<T, float>) {
      return static_cast<double>(field);
    } else if constexpr (std::is_same_v<T, char>) {
      return static_cast<unsigned char>(field);
    } else if constexpr (std::is_arithmetic_v<T>) {
      return field;
    } else if constexpr (requires { typename T::value_type; }) {
      json list = json::array();
      for (const auto& element : field) {
        // The recordings show arrays of bytes without signs.
        if constexpr (sizeof(element) == 1) {
          list.push_back(static_cast<unsigned char>(element));
        } else {
          list.push_back(to_json(element));
        }
      }
      return list;
    } else {
      JsonWriter writer;
      T::visit_fields(field, writer);
      return writer.out_;
    }
  }

 private:
  json out_ = json::object();
};

// Whether both describe the same; numbers in the recordings may be rounded to a float's digits.
::testing::AssertionResult same(const json& ours, const json& recorded, const std::string& where) {
  if (ours.is_number() && recorded.is_number()) {
    const auto a = ours.get<double>();
    const auto b = recorded.get<double>();
    if (a == b || static_cast<float>(a) == static_cast<float>(b)) {
      return ::testing::AssertionSuccess();
    }
  } else if (ours.is_array() && recorded.is_array() && ours.size() == recorded.size()) {
    for (std::size_t i = 0; i < ours.size(); ++i) {
      auto result = same(ours[i], recorded[i], where + "[" + std::to_string(i) + "]");
      if (!result) return result;
    }
    return ::testing::AssertionSuccess();
  } else if (ours.is_object() && recorded.is_object() && ours.size() == recorded.size()) {
    for (const auto& [key, value] : ours.items()) {
      if (!recorded.contains(key))
        return ::testing::AssertionFailure() << where << " lacks " << key;
      auto result = same(value, recorded[key], where + "." + key);
      if (!result) return result;
    }
    return ::testing::AssertionSuccess();
  } else if (ours == recorded) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << where << ": " << ours << " instead of " << recorded;
}

class Recordings : public testing::TestWithParam<std::string> {};

TEST_P(Recordings, DecodeToNotedValuesAndEncodeToSameBytes) {
  const PlayerRecording recording = playpen::test::player_recording(GetParam());
  int payloads = 0;
  for (const json& message : recording.described["messages"]) {
    const std::string where = GetParam() + " " + message["direction"].get<std::string>() + " at " +
                              std::to_string(message["offset"].get<int>()) + " " +
                              message.value("name", "");
    const std::string_view bytes = recording.bytes_of(message);
    const Message parsed = parse_message(bytes);
    const json address = JsonWriter::to_json(parsed.header.addr);
    for (const auto& [key, value] : address.items()) {
      EXPECT_EQ(message[key], value) << where;
    }
    EXPECT_EQ(message["type"], parsed.header.type) << where;
    EXPECT_EQ(message["subtype"], parsed.header.subtype) << where;
    std::string again;
    const auto check = [&]<typename Payload>() {
      const auto payload = decode<Payload>(parsed.payload);
      const json fields = message.contains("fields") ? message["fields"] : json::object();
      EXPECT_TRUE(same(JsonWriter::to_json(payload), fields, where));
      EXPECT_EQ(parsed.payload, encode(payload)) << where;
      append_message(again, parsed.header, payload);
    };
    const bool known =
        visit_payload(parsed.header.addr.interf, parsed.header.type, parsed.header.subtype, check);
    if (!known) {
      // Only refusals have no payload of their own.
      EXPECT_TRUE(parsed.payload.empty()) << where;
      EXPECT_TRUE(parsed.header.type == PLAYER_MSGTYPE_RESP_NACK ||
                  parsed.header.type == PLAYER_MSGTYPE_SYNCH)
          << where;
      append_message(again, parsed.header, Empty{});
    }
    EXPECT_EQ(bytes, again) << where;
    payloads += known ? 1 : 0;
  }
  EXPECT_GT(payloads, 5);
}
INSTANTIATE_TEST_SUITE_P(All, Recordings,
                         testing::ValuesIn(playpen::test::player_recording_names()),
                         [](const auto& recording) { return recording.param; });

TEST(Streams, AnyPieces_WholeMessages) {
  const PlayerRecording recording = playpen::test::player_recording("connect");
  for (const std::size_t piece : {1U, 7U, 40U, 1000U}) {
    protocol::MessageSplitter splitter(protocol::Framing::kPlayer, kMaxPayload);
    std::size_t messages = 0;
    const std::string_view bytes = recording.client;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      splitter.add(bytes.substr(at, piece));
      while (const auto message = splitter.next()) {
        EXPECT_EQ(message->size(), kHeaderBytes + parse_message(*message).header.size);
        ++messages;
      }
    }
    EXPECT_FALSE(splitter.partial());
    std::size_t recorded = 0;
    for (const json& message : recording.described["messages"]) {
      recorded += message["direction"] == "client" ? 1U : 0U;
    }
    EXPECT_EQ(messages, recorded);
  }
}

TEST(Banner, HasPrefixAndLengthOfPlayer) {
  EXPECT_EQ(banner().size(), kBannerBytes);
  EXPECT_THAT(banner(), testing::StartsWith(PLAYER_IDENT_STRING));
  EXPECT_EQ(banner().back(), '\0');
}

TEST(Texts, EndWithZeroByte) {
  EXPECT_EQ(text_bytes("stage"), std::string("stage\0", 6));
  EXPECT_EQ(text_of(std::string_view("stage\0x", 7)), "stage");
  EXPECT_EQ(text_of("stage"), "stage");
  EXPECT_EQ(text_of(""), "");
}

std::string number(std::uint32_t value) { return encode(Uint32{value}); }

template <typename Payload>
std::string error_of(const std::string& bytes) {
  try {
    static_cast<void>(decode<Payload>(bytes));
  } catch (const protocol::ProtocolError& error) {
    EXPECT_EQ(error.id(), "player/payload");
    return error.what();
  }
  return "no error";
}

TEST(Refusals, NameFault) {
  EXPECT_THAT(error_of<Pose2d>(std::string(23, '\0')), HasSubstr("ends in pa: expected 8 more"));
  EXPECT_THAT(error_of<Pose2d>(std::string(28, '\0')), HasSubstr("found 4 more bytes"));
  EXPECT_THAT(error_of<Pose2d>(""), HasSubstr("ends in px"));
  EXPECT_THAT(error_of<SonarData>(number(1) + number(2) + number(0) + number(0)),
              HasSubstr("ranges_count is 1, but the array has 2"));
  EXPECT_THAT(error_of<SonarData>(number(0xffffffff) + number(0xffffffff)),
              HasSubstr("ends in ranges"));
  EXPECT_THAT(error_of<SonarGeom>(number(0xffffffff) + number(0xffffffff)),
              HasSubstr("ends in px"));
  EXPECT_THAT(error_of<SpeechCmd>(number(5) + number(5) + "abc"), HasSubstr("ends in string"));
  EXPECT_THAT(error_of<SpeechCmd>(number(0xfffffffe) + number(0xfffffffe) + "abcd"),
              HasSubstr("ends in string"));
  EXPECT_THAT(error_of<DeviceDriverinfo>(std::string(16, '\0') + number(65) + number(65) +
                                         std::string(68, 'x')),
              HasSubstr("driver_name: expected at most 64 elements, found 65"));
  EXPECT_THAT(error_of<Empty>(number(0)), HasSubstr("found 4 more bytes"));
}

TEST(Refusals, InvalidHeaders_Refused) {
  for (const std::string& bytes : {std::string(39, '\0'), std::string(41, '\0')}) {
    try {
      static_cast<void>(parse_message(bytes));
      FAIL();
    } catch (const protocol::ProtocolError& error) {
      EXPECT_EQ(error.id(), "player/header");
    }
  }
}

TEST(Refusals, LongMessages_RefusedAtHeader) {
  protocol::MessageSplitter splitter(protocol::Framing::kPlayer, 100);
  std::string bytes;
  Msghdr header;
  header.size = 101;
  append(bytes, header);
  splitter.add(bytes);
  EXPECT_THROW(static_cast<void>(splitter.next()), protocol::ProtocolError);
}

TEST(Numbers, SignsAndLimits_Kept) {
  MapData map;
  map.data_range = -1;
  map.data = {-1, 0, 1};
  map.col = std::numeric_limits<std::uint32_t>::max();
  const auto again = decode<MapData>(encode(map));
  EXPECT_EQ(again.data_range, -1);
  EXPECT_EQ(again.data, map.data);
  EXPECT_EQ(again.col, map.col);
  PlannerData planner;
  planner.waypoint_idx = -1;
  EXPECT_EQ(decode<PlannerData>(encode(planner)).waypoint_idx, -1);
  HealthData health;
  health.mem.total = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(decode<HealthData>(encode(health)).mem.total, health.mem.total);
}

}  // namespace
}  // namespace playerlike::player
