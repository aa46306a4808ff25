#include "residual_tests/window_scores.h"

#include <algorithm>
#include <cmath>

#include "math/interruption.h"
#include "residual_tests/recursive_residuals.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double samplesOf(const std::vector<Block>& blocks) {
  double samples = 0;
  for (const Block& block : blocks)
    for (int lane = 0; lane < block.lanes; ++lane)
      samples += block.lengths[static_cast<std::size_t>(lane)];
  return samples;
}

/// The score of the samples [first, first + count).
VectorXd scoreOf(const RecursiveResiduals& of, Index first, Index count, double noise_variance) {
  const VectorXd w = of.values.segment(first, count);
  VectorXd score(of.derivatives.cols() + 1);
  score.head(of.derivatives.cols()) =
      -of.derivatives.middleRows(first, count).transpose() * w / noise_variance;
  score[of.derivatives.cols()] =
      (w.squaredNorm() / noise_variance - of.valid.segment(first, count).sum()) / 2;
  return score;
}

}  // namespace

MatrixXd windowScores(const Model& model, const std::vector<Block>& blocks,
                      const VectorXd& parameters, double noise_variance, int parts) {
  const double length = std::max(1.0, samplesOf(blocks) / parts);
  std::vector<VectorXd> scores;
  for (const Block& block : blocks) {
    checkpoint();
    Response response;
    model.evaluate(block, parameters, true, &response);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const RecursiveResiduals of = recursiveResiduals(response, block, lane);
      const Index samples = of.values.size();
      const auto own = std::max<Index>(1, std::lround(static_cast<double>(samples) / length));
      for (Index k = 0; k < own; ++k) {
        const Index first = samples * k / own, end = samples * (k + 1) / own;
        scores.push_back(scoreOf(of, first, end - first, noise_variance));
      }
    }
  }
  MatrixXd all(parameters.size() + 1, static_cast<Index>(scores.size()));
  for (std::size_t k = 0; k < scores.size(); ++k) all.col(static_cast<Index>(k)) = scores[k];
  return all;
}

}  // namespace uncertainty_identification
