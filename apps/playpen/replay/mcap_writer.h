// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/time.h"

namespace playpen::replay {

/// Writes a file of timed messages in the format MCAP, version 0, for Foxglove and the libraries of
/// https://mcap.dev. Messages and schemas are JSON.
///
/// Source: the MCAP specification (https://mcap.dev/spec). The file has chunks without compression,
/// message indexes, a summary with statistics, and all checksums. Equal calls write equal bytes.
/// docs/decisions/mcap.md states why Playpen has its own writer. Not thread-safe.
class McapWriter {
 public:
  /// Writes the head of the file.
  /// @param out  opened in binary mode; it must outlive the writer. The caller checks its state.
  explicit McapWriter(std::ostream& out);

  /// Adds a channel of JSON messages.
  /// @param schema_name  e.g. "foxglove.LaserScan".
  /// @param schema  JSON Schema of the messages. Channels with the same name and text share it.
  /// @return the channel's number. @throws std::length_error after 65535 channels.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name,
                            const std::string& schema);
  /// Adds a message.
  /// @param log_ns  by which readers sort messages, >= 0. @param publish_ns  >= 0.
  /// @param data  JSON.
  /// @pre the channel exists (asserted).
  void write(std::uint16_t channel, sim::SimTime log_ns, sim::SimTime publish_ns,
             std::string_view data);
  /// Writes the summary and the end of the file. Without it, the file is incomplete.
  /// @pre it is called once, after all messages.
  void close();

 private:
  struct Channel {
    std::string record;
    std::uint32_t messages = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index;  ///< time and offset in the chunk
  };
  /// First and last time of messages.
  struct TimeSpan {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    void add(std::uint64_t time_ns, bool is_first);
  };

  void put(std::string_view bytes);
  void put_record(std::uint8_t opcode, const std::string& content);
  void end_chunk();
  [[nodiscard]] std::string statistics() const;

  std::ostream& out_;
  std::uint64_t size_ = 0;      ///< bytes written
  unsigned long checksum_ = 0;  ///< of the bytes of the present section
  std::map<std::pair<std::string, std::string>, std::uint16_t> schema_ids_;
  std::vector<std::string> schemas_;  ///< records
  std::vector<Channel> channels_;     ///< number i + 1
  std::vector<std::string> chunk_indexes_;
  std::string chunk_;  ///< records of the open chunk
  TimeSpan chunk_times_;
  bool chunk_has_messages_ = false;
  TimeSpan times_;
  std::uint64_t messages_ = 0;
};

}  // namespace playpen::replay
