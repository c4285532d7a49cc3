#include "ocean/drawn/drawn_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "ocean/places/flow_phase.h"

namespace seascape {

namespace {

// Heights of lakes in mountains need whole floats, where the device samples those.
VkFormat format_of(InputTarget kind, bool whole) {
  switch (kind) {
    case InputTarget::level:
      return whole ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
    case InputTarget::clip:
      return VK_FORMAT_R16_SFLOAT;
    case InputTarget::albedo:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    default:
      return VK_FORMAT_R16G16_SFLOAT;
  }
}

// Its specialisation constant and its image's slot.
struct KindSlots {
  int value, slot;
};
KindSlots slots_of(InputTarget kind) {
  switch (kind) {
    case InputTarget::level:
      return {gpu::value_level, gpu::slot_level};
    case InputTarget::flow:
      return {gpu::value_flow, gpu::slot_flow};
    case InputTarget::clip:
      return {gpu::value_clip, gpu::slot_clip};
    case InputTarget::albedo:
      return {gpu::value_albedo, gpu::slot_albedo};
    default:
      return {gpu::value_shadow, gpu::slot_shadow};
  }
}

LodChanges all_slices(const PlaceSettings& settings) {
  LodChanges changes{};
  for (int i = 0; i < settings.windows.slices; ++i) changes[std::size_t(i)] = whole_change(settings.windows.resolution);
  return changes;
}

// A row of a slice's texels.
template <class T>
std::span<const T> row_of(const LodField<T>& field, int slice, int z) {
  const std::size_t side = std::size_t(field.side());
  return {field.texels(slice) + std::size_t(z) * side, side};
}
// `count` of them from column x on.
template <class T>
std::span<const T> row_of(const LodField<T>& field, int slice, int z, int x, std::size_t count) {
  return row_of(field, slice, z).subspan(std::size_t(x), count);
}

// What a row of a slice changes by along x and z, a metre: over a texel to either side, so that what is read between
// texels is the difference of what is read a texel to either side of there.
template <class T>
class Slopes {
 public:
  Slopes(const LodField<T>& field, int slice, int z)
      : side_(int(field.side())), over_(float(0.5 / field.texel_m(slice))), here_(row_of(field, slice, z)) {
    before_ = row_of(field, slice, (z + side_ - 1) % side_);
    after_ = row_of(field, slice, (z + 1) % side_);
  }
  // `of`: what counts of a texel.
  template <class Of>
  auto along_x(int x, const Of& of) const {
    return (of(here_[at(x + 1 < side_ ? x + 1 : 0)]) - of(here_[at(x > 0 ? x - 1 : side_ - 1)])) * over_;
  }
  template <class Of>
  auto along_z(int x, const Of& of) const {
    return (of(after_[at(x)]) - of(before_[at(x)])) * over_;
  }

 private:
  static std::size_t at(int x) { return std::size_t(x); }
  int side_;
  float over_;
  std::span<const T> here_, before_, after_;
};

// Of a row from column x on: the still water's level and its slopes.
void put_level(const LodField<glm::vec4>& field, int slice, int z, int x, std::span<float> texels) {
  const Slopes slopes(field, slice, z);
  const auto level = [](const glm::vec4& texel) { return texel.x; };
  for (const glm::vec4& texel : row_of(field, slice, z, x, texels.size() / 4)) {
    const glm::vec4 put(level(texel), slopes.along_x(x, level), slopes.along_z(x, level), 0.0f);
    std::memcpy(texels.data(), &put, sizeof put);
    texels = texels.subspan(4);
    ++x;
  }
}

// Of a row from column x on, one layer of the bed's waves (shaders/lib/sea_bed.glsl).
void put_bed_waves(const LodField<BedTexel>& field, int slice, int layer, int z, int x, std::span<glm::vec4> texels) {
  if (layer < 2) {
    const std::span<const BedTexel> row = row_of(field, slice, z, x, texels.size());
    for (std::size_t i = 0; i < row.size(); ++i) texels[i] = layer == 0 ? row[i].share : row[i].more;
    return;
  }
  const Slopes slopes(field, slice, z);
  const auto bed = [](const BedTexel& texel) { return texel.bed; };
  for (glm::vec4& texel : texels) {
    const glm::vec4 along = slopes.along_x(x, bed), across = slopes.along_z(x, bed);
    ++x;
    texel =
        layer == 2 ? glm::vec4(along.x, across.x, along.y, across.y) : glm::vec4(along.z, across.z, along.w, across.w);
  }
}

void put_bed_heights(const LodField<BedTexel>& field, int slice, int, int z, int x, std::span<glm::vec4> texels) {
  const std::span<const BedTexel> row = row_of(field, slice, z, x, texels.size());
  for (std::size_t i = 0; i < row.size(); ++i) texels[i] = row[i].bed;
}

// With the texels that have slopes taken from what has changed.
LodChanges with_slopes(LodChanges changes, int side) {
  for (LodChange& change : changes) change = with_neighbours(change, side);
  return changes;
}

}  // namespace

DrawnPlace::DrawnPlace(Device& device, const Sea& sea)
    : settings_(sea.spec().place.settings), depth_m_(sea.state().depth_m), shallows_{sea.shallows().from, nullptr} {
  const PlaceInputs& inputs = sea.spec().place;
  validate(settings_);
  const bool whole = device.facts().float32_linear;
  for (const InputTarget kind :
       {InputTarget::level, InputTarget::flow, InputTarget::clip, InputTarget::albedo, InputTarget::shadow}) {
    std::vector<Drawn::Part> parts;
    int laid = 0;
    if (auto stays = inputs.of(kind)) parts.push_back({std::move(stays), nullptr}), laid |= gpu::laid_stays;
    if (auto follows = PlaceInputs::of(inputs.following, kind))
      parts.push_back({std::move(follows), nullptr}), laid |= gpu::laid_follows;
    if (parts.empty()) continue;
    const std::string name(traits(kind).name);
    const EffectScope scope(device, name);
    const int layers = int(parts.size());
    drawn_.push_back(
        {kind, laid, std::move(parts), DrawnWindows(device, name, settings_.windows, format_of(kind, whole), layers)});
  }
  if (shallows_) {
    const EffectScope scope(device, traits(InputTarget::sea_depth).name);
    // Shifts of hundreds of metres are too much for halves: where the device has nothing else they are left out
    // (update()).
    bed_ = std::make_unique<Bed>(
        Bed{nullptr,
            DrawnWindows(device, "sea_depth", settings_.windows,
                         whole ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT),
            DrawnWindows(device, "sea_depth waves", settings_.windows, VK_FORMAT_R16G16B16A16_SFLOAT, 4), nullptr,
            BedTurns(settings_.windows.slices)});
  }
  if (inputs.volumes) clip_ = std::make_unique<DrawnClip>(device, inputs.volumes);
  if (inputs.shore) {
    const EffectScope scope(device, traits(InputTarget::gerstner).name);
    shore_ = std::make_unique<DrawnShore>(device, inputs.shore, shallows_.from, settings_);
  }
}

void DrawnPlace::apply(const PlaceSettings& settings) {
  settings_.sand = settings.sand;
  settings_.growth_m = settings.growth_m;
}

void DrawnPlace::take(const Sea& sea) {
  const PlaceSettings before = settings_;
  const PlaceInputs& inputs = sea.spec().place;
  settings_ = inputs.settings;
  settings_.sand = before.sand;
  settings_.growth_m = before.growth_m;
  for (Drawn& drawn : drawn_)
    if (place_outside(before, drawn.kind) != place_outside(settings_, drawn.kind))
      for (Drawn::Part& part : drawn.parts)
        if (part.field) part.field->take(place_values(part.inputs, settings_), settings_);
  if (shore_) shore_->take(inputs.shore, sea.shallows().from);
}

void DrawnPlace::update(Frame& frame, const DrawnMoment& moment) {
  const auto& [sea, water, time_s, viewer] = moment;
  time_s_ = time_s;
  if (!std::isfinite(viewer.x + viewer.y + viewer.z)) return;
  // Where a place is read from follows from the viewer alone, at once: a picture does not depend on those before it.
  placement_ = lod_placement(settings_.windows, {viewer.x, viewer.z}, lod_scale(settings_.windows, viewer.y));
  const int side = settings_.windows.resolution;
  for (Drawn& drawn : drawn_) {
    LodChanges changes{};
    for (Drawn::Part& part : drawn.parts) {
      if (part.field)
        join(changes, part.field->follow(placement_, time_s), side);
      else
        part.field = std::make_unique<PlaceField<glm::vec4>>(place_values(part.inputs, settings_), settings_,
                                                             placement_, time_s),
        changes = all_slices(settings_);
    }
    if (changed_slices(changes) == 0) continue;
    if (drawn.kind == InputTarget::level) changes = with_slopes(changes, side);
    const auto field = [&drawn](int layer) -> const PlaceField<glm::vec4>& {
      return *drawn.parts[std::size_t(layer)].field;
    };
    if (drawn.kind == InputTarget::clip && !bed_) mask_.follow(field(0), changed_slices(changes));
    const int channels = drawn.windows.channels();
    drawn.windows.copy(
        frame, traits(drawn.kind).name.data(), changes, [&](int slice) { return field(0).field().layer(slice); },
        [&](int slice, int layer, int z, int x, std::span<float> texels) {
          const LodField<glm::vec4>& values = field(layer).field();
          if (drawn.kind == InputTarget::level) return put_level(values, slice, z, x, texels);
          std::size_t at = 0;
          for (const glm::vec4& texel : row_of(values, slice, z, x, texels.size() / std::size_t(channels)))
            for (int c = 0; c < channels; ++c) texels[at++] = texel[c];
        });
  }
  if (clip_) clip_->update(frame, sea.clip_volumes());
  if (bed_) follow(sea);
  if (bed_) update(frame, *bed_, time_s);
  if (shore_) shore_->update(frame, placement_, time_s);
}

MakePlace DrawnPlace::remake(const PlaceInputs& inputs, const TileSources& others) const {
  if (!bed_) return nullptr;
  return [inputs, others, settings = settings_, placement = placement_, time_s = time_s_](const SeaState& sea,
                                                                                          const WaveBins& bins) {
    auto made = std::make_shared<MadePlace>(MadePlace{make_shallows(sea, bins, others, inputs), nullptr});
    made->field = std::make_unique<PlaceField<BedTexel>>(bed_values({made->shallows, nullptr}, sea.depth_m), settings,
                                                         placement, time_s);
    return made;
  };
}

// The bed's windows of a sea that comes are made with it on another thread, where this drawing asked for that; or else
// here.
void DrawnPlace::follow(const Sea& sea) {
  const ShallowsMix& now = sea.shallows();
  if (now.to != nullptr && now.to != shallows_.to) {
    const std::shared_ptr<MadePlace>& made = sea.made_place();
    if (made != nullptr && made->shallows == now.to && made->field &&
        made->field->settings().windows == settings_.windows)
      bed_->next = std::move(made->field);
    if (bed_->next == nullptr)
      bed_->next = std::make_unique<PlaceField<BedTexel>>(bed_values({now.to, nullptr}, depth_m_), settings_,
                                                          placement_, time_s_);
  }
  const bool other = now.from != shallows_.from || now.to != shallows_.to || now.share != shallows_.share;
  if (now.from != shallows_.from) {
    bed_->field = now.from == shallows_.to ? std::move(bed_->next) : nullptr;
    bed_->next = nullptr;
  }
  if (other) bed_->turns.stale();
  if (shore_ && now.from != shallows_.from) shore_->take(sea.spec().place.shore, now.from);
  shallows_ = now;
}

void DrawnPlace::update(Frame& frame, Bed& bed, double time_s) {
  const int side = settings_.windows.resolution;
  LodChanges changes = all_slices(settings_);
  if (bed.field)
    changes = bed.field->follow(placement_, time_s);
  else
    bed.field = std::make_unique<PlaceField<BedTexel>>(bed_values({shallows_.from, nullptr}, depth_m_), settings_,
                                                       placement_, time_s);
  if (bed.next) join(changes, bed.next->follow(placement_, time_s), side);
  if (bed.turns.any()) {
    const std::uint32_t turn = bed.turns.take(changed_slices(changes));
    for (int i = 0; i < settings_.windows.slices; ++i)
      if ((turn >> i & 1u) != 0) changes[std::size_t(i)] = whole_change(side);
  }
  if (changed_slices(changes) == 0) return;
  const float share = float(shallows_.share);
  const LodField<BedTexel>& field = bed.field->field();
  // Layers 2 and 3 of the waves and three channels of the heights hold shifts.
  const glm::vec4 all(1.0f), shifts(bytes_per_texel(bed.heights.image().spec().format) == 16 ? 1.0f : 0.0f),
      first_shift(1.0f, 1.0f, shifts.x, shifts.x), three_shifts(1.0f, shifts.x, shifts.x, shifts.x);
  const auto copy = [&](DrawnWindows& windows, const char* pass, const LodChanges& changed, const auto& put,
                        const auto& counts) {
    windows.copy(
        frame, pass, changed, [&](int slice) { return field.layer(slice); },
        [&](int slice, int layer, int z, int x, std::span<float> floats) {
          std::array<glm::vec4, 2048> now, next;
          const std::span<glm::vec4> texels(now.data(), floats.size() / 4), others(next.data(), texels.size());
          put(field, slice, layer, z, x, texels);
          if (bed.next) put(bed.next->field(), slice, layer, z, x, others);
          const glm::vec4 count = counts(layer);
          for (std::size_t i = 0; i < texels.size(); ++i) {
            const glm::vec4 texel = count * (bed.next ? glm::mix(texels[i], others[i], share) : texels[i]);
            std::memcpy(&floats[4 * i], &texel, sizeof texel);
          }
        });
  };
  copy(bed.heights, "sea_depth", changes, put_bed_heights, [&](int) { return three_shifts; });
  copy(bed.waves, "sea_depth waves", with_slopes(changes, side), put_bed_waves, [&](int layer) {
    return layer < 2 ? all : layer == 2 ? first_shift : shifts;
  });
}

void DrawnPlace::declare(SurfaceSlots& slots, std::size_t) const {
  for (const Drawn& drawn : drawn_) {
    const auto [value, slot] = slots_of(drawn.kind);
    if (drawn.kind != InputTarget::clip) slots.set(traits(drawn.kind).name.data(), value, std::uint32_t(drawn.laid));
    slots.bind(slot, drawn.windows.image());
  }
  if (bed_) {
    slots.set("sea_depth", gpu::value_bed, 1);
    slots.bind(gpu::slot_bed, bed_->heights.image());
    slots.bind(gpu::slot_bed_waves, bed_->waves.image());
  }
  if (shore_) {
    slots.bind(gpu::slot_shore_lines, shore_->lines());
    slots.bind(gpu::slot_shore_ways, shore_->ways());
  }
  const bool flat = drawn(InputTarget::clip) != nullptr, volumes = clip_ != nullptr,
             hulls = volumes && clip_->hulls() != nullptr, floors = volumes && clip_->volumes().may_have_floors();
  if (!flat && !volumes) return;
  slots.set("clip", gpu::value_clip, 1);
  slots.set(gpu::value_clip_kinds, (flat ? 1u : 0u) | (volumes ? 2u : 0u) | (hulls ? 4u : 0u) | (floors ? 8u : 0u));
  if (!volumes) return;
  slots.bind(gpu::slot_clip_nodes, clip_->node_buffer());
  slots.bind(gpu::slot_clip_volumes, clip_->volume_buffer());
  if (hulls) slots.bind(gpu::slot_clip_hulls, *clip_->hulls());
}

void DrawnPlace::describe(gpu::FrameData& frame, glm::dvec2 grid_origin_m) const {
  gpu::PlaceData& data = frame.sea.place;
  data.windows = lod_windows(settings_.windows, placement_, grid_origin_m);
  const glm::vec4 current = place_outside(settings_, InputTarget::flow);
  // Without flat inputs hulls alone clip.
  const bool clipped = settings_.clip_by_default && drawn(InputTarget::clip) != nullptr;
  data.outside = glm::vec4(float(settings_.level_m), clipped ? 1.0f : 0.0f, current.x, current.y);
  const FlowPhase phase = flow_phase(time_s_, settings_.flow_period_s);
  if (shallows_) {
    constexpr double noise_m = gpu::ground_pattern_m;
    data.outside_bed =
        glm::vec4(float(-depth_m_), glm::vec2(grid_origin_m - noise_m * glm::floor(grid_origin_m / noise_m)), 0.0f);
    const double of_ground[] = {shallows_.run_up_m(), settings_.growth_m, settings_.sand};
    for (int i = 0; i < Refraction::bent_cascades; ++i)
      data.shift_along[i] = glm::vec4(glm::vec2(shallows_.direction(i)), float(of_ground[i]), 0.0f);
  }
  const glm::dvec2 whole = glm::floor(grid_origin_m);
  data.clip_origin = glm::ivec4(glm::ivec2(whole), 0, 0);
  data.clip_from = glm::vec4(glm::vec2(grid_origin_m - whole), 0.0f, 0.0f);
  data.flow =
      glm::vec4(float(phase.first_s), float(phase.second_s), float(phase.first), float(0.5 * settings_.flow_period_s));
}

void DrawnPlace::add_uses(Uses& uses) const {
  constexpr Access access = Access::surface_read;
  for (const Drawn& drawn : drawn_) uses.add(use(drawn.windows.image(), access));
  if (clip_) clip_->add_uses(uses, access);
  if (shore_) shore_->add_uses(uses, access);
  if (!bed_) return;
  uses.add(use(bed_->heights.image(), access));
  uses.add(use(bed_->waves.image(), access));
}

const DrawnPlace::Drawn* DrawnPlace::drawn(InputTarget kind) const {
  const auto found = std::find_if(drawn_.begin(), drawn_.end(), [&](const Drawn& d) { return d.kind == kind; });
  return found == drawn_.end() ? nullptr : &*found;
}
const PlaceField<glm::vec4>* DrawnPlace::field(InputTarget kind) const {
  const Drawn* found = drawn(kind);
  return found == nullptr ? nullptr : found->parts.front().field.get();
}

bool DrawnPlace::clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m) const {
  if (!clips()) return false;
  const bool flat = drawn(InputTarget::clip) != nullptr && mask_.clipped(least_m, most_m);
  return clip_ ? clip_->volumes().clipped(least_m, most_m, height_m, flat) : flat;
}

double DrawnPlace::level_m() const {
  const PlaceField<glm::vec4>* level = field(InputTarget::level);
  return level == nullptr ? 0.0 : std::max(std::abs(level->least()), std::abs(level->most()));
}

int DrawnPlace::slice_of(double within_m) const {
  int i = 0;
  while (i < settings_.windows.slices &&
         within_m >= (0.5 * settings_.windows.resolution - 1.0) * lod_texel_m(settings_.windows, placement_, i))
    ++i;
  return i;
}

double DrawnPlace::land_m(double within_m) const {
  if (!bed_ || !bed_->field) return 0.0;
  const int slice = slice_of(within_m);
  return slice < settings_.windows.slices ? std::max(bed_->field->most(slice), 0.0) : land_m();
}

glm::dvec2 DrawnPlace::bed_m(double within_m) const {
  if (!bed_ || !bed_->field) return glm::dvec2(0.0);
  const int slice = slice_of(within_m);
  if (slice == settings_.windows.slices) return {bed_->field->least(), bed_->field->most()};
  // Finer slices have what is averaged in that one.
  glm::dvec2 range(bed_->field->least(slice), bed_->field->most(slice));
  for (int finer = 0; finer < slice; ++finer)
    range = {std::min(range.x, bed_->field->least(finer)), std::max(range.y, bed_->field->most(finer))};
  return range;
}

double DrawnPlace::land_m() const { return bed_ && bed_->field ? std::max(bed_->field->most(), 0.0) : 0.0; }

}  // namespace seascape
