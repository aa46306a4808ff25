#include "own_simulation/change.h"

#include <algorithm>
#include <cmath>

#include "own_simulation/output_filters.h"

namespace uncertainty_identification {
namespace {

constexpr double kOfParameter = 2e-3;  ///< step of differences: large beside rounded answers

/// A step for differences by one coordinate.
double differenceStep(const Change& change) {
  switch (change.kind) {
    case ChangeKind::parameter:
      return kOfParameter;
    case ChangeKind::delay:
    case ChangeKind::lag:
      return 0.02;
    default:
      return 1e-4;
  }
}

Change changeAt(ChangeKind kind, int parameter, const Eigen::VectorXd& at) {
  return {kind, parameter, at};
}

Eigen::VectorXd filteredBy(const Change& change, const Eigen::VectorXd& y) {
  const Eigen::VectorXd& at = change.at;
  switch (change.kind) {
    case ChangeKind::gain:
      return (1 + at[0]) * y;
    case ChangeKind::offset:
      return (y.array() + at[0]).matrix();
    case ChangeKind::delay:
      return delayedOutput(y, at[0]);
    case ChangeKind::lag:
      return leadLag(y, 0, std::max(at[0], 0.0));
    case ChangeKind::time_constant:
      return leadLag(y, std::exp(at[0]), std::exp(at[1]));
    case ChangeKind::parameter:
    case ChangeKind::initial_state:
      break;
  }
  return y;
}

}  // namespace

Eigen::Index estimatedCoordinates(const Changes& changes) {
  Eigen::Index count = 0;
  for (const Change& change : changes) count += change.estimated();
  return count;
}

Changes moved(Changes changes, const Eigen::VectorXd& step) {
  Eigen::Index first = 0;
  for (Change& change : changes) {
    change.at.head(change.estimated()) += step.segment(first, change.estimated());
    first += change.estimated();
    if (change.kind == ChangeKind::lag) change.at[0] = std::max(change.at[0], 0.0);
  }
  return changes;
}

std::vector<Change> startsOf(ChangeKind kind, int parameter, int samples) {
  std::vector<Change> starts;
  const auto add = [&](std::initializer_list<double> at) {
    Eigen::VectorXd coordinates(static_cast<Eigen::Index>(at.size()));
    std::copy(at.begin(), at.end(), coordinates.data());
    starts.push_back(changeAt(kind, parameter, coordinates));
  };
  switch (kind) {
    case ChangeKind::delay:
      for (const double delay : {0., 1., -1., 2., -2., 4., -4., 7., -7., 12., 20.}) add({delay});
      break;
    case ChangeKind::lag:
      for (const double lag : {0.5, 2., 8., 30.}) add({lag});
      break;
    case ChangeKind::time_constant:
      for (const double time : {1.5, 5., 15., 50.})
        for (const double ratio : {0.6, 1.6}) add({std::log(time), std::log(time * ratio)});
      break;
    case ChangeKind::initial_state:
      for (const double share : {0.01, 0.02, 0.04, 0.08, 0.16}) add({share * samples});
      break;
    default:
      add({0.});
  }
  return starts;
}

ChangedSimulation::ChangedSimulation(SimulationRuns& runs, const ComparedData& data)
    : runs_(runs), step_(Eigen::VectorXd::Ones(runs.ownValues().size())) {
  constexpr double kVisible = 0.1;  // of the output's size, by a whole step
  const ComparedRun& run = data.runs.front();
  const double size = runs.output(run, runs.ownValues()).norm();
  for (Eigen::Index k = 0; k < step_.size(); ++k) {
    if (runs.ownValues()[k] != 0) continue;
    for (step_[k] = 1e-4; step_[k] < 1e5 && runs.affords(1); step_[k] *= 10) {
      Eigen::VectorXd values = runs.ownValues();
      values[k] = kOfParameter * step_[k];
      const Eigen::VectorXd changed = runs.output(run, values);
      if (changed.allFinite() &&
          (changed - runs.output(run, runs.ownValues())).norm() > kVisible * kOfParameter * size)
        break;
    }
  }
}

double ChangedSimulation::valueAt(int parameter, double coordinate) const {
  const double yours = runs_.ownValues()[parameter];
  return yours == 0 ? coordinate * step_[parameter] : yours * std::exp(coordinate);
}

double ChangedSimulation::slopeAt(int parameter, double coordinate) const {
  return runs_.ownValues()[parameter] == 0 ? step_[parameter] : valueAt(parameter, coordinate);
}

Eigen::VectorXd ChangedSimulation::values(const Changes& changes) const {
  Eigen::VectorXd values = runs_.ownValues();
  for (const Change& change : changes)
    if (change.kind == ChangeKind::parameter && change.at[0] != 0)
      values[change.parameter] = valueAt(change.parameter, change.at[0]);
  return values;
}

Eigen::VectorXd ChangedSimulation::output(const ComparedRun& run, const Changes& changes) const {
  Eigen::VectorXd y = runs_.output(run, values(changes));
  for (const ChangeKind kind : {ChangeKind::delay, ChangeKind::lag, ChangeKind::time_constant,
                                ChangeKind::gain, ChangeKind::offset})
    for (const Change& change : changes)
      if (change.kind == kind) y = filteredBy(change, y);
  return y;
}

Eigen::MatrixXd ChangedSimulation::derivatives(const ComparedRun& run,
                                               const Changes& changes) const {
  const Eigen::VectorXd y = output(run, changes);
  Eigen::MatrixXd all(y.size(), estimatedCoordinates(changes));
  Eigen::Index column = 0;
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const double step = differenceStep(changes[c]);
    for (Eigen::Index k = 0; k < changes[c].estimated(); ++k) {
      Changes stepped = changes;
      stepped[c].at[k] += step;
      all.col(column++) = (output(run, stepped) - y) / step;
    }
  }
  return all;
}

Eigen::MatrixXd transientOf(const Changes& changes, Eigen::Index samples) {
  for (const Change& change : changes)
    if (change.kind == ChangeKind::initial_state)
      return (-Eigen::ArrayXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)) /
              change.at[0])
          .exp()
          .matrix();
  return Eigen::MatrixXd(samples, 0);
}

}  // namespace uncertainty_identification
