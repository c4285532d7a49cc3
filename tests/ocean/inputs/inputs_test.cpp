// How inputs join: blends, weights, order, thousands of them against one after the other, and what they leave alone.
#include "ocean/inputs/inputs.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <random>

#include "tests/support/allocations.h"
#include "tests/support/input_truth.h"

namespace seascape {
namespace {

InputSpec disc(InputTarget to, glm::dvec2 at, double size, float value) {
  InputSpec spec;
  spec.to = to;
  spec.where = "here";
  spec.value = {value, 0.0f, 0.0f, 0.0f};
  spec.shape = AreaInput{.at_m = at, .size_m = {size, size}};
  return spec;
}
constexpr glm::vec4 zero{0.0f};

// Control: min's formula for max's fails here.
TEST(Inputs, BlendAsTheirNamesSay) {
  for (std::size_t b = 0; b < input_blends.size(); ++b)
    for (const double weight : {0.0, 0.25, 1.0})
      for (const float base : {-2.0f, 0.5f, 7.0f})
        for (const float value : {-3.0f, 0.0f, 4.0f}) {
          if (input_blends[b] == "scale" && value < 0.0f) continue;
          InputSpec spec = disc(InputTarget::level, {0.0, 0.0}, 10.0, value);
          spec.blend = InputBlend(b), spec.weight = weight, spec.feather_m = 2.0;
          const Inputs inputs(InputTarget::level, std::vector{spec});
          for (const double x : {0.0, 3.5, 4.2, 6.0})
            EXPECT_NEAR(inputs.value({x, 0.0}, 0.0, 0.0, {base, 5.0f, 6.0f, 7.0f}).x,
                        test::joined(input_blends[b], base, value, weight * test::smooth((5.0 - x) / 2.0)), 1e-5)
                << input_blends[b] << " " << weight << " " << base << " " << value << " " << x;
          EXPECT_EQ(inputs.value({0.0, 0.0}, 0.0, 0.0, {base, 5.0f, 6.0f, 7.0f}).y, 5.0f)
              << "channels that a level has not";
        }
}

// Lower orders first, those alike as they come. Control: a sort by order downwards gives 2.
TEST(Inputs, JoinInTheirOrder) {
  std::vector<InputSpec> specs;
  const std::pair<int, float> orders[] = {{5, 1.0f}, {-1, 2.0f}, {5, 3.0f}, {0, 7.0f}};
  for (const auto& [order, value] : orders) {
    specs.push_back(disc(InputTarget::level, {0.0, 0.0}, 10.0, value));
    specs.back().order = order, specs.back().blend = InputBlend::replace;
  }
  EXPECT_EQ(Inputs(InputTarget::level, specs).value({0.0, 0.0}, 0.0, 0.0, zero).x, 3.0f) << "the last of order 5";
  specs[0].blend = InputBlend::scale;  // 7, then 1 times that, then ...
  specs[0].value.x = 2.0f;
  specs[2].blend = InputBlend::add;
  EXPECT_EQ(Inputs(InputTarget::level, specs).value({0.0, 0.0}, 0.0, 0.0, zero).x, 17.0f);
}

// Control: a tree that goes to one of its halves alone, and inputs joined as they are found.
TEST(Inputs, AThousandAreAsOneAfterTheOther) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-300.0, 300.0), size(1.0, 80.0), share(0.0, 1.0);
  for (const std::size_t count : {1u, 5u, 10u, 100u, 1000u}) {
    std::vector<InputSpec> specs;
    for (std::size_t i = 0; i < count; ++i) {
      InputSpec spec = disc(InputTarget::level, {place(random), place(random)}, 1.0, float(10.0 * share(random) - 5.0));
      std::get<AreaInput>(spec.shape) = {.round = i % 2 == 0,
                                         .at_m = {place(random), place(random)},
                                         .size_m = {size(random), size(random)},
                                         .turn_deg = place(random)};
      spec.blend = InputBlend(i % 5), spec.weight = share(random), spec.order = int(i * 7 % 4),
      spec.feather_m = 5.0 * share(random), spec.follow_waves = i % 3 == 0;
      if (spec.blend == InputBlend::scale) spec.value.x = float(2.0 * share(random));
      specs.push_back(spec);
    }
    const Inputs all(InputTarget::level, specs);
    ASSERT_EQ(all.size(), count);
    std::vector<std::size_t> sorted(count);
    for (std::size_t i = 0; i < count; ++i) sorted[i] = i;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::size_t a, std::size_t b) { return specs[a].order < specs[b].order; });
    std::vector<Inputs> each;
    for (const std::size_t i : sorted) each.emplace_back(InputTarget::level, std::span(&specs[i], 1));
    int touched = 0;
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 at{place(random), place(random)},
          rest = i % 2 == 0 ? at : at + glm::dvec2(3.0 * share(random), -2.0);
      const double footprint = i % 3 == 0 ? 0.0 : 40.0 * share(random);
      glm::vec4 truth{1.0f};
      for (const Inputs& one : each) truth = one.value(at, footprint, 0.0, truth, rest);
      const glm::vec4 value = all.value(at, footprint, 0.0, glm::vec4(1.0f), rest);
      EXPECT_EQ(value, truth) << count << " " << at.x << " " << at.y;
      touched += value != glm::vec4(1.0f);
    }
    if (count >= 100) {
      EXPECT_GT(touched, 100);
    }
  }
}

// Hundreds on one place are more than are sorted where they are found.
TEST(Inputs, HundredsAtOnePlaceKeepTheirOrder) {
  std::vector<InputSpec> specs;
  float truth = 0.0f;
  for (int i = 0; i < 300; ++i) {
    specs.push_back(disc(InputTarget::level, {0.01 * i, 0.0}, 50.0, float(i % 11)));
    specs.back().blend = i % 2 == 0 ? InputBlend::add : InputBlend::replace;
    specs.back().weight = 0.5;
    truth = i % 2 == 0 ? truth + 0.5f * float(i % 11) : 0.5f * truth + 0.5f * float(i % 11);
  }
  EXPECT_NEAR(Inputs(InputTarget::level, specs).value({1.0, 1.0}, 0.0, 0.0, zero).x, truth, 1e-4f);
}

// Where there is nothing the base comes back to the bit, whatever it is; and of many kinds only the asked one counts.
// Control: a clamp of what was not touched turns 1e30 into 10,000.
TEST(Inputs, LeaveAloneWhatTheyDoNotTouch) {
  const std::vector<InputSpec> specs{disc(InputTarget::level, {0.0, 0.0}, 10.0, 3.0f),
                                     disc(InputTarget::foam, {50.0, 0.0}, 10.0, 3.0f)};
  const Inputs level(InputTarget::level, specs);
  const glm::vec4 odd{1e30f, -0.0f, 1e-40f, -7.0f};
  EXPECT_EQ(level.size(), 1u);
  const glm::vec4 back = level.value({50.0, 0.0}, 0.0, 0.0, odd);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(std::bit_cast<std::uint32_t>(back[c]), std::bit_cast<std::uint32_t>(odd[c]));
  EXPECT_TRUE(level.still());
  EXPECT_FALSE(level.follow_waves());
  EXPECT_TRUE(Inputs(InputTarget::clip, specs).empty());
  EXPECT_EQ(level.bounds().least, glm::dvec2(-5.0));
  EXPECT_EQ(level.bounds().most, glm::dvec2(5.0));
}

// Control: asking every input at the displaced place gives 3 for 0.
TEST(Inputs, ThoseThatFollowTheWavesAreAskedAtRest) {
  std::vector<InputSpec> specs{disc(InputTarget::foam, {0.0, 0.0}, 10.0, 3.0f)};
  const auto at = [&](glm::dvec2 place, glm::dvec2 rest) {
    return Inputs(InputTarget::foam, specs).value(place, 0.0, 0.0, zero, rest).x;
  };
  EXPECT_EQ(at({0.0, 0.0}, {8.0, 0.0}), 3.0f);
  EXPECT_EQ(at({8.0, 0.0}, {0.0, 0.0}), 0.0f);
  specs[0].follow_waves = true;
  EXPECT_EQ(at({0.0, 0.0}, {8.0, 0.0}), 0.0f);
  EXPECT_EQ(at({8.0, 0.0}, {0.0, 0.0}), 3.0f);
}

// One of every kind that needs no file.
std::vector<InputSpec> mixed() {
  std::vector<InputSpec> specs(4, disc(InputTarget::foam, {0.0, 0.0}, 80.0, 1.0f));
  specs[1].shape = SplineInput{.points = {{{-50.0, 0.0}, 30.0, {1.0f, 0.0f, 0.0f, 0.0f}},
                                          {{0.0, 20.0}, 30.0, {2.0f, 0.0f, 0.0f, 0.0f}},
                                          {{50.0, 0.0}, 30.0, {3.0f, 0.0f, 0.0f, 0.0f}}}};
  specs[2].shape = SplineInput{.points = {{{-50.0, -50.0}, 1.0, glm::vec4(1.0f)},
                                          {{50.0, -50.0}, 1.0, glm::vec4(2.0f)},
                                          {{0.0, 50.0}, 1.0, glm::vec4(3.0f)}},
                               .closed = true,
                               .filled = true};
  specs[3].shape = TrailInput{.keys = {{0.0, {-40.0, 0.0}}, {5.0, {0.0, 30.0}}, {10.0, {40.0, 0.0}}}, .radius_m = 8.0};
  for (InputSpec& spec : specs) spec.feather_m = 3.0;
  return specs;
}

// Control: a list of what is found at a place that is kept in a vector allocates at every place.
TEST(Inputs, AnswerWithoutAllocations) {
  const Inputs inputs(InputTarget::foam, mixed());
  float sum = 0.0f;
  const test::AllocationCounter counter;
  for (double x = -60.0; x < 60.0; x += 1.0) sum += inputs.value({x, 5.0}, 2.0, 6.0, zero).x;
  if (test::AllocationCounter::counts) {
    EXPECT_EQ(counter.ours(), 0u);
  }
  EXPECT_GT(sum, 50.0f);
}

// Control: what is found at a place, kept in the object, differs at some places and is a race under the thread
// sanitizer.
TEST(Inputs, ConcurrentAnswersAreTheSame) {
  const Inputs inputs(InputTarget::foam, mixed());
  const auto ask = [&](int i) {
    return inputs.value({i % 120 - 60.0, i / 120 % 120 - 60.0}, i % 3, 0.01 * (i % 1000), zero).x;
  };
  std::vector<float> alone(40000), together(40000);
  for (int i = 0; i < 40000; ++i) alone[std::size_t(i)] = ask(i);
  tbb::parallel_for(0, 40000, [&](int i) { together[std::size_t(i)] = ask(i); });
  EXPECT_EQ(alone, together);
}

}  // namespace
}  // namespace seascape
