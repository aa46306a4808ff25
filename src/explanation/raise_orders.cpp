#include "raise_orders.h"

#include <cmath>

#include "estimate_fit.h"

namespace uncertainty_identification {
namespace {

double likelihoodOf(const Estimate& estimate, const std::vector<Experiment>& experiments,
                    const FitContext& context) {
  const FitData data(usedBy(estimate, experiments));
  return settled(fitOf(estimate, data, summarise(data.experiments())), data, context)
      .log_likelihood;
}

}  // namespace

Estimate withOrdersAskedFor(const Configuration& asked, Estimate estimate,
                            const std::vector<Experiment>& experiments, const FitContext& context,
                            const ProgressCallback& progress) {
  constexpr int kMostAtOnce = 2;  // a resonance
  if (!asked.nominal_model.orders_auto || !estimate.usable()) return estimate;
  double reached = likelihoodOf(estimate, experiments, context);
  for (int more = 1; more <= kMostAtOnce;) {
    Configuration larger = estimate.configuration;
    larger.nominal_model.na += more;
    larger.nominal_model.nb += more;
    if (larger.nominal_model.na > asked.nominal_model.max_order || !context.going_on()) break;
    const Estimate candidate = Identifier(larger).identify(experiments, {}, progress);
    if (!candidate.usable()) break;
    const double gain = likelihoodOf(candidate, experiments, context) - reached;
    if (gain <
        more * std::log(static_cast<double>(estimate.sample_count))) {  // two parameters each
      ++more;
      continue;
    }
    estimate = candidate;
    reached += gain;
    more = 1;
  }
  return estimate;
}

}  // namespace uncertainty_identification
