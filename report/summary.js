'use strict';
// The result in words.

const kStructures = {output_error: 'output-error', arx: 'ARX', armax: 'ARMAX', box_jenkins: 'Box-Jenkins',
                     continuous: 'continuous-time'};
const kEndings = {
  converged: 'The estimation converged', iteration_limit: 'The estimation stopped at the iteration limit',
  time_limit: 'The estimation stopped at its time limit', stalled: 'The estimation stalled',
  cancelled: 'The estimation was cancelled', not_run: 'The estimation was not run'};

function hasErrorModel(result) {
  return result.error_model.T.length > 0 && result.error_model.means[0].length > 0;
}

function hasBounds(result) {
  return Boolean(result.bounds && result.bounds.frequency);
}

/// With a capital, unless it begins with a name such as b2, and a full stop.
function asSentence(text) {
  const begun = /^[a-z]+ /.test(text) ? text.charAt(0).toUpperCase() + text.slice(1) : text;
  return begun.endsWith('.') ? begun : begun + '.';
}

function modelSentence(result) {
  const model = result.nominal_model, name = kStructures[model.structure] || model.structure;
  return `${/^[aeio]/i.test(name) ? 'An' : 'A'} ${name} model with ${counted(model.a.length, 'pole')} and a delay of ` +
    `${counted(model.delay, 'sample')} was identified from ${counted(result.experiments.count, 'experiment')} with ` +
    `${counted(result.experiments.samples, 'sample')} in total, one every ${number(model.sample_time)} s.`;
}

function uncertaintySentence(result) {
  if (result.baseline) return 'Each experiment was fitted separately; this model is the mean of the fits.';
  if (!hasErrorModel(result)) return 'The model does not describe how the plant varies between experiments.';
  const {weights, means} = result.error_model;
  const shape = weights.length === 1 ? 'a Gaussian distribution' : `a mixture of ${weights.length} Gaussian components`;
  const names = result.error_model.varied_parameters || [];
  const what = names.length > 0 ? `the relative deviations of ${listed(names)} follow` : 'its relative error follows';
  if (result.variation) return result.variation;
  return `The plant varies between experiments: ${what} ${shape} in ${counted(means[0].length, 'dimension')}.`;
}

function boundsSentence(result) {
  if (!hasBounds(result)) return '';
  const {levels, frequency} = result.bounds;
  const errors = frequency.relative_error, kind = hasBands(errors.total) ? errors.total : errors.mixture;
  if (!hasBands(kind)) return '';
  const level = levels.includes(0.95) ? levels.indexOf(0.95) : levels.length - 1;
  const last = answeringPoints(frequency), upper = kind.simultaneous[level].upper.slice(0, last), largest = Math.max(...upper);
  const whose = hasErrorModel(result) ? `For ${percent(levels[level])} of the plants` : `With a probability of ${percent(levels[level])}`;
  return `${whose} the relative error |G/Go \u2212 1| stays below ${inPercent(100 * largest, 2)} at all frequencies up to ` +
    `${number(frequency.omega[last - 1], 3)} rad/s, where the plant ${last < frequency.omega.length ? 'hardly answers any more' : 'is sampled'}; ` +
    `it is largest at ${number(frequency.omega[upper.indexOf(largest)], 3)} rad/s.`;
}

/// How many points of the grid, from the lowest frequency on, lie where the plant answers: up to the last where |Go| exceeds
/// a hundredth of its maximum. Beyond, the relative error is large and harms nobody.
function answeringPoints({magnitude}) {
  const limit = 0.01 * Math.max(...magnitude);
  return magnitude.findLastIndex(value => value >= limit) + 1;
}

function validationSentence(result) {
  const fit = result.validation.simulation_fit_percent_pooled, tried = result.validation.experiments.length;
  if (tried === 0) return 'No data were held out for validating the model.';
  return `On ${counted(tried, 'experiment')} held out for validation, a free simulation of the nominal model alone ` +
    `reproduces ${inPercent(fit, 3)} of the output (100\u00a0% is perfect, 0\u00a0% is no better than the mean)` +
    (hasErrorModel(result) ? '; the rest is noise and the difference between this plant and the nominal one.' : '.');
}

function showSummary(parent, result) {
  const varies = result.physical && result.physical.sentence && result.variation ? '' : uncertaintySentence(result);
  const sentences = [modelSentence(result), varies, boundsSentence(result), validationSentence(result)];
  parent.append(element('ul', {class: 'lead'}, ...sentences.filter(Boolean).map(text => element('li', {}, text))));
}
