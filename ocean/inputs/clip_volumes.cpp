#include "ocean/inputs/clip_volumes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/error.h"
#include "ocean/inputs/hull_check.h"

namespace seascape {

namespace {

// Own axes in the world, as columns (VolumeInput): rolled, pitched, turned.
glm::dmat3 turned(double turn_deg, double pitch_deg, double roll_deg) {
  const auto cs = [](double deg) { return glm::dvec2(std::cos(glm::radians(deg)), std::sin(glm::radians(deg))); };
  const glm::dvec2 t = cs(turn_deg), p = cs(pitch_deg), r = cs(roll_deg);
  const glm::dmat3 roll({r.x, -r.y, 0.0}, {r.y, r.x, 0.0}, {0.0, 0.0, 1.0});
  const glm::dmat3 pitch({1.0, 0.0, 0.0}, {0.0, p.x, p.y}, {0.0, -p.y, p.x});
  const glm::dmat3 turn({t.x, 0.0, t.y}, {0.0, 1.0, 0.0}, {-t.y, 0.0, t.x});
  return turn * pitch * roll;
}

// Far off every volume and still a whole number that an int holds.
int cell(double metres) { return int(std::clamp(std::floor(metres), -2e9, 2e9)); }

}  // namespace

ClipVolumes::ClipVolumes(std::span<const InputSpec> specs) {
  std::vector<const InputSpec*> sorted;
  for (const InputSpec& spec : specs)
    if (is_volume(spec)) sorted.push_back(&spec);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const InputSpec* a, const InputSpec* b) { return a->order < b->order; });
  std::vector<const Model*> models;
  for (const InputSpec* spec : sorted) {
    validate(*spec);
    add(*spec, models);
  }
  std::vector<std::uint32_t> numbers(volumes_.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  if (!numbers.empty()) add_nodes(numbers);
}

void ClipVolumes::add(const InputSpec& spec, std::vector<const Model*>& models) {
  gpu::ClipVolume v{};
  glm::dmat3 axes(1.0);
  glm::dvec3 middle(0.0), half(0.0);  // half its box's sides in its own axes
  glm::vec3 measures(0.0f);
  if (const ShapeInput* shape = std::get_if<ShapeInput>(&spec.shape)) {
    auto model = std::find(models.begin(), models.end(), shape->model.get());
    if (model == models.end()) {
      if (models.size() == most_input_hulls)
        throw Error(spec.where, "file: more than " + std::to_string(most_input_hulls) + " different models as hulls",
                    "place the same ones more often");
      validate_hull(spec);
      hulls_.push_back(make_hull_map(*shape->model));
      model = models.insert(models.end(), shape->model.get());
    }
    const HullMap& hull = hulls_[std::size_t(model - models.begin())];
    axes = turned(shape->turn_deg, shape->pitch_deg, shape->roll_deg);
    middle = glm::dvec3(shape->at_m.x, shape->at_height_m, shape->at_m.y) + axes * (shape->scale * hull.middle_m);
    const double wide =
        shape->scale * hull.texel_m * (0.5 * gpu::clip_hull_texels - double(gpu::clip_hull_margin) + 1.0);
    half = {wide, shape->scale * hull.half_height_m, wide};
    measures = {float(shape->scale * hull.texel_m), float(half.y), 0.0f};
    v.middle.z = gpu::clip_hull;
    v.middle.w = int(model - models.begin());
  } else {
    const VolumeInput& body = std::get<VolumeInput>(spec.shape);
    using Form = VolumeInput::Form;
    axes = turned(body.turn_deg, body.pitch_deg, body.roll_deg);
    middle = body.at_m;
    const double length = 0.5 * body.length_m, edge = body.form == Form::box        ? body.round_m
                                                      : body.form == Form::cylinder ? 0.0
                                                                                    : body.radius_m;
    half = body.form == Form::box      ? 0.5 * body.size_m
           : body.form == Form::sphere ? glm::dvec3(body.radius_m)
                                       : glm::dvec3(body.radius_m, length, body.radius_m);
    measures = body.form == Form::cylinder ? glm::vec3(float(body.radius_m), float(length), 0.0f)
                                           : glm::vec3(glm::max(half - edge, 0.0));
    v.edge.x = float(edge);
    v.middle.z = body.form == Form::cylinder ? gpu::clip_cylinder : gpu::clip_box;
  }
  for (int i = 0; i < 3; ++i) v.axis[i] = glm::vec4(glm::vec3(axes[i]), measures[i]);
  const glm::dvec2 whole(std::floor(middle.x), std::floor(middle.z));
  v.middle.x = cell(middle.x), v.middle.y = cell(middle.z);
  v.offset = glm::vec4(float(middle.x - whole.x), float(middle.y), float(middle.z - whole.y),
                       spec.value.x > 0.5f ? 1.0f : 0.0f);
  const glm::dvec3 about = glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z + 1e-3;
  volumes_.push_back(v);
  boxes_.push_back({middle - about, middle + about});
}

// Halves by the median of their middles, along the longer side.
void ClipVolumes::add_nodes(std::span<std::uint32_t> numbers) {
  glm::dvec3 least = boxes_[numbers[0]].least, most = boxes_[numbers[0]].most;
  for (const std::uint32_t i : numbers) least = glm::min(least, boxes_[i].least), most = glm::max(most, boxes_[i].most);
  const std::size_t mine = nodes_.size();
  nodes_.push_back({{cell(least.x), cell(least.z), cell(most.x), cell(most.z)},
                    {0, numbers.size() == 1 ? int(numbers[0]) : -1, 0, 0}});
  if (numbers.size() > 1) {
    const int axis = most.x - least.x > most.z - least.z ? 0 : 2;
    const auto middle = numbers.begin() + std::ptrdiff_t(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double at = boxes_[a].least[axis] + boxes_[a].most[axis],
                   other = boxes_[b].least[axis] + boxes_[b].most[axis];
      return at != other ? at < other : a < b;
    });
    add_nodes(numbers.first(numbers.size() / 2));
    add_nodes(numbers.subspan(numbers.size() / 2));
  }
  nodes_[mine].more.x = int(nodes_.size());
}

template <class Visit>
void ClipVolumes::walk(glm::dvec2 least_m, glm::dvec2 most_m, const Visit& visit) const {
  const glm::ivec4 cells(cell(least_m.x), cell(least_m.y), cell(most_m.x), cell(most_m.y));
  for (std::size_t node = 0; node < nodes_.size();) {
    const gpu::ClipNode& n = nodes_[node];
    const bool here = cells.z >= n.box.x && cells.w >= n.box.y && cells.x <= n.box.z && cells.y <= n.box.w;
    if (here && n.more.y >= 0) visit(std::size_t(n.more.y));
    node = here ? node + 1 : std::size_t(n.more.x);
  }
}

double ClipVolumes::distance_m(std::size_t volume, glm::dvec3 at_m) const {
  const gpu::ClipVolume& v = volumes_[volume];
  const glm::vec3 off(glm::dvec3(at_m.x - double(v.middle.x), at_m.y, at_m.z - double(v.middle.y)) -
                      glm::dvec3(v.offset));
  const glm::vec3 p(glm::dot(glm::vec3(v.axis[0]), off), glm::dot(glm::vec3(v.axis[1]), off),
                    glm::dot(glm::vec3(v.axis[2]), off));
  if (v.middle.z == gpu::clip_cylinder) return double(gpu::clip_cylinder_distance(p, v.axis[0].w, v.axis[1].w));
  if (v.middle.z == gpu::clip_box)
    return double(gpu::clip_box_distance(p, {v.axis[0].w, v.axis[1].w, v.axis[2].w}, v.edge.x));
  const HullMap& hull = hulls_[std::size_t(v.middle.w)];
  const double scale = double(v.axis[0].w) / hull.texel_m;
  return double(gpu::clip_hull_distance(p.y, hull.read(glm::dvec2(p.x, p.z) / scale), v.axis[0].w, v.axis[1].w));
}

bool ClipVolumes::clipped(glm::dvec3 at_m, bool flat) const {
  if (!std::isfinite(at_m.x + at_m.y + at_m.z)) return flat;
  bool result = flat;
  int last = -1;
  walk({at_m.x, at_m.z}, {at_m.x, at_m.z}, [&](std::size_t i) {
    if (int(i) <= last || !(distance_m(i, at_m) < 0.0)) return;
    last = int(i);
    result = volumes_[i].offset.w > 0.5f;
  });
  return result;
}

bool ClipVolumes::clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m, bool flat) const {
  if (!(most_m.x > least_m.x && most_m.y > least_m.y && height_m >= 0.0)) return false;
  bool all = flat, some_water = false;
  walk(least_m, most_m, [&](std::size_t i) {
    const Box& box = boxes_[i];
    if (box.most.y < -height_m || box.least.y > height_m || some_water) return;
    if (volumes_[i].offset.w < 0.5f) {
      some_water = true;
      return;
    }
    if (all || volumes_[i].middle.z == gpu::clip_hull) return;  // hulls need not be convex
    // A convex body holds all that its corners' hull does.
    bool holds = true;
    for (int corner = 0; corner < 8 && holds; ++corner)
      holds = distance_m(i, {corner & 1 ? most_m.x : least_m.x, corner & 2 ? height_m : -height_m,
                             corner & 4 ? most_m.y : least_m.y}) < -1e-3;
    all = all || holds;
  });
  return all && !some_water;
}

}  // namespace seascape
