'use strict';
// What a reader should know first: whether the result can be relied on, and what to record next.

function reportTitle({origin}) {
  return origin && origin.data.length > 0 ? `Identification of ${listed(origin.data.slice(0, 3))}${origin.data.length > 3 ? ', \u2026' : ''}` : 'Identification report';
}

function originLine({origin, version}) {
  const parts = [`uncertainty_identification ${version}`];
  if (origin && origin.date) parts.unshift(`${origin.date} UTC`);
  if (origin && origin.validation.length > 0) parts.push(`validated with ${listed(origin.validation)}`);
  return parts.join(' \u00b7 ');
}

/// What speaks against the result, the gravest first: {level: 'red' or 'amber', text}. Results of older versions have no trust.
function objections(result) {
  const red = result.trust && !result.trust.trusted ? [...result.trust.reasons] : [];
  if (result.termination !== 'converged') red.unshift(`${kEndings[result.termination]}: ${result.message}.`);
  const amber = [...result.warnings, ...((result.bounds && result.bounds.warnings) || [])], rejected = result.experiments.rejected.length;
  if (rejected > 0) amber.push(`${counted(rejected, 'experiment')} ${rejected === 1 ? 'was' : 'were'} left out; the section Experiments says why.`);
  return [...red.map(text => ({level: 'red', text})), ...amber.map(text => ({level: 'amber', text}))];
}

const kVerdicts = {
  red: 'Do not rely on the uncertainty of this model', amber: 'Usable; please note', green: 'Nothing speaks against this result'};

function showTrust(parent, result) {
  const found = objections(result), level = found.length > 0 ? found[0].level : 'green';
  const why = found.length > 0 ? element('ul', {}, ...found.map(({text}) => element('li', {}, asSentence(text)))) :
    paragraph(`${kEndings[result.termination]}, all experiments were used and no check raised a warning.`);
  parent.append(element('div', {class: 'trust ' + level, role: 'note'}, element('h2', {}, kVerdicts[level]), why));
}

function slowestTimeConstant({numbers}) {
  return Math.max(0, ...numbers.filter(({name}) => name.startsWith('time_constant')).map(({value}) => value),
    ...numbers.filter(({name}) => name.startsWith('natural_frequency')).map(({value}) => 1 / value));
}

/// Half the width of the widest interval among the numbers with these names, relative to the value.
function inaccuracy({numbers}, names) {
  return Math.max(0, ...numbers.filter(({name, lower_95: lower}) => isNumber(lower) && names.some(begin => name.startsWith(begin)))
    .map(({value, lower_95: lower, upper_95: upper}) => (value === 0 ? 0 : (upper - lower) / 2 / Math.abs(value))));
}

function typicalFit({runs}) {
  const held = runs.filter(run => run.validation), chosen = held.length > 0 ? held : runs;
  const run = chosen.find(({rank}) => rank === 'median') || chosen[0];
  return run ? run.fit_percent : null;
}

/// Whether noise and the spread of the plants explain what the simulation does not.
function residualsPass({residual_tests: tests}) {
  return Boolean(tests && tests.autocorrelation.length > 0 && tests.whiteness_p_value >= 0.01 && tests.independence_p_value >= 0.01);
}

/// One piece of advice, from what is weakest.
function advice(result) {
  const {physical, experiments, nominal_model: model} = result, runs = experiments.count;
  const slowest = slowestTimeConstant(physical), fit = typicalFit(result), coarse = 0.1;
  const lengths = experiments.estimates.map(({samples}) => samples * model.sample_time).sort((one, other) => one - other);
  const typical = lengths.length > 0 ? lengths[Math.floor(lengths.length / 2)] : null;
  const ofGain = inaccuracy(physical, ['gain', 'velocity_gain']), ofDynamics = inaccuracy(physical, ['time_constant', 'natural_frequency', 'damping', 'bandwidth']);
  const bandwidth = physical.numbers.find(({name}) => name === 'bandwidth'), edge = bandwidth ? bandwidth.value : slowest > 0 ? 1 / slowest : null;
  const around = edge ? ` (${number(edge, 2)} rad/s)` : '';
  if (typical !== null && typical < 5 * slowest)
    return `Longer runs: the slowest time constant is ${number(slowest, 3)} s and a run lasts ${number(typical, 3)} s. Record at least ${number(10 * slowest, 2)} s each, or the gain stays uncertain.`;
  if (runs < 4)
    return `More runs: ${runs === 1 ? 'one run says' : runs + ' runs say'} little about how the plant differs from run to run. Record at least eight, better twenty, under the conditions in which the plant will be used.`;
  if (isNumber(fit) && fit < 70 && !residualsPass(result))
    return `Nothing yet: the simulation reproduces ${inPercent(fit, 2)} of a typical run. Run explain on the same data: it tells whether noise or a cause such as friction or a dead zone is missing.`;
  if (ofGain > coarse && ofGain >= ofDynamics)
    return `Slower inputs: the gain is known to \u00b1${inPercent(100 * ofGain, 2)} only. Hold each value of the input for about ${number(5 * slowest || 20 * model.sample_time, 2)} s, so that it excites the plant below its bandwidth${around}.`;
  if (ofDynamics > coarse)
    return `Faster inputs: the dynamics are known to \u00b1${inPercent(100 * ofDynamics, 2)} only. Let the input change often enough to excite the plant at its bandwidth and above${around}.`;
  if (result.validation.experiments.length === 0)
    return 'A few runs for validation: none were held out. Record three more, or keep some back, and give them to identify by --validation.';
  return 'Other operating points: here the plant is known well. Record runs at other amplitudes, loads and temperatures to see whether it stays the same.';
}

function showAdvice(parent, result) {
  if (!result.physical || !result.runs || result.baseline) return;
  const [what, ...rest] = advice(result).split(':');
  parent.append(element('h2', {id: 'next'}, 'Record this next'), element('p', {class: 'advice'}, element('b', {}, what + ':'), rest.join(':')));
}

function showFirstPage(parent, result) {
  if (result.physical && result.physical.sentence) parent.append(element('p', {class: 'sentence'}, result.physical.sentence + ' ' + (result.variation || '')));
  showTrust(parent, result);
  showRuns(parent, result);
  showPhysical(parent, result);
  showAdvice(parent, result);
}
