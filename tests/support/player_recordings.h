// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The recorded conversations in tests/golden/player_wire.
namespace playpen::test {

/// A recorded conversation; see README.md in the folder of the recordings.
struct PlayerRecording {
  std::string name;
  std::string client;        ///< bytes to the server
  std::string server;        ///< bytes to the client, with the banner
  nlohmann::json described;  ///< the content of NAME.json

  /// The bytes of a message, an element of described["messages"].
  [[nodiscard]] std::string_view bytes_of(const nlohmann::json& message) const {
    const std::string& from = message.at("direction") == "client" ? client : server;
    constexpr std::size_t kHeader = 40;
    return std::string_view(from).substr(message.at("offset").get<std::size_t>(),
                                         kHeader + message.at("size").get<std::size_t>());
  }
};

inline std::filesystem::path player_recordings_folder() {
  return PLAYPEN_SOURCE_DIR "/tests/golden/player_wire";
}

/// Names of all recordings, sorted.
inline std::vector<std::string> player_recording_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(player_recordings_folder())) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline PlayerRecording player_recording(const std::string& name) {
  const auto read = [&](const std::string& ending) {
    const std::filesystem::path file = player_recordings_folder() / (name + ending);
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("no recording " + file.string());
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  return {name, read(".client.bin"), read(".server.bin"), nlohmann::json::parse(read(".json"))};
}

}  // namespace playpen::test
