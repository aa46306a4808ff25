#include "estimation/likelihood.h"

#include "math/pseudo_inverse.h"
#include "model/column_coefficients.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void subtractScaled(const Signals& signal, const Lanes& factor, Signals* from) {
  if (signal.cols() == 0) return;
  if (from->cols() < signal.cols()) *from = withZerosUntil(signal.cols(), *from);
  from->leftCols(signal.cols()) -= signal.colwise() * factor;
}

/// Row i of a matrix with one column per experiment, as one value per lane.
Lanes lanesOf(const MatrixXd& values, Index row, const Block& block) {
  Lanes lanes = Lanes::Zero();
  for (int lane = 0; lane < block.lanes; ++lane)
    lanes[lane] = values(row, block.index[static_cast<std::size_t>(lane)]);
  return lanes;
}

/// Derivatives d_j of the residual e - Phi m - Z zeta with respect to the parameters.
std::vector<Signals> sensitivities(const Response& response, const Block& block,
                                   const LatentMoments& moments) {
  const MatrixXd zeta =
      columnCoefficients(response, unexplainedBy(response, block, moments.means), block.lanes);
  std::vector<Signals> all;
  for (const WhitenedSignals& tangent : response.derivatives) {
    Signals d = tangent.residual;
    for (std::size_t i = 0; i < tangent.regressors.size(); ++i) {
      subtractScaled(tangent.regressors[i], lanesOf(moments.means, static_cast<Index>(i), block),
                     &d);
    }
    for (std::size_t k = 0; k < tangent.columns.size(); ++k) {
      if (tangent.columns[k] == nullptr) continue;
      subtractScaled(*tangent.columns[k], zeta.row(static_cast<Index>(k)).transpose().array(), &d);
    }
    all.push_back(std::move(d));
  }
  return all;
}

/// Fisher information of parameters that change the precisions of random effects: 1/2 dp' (M o M)
/// dp with M = precision^-1 - A^-1, A = Z'Z + precision, over the columns with a proper prior.
MatrixXd precisionInformation(const Response& response, const MatrixXd& inverse_of_A) {
  const VectorXd& precision = response.column_precision;
  const auto p = static_cast<Index>(response.column_precision_derivatives.size());
  MatrixXd dp(precision.size(), p);
  for (Index j = 0; j < p; ++j)
    dp.col(j) = response.column_precision_derivatives[static_cast<std::size_t>(j)];
  MatrixXd M = -inverse_of_A;
  for (Index k = 0; k < precision.size(); ++k) {
    if (precision[k] > 0) {
      M(k, k) += 1 / precision[k];
    } else {
      M.row(k).setZero();
      M.col(k).setZero();
    }
  }
  return 0.5 * dp.transpose() * M.cwiseAbs2() * dp;
}

/// The Gram matrix of [Phi d] in each lane, Phi and d after the columns have been integrated out,
/// and the inverse of Z'Z + precision.
std::vector<MatrixXd> sensitivityProducts(const Response& response, const Block& block,
                                          const LatentMoments& moments,
                                          std::vector<MatrixXd>* inverses) {
  const std::vector<Signals> d = sensitivities(response, block, moments);
  const Index columns = response.column_precision.size();
  std::vector<const Signals*> list;
  for (const auto& column : response.value.columns) list.push_back(column.get());
  for (const Signals& regressor : response.value.regressors) list.push_back(&regressor);
  for (const Signals& signal : d) list.push_back(&signal);
  std::vector<MatrixXd> grams = gramOf(list, block.lanes);
  for (MatrixXd& gram : grams) {
    const Index rest = gram.cols() - columns;
    MatrixXd inner = gram.topLeftCorner(columns, columns);
    inner.diagonal() += response.column_precision;
    const MatrixXd cross = gram.topRightCorner(columns, rest);
    inverses->push_back(PseudoInverse(inner).inverse);
    gram =
        (gram.bottomRightCorner(rest, rest) - cross.transpose() * inverses->back() * cross).eval();
  }
  return grams;
}

/// Information from the products of [Phi d] of each lane.
ScoringInformation informationOf(const std::vector<MatrixXd>& products, const Block& block, Index n,
                                 const ModelParameters& at, const LatentMoments& moments) {
  const Index p = products.front().rows() - n;
  ScoringInformation sum{MatrixXd::Zero(p + n, p + n), MatrixXd::Zero(p + n, p + n)};
  for (std::size_t lane = 0; lane < products.size(); ++lane) {
    const MatrixXd& rest = products[lane];
    MatrixXd all(p + n, p + n), to_phi(n, p + n);  // [d, -Phi], and Phi'[d, -Phi]
    all << rest.bottomRightCorner(p, p), -rest.bottomLeftCorner(p, n), -rest.topRightCorner(n, p),
        rest.topLeftCorner(n, n);
    to_phi << rest.topRightCorner(n, p), -rest.topLeftCorner(n, n);
    const Eigen::Map<const MatrixXd> P(moments.covariances.col(block.index[lane]).data(), n, n);
    sum.complete += all / at.noise_variance;
    sum.observed += all / at.noise_variance -
                    to_phi.transpose() * P * to_phi / (at.noise_variance * at.noise_variance);
  }
  return sum;
}

/// The same by the general path.
ScoringInformation informationOf(const Response& response, const Block& block, Index n,
                                 const ModelParameters& at, const LatentMoments& moments) {
  std::vector<MatrixXd> inverses;
  const std::vector<MatrixXd> products = sensitivityProducts(response, block, moments, &inverses);
  ScoringInformation sum = informationOf(products, block, n, at, moments);
  if (response.column_precision_derivatives.empty()) return sum;
  const auto p = static_cast<Index>(response.derivatives.size());
  for (const MatrixXd& inverse : inverses) {
    const MatrixXd of_precision = precisionInformation(response, inverse);
    sum.complete.topLeftCorner(p, p) += of_precision;
    sum.observed.topLeftCorner(p, p) += of_precision;
  }
  return sum;
}

}  // namespace

Likelihood::Likelihood(const Model& model, const std::vector<Block>& blocks, int experiments,
                       int threads)
    : model_(model),
      blocks_(blocks),
      experiments_(experiments),
      pool_(std::make_unique<WorkerPool>(threads)) {}

Statistics Likelihood::statistics(const VectorXd& parameters, bool derivatives) const {
  ++passes_;
  Statistics statistics(experiments_, model_.regressors(),
                        derivatives ? model_.parameterCount() : 0);
  const bool keep = derivatives && keepsResponses();
  if (keep) {
    responses_.resize(blocks_.size());
    responses_at_ = parameters;
  }
  const auto fused = model_.prepare(blocks_, parameters, derivatives);
  pool_->forEach(static_cast<int>(blocks_.size()), [&](int i) {
    const auto block = static_cast<std::size_t>(i);
    if (fused != nullptr && fused->statistics(blocks_[block], &statistics)) return;
    Response passing;
    computeStatistics(model_, blocks_[block], parameters, &statistics,
                      keep ? &responses_[block] : &passing);
  });
  return statistics;
}

/// Whether the responses of all blocks are small enough to be kept from statistics() for
/// information(), which usually follows at the same parameters.
bool Likelihood::keepsResponses() const {
  constexpr double kMost = 4e6;
  double samples = 0;
  for (const Block& block : blocks_) samples += static_cast<double>(block.samples) * kLanes;
  return samples * model_.parameterCount() * (model_.regressors() + 1) < kMost;
}

ScoringInformation Likelihood::information(const ModelParameters& at,
                                           const LatentMoments& moments) const {
  const bool kept = responses_.size() == blocks_.size() && responses_at_ == at.parameters;
  if (!kept) ++passes_;
  const auto fused = model_.prepare(blocks_, at.parameters, true);
  std::vector<ScoringInformation> parts(blocks_.size());
  pool_->forEach(static_cast<int>(blocks_.size()), [&](int i) {
    const auto block = static_cast<std::size_t>(i);
    std::vector<MatrixXd> products;
    if (fused != nullptr && fused->sensitivities(blocks_[block], moments.means, &products)) {
      parts[block] = informationOf(products, blocks_[block], model_.regressors(), at, moments);
      return;
    }
    Response fresh;
    const bool evaluated = kept && !responses_[block].derivatives.empty();
    if (!evaluated) model_.evaluate(blocks_[block], at.parameters, true, &fresh);
    parts[block] = informationOf(evaluated ? responses_[block] : fresh, blocks_[block],
                                 model_.regressors(), at, moments);
  });
  ScoringInformation sum = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    sum.complete += parts[i].complete;
    sum.observed += parts[i].observed;
  }
  return sum;
}

}  // namespace uncertainty_identification
