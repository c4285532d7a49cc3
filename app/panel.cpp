#include "app/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/quality.h"
#include "engine/text.h"
#include "ocean/effects.h"

namespace seascape {

namespace {

constexpr std::array<const char*, 2> keys[] = {
    {"W A S D", "move"},
    {"E Q", "up and down, when flying"},
    {"right mouse button", "look around while it is held"},
    {"Tab", "look around without it, on and off"},
    {"arrows", "turn, look up and down"},
    {"Z X", "turn by 30 degrees at once"},
    {"T", "aim while it is held; letting go moves there over the water"},
    {"F", "swim ahead while it is held"},
    {"Shift", "faster"},
    {"wheel", "change the speed"},
    {"1 2 3", "fly, walk at deck height, ride the waves"},
    {"Space", "stop and start the sea's time"},
    {"[ ]", "slower and faster time"},
    {", .", "a second back and on in the sea's time; ten with Shift"},
    {"V", "next debug view"},
    {"P or F2", "screenshot"},
    {"R", "start and end recording a camera path"},
    {"B", "board a boat, or step off"},
    {"Y, I", "aboard: make fast or cast off; anchor or weigh"},
    {"Backspace", "put the boat back where it began"},
    {"K", "what makes moving gentler in a headset, on and off"},
    {"C", "in a headset: what lies ahead becomes forward"},
    {"F1", "this panel on and off"},
    {"Esc", "free the mouse, then close"},
};

std::string_view group_of(std::string_view key) {
  const std::size_t point = key.find('.');
  return point == std::string_view::npos ? "frame" : key.substr(0, point);
}

std::string group_title(std::string_view group) {
  if (group == "lod") return "Level of detail";
  std::string title(group);
  std::replace(title.begin(), title.end(), '_', ' ');
  title[0] = char(title[0] - 'a' + 'A');
  return title;
}

// "waves.wind_speed_mps" is "wind speed" beside a widget that shows the unit.
std::string label_of(const Setting& setting) {
  std::string_view name = setting.key.substr(std::min(setting.key.size(), setting.key.find('.') + 1));
  if (!setting.unit.empty())
    for (const std::string_view unit : {"_mps2", "_mps", "_mg_m3", "_deg", "_ev", "_m", "_s"})
      if (name.ends_with(unit)) {
        name.remove_suffix(unit.size());
        break;
      }
  std::string label(name);
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

struct Edit {
  bool changed = false;  // the value differs from before
  bool settled = true;   // and nobody is dragging or typing any more
};

// One of several names. The list is open for one frame at least, so a choice is settled at once.
Edit pick(const char* id, const std::string& current, std::span<const std::string_view> choices, std::string& chosen) {
  Edit edit;
  if (!ImGui::BeginCombo(id, current.c_str())) return edit;
  for (const std::string_view choice : choices) {
    const std::string name(choice);
    if (ImGui::Selectable(name.c_str(), name == current) && name != current) {
      chosen = name;
      edit.changed = true;
    }
  }
  ImGui::EndCombo();
  return edit;
}

// The scalar under the pointer or the keyboard, told when it has come to rest.
Edit scalar_state(bool changed) { return {changed || ImGui::IsItemDeactivatedAfterEdit(), !ImGui::IsItemActive()}; }

Edit edit_row(Settings& settings, const Setting& row) {
  const std::string id = "##" + std::string(row.key);
  if (!row.choices.empty()) {
    std::string chosen;
    const Edit edit = pick(id.c_str(), value_text(settings, row), row.choices, chosen);
    if (edit.changed) set_from_text(settings, row.key, chosen, "the panel");
    return edit;
  }
  if (const auto* flag = std::get_if<FlagMember>(&row.member))
    return {ImGui::Checkbox(id.c_str(), &(*flag)(settings)), true};
  if (const auto* seed = std::get_if<SeedMember>(&row.member)) {
    const std::uint32_t one = 1;
    return scalar_state(ImGui::InputScalar(id.c_str(), ImGuiDataType_U32, &(*seed)(settings), &one));
  }
  if (const auto* whole = std::get_if<IntegerMember>(&row.member))
    return scalar_state(ImGui::SliderInt(id.c_str(), &(*whole)(settings), int(row.least), int(row.most), "%d",
                                         ImGuiSliderFlags_AlwaysClamp));
  if (const auto* text = std::get_if<TextMember>(&row.member)) {
    std::array<char, 401> bytes{};
    std::string& value = (*text)(settings);
    std::copy_n(value.begin(), std::min(value.size(), bytes.size() - 1), bytes.begin());
    const bool changed = ImGui::InputText(id.c_str(), bytes.data(), bytes.size());
    value = bytes.data();
    return scalar_state(changed);
  }
  double& value = std::get<RealMember>(row.member)(settings);
  const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
  if (row.least < -1e6) {  // no slider can set this
    const bool changed = ImGui::InputDouble(id.c_str(), &value, 1.0, 60.0, ("%.1f" + unit).c_str());
    value = std::clamp(value, row.least, row.most);
    return scalar_state(changed);
  }
  const bool wide = row.least >= 0.0 && row.most > 1000.0 * std::max(row.least, 1.0);
  const bool small = !wide && row.most - row.least <= 20.0;
  const std::string format = (wide              ? (row.least > 0.0 && row.least < 1.0 ? "%.3g" : "%.0f")
                              : row.most <= 0.5 ? "%.3f"
                              : small           ? "%.2f"
                                                : "%.1f") +
                             unit;
  const bool logarithmic = wide || (row.least > 0.0 && row.most / row.least >= 100.0);
  return scalar_state(
      ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &row.least, &row.most, format.c_str(),
                          ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0)));
}

void tooltip(const Setting& row) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
  ImGui::TextUnformatted(std::string(row.sentence).c_str());
  ImGui::TextDisabled("%s", (std::string(row.key) + ": " + range_text(row)).c_str());
  if (row.grows)
    ImGui::TextDisabled("A change comes over the sea within waves.change_s.");
  else if (!row.rebuild.empty())
    ImGui::TextDisabled("A change takes a moment: %s.", std::string(row.rebuild).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool preset_holds(const Settings& settings, std::string_view preset, DeviceClass device) {
  Settings fresh = settings;
  apply_preset(fresh, preset);
  suit_device(fresh, preset, device);
  for (const PresetRow& row : preset_rows())
    if (const Setting* setting = find_setting(row.key); value_of(settings, *setting) != value_of(fresh, *setting))
      return false;
  return true;
}

}  // namespace

std::span<const std::array<const char*, 2>> key_help() { return keys; }

void Panel::draw_head(const Settings& settings, const PanelFacts& facts, PanelWish& wish) {
  ImGui::TextWrapped("%s", std::string(facts.title).c_str());
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 5.0f);
  std::string chosen;
  const std::vector<std::string_view> scenes(facts.scenes.begin(), facts.scenes.end());
  if (pick("scene", std::string(facts.scene), scenes, chosen).changed) wish.scene = chosen;
  // The preset whose values are all in force, if there is one.
  const auto holds = std::find_if(preset_names().begin(), preset_names().end(), [&](std::string_view name) {
    return preset_holds(settings, name, facts.device_class);
  });
  const std::string preset =
      holds == preset_names().end() ? std::string(facts.preset) + ", changed" : std::string(*holds);
  if (pick("quality", preset, preset_names(), chosen).changed) wish.preset = chosen;
  constexpr std::string_view travels[] = {"fly", "walk at deck height", "ride the waves"};
  if (pick("travel", travel_name(facts.travel), travels, chosen).changed)
    wish.travel = Travel(std::find(std::begin(travels), std::end(travels), chosen) - std::begin(travels));
  ImGui::PopItemWidth();
  bool first = true;
  for (const std::string_view name : effect_names()) {
    if (!effect_is_built(name) || name == "waves") continue;  // the sea is made of waves
    std::string label(name);
    std::replace(label.begin(), label.end(), '_', ' ');
    if (!std::exchange(first, false)) {
      ImGui::SameLine();
      if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(label.c_str()).x + 2.0f * ImGui::GetFrameHeight())
        ImGui::NewLine();
    }
    const auto at = std::find(facts.effects.begin(), facts.effects.end(), name);
    bool on = at != facts.effects.end();
    if (!ImGui::Checkbox(label.c_str(), &on)) continue;
    wish.effects.emplace(facts.effects.begin(), facts.effects.end());
    if (on)
      wish.effects->emplace_back(name);
    else
      wish.effects->erase(wish.effects->begin() + (at - facts.effects.begin()));
  }
  if (ImGui::Button(facts.paused ? "Run" : "Pause")) wish.pause = true;
  ImGui::SameLine();
  if (ImGui::Button("Screenshot")) wish.screenshot = true;
  if (ImGui::GetWindowWidth() > ImGui::GetFontSize() * 22.0f) ImGui::SameLine();
  if (ImGui::Button(facts.recording ? fmt::format("End path ({:.1f} s)###record", facts.recorded_s).c_str()
                                    : "Record path###record"))
    wish.record = true;
  if (facts.aboard) {
    if (ImGui::Button(facts.moored ? "Cast off###moor" : "Moor###moor")) wish.moor = true;
    ImGui::SameLine();
    if (ImGui::Button(facts.anchored ? "Weigh anchor###anchor" : "Anchor###anchor")) wish.anchor = true;
    ImGui::SameLine();
    if (ImGui::Button("Put back")) wish.respawn = true;
  }
  double time_s = facts.sea_time_s;
  ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 5.0f);
  if (ImGui::DragScalar("sea time", ImGuiDataType_Double, &time_s, 0.05f, nullptr, nullptr, "%.1f s"))
    wish.sea_time_s = std::clamp(time_s, -1e10, 1e10);
  ImGui::TextWrapped("time x %.3g   speed %.1f m/s", facts.paused ? 0.0 : settings.time_scale, facts.speed_mps);
}

void Panel::draw_times(const PanelFacts& facts) {
  history_ms_[std::size_t(history_at_)] = float(facts.frame_ms);
  history_at_ = (history_at_ + 1) % int(history_ms_.size());
  if (!ImGui::CollapsingHeader("Frame times", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const float most = *std::max_element(history_ms_.begin(), history_ms_.end());
  ImGui::PlotLines("##history", history_ms_.data(), int(history_ms_.size()), history_at_, nullptr, 0.0f, most * 1.1f,
                   {ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 2.5f});
  ImGui::TextWrapped("%.1f ms a frame (%.0f a second)", facts.frame_ms,
                     facts.frame_ms > 0.0 ? 1000.0 / facts.frame_ms : 0.0);
  ImGui::TextWrapped("CPU %.2f ms   GPU %.2f ms", facts.cpu_ms, facts.gpu_ms);
  if (!facts.quality.empty()) ImGui::TextWrapped("%s", facts.quality.c_str());
  const auto table = [](const char* title, const auto& times) {
    if (times.empty() || !ImGui::BeginTable(title, 2)) return;
    for (const auto& time : times) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(time.name);
      ImGui::TableNextColumn();
      ImGui::Text("%.3f ms", time.ms);
    }
    ImGui::EndTable();
  };
  table("stages", facts.stages);
  ImGui::Separator();
  table("passes", facts.passes);
  ImGui::Separator();
  ImGui::TextWrapped("%llu draws, %llu triangles, %zu patches", static_cast<unsigned long long>(facts.counts.draws),
                     static_cast<unsigned long long>(facts.counts.triangles), facts.patches);
  ImGui::TextWrapped(
      "%llu dispatches, %llu barriers, %llu commands", static_cast<unsigned long long>(facts.counts.dispatches),
      static_cast<unsigned long long>(facts.counts.barriers), static_cast<unsigned long long>(facts.counts.commands));
  ImGui::TextWrapped("%ux%u, %d view%s, %s", facts.width, facts.height, facts.views, facts.views == 1 ? "" : "s",
                     std::string(facts.device).c_str());
}

void Panel::draw_presets(const PanelFacts& facts) {
  if (!ImGui::CollapsingHeader("Presets")) return;
  // What is told above its values: beside them a panel has no room for it.
  const auto row = [](const auto& values) {
    const float wide = ImGui::GetContentRegionAvail().x, left = ImGui::GetCursorPosX();
    for (std::size_t p = 0; p < preset_names().size(); ++p) {
      if (p > 0) ImGui::SameLine(left + wide * float(p) / float(preset_names().size()));
      ImGui::TextUnformatted(values[p].data(), values[p].data() + values[p].size());
    }
  };
  const auto tell = [&](const std::vector<PresetLine>& lines) {
    for (const PresetLine& line : lines) {
      ImGui::TextDisabled("%s", line.what.c_str());
      row(line.of);
    }
  };
  row(preset_names());
  ImGui::Separator();
  tell(setting_lines());
  ImGui::Separator();
  if (facts.costs == nullptr) {
    ImGui::TextWrapped("no costs are known of this scene: seascape plan --presets measures them");
    return;
  }
  ImGui::TextWrapped("%s", measured_how(*facts.costs).c_str());
  tell(cost_lines(*facts.costs));
}

// Returns whether the edited settings are to be taken now.
bool Panel::draw_rows(const Settings& initial) {
  bool take = false;
  dragging_ = false;
  std::string_view group;
  bool open = false;
  for (const Setting& row : settings_table()) {
    if (group_of(row.key) != group) {
      if (open) ImGui::EndTable();
      group = group_of(row.key);
      open = ImGui::CollapsingHeader(group_title(group).c_str(),
                                     group == "waves" || group == "sky" ? ImGuiTreeNodeFlags_DefaultOpen : 0) &&
             ImGui::BeginTable(std::string(group).c_str(), 2);
      if (open) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.48f);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.52f);
      }
    }
    if (!open) continue;
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label_of(row).c_str());
    tooltip(row);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    const Edit edit = edit_row(edited_, row);
    tooltip(row);
    if (!edit.settled) dragging_ = true;
    if (edit.changed && (edit.settled || row.rebuild.empty())) take = true;
    if (ImGui::BeginPopupContextItem(("back##" + std::string(row.key)).c_str())) {
      if (ImGui::Selectable(("Back to " + value_text(initial, row)).c_str())) {
        set_value(edited_, row, value_of(initial, row), "the panel");
        take = true;
      }
      ImGui::EndPopup();
    }
  }
  if (open) ImGui::EndTable();
  return take;
}

PanelWish Panel::draw(const Settings& settings, const Settings& initial, const PanelFacts& facts) {
  PanelWish wish;
  if (!visible) return wish;
  if (!dragging_) edited_ = settings;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  const float beside = std::min(std::max(window.x * 0.45f, 200.0f), ImGui::GetFontSize() * 30.0f);
  ImGui::SetNextWindowSize({alone ? window.x : beside, window.y});
  if (alone) ImGui::SetNextWindowBgAlpha(1.0f);
  ImGui::Begin(
      "Seascape", nullptr,
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar);
  draw_head(settings, facts, wish);
  draw_times(facts);
  draw_presets(facts);
  if (draw_rows(initial)) wish.settings = edited_;
  if (ImGui::CollapsingHeader("Keys") && ImGui::BeginTable("keys", 2)) {
    for (const auto& [key, what] : keys) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key);
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
  return wish;
}

void Panel::draw_message(std::string_view message) {
  if (message.empty()) return;
  const std::string text(message);
  const ImVec2 window = ImGui::GetIO().DisplaySize, padding = ImGui::GetStyle().WindowPadding;
  const float width = std::min(ImGui::CalcTextSize(text.c_str()).x, window.x * 0.9f);
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
  ImGui::SetNextWindowPos({window.x * 0.98f, window.y * 0.97f}, ImGuiCond_Always, {1.0f, 1.0f});
  ImGui::SetNextWindowSize({width + 2.0f * padding.x, height + 2.0f * padding.y});
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(padding.x + width + 1.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace seascape
