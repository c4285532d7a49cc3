// What a frame moves through the device's memory, against sums made by hand; and that frames for tiles leave depth and
// samples in the tile.
#include <gmock/gmock.h>

#include <set>

#include "engine/frame.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

void PrintTo(const BytesMoved& m, std::ostream* out) {
  *out << m.loaded << " loaded, " << m.stored << " stored, " << m.copied << " copied";
}

namespace {

using test::SeaShot;
using test::ShotOptions;

class FrameBytes : public test::GpuTest {};

constexpr std::uint64_t pixels = 2 * 640 * 400;  // of both eyes

ShotOptions options_of(const std::string& shape, const std::string& samples) {
  return {.preset = "low",
          .width = 640,
          .height = 400,
          .views = 2,
          .set = {{"waves.where", "gpu"}, {"frame.shape", shape}, {"msaa", samples}}};
}

// Of a frame after the first.
FrameCounts counts_of(SeaShot& shot) {
  shot.draw(shot.scene().start, 1.0);
  shot.draw(shot.scene().start, 2.0);
  return shot.counts();
}

// The resolved colour, 4 bytes a pixel, and nothing of depth or samples. Controls, all seen: samples stored, depth
// stored, colour loaded, one eye counted.
TEST_F(FrameBytes, OfATileFrameAreTheFinishedPicture) {
  for (const char* samples : {"1", "4"}) {
    ShotOptions options = options_of("tile", samples);
    options.set.emplace_back("frame.lighting", "forward");
    SeaShot shot(options);
    EXPECT_EQ(counts_of(shot).moved, (BytesMoved{0, 4 * pixels, 0})) << samples;
  }
}

// Forward, the desktop frame's light (4 halves) is stored and its picture (4 bytes). Deferred, it is what the surface
// is (16 bytes a pixel) with its depth (4) besides. Control, seen: depth that is kept, not counted.
TEST_F(FrameBytes, OfADesktopFrameAreItsLightToo) {
  SeaShot forward(options_of("desktop", "4"));
  ASSERT_FALSE(forward.experience().deferred());
  EXPECT_EQ(counts_of(forward).moved, (BytesMoved{0, (8 + 4) * pixels, 0}));
  ShotOptions options = options_of("desktop", "1");
  options.set.emplace_back("frame.lighting", "deferred");
  SeaShot deferred(options);
  ASSERT_TRUE(deferred.experience().deferred());
  const std::uint64_t footprints = test::device().facts().max_anisotropy > 1.0f ? 8 : 0;
  EXPECT_EQ(counts_of(deferred).moved, (BytesMoved{0, (16 + footprints + 4 + 8 + 4) * pixels, 0}));
}

// A pass per eye resolves each eye and copies it to its layer. Control, seen: the copy not counted.
TEST_F(FrameBytes, OfAPassPerEyeAreItsCopies) {
  ShotOptions options = options_of("tile", "4");
  options.per_eye = true;
  SeaShot shot(options);
  EXPECT_EQ(counts_of(shot).moved, (BytesMoved{0, 4 * pixels, 4 * pixels}));
}

// Copies, by hand: 2 layers of 5 x 3 texels of 4 halves, all of a buffer and a part of one. Controls, all seen: one
// layer counted, a texel taken for 4 bytes, the whole buffer for its part.
TEST_F(FrameBytes, OfCopiesAreWhatArrives) {
  Device& device = test::device();
  Frame frame(device);
  const auto both = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  const Buffer from(device, "from", 1000, both, HostAccess::write), to(device, "to", 1000, both);
  ImageSpec spec;
  spec.width = 8;
  spec.height = 4;
  spec.layers = 3;
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  const Image image(device, "image", spec);
  frame.begin();
  frame.pass("whole", {use(from, Access::transfer_read), use(to, Access::transfer_write)},
             [&](Commands& c) { c.copy(from, to); });
  frame.pass("part", {use(from, Access::transfer_read), use(to, Access::transfer_write)}, [&](Commands& c) {
    c.copy(from, to, {10, 20, 100});
  });
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 2};
  region.imageExtent = {5, 3, 1};
  frame.pass("image", {use(from, Access::transfer_read), use(image, Access::transfer_write)},
             [&](Commands& c) { c.copy(from, image, std::array{region}); });
  frame.submit();
  frame.finish();
  ASSERT_EQ(frame.work().size(), 3u);
  EXPECT_EQ(frame.work()[0].moved, (BytesMoved{0, 0, 1000}));
  EXPECT_EQ(frame.work()[1].moved, (BytesMoved{0, 0, 100}));
  EXPECT_EQ(frame.work()[2].moved, (BytesMoved{0, 0, 2 * 5 * 3 * 8}));
  EXPECT_EQ(frame.counts().moved, (BytesMoved{0, 0, 1340}));
}

// Rows of the frame's work have among them what the frame's counts say. Control, seen: a row's copies left out.
TEST_F(FrameBytes, AreToldByPass) {
  SeaShot shot({.scene = "storm", .preset = "low", .width = 64, .height = 48, .views = 2});
  const FrameCounts counts = counts_of(shot);
  BytesMoved sum;
  for (const PipelineWork& work : shot.experience().frame().work()) sum += work.moved;
  EXPECT_EQ(sum, counts.moved);
  EXPECT_GT(sum.copied, 0u) << "foam's windows";
}

// The pictures of tile frames come of one render pass, that reads and copies nothing of what it draws; depth and
// samples are transient, never stored, and no command may copy or sample them. Controls, all seen: depth with
// TRANSFER_SRC, samples that are not transient, a second pass.
TEST_F(FrameBytes, OfDepthAndSamplesStayInTheTile) {
  for (const char* preset : {"low", "medium"})
    for (const char* scene : {"open_sea", "storm", "harbour_clip"}) {
      SCOPED_TRACE(std::string(scene) + " at " + preset);
      SeaShot shot(
          {.scene = scene, .preset = preset, .width = 64, .height = 48, .views = 2, .set = {{"waves.where", "gpu"}}});
      const FrameCounts counts = counts_of(shot);
      EXPECT_EQ(counts.moved.loaded, 0u);
      std::set<std::uint32_t> drawing;
      for (const PipelineWork& work : shot.experience().frame().work())
        if (work.draws > 0 || work.moved.stored > 0) drawing.insert(work.pass_number);
      EXPECT_EQ(drawing.size(), 1u);

      const RenderTarget& picture = shot.experience().picture();
      ASSERT_NE(picture.depth(), nullptr);
      ASSERT_NE(picture.multisampled(), nullptr);
      for (const TargetAttachment& row : attachments_of(picture.spec(), test::device().facts())) {
        EXPECT_NE(row.load, VK_ATTACHMENT_LOAD_OP_LOAD);
        EXPECT_EQ(row.store == VK_ATTACHMENT_STORE_OP_STORE, row.part == TargetAttachment::Part::resolved);
      }
      int in_tile = 0;
      for (const ObjectRecord& object : test::device().objects()) {
        if (object.type != VK_OBJECT_TYPE_IMAGE) continue;
        const ImageSpec& spec = *object.made_with.image;
        const bool depth = spec.usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
        if (!depth && spec.samples == VK_SAMPLE_COUNT_1_BIT) continue;
        ++in_tile;
        EXPECT_TRUE(spec.transient) << object.name;
        EXPECT_EQ(spec.usage & (VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT), 0u) << object.name;
      }
      EXPECT_EQ(in_tile, 2);
    }
}

}  // namespace

}  // namespace seascape
