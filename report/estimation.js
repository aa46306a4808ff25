'use strict';
// How the model was found: candidates, convergence, configuration.

function showCandidates(parent, candidates) {
  if (candidates.length === 0) {
    parent.append(paragraph('The configuration stated all orders and numbers of components, so no candidates were compared.'));
    return;
  }
  const chosen = candidates.filter(candidate => candidate.chosen).map(candidate => candidate.description);
  parent.append(element('h3', {}, 'Candidates compared'),
    paragraph(`Chosen: ${listed(chosen)}. A lower BIC and a higher held-out fit are better.`),
    scrolling(table([{title: 'Choice'}, {title: 'Candidate'}, {title: 'Parameters', number: true}, {title: 'Log-likelihood', number: true},
                     {title: 'BIC', number: true}, {title: 'Held-out fit [%]', number: true}, {title: element('span', {class: 'unseen'}, 'Chosen')}],
      candidates.map(({choice: of, description, parameters, log_likelihood: likelihood, bic, validation_fit: fit, chosen: best}) =>
        [of, description, count(parameters), fixed(likelihood, 2), fixed(bic, 2), isNumber(fit) ? fixed(fit, 2) : kNone, best ? '\u2713 chosen' : '']),
      index => candidates[index].chosen), candidates.length));
}

function showConvergence(parent, result) {
  parent.append(paragraph(`${kEndings[result.termination]} after ${counted(result.iterations, 'iteration')}, ` +
    `${counted(result.passes, 'pass', 'passes')} over the data and ${number(result.seconds, 2)} s: ${result.message}. ` +
    `Log-likelihood ${fixed(result.log_likelihood, 3)}, BIC ${fixed(result.bic, 3)}.`));
  const {trace} = result;
  if (trace.length < 4) {
    parent.append(paragraph('The starting point was nearly the optimum: there are too few steps to draw.'));
    return;
  }
  const end = Math.max(...trace.map(point => point.log_likelihood));
  figure(parent, {
    title: 'Convergence', height: 250, mode: 'index',
    caption: 'Final log-likelihood minus that after each iteration of the optimisation. Few points mean that its starting ' +
      'point was good.',
    datasets: [{data: trace.map(point => ({x: point.passes, y: end - point.log_likelihood})), borderColor: kColors[0], backgroundColor: kColors[0],
                clip: false, pointRadius: trace.length > 60 ? 0 : 3.5,
                describe: k => [`iteration ${count(trace[k].iteration)}, ${counted(trace[k].passes, 'pass', 'passes')} over the data`,
                                `log-likelihood ${fixed(trace[k].log_likelihood, 4)}`]}],
    axes: {x: linearAxis('passes over the data', {ticks: {precision: 0}}),
           y: linearAxis('log-likelihood still to gain', {min: 0, ticks: {callback: value => number(value, 3)}})}});
}

function asYaml(value, indent = '') {
  return Object.entries(value).map(([key, entry]) => {
    const nested = entry !== null && typeof entry === 'object' && !Array.isArray(entry);
    if (!nested) return `${indent}${key}: ${typeof entry === 'string' ? entry || "''" : JSON.stringify(entry)}\n`;
    return Object.keys(entry).length === 0 ? `${indent}${key}: {}\n` : `${indent}${key}:\n${asYaml(entry, indent + '  ')}`;
  }).join('');
}

function showConfiguration(parent, result) {
  parent.append(paragraph('With this configuration and the same data the result can be reproduced. Automatic choices are replaced by the values chosen.'),
    element('details', {}, element('summary', {}, 'Show the configuration'), element('pre', {}, asYaml(result.configuration))));
}
