#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"

namespace nook::test {

/// Runs `action`, which must throw an Error of that kind whose message is one line and holds `part`.
template <class Action>
void expect_error(ErrorKind kind, const std::string& part, Action&& action) {
  try {
    action();
    ADD_FAILURE() << "no error; expected one with '" << part << "'";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), kind) << message;
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is missing in: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace nook::test
