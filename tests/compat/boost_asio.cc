// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program that includes Boost.Asio, but not boost/bind.hpp, because Player's headers did: its
// handlers use boost::bind with Asio's placeholders and overloaded functions. Only compiled, with
// Player's header before Asio's or after it.
#ifdef PLAYER_FIRST
#include <libplayerc++/playerc++.h>
#endif
#include <boost/asio.hpp>
#include <cstddef>
#ifndef PLAYER_FIRST
#include <libplayerc++/playerc++.h>
#endif

class Remote {
 public:
  Remote(boost::asio::io_context& io, PlayerCc::Position2dProxy& position)
      : socket_(io), timer_(io), position_(position) {
    timer_.async_wait(boost::bind(&Remote::stop, this, boost::asio::placeholders::error));
    boost::asio::async_read(socket_, boost::asio::buffer(text_),
                            boost::bind(&Remote::drive, this, boost::asio::placeholders::error,
                                        boost::asio::placeholders::bytes_transferred));
  }

 private:
  void stop() { position_.SetSpeed(0.0, 0.0); }
  void stop(const boost::system::error_code& error) {
    if (!error) stop();
  }
  void drive(const boost::system::error_code& error, std::size_t length) {
    if (!error) position_.SetSpeed(static_cast<double>(length), 0.0);
  }

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  PlayerCc::Position2dProxy& position_;
  char text_[8] = {};
};

int main() {
  boost::asio::io_context io;
  PlayerCc::PlayerClient client;
  PlayerCc::Position2dProxy position(&client);
  const Remote remote(io, position);
  boost::thread network(boost::bind(&boost::asio::io_context::run, &io));  // of two overloads
  client.Run();
  network.join();
}
