#include "study/plant.h"

#include <cmath>

namespace uncertainty_identification::study {
namespace {

using Complex = std::complex<double>;

std::vector<Complex> polesOf(const PlantParameters& parameters) {
  std::vector<Complex> poles;
  for (double tau : parameters.time_constants) poles.emplace_back(-1 / tau, 0.0);
  if (parameters.resonance > 0) {
    const double real = -parameters.damping * parameters.resonance;
    const double imaginary =
        parameters.resonance * std::sqrt(1 - parameters.damping * parameters.damping);
    poles.emplace_back(real, imaginary);
    poles.emplace_back(real, -imaginary);
  }
  return poles;
}

/// The residue of gain prod(-p_j)/prod(s - p_j) at pole i.
Complex residue(const std::vector<Complex>& poles, std::size_t i, double gain) {
  Complex value = -gain * poles[i];
  for (std::size_t j = 0; j < poles.size(); ++j) {
    if (j != i) value *= poles[j] / (poles[j] - poles[i]);
  }
  return value;
}

}  // namespace

SampledPlant::SampledPlant(const PlantParameters& parameters, double sample_time)
    : sample_time_(sample_time),
      delay_(static_cast<int>(std::floor(parameters.dead_time / sample_time))) {
  const double fraction = parameters.dead_time - delay_ * sample_time;
  const std::vector<Complex> poles = polesOf(parameters);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const Complex p = poles[i], scale = residue(poles, i, parameters.gain) / p;
    const Complex rest = std::exp(p * (sample_time - fraction));
    terms_.push_back({std::exp(p * sample_time), scale * (rest - 1.0),
                      scale * rest * (std::exp(p * fraction) - 1.0)});
  }
}

Eigen::VectorXd SampledPlant::simulate(const Eigen::VectorXd& u) const {
  const auto at = [&](Eigen::Index t) { return t < 0 ? 0.0 : u[t]; };
  Eigen::VectorXd y = Eigen::VectorXd::Zero(u.size());
  for (const Term& term : terms_) {
    Complex x = 0;
    for (Eigen::Index t = 0; t < u.size(); ++t) {
      y[t] += x.real();
      x = term.decay * x + term.early * at(t - delay_) + term.late * at(t - delay_ - 1);
    }
  }
  return y;
}

Eigen::VectorXcd SampledPlant::responses(const Eigen::VectorXd& omega) const {
  Eigen::VectorXcd all(omega.size());
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const Complex z = std::polar(1.0, omega[k] * sample_time_);
    Complex sum = 0;
    for (const Term& term : terms_) sum += (term.early + term.late / z) / (z - term.decay);
    all[k] = sum * std::polar(1.0, -omega[k] * sample_time_ * delay_);
  }
  return all;
}

}  // namespace uncertainty_identification::study
