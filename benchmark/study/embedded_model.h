#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "study/draw.h"
#include "study/plant.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::study {

/// A true model of the structure that the package identifies: Go and H as polynomials in q^-1, FIR
/// error model with GDelta(1) = 0 and a Gaussian mixture (docs/notation.md), simulated by
/// difference equations written for the studies.
struct EmbeddedModel {
  Eigen::VectorXd b, a, c, d;  ///< without the leading 1; Go = q^-1 (b1 + b2 q^-1 + ...)/A
  /// If there are time constants, Go is this plant instead, and b and a are not used.
  PlantParameters plant;
  int taps = 2;     ///< 0 = no error model
  Mixture mixture;  ///< of xi; eta = (xi, -sum xi)
  double noise_variance = 1;
  double input_pole = 0;  ///< of the input's first-order low-pass filter
  bool binary = false;    ///< the input is a binary signal instead
  int samples = 0;        ///< per experiment
  bool gaps = false;      ///< outputs are missing at the start of a third of the experiments
};

/// Orders and sizes of a model that is to be drawn.
struct EmbeddedModelSize {
  int order = 1;  ///< of A; B has 1 to `order` coefficients
  int nc = 0, nd = 0;
  int taps = 2, components = 1;
  int samples = 100;
};

/// Draws a model. Poles and zeros of Go, and of H, are at least 0.15 apart, and the mixture's
/// components three standard deviations: otherwise the orders would not be what they seem.
EmbeddedModel drawEmbeddedModel(const EmbeddedModelSize& size, Draw& draw);

/// The same with time constants and a dead time of 0.2 to 10 samples; the sample time is 1 s.
EmbeddedModel drawDeadTimeModel(const EmbeddedModelSize& size, Draw& draw);

/// Measures experiments that start at rest, in stationary noise.
std::vector<Experiment> measure(const EmbeddedModel& model, int experiments, Draw& draw);

/// theta in the package's order.
Eigen::VectorXd thetaOf(const EmbeddedModel& model);

/// Sets the structure, the orders, the error model and the number of components that are true.
void setOrders(const EmbeddedModel& model, Configuration* configuration);

/// Lets the optimisation start at the truth.
void startAtTruth(const EmbeddedModel& model, Configuration* configuration);

}  // namespace uncertainty_identification::study
