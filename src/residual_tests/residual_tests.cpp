#include "residual_tests/residual_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/distributions.h"
#include "residual_tests/nonlinear_signals.h"
#include "residual_tests/recursive_residuals.h"
#include "residual_tests/test_statistics.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Sums over all experiments.
struct Sums {
  VectorXd products;         ///< of residuals k apart, k = 0, 1, ...
  double residuals = 0;      ///< their number
  TestedProducts past;       ///< of the residuals 1, 2, ... samples earlier, 0 before the first one
  TestedProducts input;      ///< of the inputs 0, 1, ... samples earlier
  TestedProducts nonlinear;  ///< of what a plant that is not linear would add
  EstimatedParameters parameters;

  Sums(Index lags, Index signals, Index p)
      : products(VectorXd::Zero(lags + 1)),
        past(lags, p),
        input(lags + 1, p),
        nonlinear(signals, p),
        parameters{MatrixXd::Zero(p, p), VectorXd::Zero(p)} {}

  Index lags() const { return products.size() - 1; }

  /// `signals`: a row for each signal of `nonlinear`.
  void add(const RecursiveResiduals& experiment, const VectorXd& u, const MatrixXd& signals) {
    const Index samples = u.size(), K = lags();
    const VectorXd& w = experiment.values;
    const MatrixXd& D = experiment.derivatives;
    for (Index k = 0; k <= std::min(K, samples - 1); ++k)
      products[k] += w.tail(samples - k).dot(w.head(samples - k));
    VectorXd before = VectorXd::Zero(K + samples);
    before.tail(samples) = w;
    for (Index t = 0; t < samples; ++t) {
      if (experiment.valid[t] == 0) continue;
      nonlinear.add(signals.col(t), w[t], D.row(t).transpose());
      past.add(before.segment(t, K).reverse(), w[t], D.row(t).transpose());
      if (t >= K) input.add(u.segment(t - K, K + 1).reverse(), w[t], D.row(t).transpose());
    }
    residuals += experiment.valid.sum();
    parameters.information += D.transpose() * D;
    parameters.score += D.transpose() * w;
  }

  /// F test of a linear regression of the residuals on the test signals, in which the parameters
  /// were estimated too.
  double pValue(const TestedProducts& tested, double* share = nullptr) const {
    const QuadraticForm of_parameters = parameters.explained();
    const QuadraticForm form = withoutParameters(tested, parameters);
    const double rest = products[0] - of_parameters.value - form.value;
    if (share != nullptr) *share = form.value / products[0];
    const double degrees = residuals - of_parameters.rank - form.rank;
    if (form.rank < 1 || degrees < 1 || !(rest > 0)) return kNone;
    return fisherTail(form.value / form.rank / (rest / degrees), form.rank, degrees);
  }
};

ResidualTests testsOf(const Sums& sums) {
  ResidualTests tests;
  const Index lags = sums.lags();
  if (!(sums.residuals > 2 * static_cast<double>(lags)) || !(sums.products[0] > 0)) return tests;
  tests.samples = static_cast<long>(sums.residuals);
  for (Index k = 1; k <= lags; ++k)
    tests.autocorrelation.push_back(sums.products[k] / sums.products[0]);
  for (Index k = 0; k <= lags; ++k) {
    const double scale = std::sqrt(sums.products[0] * sums.input.squares(k, k));
    tests.cross_correlation.push_back(scale > 0 ? sums.input.with_residual[k] / scale : 0);
  }
  tests.whiteness_p_value = sums.pValue(sums.past);
  tests.independence_p_value = sums.pValue(sums.input);
  if (sums.nonlinear.with_residual.size() > 0)
    tests.linearity_p_value = sums.pValue(sums.nonlinear, &tests.nonlinear_share);
  return tests;
}

/// Number of lags: 20, more for many parameters, which take up some of them, and a third of the
/// longest experiment at most.
Index lagsOf(const std::vector<Block>& blocks, Index parameters) {
  constexpr Index kLags = 20, kBeyondParameters = 5;
  Index longest = 0;
  for (const Block& block : blocks) longest = std::max<Index>(longest, block.samples);
  return std::max<Index>(1, std::min(std::max(kLags, parameters + kBeyondParameters), longest / 3));
}

}  // namespace

ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const VectorXd& parameters, const Polynomials* nominal) {
  std::vector<std::vector<Signals>> nonlinear(blocks.size());
  if (nominal != nullptr) nonlinear = nonlinearSignals(*nominal, blocks);
  const auto signals = static_cast<Index>(nonlinear.empty() ? 0 : nonlinear.front().size());
  Sums sums(lagsOf(blocks, parameters.size()), signals, parameters.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    Response response;
    model.evaluate(block, parameters, true, &response);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Index samples = block.lengths[static_cast<std::size_t>(lane)];
      VectorXd u = block.u.row(lane).head(samples).transpose();
      u.array() -= u.mean();
      MatrixXd own(signals, samples);
      for (Index k = 0; k < signals; ++k)
        own.row(k) = nonlinear[b][static_cast<std::size_t>(k)].row(lane).head(samples).matrix();
      sums.add(recursiveResiduals(response, block, lane), u, own);
    }
  }
  return testsOf(sums);
}

}  // namespace uncertainty_identification
