'use strict';
// Bode diagrams and the response to a step.

const kGainUnit = 'unit of y per unit of u';

function decibel(magnitude) {
  return 20 * Math.log10(magnitude);
}

function degrees(radian) {
  return radian * 180 / Math.PI;
}

function frequencyAxis(omega) {
  return logarithmicAxis('frequency [rad/s]', omega[0], omega[omega.length - 1]);
}

/// A multiple of 15 degrees that gives at most eight labels.
function phaseStep(values) {
  const range = Math.max(...values) - Math.min(...values);
  return [15, 30, 45, 90, 180, 360, 720].find(step => range / step <= 8) || 1440;
}

/// The smallest magnitude that is drawn. Bands may reach down to zero, which has no decibel.
function lowestMagnitude(frequency) {
  const positive = frequency.magnitude.filter(value => value > 0);
  const bands = frequency.magnitude_bands;
  const narrow = bands && hasBands(bands.mixture) ? bands.mixture.pointwise[0].lower.filter(value => value > 0) : [];
  return 10 ** Math.floor(Math.log10(Math.min(...positive, ...narrow)) - 1);
}

function interval(band, text) {
  return `${percent(band.level)}: ${text(band.lower)} to ${text(band.upper)}`;
}

function at(band, index) {
  return {level: band.level, lower: band.lower[index], upper: band.upper[index]};
}

function hiddenInWords(frequency) {
  if (!frequency.hidden_from) return '';
  return ` From ${number(frequency.hidden_from)} rad/s on, noise hides what the input causes: there the plant is not known.`;
}

function showBode(parent, frequency, sampleTime, choices) {
  const {omega, magnitude, phase} = frequency, floor = lowestMagnitude(frequency);
  const head = k => `${number(omega[k], 4)} rad/s (${number(omega[k] / (2 * Math.PI), 3)} Hz)`;
  const gain = value => `${number(decibel(Math.max(value, floor)), 3)} dB (${number(value, 3)})`;
  bandFigure(parent, {
    title: 'Magnitude', x: omega, nominal: magnitude, bands: frequency.magnitude_bands, height: 340,
    caption: `|G| in decibel: 0 dB is 1 ${kGainUnit}, 20 dB is 10. Hover for values.${hiddenInWords(frequency)}`,
    toAxis: value => decibel(Math.max(value, floor)),
    describe: (k, bands) => [head(k), `nominal: ${gain(magnitude[k])}`, ...bands.map(band => interval(at(band, k), gain))],
    axes: {x: frequencyAxis(omega), y: aligningAxis(linearAxis(`|G| [dB re 1 ${kGainUnit}]`, {grace: '2%'}))}}, choices);
  // At the Nyquist frequency all responses are real: the phase is 0 or 180 degrees and carries no information.
  const nyquist = Math.PI / sampleTime, last = omega.findIndex(value => value > 0.9999 * nyquist);
  const below = values => values.slice(0, last < 0 ? undefined : last);
  const angle = value => `${number(degrees(value), 4)}\u00b0`;
  bandFigure(parent, {
    title: 'Phase', x: below(omega), nominal: below(phase), bands: frequency.phase_bands, height: 290, toAxis: degrees,
    caption: 'Phase of G, including the delay. The phase of each plant is chosen within 180 degrees of the nominal one.',
    describe: (k, bands) => [head(k), `nominal: ${angle(phase[k])}`, ...bands.map(band => interval(at(band, k), angle))],
    axes: {x: frequencyAxis(omega), y: aligningAxis(linearAxis('phase [degree]', {ticks: {stepSize: phaseStep(phase.map(degrees))}}))}}, choices);
}

function showStep(parent, step, choices) {
  const {time, nominal, bands} = step, text = value => number(value, 4);
  bandFigure(parent, {
    title: 'Response to a unit step', x: time, nominal, bands, height: 400, toAxis: value => value,
    stepped: time.length <= 120 ? 'before' : false, caption: 'Output without noise when the input steps from 0 to 1 at time 0.',
    describe: (k, shown) => [`${number(time[k], 4)} s`, `nominal: ${text(nominal[k])}`,
                             ...shown.map(band => interval(at(band, k), text))],
    axes: {x: linearAxis('time [s]', {min: 0, max: time[time.length - 1]}), y: linearAxis(`y [${kGainUnit}]`, {grace: '4%'})}}, choices);
}
