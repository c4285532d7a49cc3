#include "tests/support/place_truth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ocean/places/flow_phase.h"
#include "shaders/shared/flow_height.h"

namespace seascape::test {

namespace {
double seconds(const WaveTiles& tiles) { return double(tiles.ticks()) / double(gpu::ticks_per_second); }

// Between the four texels of a level around a place in a tile (in sides, of level 0's texels).
glm::dvec4 between_texels(const WaveTiles& tiles, int tile, WavePlane plane, int level, glm::dvec2 in_tile) {
  const int samples = tiles.samples(tile), size = samples >> level;
  const glm::dvec2 at = (in_tile + 0.5 / samples) * double(size) - 0.5, cell = glm::floor(at), part = at - cell;
  const auto texel = [&](int x, int z) {
    const auto wrapped = [&](double of) { return ((std::int64_t(of) % size) + size) % size; };
    return glm::dvec4(tiles.texels(
        tile, plane,
        level)[std::ptrdiff_t(wrapped(cell.y + z)) * tiles.stride(tile, level) + std::ptrdiff_t(wrapped(cell.x + x))]);
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
}

// What one of a field's places has at a place of the plane, as its footprint leaves it.
SeaSample one_place(const WaveField& field, const WaveTiles& tiles, std::size_t of, glm::dvec2 at, double footprint_m) {
  SeaSample sample;
  const WaveField::Place& place = of == field.curved() ? field.curved_place() : field.places()[of];
  const WaveField::Filter filter = field.filter(footprint_m);
  const int level = filter.level[of];
  if (level >= tiles.levels(place.tile) - 1) return sample;
  const glm::dvec2 in_tile =
      glm::dvec2(place.cosine * at.x + place.sine * at.y, place.cosine * at.y - place.sine * at.x) *
          place.inverse_side +
      place.offset;
  const auto read = [&](WavePlane plane) {
    const glm::dvec4 fine = between_texels(tiles, place.tile, plane, level, in_tile);
    const double more = double(filter.between[of]);
    return double(filter.share[of]) *
           (more > 0.0 ? glm::mix(fine, between_texels(tiles, place.tile, plane, level + 1, in_tile), more) : fine);
  };
  const glm::dvec4 shift = read(WavePlane::shift), slope = read(WavePlane::slope);
  sample.displacement = place.size * glm::dvec3(shift);
  sample.height_gradient = {slope.x, slope.y};
  sample.shift_gradient = {slope.z, slope.w, shift.w};
  return sample;
}

// d f / d x and d f / d z of what is read at a place, over `e` to either side.
template <class T>
struct Around {
  T east, west, south, north;
  double e;
  template <class Of>
  glm::dvec2 gradient(const Of& of) const {
    return glm::dvec2(double(of(east)) - double(of(west)), double(of(south)) - double(of(north))) / (2.0 * e);
  }
};
template <class T>
Around<T> around(PlaceReader<T>& reader, const PlaceReading& reading, glm::dvec2 at) {
  const double e = reading.fine_texel_m();
  return {reader(reading, at + glm::dvec2(e, 0.0)), reader(reading, at - glm::dvec2(e, 0.0)),
          reader(reading, at + glm::dvec2(0.0, e)), reader(reading, at - glm::dvec2(0.0, e)), e};
}

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// What a texel leaves of a place of the field: a cascade's share, or the other sources'.
double share_of(const BedTexel& texel, std::size_t of, std::size_t cascades) {
  return double(of >= cascades ? texel.more.y : of < 4 ? texel.share[int(of)] : texel.more.x);
}
double lift_of(const BedTexel& texel, std::size_t of, std::size_t cascades) {
  const double share = share_of(texel, of, cascades);
  const bool runs_up = of < std::min(std::size_t(Shallows::swash_cascades), cascades);
  return runs_up ? std::hypot(share, double(texel.more.z)) : share;
}
}  // namespace

PlaceTruth::PlaceTruth(const PlaceInputs& inputs, const WaveField& field)
    : PlaceTruth(inputs, field,
                 ShallowsMix{make_shallows(field.state(), field.bins(), field.others(), inputs), nullptr}) {}

PlaceTruth::PlaceTruth(const PlaceInputs& inputs, const WaveField& field, const ShallowsMix& shallows)
    : PlaceSea(inputs, field, shallows), inputs_(inputs), mix_(shallows) {
  if (auto of = inputs.of(InputTarget::level)) level_ = place_values(std::move(of), inputs.settings);
  if (auto of = inputs.of(InputTarget::flow)) flow_ = place_values(std::move(of), inputs.settings);
  if (mix_) bed_ = bed_values(mix_, mix_.from->depth_m());
  if (inputs.shore != nullptr && field.has_curved()) shore_ = shore_values(inputs.shore, mix_.from);
}

PlaceReading PlaceTruth::reading(const Asked& asked) const {
  return place_reading(inputs_.settings.windows, asked.rest, asked.footprint_m, asked.seen);
}

void PlaceTruth::add_bed(Here& here, const Asked& asked) const {
  PlaceReader<BedTexel> reader(*bed_, inputs_.settings, asked.time_s);
  const PlaceReading at = reading(asked);
  const BedTexel waves = reader(at, asked.rest);
  const Around<BedTexel> beside = around(reader, at, asked.rest);
  here.bed_m = double(waves.bed.x);
  here.bed_gradient = beside.gradient([](const BedTexel& texel) { return texel.bed.x; });
  here.wet = smoothstep(gpu::dry_depth_m, gpu::wet_depth_m, here.level_m - here.bed_m);
  const auto cascades = std::size_t(asked.field.quality().cascades);
  for (Part& part : here.parts) {
    part.share = share_of(waves, part.of, cascades);
    part.lift = lift_of(waves, part.of, cascades);
    part.lift_gradient = beside.gradient([&](const BedTexel& texel) { return lift_of(texel, part.of, cascades); });
    if (part.of >= std::min(std::size_t(Refraction::bent_cascades), cascades)) continue;
    const int i = int(part.of);
    part.along = mix_.direction(i);
    part.place += double(waves.bed[i + 1]) * part.along;
    part.bend = beside.gradient([&](const BedTexel& texel) { return texel.bed[i + 1]; });
  }
}

void PlaceTruth::add_curved(Here& here, const Asked& asked) const {
  PlaceReader<ShoreTexel> reader(*shore_, inputs_.settings, asked.time_s);
  const PlaceReading at = reading(asked);
  Curved part{shore_place(reader(at, asked.rest), inputs_.shore->period_m(), at.read.present)};
  part.share = double(part.at.share);
  if (part.share == 0.0) return;
  part.share_gradient = around(reader, at, asked.rest).gradient([](const ShoreTexel& texel) { return texel.line.w; });
  part.at.turning_per_m = inputs_.shore->at(asked.rest, asked.footprint_m).turning_per_m;
  here.curved.push_back(part);
}

// Two of each pattern, which the current has brought from elsewhere.
void PlaceTruth::carry(Here& here, const Asked& asked) const {
  const double period_s = inputs_.settings.flow_period_s;
  const FlowPhase phase = flow_phase(asked.time_s, period_s);
  const glm::dvec2 velocity(PlaceReader<glm::vec4>(*flow_, inputs_.settings, asked.time_s)(reading(asked), asked.rest));
  const std::vector<Part> parts = std::exchange(here.parts, {});
  for (const Part& whole : parts) {
    const WaveField::Place& place = asked.field.places()[whole.of];
    const glm::dvec2 apart = 0.5 * period_s * velocity;
    const glm::dvec3 decay = place.decay_per_m2;
    const double height = gpu::flow_height(decay.x, decay.y, decay.z, apart.x, apart.y, phase.first);
    for (const bool first : {true, false}) {
      Part part = whole;
      part.place -= velocity * (first ? phase.first_s : phase.second_s);
      const double counts = height * (first ? phase.first : 1.0 - phase.first);
      part.share *= counts, part.lift *= counts, part.lift_gradient *= counts;
      here.parts.push_back(part);
    }
  }
  const std::vector<Curved> curved = std::exchange(here.curved, {});
  for (const Curved& whole : curved) {
    const glm::dvec2 bent(double(whole.at.stretch) * glm::dot(velocity, whole.at.forward),
                          glm::dot(velocity, whole.at.right()));
    const WaveField::Place& place = asked.field.curved_place();
    const glm::dvec2 apart = std::abs(phase.second_s - phase.first_s) * bent;
    const glm::dvec3 decay = place.decay_per_m2;
    const double height = gpu::flow_height(decay.x, decay.y, decay.z, apart.x, apart.y, phase.first);
    for (const bool first : {true, false}) {
      Curved part = whole;
      part.at.bent_m -= (first ? phase.first_s : phase.second_s) * bent;
      const double counts = height * (first ? phase.first : 1.0 - phase.first);
      part.share *= counts, part.share_gradient *= counts;
      here.curved.push_back(part);
    }
  }
}

namespace {
// Adds displacement and derivatives of waves along a curve: of the shift's two halves of shear, which differ where the
// share or the direction does, their mean.
void add_turned(const SeaSample& s, const ShorePlace& at, double share, glm::dvec2 share_gradient, SeaSample& to) {
  const glm::dvec2 across = at.right(), along = double(at.stretch) * at.forward;
  const glm::dvec2 shift = s.displacement.x * at.forward + s.displacement.z * across;
  to.displacement += share * glm::dvec3(shift.x, s.displacement.y, shift.y);
  // Where x and z of the pattern grow.
  to.height_gradient +=
      share * (s.height_gradient.x * along + s.height_gradient.y * across) + s.displacement.y * share_gradient;
  // D = share (Dx forward + Dz right); forward turns by `turning_per_m` to the right, right as much against forward.
  const glm::dvec2 of_forward =
      s.shift_gradient.x * along + s.shift_gradient.z * across - s.displacement.z * at.turning_per_m * at.forward;
  const glm::dvec2 of_right =
      s.shift_gradient.z * along + s.shift_gradient.y * across + s.displacement.x * at.turning_per_m * at.forward;
  const auto part = [&](int of, int by) {
    return share * (at.forward[of] * of_forward[by] + across[of] * of_right[by]) + shift[of] * share_gradient[by];
  };
  to.shift_gradient += glm::dvec3(part(0, 0), part(1, 1), 0.5 * (part(0, 1) + part(1, 0)));
}
}  // namespace

SeaSample PlaceTruth::sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint,
                          const LodPlacement* seen, const DynamicSurface* dynamic, const ClipVolumes* volumes) const {
  const Asked asked{field, tiles, rest, footprint, seconds(tiles), seen};
  Here here;
  for (std::size_t of = 0; of < field.places().size(); ++of) here.parts.push_back({.of = of, .place = rest});
  SeaSample result;
  if (field.warp()) {
    Part& first = here.parts.front();
    for (const PatternWarp::Wave& wave : field.warp().waves()) {
      const double turn = 2.0 * M_PI * (glm::dot(wave.along, rest) + wave.phase);
      first.place += std::sin(turn) * wave.way;
      first.warp += 2.0 * M_PI * std::cos(turn) * glm::outerProduct(wave.way, wave.along);
    }
  }
  if (level_) {
    PlaceReader<glm::vec4> reader(*level_, inputs_.settings, asked.time_s);
    const PlaceReading at = reading(asked);
    here.level_m = double(reader(at, rest).x);
    result.height_gradient = around(reader, at, rest).gradient([](const glm::vec4& value) { return value.x; });
  }
  if (bed_) add_bed(here, asked);
  if (shore_) add_curved(here, asked);
  if (flow_) carry(here, asked);
  result.displacement.y = here.level_m;
  for (const Part& part : here.parts) {
    const SeaSample s = one_place(field, tiles, part.of, part.place, footprint);
    result.displacement += glm::dvec3(part.share, part.lift, part.share) * s.displacement;
    // A pattern's phase is bent by what its shift changes by; along x and z its shift's two halves of shear then
    // differ, and have their mean.
    const auto bent = [&](glm::dvec2 gradient) {
      return gradient + glm::dot(gradient, part.along) * part.bend + gradient * part.warp;
    };
    const glm::dvec3& d = s.shift_gradient;
    const glm::dvec2 of_x = bent({d.x, d.z}), of_z = bent({d.z, d.y});
    result.height_gradient += part.lift * bent(s.height_gradient) + s.displacement.y * part.lift_gradient;
    result.shift_gradient += part.share * glm::dvec3(of_x.x, of_z.y, 0.5 * (of_x.y + of_z.x));
  }
  for (const Curved& part : here.curved)
    add_turned(one_place(field, tiles, field.curved(), part.at.bent_m, footprint), part.at, part.share,
               part.share_gradient, result);
  if (dynamic != nullptr) {
    const DynamicSample more = dynamic_truth(*dynamic, rest, footprint);
    result.displacement += more.displacement;
    result.height_gradient += more.height_gradient;
    result.shift_gradient += more.shift_gradient;
  }
  if (!bed_) return result;
  result.displacement.x *= here.wet;
  result.displacement.z *= here.wet;
  result.shift_gradient *= here.wet;
  const bool ground = result.displacement.y < here.bed_m;
  if (ground) result.displacement.y = here.bed_m, result.height_gradient = here.bed_gradient;
  if (!clips() || !dry(rest, result.displacement, asked.time_s, {.volumes = volumes, .seen = seen})) return result;
  result = {};
  result.displacement.y = here.bed_m;
  result.height_gradient = here.bed_gradient;
  return result;
}

DynamicSample dynamic_truth(const DynamicSurface& surface, glm::dvec2 rest, double footprint) {
  DynamicSample sum;
  const gpu::LodWindows windows = surface.windows(surface.viewer());
  const float distance = gpu::lod_distance(glm::vec2(rest - surface.viewer()));
  const int n = surface.samples();
  for (int i = 0; i < surface.levels(); ++i) {
    if (surface.still(i)) continue;
    const double texel_m = surface.texel_m(i);
    double weight =
        gpu::lod_present(windows.reach, i, distance) * std::clamp(2.0 - footprint / (4.0 * texel_m), 0.0, 1.0);
    if (i == 0) weight *= 1.0 - double(windows.reach.z);
    const glm::dvec2 at = rest / texel_m - 0.5, cell = glm::floor(at), f = at - cell;
    const LodIndex w(cell);
    glm::dvec4 shift(0.0), slope(0.0);
    for (int k = 0; k < 4; ++k) {
      const std::size_t texel =
          std::size_t((w.y + (k >> 1)) & (n - 1)) * std::size_t(n) + std::size_t((w.x + (k & 1)) & (n - 1));
      const double share = weight * ((k & 1) != 0 ? f.x : 1.0 - f.x) * ((k >> 1) != 0 ? f.y : 1.0 - f.y);
      shift += share * glm::dvec4(surface.shift(i)[texel]);
      slope += share * glm::dvec4(surface.slope(i)[texel]);
    }
    sum.displacement += glm::dvec3(surface.share() * shift.x, shift.y, surface.share() * shift.z);
    sum.height_gradient += glm::dvec2(slope.x, slope.y);
    sum.shift_gradient += surface.share() * glm::dvec3(slope.z, slope.w, shift.w);
  }
  return sum;
}

}  // namespace seascape::test
