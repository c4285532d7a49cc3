// The self-test of the driver's multiview.
#include "engine/multiview_check.h"

#include "engine/files.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/temporary_folder.h"

namespace seascape {

namespace {

class Multiview : public test::GpuTest {};

// The project's own software driver, Mesa 25, draws multiview rightly; so do GPUs of today. Mesa 22.3 is the control:
// there the check says no (seen by VK_DRIVER_FILES= with Debian's own driver), and this test is passed over.
TEST_F(Multiview, TheDriverThatTheProjectBringsPasses) {
  const std::string driver = test::device().facts().driver;
  const bool known_bad = driver.find("Mesa 22.") != std::string::npos;
  EXPECT_EQ(multiview_works(test::device(), test::shaders()), !known_bad) << driver;
}

// The control: shaders that colour the eyes the other way round are told apart, so the check does look at the pictures.
TEST_F(Multiview, AWrongPictureIsSeen) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"multiview_check.vert.spv", "multiview_check.frag.spv"})
    std::filesystem::copy_file(ShaderLibrary::default_directory() / name, folder / name);
  auto words = read_spirv(folder / "multiview_check.frag.spv");
  int swapped = 0;
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16)
    if ((words[at] & 0xffffu) == 43 &&
        (words[at + 3] == 0x3f800000u || words[at + 3] == 0u)) {  // OpConstant 1.0 or 0.0
      words[at + 3] ^= 0x3f800000u;
      ++swapped;
    }
  ASSERT_GE(swapped, 2);
  write_atomically(folder / "multiview_check.frag.spv",
                   std::string_view(reinterpret_cast<const char*>(words.data()), words.size() * 4));
  ShaderLibrary wrong(folder.path());
  EXPECT_FALSE(multiview_works(test::device(), wrong));
}

// What the check leaves behind: nothing.
TEST_F(Multiview, TheCheckLeavesNothingBehind) {
  Device& device = test::device();
  (void)multiview_works(device, test::shaders());
  device.wait_idle();
  const std::size_t objects = device.objects().size();
  const std::uint64_t bytes = device.memory().used_bytes();
  (void)multiview_works(device, test::shaders());
  device.wait_idle();
  EXPECT_EQ(device.objects().size(), objects);
  EXPECT_EQ(device.memory().used_bytes(), bytes);
}

}  // namespace

}  // namespace seascape
