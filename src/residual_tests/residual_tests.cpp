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

/// The signal `first`, `first` + 1, ... samples earlier, a column each (samples x columns), zero
/// before its beginning, and only where `used` is 1.
MatrixXd laggedBy(Index first, Index columns, const VectorXd& signal, const VectorXd& used) {
  const Index samples = signal.size();
  MatrixXd lagged = MatrixXd::Zero(samples, columns);
  for (Index k = 0; k < columns && first + k < samples; ++k)
    lagged.col(k).tail(samples - first - k) = signal.head(samples - first - k);
  return used.asDiagonal() * lagged;
}

/// Sums over all experiments.
struct Sums {
  VectorXd products;     ///< of residuals k apart, k = 0, 1, ...
  double residuals = 0;  ///< their number
  TestedProducts past;   ///< of the residuals 1, 2, ... samples earlier, 0 before the first one
  TestedProducts input;  ///< of the inputs 0, 1, ... samples earlier, where there are as many
  EstimatedParameters parameters;

  TestedProducts nonlinear;       ///< of what a plant that is not linear would add
  EstimatedParameters linear;     ///< the parameters, past and input: what any linear model may add
  double squares = 0, terms = 0;  ///< of the residuals that `nonlinear` was compared with

  Sums(Index lags, Index signals, Index p)
      : products(VectorXd::Zero(lags + 1)),
        past(lags, p),
        input(lags + 1, p),
        parameters(p),
        nonlinear(signals, p + 2 * lags + 1),
        linear(p + 2 * lags + 1) {}

  Index lags() const { return products.size() - 1; }

  /// `signals`: a column for each signal of `nonlinear`.
  void add(const RecursiveResiduals& experiment, const VectorXd& u, const MatrixXd& signals) {
    const Index samples = u.size(), K = lags(), later = std::max<Index>(samples - K, 0);
    const VectorXd& w = experiment.values;
    for (Index k = 0; k <= std::min(K, samples - 1); ++k)
      products[k] += w.tail(samples - k).dot(w.head(samples - k));
    VectorXd after_lags = experiment.valid;
    after_lags.head(samples - later).setZero();
    const MatrixXd before = laggedBy(1, K, w, experiment.valid);
    const MatrixXd inputs = laggedBy(0, K + 1, u, after_lags);
    past.add(before, w, experiment.derivatives);
    input.add(inputs, w, experiment.derivatives);
    parameters.add(w, experiment.derivatives);
    residuals += experiment.valid.sum();
    if (signals.cols() == 0) return;
    MatrixXd regressors(samples, experiment.derivatives.cols() + before.cols() + inputs.cols());
    regressors << experiment.derivatives, before, inputs;
    nonlinear.add(after_lags.tail(later).asDiagonal() * signals.bottomRows(later), w.tail(later),
                  regressors.bottomRows(later));
    linear.add(w.tail(later), regressors.bottomRows(later));
    squares += w.tail(later).squaredNorm();
    terms += after_lags.sum();
  }
};

/// F test of a linear regression of residuals, `terms` many with the sum of squares `squares`, on
/// test signals beside others whose coefficients were estimated.
double pValue(const TestedProducts& tested, const EstimatedParameters& beside, double squares,
              double terms, double* share = nullptr) {
  const QuadraticForm of_parameters = beside.explained();
  const QuadraticForm form = withoutParameters(tested, beside);
  const double rest = squares - of_parameters.value - form.value;
  if (share != nullptr) *share = form.value / squares;
  const double degrees = terms - of_parameters.rank - form.rank;
  if (form.rank < 1 || degrees < 1 || !(rest > 0)) return kNone;
  return fisherTail(form.value / form.rank / (rest / degrees), form.rank, degrees);
}

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
  const double squares = sums.products[0];
  tests.whiteness_p_value = pValue(sums.past, sums.parameters, squares, sums.residuals);
  tests.independence_p_value = pValue(sums.input, sums.parameters, squares, sums.residuals);
  if (sums.nonlinear.with_residual.size() > 0)
    tests.linearity_p_value =
        pValue(sums.nonlinear, sums.linear, sums.squares, sums.terms, &tests.nonlinear_share);
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
      MatrixXd own(samples, signals);
      for (Index k = 0; k < signals; ++k)
        own.col(k) = nonlinear[b][static_cast<std::size_t>(k)].row(lane).head(samples).transpose();
      sums.add(recursiveResiduals(response, block, lane), u, own);
    }
  }
  return testsOf(sums);
}

}  // namespace uncertainty_identification
