#include "curves/window_search.h"

#include <numeric>
#include <utility>

#include "curves/curve_words.h"
#include "curves/held_out.h"

namespace uncertainty_identification {
namespace {

/// Every third window, so that what is held out covers the same levels as what is fitted to.
SimulationData everyThird(SimulationData* data) {
  SimulationData held = *data;
  std::vector<SimulationWindow> all = std::move(data->windows);
  data->windows.clear();
  held.windows.clear();
  for (std::size_t k = 0; k < all.size(); ++k)
    (k % 3 == 2 ? held : *data).windows.push_back(std::move(all[k]));
  for (SimulationData* part : {data, &held}) {
    part->groups.resize(part->windows.size() + 1);
    std::iota(part->groups.begin(), part->groups.end(), 0);
    part->samples = 0;
    for (const SimulationWindow& window : part->windows) part->samples += window.measuredSamples();
  }
  return held;
}

std::string unconfirmed(const std::vector<FoundCurve>& causes, int length, int other,
                        bool ended_early) {
  const std::string named = namesOf(causes);
  if (ended_early)
    return named + ": simulates windows of about " + std::to_string(length) +
           " samples better, but the time was over before it was found in windows of " +
           std::to_string(other) + ", too. Not named; a longer explanation.time_limit allows it";
  return named + ": simulates windows of about " + std::to_string(length) +
         " samples better, but is not found in windows of " + std::to_string(other) +
         ", so that it may stand for something else. Not named";
}

/// Takes fewer causes that windows of another length show, where they simulate these ones better
/// than, or as well as, the causes that were found here. False: not so.
bool takeSimpler(const CurveSearchResult& of_others, CurveSearchLimits limits,
                 const WindowSearcher& search, PlannedSearch* searched) {
  const CurveSearchResult& found = searched->found.result;
  if (of_others.causes.empty() || of_others.causes.size() >= found.causes.size()) return false;
  const double least_share = limits.least_share;
  limits.max_causes = 0;
  limits.suggested = &of_others;
  WindowSearch other = search(searched->plan, limits, Purpose::confirming);
  if (other.result.causes.empty() || !isBetter(other.result, found, least_share)) return false;
  searched->found = std::move(other);
  return true;
}

/// Withholds the causes that are not found again in windows of the length of `other`; all of them
/// where that search has no time to find them.
void confirm(const WindowPlan& other, CurveSearchLimits limits, const WindowSearcher& search,
             PlannedSearch* searched) {
  const WindowPlan& plan = searched->plan;
  const std::vector<FoundCurve> causes = searched->found.result.causes;
  CurveSearchLimits with_these = limits;  // a search may miss what it would accept
  with_these.suggested = &searched->found.result;
  const CurveSearchResult again = search(other, with_these, Purpose::confirming).result;
  std::size_t confirmed = countConfirmed(causes, again.causes);
  if (confirmed == causes.size()) return;
  if (takeSimpler(again, limits, search, searched)) return;
  if (again.ended_early) {
    confirmed = 0;
    searched->found.dropCauses();
  } else {
    limits.max_causes = static_cast<int>(confirmed);
    limits.compares_places = false;
    searched->found = search(plan, limits, Purpose::looking);
  }
  searched->withheld = {causes.begin() + static_cast<std::ptrdiff_t>(confirmed), causes.end()};
  searched->refused = unconfirmed(searched->withheld, plan.length, other.length, again.ended_early);
}

/// The search in windows of one length, with its causes confirmed where they need to be.
PlannedSearch confirmed(const WindowPlan& plan, const std::vector<Experiment>& experiments,
                        const CurveSearchLimits& limits, const WindowSearcher& search) {
  PlannedSearch searched{plan, search(plan, limits, Purpose::looking), {}, ""};
  if (!plan.one_of_each && searched.found.needsConfirmation())
    confirm(withOtherWindows(plan, experiments), limits, search, &searched);
  return searched;
}

}  // namespace

double WindowSearch::fitOf(double squared_error) const {
  return heldOutFit(kept, Eigen::VectorXd::Constant(1, squared_error));
}

double WindowSearch::baseError() const { return heldOutErrors(kept, result.base.model).sum(); }

void WindowSearch::dropCauses() {
  result.causes.clear();
  result.fit = result.base;
  result.held_error = baseError();
  result.ended_early = true;
}

bool WindowSearch::needsConfirmation() const {
  constexpr double kWell = 80;   // [% of fit]
  constexpr double kMuch = 0.1;  // of the squared error
  if (result.causes.empty()) return false;
  const double base = baseError();
  return fitOf(base) > kWell || result.held_error > kMuch * base;
}

WindowSearch searchWindows(const std::vector<Experiment>& fitted,
                           const std::vector<Experiment>& held, const WindowPlan& plan,
                           const SignalScales& scales, const CurveSearchLimits& limits,
                           const CurveSearchContext& context) {
  WindowSearch search{windowsOf(fitted, plan, scales, kMostSamplesOfSearch), {}, held.empty(), {}};
  search.kept =
      held.empty() ? everyThird(&search.data) : windowsOf(held, plan, scales, kMostSamplesOfSearch);
  if (!search.data.windows.empty() && !search.kept.windows.empty())
    search.result = searchCurves(search.data, search.kept, limits, context);
  return search;
}

PlannedSearch searchInWindows(const WindowPlan& plan, const std::vector<Experiment>& experiments,
                              const CurveSearchLimits& limits, const WindowSearcher& search) {
  constexpr double kFarBetter = 0.7;  // of the squared error: who looks twice finds more by chance
  PlannedSearch searched = confirmed(plan, experiments, limits, search);
  const CurveSearchResult& result = searched.found.result;
  const bool showed =
      !result.causes.empty() || !result.refused.empty() || !searched.refused.empty();
  const auto longer = withLongWindows(plan, experiments);
  if (showed || result.ended_early || searched.found.held_out_of_data || !longer) return searched;
  PlannedSearch in_longer = confirmed(*longer, experiments, limits, search);
  const CurveSearchResult& again = in_longer.found.result;
  const bool is_far_better = again.held_error <= (1 - kFarBetter) * in_longer.found.baseError();
  if (!again.causes.empty() && is_far_better && !again.ended_early) return in_longer;
  searched.found.result.ended_early = again.ended_early;
  return searched;
}

std::string namesOf(const std::vector<FoundCurve>& causes) {
  std::string names;
  for (const FoundCurve& cause : causes)
    names += (names.empty() ? "" : ", ") + causeNamed(cause.place.place, cause.shape);
  return names;
}

}  // namespace uncertainty_identification
