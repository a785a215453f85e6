// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "io/document.h"
#include "io/stage/file_search.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace sim::io::stage {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

/// A character that people take for another one, which they should write instead.
struct Lookalike {
  char32_t code;
  const char* name;
  const char* instead;
};

constexpr const char* kDoubleQuote = "\"";
constexpr const char* kMinus = "-";
constexpr const char* kBlank = "a blank";
constexpr const char* kNoCharacter = "nothing";

constexpr Lookalike kLookalikes[] = {
    {0x201c, "left double quotation mark", kDoubleQuote},
    {0x201d, "right double quotation mark", kDoubleQuote},
    {0x201e, "double low-9 quotation mark", kDoubleQuote},
    {0x00ab, "left-pointing double angle quotation mark", kDoubleQuote},
    {0x00bb, "right-pointing double angle quotation mark", kDoubleQuote},
    {0x2018, "left single quotation mark", kDoubleQuote},
    {0x2019, "right single quotation mark", kDoubleQuote},
    {0x2032, "prime", kDoubleQuote},
    {0x2033, "double prime", kDoubleQuote},
    {0xff02, "fullwidth quotation mark", kDoubleQuote},
    {0x0027, "apostrophe", kDoubleQuote},
    {0x2212, "minus sign", kMinus},
    {0x2010, "hyphen", kMinus},
    {0x2011, "non-breaking hyphen", kMinus},
    {0x2012, "figure dash", kMinus},
    {0x2013, "en dash", kMinus},
    {0x2014, "em dash", kMinus},
    {0xff0d, "fullwidth hyphen-minus", kMinus},
    {0x00ad, "soft hyphen", kNoCharacter},
    {0x00a0, "no-break space", kBlank},
    {0x2002, "en space", kBlank},
    {0x2003, "em space", kBlank},
    {0x2009, "thin space", kBlank},
    {0x202f, "narrow no-break space", kBlank},
    {0x3000, "ideographic space", kBlank},
    {0x200b, "zero width space", kNoCharacter},
    {0xfeff, "byte order mark", kNoCharacter},
    {0xff08, "fullwidth left parenthesis", "("},
    {0xff09, "fullwidth right parenthesis", ")"},
    {0xff3b, "fullwidth left square bracket", "["},
    {0xff3d, "fullwidth right square bracket", "]"},
};

/// Characters that Windows-1252 has where ISO 8859-1 has none.
constexpr std::pair<unsigned char, char32_t> kWindows1252[] = {
    {0x84, 0x201e}, {0x91, 0x2018}, {0x92, 0x2019}, {0x93, 0x201c},
    {0x94, 0x201d}, {0x96, 0x2013}, {0x97, 0x2014},
};

/// The first character of a text that is not empty.
struct Character {
  char32_t code = 0;
  std::string_view bytes;
  bool is_utf8 = true;  ///< otherwise it is a byte of Windows-1252
};

Character first_character(std::string_view text) {
  const std::size_t length = utf8_length(text);
  const auto lead = static_cast<unsigned char>(text.front());
  if (length == 0) {
    char32_t code = lead;
    for (const auto& [byte, its_code] : kWindows1252) {
      if (byte == lead) code = its_code;
    }
    return {code, text.substr(0, 1), false};
  }
  char32_t code = length == 1 ? lead : lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    code = (code << 6U) | (static_cast<unsigned char>(text[i]) & 0x3fU);
  }
  return {code, text.substr(0, length), true};
}

const Lookalike* lookalike(char32_t code) {
  const auto* const found =
      std::find_if(std::begin(kLookalikes), std::end(kLookalikes),
                   [&](const Lookalike& known) { return known.code == code; });
  return found == std::end(kLookalikes) ? nullptr : found;
}

/// A character in words, in ASCII if it is not visible: `"x"`, `U+2212 (minus sign)`.
std::string described(const Character& character) {
  const Lookalike* const known = lookalike(character.code);
  std::string text;
  if (!character.is_utf8) {
    text = "the byte 0x" + hexadecimal_text(static_cast<unsigned char>(character.bytes.front()), 2);
    if (known == nullptr) return text;
    text += ", in Windows-1252 ";
  } else if (character.code > 0x20 && character.code < 0x7f && known == nullptr) {
    return in_quotes(character.bytes);
  }
  std::string code = hexadecimal_text(character.code, character.code > 0xffff ? 6 : 4);
  for (char& digit : code) digit = digit >= 'a' ? static_cast<char>(digit - 'a' + 'A') : digit;
  text += "the character U+" + code;
  return text + (known == nullptr ? "" : " (" + std::string(known->name) + ")");
}

std::string instead_of(const Character& character) {
  const Lookalike* const known = lookalike(character.code);
  return known == nullptr ? "" : std::string("write ") + known->instead + " instead";
}

/// The encoding of a text that is not read; nullptr if it may be read.
const char* foreign_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, const char*> kMarks[] = {
      {"\xff\xfe\0\0"sv, "UTF-32LE"},
      {"\0\0\xfe\xff"sv, "UTF-32BE"},
      {"\xff\xfe"sv, "UTF-16LE"},
      {"\xfe\xff"sv, "UTF-16BE"},
  };
  for (const auto& [mark, name] : kMarks) {
    if (text.starts_with(mark)) return name;
  }
  // Without a mark: one of the first two bytes of ASCII is 0 in UTF-16.
  if (text.size() < 2 || (text[0] == '\0') == (text[1] == '\0')) return nullptr;
  return text[0] == '\0' ? "UTF-16BE" : "UTF-16LE";
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
      const Character character = first_character(text_.substr(at_));
      throw ConfigError(issue_at(
          here(), "stage/syntax", "a word, a number, a text in double quotes, ( ) [ ] or a comment",
          described(character),
          c == ',' ? "numbers of a tuple are separated by blanks" : instead_of(character)));
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
                                 "the end of the line",
                                 false_end(text_.substr(begin, at_ - begin))));
    }
    add(TokenKind::kString, utf8_text(text_.substr(begin, at_ - begin)), place);
    ++at_;
  }

  /// A hint about the first character of a text that looks like a double quote.
  static std::string false_end(std::string_view text) {
    while (!text.empty()) {
      const Character character = first_character(text);
      const Lookalike* const known = lookalike(character.code);
      if (known != nullptr && known->instead == kDoubleQuote && character.code != '\'') {
        return described(character) + " does not end it; " + instead_of(character);
      }
      text.remove_prefix(character.bytes.size());
    }
    return "";
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
  if (const char* encoding = foreign_encoding(text)) {
    throw ConfigError(issue_at({file, 1, 1}, "stage/encoding", "text in UTF-8, ASCII or ISO 8859-1",
                               std::string("text in ") + encoding,
                               std::string("save the file as UTF-8, for example with iconv -f ") +
                                   encoding + " -t UTF-8"));
  }
  return Lexer(text, file).run();
}

}  // namespace sim::io::stage
