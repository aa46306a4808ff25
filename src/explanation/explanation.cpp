#include "uncertainty_identification/explanation/explanation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "checks.h"
#include "estimate_fit.h"
#include "intervals.h"
#include "peaks.h"
#include "search.h"
#include "signatures.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/model/sensitivity.h"
#include "uncertainty_identification/require.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

const std::set<std::string>& noiseClass() {
  static const std::set<std::string> all{"noise_colour", "noise_hetero", "noise_tails",
                                         "noise_step", "sens_outliers"};
  return all;
}

/// Experiments to fit to and to measure with.
struct Split {
  std::vector<Experiment> train, held;
};

Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation) {
  constexpr std::size_t kFewest = 4;
  if (!validation.empty()) return {experiments, validation};
  if (experiments.size() < kFewest) return {experiments, experiments};
  std::vector<std::size_t> order(experiments.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::mt19937_64 random(configuration.estimation.seed);
  for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random() % (k + 1)]);
  const auto share = configuration.explanation.validation_share;
  const auto held = std::max<std::size_t>(
      1, static_cast<std::size_t>(share * static_cast<double>(experiments.size())));
  const std::set<std::size_t> chosen(order.begin(),
                                     order.begin() + static_cast<std::ptrdiff_t>(held));
  Split parts;
  for (std::size_t k = 0; k < experiments.size(); ++k)
    (chosen.count(k) > 0 ? parts.held : parts.train).push_back(experiments[k]);
  return parts;
}

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

/// While some check fails, only what explains most is named, if it is no noise: what a search takes
/// in beside that, or on top of a noise that explains far more, stands in for what the catalogue
/// lacks.
bool isSymptom(const FoundCause& found, const SearchState& state) {
  constexpr double kFarMore = 4.0 / 3;
  const auto of_noise = [](const FoundCause& cause) {
    return noiseClass().count(cause.effect->name()) > 0;
  };
  if (found.score == 0) return false;  // seen in the samples themselves
  if (of_noise(found)) return true;
  return std::any_of(state.causes.begin(), state.causes.end(), [&](const FoundCause& other) {
    return other.score > found.score * (of_noise(other) ? kFarMore : 1);
  });
}

/// Each further cause beside the noise is one less likely to be true: three that happen to describe
/// the data together are more often one that the catalogue lacks.
Check parsimony(const SearchState& state) {
  constexpr double kPrior = 0.005;  // of an effect to be there
  const auto causes =
      std::count_if(state.causes.begin(), state.causes.end(), [](const FoundCause& cause) {
        return cause.score != 0 && noiseClass().count(cause.effect->name()) == 0;
      });
  const double p_value = std::pow(kPrior, static_cast<double>(causes));
  const bool passed = !(p_value < kCheckThreshold);
  return {"parsimony", static_cast<double>(causes), p_value, passed,
          passed ? "" : "so many causes at once: more likely one that the catalogue lacks"};
}

std::string messageOf(const Explanation& explanation) {
  std::string names, failed;
  for (const Cause& cause : explanation.causes) names += (names.empty() ? "" : ", ") + cause.name;
  for (const Check& check : explanation.checks_after)
    if (!check.passed) failed += (failed.empty() ? "" : ", ") + check.name;
  switch (explanation.verdict) {
    case Verdict::none:
      return "the simulation agrees with the data: nothing is wrong that these experiments show";
    case Verdict::explained:
      return names + ": with it in the model nothing is left that the checks see";
    case Verdict::partly_explained:
      return names + " explains part; what remains is not explained (" + failed + ")";
    case Verdict::unknown:
      return "something is wrong that the catalogue does not name (" + failed + ")";
  }
  return "";
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
  FitContext context(const Estimate& estimate);
  void describe(const SearchState& base, const SearchState& state);

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

FitContext Explaining::context(const Estimate& estimate) {
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

Explanation Explaining::run(const std::vector<Experiment>& experiments,
                            const std::vector<Experiment>& validation) {
  configuration_.validate();
  require(!variesParameters(configuration_.error_model.basis), "error_model.basis",
          nameOf(configuration_.error_model.basis),
          "fir, laguerre or kautz: explain looks for parameters that vary by itself");
  Split data = split(configuration_, experiments, validation);
  data.train = withoutRest(std::move(data.train));
  data.held = withoutRest(std::move(data.held));
  const std::vector<Signature> signatures = signaturesOf(data.train);
  for (const Signature& signature : signatures) {
    if (std::find(configuration_.explanation.exclude.begin(),
                  configuration_.explanation.exclude.end(),
                  signature.name) != configuration_.explanation.exclude.end())
      continue;
    data.train = withoutSpoiled(std::move(data.train), signature);
    data.held = withoutSpoiled(std::move(data.held), signature);
  }
  explanation_.before =
      Identifier(configuration_).identify(data.train, {}, [this](const Progress& at) {
        return report(at.phase, 0.3 * at.fraction, at.log_likelihood);
      });
  explanation_.warnings = explanation_.before.warnings;
  std::vector<Experiment> used;
  std::size_t next = 0;
  for (Experiment& experiment : data.train) {
    if (next == explanation_.before.experiments.size()) break;
    if (experiment.id != explanation_.before.experiments[next].id) continue;
    used.push_back(std::move(experiment));
    ++next;
  }
  for (const Experiment& experiment : data.held) explanation_.held_out.push_back(experiment.id);
  SearchState base{{}, FitData(std::move(used)), FitData(std::move(data.held)), {}, {}, false, 0};
  DataSummary summary = summarise(base.train.experiments());
  const FitContext context = this->context(explanation_.before);
  base.fit = settled(fitOf(explanation_.before, base.train, summary), base.train, context);
  summary.regressors = base.fit.model->regressors();
  summary.plant_parameters =
      plantParameters(base.fit.model->nominal(),
                      base.fit.at.parameters.head(base.fit.model->nominal().parameterCount()));
  findPeaks(residualsOf(base.fit, base.train), base.train, &summary);
  const Effects effects = catalogue(summary);
  bool quantised = false;
  for (const Signature& signature : signatures) {
    const auto effect = findEffect(effects, signature.name, "");
    if (signature.name == "sens_quant") {
      const double step = signature.parameters.front().value;
      quantised = step * step / 12 > 0.2 * base.fit.at.noise_variance;
      if (!quantised) continue;
    }
    FoundCause cause{effect, 0, 0, 1, {}, {}, signature.parameters, {}};
    cause.gain = gainOf(heldOut(base.fit, base.held), heldOut(base.fit, base.held),
                        VectorXd::Zero(base.held.count()));
    base.causes.push_back(std::move(cause));
    base.banned.push_back(signature.name);
  }
  base.heavy_tails = quantised;
  explanation_.checks_before = checksOf(base.fit, base.train, base.heavy_tails);
  Search search(configuration_.explanation, context, effects);
  // the error of a coarse lattice is neither Gaussian nor white: what else is wrong would drown in
  // it
  SearchState found = quantised ? base : search.run(base);
  explanation_.candidates = search.tried();
  const auto excluded = [&](const char* name) {
    const auto& list = configuration_.explanation.exclude;
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  constexpr double kFeedback = 1e-4;
  if (!excluded("exp_feedback") &&
      feedbackProbability(residualsOf(found.fit, found.train), found.train) < kFeedback) {
    found.causes.push_back({findEffect(effects, "exp_feedback", ""), 0, 0, 1, {}, {}, {}, {}});
    explanation_.warnings.push_back(
        "the input depends on the output (closed loop): the estimates are consistent only if the "
        "noise model is right");
  }
  describe(base, found);
  return std::move(explanation_);
}

void Explaining::describe(const SearchState& base, const SearchState& state) {
  report("describing", 0.9, state.fit.log_likelihood);
  explanation_.checks_after = checksOf(state.fit, state.train, state.heavy_tails);
  const bool passed = allPassed(explanation_.checks_after);
  for (const FoundCause& found : state.causes) {
    if (!passed && isSymptom(found, state)) {
      explanation_.warnings.push_back(found.effect->name() +
                                      " describes part of what is wrong, but may be a symptom as "
                                      "long as the rest is not explained");
      continue;
    }
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
    if (!description.variant.empty()) cause.description = description.meaning;
    explanation_.causes.push_back(std::move(cause));
  }
  if (const Check check = parsimony(state); !check.passed) {
    explanation_.checks_before.push_back(parsimony(base));
    explanation_.checks_after.push_back(check);
  }
  explanation_.verdict =
      explanation_.causes.empty()
          ? (passed ? Verdict::none : Verdict::unknown)
          : (allPassed(explanation_.checks_after) ? Verdict::explained : Verdict::partly_explained);
  explanation_.message = messageOf(explanation_);
  const bool extended = !state.fit.model->effects().empty() ||
                        state.fit.at.mixture.components() != base.fit.at.mixture.components();
  explanation_.after =
      extended ? estimateOf(state.fit, state.train, explanation_.before) : explanation_.before;
  if (extended && explanation_.after.log_likelihood < state.fit.log_likelihood - 1)
    explanation_.warnings.push_back(
        "the model that is saved was estimated anew and ends " +
        std::to_string(state.fit.log_likelihood - explanation_.after.log_likelihood) +
        " nats lower than the one that the causes were found with");
  explanation_.residual_before = residualPicture(base.fit, base.train);
  explanation_.residual_after = residualPicture(state.fit, state.train);
  explanation_.pictures = picturesOf(base.fit, state.fit, state.held);
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
