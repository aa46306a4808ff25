#include "estimation/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/least_squares_start.h"
#include "estimation/simulation_fit.h"
#include "math/information_criterion.h"
#include "math/polynomial.h"
#include "model/linear_model.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr double kWorst = -std::numeric_limits<double>::infinity();

struct Split {
  std::vector<Experiment> fitted, held_out;
};

Split splitData(const std::vector<Experiment>& experiments) {
  Split split;
  if (experiments.size() >= 3) {
    for (std::size_t r = 0; r < experiments.size(); ++r) {
      (r % 3 == 2 ? split.held_out : split.fitted).push_back(experiments[r]);
    }
    return split;
  }
  for (const Experiment& experiment : experiments) {
    const int head = experiment.samples() * 2 / 3;
    split.fitted.push_back(excerpt(experiment, 0, head));
    split.held_out.push_back(excerpt(experiment, head, experiment.samples() - head));
  }
  return split;
}

/// A nominal model without error model, fitted by scoring steps.
struct Fitted {
  NominalModelOptions options;
  Eigen::VectorXd parameters;  ///< empty if the fit failed
  double log_likelihood = kWorst;
  double bic = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> held_out_fit;  ///< simulation fit on held-out data [%]
};

class Selection {
 public:
  Selection(const Configuration& configuration, double sample_time,
            const std::vector<Experiment>& experiments, int threads,
            std::vector<Candidate>* candidates, const SelectionProgress& progress)
      : configuration_(configuration),
        sample_time_(sample_time),
        threads_(threads),
        candidates_(candidates),
        progress_(progress),
        split_(splitData(experiments)),
        fitted_(fewerSamples(split_.fitted, kEnoughSamples)) {}

  NominalModelOptions run() {
    Fitted chosen =
        configuration_.nominal_model.focus == Focus::simulation ? bySimulation() : byPrediction();
    if (!std::isfinite(chosen.log_likelihood)) {
      throw DataError(
          "no model order could be fitted to these experiments; give the orders, or record longer "
          "ones");
    }
    return chosen.options;
  }

 private:
  /// From the starts that the data give, and from `start` where it is not empty.
  Fitted fit(NominalModelOptions options, const std::vector<Experiment>& experiments,
             const VectorXd& start = VectorXd()) const {
    Fitted fitted;
    options.orders_auto = false;
    fitted.options = options;
    ErrorModelOptions none;
    none.taps = 0;
    const LinearModel model(makeNominalModel(options, sample_time_), ErrorBasis(none),
                            configuration_.estimation);
    const std::vector<Block> blocks = makeBlocks(experiments);
    const Likelihood likelihood(model, blocks, static_cast<int>(experiments.size()), threads_);
    std::vector<VectorXd> starts = nominalStarts(model, options, experiments);
    if (start.size() > 0) starts.push_back(start);
    const std::optional<ModelParameters> point =
        bestSingleComponent(likelihood, starts, OptimisationOptions());
    if (!point) return fitted;
    const Statistics statistics = likelihood.statistics(point->parameters, false);
    fitted.parameters = point->parameters;
    fitted.log_likelihood = likelihood.expect(statistics, *point).total();
    fitted.bic =
        bic(fitted.log_likelihood, model.parameterCount() + 1, 0, statistics.samples().sum(), 1);
    return fitted;
  }

  /// Simulation fit on the held-out experiments [%].
  double validate(const Fitted& fitted) const {
    if (fitted.parameters.size() == 0) return kWorst;
    const auto nominal = makeNominalModel(fitted.options, sample_time_);
    const VectorXd theta = fitted.parameters.head(nominal->parameterCount());
    const bool offset = fitted.parameters.size() > theta.size();
    const double fit =
        simulationFit(*nominal, theta, offset ? fitted.parameters[theta.size()] : 0.0,
                      configuration_.estimation, split_.held_out)
            .pooled;
    return std::isfinite(fit) ? fit : kWorst;
  }

  void record(const Fitted& fitted) {
    const int parameters = static_cast<int>(fitted.parameters.size()) + 1;
    Candidate candidate{"orders", describe(fitted.options), parameters, {}, {}, {}, false};
    if (fitted.parameters.size() > 0) {
      candidate.log_likelihood = fitted.log_likelihood;
      candidate.bic = fitted.bic;
    }
    candidate.validation_fit = fitted.held_out_fit;
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
    for (const Experiment& experiment : fitted_)
      shortest = std::min(shortest, experiment.samples());
    return std::max(1, std::min(configuration_.nominal_model.max_order, shortest / 12));
  }

  /// The parameters of an output-error model as those of the next order, with the same response.
  static VectorXd enlarged(const Fitted& fitted) {
    const Eigen::Index order = fitted.options.nb, rest = fitted.parameters.size() - 2 * order;
    VectorXd larger = VectorXd::Zero(fitted.parameters.size() + 2);
    larger.head(order) = fitted.parameters.head(order);
    larger.segment(order + 1, order) = fitted.parameters.segment(order, order);
    larger.tail(rest) = fitted.parameters.tail(rest);
    return larger;
  }

  /// Output-error models of increasing order, each with the delay of the smallest Steiglitz-McBride
  /// residual.
  std::vector<Fitted> outputErrorModels() {
    const int largest = largestOrder();
    std::vector<const Experiment*> all;
    int shortest = std::numeric_limits<int>::max();
    for (const Experiment& experiment : fitted_) {
      all.push_back(&experiment);
      shortest = std::min(shortest, experiment.samples());
    }
    const int longest_delay = std::min(configuration_.nominal_model.max_delay, shortest / 4);
    const LeastSquaresStart scan(all, configuration_.estimation.offsets != Offsets::none,
                                 kEnoughSamples);
    std::vector<Fitted> models;
    for (int order = 1; order <= largest; ++order) {
      NominalModelOptions options = configuration_.nominal_model;
      options.structure = Structure::output_error;
      options.nb = options.na = order;
      options.delay = scan.steiglitzMcBride(order, order, 0, longest_delay).polynomials.delay;
      Fitted model = fit(options, fitted_);
      if (!models.empty() && model.log_likelihood < models.back().log_likelihood) {
        options.delay = models.back().options.delay;
        const Fitted again = fit(options, fitted_, enlarged(models.back()));
        if (again.log_likelihood > model.log_likelihood) model = again;
      }
      model.held_out_fit = validate(model);
      record(model);
      models.push_back(std::move(model));
      if (!report(0.7 * order / largest)) break;
    }
    return models;
  }

  /// The smallest model whose simulation is nearly as good as the best one's. Models with a pole on
  /// the unit circle, or an oscillation that no experiment sees decay, are left out if a clearly
  /// stable one simulates about as well: their good fit comes from a free response.
  std::size_t smallestGood(const std::vector<Fitted>& models) const {
    constexpr double kTolerance = 0.5;  // [%] improvement that justifies a larger model
    constexpr double kStable = 0.9995;
    constexpr double kForStability = 5;  // [%] of fit
    const auto isClearlyStable = [this](const Fitted& model) {
      if (model.parameters.size() == 0) return false;
      const VectorXd a = model.parameters.segment(model.options.nb, model.options.na);
      return isStable(a, kStable) && oscillationsDecay(a, longestOf(fitted_));
    };
    double best = kWorst, best_stable = kWorst;
    for (const Fitted& model : models) {
      best = std::max(best, *model.held_out_fit);
      if (isClearlyStable(model)) best_stable = std::max(best_stable, *model.held_out_fit);
    }
    const bool stable = best_stable >= best - kForStability;
    if (stable) best = best_stable;
    for (std::size_t k = 0; k < models.size(); ++k) {
      const bool fits = *models[k].held_out_fit >= best - kTolerance;
      if (fits && (!stable || isClearlyStable(models[k]))) return k;
    }
    return 0;
  }

  Fitted bySimulation() {
    std::vector<Fitted> models = outputErrorModels();
    const std::size_t chosen = smallestGood(models);
    (*candidates_)[candidates_->size() - models.size() + chosen].chosen = true;
    models[chosen].options.fit = PlantFit::simulation;
    return models[chosen];
  }

  /// Chooses C and D by BIC for given orders of Go.
  Fitted noiseModel(const Fitted& white) {
    Fitted best = white;
    for (int order = 1; order <= kLargestNoiseOrder; ++order) {
      NominalModelOptions options = white.options;
      options.structure = Structure::box_jenkins;
      options.nc = options.nd = order;
      Fitted model = fit(options, fitted_);
      record(model);
      if (model.bic < best.bic) {
        best = model;
        best_row_ = candidates_->size() - 1;
      }
    }
    return best;
  }

  Fitted byPrediction() {
    const std::vector<Fitted> models = outputErrorModels();
    const std::size_t first = candidates_->size() - models.size();
    Fitted best;
    std::size_t chosen = first;
    for (std::size_t k = 0;
         k < models.size() &&
         report(0.7 + 0.3 * static_cast<double>(k) / static_cast<double>(models.size()));
         ++k) {
      best_row_ = first + k;
      const Fitted coloured = noiseModel(models[k]);
      if (std::isfinite(best.log_likelihood) && coloured.bic >= best.bic) continue;
      best = coloured;
      chosen = best_row_;
    }
    (*candidates_)[chosen].chosen = true;
    return best;
  }

  const Configuration& configuration_;
  double sample_time_;
  int threads_;
  std::vector<Candidate>* candidates_;
  const SelectionProgress& progress_;
  Split split_;
  std::vector<Experiment> fitted_;
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
