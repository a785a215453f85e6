// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The only source with Boost, whose templates take a compiler some 10 s.
#include "page_server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>
// Boost 1.74 uses std::exchange without its header, so these come after it.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "gate.h"
#include "host_link.h"
#include "listening.h"
#include "live_page.h"
#include "outbox.h"
#include "playerlike/page/protocol.h"
#include "request_rules.h"

namespace playpen::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

using asio::ip::tcp;
using beast::error_code;
using websocket::close_code;
using Clock = std::chrono::steady_clock;
using Protocol = HostLink::Protocol;
using Socket = HostLink::Socket;

// A client takes a message in such pieces, so that a slow one is not taken for a hanging one.
constexpr std::size_t kPiece = std::size_t{64} << 10U;

class Connection;

}  // namespace

/// The parts of the server that its connections share.
class PageServer::Impl {
 public:
  Impl(const PageSettings& settings, const PageLimits& limits, int host,
       std::function<void(const std::string&)> tell);

  void start();
  void adopt(Socket socket, std::string peer);

  /// Removes a connection, which has ended.
  void forget(const Connection& connection);
  /// A client waits for a whole.
  void want_whole();
  /// @return whether the host takes it.
  bool command(std::uint32_t client, std::string_view text);
  void gone(std::uint32_t client) { host_.send(wire::PageKind::kGone, client); }

  PageSettings settings;
  PageLimits limits;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::vector<std::string> names;  ///< of this machine
  std::optional<Gate> gate;

 private:
  void accept();
  void on_message(wire::HostKind kind, std::uint32_t client, const Bytes& contents);
  void on_part(const Bytes& part);
  void on_end();
  void ask_for_whole();
  void look();

  HostLink host_;
  asio::steady_timer timer_{io};
  std::map<std::uint32_t, std::shared_ptr<Connection>> connections_;
  std::uint32_t last_client_ = 0;
  bool taken_owed_ = false;    ///< a part has come while nobody watched
  bool whole_wanted_ = false;  ///< and not asked for yet
  bool whole_asked_ = false;   ///< and not yet there
  std::optional<Clock::time_point> asked_at_;
  bool accepting_ = false;
  bool is_open_ = false;  ///< watching needs no token
  std::optional<Clock::time_point> ends_at_;
};

namespace {

/// One connection of a browser: an HTTP request and its answer, or a WebSocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  /// @param is_refused  it is one too many, and gets the answer 503 only.
  Connection(PageServer::Impl& server, std::uint32_t number, Socket socket, std::string peer,
             bool is_refused)
      : server_(server),
        limits_(server.limits),
        number_(number),
        peer_(std::move(peer)),
        is_refused_(is_refused),
        stream_(std::move(socket)),
        buffer_(std::max(limits_.header_bytes, limits_.message_bytes)),
        outbox_(limits_.queued_bytes, limits_.queued_time) {}

  void start();
  void whole(const Bytes& bytes, bool for_all);
  void part(const Bytes& bytes);
  void answer(const Bytes& text);
  /// The run is over.
  void over();
  /// Ends the connection if it has passed one of the limits of time.
  void look(Clock::time_point now);

  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] bool is_refused() const { return is_refused_; }
  [[nodiscard]] bool watches() const { return phase_ == Phase::kWatching; }
  [[nodiscard]] bool is_stranger() const {
    return phase_ == Phase::kRequest || phase_ == Phase::kGreeting;
  }

 private:
  enum class Phase { kRequest, kAnswered, kGreeting, kWatching, kClosing, kGone };
  using Response = http::response<http::string_body>;

  void on_request(const error_code& error);
  void handle(const http::request<http::empty_body>& request);
  void respond(int status, std::string body, const char* type, const std::string& policy,
               bool is_head);
  void drain();
  void upgrade();
  void read();
  void on_message(const std::string& text);
  void greet(const std::string& text);
  void let_in(const Rights& rights);
  void command(const std::string& text);
  [[nodiscard]] bool in_rate();
  void send_text(std::string text);
  void send_next();
  void send_piece();
  void refuse(std::string_view reason, close_code code);
  void close(close_code code);
  void leave();
  void tell_gone();
  void set_limit(PageLimits::Time time);

  PageServer::Impl& server_;
  const PageLimits& limits_;
  std::uint32_t number_;
  std::string peer_;
  bool is_refused_;
  Phase phase_ = Phase::kRequest;
  websocket::stream<Socket> stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Response> response_;
  std::array<char, 1024> drained_{};
  std::optional<asio::steady_timer> delay_;
  std::optional<Clock::time_point> limit_;  ///< when the connection ends if nothing happens
  bool may_command_ = false;
  bool has_commanded_ = false;
  Clock::time_point period_begin_{};
  int messages_ = 0;  ///< in this period
  Outbox outbox_;
  Bytes sent_;              ///< the first of the outbox, while a piece of it is under way
  std::size_t offset_ = 0;  ///< of the next piece
  close_code code_ = close_code::none;
  bool is_closing_ = false;  ///< the close frame is under way
};

void Connection::start() {
  set_limit(limits_.request_time);
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(limits_.header_bytes));
  http::async_read_header(stream_.next_layer(), buffer_, *parser_,
                          [self = shared_from_this()](const error_code& error, std::size_t) {
                            self->on_request(error);
                          });
}

void Connection::on_request(const error_code& error) {
  if (phase_ != Phase::kRequest) return;
  const char* const plain = "default-src 'none'";
  const char* const text = "text/plain; charset=utf-8";
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return respond(431, "The request is too long.\n", text, plain, false);
  }
  if (error == http::error::end_of_stream || error == http::error::partial_message) return leave();
  if (error.category() == make_error_code(http::error::bad_method).category()) {
    return respond(400, "This is no HTTP request.\n", text, plain, false);
  }
  if (error) return leave();
  handle(parser_->get());
}

void Connection::handle(const http::request<http::empty_body>& request) {
  const auto view = [](beast::string_view text) {
    return std::string_view(text.data(), text.size());
  };
  RequestParts parts;
  parts.method = view(request.method_string());
  parts.target = view(request.target());
  for (const auto& field : request) {
    if (field.name() == http::field::host) parts.hosts.push_back(view(field.value()));
    if (field.name() == http::field::origin) parts.origins.push_back(view(field.value()));
  }
  parts.is_upgrade = websocket::is_upgrade(request);
  // A client that speaks before the answer does not speak this protocol.
  parts.has_body = parser_->chunked() || parser_->content_length().value_or(0) > 0 ||
                   (parts.is_upgrade && buffer_.size() > 0);
  Verdict verdict = judge(parts, server_.names);
  if (is_refused_ && verdict.status < 400) {
    verdict = {503, "Too many browsers look at this run. Close one of them."};
  }
  if (verdict.status == 101) return upgrade();
  const bool is_head = parts.method == "HEAD";
  if (verdict.status == 200) {
    const std::string_view host = parts.hosts.front();
    return respond(200, live_page(server_.settings.title_markup, host), "text/html; charset=utf-8",
                   live_policy(host), is_head);
  }
  respond(verdict.status, verdict.reason + '\n', "text/plain; charset=utf-8", "default-src 'none'",
          is_head);
}

void Connection::respond(int status, std::string body, const char* type, const std::string& policy,
                         bool is_head) {
  phase_ = Phase::kAnswered;
  Response& response = response_.emplace();
  response.version(11);
  response.result(static_cast<unsigned>(status));
  response.keep_alive(false);
  response.set(http::field::content_type, type);
  response.set("Content-Security-Policy", policy + "; frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set(http::field::cache_control, "no-store");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  if (status == 405) response.set(http::field::allow, "GET, HEAD");
  if (status == 426) response.set(http::field::upgrade, "websocket");
  response.content_length(body.size());
  if (!is_head) response.body() = std::move(body);
  set_limit(limits_.answer_time);
  http::async_write(stream_.next_layer(), response,
                    [self = shared_from_this()](const error_code& error, std::size_t) {
                      if (error || self->phase_ != Phase::kAnswered) return self->leave();
                      error_code ignored;
                      self->stream_.next_layer().shutdown(Socket::shutdown_send, ignored);
                      self->set_limit(self->limits_.closing_time);
                      self->drain();
                    });
}

// Closing a socket while it has unread data would take the answer away from the client.
void Connection::drain() {
  stream_.next_layer().async_read_some(
      asio::buffer(drained_), [self = shared_from_this()](const error_code& error, std::size_t) {
        if (error || self->phase_ != Phase::kAnswered) return self->leave();
        self->drain();
      });
}

void Connection::upgrade() {
  phase_ = Phase::kGreeting;
  set_limit(limits_.greeting_time);
  websocket::stream_base::timeout times{};
  const auto or_none = [](PageLimits::Time time) {
    return time.count() > 0 ? std::chrono::steady_clock::duration(time)
                            : websocket::stream_base::none();
  };
  times.handshake_timeout = or_none(limits_.greeting_time);
  times.idle_timeout = or_none(limits_.idle_time);
  times.keep_alive_pings = limits_.idle_time.count() > 0;
  stream_.set_option(times);
  stream_.read_message_max(limits_.message_bytes);
  stream_.auto_fragment(false);  // send_piece() does it
  stream_.control_callback([this](websocket::frame_type kind, beast::string_view) {
    if (kind != websocket::frame_type::ping || in_rate()) return;
    asio::post(stream_.get_executor(), [self = shared_from_this()] { self->leave(); });
  });
  stream_.async_accept(parser_->get(), [self = shared_from_this()](const error_code& error) {
    if (error || self->phase_ != Phase::kGreeting) return self->leave();
    self->parser_.reset();
    self->read();
  });
}

void Connection::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error && self->is_closing_) return;  // the end of closing follows
    if (error || self->phase_ == Phase::kGone) return self->leave();
    const std::string text = beast::buffers_to_string(self->buffer_.data());
    self->buffer_.consume(self->buffer_.size());
    self->on_message(text);
  });
}

bool Connection::in_rate() {
  const Clock::time_point now = Clock::now();
  if (now - period_begin_ >= limits_.message_period) {
    period_begin_ = now;
    messages_ = 0;
  }
  return ++messages_ <= limits_.messages;
}

void Connection::on_message(const std::string& text) {
  if (phase_ == Phase::kClosing) return;
  if (!in_rate()) {
    return refuse("more than " + std::to_string(limits_.messages) + " messages a second",
                  close_code::policy_error);
  }
  if (!stream_.got_text()) return refuse("messages are texts", close_code::unknown_data);
  if (phase_ == Phase::kGreeting) return greet(text);
  command(text);
  if (phase_ == Phase::kWatching) read();
}

void Connection::greet(const std::string& text) {
  const std::optional<std::string> token = token_of_greeting(text);
  if (!token) {
    return refuse("the first message is {\"token\": \"...\"} or {}", close_code::policy_error);
  }
  limit_.reset();
  const Rights rights = server_.gate->admit(peer_, *token, Clock::now());
  if (rights.delay.count() == 0) return let_in(rights);
  delay_.emplace(server_.io, rights.delay);
  delay_->async_wait([self = shared_from_this(), rights](const error_code& error) {
    if (!error && self->phase_ == Phase::kGreeting) self->let_in(rights);
  });
}

void Connection::let_in(const Rights& rights) {
  if (!rights.watch) return refuse(rights.reason, close_code::policy_error);
  phase_ = Phase::kWatching;
  may_command_ = rights.command;
  outbox_.watch();
  send_text(std::string(R"({"rights": {"command": )") + (may_command_ ? "true" : "false") + "}}");
  if (phase_ != Phase::kWatching) return;
  server_.want_whole();
  read();
}

void Connection::command(const std::string& text) {
  if (!may_command_) {
    return send_text(refusal("commands need the token of the link that playpen printed"));
  }
  if (!is_json_object(text)) return refuse("commands are JSON objects", close_code::bad_payload);
  has_commanded_ = true;
  if (!server_.command(number_, text)) {
    send_text(refusal("the simulation takes no commands at the moment"));
  }
}

void Connection::whole(const Bytes& bytes, bool for_all) {
  if (phase_ != Phase::kWatching) return;
  outbox_.add_whole(bytes, for_all);
  send_next();
}

void Connection::part(const Bytes& bytes) {
  if (phase_ != Phase::kWatching) return;
  outbox_.add_part(bytes, Clock::now());
  send_next();
}

void Connection::answer(const Bytes& text) {
  if (phase_ == Phase::kWatching) send_text(*text);
}

void Connection::over() {
  if (phase_ == Phase::kWatching) send_text(R"({"over": true})");
  if (phase_ == Phase::kWatching || phase_ == Phase::kGreeting) {
    close(close_code::going_away);
  } else if (phase_ == Phase::kRequest) {
    leave();
  }
}

void Connection::send_text(std::string text) {
  if (!outbox_.add_text(std::move(text))) return leave();  // it asks and does not listen
  send_next();
}

void Connection::send_next() {
  if (sent_ || phase_ == Phase::kGone || is_closing_) return;
  if (!outbox_.empty()) {
    sent_ = outbox_.front().bytes;
    offset_ = 0;
    stream_.text(outbox_.front().is_text);
    return send_piece();
  }
  if (phase_ != Phase::kClosing) {
    limit_.reset();
    return;
  }
  is_closing_ = true;
  stream_.async_close(code_, [self = shared_from_this()](const error_code&) { self->leave(); });
}

void Connection::send_piece() {
  const std::size_t size = std::min(kPiece, sent_->size() - offset_);
  const bool is_last = offset_ + size == sent_->size();
  set_limit(limits_.stalled_time);
  stream_.async_write_some(
      is_last, asio::buffer(sent_->data() + offset_, size),
      [self = shared_from_this(), size, is_last](const error_code& error, std::size_t) {
        if (error || self->phase_ == Phase::kGone) return self->leave();
        self->offset_ += size;
        if (!is_last) return self->send_piece();
        self->sent_.reset();
        self->outbox_.pop();
        if (self->outbox_.waits()) self->server_.want_whole();
        self->send_next();
      });
}

void Connection::refuse(std::string_view reason, close_code code) {
  outbox_.end_watching();
  if (!outbox_.add_text(refusal(reason))) return leave();
  close(code);
}

void Connection::close(close_code code) {
  set_limit(limits_.closing_time);
  phase_ = Phase::kClosing;
  code_ = code;
  tell_gone();
  send_next();
}

void Connection::leave() {
  if (phase_ == Phase::kGone) return;
  phase_ = Phase::kGone;
  error_code ignored;
  stream_.next_layer().close(ignored);
  if (delay_) delay_->cancel();
  tell_gone();
  server_.forget(*this);
}

void Connection::tell_gone() {
  if (std::exchange(has_commanded_, false)) server_.gone(number_);
}

void Connection::set_limit(PageLimits::Time time) {
  if (phase_ == Phase::kClosing) return;  // nothing prolongs that
  limit_.reset();
  if (time.count() > 0) limit_ = Clock::now() + time;
}

void Connection::look(Clock::time_point now) {
  if (limit_ && now > *limit_) leave();
}

}  // namespace

PageServer::Impl::Impl(const PageSettings& given, const PageLimits& given_limits, int host,
                       std::function<void(const std::string&)> tell)
    : settings(given), limits(given_limits), names(given.names), host_(io, host) {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) == 0 && name.front() != '\0') {
    names.emplace_back(name.data());
    names.push_back(names.back() + ".local");  // of multicast DNS
  }
  listen_on(acceptor, settings);
  is_open_ = settings.open || acceptor.local_endpoint().address().is_loopback();
  gate.emplace(settings, is_open_, std::move(tell));
}

void PageServer::Impl::start() {
  host_.start([this](wire::HostKind kind, std::uint32_t client,
                     const Bytes& contents) { on_message(kind, client, contents); },
              [this] { on_end(); });
  host_.send(wire::PageKind::kReady, 0,
             std::to_string(acceptor.local_endpoint().port()) + (is_open_ ? " 1" : " 0"));
  accept();
  look();
}

void PageServer::Impl::accept() {
  accepting_ = true;
  acceptor.async_accept([this](const error_code& error, tcp::socket socket) {
    accepting_ = false;
    if (ends_at_) return;
    if (error) return;  // for lack of descriptors, say: look() tries again
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    error_code left;
    const tcp::endpoint peer = socket.remote_endpoint(left);
    if (!left) {
      adopt(Socket(std::move(socket)),
            peer.address().to_string() + ':' + std::to_string(peer.port()));
    }
    accept();
  });
}

void PageServer::Impl::adopt(Socket socket, std::string peer) {
  std::size_t refused = 0;
  std::size_t strangers = 0;
  for (const auto& [number, connection] : connections_) {
    refused += connection->is_refused() ? 1 : 0;
    strangers += !connection->is_refused() && connection->is_stranger() ? 1 : 0;
  }
  const bool is_refused =
      connections_.size() - refused >= limits.connections || strangers >= limits.strangers;
  if (is_refused && refused >= limits.refused_connections) return;
  const auto connection = std::make_shared<Connection>(*this, ++last_client_, std::move(socket),
                                                       std::move(peer), is_refused);
  connections_.emplace(connection->number(), connection);
  connection->start();
}

void PageServer::Impl::forget(const Connection& connection) {
  connections_.erase(connection.number());
}

bool PageServer::Impl::command(std::uint32_t client, std::string_view text) {
  if (host_.backlog() > limits.host_bytes) return false;
  host_.send(wire::PageKind::kCommand, client, text);
  return true;
}

void PageServer::Impl::want_whole() {
  if (whole_asked_) return;  // that one is for this client too
  whole_wanted_ = true;
  ask_for_whole();
}

void PageServer::Impl::ask_for_whole() {
  if (!whole_wanted_ || whole_asked_) return;
  const Clock::time_point now = Clock::now();
  if (asked_at_ && now - *asked_at_ < limits.whole_period) return;  // look() tries again
  whole_wanted_ = false;
  whole_asked_ = true;
  asked_at_ = now;
  if (taken_owed_) host_.send(wire::PageKind::kTaken);
  taken_owed_ = false;
  host_.send(wire::PageKind::kWantWhole);
}

void PageServer::Impl::on_message(wire::HostKind kind, std::uint32_t client,
                                  const Bytes& contents) {
  switch (kind) {
    case wire::HostKind::kPart:
      return on_part(contents);
    case wire::HostKind::kWhole:
    case wire::HostKind::kAnew: {
      const bool for_all = kind == wire::HostKind::kAnew;
      whole_asked_ = false;
      const auto all = connections_;  // a connection that ends is removed
      for (const auto& [number, connection] : all) connection->whole(contents, for_all);
      return;
    }
    case wire::HostKind::kAnswer:
      if (const auto found = connections_.find(client); found != connections_.end()) {
        const auto connection = found->second;
        connection->answer(contents);
      }
      return;
  }
}

void PageServer::Impl::on_part(const Bytes& part) {
  bool has_watcher = false;
  const auto all = connections_;
  for (const auto& [number, connection] : all) {
    has_watcher = has_watcher || connection->watches();
    connection->part(part);
  }
  taken_owed_ = !has_watcher;
  if (has_watcher) host_.send(wire::PageKind::kTaken);
}

void PageServer::Impl::on_end() {
  if (ends_at_) return;
  ends_at_ = Clock::now() + limits.closing_time;
  error_code ignored;
  acceptor.close(ignored);
  const auto all = connections_;
  for (const auto& [number, connection] : all) connection->over();
}

void PageServer::Impl::look() {
  const Clock::time_point now = Clock::now();
  const auto all = connections_;
  for (const auto& [number, connection] : all) connection->look(now);
  if (ends_at_ && (connections_.empty() || now > *ends_at_)) return io.stop();
  if (!ends_at_ && !accepting_) accept();
  if (!ends_at_) ask_for_whole();
  timer_.expires_after(limits.look_period);
  timer_.async_wait([this](const error_code& error) {
    if (!error) look();
  });
}

PageServer::PageServer(const PageSettings& settings, const PageLimits& limits, int host,
                       std::function<void(const std::string&)> tell)
    : impl_(std::make_unique<Impl>(settings, limits, host, std::move(tell))) {
  impl_->start();
}

PageServer::~PageServer() = default;

int PageServer::port() const noexcept {
  boost::system::error_code error;
  return impl_->acceptor.local_endpoint(error).port();
}

void PageServer::run() { impl_->io.run(); }

bool PageServer::poll() { return impl_->io.poll() > 0; }

void PageServer::adopt(int descriptor) {
  impl_->adopt(Socket(impl_->io, Protocol(AF_UNIX, 0), descriptor), "local:0");
}

}  // namespace playpen::page
