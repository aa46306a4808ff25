#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/bounds/bounds.h"

namespace uncertainty_identification::study {

/// How the widest 95 % bands that the bounds offer fare with new plants.
struct BandScore {
  double pointwise = 0;     ///< share of |G| inside the pointwise band, mean over the frequencies
  double simultaneous = 0;  ///< share of plants with |G| inside the simultaneous band everywhere
  double phase = 0;         ///< as pointwise, for the phase
  /// Width of the pointwise band of |G| over that of the true 95 % band, median over the
  /// frequencies at which |G| varies by more than 1 %; NaN if there are none.
  double width = 0;
};

/// `fresh`: responses of new plants, plants x frequencies, at the frequencies of the bounds.
BandScore score(const FrequencyBounds& bounds, const std::vector<double>& levels,
                const Eigen::MatrixXcd& fresh);

/// The median of the values that are not NaN; NaN if there are none.
double median(std::vector<double> values);

}  // namespace uncertainty_identification::study
