// SPDX-License-Identifier: MIT
#include "retime/stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinefile::retime {
namespace {

/// A piece of old frames with constant weight.
struct Piece {
  double length = 0;  ///< old frames
  double weight = 0;
};

/// The pieces from one old frame to another, forwards or backwards, cut at whole frames.
std::vector<Piece> pieces_between(double from, double to, const std::vector<double>& weights) {
  const double low = std::min(from, to);
  const double high = std::max(from, to);
  std::vector<Piece> pieces;
  for (auto frame = static_cast<std::size_t>(low); static_cast<double>(frame) < high; ++frame) {
    const auto start = static_cast<double>(frame);
    pieces.push_back({std::min(high, start + 1) - std::max(low, start),
                      (weights[frame] + weights[frame + 1]) / 2});
  }
  if (to < from) std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

tl::unexpected<Error> no_room(const Knot& from, const Knot& to, const char* reason) {
  return fail(make_error(ErrorKind::Usage, "RTM001",
                         fmt::format("expected room to change the time from {}:{} to {}:{}, {}",
                                     from.y, from.x, to.y, to.x, reason)));
}

/// Adds the knots after `from` up to `to`.
Result<void> add_stretched(const Knot& from, const Knot& to, const std::vector<double>& weights,
                           std::vector<Knot>& knots) {
  const std::vector<Piece> pieces = pieces_between(from.y, to.y, weights);
  double weighted_length = 0;
  double most = 0;
  for (const Piece& piece : pieces) {
    weighted_length += piece.length * piece.weight;
    most = std::max(most, piece.weight);
  }
  const double change = (to.x - from.x) - std::abs(to.y - from.y);
  if (change != 0 && weighted_length == 0 && !pieces.empty()) {
    return no_room(from, to, "found no frame there that may change its rate");
  }
  const double k = change == 0 || pieces.empty() ? 0 : change / weighted_length;
  if (!(1 + k * most > 0) || !std::isfinite(k * most)) {
    return no_room(from, to, "found too few frames there that may change their rate");
  }
  const double direction = to.y < from.y ? -1 : 1;
  double length = 0;
  double weighted = 0;
  for (const Piece& piece : pieces) {
    length += piece.length;
    weighted += piece.length * piece.weight;
    knots.push_back({from.x + (length + k * weighted), from.y + direction * length});
  }
  if (!pieces.empty()) knots.pop_back();  // it equals `to` except for rounding
  knots.push_back(to);
  return {};
}

}  // namespace

Result<std::vector<Knot>> stretched_knots(const std::vector<Knot>& keys,
                                          const std::vector<double>& weights) {
  std::vector<Knot> knots = {keys.front()};
  for (std::size_t j = 0; j + 1 < keys.size(); ++j) {
    auto added = add_stretched(keys[j], keys[j + 1], weights, knots);
    if (!added) return fail(std::move(added.error()));
  }
  return knots;
}

}  // namespace kinefile::retime
