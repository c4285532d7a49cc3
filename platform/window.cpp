#include "platform/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/address_space.h"
#include "engine/error.h"
#include "platform/window_overlay.h"

namespace seascape {

namespace {

std::string desktop_fault() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

}  // namespace

struct WindowEvents {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  static void key(GLFWwindow* window, int code, int, int action, int) {
    Window& w = of(window);
    if (code < 0 || std::size_t(code) >= Window::key_codes) return;
    w.keys_down_.set(std::size_t(code), action != GLFW_RELEASE);
    if (action != GLFW_PRESS) return;
    for (const KeyBinding& binding : key_bindings())
      if (binding.key == code && holds_at(binding.post, w.post_)) w.gatherer_.press(binding.action, binding.value);
  }
  static void button(GLFWwindow* window, int which, int action, int) {
    if (which == GLFW_MOUSE_BUTTON_RIGHT) of(window).gathering_.right_button = action == GLFW_PRESS;
  }
  static void moved(GLFWwindow* window, double x, double y) {
    Window& w = of(window);
    if (w.mouse_known_) w.gathering_.mouse_pixels += glm::dvec2(x, y) - w.last_mouse_;
    w.last_mouse_ = {x, y};
    w.mouse_known_ = true;
  }
  static void wheel(GLFWwindow* window, double, double y) { of(window).gathering_.wheel += y; }
  static void focus(GLFWwindow* window, int focused) {
    if (focused) return;
    of(window).keys_down_.reset();  // releases are not told to a window without the keyboard
    of(window).gathering_.right_button = false;
  }
  static void resized(GLFWwindow* window, int, int) { of(window).stale_ = true; }
};

WindowSystem::WindowSystem() {
  expect_address_space();  // it loads a driver
  if (!glfwInit())
    throw Error("display", "no display can be reached: " + desktop_fault(),
                "check DISPLAY and that a desktop runs, or use --display headless");
  if (!glfwVulkanSupported()) {
    const std::string fault = desktop_fault();
    glfwTerminate();
    throw Error("display", "Vulkan cannot draw to this desktop: " + fault,
                "run `seascape doctor`, or use --display headless");
  }
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

std::vector<std::string> WindowSystem::instance_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names)
    throw Error("display", "Vulkan has no extension for this desktop: " + desktop_fault(),
                "install a driver with a desktop's support, or use --display headless");
  return {names, names + count};
}

Window::Window(WindowSystem&, Device& device, const WindowOptions& options)
    : device_(device), options_(options), start_(std::chrono::steady_clock::now()) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUS_ON_SHOW, options.waits ? GLFW_TRUE : GLFW_FALSE);
  const int width = int(options.width) * options.views;
  window_ = glfwCreateWindow(width, int(options.height), options.title.c_str(), nullptr, nullptr);
  if (!window_)
    throw Error("display",
                fmt::format("a window of {}x{} cannot be opened: {}", width, options.height, desktop_fault()),
                "check the display, or use --display headless");
  try {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, WindowEvents::key);
    glfwSetMouseButtonCallback(window_, WindowEvents::button);
    glfwSetCursorPosCallback(window_, WindowEvents::moved);
    glfwSetScrollCallback(window_, WindowEvents::wheel);
    glfwSetWindowFocusCallback(window_, WindowEvents::focus);
    glfwSetFramebufferSizeCallback(window_, WindowEvents::resized);
    glfwGetFramebufferSize(window_, &width_, &height_);
    const EffectScope scope(device_, "window");
    make_surface();
    make_overlay_pass();
    make_waits();
  } catch (...) {
    surface_.reset();
    device_.frames_finished_to(~std::uint64_t{0});
    glfwDestroyWindow(window_);
    throw;
  }
}

Window::~Window() {
  device_.wait_for_gpu();
  if (holds_image_) {  // a fence that the desktop still has is not to be destroyed
    const VkFence fence = image_free_.get();
    constexpr std::uint64_t patience_ns = 1'000'000'000;
    (void)vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, patience_ns);
  }
  image_free_.reset();
  images_.clear();
  for (auto& semaphore : acquired_) semaphore.reset();
  swapchain_.reset();
  surface_.reset();
  device_.frames_finished_to(~std::uint64_t{0});  // in this order, before the window they belong to
  glfwDestroyWindow(window_);
}

void Window::make_surface() {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  check(glfwCreateWindowSurface(device_.instance(), window_, nullptr, &surface), "glfwCreateWindowSurface");
  surface_ = Owned<VkSurfaceKHR>(device_, surface, "window");
  VkBool32 presents = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(device_.physical(), device_.queue_family(), surface, &presents),
        "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (!presents)
    throw Error(device_.facts().name, "this device cannot show pictures in a window of this desktop",
                "name another with SEASCAPE_DEVICE (see `seascape doctor`), or use --display headless");
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), surface, &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), surface, &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  // The picture is sRGB; blitted to a format that is sRGB too, it keeps its values.
  for (const VkSurfaceFormatKHR& f : formats)
    if (f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
        (f.format == VK_FORMAT_B8G8R8A8_SRGB || f.format == VK_FORMAT_R8G8B8A8_SRGB ||
         f.format == VK_FORMAT_A8B8G8R8_SRGB_PACK32)) {
      format_ = f;
      break;
    }
  VkSurfaceCapabilitiesKHR can{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface, &can),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  if (format_.format == VK_FORMAT_UNDEFINED || !(can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
    throw Error(device_.facts().name, "the window takes no sRGB pictures that can be copied into",
                "use --display headless");
}

// The panel is drawn over what the copy of the picture left.
void Window::make_overlay_pass() {
  VkAttachmentDescription colour{};
  colour.format = format_.format;
  colour.samples = VK_SAMPLE_COUNT_1_BIT;
  colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  colour.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  colour.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  colour.initialLayout = colour.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = 1;
  info.pAttachments = &colour;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  overlay_pass_ = device_.cached_render_pass(fmt::format("window overlay {}", int(format_.format)), info);
}

void Window::gather() {
  for (const KeyBinding& binding : key_bindings())
    if (keys_down_.test(std::size_t(binding.key)) && holds_at(binding.post, post_))
      gatherer_.add(binding.action, binding.value);
  if (!glfwGetWindowAttrib(window_, GLFW_FOCUSED)) return;  // a gamepad is everybody's
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    GLFWgamepadstate pad;
    if (!glfwGetGamepadState(id, &pad)) continue;
    const std::span<const unsigned char> buttons(pad.buttons);
    gather_gamepad(gatherer_, post_, buttons, pad.axes);
  }
}

bool Window::shows() const {
  return window_shows(width_, height_, glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0,
                      glfwGetWindowAttrib(window_, GLFW_VISIBLE) != 0);
}

glm::uvec2 Window::most_size() const {
  return {std::uint32_t(std::max(1, width_ / options_.views)), std::uint32_t(std::max(1, height_))};
}

// Of the screen that the window stands on, as nearly as its place tells.
double Window::period_s() const {
  if (!options_.waits) return 0.0;
  int x = 0, y = 0, count = 0;
  glfwGetWindowPos(window_, &x, &y);
  GLFWmonitor** screens = glfwGetMonitors(&count);
  const GLFWvidmode* mode = nullptr;
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(screens[i], &left, &top);
    const GLFWvidmode* shown = glfwGetVideoMode(screens[i]);
    if (shown != nullptr && (mode == nullptr || (x + width_ / 2 >= left && x + width_ / 2 < left + shown->width &&
                                                 y + height_ / 2 >= top && y + height_ / 2 < top + shown->height)))
      mode = shown;
  }
  constexpr double usual_hz = 60.0;
  return 1.0 / (mode != nullptr && mode->refreshRate > 0 ? mode->refreshRate : usual_hz);
}

DisplayFrame Window::begin() {
  if (before_events_) before_events_();
  glfwPollEvents();
  glfwGetFramebufferSize(window_, &width_, &height_);
  DisplayFrame frame;
  frame.should_render = shows();
  if (options_.waits && !frame.should_render && !glfwWindowShouldClose(window_)) {
    glfwWaitEventsTimeout(0.25);
    glfwGetFramebufferSize(window_, &width_, &height_);
    frame.should_render = shows();
  }
  gather();
  input_ = gatherer_.take();
  input_.mouse_pixels = gathering_.mouse_pixels;
  input_.wheel = gathering_.wheel;
  input_.right_button = gathering_.right_button;
  gathering_.mouse_pixels = {0.0, 0.0};
  gathering_.wheel = 0.0;
  frame.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  frame.closed = glfwWindowShouldClose(window_) != 0;
  const glm::uvec2 most = most_size();
  frame.width = scaled_pixels(most.x, scale_);
  frame.height = scaled_pixels(most.y, scale_);
  frame.period_s = period_s();
  return frame;
}

Viewpoint Window::viewpoint(const Pose& carrier) const {
  const Fov fov =
      symmetric_fov(vertical_fov_deg_, std::max(1.0, double(width_) / options_.views) / std::max(1, height_));
  const std::vector<View> eyes = stereo_views(carrier, fov, eye_distance_m_);
  const double pixels = pixels_per_radian(eyes, int(scaled_pixels(most_size().y, scale_)));
  if (options_.views == 2) return {carrier, eyes, pixels};
  return {carrier, {{carrier, fov}}, pixels};
}

void Window::draw(Frame& frame, SwapImage& target, std::span<const WindowPart> parts) {
  Uses uses{use(target.image, Access::transfer_write, true)};
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (i == 0 || parts[i].picture != parts[i - 1].picture) uses.add(use(*parts[i].picture, Access::transfer_read));
  frame.pass("mirror", uses, [&](Commands& c) {
    if (parts.empty()) {  // black, and not what was there before
      constexpr VkClearColorValue black{};
      constexpr VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
      vkCmdClearColorImage(c.raw(), target.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &all);
    }
    for (const WindowPart& part : parts) {
      VkImageBlit blit{};
      blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, part.layer, 1};
      blit.srcOffsets[0] = {part.from_least.x, part.from_least.y, 0};
      blit.srcOffsets[1] = {part.from_most.x, part.from_most.y, 1};
      blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
      blit.dstOffsets[0] = {part.to_least.x, part.to_least.y, 0};
      blit.dstOffsets[1] = {part.to_most.x, part.to_most.y, 1};
      const bool same = part.to_most - part.to_least == part.from_most - part.from_least;
      vkCmdBlitImage(c.raw(), part.picture->get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image.get(),
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    }
  });
  if (drawn_over_)
    frame.pass("panel", {use(target.image, Access::colour_target)}, [&](Commands& c) {
      VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
      begin.renderPass = overlay_pass_;
      begin.framebuffer = target.framebuffer.get();
      begin.renderArea = {{0, 0}, extent_};
      vkCmdBeginRenderPass(c.raw(), &begin, VK_SUBPASS_CONTENTS_INLINE);
      drawn_over_(c.raw(), extent_.width, extent_.height);
      vkCmdEndRenderPass(c.raw());
    });
  frame.pass("present", {use(target.image, Access::present)}, [](Commands&) {});
}

void Window::end(Frame& frame, const RenderTarget* picture, const Image*) {
  if (!picture) return;
  const std::size_t slot = std::size_t(frame.number() % Frame::slots);
  SwapImage* target = acquire(slot);
  if (!target) {
    frame.submit();
    return;
  }
  std::vector<WindowPart> parts;  // the views side by side
  const int views = picture->spec().views;
  for (int view = 0; view < views; ++view)
    parts.push_back({&picture->colour(),
                     std::uint32_t(view),
                     {0, 0},
                     {int(picture->spec().width), int(picture->spec().height)},
                     {size().x * view / views, 0},
                     {size().x * (view + 1) / views, size().y}});
  draw(frame, *target, parts);
  const VkSemaphore drawn = target->drawn.get();
  frame.submit(acquired_[slot].get(), drawn);
  present(drawn);
}

void Window::set_lens(double vertical_fov_deg, double eye_distance_m) {
  vertical_fov_deg_ = vertical_fov_deg;
  eye_distance_m_ = eye_distance_m;
}

void Window::hold_mouse(bool held) {
  if (held == mouse_held_) return;
  mouse_held_ = held;
  mouse_known_ = false;  // the pointer jumps when its mode changes: that is no movement
  glfwSetInputMode(window_, GLFW_CURSOR, held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

std::unique_ptr<Overlay> Window::make_overlay() { return std::make_unique<WindowOverlay>(device_, *this); }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

void Window::set_visible(bool visible) {
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
  if (visible)
    glfwShowWindow(window_);
  else
    glfwHideWindow(window_);
}

double Window::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return double(std::max(x, y));
}

}  // namespace seascape
