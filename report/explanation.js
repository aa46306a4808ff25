'use strict';
// What the simulation gets wrong and why (explanation.json): the verdict, the tests, the causes.

const kColorBefore = kColors[1], kColorAfter = kColors[0];
const kQuantile95 = 1.96;  // of a two-sided interval of a Gaussian

function fullName({name, variant}) {
  return variant ? `${name} (${variant})` : name;
}

function causeNames(explanation) {
  return listed(explanation.causes.map(({equivalent, ...cause}) => [fullName(cause), ...equivalent].join(' or ')));
}

function failing(checks) {
  return checks.filter(check => !check.passed);
}

/// "whiteness and kurtosis still fail".
function failure(checks, verb) {
  const names = failing(checks).map(check => check.name);
  return `${listed(names)} ${verb}${names.length === 1 ? 's' : ''}`;
}

function verdictSentence(explanation) {
  const {verdict, causes, checks_before: before, checks_after: after} = explanation;
  const named = `The ${causes.length === 1 ? 'cause is' : 'causes are'} ${causeNames(explanation)}.`;
  return {
    none: `Nothing: all ${counted(before.length, 'test')} of the residuals pass.`,
    explained: `${named} With ${causes.length === 1 ? 'it' : 'them'} in the model all tests pass.`,
    partly_explained: `${named} This explains only a part: ${failure(after, 'still fail')}.`,
    unknown: `Something that no effect of the catalogue explains: ${failure(before, 'fail')}.`,
  }[verdict];
}

function probability(value) {
  return isNumber(value) && value < 1e-16 ? 'below 10\u207b\u00b9\u2076' : number(value, 2);
}

function outcome(check) {
  if (!check) return kNone;
  return check.passed ? 'passes' : element('span', {class: 'fails'}, 'fails' + (check.where ? ': ' + check.where : ''));
}

/// Tests that fail without the causes come first.
function checksTable({checks_before: before, checks_after: after, causes}) {
  const ordered = [...failing(before), ...before.filter(check => check.passed)], twice = causes.length > 0;
  const columns = [{title: 'Test of the residuals'}, {title: 'Statistic', number: true}, {title: 'p-value', number: true},
                   {title: twice ? 'Without the causes' : 'Outcome'}, ...(twice ? [{title: 'With them'}] : [])];
  return table(columns, ordered.map(check => {
    const cells = [check.name, number(check.statistic), probability(check.p_value), outcome(check)];
    return twice ? [...cells, outcome(after.find(({name}) => name === check.name))] : cells;
  }));
}

function causeParameters(parameters) {
  const interval90 = ({lower_90: lower, upper_90: upper}) =>
    isNumber(lower) && isNumber(upper) ? `${number(lower)} to ${number(upper)}` : kNone;
  return table([{title: 'Parameter'}, {title: 'Value', number: true}, {title: 'Standard error', number: true},
                {title: '90\u00a0% interval', number: true}, {title: 'Unit'}],
    parameters.map(parameter => {
      const {value, error} = withError(parameter.value, parameter.standard_error);
      return [parameter.name, value, error, interval90(parameter), parameter.unit];
    }));
}

// A posterior probability among the candidates is none where all of them leave something wrong, or
// where not all were tried.
function confidence(cause, allExplained) {
  if (!isNumber(cause.confidence) && cause.simulation) return 'It was found in the free simulation.';
  if (!isNumber(cause.confidence)) return 'Not all causes were tried in time, so it has no probability.';
  if (!allExplained) return 'It is the best of the catalogue; tests still fail, so it has no probability.';
  return `Its probability among the candidates is ${percent(Math.floor(1000 * cause.confidence) / 1000)}.`;
}

function showCause(parent, cause, index, allExplained) {
  parent.append(element('h3', {}, `Cause ${index + 1}: ${fullName(cause)}, ${cause.group}`));
  const others = cause.equivalent.length > 0 ? ` The data explain ${listed(cause.equivalent)} equally well.` : '';
  parent.append(paragraph(
    `${asSentence(cause.description || cause.name)} ${confidence(cause, allExplained)}${others}`));
  if (cause.advice) parent.append(element('p', {class: 'advice'}, element('b', {}, 'What to do: '), asSentence(cause.advice)));
  if (cause.parameters.length > 0) parent.append(causeParameters(cause.parameters));
}

function showVerdict(parent, explanation) {
  parent.append(element('p', {class: 'verdict ' + explanation.verdict}, verdictSentence(explanation)));
  if (explanation.warnings.length > 0) {
    parent.append(element('div', {class: 'warnings', role: 'note'},
      element('ul', {}, ...explanation.warnings.map(text => element('li', {}, asSentence(text))))));
  }
  parent.append(checksTable(explanation));
  explanation.causes.forEach((cause, index) => showCause(parent, cause, index, explanation.verdict === 'explained'));
}

const kExplanationSections = [
  {id: 'curves', title: 'What the simulation of a linear plant lacks', show: showSimulationSearch},
  {id: 'gain', title: 'What the causes improve', show: showGain},
  {id: 'simulated', title: 'Measured against simulated', show: showSimulated},
  {id: 'left', title: 'Residuals with and without the causes', show: showLeft},
  {id: 'tried', title: 'Effects that were tried', show: showTried},
];
