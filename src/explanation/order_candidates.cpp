#include "explanation/order_candidates.h"

#include <cmath>
#include <optional>

#include "estimation/excerpt.h"
#include "estimation/simulation_fit.h"
#include "explanation/estimate_fit.h"
#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "math/information_criterion.h"
#include "math/polynomial.h"
#include "model/fixed_plant.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Log-likelihood of the estimate, optimised further by the search's own fit.
double likelihoodOf(const Estimate& estimate, const std::vector<Experiment>& experiments,
                    const FitContext& context) {
  const FitData data(usedBy(estimate, experiments));
  return optimise(fitOf(estimate, data, summarise(data.experiments())), data, context)
      .log_likelihood;
}

/// The estimate with its orders as they are, and Go as one of its parameters.
Estimate withFreePlant(Estimate estimate) {
  estimate.configuration.nominal_model.fit = PlantFit::likelihood;
  return estimate;
}

/// Estimates of models with other orders than a given estimate has, and compares them by BIC.
class OrderSearch {
 public:
  OrderSearch(const Estimate& chosen, const std::vector<Experiment>& experiments,
              const FitContext& context, const ProgressCallback& progress)
      : chosen_(chosen), experiments_(experiments), context_(context), progress_(progress) {}

  /// An estimate with its log-likelihood, the highest that was found for these orders.
  struct Model {
    Estimate estimate;
    double log_likelihood = 0;

    const NominalModelOptions& orders() const { return estimate.configuration.nominal_model; }
    /// Log-likelihood minus the BIC penalty [nats].
    double penalisedLikelihood() const {
      const double parameters = orders().na + orders().nb + orders().nc + orders().nd;
      const double samples = std::max(1.0, static_cast<double>(estimate.sample_count));
      return log_likelihood - bicPenalty(parameters, samples);
    }
  };

  Model chosen() const {
    const Model as_it_is{chosen_, likelihoodOf(withFreePlant(chosen_), experiments_, context_)};
    return with(chosen_.configuration.nominal_model, as_it_is).value_or(as_it_is);
  }

  /// The model of the given orders. It is identified from the data alone and, if the orders include
  /// those of `from`, optimised from that smaller model too; the better one is returned. Nothing
  /// where the data are too few, or the search is cancelled.
  std::optional<Model> with(NominalModelOptions orders, const Model& from) const {
    if (!context_.going_on()) return std::nullopt;
    orders.fit = PlantFit::likelihood;
    orders.structure = orders.nc + orders.nd > 0 ? Structure::box_jenkins : Structure::output_error;
    std::optional<Model> best = identified(orders);
    if (best && include(orders, from.orders())) optimiseFrom(from.estimate, &*best);
    return best;
  }

  /// Raises the orders of the plant as long as BIC improves: by a delay that is one sample shorter,
  /// by a pole and a zero, or by two of each.
  Model raised(Model from, int max_order) const {
    for (bool better = true; better;) {
      better = false;
      for (const NominalModelOptions& orders : larger(from.orders())) {
        if (orders.na > max_order) continue;
        const auto candidate = with(orders, from);
        better = candidate && candidate->penalisedLikelihood() > from.penalisedLikelihood();
        if (!better) continue;
        from = *candidate;
        break;
      }
    }
    return from;
  }

  /// Removes poles and zeros of the noise model as long as BIC does not become worse.
  Model pruned(Model from) const {
    while (from.orders().nd > 0) {
      const auto candidate = with(lessNoise(from.orders(), 1), from);
      if (!candidate || candidate->penalisedLikelihood() < from.penalisedLikelihood()) break;
      from = *candidate;
    }
    return from;
  }

  static NominalModelOptions lessNoise(NominalModelOptions orders, int poles) {
    orders.nd = std::max(0, orders.nd - poles);
    orders.nc = std::max(0, orders.nc - poles);
    return orders;
  }

  static NominalModelOptions lessPlant(NominalModelOptions orders) {
    orders.na -= 2;
    orders.nb = std::max(1, orders.nb - 2);
    return orders;
  }

 private:
  std::optional<Model> identified(const NominalModelOptions& orders) const {
    Configuration other = chosen_.configuration;
    other.nominal_model = orders;
    try {
      Estimate found = Identifier(other).identify(experiments_, {}, progress_);
      found.candidates = chosen_.candidates;
      const double likelihood =
          found.usable() ? likelihoodOf(found, experiments_, context_) : std::nan("");
      if (std::isfinite(likelihood)) return Model{found, likelihood};
    } catch (const DataError&) {
    }
    return std::nullopt;
  }

  /// Whether a model of the orders `large` can equal any of the orders `small`.
  static bool include(const NominalModelOptions& large, const NominalModelOptions& small) {
    return large.na >= small.na && large.nc >= small.nc && large.nd >= small.nd &&
           large.delay <= small.delay && large.nb + large.delay >= small.nb + small.delay;
  }

  /// Optimises a model of the orders of `best` from a smaller model, and replaces `best` if the
  /// likelihood is higher.
  void optimiseFrom(const Estimate& from, Model* best) const {
    const NominalModelOptions& orders = best->orders();
    Estimate start = from;
    start.configuration.nominal_model = orders;
    NominalModelEstimate& model = start.nominal_model;
    model.parameters.clear();
    model.b = padded(model.b, model.delay - orders.delay, orders.nb);
    model.delay = orders.delay;
    model.a = padded(model.a, 0, orders.na);
    model.c = padded(model.c, 0, orders.nc);
    model.d = padded(model.d, 0, orders.nd);
    const FitData data(usedBy(start, experiments_));
    const Fit fit = optimise(fitOf(start, data, summarise(data.experiments())), data, context_);
    if (!(fit.log_likelihood > best->log_likelihood + 1)) return;
    try {
      *best = {estimateOf(fit, data, start, start.configuration.estimation.max_iterations),
               fit.log_likelihood};
    } catch (const DataError&) {  // the model is at the edge of what can be evaluated
    }
  }

  static VectorXd padded(const VectorXd& values, int before, int size) {
    VectorXd all = VectorXd::Zero(size);
    all.segment(before, values.size()) = values;
    return all;
  }

  static std::vector<NominalModelOptions> larger(const NominalModelOptions& orders) {
    constexpr int kMostAtOnce = 2;  // poles of a resonance
    std::vector<NominalModelOptions> all;
    const auto add = [&](int poles, int zeros, int earlier) {
      all.push_back(orders);
      all.back().na += poles;
      all.back().nb += zeros;
      all.back().delay -= earlier;
    };
    if (orders.delay > 0) add(0, 1, 1);
    for (int more = 1; more <= kMostAtOnce; ++more) add(more, more, 0);
    return all;
  }

  const Estimate& chosen_;
  const std::vector<Experiment>& experiments_;
  const FitContext& context_;
  const ProgressCallback& progress_;
};

/// Number of noise poles near the unit circle, which describe what does not die out.
int persistentPoles(const Estimate& estimate) {
  constexpr double kPersistent = 0.98;
  if (estimate.nominal_model.d.size() == 0) return 0;
  return static_cast<int>((roots(estimate.nominal_model.d).array().abs() > kPersistent).count());
}

/// Whether the plant has a pair of poles that nothing damps beside others: a line of the spectrum,
/// which the states that experiments begin from let it hold.
bool holdsLine(const Estimate& estimate, const std::vector<Experiment>& experiments) {
  constexpr double kPeriods = 3;
  const NominalModelEstimate& model = estimate.nominal_model;
  return model.a.size() > 2 && lastingFrequency(model.a, longestOf(experiments), kPeriods) > 0;
}

/// [%] fit of the free simulation of the mean plant of an estimate.
double simulatedFit(const Estimate& estimate, const std::vector<Experiment>& experiments) {
  const FitData data(usedBy(estimate, experiments));
  const Fit fit = fitOf(estimate, data, summarise(data.experiments()));
  return simulationFit(*fixPlant(meanPlant(*fit.model, fit.at), 0, 0), Eigen::VectorXd(0),
                       plantOf(*fit.model, fit.at).offset, estimate.configuration.estimation,
                       data.experiments())
      .pooled;
}

/// Whether the likelihood of a model has left the simulation of the data behind.
bool simulatesFarWorse(const Estimate& one, const Estimate& other,
                       const std::vector<Experiment>& experiments) {
  constexpr double kFar = 10;  // [% of fit]
  return simulatedFit(one, experiments) < simulatedFit(other, experiments) - kFar;
}

}  // namespace

std::vector<Estimate> orderCandidates(const Configuration& asked, const Estimate& estimate,
                                      const std::vector<Experiment>& experiments,
                                      const FitContext& context, const ProgressCallback& progress) {
  if (!asked.nominal_model.orders_auto || !estimate.usable()) return {withFreePlant(estimate)};
  const OrderSearch search(estimate, experiments, context, progress);
  const auto chosen = search.chosen();
  if (simulatesFarWorse(chosen.estimate, estimate, experiments)) return {estimate};
  constexpr int kMostMore = 2;  // where BIC asks for more, something else than a pole is missing
  const int most =
      std::min(estimate.configuration.nominal_model.max_order, chosen.orders().na + kMostMore);
  const auto largest = search.pruned(search.raised(search.pruned(chosen), most));
  if (simulatesFarWorse(largest.estimate, estimate, experiments)) return {estimate};
  std::vector<Estimate> all{largest.estimate};
  const auto add = [&](const NominalModelOptions& orders) {
    if (const auto other = search.with(orders, chosen)) all.push_back(other->estimate);
  };
  NominalModelOptions smaller = chosen.orders();
  smaller.nc = largest.orders().nc;
  smaller.nd = largest.orders().nd;
  if (smaller.nb < largest.orders().nb) add(smaller);
  if (const int persistent = persistentPoles(largest.estimate); persistent > 0)
    add(OrderSearch::lessNoise(largest.orders(), persistent));
  if (holdsLine(largest.estimate, experiments)) add(OrderSearch::lessPlant(largest.orders()));
  return all;
}

}  // namespace uncertainty_identification
