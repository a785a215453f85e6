// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/mcap_writer.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "sim/core/assert.h"

namespace playpen::replay {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = 1 << 20;  // a chunk that has more is complete

// Opcodes of records.
constexpr std::uint8_t kHeader = 0x01;
constexpr std::uint8_t kFooter = 0x02;
constexpr std::uint8_t kSchema = 0x03;
constexpr std::uint8_t kChannel = 0x04;
constexpr std::uint8_t kMessage = 0x05;
constexpr std::uint8_t kChunk = 0x06;
constexpr std::uint8_t kMessageIndex = 0x07;
constexpr std::uint8_t kChunkIndex = 0x08;
constexpr std::uint8_t kStatistics = 0x0b;
constexpr std::uint8_t kSummaryOffset = 0x0e;
constexpr std::uint8_t kDataEnd = 0x0f;

/// The content of a record: little-endian numbers, and texts with their lengths before them.
class Content {
 public:
  template <typename Unsigned>
  Content& number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_ += static_cast<char>((std::uint64_t{value} >> (8 * i)) & 0xff);
    }
    return *this;
  }
  Content& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    return raw(value);
  }
  Content& raw(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

std::string record_of(std::uint8_t opcode, std::string_view content) {
  return Content().number(opcode).number(std::uint64_t{content.size()}).raw(content).bytes();
}

unsigned long checksum_with(unsigned long before, std::string_view bytes) {
  return crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(checksum_with(0, bytes));
}

}  // namespace

void McapWriter::TimeSpan::add(std::uint64_t time_ns, bool is_first) {
  first_ns = is_first ? time_ns : std::min(first_ns, time_ns);
  last_ns = is_first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(std::ostream& out) : out_(out) {
  put(kMagic);
  put_record(kHeader, Content().text("").text("playpen").bytes());
}

void McapWriter::put(std::string_view bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  size_ += bytes.size();
  checksum_ = checksum_with(checksum_, bytes);
}

void McapWriter::put_record(std::uint8_t opcode, const std::string& content) {
  put(record_of(opcode, content));
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& schema_name,
                                      const std::string& schema) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (channels_.size() == kMost) throw std::length_error("an MCAP file has at most 65535 channels");
  const auto [found, is_new] = schema_ids_.try_emplace(
      {schema_name, schema}, static_cast<std::uint16_t>(schemas_.size() + 1));
  if (is_new) {
    schemas_.push_back(record_of(
        kSchema,
        Content().number(found->second).text(schema_name).text("jsonschema").text(schema).bytes()));
    chunk_ += schemas_.back();
  }
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  Content content;
  content.number(id).number(found->second).text(topic).text("json").text("");
  channels_.push_back({record_of(kChannel, content.bytes()), 0, {}});
  chunk_ += channels_.back().record;
  return id;
}

void McapWriter::write(std::uint16_t channel, sim::SimTime log_ns, sim::SimTime publish_ns,
                       std::string_view data) {
  SIM_ASSERT(channel >= 1 && channel <= channels_.size());
  Channel& own = channels_[channel - std::size_t{1}];
  const auto time_ns = static_cast<std::uint64_t>(log_ns);
  own.index.emplace_back(time_ns, chunk_.size());
  Content content;
  content.number(channel).number(own.messages++).number(time_ns);
  content.number(static_cast<std::uint64_t>(publish_ns)).raw(data);
  chunk_ += record_of(kMessage, content.bytes());
  chunk_times_.add(time_ns, !chunk_has_messages_);
  times_.add(time_ns, messages_ == 0);
  chunk_has_messages_ = true;
  ++messages_;
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t start = size_;
  const std::uint64_t bytes = chunk_.size();
  Content times;
  times.number(chunk_times_.first_ns).number(chunk_times_.last_ns);
  Content content;
  content.raw(times.bytes()).number(bytes).number(checksum_of(chunk_)).text("");
  put_record(kChunk, content.number(bytes).raw(chunk_).bytes());
  const std::uint64_t length = size_ - start;
  Content places;  // of the message indexes
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    const auto id = static_cast<std::uint16_t>(i + 1);
    places.number(id).number(size_);
    Content entries;
    for (const auto& [time_ns, offset] : channels_[i].index) entries.number(time_ns).number(offset);
    put_record(kMessageIndex, Content().number(id).text(entries.bytes()).bytes());
    channels_[i].index.clear();
  }
  Content index;
  index.raw(times.bytes()).number(start).number(length).text(places.bytes());
  index.number(size_ - start - length).text("").number(bytes).number(bytes);
  chunk_indexes_.push_back(record_of(kChunkIndex, index.bytes()));
  chunk_.clear();
  chunk_times_ = {};
  chunk_has_messages_ = false;
}

std::string McapWriter::statistics() const {
  Content content;
  content.number(messages_).number(static_cast<std::uint16_t>(schemas_.size()));
  content.number(static_cast<std::uint32_t>(channels_.size()));
  content.number(std::uint32_t{0}).number(std::uint32_t{0});  // attachments, metadata
  content.number(static_cast<std::uint32_t>(chunk_indexes_.size()));
  content.number(times_.first_ns).number(times_.last_ns);
  Content counts;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].messages == 0) continue;
    counts.number(static_cast<std::uint16_t>(i + 1)).number(std::uint64_t{channels_[i].messages});
  }
  return content.text(counts.bytes()).bytes();
}

void McapWriter::close() {
  end_chunk();
  put_record(kDataEnd, Content().number(static_cast<std::uint32_t>(checksum_)).bytes());
  const std::uint64_t summary = size_;
  checksum_ = 0;
  std::string offsets;
  const auto put_group = [&](std::uint8_t opcode, const std::vector<std::string>& records) {
    const std::uint64_t start = size_;
    for (const std::string& record : records) put(record);
    if (size_ == start) return;
    offsets += record_of(kSummaryOffset,
                         Content().number(opcode).number(start).number(size_ - start).bytes());
  };
  std::vector<std::string> channels;
  for (const Channel& channel : channels_) channels.push_back(channel.record);
  put_group(kSchema, schemas_);
  put_group(kChannel, channels);
  put_group(kStatistics, {record_of(kStatistics, statistics())});
  put_group(kChunkIndex, chunk_indexes_);
  const std::uint64_t summary_offsets = size_;
  put(offsets);
  // The summary's checksum includes the footer up to the checksum itself.
  constexpr std::uint64_t kFooterBytes = 8 + 8 + 4;
  put(Content()
          .number(kFooter)
          .number(kFooterBytes)
          .number(summary)
          .number(summary_offsets)
          .bytes());
  put(Content().number(static_cast<std::uint32_t>(checksum_)).bytes());
  put(kMagic);
  out_.flush();
}

}  // namespace playpen::replay
