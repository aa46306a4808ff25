#include "explanation/screening.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numeric>

#include "explanation/clock.h"
#include "math/pseudo_inverse.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A signal minus its regressors times the posterior means of xi. Without columns where the signal
/// and all its regressors are zero.
Signals atMeans(const WhitenedSignals& signals, const MatrixXd& xi, const Block& block) {
  Signals left = signals.residual;
  for (std::size_t i = 0; i < signals.regressors.size(); ++i) {
    if (signals.regressors[i].cols() == 0) continue;
    if (left.cols() == 0) left.setZero(kLanes, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane)
      left.row(lane) -= xi(static_cast<Index>(i), block.index[static_cast<std::size_t>(lane)]) *
                        signals.regressors[i].row(lane);
  }
  return left;
}

/// The minimum of |r + J p|^2 over p, given the Gram matrix of [J r]. `least` is set to that p.
double leftover(const MatrixXd& gram, VectorXd* least) {
  const Index p = gram.rows() - 1;
  MatrixXd information = gram.topLeftCorner(p, p);
  information.diagonal() *= 1 + 1e-9;
  information.diagonal().array() += 1e-12 * (1 + information.diagonal().maxCoeff() * 1e-6);
  const VectorXd b = gram.topRightCorner(p, 1);
  *least = -information.ldlt().solve(b);
  return gram(p, p) + b.dot(*least);
}

}  // namespace

Screening::Screening(const Fit& base, const FitData& data, const OptimisationOptions& options)
    : base_(base), data_(data), options_(options) {
  const Likelihood likelihood(*base.model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(base.at.parameters, false);
  covariances_ = latentMoments(likelihood.expect(statistics, base.at)).covariances;
  samples_ = statistics.samples().sum();
  blocks_.reserve(data.blocks().size());
  for (const Block& block : data.blocks()) {
    blocks_.push_back({&block, {}, {}, {}, {}});
    BaseBlock& of = blocks_.back();
    base.model->evaluate(block, base.at.parameters, true, &of.response);
    for (const WhitenedSignals& tangent : of.response.derivatives)
      of.sensitivities.push_back(atMeans(tangent, base.xi, block));
    base_jacobian_ += of.response.value.log_jacobian.head(block.lanes).sum();
  }
  for (BaseBlock& of : blocks_) {
    for (const auto& column : of.response.value.columns) of.list.push_back(column.get());
    for (const Signals& regressor : of.response.value.regressors) of.list.push_back(&regressor);
    for (const Signals& sensitivity : of.sensitivities)
      of.list.push_back(sensitivity.cols() == 0 ? nullptr : &sensitivity);
    of.products = innerProducts(of.list, of.list);
  }
  VectorXd none;
  base_gain_ = regressionGain(*base.model, base.at.parameters, &none);
}

Screening::Candidate Screening::evaluate(const ExtendedModel& model, const VectorXd& parameters,
                                         const BaseBlock& of) const {
  const Index own = base_.at.parameters.size();
  std::vector<int> psi(static_cast<std::size_t>(parameters.size() - own));
  std::iota(psi.begin(), psi.end(), static_cast<int>(own));
  Response response;
  model.evaluate(*of.block, parameters, psi, &response);
  std::vector<Signals> fresh;
  fresh.reserve(psi.size() + 1);
  for (const int j : psi)
    fresh.push_back(
        atMeans(response.derivatives[static_cast<std::size_t>(j)], base_.xi, *of.block));
  fresh.push_back(atMeans(response.value, base_.xi, *of.block));
  std::vector<const Signals*> added, all = of.list;
  added.reserve(fresh.size());
  for (const Signals& signal : fresh) added.push_back(signal.cols() == 0 ? nullptr : &signal);
  all.insert(all.end(), added.begin(), added.end());
  return {response.value.log_jacobian.head(of.block->lanes).sum(), innerProducts(added, all),
          static_cast<Index>(all.size())};
}

/// Gram matrix of [Phi J psi r] of one experiment, the columns of random signals and nuisances and
/// the error parameters xi integrated out.
MatrixXd Screening::marginalGram(const BaseBlock& of, const Candidate& candidate, int lane) const {
  const Index n = base_.xi.rows(), total = candidate.signals;
  const auto old = static_cast<Index>(of.list.size());
  const Index columns = of.response.column_precision.size();
  MatrixXd gram(total, total);
  for (Index i = 0; i < old; ++i) {
    for (Index j = 0; j < old; ++j)
      gram(i, j) = of.products[static_cast<std::size_t>(i * old + j)][lane];
  }
  for (Index i = old; i < total; ++i) {
    for (Index j = 0; j < total; ++j)
      gram(i, j) = gram(j, i) =
          candidate.products[static_cast<std::size_t>((i - old) * total + j)][lane];
  }
  MatrixXd inner = gram.topLeftCorner(columns, columns);
  inner.diagonal() += of.response.column_precision;
  const MatrixXd cross = gram.topRightCorner(columns, total - columns);
  MatrixXd rest = gram.bottomRightCorner(total - columns, total - columns);
  if (columns > 0) rest -= cross.transpose() * PseudoInverse(inner).inverse * cross;
  const Eigen::Map<const MatrixXd> P(
      covariances_.col(of.block->index[static_cast<std::size_t>(lane)]).data(), n, n);
  const MatrixXd to_phi = rest.topRows(n);
  rest -= to_phi.transpose() * P * to_phi / base_.at.noise_variance;
  return rest;
}

double Screening::regressionGain(const ExtendedModel& model, const VectorXd& parameters,
                                 VectorXd* step) const {
  const Index own = base_.at.parameters.size(), extra = parameters.size() - own;
  const Index n = base_.xi.rows(), size = own + n + extra + 1;
  MatrixXd sum = MatrixXd::Zero(size, size);
  double jacobian = 0;
  for (const BaseBlock& of : blocks_) {
    const Candidate candidate = evaluate(model, parameters, of);
    jacobian += candidate.log_jacobian;
    for (int lane = 0; lane < of.block->lanes; ++lane) sum += marginalGram(of, candidate, lane);
  }
  VectorXd least;
  const double left = leftover(sum, &least);
  *step = least.tail(own + extra);
  if (!(left > 0) || !std::isfinite(left)) return -std::numeric_limits<double>::infinity();
  return -0.5 * samples_ * std::log(left) + jacobian - base_jacobian_;
}

Screening::Start Screening::startAt(const std::shared_ptr<const ExtendedModel>& model,
                                    const VectorXd& psi) const {
  constexpr int kMixtureSteps = 5;
  ModelParameters at = base_.at;
  at.parameters.conservativeResize(at.parameters.size() + psi.size());
  at.parameters.tail(psi.size()) = psi;
  Start start{{model, at, base_.log_likelihood, {}, base_.xi}, 0, {}};
  if (!model->admissible(at.parameters)) {
    start.gain = -std::numeric_limits<double>::infinity();
  } else if (model->effects().back()->description().screening == ScreeningKind::regression) {
    start.gain = regressionGain(*model, at.parameters, &start.step) - base_gain_;
  } else {
    start.fit = mixtureFitted(model, at, data_, options_, kMixtureSteps);
    start.gain = start.fit.log_likelihood - base_.log_likelihood;
  }
  return start;
}

Screening::Start Screening::best(const std::shared_ptr<const Effect>& effect) const {
  Effects effects = base_.model->effects();
  effects.push_back(effect);
  std::shared_ptr<const ExtendedModel> model = base_.model->with(effects);
  if (model->isLocallyLinear() && base_.model->currentPoints().size() == 0)
    model = model->about(base_.xi);
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  Start best{{}, kNone, {}};
  if (!effect->description().starts.empty()) {  // in case that no start has a likelihood
    const VectorXd& psi = effect->description().starts.front();
    best.fit = {model, base_.at, kNone, {}, base_.xi};
    best.fit.at.parameters.conservativeResize(base_.at.parameters.size() + psi.size());
    best.fit.at.parameters.tail(psi.size()) = psi;
  }
  if (effect->has(Trait::own_shifts)) {  // the shifts do not depend on their variance, which is psi
    ModelParameters with = base_.at;
    with.parameters.conservativeResize(with.parameters.size() + 1);
    with.parameters.tail(1).setZero();
    model = model->about(clockStart(*model, with, data_));
  }
  const auto& parameters = effect->description().parameters;
  const bool one_variance = parameters.size() == 1 && parameters.front().log_variance;
  for (const VectorXd& psi : effect->description().starts) {
    Start start = startAt(model, psi);
    const bool falls = !(start.gain > best.gain);
    if (!falls) best = std::move(start);
    // The starts of a variance are in rising order, and the likelihood has one maximum over it.
    if (falls && one_variance) break;
  }
  return best;
}

}  // namespace uncertainty_identification
