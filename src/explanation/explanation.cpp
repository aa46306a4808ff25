#include "uncertainty_identification/explanation/explanation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>

#include "checks.h"
#include "estimate_fit.h"
#include "intervals.h"
#include "peaks.h"
#include "raise_orders.h"
#include "search.h"
#include "signatures.h"
#include "split.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/model/sensitivity.h"
#include "uncertainty_identification/require.h"
#include "verdict.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::string groupOf(const std::string& name) {
  static const std::map<std::string, std::string> kGroups{{"act", "actuator"},
                                                          {"plant", "plant"},
                                                          {"sens", "sensor"},
                                                          {"noise", "noise"},
                                                          {"exp", "experiment"}};
  const std::string prefix = name.substr(0, name.find('_'));
  const auto group = kGroups.find(prefix);
  return group == kGroups.end() ? prefix : group->second;
}

void requireKnown(const std::vector<std::string>& excluded,
                  const std::vector<Experiment>& experiments) {
  for (const std::string& name : excluded) {
    const std::string nearest = nearestEffect(name, summarise(experiments));
    if (nearest == name) continue;
    throw ConfigurationError("explanation.exclude: found " + name +
                             "; the catalogue has no such effect, the nearest is " + nearest);
  }
}

/// One run of explain().
class Explaining {
 public:
  Explaining(const Configuration& configuration, const ProgressCallback& progress)
      : configuration_(configuration), progress_(progress) {}

  Explanation run(const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

 private:
  bool report(const std::string& phase, double fraction, double log_likelihood);
  bool isExcluded(const std::string& name) const;
  std::vector<Signature> takeOutSpoiled(Split* data) const;
  void identify(const std::vector<Experiment>& experiments);
  void raiseOrders(const std::vector<Experiment>& experiments);
  void tellHeldOut(const Split& data);
  FitContext context();
  SearchState base(Split data, const FitContext& context) const;
  Effects catalogueFor(const SearchState& base) const;
  void addSignatures(const std::vector<Signature>& signatures, const Effects& effects,
                     SearchState* base) const;
  void addFeedback(const Effects& effects, SearchState* found);
  Cause described(const FoundCause& found, const SearchState& state) const;
  void describeModels(const SearchState& base, const SearchState& found);
  void describe(const SearchState& base, const SearchState& found);

  Configuration configuration_;
  ProgressCallback progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool cancelled_ = false;
  std::mutex reporting_;
  double searched_ = 0;  ///< share of the search done
  std::unique_ptr<WorkerPool> pool_;
  Explanation explanation_;
};

bool Explaining::report(const std::string& phase, double fraction, double log_likelihood) {
  cancelled_ = cancelled_ || (progress_ && !progress_({phase, fraction, log_likelihood}));
  return !cancelled_;
}

bool Explaining::isExcluded(const std::string& name) const {
  const auto& excluded = configuration_.explanation.exclude;
  return std::find(excluded.begin(), excluded.end(), name) != excluded.end();
}

std::vector<Signature> Explaining::takeOutSpoiled(Split* data) const {
  data->train = withoutRest(std::move(data->train));
  data->held = withoutRest(std::move(data->held));
  std::vector<Signature> signatures;
  for (Signature& signature : signaturesOf(data->train)) {
    if (!isExcluded(signature.name)) signatures.push_back(std::move(signature));
  }
  for (const Signature& signature : signatures) {
    data->train = withoutSpoiled(std::move(data->train), signature);
    data->held = withoutSpoiled(std::move(data->held), signature);
  }
  return signatures;
}

void Explaining::identify(const std::vector<Experiment>& experiments) {
  explanation_.before =
      Identifier(configuration_).identify(experiments, {}, [this](const Progress& at) {
        return report(at.phase, 0.3 * at.fraction, at.log_likelihood);
      });
  explanation_.warnings = explanation_.before.warnings;
}

void Explaining::raiseOrders(const std::vector<Experiment>& experiments) {
  if (!configuration_.nominal_model.orders_auto) return;
  const int chosen = explanation_.before.configuration.nominal_model.na;
  explanation_.before = withOrdersAskedFor(
      configuration_, explanation_.before, experiments, context(),
      [this](const Progress& at) { return report("choosing orders", 0.3, at.log_likelihood); });
  const int raised = explanation_.before.configuration.nominal_model.na;
  if (raised == chosen) return;
  explanation_.warnings = explanation_.before.warnings;
  explanation_.warnings.push_back(
      "nominal_model.orders: auto chose a plant of order " + std::to_string(chosen) +
      " by its simulations; the likelihood of all experiments asks for order " +
      std::to_string(raised) + ", which is explained here");
}

void Explaining::tellHeldOut(const Split& data) {
  if (data.fitted_to) {
    explanation_.warnings.push_back(
        "too few experiments to keep any out of the fit: gains are measured on those fitted to, "
        "and are too large; record four or more, or give others by --validation");
    return;
  }
  for (const Experiment& experiment : data.held) explanation_.held_out.push_back(experiment.id);
}

FitContext Explaining::context() {
  const Estimate& estimate = explanation_.before;
  FitContext context;
  context.options.constraint = estimate.configuration.error_model.constraint;
  if (estimate.error_model.mixture.components() > 0)
    context.options.floor = covarianceFloor(estimate.error_model.mixture);
  context.seed = configuration_.estimation.seed;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int asked = configuration_.estimation.threads;
  pool_ = std::make_unique<WorkerPool>(asked == kAutomatic ? std::max(1, cores) : asked);
  context.pool = pool_.get();
  context.going_on = [this] {  // asked by all threads: the callback is called by one at a time
    const std::lock_guard<std::mutex> lock(reporting_);
    return report("searching causes", 0.3 + 0.6 * searched_, explanation_.before.log_likelihood);
  };
  context.searched = [this](double share) {
    const std::lock_guard<std::mutex> lock(reporting_);
    searched_ = std::max(searched_, share);
  };
  return context;
}

SearchState Explaining::base(Split data, const FitContext& context) const {
  const Estimate& estimate = explanation_.before;
  SearchState base{{},
                   FitData(usedBy(estimate, std::move(data.train))),
                   FitData(std::move(data.held)),
                   {},
                   {},
                   false,
                   false,
                   0};
  const Fit fit = fitOf(estimate, base.train, summarise(base.train.experiments()));
  base.fit = settled(fit, base.train, context);
  return base;
}

Effects Explaining::catalogueFor(const SearchState& base) const {
  const NominalModel& nominal = base.fit.model->nominal();
  DataSummary summary = summarise(base.train.experiments());
  summary.regressors = base.fit.model->regressors();
  summary.plant_parameters =
      plantParameters(nominal, base.fit.at.parameters.head(nominal.parameterCount()));
  findPeaks(residualsOf(base.fit, base.train), base.train, &summary);
  return catalogue(summary);
}

/// Causes that the samples show by themselves; a lattice only where it is coarse against the noise.
void Explaining::addSignatures(const std::vector<Signature>& signatures, const Effects& effects,
                               SearchState* base) const {
  constexpr double kCoarse = 0.2;  // variance of rounding / sigma^2
  for (const Signature& signature : signatures) {
    if (signature.name == "sens_quant") {
      const double step = signature.parameters.front().value;
      base->quantised = step * step / 12 > kCoarse * base->fit.at.noise_variance;
      if (!base->quantised) continue;
    }
    const HeldOut held = heldOut(base->fit, base->held);
    FoundCause cause;
    cause.effect = findEffect(effects, signature.name, "");
    cause.parameters = signature.parameters;
    cause.gain = gainOf(held, held, VectorXd::Zero(base->held.count()));
    base->causes.push_back(std::move(cause));
    base->banned.push_back(signature.name);
  }
  base->heavy_tails = base->quantised;
}

void Explaining::addFeedback(const Effects& effects, SearchState* found) {
  constexpr double kFeedback = 1e-4;
  if (isExcluded("exp_feedback")) return;
  if (feedbackProbability(residualsOf(found->fit, found->train), found->train) >= kFeedback) return;
  FoundCause cause;
  cause.effect = findEffect(effects, "exp_feedback", "");
  found->causes.push_back(std::move(cause));
  explanation_.warnings.push_back(
      "the input depends on the output (closed loop): the estimates are consistent only if the "
      "noise model is right");
}

/// The loop of docs/explanation.md.
Explanation Explaining::run(const std::vector<Experiment>& experiments,
                            const std::vector<Experiment>& validation) {
  configuration_.validate();
  require(!variesParameters(configuration_.error_model.basis), "error_model.basis",
          nameOf(configuration_.error_model.basis),
          "fir, laguerre or kautz: explain looks for parameters that vary by itself");
  requireKnown(configuration_.explanation.exclude, experiments);
  Split data = split(configuration_, experiments, validation);
  const std::vector<Signature> signatures = takeOutSpoiled(&data);
  identify(data.train);
  raiseOrders(data.train);
  tellHeldOut(data);
  const FitContext context = this->context();
  SearchState base = this->base(std::move(data), context);
  const Effects effects = catalogueFor(base);
  addSignatures(signatures, effects, &base);
  explanation_.checks_before = checksOf(base.fit, base.train, base.heavy_tails);
  Search search(configuration_.explanation, context, effects);
  // the error of a coarse lattice is neither Gaussian nor white: what else is wrong would drown in
  // it
  SearchState found = base.quantised ? base : search.run(base);
  explanation_.candidates = search.tried();
  addFeedback(effects, &found);
  describe(base, found);
  return std::move(explanation_);
}

Cause Explaining::described(const FoundCause& found, const SearchState& state) const {
  const EffectDescription& description = found.effect->description();
  Cause cause;
  cause.name = description.name;
  cause.variant = description.variant;
  cause.group = groupOf(description.name);
  cause.description = description.meaning;
  cause.advice = description.advice;
  cause.confidence = found.confidence;
  cause.equivalent = found.equivalent;
  cause.gain = found.gain;
  cause.parameters = found.parameters.empty() ? parametersOf(state.fit, state.train, found.effect)
                                              : found.parameters;
  return cause;
}

void Explaining::describeModels(const SearchState& base, const SearchState& found) {
  const bool extended = !found.fit.model->effects().empty() ||
                        found.fit.at.mixture.components() != base.fit.at.mixture.components();
  explanation_.after =
      extended ? estimateOf(found.fit, found.train, explanation_.before) : explanation_.before;
  const double lost = found.fit.log_likelihood - explanation_.after.log_likelihood;
  if (extended && lost > 1)
    explanation_.warnings.push_back("the model that is saved was estimated anew and ends " +
                                    std::to_string(lost) +
                                    " nats lower than the one that the causes were found with");
  explanation_.residual_before = residualPicture(base.fit, base.train);
  explanation_.residual_after = residualPicture(found.fit, found.train);
  explanation_.pictures = picturesOf(base.fit, found.fit, found.held);
}

void Explaining::describe(const SearchState& base, const SearchState& found) {
  report("describing", 0.9, found.fit.log_likelihood);
  explanation_.checks_after = checksOf(found.fit, found.train, found.heavy_tails);
  const bool passed = allPassed(explanation_.checks_after);
  for (const FoundCause& cause : found.causes) {
    if (passed || !isSymptom(cause, found)) {
      explanation_.causes.push_back(described(cause, found));
      continue;
    }
    explanation_.warnings.push_back(cause.effect->name() +
                                    " describes part of what is wrong, but may be a symptom as "
                                    "long as the rest is not explained");
  }
  if (const Check check = parsimony(found); !check.passed) {
    explanation_.checks_before.push_back(parsimony(base));
    explanation_.checks_after.push_back(check);
  }
  conclude(&explanation_);
  describeModels(base, found);
  explanation_.termination = cancelled_ ? Termination::cancelled : Termination::converged;
  explanation_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

}  // namespace

Explanation explain(const Configuration& configuration, const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation, const ProgressCallback& progress) {
  return Explaining(configuration, progress).run(experiments, validation);
}

}  // namespace uncertainty_identification
