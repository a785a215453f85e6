// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/mcap_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "read_mcap.h"

namespace playpen::replay {
namespace {

using test::McapFile;
using test::read_mcap;
using testing::ElementsAre;

std::string written(int messages, std::size_t bytes_each) {
  std::ostringstream out;
  McapWriter writer(out);
  const auto a = writer.add_channel("/a", "Text", R"({"type":"object"})");
  const auto b = writer.add_channel("/b", "Text", R"({"type":"object"})");
  const auto c = writer.add_channel("/c", "Number", R"({"type":"number"})");
  writer.add_channel("/unused", "Text", R"({"type":"object"})");
  for (int i = 0; i < messages; ++i) {
    writer.write(i % 2 == 0 ? a : b, 10 * i, 10 * i - (i > 0 ? 5 : 0),
                 std::string(bytes_each, 'x'));
  }
  if (messages > 0) writer.write(c, 7, 3, "4.5");
  writer.close();
  return out.str();
}

TEST(McapWriter, FewMessages_ReadBack) {
  const McapFile file = read_mcap(written(3, 4));
  EXPECT_EQ(file.library, "playpen");
  ASSERT_EQ(file.messages.size(), 4U);
  EXPECT_EQ(file.channels.at(file.messages[1].channel).topic, "/b");
  EXPECT_EQ(file.messages[1].log_ns, 10U);
  EXPECT_EQ(file.messages[1].publish_ns, 5U);
  EXPECT_EQ(file.messages[1].data, "xxxx");
  EXPECT_EQ(file.messages[2].sequence, 1U);  // the second one of its channel
  EXPECT_EQ(file.messages[3].log_ns, 7U);
  EXPECT_EQ(file.channels.at(file.messages[3].channel).schema_name, "Number");
  EXPECT_EQ(file.channels.at(file.messages[3].channel).schema, R"({"type":"number"})");
  EXPECT_EQ(file.schemas, 2U);
  EXPECT_EQ(file.channels.size(), 4U);
  EXPECT_EQ(file.chunks, 1U);
}

TEST(McapWriter, MoreThanChunkHolds_SeveralChunks) {
  const McapFile file = read_mcap(written(50, 100'000));
  EXPECT_EQ(file.messages.size(), 51U);
  EXPECT_EQ(file.chunks, 5U);  // of 11 messages each, but the last
}

TEST(McapWriter, NoMessages_ValidFile) {
  const McapFile file = read_mcap(written(0, 0));
  EXPECT_EQ(file.messages.size(), 0U);
  EXPECT_EQ(file.channels.size(), 4U);
}

TEST(McapWriter, NothingAtAll_ValidFile) {
  std::ostringstream out;
  McapWriter(out).close();
  EXPECT_EQ(read_mcap(out.str()).chunks, 0U);
}

TEST(McapWriter, SameCalls_SameBytes) { EXPECT_TRUE(written(40, 50) == written(40, 50)); }

TEST(McapWriter, TooManyChannels_Refused) {
  std::ostringstream out;
  McapWriter writer(out);
  for (int i = 1; i <= 65535; ++i) EXPECT_EQ(writer.add_channel("/t", "S", "{}"), i);
  EXPECT_THROW(writer.add_channel("/t", "S", "{}"), std::length_error);
}

}  // namespace
}  // namespace playpen::replay
