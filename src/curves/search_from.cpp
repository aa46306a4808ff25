#include "curves/search_from.h"

#include <algorithm>
#include <utility>

#include "curves/beyond_differences.h"
#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/refuted_places.h"
#include "curves/split_model.h"
#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

class CurveSearch {
 public:
  CurveSearch(const SimulationData& data, const SimulationData& held, const LinearPlants& linear,
              const CurveSearchLimits& limits, const CurveSearchContext& context)
      : data_(data), held_(held), linear_(linear), limits_(limits), context_(context) {}

  CurveSearchResult run(const WindowFit& base);
  CurveSearchResult runBehind(const CurveCandidate& first, const FirstChoice& choice,
                              const WindowFit& base);

 private:
  enum class Round { nothing, plant, cause };
  void begin(const WindowFit& base);
  CurveSearchResult goOn();
  Round round();
  bool isWorth(const CurveCandidate& candidate, const Eigen::VectorXd& now, double base) const;
  bool takePlant(const CurveCandidate& candidate);
  bool isConvincing(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
    return convinces(before, after, held_.windows.size(),
                     {limits_.least_gain, limits_.least_held_t});
  }
  bool convincesHeld(const WindowFit& fit, const Eigen::VectorXd& errors, bool beyond) const;
  bool takeCause(std::vector<CurveCandidate>* all, const Eigen::VectorXd& now, bool beyond);
  Round takeBest(std::vector<CurveCandidate> all, const Eigen::VectorXd& now, bool beyond);
  void dropNeedless();
  void nameAgain();
  Eigen::VectorXd heldErrors(const WindowFit& fit) const;
  Eigen::VectorXd unseenBeyond(const WindowFit& fit) const;
  void keepIfAsGood(WindowFit changed);
  void tell(const std::string& what) const {
    if (context_.tell) context_.tell(what);
  }

  const SimulationData& data_;
  const SimulationData& held_;
  const LinearPlants& linear_;
  const CurveSearchLimits& limits_;
  const CurveSearchContext& context_;
  CurveSearchResult result_;
  double base_unseen_ = 0, base_beyond_ = 0;  ///< unseen errors of the base, and beyond gain
  Eigen::VectorXd held_errors_;               ///< of result_.fit
};

Eigen::VectorXd CurveSearch::heldErrors(const WindowFit& fit) const {
  return heldOutErrors(held_, fit.model);
}

/// Unseen errors beyond what differs between experiments; empty where the windows do not show it.
Eigen::VectorXd CurveSearch::unseenBeyond(const WindowFit& fit) const {
  return showDifferences(data_, held_) ? unseenBeyondDifferences(data_, fit, held_)
                                       : Eigen::VectorXd();
}

bool CurveSearch::isWorth(const CurveCandidate& candidate, const Eigen::VectorXd& now,
                          double base) const {
  const double gain = (now - candidate.unseen).sum();
  const bool is_cause = candidate.kind == CandidateKind::curve;
  return pairedT(now, candidate.unseen) >= limits_.least_t &&
         gain > limits_.least_gain * now.sum() && (!is_cause || gain > limits_.least_share * base);
}

/// A larger plant, or one with dead time, costs nothing and is no cause, but must not simulate
/// held-out windows worse.
bool CurveSearch::takePlant(const CurveCandidate& candidate) {
  Eigen::VectorXd errors = heldErrors(candidate.fit);
  if (errors.sum() > 1.1 * held_errors_.sum()) return false;
  result_.fit = candidate.fit;
  held_errors_ = std::move(errors);
  return true;
}

/// Whether held-out windows gain, also where each record has a linear plant of its own. Whether the
/// latter is significant, all unseen windows tell for the first cause, because two or three
/// held-out experiments or windows cannot; a further cause may only mend the first. `beyond`: the
/// gain is looked for in the latter way only, and there is no loss otherwise.
bool CurveSearch::convincesHeld(const WindowFit& fit, const Eigen::VectorXd& errors,
                                bool beyond) const {
  const double share = errors.sum() / held_errors_.sum();
  const bool is_material = !result_.causes.empty() || share <= 1 - limits_.least_first_gain;
  const bool as_it_is = beyond ? share < 1 : is_material && isConvincing(held_errors_, errors);
  const Eigen::VectorXd before = errorsBeyondDifferences(held_, result_.fit.model),
                        after = errorsBeyondDifferences(held_, fit.model);
  const Eigen::VectorXd all = unseenBeyond(result_.fit);
  if (!as_it_is || all.size() == 0 || !result_.causes.empty())
    return as_it_is && isConvincing(before, after);
  const double least_t =
      studentQuantile(0.95, static_cast<double>(std::max<Eigen::Index>(all.size() - 1, 1)));
  return after.sum() <= (1 - limits_.least_first_gain) * before.sum() &&
         pairedT(all, unseenBeyond(fit)) >= std::max(least_t, limits_.least_held_t);
}

/// Accepts the best of the curves if held-out windows gain; otherwise drops it.
bool CurveSearch::takeCause(std::vector<CurveCandidate>* all, const Eigen::VectorXd& now,
                            bool beyond) {
  const std::vector<CurveCandidate> tied = tiedWithFirst(*all, now);
  const CurveCandidate& first = tied.front();
  const WindowFit& fit = first.accepted();
  Eigen::VectorXd errors = heldErrors(fit);
  if (!convincesHeld(fit, errors, beyond)) {
    const auto same = [&](const CurveCandidate& each) {
      return each.kind == first.kind && each.fit.left_out == first.fit.left_out;
    };
    all->erase(std::remove_if(all->begin(), all->end(), same), all->end());
    return false;
  }
  if (result_.causes.empty() && !beyond)
    result_.first = {result_.fit, now, tied.front().unseen.sum(), ofOtherPlaces(*all, tied)};
  result_.causes.push_back(foundCurve(tied, result_.fit));
  result_.causes.back().held_before = held_errors_.sum();
  result_.causes.back().held_after = errors.sum();
  result_.fit = fit;
  held_errors_ = std::move(errors);
  return true;
}

CurveSearch::Round CurveSearch::takeBest(std::vector<CurveCandidate> all,
                                         const Eigen::VectorXd& now, bool beyond) {
  const double base = beyond ? base_beyond_ : base_unseen_;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const CurveCandidate& each) { return !isWorth(each, now, base); }),
            all.end());
  if (result_.causes.empty() && !beyond) dropImitations(data_, held_, &all);
  for (int tried = 0; tried < 3 && !all.empty(); ++tried) {
    if (all.front().kind == CandidateKind::curve) {
      if (takeCause(&all, now, beyond)) return Round::cause;
      continue;
    }
    if (takePlant(all.front())) return Round::plant;
    all.erase(all.begin());
  }
  // A plant behind curves that do not convince: with it, one of them may.
  const auto plant = std::find_if(all.begin(), all.end(), [](const CurveCandidate& each) {
    return each.kind != CandidateKind::curve;
  });
  return plant != all.end() && takePlant(*plant) ? Round::plant : Round::nothing;
}

/// Where plants differ from experiment to experiment, these differences may hide a curve: it is
/// looked for beyond them if nothing else is found.
CurveSearch::Round CurveSearch::round() {
  tell("comparing curves");
  std::vector<CurveCandidate> all =
      candidatesFor(data_, held_, result_.fit, linear_, limits_.candidates, context_);
  const Eigen::VectorXd now = unseenErrors(result_.fit, held_);
  const Round did = takeBest(all, now, false);
  if (did != Round::nothing || !result_.causes.empty()) return did;
  std::vector<CurveCandidate> curves = curvesBeyondDifferences(
      std::move(all), now, context_.pool, [this](const auto& fit) { return unseenBeyond(fit); });
  if (curves.empty()) return Round::nothing;
  return takeBest(std::move(curves), unseenBeyond(result_.fit), true);
}

/// Curves that were found first may have stood for the play or limit found since, which has a
/// memory and one parameter: a curve without which the plant simulates as well is dropped.
void CurveSearch::dropNeedless() {
  constexpr double kAsGood = 1.02;
  for (std::size_t k = result_.fit.model.curves.size(); k > 1 && context_.going_on(); --k) {
    const SplitModel parts = splitOff(result_.fit.model);
    const Curve& curve = parts.curve;
    WindowFit without = fitFreely(data_, parts.without, context_.limits(15));
    Eigen::VectorXd errors = heldErrors(without);
    const bool is_needless =
        errors.sum() <= kAsGood * held_errors_.sum() &&
        unseenErrors(without, held_).sum() <= kAsGood * unseenErrors(result_.fit, held_).sum();
    if (!is_needless) {
      result_.fit.model = parts.with(parts.without, curve, parts.own);
      continue;
    }
    result_.fit = std::move(without);
    held_errors_ = std::move(errors);
    const auto dropped =
        std::find_if(result_.causes.begin(), result_.causes.end(), [&](const FoundCurve& cause) {
          return cause.place.place == curve.place() && cause.place.covariate == curve.covariate();
        });
    const double before = dropped->held_before;
    result_.causes.erase(dropped)->held_before = before;  // the newest cause stands behind it
    result_.causes.back().held_after = held_errors_.sum();
  }
}

/// The plant has settled: each curve is freed and named again. Takes the first, puts it last.
void CurveSearch::nameAgain() {
  for (std::size_t k = 0; k < result_.fit.model.curves.size() && context_.going_on(); ++k) {
    const SplitModel parts = splitOff(result_.fit.model);
    const Curve& curve = parts.curve;
    result_.fit.model = parts.with(parts.without, curve, parts.own);
    const Curve freed = isScalar(curve.place()) ? curve : curve.freed();
    if (isScalar(curve.place()) || freed.parameters() == 0) continue;
    const WindowFit base = fitFreely(data_, parts.without, context_.limits(8));
    const WindowFit fitted =
        fitFreely(data_, parts.with(base.model, freed, freed.closest(curve.atSamples(parts.own))),
                  context_.limits(15));
    Naming naming = nameCurve(data_, base, fitted, {}, 6, context_);
    if (curve.place() == Place::loop_error && naming.shape == "curve") continue;  // is no limit
    Eigen::VectorXd errors = heldErrors(naming.fit);
    if (!(naming.fit.squared_error < 1.03 * result_.fit.squared_error) ||
        errors.sum() > 1.02 * held_errors_.sum())
      continue;
    result_.fit = std::move(naming.fit);
    held_errors_ = std::move(errors);
    for (FoundCurve& cause : result_.causes) {
      if (cause.place.place != curve.place() || cause.place.covariate != curve.covariate())
        continue;
      cause.shape = naming.shape;
      cause.nearest = naming.nearest;
      cause.nearest_share = naming.nearest_share;
      cause.ties.erase(std::remove_if(cause.ties.begin(), cause.ties.end(),
                                      [&](const TiedCurve& tie) {
                                        return tie.place.place == cause.place.place;
                                      }),
                       cause.ties.end());
      addTies(naming, &cause);
    }
  }
  // Curves were put in another order: the covariance must follow.
  if (!result_.fit.model.curves.empty())
    result_.fit = fitFreely(data_, result_.fit.model, context_.limits(3));
}

/// Takes the changed model unless it simulates held-out windows worse.
void CurveSearch::keepIfAsGood(WindowFit changed) {
  Eigen::VectorXd errors = heldErrors(changed);
  if (errors.sum() > 1.02 * held_errors_.sum()) return;
  result_.fit = std::move(changed);
  held_errors_ = std::move(errors);
}

void CurveSearch::begin(const WindowFit& base) {
  result_ = {};
  result_.base = result_.fit = base;
  base_unseen_ = unseenErrors(base, held_).sum();
  base_beyond_ = unseenBeyond(base).sum();
  held_errors_ = heldErrors(base);
}

CurveSearchResult CurveSearch::run(const WindowFit& base) {
  begin(base);
  return goOn();
}

CurveSearchResult CurveSearch::runBehind(const CurveCandidate& first, const FirstChoice& choice,
                                         const WindowFit& base) {
  begin(base);
  result_.fit = choice.before;
  held_errors_ = heldErrors(choice.before);
  result_.held_error = held_errors_.sum();
  std::vector<CurveCandidate> only{first};
  if (!takeCause(&only, choice.unseen, false)) return std::move(result_);
  keepIfAsGood(smallerPlant(data_, result_.fit, context_));
  return goOn();
}

CurveSearchResult CurveSearch::goOn() {
  constexpr double kPerfect = 1e-5;
  for (int k = 0; k < limits_.max_causes + 3; ++k) {
    if (static_cast<int>(result_.causes.size()) >= limits_.max_causes) break;
    if (result_.fit.squared_error < kPerfect * data_.samples || !context_.going_on()) break;
    const Round did = round();
    if (did == Round::nothing) break;
    if (did == Round::plant) continue;
    if (isScalar(result_.causes.back().place.place)) dropNeedless();
    keepIfAsGood(smallerPlant(data_, result_.fit, context_));
  }
  nameAgain();
  result_.held_error = held_errors_.sum();
  result_.ended_early = !context_.going_on();
  return std::move(result_);
}

}  // namespace

CurveSearchResult searchFrom(const WindowFit& base, const SimulationData& data,
                             const SimulationData& held, const LinearPlants& linear,
                             const CurveSearchLimits& limits, const CurveSearchContext& context) {
  return CurveSearch(data, held, linear, limits, context).run(base);
}

CurveSearchResult searchBehind(const CurveCandidate& first, const FirstChoice& choice,
                               const WindowFit& base, const SimulationData& data,
                               const SimulationData& held, const LinearPlants& linear,
                               const CurveSearchLimits& limits, const CurveSearchContext& context) {
  return CurveSearch(data, held, linear, limits, context).runBehind(first, choice, base);
}

}  // namespace uncertainty_identification
