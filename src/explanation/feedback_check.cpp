#include "explanation/feedback_check.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "residual_tests/test_statistics.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPredictorOrder = 15;

/// Calls `use` with the input and the standardised residual of each experiment.
template <typename Use>
void forEachExperiment(const Residuals& residuals, const FitData& data, const Use& use) {
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane)
      use(block.u.row(lane).head(block.lengths[static_cast<std::size_t>(lane)]).matrix(),
          residuals.standardised[b].row(lane).matrix());
  }
}

/// u(t), u(t - 1), ..., u(t - kPredictorOrder).
template <typename Row>
VectorXd past(const Row& u, Index t) {
  VectorXd values(kPredictorOrder + 1);
  for (Index k = 0; k <= kPredictorOrder; ++k) values[k] = u[t - k];
  return values;
}

/// The filter (1, -p_1, -p_2, ...) that leaves of the input what its own past does not predict.
/// Empty where the data are too few, or where nothing is left.
VectorXd inputInnovationFilter(const Residuals& residuals, const FitData& data) {
  MatrixXd gram = MatrixXd::Zero(kPredictorOrder + 1, kPredictorOrder + 1);
  double power = 0, samples = 0;
  forEachExperiment(residuals, data, [&](const auto& u, const auto& /*w*/) {
    for (Index t = kPredictorOrder; t < u.size(); ++t) {
      gram += past(u, t) * past(u, t).transpose();
      power += u[t] * u[t];
      ++samples;
    }
  });
  if (samples < 10 * kPredictorOrder) return {};
  MatrixXd inner = gram.bottomRightCorner(kPredictorOrder, kPredictorOrder);
  inner.diagonal() *= 1 + 1e-9;
  inner.diagonal().array() += 1e-12 * power;
  VectorXd predictor(kPredictorOrder + 1);
  predictor << 1, -inner.ldlt().solve(gram.bottomLeftCorner(kPredictorOrder, 1));
  if (predictor.dot(gram * predictor) < 1e-6 * power) return {};
  return predictor;
}

}  // namespace

double feedbackProbability(const Residuals& residuals, const FitData& data) {
  constexpr int kLags = 4;
  constexpr double kNone = 1;
  const VectorXd predictor = inputInnovationFilter(residuals, data);
  if (predictor.size() == 0) return kNone;
  VectorXd products = VectorXd::Zero(kLags), squares = VectorXd::Zero(kLags);
  forEachExperiment(residuals, data, [&](const auto& u, const auto& w) {
    for (Index t = kPredictorOrder; t < u.size(); ++t) {
      const double innovation = predictor.dot(past(u, t));
      for (Index k = 1; k <= kLags && t - k >= kPredictorOrder; ++k) {
        products[k - 1] += w[t - k] * innovation;
        squares[k - 1] += std::pow(w[t - k] * innovation, 2);
      }
    }
  });
  const double sum = (products.array().square() / squares.array().max(1e-300)).sum();
  return chiSquaredTail(sum, kLags, kNone);
}

}  // namespace uncertainty_identification
