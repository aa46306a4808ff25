#include "identification/steps.h"
#include "residual_tests/window_scores.h"

namespace uncertainty_identification {
namespace {

/// Parts of the data beyond twice the number of parameters, so that their scores show how all
/// parameters scatter; none where they would be shorter than the samples that a score needs.
int partsOf(const Likelihood& likelihood, Eigen::Index parameters) {
  constexpr int kBeyond = 20;
  constexpr long kShortest = 25;  // samples
  long samples = 0;
  for (const Block& block : likelihood.blocks())
    for (int lane = 0; lane < block.lanes; ++lane)
      samples += block.lengths[static_cast<std::size_t>(lane)];
  const int parts = 2 * static_cast<int>(parameters) + kBeyond;
  return samples / parts < kShortest ? 0 : parts;
}

}  // namespace

StandardErrors errorsOfFit(const Likelihood& likelihood, const Parametrisation& parametrisation,
                           const ModelParameters& point) {
  const int parts = partsOf(likelihood, parametrisation.size());
  const bool by_parts = likelihood.experiments() <= parametrisation.size() &&
                        likelihood.model().regressors() == 0 && parts > 0;
  if (!by_parts) return standardErrors(likelihood, parametrisation, point);
  return standardErrors(likelihood, parametrisation, point,
                        windowScores(likelihood.model(), likelihood.blocks(), point.parameters,
                                     point.noise_variance, parts));
}

}  // namespace uncertainty_identification
