#include "explanation/feedback_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "math/distributions.h"
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
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int length = block.lengths[static_cast<std::size_t>(lane)];
      use(VectorXd(block.u.row(lane).head(length).transpose().matrix()),
          VectorXd(residuals.standardised[b].row(lane).head(length).transpose().matrix()));
    }
  }
}

/// x(t), x(t - 1), ..., x(t - kPredictorOrder).
VectorXd past(const VectorXd& x, Index t) {
  return x.segment(t - kPredictorOrder, kPredictorOrder + 1).reverse();
}

/// Finds the filter (1, -p_1, -p_2, ...) that leaves of a signal what its own past does not
/// predict.
class Predictor {
 public:
  void add(const VectorXd& x) {
    for (Index t = kPredictorOrder; t < x.size(); ++t) {
      gram_ += past(x, t) * past(x, t).transpose();
      ++samples_;
    }
  }

  /// Empty where the data are too few, or where nothing is left.
  VectorXd filter() const {
    const double power = gram_(0, 0);
    if (samples_ < 10 * kPredictorOrder) return {};
    MatrixXd inner = gram_.bottomRightCorner(kPredictorOrder, kPredictorOrder);
    inner.diagonal() *= 1 + 1e-9;
    inner.diagonal().array() += 1e-12 * power;
    VectorXd filter(kPredictorOrder + 1);
    filter << 1, -inner.ldlt().solve(gram_.bottomLeftCorner(kPredictorOrder, 1));
    if (filter.dot(gram_ * filter) < 1e-6 * power) return {};
    return filter;
  }

 private:
  MatrixXd gram_ = MatrixXd::Zero(kPredictorOrder + 1, kPredictorOrder + 1);
  double samples_ = 0;
};

/// What the filter leaves of a signal; shorter by the filter's order.
VectorXd filtered(const VectorXd& filter, const VectorXd& x) {
  VectorXd left(std::max<Index>(0, x.size() - kPredictorOrder));
  for (Index t = kPredictorOrder; t < x.size(); ++t)
    left[t - kPredictorOrder] = filter.dot(past(x, t));
  return left;
}

}  // namespace

// Feedback makes the input depend on earlier noise. What is new in the input is therefore compared
// with what was new in the earlier residuals; without feedback it is independent of all that was
// before it, whatever the residuals hold.
FeedbackTest testFeedback(const Residuals& residuals, const FitData& data) {
  constexpr Index kLags = 4;                   // at which a loop answers
  constexpr Index kFirstLate = 9, kLate = 16;  // at which it has answered
  constexpr double kPeculiar = 1e-3;
  Predictor of_input, of_residual;
  forEachExperiment(residuals, data, [&](const VectorXd& u, const VectorXd& w) {
    of_input.add(u);
    of_residual.add(w);
  });
  const VectorXd input_filter = of_input.filter(), residual_filter = of_residual.filter();
  if (input_filter.size() == 0 || residual_filter.size() == 0) return {};
  const Index all = kFirstLate + kLate - 1;
  Eigen::ArrayXd products = Eigen::ArrayXd::Zero(all),
                 squares = Eigen::ArrayXd::Constant(all, 1e-300);
  double power_of_input = 0, power_of_noise = 0, samples = 0;
  forEachExperiment(residuals, data, [&](const VectorXd& u, const VectorXd& w) {
    const VectorXd new_input = filtered(input_filter, u), noise = filtered(residual_filter, w);
    power_of_input += new_input.squaredNorm();
    power_of_noise += noise.squaredNorm();
    samples += static_cast<double>(noise.size());
    for (Index k = 1; k <= std::min<Index>(all, noise.size() - 1); ++k) {
      const Index count = noise.size() - k;
      const Eigen::ArrayXd product = noise.head(count).array() * new_input.tail(count).array();
      products[k - 1] += product.sum();
      squares[k - 1] += product.square().sum();
    }
  });
  const Eigen::ArrayXd statistics = products.square() / squares;
  // An input that fifteen samples do not predict, but a longer past does, correlates with whatever
  // the residuals hold of that past: at all lags, and not only while a loop answers.
  const double ratio = statistics.head(kLags).mean() / std::max(statistics.tail(kLate).mean(), 1.0);
  if (!(fisherTail(ratio, kLags, kLate) < kPeculiar)) return {};
  const double by_chance = kLags / samples;
  const double share = products.head(kLags).square().sum() / (power_of_input * power_of_noise);
  return {chiSquaredTail(statistics.head(kLags).sum(), kLags, 1), share - by_chance};
}

}  // namespace uncertainty_identification
