// Settings taken while the program runs draw what a fresh start with them draws: what explore's panel promises.
#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "engine/text.h"
#include "ocean/effects.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/gpu/settings_that_act.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

class ExperienceApply : public test::GpuTest {};

// What such a setting does is nothing, as the proofs of effects have it.
bool of_an_absent_effect(const Scene& scene, std::string_view key) {
  const std::string_view group = key.substr(0, key.find('.'));
  const auto names = effect_names();
  return std::find(names.begin(), names.end(), group) != names.end() && !calls_for(scene.effects, group);
}

// Each setting goes to another value and back: all with SEASCAPE_LONG=1, else an eighth of those of the scene's
// effects. Controls: waves.wind_speed_mps without `rebuild` in the table, and an apply that forgets Ocean::apply, each
// fail here.
TEST_F(ExperienceApply, DrawsWhatAFreshStartDraws) {
  const test::ShotOptions common{.scene = "storm",
                                 .preset = "low",
                                 .width = 64,
                                 .height = 48,
                                 .set = {{"waves.resolution", "32"},
                                         {"waves.cascades", "2"},
                                         {"waves.change_s", "0"},
                                         {"msaa", "1"},
                                         {"foam.settle_s", "0.5"}}};
  const Pose head = test::pose({0.0, 9.0, 0.0}, 20.0, -12.0);
  constexpr double time_s = 2.0;
  test::SeaShot live(common);  // goes to each setting and back
  const Image8 plain = live.picture(head, time_s);
  // What there was before the change stays: a jump of the time has foam and spray begin with the new settings.
  const auto begin_anew = [&](std::string_view key) {
    if (key.starts_with("foam.") || key.starts_with("spray.") || key == "waves.resolution" || key == "waves.cascades")
      live.draw(head, time_s + 60.0);
  };
  int changed_pictures = 0, number = 0;
  for (const Setting& row : settings_table()) {
    SCOPED_TRACE(row.key);
    if (std::holds_alternative<TextMember>(row.member)) continue;  // a name has to be of something
    if (!test::long_run() && (of_an_absent_effect(live.scene(), row.key) || number++ % 12 != 0)) continue;
    const std::string before = value_text(live.scene().settings, row),
                      value = test::another(live.scene().settings, row);
    live.set(std::string(row.key), value);
    begin_anew(row.key);
    test::ShotOptions options = common;
    options.set.emplace_back(std::string(row.key), value);
    test::SeaShot fresh(options);
    const Image8 picture = fresh.picture(head, time_s);
    EXPECT_EQ(test::differing_pixels(live.picture(head, time_s), picture), 0) << value;
    live.set(std::string(row.key), before);
    begin_anew(row.key);
    EXPECT_EQ(test::differing_pixels(live.picture(head, time_s), plain), 0) << "and back";
    changed_pictures += test::differing_pixels(picture, plain) > 0;
  }
  EXPECT_GE(changed_pictures, test::long_run() ? 24 : 3);  // else nothing was compared
}

// Rows that the caller of the next frame reads, and not the ocean.
bool of_the_next_frame(std::string_view key) {
  for (const char* begins :
       {"time.", "stereo.", "camera.", "debug.", "comfort.", "mirror.", "headset.", "adaptive.", "waves.change_s"})
    if (key.starts_with(begins)) return true;
  return false;
}

// Rows whose sentences promise no other picture of a sea that goes on, from above: they act at a jump of the time,
// under water, or save time; or a test of their own has the hand or the breath that they need (DiveLight, Breath).
bool leaves_the_picture(std::string_view key) {
  return key == "water.adaptation" || key == "dive_light.held" || key.starts_with("breath.") ||
         key == "foam.settle_s" || key == "dynamic_waves.settle_s" || key == "frame.facing_only";
}

// What a running sea draws a second after a setting has changed, and what it then has of foam and spray; or, with no
// key, what it draws then anyway.
struct Went {
  Image8 picture;
  std::uint64_t before, after;  // hashes of foam, spray and dynamic waves before the change and after it
  std::uint64_t builds;
  std::uint64_t objects;  // made by the change and the frames after it
  std::size_t patches;
};

constexpr std::uint64_t no_hash = 1469598103934665603ull;

std::uint64_t hash_of(Experience& experience) {
  std::uint64_t hash = no_hash;
  const auto take = [&](const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i)
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  };
  if (const DrawnFoam* const foam = experience.ocean().foam()) {
    const LodField<float>& field = foam->sea().foam().field();
    for (int i = 0; i < field.slices(); ++i)
      take(field.texels(i), sizeof(float) * std::size_t(field.side()) * std::size_t(field.side()));
  }
  if (Spray* const spray = experience.ocean().spray())
    for (const Spray::Puff& puff : spray->puffs()) take(&puff.place_m, sizeof puff.place_m);
  if (const DynamicSea* const dynamic = experience.sea()->dynamic_waves())
    for (int i = 0; i < dynamic->waves().levels(); ++i)
      take(dynamic->waves().level(i).modes().data(), dynamic->waves().level(i).modes().size_bytes());
  if (const WakeWindows* const wakes = experience.sea()->wakes())
    for (int window = 0; window < WakeWindows::most; ++window)
      for (int i = 0; wakes->waves(window).active() && i < wakes->waves(window).levels(); ++i)
        take(wakes->waves(window).level(i).modes().data(), wakes->waves(window).level(i).modes().size_bytes());
  return hash;
}

Went run_on(const test::ShotOptions& options, const std::string& key, const std::string& value) {
  test::SeaShot shot(options);
  const Pose head = options.scene == "storm" ? test::pose({0.0, 6.0, 0.0}, 20.0, -18.0) : shot.scene().start;
  for (int n = 0; n < 4; ++n) shot.draw(head, 4.0 + n / 12.0);
  const std::uint64_t objects = shot.device().objects_made();
  const std::uint64_t builds = shot.experience().builds();
  Went went{};
  went.before = hash_of(shot.experience());
  if (!key.empty()) shot.set(key, value);
  went.after = hash_of(shot.experience());
  for (int n = 0; n < 12; ++n) shot.draw(head, 4.5 + n / 12.0);
  went.builds = shot.experience().builds() - builds;
  went.objects = shot.device().objects_made() - objects;
  went.picture = shot.picture(head, 5.5);
  went.patches = shot.experience().ocean().selection()->patches.size();
  return went;
}

// In a storm with foam and spray, or where else a row acts. Controls seen: an Ocean::apply that forgets
// foam_->sea().apply, one that forgets settings_, one that makes its spray anew, an Ocean::takes that is always
// false, and waves of the GPU that are copied anew whenever a source changes.
TEST_F(ExperienceApply, LiveSettingsActAndMakeNoObject) {
  std::map<std::string, Went> plain;  // by the scene
  std::size_t live = 0;
  for (const Setting& row : settings_table()) {
    if (!row.rebuild.empty() || of_the_next_frame(row.key)) continue;
    SCOPED_TRACE(row.key);
    ++live;
    if (!test::sampled(live, 12)) continue;
    test::ShotOptions options = test::where_it_acts(row.key);
    // Half of those with waves of the GPU, which software drivers do not have of themselves.
    const char* where = live / 12 % 2 == 0 ? "gpu" : "cpu";
    options.set.push_back({"waves.where", where});
    const std::string shown = options.scene + std::to_string(options.set.size()) + where;
    if (!plain.contains(shown)) {
      plain[shown] = run_on(options, "", "");
      ASSERT_EQ(plain[shown].objects, 0u);
      if (options.scene == "storm" || options.scene == "rain_pool") {
        ASSERT_NE(plain[shown].after, no_hash) << "no foam, no spray, no dynamic waves";
      }
    }
    Scene scene = test::SeaShot(options).scene();
    const std::string value = test::value_in(scene.settings, row);
    const Went went = run_on(options, std::string(row.key), value);
    EXPECT_EQ(went.builds, 0u);
    EXPECT_EQ(went.objects, 0u);
    EXPECT_EQ(went.before, went.after) << "foam, spray and dynamic waves did not stay as they were";
    ASSERT_FALSE(of_an_absent_effect(scene, row.key)) << "no scene here has it";
    if (!leaves_the_picture(row.key)) {
      EXPECT_TRUE(test::differing_pixels(went.picture, plain[shown].picture) > 0 ||
                  went.patches != plain[shown].patches);
    }
  }
  EXPECT_GE(live, 70u);
}

// Settings of what feeds the sea and of its places, taken as it runs, over a bed too: once what the bed makes of them
// is there, and a jump of the time has had foam and dynamic waves begin anew.
TEST_F(ExperienceApply, SettingsOfTheSeaDrawWhatAFreshStartDraws) {
  std::map<std::string, std::unique_ptr<test::SeaShot>> running;
  std::map<std::string, int> compared;
  double time_s = 2.0;
  int number = 0;
  const auto compare = [&](const Setting& row, const test::ShotOptions& options) {
    SCOPED_TRACE(std::string(row.key) + " in " + options.scene);
    const auto key = options.scene + std::to_string(options.set.size());
    std::unique_ptr<test::SeaShot>& live = running[key];
    if (live == nullptr) live = std::make_unique<test::SeaShot>(options);
    const Pose head = live->scene().start;
    live->draw(head, time_s);
    const std::string before = value_text(live->scene().settings, row),
                      value = test::value_in(live->scene().settings, row);
    const std::uint64_t builds = live->experience().builds();
    const std::shared_ptr<Sea> sea = live->experience().sea();
    const auto settle = [&] {
      for (int n = 0, last = 12; n < last; ++n) {  // a window of places after another
        if (sea->changing()) {
          last = n + 30;  // rows of foam's texels after others
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        live->draw(head, time_s += 0.3);
        ASSERT_LT(n, 500);
      }
      time_s += 60.0;
    };
    live->set(std::string(row.key), value);
    settle();
    test::ShotOptions other = options;
    other.set.emplace_back(std::string(row.key), value);
    test::SeaShot fresh(other);
    const Image8 picture = live->picture(head, time_s);
    EXPECT_EQ(test::differing_pixels(picture, fresh.picture(head, time_s)), 0) << value;
    live->set(std::string(row.key), before);
    settle();
    EXPECT_GT(test::differing_pixels(live->picture(head, time_s), picture), 0) << "and back";
    EXPECT_EQ(live->experience().builds(), builds);
    EXPECT_EQ(live->experience().sea(), sea);
    ++compared[options.scene];
  };
  for (const Setting& row : settings_table()) {
    const std::string_view group = row.key.substr(0, row.key.find('.'));
    const auto is = [&](std::initializer_list<std::string_view> names) {
      return std::find(names.begin(), names.end(), group) != names.end();
    };
    if (!row.rebuild.empty() || row.key == "baked.fade_m" || leaves_the_picture(row.key) ||
        !is({"gerstner", "wave_particles", "dynamic_waves", "level", "flow", "clip", "baked"}))
      continue;
    // A sample of them, and one of each scene.
    const bool alone = row.key == "clip.by_default" || row.key == "baked.scale" || row.key == "level.height_m";
    if (!alone && !test::sampled(number++, 12)) continue;
    test::ShotOptions options = test::where_it_acts(row.key);
    compare(row, options);
    if (is({"level", "flow"})) {
      options.scene = "rivers";
      compare(row, options);
    }
    if (row.key == "gerstner.set1_height_m" || row.key == "gerstner.set2_wavelength_m" || row.key == "level.height_m") {
      options = test::where_it_acts("storm");
      options.scene = "lagoon";
      compare(row, options);
    }
  }
  const std::size_t scenes = compared.size();
  EXPECT_EQ(scenes, 7u) << "gerstner, rain_pool, whirlpool, rivers, lagoon, harbour_clip, baked";
}

// While the sea's time stands still too. Control seen: a DrawnSource::take that leaves uploaded_.
TEST_F(ExperienceApply, SettingsOfTheSeaActWhileTimeStandsStill) {
  for (const char* key : {"gerstner.set1_height_m", "baked.weight", "wave_particles.height_m"}) {
    const test::ShotOptions options = test::where_it_acts(key);
    test::SeaShot shot(options);
    const Pose head = shot.scene().start;
    for (int n = 0; n < 3; ++n) shot.draw(head, 2.0);
    const Image8 before = shot.picture(head, 2.0);
    const std::string now = value_text(shot.scene().settings, *find_setting(key));
    shot.set(key, test::value_in(shot.scene().settings, *find_setting(key)));
    test::ShotOptions other = options;
    other.set.emplace_back(key, value_text(shot.scene().settings, *find_setting(key)));
    const Image8 picture = shot.picture(head, 2.0);
    EXPECT_GT(test::differing_pixels(picture, before), 0) << key;
    EXPECT_EQ(test::differing_pixels(picture, test::SeaShot(other).picture(head, 2.0)), 0) << key;
    shot.set(key, now);
    EXPECT_EQ(test::differing_pixels(shot.picture(head, 2.0), before), 0) << key;
  }
}

// Waves that water does not bear are drawn lower while the sea runs too, and said at the change alone. Controls seen:
// an apply() that changes to the settings' own sea, one that says nothing, and one that says all after each change.
TEST_F(ExperienceApply, SwellSteeperThanWaterBearsIsLimitedAndSaidOnce) {
  std::ostringstream told;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(told);
  sink->set_pattern("%v");
  auto& sinks = spdlog::default_logger()->sinks();
  sinks.push_back(sink);
  test::SeaShot shot({.scene = "open_sea",
                      .width = 32,
                      .height = 24,
                      .set = {{"waves.resolution", "32"}, {"waves.cascades", "2"}, {"waves.swell_period_s", "4"}}});
  const auto said = [&] { return std::exchange(told, std::ostringstream()).str(); };
  shot.draw(shot.scene().start, 2.0);
  EXPECT_EQ(said(), "");
  shot.set("waves.swell_height_m", "15");
  EXPECT_THAT(said(), testing::MatchesRegex("waves.swell_height_m: 15 m is steeper [^\n]*\n"));
  EXPECT_LT(shot.experience().sea()->state().swell_height_m, 2.0);
  shot.set("waves.chop", "0.9");
  shot.set("sky.haze", "3");
  EXPECT_EQ(said(), "");
  shot.set("waves.swell_height_m", "14");
  EXPECT_THAT(said(), testing::HasSubstr("14 m is steeper"));
  std::erase(sinks, sink);
}

// What builds objects anew, and an effect that comes and goes, leaves the foam and the spray that there are. Control
// seen: an Experience::build that hands nothing on.
TEST_F(ExperienceApply, ARebuildAndAToggleLeaveFoamAndSpray) {
  test::SeaShot shot(test::where_it_acts("spray.size"));
  Experience& experience = shot.experience();
  const Pose head = test::pose({0.0, 6.0, 0.0}, 20.0, -18.0);
  const std::vector<std::string> with = shot.scene().effects;
  double time_s = 4.0;
  const auto go_on = [&] {
    for (int n = 0; n < 6; ++n) shot.draw(head, time_s += 1.0 / 24.0);
  };
  go_on();
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, const char*>>{
           {"msaa", "4"}, {"frame.lighting", "forward"}, {"water.anisotropy", "1"}, {"waves.resolution", "64"}}) {
    const std::uint64_t before = hash_of(experience), builds = experience.builds();
    shot.set(key, value);
    ASSERT_GT(experience.builds(), builds) << key;
    EXPECT_EQ(hash_of(experience), before) << key;
    shot.draw(head, time_s);  // what is asked of it again is what it was
    EXPECT_EQ(hash_of(experience), before) << key;
    go_on();
    EXPECT_NE(hash_of(experience), before) << key << ": it stands still";
  }
  const auto without = [&](const char* effect) {
    std::vector<std::string> rest = with;
    std::erase(rest, effect);
    return rest;
  };
  const auto foam = [&] { return experience.ocean().foam()->sea().foam().covered({3.0, -40.0}, 0.0); };
  const float covered = foam();
  ASSERT_GT(covered, 0.0f);
  experience.apply_effects(without("spray"));
  EXPECT_EQ(foam(), covered);
  experience.apply_effects(with);
  EXPECT_EQ(foam(), covered);
  go_on();
  const std::size_t puffs = experience.ocean().spray()->puffs().size();
  ASSERT_GT(puffs, 0u);
  experience.apply_effects(without("foam"));
  EXPECT_EQ(experience.ocean().spray()->puffs().size(), puffs);
}

}  // namespace

}  // namespace seascape
