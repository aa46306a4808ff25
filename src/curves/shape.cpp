#include "curves/shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace uncertainty_identification {
namespace {

double positive(double z) { return std::max(z, 0.0); }
double sign(double z) { return z > 0 ? 1 : z < 0 ? -1 : 0; }
double step(double z, double width) { return std::tanh(z / std::max(std::abs(width), 0.01)); }
double limited(double z, double limit) {
  const double bound = std::max(std::abs(limit), 0.05);
  return std::min(std::max(z, -bound), bound);
}
double deadZone(double z, double width) {
  return sign(z) * positive(std::abs(z) - std::abs(width));
}
double stribeck(double z, const double* p) {
  const double ratio = z / (std::abs(p[2]) + 0.02);
  return step(z, p[0]) * (1 + p[1] * std::exp(-ratio * ratio));
}

ShapeParameter at(const char* name) { return {name, ShapeUnit::of_signal, false}; }
ShapeParameter width(const char* name) { return {name, ShapeUnit::of_signal, true}; }

/// Lower and upper limits to begin with: inputs may lie on one side of zero.
std::vector<std::vector<double>> limitPairs() {
  std::vector<std::vector<double>> pairs;
  for (const double lower : {-1.0, -2.0, -1.5, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0})
    for (double upper = 3; upper > lower; upper -= 0.5) pairs.push_back({lower, upper});
  return pairs;
}

std::vector<Shape> wholeShapes() {
  return {{"dead_zone",
           [](double z, const double* p) { return deadZone(z, p[0]); },
           {width("half_width")},
           {{0.1}, {0.25}, {0.5}, {1.0}},
           true,
           true},
          {"saturation",
           [](double z, const double* p) { return limited(z, p[0]); },
           {width("limit")},
           {{0.5}, {1.0}, {1.5}},
           true,
           false},
          {"dead_zone_saturation",
           [](double z, const double* p) { return limited(deadZone(z, p[0]), p[1]); },
           {width("half_width"), width("limit")},
           {{0.15, 0.5}, {0.15, 0.9}, {0.15, 1.3}, {0.4, 0.5}, {0.4, 0.9}, {0.4, 1.3}},
           true,
           true},
          {"asymmetric_dead_zone",
           [](double z, const double* p) {
             return positive(z - std::abs(p[0])) - positive(-z - std::abs(p[1]));
           },
           {width("width_above"), width("width_below")},
           {{0.1, 0.5}, {0.5, 0.1}},
           true,
           true},
          {"asymmetric_saturation",
           [](double z, const double* p) {
             return std::min(std::max(z, p[0]), std::max(p[1], p[0] + 0.05));
           },
           {at("lower_limit"), at("upper_limit")},
           limitPairs(),
           true,
           false}};
}

Shape opposing(Shape shape) {
  shape.opposes = true;
  return shape;
}

std::vector<Shape> smoothShapes() {
  return {
      {"linear", [](double z, const double*) { return z; }, {}, {{}}},
      {"square", [](double z, const double*) { return z * z; }, {}, {{}}},
      {"cubic", [](double z, const double*) { return z * z * z; }, {}, {{}}, false, true},
      {"signed_square",
       [](double z, const double*) { return z * std::abs(z); },
       {},
       {{}},
       false,
       true,
       true},
      {"power",
       [](double z, const double* p) {
         return sign(z) * std::pow(std::abs(z), std::min(std::max(p[0], 0.2), 6.0));
       },
       {{"exponent", ShapeUnit::none}},
       {{0.5}, {1.5}, {3.0}},
       false,
       true},
      {"polynomial",
       [](double z, const double* p) { return z * z + p[0] * z * z * z; },
       {{"cubic_over_square", ShapeUnit::per_signal}},
       {{0.3}, {-0.3}, {3.0}, {-3.0}}},
      opposing({"root",
                [](double z, const double* p) { return std::sqrt(positive(z - p[0])); },
                {at("empty_at")},
                {{-1.2}, {-2.0}, {-3.0}}}),
      {"exponential",
       [](double z, const double* p) { return std::exp(std::min(std::max(p[0] * z, -8.0), 8.0)); },
       {{"rate", ShapeUnit::per_signal}},
       {{0.3}, {-0.3}, {1.0}, {-1.0}}},
      opposing({"sine",
                [](double z, const double* p) { return std::sin(p[0] * z); },
                {{"angle_per_unit", ShapeUnit::per_signal}},
                {{0.5}, {1.0}, {1.8}}}),
      {"tanh",
       [](double z, const double* p) { return std::tanh(p[0] * z); },
       {{"steepness", ShapeUnit::per_signal}},
       {{0.7}, {1.5}},
       false,
       false,
       false,
       true}};
}

std::vector<Shape> brokenShapes() {
  return {{"asymmetric_slope",
           [](double z, const double*) { return positive(z); },
           {},
           {{}},
           false,
           true},
          {"magnitude", [](double z, const double*) { return std::abs(z); }, {}, {{}}, false, true},
          {"hinge",
           [](double z, const double* p) { return positive(z - p[0]); },
           {at("begins_at")},
           {{-1.2}, {-0.6}, {0.6}, {1.2}, {1.8}}},
          {"step",
           [](double z, const double* p) { return step(z - p[0], 0.02); },
           {at("at")},
           {{0.3}, {0.5}, {0.7}}},
          {"coulomb",
           [](double z, const double* p) { return step(z, p[0]); },
           {width("width")},
           {{0.03}, {0.1}, {0.3}},
           false,
           true,
           true},
          {"stribeck",
           stribeck,
           {width("width"), {"breakaway_excess", ShapeUnit::none}, width("stribeck_width")},
           {{0.05, 0.6, 0.3}, {0.05, 2.0, 0.3}},
           false,
           true,
           true},
          {"asymmetric_coulomb",
           [](double z, const double* p) { return step(z, p[0]) * (1 + p[1] * sign(z)); },
           {width("width"), {"asymmetry", ShapeUnit::none}},
           {{0.05, 0.3}, {0.05, -0.3}},
           false,
           true,
           true}};
}

/// Names of the shapes at a place, the simplest first.
const std::map<Place, std::vector<std::string>>& namesAtPlaces() {
  static const std::map<Place, std::vector<std::string>> kNames{
      {Place::input,
       {"dead_zone", "saturation", "dead_zone_saturation", "asymmetric_dead_zone",
        "asymmetric_saturation", "asymmetric_slope", "hinge", "square", "cubic", "signed_square",
        "polynomial", "exponential", "power", "tanh", "root"}},
      {Place::position,
       {"cubic", "square", "signed_square", "polynomial", "root", "exponential", "sine", "coulomb",
        "stribeck", "asymmetric_coulomb", "hinge", "asymmetric_slope", "dead_zone", "power"}},
      {Place::output_state,
       {"cubic", "square", "signed_square", "polynomial", "root", "exponential", "sine", "hinge",
        "power", "coulomb"}},
      {Place::rate,
       {"coulomb", "stribeck", "asymmetric_coulomb", "signed_square", "cubic", "square",
        "asymmetric_slope"}},
      {Place::loop_error, {"saturation", "asymmetric_saturation"}},
      {Place::position_gain, {"linear", "square", "tanh", "magnitude", "exponential", "hinge"}},
      {Place::input_times_position, {"linear", "square", "tanh", "magnitude", "exponential"}},
      {Place::hysteresis, {"linear", "signed_square", "cubic"}},
      {Place::rate_gain, {"coulomb", "linear", "magnitude"}},
      {Place::sensor,
       {"saturation", "hinge", "square", "cubic", "exponential", "polynomial", "magnitude", "root",
        "dead_zone", "signed_square", "tanh"}},
      {Place::time_gain, {"linear", "square", "step", "exponential"}},
      {Place::time, {"linear", "square", "step"}},
      {Place::covariate, {"linear", "square", "magnitude"}},
      {Place::covariate_gain, {"linear", "square"}}};
  return kNames;
}

const Shape& shapeOf(const std::string& name) {
  for (const Shape& shape : shapes())
    if (shape.name == name) return shape;
  throw std::logic_error("no shape is called " + name);
}

}  // namespace

double degreeOf(const Shape& shape, const double* parameters) {
  static const std::map<std::string, double> kDegrees{
      {"linear", 1},           {"square", 2},     {"cubic", 3},
      {"signed_square", 2},    {"polynomial", 2}, {"root", 0.5},
      {"asymmetric_slope", 1}, {"magnitude", 1},  {"hinge", 1}};
  if (shape.name == "power") return std::min(std::max(parameters[0], 0.2), 6.0);
  const auto degree = kDegrees.find(shape.name);
  return degree == kDegrees.end() ? 0 : degree->second;
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = [] {
    std::vector<Shape> found = wholeShapes();
    for (auto more : {smoothShapes(), brokenShapes()})
      found.insert(found.end(), more.begin(), more.end());
    return found;
  }();
  return all;
}

bool sticks(const std::string& shape) {
  static const std::set<std::string> kSticking{
      "dead_zone", "dead_zone_saturation", "asymmetric_dead_zone", "coulomb",
      "stribeck",  "asymmetric_coulomb"};
  return kSticking.count(shape) > 0;
}

std::vector<const Shape*> shapesAt(Place place) {
  std::vector<const Shape*> found;
  const auto names = namesAtPlaces().find(place);
  if (names == namesAtPlaces().end()) return found;
  for (const std::string& name : names->second) found.push_back(&shapeOf(name));
  return found;
}

}  // namespace uncertainty_identification
