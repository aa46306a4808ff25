#include "curves/explain_simulation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "curves/curve_search.h"
#include "curves/curve_words.h"
#include "curves/describe_curve.h"
#include "curves/held_out.h"
#include "curves/preparation.h"
#include "curves/record_difference.h"
#include "curves/record_levels.h"
#include "curves/search_time.h"
#include "curves/unpredictable.h"
#include "curves/window_search.h"
#include "math/constants.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

constexpr int kFewestSamples = 200;
constexpr int kFewestSteps = 6;
constexpr const char* kFewSteps = "the input makes fewer than six steps";

std::string sentenceOf(const WindowPlan& plan, const WindowSearch& search, std::size_t records) {
  const std::size_t windows =
      search.data.windows.size() + (search.held_out_of_data ? search.kept.windows.size() : 0);
  std::ostringstream text;
  text.precision(3);
  text << records << (records == 1 ? " record" : " records");
  if (plan.thinning > 1) text << ", thinned to one sample each " << search.data.sample_time << " s";
  text << ", simulated in " << windows << " windows of about " << plan.length
       << " samples, each from an initial state of its own";
  return text.str();
}

bool isConstant(const Scale& signal) {
  return !(signal.unit > 1e-9 * (1 + std::abs(signal.offset)));
}

std::string reasonToSkip(const SimulationData& data) {
  if (data.samples < kFewestSamples)
    return "fewer than " + std::to_string(kFewestSamples) + " samples";
  if (static_cast<int>(data.windows.size()) < kFewestWindows)
    return "fewer than " + std::to_string(kFewestWindows) + " windows";
  if (isConstant(data.scales.u)) return "the input is constant";
  if (isConstant(data.scales.y)) return "the output is constant";
  return "";
}

bool isExcluded(const std::vector<std::string>& excluded, Place place, const std::string& shape) {
  return std::find(excluded.begin(), excluded.end(), causeNamed(place, shape)) != excluded.end();
}

/// Places whose every cause is excluded by name.
std::function<bool(Place)> exclusionOf(const std::vector<std::string>& excluded) {
  return [excluded](Place place) {
    const std::vector<const Shape*> shapes = shapesAt(place);
    if (shapes.empty()) return isExcluded(excluded, place, nameOf(place));
    return std::all_of(shapes.begin(), shapes.end(), [&](const Shape* shape) {
      return isExcluded(excluded, place, shape->name);
    });
  };
}

/// The median and the worst held-out window, of outputs that are counted from these levels.
std::vector<SimulatedWindow> picturesOf(const std::vector<Experiment>& experiments,
                                        const std::vector<double>& levels,
                                        const SimulationData& held,
                                        const CurveSearchResult& result) {
  const std::vector<Eigen::VectorXd> before = heldOutSimulations(held, result.base.model),
                                     after = heldOutSimulations(held, result.fit.model);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t w = 0; w < held.windows.size(); ++w) {
    const SimulationWindow& window = held.windows[w];
    const double error = (window.measured * (window.y - before[w]).array().square()).sum();
    order.emplace_back(std::isfinite(error) ? error : 0, w);
  }
  std::sort(order.begin(), order.end());
  const Scale& scale = held.scales.y;
  std::vector<SimulatedWindow> pictures;
  for (const std::size_t place : {order.size() / 2, order.size() - 1}) {
    const std::size_t w = order[place].second;
    const SimulationWindow& window = held.windows[w];
    const int samples = window.samples() - window.rest;
    const auto record = static_cast<std::size_t>(window.record);
    const auto in_units = [&](const Eigen::VectorXd& signal) -> Eigen::VectorXd {
      return (signal.array() * scale.unit + scale.offset + levels[record]).matrix();
    };
    pictures.push_back({experiments[record].id, window.start, held.sample_time,
                        in_units(window.y.tail(samples)), in_units(before[w].tail(samples)),
                        in_units(after[w].tail(samples))});
  }
  return pictures;
}

std::string refusalOf(const CurveSearchResult& result) {
  const std::string causes = namesOf(result.refused) + ": simulates held-out data better, but ";
  if (result.is_unstable)
    return causes +
           "the plant is unstable, and a controller holds it: a simulation from the input alone "
           "runs away, and any curve that bends it back simulates better. Not named";
  return causes +
         "does not clearly predict the next output better than a linear model; where a controller "
         "answers to disturbances, or a load differs from time to time, a linear plant looks the "
         "same. The simulation alone does not name it";
}

/// [Hz] of an oscillation of the linear plant without causes that lasts as long as the records do.
double lastingOscillation(const PlannedSearch& searched, const std::vector<Experiment>& fitted) {
  const CurveModel& plant = searched.found.result.base.model;
  const double sample_time = searched.plan.thinning * fitted.front().sample_time;
  const auto longest = std::max_element(
      fitted.begin(), fitted.end(),
      [](const Experiment& a, const Experiment& b) { return a.samples() < b.samples(); });
  const double samples = static_cast<double>(longest->samples()) / searched.plan.thinning;
  return lastingFrequency(plant.theta.head(plant.order), samples) / (2 * kPi * sample_time);
}

void describe(const WindowSearch& search, SimulationCauses* found) {
  const CurveSearchResult& result = search.result;
  found->order = result.base.model.order;
  for (const FoundCurve& cause : result.causes) {
    found->causes.push_back(describeCurve(cause, result.fit, search.data));
    found->causes.back().fit_before = search.fitOf(cause.held_before);
    found->causes.back().fit_after = search.fitOf(cause.held_after);
  }
  if (!result.refused.empty() && found->refused.empty()) found->refused = refusalOf(result);
  const double of_fitted = heldOutErrors(search.data, result.base.model).sum();
  found->held_out_error_ratio = std::sqrt(search.baseError() / std::max(search.kept.samples, 1) /
                                          std::max(of_fitted / search.data.samples, 1e-12));
  found->fit_before = search.fitOf(search.baseError());
  found->fit_after = search.fitOf(result.held_error);
  found->unpredictable_share = unpredictableShare(result.fit);
}

/// How the held-out record that the linear plant simulates worst differs; empty where it simulates
/// them hardly worse than those that it was fitted to, or where curves were found that show it.
std::string differenceInWords(const std::vector<Experiment>& held, const WindowSearch& search,
                              double error_ratio) {
  constexpr double kManyTimes = 2;
  if (held.empty() || !search.result.causes.empty() || !(error_ratio > kManyTimes)) return "";
  const auto difference = differenceOf(search.kept, search.result.base.model);
  return difference ? inWords(*difference, held[static_cast<std::size_t>(difference->record)].id)
                    : "";
}

void describe(const PlannedSearch& searched, const std::vector<Experiment>& fitted,
              const std::vector<Experiment>& held, const std::vector<double>& levels,
              SimulationCauses* found) {
  const WindowSearch& search = searched.found;
  found->preparation = sentenceOf(searched.plan, search, fitted.size());
  if (found->own_levels)
    found->preparation += "; the output of each window is counted from a level of its own";
  found->refused = searched.refused;
  if (!searched.withheld.empty() && !search.result.ended_early)
    found->withheld = possibleNames(searched.withheld.front());
  describe(search, found);
  found->lasting_oscillation = lastingOscillation(searched, fitted);
  constexpr int kOfTheLine = 2;
  if (found->lasting_oscillation > 0 && found->order > kOfTheLine) found->order -= kOfTheLine;
  found->difference = differenceInWords(held, search, found->held_out_error_ratio);
  found->pictures = picturesOf(held.empty() ? fitted : held, levels, search.kept, search.result);
  found->ended_early = search.result.ended_early;
}

/// Searches the windows of records, within the limits of one call.
class RecordSearch {
 public:
  RecordSearch(const SimulationSearchOptions& options, bool for_causes, WorkerPool* pool,
               SearchTime* time)
      : for_causes_(for_causes), context_(time->context(pool)), time_(time) {
    limits_.max_causes = for_causes ? std::min(limits_.max_causes, options.max_causes) : 0;
    limits_.candidates.excluded = exclusionOf(options.excluded);
    context_.excluded = [&options](Place place, const std::string& shape) {
      return isExcluded(options.excluded, place, shape);
    };
  }

  const CurveSearchContext& context() const { return context_; }

  PlannedSearch in(const std::vector<Experiment>& fitted, const std::vector<Experiment>& held,
                   const WindowPlan& plan) const {
    const SignalScales scales = scalesOf(fitted, held, plan.thinning * fitted.front().sample_time);
    const WindowSearcher search = [&](const WindowPlan& windows, const CurveSearchLimits& within,
                                      Purpose purpose) {
      time_->setPurpose(purpose);
      return searchWindows(fitted, held, windows, scales, within, context_);
    };
    if (!for_causes_) return {plan, search(plan, limits_, Purpose::looking), {}, ""};
    return searchInWindows(plan, fitted, limits_, search);
  }

 private:
  bool for_causes_;
  CurveSearchLimits limits_;
  CurveSearchContext context_;
  SearchTime* time_;
};

/// Whether the search with levels ends with less than half of the other's error on held-out data,
/// which both have in units of their own; both begin windows from the best states. Causes with
/// which the other simulates well stand: friction, for example, makes levels of its own. No causes
/// do not take the place of causes.
bool simulatesFarBetter(const WindowSearch& with_levels, const WindowSearch& other) {
  constexpr double kHalf = 0.5, kWell = 90;  // [% of fit]
  const auto error = [](const WindowSearch& search) {
    const double unit = search.kept.scales.y.unit;
    return errorFromBestStates(search.kept, search.result.fit.model) * unit * unit /
           std::max(search.kept.samples, 1);
  };
  if (with_levels.kept.windows.empty()) return false;
  if (!other.result.causes.empty() &&
      (with_levels.result.causes.empty() || other.fitOf(other.result.held_error) > kWell))
    return false;
  return error(with_levels) < kHalf * error(other);
}

}  // namespace

bool areFewSteps(const std::vector<Experiment>& fitted, const std::vector<Experiment>& held) {
  int steps = 0;
  for (const auto* records : {&fitted, &held})
    for (const Experiment& record : *records) steps += std::max(1, changesOf(record.u));
  return steps < kFewestSteps;
}

SimulationCauses explainSimulation(const std::vector<Experiment>& fitted,
                                   const std::vector<Experiment>& held,
                                   const SimulationSearchOptions& options, WorkerPool* pool) {
  SimulationCauses found;
  const WindowPlan plan = planWindows(fitted);
  const SignalScales scales = scalesOf(fitted, held, plan.thinning * fitted.front().sample_time);
  const std::string too_few = reasonToSkip(windowsOf(fitted, plan, scales, kMostSamplesOfSearch));
  found.skipped = areFewSteps(fitted, held) ? kFewSteps : too_few;
  // Few steps still show how well one linear plant simulates records that it was not fitted to.
  const bool compares = found.skipped == kFewSteps && too_few.empty() && !held.empty();
  if (!found.skipped.empty() && !compares) return found;

  constexpr double kOfLevels = 0.5;  // of the time
  SearchTime time(options);
  const RecordSearch search(options, found.skipped.empty(), pool, &time);
  time.allow(kOfLevels);
  const auto levelled = options.own_levels && !compares
                            ? countedFromOwnLevels(fitted, held, plan, search.context())
                            : std::nullopt;
  PlannedSearch own;
  if (levelled) {
    WindowPlan about_levels = planWindows(levelled->fitted);
    about_levels.own_levels = true;
    own = search.in(levelled->fitted, levelled->held, about_levels);
  }
  time.allow(1);
  PlannedSearch searched = search.in(fitted, held, plan);
  std::vector<double> levels(held.empty() ? fitted.size() : held.size(), 0.0);
  found.own_levels = levelled && simulatesFarBetter(own.found, searched.found);
  if (found.own_levels) {
    searched = std::move(own);
    levels = held.empty() ? levelled->fitted_levels : levelled->held_levels;
  }
  if (!searched.found.kept.windows.empty()) describe(searched, fitted, held, levels, &found);
  found.seconds = time.seconds();
  return found;
}

}  // namespace uncertainty_identification
