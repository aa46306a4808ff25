#include "curves/screening_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "curves/free_simulation.h"
#include "curves/starts_behind.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Signal = Eigen::VectorXd SimulationWindow::*;

Eigen::VectorXd joined(const SimulationData& data, Signal signal) {
  Eigen::Index count = 0;
  for (const SimulationWindow& window : data.windows) count += window.samples();
  Eigen::VectorXd all(count);
  Eigen::Index at = 0;
  for (const SimulationWindow& window : data.windows) {
    all.segment(at, window.samples()) = window.*signal;
    at += window.samples();
  }
  return all;
}

Eigen::VectorXd joinedCovariate(const SimulationData& data, const std::string& name) {
  std::vector<double> all;
  for (const SimulationWindow& window : data.windows) {
    const Eigen::VectorXd& signal = window.covariates.at(name);
    all.insert(all.end(), signal.data(), signal.data() + signal.size());
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// The measured output of all windows, counted from their levels.
Eigen::VectorXd outputOf(const SimulationData& data, const CurveModel& model) {
  SimulationData counted = data;
  for (std::size_t w = 0; w < counted.windows.size(); ++w)
    counted.windows[w].y.array() -= model.levelOf(w);
  return joined(counted, &SimulationWindow::y);
}

/// A signal in the simulation, without the first sample of each window; outputs less their levels.
Eigen::VectorXd simulatedSignal(const SimulationData& data, const CurveModel& model,
                                Eigen::VectorXd FreeSimulation::*signal) {
  const std::vector<CurveTable> tables = tablesOf(model);
  std::vector<double> all;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    Eigen::VectorXd values =
        simulateFreely(model, tables, data.windows[w], model.initial[w], false).*signal;
    if (signal == &FreeSimulation::y) values.array() -= model.levelOf(w);
    all.insert(all.end(), values.data() + 1, values.data() + values.size());
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// The loop's error in the simulation, without the first sample of each window.
Eigen::VectorXd loopError(const SimulationData& data, const CurveModel& model) {
  Eigen::VectorXd error = -model.inverseGain() * simulatedSignal(data, model, &FreeSimulation::y);
  error.array() += model.theta[model.biasIndex()];
  Eigen::Index at = 0;
  for (const SimulationWindow& window : data.windows)
    for (int k = 1; k < window.samples(); ++k)
      error[at++] += window.u[std::max(k - model.delay, 0)];
  return error;
}

Curve curveAt(const SimulationData& data, const PlaceOf& at, CurveModel* model) {
  const SignalScales& scales = data.scales;
  switch (at.place) {
    case Place::input:
    case Place::input_times_position:
      return {at.place, nullptr, joined(data, &SimulationWindow::u), scales.u.zero()};
    case Place::rate:
    case Place::rate_gain: {
      Eigen::VectorXd rates = simulatedSignal(data, *model, &FreeSimulation::rate);
      if (!model->has(Place::rate) && !model->has(Place::rate_gain)) {
        const double size = std::sqrt(rates.array().square().mean()) + 1e-9;
        model->rate_scale *= size;
        rates /= size;
      }
      return {at.place, nullptr, rates, 0};
    }
    case Place::loop_error:
      return {at.place, nullptr, loopError(data, *model), 0};
    case Place::time:
    case Place::time_gain:
      return {at.place, nullptr, joined(data, &SimulationWindow::time), 0};
    case Place::covariate:
    case Place::covariate_gain:
      return {at.place, nullptr, joinedCovariate(data, at.covariate),
              scales.covariates.at(at.covariate).zero(), at.covariate};
    case Place::sensor:  // what goes in is the output before the sensor's curve
      return {at.place, nullptr, simulatedSignal(data, *model, &FreeSimulation::y),
              scales.y.zero()};
    case Place::play:
    case Place::rate_limit:
    case Place::output_play:
    case Place::input_hysteresis:
      return Curve(at.place);
    default:
      return {at.place, nullptr, outputOf(data, *model), scales.y.zero()};
  }
}

/// The covariate itself, of one behind a lag.
std::string covariateBehind(const std::string& name, const SimulationData& data) {
  return name.empty() ? "" : data.scales.covariates.at(name).of;
}

/// Of a covariate behind several lags, the first is kept.
void keepFirstLag(const SimulationData& data, std::vector<ScreenedPlace>* sorted) {
  std::set<std::string> seen;
  std::vector<ScreenedPlace> kept;
  for (ScreenedPlace& each : *sorted)
    if (each.place.place != Place::covariate ||
        seen.insert(covariateBehind(each.place.covariate, data)).second)
      kept.push_back(std::move(each));
  *sorted = std::move(kept);
}

/// Whether the input goes both ways from its physical zero, so that its size is not itself.
bool changesSign(const SimulationData& data) {
  constexpr double kShare = 0.1;
  double above = 0, below = 0, samples = 0;
  for (const SimulationWindow& window : data.windows) {
    above += static_cast<double>((window.u.array() > -data.scales.u.zero()).count());
    below += static_cast<double>((window.u.array() < -data.scales.u.zero()).count());
    samples += window.samples();
  }
  return std::min(above, below) > kShare * samples;
}

/// Whether a play shows: it takes the same width at each reversal. At the first motion it is a dead
/// zone.
bool reverses(const SimulationData& data) {
  constexpr double kLeast = 0.1;  // standard deviations of the input
  constexpr int kTwice = 2;
  int reversals = 0;
  for (const SimulationWindow& window : data.windows) reversals += reversalsOf(window.u, kLeast);
  return reversals >= kTwice;
}

std::vector<PlaceOf> placesFor(const SimulationData& data, const CurveModel& model) {
  std::vector<PlaceOf> all{{Place::input, ""}, {Place::position, ""}};
  if (model.order > 1) all.push_back({Place::output_state, ""});
  // The linear plant of a loop at its limit is slower, and its gain may be any.
  if (model.curves.empty() && !model.direct &&
      isStable(model.theta.head(model.order), std::exp(-1.0 / data.longest)))
    all.push_back({Place::loop_error, ""});
  if (changesSign(data)) all.push_back({Place::hysteresis, ""});
  for (const Place place : {Place::rate, Place::position_gain, Place::input_times_position,
                            Place::rate_gain, Place::sensor, Place::time_gain, Place::time})
    all.push_back({place, ""});
  for (const auto& [name, scale] : data.scales.covariates) {
    all.push_back({Place::covariate, name});
    if (scale.lag == 0) all.push_back({Place::covariate_gain, name});
  }
  const bool may_have_play = reverses(data);
  if (may_have_play) all.push_back({Place::play, ""});
  all.push_back({Place::rate_limit, ""});
  if (may_have_play) {
    all.push_back({Place::output_play, ""});
    all.push_back({Place::input_hysteresis, ""});
  }
  const auto taken = [&](const PlaceOf& at) {
    return std::any_of(model.curves.begin(), model.curves.end(), [&](const Curve& curve) {
      return curve.place() == at.place &&
             covariateBehind(curve.covariate(), data) == covariateBehind(at.covariate, data);
    });
  };
  all.erase(std::remove_if(all.begin(), all.end(), taken), all.end());
  return all;
}

void keepBetter(WindowFit stepped, WindowFit* best) {
  if (stepped.left_out < best->left_out) *best = std::move(stepped);
}

/// The plant that is driven by the covariate, too, with a curve of it that is a straight line.
CurveModel driven(const SimulationData& data, const WindowFit& fit, const PlaceOf& place) {
  PlantBesideCovariate beside = plantBeside(data, fit.model, place.covariate);
  CurveModel& model = beside.plant;
  if (model.order == 0) return model;
  const Curve curve = curveAt(data, place, &model);
  const Eigen::VectorXd line = curve.closest(beside.ratio * curve.samples());
  model.input_zero = data.scales.u.zero();
  model.theta.conservativeResize(model.theta.size() + line.size());
  model.theta.tail(line.size()) = line;
  model.curves.push_back(curve);
  return model;
}

}  // namespace

bool comesToRest(const CurveModel& model) {
  constexpr double kLeast = 0.2, kMost = 5;  // standard deviations of y for one of u
  const double gain = 1 / std::abs(model.inverseGain());
  return !model.direct && gain > kLeast && gain < kMost && isStable(model.theta.head(model.order));
}

CurveModel extended(const SimulationData& data, const WindowFit& fit, const PlaceOf& place,
                    double width) {
  CurveModel model = fit.model;
  model.input_zero = data.scales.u.zero();
  const Curve curve = curveAt(data, place, &model);
  Eigen::VectorXd theta(model.theta.size() + curve.parameters());
  theta << model.theta, Eigen::VectorXd::Constant(curve.parameters(), width);
  model.theta = std::move(theta);
  model.curves.push_back(curve);
  return model;
}

std::vector<ScreenedPlace> screenPlaces(const SimulationData& data, const WindowFit& fit,
                                        const std::function<bool(Place)>& excluded,
                                        const CurveSearchContext& context) {
  std::vector<PlaceOf> places = placesFor(data, fit.model);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const PlaceOf& at) { return excluded && excluded(at.place); }),
               places.end());
  std::vector<ScreenedPlace> found(places.size());
  context.pool->forEach(static_cast<int>(places.size()), [&](int index) {
    const PlaceOf& place = places[static_cast<std::size_t>(index)];
    ScreenedPlace& screened = found[static_cast<std::size_t>(index)];
    screened.place = place;
    screened.fit.left_out = std::numeric_limits<double>::infinity();
    std::vector<double> widths{0};
    if (isScalar(place.place)) widths = widthsFor(data, place.place);
    for (const double width : widths) {
      const CurveModel model = extended(data, fit, place, width);
      if (model.curves.back().parameters() == 0) continue;
      keepBetter(stepLinearly(data, model), &screened.fit);
    }
    if (place.place != Place::covariate || !fit.model.curves.empty()) return;
    const CurveModel model = driven(data, fit, place);
    if (model.order > 0 && isSimulable(model)) keepBetter(stepLinearly(data, model), &screened.fit);
  });
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const ScreenedPlace& each) { return each.fit.step.size() == 0; }),
              found.end());
  std::stable_sort(found.begin(), found.end(),
                   [](const ScreenedPlace& left, const ScreenedPlace& right) {
                     return left.fit.left_out < right.fit.left_out;
                   });
  keepFirstLag(data, &found);
  return found;
}

WindowFit fitPlace(const SimulationData& data, const WindowFit& before,
                   const ScreenedPlace& screened, const CurveSearchContext& context) {
  WindowFit best;
  best.squared_error = std::numeric_limits<double>::infinity();
  for (const double share : {0.0, 1.0, 0.4}) {
    CurveModel model = screened.fit.model;
    model.theta += share * screened.fit.step;
    model.initial = before.model.initial;
    if (share > 0 && !isSimulable(model)) continue;
    WindowFit fitted = fitFreely(data, std::move(model), context.limits(5));
    if (fitted.squared_error < best.squared_error) best = std::move(fitted);
  }
  best = fitFreely(data, std::move(best.model), context.limits(25));
  const Place place = screened.place.place;
  const bool is_before_plant = place == Place::play || place == Place::rate_limit;
  if (!is_before_plant || !before.model.curves.empty()) return best;
  CurveModel behind = startBehind(data, before.model, place);
  if (behind.order == 0) return best;
  WindowFit other = fitFreely(data, std::move(behind), context.limits(25));
  return other.squared_error < best.squared_error ? other : best;
}

}  // namespace uncertainty_identification
