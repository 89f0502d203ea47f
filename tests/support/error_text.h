#pragma once
// Catches the errors that the code under test reports, and checks the form of their messages.

#include "base/error.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Returns the message of the only permitted kind of failure, or nothing if the work succeeds. Anything else fails the test.
inline std::optional<std::string> message_of(const std::function<void()>& work, ErrorKind kind = ErrorKind::input) {
  try {
    work();
    return std::nullopt;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << "not an Error: " << other.what();
    return std::nullopt;
  }
}

// Returns the message of the failure in which the work must end.
inline std::string refusal_of(const std::function<void()>& work, ErrorKind kind = ErrorKind::input) {
  const std::optional<std::string> message = message_of(work, kind);
  EXPECT_TRUE(message) << "it was not refused";
  return message.value_or("");
}

inline void expect_three_parts(const std::string& message) {
  EXPECT_EQ(message.find_first_of("\n\r\t\x1b"), std::string::npos) << message;
  EXPECT_EQ(message.find('\0'), std::string::npos) << message;
  const std::size_t open = message.find(" (");
  const std::size_t close = message.find("); ");
  ASSERT_NE(open, std::string::npos) << message;
  ASSERT_NE(close, std::string::npos) << message;
  EXPECT_LT(open + 2, close) << message;
  EXPECT_LT(close + 3, message.size()) << message;
}

// Expects the work to be refused in three parts with these words in them, and returns the message.
inline std::string expect_refusal(const std::function<void()>& work, std::string_view words = {},
                                  ErrorKind kind = ErrorKind::input) {
  std::string message = refusal_of(work, kind);
  expect_three_parts(message);
  EXPECT_NE(message.find(words), std::string::npos) << message;
  return message;
}

}  // namespace sunfleck
