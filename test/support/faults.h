#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "detection/fault_detector.h"
#include "simulation/truth.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Experiments with faults in them, and what a detector makes of them.
namespace uncertainty_identification::test {

enum class FaultKind { none, effectiveness, bias, delay };

/// A fault that begins at a sample and stays.
struct Fault {
  FaultKind kind = FaultKind::none;
  double size = 0;  ///< effectiveness: share of the input lost; bias: added to the output [unit of
                    ///< y]; delay: [samples] by which the input arrives later
  int onset = 0;    ///< [sample] the first with the fault
};

/// The model that the truth is, as an identification without errors would give it.
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
