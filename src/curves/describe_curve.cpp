#include "curves/describe_curve.h"

#include <algorithm>
#include <cmath>

#include "curves/curve_words.h"

namespace uncertainty_identification {
namespace {

constexpr double kNearly = 0.9;       // share of a free curve's gain that names it
constexpr double kNormal90 = 1.6449;  // quantile of 95 %

Scale signalScale(const PlaceOf& at, const CurveModel& model, const SignalScales& scales) {
  switch (at.place) {
    case Place::input:
    case Place::input_times_position:
    case Place::play:
    case Place::rate_limit:
    case Place::input_hysteresis:
      return scales.u;
    case Place::loop_error:
      return {0, scales.u.unit};
    case Place::rate:
    case Place::rate_gain:
      return {0, model.rate_scale * scales.y.unit};
    case Place::time:
    case Place::time_gain:
      return {0, 1};
    case Place::covariate:
    case Place::covariate_gain:
      return scales.covariates.at(at.covariate);
    default:
      return scales.y;
  }
}

std::string signalOf(const PlaceOf& at) {
  switch (at.place) {
    case Place::input:
    case Place::input_times_position:
      return "input";
    case Place::loop_error:
      return "input less the one that would hold the output";
    case Place::rate:
    case Place::rate_gain:
      return "change of the output per sample";
    case Place::time:
    case Place::time_gain:
      return "share of the experiment";
    case Place::covariate:
    case Place::covariate_gain:
      return at.covariate;
    default:
      return "output";
  }
}

bool isFactor(Place place) {
  return place == Place::position_gain || place == Place::rate_gain || place == Place::time_gain ||
         place == Place::covariate_gain || place == Place::input_times_position ||
         place == Place::hysteresis;
}

double valueUnit(Place place, const SignalScales& scales) {
  return isFactor(place) ? 1 : place == Place::sensor ? scales.y.unit : scales.u.unit;
}

/// Whether what enters is known only as what the linear plant simulates, which a whole shape of a
/// sensor shrinks to its slope.
bool isShrunk(const Curve& curve) {
  return curve.place() == Place::sensor && curve.shape() && curve.shape()->is_whole;
}

/// A value of the curve's argument, counted from the physical zero, in the units of the data. What
/// entered a sensor is told as the sensor reads it where its shape has a slope of one.
double argumentInUnits(const Curve& curve, const Eigen::VectorXd& parameters, const Scale& signal,
                       double value) {
  if (!isShrunk(curve)) return signal.unit * value;
  const Curve::Normalisation of = curve.normalisation(parameters);
  return signal.offset + signal.unit * (value - of.constant) / of.scale;
}

/// A limit as the sensor reads it, on the side where it is reached; half the width of a dead zone.
double readingOf(const Curve& curve, const Eigen::VectorXd& parameters, const Scale& signal,
                 double value) {
  if (curve.shape()->name != "saturation")
    return signal.unit * value / curve.normalisation(parameters).scale;
  const double largest = curve.samples()[curve.samples().size() - 1] + signal.zero();
  const double limit = largest >= std::abs(value) ? std::abs(value) : -std::abs(value);
  return argumentInUnits(curve, parameters, signal, limit);
}

/// The parameters of a shape in the units of the data.
Eigen::VectorXd inUnits(const Curve& curve, const Eigen::VectorXd& parameters, const Scale& signal,
                        double value_unit) {
  const Shape& shape = *curve.shape();
  Eigen::VectorXd found = parameters;
  const Eigen::Index first = shape.is_whole ? 0 : 1;
  if (first == 1)
    found[0] = parameters[0] / curve.normalisation(parameters).scale * value_unit /
               std::pow(signal.unit, degreeOf(shape, parameters.data() + first));
  for (std::size_t k = 0; k < shape.parameters.size(); ++k) {
    double& each = found[first + static_cast<Eigen::Index>(k)];
    if (shape.parameters[k].unit == ShapeUnit::of_signal)
      each = isShrunk(curve) ? readingOf(curve, parameters, signal, each) : each * signal.unit;
    if (shape.parameters[k].unit == ShapeUnit::per_signal) each /= signal.unit;
    if (shape.parameters[k].is_size) each = std::abs(each);
  }
  return found;
}

/// d of(parameters) / d parameters, by differences.
template <class Function>
Eigen::MatrixXd slopesOf(const Function& of, const Eigen::VectorXd& parameters) {
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd slopes(of(parameters).size(), parameters.size());
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    Eigen::VectorXd above = parameters, below = parameters;
    above[k] += kStep;
    below[k] -= kStep;
    slopes.col(k) = (of(above) - of(below)) / (2 * kStep);
  }
  return slopes;
}

std::vector<ShapeValue> valuesOf(const Curve& curve, const Eigen::VectorXd& parameters,
                                 const Eigen::MatrixXd& covariance, const Scale& signal,
                                 double value_unit) {
  const auto in_units = [&](const Eigen::VectorXd& of) {
    return inUnits(curve, of, signal, value_unit);
  };
  const Eigen::VectorXd values = in_units(parameters);
  const Eigen::MatrixXd slopes = slopesOf(in_units, parameters);
  const Eigen::MatrixXd spread = slopes * covariance * slopes.transpose();
  std::vector<ShapeValue> all;
  const Shape& shape = *curve.shape();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Eigen::Index own = k - (shape.is_whole ? 0 : 1);
    const std::string name =
        own < 0 ? "amplitude" : shape.parameters[static_cast<std::size_t>(own)].name;
    all.push_back({name, values[k], std::sqrt(std::max(spread(k, k), 0.0))});
  }
  return all;
}

/// Of weights of plays: the gain right after the input has turned back, over that of long motions
/// (less than one: the actuator lags behind), and the mean half width.
Eigen::VectorXd hysteresisOf(const Eigen::VectorXd& weights) {
  const Eigen::Map<const Eigen::ArrayXd> widths(kPlayWidths.data(), kPlays);
  const Eigen::ArrayXd sizes = weights.array().abs() + 1e-12;
  return Eigen::Vector2d(1 / (1 + weights.sum()), (sizes * widths).sum() / sizes.sum());
}

/// The width, limit or weights of plays at a scalar place, in the units of the data.
std::vector<ShapeValue> valuesWithoutCurve(Place place, const Eigen::VectorXd& parameters,
                                           const Eigen::MatrixXd& covariance, double unit,
                                           double sample_time) {
  if (place != Place::input_hysteresis) {
    const bool is_limit = place == Place::rate_limit;
    const double scale = is_limit ? unit / sample_time : unit;
    return {{is_limit ? "limit_per_second" : "half_width", std::abs(parameters[0]) * scale,
             std::sqrt(std::max(covariance(0, 0), 0.0)) * scale}};
  }
  const Eigen::VectorXd values = hysteresisOf(parameters);
  const Eigen::MatrixXd slopes = slopesOf(hysteresisOf, parameters);
  const Eigen::VectorXd errors =
      (slopes * covariance * slopes.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  return {{"gain_after_reversal", values[0], errors[0]},
          {"mean_half_width", values[1] * unit, errors[1] * unit}};
}

/// Lower and upper 0.2 % of the measured changes of the output from sample to sample.
std::pair<double, double> measuredRates(const SimulationData& data) {
  constexpr double kTail = 0.002;
  std::vector<double> rates;
  for (const SimulationWindow& window : data.windows)
    for (Eigen::Index k = 1; k < window.y.size(); ++k)
      if (window.measured[k] > 0 && window.measured[k - 1] > 0)
        rates.push_back(window.y[k] - window.y[k - 1]);
  if (rates.empty()) return {0, 0};
  std::sort(rates.begin(), rates.end());
  const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(rates.size()));
  return {rates[tail], rates[rates.size() - 1 - tail]};
}

/// Between which values of its argument a curve is drawn: where data were, not all that the linear
/// plant simulates, which may move much further without the curve.
std::pair<double, double> drawnRange(const Curve& curve, const CurveModel& model,
                                     const SimulationData& data) {
  const Eigen::VectorXd& samples = curve.samples();
  const std::pair<double, double> simulated{samples[0], samples[samples.size() - 1]};
  if (curve.place() != Place::rate && curve.place() != Place::rate_gain) return simulated;
  const auto [low, high] = measuredRates(data);
  const std::pair<double, double> both{std::max(simulated.first, low / model.rate_scale),
                                       std::min(simulated.second, high / model.rate_scale)};
  return both.first < both.second ? both : simulated;
}

CurvePicture pictureOf(const Curve& curve, const Eigen::VectorXd& parameters,
                       const Eigen::MatrixXd& covariance, const PlaceOf& at, const Scale& signal,
                       double value_unit, const std::pair<double, double>& range) {
  constexpr int kPoints = 41;
  CurvePicture picture;
  picture.of = signalOf(at);
  picture.unit = isFactor(at.place) ? "1" : at.place == Place::sensor ? "output" : "input";
  const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(kPoints, range.first, range.second);
  const bool is_characteristic = isPassed(at.place);
  const auto drawn = [&](const Eigen::VectorXd& of) {
    return is_characteristic ? curve.characteristic(z, of) : curve.at(z, of);
  };
  const Eigen::VectorXd value = drawn(parameters);
  const Eigen::MatrixXd slopes = slopesOf(drawn, parameters);
  const double offset = is_characteristic ? signal.offset : 0;
  for (int k = 0; k < kPoints; ++k) {
    const double deviation =
        std::sqrt(std::max(slopes.row(k).dot(covariance * slopes.row(k).transpose()), 0.0));
    picture.signal.push_back(argumentInUnits(curve, parameters, signal, z[k] + signal.zero()));
    picture.value.push_back(offset + value_unit * value[k]);
    picture.lower_90.push_back(offset + value_unit * (value[k] - kNormal90 * deviation));
    picture.upper_90.push_back(offset + value_unit * (value[k] + kNormal90 * deviation));
  }
  return picture;
}

/// The shape by which a curve is called: that of its exponent, where a power has one of those that
/// physics knows within two standard errors.
std::string knownShape(const std::string& shape, const Eigen::VectorXd& parameters,
                       const Eigen::MatrixXd& covariance) {
  if (shape != "power") return shape;
  const double error = std::sqrt(std::max(covariance(1, 1), 0.0));
  for (const auto& [exponent, name] :
       {std::make_pair(0.5, "root"), std::make_pair(2.0, "signed_square"),
        std::make_pair(3.0, "cubic")})
    if (std::abs(parameters[1] - exponent) < 2 * error) return name;
  return shape;
}

/// Of two limits, drops the one beyond all but 0.2 % of the recorded signal: it is only known to
/// lie there. The words then speak of the other one.
void dropUnreachedLimit(SimulationCause* cause) {
  const auto is_unreached = [&](const ShapeValue& limit) {
    return (limit.name == "lower_limit" && limit.value < cause->curve.signal.front()) ||
           (limit.name == "upper_limit" && limit.value > cause->curve.signal.back());
  };
  std::vector<ShapeValue>& limits = cause->values;
  if (limits.size() != 2 || is_unreached(limits[0]) == is_unreached(limits[1])) return;
  limits.erase(std::remove_if(limits.begin(), limits.end(), is_unreached), limits.end());
  const std::string both = shapeInWords(cause->what.shape);
  const std::string one = limits[0].name == "lower_limit" ? "a lower limit" : "an upper limit";
  const std::size_t at = cause->description.find(both);
  if (at != std::string::npos) cause->description.replace(at, both.size(), one);
}

}  // namespace

SimulationCause describeCurve(const FoundCurve& found, const WindowFit& fit,
                              const SimulationData& data) {
  const CurveModel& model = fit.model;
  SimulationCause cause;
  std::size_t index = 0;
  while (model.curves[index].place() != found.place.place ||
         model.curves[index].covariate() != found.place.covariate)
    ++index;
  const Curve& curve = model.curves[index];
  const Eigen::VectorXd parameters = model.parametersOf(index);
  const int first = model.firstOf(index), count = curve.parameters();
  const Eigen::MatrixXd covariance = fit.covariance.block(first, first, count, count);
  const Scale signal = signalScale(found.place, model, data.scales);
  const double unit = valueUnit(found.place.place, data.scales);
  const std::string shape = isScalar(found.place.place) ? nameOf(found.place.place) : found.shape;
  const bool is_nearly = shape == "curve" && found.nearest_share > kNearly;
  const std::string called = is_nearly ? found.nearest : knownShape(shape, parameters, covariance);
  cause.what = {causeNamed(found.place.place, called), nameOf(found.place.place), shape,
                found.place.covariate};
  cause.description = inWords(found.place, shape);
  cause.advice = adviceFor(found.place.place);
  if (isScalar(found.place.place)) {
    cause.values = valuesWithoutCurve(found.place.place, parameters, covariance, signal.unit,
                                      data.sample_time);
  } else {
    cause.curve = pictureOf(curve, parameters, covariance, found.place, signal, unit,
                            drawnRange(curve, model, data));
    if (curve.shape()) cause.values = valuesOf(curve, parameters, covariance, signal, unit);
    dropUnreachedLimit(&cause);
  }
  if (shape == "curve" && found.nearest_share > 0.8)  // else the curve is all that is known
    cause.description += "; " + shapeInWords(found.nearest) + " has " +
                         std::to_string(static_cast<int>(100 * found.nearest_share)) +
                         " % of its gain";
  for (const TiedCurve& tie : found.ties) {
    const std::string shape = isScalar(tie.place.place) ? nameOf(tie.place.place) : tie.shape;
    cause.ties.push_back(
        {causeNamed(tie.place.place, shape), nameOf(tie.place.place), shape, tie.place.covariate});
  }
  return cause;
}

}  // namespace uncertainty_identification
