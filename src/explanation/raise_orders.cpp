#include "raise_orders.h"

#include <cmath>
#include <optional>

#include "estimate_fit.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

double likelihoodOf(const Estimate& estimate, const std::vector<Experiment>& experiments,
                    const FitContext& context) {
  const FitData data(usedBy(estimate, experiments));
  return settled(fitOf(estimate, data, summarise(data.experiments())), data, context)
      .log_likelihood;
}

/// The same with more poles and zeros; nothing where the data are too few for them.
std::optional<Estimate> withMore(const Estimate& estimate, int poles,
                                 const std::vector<Experiment>& experiments,
                                 const ProgressCallback& progress) {
  Configuration larger = estimate.configuration;
  larger.nominal_model.na += poles;
  larger.nominal_model.nb += poles;
  try {
    Estimate found = Identifier(larger).identify(experiments, {}, progress);
    if (found.usable()) return found;
  } catch (const DataError&) {
  }
  return std::nullopt;
}

}  // namespace

Estimate withOrdersAskedFor(const Configuration& asked, Estimate estimate,
                            const std::vector<Experiment>& experiments, const FitContext& context,
                            const ProgressCallback& progress) {
  constexpr int kMostAtOnce = 2;  // a resonance
  if (!asked.nominal_model.orders_auto || !estimate.usable()) return estimate;
  double reached = likelihoodOf(estimate, experiments, context);
  for (int more = 1; more <= kMostAtOnce;) {
    const int poles = estimate.configuration.nominal_model.na + more;
    if (poles > asked.nominal_model.max_order || !context.going_on()) break;
    const auto candidate = withMore(estimate, more, experiments, progress);
    if (!candidate) break;
    const double gain = likelihoodOf(*candidate, experiments, context) - reached;
    if (gain <
        more * std::log(static_cast<double>(estimate.sample_count))) {  // two parameters each
      ++more;
      continue;
    }
    estimate = *candidate;
    reached += gain;
    more = 1;
  }
  return estimate;
}

}  // namespace uncertainty_identification
