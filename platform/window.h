// A display in a window of the desktop: a swapchain made anew whenever the window asks for it, keys and mouse.
#pragma once
#include <array>
#include <bitset>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "platform/display.h"

struct GLFWwindow;

namespace seascape {

// The connection to the desktop; made before the device, which needs its extensions. Throws Error when no display
// answers.
class WindowSystem {
 public:
  WindowSystem();
  ~WindowSystem();
  WindowSystem(const WindowSystem&) = delete;
  WindowSystem& operator=(const WindowSystem&) = delete;
  std::vector<std::string> instance_extensions() const;
};

struct WindowOptions {
  std::string title = "Seascape";
  std::uint32_t width = 1280, height = 720;  // pixels an eye; two views stand side by side in the window
  int views = 1;
};

// A picture is seen only while the window has an area and stands on the screen.
constexpr bool window_shows(int width, int height, bool iconified, bool visible) {
  return width > 0 && height > 0 && !iconified && visible;
}

class Window final : public Display {
 public:
  // Opens the window. Throws Error when the device cannot present to it. The device must outlive the window.
  Window(WindowSystem& system, Device& device, const WindowOptions& options);
  ~Window() override;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const char* name() const override { return "window"; }
  int views() const override { return options_.views; }
  // Takes in events. While nothing of the window can be seen it waits for an event, a quarter of a second at most, and
  // says so with should_render.
  DisplayFrame begin() override;
  Viewpoint viewpoint(const Pose& carrier) const override;
  void end(Frame& frame, const RenderTarget* picture, const Image* depth = nullptr) override;

  const Input& input() const override { return input_; }
  void set_post(Post post) override { post_ = post; }
  void set_lens(double vertical_fov_deg, double eye_distance_m) override;
  void hold_mouse(bool held) override;
  void set_title(const std::string& title) override;
  std::unique_ptr<Overlay> make_overlay() override;

  // Drawn over the picture, in a render pass made like overlay_pass(), with the window's size in pixels.
  using DrawOver = std::function<void(VkCommandBuffer, std::uint32_t width, std::uint32_t height)>;
  void draw_over(DrawOver drawn) { drawn_over_ = std::move(drawn); }
  VkRenderPass overlay_pass() const { return overlay_pass_; }

  void close();
  GLFWwindow* handle() const { return window_; }
  double content_scale() const;
  // How often a swapchain was made: 1 after the first frame.
  int swapchains_made() const { return swapchains_made_; }

 private:
  struct SwapImage {
    Image image;
    Owned<VkFramebuffer> framebuffer;
    Owned<VkSemaphore> drawn;  // waited for by presenting
  };
  friend struct WindowEvents;  // the desktop's callbacks
  void make_surface();
  bool make_swapchain();  // false: the window has no area
  void make_overlay_pass();
  SwapImage* acquire(std::size_t slot);
  void show(Frame& frame, SwapImage& target, const RenderTarget& picture);

  Device& device_;
  WindowOptions options_;
  GLFWwindow* window_ = nullptr;
  Owned<VkSurfaceKHR> surface_;
  VkSurfaceFormatKHR format_{};
  VkRenderPass overlay_pass_ = VK_NULL_HANDLE;
  Owned<VkSwapchainKHR> swapchain_;
  VkExtent2D extent_{0, 0};
  std::vector<SwapImage> images_;
  std::array<Owned<VkSemaphore>, Frame::slots> acquired_;
  std::uint32_t image_index_ = 0;
  bool stale_ = true;  // the swapchain no longer fits the window
  int swapchains_made_ = 0;
  DrawOver drawn_over_;

  void gather();                                 // keys and gamepads
  static constexpr std::size_t key_codes = 512;  // GLFW's
  InputGatherer gatherer_;
  std::bitset<key_codes> keys_down_;
  Post post_ = Post::afoot;
  Input input_, gathering_;  // of gathering_ the mouse only
  glm::dvec2 last_mouse_{0.0};
  bool mouse_known_ = false, mouse_held_ = false;
  int width_ = 0, height_ = 0;  // of the window's picture, pixels
  double vertical_fov_deg_ = 60.0, eye_distance_m_ = 0.064;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace seascape
