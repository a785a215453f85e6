// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace playpen::test {

/// What an MCAP file contains.
struct McapFile {
  struct Channel {
    std::string topic;
    std::string schema_name;
    std::string schema;
  };
  struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_ns = 0;
    std::uint64_t publish_ns = 0;
    std::string data;
  };
  std::string library;
  std::map<std::uint16_t, Channel> channels;
  std::vector<Message> messages;  ///< in the file's order
  std::size_t schemas = 0;
  std::size_t chunks = 0;

  /// The messages of a topic.
  [[nodiscard]] std::vector<Message> of(const std::string& topic) const;
};

/// Reads a file by the specification (https://mcap.dev/spec), independently of the writer. Fails
/// the test if a record, index, count, or checksum is wrong.
[[nodiscard]] McapFile read_mcap(std::string_view bytes);

}  // namespace playpen::test
