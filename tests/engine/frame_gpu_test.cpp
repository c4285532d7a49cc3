// Frames: room for the lists of vertices that they ask for, and whether they have left the GPU.
#include "engine/frame.h"

#include <cstring>

#include "tests/support/gpu/blockade.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {

namespace {

class FrameVertices : public test::GpuTest {};

// A frame whose lists outgrow the room gets more, and what it has bound already stays. The sea at ultra once asked for
// more patches than there was room for, and the frame was refused. Controls seen: the smaller buffer destroyed at once
// (the validation layer), a list that begins where the last one did, room only for as much as the frame has asked for
// so far, so that every frame makes a buffer anew.
TEST_F(FrameVertices, GrowWithWhatFramesAskFor) {
  Device& device = test::device();
  TargetSpec spec;
  spec.width = spec.height = 16;
  spec.views = 2;
  spec.colour = VK_FORMAT_R8G8B8A8_UNORM;
  const RenderTarget target(device, "vertices", spec);
  GraphicsSpec graphics;
  graphics.vertex = "multiview_check.vert";
  graphics.fragment = "multiview_check.frag";
  const Pipeline pipeline = make_graphics_pipeline(device, test::shaders(), target, graphics);
  const Bindings none;
  Frame frame(device, 64);
  std::size_t objects = 0;
  std::uint64_t bytes = 0;
  for (int f = 0; f < 3 * Frame::slots; ++f) {
    frame.begin();
    std::vector<VertexList> lists;
    frame.draw_pass("vertices", target, {}, [&](Commands& c) {
      c.bind(pipeline, none);
      for (const VkDeviceSize wanted : {40u, 20u, 300u, 1000u, 8u}) {
        const VertexList list = frame.vertices(wanted);
        ASSERT_EQ(list.offset % 16, 0u);
        ASSERT_LE(list.offset + wanted, list.buffer->bytes());
        ASSERT_TRUE(f < 2 * Frame::slots || lists.empty() || list.offset > 0) << "a buffer anew in frame " << f;
        std::memset(list.host, int(lists.size()) + 1, wanted);
        c.bind_vertices(list);
        c.draw(3);
        lists.push_back({list.buffer, wanted, list.host});
      }
    });
    for (std::size_t i = 0; i < lists.size(); ++i)
      for (VkDeviceSize b = 0; b < lists[i].offset; ++b)
        ASSERT_EQ(static_cast<unsigned char*>(lists[i].host)[b], i + 1) << "frame " << f;
    frame.submit();
    if (f + 1 == 2 * Frame::slots)
      frame.finish(), objects = device.objects().size(), bytes = device.memory().used_bytes();
  }
  frame.finish();
  EXPECT_EQ(device.objects().size(), objects);
  EXPECT_EQ(device.memory().used_bytes(), bytes);
}

// Control seen: ready() that asks for the frame before the last.
TEST_F(FrameVertices, AreReadyWhenTheGpuHasDone) {
  Device& device = test::device();
  Frame frame(device, 64);
  EXPECT_TRUE(frame.ready());
  test::Blockade blockade(device);
  EXPECT_FALSE(blockade.frame().ready());
  frame.begin();
  frame.submit();
  EXPECT_FALSE(frame.ready());
  EXPECT_TRUE(blockade.lift()) << "ready() waited";
  frame.finish();
  EXPECT_TRUE(frame.ready());
}

}  // namespace

}  // namespace seascape
