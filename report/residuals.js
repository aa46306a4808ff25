'use strict';
// Whether what the model leaves of the data is white noise that holds nothing of the input.

const kInsideShare = 2.576;  // standard deviations within which 99 % of a Gaussian lie

function verdict(probability, good, bad) {
  const text = probability < 1e-4 ? 'below 0.0001' : number(probability, 2);
  return `${probability < 0.01 ? bad : good} (p-value ${text}).`;
}

function correlationFigure(parent, title, axis, correlation, first, samples) {
  const limit = kInsideShare / Math.sqrt(samples), last = first + correlation.length - 1;
  const edge = side => ({label: side > 0 ? '99\u00a0% limits' : '', group: 'limits', type: 'line', borderColor: kColors[1], backgroundColor: kColors[1],
                         borderDash: [7, 4], borderWidth: 1.5, data: [first - 0.5, last + 0.5].map(x => ({x, y: side * limit}))});
  const largest = Math.max(1.25 * limit, ...correlation.map(value => 1.1 * Math.abs(value)));
  figure(parent, {
    title, height: 260, type: 'bar',
    caption: 'Where the model is right one in a hundred bars leaves the limits. Of very many samples even harmless correlations do.',
    datasets: [{data: correlation.map((value, k) => ({x: first + k, y: value})), backgroundColor: kColors[0],
                describe: k => [`lag ${first + k}`, `correlation ${number(correlation[k], 3)}`]}, edge(1), edge(-1)],
    axes: {x: linearAxis(axis, {offset: false, min: first - 0.5, max: last + 0.5, ticks: {precision: 0}}),
           y: linearAxis('correlation [1]', {min: -largest, max: largest})}});
}

function showResiduals(parent, result) {
  const tests = result.residual_tests;
  if (!tests || tests.autocorrelation.length === 0) {
    parent.append(paragraph('This result holds no residual tests.'));
    return;
  }
  parent.append(paragraph(`From ${counted(tests.samples, 'residual')}: each sample less its prediction from the samples before it in the same ` +
    'experiment, relative errors unknown at its start. ' +
    verdict(tests.whiteness_p_value, 'They look white: nothing speaks against the noise model', 'They are not white: the noise model leaves something out') + ' ' +
    verdict(tests.independence_p_value, 'They hold nothing of the input: nothing speaks against the plant model',
            'They hold something of the input: the plant model leaves something out')));
  const pair = element('div', {class: 'figures'});
  parent.append(pair);
  correlationFigure(pair, 'Autocorrelation of the residuals', 'lag [samples]', tests.autocorrelation, 1, tests.samples);
  correlationFigure(pair, 'Correlation of the residuals with the input', 'lag of the input [samples]', tests.cross_correlation, 0, tests.samples);
}
