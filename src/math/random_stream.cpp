#include "math/random_stream.h"

#include <cmath>

namespace uncertainty_identification {

std::mt19937_64 randomStream(std::uint64_t seed, int r, RandomPurpose purpose) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                         static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(purpose)};
  return std::mt19937_64(sequence);
}

Eigen::VectorXd gaussian(int count, double variance, std::mt19937_64& random) {
  std::normal_distribution<double> standard;
  const double deviation = std::sqrt(variance);
  return Eigen::VectorXd::NullaryExpr(count, [&] { return deviation * standard(random); });
}

}  // namespace uncertainty_identification
