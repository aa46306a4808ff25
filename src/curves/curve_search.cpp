#include "curves/curve_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "curves/held_out.h"
#include "curves/plant_orders.h"

namespace uncertainty_identification {
namespace {

enum class CandidateKind { order, direct, delay, curve };

/// A change of the model that competes in a round.
struct Candidate {
  CandidateKind kind = CandidateKind::curve;
  PlaceOf place;
  SimulationFit fit;
  Naming naming;  ///< of curves
};

/// Of places that the data cannot tell apart, the first is named.
int rankOf(const Candidate& candidate) {
  if (candidate.kind == CandidateKind::delay) return -1;
  constexpr Place kOrder[] = {
      Place::input,        Place::position,      Place::rate,
      Place::output_state, Place::sensor,        Place::time_gain,
      Place::covariate,    Place::position_gain, Place::input_times_position,
      Place::rate_gain,    Place::time,          Place::covariate_gain,
      Place::play,         Place::rate_limit,    Place::output_play};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), candidate.place.place) -
                          std::begin(kOrder));
}

class CurveSearch {
 public:
  CurveSearch(const SimulationData& data, const SimulationData& held, const LinearPlants& linear,
              const CurveSearchLimits& limits, const CurveSearchContext& context)
      : data_(data), held_(held), linear_(linear), limits_(limits), context_(context) {}

  CurveSearchResult run(const SimulationFit& base);

 private:
  enum class Round { nothing, plant, cause };
  Round round();
  std::vector<Candidate> candidates();
  void addCurves(std::vector<Candidate>* all);
  void dropDominated(std::vector<Candidate>* all) const;
  bool isWorth(const Candidate& candidate) const;
  bool takePlant(const Candidate& candidate);
  bool isSameForce(const Candidate& position, const Candidate& best) const;
  std::vector<Candidate> rivals(const std::vector<Candidate>& all) const;
  bool convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;
  bool takeCause(std::vector<Candidate>* all);
  FoundCurve describe(const std::vector<Candidate>& tied) const;
  void nameAgain();
  Eigen::VectorXd heldErrors(const SimulationFit& fit) const;
  void keepIfAsGood(SimulationFit changed);
  void tell(const std::string& what) const {
    if (context_.tell) context_.tell(what);
  }

  const SimulationData& data_;
  const SimulationData& held_;
  const LinearPlants& linear_;
  const CurveSearchLimits& limits_;
  const CurveSearchContext& context_;
  CurveSearchResult result_;
  double base_left_out_ = 0;
  Eigen::VectorXd held_errors_;  ///< of result_.fit
};

Eigen::VectorXd CurveSearch::heldErrors(const SimulationFit& fit) const {
  return heldOutErrors(held_, fit.model);
}

/// Student's t of the mean of paired differences, or of those of their logarithms if larger.
double heldOutT(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  SimulationFit first, second;
  first.left_out_of = before;
  second.left_out_of = after;
  return pairedT(first, second);
}

void CurveSearch::addCurves(std::vector<Candidate>* all) {
  std::vector<ScreenedPlace> screened =
      screenPlaces(data_, result_.fit, limits_.excluded, context_);
  if (static_cast<int>(screened.size()) > limits_.places)
    screened.resize(static_cast<std::size_t>(limits_.places));
  std::vector<Candidate> found(screened.size() * 2);
  context_.pool->forEach(static_cast<int>(screened.size()), [&](int index) {
    const auto k = static_cast<std::size_t>(index);
    if (!context_.going_on()) return;
    const SimulationFit free = fitPlace(data_, result_.fit, screened[k], context_);
    Candidate& whole = found[2 * k];
    whole = {CandidateKind::curve, screened[k].place, free, {}};
    whole.naming = nameCurve(data_, result_.fit, free, screened[k].fit, 5, context_);
    found[2 * k + 1] = whole;  // a free curve has leverage: its shape competes as well
    found[2 * k + 1].fit = whole.naming.fit;
  });
  for (Candidate& candidate : found)
    if (candidate.fit.parameters() > 0) all->push_back(std::move(candidate));
}

/// Dead time must beat order + 2; a higher order must beat dead time where that gains much.
void CurveSearch::dropDominated(std::vector<Candidate>* all) const {
  const double now = result_.fit.left_out;
  double order = 1e30, delay = 1e30;
  for (const Candidate& each : *all) {
    if (each.kind == CandidateKind::order) order = std::min(order, each.fit.left_out);
    if (each.kind == CandidateKind::delay) delay = std::min(delay, each.fit.left_out);
  }
  const auto is_dominated = [&](const Candidate& each) {
    if (each.kind == CandidateKind::delay)
      return each.fit.left_out > 0.75 * now || each.fit.left_out > 1.1 * order;
    return each.kind == CandidateKind::order && delay < 0.75 * now && delay <= 1.1 * order;
  };
  all->erase(std::remove_if(all->begin(), all->end(), is_dominated), all->end());
}

std::vector<Candidate> CurveSearch::candidates() {
  std::vector<Candidate> all;
  const int most =
      result_.fit.model.curves.empty() ? limits_.max_order : std::min(limits_.max_order, 3);
  for (PlantChange& change : largerPlants(data_, result_.fit, linear_, most, context_)) {
    const CandidateKind kind = change.kind == PlantChange::Kind::order    ? CandidateKind::order
                               : change.kind == PlantChange::Kind::direct ? CandidateKind::direct
                                                                          : CandidateKind::delay;
    all.push_back({kind, {}, std::move(change.fit), {}});
  }
  addCurves(&all);
  dropDominated(&all);
  std::stable_sort(all.begin(), all.end(), [](const Candidate& left, const Candidate& right) {
    return left.fit.left_out < right.fit.left_out;
  });
  std::ostringstream text;
  for (const Candidate& each : all)
    text << ' '
         << (each.kind == CandidateKind::curve ? nameOf(each.place.place) + "/" + each.naming.shape
             : each.kind == CandidateKind::order  ? "order"
             : each.kind == CandidateKind::direct ? "direct"
                                                  : "delay" + std::to_string(each.fit.model.delay))
         << ':' << std::lround(100 * (1 - each.fit.left_out / result_.fit.left_out)) << "%/"
         << 0.1 * static_cast<double>(std::lround(10 * pairedT(result_.fit, each.fit)));
  tell("candidates" + text.str());
  return all;
}

bool CurveSearch::isWorth(const Candidate& candidate) const {
  const SimulationFit& now = result_.fit;
  const double gain = now.left_out - candidate.fit.left_out;
  const bool is_cause =
      candidate.kind == CandidateKind::curve || candidate.kind == CandidateKind::delay;
  return pairedT(now, candidate.fit) >= limits_.least_t &&
         gain > limits_.least_gain * now.left_out &&
         (!is_cause || gain > limits_.least_share * base_left_out_);
}

/// A larger plant costs nothing and is no cause, but must not simulate held-out windows worse.
bool CurveSearch::takePlant(const Candidate& candidate) {
  Eigen::VectorXd errors = heldErrors(candidate.fit);
  if (errors.sum() > 1.1 * held_errors_.sum()) return false;
  result_.fit = candidate.fit;
  held_errors_ = std::move(errors);
  return true;
}

/// A force that varies between samples acts on both states of a discrete plant, so that a curve of
/// the output's own state may lead that of the position. It is the position that is meant.
bool CurveSearch::isSameForce(const Candidate& position, const Candidate& best) const {
  const double now = result_.fit.left_out;
  return best.place.place == Place::output_state && position.place.place == Place::position &&
         now - position.fit.left_out > 0.95 * (now - best.fit.left_out);
}

/// The curves that leaving windows out cannot tell from the best candidate, with their names.
std::vector<Candidate> CurveSearch::rivals(const std::vector<Candidate>& all) const {
  const SimulationFit& best = all.front().fit;
  std::vector<Candidate> found;
  if (all.front().kind == CandidateKind::delay) return {all.front()};
  for (const Candidate& each : all) {
    if (each.kind != CandidateKind::curve || found.size() == 8) continue;
    if (pairedT(each.fit, best) >= 2 && each.fit.left_out >= 1.1 * best.left_out &&
        !isSameForce(each, all.front()))
      continue;
    found.push_back(each);
  }
  const auto penalised = [](const Candidate& each) {
    const SimulationFit& fit = each.naming.fit;
    return fit.left_out * (1 + 2 * fit.parameters() / effectiveSamples(fit));
  };
  std::stable_sort(found.begin(), found.end(), [&](const Candidate& left, const Candidate& right) {
    return penalised(left) < penalised(right);
  });
  const double least = penalised(found.front());
  const Candidate first = found.front();
  const auto is_tied = [&](const Candidate& each) {
    return penalised(each) < 1.05 * least || isSameForce(each, first) ||
           (penalised(each) < 1.25 * least && pairedT(each.naming.fit, first.naming.fit) < 2);
  };
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const Candidate& each) { return !is_tied(each); }),
              found.end());
  std::stable_sort(found.begin(), found.end(), [](const Candidate& left, const Candidate& right) {
    return rankOf(left) < rankOf(right);
  });
  return found;
}

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

FoundCurve CurveSearch::describe(const std::vector<Candidate>& tied) const {
  const Candidate& first = tied.front();
  FoundCurve found;
  found.is_delay = first.kind == CandidateKind::delay;
  const SimulationFit& fit = found.is_delay ? first.fit : first.naming.fit;
  found.delay = fit.model.delay;
  found.place = first.place;
  found.shape = first.naming.shape;
  found.nearest = first.naming.nearest;
  found.nearest_share = first.naming.nearest_share;
  found.left_out_gain = 1 - fit.left_out / result_.fit.left_out;
  found.t = pairedT(result_.fit, fit);
  for (std::size_t k = 1; k < tied.size(); ++k)
    addTie({tied[k].place, tied[k].naming.shape}, &found);
  for (const OtherShape& other : first.naming.others)
    if (other.behind < 2 && other.shape != "curve") addTie({found.place, other.shape}, &found);
  return found;
}

bool CurveSearch::convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
  if (before.size() == 0) return true;
  return 1 - after.sum() / before.sum() >= limits_.least_gain &&
         heldOutT(before, after) >= limits_.least_held_t;
}

/// Accepts the best of the curves, or dead time, if held-out windows gain; otherwise drops it.
bool CurveSearch::takeCause(std::vector<Candidate>* all) {
  const std::vector<Candidate> tied = rivals(*all);
  const Candidate& first = tied.front();
  const SimulationFit& fit = first.kind == CandidateKind::delay ? first.fit : first.naming.fit;
  Eigen::VectorXd errors = heldErrors(fit);
  if (!convinces(held_errors_, errors) ||
      !convinces(errorsBeyondGain(held_, result_.fit.model), errorsBeyondGain(held_, fit.model))) {
    tell("held out refuses " + nameOf(first.place.place) + " " + first.naming.shape);
    const auto same = [&](const Candidate& each) {
      return each.kind == first.kind && each.fit.left_out == first.fit.left_out;
    };
    all->erase(std::remove_if(all->begin(), all->end(), same), all->end());
    return false;
  }
  result_.causes.push_back(describe(tied));
  result_.causes.back().held_before = held_errors_.sum();
  result_.causes.back().held_after = errors.sum();
  result_.fit = fit;
  held_errors_ = std::move(errors);
  return true;
}

CurveSearch::Round CurveSearch::round() {
  std::vector<Candidate> all = candidates();
  all.erase(std::remove_if(all.begin(), all.end(),
                           [this](const Candidate& each) { return !isWorth(each); }),
            all.end());
  for (int tried = 0; tried < 3 && !all.empty(); ++tried) {
    const bool is_plant =
        all.front().kind == CandidateKind::order || all.front().kind == CandidateKind::direct;
    if (!is_plant) {
      if (takeCause(&all)) return Round::cause;
      continue;
    }
    if (takePlant(all.front())) return Round::plant;
    all.erase(all.begin());
  }
  return Round::nothing;
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

/// The plant has settled: each curve is freed and named again. Takes the first, puts it last.
void CurveSearch::nameAgain() {
  for (std::size_t k = 0; k < result_.fit.model.curves.size() && context_.going_on(); ++k) {
    const SplitModel parts = splitOff(result_.fit.model);
    const Curve& curve = parts.curve;
    result_.fit.model = parts.with(parts.without, curve, parts.own);
    const Curve freed = isScalar(curve.place()) ? curve : curve.freed();
    if (isScalar(curve.place()) || freed.parameters() == 0) continue;
    const SimulationFit base = fitFreely(data_, parts.without, context_.limits(8));
    const SimulationFit fitted =
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
void CurveSearch::keepIfAsGood(SimulationFit changed) {
  Eigen::VectorXd errors = heldErrors(changed);
  if (errors.sum() > 1.02 * held_errors_.sum()) return;
  result_.fit = std::move(changed);
  held_errors_ = std::move(errors);
}

CurveSearchResult CurveSearch::run(const SimulationFit& base) {
  constexpr double kPerfect = 1e-5;
  result_ = {};
  result_.base = result_.fit = base;
  base_left_out_ = base.left_out;
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

}  // namespace

CurveSearchResult searchCurves(const SimulationData& data, const SimulationData& held,
                               const CurveSearchLimits& limits, const CurveSearchContext& context) {
  if (context.tell) context.tell("fitting the smallest plant");
  const LinearPlants linear = fitLinearPlants(data, limits.max_order, context);
  CurveSearch search(data, held, linear, limits, context);
  CurveSearchResult best;
  for (const SimulationFit& base : linear.starts) {
    CurveSearchResult found = search.run(base);
    if (best.base.parameters() == 0) {
      best = std::move(found);
    } else if (isBetter(found, best)) {
      found.base = std::move(best.base);
      best = std::move(found);
    }
  }
  const double base_error = heldOutErrors(held, best.base.model).sum();
  const bool is_poor =
      heldOutFit(held, Eigen::VectorXd::Constant(1, best.held_error)) < limits.least_fit;
  if (best.causes.empty() || (!is_poor && best.held_error < (1 - limits.least_gain) * base_error))
    return best;
  // What does not simulate held-out windows better than the linear plant is no cause of its errors.
  best.causes.clear();
  best.fit = best.base;
  best.held_error = base_error;
  return best;
}

}  // namespace uncertainty_identification
