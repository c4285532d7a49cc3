// Formulas that C++ and GLSL share give the same numbers in both.
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "engine/frame.h"
#include "ocean/waves/wave_field.h"
#include "shaders/shared/flow_height.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

class SharedFormulas : public test::GpuTest {};

// Slopes of 4,096 surfaces, a third of them turned over and a tenth all but singular, as SeaSample::slope() has them in
// double. Where float makes another Jacobian than double the slope is off by as much: the bar is of a float's rounding
// over the held Jacobian. Controls seen, in the shader alone: the sign of the fold lost; max(J, 0.15),
// as pictures had it; held at 2e-3; dDx/dx for dDz/dx; a Gaussian of another width.
TEST_F(SharedFormulas, AreTheProcessors) {
  constexpr std::size_t count = 4096;
  struct Given {
    glm::vec4 height_shift, shear_decay, way;
  };
  std::vector<Given> given(count);
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (std::size_t i = 0; i < count; ++i) {
    Given& g = given[i];
    for (int n = 0; n < 4; ++n) g.height_shift[n] = normal(random);
    const float xx = unit(random), zz = 0.2f * unit(random);
    g.shear_decay = {0.3f * normal(random), xx, zz, (2.0f * unit(random) - 1.0f) * std::sqrt(xx * zz)};
    g.way = {4.0f * unit(random), 4.0f * unit(random), 0.0f, 0.0f};
    if (i % 10 == 0)
      g.height_shift.w =
          (g.shear_decay.x * g.shear_decay.x + 1e-3f * normal(random)) / (1.0f + g.height_shift.z) - 1.0f;
  }
  const Buffer in = make_filled_buffer(test::device(), "given", given.data(), count * sizeof(Given),
                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer out(test::device(), "found", count * sizeof(glm::vec4),
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const Pipeline pipeline = make_compute_pipeline(test::device(), test::shaders(), "shared_formulas.comp", {});
  const Bindings bindings(test::device(), pipeline, {{.binding = 0, .buffer = &in}, {.binding = 1, .buffer = &out}},
                          "shared formulas");
  Frame frame(test::device(), 4096);
  frame.begin();
  frame.pass("formulas", {use(in, Access::compute_read), use(out, Access::compute_write)}, [&](Commands& c) {
    c.bind(pipeline, bindings);
    c.dispatch(std::uint32_t(count / 64), 1, 1);
  });
  frame.submit();
  frame.finish();
  const std::vector<std::uint8_t> bytes = read_buffer(test::device(), out);
  int folded = 0, held = 0;
  for (std::size_t i = 0; i < count; ++i) {
    glm::vec4 got;
    std::memcpy(&got, bytes.data() + i * sizeof got, sizeof got);
    const Given& g = given[i];
    SeaSample want;
    want.height_gradient = glm::dvec2(g.height_shift);
    want.shift_gradient = glm::dvec3(g.height_shift.z, g.height_shift.w, g.shear_decay.x);
    const double jacobian = want.jacobian(), size = std::max(std::abs(jacobian), 1e-3);
    const glm::dvec2 slope = want.slope();
    folded += jacobian < 0.0;
    held += std::abs(jacobian) < 1e-3;
    ASSERT_NEAR(double(got.z), jacobian, 2e-6) << i;
    if (std::abs(jacobian) < 4e-6) continue;  // whose sign a float may lose
    const double bar = 4e-6 * (1.0 + glm::length(slope) + 4.0) / size;
    ASSERT_NEAR(double(got.x), slope.x, bar) << i << ' ' << jacobian;
    ASSERT_NEAR(double(got.y), slope.y, bar) << i << ' ' << jacobian;
    const glm::dvec4 decay(g.shear_decay), way(g.way);
    ASSERT_NEAR(double(got.w), gpu::flow_height(decay.y, decay.z, decay.w, way.x, way.y, double(0.3f)), 4e-6) << i;
  }
  EXPECT_GT(folded, 1000);
  EXPECT_GT(held, 200);
}

}  // namespace
}  // namespace seascape
