// Settings taken while the program runs draw what a fresh start with them draws: what explore's panel promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "engine/text.h"
#include "ocean/effects.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

class ExperienceApply : public test::GpuTest {};

// Another value that the row allows, as text.
std::string another(const Settings& settings, const Setting& row) {
  if (std::holds_alternative<FlagMember>(row.member)) return value_text(settings, row) == "true" ? "false" : "true";
  if (!row.choices.empty()) return std::string(row.choices[value_text(settings, row) == row.choices[0] ? 1 : 0]);
  const double now = std::get<double>(value_of(settings, row));
  const double wanted = now == 0.0 ? std::min(2.0, row.most) : now * 0.5 >= row.least ? now * 0.5 : now * 2.0;
  const double value = std::clamp(wanted, row.least, row.most);
  return text_from(std::holds_alternative<RealMember>(row.member) ? value : std::floor(value));
}

// What such a setting does is nothing, as the proofs of effects have it.
bool of_an_absent_effect(const Scene& scene, std::string_view key) {
  const std::string_view group = key.substr(0, key.find('.'));
  const auto names = effect_names();
  return std::find(names.begin(), names.end(), group) != names.end() && !calls_for(scene.effects, group);
}

// Each setting (those of effects that the scene does not have with SEASCAPE_LONG=1) goes to another value and back.
// Controls: waves.wind_speed_mps without `rebuild` in the table, and an apply that forgets Ocean::apply, each fail
// here.
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
  int changed_pictures = 0;
  for (const Setting& row : settings_table()) {
    SCOPED_TRACE(row.key);
    if (std::holds_alternative<TextMember>(row.member)) continue;  // a name has to be of something
    if (std::getenv("SEASCAPE_LONG") == nullptr && of_an_absent_effect(live.scene(), row.key)) continue;
    const std::string before = value_text(live.scene().settings, row), value = another(live.scene().settings, row);
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
  EXPECT_GE(changed_pictures, 25);  // else nothing was compared
}

// Rows that the caller of the next frame reads, and not the ocean.
bool of_the_next_frame(std::string_view key) {
  for (const char* begins : {"time.", "stereo.", "camera.", "debug.", "waves.change_s"})
    if (key.starts_with(begins)) return true;
  return false;
}

// Rows whose sentences promise no other picture of a sea that goes on: they act at a jump of the time, or save time.
bool leaves_the_picture(std::string_view key) { return key == "foam.settle_s" || key == "frame.facing_only"; }

// What a running sea draws a second after a setting has changed, and what it then has of foam and spray; or, with no
// key, what it draws then anyway.
struct Went {
  Image8 picture;
  std::uint64_t before, after;  // hashes of foam and spray before the change and after it
  std::uint64_t builds;
  std::uint64_t objects;  // made by the change and the frames after it
  std::size_t patches;
};

std::uint64_t hash_of(Experience& experience) {
  std::uint64_t hash = 1469598103934665603ull;
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

// In a storm with foam and spray, or in a lagoon for what is of the ground. Controls seen: an Ocean::apply that forgets
// foam_->sea().apply, one that forgets settings_, one that makes its spray anew, and an Ocean::takes that is always
// false.
TEST_F(ExperienceApply, LiveSettingsActAndMakeNoObject) {
  const std::vector<std::pair<std::string, std::string>> small{
      {"waves.resolution", "32"}, {"waves.cascades", "3"}, {"msaa", "1"},        {"foam.simulated", "true"},
      {"foam.resolution", "64"},  {"foam.settle_s", "1"},  {"foam.texel_m", "1"}};
  const test::ShotOptions storm{.scene = "storm", .preset = "low", .width = 64, .height = 48, .set = small},
      lagoon{.scene = "lagoon", .preset = "low", .width = 64, .height = 48, .set = small},
      loop{.scene = "baked", .preset = "low", .width = 64, .height = 48, .set = {{"baked.fade_m", "100"}}};
  test::ShotOptions threshold = storm;
  threshold.set.emplace_back("lod.by", "threshold");
  threshold.set.emplace_back("lod.ocean_size_m", "256");  // doubled as far as the skirt's multiplier says
  const Went plain_storm = run_on(storm, "", ""), plain_lagoon = run_on(lagoon, "", ""),
             plain_threshold = run_on(threshold, "", ""), plain_loop = run_on(loop, "", "");
  ASSERT_EQ(plain_storm.objects, 0u);
  ASSERT_NE(plain_storm.after, std::uint64_t(1469598103934665603ull)) << "no foam, no spray";
  std::size_t live = 0;
  for (const Setting& row : settings_table()) {
    if (!row.rebuild.empty() || of_the_next_frame(row.key)) continue;
    SCOPED_TRACE(row.key);
    ++live;
    const bool ground = row.key.starts_with("sea_depth.") || row.key.starts_with("foam.shore_");
    const bool mesh = row.key.starts_with("lod.") && row.key != "lod.pixel_error" && row.key != "lod.by";
    const bool baked = row.key.starts_with("baked.");
    const test::ShotOptions& options = ground ? lagoon : mesh ? threshold : baked ? loop : storm;
    const Went& plain = ground ? plain_lagoon : mesh ? plain_threshold : baked ? plain_loop : plain_storm;
    Scene scene = test::SeaShot(options).scene();
    const std::string value = row.key == "lod.ocean_size_m"       ? "300"
                              : row.key == "lod.skirt_multiplier" ? "1"
                                                                  : another(scene.settings, row);
    const Went went = run_on(options, std::string(row.key), value);
    EXPECT_EQ(went.builds, 0u);
    EXPECT_EQ(went.objects, 0u);
    EXPECT_EQ(went.before, went.after) << "foam and spray did not stay as they were";
    ASSERT_FALSE(of_an_absent_effect(scene, row.key)) << "no scene here has it";
    if (!leaves_the_picture(row.key)) {
      EXPECT_TRUE(test::differing_pixels(went.picture, plain.picture) > 0 || went.patches != plain.patches);
    }
  }
  EXPECT_GE(live, 30u);
}

// What builds objects anew, and an effect that comes and goes, leaves the foam and the spray that there are. Control
// seen: an Experience::build that hands nothing on.
TEST_F(ExperienceApply, ARebuildAndAToggleLeaveFoamAndSpray) {
  test::SeaShot shot({.scene = "storm",
                      .preset = "low",
                      .width = 64,
                      .height = 48,
                      .set = {{"waves.resolution", "32"},
                              {"waves.cascades", "3"},
                              {"msaa", "1"},
                              {"foam.simulated", "true"},
                              {"foam.resolution", "64"},
                              {"foam.settle_s", "1"}}});
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
