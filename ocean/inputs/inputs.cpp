#include "ocean/inputs/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace seascape {

namespace {
// So many inputs at one place are put in order where they are found; of more, all are gone through.
constexpr std::size_t most_sorted = 48;
// Between inputs values are kept finite and no more; their range holds for what comes of all of them.
constexpr float largest = 1e9f;
}  // namespace

std::unique_ptr<const InputSource> make_input(const InputSpec& spec, std::vector<std::string>& remarks) {
  struct Maker {
    const InputSpec& spec;
    std::vector<std::string>& remarks;
    std::unique_ptr<const InputSource> operator()(const SplineInput&) const { return make_spline(spec, remarks); }
    std::unique_ptr<const InputSource> operator()(const AreaInput&) const { return make_area(spec); }
    std::unique_ptr<const InputSource> operator()(const VortexInput&) const { return make_vortex(spec); }
    std::unique_ptr<const InputSource> operator()(const ShapeInput&) const {
      return is_volume(spec) ? nullptr : make_shape(spec, remarks);
    }
    std::unique_ptr<const InputSource> operator()(const TextureInput&) const { return make_texture(spec); }
    std::unique_ptr<const InputSource> operator()(const TrailInput&) const { return make_trail(spec, remarks); }
    std::unique_ptr<const InputSource> operator()(const VolumeInput&) const { return nullptr; }  // ClipVolumes
  };
  return std::visit(Maker{spec, remarks}, spec.shape);
}

glm::vec4 with_cover(const InputSpec& spec, glm::vec4 value) {
  return spec.to == InputTarget::albedo && spec.blend != InputBlend::scale
             ? glm::vec4(glm::vec3(value) * value.w, value.w)
             : value;
}

glm::vec4 plain_value(const InputSpec& spec, glm::vec4 value) {
  return spec.blend == InputBlend::scale ? glm::vec4(value.x) : with_cover(spec, value);
}

std::vector<std::string> remarks_of(std::span<const InputSpec> specs) {
  std::vector<std::string> remarks;
  for (std::size_t t = 0; t < input_targets.size(); ++t) {
    const auto first =
        std::find_if(specs.begin(), specs.end(), [&](const InputSpec& spec) { return spec.to == InputTarget(t); });
    if (first != specs.end() && !input_targets[t].asked)
      remarks.push_back(fmt::format(
          "{}: the sea of this version takes no inputs of {} yet, and this changes nothing; keep it for a later one",
          first->where, input_targets[t].name));
  }
  for (const InputSpec& spec : specs)
    if (!std::holds_alternative<TextureInput>(spec.shape))
      (void)make_input(spec, remarks);  // of a picture there is always something
  return remarks;
}

Inputs::Inputs(InputTarget to, std::span<const InputSpec> specs, bool (*taken)(const InputSpec&)) : to_(to) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].to == to && !is_volume(specs[i]) && taken(specs[i])) numbers.push_back(i);
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::size_t a, std::size_t b) { return specs[a].order < specs[b].order; });
  std::vector<InputBounds> boxes;
  for (const std::size_t i : numbers) {
    const InputSpec& spec = specs[i];
    validate(spec);
    std::unique_ptr<const InputSource> source = make_input(spec, remarks_);
    if (source == nullptr || float(spec.weight) == 0.0f) continue;
    const InputBounds bounds = source->bounds();
    layers_.push_back({std::move(source), float(spec.weight), spec.blend, spec.follow_waves, bounds});
    boxes.push_back(bounds);
  }
  tree_ = BoundsTree(boxes);
}

bool Inputs::still() const {
  return std::all_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.source->still(); });
}
bool Inputs::follow_waves() const {
  return std::any_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.follow_waves; });
}
bool Inputs::only_add() const {
  return std::all_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.blend == InputBlend::add; });
}

glm::vec4 Inputs::joined(const Layer& layer, const InputSample& sample, glm::vec4 base) const {
  const float m = layer.weight * sample.share;
  const glm::vec4 v = sample.value;
  glm::vec4 result = base;
  switch (layer.blend) {
    case InputBlend::add:
      result = base + m * v;
      break;
    case InputBlend::replace:
      result = to_ == InputTarget::albedo ? base * (1.0f - m * v.w) + m * v : base + m * (v - base);
      break;
    case InputBlend::scale:
      result = base * (1.0f + m * (v - 1.0f));
      break;
    case InputBlend::min:
      result = base + m * (glm::min(base, v) - base);
      break;
    case InputBlend::max:
      result = base + m * (glm::max(base, v) - base);
      break;
  }
  return glm::clamp(result, -largest, largest);
}

glm::vec4 Inputs::value(glm::dvec2 place_m, double footprint_m, double time_s, glm::vec4 base,
                        glm::dvec2 rest_m) const {
  if (layers_.empty() || !std::isfinite(place_m.x + place_m.y + rest_m.x + rest_m.y + time_s)) return base;
  const double footprint = footprint_m > 0.0 ? std::min(footprint_m, 1e7) : 0.0, reach = 0.5 * footprint;
  std::array<std::uint32_t, most_sorted> found;
  std::size_t count = 0;
  const auto find = [&](glm::dvec2 at, bool of_waves) {
    tree_.at(at, reach, [&](std::uint32_t i) {
      if (layers_[i].follow_waves != of_waves) return;
      if (count < most_sorted) found[count] = i;
      ++count;
    });
  };
  if (rest_m == place_m) {
    tree_.at(place_m, reach, [&](std::uint32_t i) {
      if (count < most_sorted) found[count] = i;
      ++count;
    });
  } else {
    find(place_m, false);
    find(rest_m, true);
  }
  if (count == 0) return base;

  glm::vec4 result = base;
  bool touched = false;
  const auto join = [&](const Layer& layer) {
    const InputSample sample = layer.source->sample(layer.follow_waves ? rest_m : place_m, footprint, time_s);
    if (!(sample.share > 0.0f)) return;
    result = joined(layer, sample, result);
    touched = true;
  };
  if (count <= most_sorted) {
    std::sort(found.begin(), found.begin() + std::ptrdiff_t(count));
    for (std::size_t i = 0; i < count; ++i) join(layers_[found[i]]);
  } else {
    for (const Layer& layer : layers_)
      if (layer.bounds.holds(layer.follow_waves ? rest_m : place_m, reach)) join(layer);
  }
  if (!touched) return base;
  const InputTargetTraits& target = traits(to_);
  for (int c = 0; c < 4; ++c)
    result[c] = c < target.channels ? glm::clamp(result[c], float(target.least), float(target.most)) : base[c];
  return result;
}

}  // namespace seascape
