// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "read_mcap.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <stdexcept>

namespace playpen::test {

std::vector<McapFile::Message> McapFile::of(const std::string& topic) const {
  std::vector<Message> found;
  for (const Message& message : messages) {
    if (channels.at(message.channel).topic == topic) found.push_back(message);
  }
  return found;
}

namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Takes values from the front of bytes.
struct Input {
  std::string_view rest;

  std::string_view take(std::uint64_t count) {
    if (count > rest.size()) throw std::runtime_error("the MCAP file ends too early");
    const std::string_view taken = rest.substr(0, count);
    rest.remove_prefix(count);
    return taken;
  }
  template <typename Unsigned>
  Unsigned number() {
    std::uint64_t value = 0;
    const std::string_view bytes = take(sizeof(Unsigned));
    for (std::size_t i = bytes.size(); i > 0; --i) {
      value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
    }
    return static_cast<Unsigned>(value);
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
};

struct Record {
  std::uint64_t offset = 0;  ///< of its opcode
  std::uint64_t length = 0;  ///< with opcode and length
  int opcode = 0;
  std::string_view content;
};

std::vector<Record> records_in(std::string_view bytes, std::uint64_t offset) {
  std::vector<Record> records;
  for (Input input{bytes}; !input.rest.empty();) {
    Record& record = records.emplace_back();
    record.offset = offset;
    record.opcode = input.number<std::uint8_t>();
    record.content = input.take(input.number<std::uint64_t>());
    record.length = 9 + record.content.size();
    offset += record.length;
  }
  return records;
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  McapFile read() {
    EXPECT_EQ(bytes_.substr(0, 8), kMagic);
    EXPECT_EQ(bytes_.substr(bytes_.size() - 8), kMagic);
    const std::vector<Record> records = records_in(bytes_.substr(8, bytes_.size() - 16), 8);
    EXPECT_EQ(records.front().opcode, 0x01);
    EXPECT_EQ(records.back().opcode, 0x02);
    for (const Record& record : records) read(record);
    const auto end = std::ranges::find(records, 0x0f, &Record::opcode);
    if (end == records.end()) throw std::runtime_error("no DataEnd");
    EXPECT_EQ(Input{end->content}.number<std::uint32_t>(), checksum(bytes_.substr(0, end->offset)));
    check_footer(records.back(), end->offset + end->length);
    EXPECT_EQ(chunk_indexes_, file_.chunks);
    EXPECT_EQ(indexed_, file_.messages.size());
    EXPECT_TRUE(has_statistics_);
    return file_;
  }

 private:
  void read(const Record& record) {
    Input input{record.content};
    switch (record.opcode) {
      case 0x01:
        EXPECT_EQ(input.text(), "");
        file_.library = input.text();
        break;
      case 0x03:
        return read_schema(input);
      case 0x04:
        return read_channel(input);
      case 0x05:
        return read_message(input);
      case 0x06:
        return read_chunk(record, input);
      case 0x07:
        return read_message_index(record, input);
      case 0x08:
        return check_chunk_index(input);
      case 0x0b:
        return check_statistics(input);
      case 0x0e: {
        const int opcode = input.number<std::uint8_t>();
        const auto start = input.number<std::uint64_t>();
        for (const Record& one :
             records_in(bytes_.substr(start, input.number<std::uint64_t>()), start)) {
          EXPECT_EQ(one.opcode, opcode);
        }
        break;
      }
      default:
        EXPECT_TRUE(record.opcode == 0x02 || record.opcode == 0x0f) << record.opcode;
        return;
    }
    EXPECT_TRUE(input.rest.empty());
  }

  void read_schema(Input input) {
    const auto id = input.number<std::uint16_t>();
    const std::string name(input.text());
    EXPECT_EQ(input.text(), "jsonschema");
    schemas_[id] = {name, std::string(input.text())};
    file_.schemas = schemas_.size();
  }

  void read_channel(Input input) {
    const auto id = input.number<std::uint16_t>();
    const auto [name, schema] = schemas_.at(input.number<std::uint16_t>());
    file_.channels[id] = {std::string(input.text()), name, schema};
    EXPECT_EQ(input.text(), "json");
    EXPECT_EQ(input.text(), "");
  }

  void read_message(Input input) {
    McapFile::Message& message = file_.messages.emplace_back();
    message.channel = input.number<std::uint16_t>();
    EXPECT_TRUE(file_.channels.contains(message.channel));
    message.sequence = input.number<std::uint32_t>();
    message.log_ns = input.number<std::uint64_t>();
    message.publish_ns = input.number<std::uint64_t>();
    message.data = input.rest;
  }

  void read_chunk(const Record& record, Input input) {
    const auto first_ns = input.number<std::uint64_t>();
    const auto last_ns = input.number<std::uint64_t>();
    const auto size = input.number<std::uint64_t>();
    const auto crc = input.number<std::uint32_t>();
    EXPECT_EQ(input.text(), "");
    EXPECT_EQ(input.number<std::uint64_t>(), size);
    EXPECT_EQ(input.rest.size(), size);
    EXPECT_EQ(checksum(input.rest), crc);
    chunk_ = input.rest;
    chunk_record_ = record;
    const std::size_t before = file_.messages.size();
    for (const Record& one : records_in(chunk_, 0)) read(one);
    std::vector<std::uint64_t> times;
    for (std::size_t i = before; i < file_.messages.size(); ++i) {
      times.push_back(file_.messages[i].log_ns);
    }
    EXPECT_EQ(first_ns, times.empty() ? 0 : std::ranges::min(times));
    EXPECT_EQ(last_ns, times.empty() ? 0 : std::ranges::max(times));
    chunks_[record.offset] = {record.content.substr(0, 16), {}, record.length, size, 0};
    ++file_.chunks;
  }

  void read_message_index(const Record& record, Input input) {
    const auto channel = input.number<std::uint16_t>();
    for (Input entries{input.text()}; !entries.rest.empty(); ++indexed_) {
      const auto time_ns = entries.number<std::uint64_t>();
      Input message{chunk_.substr(entries.number<std::uint64_t>())};
      EXPECT_EQ(message.number<std::uint8_t>(), 0x05);
      message.number<std::uint64_t>();
      EXPECT_EQ(message.number<std::uint16_t>(), channel);
      message.number<std::uint32_t>();
      EXPECT_EQ(message.number<std::uint64_t>(), time_ns);
    }
    Chunk& own = chunks_.at(chunk_record_.offset);
    own.indexes[channel] = record.offset;
    own.index_length += record.length;
  }

  void check_chunk_index(Input input) {
    ++chunk_indexes_;
    const std::string_view times = input.take(16);
    const auto start = input.number<std::uint64_t>();
    ASSERT_TRUE(chunks_.contains(start));
    const Chunk& own = chunks_.at(start);
    EXPECT_EQ(times, own.times);
    EXPECT_EQ(input.number<std::uint64_t>(), own.length);
    std::map<std::uint16_t, std::uint64_t> indexes;
    for (Input entries{input.text()}; !entries.rest.empty();) {
      const auto channel = entries.number<std::uint16_t>();
      indexes[channel] = entries.number<std::uint64_t>();
    }
    EXPECT_EQ(indexes, own.indexes);
    EXPECT_EQ(input.number<std::uint64_t>(), own.index_length);
    EXPECT_EQ(input.text(), "");
    EXPECT_EQ(input.number<std::uint64_t>(), own.size);
    EXPECT_EQ(input.number<std::uint64_t>(), own.size);
  }

  void check_statistics(Input input) {
    has_statistics_ = true;
    std::map<std::uint16_t, std::uint64_t> counts;
    std::vector<std::uint64_t> times = {};
    for (const McapFile::Message& message : file_.messages) {
      ++counts[message.channel];
      times.push_back(message.log_ns);
    }
    EXPECT_EQ(input.number<std::uint64_t>(), file_.messages.size());
    EXPECT_EQ(input.number<std::uint16_t>(), schemas_.size());
    EXPECT_EQ(input.number<std::uint32_t>(), file_.channels.size());
    EXPECT_EQ(input.number<std::uint32_t>(), 0U);
    EXPECT_EQ(input.number<std::uint32_t>(), 0U);
    EXPECT_EQ(input.number<std::uint32_t>(), file_.chunks);
    EXPECT_EQ(input.number<std::uint64_t>(), times.empty() ? 0 : std::ranges::min(times));
    EXPECT_EQ(input.number<std::uint64_t>(), times.empty() ? 0 : std::ranges::max(times));
    std::map<std::uint16_t, std::uint64_t> stated;
    for (Input entries{input.text()}; !entries.rest.empty();) {
      const auto channel = entries.number<std::uint16_t>();
      stated[channel] = entries.number<std::uint64_t>();
    }
    EXPECT_EQ(stated, counts);
  }

  void check_footer(const Record& footer, std::uint64_t summary) {
    Input input{footer.content};
    EXPECT_EQ(input.number<std::uint64_t>(), summary);
    const auto offsets = input.number<std::uint64_t>();
    const std::vector<Record> records =
        records_in(bytes_.substr(offsets, footer.offset - offsets), offsets);
    EXPECT_TRUE(std::ranges::all_of(records, [](const Record& r) { return r.opcode == 0x0e; }));
    const std::uint64_t end = footer.offset + 9 + 16;
    EXPECT_EQ(input.number<std::uint32_t>(), checksum(bytes_.substr(summary, end - summary)));
  }

  struct Chunk {
    std::string_view times;
    std::map<std::uint16_t, std::uint64_t> indexes;
    std::uint64_t length = 0;
    std::uint64_t size = 0;
    std::uint64_t index_length = 0;
  };

  std::string_view bytes_;
  McapFile file_;
  std::map<std::uint16_t, std::pair<std::string, std::string>> schemas_;
  std::map<std::uint64_t, Chunk> chunks_;
  std::string_view chunk_;
  Record chunk_record_;
  std::size_t chunk_indexes_ = 0;
  std::size_t indexed_ = 0;
  bool has_statistics_ = false;
};

}  // namespace

McapFile read_mcap(std::string_view bytes) { return Reader(bytes).read(); }

}  // namespace playpen::test
