#include "curves/curve_words.h"

#include <algorithm>
#include <map>
#include <set>

namespace uncertainty_identification {
namespace {

bool isOneOf(const std::string& word, std::initializer_list<const char*> list) {
  return std::any_of(list.begin(), list.end(), [&](const char* each) { return word == each; });
}

std::string actuatorNamed(const std::string& shape) {
  if (isOneOf(shape, {"dead_zone", "asymmetric_dead_zone", "dead_zone_saturation"}))
    return "act_deadzone";
  if (isOneOf(shape, {"saturation", "asymmetric_saturation", "tanh"})) return "act_saturation";
  if (isOneOf(shape, {"asymmetric_slope", "hinge"})) return "act_asymmetry";
  return shape == "curve" ? "act_curve" : "act_hammerstein";
}

std::string plantNamed(const std::string& shape) {
  if (isOneOf(shape, {"coulomb", "stribeck", "asymmetric_coulomb"})) return "plant_coulomb";
  if (shape == "signed_square") return "plant_drag";
  if (isOneOf(shape, {"cubic", "polynomial"})) return "plant_cubic";
  if (isOneOf(shape, {"root", "sine"})) return "plant_" + shape;
  return "plant_curve";
}

}  // namespace

std::string shapeInWords(const std::string& shape) {
  static const std::map<std::string, std::string> kWords{
      {"dead_zone", "a dead zone"},
      {"saturation", "a limit"},
      {"dead_zone_saturation", "a dead zone and a limit"},
      {"asymmetric_dead_zone", "a dead zone of unequal sides"},
      {"asymmetric_saturation", "a lower and an upper limit"},
      {"linear", "a straight line"},
      {"square", "a square"},
      {"cubic", "a cubic curve"},
      {"signed_square", "a square with the sign of its argument"},
      {"power", "a power"},
      {"polynomial", "a polynomial"},
      {"root", "a square root"},
      {"exponential", "an exponential"},
      {"sine", "a sine"},
      {"tanh", "a curve that levels off"},
      {"asymmetric_slope", "another slope on one side of zero"},
      {"magnitude", "an absolute value"},
      {"hinge", "another slope beyond a point"},
      {"step", "a step"},
      {"coulomb", "Coulomb friction"},
      {"stribeck", "Coulomb friction with a higher breakaway force"},
      {"asymmetric_coulomb", "Coulomb friction of unequal sides"},
      {"curve", "a curve of no simple shape"}};
  return kWords.at(shape);
}

std::string inWords(const PlaceOf& at, const std::string& shape) {
  const std::string what = isScalar(at.place) ? "" : shapeInWords(shape);
  switch (at.place) {
    case Place::input:
      return "the input acts through " + what;
    case Place::position:
    case Place::output_state:
      return "the output acts back on the plant through " + what;
    case Place::loop_error:
      return "the plant is a control loop, whose error (the input less the one that would hold the "
             "output) acts through " +
             what;
    case Place::rate:
      return "the speed of the output acts back on the plant through " + what;
    case Place::position_gain:
      return "how strongly the input acts depends on the output, by " + what;
    case Place::rate_gain:
      return "how strongly the input acts depends on the speed of the output, by " + what;
    case Place::input_times_position:
      return "how strongly the output acts back depends on the input, by " + what;
    case Place::hysteresis:
      return "the output follows the input in a loop that does not depend on speed (hysteresis): "
             "each unit of motion pushes it back, by " +
             what;
    case Place::sensor:
      return "the sensor reads through " + what;
    case Place::time_gain:
      return "how strongly the input acts changes during an experiment, by " + what;
    case Place::time:
      return "something acts on the plant that changes during an experiment, by " + what;
    case Place::covariate:
      return at.covariate + " acts on the plant, by " + what;
    case Place::covariate_gain:
      return "how strongly the input acts depends on " + at.covariate + ", by " + what;
    case Place::play:
      return "play (backlash) between the input and the plant";
    case Place::input_hysteresis:
      return "the input acts through a hysteresis: right after it turns back, it acts by another "
             "gain than over long ways";
    case Place::rate_limit:
      return "the input can only change at a limited rate";
    case Place::output_play:
      return "play (slack) between the plant and the sensor";
  }
  return "";
}

std::string adviceFor(Place place) {
  switch (place) {
    case Place::input:
      return "drive the actuator slowly through its range, and draw the output at rest over the "
             "input";
    case Place::position:
    case Place::output_state:
    case Place::sensor:
      return "record at several operating points: a force in the plant changes its dynamics there, "
             "a sensor's curve only its gain";
    case Place::rate:
      return "record slow reversals of motion, where friction shows most";
    case Place::play:
    case Place::output_play:
      return "record reversals of different sizes: play loses the same width at each";
    case Place::rate_limit:
      return "record steps of different sizes: a limited rate makes large ones slower";
    case Place::loop_error:
      return "record steps of different sizes: a limit within the loop makes large ones slower";
    case Place::hysteresis:
    case Place::input_hysteresis:
      return "record slow and fast cycles of the same size: the loop of a hysteresis stays the "
             "same";
    case Place::time:
    case Place::time_gain:
      return "repeat the same input at the beginning and at the end of an experiment";
    default:
      return "vary both signals independently of each other";
  }
}

std::string causeNamed(Place place, const std::string& shape) {
  switch (place) {
    case Place::input:
    case Place::loop_error:
      return actuatorNamed(shape);
    case Place::position:
    case Place::output_state:
    case Place::rate:
      return plantNamed(shape);
    case Place::position_gain:
    case Place::rate_gain:
      return "plant_product";
    case Place::input_times_position:  // |u| x is Dahl's hysteresis
      return shape == "magnitude" ? "plant_hysteresis" : "plant_product";
    case Place::hysteresis:
      return "plant_hysteresis";
    case Place::sensor:
      return shape == "saturation" ? "sens_clip" : shape == "curve" ? "sens_curve" : "sens_wiener";
    case Place::play:
      return "act_backlash";
    case Place::input_hysteresis:
      return "act_hysteresis";
    case Place::rate_limit:
      return "act_ratelimit";
    case Place::output_play:
      return "sens_backlash";
    case Place::time_gain:
      return shape == "step" ? "act_loss" : "plant_drift";
    case Place::time:
      return "sens_drift";
    case Place::covariate:
      return "exp_input2";
    case Place::covariate_gain:
      return "plant_temp";
  }
  return "";
}

std::vector<std::string> curveCauseNames() {
  std::set<std::string> names{"act_delay"};
  for (int index = 0; index <= static_cast<int>(Place::input_hysteresis); ++index) {
    const auto place = static_cast<Place>(index);
    names.insert(causeNamed(place, "curve"));
    for (const Shape* shape : shapesAt(place)) names.insert(causeNamed(place, shape->name));
  }
  return {names.begin(), names.end()};
}

bool isCurveCause(const std::string& name) {
  static const std::vector<std::string> kNames = curveCauseNames();
  return std::binary_search(kNames.begin(), kNames.end(), name);
}

std::string causeBetween(const std::vector<std::string>& names) {
  static const char* const kSmooth = "cubic";
  const auto has = [&](Place place) {
    return std::find(names.begin(), names.end(), causeNamed(place, kSmooth)) != names.end();
  };
  return has(Place::input) && has(Place::sensor) ? causeNamed(Place::position, "curve") : "";
}

}  // namespace uncertainty_identification
