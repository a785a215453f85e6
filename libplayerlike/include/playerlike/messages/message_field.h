// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

/// The fields of structs in messages, see requests.h.
namespace playerlike {

/// Whether a message contains a field.
enum class Presence {
  kAlways,    ///< required
  kOptional,  ///< may be missing; the member then keeps its value
  kNullable,  ///< null if the member has no value; may also be missing
};

/// Range of an integer field.
struct WholeRange {
  std::int64_t least = 0;
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};
/// Range of columns, rows and side lengths in cells.
inline constexpr WholeRange kCellRange{-(1 << 30), 1 << 30};
/// Range of layer numbers.
inline constexpr WholeRange kLayerRange{0, 1 << 30};
/// Range of the side lengths of a canvas or map in cells.
inline constexpr WholeRange kMapSideRange{1, 8192};

/// Description of a struct's member in messages.
template <typename Struct, typename Value>
struct MessageField {
  const char* key;
  Value Struct::*member;
  Presence presence;
  WholeRange range;
};
/// Makes an entry of `kFields`.
/// @param range  range of an integer.
template <typename Struct, typename Value>
constexpr MessageField<Struct, Value> field(const char* key, Value Struct::*member,
                                            WholeRange range = {},
                                            Presence presence = Presence::kAlways) {
  return {key, member, presence, range};
}
/// Makes an entry of `kFields` for a member that is not an integer.
template <typename Struct, typename Value>
constexpr MessageField<Struct, Value> field(const char* key, Value Struct::*member,
                                            Presence presence) {
  return {key, member, presence, {}};
}

}  // namespace playerlike
