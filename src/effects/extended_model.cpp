#include "effects/extended_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "effects/chain_evaluation.h"
#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// (to - from)/step; empty where nothing changed, so that zeros are neither stored nor multiplied.
Signals difference(const Signals& from, const Signals& to, double step) {
  Signals change = (to - from) / step;
  if ((change == 0).all()) change.resize(kLanes, 0);
  return change;
}

WhitenedSignals difference(const WhitenedSignals& from, const WhitenedSignals& to, double step) {
  WhitenedSignals change;
  change.residual = difference(from.residual, to.residual, step);
  for (std::size_t i = 0; i < from.regressors.size(); ++i)
    change.regressors.push_back(difference(from.regressors[i], to.regressors[i], step));
  for (std::size_t k = 0; k < from.columns.size(); ++k) {
    const Index samples = std::max(from.columns[k]->cols(), to.columns[k]->cols());
    auto column = std::make_shared<Signals>(difference(
        withZerosUntil(samples, *from.columns[k]), withZerosUntil(samples, *to.columns[k]), step));
    if (column->cols() == 0) column = nullptr;
    change.columns.push_back(std::move(column));
  }
  change.log_jacobian = (to.log_jacobian - from.log_jacobian) / step;
  return change;
}

}  // namespace

ExtendedModel::ExtendedModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
                             const EstimationOptions& options, Effects effects,
                             const DataSummary& scales, int experiments, MatrixXd points)
    : LinearModel(std::move(nominal), basis, options),
      effects_(std::move(effects)),
      scales_(scales),
      experiments_(experiments),
      points_(std::move(points)) {
  count_ = static_cast<int>(LinearModel::names().size());
  for (const auto& effect : effects_) {
    offsets_.push_back(count_);
    count_ += effect->parameterCount();
  }
}

Index ExtendedModel::own() const { return effects_.empty() ? count_ : offsets_.front(); }

VectorXd ExtendedModel::psi(const VectorXd& parameters, std::size_t k) const {
  const int end = k + 1 < offsets_.size() ? offsets_[k + 1] : count_;
  return parameters.segment(offsets_[k], end - offsets_[k]);
}

std::unique_ptr<ExtendedModel> ExtendedModel::with(Effects effects) const {
  auto changed = std::make_unique<ExtendedModel>(sharedNominal(), basis(), options(),
                                                 std::move(effects), scales_, experiments_);
  if (points_.size() > 0) changed->points_ = pointsFor(*changed);
  return changed;
}

std::unique_ptr<ExtendedModel> ExtendedModel::forExperiments(int experiments) const {
  return std::make_unique<ExtendedModel>(sharedNominal(), basis(), options(), effects_, scales_,
                                         experiments);
}

std::unique_ptr<ExtendedModel> ExtendedModel::about(const MatrixXd& points) const {
  return std::make_unique<ExtendedModel>(sharedNominal(), basis(), options(), effects_, scales_,
                                         experiments_, points);
}

std::unique_ptr<LinearModel> ExtendedModel::linearisedAbout(const MatrixXd& points) const {
  return about(points);
}

std::vector<std::string> ExtendedModel::names() const {
  std::vector<std::string> all = LinearModel::names();
  for (const auto& effect : effects_) {
    for (const EffectParameter& parameter : effect->description().parameters)
      all.push_back(effect->name() + "." + parameter.name);
  }
  return all;
}

Chain ExtendedModel::chain(const Block& block, const VectorXd& parameters) const {
  Chain chain{block,
              nominal(),
              theta(parameters.head(own())),
              experiments_,
              {},
              regressors(),
              -1,
              {},
              {},
              {},
              {},
              {},
              {},
              Lanes::Zero(),
              {}};
  chain.points = MatrixXd::Zero(regressors(), kLanes);
  for (int lane = 0; lane < block.lanes && points_.size() > 0; ++lane)
    chain.points.col(lane) =
        points_.col(block.index[static_cast<std::size_t>(lane)]).head(regressors());
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    const Index row = pointRow(k);
    if (row < 0) continue;
    chain.points.conservativeResize(row + 1, Eigen::NoChange);
    chain.points.row(row).setConstant(pointAt(k, 0, parameters));
    for (int lane = 0; lane < block.lanes && row < points_.rows(); ++lane) {
      const double own = points_(row, block.index[static_cast<std::size_t>(lane)]);
      if (!std::isnan(own)) chain.points(row, lane) = own;
    }
  }
  return chain;
}

std::vector<SetEffect> ExtendedModel::setEffects(const VectorXd& parameters) const {
  std::vector<SetEffect> set;
  for (std::size_t k = 0; k < effects_.size(); ++k)
    set.push_back({effects_[k].get(), psi(parameters, k), pointRow(k)});
  std::stable_sort(set.begin(), set.end(), [](const SetEffect& left, const SetEffect& right) {
    return left.effect->position() < right.effect->position();
  });
  return set;
}

Signals ExtendedModel::drivingInput(const Block& block, const VectorXd& parameters) const {
  const std::vector<SetEffect> set = setEffects(parameters);
  Chain chain = this->chain(block, parameters);
  chain.u = block.u;
  applyStage(Stage::actuator, set, &chain);
  chain.x = chain.u;
  for (const SetEffect& of : set) {
    if (of.effect->name() == "plant_pole") of.effect->apply(of.psi, &chain);
    of.effect->sense(of.psi, &chain.x);
  }
  return chain.x;
}

Chain ExtendedModel::simulated(const Block& block, const VectorXd& parameters,
                               const MatrixXd& xi) const {
  const std::vector<SetEffect> set = setEffects(parameters);
  Chain chain = this->chain(block, parameters);
  for (int lane = 0; lane < block.lanes; ++lane)
    chain.points.col(lane).head(xi.rows()) = xi.col(block.index[static_cast<std::size_t>(lane)]);
  Polynomials p = nominal().polynomials(chain.theta);
  const bool at_input = options().offset_side == OffsetSide::input;
  const double offset = commonOffset(parameters.head(own()));
  runChain(p, basis(), set, at_input ? Signals(block.u + offset) : block.u, &chain);
  if (!at_input) chain.x += offset;
  applyStage(Stage::noise, set, &chain);
  for (const SetEffect& of : set) {
    of.effect->sense(of.psi, &chain.x);
    for (Signals& regressor : chain.X) of.effect->sense(of.psi, &regressor);
  }
  return chain;
}

MatrixXd ExtendedModel::unknownSignals(const VectorXd& parameters, int samples) const {
  const Polynomials p = nominal().polynomials(theta(parameters.head(own())));
  std::vector<Signals> signals;
  if (estimatesInitialState(options())) {
    Signals impulse = Signals::Zero(kLanes, samples), free, shifted;
    impulse.col(0).setOnes();
    filter(VectorXd::Ones(1), multiply(p.a, basis().denominator()), 0, impulse, &free);
    for (const SetEffect& of : setEffects(parameters)) of.effect->sense(of.psi, &free);
    for (int k = 0; k < freeResponseDirections(p, basis(), samples); ++k) {
      shift(k, free, &shifted);
      signals.push_back(shifted);
    }
  }
  if (options().offsets == Offsets::per_experiment)
    signals.push_back(Signals::Ones(kLanes, samples));
  MatrixXd all(samples, static_cast<Index>(signals.size()));
  for (Index k = 0; k < all.cols(); ++k)
    all.col(k) = signals[static_cast<std::size_t>(k)].row(0).transpose().matrix();
  return all;
}

Chain ExtendedModel::value(const Block& block, const VectorXd& parameters, KeptWhitening* kept,
                           Response* response) const {
  const std::vector<SetEffect> set = setEffects(parameters);
  Chain chain = this->chain(block, parameters);
  applyStage(Stage::measurement, set, &chain);
  Polynomials p = nominal().polynomials(chain.theta);
  p.d = multiply(p.d, chain.noise_d);
  if (kept->filter == nullptr || kept->c != p.c || kept->d != p.d)
    *kept = {p.c, p.d, whiteningOf(p, options(), block, false)};
  *response = Response();
  const auto run = [&](const Block& measured) {
    ChainEvaluation evaluation(p, basis(), options(), measured, kept->filter, set, &chain);
    evaluation.run(commonOffset(parameters.head(own())), response);
    evaluation.complete(response);
  };
  if (chain.y.size() == 0) {
    run(block);
    return chain;
  }
  Block measured = block;
  measured.y = chain.y;
  run(measured);
  return chain;
}

double ExtendedModel::step(const VectorXd& parameters, int j) const {
  constexpr double kRelative = 1e-6;
  double scale = 0.1;
  if (j >= own()) {
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      const auto& of_effect = effects_[k]->description().parameters;
      const int i = j - offsets_[k];
      if (i >= 0 && i < static_cast<int>(of_effect.size()))
        scale = of_effect[static_cast<std::size_t>(i)].scale;
    }
  } else if (j >= nominal().parameterCount()) {
    scale = scales_.output_deviation;
  }
  const double size = kRelative * std::max(std::abs(parameters[j]), scale);
  VectorXd moved = parameters;
  moved[j] += size;
  return admissible(moved) ? size : -size;
}

void ExtendedModel::evaluate(const Block& block, const VectorXd& parameters,
                             const std::vector<int>& derivatives, Response* response) const {
  KeptWhitening whitening;  // computed again only for parameters that change the noise model
  value(block, parameters, &whitening, response);
  if (derivatives.empty()) return;
  response->derivatives.resize(static_cast<std::size_t>(count_));
  response->column_precision_derivatives.assign(static_cast<std::size_t>(count_),
                                                VectorXd::Zero(response->column_precision.size()));
  for (const int j : derivatives) {
    const double size = step(parameters, j);
    VectorXd moved = parameters;
    moved[j] += size;
    Response there;
    value(block, moved, &whitening, &there);
    const auto at = static_cast<std::size_t>(j);
    response->derivatives[at] = difference(response->value, there.value, size);
    response->column_precision_derivatives[at] =
        (there.column_precision - response->column_precision) / size;
  }
}

void ExtendedModel::evaluate(const Block& block, const VectorXd& parameters, bool derivatives,
                             Response* response) const {
  std::vector<int> all(derivatives ? static_cast<std::size_t>(count_) : 0);
  std::iota(all.begin(), all.end(), 0);
  evaluate(block, parameters, all, response);
}

std::unique_ptr<const FusedSweep> ExtendedModel::prepare(const std::vector<Block>& /*blocks*/,
                                                         const VectorXd& /*parameters*/,
                                                         bool /*derivatives*/) const {
  return nullptr;
}

bool ExtendedModel::admissible(const VectorXd& parameters) const {
  if (!parameters.allFinite() || !LinearModel::admissible(parameters.head(own()))) return false;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (!effects_[k]->admissible(psi(parameters, k))) return false;
  }
  return true;
}

VectorXd ExtendedModel::toUnbounded(const VectorXd& parameters) const {
  VectorXd z = parameters;
  z.head(own()) = LinearModel::toUnbounded(parameters.head(own()));
  return z;
}

VectorXd ExtendedModel::fromUnbounded(const VectorXd& unbounded) const {
  VectorXd parameters = unbounded;
  parameters.head(own()) = LinearModel::fromUnbounded(unbounded.head(own()));
  return parameters;
}

MatrixXd ExtendedModel::unboundedJacobian(const VectorXd& unbounded) const {
  MatrixXd jacobian = MatrixXd::Identity(unbounded.size(), unbounded.size());
  jacobian.topLeftCorner(own(), own()) = LinearModel::unboundedJacobian(unbounded.head(own()));
  return jacobian;
}

}  // namespace uncertainty_identification
