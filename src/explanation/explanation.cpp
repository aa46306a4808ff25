#include "uncertainty_identification/explanation/explanation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "configuration/require.h"
#include "configuration/thread_count.h"
#include "explanation/attempt.h"
#include "explanation/checks.h"
#include "explanation/estimate_fit.h"
#include "explanation/intervals.h"
#include "explanation/order_candidates.h"
#include "explanation/verdict.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

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

std::string orderText(const Estimate& estimate) {
  const NominalModelOptions& of = estimate.configuration.nominal_model;
  const auto text = [](const char* name, int value) {
    return std::string(name) + "=" + std::to_string(value);
  };
  return text("nb", of.nb) + text(" na", of.na) + text(" nc", of.nc) + text(" nd", of.nd) +
         text(" delay", of.delay);
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
      : configuration_(configuration),
        progress_(progress),
        pool_(threadCount(configuration.estimation.threads)) {}

  Explanation run(const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

 private:
  bool report(const std::string& phase, double fraction, std::optional<double> log_likelihood);
  bool isExcluded(const std::string& name) const;
  std::vector<Signature> takeOutSpoiled(Split* data);
  Estimate identify(const std::vector<Experiment>& experiments);
  Attempt bestAttempt(const Split& data, const std::vector<Signature>& signatures);
  void tellOrders(const Estimate& chosen, const Estimate& explained);
  void tellTie(const Attempt& other, const Attempt& best);
  void tellHeldOut(const Split& data);
  FitContext context(const Estimate& estimate);
  Cause described(const FoundCause& found, const SearchState& state) const;
  void describeModels(const SearchState& base, const SearchState& found);
  void describe(const SearchState& base, const SearchState& found);

  Configuration configuration_;
  const LimitOptions limits_ = configuration_.limits;
  ProgressCallback progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool cancelled_ = false;
  std::mutex reporting_;
  double searched_ = 0;  ///< share of the search done
  WorkerPool pool_;
  Explanation explanation_;
};

bool Explaining::report(const std::string& phase, double fraction,
                        std::optional<double> log_likelihood) {
  cancelled_ = cancelled_ || (progress_ && !progress_({phase, fraction, log_likelihood}));
  return !cancelled_;
}

bool Explaining::isExcluded(const std::string& name) const {
  const auto& excluded = configuration_.explanation.exclude;
  return std::find(excluded.begin(), excluded.end(), name) != excluded.end();
}

std::vector<Signature> Explaining::takeOutSpoiled(Split* data) {
  constexpr double kAny = 0.999;  // what is taken out here was not missing from the recording
  data->train = withoutRest(std::move(data->train));
  data->held = withoutRest(std::move(data->held));
  std::vector<Signature> signatures;
  for (Signature& signature : signaturesOf(data->train)) {
    if (!isExcluded(signature.name)) signatures.push_back(std::move(signature));
  }
  for (const Signature& signature : signatures) {
    data->train = withoutSpoiled(std::move(data->train), signature);
    data->held = withoutSpoiled(std::move(data->held), signature);
    if (signature.name != "sens_quant") configuration_.limits.max_missing = kAny;
  }
  return signatures;
}

Estimate Explaining::identify(const std::vector<Experiment>& experiments) {
  return Identifier(configuration_).identify(experiments, {}, [this](const Progress& at) {
    return report(at.phase, 0.3 * at.fraction, at.log_likelihood);
  });
}

void Explaining::tellOrders(const Estimate& chosen, const Estimate& explained) {
  const std::string before = orderText(chosen), after = orderText(explained);
  if (before == after) return;
  explanation_.warnings.push_back("nominal_model.orders: auto chose " + before +
                                  " by simulations; the likelihood of all experiments asks for " +
                                  after + ", which is explained here");
}

void Explaining::tellTie(const Attempt& other, const Attempt& best) {
  if (other.merit() <= best.merit() || other.found.causes.size() <= best.found.causes.size())
    return;
  std::string names;
  for (const FoundCause& cause : other.found.causes)
    names += (names.empty() ? "" : " and ") + cause.effect->label();
  explanation_.warnings.push_back("with " + orderText(other.estimate) + ", " + names +
                                  " would explain the data as well: they cannot tell; if that is "
                                  "what you know the orders to be, state them");
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

FitContext Explaining::context(const Estimate& estimate) {
  FitContext context = contextOf(estimate, configuration_.estimation.seed);
  context.pool = &pool_;
  context.going_on = [this, reached = estimate.log_likelihood] {
    const std::lock_guard<std::mutex> lock(reporting_);  // asked by all threads
    return report("searching causes", 0.3 + 0.6 * searched_, reached);
  };
  context.searched = [this](double share) {
    const std::lock_guard<std::mutex> lock(reporting_);
    searched_ = std::max(searched_, share);
  };
  return context;
}

/// Where the orders are not told, a model with more poles and zeros may take up what an effect of
/// fewer parameters explains on top of a smaller one.
Attempt Explaining::bestAttempt(const Split& data, const std::vector<Signature>& signatures) {
  const Estimate chosen = identify(data.train);
  const std::vector<Estimate> candidates = orderCandidates(
      configuration_, chosen, data.train, context(chosen),
      [this](const Progress& at) { return report("choosing orders", 0.3, at.log_likelihood); });
  const auto worth = [this](const Attempt& of) {  // a tie is no reason to name anything
    return of.merit() -
           configuration_.explanation.acceptance * static_cast<double>(of.found.causes.size());
  };
  std::vector<Attempt> attempts;
  for (const Estimate& candidate : candidates) {
    attempts.push_back(
        attempted(configuration_.explanation, context(candidate), candidate, data, signatures));
    const SearchState& first = attempts.front().found;
    if (!first.causes.empty() && allPassed(checksOf(first.fit, first.train, first.heavy_tails)))
      break;
  }
  auto best = std::max_element(
      attempts.begin(), attempts.end(),
      [&](const Attempt& left, const Attempt& right) { return worth(left) < worth(right); });
  explanation_.warnings = best->estimate.warnings;
  tellOrders(chosen, best->estimate);
  for (const Attempt& other : attempts) tellTie(other, *best);
  return std::move(*best);
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
  const Attempt best = bestAttempt(data, signatures);
  tellHeldOut(data);
  explanation_.before = best.estimate;
  explanation_.checks_before = checksOf(best.base.fit, best.base.train, best.base.heavy_tails);
  explanation_.candidates = best.tried;
  describe(best.base, best.found);
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
  explanation_.before.configuration.limits = explanation_.after.configuration.limits = limits_;
  explanation_.residual_before = residualPicture(base.fit, base.train);
  explanation_.residual_after = residualPicture(found.fit, found.train);
  explanation_.pictures = picturesOf(base.fit, found.fit, found.held);
}

void Explaining::describe(const SearchState& base, const SearchState& found) {
  report("describing", 0.9, found.fit.log_likelihood);
  explanation_.checks_after = checksOf(found.fit, found.train, found.heavy_tails);
  const bool passed = allPassed(explanation_.checks_after);
  for (const FoundCause& cause : found.causes) {
    if (cause.effect->name() == "exp_feedback")
      explanation_.warnings.push_back(
          "the input depends on the output (closed loop): the estimates are consistent only if the "
          "noise model is right");
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
