// Holds a device's queue up: what is submitted after it waits until it is lifted, or for 20 s.
#pragma once
#include <atomic>
#include <chrono>
#include <thread>

#include "engine/frame.h"

namespace seascape::test {

class Blockade {
 public:
  explicit Blockade(Device& device) : device_(device), frame_(device, 64) {
    const VkEventCreateInfo info{VK_STRUCTURE_TYPE_EVENT_CREATE_INFO};
    check(vkCreateEvent(device.handle(), &info, nullptr, &event_), "vkCreateEvent");
    frame_.begin();
    frame_.pass("blockade", {}, [&](Commands& c) {
      vkCmdWaitEvents(c.raw(), 1, &event_, VK_PIPELINE_STAGE_HOST_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, nullptr,
                      0, nullptr, 0, nullptr);
    });
    frame_.submit();
    patience_ = std::jthread([this](std::stop_token stop) {
      for (int i = 0; i < 2000 && !stop.stop_requested(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (!lifted_.exchange(true)) {
        waited_for_ = true;
        vkSetEvent(device_.handle(), event_);
      }
    });
  }
  ~Blockade() {
    (void)lift();
    vkDestroyEvent(device_.handle(), event_, nullptr);
  }
  Blockade(const Blockade&) = delete;
  Blockade& operator=(const Blockade&) = delete;
  const Frame& frame() const { return frame_; }  // that is held up
  // Lets all go on, and waits for it; false: the time was up before.
  bool lift() {
    if (!lifted_.exchange(true)) vkSetEvent(device_.handle(), event_);
    frame_.finish();
    return !waited_for_;
  }

 private:
  Device& device_;
  VkEvent event_ = VK_NULL_HANDLE;
  Frame frame_;
  std::atomic<bool> lifted_ = false, waited_for_ = false;
  std::jthread patience_;
};

}  // namespace seascape::test
