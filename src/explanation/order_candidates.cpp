#include "explanation/order_candidates.h"

#include <cmath>
#include <optional>

#include "explanation/estimate_fit.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

double likelihoodOf(const Estimate& estimate, const std::vector<Experiment>& experiments,
                    const FitContext& context) {
  const FitData data(usedBy(estimate, experiments));
  return optimise(fitOf(estimate, data, summarise(data.experiments())), data, context)
      .log_likelihood;
}

/// Models of other orders than an estimate's, by likelihood.
class OrderSearch {
 public:
  OrderSearch(const Estimate& chosen, const std::vector<Experiment>& experiments,
              const FitContext& context, const ProgressCallback& progress)
      : chosen_(chosen), experiments_(experiments), context_(context), progress_(progress) {}

  /// An estimate with the highest likelihood that is known for its orders.
  struct Model {
    Estimate estimate;
    double log_likelihood = 0;

    const NominalModelOptions& orders() const { return estimate.configuration.nominal_model; }
    /// [nats] Less what BIC charges for the parameters.
    double merit() const {
      const double parameters = orders().na + orders().nb + orders().nc + orders().nd;
      const double samples = std::max(1.0, static_cast<double>(estimate.sample_count));
      return log_likelihood - 0.5 * parameters * std::log(samples);
    }
  };

  Model chosen() const {
    const Model as_it_is{chosen_, likelihoodOf(chosen_, experiments_, context_)};
    return with(chosen_.configuration.nominal_model, as_it_is).value_or(as_it_is);
  }

  /// Of other orders: found afresh or climbed to from a model at hand, whichever leads higher.
  /// Nothing where the data are too few.
  std::optional<Model> with(NominalModelOptions orders, const Model& from) const {
    if (!context_.going_on()) return std::nullopt;
    orders.fit = PlantFit::likelihood;
    orders.structure = orders.nc + orders.nd > 0 ? Structure::box_jenkins : Structure::output_error;
    std::optional<Model> best = afresh(orders);
    if (best && holds(orders, from.orders())) climb(from.estimate, &*best);
    return best;
  }

  /// The plant with what BIC asks for more: a response one sample earlier, a pole and a zero, or
  /// two.
  Model raised(Model from, int max_order) const {
    for (bool better = true; better;) {
      better = false;
      for (const NominalModelOptions& orders : larger(from.orders())) {
        if (orders.na > max_order) continue;
        const auto candidate = with(orders, from);
        better = candidate && candidate->merit() > from.merit();
        if (!better) continue;
        from = *candidate;
        break;
      }
    }
    return from;
  }

  /// Poles and zeros taken from the noise model while BIC does not miss them.
  Model pruned(Model from) const {
    while (from.orders().nd > 0) {
      const auto candidate = with(lessNoise(from.orders(), 1), from);
      if (!candidate || candidate->merit() < from.merit()) break;
      from = *candidate;
    }
    return from;
  }

  static NominalModelOptions lessNoise(NominalModelOptions orders, int poles) {
    orders.nd = std::max(0, orders.nd - poles);
    orders.nc = std::max(0, orders.nc - poles);
    return orders;
  }

 private:
  std::optional<Model> afresh(const NominalModelOptions& orders) const {
    Configuration other = chosen_.configuration;
    other.nominal_model = orders;
    try {
      Estimate found = Identifier(other).identify(experiments_, {}, progress_);
      found.candidates = chosen_.candidates;
      if (found.usable()) return Model{found, likelihoodOf(found, experiments_, context_)};
    } catch (const DataError&) {
    }
    return std::nullopt;
  }

  static bool holds(const NominalModelOptions& large, const NominalModelOptions& small) {
    return large.na >= small.na && large.nc >= small.nc && large.nd >= small.nd &&
           large.delay <= small.delay && large.nb + large.delay >= small.nb + small.delay;
  }

  /// Replaces a model by one of its orders climbed to from a smaller one, where that leads higher.
  void climb(const Estimate& from, Model* best) const {
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
    if (fit.log_likelihood > best->log_likelihood + 1)
      *best = {estimateOf(fit, data, start), fit.log_likelihood};
  }

  static VectorXd padded(const VectorXd& values, int before, int size) {
    VectorXd all = VectorXd::Zero(size);
    all.segment(before, values.size()) = values;
    return all;
  }

  static std::vector<NominalModelOptions> larger(const NominalModelOptions& orders) {
    constexpr int kMostAtOnce = 2;  // a resonance
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

int persistentPoles(const Estimate& estimate) {
  constexpr double kPersistent = 0.98;
  if (estimate.nominal_model.d.size() == 0) return 0;
  return static_cast<int>((roots(estimate.nominal_model.d).array().abs() > kPersistent).count());
}

}  // namespace

std::vector<Estimate> orderCandidates(const Configuration& asked, const Estimate& estimate,
                                      const std::vector<Experiment>& experiments,
                                      const FitContext& context, const ProgressCallback& progress) {
  if (!asked.nominal_model.orders_auto || !estimate.usable()) return {estimate};
  const OrderSearch search(estimate, experiments, context, progress);
  const auto chosen = search.chosen();
  constexpr int kMostMore = 2;  // what asks for more is no lack of poles
  const int most = std::min(asked.nominal_model.max_order, chosen.orders().na + kMostMore);
  const auto largest = search.pruned(search.raised(search.pruned(chosen), most));
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
  return all;
}

}  // namespace uncertainty_identification
