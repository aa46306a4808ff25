#include "study/signals.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification::study {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kTurn = 6.283185307179586;

VectorXd binary(int hold, int samples, Draw& draw) {
  VectorXd u(samples);
  for (Index t = 0; t < samples; ++t)
    u[t] = t % hold == 0 ? (draw.chance(0.5) ? 1.0 : -1.0) : u[t - 1];
  return u;
}

VectorXd steps(int hold, int samples, Draw& draw) {
  VectorXd u(samples);
  int left = 0;
  double level = 0;
  for (Index t = 0; t < samples; ++t, --left) {
    if (left == 0) {
      left = std::max(1, static_cast<int>(hold * draw.uniform(0.5, 1.5)));
      level = draw.uniform(-1, 1);
    }
    u[t] = level;
  }
  return u;
}

VectorXd multisine(double top, int samples, Draw& draw) {
  const int lines = std::max(3, static_cast<int>(top * samples / 2));
  VectorXd u = VectorXd::Zero(samples);
  for (int line = 1; line <= lines; ++line) {
    const double phase = draw.uniform(0, kTurn);
    for (Index t = 0; t < samples; ++t)
      u[t] += std::cos(kTurn * line * static_cast<double>(t) / samples + phase);
  }
  return u * std::sqrt(2.0 / lines);
}

/// (1 + ma q^-1)/(1 - ar q^-1) applied to `white`, scaled to the variance of `white`.
VectorXd coloured(const VectorXd& white, double ar, double ma) {
  VectorXd filtered(white.size());
  double before = 0, white_before = 0;
  for (Index t = 0; t < white.size(); ++t) {
    before = ar * before + white[t] + ma * white_before;
    white_before = white[t];
    filtered[t] = before;
  }
  return filtered / std::sqrt(1 + (ar + ma) * (ar + ma) / (1 - ar * ar));
}

}  // namespace

InputDesign drawInput(double slowest, int samples, Draw& draw) {
  InputDesign design;
  design.kind = static_cast<InputKind>(draw.integer(0, 3));
  design.amplitude = draw.logUniform(0.1, 10);
  if (design.kind == InputKind::binary)
    design.hold = draw.integer(1, std::max(1, static_cast<int>(slowest / 2)));
  if (design.kind == InputKind::steps) {
    const int wanted = static_cast<int>(slowest * draw.uniform(1.5, 4));
    design.hold = std::max(2, std::min(wanted, samples / 4));
  }
  design.top = draw.uniform(0.3, 0.9);
  design.pole = draw.uniform(0, 0.9);
  return design;
}

VectorXd drawSignal(const InputDesign& design, int samples, Draw& draw) {
  switch (design.kind) {
    case InputKind::binary:
      return design.amplitude * binary(design.hold, samples, draw);
    case InputKind::steps:
      return design.amplitude * steps(design.hold, samples, draw);
    case InputKind::multisine:
      return design.amplitude * multisine(design.top, samples, draw);
    case InputKind::noise:
      break;
  }
  constexpr int kRunUp = 200;
  return design.amplitude * coloured(draw.normals(samples + kRunUp), design.pole, 0).tail(samples);
}

NoiseDesign drawNoise(NoiseKind kind, Draw& draw) {
  NoiseDesign design;
  design.kind = kind;
  design.ar = draw.uniform(0.5, 0.95);
  design.ma = draw.chance(0.5) ? draw.uniform(-0.4, 0.8) : 0.0;
  return design;
}

VectorXd drawNoiseSignal(const NoiseDesign& design, int samples, Draw& draw) {
  constexpr int kRunUp = 500;
  if (design.kind == NoiseKind::heavy_tailed)
    return VectorXd::NullaryExpr(samples, [&draw]() { return draw.heavyTailed(); });
  if (design.kind == NoiseKind::white) return draw.normals(samples);
  return coloured(draw.normals(samples + kRunUp), design.ar, design.ma).tail(samples);
}

}  // namespace uncertainty_identification::study
