// The shapes of a frame, as settings, for tests of what is drawn in each.
#pragma once
#include <string>
#include <utility>
#include <vector>

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

}  // namespace seascape::test
