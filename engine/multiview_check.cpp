#include "engine/multiview_check.h"

#include "engine/frame.h"

namespace seascape {

bool multiview_works(Device& device, ShaderLibrary& shaders) {
  const EffectScope scope(device, "multiview check");
  TargetSpec spec;
  spec.width = spec.height = 16;
  spec.views = 2;
  spec.colour = VK_FORMAT_R8G8B8A8_UNORM;
  const RenderTarget target(device, "multiview check", spec);
  GraphicsSpec graphics;
  graphics.vertex = "multiview_check.vert";
  graphics.fragment = "multiview_check.frag";
  const Pipeline pipeline = make_graphics_pipeline(device, shaders, target, graphics);
  const Bindings none;
  {
    Frame frame(device, 4096);
    frame.begin();
    frame.draw_pass("multiview check", target, {}, [&](Commands& c) {
      c.bind(pipeline, none);
      c.draw(3);
    });
    frame.submit();
    frame.finish();
  }
  bool right = true;
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    const auto pixels = read_image(device, target.colour(), eye);
    // The triangle crosses every side of the picture and the near plane; it covers all but the upper left corner.
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const std::uint8_t* p = &pixels[std::size_t(y * 16 + x) * 4];
        const bool covered = x + y > 8, drawn = p[0] == (eye == 0 ? 255 : 0) && p[1] == (eye == 1 ? 255 : 0);
        if (x + y < 6 || x + y > 10) right = right && covered == drawn;
      }
  }
  return right;
}

bool multiview_known_to_work(Device& device, ShaderLibrary& shaders) {
  if (!device.multiview_checked()) device.multiview_checked() = multiview_works(device, shaders);
  return *device.multiview_checked();
}

}  // namespace seascape
