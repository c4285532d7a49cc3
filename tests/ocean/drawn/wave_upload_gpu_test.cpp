// Uploaded tiles hold what the wave field computed, to the bit, and draw the picture that computed ones draw.
#include "ocean/drawn/wave_upload.h"

#include <cmath>
#include <cstring>

#include "tests/support/gpu/drawn_tiles.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::DrawnTiles;
using test::windy;

using Filled = WaveImages::Filled;

class UploadedTiles : public test::GpuTest {};

// Both ways into the images; the first falls back to the second where the device does not sample what the host writes.
constexpr Filled both[] = {Filled::written, Filled::copied};

// To the nearest number with 11 bits, ties to the even one, from 2^-24 on.
double to_half(float value) {
  if (value == 0.0f) return value;
  const double step = std::ldexp(1.0, std::max(std::ilogb(value), -14) - 10);
  return std::nearbyint(value / step) * step;
}

// How many numbers of all images, cascades and levels are not what the field has.
std::size_t wrong_numbers(DrawnTiles& drawn, const WaveTiles& field, std::string& where) {
  std::size_t wrong = 0, numbers = 0;
  for (int image = 0; image < 3; ++image)
    for (int cascade = 0; cascade < field.cascades(); ++cascade)
      for (int level = 0; level < field.levels(cascade); ++level) {
        const auto got = drawn.texels(cascade, WavePlane(image), level);
        const int size = field.samples(cascade) >> level;
        if (got.size() != std::size_t(size) * std::size_t(size)) return where = "a level of another size", 1;
        for (int z = 0; z < size; ++z)
          for (int x = 0; x < size; ++x) {
            const glm::vec4& want =
                field.texels(cascade, WavePlane(image), level)[z * field.stride(cascade, level) + x];
            const glm::vec4& have = got[std::size_t(z * size + x)];
            for (int c = 0; c < 4; ++c, ++numbers) {
              const bool same = drawn.images().half_storage() ? double(have[c]) == to_half(want[c])
                                                              : std::memcmp(&have[c], &want[c], sizeof(float)) == 0;
              if (!same && wrong++ == 0)
                where = "image " + std::to_string(image) + ", cascade " + std::to_string(cascade) + ", level " +
                        std::to_string(level) + ", x " + std::to_string(x) + ", z " + std::to_string(z) + ", channel " +
                        std::to_string(c);
            }
          }
      }
  return numbers == 0 ? 1 : wrong;
}

void expect_exact(const WaveQuality& quality, Filled filled) {
  DrawnTiles drawn(WavePlace::cpu, windy(), quality, filled);
  SCOPED_TRACE(drawn.images().filled() == Filled::written ? "written" : "copied");
  EXPECT_EQ(drawn.images().half_storage(), quality.half_storage);
  const WaveField field(windy(), quality);
  WaveTiles tiles;
  std::string where;
  for (const double time_s : {17.3, 1e7}) {  // one in each frame's memory
    field.evaluate(ticks_from_seconds(time_s), tiles);
    drawn.compute(ticks_from_seconds(time_s));
    EXPECT_EQ(wrong_numbers(drawn, tiles, where), 0u) << quality.resolution << ", " << time_s << " s: " << where;
  }
  // The control: tiles of a tick later are others.
  field.evaluate(ticks_from_seconds(1e7) + 1, tiles);
  EXPECT_GT(wrong_numbers(drawn, tiles, where), 0u);
}

// Controls: rows taken as long as the level is wide, derivatives copied from the moments, and one level's copy left out
// each fail here.
TEST_F(UploadedTiles, HoldTheFieldsBits) {
  for (const Filled filled : both)
    for (const int resolution : {16, 32, 64, 128, 256, 512})
      expect_exact({.resolution = resolution, .cascades = resolution <= 128 ? 5 : 2}, filled);
}

TEST_F(UploadedTiles, HoldTheFieldsBitsForAnyNumberOfCascades) {
  for (const Filled filled : both)
    for (int cascades = 1; cascades <= 5; ++cascades) expect_exact({.resolution = 32, .cascades = cascades}, filled);
}

// Controls: halves cut instead of rounded fail; of images that are written, the levels below a strip's left out.
TEST_F(UploadedTiles, HoldTheFieldsNumbersRoundedToHalves) {
  for (const Filled filled : both)
    for (const int resolution : {16, 32, 64, 128, 256, 512})
      expect_exact({.resolution = resolution, .cascades = resolution <= 128 ? 5 : 2, .half_storage = true}, filled);
}

// The processor writes the next frame's tiles while the GPU still copies this one's: each frame keeps what it had.
// Control: one staging buffer, or one set of images, for all frames in flight is seen here (by most of the pairs).
void expect_frames_apart(Filled filled) {
  const WaveQuality quality{.resolution = 256, .cascades = 5};
  DrawnTiles drawn(WavePlace::cpu, windy(), quality, filled);
  const WaveField field(windy(), quality);
  WaveTiles tiles;
  const VkDeviceSize bytes = 256u * 256u * 16u;
  constexpr VkDeviceSize times = 60;  // long enough for the processor to have written the next frame's before the last
  Buffer kept(test::device(), "kept", times * bytes,
              VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  VkBufferImageCopy last{};
  last.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 3, 1};
  last.imageExtent = {256, 256, 1};
  for (int pair = 0; pair < 8; ++pair) {
    Frame& frame = drawn.frame();
    frame.begin();
    drawn.update(2 * pair);
    const Image& moments = drawn.image(4, WavePlane::moments);
    frame.pass("keep", {use(moments, Access::transfer_read), use(kept, Access::transfer_write)}, [&](Commands& c) {
      for (last.bufferOffset = 0; last.bufferOffset < times * bytes; last.bufferOffset += bytes)
        vkCmdCopyImageToBuffer(c.raw(), moments.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kept.get(), 1, &last);
    });
    frame.submit();
    frame.begin();
    drawn.update(ticks_from_seconds(100.0 + pair));
    frame.submit();
    frame.finish();
    field.evaluate(2 * pair, tiles);
    const auto got = read_buffer(test::device(), kept);
    int wrong = 0;
    for (int z = 0; z < 256; ++z)
      wrong += std::memcmp(&got[(times - 1) * bytes + std::size_t(z) * 256 * 16],
                           tiles.texels(4, WavePlane::moments, 0) + z * tiles.stride(4, 0), 256 * 16) != 0;
    EXPECT_EQ(wrong, 0) << "rows of pair " << pair;
  }
}

TEST_F(UploadedTiles, FramesInFlightDoNotShareTheirMemory) {
  for (const Filled filled : both) expect_frames_apart(filled);
}

// A sea that stands still is not computed again, whichever frame's images hold it; another time is.
TEST_F(UploadedTiles, AreKeptWhileTimeStands) {
  for (const Filled filled : both) {
    DrawnTiles drawn(WavePlace::cpu, windy(), {.resolution = 32, .cascades = 2}, filled);
    const WaveField field(windy(), {.resolution = 32, .cascades = 2});
    WaveTiles tiles;
    std::string where;
    for (const std::int64_t ticks : {7, 7, 7, 9, 9, 7}) {
      drawn.compute(ticks);
      field.evaluate(ticks, tiles);
      EXPECT_EQ(wrong_numbers(drawn, tiles, where), 0u) << ticks << ": " << where;
    }
  }
}

// Nothing of the other way is there: no pipeline and no storage here, no staging there.
TEST_F(UploadedTiles, BuildNothingOfTheOtherWay) {
  Device& device = test::device();
  const auto named = [&](const std::string& name) {
    int found = 0;
    for (const ObjectRecord& object : device.objects()) found += object.name == name;
    return found;
  };
  const std::uint64_t pipelines = device.pipelines_made();
  {
    const DrawnTiles drawn(WavePlace::cpu, windy(), {.resolution = 32, .cascades = 2}, Filled::copied);
    EXPECT_EQ(device.pipelines_made(), pipelines);
    EXPECT_EQ(named("wave bins") + named("wave rows"), 0);
    EXPECT_EQ(named("wave staging"), Frame::slots);
    EXPECT_FALSE(drawn.images().sets()[1].displacement.spec().usage & VK_IMAGE_USAGE_STORAGE_BIT);
  }
  device.wait_idle();
  {
    const DrawnTiles drawn(WavePlace::cpu, windy(), {.resolution = 32, .cascades = 2});
    EXPECT_EQ(device.pipelines_made(), pipelines);
    if (drawn.images().filled() == Filled::written) {
      EXPECT_EQ(named("wave staging"), 0);
      EXPECT_EQ(named("wave moments"), 2 * 2 * Frame::slots) << "an image and its view, of two sets";
    }
  }
  device.wait_idle();
  const DrawnTiles computed(WavePlace::gpu, windy(), {.resolution = 32, .cascades = 2});
  EXPECT_EQ(device.pipelines_made(), pipelines + 5);
  EXPECT_EQ(named("wave staging"), 0);
  EXPECT_FALSE(computed.images().sets()[1].displacement.spec().usage & VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

// Frames of every scene drawn in both ways. Of a pixel's largest difference in linear light; the control: a hundredth
// of a second later is outside.
TEST_F(UploadedTiles, DrawThePictureThatComputedOnesDraw) {
  constexpr double mean = 4e-4, p99 = 8e-3;  // half floats: a driver may cut where we round
  for (const char* scene : {"open_sea", "calm", "storm", "swell"})
    for (const char* preset : {"medium", "high"}) {
      const auto shot = [&](const char* place) {
        return test::SeaShot(
            {.scene = scene, .preset = preset, .width = 160, .height = 90, .set = {{"waves.where", place}}});
      };
      auto cpu = shot("cpu"), gpu = shot("gpu");
      const Pose head = cpu.scene().start;
      const Image8 uploaded = cpu.picture(head, 60.0), computed = gpu.picture(head, 60.0),
                   later = cpu.picture(head, 60.01);
      const auto same = test::difference(uploaded, computed), other = test::difference(later, computed);
      EXPECT_LE(same.mean, mean) << scene << " " << preset;
      EXPECT_LE(same.p99, p99) << scene << " " << preset;
      EXPECT_TRUE(other.mean > mean && other.p99 > p99)
          << scene << " " << preset << ": " << other.mean << ", " << other.p99;
      RecordProperty(std::string(scene) + "_" + preset, std::to_string(same.mean) + ", " + std::to_string(same.p99) +
                                                            "; later " + std::to_string(other.mean) + ", " +
                                                            std::to_string(other.p99));
    }
}

}  // namespace

}  // namespace seascape
