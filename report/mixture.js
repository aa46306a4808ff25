'use strict';
// The distribution of the plants' relative error.

const kBases = {fir: 'delays q\u207b\u1d4f (FIR)', laguerre: 'Laguerre functions', kautz: 'Kautz functions'};

function showMixture(parent, result) {
  const model = result.error_model;
  if (!hasErrorModel(result)) {
    parent.append(paragraph('No error model was identified: all experiments are assumed to come from the same plant. How the plant varies can ' +
      'be seen from two experiments or more; a mixture needs at least four, better twenty.'));
    return;
  }
  parent.append(paragraph(`${errorModelSentence(model)} Each experiment\u2019s \u03be is drawn from ` +
    (model.weights.length === 1 ? 'one Gaussian.' : `a mixture of ${model.weights.length} Gaussians.`)));
  parent.append(componentsTable(model));
  const dimension = model.means[0].length;
  if (dimension === 1) showDensity(parent, result);
  else showPairs(parent, result, dimension);
}

function errorModelSentence(model) {
  const names = listed(model.varied_parameters || []);
  if (model.basis === 'parameter_spread') {
    return `The parameters of Go themselves vary from experiment to experiment: \u03be are the relative deviations of ${names}.`;
  }
  if (model.basis === 'sensitivity') {
    return `The parameters of Go vary from experiment to experiment: \u03be are the relative deviations of ${names}` +
      `${model.sensitivity_order === 2 ? ' and products of two of them' : ''}, to which G responds by the derivatives of Go.`;
  }
  return `G = Go (1 + G\u0394), where G\u0394 = \u2211 \u03b7\u2096 F\u2096 over ${counted(model.T.length, 'tap')} of ` +
    `${kBases[model.basis] || model.basis}, \u03b7 = T \u03be with T = ${matrix(model.T)}.`;
}

/// Title of an axis: the k-th coordinate of xi, with the parameter whose deviation it is, if it is that of one.
function coordinateName(model, k) {
  const index = model.means[0].length === 1 ? '' : '\u2080\u2081\u2082\u2083\u2084\u2085\u2086\u2087\u2088\u2089'[k + 1];
  const parameter = (model.varied_parameters || [])[k];
  return `\u03be${index}${parameter ? ', relative deviation of ' + parameter : ''} [1]`;
}

function standardErrors(model) {
  return Object.fromEntries(model.parameters.map(parameter => [parameter.name, parameter.standard_error]));
}

function componentsTable(model) {
  const errors = standardErrors(model), several = model.means[0].length > 1;
  const rows = model.weights.map((weight, i) => [String(i + 1), plusMinus(weight, errors[`weight${i + 1}`]),
    model.means[i].map((mean, k) => plusMinus(mean, errors[`mean${i + 1}[${k + 1}]`])).join('; '),
    model.covariances[i].map((row, k) => number(Math.sqrt(row[k]), 3)).join('; '),
    ...(several ? [matrix(model.covariances[i])] : [plusMinus(model.covariances[i][0][0], errors[`covariance${i + 1}[1,1]`])])]);
  return table([{title: 'Component', number: true}, {title: 'Weight', number: true}, {title: 'Mean of \u03be', number: true},
                {title: 'Standard deviation', number: true}, {title: several ? 'Covariance' : 'Variance', number: !several}], rows);
}

/// The experiments whose most probable component this is.
function membersOf(result, component) {
  return result.experiments.estimates.filter(estimate => mostProbable(estimate) === component);
}

function describeMember(estimate) {
  const component = mostProbable(estimate);
  return [estimate.id, `posterior mean of \u03be: ${vector(estimate.error_mean)}`,
          `component ${component + 1} with probability ${fixed(estimate.responsibilities[component], 3)}`];
}

function normalDensity(x, mean, variance) {
  return Math.exp(-((x - mean) ** 2) / (2 * variance)) / Math.sqrt(2 * Math.PI * variance);
}

function densityGrid(model, estimates) {
  const spread = model.means.flatMap(([mean], i) => [-4, 4].map(side => mean + side * Math.sqrt(model.covariances[i][0][0])));
  const [low, high] = extent([...spread, ...estimates.map(estimate => estimate.error_mean[0])]);
  const fine = model.means.flatMap(([mean], i) => Array.from({length: 81}, (none, k) => mean + (k / 10 - 4) * Math.sqrt(model.covariances[i][0][0])));
  return [...Array.from({length: 301}, (none, k) => low + (high - low) * k / 300), ...fine].sort((a, b) => a - b);
}

function showDensity(parent, result) {
  const model = result.error_model, {estimates} = result.experiments, grid = densityGrid(model, estimates);
  const part = (x, i) => model.weights[i] * normalDensity(x, model.means[i][0], model.covariances[i][0][0]);
  const total = grid.map(x => model.weights.reduce((sum, weight, i) => sum + part(x, i), 0));
  const peak = Math.max(...total);
  const datasets = [{label: 'density of \u03be', data: points(grid, total), borderColor: kInk, backgroundColor: kInk,
                     describe: k => [`\u03be = ${number(grid[k])}`, `density ${number(total[k], 3)}`]}];
  model.weights.forEach((weight, i) => {
    const color = componentColor(i), members = membersOf(result, i);
    if (model.weights.length > 1) {
      datasets.push({label: `component ${i + 1}`, data: points(grid, grid.map(x => part(x, i))), borderColor: color,
                     backgroundColor: tint(color, 0.18), fill: 'origin', borderDash: [6, 4], borderWidth: 1.5});
    }
    datasets.push({label: i === 0 ? 'posterior mean of each experiment' : '', group: 'ticks', showLine: false, pointStyle: 'line', pointRotation: 90,
                   pointRadius: 9, pointHoverRadius: 12, borderColor: color, backgroundColor: color,
                   data: members.map(estimate => ({x: estimate.error_mean[0], y: -0.045 * peak})), describe: k => describeMember(members[k])});
  });
  figure(parent, {
    title: 'Density of the relative error\u2019s coordinate \u03be', height: 320, datasets,
    caption: 'Ticks: the posterior mean of \u03be of each experiment, in the colour of its most probable component. The noisier an ' +
      'experiment is, the more its posterior mean is drawn towards the mean of the component.',
    axes: {x: linearAxis(coordinateName(model, 0), {min: grid[0], max: grid[grid.length - 1]}), y: linearAxis('probability density [1]', {
             min: -0.09 * peak, max: 1.06 * peak, ticks: {callback: value => (value < 0 ? '' : number(value))}})}});
}

/// Points of the ellipse that contains this share of a two-dimensional Gaussian.
function ellipse([mx, my], [[xx, xy], [, yy]], share) {
  const radius = Math.sqrt(-2 * Math.log(1 - share)), l11 = Math.sqrt(xx), l21 = l11 > 0 ? xy / l11 : 0;
  const l22 = Math.sqrt(Math.max(0, yy - l21 * l21));
  return Array.from({length: 73}, (none, k) => {
    const c = radius * Math.cos(k * Math.PI / 36), s = radius * Math.sin(k * Math.PI / 36);
    return {x: mx + l11 * c, y: my + l21 * c + l22 * s};
  });
}

function showPairs(parent, result, dimension) {
  const grid = element('div', {class: 'figures'}), shown = Math.min(dimension, 4);
  if (shown < dimension) parent.append(paragraph(`The first ${shown} of ${dimension} coordinates are drawn.`));
  parent.append(grid);
  for (let i = 0; i < shown; ++i) for (let j = i + 1; j < shown; ++j) showPair(grid, result, i, j);
}

function showPair(parent, result, i, j) {
  const model = result.error_model, datasets = [];
  model.weights.forEach((weight, component) => {
    const color = componentColor(component), members = membersOf(result, component);
    const mean = [model.means[component][i], model.means[component][j]], all = model.covariances[component];
    const covariance = [[all[i][i], all[i][j]], [all[j][i], all[j][j]]], group = 'component' + component;
    datasets.push({label: `component ${component + 1}, weight ${number(weight, 3)}`, group, showLine: false, pointRadius: 3.5,
                   pointStyle: ['circle', 'triangle', 'rect', 'rectRot'][component % 4], borderColor: color, backgroundColor: color,
                   data: members.map(estimate => ({x: estimate.error_mean[i], y: estimate.error_mean[j]})),
                   describe: k => describeMember(members[k])});
    [0.5, 0.95].forEach(share => datasets.push({group, data: ellipse(mean, covariance, share), borderColor: color, borderWidth: 1.5,
      borderDash: share < 0.9 ? [] : [6, 4], backgroundColor: 'rgba(0, 0, 0, 0)', pointHitRadius: 0}));
  });
  figure(parent, {
    title: `Relative error, coordinates ${i + 1} and ${j + 1} of \u03be`, height: 380, datasets,
    caption: 'Ellipses contain 50 % (solid) and 95 % (dashed) of each component. Points: the posterior mean of each experiment, by its most ' +
      'probable component.',
    axes: {x: linearAxis(coordinateName(model, i), {grace: '4%'}), y: linearAxis(coordinateName(model, j), {grace: '4%'})}});
}
