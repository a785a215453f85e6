// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "utf8_stream.h"

#include <gtest/gtest.h>

#include <sstream>

namespace playpen {
namespace {

TEST(Utf8Stream, ValidCharacters_PassedInAnyPieces) {
  std::ostringstream out;
  {
    const Utf8Stream filter(out);
    out << "gr\xc3\xbcn ";
    out << '\xe2' << '\x82' << '\xac' << std::flush << 1.5;
    EXPECT_EQ(out.str(),
              "gr\xc3\xbcn \xe2\x82\xac"
              "1.5");
  }
  out << "\xff";
  EXPECT_EQ(out.str().back(), '\xff') << "the stream is its own again";
}

TEST(Utf8Stream, OtherBytes_Escaped) {
  std::ostringstream out;
  {
    const Utf8Stream filter(out);
    out << "gr\xfcn " << '\xc3' << "x\x80";
    EXPECT_EQ(out.str(), "gr\\xfcn \\xc3x\\x80");
    out << "\xe2\x82";  // cut off
  }
  EXPECT_EQ(out.str(), "gr\\xfcn \\xc3x\\x80\\xe2\\x82");
}

}  // namespace
}  // namespace playpen
