'use strict';
// Residuals of the models without and with the causes: where the simulation is wrong.

/// What to draw, {label, color, picture}: without and with the causes, or one side only if there are none.
function sidesOf({causes, residuals_before: before, residuals_after: after}) {
  if (causes.length === 0) return [{label: '', color: kColorBefore, picture: before}];
  return [{label: 'without the causes', color: kColorBefore, picture: before}, {label: 'with the causes', color: kColorAfter, picture: after}];
}

function ruler(level, first, last, label = '') {
  return {label, group: 'ruler', type: 'line', borderColor: kInk, backgroundColor: kInk, borderDash: [6, 4], borderWidth: 1,
          data: [{x: first, y: level}, {x: last, y: level}]};
}

function lagFigure(parent, sides, {title, axis, key, first}) {
  const limit = sides[0].picture.confidence_95, last = first + sides[0].picture[key].length - 1;
  const largest = Math.max(1.5 * limit, ...sides.flatMap(({picture}) => picture[key].map(value => 1.1 * Math.abs(value))));
  figure(parent, {
    title, height: 240, type: 'bar', caption: 'If the model is right, one in twenty bars exceeds the limits.',
    datasets: [...sides.map(({label, color, picture}) => (
      {label, data: picture[key].map((value, k) => ({x: first + k, y: value})), backgroundColor: color, fill: true,
       describe: k => [`lag ${first + k}${label && ', ' + label}`, `correlation ${number(picture[key][k], 3)}`]})),
      ruler(limit, first - 0.5, last + 0.5, '95\u00a0% limits'), ruler(-limit, first - 0.5, last + 0.5)],
    axes: {x: linearAxis(axis, {offset: false, min: first - 0.5, max: last + 0.5, ticks: {precision: 0}}),
           y: linearAxis('correlation [1]', {min: -largest, max: largest})}});
}

/// A quantity over another one, {x, y: keys of the picture}; for a right model it stays near `level`.
function curveFigure(parent, sides, {title, axis, unit, quantity, x, y, level, caption, logarithmic = false}) {
  const values = picture => (x ? picture[x] : picture[y].map((value, k) => k + 1));
  const all = sides.flatMap(({picture}) => values(picture)), first = Math.min(...all), last = Math.max(...all);
  figure(parent, {
    title, height: 240, caption,
    datasets: [...sides.map(({label, color, picture}) => (
      {label, data: points(values(picture), picture[y]), borderColor: color, backgroundColor: color, borderWidth: 1.5,
       pointRadius: picture[y].length > 40 ? 0 : 2.5, spanGaps: true,
       describe: k => [`${number(values(picture)[k])} ${unit}${label && ', ' + label}`, `${quantity} ${number(picture[y][k], 3)}`]})),
      ruler(level, first, last)],
    axes: {x: logarithmic ? logarithmicAxis(axis, first, last) : linearAxis(axis, {min: first, max: last}),
           y: linearAxis(quantity, {grace: '5%', ...(logarithmic ? {min: 0} : {})})}});
}

const kCurves = [
  {title: 'Residual over the input', axis: 'u', unit: '', x: 'input_level', y: 'residual_of_input', quantity: 'mean residual / \u03c3', level: 0,
   caption: 'A bend, a step or a flat part near zero points to the actuator.'},
  {title: 'Residual over the simulated output', axis: 'simulated output', unit: '', x: 'output_level', y: 'residual_of_output', quantity: 'mean residual / \u03c3',
   level: 0, caption: 'A bend points to the sensor or to a plant that is not linear.'},
  {title: 'Residual over time', axis: 'time since the start [s]', unit: 's', x: 'time', y: 'residual_of_time', quantity: 'mean residual / \u03c3', level: 0,
   caption: 'A ramp points to a drift, a deviation at the start to the initial state.'},
  {title: 'Variance over time', axis: 'time since the start [s]', unit: 's', x: 'time', y: 'variance_of_time', quantity: 'variance / \u03c3\u00b2', level: 1,
   caption: 'A step points to a change of the noise or of the gain.'},
  {title: 'Spectrum of the residuals', axis: 'frequency [rad/s]', unit: 'rad/s', x: 'frequency', y: 'spectrum', quantity: 'power / that of white noise', level: 1,
   caption: 'A narrow peak points to hum, a broad one to a resonance, low frequencies to drift.', logarithmic: true},
  {title: 'Size of the residuals by experiment', axis: 'experiment, in order', unit: '(experiment)', y: 'of_experiment', quantity: 'root mean square / \u03c3', level: 1,
   caption: 'A trend points to ageing, groups to modes of operation, single points to faulty records.'},
];

function showLeft(parent, explanation) {
  if (explanation.residuals_before.autocorrelation.length === 0) {
    parent.append(paragraph('Those of the model that identify chooses are in the section "Residuals" of its result.'));
    return;
  }
  const sides = sidesOf(explanation), drawn = key => sides.every(({picture}) => picture[key].length > 1);
  parent.append(paragraph('Residuals of the prediction, relative to the standard deviation \u03c3 of the noise. If the model is right they are ' +
    'nothing but noise, and the curves stay near their dashed lines.'));
  const figures = element('div', {class: 'figures'});
  parent.append(figures);
  const lags = [{title: 'Residuals: autocorrelation', axis: 'lag [samples]', key: 'autocorrelation', first: 1},
                {title: 'Residuals: correlation with the input', axis: 'lag of the input [samples]', key: 'cross_correlation', first: 0}];
  lags.filter(({key}) => drawn(key)).forEach(content => lagFigure(figures, sides, content));
  kCurves.filter(({y}) => drawn(y)).forEach(content => curveFigure(figures, sides, content));
}
