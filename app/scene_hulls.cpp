#include "app/scene_hulls.h"

#include <algorithm>
#include <set>

#include "app/solids/inside_hulls.h"
#include "engine/error.h"

namespace seascape {

namespace {

// No wave of any scene stands higher over y = 0, or lower, where nothing gives the water another level.
constexpr double highest_wave_m = 100.0;

bool holds(const InputRange& range, double value) { return value >= range.least && value <= range.most; }

// Whether water may come to where a thing has a hull.
bool water_may_reach(const SolidThing& thing, const Model& hull, bool at_any_level) {
  const glm::dvec3& at = thing.pose.position_m;
  if (!holds(input_place_range, at.x) || !holds(input_height_range, at.y) || !holds(input_place_range, at.z))
    return false;
  if (at_any_level) return true;
  const glm::dmat3 axes = thing.scale * glm::mat3_cast(thing.pose.orientation);
  const glm::dvec3 least(hull.least), most(hull.most), half = 0.5 * (most - least);
  const double middle = at.y + (axes * (0.5 * (most + least))).y;
  const double reach =
      std::abs(axes[0].y) * half.x + std::abs(axes[1].y) * half.y + std::abs(axes[2].y) * half.z + highest_wave_m;
  return std::abs(middle) <= reach;
}

// Whether a scene's things float, by their number.
std::vector<bool> floating(const Scene& scene) {
  std::vector<bool> floats(scene.objects.things.size(), false);
  if (calls_for(scene.effects, "boats"))
    for (const FloatingThing& one : scene.objects.floating) floats[one.thing] = true;
  return floats;
}

// Calls visit(thing, model, hull of the model) of things that stand still until it gives false.
template <class Visit>
void each_hull(const Scene& scene, const Visit& visit) {
  if (!calls_for(scene.effects, "models")) return;
  const bool at_any_level = calls_for(scene.effects, "level");
  const std::vector<bool> floats = floating(scene);
  for (std::size_t t = 0; t < floats.size(); ++t) {
    const SolidThing& thing = scene.objects.things[t];
    const auto& hulls = scene.objects.models[thing.model].insides();
    for (std::size_t i = 0; i < hulls.size() && !floats[t]; ++i)
      if (water_may_reach(thing, *hulls[i], at_any_level) && !visit(thing, thing.model, i)) return;
  }
}

struct Hulls {
  ClipRoom room;
  std::vector<BodyInsides> insides;
};

Hulls all_hulls(const Scene& scene) {
  Hulls all{scene.clip_room, {}};
  ClipRoom& room = all.room;
  std::vector<int> first(scene.objects.models.size(), ClipBody::no_hull);  // of each model's hulls, in the room
  const auto first_of = [&](std::size_t model) {
    if (first[model] == ClipBody::no_hull) {
      first[model] = int(room.hulls.size());
      const auto& hulls = scene.objects.models[model].insides();
      room.hulls.insert(room.hulls.end(), hulls.begin(), hulls.end());
    }
    return first[model];
  };
  each_hull(scene, [&](const SolidThing& thing, std::size_t model, std::size_t hull) {
    room.still.push_back(hull_body(thing, first_of(model) + int(hull)));
    return true;
  });
  if (!calls_for(scene.effects, "boats")) return all;
  for (const FloatingThing& one : scene.objects.floating) {
    const SolidThing& thing = scene.objects.things[one.thing];
    BodyInsides insides{{}, thing.scale};
    const int count = int(scene.objects.models[thing.model].insides().size());
    if (room.most_bodies + count <= most_clip_bodies)
      for (int i = 0; i < count; ++i) insides.hulls.push_back(first_of(thing.model) + i);
    room.most_bodies += int(insides.hulls.size());
    all.insides.push_back(std::move(insides));
  }
  return all;
}

}  // namespace

ClipRoom hulls_of(const Scene& scene) { return all_hulls(scene).room; }
std::vector<BodyInsides> insides_of(const Scene& scene) { return all_hulls(scene).insides; }

void validate_hulls(const Scene& scene, const std::string& where) {
  std::set<const Model*> different;
  if (calls_for(scene.effects, "clip"))
    for (const InputSpec& spec : scene.inputs)
      if (const ShapeInput* shape = std::get_if<ShapeInput>(&spec.shape);
          shape != nullptr && shape->from == ShapeInput::From::hull)
        different.insert(shape->model.get());
  const ClipRoom room = hulls_of(scene);
  for (const auto& hull : room.hulls) different.insert(hull.get());
  if (room.still.size() > most_still_hulls)
    throw Error(where,
                "objects: they have " + std::to_string(room.still.size()) + " inside hulls to keep water out, over " +
                    std::to_string(most_still_hulls),
                "place fewer, or models without nodes called inside_...");
  if (!room.still.empty() && different.size() > most_input_hulls)
    throw Error(where,
                "objects: with the inputs there are " + std::to_string(different.size()) +
                    " different hulls to keep water out, over " + std::to_string(most_input_hulls),
                "place fewer different models");
}

std::vector<EffectEntry> called_for(const Scene& scene) {
  std::vector<EffectEntry> entries = closure(scene.effects);
  const auto is_clip = [](const EffectEntry& entry) { return entry.name == "clip"; };
  bool any = false;
  if (std::none_of(entries.begin(), entries.end(), is_clip)) {
    each_hull(scene, [&](const SolidThing&, std::size_t, std::size_t) {
      any = true;
      return false;
    });
    if (!any && calls_for(scene.effects, "boats"))
      any = std::any_of(scene.objects.floating.begin(), scene.objects.floating.end(), [&](const FloatingThing& one) {
        return !scene.objects.models[scene.objects.things[one.thing].model].insides().empty();
      });
  }
  if (any) entries.push_back({"clip", "hulls of its objects keep water out"});
  return entries;
}

bool calls_for(const Scene& scene, std::string_view effect) {
  const std::vector<EffectEntry> entries = called_for(scene);
  return std::any_of(entries.begin(), entries.end(), [&](const EffectEntry& entry) { return entry.name == effect; });
}

}  // namespace seascape
