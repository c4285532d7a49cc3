#include "app/mirror_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <string>

namespace seascape {

namespace {
constexpr ImU32 cpu_colour = IM_COL32(90, 200, 250, 255), gpu_colour = IM_COL32(250, 170, 60, 255),
                period_colour = IM_COL32(230, 70, 70, 255);
}

void MirrorWidgets::note(double cpu_ms, double gpu_ms) {
  cpu_ms_[next_] = float(cpu_ms);
  gpu_ms_[next_] = float(gpu_ms);
  next_ = (next_ + 1) % frames;
}

void MirrorWidgets::draw(const PanelFacts& facts) const {
  const float em = ImGui::GetFontSize(), width = 20.0f * em, graph = 4.0f * em;
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - 0.5f * em, 0.5f * em}, ImGuiCond_Always, {1.0f, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::Begin("mirror", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_AlwaysAutoResize);
  const double hz = facts.period_ms > 0.0 ? 1000.0 / facts.period_ms : 0.0;
  ImGui::Text("headset %s, %.0f Hz, %llu dropped", std::string(facts.state).c_str(), hz,
              static_cast<unsigned long long>(facts.dropped));
  ImGui::Text("%s, %ux%u, scale %.2f", std::string(facts.preset).c_str(), facts.width, facts.height, facts.scale);
  ImGui::TextColored(ImColor(cpu_colour), "CPU %.1f ms", facts.cpu_ms);
  ImGui::SameLine();
  ImGui::TextColored(ImColor(gpu_colour), "GPU %.1f ms", facts.gpu_ms);

  // Twice the period fills the graph, or what frames took where that is more.
  float most = std::max(1.0f, 2.0f * float(facts.period_ms));
  for (const auto* times : {&cpu_ms_, &gpu_ms_}) most = std::max(most, *std::max_element(times->begin(), times->end()));
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto at = [&](std::size_t frame, float ms) {
    return ImVec2(from.x + width * float(frame) / float(frames - 1), from.y + graph * (1.0f - ms / most));
  };
  std::array<ImVec2, frames> line;
  for (const auto& [times, colour] : {std::pair(&cpu_ms_, cpu_colour), std::pair(&gpu_ms_, gpu_colour)}) {
    for (std::size_t i = 0; i < frames; ++i) line[i] = at(i, (*times)[(next_ + i) % frames]);
    list.AddPolyline(line.data(), int(frames), colour, ImDrawFlags_None, 1.5f);
  }
  if (facts.period_ms > 0.0)
    list.AddLine(at(0, float(facts.period_ms)), at(frames - 1, float(facts.period_ms)), period_colour);
  ImGui::Dummy({width, graph});

  // Each stage of the processor's frame as a share of the period.
  const double whole = std::max({facts.period_ms, facts.cpu_ms, 1e-3});
  for (const StageTime& stage : facts.stages) {
    const ImVec2 left = ImGui::GetCursorScreenPos();
    const float bar = width * float(std::clamp(stage.ms / whole, 0.0, 1.0));
    list.AddRectFilled(left, {left.x + bar, left.y + em}, IM_COL32(60, 110, 150, 160));
    ImGui::Text("%-12s %6.2f ms", stage.name, stage.ms);
  }
  ImGui::End();
}

}  // namespace seascape
