#include "model/plant_derivatives.h"

#include <algorithm>
#include <cmath>

#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Relative step of the finite differences. They are of fourth order, so a wide step is accurate;
/// and the Jacobian may itself be computed by differences, whose error a narrow step would amplify.
constexpr double kStep = 1e-2;

bool isZero(const Lanes& lanes) { return (lanes == 0).all(); }

/// The entries of `index` at the positions whose bit is set in `mask`.
DerivativeIndex chosen(const DerivativeIndex& index, unsigned mask) {
  DerivativeIndex part;
  for (std::size_t k = 0; k < index.size(); ++k) {
    if ((mask >> k & 1u) != 0) part.push_back(index[k]);
  }
  return part;
}

}  // namespace

DerivativeIndex with(DerivativeIndex index, int l) {
  index.insert(std::upper_bound(index.begin(), index.end(), l), l);
  return index;
}

PlantCoefficients::PlantCoefficients(const NominalModel& nominal, const VectorXd& theta)
    : nominal_(nominal), theta_(theta) {
  const Polynomials p = nominal.polynomials(theta);
  delay_ = p.delay;
  nb_ = p.b.size();
  na_ = p.a.size();
  value_.resize(nb_ + na_);
  value_ << p.b, p.a;
}

VectorXd PlantCoefficients::derivative(const DerivativeIndex& index) {
  if (index.empty()) return value_;
  return jacobianDerivative({index.begin() + 1, index.end()}).col(index.front());
}

const MatrixXd& PlantCoefficients::jacobianDerivative(const DerivativeIndex& directions) {
  const auto known = jacobians_.find(directions);
  if (known != jacobians_.end()) return known->second;
  MatrixXd result;
  if (directions.empty()) {
    result = nominal_.jacobian(theta_).topRows(nb_ + na_);
  } else {
    const Index j = directions.front();
    const DerivativeIndex others(directions.begin() + 1, directions.end());
    const double step = kStep * std::max(std::abs(theta_[j]), 1e-9);
    const auto moved = [&](double distance) -> MatrixXd {
      VectorXd there = theta_;
      there[j] += distance;
      if (others.empty())  // the coefficients themselves are not needed there
        return nominal_.jacobian(there).topRows(nb_ + na_);
      return PlantCoefficients(nominal_, there).jacobianDerivative(others);
    };
    result =
        (8 * (moved(step) - moved(-step)) - (moved(2 * step) - moved(-2 * step))) / (12 * step);
  }
  return jacobians_.emplace(directions, std::move(result)).first->second;
}

PlantDerivatives::PlantDerivatives(std::vector<PlantCoefficients>* lanes, const Signals& input,
                                   MatrixXd start)
    : lanes_(lanes), input_(input), start_(std::move(start)) {}

const std::vector<Lanes>& PlantDerivatives::coefficients(const DerivativeIndex& index) {
  const auto known = coefficients_.find(index);
  if (known != coefficients_.end()) return known->second;
  const auto size = static_cast<std::size_t>(lanes_->front().nb() + lanes_->front().na());
  std::vector<Lanes> all(size);
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto own = std::min(static_cast<std::size_t>(lane), lanes_->size() - 1);
    if (own < static_cast<std::size_t>(lane)) {  // unused lanes repeat the last one
      for (Lanes& coefficient : all) coefficient[lane] = coefficient[lane - 1];
      continue;
    }
    const VectorXd of_lane = (*lanes_)[own].derivative(index);
    for (std::size_t k = 0; k < size; ++k) all[k][lane] = of_lane[static_cast<Index>(k)];
  }
  return coefficients_.emplace(index, std::move(all)).first->second;
}

/// Appends factor sum_k (coefficient k of A_S) q^-k x.
void PlantDerivatives::appendTimesA(const DerivativeIndex& index, double factor, const Signals& x,
                                    std::vector<DelayedSignal>* terms) {
  const std::vector<Lanes>& all = coefficients(index);
  const Index nb = lanes_->front().nb(), na = lanes_->front().na();
  for (Index k = 0; k < na; ++k) {
    const Lanes& one = all[static_cast<std::size_t>(nb + k)];
    if (!isZero(one)) terms->push_back({&x, factor * one, static_cast<int>(k) + 1});
  }
}

Signals PlantDerivatives::timesA(const DerivativeIndex& index, const Signals& x) {
  std::vector<DelayedSignal> terms;
  appendTimesA(index, 1, x, &terms);
  Signals out = Signals::Zero(kLanes, x.cols());
  filterSum(terms, {}, &out);
  return out;
}

std::vector<Lanes> PlantDerivatives::denominator() {
  const std::vector<Lanes>& all = coefficients({});
  return {all.begin() + lanes_->front().nb(), all.end()};
}

void PlantDerivatives::divideByA(Signals* x) { filterSum({}, denominator(), x); }

const Signals& PlantDerivatives::signal(const DerivativeIndex& index) {
  const auto known = signals_.find(index);
  if (known != signals_.end()) return known->second;
  Signals x = Signals::Zero(kLanes, input_.cols());
  if (index.empty() && start_.size() > 0) {
    const Index first = std::min(start_.rows(), x.cols());
    x.topLeftCorner(start_.cols(), first) = start_.topRows(first).transpose().array();
  }
  std::vector<DelayedSignal> terms;
  const std::vector<Lanes>& all = coefficients(index);
  for (int k = 0; k < lanes_->front().nb(); ++k) {
    const Lanes& factor = all[static_cast<std::size_t>(k)];
    if (!isZero(factor)) terms.push_back({&input_, factor, lanes_->front().delay() + k});
  }
  const unsigned whole = 1u << index.size();
  for (unsigned mask = 1; mask < whole; ++mask)
    appendTimesA(chosen(index, mask), -1, signal(chosen(index, whole - 1 - mask)), &terms);
  filterSum(terms, denominator(), &x);
  return signals_.emplace(index, std::move(x)).first->second;
}

}  // namespace uncertainty_identification
