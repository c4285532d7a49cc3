// A display in a window of the desktop: a swapchain made anew whenever the window asks for it, keys and mouse.
#pragma once
#include <array>
#include <bitset>
#include <chrono>
#include <functional>
#include <span>
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
  // Whether begin(), end() and the swapchain may wait for the desktop. A window that may not shows a picture only where
  // ready() says so, and not in step with the screen: it stands beside a headset, which waits for nothing.
  bool waits = true;
  bool visible = true;  // from the beginning
};

// A part of a picture, and where in the window it goes, stretched where the sizes differ. Pixels from the upper left.
struct WindowPart {
  const Image* picture;
  std::uint32_t layer;
  glm::ivec2 from_least, from_most, to_least, to_most;
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
  // The picture is stretched over the window.
  void set_scale(double scale) override { scale_ = scale; }
  double scale() const override { return scale_; }
  glm::uvec2 most_size() const override;
  void hold_mouse(bool held) override;
  void set_title(const std::string& title) override;
  std::unique_ptr<Overlay> make_overlay() override;

  // Of a window that never waits. Whether a picture can be shown by `frame`, a loop of frames that draws nothing else:
  // all that it drew before has left the GPU (and is on the screen from now), the window is to be seen, and its next
  // image is free.
  bool ready(const Frame& frame);
  // After ready(): has the frame that was begun fill the window with these parts (none: black) and what is drawn over
  // them, and submits it. ready() brings it to the screen.
  void show(Frame& frame, std::span<const WindowPart> parts);
  double period_s() const;                                                       // of the screen that it stands on
  glm::ivec2 size() const { return {int(extent_.width), int(extent_.height)}; }  // of its images, pixels
  void set_visible(bool visible);                                                // and no longer closed
  bool shows() const;                                                            // something of it can be seen

  // Asked before the desktop's events are handed out: a library that takes them for several windows has to be told
  // whose they are.
  void before_events(std::function<void()> asked) { before_events_ = std::move(asked); }
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
  void make_waits();      // what tells that an image is there
  bool make_swapchain();  // false: the window has no area
  void make_overlay_pass();
  SwapImage* acquire(std::size_t slot);
  bool hold_image();
  void draw(Frame& frame, SwapImage& target, std::span<const WindowPart> parts);
  void present(VkSemaphore drawn);

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
  Owned<VkFence> image_free_;  // of a window that never waits: the image held is no longer on the screen
  std::uint32_t image_index_ = 0;
  bool holds_image_ = false, shown_next_ = false;  // acquired; drawn, and to be presented once it has left the GPU
  bool stale_ = true;                              // the swapchain no longer fits the window
  int swapchains_made_ = 0;
  DrawOver drawn_over_;
  std::function<void()> before_events_;

  void gather();                                 // keys and gamepads
  static constexpr std::size_t key_codes = 512;  // GLFW's
  InputGatherer gatherer_;
  std::bitset<key_codes> keys_down_;
  Post post_ = Post::afoot;
  Input input_, gathering_;  // of gathering_ the mouse only
  glm::dvec2 last_mouse_{0.0};
  bool mouse_known_ = false, mouse_held_ = false;
  int width_ = 0, height_ = 0;  // of the window's picture, pixels
  double vertical_fov_deg_ = 60.0, eye_distance_m_ = 0.064, scale_ = 1.0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace seascape
