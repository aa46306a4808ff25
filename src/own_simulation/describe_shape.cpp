#include "own_simulation/describe_shape.h"

#include <algorithm>
#include <cmath>

#include "curves/curve_words.h"

namespace uncertainty_identification {
namespace {

constexpr double kNormal90 = 1.6449;  // quantile of 95 %

/// What parameters of a shape are multiplied by in the units of the data.
Eigen::VectorXd unitsOf(const PlacedShape& placed, const Eigen::VectorXd& parameters) {
  const Shape& shape = *placed.shape;
  const int first = shape.is_whole ? 0 : 1;
  Eigen::VectorXd units = Eigen::VectorXd::Ones(parameters.size());
  if (first == 1) units[0] = std::pow(placed.unit, 1 - degreeOf(shape, parameters.data() + first));
  for (std::size_t k = 0; k < shape.parameters.size(); ++k)
    if (shape.parameters[k].unit == ShapeUnit::of_signal)
      units[first + static_cast<Eigen::Index>(k)] = placed.unit;
  return units;
}

CurvePicture pictureOf(const PlacedShape& placed, const Eigen::VectorXd& parameters,
                       const Eigen::MatrixXd& covariance, double low, double high) {
  constexpr int kPoints = 41;
  constexpr double kStep = 1e-4;
  const bool is_factor = placed.place == Place::time_gain;
  CurvePicture picture;
  picture.of = is_factor                      ? "share of the experiment"
               : placed.place == Place::input ? "input"
                                              : "output";
  picture.unit = is_factor ? "1" : picture.of;
  const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(kPoints, low, high);
  const Eigen::VectorXd value = shaped(placed, z, parameters);
  Eigen::MatrixXd slopes(kPoints, parameters.size());
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    Eigen::VectorXd above = parameters;
    above[k] += kStep;
    slopes.col(k) = (shaped(placed, z, above) - value) / kStep;
  }
  for (int k = 0; k < kPoints; ++k) {
    const double drawn = value[k] - (is_factor ? 1 : 0);
    const double deviation =
        std::sqrt(std::max(slopes.row(k).dot(covariance * slopes.row(k).transpose()), 0.0));
    picture.signal.push_back(z[k]);
    picture.value.push_back(drawn);
    picture.lower_90.push_back(drawn - kNormal90 * deviation);
    picture.upper_90.push_back(drawn + kNormal90 * deviation);
  }
  return picture;
}

}  // namespace

PlaceAndShape placeAndShapeOf(const PlacedShape& placed) {
  return {causeNamed(placed.place, placed.shape->name), nameOf(placed.place), placed.shape->name,
          ""};
}

SimulationCause describeShape(const PlacedShape& placed, const Eigen::VectorXd& parameters,
                              const Eigen::MatrixXd& covariance, double low, double high) {
  const Shape& shape = *placed.shape;
  SimulationCause cause;
  cause.what = placeAndShapeOf(placed);
  cause.description = inWords({placed.place, ""}, shape.name);
  if (shape.name == "asymmetric_slope")
    cause.description += placed.is_mirrored ? ", below it" : ", above it";
  cause.advice = adviceFor(placed.place);
  const Eigen::VectorXd units = unitsOf(placed, parameters),
                        errors = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const int own = shape.is_whole ? 0 : 1;
  if (own == 1)
    cause.values.push_back({"amplitude", units[0] * (parameters[0] - 1), units[0] * errors[0]});
  for (int k = own; k < parameters.size(); ++k)
    cause.values.push_back({shape.parameters[static_cast<std::size_t>(k - own)].name,
                            units[k] * std::abs(parameters[k]), units[k] * errors[k]});
  cause.curve = pictureOf(placed, parameters, covariance, low, high);
  return cause;
}

}  // namespace uncertainty_identification
