'use strict';
// The nominal model's own responses, for results without bounds, and the weight's.

/// Value of sum c_k z^-k at z = e^(j angle), as [real, imaginary].
function onUnitCircle(coefficients, angle) {
  return coefficients.reduce(([re, im], c, k) => [re + c * Math.cos(k * angle), im - c * Math.sin(k * angle)], [0, 0]);
}

function magnitudeOf(numerator, denominator, angle) {
  return Math.hypot(...onUnitCircle(numerator, angle)) / Math.hypot(...onUnitCircle(denominator, angle));
}

function plantPolynomials(model) {
  return {numerator: [...Array(model.delay).fill(0), ...model.b], denominator: [1, ...model.a]};
}

/// The frequency response in the form of the bounds, without bands: omega [rad/s], magnitude, unwrapped phase [rad].
function nominalFrequencyResponse(model) {
  const {numerator, denominator} = plantPolynomials(model);
  const nyquist = Math.PI / model.sample_time;
  const response = {omega: [], magnitude: [], phase: []};
  let last = 0;
  for (let k = 0; k <= 300; ++k) {
    const omega = nyquist * 10 ** (3 * (k / 300 - 1));
    const angle = omega * model.sample_time;
    const [nr, ni] = onUnitCircle(numerator, angle), [dr, di] = onUnitCircle(denominator, angle);
    let phase = Math.atan2(ni, nr) - Math.atan2(di, dr);
    phase -= 2 * Math.PI * Math.round((phase - last) / (2 * Math.PI));
    last = phase;
    response.omega.push(omega);
    response.magnitude.push(Math.hypot(nr, ni) / Math.hypot(dr, di));
    response.phase.push(phase);
  }
  return response;
}

/// The step response in the form of the bounds, without bands: until the plant has settled, 20 to 500 samples.
function nominalStepResponse(model) {
  const {numerator, denominator} = plantPolynomials(model);
  const y = [];
  for (let t = 0; t < 500; ++t) {
    let value = numerator.slice(0, t + 1).reduce((sum, b) => sum + b, 0);
    for (let k = 1; k < denominator.length && k <= t; ++k) value -= denominator[k] * y[t - k];
    y.push(value);
  }
  const final = y[y.length - 1], largest = Math.max(...y.map(value => Math.abs(value - final)), 1e-300);
  const settled = y.findLastIndex(value => Math.abs(value - final) > 0.01 * largest) + 1;
  const length = Math.min(500, Math.max(20, Math.ceil(1.3 * settled)));
  return {time: y.slice(0, length).map((value, t) => t * model.sample_time), nominal: y.slice(0, length)};
}

function staticGain(model) {
  const sum = values => values.reduce((total, value) => total + value, 0);
  return sum(model.b) / (1 + sum(model.a));
}
