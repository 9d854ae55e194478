// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/retime.hpp"

namespace kinefile::retime {

/// The position of a new frame among the old ones.
struct Step {
  std::size_t new_frame = 0;
  std::size_t old_frame = 0;  ///< the one at or before it
  double t = 0;               ///< the fraction of the interval to the next; 0 at the last
  double sigma = 0;           ///< of the average over old frames around it; 0: no average

  bool is_average() const { return sigma > 0; }
  bool is_copy() const { return t == 0 && !is_average(); }
};

/// The four old frames around a step; at the ends of the motion the end frame repeats.
struct Around {
  std::size_t before;
  std::size_t from;
  std::size_t to;
  std::size_t after;
};

/// An old frame and its weight in an average.
struct Tap {
  std::size_t old_frame;
  double weight;
};

/// The steps of a map through an old motion of at least one frame; shape (new frames). Values
/// outside of the motion are clamped to its ends.
std::vector<Step> steps_of(const std::vector<double>& old_frames, std::size_t num_old_frames,
                           bool antialias);

Around around(const Step& step, std::size_t num_old_frames);

/// The old frames of an average, with weights that sum up to 1. A Gaussian, truncated at three
/// sigma.
std::vector<Tap> taps_of(const Step& step, std::size_t num_old_frames);

}  // namespace kinefile::retime
