// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// JSON by nlohmann's parser, except for lists of numbers: the parser takes 0.2 ms for a scan of 682
// ranges, std::from_chars less than a tenth of that.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

#include "protocol/formats.h"
#include "protocol/framing.h"

namespace playerlike::protocol {
namespace {

using nlohmann::json;

// --- writing

void append_text(const std::string& text, std::string& out) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return c >= 0x20 && c < 0x7f && c != '"' && c != '\\';  // printable ASCII that needs no escape
  });
  if (plain) {
    out += '"';
    out += text;
    out += '"';
  } else {
    out += json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  }
}

void append_double(double value, std::string& out) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  char digits[32];
  char* const end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  out.append(std::begin(digits), end);
  // The parser would read a number without a mark as an integer, and -0 as 0.
  const auto is_mark = [](char c) { return c == '.' || c == 'e'; };
  if (std::none_of(std::begin(digits), end, is_mark)) out += ".0";
}

template <typename Integer>
void append_integer(Integer value, std::string& out) {
  char digits[24];
  out.append(std::begin(digits), std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

// --- reading

/// A long list of numbers that was removed from a text; "[]" remains in its place.
struct ExtractedList {
  std::size_t index;  ///< among all lists of the text, in the order of their '['
  json array;
};

/// Builds the value from the events of nlohmann's parser and refuses what the protocol does not
/// allow. Errors are stored in `error_`, because exceptions must not pass through nlohmann's
/// parser.
class Builder {
 public:
  explicit Builder(std::vector<ExtractedList> extracted_lists)
      : extracted_lists_(std::move(extracted_lists)) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(json::number_integer_t value) { return put(value); }
  bool number_unsigned(json::number_unsigned_t value) { return put(value); }
  bool number_float(json::number_float_t value, const json::string_t&) { return put(value); }
  bool string(json::string_t& value) { return put(std::move(value)); }
  bool binary(json::binary_t&) { return false; }  // JSON has no binary values
  bool start_object(std::size_t) { return open(json::object()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) {
    if (next_ == extracted_lists_.size() || extracted_lists_[next_].index != lists_++) {
      return open(json::array());
    }
    return open(std::move(extracted_lists_[next_++].array));
  }
  bool end_array() { return close(); }

  bool key(json::string_t& name) {
    const auto [at, is_new] = open_.back()->get_ptr<json::object_t*>()->emplace(name, nullptr);
    if (!is_new) {
      return fail("protocol/duplicate-key", "a key stands twice in an object: " + shortened(name));
    }
    member_ = &at->second;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const json::exception& what) {
    constexpr int kNumberOverflow = 406;
    if (what.id == kNumberOverflow) {
      return fail("protocol/number", "a number is too large");
    }
    // Removes nlohmann's prefix from "[json.exception.parse_error.101] parse error at line 1, ..."
    std::string_view text = what.what();
    if (const std::size_t at = text.find("] "); at != std::string_view::npos) {
      text.remove_prefix(at + 2);
    }
    return fail("protocol/syntax", "not JSON: " + shortened(text));
  }

  [[nodiscard]] json take() {
    if (error_) throw ProtocolError(*error_);
    return std::move(root_);
  }

 private:
  static std::string shortened(std::string_view text) {
    constexpr std::size_t kMost = 200;
    return text.size() <= kMost ? std::string(text) : std::string(text.substr(0, kMost)) + "...";
  }

  bool fail(const char* id, const std::string& message) {
    error_.emplace(id, message);
    return false;
  }

  json* place(json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    if (json::array_t* list = open_.back()->get_ptr<json::array_t*>()) {
      return &list->emplace_back(std::move(value));
    }
    *member_ = std::move(value);
    return member_;
  }
  bool put(json&& value) {
    place(std::move(value));
    return true;
  }
  bool open(json&& value) {
    if (open_.size() == kMaxDepth) {
      return fail("protocol/too-deep",
                  "lists and objects are nested more than " + std::to_string(kMaxDepth) + " deep");
    }
    open_.push_back(place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<ExtractedList> extracted_lists_;
  std::size_t next_ = 0;   ///< next element of extracted_lists_
  std::size_t lists_ = 0;  ///< lists begun so far; counting stops when extracted_lists_ is used up
  json root_;
  std::vector<json*> open_;  ///< outermost first; their lists do not grow, so pointers stay valid
  json* member_ = nullptr;   ///< member of the innermost object that waits for its value
  std::optional<ProtocolError> error_;
};

json parse_by(Builder builder, std::string_view text) {
  json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

bool is_digit(const char* at, const char* end) { return at != end && *at >= '0' && *at <= '9'; }

/// Reads a number in JSON's syntax. @return its end; null if there is no number or a double cannot
/// hold it.
const char* read_number(const char* at, const char* end, double& value) {
  const char* digits = at != end && *at == '-' ? at + 1 : at;
  if (!is_digit(digits, end) || (*digits == '0' && is_digit(digits + 1, end))) return nullptr;
  const auto [last, error] = std::from_chars(at, end, value);
  if (error != std::errc()) return nullptr;
  // from_chars() also accepts "1." and "1.e5".
  const void* point = std::memchr(at, '.', static_cast<std::size_t>(last - at));
  if (point != nullptr && !is_digit(static_cast<const char*>(point) + 1, end)) return nullptr;
  return last;
}

const char* skip_blanks(const char* at, const char* end) {
  while (at != end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == '\n')) ++at;
  return at;
}

/// Reads numbers up to the end of the list. @param at  behind the '['. @return the position behind
/// the ']'; null if the list holds anything else.
const char* read_numbers(const char* at, const char* end, std::vector<double>& values) {
  values.clear();
  for (;;) {
    double value = 0.0;
    at = read_number(skip_blanks(at, end), end, value);
    if (at == nullptr) return nullptr;
    values.push_back(value);
    at = skip_blanks(at, end);
    if (at == end) return nullptr;
    if (*at == ']') return at + 1;
    if (*at++ != ',') return nullptr;
  }
}

json typed_array(const std::vector<double>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(double));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return json::binary(std::move(bytes), kDoublesTag);
}

struct ExtractedText {
  std::string text;
  std::vector<ExtractedList> extracted_lists;
};

/// Removes long lists of numbers from a text, which need not be valid JSON.
ExtractedText extract_lists(std::string_view text) {
  ExtractedText extracted;
  std::vector<double> values;
  std::size_t lists = 0;
  const char* const end = text.data() + text.size();
  const char* copied = text.data();
  bool in_text = false;
  for (const char* at = copied; at != end; ++at) {
    if (*at == '"') {
      in_text = !in_text;
    } else if (in_text) {
      if (*at == '\\' && at + 1 != end) ++at;
    } else if (*at == '[') {
      const std::size_t index = lists++;
      const char* const behind = read_numbers(at + 1, end, values);
      if (behind == nullptr || values.size() < kLongList) continue;
      extracted.extracted_lists.push_back({index, typed_array(values)});
      extracted.text.append(copied, at + 1);
      copied = behind - 1;
      at = behind - 1;
    }
  }
  extracted.text.append(copied, end);
  return extracted;
}

}  // namespace

void append_json(const json& value, std::string& out) {
  switch (value.type()) {
    case json::value_t::object: {
      char before = '{';
      for (const auto& [key, member] : value.get_ref<const json::object_t&>()) {
        out += before;
        before = ',';
        append_text(key, out);
        out += ':';
        append_json(member, out);
      }
      out += before == '{' ? "{}" : "}";
      return;
    }
    case json::value_t::array: {
      char before = '[';
      for (const json& element : value.get_ref<const json::array_t&>()) {
        out += before;
        before = ',';
        append_json(element, out);
      }
      out += before == '[' ? "[]" : "]";
      return;
    }
    case json::value_t::string:
      return append_text(value.get_ref<const std::string&>(), out);
    case json::value_t::number_float:
      return append_double(value.get<double>(), out);
    case json::value_t::number_integer:
      return append_integer(value.get<std::int64_t>(), out);
    case json::value_t::number_unsigned:
      return append_integer(value.get<std::uint64_t>(), out);
    default:
      out += value.dump();
  }
}

json parse_json(std::string_view text, bool splice_lists) {
  if (splice_lists) {
    ExtractedText extracted = extract_lists(text);
    if (!extracted.extracted_lists.empty()) {
      try {
        return parse_by(Builder(std::move(extracted.extracted_lists)), extracted.text);
      } catch (const ProtocolError&) {
        // Parses the original text again, so that the error gives the position in that text.
      }
    }
  }
  return parse_by(Builder({}), text);
}

}  // namespace playerlike::protocol
