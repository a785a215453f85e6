// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"

/// @file
/// A struct that is read, written or sent (settings, readings, commands, requests) lists its fields
/// once, in a FieldTable beside it. Readers, writers, checks, hashes and documentation walk that
/// table. None of them is a template, so a further struct adds its table and no code. Ranges stand
/// in the tables only: the comments of members do not repeat them, the pages of docs/ list them.
///
///     constexpr Field kReadingFields[] = {
///         field<&LaserReading::ranges_m>("ranges", "m"),
///         field<&LaserReading::range_max_m>("range_max", "m"),
///     };
///     SIM_FIELDS(LaserReading, kReadingFields)
namespace sim {

/// Bounds of a number. Error messages state them in words.
struct NumberRange {
  double min = -1e9;
  double max = 1e9;
  bool min_exclusive = false;
  const char* unit = "";  ///< for messages, e.g. "m"
};

/// What a member holds. Deduced from its C++ type.
enum class FieldType : std::uint8_t {
  kNumber,   ///< double
  kInt,      ///< int
  kInt64,    ///< std::int64_t
  kUint32,   ///< std::uint32_t
  kUint64,   ///< std::uint64_t, at most 2^63 - 1
  kBool,     ///< bool
  kText,     ///< std::string
  kChoice,   ///< enumeration of the size of an int, with values that count from 0; see Field::words
  kColour,   ///< Colour
  kVec2,     ///< Vec2
  kPose,     ///< Pose
  kVec3,     ///< std::array<double, 3>
  kBytes,    ///< std::vector<std::uint8_t>, opaque
  kOctets,   ///< std::vector<std::uint8_t>, numbers from 0 to 255
  kNumbers,  ///< std::vector<double>
  kTexts,    ///< std::vector<std::string>
  kPoses,    ///< std::vector<Pose>
  kPoints,   ///< std::vector<Vec2>
  kList,     ///< std::vector of structs that have a table, of variants, or of values that
             ///< Field::element reads
  kMap,      ///< std::map from std::string to a type of this list
  kStruct,   ///< a struct that has a table
  kVariant,  ///< std::variant of structs, see Field::kinds
  kInclude,  ///< base class that has a table; its fields appear among those of the derived class
  kCustom,   ///< see Field::custom
  kForm,     ///< a value that occurs only in messages; see Field::form
};

/// An error in the combination of a struct's fields.
struct FieldError {
  std::string id;        ///< in world files, e.g. "device/battery-voltage"
  std::string expected;  ///< in words, after "expected "
  std::string found;
  std::string hint;
  const char* key = "";  ///< the wrong field; empty if it is the struct as a whole
};

/// What part of the world a text, or each text of a list, names.
enum class NamedPart {
  kNone,
  kObstacle,
  kDynamicObstacle,
  kRobot,          ///< may be empty where a robot has sprung a trap
  kConfiguration,  ///< of the arena
  kSwitch,         ///< a timer or a trap
};

struct Field;
/// How messages write and read the values of a type. The protocol defines it.
struct MessageForm;

/// The fields of a struct, in the order in which they are read, written and shown.
struct FieldTable {
  std::span<const Field> fields;
  /// Checks all fields together after they are read; nullptr if there is nothing to check.
  std::optional<FieldError> (*check)(const void* object) = nullptr;
};

/// The table of a struct; specialised next to the struct.
template <typename Struct>
[[nodiscard]] const FieldTable& fields_of();

/// Declares that SIM_FIELDS defines fields_of<Struct>() elsewhere.
#define SIM_HAS_FIELDS(Struct) \
  template <>                  \
  const FieldTable& fields_of<Struct>();

/// Defines fields_of<Struct>() in namespace sim: SIM_FIELDS(Struct, kFields), or
/// SIM_FIELDS(Struct, kFields, check).
#define SIM_FIELDS(Struct, ...)                         \
  template <>                                           \
  const FieldTable& fields_of<Struct>() {               \
    static constexpr FieldTable kTable = {__VA_ARGS__}; \
    return kTable;                                      \
  }

/// Access to a std::vector whose element type the caller does not know.
struct ListAccess {
  std::size_t (*size)(const void* list);
  const void* (*at)(const void* list, std::size_t index);
  void* (*append)(void* list);
  void (*clear)(void* list);
};

/// One way to write a value that files write in several ways: an alternative of a variant, or a
/// struct of which a member says what it describes. Made by kind().
struct Kind {
  const char* word;                        ///< its key or name in files
  const FieldTable& (*table)();            ///< its fields
  void* (*make)(void* value);              ///< makes the value one of this kind; returns its struct
  const void* (*find)(const void* value);  ///< its struct; nullptr if the value is of another kind
  const char* meaning = "";                ///< a phrase in lower case, in Markdown
  /// The key is also that of the kind's only field, so files need no object: {"message": "hello"}.
  bool is_bare = false;
  /// Its key stands in the object that has the variant, instead of the variant's own key.
  bool is_beside = false;
  /// A copy with is_bare.
  [[nodiscard]] constexpr Kind bare() const {
    Kind made = *this;
    made.is_bare = true;
    return made;
  }
  /// A copy with is_beside.
  [[nodiscard]] constexpr Kind beside() const {
    Kind made = *this;
    made.is_beside = true;
    return made;
  }
};

/// A list element that is written as a single value in world files (sim/io/field_reader.h).
struct ElementType;

/// A field of a world file with a format of its own (sim/io/field_reader.h).
struct CustomField;

/// What the levels of realism set a number to, in the units of world files (sim/world/realism.h).
struct RealismFigures {
  double ideal = 0.0;  ///< without any error
  double real = 0.0;   ///< if neither the world nor the robot's model sets the number
};

/// One field of a struct. Made by field<>(), include<>() and custom<>().
struct Field {
  const char* name;  ///< its key; empty if the parts of a vector or pose appear as fields of the
                     ///< struct itself
  FieldType type;
  NumberRange range = {};    ///< of a number or of each part; range.unit is the field's unit
  const char* meaning = "";  ///< a phrase in lower case, in Markdown
  std::int64_t least = 0;    ///< smallest value of a whole number
  std::int64_t greatest = 0;
  std::size_t min_count = 0;  ///< minimum number of elements of a list
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  std::span<const char* const> words = {};  ///< names of a choice's values, in their order
  /// Name of the property that clients see; nullptr: the field's name without "_deg".
  const char* property = nullptr;
  bool is_property = true;           ///< clients see it as a property
  bool read_only = false;            ///< read_fields() does not read it: clients see it, but world
                                     ///< files cannot set it
  bool is_read_apart = false;        ///< read_only, but other code reads it from world files
  bool lists_elements = false;       ///< clients see each element's fields, not only the number of
                                     ///< elements
  bool may_be_left_out = false;      ///< may be missing in messages, and then keeps its default
  bool null_if_empty = false;        ///< messages say null for an empty std::optional
  bool is_angle = false;             ///< in degrees in world files, in radians elsewhere
  const char* needed_for = nullptr;  ///< the field must name something; what it is needed for
  const char* issue_id = nullptr;    ///< issue id for a list with wrong, too few or too many
                                     ///< elements
  const char* issue_expected = nullptr;    ///< the text after "expected" in that issue, and in
                                           ///< errors of messages about words, colours and lists
  const FieldTable& (*table)() = nullptr;  ///< table of a struct, or of a list's elements
  const ListAccess* list = nullptr;
  const ElementType* element = nullptr;
  const CustomField* custom = nullptr;
  const MessageForm* form = nullptr;
  /// Properties of a kCustom field.
  void (*add_custom_properties)(const void* object,
                                std::map<std::string, double>& properties) = nullptr;
  std::span<const Kind> kinds = {};    ///< of a variant, or of a list's elements
  bool is_name = false;                ///< a text of letters, digits, _ and -
  NamedPart names = NamedPart::kNone;  ///< the part must exist
  bool in_seconds = false;  ///< SimTime, in seconds in world files; its range is in seconds, too
  bool is_identity = true;  ///< part of what tells worlds apart, see world_hash()
  bool first_word = false;  ///< of a bool with words: the value of the first word
  bool is_keyed = false;    ///< a list that files write as an object: its keys are the first,
                          ///< read-only field of the elements, and its values have the other fields
  bool may_be_null = false;       ///< an optional member: null in a file is the same as no key
  const char* default_text = "";  ///< the default in words, in Markdown, if it depends on others
  std::optional<RealismFigures> realism = {};  ///< of a number that the level of realism changes
  std::optional<double> unlisted_at = {};  ///< clients see no such property while a number has this
                                           ///< value
  /// Pointer to the value in an object; nullptr if the value is an empty std::optional.
  [[nodiscard]] const void* get(const void* object) const {
    return find != nullptr ? find(object) : set(const_cast<void*>(object));
  }
  /// get() of a std::optional; nullptr for other members, whose set() changes nothing.
  const void* (*find)(const void* object) = nullptr;
  /// Pointer for writing the value; fills an empty std::optional first.
  void* (*set)(void* object) = nullptr;
  /// Resets a std::optional; nullptr for other members.
  void (*drop)(void* object) = nullptr;

  /// @name For tables: a copy of the field with one property changed
  /// @{
  template <auto kTrait, typename Value>
  [[nodiscard]] constexpr Field with(Value value) const {
    Field made = *this;
    made.*kTrait = value;
    return made;
  }
  [[nodiscard]] constexpr Field within(double min, double max) const {
    Field made = *this;
    made.range = {min, max, false, range.unit};
    made.least = static_cast<std::int64_t>(min);
    made.greatest = static_cast<std::int64_t>(max);
    return made;
  }
  [[nodiscard]] constexpr Field above(double min, double max) const {
    Field made = within(min, max);
    made.range.min_exclusive = true;
    return made;
  }
  [[nodiscard]] constexpr Field counting(std::size_t from, std::size_t to) const {
    return with<&Field::min_count>(from).with<&Field::max_count>(to);
  }
  [[nodiscard]] constexpr Field one_of(std::span<const char* const> all) const {
    return with<&Field::words>(all);
  }
  [[nodiscard]] constexpr Field of(const ElementType& type_of_elements) const {
    Field made = with<&Field::element>(&type_of_elements);
    made.type = FieldType::kList;
    made.table = nullptr;
    return made;
  }
  [[nodiscard]] constexpr Field with_issue(const char* id, const char* expected) const {
    return with<&Field::issue_id>(id).with<&Field::issue_expected>(expected);
  }
  /// What errors of messages say that they expected.
  [[nodiscard]] constexpr Field expecting(const char* what) const {
    return with<&Field::issue_expected>(what);
  }
  /// An empty std::optional is null in messages, instead of missing.
  [[nodiscard]] constexpr Field nullable() const { return with<&Field::null_if_empty>(true); }
  [[nodiscard]] constexpr Field property_name(const char* key) const {
    return with<&Field::property>(key);
  }
  [[nodiscard]] constexpr Field needed(const char* what_for) const {
    return with<&Field::needed_for>(what_for);
  }
  [[nodiscard]] constexpr Field naming(NamedPart part) const { return with<&Field::names>(part); }
  [[nodiscard]] constexpr Field as_name() const { return with<&Field::is_name>(true); }
  /// A bool that files write as one of two words.
  /// @param first  the value of the first word.
  [[nodiscard]] constexpr Field one_of(std::span<const char* const> two, bool first) const {
    return with<&Field::words>(two).with<&Field::first_word>(first);
  }
  [[nodiscard]] constexpr Field seconds(NumberRange values) const {
    return with<&Field::in_seconds>(true).with<&Field::range>(values);
  }
  /// @param what  an element or the value, for messages: "an action".
  [[nodiscard]] constexpr Field of_kinds(std::span<const Kind> all, const char* what) const {
    return with<&Field::kinds>(all).with<&Field::issue_expected>(what);
  }
  /// World files have a format of its own for it.
  [[nodiscard]] constexpr Field in_format(const CustomField& format) const {
    return with<&Field::custom>(&format);
  }
  [[nodiscard]] constexpr Field keyed() const { return with<&Field::is_keyed>(true); }
  [[nodiscard]] constexpr Field or_null() const { return with<&Field::may_be_null>(true); }
  [[nodiscard]] constexpr Field not_identity() const { return with<&Field::is_identity>(false); }
  /// As a list of numbers from 0 to 255, not as opaque bytes.
  [[nodiscard]] constexpr Field as_octets() const { return with<&Field::type>(FieldType::kOctets); }
  [[nodiscard]] constexpr Field or_default() const { return with<&Field::may_be_left_out>(true); }
  [[nodiscard]] constexpr Field not_property() const { return with<&Field::is_property>(false); }
  [[nodiscard]] constexpr Field as_read_only() const { return with<&Field::read_only>(true); }
  [[nodiscard]] constexpr Field read_apart() const {
    return as_read_only().with<&Field::is_read_apart>(true);
  }
  [[nodiscard]] constexpr Field defaults_to(const char* text) const {
    return with<&Field::default_text>(text);
  }
  [[nodiscard]] constexpr Field listing_elements() const {
    return with<&Field::lists_elements>(true);
  }
  /// A number that the level of realism changes.
  [[nodiscard]] constexpr Field with_realism(double ideal, double real) const {
    return with<&Field::realism>(RealismFigures{ideal, real});
  }
  /// Not a property while the number has this value, in SI units and radians. So a device without
  /// the setting has the properties, and the hash, that it had before the setting existed.
  [[nodiscard]] constexpr Field unlisted(double at) const { return with<&Field::unlisted_at>(at); }
  /// @}
};

/// @cond
namespace field_detail {

template <typename Member>
struct Parts;
template <typename Type, typename Class>
struct Parts<Type Class::*> {
  using Owner = Class;
};

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <typename T>
inline constexpr bool kIsVector = false;
template <typename T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <typename T>
inline constexpr bool kIsVariant = false;
template <typename... Kinds>
inline constexpr bool kIsVariant<std::variant<Kinds...>> = true;
template <typename T>
inline constexpr bool kIsMap = false;
template <typename T>
inline constexpr bool kIsMap<std::map<std::string, T>> = true;

template <typename T>
struct ValueOf {
  using Type = T;
};
template <typename T>
struct ValueOf<std::optional<T>> {
  using Type = T;
};

template <typename T>
[[nodiscard]] constexpr FieldType type_of() {
  if constexpr (std::is_same_v<T, double>) return FieldType::kNumber;
  if constexpr (std::is_same_v<T, int>) return FieldType::kInt;
  if constexpr (std::is_same_v<T, std::int64_t>) return FieldType::kInt64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return FieldType::kUint32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return FieldType::kUint64;
  if constexpr (std::is_same_v<T, bool>) return FieldType::kBool;
  if constexpr (std::is_same_v<T, std::string>) return FieldType::kText;
  if constexpr (std::is_enum_v<T>) return FieldType::kChoice;
  if constexpr (std::is_same_v<T, Colour>) return FieldType::kColour;
  if constexpr (std::is_same_v<T, Vec2>) return FieldType::kVec2;
  if constexpr (std::is_same_v<T, Pose>) return FieldType::kPose;
  if constexpr (std::is_same_v<T, std::array<double, 3>>) return FieldType::kVec3;
  if constexpr (std::is_same_v<T, std::vector<std::uint8_t>>) return FieldType::kBytes;
  if constexpr (std::is_same_v<T, std::vector<double>>) return FieldType::kNumbers;
  if constexpr (std::is_same_v<T, std::vector<std::string>>) return FieldType::kTexts;
  if constexpr (std::is_same_v<T, std::vector<Pose>>) return FieldType::kPoses;
  if constexpr (std::is_same_v<T, std::vector<Vec2>>) return FieldType::kPoints;
  if constexpr (kIsVariant<T>) return FieldType::kVariant;
  if constexpr (kIsMap<T>) return FieldType::kMap;
  return kIsVector<T> ? FieldType::kList : FieldType::kStruct;
}

/// Smallest and largest value of an integer type that messages can hold.
template <typename T>
[[nodiscard]] constexpr std::pair<std::int64_t, std::int64_t> integer_range() {
  if constexpr (std::is_same_v<T, std::uint64_t>) {
    return {0, std::numeric_limits<std::int64_t>::max()};
  } else if constexpr (std::is_integral_v<T>) {
    return {std::int64_t{std::numeric_limits<T>::min()},
            std::int64_t{std::numeric_limits<T>::max()}};
  } else {
    return {0, 0};
  }
}

template <typename List>
inline constexpr ListAccess kAccess = {
    [](const void* list) { return static_cast<const List*>(list)->size(); },
    [](const void* list, std::size_t i) -> const void* {
      return &(*static_cast<const List*>(list))[i];
    },
    [](void* list) -> void* { return &static_cast<List*>(list)->emplace_back(); },
    [](void* list) { static_cast<List*>(list)->clear(); }};

/// Entries of a map are visited only.
template <typename Map>
inline constexpr ListAccess kEntries = {
    [](const void* map) { return static_cast<const Map*>(map)->size(); },
    [](const void* map, std::size_t i) -> const void* {
      return &*std::next(static_cast<const Map*>(map)->begin(), static_cast<std::ptrdiff_t>(i));
    },
    nullptr, [](void* map) { static_cast<Map*>(map)->clear(); }};

template <typename Map>
[[nodiscard]] const FieldTable& entry_fields();

// What depends only on the type of the value. Each field has its own field(), so that is short.
template <typename Value>
[[nodiscard]] constexpr Field describe(const char* name, const char* unit, const char* meaning) {
  Field made{name, type_of<Value>()};
  made.range.unit = unit;
  made.meaning = meaning;
  const auto limits = integer_range<Value>();
  made.least = limits.first;
  made.greatest = limits.second;
  made.is_angle = made.type == FieldType::kNumber && std::string_view(name).ends_with("_deg");
  if constexpr (std::is_enum_v<Value>) static_assert(sizeof(Value) == sizeof(int));
  if constexpr (kIsVector<Value>) {
    made.list = &kAccess<Value>;
    if constexpr (type_of<Value>() == FieldType::kList && !kIsVariant<typename Value::value_type>) {
      made.table = &fields_of<typename Value::value_type>;
    }
  } else if constexpr (kIsMap<Value>) {
    made.list = &kEntries<Value>;
    made.table = &entry_fields<Value>;
  } else if constexpr (type_of<Value>() == FieldType::kStruct) {
    made.table = &fields_of<Value>;
  }
  return made;
}

/// A new value. Eigen would leave a vector undefined.
template <typename Value>
[[nodiscard]] Value blank() {
  if constexpr (std::is_same_v<Value, Vec2>) return Vec2::Zero();
  return Value();
}

template <typename Owner, auto... kMembers>
void* address(void* object) {
  return &(*static_cast<Owner*>(object).*....*kMembers);
}

// Adds the access to a member of a member ... of Owner; without members, to the object itself.
template <typename Owner, auto... kMembers>
[[nodiscard]] constexpr Field with_access(Field made) {
  using Member = std::remove_reference_t<decltype((std::declval<Owner&>().*....*kMembers))>;
  made.set = &address<Owner, kMembers...>;
  if constexpr (kIsOptional<Member>) {
    made.find = [](const void* object) -> const void* {
      const auto& member = (*static_cast<const Owner*>(object).*....*kMembers);
      return member.has_value() ? &*member : nullptr;
    };
    made.set = [](void* object) -> void* {
      auto& member = (*static_cast<Owner*>(object).*....*kMembers);
      return member.has_value() ? &*member
                                : &member.emplace(blank<typename ValueOf<Member>::Type>());
    };
    made.drop = [](void* object) { (*static_cast<Owner*>(object).*....*kMembers).reset(); };
  }
  return made;
}

template <typename Map>
const FieldTable& entry_fields() {
  using Entry = typename Map::value_type;
  static constexpr auto kFields = [] {
    Field key = describe<std::string>("key", "", "");
    key.find = [](const void* entry) -> const void* {
      return &static_cast<const Entry*>(entry)->first;
    };
    Field value = describe<typename Map::mapped_type>("value", "", "");
    value.set = [](void* entry) -> void* { return &static_cast<Entry*>(entry)->second; };
    return std::array{key, value};
  }();
  static constexpr FieldTable kTable = {kFields};
  return kTable;
}

}  // namespace field_detail
/// @endcond

/// A member of a struct, or a member of a member: field<&PoseReading::twist, &Twist::v_mps>("v",
/// "m/s").
/// @param unit     shown in messages and pages; empty if it has none.
/// @param meaning  shown in pages and in the schema.
template <auto kFirst, auto... kRest>
[[nodiscard]] constexpr Field field(const char* name, const char* unit = "",
                                    const char* meaning = "") {
  using Owner = typename field_detail::Parts<decltype(kFirst)>::Owner;
  using Member = std::remove_reference_t<decltype(((std::declval<Owner&>().*kFirst).*....*kRest))>;
  using Value = typename field_detail::ValueOf<Member>::Type;
  return field_detail::with_access<Owner, kFirst, kRest...>(
      field_detail::describe<Value>(name, unit, meaning));
}

/// A key of world files that is no member. Other code reads it.
template <typename Value>
[[nodiscard]] constexpr Field key_of_files(const char* name, const char* unit,
                                           const char* meaning) {
  return field_detail::describe<Value>(name, unit, meaning).read_apart().not_identity();
}

/// A member that occurs only in messages.
template <auto kMember>
[[nodiscard]] constexpr Field field(const char* name, const MessageForm& form) {
  Field made{name, FieldType::kForm};
  made.form = &form;
  return field_detail::with_access<typename field_detail::Parts<decltype(kMember)>::Owner, kMember>(
      made);
}

/// A message whose only field is the object itself.
template <typename Object>
[[nodiscard]] constexpr Field whole(const char* name) {
  return field_detail::with_access<Object>(
      field_detail::describe<typename field_detail::ValueOf<Object>::Type>(name, "", ""));
}
template <typename Object>
[[nodiscard]] constexpr Field whole(const char* name, const MessageForm& form) {  ///< in a form
  Field made{name, FieldType::kForm};
  made.form = &form;
  return field_detail::with_access<Object>(made);
}

/// The fields of a base class, listed among those of the derived class.
template <typename Derived, typename Base>
[[nodiscard]] constexpr Field include() {
  Field made{"", FieldType::kInclude};
  made.table = &fields_of<Base>;
  made.set = [](void* object) -> void* {
    return static_cast<Base*>(static_cast<Derived*>(object));
  };
  return made;
}

/// Further fields of the same struct, from a table of their own.
template <const auto& kFields>
[[nodiscard]] constexpr Field part() {
  Field made{"", FieldType::kInclude};
  made.table = []() -> const FieldTable& {
    static constexpr FieldTable kTable = {kFields};
    return kTable;
  };
  made.set = [](void* object) { return object; };
  return made;
}

/// A field of the value itself, for structs whose table has a single field:
/// field_itself<Polygon>().
template <typename Value>
[[nodiscard]] constexpr Field field_itself() {
  Field made = field_detail::describe<Value>("", "", "");
  made.set = [](void* object) { return object; };
  return made;
}

/// A kind of a variant: the alternative `Alternative`.
/// @tparam kFields  its fields, an array of Field.
template <typename Variant, typename Alternative, const auto& kFields>
[[nodiscard]] constexpr Kind kind(const char* word, const char* meaning) {
  return {word,
          []() -> const FieldTable& {
            static constexpr FieldTable kTable = {kFields};
            return kTable;
          },
          [](void* value) -> void* {
            return &static_cast<Variant*>(value)->template emplace<Alternative>();
          },
          [](const void* value) -> const void* {
            return std::get_if<Alternative>(static_cast<const Variant*>(value));
          },
          meaning};
}

/// A kind whose struct has the value `kValue` in a member. The struct is the value itself, or an
/// alternative of it if Value is a variant.
template <typename Value, auto kMember, auto kValue, const auto& kFields>
[[nodiscard]] constexpr Kind kind(const char* word, const char* meaning) {
  using Owner = typename field_detail::Parts<decltype(kMember)>::Owner;
  return {word,
          []() -> const FieldTable& {
            static constexpr FieldTable kTable = {kFields};
            return kTable;
          },
          [](void* value) -> void* {
            Owner* made = nullptr;
            if constexpr (std::is_same_v<Owner, Value>) {
              made = static_cast<Owner*>(value);
            } else {
              made = &static_cast<Value*>(value)->template emplace<Owner>();
            }
            made->*kMember = kValue;
            return made;
          },
          [](const void* value) -> const void* {
            const Owner* found = nullptr;
            if constexpr (std::is_same_v<Owner, Value>) {
              found = static_cast<const Owner*>(value);
            } else {
              found = std::get_if<Owner>(static_cast<const Value*>(value));
            }
            return found != nullptr && found->*kMember == kValue ? found : nullptr;
          },
          meaning};
}

/// A field that no FieldType fits.
[[nodiscard]] constexpr Field custom(const char* name, const CustomField& format,
                                     void (*add)(const void*, std::map<std::string, double>&),
                                     const char* unit, const char* meaning) {
  Field made{name, FieldType::kCustom};
  made.custom = &format;
  made.add_custom_properties = add;
  made.range.unit = unit;
  made.meaning = meaning;
  made.set = [](void* object) { return object; };
  return made;
}

/// Visits the fields of a table; fields of an included table are visited in its place.
/// @param visit  called with each field and the object that contains it.
template <typename Object, typename Visit>
void for_each_field(const FieldTable& table, Object* object, const Visit& visit) {
  for (const Field& one : table.fields) {
    if (one.type != FieldType::kInclude) {
      visit(one, object);
    } else if constexpr (std::is_const_v<Object>) {
      for_each_field(one.table(), one.get(object), visit);
    } else {
      for_each_field(one.table(), one.set(object), visit);
    }
  }
}

/// The field with that name. @pre there is one, not in an included table
[[nodiscard]] const Field& field_named(const FieldTable& table, std::string_view name);

/// Reads a whole number or a choice of any size.
[[nodiscard]] std::int64_t integer_at(const Field& field, const void* value);
/// Writes a whole number or a choice of any size.
void set_integer(const Field& field, void* value, std::int64_t number);

/// Whether all numbers of a struct are finite.
[[nodiscard]] bool all_finite(const FieldTable& table, const void* object);

/// Adds the numbers of a struct to the properties that clients see, in SI units and radians. A list
/// adds its length; with lists_elements, it adds each element's fields with the suffixes "_0",
/// "_1", ...
void add_properties(const FieldTable& table, const void* object,
                    std::map<std::string, double>& properties, const std::string& suffix = "");

/// One alternative of a variant of structs: its name in messages and its fields.
template <typename Variant>
struct AlternativeKind {
  const char* name;
  const FieldTable& (*fields)();
  Variant (*make)();
};

/// The alternatives of a variant, in its order.
/// @param names  one per alternative.
template <typename Variant>
[[nodiscard]] constexpr auto alternative_kinds(
    const std::array<const char*, std::variant_size_v<Variant>>& names) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<AlternativeKind<Variant>, sizeof...(kIndex)>{AlternativeKind<Variant>{
        names[kIndex], &fields_of<std::variant_alternative_t<kIndex, Variant>>,
        [] { return Variant(std::in_place_index<kIndex>); }}...};
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// Pointer to the struct that a variant holds.
template <typename Variant>
[[nodiscard]] auto* object_in(Variant& variant) {
  using Object = std::conditional_t<std::is_const_v<Variant>, const void, void>;
  return std::visit([](auto& alternative) -> Object* { return &alternative; }, variant);
}

}  // namespace sim
