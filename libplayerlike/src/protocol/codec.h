// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"
#include "protocol/framing.h"
#include "sim/canvas/layers.h"
#include "sim/world/occupancy_map.h"

/// Messages between client and server as JSON values; docs/protocol.md is the reference. All
/// decoders throw ProtocolError protocol/bad-value, which names the key, the expected value and the
/// value found. Doubles and whole numbers survive encoding and decoding exactly.
///
/// Decoders of what clients send (commands, drawings, styles) refuse unknown keys. Decoders of what
/// servers send ignore unknown keys, so that later versions can add keys.
namespace playerlike::protocol {

using nlohmann::json;

/// @name Reading objects that came from outside
/// @{

/// The member `key`. @throws ProtocolError also if `object` is not an object.
[[nodiscard]] const json& require(const json& object, const char* key);
[[nodiscard]] double require_number(const json& object, const char* key);  ///< finite
/// A whole number from `least` to `most`; 3.0 is whole, 3.5 is not.
[[nodiscard]] std::int64_t require_integer(const json& object, const char* key, std::int64_t least,
                                           std::int64_t most);
[[nodiscard]] bool require_bool(const json& object, const char* key);
[[nodiscard]] std::string require_text(const json& object, const char* key);
/// Checks that a value is a list. @param expected  describes it in errors: "a list of robots".
[[nodiscard]] const json::array_t& require_list(const json& value, const char* key,
                                                const char* expected = "a list");
/// Refuses a value that is not an object or has keys that are not in `known`.
/// @param what  describes the object in errors: "a command twist".
void refuse_unknown_keys(const json& object, std::span<const std::string_view> known,
                         std::string_view what);
inline void refuse_unknown_keys(const json& object, std::initializer_list<std::string_view> known,
                                std::string_view what) {
  refuse_unknown_keys(object, std::span(known.begin(), known.size()), what);
}
/// Throws ProtocolError protocol/bad-value for a value: "KEY: expected ..., found ...".
[[noreturn]] void refuse_value(std::string_view key, std::string_view expected, const json& found);
/// @}

/// @name Bytes: in CBOR a byte string, in JSON a text in base64 (RFC 4648, with padding)
/// @{
[[nodiscard]] json bytes(std::vector<std::uint8_t> value, Encoding encoding);
[[nodiscard]] std::vector<std::uint8_t> require_bytes(const json& object, const char* key,
                                                      Encoding encoding);
/// @}

/// @name Doubles: in CBOR a typed array of little-endian doubles (RFC 8746, tag 86), in JSON a list
/// @{
[[nodiscard]] json doubles(std::span<const double> values, Encoding encoding);
/// Accepts lists and typed arrays in both encodings.
[[nodiscard]] std::vector<double> require_doubles(const json& object, const char* key,
                                                  Encoding encoding);
/// @}

[[nodiscard]] json encode_device_id(DeviceId device);  ///< [robot, device]
[[nodiscard]] DeviceId require_device_id(const json& object, const char* key);
[[nodiscard]] json encode_pose(const sim::Pose& pose);  ///< {"x", "y", "yaw"}
[[nodiscard]] sim::Pose decode_pose(const json& pose);

/// Encodes a reading: {"device", "seq", "t" [ns], "type", ...fields of its type}.
/// @param type  of the device, e.g. "laser".
/// @throws ProtocolError protocol/bad-value if devices of that type make no readings.
[[nodiscard]] json encode_reading(DeviceId device, std::string_view type,
                                  const sim::Reading& reading, Encoding encoding);
/// The result of decode_reading().
struct DecodedReading {
  DeviceId device{-1, -1};
  std::unique_ptr<sim::Reading> reading;
};
[[nodiscard]] DecodedReading decode_reading(const json& reading, Encoding encoding);

/// @name Readings and commands in CBOR, without a tree of values
/// What these functions write and read is what the trees say; only the order of members differs.
/// @{
/// Appends a reading, see encode_reading().
void append_cbor_reading(DeviceId device, std::string_view type, const sim::Reading& reading,
                         std::string& out);
/// Removes a reading from the front of `rest`. @throws ProtocolError as decode() and
/// decode_reading().
[[nodiscard]] DecodedReading take_cbor_reading(std::string_view& rest);
/// A list of encoded items as a value, see kEncodedItemTag.
[[nodiscard]] json encoded_list(std::size_t count, std::string_view items);
/// Decodes an encoded list of readings. @throws ProtocolError.
[[nodiscard]] std::vector<DecodedReading> decode_cbor_readings(std::string_view list);
/// @}

/// Appends a command as a request, which has no answer, with its length or line end.
void append_command_request(DeviceId device, const sim::Command& command, Encoding encoding,
                            std::string& out);
/// Appends drawings as such a request.
void append_draw_request(std::span<const sim::DrawOperation> drawings, Encoding encoding,
                         std::string& out);

/// Appends an image of a layer as such a request.
/// @param cells  row by row from the top.
void append_set_cells_request(sim::LayerId layer, const sim::CellRect& rect,
                              std::span<const sim::CellValue> cells, Encoding encoding,
                              std::string& out);

/// Encodes a command: {"kind": "twist", ...}.
[[nodiscard]] json encode_command(const sim::Command& command);
[[nodiscard]] sim::Command decode_command(const json& command);

/// @name Structs by their fields; in request_codec.cpp
/// @{
[[nodiscard]] json encode_robots(const std::vector<RobotInfo>& robots);
[[nodiscard]] std::vector<RobotInfo> decode_robots(const json& robots);
[[nodiscard]] json encode_canvas(const CanvasInfo& canvas);
[[nodiscard]] CanvasInfo decode_canvas(const json& canvas);
[[nodiscard]] json encode_time(const TimeStatistics& time);
[[nodiscard]] TimeStatistics decode_time(const json& time);
[[nodiscard]] json encode_style(const sim::LayerStyle& style);
/// Missing keys get the defaults of sim::LayerStyle.
[[nodiscard]] sim::LayerStyle decode_style(const json& style);
[[nodiscard]] json encode_layers(const std::vector<sim::LayerInfo>& layers);
[[nodiscard]] std::vector<sim::LayerInfo> decode_layers(const json& layers);
[[nodiscard]] json encode_map(const sim::OccupancyMap& map, Encoding encoding);
[[nodiscard]] sim::OccupancyMap decode_map(const json& map, Encoding encoding);
/// @}

/// A property of an object: a list of numbers, or a text.
[[nodiscard]] json encode_property(const PropertyValue& value);
[[nodiscard]] PropertyValue require_property(const json& object, const char* key);

/// Drawings: in CBOR bytes, 28 per drawing; in JSON a list of lists. Fields that the drawing's kind
/// does not use are neither checked nor sent; they decode as 0.
[[nodiscard]] json encode_drawings(std::span<const sim::DrawOperation> drawings, Encoding encoding);
[[nodiscard]] std::vector<sim::DrawOperation> decode_drawings(const json& drawings,
                                                              Encoding encoding);
/// Cells of a rectangle: four bytes per cell, little-endian (see docs/protocol.md).
[[nodiscard]] json encode_cells(std::span<const sim::CellValue> cells, Encoding encoding);
[[nodiscard]] std::vector<sim::CellValue> decode_cells(const json& cells, Encoding encoding);
/// The same into a list, whose memory is reused.
void decode_cells(const json& cells, Encoding encoding, std::vector<sim::CellValue>& into);
/// Cells of a map: four bytes per cell, floats in 0..1.
[[nodiscard]] json encode_occupancy(std::span<const float> cells, Encoding encoding);
[[nodiscard]] std::vector<float> decode_occupancy(const json& cells, std::size_t count,
                                                  Encoding encoding);

/// Maps an error code of a session to its stable name, e.g. "session/finished", and back.
[[nodiscard]] std::string_view error_id(SessionError::Code code) noexcept;
[[nodiscard]] std::optional<SessionError::Code> session_error_code(std::string_view id) noexcept;

}  // namespace playerlike::protocol
