#include "residual_tests/test_statistics.h"

#include <algorithm>
#include <cmath>

#include "math/distributions.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double chiSquaredTail(double sum, double degrees, double undefined) {
  if (!std::isfinite(sum) || degrees < 1) return undefined;
  return chiSquaredTail(std::max(0.0, sum), degrees);
}

double twoSidedNormalTail(double z) { return std::isfinite(z) ? 2 * normalTail(std::abs(z)) : 1; }

QuadraticForm quadraticForm(const MatrixXd& A, const VectorXd& x, double threshold) {
  const SymmetricEigen of_A(A);
  const VectorXd along = of_A.eigenvectors().transpose() * x;
  QuadraticForm form;
  for (Index k = 0; k < x.size(); ++k) {
    if (of_A.eigenvalues()[k] < threshold * of_A.eigenvalues().maxCoeff()) continue;
    form.value += along[k] * along[k] / of_A.eigenvalues()[k];
    ++form.rank;
  }
  return form;
}

VectorXd scaledCorrelations(const std::vector<Signals>& signals, int lags, double samples) {
  VectorXd sums = VectorXd::Zero(lags);
  for (const Signals& signal : signals) {
    for (int k = 1; k <= std::min<int>(lags, static_cast<int>(signal.cols()) - 1); ++k)
      sums[k - 1] +=
          (signal.rightCols(signal.cols() - k) * signal.leftCols(signal.cols() - k)).sum();
  }
  return sums / std::sqrt(samples);
}

VectorXd scaledTimeBins(const std::vector<Signals>& signals, const std::vector<Block>& blocks,
                        int bins) {
  VectorXd sums = VectorXd::Zero(bins), counts = VectorXd::Zero(bins);
  for (std::size_t b = 0; b < signals.size(); ++b) {
    const Block& block = blocks[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int length = block.lengths[static_cast<std::size_t>(lane)];
      for (int t = 0; t < length; ++t) {
        const int bin = t * bins / length;
        sums[bin] += signals[b](lane, t);
        counts[bin] += block.weight(lane, t);
      }
    }
  }
  return sums.cwiseQuotient(counts.cwiseMax(1).cwiseSqrt());
}

}  // namespace uncertainty_identification
