#include "app/scene_loader.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "app/frame.h"
#include "app/sea_time.h"
#include "platform/headless.h"

namespace seascape {

void draw_unseen(Experience& experience, const Pose& head, double time_s) {
  experience.draw_into(nullptr);
  const ExperienceOptions& options = experience.options();
  const RenderSettings& render = experience.scene().settings.render;
  const Headless eyes({.width = options.width,
                       .height = options.height,
                       .views = options.views,
                       .vertical_fov_deg = render.vertical_fov_deg,
                       .eye_distance_m = render.eye_distance_m});
  Frame& frame = experience.frame();
  frame.begin();
  draw_frame(experience, frame, eyes.viewpoint(head), time_s);
  frame.submit();
  frame.finish();
}

SceneLoader::SceneLoader(Device& device, ShaderLibrary& shaders)
    : device_(device), shaders_(shaders), thread_([this](std::stop_token stop) { work(stop); }) {}

SceneLoader::~SceneLoader() {
  thread_.request_stop();
  thread_.join();
}

void SceneLoader::ask(Request request) {
  std::unique_ptr<Experience> forgotten;  // given up after the lock
  const std::lock_guard lock(mutex_);
  wanted_ = std::move(request);
  forgotten = std::move(loaded_);
  fault_ = nullptr;
  asked_.notify_one();
}

bool SceneLoader::busy() const {
  const std::lock_guard lock(mutex_);
  return wanted_ || loading_;
}

void SceneLoader::wait() const {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return !wanted_ && !loading_; });
}

std::unique_ptr<Experience> SceneLoader::take() {
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  return std::move(loaded_);
}

std::unique_ptr<Experience> SceneLoader::load(const Request& request) {
  const Scene scene = request.read();
  const ExperienceOptions options = request.options(scene);
  auto experience = std::make_unique<Experience>(device_, shaders_, scene, options);
  const Settings& own = scene.settings;
  draw_unseen(*experience, scene.start, sea_time_s(own, own.follow_clock ? machine_clock_s() : 0.0));
  experience->go_on();
  return experience;
}

void SceneLoader::work(std::stop_token stop) {
  // An arena of its own: who draws, when he waits for his own pieces of work, must not pick up one of these.
  tbb::task_arena arena(std::max(1, tbb::this_task_arena::max_concurrency() / 2));
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      if (!asked_.wait(lock, stop, [&] { return wanted_.has_value(); })) return;
      request = *std::exchange(wanted_, std::nullopt);
      loading_ = true;
    }
    std::unique_ptr<Experience> experience;
    std::exception_ptr fault;
    try {
      arena.execute([&] { experience = load(request); });
    } catch (...) {
      fault = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    loading_ = false;
    if (wanted_) {  // another is wanted by now
      lock.unlock();
      experience.reset();
      continue;
    }
    loaded_ = std::move(experience);
    fault_ = std::move(fault);
    done_.notify_all();
  }
}

}  // namespace seascape
