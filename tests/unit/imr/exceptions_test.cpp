// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <exception>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "imr-h/imr_assert.h"
#include "imr-h/imr_exceptions.h"
#include "robot_types.h"

namespace {

using testing::EndsWith;
using testing::HasSubstr;

// what() of the imr::exception that the function throws; a failure if it throws none.
template <typename Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const imr::exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no imr::exception";
  return {};
}

TEST(ImrException, StandardExceptionWithMessage) {
  static_assert(std::is_base_of<std::exception, imr::exception>::value, "");
  static_assert(std::is_nothrow_copy_constructible<imr::exception>::value, "");
  try {
    throw imr::exception("no laser");
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "no laser");
  }
}

TEST(ImrException, EmptyMessage_ReplacedByText) { EXPECT_STRNE(imr::exception().what(), ""); }

TEST(AssertArgument, TrueCondition_Passes) {
  const int object = 1;
  const int* pointer = &object;
  EXPECT_NO_THROW(imr::assert_argument(true, "m"));
  EXPECT_NO_THROW(imr::assert_argument(pointer, "m"));
  EXPECT_NO_THROW(imr::assert_argument(std::make_unique<int>(0), "m"));
  EXPECT_NO_THROW(imr::assert_argument(7, std::string("m")));
}

TEST(AssertArgument, FalseCondition_ThrowsMessage) {
  const int* pointer = nullptr;
  EXPECT_EQ(message_of([] { imr::assert_argument(false, "bad"); }), "bad");
  EXPECT_EQ(message_of([&] { imr::assert_argument(pointer, "no laser"); }), "no laser");
  EXPECT_EQ(message_of([] { imr::assert_argument(nullptr, "null"); }), "null");
  EXPECT_EQ(message_of([] { imr::assert_argument(std::unique_ptr<int>(), "empty"); }), "empty");
  EXPECT_EQ(message_of([] { imr::assert_argument(0, std::string("zero")); }), "zero");
}

TEST(AssertArgument, MissingMessage_Replaced) {
  const char* none = nullptr;
  EXPECT_EQ(message_of([&] { imr::assert_argument(false, none); }), "invalid argument");
  EXPECT_EQ(message_of([] { imr::assert_argument(false, ""); }), "invalid argument");
}

TEST(ImrAssert, Message_NamesPlaceAndCondition) {
  const int line = __LINE__ + 1;
  const std::string message = message_of([] { IMR_ASSERT(1 + 1 == 3); });
  EXPECT_THAT(message, HasSubstr("exceptions_test.cpp:" + std::to_string(line) + ": "));
  EXPECT_THAT(message, EndsWith("assertion '1 + 1 == 3' failed"));
}

TEST(ImrAssert, ConditionWithCommas_Accepted) {
  EXPECT_NO_THROW(IMR_ASSERT(std::is_same<std::pair<int, int>, std::pair<int, int>>::value));
  EXPECT_THROW(IMR_ASSERT(std::is_same<int, long>::value), imr::exception);
}

TEST(ImrAssert, Condition_EvaluatedOnce) {
  int count = 0;
  IMR_ASSERT(++count > 0);
  IMR_ASSERT_MSG(++count > 0, "");
  ASSERT_ARGUMENT(++count > 0, "");
  EXPECT_EQ(count, 3);
}

TEST(ImrAssert, Message_BuiltOnFailureOnly) {
  int evaluated = 0;
  const auto value = [&] { return ++evaluated; };
  IMR_ASSERT_MSG(true, "value " << value());
  ASSERT_ARGUMENT(true, "value " << value());
  EXPECT_EQ(evaluated, 0);
  EXPECT_THAT(message_of([&] { IMR_ASSERT_MSG(false, "value " << value() << ", 2"); }),
              EndsWith("assertion 'false' failed: value 1, 2"));
}

TEST(ImrAssert, ArgumentCheck_AcceptsPointers) {
  const double* speed = nullptr;
  EXPECT_THAT(message_of([&] { ASSERT_ARGUMENT(speed, "no speed"); }),
              EndsWith("argument check 'speed' failed: no speed"));
}

TEST(ImrAssert, IsOneStatement) {
  bool reached_else = false;
  if (reached_else)
    IMR_ASSERT(false);
  else
    reached_else = true;
  EXPECT_TRUE(reached_else);
}

// The type of the exception that the function throws, if it is one of imr's.
template <typename Exception, typename Function>
bool throws(const Function& function) {
  try {
    function();
  } catch (const Exception&) {
    return true;
  } catch (const imr::exception&) {
  }
  return false;
}

TEST(ImrException, Kinds_CaughtAloneOrTogether) {
  EXPECT_TRUE(throws<imr::argument_error>([] { imr::assert_argument(false, "m"); }));
  EXPECT_FALSE(throws<imr::io_error>([] { imr::assert_argument(false, "m"); }));
  EXPECT_TRUE(throws<imr::io_error>([] { imr::assert_io(false, "no file"); }));
  EXPECT_TRUE(throws<imr::bad_usage>([] { imr::assert_usage(false, "twice"); }));
  EXPECT_TRUE(throws<imr::bad_code>([] { imr::assert_exception<imr::bad_code>(false, "code"); }));
  EXPECT_EQ(message_of([] { imr::assert_io(false, "no file"); }), "no file");
  EXPECT_NO_THROW({
    imr::assert_io(true, "m");
    imr::assert_usage(true, "m");
    imr::assert_exception<imr::io_error>(true, "m");
  });
  EXPECT_TRUE(throws<imr::argument_error>([] { ASSERT_ARGUMENT(false, "m"); }));
  EXPECT_TRUE(throws<imr::io_error>([] { ASSERT_IO(false, "m"); }));
  EXPECT_FALSE(throws<imr::argument_error>([] { IMR_ASSERT(false); }));
  EXPECT_THAT(message_of([] { ASSERT_IO(1 > 2, "map " << 3); }),
              EndsWith("i/o check '1 > 2' failed: map 3"));
}

TEST(SPosition, DefaultIsOriginAndValuesKept) {
  const imr::robot::SPosition origin;
  EXPECT_EQ(origin.x, 0.0);
  EXPECT_EQ(origin.y, 0.0);
  EXPECT_EQ(origin.yaw, 0.0);
  const imr::robot::SPosition pose(1.0, 2.0, 0.5);
  EXPECT_EQ(pose.x, 1.0);
  EXPECT_EQ(pose.y, 2.0);
  EXPECT_EQ(pose.yaw, 0.5);
}

}  // namespace
