#pragma once

#include <nlohmann/json_fwd.hpp>

#include "uncertainty_identification/bounds/plant_distribution.h"

namespace uncertainty_identification {

/// Plants as samples.json holds them ("format": "uncertainty_identification/samples/1"):
/// "sample_time" [s], "delay" [samples], "omega" [rad/s] and the array "plants", each {"num",
/// "den"} (powers of q^-1, G = q^-delay num/den), "eta", and "real" and "imaginary" of the response
/// at omega, the delay included: an array of models as ucover and its like take.
nlohmann::json toJson(const PlantSamples& plants, const Eigen::VectorXd& omega);

}  // namespace uncertainty_identification
