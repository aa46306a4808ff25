#include "math/distributions.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

namespace uncertainty_identification {

namespace math = boost::math;

double chiSquaredTail(double x, double degrees) {
  return cdf(complement(math::chi_squared(degrees), x));
}

double chiSquaredQuantile(double probability, double degrees) {
  using math::policies::policy;
  using math::policies::promote_double;
  return quantile(math::chi_squared_distribution<double, policy<promote_double<false>>>(degrees),
                  probability);
}

double fisherTail(double x, double numerator_degrees, double denominator_degrees) {
  return cdf(complement(math::fisher_f(numerator_degrees, denominator_degrees), x));
}

double betaTail(double x, double alpha, double beta) {
  return cdf(complement(math::beta_distribution<>(alpha, beta), x));
}

double betaQuantile(double probability, double alpha, double beta) {
  return quantile(math::beta_distribution<>(alpha, beta), probability);
}

double normalTail(double z) { return cdf(complement(math::normal(), z)); }

double normalTailQuantile(double tail) {
  return math::constants::root_two<double>() * math::erfc_inv(2 * tail);
}

double fastNormalQuantile(double probability) {
  using math::policies::policy;
  using math::policies::promote_double;
  return -std::sqrt(2.0) * math::erfc_inv(2 * probability, policy<promote_double<false>>());
}

double studentQuantile(double probability, double degrees) {
  return quantile(math::students_t(degrees), probability);
}

double poissonTail(double k, double mean) { return cdf(complement(math::poisson(mean), k)); }

double binomialProbability(double k, double trials, double probability) {
  return cdf(math::binomial_distribution<>(trials, probability), k);
}

double binomialTail(double k, double trials, double probability) {
  return cdf(complement(math::binomial_distribution<>(trials, probability), k));
}

}  // namespace uncertainty_identification
