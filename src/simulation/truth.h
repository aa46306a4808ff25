#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulation/effects_truth.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/math/mixture.h"

/// A system whose every parameter is known, to simulate experiments from. Signals pass a chain in
/// physical order: input, actuator, plant (with its relative error), sensor; the noise is added at
/// the plant's output.
namespace uncertainty_identification {

enum class InputKind { white_noise, prbs, steps, multisine };
enum class PlantStructure { polynomials, first_order };

const EnumNames<InputKind>& enumNames(InputKind);
const EnumNames<PlantStructure>& enumNames(PlantStructure);

/// What excites the system, drawn anew for every experiment.
struct InputTruth {
  InputKind kind = InputKind::white_noise;
  double mean = 0;
  double variance = 1;  ///< white_noise: Gaussian; prbs: mean +- its root; steps: uniform levels;
                        ///< multisine: its tones share it
  int hold = 1;         ///< [samples] each value is held (not multisine), at least 1
  int tones = 10;  ///< multisine: harmonics 1..tones of the record with random phases, below half
                   ///< its samples
  double amplitude_spread = 0;  ///< each experiment's input is multiplied by its own factor,
                                ///< uniform within 1 +- this; at least 0, below 1

  void validate() const;
};

/// G_o = q^-delay B/A, one for all experiments, or a first-order system under zero-order hold with
/// a time constant per experiment, equation (39): gain (1 - p)/(1 - p q^-1) q^-delay, p =
/// exp(-sample_time/tau).
struct PlantTruth {
  PlantStructure structure = PlantStructure::polynomials;
  Eigen::VectorXd b =
      Eigen::VectorXd::Ones(1);  ///< b1..b_nb: B = b1 + b2 q^-1 + ... behind the delay
  Eigen::VectorXd a;             ///< without the leading 1
  int delay = 1;                 ///< [samples]
  double gain = 1;               ///< first_order
  double time_constant = 1;      ///< first_order: tau_o [s]
  double time_constant_spread =
      0;  ///< first_order: tau = tau_o (1 + delta), delta uniform within +- this, below 1

  void validate() const;
};

/// The relative error GDelta = sum_k eta_k F_k, eta = T xi, xi drawn per experiment from a mixture:
/// equations (4), (12).
struct ErrorModelTruth {
  ErrorModelOptions
      basis;        ///< basis, taps (a number), constraint, T and poles; the rest is not used
  Mixture mixture;  ///< of xi; no components = no error

  void validate() const;
};

/// What the sensor does to the output.
struct SensorTruth {
  double missing = 0;  ///< probability that an output sample is not measured, in [0, 1)

  void validate() const;
};

/// v = C/D omega, omega ~ N(0, variance).
struct NoiseTruth {
  double variance = 0;   ///< sigma^2 [unit of y, squared]
  Eigen::VectorXd c, d;  ///< without the leading 1
  NoiseStart start =
      NoiseStart::zero;  ///< at rest at the first sample (the paper), or running since long before

  void validate() const;
};

/// Covariates that are recorded. They do nothing unless plant_temp or exp_input2 use them, which
/// record them too.
struct CovariatesTruth {
  bool temp = false;  ///< a temperature: 20 + N(0, 5^2) per experiment, wandering by N(0, 3^2) with
                      ///< a time constant of 100 samples
  bool d = false;     ///< a second input: N(0, 1), with a time constant of 3 samples
};

/// Everything that determines simulated experiments, given a seed. The plant starts at rest.
struct Truth {
  double sample_time = 1;            ///< [s]
  int experiments = 100;             ///< M
  std::vector<int> samples = {100};  ///< N, one for all or one per experiment
  InputTruth input;
  PlantTruth plant;
  ErrorModelTruth error_model;
  SensorTruth sensor;
  NoiseTruth noise;
  CovariatesTruth covariates;
  EffectsTruth effects;

  /// N of experiment r.
  int samplesOf(int r) const;

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

}  // namespace uncertainty_identification
