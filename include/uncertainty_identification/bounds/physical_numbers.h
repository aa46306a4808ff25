#pragma once

#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A number that says in physical terms what the nominal plant does.
struct PhysicalNumber {
  /// "gain", "velocity_gain", "dead_time", "time_constant", "natural_frequency", "damping",
  /// "alternating_pole", "bandwidth"; "time_constant_1", ... where there are several, the slowest
  /// first
  std::string name;
  std::string unit;  ///< empty if it has none or follows from the units of u and y
  double value = 0;
  std::optional<double> lower{}, upper{};  ///< 95 % interval of the estimate; absent if not known
  std::optional<double>
      spread{};  ///< standard deviation between experiments; absent if not modelled
};

/// The plant in physical terms.
struct PhysicalNumbers {
  std::string sentence;  ///< "First-order plant: gain 8.2, time constant 0.2 s, no dead time."
  std::vector<PhysicalNumber> numbers;
};

/// The physical numbers of Go, sampled with a zero-order hold: the static gain (of a plant that
/// integrates the gain from u to the rate of y), the dead time beyond the one sample of the hold,
/// the time constant of each real pole, the natural frequency and damping of each pair, and the
/// frequency where |Go| has fallen by 3 dB. A pole integrates if its time constant exceeds ten
/// times the longest experiment, which cannot tell the two apart. A real pole at z < 0 has no
/// counterpart in continuous time: its response alternates from sample to sample, and the number is
/// z. A bandwidth above the Nyquist frequency is left out.
///
/// `plants` gives the intervals and the spread by 1,000 draws with the estimate's seed; null: there
/// are none. A number that more than one draw in twenty lacks, because its poles are of another
/// kind, has no interval.
PhysicalNumbers physicalNumbers(const Estimate& estimate, const PlantDistribution* plants);

}  // namespace uncertainty_identification
