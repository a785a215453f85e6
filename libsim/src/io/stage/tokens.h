// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/error.h"

/// The token language that world files of Stage and configuration files of Player share: words,
/// numbers, strings in double quotes, `(` `)` around the parts of an entity, `[` `]` around a
/// tuple, comments from # to the end of the line. Source: libstage/worldfile.cc of Stage 4,
/// libplayercore/configfile.cc of Player 3.
namespace sim::io::stage {

/// A place in a file, for messages.
struct Place {
  std::shared_ptr<const std::string> file;  ///< as the user or an include named it
  int line = 0;                             ///< from 1
  int column = 0;                           ///< byte in the line, from 1
};

/// An error at a place, for ConfigError.
[[nodiscard]] ConfigIssue issue_at(const Place& place, std::string id, std::string expected,
                                   std::string found, std::string hint = "");

/// Kind of a token.
enum class TokenKind : std::uint8_t {
  kWord,
  kNumber,
  kString,
  kOpenEntity,
  kCloseEntity,
  kOpenTuple,
  kCloseTuple,
  kEnd,  ///< after the last token
};

/// One token. A string's text has no quotes, and is UTF-8: a text that is not is read as ISO
/// 8859-1.
struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string text;
  double number = 0.0;  ///< of a number
  bool cut = false;     ///< of a number: only its beginning is one, as in 0.5.2
  Place place;
};

/// A token in words, for messages: `the word "model"`, `"("`, `the end of the file`.
[[nodiscard]] std::string described(const Token& token);

/// Divides a text into tokens; the last one has the kind kEnd.
///
/// Words begin with a letter or `_`, and continue with letters, digits, `.`, `-`, `_`, `:` and
/// indexes in square brackets, as in `point[3]`. Numbers are read whatever the locale; an exponent
/// is allowed. As in Stage, a notation like 0.5.2 is the number that it begins with, see
/// Token::cut.
/// @throws ConfigError for a character that begins no token, a number that is none, a string
/// without
///     an end, and a text in UTF-16 or UTF-32.
[[nodiscard]] std::vector<Token> tokens_of(std::string_view text,
                                           const std::shared_ptr<const std::string>& file);

}  // namespace sim::io::stage
