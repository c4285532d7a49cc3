#include "app/settings.h"

namespace seascape {

namespace {

// The member that a chain of pointers to members leads to: at<&Settings::sea, &SeaState::chop>(settings).
template <auto... path>
auto& at(Settings& settings) {
  return (settings .* ... .* path);
}

template <auto... path>
int choice_of(const Settings& settings) {
  return static_cast<int>((settings .* ... .* path));
}

template <auto... path>
void set_choice(Settings& settings, int index) {
  auto& value = at<path...>(settings);
  value = static_cast<std::remove_reference_t<decltype(value)>>(index);
}

template <auto member> constexpr auto real = &at<member>;
template <auto member> constexpr auto sea = &at<&Settings::sea, member>;
template <auto member> constexpr auto waves = &at<&Settings::waves, member>;
template <auto member> constexpr auto baked = &at<&Settings::baked, member>;
template <auto member> constexpr auto gerstner = &at<&Settings::gerstner, member>;
template <auto member> constexpr auto gset1 = &at<&Settings::gerstner, &GerstnerSettings::set1, member>;
template <auto member> constexpr auto gset2 = &at<&Settings::gerstner, &GerstnerSettings::set2, member>;
template <auto member> constexpr auto particles = &at<&Settings::wave_particles, member>;
template <auto member> constexpr auto dynamic = &at<&Settings::dynamic_waves, &DynamicSeaSettings::waves, member>;
template <auto member> constexpr auto dynamic_windows = &at<&Settings::dynamic_waves, &DynamicSeaSettings::waves, &DynamicWavesSettings::windows, member>;
template <auto member> constexpr auto rain = &at<&Settings::dynamic_waves, &DynamicSeaSettings::rain, member>;
template <auto member> constexpr auto foam = &at<&Settings::foam, member>;
template <auto member> constexpr auto foam_windows = &at<&Settings::foam, &FoamSettings::windows, member>;
template <auto member> constexpr auto spray = &at<&Settings::spray, member>;
template <auto member> constexpr auto place = &at<&Settings::place, member>;
template <auto member> constexpr auto place_windows = &at<&Settings::place, &PlaceSettings::windows, member>;
template <auto member> constexpr auto lod = &at<&Settings::lod, member>;
template <auto member> constexpr auto water = &at<&Settings::water, member>;
template <auto member> constexpr auto sky = &at<&Settings::sky, member>;
template <auto member> constexpr auto render = &at<&Settings::render, member>;
template <auto member>
constexpr ChoiceMember sea_choice{&choice_of<&Settings::sea, member>, &set_choice<&Settings::sea, member>};
template <auto member>
constexpr ChoiceMember lod_choice{&choice_of<&Settings::lod, member>, &set_choice<&Settings::lod, member>};
template <auto member>
constexpr ChoiceMember render_choice{&choice_of<&Settings::render, member>, &set_choice<&Settings::render, member>};

constexpr bool quality = true, rebuild = true, grows = true;

// The order is that of the panel and of docs/settings.md: groups stay together.
const std::vector<Setting>& table() {
  static const std::vector<Setting> rows{
      {"waves.wind_speed_mps", "m/s", "Wind speed at 10 m height; 0 gives a sea without wind waves.",
       sea<&SeaState::wind_speed_mps>, 0.0, 64.0, {}, false, rebuild, grows},
      {"waves.wind_to_deg", "deg", "Direction the wind blows to, clockwise from -z seen from above.",
       sea<&SeaState::wind_to_deg>, 0.0, 360.0, {}, false, rebuild, grows},
      {"waves.fetch_m", "m", "How far the wind has blown over open water; short fetches give short, steep waves.",
       sea<&SeaState::fetch_m>, 0.0, 1e9, {}, false, rebuild, grows},
      {"waves.spectrum", "",
       "Long waves of the wind sea: fully developed, growing with fetch, the same limited by depth, or Elfouhaily's of 1997.",
       sea_choice<&SeaState::spectrum>, 0.0, 0.0, {"pierson_moskowitz", "jonswap", "tma", "elfouhaily"}, false, rebuild, grows},
      {"waves.spreading", "", "How the wind sea's long waves spread over directions.", sea_choice<&SeaState::spreading>, 0.0,
       0.0, {"cosine_power", "hasselmann", "donelan_banner", "elfouhaily"}, false, rebuild, grows},
      {"waves.swell_elongation", "",
       "Narrows the spreading, the long waves' most, to longer and more parallel crests: 0 as measured, 1 most.",
       sea<&SeaState::swell_elongation>, 0.0, 1.0, {}, false, rebuild, grows},
      {"waves.depth_m", "m",
       "Depth of the still water, by which waves run and which limits the tma spectrum; 0 or less is dry land without waves.",
       sea<&SeaState::depth_m>, -1000.0, 1e6, {}, false, rebuild},
      {"waves.peak_enhancement", "", "JONSWAP's gamma: 1 is a fully developed sea with a broad peak, 7 a sharp young one.",
       sea<&SeaState::peak_enhancement>, 1.0, 7.0, {}, false, rebuild, grows},
      {"waves.swell_height_m", "m", "Significant height of a swell train from a far storm; 0 for none.",
       sea<&SeaState::swell_height_m>, 0.0, 15.0, {}, false, rebuild, grows},
      {"waves.swell_period_s", "s", "Peak period of the swell.", sea<&SeaState::swell_period_s>, 4.0, 22.0, {}, false, rebuild, grows},
      {"waves.swell_to_deg", "deg", "Direction the swell travels to, clockwise from -z seen from above.",
       sea<&SeaState::swell_to_deg>, 0.0, 360.0, {}, false, rebuild, grows},
      {"waves.swell2_height_m", "m", "Significant height of a second swell; 0 for none.", sea<&SeaState::swell2_height_m>, 0.0,
       15.0, {}, false, rebuild, grows},
      {"waves.swell2_period_s", "s", "Peak period of the second swell.", sea<&SeaState::swell2_period_s>, 4.0, 22.0, {}, false,
       rebuild, grows},
      {"waves.swell2_to_deg", "deg", "Direction the second swell travels to, clockwise from -z seen from above.",
       sea<&SeaState::swell2_to_deg>, 0.0, 360.0, {}, false, rebuild, grows},
      {"waves.swell3_height_m", "m", "Significant height of a third swell; 0 for none.", sea<&SeaState::swell3_height_m>, 0.0,
       15.0, {}, false, rebuild, grows},
      {"waves.swell3_period_s", "s", "Peak period of the third swell.", sea<&SeaState::swell3_period_s>, 4.0, 22.0, {}, false,
       rebuild, grows},
      {"waves.swell3_to_deg", "deg", "Direction the third swell travels to, clockwise from -z seen from above.",
       sea<&SeaState::swell3_to_deg>, 0.0, 360.0, {}, false, rebuild, grows},
      {"waves.chop", "", "Horizontal displacement that sharpens crests: 0 none, 1 as linear theory has it.",
       sea<&SeaState::chop>, 0.0, 2.0, {}, false, rebuild, grows},
      {"waves.small_wave_suppression", "", "Damps waves shorter than about 2 m for comfort in a headset, 0 none to 1 most.",
       sea<&SeaState::small_wave_suppression>, 0.0, 1.0, {}, false, rebuild, grows},
      {"waves.gravity_mps2", "m/s2", "Acceleration of gravity.", sea<&SeaState::gravity_mps2>, 1.0, 30.0, {}, false, rebuild},
      {"waves.loop_s", "s",
       "The sea repeats exactly after this time, the waves' periods rounded to whole fractions of it; 0 never repeats.",
       sea<&SeaState::loop_s>, 0.0, 86400.0, {}, false, rebuild},
      {"waves.seed", "", "Which sea of the same statistics; independent of quality.", sea<&SeaState::seed>, 0.0,
       4294967295.0, {}, false, rebuild, grows},
      {"waves.change_s", "s",
       "How long a changed wind, swell or chop takes to come over the running sea, wave by wave; 0 makes another sea at once.",
       real<&Settings::sea_change_s>, 0.0, 600.0},
      {"waves.resolution", "", "Samples a side of each cascade's tile; the longest has four times as many, up to 512.", waves<&WaveQuality::resolution>, 16.0, 512.0,
       {"16", "32", "64", "128", "256", "512"}, quality, rebuild},
      {"waves.cascades", "", "How many cascades of waves are kept, the longest first.", waves<&WaveQuality::cascades>, 1.0,
       5.0, {}, quality, rebuild},
      {"waves.half_storage", "", "Stores the tiles of waves on the GPU as 16-bit floats.",
       waves<&WaveQuality::half_storage>, 0.0, 1.0, {}, quality, rebuild},
      {"waves.where", "",
       "What computes the picture's waves: the GPU, or the processor, which uploads them; auto takes the processor on software drivers.",
       ChoiceMember{&choice_of<&Settings::wave_place>, &set_choice<&Settings::wave_place>}, 0.0, 0.0, {"auto", "gpu", "cpu"}, false,
       rebuild},

      {"gerstner.set1_height_m", "m", "Significant height of the first set of Gerstner waves, 1.41 times trough to crest of a single wave; 0 leaves it out.",
       gset1<&GerstnerSet::height_m>, 0.0, 30.0, {}, false, rebuild},
      {"gerstner.set1_wavelength_m", "m", "Length of the first set's longest wave; both sets' waves lie within a factor of 8 where neither or both are for shores.",
       gset1<&GerstnerSet::wavelength_m>, 0.25, 1000.0, {}, false, rebuild},
      {"gerstner.set1_to_deg", "deg", "Direction the first set travels to, clockwise from -z seen from above; of a set for shores from straight towards the shore.",
       gset1<&GerstnerSet::to_deg>, 0.0, 360.0, {}, false, rebuild},
      {"gerstner.set1_spread_deg", "deg", "The directions of the first set's waves lie evenly within this angle; a single wave has none.",
       gset1<&GerstnerSet::spread_deg>, 0.0, 360.0, {}, false, rebuild},
      {"gerstner.set1_octaves", "", "0: the first set is one wave. 1 to 3: waves of so many octaves of length below it, each as steep as the others.",
       gset1<&GerstnerSet::octaves>, 0.0, 3.0, {"0", "1", "2", "3"}, false, rebuild},
      {"gerstner.set1_waves", "", "How many waves the first set has an octave.",
       gset1<&GerstnerSet::waves>, 1.0, 16.0, {}, false, rebuild},
      {"gerstner.set1_reverse", "", "What comes back against the first set, as a share of each wave's height: 1 gives waves that stand.",
       gset1<&GerstnerSet::reverse>, 0.0, 1.0, {}, false, rebuild},
      {"gerstner.set1_shore", "", "true: the first set runs along the scene's splines to gerstner and nowhere else, its direction counted from straight towards the shore; false: it covers the sea.",
       gset1<&GerstnerSet::shore>, 0.0, 1.0, {}, false, rebuild},
      {"gerstner.set2_height_m", "m", "Significant height of the second set of Gerstner waves, 1.41 times trough to crest of a single wave; 0 leaves it out.",
       gset2<&GerstnerSet::height_m>, 0.0, 30.0, {}, false, rebuild},
      {"gerstner.set2_wavelength_m", "m", "Length of the second set's longest wave; both sets' waves lie within a factor of 8 where neither or both are for shores.",
       gset2<&GerstnerSet::wavelength_m>, 0.25, 1000.0, {}, false, rebuild},
      {"gerstner.set2_to_deg", "deg", "Direction the second set travels to, clockwise from -z seen from above; of a set for shores from straight towards the shore.",
       gset2<&GerstnerSet::to_deg>, 0.0, 360.0, {}, false, rebuild},
      {"gerstner.set2_spread_deg", "deg", "The directions of the second set's waves lie evenly within this angle; a single wave has none.",
       gset2<&GerstnerSet::spread_deg>, 0.0, 360.0, {}, false, rebuild},
      {"gerstner.set2_octaves", "", "0: the second set is one wave. 1 to 3: waves of so many octaves of length below it, each as steep as the others.",
       gset2<&GerstnerSet::octaves>, 0.0, 3.0, {"0", "1", "2", "3"}, false, rebuild},
      {"gerstner.set2_waves", "", "How many waves the second set has an octave.",
       gset2<&GerstnerSet::waves>, 1.0, 16.0, {}, false, rebuild},
      {"gerstner.set2_reverse", "", "What comes back against the second set, as a share of each wave's height: 1 gives waves that stand.",
       gset2<&GerstnerSet::reverse>, 0.0, 1.0, {}, false, rebuild},
      {"gerstner.set2_shore", "", "true: the second set runs along the scene's splines to gerstner and nowhere else, its direction counted from straight towards the shore; false: it covers the sea.",
       gset2<&GerstnerSet::shore>, 0.0, 1.0, {}, false, rebuild},
      {"gerstner.chop", "", "Horizontal displacement of Gerstner waves: 0 none, 1 circles, as Gerstner's; refused where it would fold the surface over.",
       gerstner<&GerstnerSettings::chop>, 0.0, 2.0, {}, false, rebuild},
      {"gerstner.seed", "", "Which phases, and which lengths and directions within their octaves and spread, Gerstner waves have.",
       gerstner<&GerstnerSettings::seed>, 0.0, 4294967295.0, {}, false, rebuild},

      {"wave_particles.count", "", "Wave particles on the tile: bumps that run straight on, half of them troughs, evenly in all directions.",
       particles<&WaveParticleSettings::count>, 1.0, 100000.0, {}, false, rebuild},
      {"wave_particles.height_m", "m", "Significant height of the wave particles' waves; 0 leaves them out.",
       particles<&WaveParticleSettings::height_m>, 0.0, 20.0, {}, false, rebuild},
      {"wave_particles.tile_m", "m", "Side of the wave particles' tile, after which the largest of its sizes repeats.",
       particles<&WaveParticleSettings::tile_m>, 0.25, 4000.0, {}, false, rebuild},
      {"wave_particles.radius_m", "m", "Radius of a wave particle, half the length of its wave: 1/64 to 1/4 of the tile's side.",
       particles<&WaveParticleSettings::radius_m>, 0.005, 1000.0, {}, false, rebuild},
      {"wave_particles.speed_mps", "m/s", "How fast wave particles run; 0 takes the speed of a deep-water wave two radii long.",
       particles<&WaveParticleSettings::speed_mps>, 0.0, 100.0, {}, false, rebuild},
      {"wave_particles.chop", "", "Horizontal displacement that sharpens wave particles: 0 none, 1 as Yuksel's are at their crests.",
       particles<&WaveParticleSettings::chop>, 0.0, 2.0, {}, false, rebuild},
      {"wave_particles.scales", "", "How many sizes the tile is laid over the sea in: the whole, 0.62 and 0.32 of it.",
       particles<&WaveParticleSettings::scales>, 1.0, 3.0, {"1", "2", "3"}, false, rebuild},
      {"wave_particles.seed", "", "Which wave particles of the same statistics.", particles<&WaveParticleSettings::seed>, 0.0,
       4294967295.0, {}, false, rebuild},

      {"dynamic_waves.resolution", "", "Texels a side of each level's window; more reach farther from the viewer.",
       dynamic_windows<&LodWindowSettings::resolution>, 64.0, 512.0, {"64", "128", "256", "512"}, quality, rebuild},
      {"dynamic_waves.levels", "", "Levels of dynamic waves, each of waves and a window twice as long as the one before.",
       dynamic_windows<&LodWindowSettings::slices>, 2.0, 8.0, {}, false, rebuild},
      {"dynamic_waves.texel_m", "m", "Texel of the finest level; the shortest dynamic waves are eight of them long.",
       dynamic_windows<&LodWindowSettings::texel_m>, 0.005, 10.0, {}, false, rebuild},
      {"dynamic_waves.rate_hz", "1/s", "Steps a second; any rate gives the same waves, a lower one places what pushes them less exactly.",
       dynamic<&DynamicWavesSettings::rate_hz>, 10.0, 240.0, {}, false, rebuild},
      {"dynamic_waves.damping_per_s", "1/s", "How fast dynamic waves die away: their energy falls by this share a second.",
       dynamic<&DynamicWavesSettings::damping_per_s>, 0.0, 10.0, {}, false, rebuild},
      {"dynamic_waves.sharpening", "", "Horizontal displacement that sharpens dynamic waves: 0 none, 1 as linear waves have it; never so much that the water folds.",
       dynamic<&DynamicWavesSettings::sharpening>, 0.0, 2.0, {}, false, rebuild},
      {"dynamic_waves.idle_m", "m", "Lower than this everywhere, and not pushed, dynamic waves come to rest and cost nothing; 0 keeps them moving.",
       dynamic<&DynamicWavesSettings::idle_m>, 0.0, 0.1, {}, false, rebuild},
      {"dynamic_waves.settle_s", "s", "Simulated before the first moment shown and after each jump of the time, so that rain has fallen already.",
       &at<&Settings::dynamic_waves, &DynamicSeaSettings::settle_s>, 0.0, 60.0, {}, false, rebuild},
      {"dynamic_waves.rain_per_m2_s", "1/(m2 s)", "Drops of rain that fall on each square metre in a second, around the viewer as far as a thousand drops a step go, at most 256 m; 0 is dry.", rain<&RainSettings::drops_per_m2_s>,
       0.0, 100.0, {}, false, rebuild},
      {"dynamic_waves.drop_length_m", "m", "Length of the hump that a drop leaves; its waves are about twice as long.", rain<&RainSettings::drop_length_m>, 0.01,
       10.0, {}, false, rebuild},
      {"dynamic_waves.drop_height_m", "m", "Height of the hump that a drop leaves.", rain<&RainSettings::drop_height_m>, -1.0, 1.0, {}, false, rebuild},
      {"dynamic_waves.seed", "", "Which drops fall, of the same statistics.", rain<&RainSettings::seed>, 0.0, 4294967295.0, {}, false, rebuild},

      {"foam.simulated", "", "Foam outlives the crest that made it and is left behind in streaks; inputs of foam, shores and wakes have it simulated in any case.",
       foam<&FoamSettings::simulated>, 0.0, 1.0, {}, false, rebuild},
      {"foam.breaking", "", "What breaking waves leave: 1 as photographs of the sea have it, 0 none.", foam<&FoamSettings::breaking>, 0.0, 4.0, {}, false, rebuild},
      {"foam.life_s", "s", "Foam that nothing feeds falls to 1/e in this time.", foam<&FoamSettings::life_s>, 0.1, 1000.0, {}, false, rebuild},
      {"foam.shore_m", "m", "Along shores (the effect sea_depth) water less deep than this foams.", foam<&FoamSettings::shore_m>, 0.01, 100.0, {}, false, rebuild},
      {"foam.shore_per_s", "1/s", "Share of the water at a shore's very edge, and of the crests of waves that have broken, that foam comes to cover in a second; 0 none.",
       foam<&FoamSettings::shore_per_s>, 0.0, 100.0, {}, false, rebuild},
      {"foam.resolution", "", "Texels a side of each window of foam; more reach farther from the viewer.",
       foam_windows<&LodWindowSettings::resolution>, 64.0, 512.0, {"64", "128", "256", "512"}, quality, rebuild},
      {"foam.levels", "", "Windows of foam, each twice as wide as the one before.", foam_windows<&LodWindowSettings::slices>, 2.0, 8.0, {}, false, rebuild},
      {"foam.texel_m", "m", "Texel of the finest window of foam.", foam_windows<&LodWindowSettings::texel_m>, 0.05, 100.0, {}, false, rebuild},
      {"foam.rate_hz", "1/s", "Steps of the foam a second; any rate gives the same decay, a lower one leaves stripes behind fast crests.", foam<&FoamSettings::rate_hz>, 1.0,
       240.0, {}, false, rebuild},
      {"foam.settle_s", "s", "Simulated before the first moment shown and after each jump of the time, so that foam lies there already.", foam<&FoamSettings::settle_s>, 0.0,
       60.0, {}, false, rebuild},

      {"spray.amount", "", "How much spray breaking crests throw up and the wind carries off: 1 usual, 0 none; below 7 m/s of wind there is none.", spray<&SpraySettings::amount>,
       0.0, 4.0, {}, false, rebuild},
      {"spray.most", "", "The most puffs of spray aloft at once; where there would be more they are thinned evenly.", spray<&SpraySettings::most>, 64.0, 32768.0, {}, quality,
       rebuild},
      {"spray.range_m", "m", "How far around the viewer there is spray; it thins out from two thirds of this on.", spray<&SpraySettings::range_m>, 10.0, 300.0, {}, false,
       rebuild},
      {"spray.life_s", "s", "The longest that a puff of spray is seen.", spray<&SpraySettings::life_s>, 0.2, 6.0, {}, false, rebuild},
      {"spray.size", "", "Size of the puffs of spray, which begin with radii of 6 to 36 cm times this.", spray<&SpraySettings::size>, 0.25, 4.0, {}, false, rebuild},
      {"spray.rate_hz", "1/s", "Steps of the spray a second; between them what is aloft flies on.",
       spray<&SpraySettings::rate_hz>, 4.0, 60.0, {}, false, rebuild},
      {"spray.seed", "", "Which spray of the same statistics.", spray<&SpraySettings::seed>, 0.0, 4294967295.0, {}, false, rebuild},

      {"level.height_m", "m", "Height of the still water above y = 0, where no input gives another: a tide.", place<&PlaceSettings::level_m>, -10000.0, 10000.0,
       {}, false, rebuild},
      {"sea_depth.sand", "", "How bright the sand of the bed and the beaches is: 1 as coral sand, 0.4 as that of old rock.", place<&PlaceSettings::sand>, 0.0, 1.8, {}, false,
       rebuild},
      {"sea_depth.growth_m", "m", "Height above the still water from which green covers the land; 0 leaves it bare.", place<&PlaceSettings::growth_m>, 0.0, 1000.0, {},
       false, rebuild},
      {"flow.to_deg", "deg", "Where a current everywhere goes to, clockwise from -z seen from above.", place<&PlaceSettings::flow_to_deg>, 0.0, 360.0, {}, false,
       rebuild},
      {"flow.speed_mps", "m/s", "How fast that current is; inputs add theirs.", place<&PlaceSettings::flow_mps>, 0.0, 20.0, {}, false, rebuild},
      {"flow.period_s", "s", "How long a pattern of waves is carried along before another takes its place: longer is calmer, and draws patterns out more.",
       place<&PlaceSettings::flow_period_s>, 0.1, 60.0, {}, false, rebuild},
      {"clip.by_default", "", "Whether there is water only where an input takes the clipping away.", place<&PlaceSettings::clip_by_default>, 0.0, 1.0, {}, false,
       rebuild},
      {"place.resolution", "", "Texels a side of each window of data of places; more reach farther from the viewer.",
       place_windows<&LodWindowSettings::resolution>, 64.0, 512.0, {"64", "128", "256", "512"}, quality, rebuild},
      {"place.levels", "", "Windows of data of places, each twice as wide as the one before.", place_windows<&LodWindowSettings::slices>, 2.0, 12.0, {}, false,
       rebuild},
      {"place.texel_m", "m", "Texel of the finest window of data of places.", place_windows<&LodWindowSettings::texel_m>, 0.01, 100.0, {}, false, rebuild},

      {"baked.loop", "", "The loop of waves that is played: a folder that `seascape bake` wrote, or the name of one in content/loops.",
       TextMember{&at<&Settings::baked, &BakedSettings::loop>}, 0.0, 0.0, {}, false, rebuild},
      {"baked.scale", "", "Plays the loop so many times as long and as high as recorded, and slower by the root of it, as such waves run.",
       baked<&BakedSettings::scale>, 0.01, 100.0, {}, false, rebuild},
      {"baked.weight", "", "Of the loop's displacement: 1 all, 0 none.", baked<&BakedSettings::weight>, 0.0, 4.0, {}, false, rebuild},
      {"baked.speed", "", "How fast the loop runs; 0 stands still, below 0 it runs backwards.", baked<&BakedSettings::speed>, -8.0, 8.0, {}, false, rebuild},
      {"baked.fade_m", "m", "From half this distance on the picture fades the loop's waves into roughness, which is all that is left from there on; 0 does not. Queries have them everywhere.",
       baked<&BakedSettings::fade_m>, 0.0, 1e6, {}, false, rebuild},

      {"lod.ocean_size_m", "m", "Side of the square that is divided into patches, doubled where motion is seen beyond it; a skirt goes on to the horizon.",
       lod<&LodSettings::ocean_size_m>, 256.0, 8192.0, {}, false, rebuild},
      {"lod.patch_quads", "", "Quads along a patch's side.", lod<&LodSettings::patch_quads>, 16.0, 64.0,
       {"16", "32", "64"}, quality, rebuild},
      {"lod.pixel_error", "px",
       "The most pixels by which the mesh may miss the sea, 0.25 or more, whatever sea and picture: patches split as that needs. 0: lod.threshold decides.",
       lod<&LodSettings::pixel_error>, 0.0, 64.0, {}, quality, rebuild},
      {"lod.threshold", "",
       "Where lod.pixel_error is 0, a patch splits when its size over its distance exceeds this, in a fixed measure; lower gives more detail.",
       lod<&LodSettings::threshold>, 0.5, 4.0, {}, quality, rebuild},
      {"lod.join", "",
       "How levels of detail meet: masked snaps edge vertices to the coarser side, morphed slides vertices there with distance, so that nothing pops.",
       lod_choice<&LodSettings::join>, 0.0, 0.0, {"masked", "morphed"}},
      {"lod.cull_scale", "", "How much a patch's bounds grow before it is culled.", lod<&LodSettings::cull_scale>, 1.0, 4.0,
       {}, quality, false},
      {"lod.levels", "", "Depth of the quadtree; 0 takes as many levels as the quality needs.",
       lod<&LodSettings::levels>, 0.0, 12.0, {}, false, rebuild},
      {"lod.max_height_m", "m", "Largest displacement that culling expects; 0 takes it from the waves.",
       lod<&LodSettings::max_height_m>, 0.0, 200.0},
      {"lod.skirt_multiplier", "", "Patches, and the skirt outside, keep their density up to this many ocean sizes, where motion is seen so far.",
       lod<&LodSettings::skirt_multiplier>, 1.0, 20.0, {}, false, rebuild},
      {"lod.earth_curvature", "", "The sea falls away with the curve of the Earth, so that it has a true horizon.",
       lod<&LodSettings::earth_curvature>, 0.0, 1.0},

      {"water.chlorophyll_mg_m3", "mg/m3", "Chlorophyll in the water: 0.01 the bluest ocean, 10 a green coast.",
       water<&WaterSettings::chlorophyll_mg_m3>, 0.01, 10.0},
      {"water.crest_light", "", "Strength of sunlight seen through thin crests: 1 as derived, 0 none.",
       water<&WaterSettings::crest_light>, 0.0, 4.0},
      {"water.whitecaps", "", "Strength of whitecaps where the scene has the foam effect: 1 as derived, 0 none.",
       water<&WaterSettings::whitecaps>, 0.0, 4.0},
      {"water.glitter", "", "Strength of the sun's reflection: 1 as derived, 0 none.", water<&WaterSettings::glitter>, 0.0,
       4.0},
      {"water.anisotropy", "", "Largest anisotropy of the slopes' samplers, where the device has it.",
       water<&WaterSettings::anisotropy>, 1.0, 16.0, {}, quality, rebuild},

      {"sky.sun_elevation_deg", "deg", "Height of the sun above the horizon.", sky<&SkySettings::sun_elevation_deg>, -5.0,
       90.0},
      {"sky.sun_to_deg", "deg", "Where the sun stands, clockwise from -z seen from above.", sky<&SkySettings::sun_to_deg>,
       0.0, 360.0},
      {"sky.haze", "", "Aerosol in the air: 0 pure air, 1 a clear day at sea, 8 milky.", sky<&SkySettings::haze>, 0.0, 8.0},
      {"sky.visibility_m", "m", "Distance at which haze leaves 2 % of the contrast.", sky<&SkySettings::visibility_m>, 100.0,
       1e6},
      {"sky.exposure_ev", "EV", "Stops added to the automatic exposure.", sky<&SkySettings::exposure_ev>, -10.0, 10.0},

      {"msaa", "", "Samples a pixel.", render<&RenderSettings::msaa>, 1.0, 8.0, {"1", "2", "4", "8"}, quality, rebuild},
      {"frame.shape", "", "How a frame is drawn: tile with its tone mapping, desktop with a picture of light that effects may read, auto as the scene needs.",
       render_choice<&RenderSettings::shape>, 0.0, 0.0, {"tile", "desktop", "auto"}, quality, rebuild},
      {"frame.lighting", "",
       "Where the sea's pixels are lit: forward as its triangles are drawn, deferred once a pixel after all of them (with one sample a pixel); auto deferred on software drivers.",
       render_choice<&RenderSettings::lighting>, 0.0, 0.0, {"forward", "deferred", "auto"}, false, rebuild},
      {"frame.facing_only", "",
       "Leaves out triangles that face away from eyes in the air: faster, but Mesa's software driver then leaves a sample open here and there at a picture's edge.",
       render<&RenderSettings::facing_only>, 0.0, 1.0},
      {"stereo.mode", "", "One pass for both eyes or a pass per eye; auto takes one where the driver draws it rightly.",
       render_choice<&RenderSettings::stereo>, 0.0, 0.0, {"auto", "single", "per-eye"}, false, rebuild},
      {"stereo.eye_distance_m", "m", "Distance between the eyes where no headset gives it.",
       render<&RenderSettings::eye_distance_m>, 0.0, 0.2},
      {"camera.vertical_fov_deg", "deg", "Vertical field of view of a window and of headless pictures.",
       render<&RenderSettings::vertical_fov_deg>, 1.0, 170.0},
      {"camera.near_m", "m", "Distance of the near plane.", render<&RenderSettings::near_m>, 0.001, 10.0},

      {"time.scale", "", "Speed of the sea's time; 0 stands still, below 0 it runs backwards.", real<&Settings::time_scale>, -8.0, 8.0},
      {"time.start_s", "s", "The sea's time at the start.", real<&Settings::time_start_s>, -1e9, 1e9},
      {"time.offset_s", "s", "What the clock that the sea goes by, such as a server's, says more than this one: the sea's time is time.start_s + time.scale (clock + this).",
       real<&Settings::time_offset_s>, -1e9, 1e9},
      {"time.follow_clock", "", "In explore the clock is the machine's (seconds since 1970, UTC) instead of the time since the start: all who have the same clock see one sea.",
       real<&Settings::follow_clock>, 0.0, 1.0},

      {"debug.view", "", "Paints something else than light: holes in magenta, levels, wires, normals, slices.",
       render_choice<&RenderSettings::debug>, 0.0, 0.0, {"none", "holes", "lod", "wireframe", "normals", "slices"}, false,
       rebuild},
      {"debug.freeze", "", "Keeps the patches of the last frame, to look at them from elsewhere.",
       lod<&LodSettings::freeze>, 0.0, 1.0},
      {"debug.drop_patch", "", "Leaves out the patch of this number, the control of tests for holes; -1 none.",
       lod<&LodSettings::drop_patch>, -1.0, 1e6},
  };
  return rows;
}

}  // namespace

std::span<const Setting> settings_table() { return table(); }

}  // namespace seascape
