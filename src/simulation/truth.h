#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulation/effects_truth.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/math/mixture.h"

/// A simulated system of which every parameter is known. Signals pass it in physical order: input,
/// actuator, plant with its relative error, sensor. The noise is added to the plant's output.
namespace uncertainty_identification {

enum class InputKind { white_noise, prbs, steps, multisine };
enum class PlantStructure { polynomials, first_order };

const EnumNames<InputKind>& enumNames(InputKind);
const EnumNames<PlantStructure>& enumNames(PlantStructure);

/// The input of the system, drawn anew for every experiment.
struct InputTruth {
  InputKind kind = InputKind::white_noise;
  double mean = 0;
  double variance = 1;  ///< white_noise is Gaussian with this variance, prbs switches between mean
                        ///< +- its root, steps has uniformly distributed levels, and the tones of a
                        ///< multisine have equal shares of it
  int hold = 1;         ///< [samples] for which each value is held; not used by multisine
  int tones = 10;       ///< multisine: harmonics 1..tones of the record, with random phases; less
                        ///< than half the number of samples
  double amplitude_spread = 0;  ///< the input of each experiment is multiplied by its own factor,
                                ///< drawn uniformly from 1 - this to 1 + this
  Fields fields() {
    return {{"kind", &kind},
            {"mean", &mean},
            {"variance", &variance, range::kNotNegative},
            {"hold", &hold, range::kOneToMillion},
            {"tones", &tones, range::kOneToMillion},
            {"amplitude_spread", &amplitude_spread, range::kBelowOne}};
  }
};

/// Go = q^-delay B/A, the same in all experiments, or a first-order system under zero-order hold
/// whose time constant tau differs between experiments, equation (39): gain (1 - p)/(1 - p q^-1)
/// q^-delay with p = exp(-sample_time/tau).
struct PlantTruth {
  PlantStructure structure = PlantStructure::polynomials;
  Eigen::VectorXd b = Eigen::VectorXd::Ones(1);  ///< b1..b_nb: B = b1 + b2 q^-1 + ...
  Eigen::VectorXd a;                             ///< without the leading 1
  int delay = 1;                                 ///< [samples]
  double gain = 1;                               ///< first_order
  double time_constant = 1;                      ///< first_order: tau_o [s]
  double time_constant_spread = 0;  ///< first_order: tau = tau_o (1 + delta), where delta is drawn
                                    ///< uniformly from -this ... this for each experiment
  Fields fields() {
    return {{"structure", &structure},
            {"b", &b},
            {"a", &a},
            {"delay", &delay, range::kDelay},
            {"gain", &gain},
            {"time_constant", &time_constant, range::kPositive},
            {"time_constant_spread", &time_constant_spread, range::kBelowOne}};
  }
};

/// The relative error GDelta = sum_k eta_k F_k with eta = T xi, where xi is drawn from a mixture
/// for each experiment: equations (4), (12).
struct ErrorModelTruth {
  ErrorModelOptions basis =
      paperErrorModel();  ///< basis, taps (a number), constraint, T and poles; the rest is ignored
  Mixture mixture;        ///< of xi; without components there is no error

  void validate() const;
};

/// What the sensor does to the output.
struct SensorTruth {
  double missing = 0;  ///< probability that an output sample is not measured
  Fields fields() { return {{"missing", &missing, range::kBelowOne}}; }
};

/// v = C/D omega with omega ~ N(0, variance).
struct NoiseTruth {
  double variance = 0;                  ///< sigma^2 [unit of y, squared]
  Eigen::VectorXd c, d;                 ///< without the leading 1
  NoiseStart start = NoiseStart::zero;  ///< `zero`: at rest at the first sample, as in the paper;
                                        ///< `stationary`: the noise has always been there
  Fields fields() {
    return {{"variance", &variance, range::kNotNegative}, {"c", &c}, {"d", &d}, {"start", &start}};
  }
};

/// The covariates that are recorded. plant_temp and exp_input2 use them, and record theirs in any
/// case; nothing else depends on them.
struct CovariatesTruth {
  bool temp = false;  ///< a temperature: 20 + N(0, 5^2) for each experiment, and within it
                      ///< first-order noise N(0, 3^2) with a time constant of 100 samples
  bool d = false;     ///< a second input: first-order noise N(0, 1), time constant 3 samples
  Fields fields() { return {{"temp", &temp}, {"d", &d}}; }
};

/// Everything that determines the simulated experiments, besides the seed. The plant starts at
/// rest.
struct Truth {
  double sample_time = 1;            ///< [s]
  int experiments = 100;             ///< M
  std::vector<int> samples = {100};  ///< N, one number for all experiments or one for each
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
