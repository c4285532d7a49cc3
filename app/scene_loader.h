// Loads scenes on a thread of its own, while another scene is drawn.
#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/experience.h"

namespace seascape {

// Draws a frame of its own pictures that nobody sees. The first frame of what is newly made has work that no other has:
// windows are filled, foam settles, and drivers may finish pipelines.
void draw_unseen(Experience& experience, const Pose& head, double time_s);

class SceneLoader {
 public:
  // Both outlive it.
  SceneLoader(Device& device, ShaderLibrary& shaders);
  ~SceneLoader();  // waits for what is being loaded
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  struct Request {
    // Asked on the loader's thread; they may throw Error.
    std::function<Scene()> read;
    std::function<ExperienceOptions(const Scene&)> options;
  };
  // Asks for a scene. One asked for before and not yet there is forgotten. Never waits for the loading.
  void ask(Request request);
  bool busy() const;
  // Until it is not busy.
  void wait() const;
  // The scene asked for last, once, when it is there: its objects made, its simulations settled and its first frame
  // drawn, at the time at which it starts; it goes on (Experience::go_on). Throws the Error that loading it met, once.
  // Never waits for the loading.
  std::unique_ptr<Experience> take();

 private:
  void work(std::stop_token stop);
  std::unique_ptr<Experience> load(const Request& request);
  Device& device_;
  ShaderLibrary& shaders_;
  mutable std::mutex mutex_;
  std::condition_variable_any asked_;
  mutable std::condition_variable done_;
  std::optional<Request> wanted_;
  bool loading_ = false;
  std::unique_ptr<Experience> loaded_;
  std::exception_ptr fault_;
  std::jthread thread_;
};

}  // namespace seascape
