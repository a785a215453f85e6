// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "protocol/codec.h"
#include "server/morse_services.h"
#include "server/morse_state.h"
#include "server/python_json.h"
#include "sim/core/utf8.h"

namespace playerlike::server {
namespace {

using nlohmann::json;

/// Maximum length of an id in bytes.
constexpr std::size_t kMaxId = 80;

constexpr std::string_view kBlanks = " \t\r\v\f";

/// Removes the first word of a text and the white space around it.
std::string_view take_word(std::string_view& text) {
  const auto begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const auto end = std::min(text.find_first_of(kBlanks, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks, end), text.size()));
  return word;
}

std::string_view without_blanks_behind(std::string_view text) {
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Whether an id can be echoed unchanged.
bool is_valid_id(std::string_view id) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7f; };
  return id.size() <= kMaxId && std::none_of(id.begin(), id.end(), is_control) &&
         sim::find_invalid_utf8(id) == std::string_view::npos;
}

constexpr const char* kTooManyWrong = "too many wrong tokens came through this connection";

/// The tokens in a hello; ignores elements that are not texts.
std::vector<std::string> tokens_in(const json& hello) {
  std::vector<std::string> tokens;
  if (!hello.is_object() || !hello.contains("tokens") || !hello["tokens"].is_array()) return tokens;
  for (const json& token : hello["tokens"]) {
    if (token.is_string() && tokens.size() < kMaxTokens) tokens.push_back(token.get<std::string>());
  }
  return tokens;
}

/// Parses the arguments of a request.
json arguments_of(std::string_view text) {
  if (text.empty()) return json::array();
  json list;
  try {
    list = protocol::decode_json_value(text);
  } catch (const protocol::ProtocolError& error) {
    if (error.id() != "protocol/syntax") throw;
    // The text of MORSE's _parse_request(), followed by the parser's own.
    throw MorseRefusal("Invalid request syntax: error while parsing the parameters: <" +
                       std::string(text) + ">. " + error.what());
  }
  if (list.is_null()) return json::array();
  if (!list.is_array()) {
    throw MorseRefusal(std::string("arguments are a JSON list, found ") + list.type_name());
  }
  return list;
}

std::string line_of(const std::string& id, std::string_view status, const json& result) {
  std::string line = id + ' ' + std::string(status);
  if (!result.is_null()) line += ' ' + python_json(result);
  return line + '\n';
}

}  // namespace

MorseConnection::MorseConnection(Peer& peer, Hub& hub)
    : peer_(peer),
      hub_(hub),
      state_(MorseState::of(hub)),
      self_(std::make_shared<MorseConnection*>(this)),
      commander_(hub.host().shared_from_this()),
      rights_(hub.access().rights({})) {}

MorseConnection::~MorseConnection() { state_->forget(*this); }

void MorseConnection::present(std::string token) {
  if (tokens_.size() >= kMaxTokens) throw MorseRefusal("access/denied: too many tokens");
  tokens_.push_back(std::move(token));
  rights_ = hub_.access().rights(tokens_);
}

void MorseConnection::answer(const std::string& id, std::string_view status, const json& result) {
  peer_.send(line_of(id, status, result));
}

std::string MorseConnection::farewell(const protocol::ProtocolError& error) {
  return "- FAILED " + python_json(json(error.id() + ": " + error.what())) + '\n';
}

void MorseConnection::on_message(std::string_view line) {
  std::string_view rest = without_blanks_behind(line);
  const std::string_view word = take_word(rest);
  if (word.empty()) return;  // an empty line has no id for an answer
  if (!is_valid_id(word)) {
    return answer("-", "FAILED",
                  "Malformed request: an id is 1 to 80 bytes of UTF-8 without control characters");
  }
  const std::string id(word);
  const std::string_view component = take_word(rest);
  const std::string_view service = take_word(rest);
  if (component.empty()) return answer(id, "FAILED", "Malformed request! ");  // as MORSE's
  if (component == "cancel" && service.empty()) return state_->cancel(*this, id);
  if (service.empty()) {
    return answer(id, "FAILED",
                  "Malformed request: expected id, component, service and maybe a JSON list of "
                  "arguments, or id and cancel");
  }
  execute(id, component, service, rest);
}

void MorseConnection::execute(const std::string& id, std::string_view component,
                              std::string_view service, std::string_view arguments) {
  guarded(id, [&] {
    const json list = arguments_of(arguments);
    if (component == "playpen") return playpen(id, service, list);
    static_cast<void>(state_->session());  // opens the session that time may wait for
    if (auto result = call_service(*state_, *this, id, component, service, list)) {
      answer(id, "SUCCESS", *result);
    }
  });
}

template <typename Action>
void MorseConnection::guarded(const std::string& id, Action action) {
  try {
    action();
  } catch (const MorseRefusal& refusal) {
    answer(id, "FAILED", refusal.what());
  } catch (const SessionError& error) {
    answer(id, "FAILED", std::string(protocol::error_id(error.code())) + ": " + error.what());
  } catch (const protocol::ProtocolError& error) {
    answer(id, "FAILED", error.id() + ": " + error.what());
  }
}

void MorseConnection::work(const std::string& id, const MorseService& service, const json& list) {
  peer_.set_busy(true);
  // The job holds no reference to the connection, which may be closed before the job is done.
  const auto line = std::make_shared<std::string>();
  const auto run_slice = [client = state_->client(), &service, list, id, line] {
    const MorseArguments arguments(service, list);
    *line = line_of(id, "SUCCESS", service.work({*client, arguments}));
    return false;
  };
  const auto done = [weak = std::weak_ptr<MorseConnection*>(self_), id,
                     line](const std::exception_ptr& error) {
    const auto self = weak.lock();
    if (!self) return;
    MorseConnection& from = **self;
    try {
      from.guarded(id, [&] {
        if (error) std::rethrow_exception(error);
        from.peer_.send(std::move(*line));
      });
    } catch (const std::exception& e) {
      from.hub_.log(sim::LogLevel::kError, from.peer_.name() + ": " + e.what());
      from.answer(id, "FAILED", std::string("server/internal: ") + e.what());
    }
    from.peer_.set_busy(false);
  };
  hub_.work({run_slice, done});
}

void MorseConnection::try_tokens(const std::string& id, const std::vector<std::string>& tokens,
                                 std::function<void()> action) {
  const Hub::TokenVerdict verdict = hub_.check_tokens(peer_, tokens);
  if (verdict.wrong) ++wrong_tokens_;
  hub_.answer_after(verdict.delay, peer_, self_, [this, id, action = std::move(action)] {
    guarded(id, action);
    if (wrong_tokens_ >= TokenThrottle::kMostOfAConnection) {
      peer_.close(farewell(protocol::ProtocolError("access/slow-down", kTooManyWrong)));
    }
  });
}

// Handles Playpen's own requests.
void MorseConnection::playpen(const std::string& id, std::string_view service,
                              const json& arguments) {
  if (service == "hello") {
    if (arguments.size() > 1) throw MorseRefusal("wrong # of parameters for hello: expected 1");
    const json argument = arguments.empty() ? json::object() : arguments[0];
    return try_tokens(id, tokens_in(argument),
                      [this, id, argument] { say_hello(peer_, hub_, id, argument); });
  }
  if (service == "token") {
    if (arguments.size() != 1) throw MorseRefusal("wrong # of parameters for token: expected 1");
    if (!arguments[0].is_string()) throw MorseRefusal("expected the token, a text");
    const std::string token = arguments[0].get<std::string>();
    return try_tokens(id, {token}, [this, id, token] {
      const Rights before = rights_;
      present(token);
      if (rights_.connect == before.connect && rights_.watch == before.watch &&
          rights_.command == before.command) {
        throw MorseRefusal("access/denied: this token gives no further rights");
      }
      answer(id, "SUCCESS", nullptr);
    });
  }
  throw MorseRefusal("there is no playpen " + std::string(service) + ", only hello and token");
}

std::unique_ptr<Handler> make_morse_handler(Peer& peer, Hub& hub) {
  return std::make_unique<MorseConnection>(peer, hub);
}

}  // namespace playerlike::server
