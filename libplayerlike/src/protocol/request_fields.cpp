// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/request_fields.h"

#include <limits>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "protocol/message_table.h"

// --- Values that are not a sim::FieldType

namespace playerlike::protocol::form {
namespace {

constexpr int kMaxSide = 1 << 14;  // of a rectangle; canvases have at most 8192

json encode_rect(const sim::CellRect& rect) {
  return {rect.column, rect.row, rect.width, rect.height};
}

sim::CellRect require_rect(const json& object, const char* key) {
  const json& rect = require(object, key);
  if (!rect.is_array() || rect.size() != 4) {
    refuse_value(key, "[column, row, width, height]", rect);
  }
  const auto number = [&](std::size_t i, std::int64_t least, std::int64_t most) {
    return static_cast<int>(require_integer({{key, rect[i]}}, key, least, most));
  };
  constexpr std::int64_t kFarthest = 1 << 30;
  return {number(0, -kFarthest, kFarthest), number(1, -kFarthest, kFarthest),
          number(2, 0, kMaxSide), number(3, 0, kMaxSide)};
}

json encode_cell(const sim::CellValue& cell, Encoding encoding) {
  return encode_cells(std::span(&cell, 1), encoding);
}

void read_cells(const json& object, const char* key, Encoding encoding, void* value) {
  decode_cells(require(object, key), encoding, *static_cast<std::vector<sim::CellValue>*>(value));
}

sim::CellValue require_cell(const json& object, const char* key, Encoding encoding) {
  const auto cells = decode_cells(require(object, key), encoding);
  if (cells.size() != 1) throw ProtocolError("protocol/bad-value", "cell: not one");
  return cells.front();
}

sim::OccupancyMap require_map(const json& object, const char* key, Encoding encoding) {
  return decode_map(require(object, key), encoding);
}

sim::LayerStyle require_style(const json& object, const char* key) {
  return decode_style(require(object, key));
}

template <auto kEncode, typename Value>
json encode(const void* value, Encoding encoding) {
  const auto& typed = *static_cast<const Value*>(value);
  if constexpr (std::is_invocable_v<decltype(kEncode), const Value&>) {
    return kEncode(typed);
  } else {
    return kEncode(typed, encoding);
  }
}

template <auto kDecode, typename Value>
void decode(const json& object, const char* key, Encoding encoding, void* value) {
  if constexpr (std::is_invocable_v<decltype(kDecode), const json&, const char*>) {
    *static_cast<Value*>(value) = kDecode(object, key);
  } else {
    *static_cast<Value*>(value) = kDecode(object, key, encoding);
  }
}

template <typename Value, auto kEncode, auto kDecode>
constexpr sim::MessageForm kForm = {encode<kEncode, Value>, decode<kDecode, Value>};

constexpr auto kDevice = kForm<DeviceId, encode_device_id, require_device_id>;
constexpr auto kRect = kForm<sim::CellRect, encode_rect, require_rect>;
constexpr auto kCell = kForm<sim::CellValue, encode_cell, require_cell>;
constexpr sim::MessageForm kCells = {encode<encode_cells, std::vector<sim::CellValue>>, read_cells};
constexpr auto kProperty = kForm<PropertyValue, encode_property, require_property>;
constexpr auto kMap = kForm<sim::OccupancyMap, encode_map, require_map>;
constexpr auto kStyle = kForm<sim::LayerStyle, encode_style, require_style>;

// --- Enumerations whose values count from 0

std::string_view to_string(sim::LayerKind kind) {
  constexpr std::string_view kNames[] = {"colour", "binary", "grey"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view to_string(sim::TimeMode mode) {
  return mode == sim::TimeMode::kLockstep ? "lockstep" : "paced";
}

template <typename Enum>
constexpr const char* kExpected = nullptr;
template <>
constexpr const char* kExpected<sim::LayerKind> = R"("colour", "binary" or "grey")";
template <>
constexpr const char* kExpected<sim::TimeMode> = R"("lockstep" or "paced")";
template <>
constexpr const char* kExpected<sim::ViewMode> = "ground, mini-map or full-screen";
template <>
constexpr const char* kExpected<sim::io::MapMode> = "trinary or scale";
template <>
constexpr const char* kExpected<sim::ArenaEventKind> = "a kind of event";

template <typename Enum>
json encode_word(Enum value) {
  return to_string(value);
}

template <auto kLast, typename Enum = decltype(kLast)>
Enum require_word(const json& object, const char* key) {
  const json& word = require(object, key);
  for (int i = 0; i <= static_cast<int>(kLast); ++i) {
    if (word == to_string(static_cast<Enum>(i))) return static_cast<Enum>(i);
  }
  refuse_value(key, kExpected<Enum>, word);
}

template <auto kLast, typename Enum = decltype(kLast)>
constexpr auto kWord = kForm<Enum, encode_word<Enum>, require_word<kLast>>;

constexpr auto kLayerKind = kWord<sim::LayerKind::kGrey>;
constexpr auto kTimeMode = kWord<sim::TimeMode::kPaced>;
constexpr auto kViewMode = kWord<sim::ViewMode::kFullScreen>;
constexpr auto kMapMode = kWord<sim::io::MapMode::kScale>;
constexpr auto kEventKind = kWord<sim::kLastArenaEventKind>;

// --- Maps from names

void read(const json& in, const char* key, double& value) { value = require_number(in, key); }
void read(const json& in, const char* key, std::string& value) { value = require_text(in, key); }
void read(const json& in, const char* key, int& value) {
  value = static_cast<int>(
      require_integer(in, key, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}
void read(const json& in, const char* key, std::vector<std::string>& value) {
  value = require_texts(in, key, "a list of texts");
}

template <typename Map>
json encode_members(const Map& map) {
  return map;
}

template <typename Map>
Map require_members(const json& object, const char* key) {
  const json& value = require(object, key);
  const auto* members = value.get_ptr<const json::object_t*>();
  if (members == nullptr) refuse_value(key, "an object", value);
  Map map;
  for (const auto& [name, member] : *members) read(value, name.c_str(), map[name]);
  return map;
}

template <typename Value, typename Map = std::map<std::string, Value>>
constexpr auto kMapOf = kForm<Map, encode_members<Map>, require_members<Map>>;

}  // namespace
}  // namespace playerlike::protocol::form

// --- Tables

namespace sim {
namespace {

namespace form = playerlike::protocol::form;

constexpr double kMost = 1 << 30;

constexpr const char* kColourText = "a colour like \"#34aaff\" or \"#34aaff80\"";

constexpr Field layer(const Field& of) { return of.within(0, kMost); }
constexpr Field in_cells(const Field& of) { return of.within(-kMost, kMost); }
constexpr Field map_side(const Field& of) { return of.within(1, 8192); }
constexpr Field natural(const Field& of) { return of.with<&Field::least>(0); }

std::optional<FieldError> check_canvas(const void* object) {
  if (static_cast<const playerlike::CanvasInfo*>(object)->cell_size_m > 0.0) return std::nullopt;
  return FieldError{"", "a number greater than 0", "", "", "cell_size"};
}

// Of a driver in messages; worlds have a table of their own.
const FieldTable& driver_fields() {
  static constexpr Field kFields[] = {
      field<&DriverDescription::type>("type"),
      field<&DriverDescription::settings>("settings", form::kMapOf<std::string>)};
  static constexpr FieldTable kTable = {kFields};
  return kTable;
}

}  // namespace

MESSAGE_CHECKED(playerlike::CanvasInfo, check_canvas, map_side(field<&T::width>("width")),
                map_side(field<&T::height>("height")), field<&T::cell_size_m>("cell_size"),
                field<&T::origin_x_m>("x"), field<&T::origin_y_m>("y"))
MESSAGE(playerlike::TimeStatistics, natural(field<&T::sim_time_ns>("t")), field<&T::steps>("steps"),
        field<&T::step_s>("step"), field<&T::wall_time_s>("wall_time"),
        field<&T::real_time_factor>("real_time_factor"),
        field<&T::duration_s>("duration").nullable(), field<&T::mode>("mode", form::kTimeMode),
        field<&T::finished>("finished"))
MESSAGE(playerlike::LogStatus, field<&T::replay>("replay"), field<&T::running>("running"),
        field<&T::file>("file"))
MESSAGE(LayerStyle, field<&T::name>("name").or_default(),
        field<&T::colour>("colour").expecting(kColourText).or_default(),
        field<&T::transparency>("transparency").or_default(),
        field<&T::transparent_colour>("transparent_colour")
            .expecting(kColourText)
            .nullable()
            .or_default(),
        field<&T::priority>("priority").or_default(), field<&T::visible>("visible").or_default())
MESSAGE(LayerInfo, field<&T::id>("layer"), field<&T::kind>("kind", form::kLayerKind),
        field<&T::owner>("owner"), field<&T::style>("style", form::kStyle))
MESSAGE(playerlike::DeviceInfo, field<&T::id>("device", form::kDevice), field<&T::name>("name"),
        field<&T::type>("type"), field<&T::properties>("properties", form::kMapOf<double>))
MESSAGE(playerlike::RobotInfo, field<&T::name>("name"), field<&T::model>("model"),
        field<&T::colour>("colour").expecting(kColourText), field<&T::initial_pose>("initial_pose"),
        field<&T::port>("port").within(0, 65535), field<&T::length_m>("length"),
        field<&T::width_m>("width"), field<&T::height_m>("height"), field<&T::center_m>("center_"),
        field<&T::radius_m>("radius").or_default(), field<&T::mass_kg>("mass").or_default(),
        field<&T::max_speed_mps>("max_speed"), field<&T::max_turn_rate_radps>("max_turn_rate"),
        field<&T::proxies>("proxies", form::kMapOf<int>),
        field<&T::interfaces>("interfaces", form::kMapOf<std::vector<std::string>>),
        field<&T::drivers>("drivers").with<&Field::table>(&driver_fields),
        field<&T::devices>("devices"))
MESSAGE(ArenaTrigger, field<&T::name>("name"), field<&T::enabled>("enabled"),
        field<&T::count>("count"), field<&T::time_left_s>("time_left"))
MESSAGE(ArenaEvent, field<&T::number>("number"), natural(field<&T::time_ns>("t")),
        field<&T::kind>("kind", form::kEventKind), field<&T::what>("what"), field<&T::who>("who"),
        field<&T::text>("text"), field<&T::value>("value"))
MESSAGE(Verdict, field<&T::passed>("passed"), field<&T::reason>("reason"),
        natural(field<&T::time_ns>("t")))

MESSAGE(playerlike::SubscribeRequest, field<&T::device>("device", form::kDevice))
MESSAGE(playerlike::UnsubscribeRequest, field<&T::device>("device", form::kDevice))
MESSAGE(playerlike::ReplaceRequest,
        field<&T::device>("device", form::kDevice).nullable().or_default(),
        field<&T::replace>("replace"))
SIM_FIELDS(playerlike::TimeRequest, {})
MESSAGE(playerlike::PreferRealTimeRequest, field<&T::reason>("reason"))
MESSAGE(playerlike::SetCellsRequest, layer(field<&T::layer>("layer")),
        field<&T::rect>("rect", form::kRect), field<&T::cells>("cells", form::kCells))
MESSAGE(playerlike::CellRequest, layer(field<&T::layer>("layer")),
        in_cells(field<&T::column>("column")), in_cells(field<&T::row>("row")))
MESSAGE(playerlike::CellsRequest, layer(field<&T::layer>("layer")))
MESSAGE(playerlike::CreateLayerRequest, field<&T::kind>("kind", form::kLayerKind),
        field<&T::style>("style", form::kStyle))
MESSAGE(playerlike::RemoveLayerRequest, layer(field<&T::layer>("layer")))
MESSAGE(playerlike::SetLayerStyleRequest, layer(field<&T::layer>("layer")),
        field<&T::style>("style", form::kStyle))
SIM_FIELDS(playerlike::LayersRequest, {})
MESSAGE(playerlike::CanvasImage, field<&T::rgba>("image"), field<&T::canvas>("canvas"))
SIM_FIELDS(playerlike::CanvasImageRequest, {})
MESSAGE(playerlike::ResizeCanvasRequest, in_cells(field<&T::width>("width")),
        in_cells(field<&T::height>("height")))
MESSAGE(playerlike::SaveImageRequest, field<&T::name>("name"),
        in_cells(field<&T::scale>("scale")).or_default(), layer(field<&T::layer>("layer")))
MESSAGE(playerlike::SaveMapRequest, layer(field<&T::layer>("layer")), field<&T::name>("name"),
        field<&T::mode>("mode", form::kMapMode).or_default())
SIM_FIELDS(playerlike::ViewModeRequest, {})
MESSAGE(playerlike::SetViewModeRequest, field<&T::mode>("mode", form::kViewMode))
MESSAGE(playerlike::WorldMap, field<&T::map>("map", form::kMap),
        map_side(field<&T::width>("width")), map_side(field<&T::height>("height")),
        field<&T::origin>("origin"))
MESSAGE(playerlike::WorldMapRequest, field<&T::cell_size_m>("cell_size"),
        field<&T::tile>("tile", form::kRect))
MESSAGE(playerlike::ObjectPose, field<&T::pose>("pose"), natural(field<&T::time_ns>("t")))
MESSAGE(playerlike::ObjectPoseRequest, field<&T::name>("name"))
MESSAGE(playerlike::PlaceObjectRequest, field<&T::name>("name"), field<&T::pose>("pose"))
MESSAGE(playerlike::ObjectPropertyRequest, field<&T::name>("name"), field<&T::property>("property"))
MESSAGE(playerlike::SetObjectPropertyRequest, field<&T::name>("name"),
        field<&T::property>("property"), field<&T::value>("value", form::kProperty))
MESSAGE(playerlike::SaveStateRequest, field<&T::name>("name"))
MESSAGE(playerlike::RestoreStateRequest, field<&T::name>("name"))
MESSAGE(playerlike::NoteGoalRequest, field<&T::device>("device", form::kDevice),
        field<&T::goal_m>("goal_"), field<&T::tolerance_m>("tolerance"))
MESSAGE(playerlike::Charge, field<&T::watched>("watched"), field<&T::stopped>("stopped"))
MESSAGE(playerlike::TakeChargeRequest, field<&T::device>("device", form::kDevice),
        field<&T::watchdog_s>("watchdog"), field<&T::take_over>("take_over").or_default(),
        field<&T::name>("name").or_default())
MESSAGE(playerlike::LocalizationParticle, field<&T::pose>("pose"), field<&T::weight>("weight"))
MESSAGE(playerlike::ParticlesRequest, field<&T::device>("device", form::kDevice))
MESSAGE(playerlike::BlackboardEntry, field<&T::group>("group"), field<&T::key>("key"),
        field<&T::type>("type").within(0, 65535), field<&T::subtype>("subtype").within(0, 65535),
        field<&T::data>("data"), natural(field<&T::time_ns>("t")),
        natural(field<&T::change>("change")))
MESSAGE(playerlike::SetBlackboardRequest, field<&T::group>("group"), field<&T::key>("key"),
        field<&T::type>("type").within(0, 65535), field<&T::subtype>("subtype").within(0, 65535),
        field<&T::data>("data"))
MESSAGE(playerlike::BlackboardRequest, natural(field<&T::after>("after")).or_default(),
        field<&T::group>("group"), field<&T::key>("key"))
MESSAGE(playerlike::LogRequest, field<&T::file>("file"), field<&T::replay>("replay"),
        field<&T::rewind>("rewind"), field<&T::running>("running"))
MESSAGE(playerlike::ArenaBlock, field<&T::name>("name"), field<&T::state>("state"),
        field<&T::height_m>("height"))
MESSAGE(playerlike::ArenaScore, field<&T::robot>("robot"), field<&T::points>("points"))
MESSAGE(playerlike::ArenaStatus, natural(field<&T::time_ns>("t")),
        field<&T::configurations>("configurations").expecting("a list of texts"),
        field<&T::configuration>("configuration"), field<&T::blocks>("blocks"),
        field<&T::timers>("timers"), field<&T::traps>("traps"), field<&T::scores>("scores"),
        field<&T::verdict>("verdict"), field<&T::newest>("newest"))
SIM_FIELDS(playerlike::ArenaRequest, {})
MESSAGE(playerlike::ArenaEventList, field<&T::events>("events"), field<&T::newest>("newest"),
        field<&T::lost>("lost"))
MESSAGE(playerlike::ArenaEventsRequest, field<&T::since>("since").or_default())
MESSAGE(playerlike::SetConfigurationRequest, field<&T::name>("name"))
MESSAGE(playerlike::SetBlockRequest, field<&T::name>("name"), field<&T::extended>("extended"))
MESSAGE(playerlike::SetTimerRequest, field<&T::name>("name"), field<&T::enabled>("enabled"))
MESSAGE(playerlike::SetTrapRequest, field<&T::name>("name"), field<&T::enabled>("enabled"))

#undef MESSAGE
#undef MESSAGE_CHECKED

}  // namespace sim

// --- Answers, and all types of requests

namespace playerlike::protocol {
namespace {

using sim::whole;

/// The fields of the answer to a request: those of its result, or one that is the result.
template <typename One>
const sim::FieldTable& answer_of() {
  using Result = typename One::Result;
  if constexpr (std::is_void_v<Result>) {
    static constexpr sim::FieldTable kNone = {{}};
    return kNone;
  } else {
    return sim::fields_of<Result>();
  }
}

/// Defines the only field of an answer.
#define ANSWER(Request, field)                           \
  template <>                                            \
  const sim::FieldTable& answer_of<Request>() {          \
    using Result = Request::Result;                      \
    static constexpr sim::Field kFields[] = {field};     \
    static constexpr sim::FieldTable kTable = {kFields}; \
    return kTable;                                       \
  }

ANSWER(TimeRequest, whole<Result>("time"))
ANSWER(CellRequest, whole<Result>("cell", form::kCell).nullable())
ANSWER(CellsRequest, whole<Result>("cells", form::kCells))
ANSWER(CreateLayerRequest, sim::natural(whole<Result>("layer")))
ANSWER(LayersRequest, whole<Result>("layers").expecting("a list of layers"))
ANSWER(ResizeCanvasRequest, whole<Result>("canvas"))
ANSWER(ViewModeRequest, whole<Result>("mode", form::kViewMode))
ANSWER(ObjectPropertyRequest, whole<Result>("value", form::kProperty))
ANSWER(ParticlesRequest, whole<Result>("particles").expecting("a list of particles"))
ANSWER(BlackboardRequest, whole<Result>("entries").expecting("a list of entries"))
ANSWER(LogRequest, whole<Result>("log"))

#undef ANSWER

template <typename One>
constexpr RequestKind request_kind() {
  if constexpr (!requires { One::kName; }) {
    return {};
  } else {
    return {One::kName, &sim::fields_of<One>, &answer_of<One>, []() -> Request { return One{}; },
            []() -> Answer {
              using Result = typename One::Result;
              if constexpr (std::is_void_v<Result>) {
                return {};
              } else {
                return Answer(std::in_place_type<Result>);
              }
            }};
  }
}

template <typename... One>
constexpr std::array<RequestKind, sizeof...(One)> kinds_of(
    std::type_identity<std::variant<One...>> /*type*/) {
  return {request_kind<One>()...};
}

}  // namespace

const std::array<RequestKind, std::variant_size_v<Request>>& request_kinds() {
  static constexpr auto kKinds = kinds_of(std::type_identity<Request>{});
  return kKinds;
}

}  // namespace playerlike::protocol
