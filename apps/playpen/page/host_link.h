// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
// Boost 1.74 uses std::exchange without its header, so these come after it.
#include <boost/asio/buffer.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "outbox.h"
#include "playerlike/page/protocol.h"

namespace playpen::page {

namespace wire = playerlike::page;

/// The connection to the host (playerlike/page/protocol.h). For page_server.cpp alone, since it
/// shows types of Boost. Only the thread of its io_context uses it.
class HostLink {
 public:
  /// TCP and socketpairs alike.
  using Protocol = boost::asio::generic::stream_protocol;
  using Socket = Protocol::socket;
  using Error = boost::system::error_code;
  using OnMessage =
      std::function<void(wire::HostKind, std::uint32_t client, const Bytes& contents)>;

  HostLink(boost::asio::io_context& io, int descriptor)
      : socket_(io, Protocol(AF_UNIX, 0), descriptor) {}

  /// Reads messages until the end.
  /// @param on_end  called once: the host has closed its end, or has sent what is no message.
  void start(OnMessage on_message, std::function<void()> on_end) {
    on_message_ = std::move(on_message);
    on_end_ = std::move(on_end);
    read_header();
  }

  /// Sends a message as soon as the host has taken those before it.
  void send(wire::PageKind kind, std::uint32_t client = 0, std::string_view contents = {}) {
    waiting_ += wire::page_message(kind, client, contents);
    write();
  }

  /// Bytes that the host has not taken yet.
  [[nodiscard]] std::size_t backlog() const { return waiting_.size() + writing_.size(); }

 private:
  void read_header() {
    boost::asio::async_read(socket_, boost::asio::buffer(&header_, sizeof header_),
                            [this](const Error& error, std::size_t) {
                              if (error || !wire::is_from_host(header_)) return on_end_();
                              contents_ = std::make_shared<std::string>(header_.length, '\0');
                              read_contents();
                            });
  }

  void read_contents() {
    boost::asio::async_read(
        socket_, boost::asio::buffer(*contents_), [this](const Error& error, std::size_t) {
          if (error) return on_end_();
          on_message_(static_cast<wire::HostKind>(header_.kind), header_.client, contents_);
          read_header();
        });
  }

  void write() {
    if (!writing_.empty() || waiting_.empty()) return;
    writing_.swap(waiting_);
    boost::asio::async_write(socket_, boost::asio::buffer(writing_),
                             [this](const Error& error, std::size_t) {
                               if (error) return;  // the end of reading follows
                               writing_.clear();
                               write();
                             });
  }

  Socket socket_;
  OnMessage on_message_;
  std::function<void()> on_end_;
  wire::Header header_;
  std::shared_ptr<std::string> contents_;
  std::string waiting_;
  std::string writing_;
};

}  // namespace playpen::page
