#include "uncertainty_identification/explanation/explanation.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "configuration/thread_count.h"
#include "data/text.h"
#include "explanation/base_model.h"
#include "explanation/cause_free_model.h"
#include "explanation/columns_beside.h"
#include "explanation/estimate_fit.h"
#include "explanation/gains.h"
#include "explanation/last_thirds.h"
#include "explanation/limits_of_time.h"
#include "explanation/masked_samples.h"
#include "explanation/named_causes.h"
#include "explanation/order_candidates.h"
#include "explanation/prediction_checks.h"
#include "explanation/residual_checks.h"
#include "explanation/residual_picture.h"
#include "explanation/search_outcome.h"
#include "explanation/search_progress.h"
#include "explanation/search_simulation.h"
#include "explanation/simulation_answer.h"
#include "explanation/verdict.h"
#include "explanation/warnings.h"
#include "explanation/wording.h"
#include "inspection/closed_loop.h"
#include "math/interruption.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// One run of explain().
class Explaining {
 public:
  Explaining(const Configuration& configuration, SearchProgress& progress)
      : asked_(configuration),
        configuration_(ofBaseModel(configuration)),
        progress_(progress),
        pool_(threadCount(configuration.estimation.threads)) {}

  /// Throws CancelledError once the caller has cancelled.
  Explanation run(const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

 private:
  bool ordersAreChosen() const { return asked_.nominal_model.orders_auto; }  ///< and not stated
  Estimate identify(const std::vector<Experiment>& experiments);
  bool lowersOrder();
  std::vector<SearchOutcome> outcomesWith(Offsets offsets, const Split& data,
                                          const std::vector<SpoiltSamples>& spoilt);
  void addWithCommonOffset(const Split& data, const std::vector<SpoiltSamples>& spoilt,
                           std::vector<SearchOutcome>* outcomes);
  SearchOutcome bestOutcome(const Split& data, const std::vector<SpoiltSamples>& spoilt);
  SearchOutcome searchLikelihood(const std::optional<SpoiltSamples>& stray, Split* data);
  FitContext context(const Estimate& estimate);
  std::string describeModels(const SearchState& base, const SearchState& found);
  void describe(const SearchState& base, const SearchState& found);

  const Configuration asked_;
  Configuration configuration_;  ///< of the model that the search extends
  SearchProgress& progress_;
  Following following_;                      ///< of the signals that the model is fitted to
  std::vector<std::string> leading_curves_;  ///< the only effects that the likelihood tries, if any
  std::vector<std::string> left_out_;        ///< what was said of covariates
  std::string thinning_, simplification_;    ///< of long records and orders
  WorkerPool pool_;
  Explanation explanation_;
};

/// The best model that is found within a share of the time. Where curves explain most of the error,
/// a choice of orders would only take part of it up, and that of an error model needs little time.
Estimate Explaining::identify(const std::vector<Experiment>& experiments) {
  constexpr double kShare = 0.5, kBesideCurves = 0.15;
  const bool leads = !leading_curves_.empty();
  const int order = explanation_.simulation.order;
  if (configuration_.nominal_model.orders_auto && leads)
    configuration_.nominal_model = ofOrder(order);
  const auto go = [this](const Progress& at) {
    return progress_.report(at.phase, 0.3 * at.fraction, at.log_likelihood);
  };
  return identifyInTime(leads ? kBesideCurves : kShare, order, experiments, go, &configuration_,
                        &simplification_);
}

/// Goes down to the order of the free simulation or, from there, to first order. False where the
/// orders were stated or are the least.
bool Explaining::lowersOrder() {
  NominalModelOptions& nominal = configuration_.nominal_model;
  if (!ordersAreChosen() || (!nominal.orders_auto && nominal.na == 1)) return false;
  const std::string failed =
      nominal.orders_auto ? "that was chosen" : "of order " + std::to_string(nominal.na);
  nominal = ofOrder(nominal.orders_auto ? explanation_.simulation.order : 1);
  simplification_ = "the model " + failed + " cannot be evaluated on its own experiments; order " +
                    std::to_string(nominal.na) + " is used instead";
  return true;
}

FitContext Explaining::context(const Estimate& estimate) {
  FitContext context = contextOf(estimate, configuration_.estimation.seed);
  context.pool = &pool_;
  return reportingTo(&progress_, estimate.log_likelihood, std::move(context));
}

/// Looks for causes on top of the model. If the orders were not given, it does so on top of several
/// models, since a model with more poles and zeros may absorb what an effect with fewer parameters
/// explains on top of a smaller one.
std::vector<SearchOutcome> Explaining::outcomesWith(Offsets offsets, const Split& data,
                                                    const std::vector<SpoiltSamples>& spoilt) {
  configuration_.estimation.offsets = offsets;
  const auto going_on = [this](const Progress& at) {
    return progress_.report("choosing orders", 0.3, at.log_likelihood) && progress_.inTime();
  };
  const auto search = [&](const Estimate& on) {
    return searchOnTopOf(configuration_.explanation, context(on), on, data, spoilt,
                         leading_curves_);
  };
  for (;;) {
    try {
      const Estimate chosen = identify(data.train);
      if (progress_.cancelled()) throw CancelledError("cancelled");
      configuration_.estimation.offsets = chosen.configuration.estimation.offsets;
      std::vector<SearchOutcome> outcomes =
          outcomesOf(orderCandidates(configuration_, chosen, data.train, context(chosen), going_on),
                     chosen, search, [this] { return progress_.inTime(); });
      for (SearchOutcome& outcome : outcomes) outcome.simplification = simplification_;
      return outcomes;
    } catch (const DataError&) {
      if (!lowersOrder()) throw;
    }
  }
}

/// Where each experiment has an offset of its own, and no cause is found that explains all, causes
/// are also looked for with a common offset, if there is time: own ones take part of a cause up.
void Explaining::addWithCommonOffset(const Split& data, const std::vector<SpoiltSamples>& spoilt,
                                     std::vector<SearchOutcome>* outcomes) {
  constexpr double kShare = 0.35;  // of the time limit, which the first search has left
  const double limit = asked_.explanation.time_limit;
  if (configuration_.estimation.offsets == asked_.estimation.offsets ||
      configuration_.estimation.offsets != Offsets::per_experiment ||
      outcomes->front().explainsAll() || (limit > 0 && progress_.seconds() > kShare * limit))
    return;
  try {
    for (SearchOutcome& other : outcomesWith(Offsets::estimate, data, spoilt))
      outcomes->push_back(std::move(other));
  } catch (const DataError&) {  // the first ones remain
  }
}

SearchOutcome Explaining::bestOutcome(const Split& data, const std::vector<SpoiltSamples>& spoilt) {
  auto outcomes = outcomesWith(configuration_.estimation.offsets, data, spoilt);
  addWithCommonOffset(data, spoilt, &outcomes);
  SearchOutcome* const best = bestOf(&outcomes, configuration_.explanation.acceptance);
  explanation_.warnings = best->estimate.warnings;
  std::vector<std::string> remarks = warningsOf(*best, outcomes);
  remarks.insert(remarks.begin(), {thinning_, progress_.outOfTime() ? kOutOfTime : ""});
  remarks.insert(remarks.begin(), left_out_.begin(), left_out_.end());
  for (std::string& text : remarks)
    if (!text.empty()) explanation_.warnings.push_back(std::move(text));
  if (!ordersAreChosen())
    for (FoundCause& cause : best->found.causes) cause.may_be_order = false;
  return std::move(*best);
}

/// What the likelihood finds in records that are thinned where they are long; in all samples where
/// it sees that the actuator moves in steps, which are none once they are averaged, and the time
/// suffices.
SearchOutcome Explaining::searchLikelihood(const std::optional<SpoiltSamples>& stray, Split* data) {
  Split whole = *data;
  const Configuration given = configuration_;
  if (configuration_.explanation.time_limit > 0) thinning_ = thinLongRecords(data);
  if (!thinning_.empty()) configuration_.sample_time = 0;
  SearchOutcome best = bestOutcome(*data, maskSpoilt(stray, &configuration_, data));
  if (thinning_.empty() || !best.may_move_in_steps || areMany(whole.train) || !progress_.inTime())
    return best;
  const auto thinned = std::make_tuple(configuration_, thinning_, explanation_.warnings);
  configuration_ = given;
  thinning_ = simplification_ = "";
  SearchOutcome of_all = bestOutcome(whole, maskSpoilt(stray, &configuration_, &whole));
  if (progress_.outOfTime()) {
    std::tie(configuration_, thinning_, explanation_.warnings) = thinned;
    return best;
  }
  *data = std::move(whole);
  return of_all;
}

/// The steps of docs/explanation.md.
Explanation Explaining::run(const std::vector<Experiment>& experiments,
                            const std::vector<Experiment>& validation) {
  requireExplainable(configuration_, experiments);
  std::vector<RejectedExperiment> rejected;
  Split data = splitUsable(configuration_, experiments, validation, &rejected);
  const std::optional<SpoiltSamples> stray = maskStray(&configuration_, &data);
  left_out_ = leaveOutColumnsOfTheLoop(asked_, &data);
  following_ = followingOf(data.train);
  configuration_.estimation.offsets = offsetsOfBaseModel(asked_, data.train);
  explanation_.simulation = searchSimulation(
      configuration_, withoutSpoiltSamples(configuration_, data), &progress_, &pool_);
  leading_curves_ = leadingCurves(explanation_.simulation);
  const Split whole = data;
  const SearchOutcome best = searchLikelihood(stray, &data);
  explanation_.before = best.estimate;
  describeHeldOut(best.base, &explanation_);
  explanation_.before.rejected = rejected;
  explanation_.checks_before = checkResiduals(best.base.fit, best.base.train, best.base.law);
  explanation_.candidates = best.tried;
  describe(best.base, best.found);
  compareWithCauseFreeModel(asked_, whole, likelihoodOf(best), progress_, &explanation_);
  tellOddExperiments(&explanation_);
  if (progress_.cancelled()) throw CancelledError("cancelled");
  explanation_.seconds = progress_.seconds();
  return std::move(explanation_);
}

/// Returns a remark on the model with causes; empty: none.
std::string Explaining::describeModels(const SearchState& base, const SearchState& found) {
  constexpr int kHurried = 10;  // iterations, once the time has run out
  const bool extended = !found.fit.model->effects().empty() ||
                        found.fit.at.mixture.components() != base.fit.at.mixture.components();
  const int most = progress_.outOfTime() ? kHurried : configuration_.estimation.max_iterations;
  explanation_.after = extended ? estimateOf(found.fit, found.train, explanation_.before, most)
                                : explanation_.before;
  explanation_.before.configuration.limits = explanation_.after.configuration.limits =
      asked_.limits;
  explanation_.residual_before = residualPicture(base.fit, base.train);
  explanation_.residual_after = residualPicture(found.fit, found.train);
  explanation_.pictures = picturesOf(base.fit, found.fit, found.held);
  const double lost = found.fit.log_likelihood - explanation_.after.log_likelihood;
  return extended && lost > 1
             ? "the model that is saved was optimised again and ends " + rounded(lost) +
                   " nats below the model that the causes were found with"
             : "";
}

void Explaining::describe(const SearchState& base, const SearchState& found) {
  progress_.report("describing", 0.9, found.fit.log_likelihood);
  const std::string remark = describeModels(base, found);
  explanation_.checks_after = checkResiduals(found.fit, found.train, found.law);
  addFailedPredictions(&explanation_);
  addUnclearDirection(following_, ordersAreChosen(), &explanation_);
  const TestsAround tests{
      allPassed(explanation_.checks_before), allPassed(explanation_.checks_after),
      isOfNoiseAlone(explanation_.checks_after), explanation_.simulation.withheld};
  for (const FoundCause& cause : found.causes) {
    if (cause.effect->has(Trait::feedback)) explanation_.warnings.push_back(kFeedback);
    const std::string reason = reasonNotToName(cause, found, tests);
    if (reason.empty())
      explanation_.causes.push_back(described(cause, found, !progress_.outOfTime()));
    else
      explanation_.warnings.push_back(reason);
  }
  const bool withheld = explanation_.causes.size() < found.causes.size();
  const bool none_named = withheld && explanation_.causes.empty();
  if (none_named) forgetModelWithCauses(&explanation_);
  if (!none_named && !remark.empty()) explanation_.warnings.push_back(remark);
  addFailedParsimony(base, none_named ? base : found, &explanation_);
  explanation_.termination =
      progress_.outOfTime() ? Termination::iteration_limit : Termination::converged;
  conclude(&explanation_, withheld);
  joinSimulation(&explanation_, explanation_.verdict == Verdict::explained
                                    ? gainOnLastThirds(base, found, context(explanation_.before))
                                    : std::nullopt);
  doubtAgreement(found, &explanation_);
}

}  // namespace

Explanation explain(const Configuration& configuration, const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation, const ProgressCallback& progress) {
  SearchProgress search(progress, configuration.explanation.time_limit);
  const Interruption interruption([&search] { return !search.repeat(); });
  try {
    return Explaining(configuration, search).run(experiments, validation);
  } catch (const CancelledError&) {
    if (!search.cancelled()) throw;  // somebody further out has cancelled
    Explanation none;
    none.termination = none.before.termination = Termination::cancelled;
    none.message = none.before.message = "cancelled";
    none.seconds = search.seconds();
    return none;
  }
}

}  // namespace uncertainty_identification
