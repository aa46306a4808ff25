#include "curves/curve_search.h"

#include <algorithm>
#include <utility>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/prediction_check.h"

namespace uncertainty_identification {
namespace {

bool isSame(const TiedCurve& left, const TiedCurve& right) {
  return left.place.place == right.place.place && left.place.covariate == right.place.covariate &&
         left.shape == right.shape;
}

void addTie(const TiedCurve& tie, FoundCurve* cause) {
  constexpr std::size_t kMost = 4;
  if (isSame(tie, {cause->place, cause->shape}) || cause->ties.size() == kMost) return;
  for (const TiedCurve& other : cause->ties)
    if (isSame(tie, other)) return;
  cause->ties.push_back(tie);
}

/// The cause to be named, with what is tied with it.
FoundCurve described(const std::vector<CurveCandidate>& tied, const WindowFit& now) {
  const CurveCandidate& first = tied.front();
  FoundCurve found;
  found.is_delay = first.kind == CandidateKind::delay;
  const WindowFit& fit = first.accepted();
  found.delay = fit.model.delay;
  found.place = first.place;
  found.shape = first.naming.shape;
  found.nearest = first.naming.nearest;
  found.nearest_share = first.naming.nearest_share;
  found.left_out_gain = 1 - fit.left_out / now.left_out;
  found.t = pairedT(now.left_out_of, fit.left_out_of);
  for (std::size_t k = 1; k < tied.size(); ++k)
    addTie({tied[k].place, tied[k].naming.shape}, &found);
  for (const OtherShape& other : first.naming.others)
    if (other.behind < 2 && other.shape != "curve") addTie({found.place, other.shape}, &found);
  return found;
}

/// The model without its first curve, which is put last: without_, and its parameters.
struct SplitModel {
  CurveModel without;
  Curve curve;
  Eigen::VectorXd own;

  /// The model with `curve` behind the others.
  CurveModel with(const CurveModel& base, const Curve& added, const Eigen::VectorXd& values) const {
    CurveModel model = base;
    model.curves.push_back(added);
    model.theta.conservativeResize(base.theta.size() + values.size());
    model.theta.tail(values.size()) = values;
    return model;
  }
};

SplitModel splitOff(const CurveModel& model) {
  const Curve curve = model.curves.front();
  const int first = model.linearParameters(), count = curve.parameters();
  SplitModel parts{model, curve, model.theta.segment(first, count)};
  const Eigen::VectorXd behind = model.theta.tail(model.theta.size() - first - count);
  parts.without.curves.erase(parts.without.curves.begin());
  parts.without.theta.conservativeResize(first + behind.size());
  parts.without.theta.tail(behind.size()) = behind;
  return parts;
}

class CurveSearch {
 public:
  CurveSearch(const SimulationData& data, const SimulationData& held, const LinearPlants& linear,
              const CurveSearchLimits& limits, const CurveSearchContext& context)
      : data_(data), held_(held), linear_(linear), limits_(limits), context_(context) {}

  CurveSearchResult run(const WindowFit& base);

 private:
  enum class Round { nothing, plant, cause };
  Round round();
  bool isWorth(const CurveCandidate& candidate, const Eigen::VectorXd& now) const;
  bool takePlant(const CurveCandidate& candidate);
  bool convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;
  bool takeCause(std::vector<CurveCandidate>* all, const Eigen::VectorXd& now);
  void nameAgain();
  Eigen::VectorXd heldErrors(const WindowFit& fit) const;
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
  double base_unseen_ = 0;
  Eigen::VectorXd held_errors_;  ///< of result_.fit
};

Eigen::VectorXd CurveSearch::heldErrors(const WindowFit& fit) const {
  return heldOutErrors(held_, fit.model);
}

bool CurveSearch::isWorth(const CurveCandidate& candidate, const Eigen::VectorXd& now) const {
  const double gain = (now - candidate.unseen).sum();
  const bool is_cause =
      candidate.kind == CandidateKind::curve || candidate.kind == CandidateKind::delay;
  return pairedT(now, candidate.unseen) >= limits_.least_t &&
         gain > limits_.least_gain * now.sum() &&
         (!is_cause || gain > limits_.least_share * base_unseen_);
}

/// A larger plant costs nothing and is no cause, but must not simulate held-out windows worse.
bool CurveSearch::takePlant(const CurveCandidate& candidate) {
  Eigen::VectorXd errors = heldErrors(candidate.fit);
  if (errors.sum() > 1.1 * held_errors_.sum()) return false;
  result_.fit = candidate.fit;
  held_errors_ = std::move(errors);
  return true;
}

bool CurveSearch::convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
  if (before.size() == 0) return true;
  return 1 - after.sum() / before.sum() >= limits_.least_gain &&
         pairedT(before, after) >= limits_.least_held_t;
}

/// Accepts the best of the curves, or dead time, if held-out windows gain; otherwise drops it.
bool CurveSearch::takeCause(std::vector<CurveCandidate>* all, const Eigen::VectorXd& now) {
  const std::vector<CurveCandidate> tied = tiedWithFirst(*all, now);
  const CurveCandidate& first = tied.front();
  const WindowFit& fit = first.accepted();
  Eigen::VectorXd errors = heldErrors(fit);
  if (!convinces(held_errors_, errors) ||
      !convinces(errorsBeyondGain(held_, result_.fit.model), errorsBeyondGain(held_, fit.model))) {
    const auto same = [&](const CurveCandidate& each) {
      return each.kind == first.kind && each.fit.left_out == first.fit.left_out;
    };
    all->erase(std::remove_if(all->begin(), all->end(), same), all->end());
    return false;
  }
  result_.causes.push_back(described(tied, result_.fit));
  result_.causes.back().held_before = held_errors_.sum();
  result_.causes.back().held_after = errors.sum();
  result_.fit = fit;
  held_errors_ = std::move(errors);
  return true;
}

CurveSearch::Round CurveSearch::round() {
  tell("comparing curves");
  std::vector<CurveCandidate> all =
      candidatesFor(data_, held_, result_.fit, linear_, limits_.candidates, context_);
  const Eigen::VectorXd now = unseenErrors(result_.fit, held_);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const CurveCandidate& each) { return !isWorth(each, now); }),
            all.end());
  for (int tried = 0; tried < 3 && !all.empty(); ++tried) {
    const bool is_plant =
        all.front().kind == CandidateKind::order || all.front().kind == CandidateKind::direct;
    if (!is_plant) {
      if (takeCause(&all, now)) return Round::cause;
      continue;
    }
    if (takePlant(all.front())) return Round::plant;
    all.erase(all.begin());
  }
  return Round::nothing;
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
    Eigen::VectorXd errors = heldErrors(naming.fit);
    if (!(naming.fit.squared_error < 1.03 * result_.fit.squared_error) ||
        errors.sum() > 1.02 * held_errors_.sum())
      continue;
    result_.fit = std::move(naming.fit);
    held_errors_ = std::move(errors);
    for (FoundCurve& cause : result_.causes) {
      if (cause.is_delay || cause.place.place != curve.place() ||
          cause.place.covariate != curve.covariate())
        continue;
      cause.shape = naming.shape;
      cause.nearest = naming.nearest;
      cause.nearest_share = naming.nearest_share;
      cause.ties.erase(std::remove_if(cause.ties.begin(), cause.ties.end(),
                                      [&](const TiedCurve& tie) {
                                        return tie.place.place == cause.place.place;
                                      }),
                       cause.ties.end());
      for (const OtherShape& other : naming.others)
        if (other.behind < 2 && other.shape != "curve") addTie({cause.place, other.shape}, &cause);
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

CurveSearchResult CurveSearch::run(const WindowFit& base) {
  constexpr double kPerfect = 1e-5;
  result_ = {};
  result_.base = result_.fit = base;
  base_unseen_ = unseenErrors(base, held_).sum();
  held_errors_ = heldErrors(base);
  for (int k = 0; k < limits_.max_causes + 3; ++k) {
    if (static_cast<int>(result_.causes.size()) >= limits_.max_causes) break;
    if (result_.fit.squared_error < kPerfect * data_.samples || !context_.going_on()) break;
    const Round did = round();
    if (did == Round::nothing) break;
    if (did == Round::plant) continue;
    keepIfAsGood(smallerPlant(data_, result_.fit, context_));
  }
  nameAgain();
  result_.held_error = held_errors_.sum();
  result_.ended_early = !context_.going_on();
  return std::move(result_);
}

/// Whether the search from one order more ends better: with a tenth less left out, or as well with
/// fewer causes.
bool isBetter(const CurveSearchResult& other, const CurveSearchResult& than) {
  const double ratio = other.fit.left_out / than.fit.left_out;
  if (other.held_error > 1.05 * than.held_error) return false;
  if (other.causes.size() < than.causes.size()) return ratio < 1.1;
  return ratio < (other.causes.size() > than.causes.size() ? 0.7 : 0.9);
}

/// Whether the causes, which leave much unexplained, simulate better and do not predict better. In
/// a closed loop the input holds the controller's answers to disturbances, from which the
/// simulation drifts away: a dead zone that takes them out, or a friction that holds the simulation
/// back, gains.
bool isControllersAnswer(const SimulationData& data, const SimulationData& held,
                         const CurveSearchLimits& limits, const CurveSearchResult& found) {
  if (heldOutFit(held, Eigen::VectorXd::Constant(1, found.held_error)) > limits.clear_fit)
    return false;
  const auto gain = predictionGain(data, held, found.base.model, found.fit.model);
  return gain &&
         !(gain->share >= limits.least_prediction_gain && gain->t >= limits.least_prediction_t);
}

}  // namespace

CurveSearchResult searchCurves(const SimulationData& data, const SimulationData& held,
                               const CurveSearchLimits& limits, const CurveSearchContext& context) {
  if (context.tell) context.tell("fitting the smallest plant");
  const LinearPlants linear = fitLinearPlants(data, limits.candidates.max_order, context);
  CurveSearch search(data, held, linear, limits, context);
  CurveSearchResult best;
  for (const WindowFit& base : linear.starts) {
    CurveSearchResult found = search.run(base);
    if (best.base.parameters() == 0) {
      best = std::move(found);
      if (best.causes.empty()) break;  // one order more only tells which of several places it is
    } else if (isBetter(found, best)) {
      found.base = std::move(best.base);
      best = std::move(found);
    }
  }
  const double base_error = heldOutErrors(held, best.base.model).sum();
  const bool is_poor =
      heldOutFit(held, Eigen::VectorXd::Constant(1, best.held_error)) < limits.least_fit;
  const bool is_better = !is_poor && best.held_error < (1 - limits.least_gain) * base_error;
  if (best.causes.empty() || (is_better && !isControllersAnswer(data, held, limits, best)))
    return best;
  // What does not simulate held-out windows better than the linear plant is no cause of its errors.
  best.refused = is_better ? std::move(best.causes) : std::vector<FoundCurve>();
  best.causes.clear();
  best.fit = best.base;
  best.held_error = base_error;
  return best;
}

}  // namespace uncertainty_identification
