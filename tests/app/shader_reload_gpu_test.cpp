// Shaders that change on disk while the sea is drawn.
#include <cstring>

#include "app/frame.h"
#include "app/program.h"
#include "engine/error.h"
#include "engine/files.h"
#include "platform/headless.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;

class ShaderReload : public test::GpuTest {};

// A module with all constants that are floats times this.
std::vector<std::uint8_t> with_floats(const fs::path& file, float times) {
  std::vector<std::uint32_t> words = read_spirv(file);
  constexpr std::uint32_t constant = 43, type_float = 22;
  std::uint32_t float_type = 0;
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
    if ((words[at] & 0xffffu) == type_float) float_type = words[at + 1];
    if ((words[at] & 0xffffu) != constant || words[at + 1] != float_type) continue;
    float value;
    std::memcpy(&value, &words[at + 3], 4);
    value *= times;
    std::memcpy(&words[at + 3], &value, 4);
  }
  std::vector<std::uint8_t> bytes(4 * words.size());
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

// Controls seen: shaders that are read once only; files that are not validated (a crash in the optimiser).
TEST_F(ShaderReload, DrawsWhatIsOnDiskNow) {
  const fs::path folder = fs::path(::testing::TempDir()) / "shader_reload";
  fs::remove_all(folder);
  fs::copy(ShaderLibrary::default_directory(), folder);
  ShaderLibrary shaders(folder);
  const HeadlessOptions options{.width = 48, .height = 32, .views = 1};
  const Scene scene = load_scene("calm", "low");
  Experience experience(test::device(), shaders, scene, {.width = 48, .height = 32, .views = 1});
  Headless display(options);
  const auto picture = [&] {
    Frame& frame = experience.frame();
    display.begin();
    frame.begin();
    draw_frame(experience, frame, display.viewpoint(scene.start), scene.settings.time_start_s);
    display.end(frame, &experience.picture());
    frame.finish();
    return picture_of(test::device(), experience, 0).pixels;
  };
  const auto first = picture();
  experience.reload_shaders();
  EXPECT_EQ(experience.builds(), 1u);  // none has changed

  const fs::path file = folder / "sky.frag.spv";
  const std::vector<std::uint8_t> whole = read_bytes(file);
  write_atomically(file, with_floats(file, 0.5f));
  experience.reload_shaders();
  EXPECT_EQ(experience.builds(), 2u);
  EXPECT_NE(picture(), first);

  const std::size_t half = whole.size() / 8 * 4;  // as while it is written: whole words, and not
  for (const std::size_t size : {whole.size() - 4, half + 40, half, half - 2}) {
    write_atomically(file, std::span<const std::uint8_t>(whole).first(size));
    EXPECT_THROW(experience.reload_shaders(), Error) << size;
  }
  experience.reload_shaders();  // until it changes again it is not read
  EXPECT_NE(picture(), first);
  write_atomically(file, whole);
  experience.reload_shaders();
  EXPECT_EQ(picture(), first);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace seascape
