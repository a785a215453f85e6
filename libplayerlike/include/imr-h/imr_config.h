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

/// Result of parsing a value from text.
enum class ParseResult { kOk, kMalformed, kOutOfRange };

/// @name Parsing a value from a complete text
/// Parsing does not depend on the locale. The value is unchanged unless the result is kOk. Integers
/// are decimal. Floating-point numbers may be infinite but not NaN. A bool is true/false, yes/no,
/// on/off or 1/0, in upper or lower case.
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

/// Parses any other type with its operator>>, which must consume the whole text except for trailing
/// white space.
template <typename T>
ParseResult parse_text(const std::string& text, T& value) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  T read = T();
  if (!(in >> read)) {
    return ParseResult::kMalformed;
  }
  // Only white space may follow the value.
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

// Fallback for a type that has operator>> but no operator<<.
template <typename T>
std::string print_text(const T& /*value*/, long /*fallback*/) {
  return "(set)";
}

template <typename T>
std::string to_text(const T& value) {
  return print_text(value, 0);
}
/// @}

/// An immutable value of any type. Because it never changes, it can be read without a lock.
class ConfigValue {
 public:
  virtual ~ConfigValue();
  virtual const std::type_info& type() const noexcept = 0;
  virtual std::string text() const = 0;
  /// Parses a new value of the same type from text. Returns null unless result becomes kOk.
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

/// The named settings of a program. The program declares them once in code; their values then come
/// from a file, from the command line and from the program itself.
///
///   imr::CConfig config;
///   config.add<std::string>("host", "server to connect to", "localhost");
///   config.add<int>("port", "its port", 6665);
///   config.add<double>("speed", "forward speed in m/s");       // no default: required
///   if (!config.parse_command_line(argc, argv)) return 0;      // --help was asked for
///   const double speed = config.get<double>("speed");
///
/// Types: bool, short, int, long, long long and their unsigned forms, float, double, std::string,
/// and any other copyable type with a default constructor and an operator>>. The type is part of
/// the declaration: reading an int as a double is an error.
///
/// Precedence: a later value replaces an earlier one, except that a value from a file never
/// replaces one from the command line. The file may therefore be loaded before or after the command
/// line is parsed.
///
/// Errors: members throw imr::exception with a message for the user. A call that throws leaves all
/// settings unchanged, even if only a part of the file or command line is wrong.
///
/// Threads: all members may be called from any thread. Objects cannot be copied; pass references.
class CConfig {
 public:
  /// How parse_command_line() handles arguments that are not options of this configuration.
  enum class UnknownArguments {
    kError,  ///< Throws an exception.
    kKeep    ///< Keeps them, in order; see positional().
  };

  /// How parse_command_line() handles required options that still have no value.
  enum class MissingOptions {
    kError,  ///< Throws an exception that names them.
    kAllow   ///< Does nothing; call check_required() after the last source.
  };

  CConfig();
  ~CConfig();
  CConfig(const CConfig&) = delete;
  CConfig& operator=(const CConfig&) = delete;

  /// Declares a required option: get() throws until it has a value.
  ///
  /// @param name         letters, digits, '-', '_' and '.'; the first character is a letter or a
  ///                     digit. "help" and "h" are reserved.
  /// @param description  for --help.
  /// @return this configuration.
  /// @throws imr::exception if the name is invalid or was added before.
  template <typename T>
  CConfig& add(const std::string& name, const std::string& description) {
    add_option(name, description, std::make_shared<detail::TypedConfigValue<T>>(T()), false);
    return *this;
  }

  /// Declares an option with a default value. Parameters and errors are those of the overload
  /// above.
  template <typename T>
  CConfig& add(const std::string& name, const std::string& description, const T& default_value) {
    add_option(name, description, std::make_shared<detail::TypedConfigValue<T>>(default_value),
               true);
    return *this;
  }

  /// Returns the value of an option.
  ///
  /// @tparam T  the type with which the option was added.
  /// @throws imr::exception if there is no such option, if it has another type, or if it is
  ///         required and has no value yet.
  template <typename T>
  T get(const std::string& name) const {
    // find_value() has checked the type.
    return static_cast<const detail::TypedConfigValue<T>&>(*find_value(name, typeid(T))).value();
  }

  /// Sets an option from text, with the syntax of a value on the command line.
  ///
  /// @throws imr::exception if there is no such option, or if the text cannot be parsed as its
  ///         type.
  void set(const std::string& name, const std::string& text);

  /// Overload for string literals. A null pointer also throws imr::exception.
  void set(const std::string& name, const char* text);

  /// Sets an option to a value of its own type. For T = std::string, the option may have any type;
  /// the text is then parsed.
  ///
  /// @throws imr::exception if there is no such option, or if it has another type.
  template <typename T>
  void set(const std::string& name, const T& value) {
    set_typed(name, value, std::is_same<T, std::string>());
  }

  /// The declaration of an option.
  struct OptionInfo {
    std::string name;
    std::string description;
    std::string type;          ///< type name, as in the help table: "int", "string", ...
    bool has_default = false;  ///< if true, set() accepts default_text
    std::string default_text;
  };
  /// Returns all options in the order of their declaration.
  std::vector<OptionInfo> options() const;

  /// Prints a line "name=value" for each option, in the order of declaration. For an option without
  /// a value, nothing follows the "=".
  void print(std::ostream& out) const;

  /// Returns whether an option of this name was added.
  bool has(const std::string& name) const;

  /// Fills the options from the arguments of main().
  ///
  /// The syntax is `--name value` or `--name=value`. Bool options also accept `--name` (true),
  /// `--no-name` (false), and `--name value` if the value is one of the words for bool. A value
  /// that begins with "--" or equals "-h" needs the form with "="; a negative number does not. `--`
  /// ends the options: all arguments after it are positional. If an option occurs several times,
  /// the last value is used.
  ///
  /// `-h` or `--help` anywhere among the options prints help() on standard output; all other
  /// arguments are then ignored.
  ///
  /// @param argc     number of arguments, the program's name included.
  /// @param argv     the arguments; argv[0] is the program's name, which the help shows.
  /// @param unknown  how to handle arguments that are not options of this configuration.
  /// @param missing  how to handle required options without a value.
  /// @return whether the program should continue; false after --help.
  /// @throws imr::exception for an unknown option (the message names the most similar known one), a
  ///         missing value, a value of the wrong type, or a missing required option.
  bool parse_command_line(int argc, const char* const* argv,
                          UnknownArguments unknown = UnknownArguments::kError,
                          MissingOptions missing = MissingOptions::kError);

  /// Returns the arguments that the last parse_command_line() with UnknownArguments::kKeep kept, in
  /// order.
  std::vector<std::string> positional() const;

  /// Fills options from a text file.
  ///
  /// Each line is empty or has the form `name = value`. `#` at the start of a line or after white
  /// space begins a comment. A value in double quotes is taken literally, including '#' and white
  /// space; within it \" is a quote and \\ a backslash. An empty text is written as "".
  ///
  /// @param path  the file.
  /// @throws imr::exception if the file cannot be read; or, with a message that begins with
  ///         "path:line: ", for a malformed line, an unknown or repeated name, or a value of the
  ///         wrong type.
  void load_file(const std::string& path);

  /// @throws imr::exception if required options have no value; the message names all of them.
  void check_required() const;

  /// Returns the table that --help prints: name, type, default and description of each option, in
  /// the order of declaration. Lines are at most 100 columns wide unless a single word is longer.
  ///
  /// @param program  name of the program, shown in the first line.
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
