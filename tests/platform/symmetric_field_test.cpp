// The one field that both eyes are drawn with, and each eye's part of it. Controls are named beside each test; each was
// seen to fail.
#include "platform/symmetric_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace seascape {
namespace {

constexpr glm::uvec2 unbounded{1u << 20, 1u << 20};

// The middle of a pixel of the drawn picture is that of the pixel in the eye's own, for eyes of all kinds. Controls:
// the part's beginning not whole; y counted from below; the step that of the drawn picture.
TEST(SymmetricField, ThePartIsTheEyesOwnPicture) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> tangent(0.2, 2.5);
  std::uniform_int_distribution<std::uint32_t> side(1, 2000);
  for (int round = 0; round < 2000; ++round) {
    std::array<Fov, 2> eyes;
    for (Fov& eye : eyes) eye = {-tangent(random), tangent(random), tangent(random), -tangent(random)};
    if (round % 5 == 0) eyes[0].right = -0.5 * std::abs(eyes[0].left) * 0.1;  // sees only to one side
    const glm::uvec2 shown(side(random), side(random));
    const glm::uvec2 most = round % 3 == 0 ? shown + glm::uvec2(3, 1) : unbounded;
    const glm::uvec2 drawn = symmetric_size(eyes, shown, most);
    ASSERT_LE(shown.x, drawn.x);
    ASSERT_LE(shown.y, drawn.y);
    ASSERT_LE(drawn.x, most.x);
    ASSERT_LE(drawn.y, most.y);
    const auto parts = symmetric_parts(eyes, shown, drawn);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& [field, from] = parts[i];
      ASSERT_LE(from.x + shown.x, drawn.x) << round;
      ASSERT_LE(from.y + shown.y, drawn.y) << round;
      for (const glm::uvec2& pixel : {glm::uvec2(0), shown - 1u, shown / 2u}) {
        const auto at = [](const Fov& f, const glm::uvec2& p, const glm::uvec2& size) {
          return glm::dvec2(f.left + (f.right - f.left) * (p.x + 0.5) / size.x,
                            f.up + (f.down - f.up) * (p.y + 0.5) / size.y);
        };
        ASSERT_LT(glm::length(at(field, from + pixel, drawn) - at(eyes[i], pixel, shown)), 1e-9) << round;
      }
    }
  }
}

// Eyes that mirror each other are drawn alike, and to either side alike, within a pixel: as far as the farthest that
// one sees, and no farther than a pixel more. Controls: the nearest instead of the farthest; the middle of the eye's
// field for that of both.
TEST(SymmetricField, IsOneForBothEyes) {
  for (const glm::uvec2& shown : {glm::uvec2(1680, 1760), glm::uvec2(97, 81), glm::uvec2(16, 12)}) {
    const std::array<Fov, 2> eyes{Fov{-1.28, 0.84, 0.97, -1.11}, Fov{-0.84, 1.28, 0.97, -1.11}};
    const double pixel = (1.28 + 0.84) / shown.x;
    const glm::uvec2 drawn = symmetric_size(eyes, shown, unbounded);
    EXPECT_NEAR(drawn.x * pixel, 2.56, pixel);
    EXPECT_EQ(drawn.y, shown.y);  // they see alike upwards and downwards
    const auto parts = symmetric_parts(eyes, shown, drawn);
    for (const FieldPart& part : parts) {
      EXPECT_NEAR(part.drawn.left, -1.28, pixel);
      EXPECT_NEAR(part.drawn.right, 1.28, pixel);
      EXPECT_NEAR(part.drawn.left, -part.drawn.right, 1.01 * pixel);
      EXPECT_NEAR(part.drawn.up, 0.97, 1e-9);
    }
    EXPECT_EQ(parts[0].from.x, 0u);
    EXPECT_EQ(parts[1].from.x + shown.x, drawn.x);
  }
}

// Without room the field is what there is room for, about the same middle. Control: all of the room to one side.
TEST(SymmetricField, TakesTheRoomThatThereIs) {
  const std::array<Fov, 2> eyes{Fov{-1.5, 0.5, 1.0, -1.0}, Fov{-0.5, 1.5, 1.0, -1.0}};
  const glm::uvec2 shown(100, 100), most(120, 100);
  const glm::uvec2 drawn = symmetric_size(eyes, shown, most);
  EXPECT_EQ(drawn, most);
  const auto parts = symmetric_parts(eyes, shown, drawn);
  EXPECT_EQ(parts[0].from, glm::uvec2(0, 0));
  EXPECT_EQ(parts[1].from, glm::uvec2(20, 0));
  const Fov even{-1.0, 1.0, 1.0, -1.0};
  EXPECT_EQ(symmetric_size({even, even}, shown, unbounded), shown);
  EXPECT_EQ(symmetric_parts({even, even}, shown, shown)[0].from, glm::uvec2(0, 0));
  EXPECT_EQ(symmetric_parts({even, even}, shown, {120, 110})[0].from, glm::uvec2(10, 5));
}

}  // namespace
}  // namespace seascape
