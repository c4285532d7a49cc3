// The panel under a mouse that tries every place of it; needs ImGui, but no device. Controls are named beside each
// test; each was seen to fail.
#include "app/panel.h"
#include "ocean/effects.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <map>
#include <string>

namespace seascape {
namespace {

class PanelUnderTheMouse : public testing::Test {
 protected:
  PanelUnderTheMouse() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1280.0f, 7600.0f};  // tall enough for all rows
    io.DeltaTime = 1.0f / 60.0f;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    facts_.title = "A sea";
    facts_.scene = "calm";
    facts_.preset = "high";
    frame(-1.0f, -1.0f, false);
  }
  ~PanelUnderTheMouse() override { ImGui::DestroyContext(); }

  PanelWish frame(float x, float y, bool down, const std::function<void()>& before = {}) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {x, y};
    io.MouseDown[0] = down;
    ImGui::NewFrame();
    if (before) before();
    PanelWish wish = panel_.draw(settings_, settings_, facts_);
    ImGui::Render();
    return wish;
  }
  void open_all() {
    frame(-1.0f, -1.0f, false, [] {
      ImGui::Begin("Seascape");
      for (const char* title :
           {"Waves",     "Gerstner", "Wave particles", "Dynamic waves", "Foam",       "Spray",           "Level",
            "Sea depth", "Flow",     "Clip",           "Place",         "Baked",      "Level of detail", "Water",
            "Sky",       "Frame",    "Stereo",         "Camera",        "Comfort",    "Headset",         "Mirror",
            "Time",      "Debug",    "Models",         "Wakes",         "Dive light", "Breath",          "Adaptive"})
        ImGui::GetStateStorage()->SetInt(ImGui::GetID(title), 1);
      ImGui::End();
    });
    for (int i = 0; i < 2; ++i) frame(-1.0f, -1.0f, false);
  }
  // `told` hears every wish with the button's state.
  using Told = std::function<void(const PanelWish&, bool down)>;
  // Presses, drags a little and lets go.
  void drag(float x, float y, float by, const Told& told) {
    frame(x, y, false);
    for (int i = 0; i < 2; ++i) told(frame(x + by * float(i), y, true), true);
    for (int i = 0; i < 2; ++i) told(frame(x + by, y, false), false);
  }
  // Drags and clicks at each place of a column, `step` pixels apart; a list that opens is asked for
  // several of its items, and closed.
  void try_column(float x, float by, float lowest, const Told& told, float step = 9.0f) {
    for (float y = 5.0f; y < lowest; y += step)
      for (const float item : {20.0f, 34.0f, 60.0f}) {
        open_all();  // a click on a header closes its group
        drag(x, y, by, told);
        if (by != 0.0f) break;
        drag(x, y + item, 0.0f, told);
        drag(1200.0f, 5.0f, 0.0f, told);
      }
  }

  Panel panel_;
  Settings settings_;
  PanelFacts facts_;
};

// Controls: a group left out of the loop, an edit_row that passes over flags, and a rebuild row that is handed out at
// once (without `edit.settled || row.rebuild.empty()`) each fail here; so does a slider of whole numbers with 0 to 100
// for all.
TEST_F(PanelUnderTheMouse, ChangesEverySettingWithinItsRangeAndWaitsForTheMouseToLetGo) {
  std::map<std::string, int> changed;
  const auto told = [&](const PanelWish& wish, bool down) {
    if (!wish.settings) return;
    for (const Setting& row : settings_table()) {
      const SettingValue value = value_of(*wish.settings, row);
      if (value == value_of(settings_, row)) continue;
      ++changed[std::string(row.key)];
      Settings scratch;
      EXPECT_NO_THROW(set_value(scratch, row, value, "the panel")) << row.key;
      EXPECT_FALSE(down && !row.rebuild.empty()) << row.key;
    }
  };
  constexpr float lowest = 7000.0f, step = 17.0f;  // a row is 19 pixels high
  try_column(290.0f, 40.0f, lowest, told, step);   // sliders
  try_column(200.0f, 0.0f, lowest, told, step);    // boxes and lists
  try_column(373.0f, 0.0f, lowest, told, step);    // the steps beside a number that is typed
  for (const Setting& row : settings_table())
    EXPECT_TRUE(changed.count(std::string(row.key)) || std::holds_alternative<TextMember>(row.member))
        << row.key;  // what is typed
}

// Control: a button without its wish fails here.
TEST_F(PanelUnderTheMouse, HasButtonsAndLists) {
  bool paused = false, photographed = false, recorded = false, preset = false, travel = false, scrubbed = false;
  for (float x = 20.0f; x < 260.0f; x += 25.0f)
    try_column(x, 0.0f, 150.0f, [&](const PanelWish& wish, bool) {
      paused |= wish.pause;
      photographed |= wish.screenshot;
      recorded |= wish.record;
      preset |= wish.preset.has_value();
      travel |= wish.travel.has_value();
      scrubbed |= wish.sea_time_s.has_value();
    });
  EXPECT_TRUE(paused);
  EXPECT_TRUE(photographed);
  EXPECT_TRUE(recorded);
  EXPECT_TRUE(preset);
  EXPECT_TRUE(travel);
  for (float y = 5.0f; y < 400.0f && !scrubbed; y += 5.0f)
    drag(120.0f, y, 60.0f, [&](const PanelWish& wish, bool) { scrubbed |= wish.sea_time_s.has_value(); });
  EXPECT_TRUE(scrubbed);
}

// Control: draw() without its look at `visible` fails here.
TEST_F(PanelUnderTheMouse, IsNotThereWhenHidden) {
  panel_.visible = false;
  frame(100.0f, 100.0f, false);
  frame(100.0f, 100.0f, false);
  EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse);
  panel_.visible = true;
  frame(100.0f, 100.0f, false);
  frame(100.0f, 100.0f, false);
  EXPECT_TRUE(ImGui::GetIO().WantCaptureMouse);
}

// A box for each effect that is built but the waves; a click asks for the scene's effects with it, or without. Control
// seen: the box taken for its opposite.
TEST_F(PanelUnderTheMouse, SwitchesEffects) {
  const std::vector<std::string> now{"waves", "foam"};
  facts_.effects = now;
  for (int i = 0; i < 3; ++i) frame(-1.0f, -1.0f, false);
  std::map<std::string, int> asked;
  for (float y = 40.0f; y < 320.0f; y += 6.0f)
    for (float x = 10.0f; x < 420.0f; x += 6.0f) {
      frame(x, y, false);
      frame(x, y, true);
      const PanelWish wish = frame(x, y, false);
      frame(-1.0f, -1.0f, false);
      if (!wish.effects) continue;
      std::string list;
      for (const std::string& name : *wish.effects) list += name + " ";
      ++asked[list];
    }
  std::size_t built = 0;
  for (const std::string_view name : effect_names()) built += effect_is_built(name) && name != "waves";
  EXPECT_EQ(asked.size(), built);
  EXPECT_GT(asked["waves foam gerstner "], 0);
  EXPECT_GT(asked["waves foam baked "], 0);
  EXPECT_GT(asked["waves "], 0) << "foam off";
  EXPECT_GT(asked["waves foam wave_particles "], 0);
}

}  // namespace
}  // namespace seascape
