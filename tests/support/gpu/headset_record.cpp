#include "tests/support/gpu/headset_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace seascape::test {

bool same_view(const XrView& a, const XrView& b) {
  return std::memcmp(&a.pose, &b.pose, sizeof a.pose) == 0 && std::memcmp(&a.fov, &b.fov, sizeof a.fov) == 0;
}

HeadsetRecord::HeadsetRecord(HostileRuntime& calls) : calls_(calls) {
  const XrApi& real = calls.real;
  calls.instead.WaitFrame = [this, &real](XrSession session, const XrFrameWaitInfo* info, XrFrameState* state) {
    const XrResult result = real.WaitFrame(session, info, state);
    taken_.waited = state->predictedDisplayTime;
    taken_.should_render = state->shouldRender;
    return result;
  };
  calls.instead.LocateViews = [this, &real](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                            std::uint32_t room, std::uint32_t* count, XrView* views) {
    const XrResult result = real.LocateViews(session, info, state, room, count, views);
    taken_.located = info->displayTime;
    if (views != nullptr && *count == 2) std::copy(views, views + 2, taken_.told.begin());
    return result;
  };
  calls.instead.EndFrame = [this, &real](XrSession session, const XrFrameEndInfo* info) {
    taken_.ended = info->displayTime;
    for (std::uint32_t i = 0; i < info->layerCount; ++i) {
      if (info->layers[i]->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) continue;
      const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[i]);
      for (std::uint32_t eye = 0; eye < layer.viewCount; ++eye) {
        taken_.submitted.push_back({XR_TYPE_VIEW, nullptr, layer.views[eye].pose, layer.views[eye].fov});
        taken_.layers.push_back(layer.views[eye].subImage.imageArrayIndex);
      }
      ++pictures_;
    }
    return real.EndFrame(session, info);
  };
}

HeadsetRecord::~HeadsetRecord() {
  calls_.instead.WaitFrame = {};
  calls_.instead.LocateViews = {};
  calls_.instead.EndFrame = {};
}

void HeadsetRecord::next_frame() {
  last_waited_ = std::max(last_waited_, taken_.waited);
  taken_ = {};
  from_ = calls_.calls().size();
}

std::string HeadsetRecord::fault(bool picture) const {
  const std::vector<std::string>& all = calls_.calls();
  const auto first = all.begin() + std::ptrdiff_t(from_);
  const auto number = [&](const char* name) { return std::count(first, all.end(), name); };
  const auto place = [&](const char* name) { return std::find(first, all.end(), name) - first; };
  const auto come = [&](std::vector<const char*> names) {
    for (std::size_t i = 1; i < names.size(); ++i)
      if (place(names[i - 1]) >= place(names[i])) return fmt::format("{} before {}", names[i], names[i - 1]);
    return std::string();
  };
  for (const char* once : {"xrWaitFrame", "xrBeginFrame", "xrEndFrame"})
    if (number(once) != 1) return fmt::format("{} is called {} times", once, number(once));
  std::vector<std::vector<const char*>> orders{{"xrWaitFrame", "xrBeginFrame", "xrEndFrame"}};
  if (number("xrSyncActions") > 0) orders.push_back({"xrWaitFrame", "xrSyncActions", "xrBeginFrame"});
  if (taken_.should_render) orders.push_back({"xrBeginFrame", "xrAcquireSwapchainImage", "xrReleaseSwapchainImage"});
  if (picture) orders.push_back({"xrBeginFrame", "xrLocateViews", "xrEndFrame"});
  const auto ended = first + place("xrEndFrame");
  if (std::find(ended, all.end(), "xrReleaseSwapchainImage") != all.end()) return "an image is released too late";
  for (const auto& order : orders)
    if (const std::string wrong = come(order); !wrong.empty()) return wrong;
  if (taken_.ended != taken_.waited) return fmt::format("it ends {} ns late", taken_.ended - taken_.waited);
  if (taken_.waited <= last_waited_) return fmt::format("time stands: {} ns on", taken_.waited - last_waited_);
  // The colour and the depth that were acquired.
  if (number("xrReleaseSwapchainImage") != number("xrAcquireSwapchainImage"))
    return "images are acquired and not released";
  if (taken_.submitted.size() != (picture ? 2u : 0u))
    return fmt::format("{} views are submitted", taken_.submitted.size());
  if (!picture) return "";
  if (taken_.located != taken_.waited) return fmt::format("views of {} ns later", taken_.located - taken_.waited);
  if (number("xrLocateViews") != 1) return fmt::format("views are located {} times", number("xrLocateViews"));
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    if (!same_view(taken_.told[eye], taken_.submitted[eye])) return fmt::format("eye {} is not where it was told", eye);
    if (taken_.layers[eye] != eye) return fmt::format("eye {} shows layer {}", eye, taken_.layers[eye]);
  }
  return "";
}

}  // namespace seascape::test
