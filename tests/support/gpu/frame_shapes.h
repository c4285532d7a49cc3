// The shapes of a frame, as settings, for tests of what is drawn in each.
#pragma once
#include <gtest/gtest.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/sampled.h"

namespace seascape::test {

struct FrameLook {
  std::string name;
  std::vector<std::pair<std::string, std::string>> set;  // as by --set
};

inline const FrameLook frame_looks[] = {
    {"tile", {{"frame.shape", "tile"}, {"msaa", "4"}, {"frame.lighting", "forward"}}},
    {"deferred", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "deferred"}}},
    {"desktop", {{"frame.shape", "desktop"}, {"msaa", "4"}, {"frame.lighting", "forward"}}},
    {"desktop_deferred", {{"frame.shape", "desktop"}, {"msaa", "1"}, {"frame.lighting", "deferred"}}},
};

// Two that differ in shape and in light, some tests the one pair and some the other; all with SEASCAPE_LONG.
inline std::vector<FrameLook> sampled_looks() {
  if (long_run()) return {std::begin(frame_looks), std::end(frame_looks)};
  const char* const test = testing::UnitTest::GetInstance()->current_test_info()->name();
  if (std::string_view(test).size() % 2 == 0) return {frame_looks[0], frame_looks[3]};
  return {frame_looks[1], frame_looks[2]};
}

}  // namespace seascape::test
