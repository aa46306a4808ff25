'use strict';
// The experiments: which were used, which were not and why, and how well the model explains each of them.

function mostProbable(experiment) {
  const shares = experiment.responsibilities;
  return shares.indexOf(Math.max(...shares));
}

function showData(parent, result) {
  const {estimates, rejected, count: used, samples} = result.experiments;
  parent.append(paragraph(`${counted(used, 'experiment')} with ${counted(samples, 'measured output sample')} ` +
    `${used === 1 ? 'was' : 'were'} used` + (rejected.length > 0 ? '.' : '; none was left out.') + ' ' +
    `The operating point, which is subtracted from the signals: ${number(result.offsets.u)} from u, ${number(result.offsets.y)} from y.`));
  if (rejected.length > 0) {
    parent.append(element('h3', {}, 'Left out'),
      scrolling(table([{title: 'Experiment'}, {title: 'Reason'}], rejected.map(({id, reason}) => [id, reason])), rejected.length));
  }
  if (estimates.length > 1) showLikelihoods(parent, result);
  parent.append(element('h3', {}, 'Experiments used'), experimentsTable(result));
}

function showLikelihoods(parent, result) {
  const {estimates} = result.experiments;
  const components = result.error_model.weights.length, mixed = hasErrorModel(result) && components > 1;
  const datasets = [];
  for (let component = 0; component < (mixed ? components : 1); ++component) {
    const members = estimates.map((estimate, index) => ({estimate, index}))
      .filter(({estimate}) => !mixed || mostProbable(estimate) === component);
    datasets.push({
      label: mixed ? `most probably component ${component + 1}` : '', showLine: false, pointRadius: 4,
      pointStyle: ['circle', 'triangle', 'rect', 'rectRot'][component % 4],
      backgroundColor: componentColor(component), borderColor: componentColor(component),
      data: members.map(({estimate, index}) => ({x: index + 1, y: estimate.log_likelihood / estimate.samples})),
      describe: k => [members[k].estimate.id, `log-likelihood ${number(members[k].estimate.log_likelihood, 5)}, ` +
        `${number(members[k].estimate.log_likelihood / members[k].estimate.samples)} per sample`]});
  }
  figure(parent, {
    title: 'How well the model explains each experiment', height: 230, datasets,
    caption: 'Log-likelihood per sample of each experiment. An experiment far below the others was recorded under different ' +
      'conditions or contains faulty data. Hover over a point to see its experiment.',
    axes: {x: linearAxis('experiment, in order', {min: 0, max: estimates.length + 1, ticks: {precision: 0}}),
           y: linearAxis('log-likelihood per sample')}});
}

function experimentsTable(result) {
  const {estimates} = result.experiments, error = hasErrorModel(result);
  const columns = [{title: 'Experiment'}, {title: 'Samples', number: true}, {title: 'Log-likelihood', number: true}];
  if (error) columns.push({title: 'Component', number: true}, {title: 'its probability', number: true},
                          {title: 'Posterior mean of \u03be', number: true});
  const means = estimates.length === 0 ? [] : estimates[0].error_mean.map((none, k) => aligned(estimates.map(estimate => estimate.error_mean[k])));
  const rows = estimates.map((estimate, index) => {
    const cells = [estimate.id, count(estimate.samples), fixed(estimate.log_likelihood, 2)];
    if (!error) return cells;
    const component = mostProbable(estimate);
    return [...cells, String(component + 1), fixed(estimate.responsibilities[component], 3), means.map(mean => mean[index]).join(', ')];
  });
  return scrolling(table(columns, rows), rows.length);
}

function showValidation(parent, result) {
  const {experiments, simulation_fit_percent: fits, log_density_per_experiment: density} = result.validation;
  if (experiments.length === 0) {
    parent.append(paragraph('No data were held out for validation (identify --validation DATA), so it is not known how well the model ' +
      'predicts data to which it was not fitted.'));
    return;
  }
  parent.append(paragraph(validationSentence(result) + ` The mean log predictive density is ${number(density, 5)} per experiment.`));
  if (experiments.length === 1) return;
  const order = fits.map((fit, k) => k).filter(k => isNumber(fits[k])).sort((i, j) => fits[i] - fits[j]);
  figure(parent, {
    title: 'Simulation fit on validation data', height: 230, type: 'bar', mode: 'index',
    caption: 'Free simulation of the nominal model, the worst experiment first: 100 (1 \u2212 |y \u2212 y_sim| / |y \u2212 mean y|). ' +
      'Hover over a bar to see its experiment.',
    datasets: [{data: order.map((k, rank) => ({x: rank + 1, y: fits[k]})), backgroundColor: kColors[0],
                describe: rank => `${experiments[order[rank]]}: ${inPercent(fits[order[rank]], 3)}`}],
    axes: {x: linearAxis('experiment, by rank', {offset: false, min: 0.5, max: order.length + 0.5, ticks: {precision: 0}}),
           y: linearAxis('simulation fit [%]')}});
}
