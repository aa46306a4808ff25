#include "uncertainty_identification/io/samples_json.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace uncertainty_identification {
namespace {

std::vector<double> toList(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

}  // namespace

nlohmann::json toJson(const PlantSamples& plants, const Eigen::VectorXd& omega) {
  const TransferFunctions models = transferFunctions(plants);
  const Eigen::MatrixXcd responses = delayedResponses(plants, omega);
  nlohmann::json list = nlohmann::json::array();
  for (Eigen::Index i = 0; i < plants.count(); ++i)
    list.push_back({{"num", toList(models.num.row(i))},
                    {"den", toList(models.den.row(i))},
                    {"eta", toList(plants.eta.row(i))},
                    {"real", toList(responses.row(i).real())},
                    {"imaginary", toList(responses.row(i).imag())}});
  return {{"format", "uncertainty_identification/samples/1"},
          {"sample_time", plants.sample_time},
          {"delay", plants.delay},
          {"omega", toList(omega)},
          {"plants", list}};
}

}  // namespace uncertainty_identification
