// Runs something that must throw an Error, and gives what it says.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "engine/error.h"

namespace seascape::test {

// "" when nothing, or another kind of exception, was thrown; both fail the test. The Error must say what to do.
template <class Work>
std::string error_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    return error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << "not an Error: " << other.what();
    return "";
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace seascape::test
