#include "ocean/inputs/clip_volumes.h"

#include <algorithm>
#include <cassert>
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

// A body in the world: its own axes as columns, its middle, and half its box's sides along those axes.
struct ClipSolid {
  glm::dmat3 axes{1.0};
  glm::dvec3 middle{0.0}, half{0.0};
  glm::vec3 measures{0.0f};  // gpu::ClipVolume::axis, w
  double edge = 0.0;
  int form = gpu::clip_box, map = 0;
};

namespace {

// A form about the origin; T is a VolumeInput or a ClipBody.
template <class T>
ClipSolid form_of(const T& body) {
  using Form = VolumeInput::Form;
  ClipSolid result;
  const double length = 0.5 * body.length_m;
  result.edge = body.form == Form::box ? body.round_m : body.form == Form::cylinder ? 0.0 : body.radius_m;
  result.half = body.form == Form::box      ? 0.5 * body.size_m
                : body.form == Form::sphere ? glm::dvec3(body.radius_m)
                                            : glm::dvec3(body.radius_m, length, body.radius_m);
  result.measures = body.form == Form::cylinder ? glm::vec3(float(body.radius_m), float(length), 0.0f)
                                                : glm::vec3(glm::max(result.half - result.edge, 0.0));
  result.form = body.form == Form::cylinder ? gpu::clip_cylinder : gpu::clip_box;
  return result;
}

// A hull whose model's origin stands at `at`.
ClipSolid hull_of(const HullMap& hull, int map, double scale, const glm::dmat3& axes, const glm::dvec3& at) {
  ClipSolid result;
  result.axes = axes;
  result.middle = at + axes * (scale * hull.middle_m);
  const double wide = scale * hull.texel_m * (0.5 * gpu::clip_hull_texels - double(gpu::clip_hull_margin) + 1.0);
  result.half = {wide, scale * hull.half_height_m, wide};
  result.measures = {float(scale * hull.texel_m), float(result.half.y), 0.0f};
  result.form = gpu::clip_hull;
  result.map = map;
  return result;
}

// The maps of models, each made once.
class HullMaps {
 public:
  explicit HullMaps(std::vector<HullMap>& maps) : maps_(maps) {}
  // The number of a model's map. Throws Error at the spec's place.
  int of(const InputSpec& spec) {
    const ShapeInput& shape = std::get<ShapeInput>(spec.shape);
    const auto known = std::find(models_.begin(), models_.end(), shape.model.get());
    if (known != models_.end()) return int(known - models_.begin());
    if (models_.size() == most_input_hulls)
      throw Error(spec.where, "file: more than " + std::to_string(most_input_hulls) + " different models as hulls",
                  "place the same ones more often");
    validate_hull(spec);
    maps_.push_back(make_hull_map(*shape.model));
    models_.push_back(shape.model.get());
    return int(models_.size()) - 1;
  }

 private:
  std::vector<HullMap>& maps_;
  std::vector<const Model*> models_;
};

bool within(double value, const InputRange& range) { return value >= range.least && value <= range.most; }
bool within(const glm::dvec3& v, const InputRange& range) {
  return within(v.x, range) && within(v.y, range) && within(v.z, range);
}

}  // namespace

ClipVolumes::ClipVolumes(std::span<const InputSpec> specs, const ClipRoom& room) : most_bodies_(room.most_bodies) {
  if (room.most_bodies < 0 || room.most_bodies > most_clip_bodies)
    throw Error("most_bodies", std::to_string(room.most_bodies) + " is out of range",
                "give 0 to " + std::to_string(most_clip_bodies));
  std::vector<const InputSpec*> sorted;
  for (const InputSpec& spec : specs)
    if (is_volume(spec)) sorted.push_back(&spec);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const InputSpec* a, const InputSpec* b) { return a->order < b->order; });
  auto hulls = std::make_shared<Hulls>();
  hulls_ = hulls;
  HullMaps maps(hulls->maps);
  for (const InputSpec* spec : sorted) {
    validate(*spec);
    const bool takes_away = spec->value.x > 0.5f;
    if (const ShapeInput* shape = std::get_if<ShapeInput>(&spec->shape)) {
      add(solid(*shape, maps.of(*spec)), takes_away, false);
    } else {
      const VolumeInput& body = std::get<VolumeInput>(spec->shape);
      ClipSolid form = form_of(body);
      form.axes = turned(body.turn_deg, body.pitch_deg, body.roll_deg);
      form.middle = body.at_m;
      add(form, takes_away, false);
    }
  }
  for (std::size_t i = 0; i < room.hulls.size(); ++i) {
    assert(room.hulls[i] != nullptr);
    InputSpec spec;
    spec.to = InputTarget::clip;
    spec.shape = ShapeInput{.model = room.hulls[i], .from = ShapeInput::From::hull};
    spec.where = "hulls[" + std::to_string(i) + "] of bodies";
    hulls->of_bodies.push_back(maps.of(spec));
  }
  for (std::size_t i = 0; i < room.still.size(); ++i) {
    if (!takes(room.still[i]))
      throw Error("still[" + std::to_string(i) + "] of bodies", "a number of it is out of range", "place it elsewhere");
    add(room.still[i]);
  }
  add_tree(0);
  fixed_volumes_ = volumes_.size();
  fixed_nodes_ = nodes_.size();
  count_nodes();
}

ClipSolid ClipVolumes::solid(const ShapeInput& shape, int map) const {
  return hull_of(hulls_->maps[std::size_t(map)], map, shape.scale,
                 turned(shape.turn_deg, shape.pitch_deg, shape.roll_deg),
                 {shape.at_m.x, shape.at_height_m, shape.at_m.y});
}

ClipSolid ClipVolumes::solid(const ClipBody& body) const {
  const glm::dmat3 axes = glm::mat3_cast(body.orientation);
  if (body.hull != ClipBody::no_hull) {
    const int map = hulls_->of_bodies[std::size_t(body.hull)];
    return hull_of(hulls_->maps[std::size_t(map)], map, body.scale, axes, body.at_m);
  }
  ClipSolid result = form_of(body);
  result.axes = axes;
  result.middle = body.at_m;
  return result;
}

bool ClipVolumes::takes(const ClipBody& body) const {
  using Form = VolumeInput::Form;
  constexpr InputRange speeds{-1e4, 1e4};
  if (!within(body.at_m, input_place_range) || !within(body.at_m.y, input_height_range) ||
      !within(body.velocity_mps, speeds) || !within(body.spin_rad_s, speeds) ||
      !within(glm::length(body.orientation), {0.999, 1.001}))
    return false;
  if (body.hull != ClipBody::no_hull)
    return body.hull >= 0 && std::size_t(body.hull) < hulls_->of_bodies.size() && within(body.scale, input_model_range);
  if (body.form == Form::box)
    return within(body.size_m, input_size_range) &&
           within(body.round_m, {0.0, 0.5 * std::min({body.size_m.x, body.size_m.y, body.size_m.z})});
  return within(body.radius_m, input_size_range) &&
         (body.form != Form::capsule || within(body.length_m, {2.0 * body.radius_m, 4e6})) &&
         (body.form != Form::cylinder || within(body.length_m, input_size_range));
}

void ClipVolumes::place(std::span<const ClipBody> bodies) {
  assert(bodies.size() <= std::size_t(most_bodies_));
  const auto most = std::size_t(most_bodies_);
  bodies_.reserve(most);
  volumes_.reserve(fixed_volumes_ + most);
  boxes_.reserve(fixed_volumes_ + most);
  nodes_.reserve(fixed_nodes_ + 2 * most);
  numbers_.reserve(fixed_volumes_ + most);
  volumes_.resize(fixed_volumes_);
  boxes_.resize(fixed_volumes_);
  nodes_.resize(fixed_nodes_);
  bodies_.assign(bodies.begin(), bodies.end());
  for (const ClipBody& body : bodies) add(body);
  add_tree(fixed_volumes_);
  count_nodes();
}

void ClipVolumes::add(const ClipBody& body) { add(solid(body), true, body.hull != ClipBody::no_hull); }

void ClipVolumes::add(const ClipSolid& solid, bool takes_away, bool has_floor) {
  gpu::ClipVolume v{};
  for (int i = 0; i < 3; ++i) v.axis[i] = glm::vec4(glm::vec3(solid.axes[i]), solid.measures[i]);
  const glm::dvec2 whole(std::floor(solid.middle.x), std::floor(solid.middle.z));
  v.middle = {cell(solid.middle.x), cell(solid.middle.z), solid.form, solid.map};
  v.offset = glm::vec4(float(solid.middle.x - whole.x), float(solid.middle.y), float(solid.middle.z - whole.y),
                       takes_away ? 1.0f : 0.0f);
  v.edge.x = float(solid.edge);
  v.edge.y = has_floor ? 1.0f : 0.0f;
  glm::dvec3 about(1e-3);
  for (int i = 0; i < 3; ++i) about += glm::abs(solid.axes[i]) * solid.half[i];
  volumes_.push_back(v);
  boxes_.push_back({solid.middle - about, solid.middle + about});
}

// Of the volumes from `first` on, after the nodes that are there.
void ClipVolumes::add_tree(std::size_t first) {
  if (first == volumes_.size()) return;
  numbers_.resize(volumes_.size() - first);
  std::iota(numbers_.begin(), numbers_.end(), std::uint32_t(first));
  add_nodes(numbers_);
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
  const HullMap& hull = hulls_->maps[std::size_t(v.middle.w)];
  const double scale = double(v.axis[0].w) / hull.texel_m;
  return double(gpu::clip_hull_distance(p.y, hull.read(glm::dvec2(p.x, p.z) / scale), v.axis[0].w, v.axis[1].w));
}

bool ClipVolumes::clipped(glm::dvec3 at_m, bool flat) const { return decided(at_m, flat, true); }
bool ClipVolumes::dry(glm::dvec3 at_m, bool flat) const { return decided(at_m, flat, false); }

bool ClipVolumes::decided(const glm::dvec3& at_m, bool flat, bool with_floors) const {
  if (!std::isfinite(at_m.x + at_m.y + at_m.z)) return flat;
  bool result = flat;
  int last = -1;
  walk({at_m.x, at_m.z}, {at_m.x, at_m.z}, [&](std::size_t i) {
    if (int(i) <= last || (!with_floors && volumes_[i].edge.y > 0.5f)) return;
    if (!(distance_m(i, at_m) < 0.0)) return;
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
