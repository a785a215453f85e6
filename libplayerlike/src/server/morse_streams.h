// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "server/peer.h"

namespace playerlike::server {

class MorseState;
struct MorseComponent;

/// The data streams of a server: one TCP port for each component with a stream, opened on the first
/// request. Used by the server's thread only.
class MorseStreams {
 public:
  explicit MorseStreams(MorseState& state);
  ~MorseStreams();
  MorseStreams(const MorseStreams&) = delete;
  MorseStreams& operator=(const MorseStreams&) = delete;

  /// The port of a component's stream. @pre it has a stream. @throws protocol::ProtocolError
  /// server/no-port.
  int port(const MorseComponent& component);
  /// Opens the ports of all devices with a stream, in the order of components. @throws as port().
  void open_all();

 private:
  class Source;
  class Reader;
  class Writer;
  struct Stream {
    int port = 0;
    std::shared_ptr<Source> source;  ///< of a stream that clients read
  };

  MorseState& state_;
  std::map<std::string, Stream> streams_;  ///< by component name
  int next_port_;
};

}  // namespace playerlike::server
