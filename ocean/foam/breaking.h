// Where the waves break: the share of each texel whose surface is squeezed to less than a threshold, of waves on the
// processor.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ocean/foam/breaking_simd.h"
#include "ocean/foam/foam.h"
#include "ocean/places/flow_phase.h"
#include "ocean/sea/query_simd.h"
#include "ocean/sea/sea.h"

namespace seascape {

// How much of the sea breaks is known from photographs, W = 3.84e-6 U^3.41 of a wind U (Monahan and O'Muircheartaigh
// 1980); where it does, from how the surface is squeezed: the threshold is that below which a Gaussian of the
// divergence's variance has as much as keeps up W. Of winds from 5 to 23 m/s that is a Jacobian of some 0.7, and it is
// held between 0.6 and 0.78, so that what is flat or smooth does not foam whatever the wind.
//
// The sea is asked for its crests (SeaDetail), which are the same at any quality, and so is foam.
//
// Of a texel the mean Jacobian is known, and how much the divergence varies within it, from what its footprint takes of
// the waves: the share of it below the threshold is that of a Gaussian (Dupuy and Bruneton 2012). The variance is the
// sea's mean for the footprint.
class Breaking {
 public:
  // `sea` outlives it; `life_s`: in which foam goes.
  Breaking(Sea& sea, double life_s);
  // Lets go of the sea's views: the next moment asks for new ones.
  void forget() { view_ = ahead_ = {}; }
  // As of the next moment that is asked for.
  void set_life(double life_s) { life_s_ = life_s; }
  // The sea has other sources than before.
  void take_sources();

  // Whether these waves ever break to speak of.
  bool ever() const;
  // Waves and threshold as they are at a time; nothing where they are of that already.
  void evaluate(std::int64_t ticks);
  // Makes part of the waves of a time to come, of which this share (0 to 1) has gone; not while the sea changes.
  void prepare(std::int64_t ticks, double share);
  // As evaluate(), for texels of a slice i of texel_m 2^i (lod_texel_m).
  void at(std::int64_t ticks, double texel_m, int slices);
  // Of the whole sea, by the same Gaussian, as of evaluate().
  double mean_share() const;
  double threshold() const { return threshold_; }
  // Of the height of all waves that cover the sea (m^2).
  double height_variance() const { return sea_.statistics().height_variance + others_height_variance_; }

  // Adds per_s times the share of each of a row's texels that breaks, a multiple of breaking_group of them. `water`:
  // what else moves it.
  void add(const FoamRow& row, float per_s, const BreakingWater& water, const FlowPhase& phase,
           std::span<float> gains) const;
  // Displacements at rest positions, for the texels of a slice, as WaveField has them.
  void displace(int slice, std::span<const glm::dvec2> rest_m, std::span<glm::vec3> displacements) const;

  // As of evaluate().
  const SeaView& view() const { return view_; }
  const WaveField& field() const { return view_.field(); }
  const WaveTiles& tiles() const { return view_.tiles(); }

 private:
  // A level of a place's tile, as a slice's texels read it.
  struct Reading {
    int tile, level, size, stride;
    float share;
    glm::dvec2 along_x, along_z;  // from rest positions to its texels
    double offset;
    glm::vec3 decay_per_m2;
  };
  struct Slice {
    std::vector<Reading> readings;
    double variance = 0.0;
    QueryPlan displaced;
  };
  double threshold_of(double sea_variance) const;
  double slope_variance() const;
  Sea& sea_;
  SeaView view_, ahead_;                       // as of evaluate(), and of prepare()
  std::uint64_t waves_ = 0, ahead_waves_ = 0;  // Sea::waves_version() that they are of
  std::vector<Slice> slices_;
  double life_s_;
  double others_variance_ = 0.0;  // no less than the divergence's
  double others_height_variance_ = 0.0;
  double lowest_ = -9.0;                     // where a normal number is below in as many cases as breaks
  double variance_ = 0.0, threshold_ = 0.6;  // of the whole sea's divergence, as of evaluate()
};

}  // namespace seascape
