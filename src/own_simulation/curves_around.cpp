#include "own_simulation/curves_around.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "curves/fit_comparison.h"
#include "own_simulation/answered_data.h"
#include "own_simulation/describe_shape.h"
#include "own_simulation/logged_simulation.h"

namespace uncertainty_identification {
namespace {

/// A gain and an offset of the output, which cost no runs.
Changes gainAndOffset() {
  return {{ChangeKind::gain, -1, Eigen::VectorXd::Zero(1)},
          {ChangeKind::offset, -1, Eigen::VectorXd::Zero(1)}};
}

/// A shape around the simulation, and what it was fitted to.
struct Candidate {
  std::unique_ptr<ShapedSimulation> simulation;
  std::unique_ptr<SimulationRuns> runs;
  std::unique_ptr<ChangedSimulation> changed;
  ChangeFit fit;

  Candidate(Simulation& own, const PlacedShape& placed, const ComparedData& data, int most,
            const std::function<bool(int)>& keep_going)
      : simulation(std::make_unique<ShapedSimulation>(own, placed)),
        runs(std::make_unique<SimulationRuns>(*simulation, most, keep_going)),
        changed(std::make_unique<ChangedSimulation>(*runs, data)) {}

  const PlacedShape& placed() const { return simulation->placed(); }
  /// Gain, offset and all parameters of the shape.
  Changes changes() const {
    Changes all = gainAndOffset();
    for (int k = 0; k < placed().start.size(); ++k)
      all.push_back({ChangeKind::parameter, k, Eigen::VectorXd::Zero(1)});
    return all;
  }
};

/// The search.
class SearchAround {
 public:
  SearchAround(Simulation& simulation, const ComparisonTask& task, int most)
      : counted_(simulation), task_(task), most_(most) {}

  SimulationCauses run();
  int count() const { return counted_.count(); }

 private:
  int left() const;
  const ComparedData& dataFor(const PlacedShape& placed) const;
  std::vector<PlacedShape> shapesToTry() const;
  template <class Fit>
  void tryOut(const PlacedShape& placed, const ComparedData& data, const Fit& fit,
              std::vector<Candidate>* found);
  std::vector<Candidate> screened();
  std::vector<Candidate> fitted(const std::vector<Candidate>& screened);

  CountedSimulation counted_;
  const std::unique_ptr<Simulation> logged_ = makeLoggedSimulation(Answered::kSignal, "its answer");
  std::unique_ptr<Answered> answers_, held_answers_;
  const ComparisonTask& task_;
  const int most_;
  bool ended_early_ = false;
};

/// Runs that are left for fitting, besides those of the best curve for what is held out, and of the
/// comparison with the curve.
int SearchAround::left() const {
  return most_ - count() - static_cast<int>(task_.held.runs.size()) - 2 * task_.fewest();
}

/// What a shape is fitted to.
const ComparedData& SearchAround::dataFor(const PlacedShape& placed) const {
  return placed.place == Place::sensor ? answers_->data() : task_.fitted;
}

double rootMeanSquare(double squares, Eigen::Index samples) {
  return std::max(std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(samples, 1))),
                  std::numeric_limits<double>::min());
}

std::vector<PlacedShape> SearchAround::shapesToTry() const {
  double of_u = 0, of_y = 0;
  Eigen::Index samples = 0;
  for (const ComparedRun& run : answers_->data().runs) {
    of_u += run.experiment->u.squaredNorm();
    of_y += run.experiment->signals.at(Answered::kSignal).squaredNorm();
    samples += run.experiment->samples();
  }
  return shapesAround(rootMeanSquare(of_u, samples), rootMeanSquare(of_y, samples));
}

/// Adds the shape with its fit, unless there are no runs left for it.
template <class Fit>
void SearchAround::tryOut(const PlacedShape& placed, const ComparedData& data, const Fit& fit,
                          std::vector<Candidate>* found) {
  const bool is_behind = placed.place == Place::sensor;
  const auto fewest =
      static_cast<int>(data.runs.size()) * static_cast<int>(1 + placed.start.size());
  const bool is_cancelled = task_.keep_going && !task_.keep_going(count());
  ended_early_ = ended_early_ || is_cancelled || (!is_behind && left() < fewest);
  if (is_cancelled || (!is_behind && left() < fewest)) return;
  Simulation& simulation = is_behind ? *logged_ : counted_;
  Candidate candidate(simulation, placed, data, left(), task_.keep_going);
  candidate.fit = fit(candidate);
  ended_early_ = ended_early_ || candidate.runs->endedEarly();
  if (std::isfinite(candidate.fit.leftOut())) found->push_back(std::move(candidate));
}

/// All shapes, each from its best start and by one linearised step, for a few experiments; the best
/// first.
std::vector<Candidate> SearchAround::screened() {
  constexpr std::size_t kFew = 6;
  std::vector<Candidate> found;
  std::vector<PlacedShape> all = shapesToTry();
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(), [&](const PlacedShape& each) {
      return each.shape != begin->shape || each.place != begin->place ||
             each.is_mirrored != begin->is_mirrored;
    });
    ComparedData few = dataFor(*begin);
    if (few.runs.size() > kFew) few.runs.resize(kFew);
    std::vector<Candidate> starts;
    for (auto each = begin; each != end; ++each)
      tryOut(
          *each, few,
          [&](const Candidate& candidate) {
            return fitChanges(*candidate.changed, few, gainAndOffset());
          },
          &starts);
    const auto best = std::min_element(starts.begin(), starts.end(),
                                       [](const Candidate& left, const Candidate& right) {
                                         return left.fit.squared_error < right.fit.squared_error;
                                       });
    if (best != starts.end())
      tryOut(
          best->placed(), few,
          [&](const Candidate& candidate) {
            return stepOnce(*candidate.changed, few, candidate.changes());
          },
          &found);
    begin = end;
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& left, const Candidate& right) {
    return left.fit.leftOut() < right.fit.leftOut();
  });
  return found;
}

/// The best few fitted to all experiments, the best first.
std::vector<Candidate> SearchAround::fitted(const std::vector<Candidate>& screened) {
  constexpr std::size_t kBest = 4;
  std::vector<Candidate> found;
  for (std::size_t k = 0; k < std::min(kBest, screened.size()); ++k) {
    const ComparedData& data = dataFor(screened[k].placed());
    tryOut(
        screened[k].placed(), data,
        [&](const Candidate& candidate) {
          return fitChanges(*candidate.changed, data, candidate.changes());
        },
        &found);
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& left, const Candidate& right) {
    return left.fit.leftOut() < right.fit.leftOut();
  });
  return found;
}

/// Covariance of the shape's parameters.
Eigen::MatrixXd covarianceOf(const Candidate& candidate) {
  const Eigen::Index first = estimatedCoordinates(gainAndOffset());
  const Eigen::Index count = candidate.placed().start.size();
  Eigen::VectorXd slopes(count);
  for (int k = 0; k < count; ++k)
    slopes[k] = candidate.changed->slopeAt(
        k,
        candidate.fit.changes[static_cast<std::size_t>(first) + static_cast<std::size_t>(k)].at[0]);
  return slopes.asDiagonal() * candidate.fit.covariance.block(first, first, count, count) *
         slopes.asDiagonal();
}

/// Between which values the signal lies that goes into the shape.
std::pair<double, double> rangeOf(const PlacedShape& placed, const ComparedData& answers) {
  if (placed.place == Place::time_gain) return {0, 1};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ComparedRun& run : answers.runs) {
    const Eigen::VectorXd& signal = placed.place == Place::input
                                        ? run.experiment->u
                                        : run.experiment->signals.at(Answered::kSignal);
    for (Eigen::Index k = 0; k < signal.size(); ++k) {
      if (!(run.weight[k] > 0)) continue;
      low = std::min(low, signal[k]);
      high = std::max(high, signal[k]);
    }
  }
  return {low, high};
}

SimulationCause describe(const Candidate& candidate, const ComparedData& data) {
  const auto [low, high] = rangeOf(candidate.placed(), data);
  return describeShape(candidate.placed(), candidate.changed->values(candidate.fit.changes),
                       covarianceOf(candidate), low, high);
}

/// Those that the data do not tell from the first.
std::vector<PlaceAndShape> tiesOf(const std::vector<Candidate>& candidates) {
  constexpr double kNear = 1.05, kSignificant = 2;
  std::vector<PlaceAndShape> ties;
  const PlaceAndShape first = placeAndShapeOf(candidates.front().placed());
  const Eigen::VectorXd& best = candidates.front().fit.left_out_of;
  for (auto each = std::next(candidates.begin()); each != candidates.end(); ++each) {
    const PlaceAndShape other = placeAndShapeOf(each->placed());
    const bool is_mirror = other.place == first.place && other.shape == first.shape;
    if (!is_mirror && (each->fit.leftOut() < kNear * best.sum() ||
                       pairedT(each->fit.left_out_of, best) < kSignificant))
      ties.push_back(other);
  }
  return ties;
}

SimulationCauses SearchAround::run() {
  SimulationCauses found;
  task_.limits.tell("trying curves before and behind your simulation");
  found.ended_early = left() < task_.fewest() || (task_.keep_going && !task_.keep_going(0));
  if (found.ended_early) return found;
  SimulationRuns runs(counted_, most_, task_.keep_going);
  answers_ = std::make_unique<Answered>(task_.fitted, &runs);
  held_answers_ = std::make_unique<Answered>(task_.held, &runs);
  const ChangedSimulation plain(runs, task_.fitted);
  const ChangeFit without = fitChanges(plain, task_.fitted, gainAndOffset());
  const std::vector<Candidate> candidates = fitted(screened());
  found.ended_early = ended_early_;
  if (candidates.empty() || !std::isfinite(without.leftOut())) return found;
  const Candidate& best = candidates.front();
  const bool is_behind = best.placed().place == Place::sensor;
  const Eigen::VectorXd held_without = errorsOf(plain, task_.held, without.changes),
                        held_with =
                            errorsOf(*best.changed, is_behind ? held_answers_->data() : task_.held,
                                     best.fit.changes);
  found.fit_before = found.fit_after = task_.held.fitOf(held_without.sum());
  const ChangeSearchLimits& limits = task_.limits;
  const auto gains = [](const Eigen::VectorXd& before, const Eigen::VectorXd& after, double share,
                        double t) {
    return after.sum() <= (1 - share) * before.sum() && pairedT(before, after) >= t;
  };
  if (!gains(without.left_out_of, best.fit.left_out_of, limits.least_gain, limits.least_t) ||
      !gains(held_without, held_with, limits.least_gain, limits.least_held_t))
    return found;
  found.fit_after = task_.held.fitOf(held_with.sum());
  found.causes.push_back(describe(best, answers_->data()));
  found.causes.back().ties = tiesOf(candidates);
  found.causes.back().fit_before = found.fit_before;
  found.causes.back().fit_after = found.fit_after;
  return found;
}

}  // namespace

SimulationCauses searchCurvesAround(Simulation& simulation, const ComparisonTask& task, int most,
                                    int* count) {
  SearchAround search(simulation, task, most);
  SimulationCauses found = search.run();
  *count += search.count();
  return found;
}

}  // namespace uncertainty_identification
