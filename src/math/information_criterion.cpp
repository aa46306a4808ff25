#include "math/information_criterion.h"

#include <cmath>

namespace uncertainty_identification {

double bicPenalty(double parameters, double observations) {
  return 0.5 * parameters * std::log(observations);
}

double bic(double log_likelihood, int model_parameters, int mixture_parameters, double samples,
           int experiments) {
  return -2 * log_likelihood + 2 * bicPenalty(model_parameters, samples) +
         2 * bicPenalty(mixture_parameters, experiments);
}

}  // namespace uncertainty_identification
