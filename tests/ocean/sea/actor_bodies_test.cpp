// Bodies of actors, in which there is no water: where they are at steps and between them, for whom, and until when.
#include "ocean/sea/actor_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "ocean/sea/sea.h"
#include "tests/support/allocations.h"
#include "tests/support/own_sea.h"
#include "tests/support/wigley.h"

namespace seascape {
namespace {

using Form = VolumeInput::Form;
const glm::dvec3 head{3.0, 2.0, -2.0};
const test::Wigley boat{.length_m = 12.0, .beam_m = 4.0, .draught_m = 2.5, .freeboard_m = 2.5};

SeaSpec spec_with_room(int most = 4, const std::vector<InputSpec>& volumes = {}) {
  SeaState state;
  state.wind_speed_mps = 6.0;
  SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
  spec.place.volumes = std::make_shared<const ClipVolumes>(volumes, ClipRoom{most, {test::wigley_model(boat)}});
  return spec;
}

// Says in each step what a function of the step's end makes of it.
class Clipper : public SeaActor {
 public:
  using Body = std::function<ClipBody(SeaStep& step)>;
  explicit Clipper(Body body) : body_(std::move(body)) {}
  void step(SeaStep& step) override { taken = step.clip(body_(step)); }
  bool taken = false;

 private:
  Body body_;
};

// A motion of constant velocity and spin, about an axis that leans.
const glm::dvec3 begin_m(-4.0, 0.5, 3.0), speed_mps(9.0, 0.2, -4.0), spin_rad_s(0.3, 1.4, -0.2);
ClipBody moving_at(double time_s, ClipBody body) {
  body.at_m = begin_m + time_s * speed_mps;
  body.velocity_mps = speed_mps;
  body.orientation = glm::angleAxis(time_s * glm::length(spin_rad_s), glm::normalize(spin_rad_s));
  body.spin_rad_s = spin_rad_s;
  return body;
}
// A point of the world in its own axes then, by Rodrigues's formula.
glm::dvec3 own_place(double time_s, glm::dvec3 at) {
  const glm::dvec3 p = at - begin_m - time_s * speed_mps, k = glm::normalize(spin_rad_s);
  const double a = -time_s * glm::length(spin_rad_s);
  return std::cos(a) * p + std::sin(a) * glm::cross(k, p) + (1.0 - std::cos(a)) * glm::dot(k, p) * k;
}

// Asks the places of a raster about the body and holds their flags against `beyond`, which says how far outside a point
// in the body's own axes is (m, roughly): places within slack_m of the edge do not count.
void expect_clipped(const SeaView& view, double time_s, double slack_m,
                    const std::function<double(glm::dvec3)>& beyond) {
  int within = 0, wrong = 0;
  const glm::dvec3 middle = begin_m + time_s * speed_mps;
  for (int i = 0; i < 6400; ++i) {
    const glm::dvec2 place = glm::dvec2(middle.x, middle.z) + 0.25 * glm::dvec2(i % 80 - 40, i / 80 - 40);
    const QueryAnswer answer = view.query(place);
    const double off = beyond(own_place(time_s, {place.x, answer.height_m, place.y}));
    within += off < 0.0;
    wrong += std::abs(off) > slack_m && answer.clipped != (off < 0.0);
  }
  EXPECT_GT(within, 200) << time_s;
  EXPECT_EQ(wrong, 0) << "of " << within << " at " << time_s << " s, detail " << int(view.detail());
}

// A box and a boat that move and turn are where they are at times of steps and between them, in each detail. Controls
// seen: bodies not carried on; spin left out; turned the other way.
TEST(ActorBodies, AreWhereTheyAreAtStepsAndBetween) {
  ClipBody box{.form = Form::box, .size_m = {6.0, 5.0, 3.0}};
  ClipBody hull{.hull = 0, .scale = 1.2};
  const auto of_box = [&](glm::dvec3 p) {
    const glm::dvec3 q = glm::abs(p) - 0.5 * box.size_m;
    return std::max({q.x, q.y, q.z});
  };
  const auto of_hull = [&](glm::dvec3 p) {
    p /= hull.scale;
    const bool holds = boat.holds(p.x, p.y, p.z);
    for (int i = 0; i < 6; ++i) {
      glm::dvec3 beside = p;
      beside[i / 2] += i % 2 ? 0.03 : -0.03;
      if (boat.holds(beside.x, beside.y, beside.z) != holds) return 0.0;  // at its edge
    }
    return holds ? -1.0 : 1.0;
  };
  for (const bool is_hull : {false, true}) {
    Sea sea(spec_with_room());
    sea.add(std::make_shared<Clipper>([&](SeaStep& step) { return moving_at(step.time_s, is_hull ? hull : box); }));
    sea.advance(0.0, head);
    for (const double time_s : {1.0 / 60.0, 1.5 / 60.0, 0.5, 0.5 + 0.9 / 60.0, 1.25 + 0.3 / 60.0}) {
      sea.advance(time_s, head);
      for (const SeaDetail detail : {SeaDetail::felt, SeaDetail::drawn})
        expect_clipped(sea.view_at(time_s, detail), time_s, is_hull ? 0.5 : 2e-3,
                       is_hull ? std::function<double(glm::dvec3)>(of_hull) : of_box);
    }
  }
}

ClipBody ball(glm::dvec2 at, double radius_m = 2.0) {
  return {.form = Form::sphere, .radius_m = radius_m, .at_m = {at.x, 0.0, at.y}};
}
bool clipped(const SeaView& view, glm::dvec2 at) { return view.query(at).clipped; }

// Who holds a view keeps the bodies that it has, whatever steps follow. Views of another time and questions without
// history have the scene's volumes alone. Controls seen: a body placed into the volumes that the view holds; bodies in
// views of any time; history not asked.
TEST(ActorBodies, ViewsThatAreHeldKeepThem) {
  InputSpec rock;
  rock.to = InputTarget::clip;
  rock.blend = InputBlend::replace;
  rock.value.x = 1.0f;
  rock.shape = VolumeInput{.form = Form::sphere, .at_m = {0.0, 0.0, 40.0}, .radius_m = 4.0};
  Sea sea(spec_with_room(4, {rock}));
  sea.add(std::make_shared<Clipper>([](SeaStep& step) { return ball({10.0 * step.time_s, 0.0}); }));
  sea.advance(0.0, head);
  std::vector<SeaView> views;
  for (int i = 1; i <= 6; ++i) {
    sea.advance(i, head);
    views.push_back(sea.view_at(i, SeaDetail::felt));
  }
  for (int i = 1; i <= 6; ++i)
    for (int at = 1; at <= 6; ++at)
      EXPECT_EQ(clipped(views[std::size_t(i - 1)], {10.0 * at, 0.0}), at == i) << i << ' ' << at;
  EXPECT_TRUE(clipped(views[2], {0.0, 40.0}));
  EXPECT_FALSE(views[2].query({30.0, 0.0}, {.history = false}).clipped);
  EXPECT_TRUE(views[2].query({0.0, 40.0}, {.history = false}).clipped);
  EXPECT_FALSE(clipped(sea.view_at(5.5, SeaDetail::felt), {60.0, 0.0}));
  EXPECT_FALSE(clipped(sea.view_at(6.5, SeaDetail::drawn), {60.0, 0.0}));
  EXPECT_TRUE(clipped(sea.view_at(6.5, SeaDetail::drawn), {0.0, 40.0}));
}

// In its own steps an actor's view has the bodies of the step before, carried on to this one's end, whoever comes
// first. Control seen: bodies not carried on.
TEST(ActorBodies, StepsSeeThoseOfTheStepBefore) {
  Sea sea(spec_with_room());
  std::vector<int> seen;
  const auto watch = [&](SeaStep& step) {
    seen.push_back(clipped(step.felt(), {60.0 * step.time_s, 0.0}));
    ClipBody body = ball({60.0 * step.time_s, 0.0}, 0.4);
    body.velocity_mps = {60.0, 0.0, 0.0};
    return body;
  };
  for (int i = 0; i < 2; ++i) sea.add(std::make_shared<Clipper>(watch));
  sea.advance(0.0, head);
  sea.advance(3.0 / 60.0, head);
  EXPECT_EQ(seen, (std::vector{0, 0, 1, 1, 1, 1}));
}

// The bodies after some seconds, and what the sea hashes to, to the bit, however frames fall in which they are drawn;
// they follow the water they feel. Control seen: the time of the frame before taken for that of the step's end.
TEST(ActorBodies, AreTheSameHoweverFramesFall) {
  const auto at_end = [](double rate_hz) {
    Sea sea(spec_with_room());
    glm::dvec2 at(0.0);
    sea.add(std::make_shared<Clipper>([&](SeaStep& step) {
      const QueryAnswer water = step.felt().query(at, {.footprint_m = 1.0});
      const glm::dvec2 along = glm::dvec2(2.0, 1.0) + 3.0 * glm::dvec2(water.normal.x, water.normal.z);
      at += step.dt_s * along;
      ClipBody body{.form = Form::capsule, .radius_m = 1.5, .length_m = 5.0};
      body.at_m = {at.x, water.height_m, at.y};
      body.velocity_mps = {along.x, 0.0, along.y};
      body.spin_rad_s = water.normal;
      return body;
    }));
    for (double i = 0.0; i < 4.0 * rate_hz; ++i) {
      sea.advance(i / rate_hz, head);
      (void)sea.clip_volumes();
    }
    sea.advance(4.0 + 0.1 / 60.0, head);
    const gpu::ClipVolume volume = sea.clip_volumes()->volumes().at(0);
    return std::pair(sea.hash(), volume);
  };
  const auto want = at_end(60.0);
  for (const double rate : {20.0, 72.0, 90.0}) {
    const auto got = at_end(rate);
    EXPECT_EQ(got.first, want.first) << rate;
    EXPECT_EQ(std::memcmp(&got.second, &want.second, sizeof got.second), 0) << rate;
  }
}

// Added between steps it clips from the next one on; taken away it is gone in the next advance, though no step falls in
// it, and others stay. Controls seen: bodies forgotten in steps only; all of them forgotten.
TEST(ActorBodies, ComeAndGoBetweenSteps) {
  Sea sea(spec_with_room());
  const auto one = std::make_shared<Clipper>([](SeaStep&) {
    return ball({0.0, 0.0});
  }),
             other = std::make_shared<Clipper>([](SeaStep&) {
               return ball({20.0, 0.0});
             });
  const auto both = [&](double time_s) {
    const SeaView view = sea.view_at(time_s, SeaDetail::felt);
    return std::pair(clipped(view, {0.0, 0.0}), clipped(view, {20.0, 0.0}));
  };
  sea.add(one);
  sea.advance(0.0, head);
  EXPECT_EQ(both(0.0), std::pair(false, false)) << "no step was taken";
  sea.advance(1.0, head);
  EXPECT_EQ(both(1.0), std::pair(true, false));
  sea.add(other);
  sea.advance(1.004, head);
  EXPECT_EQ(both(1.004), std::pair(true, false)) << "its first step has not come";
  sea.advance(1.0 + 1.0 / 60.0, head);
  EXPECT_EQ(both(1.0 + 1.0 / 60.0), std::pair(true, true));
  EXPECT_TRUE(other->taken);
  sea.take_away(*one);
  EXPECT_EQ(both(1.0 + 1.0 / 60.0), std::pair(true, true));
  sea.advance(1.02, head);
  EXPECT_EQ(both(1.02), std::pair(false, true));
  sea.take_away(*other);
  sea.advance(1.021, head);
  const std::shared_ptr<const ClipVolumes> none = sea.clip_volumes();
  EXPECT_TRUE(none->bodies().empty());
  sea.advance(1.5, head);
  EXPECT_EQ(sea.clip_volumes(), none) << "nothing has changed";
}

// Seas whose bodies differ do not hash alike. Control seen: bodies left out of the hash.
TEST(ActorBodies, CountInTheHash) {
  const auto hash_of = [](const ClipBody& body) {
    Sea sea(spec_with_room());
    sea.add(std::make_shared<Clipper>([=](SeaStep&) { return body; }));
    sea.advance(0.0, head);
    sea.advance(1.0, head);
    return sea.hash();
  };
  const std::uint64_t of_ball = hash_of(ball({0.0, 0.0}));
  EXPECT_EQ(of_ball, hash_of(ball({0.0, 0.0})));
  ClipBody turns = ball({0.0, 0.0});
  turns.spin_rad_s.y = 1.0;
  for (const ClipBody& other : {ball({0.0, 1e-9}), ball({0.0, 0.0}, 2.5), turns}) EXPECT_NE(hash_of(other), of_ball);
}

// Over a jump of time bodies stay as the last step had them, and are not carried on before the next step. Control seen:
// held bodies carried on.
TEST(ActorBodies, StayWhereTheyAreOverAJump) {
  Sea sea(spec_with_room());
  sea.add(std::make_shared<Clipper>([](SeaStep& step) {
    ClipBody body = ball({30.0 * step.time_s, 0.0});
    body.velocity_mps = {600.0, 0.0, 0.0};
    return body;
  }));
  const auto x = [&] { return sea.clip_volumes()->bodies()[0].at_m.x; };
  sea.advance(0.0, head);
  sea.advance(1.0 + 0.5 / 60.0, head);
  EXPECT_NEAR(x(), 35.0, 1e-3);
  for (const double time_s : {100.0, 100.0 + 0.5 / 60.0, 2.0, 2.0 + 0.5 / 60.0}) {
    sea.advance(time_s, head);
    EXPECT_EQ(x(), 30.0) << time_s;
    EXPECT_TRUE(clipped(sea.view_at(time_s, SeaDetail::felt), {30.0, 0.0}));
  }
  sea.advance(2.0 + 1.5 / 60.0, head);
  EXPECT_NEAR(x(), 30.0 * (2.0 + 1.0 / 60.0) + 5.0, 1e-3);
}

// Over a bed the ground is the surface where a body takes the water away, for queries and for what is drawn. Controls
// seen: the scene's volumes alone in the search; the same in at().
TEST(ActorBodies, LieDryOverABed) {
  SeaSpec spec = spec_with_room();
  InputSpec bank;
  bank.to = InputTarget::sea_depth;
  bank.value.x = -3.0f;
  bank.blend = InputBlend::replace;
  bank.shape = AreaInput{.round = true, .at_m = {0.0, 0.0}, .size_m = {200.0, 200.0}};
  spec.place.kinds.push_back(std::make_shared<const Inputs>(InputTarget::sea_depth, std::vector{bank}));
  Sea sea(std::move(spec));
  sea.add(std::make_shared<Clipper>([](SeaStep&) {
    return ClipBody{.form = Form::box, .size_m = {10.0, 20.0, 10.0}};
  }));
  sea.advance(0.0, head);
  sea.advance(1.0, head);
  const SeaView view = sea.view_at(1.0, SeaDetail::felt);
  for (const glm::dvec2 within : {glm::dvec2(0.0), glm::dvec2(2.0, -3.0)}) {
    EXPECT_NEAR(view.query(within).height_m, -3.0, 0.1);
    EXPECT_NEAR(view.at(within, 0.0).displacement.y, -3.0, 0.1);
    EXPECT_GT(view.query(within, {.history = false}).height_m, -1.5);
  }
  EXPECT_GT(view.query({12.0, 0.0}).height_m, -1.5);
}

// Frames in which bodies move, are asked for in steps and by views, and are held by a picture of the frame before,
// allocate nothing. Control seen: volumes made anew for each frame.
TEST(ActorBodies, SteadyFramesAllocateNothing) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "a sanitizer has its own operator new";
  Sea sea(spec_with_room(8));
  for (int i = 0; i < 6; ++i)
    sea.add(std::make_shared<Clipper>([i](SeaStep& step) {
      (void)step.felt().query({4.0 * i, 0.0});
      ClipBody body = moving_at(step.time_s, {.hull = i % 2 - 1});
      body.at_m.z += 20.0 * i;
      return body;
    }));
  SeaView picture;
  std::uint64_t placed = 0, ours = 0;
  for (int i = 0; i <= 40; ++i) {
    const double time_s = i / 72.0;
    const test::AllocationCounter counter;
    sea.advance(time_s, head);
    const SeaView view = sea.view_at(time_s, SeaDetail::felt);
    placed += view.volumes()->bodies().size();
    (void)view.query({1.0, 1.0});
    ours += i < 10 ? 0 : counter.ours();
    picture = view;
  }
  EXPECT_EQ(ours, 0u);
  EXPECT_GT(placed, 6u * 35u);
}

// What cannot be is refused and left out: more bodies than there is room for, a hull that nobody gave, numbers that are
// none or out of range, a scene without clip. Controls seen: hulls' numbers not looked at; nor orientations.
TEST(ActorBodies, RefuseWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<ClipBody> bad(10, ball({0.0, 0.0}));
  bad[0].at_m.x = nan, bad[1].at_m.y = 1e9, bad[2].orientation = {0.0, 0.0, 0.0, 0.0}, bad[3].velocity_mps.z = nan;
  bad[4].spin_rad_s.x = std::numeric_limits<double>::infinity(), bad[5].hull = 1, bad[6].hull = -2;
  bad[7].radius_m = 0.0, bad[8].form = Form::capsule, bad[8].length_m = 1.0;
  bad[9].form = Form::box, bad[9].round_m = 6.0;
  Sea sea(spec_with_room(3));
  std::vector<std::shared_ptr<Clipper>> actors;
  for (const ClipBody& body : bad) actors.push_back(std::make_shared<Clipper>([body](SeaStep&) { return body; }));
  for (int i = 0; i < 4; ++i)
    actors.push_back(std::make_shared<Clipper>([i](SeaStep&) { return ball({9.0 * i, 0.0}); }));
  for (const auto& actor : actors) sea.add(actor);
  sea.advance(0.0, head);
  sea.advance(1.0, head);
  for (std::size_t i = 0; i < actors.size(); ++i) EXPECT_EQ(actors[i]->taken, i >= 10 && i < 13) << i;
  EXPECT_EQ(sea.clip_volumes()->bodies().size(), 3u);

  SeaSpec spec = spec_with_room();
  spec.place.volumes = nullptr;
  Sea without(std::move(spec));
  without.add(actors.back());
  without.advance(0.0, head);
  without.advance(1.0, head);
  EXPECT_FALSE(actors.back()->taken);
  EXPECT_EQ(without.clip_volumes(), nullptr);
}

}  // namespace
}  // namespace seascape
