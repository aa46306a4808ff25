#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "detection/fault_detector.h"
#include "simulation/truth.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Simulates experiments with faults and runs a detector on them.
namespace uncertainty_identification::test {

enum class FaultKind { none, effectiveness, bias, delay };

/// A fault that begins at a sample and persists.
struct Fault {
  FaultKind kind = FaultKind::none;
  double size = 0;  ///< effectiveness: share of the input lost; bias: added to the output [unit of
                    ///< y]; delay: [samples] by which the input arrives later
  int onset = 0;    ///< [sample] the first with the fault
};

/// The truth as an estimate without errors.
Estimate estimateOf(const Truth& truth);

/// Simulates experiments of a truth one by one, with any fault: input, system and noise are those
/// of simulateExperiment().
class FaultyPlant {
 public:
  FaultyPlant(const Truth& truth, std::uint64_t seed) : truth_(truth), seed_(seed) {}

  /// Experiment r with the fault.
  Experiment experiment(int r, const Fault& fault) const;

 private:
  Truth truth_;
  std::uint64_t seed_;
};

/// All decisions on an experiment, the detector being reset before.
std::vector<FaultWindow> decisions(FaultDetector* detector, const Experiment& experiment);

}  // namespace uncertainty_identification::test
