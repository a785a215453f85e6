// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Playpen's protocol as bytes and as values: data survives both encodings bit by bit, however the
// bytes are split; invalid data gets a specific error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "messages/spare.h"
#include "print_encoding.h"
#include "protocol/codec.h"
#include "protocol/framing.h"
#include "protocol/request_fields.h"
#include "random_fields.h"
#include "sim/devices/builtin.h"
#include "sim/devices/camera.h"
#include "sim/devices/depth_camera.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/rangers.h"

namespace playerlike::protocol {

namespace {

using test::any_double;
using test::field_of_key;
using test::FieldText;
using test::may_be_missing;
using test::RandomFields;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t kLimit = std::size_t{1} << 20U;

/// The id of the ProtocolError that a call throws; "" if it throws none.
std::string error_of(const std::function<void()>& call, std::string* message = nullptr) {
  try {
    call();
  } catch (const ProtocolError& e) {
    if (message != nullptr) *message = e.what();
    return e.id();
  }
  return "";
}

std::string decode_error(std::string_view bytes, Encoding encoding) {
  return error_of([&] { static_cast<void>(decode(bytes, encoding)); });
}

/// The message after encoding and decoding.
json through(const json& message, Encoding encoding) {
  MessageSplitter splitter(encoding, 4 * kLimit);
  splitter.add(encode(message, encoding));
  const std::optional<std::string_view> bytes = splitter.next();
  if (!bytes) throw std::runtime_error("an encoded message is not whole");
  return decode(*bytes, encoding);
}

/// Does this for a value that is not a message by itself.
json value_through(const json& value, Encoding encoding) {
  return through({{"value", value}}, encoding).at("value");
}

class EachEncoding : public testing::TestWithParam<Encoding> {};
INSTANTIATE_TEST_SUITE_P(Protocol, EachEncoding, testing::Values(Encoding::kJson, Encoding::kCbor),
                         [](const auto& it) { return std::string(to_string(it.param)); });

// --- framing

TEST(Framing, Encodings_HaveNames) {
  EXPECT_EQ(parse_encoding("json"), Encoding::kJson);
  EXPECT_EQ(parse_encoding("cbor"), Encoding::kCbor);
  EXPECT_EQ(parse_encoding("CBOR"), std::nullopt);
  EXPECT_EQ(parse_encoding(""), std::nullopt);
}

TEST_P(EachEncoding, Stream_SplitInAnyPieces) {
  std::vector<json> messages;
  for (std::size_t length : {0U, 1U, 2U, 30U, 300U, 3U, 70000U, 5U}) {
    messages.push_back({{"id", messages.size()}, {"text", std::string(length, 'x')}});
  }
  std::string stream;
  for (const json& message : messages) stream += encode(message, GetParam());
  std::mt19937_64 random(1);
  for (const std::size_t most : {1U, 2U, 3U, 4U, 5U, 7U, 100U, 5000U, 100000U}) {
    MessageSplitter splitter(GetParam(), kLimit);
    std::vector<json> received;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size =
          std::min(stream.size() - at, most < 100 ? most : 1 + random() % most);
      // Half of the time like a socket, which may write less than there is room for.
      if (random() % 2 == 0) {
        splitter.add(std::string_view(stream).substr(at, size));
      } else {
        std::memcpy(splitter.room(size + random() % 100).data(), stream.data() + at, size);
        splitter.added(size);
      }
      at += size;
      while (const auto message = splitter.next()) {
        received.push_back(decode(*message, GetParam()));
      }
    }
    EXPECT_EQ(received, messages) << "pieces of up to " << most;
    EXPECT_FALSE(splitter.partial());
  }
}

TEST_P(EachEncoding, PartialMessage_Detected) {
  const std::string bytes = encode({{"id", 1}}, GetParam());
  MessageSplitter splitter(GetParam(), kLimit);
  EXPECT_FALSE(splitter.partial());
  splitter.add(std::string_view(bytes).substr(0, 1));
  EXPECT_EQ(splitter.next(), std::nullopt);
  EXPECT_TRUE(splitter.partial());
  splitter.add(std::string_view(bytes).substr(1));
  EXPECT_NE(splitter.next(), std::nullopt);
  EXPECT_FALSE(splitter.partial());
  splitter.add("");
  EXPECT_FALSE(splitter.partial());
}

TEST(Framing, Lines_MayEndWithCrLf) {
  MessageSplitter splitter(Encoding::kJson, 3);
  splitter.add("abc\r\n\n\r\na\rb\nx");
  EXPECT_EQ(splitter.next(), "abc");
  EXPECT_EQ(splitter.next(), "");
  EXPECT_EQ(splitter.next(), "");
  EXPECT_EQ(splitter.next(), "a\rb");
  EXPECT_EQ(splitter.next(), std::nullopt);
}

TEST(Framing, LongLine_DetectedBeforeItsEnd) {
  MessageSplitter splitter(Encoding::kJson, 3);
  splitter.add("abc");
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("\r");  // may be a part of the line's end
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("x");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
  }
  MessageSplitter whole(Encoding::kJson, 3);
  whole.add("abcd\n");
  EXPECT_EQ(error_of([&] { static_cast<void>(whole.next()); }), "protocol/too-long");
}

TEST(Framing, LongFrame_DetectedByLength) {
  MessageSplitter splitter(Encoding::kCbor, 3);
  splitter.add(std::string_view("\0\0\0\3abc\0\0\0", 10));
  EXPECT_EQ(splitter.next(), "abc");
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("\4");
  EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
  MessageSplitter gigabytes(Encoding::kCbor, kLimit);
  gigabytes.add("\xff\xff\xff\xff");
  EXPECT_EQ(error_of([&] { static_cast<void>(gigabytes.next()); }), "protocol/too-long");
}

TEST(Framing, Encoding_MayChangeWithinPiece) {
  const json message = {{"id", 7}};
  MessageSplitter splitter(Encoding::kJson, kLimit);
  splitter.add("1 playpen hello\n" + encode(message, Encoding::kCbor) + "1 time now\n");
  EXPECT_EQ(splitter.next(), "1 playpen hello");
  splitter.set_encoding(Encoding::kCbor);
  EXPECT_EQ(decode(splitter.next().value(), Encoding::kCbor), message);
  splitter.set_encoding(Encoding::kJson);
  EXPECT_EQ(splitter.next(), "1 time now");
}

TEST(Framing, Limit_MayChange) {
  MessageSplitter splitter(Encoding::kJson, 10);
  splitter.add("123456\n1234\n");
  EXPECT_EQ(splitter.next(), "123456");
  splitter.set_limit(3);
  EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
}

// --- values

TEST_P(EachEncoding, Values_RoundTrip) {
  const json message = {
      {"null", nullptr},
      {"yes", true},
      {"no", false},
      {"zero", 0},
      {"greatest", std::numeric_limits<std::uint64_t>::max()},
      {"least", std::numeric_limits<std::int64_t>::min()},
      {"counts", {23, 24, 255, 256, 65535, 65536, 4294967295, 4294967296, -24, -25, -256, -257}},
      {"text", "a\"b\\c\n\x01 é→🤖"},
      {"", {{"deep", {{{"list", json::array()}, {"object", json::object()}}}}}}};
  EXPECT_EQ(through(message, GetParam()), message);
}

TEST_P(EachEncoding, Doubles_RoundTripExactly) {
  std::mt19937_64 random(2);
  std::vector<double> numbers = {0.0,
                                 -0.0,
                                 1.0,
                                 -5.0,
                                 0.1,
                                 1e22,
                                 1e300,
                                 9007199254740993.0,
                                 18446744073709551616.0,
                                 std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::denorm_min(),
                                 -std::numeric_limits<double>::denorm_min()};
  for (int i = 0; i < 5000; ++i) numbers.push_back(any_double(random));
  for (const double number : numbers) {
    const json value = value_through(number, GetParam());
    ASSERT_TRUE(value.is_number_float()) << number;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value.get<double>()),
              std::bit_cast<std::uint64_t>(number))
        << number;
  }
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 5000U}) {
    const std::vector<double> some(numbers.begin(), numbers.begin() + static_cast<int>(count));
    const json message = through({{"numbers", doubles(some, GetParam())}}, GetParam());
    const std::vector<double> received = require_doubles(message, "numbers", GetParam());
    ASSERT_THAT(received, SizeIs(count));
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(received[i]), std::bit_cast<std::uint64_t>(some[i]));
    }
  }
}

TEST_P(EachEncoding, Bytes_RoundTrip) {
  std::mt19937_64 random(3);
  for (std::size_t size = 0; size < 70; ++size) {
    std::vector<std::uint8_t> data(size);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
    const json message = through({{"data", bytes(data, GetParam())}}, GetParam());
    EXPECT_EQ(require_bytes(message, "data", GetParam()), data);
  }
}

TEST(JsonText, Bytes_AreStandardBase64) {
  // RFC 4648, section 10.
  const std::map<std::string, std::string> vectors = {{"", ""},
                                                      {"f", "Zg=="},
                                                      {"fo", "Zm8="},
                                                      {"foo", "Zm9v"},
                                                      {"foob", "Zm9vYg=="},
                                                      {"fooba", "Zm9vYmE="},
                                                      {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, text] : vectors) {
    EXPECT_EQ(bytes({plain.begin(), plain.end()}, Encoding::kJson), text);
  }
  for (const char* wrong : {"Z", "Zg", "Zg=", "Zg===", "=",
                            "====", "Z===", "Zg==Zg==", "Zh==", "Zm9=", "Zm 9", "Zm9v\n", "Zm-_"}) {
    EXPECT_EQ(error_of([&] {
                static_cast<void>(require_bytes({{"b", wrong}}, "b", Encoding::kJson));
              }),
              "protocol/bad-value")
        << wrong;
  }
}

TEST_P(EachEncoding, InvalidUtf8_Replaced) {
  const json message = {{"te\xffxt", {"a\xc3", {{"k\xed\xa0\x80", "\xf0\x9f\xa4\x96"}}}}, {"n", 1}};
  const json received = through(message, GetParam());
  EXPECT_EQ(received.at("te\uFFFDxt").at(0), "a\uFFFD");
  EXPECT_EQ(received.at("te\uFFFDxt").at(1).begin().value(), "🤖");
  EXPECT_EQ(received.at("n"), 1);
}

TEST(JsonText, Message_OneLine) {
  const std::string line = encode({{"text", "a\nb\r\u2028"}, {"n", 1.0}}, Encoding::kJson);
  EXPECT_EQ(line, "{\"n\":1.0,\"text\":\"a\\nb\\r\u2028\"}\n");
}

TEST(JsonText, NonFiniteNumbers_AreNull) {
  EXPECT_EQ(encode({{"n", std::nan("")}}, Encoding::kJson), "{\"n\":null}\n");
}

TEST(JsonText, LongNumberLists_MatchParser) {
  // Many spellings, between other lists that look similar.
  const std::string numbers =
      " 0 ,-0,1.5e3,1E-2 ,\t12345678901234567890,0.1,2e+2,-7.25,8,9,10,11,12,13,14,15,1e-300 ";
  const std::string text = "{\"a\":[[],[1,2],[" + numbers + "],{\"b\":[" + numbers + "]},\"[" +
                           "1,2\\\"\"],\"c\":[1,[" + numbers + "]]}";
  const json expected = json::parse(text);
  const json decoded = decode(text, Encoding::kJson);
  const auto check = [](const json& holder, const char* key, const json& list) {
    ASSERT_TRUE(holder.at(key).is_binary());
    EXPECT_EQ(require_doubles(holder, key, Encoding::kJson), list.get<std::vector<double>>());
  };
  EXPECT_EQ(decoded["a"][0], expected["a"][0]);
  EXPECT_EQ(decoded["a"][1], expected["a"][1]);
  check({{"x", decoded["a"][2]}}, "x", expected["a"][2]);
  check(decoded["a"][3], "b", expected["a"][3]["b"]);
  EXPECT_EQ(decoded["a"][4], expected["a"][4]);
  EXPECT_EQ(decoded["c"][0], expected["c"][0]);
  check({{"x", decoded["c"][1]}}, "x", expected["c"][1]);
  // A number that from_chars does not accept leaves the list to the parser.
  const std::string tiny = "[" + numbers + ",1e-400]";
  EXPECT_EQ(decode("{\"a\":" + tiny + "}", Encoding::kJson).at("a"), json::parse(tiny));
}

TEST(JsonText, ShortLists_StayLists) {
  EXPECT_EQ(decode("{\"a\":[1,2,3]}", Encoding::kJson), (json{{"a", {1, 2, 3}}}));
  const json list = std::vector<int>(100, 3);
  EXPECT_EQ(decode_json_value(list.dump()), list);
  EXPECT_EQ(decode_json_value(" 3 "), 3);
  EXPECT_EQ(decode_json_value("null"), nullptr);
  EXPECT_EQ(error_of([] { static_cast<void>(decode_json_value("3 4")); }), "protocol/syntax");
}

// --- what is refused

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(JsonText, InvalidJson_Refused) {
  for (const std::string text : {"",
                                 " ",
                                 "{",
                                 "}",
                                 "{\"a\":1",
                                 "{\"a\":1}}",
                                 "{\"a\":1} x",
                                 "{a:1}",
                                 "{'a':1}",
                                 "{\"a\":01}",
                                 "{\"a\":.5}",
                                 "{\"a\":1.}",
                                 "{\"a\":+1}",
                                 "{\"a\":NaN}",
                                 "{\"a\":Infinity}",
                                 "{\"a\":nul}",
                                 "{\"a\":1,}",
                                 "{\"a\":[1,]}",
                                 "{\"a\":\"\\x\"}",
                                 "{\"a\":\"\\ud800\"}",
                                 "{\"a\":\"\xff\"}",
                                 "{\"a\":\"\xc3\"}",
                                 "{\"a\":\"\xed\xa0\x80\"}",
                                 "{\"a\":\"\xc0\x80\"}",
                                 "{\"\xff\":1}",
                                 "{\"a\":\"\n\"}",
                                 "// no\n{}",
                                 "\x7f\x45\x4c\x46",
                                 "{\"a\":\"b",
                                 "{\"a\":\"b\\"}) {
    EXPECT_EQ(decode_error(text, Encoding::kJson), "protocol/syntax") << text;
  }
  EXPECT_EQ(decode_error(std::string(3, '\0'), Encoding::kJson), "protocol/syntax");
  // The same errors in lists that are read by the fast method.
  const std::string many = repeated("1,", kLongList);
  for (const char* last : {"01", ".5", "1.", "1.e5", "+1", "NaN", "inf", "0x1", "1e", "-", "",
                           "1 2", "1]", "\"", "1.5.5", "--1"}) {
    EXPECT_EQ(decode_error("{\"a\":[" + many + last + "]}", Encoding::kJson), "protocol/syntax")
        << last;
  }
}

TEST(JsonText, Error_NamesPlace) {
  std::string message;
  const std::string text = "{\"a\":[" + repeated("1.25,", 30) + "1],\"b\":x}";
  error_of([&] { static_cast<void>(decode(text, Encoding::kJson)); }, &message);
  // In the original text, although the list was taken out: 6 + 30 * 5 + 3 + 4 bytes precede the x.
  EXPECT_THAT(message, HasSubstr("column 164"));
  error_of([&] { static_cast<void>(decode('"' + std::string(5000, 'x'), Encoding::kJson)); },
           &message);
  EXPECT_THAT(message, SizeIs(testing::Lt(300U))) << "as long as what was sent";
}

TEST(JsonText, LargeNumbers_Refused) {
  for (const std::string& number : {std::string("1e999"), std::string("-1e999"),
                                    std::string(400, '9'), "-" + std::string(400, '9')}) {
    EXPECT_EQ(decode_error("{\"a\":" + number + "}", Encoding::kJson), "protocol/number") << number;
    EXPECT_EQ(decode_error("{\"a\":[" + repeated("1,", kLongList) + number + "]}", Encoding::kJson),
              "protocol/number")
        << number;
  }
}

TEST(JsonText, DeepNesting_Refused) {
  const auto nested = [](int levels, const char* open, const char* close) {
    return "{\"a\":" + repeated(open, levels - 1) + "1" + repeated(close, levels - 1) + "}";
  };
  EXPECT_EQ(decode_error(nested(kMaxDepth, "[", "]"), Encoding::kJson), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth + 1, "[", "]"), Encoding::kJson), "protocol/too-deep");
  EXPECT_EQ(decode_error(nested(kMaxDepth, "{\"a\":", "}"), Encoding::kJson), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth + 1, "{\"a\":", "}"), Encoding::kJson),
            "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("[", 1000000), Encoding::kJson), "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("{\"a\":", 200000), Encoding::kJson), "protocol/too-deep");
}

TEST(JsonText, DuplicateKey_Refused) {
  EXPECT_EQ(decode_error(R"({"a":1,"b":{"c":1,"d":2,"c":3}})", Encoding::kJson),
            "protocol/duplicate-key");
  EXPECT_EQ(decode_error(R"({"a":1,"b":{"a":1}})", Encoding::kJson), "");
}

TEST_P(EachEncoding, NonObject_Refused) {
  for (const json& value : {json(nullptr), json(1), json("text"), json{1, 2}}) {
    const std::string bytes = encode(value, GetParam());
    MessageSplitter splitter(GetParam(), kLimit);
    splitter.add(bytes);
    EXPECT_EQ(decode_error(splitter.next().value(), GetParam()), "protocol/not-an-object");
  }
}

/// {"a": ITEM} in CBOR.
std::string cbor_of(const std::string& item) { return "\xa1\x61" + ("a" + item); }

TEST(Cbor, StandardExamples_Read) {
  // RFC 8949, appendix A.
  const std::vector<std::pair<std::string, json>> items = {
      {{"\x00", 1}, 0},
      {{"\x18\x18", 2}, 24},
      {{"\x1b\xff\xff\xff\xff\xff\xff\xff\xff", 9}, std::numeric_limits<std::uint64_t>::max()},
      {{"\x38\x63", 2}, -100},
      {{"\x3b\x7f\xff\xff\xff\xff\xff\xff\xff", 9}, std::numeric_limits<std::int64_t>::min()},
      {{"\xf9\x00\x00", 3}, 0.0},
      {{"\xf9\x3c\x00", 3}, 1.0},
      {{"\xf9\x3e\x00", 3}, 1.5},
      {{"\xf9\x7b\xff", 3}, 65504.0},
      {{"\xf9\x00\x01", 3}, 5.960464477539063e-8},
      {{"\xf9\x04\x00", 3}, 0.00006103515625},
      {{"\xf9\xc4\x00", 3}, -4.0},
      {{"\xfa\x47\xc3\x50\x00", 5}, 100000.0},
      {{"\xfb\x3f\xf1\x99\x99\x99\x99\x99\x9a", 9}, 1.1},
      {{"\xf4", 1}, false},
      {{"\xf5", 1}, true},
      {{"\xf6", 1}, nullptr},
      {{"\x62\xc3\xbc", 3}, "ü"},
      {{"\x83\x01\x82\x02\x03\x80", 6}, {1, {2, 3}, json::array()}},
      {{"\x1b\x00\x00\x00\x00\x00\x00\x00\x01", 9}, 1},  // longer than need be
  };
  for (const auto& [item, value] : items) {
    EXPECT_EQ(decode(cbor_of(item), Encoding::kCbor).at("a"), value) << value;
  }
  EXPECT_TRUE(
      std::signbit(decode(cbor_of({"\xf9\x80\x00", 3}), Encoding::kCbor).at("a").get<double>()));
}

TEST(Cbor, UnsupportedItems_Refused) {
  using namespace std::string_literals;
  const std::vector<std::string> items = {
      ""s,      // nothing
      "\x18"s,  // a length cut off
      "\x1c"s,
      "\x1d"s,
      "\x1e"s,  // reserved
      "\x1f"s,  // reserved
      "\x42z"s,
      "\x62z"s,  // ends too early
      "\x5f\x41z\xff"s,
      "\x7f\x61z\xff"s,  // indefinite lengths
      "\x9f\x01\xff"s,
      "\xbf\x61z\x01\xff"s,  //
      "\xff"s,               // a break without
      "\x61\xff"s,
      "\x62\xc0\x80"s,          // no UTF-8
      "\x63\xed\xa0\x80"s,      // a surrogate
      "\x64\xf4\x90\x80\x80"s,  // beyond Unicode
      "\xa1\x01\x01"s,          // a key that is no text
      "\xc0\x61z"s,
      "\xc2\x41\x01"s,  // tags: a date, a large number
      "\xd8\x56\x01"s,
      "\xd8\x56\x61z"s,  // tag 86 of what is no byte string
      "\xd8\x56\x47"
      "1234567"s,  // of what is no whole double
      "\xd8\x55\x44"
      "1234"s,              // an array of floats
      "\xd9\xd9\xf7\x01"s,  // CBOR's own mark
      "\xf7"s,
      "\xf3"s,
      "\xe0"s,
      "\xf8\x20"s,  // simple values
      "\x01\x01"s,  // bytes behind the end
  };
  for (const std::string& item : items) {
    EXPECT_EQ(decode_error(cbor_of(item), Encoding::kCbor), "protocol/syntax")
        << testing::PrintToString(item);
  }
  EXPECT_EQ(decode_error("", Encoding::kCbor), "protocol/syntax");
}

TEST(Cbor, FalseLengths_Refused) {
  using namespace std::string_literals;
  // 2^64 - 1 and 2^32 - 1 bytes, characters, elements and members.
  for (const char first : {'\x5b', '\x7b', '\x9b', '\xbb'}) {
    EXPECT_EQ(decode_error(cbor_of(first + std::string(8, '\xff') + "\x01"), Encoding::kCbor),
              "protocol/syntax");
  }
  for (const char first : {'\x5a', '\x7a', '\x9a', '\xba'}) {
    EXPECT_EQ(decode_error(cbor_of(first + std::string(4, '\xff') + "\x01"), Encoding::kCbor),
              "protocol/syntax");
  }
  EXPECT_EQ(decode_error(cbor_of("\xd8\x56\x5b\xff\xff\xff\xff\xff\xff\xff\xf8"s), Encoding::kCbor),
            "protocol/syntax");
}

TEST(Cbor, LargeBytes_InKeptMemory) {
  const auto message_of = [](std::size_t size, std::uint8_t value) {
    return encode({{"cells", json::binary(std::vector<std::uint8_t>(size, value))}},
                  Encoding::kCbor)
        .substr(4);
  };
  Spare<std::uint8_t> spare;
  json first = decode(message_of(100'000, 7), Encoding::kCbor, &spare);
  const std::uint8_t* const memory = first.at("cells").get_binary().data();
  keep_bytes(first, spare);
  const json small = decode(message_of(100, 9), Encoding::kCbor, &spare);
  EXPECT_NE(small.at("cells").get_binary().data(), memory);
  const json second = decode(message_of(50'000, 8), Encoding::kCbor, &spare);
  EXPECT_EQ(second.at("cells").get_binary().data(), memory);
  EXPECT_EQ(second.at("cells"), json::binary(std::vector<std::uint8_t>(50'000, 8)));
}

TEST(Spare, TooLargeOrSmallerLists_NotKept) {
  Spare<char> spare;
  spare.keep(std::vector<char>(Spare<char>::kMostBytes + 1));
  EXPECT_EQ(spare.take().capacity(), 0U);
  spare.keep(std::vector<char>(100));
  spare.keep(std::vector<char>(10));
  EXPECT_GE(spare.take().capacity(), 100U);
  EXPECT_EQ(spare.take().capacity(), 0U);
}

TEST(Cbor, NonFiniteOrLargeNumbers_Refused) {
  using namespace std::string_literals;
  for (const std::string& item :
       {"\xf9\x7c\x00"s, "\xf9\xfc\x00"s, "\xf9\x7e\x00"s, "\xfa\x7f\x80\x00\x00"s,
        "\xfa\x7f\xc0\x00\x00"s, "\xfb\x7f\xf0\x00\x00\x00\x00\x00\x00"s,
        "\xfb\xff\xf0\x00\x00\x00\x00\x00\x00"s, "\xfb\x7f\xf8\x00\x00\x00\x00\x00\x00"s,
        "\xfb\x7f\xf0\x00\x00\x00\x00\x00\x01"s, "\x3b\x80\x00\x00\x00\x00\x00\x00\x00"s,
        "\x3b\xff\xff\xff\xff\xff\xff\xff\xff"s}) {
    EXPECT_EQ(decode_error(cbor_of(item), Encoding::kCbor), "protocol/number")
        << testing::PrintToString(item);
  }
  // At any place in typed arrays.
  for (const double wrong : {std::nan(""), -std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (const std::size_t place : {0U, 1U, 5U}) {
      std::vector<double> numbers(6, -std::numeric_limits<double>::max());
      numbers[place] = wrong;
      const std::string bytes =
          encode({{"a", doubles(numbers, Encoding::kCbor)}}, Encoding::kCbor).substr(4);
      EXPECT_EQ(decode_error(bytes, Encoding::kCbor), "protocol/number");
    }
  }
}

TEST(Cbor, DeepNesting_Refused) {
  const auto nested = [](int lists) { return cbor_of(repeated("\x81", lists) + "\x01"); };
  EXPECT_EQ(decode_error(nested(kMaxDepth - 1), Encoding::kCbor), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth), Encoding::kCbor), "protocol/too-deep");
  EXPECT_EQ(decode_error(nested(1000000), Encoding::kCbor), "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("\xa1\x61"
                                  "a",
                                  300000),
                         Encoding::kCbor),
            "protocol/too-deep");
}

TEST(Cbor, DuplicateKey_Refused) {
  EXPECT_EQ(decode_error("\xa2\x61"
                         "a\x01\x61"
                         "a\x02",
                         Encoding::kCbor),
            "protocol/duplicate-key");
}

TEST_P(EachEncoding, BrokenMessages_GiveProtocolErrorsOnly) {
  const json message = {{"id", 12},
                        {"do", "read"},
                        {"list", {1, 2.5, "x", nullptr, {{"deep", {true}}}}},
                        {"numbers", doubles(std::vector<double>(20, 0.1), GetParam())},
                        {"bytes", bytes({1, 2, 3, 4}, GetParam())}};
  std::string whole = encode(message, GetParam());
  whole = GetParam() == Encoding::kCbor ? whole.substr(4) : whole.substr(0, whole.size() - 1);
  std::mt19937_64 random(4);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = whole.substr(0, random() % 4 == 0 ? random() % whole.size() : whole.size());
    for (auto changes = random() % 4; changes > 0 && !bytes.empty(); --changes) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    refused += decode_error(bytes, GetParam()).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 5000);
}

// --- reading members

TEST(Members, RequiredWithTheirType) {
  const json object = {{"n", 2.5}, {"w", 3.0}, {"i", 7}, {"b", true}, {"t", "x"}, {"l", {1}}};
  EXPECT_EQ(require_number(object, "n"), 2.5);
  EXPECT_EQ(require_number(object, "i"), 7.0);
  EXPECT_EQ(require_integer(object, "i", 7, 7), 7);
  EXPECT_EQ(require_integer(object, "w", 0, 10), 3);
  EXPECT_EQ(require_bool(object, "b"), true);
  EXPECT_EQ(require_text(object, "t"), "x");
  std::string message;
  const auto refused = [&](const std::function<void()>& call) {
    EXPECT_EQ(error_of(call, &message), "protocol/bad-value");
    return message;
  };
  EXPECT_THAT(refused([&] { static_cast<void>(require(object, "none")); }), HasSubstr("\"none\""));
  EXPECT_THAT(refused([&] { static_cast<void>(require(7, "n")); }), HasSubstr("object"));
  EXPECT_EQ(refused([&] { static_cast<void>(require_number(object, "t")); }),
            "t: expected a number, found \"x\"");
  EXPECT_EQ(refused([&] { static_cast<void>(require_integer(object, "n", 0, 10)); }),
            "n: expected a whole number from 0 to 10, found 2.5");
  EXPECT_EQ(refused([&] { static_cast<void>(require_integer(object, "i", 0, 6)); }),
            "i: expected a whole number from 0 to 6, found 7");
  EXPECT_EQ(refused([&] { static_cast<void>(require_bool(object, "i")); }),
            "i: expected true or false, found 7");
  EXPECT_EQ(refused([&] { static_cast<void>(require_text(object, "l")); }),
            "l: expected a text, found a list of 1");
  refused([&] { static_cast<void>(require_number({{"n", std::nan("")}}, "n")); });
  refused([&] { static_cast<void>(require_integer({{"n", 1e300}}, "n", 0, 10)); });
  refused([&] {
    static_cast<void>(require_integer({{"n", std::numeric_limits<std::uint64_t>::max()}}, "n",
                                      std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()));
  });
  refused([&] { static_cast<void>(require_doubles({{"d", {1, "x"}}}, "d", Encoding::kJson)); });
  refused([&] { static_cast<void>(require_doubles({{"d", 1}}, "d", Encoding::kCbor)); });
  refused([&] {
    static_cast<void>(require_doubles({{"d", bytes(std::vector<std::uint8_t>(8), Encoding::kCbor)}},
                                      "d", Encoding::kCbor));
  });
  refused([&] {
    const json typed = doubles(std::vector<double>(1), Encoding::kCbor);
    static_cast<void>(require_bytes({{"b", typed}}, "b", Encoding::kCbor));
  });
  refused([&] { static_cast<void>(require_bytes({{"b", "AAAA"}}, "b", Encoding::kCbor)); });
}

TEST(Members, UnknownKeys_Named) {
  std::string message;
  refuse_unknown_keys({{"a", 1}}, {"a", "b"}, "a thing");
  EXPECT_EQ(error_of(
                [] {
                  refuse_unknown_keys({{"a", 1}, {"c", 1}}, {"a", "b"}, "a thing");
                },
                &message),
            "protocol/bad-value");
  EXPECT_EQ(message, "a thing has the unknown key \"c\"; it may have: a, b");
  EXPECT_EQ(error_of([] { refuse_unknown_keys(3, {"a"}, "a thing"); }), "protocol/bad-value");
}

TEST_P(EachEncoding, DeviceIds_RoundTrip) {
  const json message = through({{"device", encode_device_id({3, 14})}}, GetParam());
  const DeviceId id = require_device_id(message, "device");
  EXPECT_EQ(id.robot, 3);
  EXPECT_EQ(id.device, 14);
  for (const json& wrong : {json(3), json{1}, json{1, 2, 3}, json{-1, 0}, json{0, 2147483648},
                            json{0.5, 0}, json{"0", 0}, json(nullptr)}) {
    EXPECT_EQ(error_of([&] {
                static_cast<void>(require_device_id({{"device", wrong}}, "device"));
              }),
              "protocol/bad-value")
        << wrong;
  }
}

// --- readings

/// A reading with random values.
std::unique_ptr<sim::Reading> any_reading(const sim::ReadingKind& kind, RandomFields& fields) {
  std::unique_ptr<sim::Reading> reading = kind.make();
  fields.fill(*kind.fields, kind.object(*reading));
  reading->time_ns = static_cast<std::int64_t>(fields.random()() >> 1U);
  reading->sequence = fields.random()() >> 1U;
  // What the tables' checks compare with the length of a list.
  if (auto* camera = dynamic_cast<sim::CameraReading*>(reading.get())) {
    camera->width %= 8, camera->height %= 6;
    camera->pixels.resize(static_cast<std::size_t>(3 * camera->width * camera->height));
  } else if (auto* depths = dynamic_cast<sim::DepthCameraReading*>(reading.get())) {
    depths->width %= 8, depths->height %= 6;
    depths->depths_m.resize(static_cast<std::size_t>(depths->width * depths->height));
  } else if (auto* ranger = dynamic_cast<sim::RangerReading*>(reading.get())) {
    ranger->X_BS.resize(ranger->ranges_m.size());
  }
  return reading;
}

TEST_P(EachEncoding, Readings_RoundTripExactly) {
  RandomFields fields(5);
  int sensors = 0;
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    if (kind.reading.fields == nullptr) {
      EXPECT_EQ(
          error_of([&] {
            static_cast<void>(encode_reading({0, 0}, kind.name, sim::PoseReading(), GetParam()));
          }),
          "protocol/bad-value")
          << kind.name;
      continue;
    }
    ++sensors;
    for (int i = 0; i < 20; ++i) {
      const std::unique_ptr<sim::Reading> sent = any_reading(kind.reading, fields);
      const json message =
          value_through(encode_reading({2, 5}, kind.name, *sent, GetParam()), GetParam());
      const DecodedReading decoded = decode_reading(message, GetParam());
      EXPECT_EQ(decoded.device, (DeviceId{2, 5}));
      EXPECT_EQ(decoded.reading->time_ns, sent->time_ns);
      EXPECT_EQ(decoded.reading->sequence, sent->sequence);
      const auto text = [&](const sim::Reading& reading) {
        return FieldText::of(*kind.reading.fields, kind.reading.object(reading));
      };
      ASSERT_EQ(text(*decoded.reading), text(*sent)) << kind.name;
    }
  }
  EXPECT_GE(sensors, 9);
}

/// The fields of a reading as a text.
std::string text_of(const sim::ReadingKind& kind, const DecodedReading& decoded) {
  return std::to_string(decoded.device.robot) + ',' + std::to_string(decoded.device.device) + ',' +
         std::to_string(decoded.reading->sequence) + ',' +
         std::to_string(decoded.reading->time_ns) + ',' +
         FieldText::of(*kind.fields, kind.object(*decoded.reading));
}

TEST(CborReadings, WithoutTree_SameAsTree) {
  RandomFields fields(7);
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    if (kind.reading.fields == nullptr) continue;
    for (int i = 0; i < 20; ++i) {
      const std::unique_ptr<sim::Reading> sent = any_reading(kind.reading, fields);
      std::string written;
      append_cbor_reading({2, 5}, kind.name, *sent, written);
      const json tree = encode_reading({2, 5}, kind.name, *sent, Encoding::kCbor);
      ASSERT_EQ(decode(written, Encoding::kCbor), tree) << kind.name;
      std::string_view rest = written;
      const DecodedReading read = take_cbor_reading(rest);
      EXPECT_TRUE(rest.empty());
      ASSERT_EQ(text_of(kind.reading, read),
                text_of(kind.reading, decode_reading(tree, Encoding::kCbor)))
          << kind.name;
    }
  }
}

// Readings that the reader without a tree does not take itself.
TEST(CborReadings, UnusualOrWrong_SameAsTree) {
  RandomFields fields(8);
  std::mt19937_64 random(9);
  int refused = 0;
  int taken = 0;
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    if (kind.reading.fields == nullptr) continue;
    for (int i = 0; i < 300; ++i) {
      const json whole =
          encode_reading({0, 1}, kind.name, *any_reading(kind.reading, fields), Encoding::kCbor);
      std::string bytes = encode(whole, Encoding::kCbor).substr(4);
      for (auto changes = random() % 4; changes > 0; --changes) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      std::string expected;
      std::string tree_error;
      std::string error;
      const std::string tree_id = error_of(
          [&] {
            const json tree = decode(bytes, Encoding::kCbor);
            expected = text_of(kind.reading, decode_reading(tree, Encoding::kCbor));
          },
          &tree_error);
      std::string read;
      const std::string id = error_of(
          [&] {
            std::string_view rest = bytes;
            const DecodedReading decoded = take_cbor_reading(rest);
            if (!rest.empty()) throw ProtocolError("protocol/syntax", "bytes follow");
            read = text_of(kind.reading, decoded);
          },
          &error);
      ASSERT_EQ(id.empty(), tree_id.empty()) << kind.name << ": " << error << " / " << tree_error;
      ASSERT_EQ(read, expected) << kind.name;
      ++(id.empty() ? taken : refused);
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(taken, 1000);
}

TEST(CborReadings, Lists_DecodedOrRefused) {
  std::string items;
  append_cbor_reading({0, 4}, "pose", sim::PoseReading(), items);
  append_cbor_reading({0, 0}, "laser", sim::LaserReading(), items);
  const std::string message =
      encode({{"id", 1}, {"readings", encoded_list(2, items)}}, Encoding::kCbor).substr(4);
  EXPECT_EQ(decode(message, Encoding::kCbor)["readings"].size(), 2U);
  const json kept = decode(message, Encoding::kCbor, nullptr, "readings");
  const auto bytes_in = [](const json& value) {
    return std::string(value.get_binary().begin(), value.get_binary().end());
  };
  EXPECT_EQ(kept["id"], 1);
  EXPECT_EQ(kept["readings"].get_binary().subtype(), kEncodedItemTag);
  const std::string list = bytes_in(kept["readings"]);
  ASSERT_EQ(decode_cbor_readings(list).size(), 2U);
  EXPECT_EQ(decode_cbor_readings(list)[1].device, (DeviceId{0, 0}));
  for (const std::string& wrong :
       {list.substr(0, list.size() - 1), list + '\x01', '\x83' + list.substr(1),
        '\x9b' + std::string(8, '\x7f'), std::string("\xa0"), std::string("\x81\x05"),
        std::string("\x81\xa0"), std::string()}) {
    EXPECT_NE(error_of([&] { static_cast<void>(decode_cbor_readings(wrong)); }), "");
  }
}

TEST(CborRequests, CommandsAndDrawings_SameAsTree) {
  RandomFields fields(10);
  const std::vector<sim::DrawOperation> drawings = {
      {sim::DrawOperation::Kind::kLine, 3, 1, 2, 3, 4, {5}},
      {sim::DrawOperation::Kind::kFill, 0, 1, 2, 3, 4, {6}}};
  const auto sent = [](const std::string& bytes, Encoding encoding) {
    MessageSplitter splitter(encoding, bytes.size());
    splitter.add(bytes);
    return decode(splitter.next().value(), encoding);
  };
  for (const Encoding encoding : {Encoding::kJson, Encoding::kCbor}) {
    std::string drawn;
    append_draw_request(drawings, encoding, drawn);
    EXPECT_EQ(sent(drawn, encoding),
              (json{{"do", "draw"}, {"drawings", encode_drawings(drawings, encoding)}}));
    for (const auto& kind : sim::command_kinds()) {
      sim::Command command = kind.make();
      fields.fill(kind.fields(), sim::object_in(command));
      std::string bytes;
      append_command_request({1, 2}, command, encoding, bytes);
      const json tree = {{"do", "command"},
                         {"device", encode_device_id({1, 2})},
                         {"command", encode_command(command)}};
      EXPECT_EQ(sent(bytes, encoding), sent(encode(tree, encoding), encoding)) << kind.name;
    }
  }
}

TEST(Readings, TrueLaserPose_NotSent) {
  sim::LaserReading reading;
  reading.X_WB = {1.0, 2.0, 3.0};
  const json message = encode_reading({0, 0}, "laser", reading, Encoding::kCbor);
  const DecodedReading decoded = decode_reading(message, Encoding::kCbor);
  EXPECT_EQ(dynamic_cast<const sim::LaserReading&>(*decoded.reading).X_WB, sim::Pose());
}

TEST(Readings, MatchReference) {
  sim::PoseReading reading;
  reading.time_ns = 100'000'000;
  reading.sequence = 1;
  reading.pose = {0.5, 1.25, 0.0};
  EXPECT_EQ(encode(encode_reading({0, 4}, "pose", reading, Encoding::kJson), Encoding::kJson),
            R"({"device":[0,4],"increment":{"x":0.0,"y":0.0,"yaw":0.0},"lateral":0.0,"omega":0.0,)"
            R"("path_length":0.0,"pitch":0.0,"roll":0.0,"seq":1,"stalled":false,"t":100000000,)"
            R"("type":"pose","v":0.0,"x":0.5,"y":1.25,"yaw":0.0,"z":0.0})"
            "\n");
}

TEST(Readings, UnknownKeys_Accepted) {
  json message = encode_reading({0, 0}, "pose", sim::PoseReading(), Encoding::kJson);
  message["altitude"] = 3;
  EXPECT_NE(decode_reading(message, Encoding::kJson).reading, nullptr);
}

TEST(Readings, MissingOrWrongMembers_Refused) {
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    if (kind.reading.fields == nullptr) continue;
    for (const Encoding encoding : {Encoding::kJson, Encoding::kCbor}) {
      const json whole = encode_reading({0, 0}, kind.name, *kind.reading.make(), encoding);
      const auto refused = [&](const json& message) {
        return error_of([&] { static_cast<void>(decode_reading(message, encoding)); }) ==
               "protocol/bad-value";
      };
      for (const auto& [key, value] : whole.items()) {
        const sim::Field* field = field_of_key(*kind.reading.fields, key);
        json changed = whole;
        changed.erase(key);
        EXPECT_TRUE(refused(changed) || may_be_missing(field)) << kind.name << " without " << key;
        for (const json& wrong : {json(nullptr), json("no such word"), json::object(), json(-1.5),
                                  json({json::object()}), json::array({nullptr})}) {
          if (wrong.type() == value.type() && !value.is_string()) continue;
          const bool any_text = field != nullptr && field->type == sim::FieldType::kText;
          if (any_text && wrong.is_string()) continue;
          changed[key] = wrong;
          EXPECT_TRUE(refused(changed)) << kind.name << " with " << key << " = " << wrong;
        }
      }
    }
  }
  json sonar = encode_reading({0, 0}, "sonar", sim::RangerReading(), Encoding::kJson);
  sonar["ranges"] = {1.0, 2.0};
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_reading(sonar, Encoding::kJson)); }),
            "protocol/bad-value");
}

// --- commands

std::string text_of(const sim::Command& command) {
  return FieldText::of(sim::command_kinds()[command.index()].fields(), sim::object_in(command));
}

std::vector<sim::Command> all_commands(RandomFields& fields) {
  std::vector<sim::Command> commands;
  for (const auto& kind : sim::command_kinds()) {
    fields.fill(kind.fields(), sim::object_in(commands.emplace_back(kind.make())));
  }
  return commands;
}

TEST_P(EachEncoding, Commands_RoundTripExactly) {
  RandomFields fields(6);
  for (int i = 0; i < 20; ++i) {
    for (const sim::Command& sent : all_commands(fields)) {
      const sim::Command received = decode_command(value_through(encode_command(sent), GetParam()));
      ASSERT_EQ(received.index(), sent.index());
      ASSERT_EQ(text_of(received), text_of(sent)) << encode_command(sent);
    }
  }
}

TEST(Commands, MatchReference) {
  const auto line = [](const sim::Command& command) {
    return encode(encode_command(command), Encoding::kJson);
  };
  EXPECT_EQ(line(sim::TwistCommand{{.v_mps = 0.3, .omega_radps = -1.0}}),
            "{\"kind\":\"twist\",\"lateral\":0.0,\"omega\":-1.0,\"v\":0.3}\n");
  EXPECT_EQ(line(sim::MotorEnableCommand{true}), "{\"kind\":\"motors\",\"on\":true}\n");
  const sim::Command short_twist =
      decode_command(json::parse(R"({"kind": "twist", "v": 0.3, "omega": 0})"));
  EXPECT_EQ(std::get<sim::TwistCommand>(short_twist).twist, (sim::Twist{0.3, 0.0, 0.0}));
}

TEST(Commands, MissingWrongOrUnknownMembers_Refused) {
  RandomFields fields(7);
  for (const sim::Command& command : all_commands(fields)) {
    const sim::FieldTable& table = sim::command_kinds()[command.index()].fields();
    const json whole = encode_command(command);
    const auto refused = [](const json& message) {
      return error_of([&] { static_cast<void>(decode_command(message)); }) == "protocol/bad-value";
    };
    for (const auto& [key, value] : whole.items()) {
      json changed = whole;
      changed.erase(key);
      const sim::Field* field = field_of_key(table, key);
      EXPECT_TRUE(refused(changed) || may_be_missing(field)) << whole << " without " << key;
      for (const json& wrong : {json(nullptr), json("x"), json({1}), json(std::nan(""))}) {
        changed[key] = wrong;
        const bool any_text =
            field != nullptr && field->type == sim::FieldType::kText && wrong.is_string();
        const bool any_numbers =
            field != nullptr && field->type == sim::FieldType::kNumbers && wrong.is_array();
        EXPECT_TRUE(refused(changed) || any_text || any_numbers) << changed;
      }
    }
    json more = whole;
    more["omgea"] = 1.0;
    EXPECT_TRUE(refused(more));
  }
  std::string message;
  error_of([] { static_cast<void>(decode_command({{"kind", "fly"}})); }, &message);
  EXPECT_THAT(message, AllOf(HasSubstr("\"fly\""), HasSubstr("twist, "), HasSubstr("rotate")));
  EXPECT_EQ(error_of([] { static_cast<void>(decode_command(3)); }), "protocol/bad-value");
}

// --- other messages

TEST_P(EachEncoding, Robots_RoundTripExactly) {
  RandomFields fields(8);
  for (int i = 0; i < 5; ++i) {
    std::vector<RobotInfo> sent(fields.random()() % 4);
    for (std::size_t r = 0; r < sent.size(); ++r) {
      fields.fill(sim::fields_of<RobotInfo>(), &sent[r]);
      for (std::size_t d = 0; d < sent[r].devices.size(); ++d) {
        sent[r].devices[d].id = {static_cast<int>(r), static_cast<int>(d)};
      }
    }
    const std::vector<RobotInfo> received =
        decode_robots(value_through(encode_robots(sent), GetParam()));
    ASSERT_THAT(received, SizeIs(sent.size()));
    for (std::size_t r = 0; r < sent.size(); ++r) {
      ASSERT_EQ(FieldText::of(received[r]), FieldText::of(sent[r]));
    }
  }
}

TEST(Robots, DevicesOutOfPlaceAndInvalidDrivers_Refused) {
  RobotInfo robot;
  robot.devices.push_back({{0, 1}, "laser", "laser", {}});
  const auto refused = [](const json& robots) {
    return error_of([&] { static_cast<void>(decode_robots(robots)); });
  };
  EXPECT_EQ(refused(encode_robots({robot})), "protocol/bad-value");
  robot.devices[0].id = {0, 0};
  EXPECT_EQ(refused(encode_robots({robot})), "");
  robot.devices.push_back({{0, 1}, "pose", "pose", {}});
  robot.devices.push_back({{0, 2}, "motion", "motion", {}});
  robot.drivers = {{"snd", {{"max_speed", "0.25"}}}, {"of_a_newer_server", {{"a", "b"}}}};
  EXPECT_EQ(refused(encode_robots({robot})), "");
  const std::vector<RobotInfo> received = decode_robots(encode_robots({robot}));
  EXPECT_EQ(received[0].drivers.size(), 2U);
  ASSERT_EQ(received[0].goal_drivers.size(), 1U);
  EXPECT_EQ(received[0].goal_drivers[0].index, 1);
  EXPECT_EQ(std::get<SndSettings>(received[0].goal_drivers[0].settings).max_speed_mps, 0.25);
  robot.drivers[0].settings["max_speed"] = "-1";
  EXPECT_EQ(refused(encode_robots({robot})), "protocol/bad-value");
  EXPECT_EQ(refused(json::object()), "protocol/bad-value");
  EXPECT_EQ(refused({1}), "protocol/bad-value");
}

TEST_P(EachEncoding, CanvasTimeAndLayers_RoundTripExactly) {
  RandomFields fields(9);
  for (int i = 0; i < 20; ++i) {
    CanvasInfo canvas;
    fields.fill(sim::fields_of<CanvasInfo>(), &canvas);
    EXPECT_EQ(FieldText::of(decode_canvas(value_through(encode_canvas(canvas), GetParam()))),
              FieldText::of(canvas));
    TimeStatistics time;
    fields.fill(sim::fields_of<TimeStatistics>(), &time);
    EXPECT_EQ(FieldText::of(decode_time(value_through(encode_time(time), GetParam()))),
              FieldText::of(time));
    std::vector<sim::LayerInfo> layers(1);
    fields.fill(sim::fields_of<sim::LayerInfo>(), &layers[0]);
    const auto received = decode_layers(value_through(encode_layers(layers), GetParam()));
    ASSERT_THAT(received, SizeIs(1));
    EXPECT_EQ(FieldText::of(received[0]), FieldText::of(layers[0]));
  }
}

TEST(Canvas, ImpossibleSize_Refused) {
  const json sound = encode_canvas({172, 186, 0.02, 0.0, 0.0});
  const auto refused = [&](const char* key, const json& value) {
    json canvas = sound;
    canvas[key] = value;
    return error_of([&] { static_cast<void>(decode_canvas(canvas)); }) == "protocol/bad-value";
  };
  EXPECT_FALSE(refused("width", 8192));
  EXPECT_TRUE(refused("width", 8193));
  EXPECT_TRUE(refused("height", 0));
  EXPECT_TRUE(refused("cell_size", 0));
  EXPECT_TRUE(refused("x", nullptr));
}

TEST(Time, UnknownMode_Refused) {
  json time = encode_time({});
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_time(time)); }), "");
  time["mode"] = "fast";
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_time(time)); }), "protocol/bad-value");
}

TEST(Styles, DefaultsAndUnknownValues_Handled) {
  EXPECT_EQ(decode_style(json::object()), sim::LayerStyle());
  EXPECT_EQ(decode_style({{"name", "way"}, {"colour", "#f00"}}),
            (sim::LayerStyle{.name = "way", .colour = {255, 0, 0, 255}}));
  for (const json& wrong :
       {json{{"color", "#f00"}}, json{{"colour", "red"}}, json{{"colour", 3}},
        json{{"transparency", "half"}}, json{{"priority", 1.5}}, json{{"priority", 4294967296}},
        json{{"visible", 1}}, json{{"name", nullptr}}, json{{"transparent_colour", ""}}, json(1)}) {
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_style(wrong)); }), "protocol/bad-value")
        << wrong;
  }
  for (const json& wrong : {json("red"), json(nullptr), json(0)}) {
    const json layer = {{"layer", 1}, {"kind", wrong}, {"owner", 0}, {"style", json::object()}};
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_layers(json::array({layer}))); }),
              "protocol/bad-value");
  }
}

TEST_P(EachEncoding, Maps_RoundTripExactly) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 50; ++i) {
    sim::OccupancyMap sent{static_cast<int>(1 + random() % 40),
                           static_cast<int>(1 + random() % 40),
                           1e-300 + std::abs(any_double(random)),
                           {any_double(random), any_double(random)},
                           {}};
    sent.cells.resize(static_cast<std::size_t>(sent.width * sent.height));
    for (float& cell : sent.cells) cell = static_cast<float>(random() >> 40U) * 0x1p-24F;
    const sim::OccupancyMap received =
        decode_map(value_through(encode_map(sent, GetParam()), GetParam()), GetParam());
    EXPECT_EQ(received.width, sent.width);
    EXPECT_EQ(received.height, sent.height);
    EXPECT_EQ(received.cell_size_m, sent.cell_size_m);
    EXPECT_EQ(received.origin, sent.origin);
    EXPECT_EQ(received.cells, sent.cells);
  }
}

TEST_P(EachEncoding, MapsWithWrongCells_Refused) {
  sim::OccupancyMap map{3, 2, 0.02, {0.0, 0.0}, std::vector<float>(6, 1.0F)};
  const auto refused = [&] {
    return error_of(
        [&] { static_cast<void>(decode_map(encode_map(map, GetParam()), GetParam())); });
  };
  EXPECT_EQ(refused(), "");
  for (const float wrong : {-0.1F, 1.1F, std::nanf("")}) {
    map.cells[5] = wrong;
    EXPECT_EQ(refused(), "protocol/bad-value") << wrong;
  }
  map.cells.assign(5, 0.0F);
  EXPECT_EQ(refused(), "protocol/bad-value");
}

using Kind = sim::DrawOperation::Kind;

std::string written(const sim::DrawOperation& v) {
  std::string text;
  for (const std::int64_t number :
       {std::int64_t{static_cast<int>(v.kind)}, std::int64_t{v.layer}, std::int64_t{v.x0},
        std::int64_t{v.y0}, std::int64_t{v.x1}, std::int64_t{v.y1}, std::int64_t{v.value.bits}}) {
    text += std::to_string(number) + ' ';
  }
  return text;
}

TEST_P(EachEncoding, Drawings_RoundTrip) {
  std::mt19937_64 random(11);
  const auto any_int = [&] { return static_cast<int>(random()); };
  std::vector<sim::DrawOperation> sent(1000);
  for (sim::DrawOperation& drawing : sent) {
    drawing = {static_cast<Kind>(random() % 3),
               any_int(),
               any_int(),
               any_int(),
               any_int(),
               any_int(),
               {static_cast<std::uint32_t>(random())}};
  }
  const std::vector<sim::DrawOperation> received =
      decode_drawings(value_through(encode_drawings(sent, GetParam()), GetParam()), GetParam());
  ASSERT_THAT(received, SizeIs(sent.size()));
  for (std::size_t i = 0; i < sent.size(); ++i) {
    // Members that a kind does not use are not sent: they may be uninitialised.
    if (sent[i].kind != Kind::kLine) sent[i].x1 = sent[i].y1 = 0;
    if (sent[i].kind == Kind::kFill) sent[i].x0 = sent[i].y0 = 0;
    ASSERT_EQ(written(received[i]), written(sent[i]));
  }
  const json none = value_through(encode_drawings({}, GetParam()), GetParam());
  EXPECT_THAT(decode_drawings(none, GetParam()), IsEmpty());
}

TEST(Drawings, MatchReference) {
  const std::vector<sim::DrawOperation> drawings = {
      {Kind::kPixel, 0, 3, 4, 0, 0, sim::CellValue::of(sim::Colour{255, 0, 0, 255})},
      {Kind::kLine, 2, 0, 1, 5, -6, sim::CellValue::of(true)},
      {Kind::kFill, 1, 0, 0, 0, 0, sim::CellValue::of(0.5F)}};
  // Red is the lowest of the four bytes, alpha the highest; 0.5 as a float is 0x3f000000.
  EXPECT_EQ(encode(encode_drawings(drawings, Encoding::kJson), Encoding::kJson),
            "[[\"pixel\",0,3,4,4278190335],[\"line\",2,0,1,5,-6,1],[\"fill\",1,1056964608]]\n");
  const json bytes = encode_drawings(std::span(drawings).first(2), Encoding::kCbor);
  const std::vector<std::uint8_t>& data = bytes.get_binary();
  const std::vector<std::uint8_t> expected = {0, 0, 0, 0, 0, 0, 0,   0,   3,   0,   0,   0, 4, 0,
                                              0, 0, 0, 0, 0, 0, 0,   0,   0,   0,   255, 0, 0, 255,
                                              1, 0, 0, 0, 2, 0, 0,   0,   0,   0,   0,   0, 1, 0,
                                              0, 0, 5, 0, 0, 0, 250, 255, 255, 255, 1,   0, 0, 0};
  EXPECT_EQ(data, expected);
}

TEST(Drawings, InvalidDrawings_Refused) {
  for (const json& wrong :
       {json(1), json::array({1}), json::array({json::array()}), json{{"dot", 0, 1, 1, 0}},
        json{{"pixel", 0, 1, 1}}, json{{"pixel", 0, 1, 1, 0, 0}}, json{{"pixel", 0, 1.5, 1, 0}},
        json{{"pixel", 0, 1, 1, -1}}, json{{"pixel", 0, 1, 1, 4294967296}},
        json{{"pixel", 0, 2147483648, 1, 0}}, json{{"fill", "0", 1}}, json{{0, 0, 1, 1, 0}}}) {
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_drawings(wrong, Encoding::kJson)); }),
              "protocol/bad-value")
        << wrong;
  }
  std::vector<std::uint8_t> data(28);
  const auto refused = [&] {
    return error_of(
        [&] { static_cast<void>(decode_drawings(bytes(data, Encoding::kCbor), Encoding::kCbor)); });
  };
  EXPECT_EQ(refused(), "");
  data[0] = 3;
  EXPECT_EQ(refused(), "protocol/bad-value");
  data[0] = 0;
  data[3] = 0x80;
  EXPECT_EQ(refused(), "protocol/bad-value");
  data.assign(27, 0);
  EXPECT_EQ(refused(), "protocol/bad-value");
  EXPECT_EQ(error_of([] { static_cast<void>(decode_drawings("AAAA", Encoding::kCbor)); }),
            "protocol/bad-value");
}

TEST_P(EachEncoding, Cells_RoundTrip) {
  std::mt19937_64 random(12);
  std::vector<sim::CellValue> sent(1000);
  for (sim::CellValue& cell : sent) cell.bits = static_cast<std::uint32_t>(random());
  EXPECT_EQ(decode_cells(value_through(encode_cells(sent, GetParam()), GetParam()), GetParam()),
            sent);
  for (const std::size_t size : {1U, 2U, 3U, 5U}) {
    const json wrong = bytes(std::vector<std::uint8_t>(size), GetParam());
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_cells(wrong, GetParam())); }),
              "protocol/bad-value");
  }
}

TEST(Cells, MatchReference) {
  const std::vector<sim::CellValue> cells = {sim::CellValue::of(sim::Colour{1, 2, 3, 4}),
                                             sim::CellValue::of(true), sim::CellValue::of(1.0F)};
  EXPECT_THAT(encode_cells(cells, Encoding::kCbor).get_binary(),
              ElementsAre(1, 2, 3, 4, 1, 0, 0, 0, 0, 0, 0x80, 0x3f));
}

TEST(Errors, SessionErrors_NamesRoundTrip) {
  using Code = SessionError::Code;
  for (const Code code : {Code::kFinished, Code::kDisconnected, Code::kNoSuchDevice,
                          Code::kNotAvailable, Code::kBadArgument}) {
    EXPECT_EQ(session_error_code(error_id(code)), code);
    EXPECT_THAT(std::string(error_id(code)), testing::StartsWith("session/"));
  }
  EXPECT_EQ(error_id(Code::kFinished), "session/finished");
  EXPECT_EQ(session_error_code("protocol/syntax"), std::nullopt);
}

}  // namespace
}  // namespace playerlike::protocol
