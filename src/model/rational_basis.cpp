#include "model/rational_basis.h"

#include <algorithm>

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

RationalBasis::RationalBasis(const ErrorBasis& basis)
    : denominator(basis.denominator()), taps(basis.taps()) {
  // A numerator is the denominator times the filter's impulse response, cut off at its degree.
  const Index length = std::max<Index>(denominator.size(), taps - 1) + 1;
  Signals impulse = Signals::Zero(kLanes, length);
  impulse(0, 0) = 1;
  std::vector<Signals> responses;
  basis.apply(impulse, &responses);
  for (const Signals& response : responses) {
    VectorXd numerator = response.row(0).matrix().transpose();
    for (Index t = length - 1; t >= 0; --t) {
      for (Index k = 0; k < std::min(denominator.size(), t); ++k)
        numerator[t] += denominator[k] * response(0, t - k - 1);
    }
    numerators.push_back(std::move(numerator));
  }
}

}  // namespace uncertainty_identification
