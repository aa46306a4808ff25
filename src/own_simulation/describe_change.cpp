#include "own_simulation/describe_change.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string threeDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "9.1 +- 0.4": the error with one digit, or two where the first is a 1 or a 2.
std::string withError(double value, double error) {
  if (!(error > 0) || !std::isfinite(error)) return threeDigits(value);
  int exponent = static_cast<int>(std::floor(std::log10(error)));
  if (error / std::pow(10, exponent) < 3) --exponent;
  const double unit = std::pow(10, exponent);
  char text[80];
  std::snprintf(text, sizeof text, "%.*f +- %.*f", std::max(-exponent, 0),
                std::round(value / unit) * unit, std::max(-exponent, 0),
                std::round(error / unit) * unit);
  return text;
}

std::string inUnit(const std::string& number, const std::string& unit) {
  return unit.empty() || unit == "1" ? number : number + " " + unit;
}

/// "9.1 +- 0.4 % higher", or as a factor where it is large.
std::string ratioText(double factor, double error, const char* higher, const char* lower) {
  if (factor > 1.9 || factor < 0.55) return withError(factor, error) + " times as large";
  return withError(100 * std::abs(factor - 1), 100 * error) + " % " + (factor > 1 ? higher : lower);
}

/// One found change, where its coordinates stand in the fit.
struct Found {
  const Change& change;
  Eigen::VectorXd errors;  ///< standard errors of its coordinates
  std::vector<double> spreads;
  double quantile;  ///< of Student's t
  double sample_time;
};

OwnValue valueOf(const std::string& name, const std::string& unit, double yours, double measured,
                 double error, double quantile, double spread) {
  return {
      name,  unit, yours, measured, error, measured - quantile * error, measured + quantile * error,
      spread};
}

std::string spreadText(const std::string& amount) {
  return " (differing by " + amount + " from run to run)";
}

void describeParameter(const Found& found, const ChangedSimulation& simulation, OwnCause* cause) {
  const int index = found.change.parameter;
  const SimulationParameter& own = simulation.runs().parameters()[static_cast<std::size_t>(index)];
  const double x = found.change.at[0], error = found.errors[0], spread = found.spreads[0];
  const double value = simulation.valueAt(index, x), slope = simulation.slopeAt(index, x);
  cause->parameter = own.name;
  cause->values.push_back(valueOf(own.name, own.unit, own.value, value, std::abs(slope) * error,
                                  found.quantile, std::abs(slope) * spread));
  if (own.value == 0) {
    cause->description = own.name + " " +
                         inUnit(withError(value, std::abs(slope) * error), own.unit) +
                         " instead of 0";
  } else {
    // An interval of the logarithm is the better one for what is positive.
    OwnValue& told = cause->values.back();
    const double one = simulation.valueAt(index, x - found.quantile * error),
                 other = simulation.valueAt(index, x + found.quantile * error);
    told.lower_95 = std::min(one, other);
    told.upper_95 = std::max(one, other);
    const double factor = std::exp(x);
    cause->description = own.name + " " + ratioText(factor, factor * error, "higher", "lower");
    cause->remark = likelyUnit(factor);
  }
  if (spread > 0)
    cause->description +=
        spreadText(own.value == 0 ? inUnit(threeDigits(std::abs(slope) * spread), own.unit)
                                  : threeDigits(100 * spread) + " %");
  cause->advice = "set " + own.name + " to " + inUnit(threeDigits(value), own.unit) +
                  ", or find out why the machine differs from its data";
}

void describeGain(const Found& found, OwnCause* cause) {
  const double factor = 1 + found.change.at[0], error = found.errors[0];
  const double spread = found.spreads[0];
  cause->values.push_back(valueOf("output gain", "1", 1, factor, error, found.quantile, spread));
  cause->remark = likelyUnit(factor);
  cause->description = factor < 0 ? "its output multiplied by " + withError(factor, error)
                                  : "its output " + ratioText(factor, error, "larger", "smaller");
  if (spread > 0)
    cause->description += spreadText(threeDigits(100 * spread / std::abs(factor)) + " %");
  cause->advice =
      "look for what scales the output: a gain, a gear ratio, a unit, the sensor's calibration";
  if (factor < 0 && std::abs(factor + 1) < 0.3)
    cause->name = "sim_sign";
  else if (!cause->remark.empty())
    cause->name = "sim_unit";
}

void describeTimes(const Found& found, OwnCause* cause) {
  const double time = found.sample_time;
  const Eigen::VectorXd& at = found.change.at;
  if (found.change.kind == ChangeKind::lag) {
    const double lag = at[0] * time, error = found.errors[0] * time;
    cause->values.push_back(valueOf("further time constant", "s", 0, lag, error, found.quantile,
                                    found.spreads[0] * time));
    cause->description = "a further time constant of " + withError(lag, error) + " s";
    cause->advice = "add the dynamics that are missing: an actuator, a filter, a soft coupling";
    return;
  }
  const double yours = std::exp(at[0]) * time, measured = std::exp(at[1]) * time;
  cause->values.push_back(valueOf("time constant", "s", yours, measured, measured * found.errors[1],
                                  found.quantile, 0));
  cause->description = "a time constant of " + withError(measured, measured * found.errors[1]) +
                       " s where it seems to have " + threeDigits(yours) + " s";
  cause->advice = "check what sets this time constant: inertia, resistance, friction, a filter";
}

/// Name, values and words of a change; the name alone for one that is tied.
OwnCause describe(const Found& found, const ChangedSimulation& simulation) {
  OwnCause cause;
  const double time = found.sample_time;
  switch (found.change.kind) {
    case ChangeKind::parameter:
      cause.name = "sim_parameter";
      describeParameter(found, simulation, &cause);
      break;
    case ChangeKind::gain:
      cause.name = "sim_gain";
      describeGain(found, &cause);
      break;
    case ChangeKind::offset:
      cause.name = "sim_offset";
      cause.values.push_back(valueOf("output offset", "", 0, found.change.at[0], found.errors[0],
                                     found.quantile, found.spreads[0]));
      cause.description = withError(found.change.at[0], found.errors[0]) + " added to its output";
      if (found.spreads[0] > 0) cause.description += spreadText(threeDigits(found.spreads[0]));
      cause.advice = "check the zero of the sensor and the operating point";
      break;
    case ChangeKind::delay: {
      const double delay = found.change.at[0] * time, error = found.errors[0] * time;
      cause.name = "sim_delay";
      cause.values.push_back(valueOf("further dead time", "s", 0, delay, error, found.quantile,
                                     found.spreads[0] * time));
      cause.description = withError(std::abs(delay), error) +
                          (delay > 0 ? " s more dead time" : " s less dead time");
      if (found.spreads[0] > 0)
        cause.description += spreadText(threeDigits(found.spreads[0] * time) + " s");
      cause.advice = "check the communication, the time stamps and the dead time of the actuator";
      break;
    }
    case ChangeKind::lag:
    case ChangeKind::time_constant:
      cause.name = "sim_time_constant";
      describeTimes(found, &cause);
      break;
    case ChangeKind::initial_state:
      cause.name = "sim_initial_state";
      cause.values.push_back(valueOf("time of the transient", "s", 0, found.change.at[0] * time,
                                     kNan, found.quantile, 0));
      cause.description = "an initial state of its own in each run (a transient of about " +
                          threeDigits(found.change.at[0] * time) + " s)";
      cause.advice =
          "start the simulation from the measured initial state, or the machine from rest";
      break;
  }
  return cause;
}

std::string tieText(const Change& tie, const ChangedSimulation& simulation) {
  switch (tie.kind) {
    case ChangeKind::parameter:
      return "another " +
             simulation.runs().parameters()[static_cast<std::size_t>(tie.parameter)].name;
    case ChangeKind::gain:
      return "another output gain";
    case ChangeKind::offset:
      return "an output offset";
    case ChangeKind::delay:
      return "another dead time";
    case ChangeKind::lag:
      return "a further time constant";
    case ChangeKind::time_constant:
      return "another time constant";
    case ChangeKind::initial_state:
      break;
  }
  return "another initial state";
}

std::size_t unitsOf(const ComparedData& data) {
  std::size_t units = 0;
  for (const ComparedRun& run : data.runs) units += run.blocks.size() - 1;
  return units;
}

}  // namespace

std::string likelyUnit(double factor) {
  struct Known {
    double factor;
    const char* words;
  };
  static const Known kKnown[] = {{-1, "the opposite sign"},
                                 {kPi / 180, "looks like degrees for radians"},
                                 {180 / kPi, "looks like radians for degrees"},
                                 {2 * kPi / 60, "looks like revolutions per minute for rad/s"},
                                 {60 / (2 * kPi), "looks like rad/s for revolutions per minute"},
                                 {1 / (2 * kPi), "looks like rad for revolutions, or rad/s for Hz"},
                                 {2 * kPi, "looks like revolutions for rad, or Hz for rad/s"},
                                 {9.81, "looks like g for m/s^2, or kg for N"},
                                 {1 / 9.81, "looks like m/s^2 for g, or N for kg"},
                                 {2, "looks like a factor of 2, such as radius for diameter"},
                                 {0.5, "looks like a factor of 1/2, such as diameter for radius"},
                                 {1000, "looks like a unit for its thousandth, such as m for mm"},
                                 {0.001, "looks like a thousandth for its unit, such as mm for m"}};
  for (const Known& known : kKnown)
    if (std::abs(factor / known.factor - 1) < 0.03) return known.words;
  return "";
}

std::vector<OwnCause> describeChanges(const ChangeSearchResult& result,
                                      const std::vector<RunSpread>& spreads,
                                      const ChangedSimulation& simulation, const ComparedData& data,
                                      const ComparedData& held, double sample_time) {
  const auto freedom = static_cast<double>(std::max<std::size_t>(unitsOf(data), 2) - 1);
  const double quantile = boost::math::quantile(boost::math::students_t(freedom), 0.975);
  std::vector<OwnCause> causes;
  Eigen::Index first = 0;
  for (const FoundChange& each : result.found) {
    Found found{each.change, {}, {}, quantile, sample_time};
    const Eigen::Index count = each.change.estimated();
    found.errors = result.fit.covariance.diagonal().segment(first, count).cwiseMax(0).cwiseSqrt();
    for (Eigen::Index k = first; k < first + count; ++k) {
      const RunSpread& spread = spreads[static_cast<std::size_t>(k)];
      found.spreads.push_back(spread.significant ? spread.deviation : 0);
    }
    first += count;
    causes.push_back(describe(found, simulation));
    causes.back().t = count == 1 ? std::abs(each.change.at[0]) / found.errors[0] : kNan;
    causes.back().fit_without = held.fitOf(each.held_without);
    for (const Change& tie : each.ties) causes.back().ties.push_back(tieText(tie, simulation));
  }
  return causes;
}

}  // namespace uncertainty_identification
