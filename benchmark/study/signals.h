#pragma once

#include <Eigen/Core>

#include "study/draw.h"

namespace uncertainty_identification::study {

enum class InputKind { binary, steps, multisine, noise };

/// An input signal of the kind that people use for identification.
struct InputDesign {
  InputKind kind = InputKind::binary;
  double amplitude = 1;  ///< standard deviation, except steps: largest level
  int hold = 1;          ///< [samples] clock of the binary signal, or mean length of a step
  double top = 1;        ///< multisine: highest frequency as a share of the Nyquist frequency
  double pole = 0;       ///< noise: pole of the first-order low-pass filter
};

/// A design for plants whose slowest time constant is `slowest` samples. The hold is short enough
/// for several steps in a record of so many samples.
InputDesign drawInput(double slowest, int samples, Draw& draw);

Eigen::VectorXd drawSignal(const InputDesign& design, int samples, Draw& draw);

enum class NoiseKind { white, coloured, heavy_tailed };

/// Measurement noise (1 + ma q^-1)/(1 - ar q^-1) applied to white noise.
struct NoiseDesign {
  NoiseKind kind = NoiseKind::white;
  double ar = 0, ma = 0;  ///< coloured only
};

NoiseDesign drawNoise(NoiseKind kind, Draw& draw);

/// Stationary noise of variance 1.
Eigen::VectorXd drawNoiseSignal(const NoiseDesign& design, int samples, Draw& draw);

}  // namespace uncertainty_identification::study
