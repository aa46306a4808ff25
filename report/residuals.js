'use strict';
// Whether the residuals are white and uncorrelated with the input.

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
    caption: 'If the model is right, one in a hundred bars exceeds the limits. With very many samples even harmless correlations do.',
    datasets: [{data: correlation.map((value, k) => ({x: first + k, y: value})), backgroundColor: kColors[0],
                describe: k => [`lag ${first + k}`, `correlation ${number(correlation[k], 3)}`]}, edge(1), edge(-1)],
    axes: {x: linearAxis(axis, {offset: false, min: first - 0.5, max: last + 0.5, ticks: {precision: 0}}),
           y: linearAxis('correlation [1]', {min: -largest, max: largest})}});
}

function showResiduals(parent, result) {
  const tests = result.residual_tests;
  if (!tests || tests.autocorrelation.length === 0) {
    parent.append(paragraph('This result contains no residual tests.'));
    return;
  }
  parent.append(paragraph(`From ${counted(tests.samples, 'residual')}: each sample minus its prediction from the earlier samples of the same ` +
    'experiment, with its relative error unknown at the start. ' +
    verdict(tests.whiteness_p_value, 'They look white, as they should with the right noise model', 'They are not white, so the noise model is incomplete') + ' ' +
    verdict(tests.independence_p_value, 'They are uncorrelated with the input, as they should be with the right plant model',
            'They are correlated with the input, so the plant model is incomplete')));
  const pair = element('div', {class: 'figures'});
  parent.append(pair);
  correlationFigure(pair, 'Autocorrelation of the residuals', 'lag [samples]', tests.autocorrelation, 1, tests.samples);
  correlationFigure(pair, 'Correlation of the residuals with the input', 'lag of the input [samples]', tests.cross_correlation, 0, tests.samples);
}
