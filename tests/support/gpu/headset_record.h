// What a headset asks of its runtime, frame by frame, as the runtime sees it, and whether that is in order.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/gpu/hostile_runtime.h"

namespace seascape::test {

bool same_view(const XrView& a, const XrView& b);  // to the bit

// Of xrWaitFrame, xrLocateViews and xrEndFrame, which pass through it. `calls` outlives it.
class HeadsetRecord {
 public:
  explicit HeadsetRecord(HostileRuntime& calls);
  ~HeadsetRecord();
  HeadsetRecord(const HeadsetRecord&) = delete;
  HeadsetRecord& operator=(const HeadsetRecord&) = delete;

  void next_frame();  // what comes is another frame's

  struct Taken {
    XrTime waited = 0, located = 0, ended = 0;  // display times: given, asked for, submitted
    bool should_render = false;                 // as the runtime said
    std::array<XrView, 2> told{};               // by xrLocateViews
    std::vector<XrView> submitted;              // with a picture
    std::vector<std::uint32_t> layers;          // of the picture: whose eye's each submitted view is
  };
  // Since next_frame().
  const Taken& taken() const { return taken_; }
  std::size_t pictures() const { return pictures_; }  // submitted since the beginning

  // What is out of order in the frame since next_frame(), in which a picture was submitted or not; empty: nothing is.
  std::string fault(bool picture) const;

 private:
  HostileRuntime& calls_;
  std::size_t from_ = 0;
  XrTime last_waited_ = 0;
  Taken taken_;
  std::size_t pictures_ = 0;
};

}  // namespace seascape::test
