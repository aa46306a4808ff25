#include "uncertainty_identification/estimation/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/estimation/initial_guess.h"
#include "uncertainty_identification/estimation/least_squares_start.h"
#include "uncertainty_identification/estimation/simulation_fit.h"
#include "uncertainty_identification/model/linear_model.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr double kNotUsed = std::numeric_limits<double>::quiet_NaN();

/// Fits of larger models are cut short at this many samples: a choice needs less data than an estimate.
constexpr int kEnoughSamples = 30000;

Experiment part(const Experiment& whole, int first, int count) {
  Experiment piece = whole;
  piece.u = whole.u.segment(first, count);
  piece.y = whole.y.segment(first, count);
  if (!whole.valid.empty()) piece.valid.assign(whole.valid.begin() + first, whole.valid.begin() + first + count);
  piece.signals.clear();
  piece.stamp_offset.resize(0);
  return piece;
}

struct Split {
  std::vector<Experiment> fitted, held_out;
};

Split split(const std::vector<Experiment>& experiments) {
  Split split;
  if (experiments.size() >= 3) {
    for (std::size_t r = 0; r < experiments.size(); ++r) {
      (r % 3 == 2 ? split.held_out : split.fitted).push_back(experiments[r]);
    }
    return split;
  }
  for (const Experiment& experiment : experiments) {
    const int head = experiment.samples() * 2 / 3;
    split.fitted.push_back(part(experiment, 0, head));
    split.held_out.push_back(part(experiment, head, experiment.samples() - head));
  }
  return split;
}

std::vector<Experiment> thinned(const std::vector<Experiment>& experiments) {
  long total = 0;
  for (const Experiment& experiment : experiments) total += experiment.samples();
  if (total <= kEnoughSamples) return experiments;
  std::vector<Experiment> fewer;
  const double share = static_cast<double>(kEnoughSamples) / static_cast<double>(total);
  const int each = static_cast<int>(kEnoughSamples / experiments.size());
  if (each > 500) {
    for (const Experiment& experiment : experiments) {
      fewer.push_back(part(experiment, 0, std::min(experiment.samples(), std::max(each, static_cast<int>(share * experiment.samples())))));
    }
    return fewer;
  }
  double credit = 0;
  for (const Experiment& experiment : experiments) {
    credit += share;
    if (credit < 1) continue;
    credit -= 1;
    fewer.push_back(experiment);
  }
  return fewer;
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
  Selection(const Configuration& configuration, double sample_time, const std::vector<Experiment>& experiments,
            int threads, std::vector<Candidate>* candidates, const SelectionProgress& progress)
      : configuration_(configuration),
        sample_time_(sample_time),
        threads_(threads),
        candidates_(candidates),
        progress_(progress),
        experiments_(experiments),
        split_(split(experiments)),
        fitted_(thinned(split_.fitted)) {}

  NominalModelOptions run() {
    Fitted chosen = configuration_.nominal_model.focus == Focus::simulation ? bySimulation() : byPrediction();
    if (!std::isfinite(chosen.log_likelihood)) {
      throw DataError("no model order could be fitted to these experiments; give the orders, or record longer ones");
    }
    chosen.options.orders_auto = true;
    return chosen.options;
  }

 private:
  Fitted fit(NominalModelOptions options, const std::vector<Experiment>& experiments) const {
    Fitted fitted;
    options.orders_auto = false;
    fitted.options = options;
    ErrorModelOptions none;
    none.taps = 0;
    const LinearModel model(makeNominalModel(options, sample_time_), ErrorBasis(none), configuration_.estimation);
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
    const double fit = simulationFit(*nominal, theta, offset ? fitted.at.parameters[theta.size()] : 0.0,
                                     configuration_.estimation, split_.held_out)
                           .pooled;
    return std::isfinite(fit) ? fit : -std::numeric_limits<double>::infinity();
  }

  static double bicOf(const Fitted& f) {
    return bic(f.log_likelihood, static_cast<int>(f.at.parameters.size()) + 1, 0, f.samples, 1);
  }

  void record(const std::string& description, const Fitted& fitted) {
    candidates_->push_back({"orders", description, static_cast<int>(fitted.at.parameters.size()) + 1,
                            fitted.log_likelihood, bicOf(fitted), fitted.validation_fit, false});
  }

  static std::string describe(const NominalModelOptions& o) {
    std::string text = o.structure == Structure::output_error ? "output_error" : "box_jenkins";
    text += " nb=" + std::to_string(o.nb) + " na=" + std::to_string(o.na);
    if (o.structure == Structure::box_jenkins) text += " nc=" + std::to_string(o.nc) + " nd=" + std::to_string(o.nd);
    return text + " delay=" + std::to_string(o.delay);
  }

  bool goOn(double share) const { return !progress_ || progress_(share); }

  int largestOrder() const {
    int shortest = std::numeric_limits<int>::max();
    for (const Experiment& experiment : fitted_) shortest = std::min(shortest, experiment.samples());
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
    const LeastSquaresStart scan(all, configuration_.estimation.offsets != Offsets::none, kEnoughSamples);
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

  Fitted bySimulation() {
    constexpr double kTolerance = 0.2;  // [%] a larger model must gain more to be taken
    const std::vector<Fitted> models = outputErrorModels();
    double best = -std::numeric_limits<double>::infinity();
    for (const Fitted& model : models) best = std::max(best, model.validation_fit);
    std::size_t chosen = 0;
    while (chosen + 1 < models.size() && models[chosen].validation_fit < best - kTolerance) ++chosen;
    const std::size_t row = candidates_->size() - models.size() + chosen;
    const Fitted coloured = noiseModel(models[chosen], &chosen);
    if (coloured.options.structure == Structure::output_error) (*candidates_)[row].chosen = true;
    return coloured;
  }

  /// C and D by BIC at given orders of Go, unless they cost simulation fit.
  Fitted noiseModel(const Fitted& white, std::size_t*) {
    constexpr int kLargest = 3;
    constexpr double kHarm = 0.5;  // [%] of simulation fit that a noise model may cost
    Fitted best = white;
    std::size_t best_row = candidates_->size();
    for (int order = 1; order <= kLargest; ++order) {
      NominalModelOptions options = white.options;
      options.structure = Structure::box_jenkins;
      options.nc = options.nd = order;
      Fitted model = fit(options, fitted_);
      model.validation_fit = validate(model);
      record(describe(options), model);
      const bool harmless = configuration_.nominal_model.focus == Focus::prediction ||
                            model.validation_fit > white.validation_fit - kHarm;
      if (harmless && bicOf(model) < bicOf(best)) {
        best = model;
        best_row = candidates_->size() - 1;
      }
      if (!goOn(0.7 + 0.3 * order / kLargest)) break;
    }
    if (best_row < candidates_->size()) (*candidates_)[best_row].chosen = true;
    return best;
  }

  Fitted byPrediction() {
    const std::vector<Fitted> models = outputErrorModels();
    Fitted best;
    std::size_t chosen = 0;
    for (const Fitted& model : models) {
      const std::size_t before = candidates_->size();
      const Fitted coloured = noiseModel(model, nullptr);
      for (std::size_t k = before; k < candidates_->size(); ++k) {
        if ((*candidates_)[k].chosen) chosen = bicOf(coloured) < bicOf(best) ? k : chosen;
        (*candidates_)[k].chosen = false;
      }
      if (!std::isfinite(best.log_likelihood) || bicOf(coloured) < bicOf(best)) best = coloured;
    }
    if (chosen < candidates_->size()) (*candidates_)[chosen].chosen = true;
    return best;
  }

  const Configuration& configuration_;
  double sample_time_;
  int threads_;
  std::vector<Candidate>* candidates_;
  const SelectionProgress& progress_;
  const std::vector<Experiment>& experiments_;
  Split split_;
  std::vector<Experiment> fitted_;
};

}  // namespace

double bic(double log_likelihood, int model_parameters, int mixture_parameters, double samples, int experiments) {
  return -2 * log_likelihood + model_parameters * std::log(samples) + mixture_parameters * std::log(experiments);
}

int mixtureParameters(Constraint constraint, int dimension, int components) {
  if (dimension == 0) return 0;
  const int free_means = constraint == Constraint::zero_mean ? components - 1 : components;
  return components - 1 + free_means * dimension + components * dimension * (dimension + 1) / 2;
}

NominalModelOptions selectOrders(const Configuration& configuration, double sample_time,
                                 const std::vector<Experiment>& experiments, int threads,
                                 std::vector<Candidate>* candidates, const SelectionProgress& progress) {
  return Selection(configuration, sample_time, experiments, threads, candidates, progress).run();
}

}  // namespace uncertainty_identification
