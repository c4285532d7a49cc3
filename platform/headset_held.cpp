// A headset's picture while nobody draws: a thread ends the runtime's frames with the last one, which the runtime turns
// as the head turns. Without it a person would look at nothing, or at the runtime's own room.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "platform/headset.h"

namespace seascape {

namespace {

class HeldByThread final : public HeldPicture {
 public:
  explicit HeldByThread(Headset& headset) : thread_([&headset](const std::stop_token& stop) { show(headset, stop); }) {}

 private:
  static void show(Headset& headset, const std::stop_token& stop) {
    // Work that is soon done has no frame taken from it: who waits for a frame waits for its time.
    std::mutex mutex;
    std::condition_variable_any done;
    std::unique_lock lock(mutex);
    const std::chrono::duration<double> patience(0.5 * headset.period_s());
    if (done.wait_for(lock, stop, patience, [] { return false; }) || stop.stop_requested()) return;
    while (!stop.stop_requested() && headset.repeat_frame()) {
    }
  }
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<HeldPicture> Headset::hold_picture() {
  if (!options_.in_real_time || !submitted_) return nullptr;
  return std::make_unique<HeldByThread>(*this);
}

bool Headset::repeat_frame() {
  if (!submitted_ || !running_ || session_lost_ || frame_begun_) return false;
  XrFrameState state{XR_TYPE_FRAME_STATE};
  if (XR_FAILED(api_.WaitFrame(session_, nullptr, &state))) return false;
  const auto told = [&](HeadsetCall::Kind kind) {
    HeadsetCall call{kind, state.predictedDisplayTime, {}, true};
    if (kind == HeadsetCall::Kind::end) call.views.assign(submitted_->views.begin(), submitted_->views.end());
    tell(call);
  };
  told(HeadsetCall::Kind::wait);
  const std::lock_guard lock(device_.queue_mutex());
  if (XR_FAILED(api_.BeginFrame(session_, nullptr))) return false;
  told(HeadsetCall::Kind::begin);
  told(HeadsetCall::Kind::end);
  return XR_SUCCEEDED(submit(state.predictedDisplayTime));
}

}  // namespace seascape
