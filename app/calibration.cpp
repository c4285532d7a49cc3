#include "app/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/quality.h"

namespace seascape {

namespace {

constexpr int version = 1;  // of what is kept: another is measured anew

bool fits(const std::optional<FrameCost>& cost, const FrameGoal& goal) {
  return cost && cost->at(goal.megapixels) <= share_of_period * goal.period_ms;
}

std::string file_name(const CalibratedDevice& device) {
  const std::string text = device.device + "\n" + device.driver;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  return fmt::format("calibration_{}_{:016x}", version, hash_bytes({bytes, text.size()}));
}

}  // namespace

FrameCost cost_through(double megapixels, double ms, double more_megapixels, double more_ms) {
  if (!(more_megapixels > megapixels)) return {more_ms, 0.0};  // a pixel has no half
  const double slope = std::max((more_ms - ms) / (more_megapixels - megapixels), 0.0);
  const double fixed = more_ms - slope * more_megapixels;
  if (fixed >= 0.0) return {fixed, slope};
  return {0.0, more_ms / more_megapixels};  // the larger picture is the better measure
}

AutoStep auto_step(const Calibration& known, std::size_t first, const FrameGoal& goal) {
  std::size_t preset = first;
  const std::size_t last = known.presets.size() - 1;
  for (;;) {
    if (!known.presets[preset]) return {preset, true};
    if (fits(known.presets[preset], goal)) {
      if (preset == last) return {preset, false};
      ++preset;
    } else {
      if (preset <= 1) return {0, false};  // nothing is below low, whatever it takes
      --preset;
      if (fits(known.presets[preset], goal)) return {preset, false};
    }
  }
}

std::size_t auto_choice(const Calibration& known, const FrameGoal& goal) {
  for (std::size_t preset = known.presets.size(); preset-- > 0;)
    if (fits(known.presets[preset], goal)) return preset;
  return 0;
}

void remember(const DiskCache& cache, const CalibratedDevice& device, const Calibration& known) {
  nlohmann::json json = {{"device", device.device}, {"driver", device.driver}};
  for (std::size_t p = 0; p < known.presets.size(); ++p)
    if (const auto& cost = known.presets[p])
      json["presets"][std::string(preset_names()[p])] = {{"fixed_ms", cost->fixed_ms},
                                                         {"ms_a_megapixel", cost->ms_a_megapixel}};
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  cache.write(file_name(device), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Calibration remembered(const DiskCache& cache, const CalibratedDevice& device) {
  Calibration known;
  const auto bytes = cache.read(file_name(device));
  if (!bytes) return known;
  const nlohmann::json json = nlohmann::json::parse(bytes->begin(), bytes->end(), nullptr, false);
  if (!json.is_object() || json.value("device", nlohmann::json()) != device.device ||
      json.value("driver", nlohmann::json()) != device.driver)
    return known;
  for (std::size_t p = 0; p < known.presets.size(); ++p) {
    const auto number = [&](const char* name) {
      const nlohmann::json::json_pointer at(fmt::format("/presets/{}/{}", preset_names()[p], name));
      if (!json.contains(at) || !json.at(at).is_number()) return std::nan("");
      return json.at(at).get<double>();
    };
    const FrameCost cost{number("fixed_ms"), number("ms_a_megapixel")};
    if (cost.fixed_ms >= 0.0 && cost.ms_a_megapixel >= 0.0 && std::isfinite(cost.fixed_ms + cost.ms_a_megapixel))
      known.presets[p] = cost;
  }
  return known;
}

std::string calibration_text(const Calibration& known) {
  std::string text;
  for (std::size_t p = 0; p < known.presets.size(); ++p)
    if (const auto& cost = known.presets[p])
      text += fmt::format("{}{} {:.2f} ms and {:.2f} ms a megapixel", text.empty() ? "" : ", ", preset_names()[p],
                          cost->fixed_ms, cost->ms_a_megapixel);
  return text.empty() ? "not measured" : text;
}

}  // namespace seascape
