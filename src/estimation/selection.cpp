#include "estimation/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/least_squares_start.h"
#include "estimation/simulation_fit.h"
#include "math/polynomial.h"
#include "model/linear_model.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr double kNotUsed = std::numeric_limits<double>::quiet_NaN();

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

/// A model without error model, fitted by scoring steps.
struct Fitted {
  NominalModelOptions options;
  ModelParameters at;
  double log_likelihood = -std::numeric_limits<double>::infinity();
  double samples = 0;
  double validation_fit = kNotUsed;
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
        fitted_(thinned(split_.fitted, kEnoughSamples)) {}

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
  Fitted fit(NominalModelOptions options, const std::vector<Experiment>& experiments) const {
    Fitted fitted;
    options.orders_auto = false;
    fitted.options = options;
    ErrorModelOptions none;
    none.taps = 0;
    const LinearModel model(makeNominalModel(options, sample_time_), ErrorBasis(none),
                            configuration_.estimation);
    const std::vector<Block> blocks = makeBlocks(experiments);
    const Likelihood likelihood(model, blocks, static_cast<int>(experiments.size()), threads_);
    ClimbOptions climb;
    const std::vector<VectorXd> starts = nominalStarts(model, options, experiments);
    fitted.at = bestSingleComponent(likelihood, starts, climb);
    if (fitted.at.parameters.size() == 0) return fitted;
    const Statistics statistics = likelihood.statistics(fitted.at.parameters, false);
    fitted.log_likelihood = likelihood.expect(statistics, fitted.at).total();
    fitted.samples = statistics.samples().sum();
    return fitted;
  }

  double validate(const Fitted& fitted) const {
    if (fitted.at.parameters.size() == 0) return -std::numeric_limits<double>::infinity();
    const auto nominal = makeNominalModel(fitted.options, sample_time_);
    const VectorXd theta = fitted.at.parameters.head(nominal->parameterCount());
    const bool offset = fitted.at.parameters.size() > theta.size();
    const double fit =
        simulationFit(*nominal, theta, offset ? fitted.at.parameters[theta.size()] : 0.0,
                      configuration_.estimation, split_.held_out)
            .pooled;
    return std::isfinite(fit) ? fit : -std::numeric_limits<double>::infinity();
  }

  static double bicOf(const Fitted& f) {
    return bic(f.log_likelihood, static_cast<int>(f.at.parameters.size()) + 1, 0, f.samples, 1);
  }

  void record(const std::string& description, const Fitted& fitted) {
    candidates_->push_back({"orders", description,
                            static_cast<int>(fitted.at.parameters.size()) + 1,
                            fitted.log_likelihood, bicOf(fitted), fitted.validation_fit, false});
  }

  static std::string describe(const NominalModelOptions& o) {
    std::string text = o.structure == Structure::output_error ? "output_error" : "box_jenkins";
    text += " nb=" + std::to_string(o.nb) + " na=" + std::to_string(o.na);
    if (o.structure == Structure::box_jenkins)
      text += " nc=" + std::to_string(o.nc) + " nd=" + std::to_string(o.nd);
    return text + " delay=" + std::to_string(o.delay);
  }

  bool goOn(double share) const { return !progress_ || progress_(share); }

  int largestOrder() const {
    int shortest = std::numeric_limits<int>::max();
    for (const Experiment& experiment : fitted_)
      shortest = std::min(shortest, experiment.samples());
    return std::max(1, std::min(configuration_.nominal_model.max_order, shortest / 12));
  }

  /// Output-error models of rising order, each with the delay Steiglitz-McBride likes best.
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
      model.validation_fit = validate(model);
      record(describe(options), model);
      models.push_back(std::move(model));
      if (!goOn(0.7 * order / largest)) break;
    }
    return models;
  }

  /// The smallest model whose simulation is nearly as good as the best one's. Where some models
  /// settle, those with a pole on the unit circle are passed over: they owe their fit to a free
  /// response that never ends.
  static std::size_t smallestGood(const std::vector<Fitted>& models) {
    constexpr double kTolerance = 0.5;  // [%] a larger model must gain more to be taken
    constexpr double kSettling = 0.9995;
    const auto settles = [](const Fitted& model) {
      return model.at.parameters.size() > 0 &&
             isStable(model.at.parameters.segment(model.options.nb, model.options.na), kSettling);
    };
    const bool any = std::any_of(models.begin(), models.end(), settles);
    double best = -std::numeric_limits<double>::infinity();
    for (const Fitted& model : models) {
      if (!any || settles(model)) best = std::max(best, model.validation_fit);
    }
    for (std::size_t k = 0; k < models.size(); ++k) {
      if ((!any || settles(models[k])) && models[k].validation_fit >= best - kTolerance) return k;
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

  /// C and D by BIC at given orders of Go.
  Fitted noiseModel(const Fitted& white) {
    Fitted best = white;
    for (int order = 1; order <= kLargestNoiseOrder; ++order) {
      NominalModelOptions options = white.options;
      options.structure = Structure::box_jenkins;
      options.nc = options.nd = order;
      Fitted model = fit(options, fitted_);
      record(describe(options), model);
      if (bicOf(model) < bicOf(best)) {
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
    for (std::size_t k = 0; k < models.size() && goOn(0.7 + 0.3 * static_cast<double>(k) /
                                                                static_cast<double>(models.size()));
         ++k) {
      best_row_ = first + k;
      const Fitted coloured = noiseModel(models[k]);
      if (std::isfinite(best.log_likelihood) && bicOf(coloured) >= bicOf(best)) continue;
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
  std::size_t best_row_ = 0;  ///< of the candidate that noiseModel() likes best
};

}  // namespace

double bic(double log_likelihood, int model_parameters, int mixture_parameters, double samples,
           int experiments) {
  return -2 * log_likelihood + model_parameters * std::log(samples) +
         mixture_parameters * std::log(experiments);
}

int mixtureParameters(Constraint constraint, int dimension, int components) {
  if (dimension == 0) return 0;
  const int free_means = constraint == Constraint::zero_mean ? components - 1 : components;
  return components - 1 + free_means * dimension + components * dimension * (dimension + 1) / 2;
}

NominalModelOptions selectOrders(const Configuration& configuration, double sample_time,
                                 const std::vector<Experiment>& experiments, int threads,
                                 std::vector<Candidate>* candidates,
                                 const SelectionProgress& progress) {
  return Selection(configuration, sample_time, experiments, threads, candidates, progress).run();
}

}  // namespace uncertainty_identification
