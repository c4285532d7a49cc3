#include "ocean/waves/travelling_particles.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {
void require(bool holds, double value, const char* name, const char* range) {
  if (!holds || !std::isfinite(value))
    throw Error(name, text_from(value) + " is not " + range, std::string("give a number ") + range);
}
}  // namespace

TravellingParticles::TravellingParticles(const TravellingSettings& settings) : settings_(settings) {
  require(settings.radius_m > 0.0, settings.radius_m, "radius_m", "above 0");
  require(settings.speed_mps > 0.0, settings.speed_mps, "speed_mps", "above 0");
  require(settings.least_amplitude_m >= 0.0, settings.least_amplitude_m, "least_amplitude_m", "0 or more");
  require(settings.most_particles >= 1, double(settings.most_particles), "most_particles", "1 or more");
}

bool TravellingParticles::add(const TravellingParticle& p) {
  const double all = p.origin.x + p.origin.y + p.born_s + p.direction_rad + p.dispersion_rad + p.amplitude_m;
  if (!std::isfinite(all) || p.dispersion_rad < 0.0 || particles_.size() >= settings_.most_particles) return false;
  particles_.push_back(p);
  return true;
}

bool TravellingParticles::add_ring(glm::dvec2 origin, double born_s, double amplitude_m, int pieces) {
  if (pieces < 1 || particles_.size() + std::size_t(pieces) > settings_.most_particles) return false;
  const double width = 2.0 * std::numbers::pi / pieces;
  for (int i = 0; i < pieces; ++i)
    if (!add({origin, born_s, i * width, width, amplitude_m})) return false;
  return true;
}

double TravellingParticles::too_wide_after_s(const TravellingParticle& p) const {
  return p.dispersion_rad > 0.0 ? 0.5 * settings_.radius_m / (p.dispersion_rad * settings_.speed_mps)
                                : std::numeric_limits<double>::infinity();
}

void TravellingParticles::advance(double time_s) {
  if (!std::isfinite(time_s)) return;
  // A generation at a time, until no piece is too wide. Each generation is a third as wide: as many as the distance has
  // powers of three.
  for (bool split = true; split;) {
    split = false;
    next_.clear();
    std::size_t left = particles_.size();
    for (const TravellingParticle& p : particles_) {
      --left;
      if (std::abs(p.amplitude_m) < settings_.least_amplitude_m) {
        taken_away_m_ += p.amplitude_m;
        continue;
      }
      const bool wide = time_s - p.born_s > too_wide_after_s(p),
                 room = next_.size() + 3 + left <= settings_.most_particles;
      full_ = full_ || (wide && !room);
      if (!wide || !room) {
        next_.push_back(p);
        continue;
      }
      split = true;
      const double third = p.dispersion_rad / 3.0;
      for (const int side : {-1, 0, 1})
        next_.push_back({p.origin, p.born_s, p.direction_rad + side * third, third, p.amplitude_m / 3.0});
    }
    particles_.swap(next_);
  }
}

glm::dvec2 TravellingParticles::place(const TravellingParticle& p, double time_s) const {
  return p.origin +
         settings_.speed_mps * (time_s - p.born_s) * glm::dvec2(std::cos(p.direction_rad), std::sin(p.direction_rad));
}

double TravellingParticles::height_m(glm::dvec2 place_m, double time_s) const {
  double sum = 0.0;
  for (const TravellingParticle& p : particles_) {
    const double u = glm::length(place_m - place(p, time_s)) / settings_.radius_m;
    if (u < 1.0) sum += 0.5 * p.amplitude_m * (1.0 + std::cos(std::numbers::pi * u));
  }
  return sum;
}

double TravellingParticles::amplitude_sum_m() const {
  double sum = 0.0;
  for (const TravellingParticle& p : particles_) sum += p.amplitude_m;
  return sum;
}

}  // namespace seascape
