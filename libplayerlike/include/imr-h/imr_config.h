// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "imr-h/imr_exceptions.h"

namespace imr {
namespace detail {

/// How reading a value from text went.
enum class ParseResult { kOk, kMalformed, kOutOfRange };

/// @name Reading a value from the whole of a text
/// Independent of the locale; the value is unchanged unless the result is kOk. Whole numbers are
/// decimal; real numbers may be infinite but not NaN; bool is true/false, yes/no, on/off or 1/0 in
/// any case.
/// @{
ParseResult parse_text(const std::string& text, bool& value);
ParseResult parse_text(const std::string& text, short& value);
ParseResult parse_text(const std::string& text, unsigned short& value);
ParseResult parse_text(const std::string& text, int& value);
ParseResult parse_text(const std::string& text, unsigned& value);
ParseResult parse_text(const std::string& text, long& value);
ParseResult parse_text(const std::string& text, unsigned long& value);
ParseResult parse_text(const std::string& text, long long& value);
ParseResult parse_text(const std::string& text, unsigned long long& value);
ParseResult parse_text(const std::string& text, float& value);
ParseResult parse_text(const std::string& text, double& value);
ParseResult parse_text(const std::string& text, std::string& value);

/// Any other type: by its operator>>, which must use up the text but for white space.
template <typename T>
ParseResult parse_text(const std::string& text, T& value) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  T read = T();
  if (!(in >> read)) {
    return ParseResult::kMalformed;
  }
  // At the end of the text there is no further character but white space.
  in >> std::ws;
  if (!in.eof()) {
    return ParseResult::kMalformed;
  }
  value = std::move(read);
  return ParseResult::kOk;
}
/// @}

/// @name Text of a value, for the help table
/// @{
std::string to_text(bool value);
std::string to_text(float value);
std::string to_text(double value);
std::string to_text(const std::string& value);

template <typename T>
auto print_text(const T& value, int /*preferred*/)
    -> decltype(std::declval<std::ostream&>() << value, std::string()) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

// For a type that can be read but not printed.
template <typename T>
std::string print_text(const T& /*value*/, long /*fallback*/) {
  return "(set)";
}

template <typename T>
std::string to_text(const T& value) {
  return print_text(value, 0);
}
/// @}

/// A value of some type that never changes, so that it can be read without a lock.
class ConfigValue {
 public:
  virtual ~ConfigValue();
  virtual const std::type_info& type() const noexcept = 0;
  virtual std::string text() const = 0;
  /// A new value of the same type, read from text; null unless result becomes kOk.
  virtual std::shared_ptr<const ConfigValue> parsed(const std::string& text,
                                                    ParseResult& result) const = 0;

 protected:
  ConfigValue() = default;
  ConfigValue(const ConfigValue&) = default;
  ConfigValue& operator=(const ConfigValue&) = default;
};

template <typename T>
class TypedConfigValue final : public ConfigValue {
 public:
  explicit TypedConfigValue(T value) : value_(std::move(value)) {}

  const T& value() const noexcept { return value_; }
  const std::type_info& type() const noexcept override { return typeid(T); }
  std::string text() const override { return to_text(value_); }
  std::shared_ptr<const ConfigValue> parsed(const std::string& text,
                                            ParseResult& result) const override {
    T value = T();
    result = parse_text(text, value);
    if (result != ParseResult::kOk) {
      return nullptr;
    }
    return std::make_shared<TypedConfigValue<T>>(std::move(value));
  }

 private:
  T value_;
};

}  // namespace detail

/// The named settings of a program: declared once in code, then filled from a file, from the
/// command line and by the program itself.
///
///   imr::CConfig config;
///   config.add<std::string>("host", "server to connect to", "localhost");
///   config.add<int>("port", "its port", 6665);
///   config.add<double>("speed", "forward speed in m/s");       // no default: required
///   if (!config.parse_command_line(argc, argv)) return 0;      // --help was asked for
///   const double speed = config.get<double>("speed");
///
/// Types: bool, short, int, long, long long and their unsigned forms, float, double, std::string,
/// and any other copyable type with a default value and an operator>>. The type is part of the
/// declaration: reading an int as a double is an error.
///
/// Which value holds: a later one replaces an earlier one, but a value from the command line is
/// not replaced by one from a file, so that the file may be loaded before or after.
///
/// Errors are reported as imr::exception with a sentence for the user; the settings are then
/// unchanged, also by a file or a command line of which only a part is wrong.
///
/// Threads: all members may be called from any thread. Objects can't be copied; pass references.
class CConfig {
 public:
  /// What parse_command_line() does with arguments that are no options of this configuration.
  enum class UnknownArguments {
    kError,  ///< An exception.
    kKeep    ///< They are kept, in order; see positional().
  };

  /// What parse_command_line() does when a required option has no value afterwards.
  enum class MissingOptions {
    kError,  ///< An exception that names them.
    kAllow   ///< Nothing; call check_required() after the last source.
  };

  CConfig();
  ~CConfig();
  CConfig(const CConfig&) = delete;
  CConfig& operator=(const CConfig&) = delete;

  /// Declares a required option: get() throws until it has a value.
  ///
  /// @param name         letters, digits, '-', '_' and '.'; begins with none of the marks. "help"
  ///                     and "h" are taken.
  /// @param description  for --help.
  /// @return this configuration.
  /// @throws imr::exception if the name is not allowed, or was added before.
  template <typename T>
  CConfig& add(const std::string& name, const std::string& description) {
    add_option(name, description, std::make_shared<detail::TypedConfigValue<T>>(T()), false);
    return *this;
  }

  /// Declares an option with a default value; the rest as above.
  template <typename T>
  CConfig& add(const std::string& name, const std::string& description, const T& default_value) {
    add_option(name, description, std::make_shared<detail::TypedConfigValue<T>>(default_value),
               true);
    return *this;
  }

  /// The value of an option.
  ///
  /// @tparam T  the type that the option was added with.
  /// @throws imr::exception if there is no such option, if it has another type, or if it is
  ///         required and has no value yet.
  template <typename T>
  T get(const std::string& name) const {
    // find_value() has checked the type.
    return static_cast<const detail::TypedConfigValue<T>&>(*find_value(name, typeid(T))).value();
  }

  /// Sets an option from text, as if it stood on the command line.
  ///
  /// @throws imr::exception if there is no such option, or the text is no value of its type.
  void set(const std::string& name, const std::string& text);

  /// As above.
  void set(const std::string& name, const char* text);

  /// Sets an option to a value of its own type. set<std::string>() sets an option of any type from
  /// text.
  ///
  /// @throws imr::exception if there is no such option, or it has another type.
  template <typename T>
  void set(const std::string& name, const T& value) {
    set_typed(name, value, std::is_same<T, std::string>());
  }

  /// What is declared of an option.
  struct OptionInfo {
    std::string name;
    std::string description;
    std::string type;          ///< in words, as in the help table: "int", "string", ...
    bool has_default = false;  ///< and default_text is one that set() understands
    std::string default_text;
  };
  /// All options, in the order of their declaration.
  std::vector<OptionInfo> options() const;

  /// Prints a line "name=value" for each option, in that order; nothing after the "=" of one
  /// without a value.
  void print(std::ostream& out) const;

  /// Whether an option of this name was added.
  bool has(const std::string& name) const;

  /// Fills the options from the arguments of main().
  ///
  /// Understood are `--name value` and `--name=value`; for bool options also `--name` (true),
  /// `--no-name` (false), and `--name value` if the value is one of bool's words. A value that
  /// begins with "--", or is "-h", must be joined by "="; negative numbers need not. `--` ends the
  /// options: what follows is positional. The last of several values of an option holds.
  ///
  /// `-h` or `--help` anywhere among the options prints help() on standard output, and nothing
  /// else is looked at.
  ///
  /// @param argc     number of arguments, the program's name included.
  /// @param argv     the arguments; argv[0] is the program's name, which the help shows.
  /// @param unknown  what to do with arguments that are no options of this configuration.
  /// @param missing  what to do about required options without a value.
  /// @return whether the program should go on; false after --help.
  /// @throws imr::exception for an unknown option (the nearest known one is named), a value that
  ///         is missing or of the wrong type, a missing required option.
  bool parse_command_line(int argc, const char* const* argv,
                          UnknownArguments unknown = UnknownArguments::kError,
                          MissingOptions missing = MissingOptions::kError);

  /// The arguments that the last parse_command_line() with UnknownArguments::kKeep kept, in order.
  std::vector<std::string> positional() const;

  /// Fills options from a text file.
  ///
  /// A line is empty, or `name = value`; `#` at the start of a line or after white space begins a
  /// comment. A value in double quotes is taken as it stands, '#' and white space included; within
  /// it \" is a quote and \\ a backslash. An empty text is written "".
  ///
  /// @param path  the file.
  /// @throws imr::exception that begins with "path:line: " for a line that is no such line, an
  ///         unknown or repeated name, a value of the wrong type; or if the file can't be read.
  void load_file(const std::string& path);

  /// @throws imr::exception that names all required options without a value, if there are any.
  void check_required() const;

  /// The table that --help prints: each option's name, type, default and description, in the order
  /// of their declaration, at most 100 columns wide where words allow.
  ///
  /// @param program  name of the program for the first line.
  std::string help(const std::string& program = "program") const;

 private:
  struct Impl;

  void add_option(const std::string& name, const std::string& description,
                  std::shared_ptr<const detail::ConfigValue> value, bool has_default);
  std::shared_ptr<const detail::ConfigValue> find_value(const std::string& name,
                                                        const std::type_info& type) const;
  void set_value(const std::string& name, std::shared_ptr<const detail::ConfigValue> value);

  void set_typed(const std::string& name, const std::string& text, std::true_type /*is_text*/) {
    set(name, text);
  }
  template <typename T>
  void set_typed(const std::string& name, const T& value, std::false_type /*is_text*/) {
    set_value(name, std::make_shared<detail::TypedConfigValue<T>>(value));
  }

  std::unique_ptr<Impl> impl_;
};

}  // namespace imr
