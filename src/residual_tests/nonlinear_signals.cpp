#include "residual_tests/nonlinear_signals.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

/// Samples within the lanes' lengths have weight 1 here, be their output measured or not.
Signals within(const Block& block) {
  Signals inside = Signals::Zero(kLanes, block.samples);
  for (int lane = 0; lane < block.lanes; ++lane)
    inside.row(lane).head(block.lengths[static_cast<std::size_t>(lane)]).setOnes();
  return inside;
}

double total(const std::vector<Signals>& signals) {
  double sum = 0;
  for (const Signals& signal : signals) sum += signal.sum();
  return sum;
}

/// Scales the signals of all blocks to a mean square of 1.
void normalise(double samples, std::vector<Signals>* of_blocks) {
  double squares = 0;
  for (const Signals& signal : *of_blocks) squares += signal.square().sum();
  const double scale = 1 / std::sqrt(std::max(squares / std::max(samples, 1.0), 1e-300));
  for (Signals& signal : *of_blocks) signal *= scale;
}

/// The direction in which a signal of variance 1 moves, from -1 to 1.
Signals direction(const Signals& x, const Signals& inside) {
  constexpr double kSlow = 0.2;  // of the root mean square of the steps
  Signals before;
  shift(1, x, &before);
  const Signals steps = (x - before) * inside;
  const double width =
      kSlow * std::sqrt(steps.square().sum() / std::max(inside.sum(), 1.0)) + 1e-300;
  return steps / (steps.abs() + width);
}

/// Without its mean: a constant is an offset, not a plant that is not linear.
Signals centred(const Signals& signal, const Signals& inside) {
  const double mean = (signal * inside).sum() / std::max(inside.sum(), 1.0);
  return (signal - mean) * inside;
}

/// The signals of one block. `u` and `x`, the simulated output, have variance 1 over all blocks.
std::vector<Signals> signalsOf(const Polynomials& model, const Signals& inside, const Signals& u,
                               const Signals& x) {
  const std::vector<Signals> at_input{
      u.square(), u.abs(), u.cube(), x.square(), x.abs(), x.cube(), direction(x, inside)};
  std::vector<Signals> all{centred(x.square(), inside), centred(x.cube(), inside)};
  for (const Signals& signal : at_input) {
    all.emplace_back();
    filter(model.b, model.a, model.delay, centred(signal, inside), &all.back());
  }
  for (Signals& signal : all) {
    const Signals plain = signal * inside;
    filter(withLeadingOne(model.d), model.c, 0, plain, &signal);
  }
  return all;
}

}  // namespace

std::vector<std::vector<Signals>> nonlinearSignals(const Polynomials& model,
                                                   const std::vector<Block>& blocks) {
  std::vector<Signals> inside, u, x;
  for (const Block& block : blocks) {
    inside.push_back(within(block));
    u.push_back(block.u * inside.back());
  }
  const double samples = total(inside), mean = total(u) / std::max(samples, 1.0);
  for (std::size_t b = 0; b < blocks.size(); ++b) u[b] -= mean * inside[b];
  normalise(samples, &u);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    x.emplace_back();
    filter(model.b, model.a, model.delay, u[b], &x.back());
    x.back() *= inside[b];
  }
  normalise(samples, &x);
  std::vector<std::vector<Signals>> all;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    all.push_back(signalsOf(model, inside[b], u[b], x[b]));
  for (std::size_t k = 0; !all.empty() && k < all.front().size(); ++k) {
    std::vector<Signals> one;
    one.reserve(all.size());
    for (std::vector<Signals>& of_block : all) one.push_back(std::move(of_block[k]));
    normalise(samples, &one);
    for (std::size_t b = 0; b < all.size(); ++b) all[b][k] = std::move(one[b]);
  }
  return all;
}

}  // namespace uncertainty_identification
