// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/tokens.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include "io/document.h"
#include "sim/core/utf8.h"

namespace sim::io::stage {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

/// A text as UTF-8. Files of Stage's time that are none are in ISO 8859-1, whose characters have
/// the numbers of their bytes.
std::string utf8_text(std::string_view text) {
  if (find_invalid_utf8(text) == std::string_view::npos) return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0U | (byte >> 6U));
      result += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return result;
}

class Lexer {
 public:
  Lexer(std::string_view text, const std::shared_ptr<const std::string>& file)
      : text_(text), file_(file) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  }

  std::vector<Token> run() {
    for (;;) {
      skip_blanks();
      if (at_ >= text_.size()) break;
      next();
    }
    add(TokenKind::kEnd, "", here());
    return std::move(tokens_);
  }

 private:
  [[nodiscard]] Place here() const {
    return {file_, line_, static_cast<int>(at_ - line_start_) + 1};
  }

  void new_line() {
    ++line_;
    line_start_ = at_;
  }

  /// Line ends are LF, CR LF, or CR alone.
  void skip_blanks() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
      } else if (c == '\n' || c == '\r') {
        ++at_;
        if (c == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
        new_line();
      } else if (is_blank(c)) {
        ++at_;
      } else {
        return;
      }
    }
  }

  void add(TokenKind kind, std::string text, Place place, double number = 0.0) {
    tokens_.push_back({kind, std::move(text), number, false, std::move(place)});
  }

  void next() {
    const char c = text_[at_];
    if (is_letter(c)) return word();
    if (is_digit(c) || c == '+' || c == '-' || c == '.') return number();
    if (c == '"') return string();
    constexpr std::string_view kBrackets = "()[]";
    const std::size_t which = kBrackets.find(c);
    if (which == std::string_view::npos) {
      throw ConfigError(issue_at(here(), "stage/syntax",
                                 "a word, a number, a text in double quotes, ( ) [ ] or a comment",
                                 in_quotes(text_.substr(at_, 1)),
                                 c == ',' ? "numbers of a tuple are separated by blanks" : ""));
    }
    constexpr TokenKind kKinds[] = {TokenKind::kOpenEntity, TokenKind::kCloseEntity,
                                    TokenKind::kOpenTuple, TokenKind::kCloseTuple};
    add(kKinds[which], std::string(1, c), here());
    ++at_;
  }

  void word() {
    const Place place = here();
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (is_letter(c) || is_digit(c) || c == '.' || c == '-' || c == ':') {
        ++at_;
        continue;
      }
      if (c != '[') break;
      std::size_t end = at_ + 1;  // an index, not the begin of a tuple
      while (end < text_.size() && is_digit(text_[end])) ++end;
      if (end == at_ + 1 || end >= text_.size() || text_[end] != ']') break;
      at_ = end + 1;
    }
    add(TokenKind::kWord, std::string(text_.substr(begin, at_ - begin)), place);
  }

  void number() {
    const Place place = here();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_digit(text_[at_]) || is_letter(text_[at_]) ||
                                  text_[at_] == '.' || text_[at_] == '+' || text_[at_] == '-')) {
      ++at_;
    }
    const std::string_view text = text_.substr(begin, at_ - begin);
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = end == digits.data() + digits.size();
    // libstage/worldfile.cc reads what a notation begins with.
    const bool like_stage = text.find_first_not_of("0123456789.+-") == std::string_view::npos;
    if (error != std::errc() || !std::isfinite(value) || (!whole && !like_stage)) {
      throw ConfigError(issue_at(place, "stage/syntax", "a number", in_quotes(text)));
    }
    add(TokenKind::kNumber, std::string(text), place, value);
    tokens_.back().cut = !whole;
  }

  void string() {
    const Place place = here();
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n' && text_[at_] != '\r') {
      ++at_;
    }
    if (at_ >= text_.size() || text_[at_] != '"') {
      throw ConfigError(issue_at(place, "stage/syntax", "a double quote at the end of the text",
                                 "the end of the line"));
    }
    add(TokenKind::kString, utf8_text(text_.substr(begin, at_ - begin)), place);
    ++at_;
  }

  std::string_view text_;
  const std::shared_ptr<const std::string>& file_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

ConfigIssue issue_at(const Place& place, std::string id, std::string expected, std::string found,
                     std::string hint) {
  return {std::move(id),
          place.file ? *place.file : "",
          "",
          std::move(expected),
          std::move(found),
          std::move(hint),
          place.line,
          place.column};
}

std::string described(const Token& token) {
  switch (token.kind) {
    case TokenKind::kWord:
      return "the word " + in_quotes(token.text);
    case TokenKind::kNumber:
      return "the number " + token.text;
    case TokenKind::kString:
      return "the text " + in_quotes(token.text);
    case TokenKind::kEnd:
      return "the end of the file";
    default:
      return in_quotes(token.text);
  }
}

std::vector<Token> tokens_of(std::string_view text,
                             const std::shared_ptr<const std::string>& file) {
  return Lexer(text, file).run();
}

}  // namespace sim::io::stage
