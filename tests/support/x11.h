// What a test does to a window of a virtual display, and sees of it, as a window manager and a screen do. Include it
// last: X11's macros take common names.
#pragma once
#include <stdexcept>

#include "engine/image_file.h"
#include "tests/support/desktop.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace seascape::test {

// What a window manager says to windows, for there is none on the virtual display.
class WindowManager {
 public:
  explicit WindowManager(const VirtualDisplay& display) : x_(XOpenDisplay(display.name().c_str())) {}
  ~WindowManager() { XCloseDisplay(x_); }
  void close_button(::Window window) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(x_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = long(XInternAtom(x_, "WM_DELETE_WINDOW", False));
    XSendEvent(x_, window, False, NoEventMask, &event);
    XSync(x_, False);
  }
  void set_iconic(::Window window, bool iconic) {
    const long state[] = {iconic ? IconicState : NormalState, 0};
    const Atom name = XInternAtom(x_, "WM_STATE", False);
    XChangeProperty(x_, window, name, name, 32, PropModeReplace, reinterpret_cast<const unsigned char*>(state), 2);
    XSync(x_, False);
  }

 private:
  ::Display* x_;
};

// Reads what a window shows, as a screen does.
class X11Reader {
 public:
  X11Reader(const VirtualDisplay& display, ::Window window)
      : x_(XOpenDisplay(display.name().c_str())), window_(window) {}
  ~X11Reader() { XCloseDisplay(x_); }
  X11Reader(const X11Reader&) = delete;
  X11Reader& operator=(const X11Reader&) = delete;
  Image8 read() const {
    XWindowAttributes is{};
    XGetWindowAttributes(x_, window_, &is);
    XImage* image = XGetImage(x_, window_, 0, 0, unsigned(is.width), unsigned(is.height), AllPlanes, ZPixmap);
    if (image == nullptr) throw std::runtime_error("the window cannot be read");
    Image8 result{is.width, is.height, 4, {}};
    for (int y = 0; y < is.height; ++y)
      for (int x = 0; x < is.width; ++x) {
        const unsigned long pixel = XGetPixel(image, x, y);
        for (const unsigned shift : {16u, 8u, 0u}) result.pixels.push_back(std::uint8_t(pixel >> shift));
        result.pixels.push_back(255);
      }
    XDestroyImage(image);
    return result;
  }

 private:
  ::Display* x_;
  ::Window window_;
};

}  // namespace seascape::test
