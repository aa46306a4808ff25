#include "own_simulation/change_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "curves/fit_comparison.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMostFitted = 3;  ///< named parameters that are fitted in a round
/// Share of the least gain that a linearised step must promise before runs are spent on a fit.
constexpr double kPromise = 0.5;

bool isLagging(ChangeKind kind) {
  return kind == ChangeKind::lag || kind == ChangeKind::time_constant;
}

/// One or two changes that are added together, with the fit of all.
struct Trial {
  std::vector<Change> added;
  ChangeFit fit;

  /// Which of two that explain the data as well is named: what the user can change in the
  /// simulation, and what has fewer coordinates.
  int rank() const {
    const Change& first = added.front();
    const bool named = first.kind == ChangeKind::parameter;
    return named ? 0 : 10 * static_cast<int>(first.estimated()) + static_cast<int>(first.kind);
  }
};

class ChangeSearch {
 public:
  ChangeSearch(const ChangedSimulation& simulation, const ComparedData& fitted,
               const ComparedData& held, const ChangeSearchLimits& limits)
      : simulation_(simulation), fitted_(fitted), held_(held), limits_(limits) {}

  ChangeSearchResult run();

 private:
  std::vector<Change> candidates() const;
  std::optional<Trial> screened(ChangeKind kind, int parameter) const;
  std::vector<Trial> singles() const;
  std::vector<Trial> pairs() const;
  std::vector<Trial> fitted(std::vector<Trial> screened) const;
  bool isWorth(const ChangeFit& without, const ChangeFit& with, const Change& change) const;
  bool take(std::vector<Trial> trials);
  void dropNeedless();
  void order(ChangeSearchResult* result) const;
  bool affordsColumn() const { return simulation_.runs().affords(fitted_.runs.size()); }
  ChangeFit without(const Change& change) const;
  double heldWithout(const Change& change) const;

  const ChangedSimulation& simulation_;
  const ComparedData& fitted_;
  const ComparedData& held_;
  const ChangeSearchLimits& limits_;
  ChangeFit now_;
  std::vector<FoundChange> found_;
};

std::vector<Change> ChangeSearch::candidates() const {
  std::vector<Change> all;
  const auto own = simulation_.runs().ownValues();
  const auto& names = simulation_.runs().parameters();
  for (int k = 0; k < static_cast<int>(own.size()); ++k) {
    // A dead time of 0 has no logarithm and no negative values: `delay` stands for it.
    const bool is_dead_time = names[static_cast<std::size_t>(k)].name == "dead_time";
    if (!is_dead_time || own[k] > 0) all.push_back({ChangeKind::parameter, k, {}});
  }
  for (const ChangeKind kind :
       {ChangeKind::gain, ChangeKind::offset, ChangeKind::delay, ChangeKind::lag,
        ChangeKind::time_constant, ChangeKind::initial_state})
    all.push_back({kind, -1, {}});
  const auto isGain = [&names](const Change& each) {
    return each.kind == ChangeKind::gain ||
           (each.kind == ChangeKind::parameter &&
            names[static_cast<std::size_t>(each.parameter)].name == "gain");
  };
  const auto is_taken = [&](const Change& each) {
    return std::any_of(now_.changes.begin(), now_.changes.end(), [&](const Change& taken) {
      return taken.isSame(each) || (isLagging(taken.kind) && isLagging(each.kind)) ||
             (isGain(taken) && isGain(each));
    });
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_taken), all.end());
  return all;
}

/// The best start of a change by one linearised step.
std::optional<Trial> ChangeSearch::screened(ChangeKind kind, int parameter) const {
  std::optional<Trial> best;
  const int samples = fitted_.runs.front().experiment->samples();
  for (const Change& start : startsOf(kind, parameter, samples)) {
    Changes changes = now_.changes;
    changes.push_back(start);
    Trial trial{{start}, stepOnce(simulation_, fitted_, changes)};
    if (!std::isfinite(trial.fit.leftOut())) continue;
    if (!best || trial.fit.leftOut() < best->fit.leftOut()) best = std::move(trial);
  }
  return best;
}

std::vector<Trial> ChangeSearch::singles() const {
  std::vector<Trial> trials;
  for (const Change& each : candidates()) {
    if (each.kind == ChangeKind::parameter && !affordsColumn()) break;
    if (std::optional<Trial> trial = screened(each.kind, each.parameter))
      trials.push_back(std::move(*trial));
  }
  return trials;
}

/// Two named parameters at once. Their derivatives are known from the single ones.
std::vector<Trial> ChangeSearch::pairs() const {
  std::vector<Change> named;
  for (const Change& each : candidates())
    if (each.kind == ChangeKind::parameter)
      named.push_back({each.kind, each.parameter, Eigen::VectorXd::Zero(1)});
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < named.size(); ++i)
    for (std::size_t j = i + 1; j < named.size(); ++j) {
      Changes changes = now_.changes;
      changes.insert(changes.end(), {named[i], named[j]});
      if (affordsColumn())
        trials.push_back({{named[i], named[j]}, stepOnce(simulation_, fitted_, changes)});
    }
  return trials;
}

/// Fits what promises most; of the named parameters, which cost runs, only a few.
std::vector<Trial> ChangeSearch::fitted(std::vector<Trial> screened) const {
  std::sort(screened.begin(), screened.end(), [](const Trial& left, const Trial& right) {
    return left.fit.leftOut() < right.fit.leftOut();
  });
  std::vector<Trial> trials;
  std::size_t named = 0;
  for (Trial& trial : screened) {
    const bool is_named = trial.added.front().kind == ChangeKind::parameter;
    if (!(trial.fit.leftOut() < (1 - kPromise * limits_.least_gain) * now_.leftOut())) continue;
    if ((is_named && ++named > kMostFitted) || !affordsColumn()) continue;
    Changes changes = now_.changes;
    changes.insert(changes.end(), trial.added.begin(), trial.added.end());
    trial.fit = fitChanges(simulation_, fitted_, changes);
    if (std::isfinite(trial.fit.leftOut())) trials.push_back(std::move(trial));
  }
  return trials;
}

/// Size of a change by its standard error; infinite where it is not one number.
double sizeT(const ChangeFit& fit, const Change& change) {
  Eigen::Index first = 0;
  for (const Change& each : fit.changes) {
    if (each.isSame(change) && each.estimated() == 1)
      return std::abs(each.at[0]) / std::sqrt(fit.covariance(first, first));
    first += each.estimated();
  }
  return HUGE_VAL;
}

/// Whether the units that are left out, the change's own size and the held-out data say so. Where
/// the machine differs from run to run, squared errors scatter more than the size does.
bool ChangeSearch::isWorth(const ChangeFit& without, const ChangeFit& with,
                           const Change& change) const {
  const bool is_own = change.kind == ChangeKind::initial_state;
  const double least = is_own ? limits_.least_own : limits_.least_gain;
  const double t = pairedT(without.left_out_of, with.left_out_of), size = sizeT(with, change);
  if (!simulation_.runs().affords(2 * held_.runs.size())) return false;
  const bool is_large = std::isfinite(size) && size >= limits_.least_clear_t;
  if (!(with.leftOut() < (1 - least) * without.leftOut()) || !(size >= limits_.least_t) ||
      t < (is_large ? limits_.least_held_t : limits_.least_t))
    return false;
  const Eigen::VectorXd before = errorsOf(simulation_, held_, without.changes);
  const Eigen::VectorXd after = errorsOf(simulation_, held_, with.changes);
  return after.sum() < (1 - least) * before.sum() && pairedT(before, after) >= limits_.least_held_t;
}

/// Accepts the best of the trials that is worth it, with those that are tied with it.
bool ChangeSearch::take(std::vector<Trial> trials) {
  constexpr double kAsGood = 1.02, kTiedT = 2;
  trials.erase(std::remove_if(trials.begin(), trials.end(),
                              [&](const Trial& trial) {
                                return std::any_of(trial.added.begin(), trial.added.end(),
                                                   [&](const Change& each) {
                                                     return !isWorth(now_, trial.fit, each);
                                                   });
                              }),
               trials.end());
  if (trials.empty()) return false;
  const auto best =
      std::min_element(trials.begin(), trials.end(), [](const Trial& left, const Trial& right) {
        return left.fit.leftOut() < right.fit.leftOut();
      });
  std::vector<Trial> tied;
  for (const Trial& trial : trials)
    if (trial.fit.leftOut() < kAsGood * best->fit.leftOut() ||
        pairedT(trial.fit.left_out_of, best->fit.left_out_of) < kTiedT)
      tied.push_back(trial);
  std::stable_sort(tied.begin(), tied.end(), [](const Trial& left, const Trial& right) {
    return left.rank() != right.rank() ? left.rank() < right.rank()
                                       : left.fit.leftOut() < right.fit.leftOut();
  });
  const Trial& first = tied.front();
  now_ = first.fit;
  for (const Change& added : first.added) found_.push_back({added, {}});
  const bool named = first.rank() == 0;
  for (std::size_t k = 1; k < tied.size(); ++k)  // a parameter needs no other words for itself
    if (tied[k].added.size() == 1 && first.added.size() == 1 && named == (tied[k].rank() == 0) &&
        tied[k].added.front().estimated() <= first.added.front().estimated())
      found_.back().ties.push_back(tied[k].added.front());
  return true;
}

ChangeFit ChangeSearch::without(const Change& change) const {
  Changes rest = now_.changes;
  rest.erase(std::remove_if(rest.begin(), rest.end(),
                            [&](const Change& each) { return each.isSame(change); }),
             rest.end());
  return fitChanges(simulation_, fitted_, rest);
}

/// What was taken first may only have imitated what came later.
void ChangeSearch::dropNeedless() {
  for (std::size_t k = 0; k + 1 < found_.size();) {
    ChangeFit rest = without(found_[k].change);
    const bool is_known =
        std::isfinite(rest.leftOut()) && simulation_.runs().affords(2 * held_.runs.size());
    if (!is_known || isWorth(rest, now_, found_[k].change)) {
      ++k;
      continue;
    }
    now_ = std::move(rest);
    found_.erase(found_.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

/// Squared error of the held-out data with all other changes; not finite where no runs are left.
double ChangeSearch::heldWithout(const Change& change) const {
  const ChangeFit rest = without(change);
  const bool known = std::isfinite(rest.leftOut()) && simulation_.runs().affords(held_.runs.size());
  return known ? errorsOf(simulation_, held_, rest.changes).sum() : HUGE_VAL;
}

/// Where no runs are left to fit anew, the causes stay in the order in which they were found.
void ChangeSearch::order(ChangeSearchResult* result) const {
  result->fit = now_;
  if (found_.empty()) return;
  for (FoundChange& found : result->found) found.held_without = heldWithout(found.change);
  std::stable_sort(result->found.begin(), result->found.end(),
                   [](const FoundChange& left, const FoundChange& right) {
                     return left.held_without > right.held_without;
                   });
  Changes ordered;
  for (FoundChange& found : result->found)
    for (const Change& each : now_.changes)
      if (each.isSame(found.change)) {
        found.change = each;
        ordered.push_back(each);
      }
  const ChangeFit fit = fitChanges(simulation_, fitted_, ordered);
  if (std::isfinite(fit.leftOut()) && simulation_.runs().affords(held_.runs.size()))
    result->fit = fit;
  else
    result->found = found_;
  for (std::size_t k = 0; k < result->found.size(); ++k)
    result->found[k].change = result->fit.changes[k];
}

ChangeSearchResult ChangeSearch::run() {
  constexpr double kPerfect = 1e-10;  // of the output's power
  ChangeSearchResult result;
  result.held_before = errorsOf(simulation_, held_, {});
  now_ = fitChanges(simulation_, fitted_, {});
  while (static_cast<int>(found_.size()) < limits_.max_causes &&
         now_.leftOut() > kPerfect * fitted_.power()) {
    if (limits_.tell) limits_.tell("comparing your simulation");
    const std::size_t before = found_.size();
    if (!take(fitted(singles())) && !take(fitted(pairs()))) break;
    dropNeedless();
    if (found_.size() <= before && simulation_.runs().endedEarly()) break;
    if (found_.size() < before) break;  // what came replaced more than it added: no progress
  }
  result.found = found_;
  order(&result);
  result.held_after = errorsOf(simulation_, held_, result.fit.changes);
  return result;
}

}  // namespace

ChangeSearchResult searchChanges(const ChangedSimulation& simulation, const ComparedData& fitted,
                                 const ComparedData& held, const ChangeSearchLimits& limits) {
  return ChangeSearch(simulation, fitted, held, limits).run();
}

}  // namespace uncertainty_identification
