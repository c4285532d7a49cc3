// The table of settings: ranges, presets, messages. Controls are named beside each test; each was seen to fail.
#include "app/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "app/quality.h"
#include "engine/error.h"
#include "engine/text.h"

namespace seascape {
namespace {

std::string fault_of(std::string_view key, std::string_view value) {
  Settings settings;
  try {
    set_from_text(settings, key, value, "--set", 2);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    return error.what();
  }
  return "";
}

// Control: a row whose range excludes its default (waves.chop from 1.5) fails here.
TEST(Settings, EveryRowIsWholeAndItsDefaultIsInItsRange) {
  std::set<std::string_view> keys;
  const Settings defaults;
  for (const Setting& setting : settings_table()) {
    SCOPED_TRACE(setting.key);
    EXPECT_TRUE(keys.insert(setting.key).second);
    ASSERT_FALSE(setting.sentence.empty());
    EXPECT_EQ(setting.sentence.back(), '.');
    Settings settings;
    EXPECT_NO_THROW(set_value(settings, setting, value_of(defaults, setting), "test"));
    EXPECT_NO_THROW(set_from_text(settings, setting.key, value_text(defaults, setting), "test"));
    EXPECT_EQ(find_setting(setting.key), &setting);
  }
  EXPECT_GE(keys.size(), 40u);
}

// Control: two rows that share one member (sky.haze bound to visibility_m) fail here.
TEST(Settings, EveryRowHasAMemberOfItsOwn) {
  for (const Setting& changed : settings_table()) {
    SCOPED_TRACE(changed.key);
    Settings settings;
    const Settings defaults;
    const SettingValue before = value_of(defaults, changed);
    SettingValue other;
    if (const bool* flag = std::get_if<bool>(&before)) {
      other = !*flag;
    } else if (const auto* name = std::get_if<std::string>(&before)) {
      other = changed.choices.empty()
                  ? "another"
                  : std::string(*name == changed.choices[0] ? changed.choices[1] : changed.choices[0]);
    } else {
      const double number = std::get<double>(before);
      other = number == changed.least ? changed.most : changed.least;
    }
    set_value(settings, changed, other, "test");
    for (const Setting& setting : settings_table())
      EXPECT_EQ(value_of(settings, setting), &setting == &changed ? other : value_of(defaults, setting)) << setting.key;
  }
}

// Control: comparing with > instead of >= at the ends of a range fails here.
// Few enough that what is a number, a distance or a rate is taken as the sea runs. Control seen: spray.seed with a
// reason to rebuild.
TEST(Settings, FewRowsBuildAnew) {
  int anew = 0;
  for (const Setting& row : settings_table()) anew += !row.rebuild.empty() && !row.grows;
  EXPECT_LE(anew, 32);
}

TEST(Settings, BothEndsOfARangeAreAllowedAndNothingBeyond) {
  for (const Setting& setting : settings_table()) {
    if (!setting.choices.empty() || std::holds_alternative<FlagMember>(setting.member) ||
        std::holds_alternative<TextMember>(setting.member))
      continue;
    SCOPED_TRACE(setting.key);
    Settings settings;
    for (const double end : {setting.least, setting.most}) {
      set_value(settings, setting, end, "test");
      EXPECT_EQ(std::get<double>(value_of(settings, setting)), end);
    }
    const Settings before = settings;
    const double infinity = std::numeric_limits<double>::infinity();
    const double wrong[] = {setting.least - 1.0, setting.most + 1.0, infinity, -infinity,
                            std::numeric_limits<double>::quiet_NaN()};
    for (const double value : wrong) EXPECT_THROW(set_value(settings, setting, value, "test"), Error) << value;
    EXPECT_EQ(value_of(settings, setting), value_of(before, setting)) << "a refused value must change nothing";
  }
}

TEST(Settings, MessagesNamePlaceKeyValueRangeAndRemedy) {
  EXPECT_EQ(fault_of("waves.wind_speed_mps", "99"),
            "--set: waves.wind_speed_mps: 99 is out of range; give a number from 0 to 64 m/s");
  EXPECT_EQ(fault_of("waves.wind_speed_mps", "nan"),
            "--set: waves.wind_speed_mps: 'nan' is not a number; give a number from 0 to 64 m/s");
  EXPECT_EQ(fault_of("waves.wind_speed_mps", ""),
            "--set: waves.wind_speed_mps: '' is not a number; give a number from 0 to 64 m/s");
  EXPECT_EQ(fault_of("lod.patch_quads", "48"),
            "--set: lod.patch_quads: 48 is not one of the numbers it takes; give 16, 32 or 64");
  EXPECT_EQ(fault_of("waves.cascades", "2.5"),
            "--set: waves.cascades: 2.5 is not a whole number; give a whole number from 1 to 5");
  EXPECT_EQ(fault_of("waves.half_storage", "1"),
            "--set: waves.half_storage: '1' is neither true nor false; give true or false");
  EXPECT_EQ(fault_of("stereo.mode", "both"),
            "--set: stereo.mode: 'both' is none of its names; give auto, single or per-eye");
  EXPECT_EQ(fault_of("baked.loop", "a\nb"),
            "--set: baked.loop: 'a\\x0ab' is too long or has control characters; give a text of at most 400 bytes "
            "without control characters");
  EXPECT_EQ(fault_of("waves.seed", "-1"),
            "--set: waves.seed: -1 is out of range; give a whole number from 0 to 4294967295");
}

// Control: without the nearest name (did_you_mean returning "") these fail.
TEST(Settings, UnknownKeysNameTheNearest) {
  EXPECT_EQ(
      fault_of("waves.wind_sped_mps", "9"),
      "--set: unknown key 'waves.wind_sped_mps' (did you mean 'waves.wind_speed_mps'?); remove it, or take a key of "
      "docs/settings.md");
  EXPECT_NE(fault_of("wind_speed", "9").find("'waves.wind_speed_mps'"), std::string::npos);
  EXPECT_NE(fault_of("water.wind_speed_mps", "9").find("'waves.wind_speed_mps'"), std::string::npos);
  EXPECT_EQ(fault_of("zzzzzzzzzzzzzz", "9").find("did you mean"), std::string::npos);
  // What is left of a key after its group is too short to say anything. Control: the name's length and the point's
  // place added (tests/mutants).
  EXPECT_EQ(fault_of("zzzzzzzzzzzzzz.mps", "9").find("did you mean"), std::string::npos);
}

TEST(Settings, ValuesReachTheirMembers) {
  Settings settings;
  set_from_text(settings, "waves.wind_speed_mps", "12.5", "test");
  set_from_text(settings, "waves.seed", "4294967295", "test");
  set_from_text(settings, "lod.earth_curvature", "false", "test");
  set_from_text(settings, "stereo.mode", "per-eye", "test");
  set_from_text(settings, "debug.view", "holes", "test");
  set_from_text(settings, "debug.drop_patch", "3", "test");
  EXPECT_EQ(settings.sea.wind_speed_mps, 12.5);
  EXPECT_EQ(settings.sea.seed, 4294967295u);
  EXPECT_FALSE(settings.lod.earth_curvature);
  EXPECT_EQ(settings.render.stereo, StereoMode::per_eye);
  EXPECT_EQ(settings.render.debug, DebugView::holes);
  EXPECT_EQ(settings.lod.drop_patch, 3);
}

// Control: dropping the msaa row from quality.cpp, or flagging waves.chop as quality, fails here.
TEST(Quality, PresetsSetExactlyTheQualitySettings) {
  std::set<std::string_view> of_presets, flagged;
  for (const PresetRow& row : preset_rows()) of_presets.insert(row.key);
  for (const Setting& setting : settings_table())
    if (setting.quality) flagged.insert(setting.key);
  EXPECT_EQ(of_presets, flagged);
  for (const std::string_view preset : preset_names()) {
    Settings settings;
    EXPECT_NO_THROW(apply_preset(settings, preset)) << preset;
  }
}

TEST(Quality, PresetsGrowFromLowToUltra) {
  Settings low, medium, high, ultra;
  apply_preset(low, "low");
  apply_preset(medium, "medium");
  apply_preset(high, "high");
  apply_preset(ultra, "ultra");
  EXPECT_EQ(low.lod.patch_quads, 16);
  EXPECT_EQ(ultra.waves.resolution, 512);
  EXPECT_EQ(low.render.shape, FrameShape::tile);
  EXPECT_EQ(high.render.shape, FrameShape::automatic);
  const Settings* order[] = {&low, &medium, &high, &ultra};
  for (int i = 1; i < 4; ++i) {
    EXPECT_LE(order[i - 1]->waves.resolution, order[i]->waves.resolution);
    EXPECT_LE(order[i - 1]->waves.cascades, order[i]->waves.cascades);
    EXPECT_LE(order[i - 1]->lod.patch_quads, order[i]->lod.patch_quads);
    EXPECT_GE(order[i - 1]->lod.threshold, order[i]->lod.threshold);
    EXPECT_LE(order[i - 1]->water.anisotropy, order[i]->water.anisotropy);
  }
  Settings automatic;
  apply_preset(automatic, "auto");
  EXPECT_EQ(automatic.waves.cascades, high.waves.cascades);
}

TEST(Quality, AutoSuitsTheDeviceAndUnknownNamesAreWrongUsage) {
  EXPECT_EQ(resolve_preset("auto", DeviceClass::software), "medium");
  EXPECT_EQ(resolve_preset("auto", DeviceClass::integrated), "high");
  EXPECT_EQ(resolve_preset("auto", DeviceClass::discrete), "ultra");
  EXPECT_EQ(resolve_preset("low", DeviceClass::discrete), "low");
  // One sample a pixel of any preset for software drivers, unless the scene asks for its own. Control seen: whatever
  // the scene asks for.
  for (const DeviceClass device : {DeviceClass::software, DeviceClass::integrated, DeviceClass::discrete})
    for (const std::string_view preset : preset_names())
      for (const int asked : {2, 4}) {
        Settings settings;
        apply_preset(settings, preset);
        if (asked == 2) settings.render.msaa = 2;
        suit_device(settings, preset, device);
        EXPECT_EQ(settings.render.msaa, device == DeviceClass::software && asked == 4 ? 1 : asked) << preset;
      }
  Settings settings;
  try {
    apply_preset(settings, "hihg");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_STREQ(error.what(),
                 "--preset: unknown preset 'hihg' (did you mean 'high'?); take low, medium, high or ultra, or auto");
  }
}

// Control seen: any of the values instead of all.
TEST(Quality, TellsWhichPresetsHaveValues) {
  EXPECT_EQ(presets_with({{"waves.cascades", "5"}}), "low medium high ultra");
  EXPECT_EQ(presets_with({{"waves.resolution", "256"}, {"waves.half_storage", "true"}}), "low medium");
  EXPECT_EQ(presets_with({{"waves.resolution", "512"}, {"waves.half_storage", "true"}}), "");
}

// Control: std::to_string(double) in text_from fails here.
TEST(Text, NumbersReadBackAsTheSameDouble) {
  for (const double value :
       {0.0, -0.0, 0.1, 1.0 / 3.0, 300000.0, 1e-5, 9.9e-6, 1e15, -1.7976931348623157e308, 5e-324}) {
    const auto back = real_from(text_from(value));
    ASSERT_TRUE(back.has_value()) << text_from(value);
    EXPECT_EQ(*back, value);
  }
  EXPECT_EQ(text_from(300000.0), "300000");
  for (const char* wrong : {"", " 1", "1 ", "1,5", "inf", "nan", "1e999", "0x10", "--1"})
    EXPECT_FALSE(real_from(wrong)) << wrong;
}

// Control: passing control characters through in in_quotes fails here.
TEST(Text, QuotesKeepAMessageOnOneLine) {
  EXPECT_EQ(in_quotes("a\nb\x7f"), "'a\\x0ab\\x7f'");
  EXPECT_EQ(in_quotes("0123456789", 4), "'0123...'");
  EXPECT_EQ(in_quotes("ab\xc3\xa9z", 3), "'ab...'");  // the cut would fall inside an e with an acute accent
}

}  // namespace
}  // namespace seascape
