// The constants of adaptive quality's controller.
#pragma once
#include "app/adaptive/cost_estimator.h"

namespace seascape {

// What the controller weighs. Prices are in units of quality x frames: a miss costs as much as one frame drawn at the
// floor in place of the ceiling.
struct AdaptiveTuning {
  double miss_price = 1.3;  // more than 1: frames that are missed come in runs, which one sees
  // The price alone would let a steady load miss one frame in 50. Where noise is small, more margin costs little: so
  // many spreads, up to so much of the cost (logarithm); the price of each unit by which it is not kept.
  double margin_sigmas = 2.6, most_margin = 0.08, margin_price = 4.0;
  double move_price = 0.16;      // of a move through the whole range
  double horizon_frames = 20.0;  // a move has to earn its price within so many
  double outlier_horizon = 1.5;  // the same for a move on a single timing, which the next may take back
  // A move changes the cost by at least so many spreads of single frames: on in the direction of the last move; down
  // after up; and up after down. The last two keep noise from moving levels to and fro.
  double onward_band = 0.25, down_band = 0.6, up_band = 1.3;
  double most_band = 0.04;      // and no more than so much (logarithm): with much noise, waiting costs more than moving
  double rise_a_frame = 0.25;   // quality given back in a frame, at most
  double least_spread = 0.005;  // relative; a floor on the margin
  int blind_frames = 45;        // without GPU times for so long, intervals are looked at
  // Late for so long with levers that seem not to help, they are tried again; each time that is in vain doubles it, up
  // to the second.
  int first_patience = 20, most_patience = 2560;
  CostEstimatorSettings estimator{};
};

}  // namespace seascape
