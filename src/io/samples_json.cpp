#include "uncertainty_identification/io/samples_json.h"

#include <complex>
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
  const ComplexResponses responses = frequencyResponses(plants, omega);
  nlohmann::json list = nlohmann::json::array();
  for (Eigen::Index i = 0; i < plants.count(); ++i) {
    std::vector<double> real, imaginary;
    for (Eigen::Index k = 0; k < omega.size(); ++k) {
      const std::complex<double> delayed =
          std::complex<double>(responses.real(i, k), responses.imaginary(i, k)) *
          std::polar(1.0, -omega[k] * plants.sample_time * plants.delay);
      real.push_back(delayed.real());
      imaginary.push_back(delayed.imag());
    }
    list.push_back({{"num", toList(models.num.row(i))},
                    {"den", toList(models.den.row(i))},
                    {"eta", toList(plants.eta.row(i))},
                    {"real", real},
                    {"imaginary", imaginary}});
  }
  return {{"format", "uncertainty_identification/samples/1"},
          {"sample_time", plants.sample_time},
          {"delay", plants.delay},
          {"omega", toList(omega)},
          {"plants", list}};
}

}  // namespace uncertainty_identification
