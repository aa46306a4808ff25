#include "estimation/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "estimation/excerpt.h"
#include "estimation/least_squares_start.h"
#include "estimation/order_fits.h"
#include "estimation/simulation_fit.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

class Selection {
 public:
  Selection(const Configuration& configuration, double sample_time,
            const std::vector<Experiment>& experiments, int threads,
            std::vector<Candidate>* candidates, const SelectionProgress& progress)
      : configuration_(configuration),
        candidates_(candidates),
        progress_(progress),
        fits_(configuration, sample_time, experiments, threads) {}

  NominalModelOptions run() {
    OrderFit chosen =
        configuration_.nominal_model.focus == Focus::simulation ? bySimulation() : byPrediction();
    if (!std::isfinite(chosen.log_likelihood)) {
      throw DataError(
          "no model order could be fitted to these experiments; give the orders, or record longer "
          "ones");
    }
    return chosen.options;
  }

 private:
  void record(const OrderFit& fitted) {
    const int parameters = static_cast<int>(fitted.parameters.size()) + 1;
    Candidate candidate{"orders", describe(fitted.options), parameters, {}, {}, {}, false};
    if (fitted.parameters.size() > 0) {
      candidate.log_likelihood = fitted.log_likelihood;
      candidate.bic = fitted.bic;
    }
    if (!fitted.held_out_errors.empty()) candidate.validation_fit = fitted.held_out_fit;
    candidates_->push_back(std::move(candidate));
  }

  static std::string describe(const NominalModelOptions& o) {
    std::string text = o.structure == Structure::output_error ? "output_error" : "box_jenkins";
    text += " nb=" + std::to_string(o.nb) + " na=" + std::to_string(o.na);
    if (o.structure == Structure::box_jenkins)
      text += " nc=" + std::to_string(o.nc) + " nd=" + std::to_string(o.nd);
    return text + " delay=" + std::to_string(o.delay);
  }

  /// Reports progress. Returns false if the choice is to end with the best candidate so far.
  bool report(double share) const { return !progress_ || progress_(share); }

  int largestOrder() const {
    int shortest = std::numeric_limits<int>::max();
    for (const Experiment& experiment : fits_.experiments())
      shortest = std::min(shortest, experiment.samples());
    return std::max(1, std::min(configuration_.nominal_model.max_order, shortest / 12));
  }

  /// The parameters of an output-error model as those of the next order, with the same response.
  static VectorXd enlarged(const OrderFit& fitted) {
    const Eigen::Index order = fitted.options.nb, rest = fitted.parameters.size() - 2 * order;
    VectorXd larger = VectorXd::Zero(fitted.parameters.size() + 2);
    larger.head(order) = fitted.parameters.head(order);
    larger.segment(order + 1, order) = fitted.parameters.segment(order, order);
    larger.tail(rest) = fitted.parameters.tail(rest);
    return larger;
  }

  /// Whether the last models simulate held-out data no better than a smaller one does: larger ones
  /// cost the most and gain the least.
  static bool gainNoMore(const std::vector<OrderFit>& models) {
    constexpr std::size_t kInVain = 3;
    constexpr double kImmaterial = 0.1;  // [% of fit]
    std::size_t best = 0;
    for (std::size_t k = 1; k < models.size(); ++k)
      if (!(models[k].held_out_fit <= models[best].held_out_fit + kImmaterial)) best = k;
    return models.size() > best + kInVain;
  }

  /// Output-error models of increasing order, each with the delay of the smallest Steiglitz-McBride
  /// residual.
  std::vector<OrderFit> outputErrorModels() {
    const int largest = largestOrder();
    std::vector<const Experiment*> all;
    int shortest = std::numeric_limits<int>::max();
    for (const Experiment& experiment : fits_.experiments()) {
      all.push_back(&experiment);
      shortest = std::min(shortest, experiment.samples());
    }
    const int longest_delay = std::min(configuration_.nominal_model.max_delay, shortest / 4);
    const LeastSquaresStart scan(all, constantOf(configuration_.estimation.offsets),
                                 kEnoughSamples);
    std::vector<OrderFit> models;
    for (int order = 1; order <= largest; ++order) {
      NominalModelOptions options = configuration_.nominal_model;
      options.structure = Structure::output_error;
      options.nb = options.na = order;
      options.delay = scan.steiglitzMcBride(order, order, 0, longest_delay).polynomials.delay;
      OrderFit model = fits_.fit(options);
      if (!models.empty() && model.log_likelihood < models.back().log_likelihood) {
        options.delay = models.back().options.delay;
        const OrderFit again = fits_.fit(options, enlarged(models.back()));
        if (again.log_likelihood > model.log_likelihood) model = again;
      }
      fits_.crossValidate(&model);
      record(model);
      models.push_back(std::move(model));
      if (!report(0.7 * order / largest) || gainNoMore(models)) break;
    }
    return models;
  }

  /// Whether no oscillation and no pole of the model outlasts the experiments.
  bool isClearlyStable(const OrderFit& model) const {
    constexpr double kStable = 0.9995;
    if (model.parameters.size() == 0) return false;
    const VectorXd a = model.parameters.segment(model.options.nb, model.options.na);
    return isStable(a, kStable) && oscillationsDecay(a, longestOf(fits_.experiments()));
  }

  /// Whether a smaller model simulates as well as `best`, as far as the data can tell.
  static bool isAsGood(const OrderFit& smaller, const OrderFit& best) {
    constexpr double kNegligible = 0.5;  // [% of fit] that never justifies more poles
    constexpr double kDecisive = 5;      // [% of fit] that always does
    const double loss = best.held_out_fit - smaller.held_out_fit;
    if (loss <= kNegligible) return true;
    return loss <= kDecisive && best.fit - smaller.fit <= kDecisive &&
           !areNoticeablyLarger(smaller.held_out_errors, best.held_out_errors);
  }

  /// The smallest model whose simulation is as good as the best one's. Models with a pole on the
  /// unit circle, or an oscillation that no experiment sees decay, are left out if a clearly stable
  /// one simulates about as well: their good fit comes from a free response.
  std::size_t smallestGood(const std::vector<OrderFit>& models) const {
    constexpr double kWorthOfStability = 5;  // [% of fit]
    const auto best_of = [&](bool only_stable) {
      const OrderFit* best = nullptr;
      for (const OrderFit& model : models)
        if ((!only_stable || isClearlyStable(model)) &&
            (best == nullptr || model.held_out_fit > best->held_out_fit))
          best = &model;
      return best;
    };
    const OrderFit* best = best_of(false);
    const OrderFit* best_stable = best_of(true);
    const bool stable = best_stable != nullptr &&
                        best_stable->held_out_fit >= best->held_out_fit - kWorthOfStability;
    if (stable) best = best_stable;
    for (std::size_t k = 0; k < models.size(); ++k)
      if ((!stable || isClearlyStable(models[k])) && isAsGood(models[k], *best)) return k;
    return 0;
  }

  OrderFit bySimulation() {
    std::vector<OrderFit> models = outputErrorModels();
    const std::size_t chosen = smallestGood(models);
    (*candidates_)[candidates_->size() - models.size() + chosen].chosen = true;
    models[chosen].options.fit = PlantFit::simulation;
    return models[chosen];
  }

  /// Chooses C and D by BIC for given orders of Go.
  OrderFit noiseModel(const OrderFit& white) {
    OrderFit best = white;
    for (int order = 1; order <= kLargestNoiseOrder; ++order) {
      NominalModelOptions options = white.options;
      options.structure = Structure::box_jenkins;
      options.nc = options.nd = order;
      OrderFit model = fits_.fit(options);
      record(model);
      if (model.bic < best.bic) {
        best = model;
        best_row_ = candidates_->size() - 1;
      }
    }
    return best;
  }

  OrderFit byPrediction() {
    const std::vector<OrderFit> models = outputErrorModels();
    const std::size_t first = candidates_->size() - models.size();
    OrderFit best;
    std::size_t chosen = first;
    for (std::size_t k = 0;
         k < models.size() &&
         report(0.7 + 0.3 * static_cast<double>(k) / static_cast<double>(models.size()));
         ++k) {
      best_row_ = first + k;
      const OrderFit coloured = noiseModel(models[k]);
      if (std::isfinite(best.log_likelihood) && coloured.bic >= best.bic) continue;
      best = coloured;
      chosen = best_row_;
    }
    (*candidates_)[chosen].chosen = true;
    return best;
  }

  const Configuration& configuration_;
  std::vector<Candidate>* candidates_;
  const SelectionProgress& progress_;
  OrderFits fits_;
  std::size_t best_row_ = 0;  ///< index of the candidate that noiseModel() chose
};

}  // namespace

int mixtureParameters(Constraint constraint, int dimension, int components) {
  if (dimension == 0) return 0;
  const int free_means = constraint == Constraint::zero_mean ? components - 1 : components;
  return components - 1 + free_means * dimension + components * dimension * (dimension + 1) / 2;
}

std::optional<std::size_t> chooseLeastBic(std::size_t first, std::vector<Candidate>* candidates) {
  std::optional<std::size_t> least;
  for (std::size_t k = first; k < candidates->size(); ++k) {
    const std::optional<double>& bic = (*candidates)[k].bic;
    if (!bic || !std::isfinite(*bic)) continue;
    if (!least || *bic < *(*candidates)[*least].bic) least = k;
  }
  if (least) (*candidates)[*least].chosen = true;
  return least;
}

NominalModelOptions selectOrders(const Configuration& configuration, double sample_time,
                                 const std::vector<Experiment>& experiments, int threads,
                                 std::vector<Candidate>* candidates,
                                 const SelectionProgress& progress) {
  return Selection(configuration, sample_time, experiments, threads, candidates, progress).run();
}

}  // namespace uncertainty_identification
