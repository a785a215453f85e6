// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <mutex>
#include <sstream>
#include <string_view>
#include <system_error>
#include <typeindex>

#include "imr-h/imr_config.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "text.h"
#include "type_name.h"

namespace imr {
namespace {

using detail::ConfigValue;
using detail::kWhiteSpace;
using detail::lower_case;
using detail::ParseResult;
using detail::trimmed;
using ValuePointer = std::shared_ptr<const ConfigValue>;

constexpr std::size_t kHelpColumns = 100;
constexpr std::size_t kLeastDescriptionColumns = 30;

bool is_white_space(char character) {
  return kWhiteSpace.find(character) != std::string_view::npos;
}

bool is_letter_or_digit(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0;
}

template <typename Number>
ParseResult parse_number(const std::string& text, Number& value) {
  const char* first = text.data();
  const char* const last = first + text.size();
  // std::from_chars() rejects a plus sign.
  if (last - first > 1 && *first == '+' && first[1] != '-') {
    ++first;
  }
  Number read{};
  const std::from_chars_result result = std::from_chars(first, last, read);
  if (result.ec == std::errc::invalid_argument || result.ptr != last) {
    return ParseResult::kMalformed;
  }
  if (result.ec == std::errc::result_out_of_range) {
    return ParseResult::kOutOfRange;
  }
  if constexpr (std::is_floating_point_v<Number>) {
    if (std::isnan(read)) {
      return ParseResult::kMalformed;
    }
  }
  value = read;
  return ParseResult::kOk;
}

struct TypeWords {
  std::string name;         // For the help table.
  std::string description;  // Completes "is not ...".
};

TypeWords type_words(const std::type_info& type) {
  static const std::map<std::type_index, TypeWords> kWords = {
      {typeid(bool), {"bool", "true or false"}},
      {typeid(short), {"short", "a whole number"}},
      {typeid(unsigned short), {"unsigned short", "a whole number of 0 or more"}},
      {typeid(int), {"int", "a whole number"}},
      {typeid(unsigned), {"unsigned", "a whole number of 0 or more"}},
      {typeid(long), {"long", "a whole number"}},
      {typeid(unsigned long), {"unsigned long", "a whole number of 0 or more"}},
      {typeid(long long), {"long long", "a whole number"}},
      {typeid(unsigned long long), {"unsigned long long", "a whole number of 0 or more"}},
      {typeid(float), {"float", "a number"}},
      {typeid(double), {"double", "a number"}},
      {typeid(std::string), {"string", "a text"}},
  };
  const auto known = kWords.find(type);
  if (known != kWords.end()) {
    return known->second;
  }
  const std::string name = detail::type_name(type);
  return {name, "a value of type " + name};
}

struct Option {
  std::string name;
  std::string description;
  ValuePointer prototype;  // Knows the type; never null.
  ValuePointer value;      // Null while a required option is missing.
  std::string default_text;
  bool is_required = false;
  bool from_command_line = false;

  bool is_bool() const { return prototype->type() == typeid(bool); }
};

template <typename Options>
auto find_option(Options& options, std::string_view name) {
  return std::find_if(options.begin(), options.end(),
                      [name](const Option& option) { return option.name == name; });
}

// "unknown option '--prt'; did you mean '--port'?", with `dashes` in front of both names.
std::string unknown_option_text(const std::vector<Option>& options, const std::string& shown,
                                std::string_view name, const std::string& dashes) {
  std::vector<std::string> known;
  known.reserve(options.size());
  for (const Option& option : options) known.push_back(lower_case(option.name));
  const std::string near = sim::nearest_word(lower_case(std::string(name)), known);
  std::string text = "unknown option '" + shown + "'";
  if (near.empty()) return text;
  const auto place = std::find(known.begin(), known.end(), near) - known.begin();
  text += "; did you mean '" + dashes + options[static_cast<std::size_t>(place)].name + "'?";
  return text;
}

ValuePointer parse_value(const Option& option, const std::string& text, const std::string& where,
                         const std::string& dashes) {
  ParseResult result = ParseResult::kMalformed;
  ValuePointer value = option.prototype->parsed(text, result);
  if (result != ParseResult::kOk) {
    const TypeWords words = type_words(option.prototype->type());
    const std::string reason = result == ParseResult::kOutOfRange
                                   ? "is out of the range of type " + words.name
                                   : "is not " + words.description;
    throw exception(where + "option '" + dashes + option.name + "': '" + text + "' " + reason);
  }
  return value;
}

void throw_if_missing(const std::vector<Option>& options) {
  std::string names;
  std::size_t count = 0;
  for (const Option& option : options) {
    if (option.value == nullptr) {
      names += (count == 0 ? "'--" : ", '--") + option.name + "'";
      ++count;
    }
  }
  if (count != 0) {
    throw exception((count == 1 ? "missing required option " : "missing required options ") +
                    names);
  }
}

using Assignments = std::map<std::string, ValuePointer>;

// Parses a command line. Nothing is stored before all of it is valid.
class CommandLineReader {
 public:
  CommandLineReader(const std::vector<Option>& options, std::vector<std::string> arguments,
                    bool keeps_unknown)
      : options_(options), arguments_(std::move(arguments)), keeps_unknown_(keeps_unknown) {}

  bool asks_for_help() const {
    const auto options_end = std::find(arguments_.begin(), arguments_.end(), "--");
    return std::any_of(arguments_.begin(), options_end, [](const std::string& argument) {
      return argument == "-h" || argument == "--help";
    });
  }

  void read() {
    while (next_ < arguments_.size()) {
      const std::string argument = arguments_[next_++];
      if (argument == "--") {
        while (next_ < arguments_.size()) {
          const std::string& positional = arguments_[next_++];
          take_unknown(positional, "unexpected argument '" + positional + "'");
        }
      } else if (argument.compare(0, 2, "--") == 0) {
        read_option(argument);
      } else {
        take_unknown(argument, stray_text(argument));
      }
    }
  }

  const Assignments& assignments() const { return assignments_; }
  const std::vector<std::string>& positional() const { return positional_; }

 private:
  static constexpr const char* kWhere = "command line: ";

  void read_option(const std::string& argument) {
    const std::size_t equals = argument.find('=');
    const bool has_value = equals != std::string::npos;
    const std::string name = argument.substr(2, has_value ? equals - 2 : std::string::npos);
    const auto option = find_option(options_, name);
    if (option != options_.end()) {
      assign(*option, has_value ? argument.substr(equals + 1) : separate_value(*option));
      return;
    }
    if (name.compare(0, 3, "no-") == 0) {
      const auto negated = find_option(options_, std::string_view(name).substr(3));
      if (negated != options_.end() && negated->is_bool()) {
        if (has_value) {
          throw exception(std::string(kWhere) + "option '--" + name + "' takes no value");
        }
        assign(*negated, "false");
        return;
      }
    }
    take_unknown(argument, unknown_option_text(options_, "--" + name, name, "--"));
  }

  // The value of an option whose argument has no '=': the next argument, if that can be a value.
  std::string separate_value(const Option& option) {
    const bool has_next = next_ < arguments_.size();
    if (option.is_bool()) {
      bool ignored = false;
      const bool next_is_word =
          has_next && detail::parse_text(arguments_[next_], ignored) == ParseResult::kOk;
      return next_is_word ? arguments_[next_++] : "true";
    }
    if (!has_next || arguments_[next_].compare(0, 2, "--") == 0) {
      throw exception(std::string(kWhere) + "option '--" + option.name + "' needs a value (" +
                      type_words(option.prototype->type()).description + ")");
    }
    return arguments_[next_++];
  }

  void assign(const Option& option, const std::string& text) {
    assignments_[option.name] = parse_value(option, text, kWhere, "--");
  }

  // The error text for an argument that does not begin with "--".
  std::string stray_text(const std::string& argument) const {
    const bool is_dashed_word = argument.size() > 1 && argument[0] == '-' &&
                                std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
    if (is_dashed_word) {
      const std::size_t name_end = std::min(argument.find('='), argument.size());
      const std::string name = argument.substr(1, name_end - 1);
      return unknown_option_text(options_, "-" + name, name, "--");
    }
    return "unexpected argument '" + argument + "'";
  }

  void take_unknown(const std::string& argument, const std::string& error) {
    if (!keeps_unknown_) {
      throw exception(kWhere + error);
    }
    positional_.push_back(argument);
  }

  const std::vector<Option>& options_;
  const std::vector<std::string> arguments_;
  const bool keeps_unknown_;
  std::size_t next_ = 0;
  Assignments assignments_;
  std::vector<std::string> positional_;
};

// The value to the right of '=' in a line of a file, without its comment and quotes.
std::string file_value(const std::string& where, const std::string& text) {
  const std::string value = trimmed(text);
  if (!value.empty() && value[0] == '"') {
    std::string content;
    std::size_t i = 1;
    for (; i < value.size() && value[i] != '"'; ++i) {
      const bool is_escape =
          value[i] == '\\' && i + 1 < value.size() && (value[i + 1] == '"' || value[i + 1] == '\\');
      content += value[is_escape ? ++i : i];
    }
    if (i == value.size()) {
      throw exception(where + "the closing '\"' is missing");
    }
    const std::string rest = trimmed(std::string_view(value).substr(i + 1));
    if (!rest.empty() && rest[0] != '#') {
      throw exception(where + "unexpected '" + rest + "' after the quoted value");
    }
    return content;
  }
  std::size_t comment = 0;
  while (comment < value.size() &&
         !(value[comment] == '#' && (comment == 0 || is_white_space(value[comment - 1])))) {
    ++comment;
  }
  std::string plain = trimmed(std::string_view(value).substr(0, comment));
  if (plain.empty()) {
    throw exception(where +
                    "no value after '='; quote a value that is empty (\"\") or begins with '#'");
  }
  return plain;
}

Assignments read_file(const std::vector<Option>& options, const std::string& path) {
  std::string text;
  if (const auto problem = sim::read_whole_file(path, {.pipes = true}, text)) {
    throw exception("can't read configuration file '" + path + "': " + problem->found);
  }
  std::istringstream in(std::move(text));
  Assignments assignments;
  std::map<std::string, std::size_t> first_lines;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    // Some editors begin a file with a byte order mark.
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && line.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) {
      line.erase(0, kByteOrderMark.size());
    }
    const std::string content = trimmed(line);
    if (content.empty() || content[0] == '#') {
      continue;
    }
    const std::string where = path + ":" + std::to_string(number) + ": ";
    const std::size_t equals = content.find('=');
    if (equals == std::string::npos) {
      throw exception(where + "expected 'name = value', found '" + content + "'");
    }
    const std::string name = trimmed(std::string_view(content).substr(0, equals));
    if (name.empty()) {
      throw exception(where + "no name before '='");
    }
    const auto option = find_option(options, name);
    if (option == options.end()) {
      throw exception(where + unknown_option_text(options, name, name, ""));
    }
    const auto [first_line, is_first] = first_lines.emplace(name, number);
    if (!is_first) {
      throw exception(where + "option '" + name + "' is given twice, first in line " +
                      std::to_string(first_line->second));
    }
    assignments[name] =
        parse_value(*option, file_value(where, content.substr(equals + 1)), where, "");
  }
  if (in.bad()) {
    throw exception("can't read configuration file '" + path + "'");
  }
  return assignments;
}

std::string program_name(int argc, const char* const* argv) {
  const bool is_known = argc > 0 && argv != nullptr && argv[0] != nullptr && *argv[0] != '\0';
  const std::string path = is_known ? argv[0] : "program";
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

// Wraps a text between words into lines of at most `columns` characters; keeps its line breaks.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines;
  std::istringstream paragraphs(text);
  std::string paragraph;
  while (std::getline(paragraphs, paragraph)) {
    std::string line;
    std::istringstream words(paragraph);
    std::string word;
    while (words >> word) {
      if (!line.empty() && line.size() + 1 + word.size() > columns) {
        lines.push_back(line);
        line.clear();
      }
      line += (line.empty() ? "" : " ") + word;
    }
    lines.push_back(line);
  }
  if (lines.empty()) {
    lines.emplace_back();
  }
  return lines;
}

}  // namespace

namespace detail {

ParseResult parse_text(const std::string& text, bool& value) {
  const std::string word = lower_case(text);
  if (word == "true" || word == "yes" || word == "on" || word == "1") {
    value = true;
  } else if (word == "false" || word == "no" || word == "off" || word == "0") {
    value = false;
  } else {
    return ParseResult::kMalformed;
  }
  return ParseResult::kOk;
}

ParseResult parse_text(const std::string& text, short& value) { return parse_number(text, value); }

ParseResult parse_text(const std::string& text, unsigned short& value) {
  return parse_number(text, value);
}

ParseResult parse_text(const std::string& text, int& value) { return parse_number(text, value); }

ParseResult parse_text(const std::string& text, unsigned& value) {
  return parse_number(text, value);
}

ParseResult parse_text(const std::string& text, long& value) { return parse_number(text, value); }

ParseResult parse_text(const std::string& text, unsigned long& value) {
  return parse_number(text, value);
}

ParseResult parse_text(const std::string& text, long long& value) {
  return parse_number(text, value);
}

ParseResult parse_text(const std::string& text, unsigned long long& value) {
  return parse_number(text, value);
}

ParseResult parse_text(const std::string& text, float& value) { return parse_number(text, value); }

ParseResult parse_text(const std::string& text, double& value) { return parse_number(text, value); }

ParseResult parse_text(const std::string& text, std::string& value) {
  value = text;
  return ParseResult::kOk;
}

std::string to_text(bool value) { return value ? "true" : "false"; }

std::string to_text(float value) { return sim::shortest_text(value); }

std::string to_text(double value) { return sim::shortest_text(value); }

std::string to_text(const std::string& value) { return value.empty() ? "\"\"" : value; }

// Out of line, so that the class has its type information in one place only.
ConfigValue::~ConfigValue() = default;

}  // namespace detail

namespace {

// A value in the form that set() takes: texts without the quotes of the help table.
std::string plain_text(const ConfigValue& value) {
  if (value.type() != typeid(std::string)) return value.text();
  return static_cast<const detail::TypedConfigValue<std::string>&>(value).value();
}

}  // namespace

struct CConfig::Impl {
  mutable std::mutex mutex;  // Guards all members below.
  std::vector<Option> options;
  std::vector<std::string> positional;

  std::vector<Option> copy_of_options() const {
    const std::lock_guard<std::mutex> lock(mutex);
    return options;
  }

  // The caller must hold the mutex.
  Option& known_option(const std::string& name) {
    const auto option = find_option(options, name);
    if (option == options.end()) {
      throw exception(unknown_option_text(options, name, name, ""));
    }
    return *option;
  }
};

CConfig::CConfig() : impl_(std::make_unique<Impl>()) {}

CConfig::~CConfig() = default;

void CConfig::add_option(const std::string& name, const std::string& description,
                         std::shared_ptr<const detail::ConfigValue> value, bool has_default) {
  const bool is_well_formed = !name.empty() && is_letter_or_digit(name[0]) &&
                              std::all_of(name.begin(), name.end(), [](char character) {
                                return is_letter_or_digit(character) || character == '-' ||
                                       character == '_' || character == '.';
                              });
  if (!is_well_formed) {
    throw exception("'" + name +
                    "' is not allowed as the name of an option: letters, digits, '-', '_' and "
                    "'.' are, after a letter or digit");
  }
  if (name == "help" || name == "h") {
    throw exception("option '" + name + "' exists always, it can't be added");
  }
  Option option;
  option.name = name;
  option.description = description;
  option.is_required = !has_default;
  option.prototype = value;
  if (has_default) {
    option.default_text = value->text();
    option.value = std::move(value);
  }
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (find_option(impl_->options, name) != impl_->options.end()) {
    throw exception("option '" + name + "' is added twice");
  }
  impl_->options.push_back(std::move(option));
}

std::shared_ptr<const detail::ConfigValue> CConfig::find_value(const std::string& name,
                                                               const std::type_info& type) const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  const Option& option = impl_->known_option(name);
  if (option.prototype->type() != type) {
    throw exception("option '" + name + "' is of type " +
                    type_words(option.prototype->type()).name + ", but is read as " +
                    type_words(type).name);
  }
  if (option.value == nullptr) {
    throw exception("missing required option '--" + name + "'");
  }
  return option.value;
}

void CConfig::set_value(const std::string& name, std::shared_ptr<const detail::ConfigValue> value) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  Option& option = impl_->known_option(name);
  if (option.prototype->type() != value->type()) {
    throw exception("option '" + name + "' is of type " +
                    type_words(option.prototype->type()).name + ", but is set to a value of type " +
                    type_words(value->type()).name);
  }
  option.value = std::move(value);
  option.from_command_line = false;
}

void CConfig::set(const std::string& name, const std::string& text) {
  // A user's operator>> runs without the mutex; an option never changes its type.
  Option option;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    option = impl_->known_option(name);
  }
  set_value(name, parse_value(option, text, "", ""));
}

void CConfig::set(const std::string& name, const char* text) {
  assert_argument(text, "option '" + name + "' is set to a null pointer");
  set(name, std::string(text));
}

bool CConfig::has(const std::string& name) const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return find_option(impl_->options, name) != impl_->options.end();
}

bool CConfig::parse_command_line(int argc, const char* const* argv, UnknownArguments unknown,
                                 MissingOptions missing) {
  std::vector<std::string> arguments;
  for (int i = 1; argv != nullptr && i < argc && argv[i] != nullptr; ++i) {
    arguments.emplace_back(argv[i]);
  }
  std::vector<Option> options = impl_->copy_of_options();
  CommandLineReader reader(options, std::move(arguments), unknown == UnknownArguments::kKeep);
  if (reader.asks_for_help()) {
    std::cout << help(program_name(argc, argv)) << std::flush;
    return false;
  }
  reader.read();
  if (missing == MissingOptions::kError) {
    for (const auto& [name, value] : reader.assignments()) {
      find_option(options, name)->value = value;
    }
    throw_if_missing(options);
  }
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  for (const auto& [name, value] : reader.assignments()) {
    Option& option = impl_->known_option(name);
    option.value = value;
    option.from_command_line = true;
  }
  impl_->positional = reader.positional();
  return true;
}

std::vector<std::string> CConfig::positional() const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->positional;
}

void CConfig::load_file(const std::string& path) {
  const Assignments assignments = read_file(impl_->copy_of_options(), path);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  for (const auto& [name, value] : assignments) {
    Option& option = impl_->known_option(name);
    if (!option.from_command_line) {
      option.value = value;
    }
  }
}

void CConfig::check_required() const { throw_if_missing(impl_->copy_of_options()); }

std::vector<CConfig::OptionInfo> CConfig::options() const {
  std::vector<OptionInfo> infos;
  for (const Option& option : impl_->copy_of_options()) {
    OptionInfo info;
    info.name = option.name;
    info.description = option.description;
    info.type = type_words(option.prototype->type()).name;
    if (!option.is_required) {
      info.default_text = plain_text(*option.prototype);
      ParseResult result = ParseResult::kMalformed;
      info.has_default = option.prototype->parsed(info.default_text, result) != nullptr;
      if (!info.has_default) info.default_text.clear();
    }
    infos.push_back(std::move(info));
  }
  return infos;
}

void CConfig::print(std::ostream& out) const {
  for (const Option& option : impl_->copy_of_options()) {
    out << option.name << '=' << (option.value == nullptr ? "" : plain_text(*option.value)) << '\n';
  }
}

std::string CConfig::help(const std::string& program) const {
  struct Row {
    std::string name;
    std::string type;
    std::string default_text;
    std::string description;
  };
  std::vector<Row> rows = {{"option", "type", "default", "description"}};
  for (const Option& option : impl_->copy_of_options()) {
    rows.push_back({(option.is_bool() ? "--[no-]" : "--") + option.name,
                    type_words(option.prototype->type()).name,
                    option.is_required ? "(required)" : option.default_text, option.description});
  }
  rows.push_back({"-h, --help", "", "", "show this help and exit"});

  std::size_t name_width = 0;
  std::size_t type_width = 0;
  std::size_t default_width = 0;
  for (const Row& row : rows) {
    name_width = std::max(name_width, row.name.size());
    type_width = std::max(type_width, row.type.size());
    default_width = std::max(default_width, row.default_text.size());
  }
  const auto padded = [](std::string text, std::size_t width) {
    text.resize(width, ' ');
    return text;
  };
  constexpr std::size_t kGap = 2;
  const std::size_t indent = name_width + type_width + default_width + 4 * kGap;
  const std::size_t columns = indent + kLeastDescriptionColumns > kHelpColumns
                                  ? kLeastDescriptionColumns
                                  : kHelpColumns - indent;
  std::string text = "Usage: " + program + " [options]\n\n";
  for (const Row& row : rows) {
    std::string head = std::string(kGap, ' ') + padded(row.name, name_width + kGap) +
                       padded(row.type, type_width + kGap) +
                       padded(row.default_text, default_width + kGap);
    for (const std::string& line : wrapped(row.description, columns)) {
      head += line;
      head.erase(head.find_last_not_of(' ') + 1);
      text += head + "\n";
      head.assign(indent, ' ');
    }
  }
  return text;
}

}  // namespace imr
