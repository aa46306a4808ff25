#include "model/continuous_poles.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"

namespace uncertainty_identification {

ContinuousPoles continuousPoles(const Eigen::VectorXd& a, double sample_time) {
  ContinuousPoles poles;
  for (const std::complex<double>& root : listOfRoots(a)) {
    const std::complex<double> bounded =
        std::abs(root) > 1e-6 ? root : std::complex<double>(1e-6, 0);
    const std::complex<double> s = std::log(bounded) / sample_time;
    if (std::abs(root.imag()) < 1e-9) {
      poles.time_constants.push_back(1 / std::max(-s.real(), 1e-6 / sample_time));
    } else if (root.imag() > 0) {
      poles.pairs.push_back(s);
    }
  }
  std::sort(poles.time_constants.rbegin(), poles.time_constants.rend());
  poles.longest = !poles.time_constants.empty() ? poles.time_constants[0]
                  : !poles.pairs.empty()        ? 1 / std::abs(poles.pairs[0])
                                                : sample_time;
  return poles;
}

}  // namespace uncertainty_identification
