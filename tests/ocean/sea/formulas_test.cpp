// The vector forms of the shared formulas against the scalar ones.
#include "ocean/sea/formulas-inl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/shared/flow_height.h"
#include "shaders/shared/surface_slope.h"

namespace seascape {
namespace {

namespace vectors = HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::FixedTag<float, 4>;

// Slopes of folded, flat and turned-over surfaces, to the bit; one in eight has a Jacobian of less than 1e-3. Controls
// seen: dDx/dz for dDz/dx; the sign of the fold lost; held at 2e-3.
TEST(Formulas, SlopesOfVectorsAreTheScalarOnes) {
  const Tag d;
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  int folded = 0, held = 0;
  for (int i = 0; i < 4000; ++i) {
    float in[6][4], out[4][4];
    for (auto& value : in)
      for (float& lane : value) lane = normal(random);
    for (int lane = 0; i % 8 == 0 && lane < 4; ++lane)  // singular, to a little
      in[3][lane] = (in[4][lane] * in[5][lane] + 1e-3f * normal(random)) / (1.0f + in[2][lane]) - 1.0f;
    const auto load = [&](int n) { return hn::LoadU(d, in[n]); };
    const auto fold = vectors::fold(d, load(2), load(3), load(4), load(5));
    hn::StoreU(vectors::slope_x(fold, load(0), load(1)), d, out[0]);
    hn::StoreU(vectors::slope_z(fold, load(0), load(1)), d, out[1]);
    hn::StoreU(fold.jacobian, d, out[2]);
    hn::StoreU(fold.held, d, out[3]);
    for (int lane = 0; lane < 4; ++lane) {
      const auto of = [&](int n) { return in[n][lane]; };
      const glm::vec2 slope = gpu::surface_slope(of(0), of(1), of(2), of(3), of(4), of(5));
      const float jacobian = gpu::surface_jacobian(of(2), of(3), of(4), of(5));
      ASSERT_EQ(out[0][lane], slope.x);
      ASSERT_EQ(out[1][lane], slope.y);
      ASSERT_EQ(out[2][lane], jacobian);
      ASSERT_EQ(out[3][lane], gpu::held_jacobian(jacobian));
      ASSERT_GE(std::abs(out[3][lane]), 1e-3f);
      ASSERT_EQ(out[3][lane] < 0.0f, jacobian < 0.0f);
      folded += jacobian < 0.0f;
      held += std::abs(jacobian) < 1e-3f;
    }
  }
  EXPECT_GT(folded, 1000);
  EXPECT_GT(held, 200);
}

// Heights of two patterns, to some float roundings of both exponential and root. Controls seen: the sum without its
// factor of 2; a term of the exponential a twenty-fifth instead of a twenty-fourth.
TEST(Formulas, FlowHeightsOfVectorsAreTheScalarOnes) {
  const Tag d;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const float xx = float(unit(random)), zz = float(0.1 * unit(random)),
                xz = float((2.0 * unit(random) - 1.0) * std::sqrt(xx * zz)), first = float(unit(random));
    float way_x[4], way_z[4], out[4];
    for (int lane = 0; lane < 4; ++lane)
      way_x[lane] = float(10.0 * unit(random) * unit(random)), way_z[lane] = float(10.0 * unit(random) - 5.0);
    hn::StoreU(vectors::flow_height(d, {xx, zz, xz}, hn::LoadU(d, way_x), hn::LoadU(d, way_z), first), d, out);
    for (int lane = 0; lane < 4; ++lane) {
      const double want =
          gpu::flow_height(double(xx), double(zz), double(xz), double(way_x[lane]), double(way_z[lane]), double(first));
      most = std::max(most, std::abs(double(out[lane]) - want) / want);
      ASSERT_NEAR(want, double(gpu::flow_height(xx, zz, xz, way_x[lane], way_z[lane], first)), 2e-6);
      ASSERT_GE(want, 1.0 - 1e-12);
      ASSERT_LE(want, std::sqrt(2.0) + 1e-12);
    }
  }
  RecordProperty("most", std::to_string(most * 1e7) + "e-7");
  EXPECT_LT(most, 1e-6);
}

}  // namespace
}  // namespace seascape
