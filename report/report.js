'use strict';
// The sections of the report of a result (result.json) and, if there is one, of an explanation.

function showResponses(parent, result) {
  const choices = new BandChoice(hasErrorModel(result)), bounds = hasBounds(result) ? result.bounds : null;
  if (bounds) {
    const spread = hasErrorModel(result) ? 'the identified distribution' : 'the distribution of the errors of the estimate';
    parent.append(paragraph(`Bands from ${counted(bounds.samples, 'plant')} drawn from ${spread}; the Nyquist frequency is ` +
      `${number(Math.PI / result.nominal_model.sample_time)} rad/s.`));
    showBandChoice(parent, bounds, choices);
  } else if (result.baseline) {
    parent.append(paragraph('This method gives bands of the magnitude only, which are drawn above. The responses below are those of the mean model.'));
  } else {
    parent.append(paragraph('This result contains no bounds: its configuration has bounds: {frequencies: 0}, or they could not be computed (see the ' +
      'notes at the top). The responses of the nominal model are drawn without uncertainty.'));
  }
  const frequency = bounds ? bounds.frequency : nominalFrequencyResponse(result.nominal_model);
  showBode(parent, frequency, result.nominal_model.sample_time, choices);
  const pair = element('div', {class: 'figures'}), left = element('div'), right = element('div');
  pair.append(left, right);
  parent.append(pair);
  showNyquist(left, result, frequency);
  showStep(right, bounds ? bounds.step : nominalStepResponse(result.nominal_model), choices);
  if (bounds) showRelativeError(parent, result, choices);
}

const kSections = [
  {id: 'data', title: 'Data', show: showData},
  {id: 'model', title: 'Nominal model', show: showNominalModel},
  {id: 'uncertainty', title: 'Distribution of the model error', show: showMixture},
  {id: 'responses', title: 'Responses and their uncertainty', show: showResponses},
  {id: 'validation', title: 'Validation', show: showValidation},
  {id: 'residuals', title: 'Residuals', show: showResiduals},
  {id: 'estimation', title: 'How the model was found', show: (parent, result) => {
    showConvergence(parent, result);
    showCandidates(parent, result.candidates);
  }},
  {id: 'configuration', title: 'Configuration', show: showConfiguration},
];

const kBaselineSection = {id: 'baseline', title: 'Fits of each experiment', show: showBaseline};

function sectionsOf(result, explanation) {
  const before = explanation ? kExplanationSections.map(entry => ({...entry, show: parent => entry.show(parent, explanation)})) : [];
  return [...before, ...(result.baseline ? [...kSections.slice(0, 2), kBaselineSection, ...kSections.slice(2)] : kSections)];
}

/// `explanation` is null where there is none.
function showReport(result, explanation, parent) {
  const sections = sectionsOf(result, explanation);
  const first = explanation ? [{id: 'verdict', title: 'What the simulation gets wrong'}, {id: 'summary', title: 'The identified model'}] : [];
  const origin = `uncertainty_identification ${result.version} \u00b7 data ${result.data_fingerprint} \u00b7 seed ${result.seed}`;
  parent.append(element('header', {}, element('h1', {}, 'Identification report'),
    element('nav', {}, ...[...first, ...sections].map(({id, title}) => element('a', {href: '#' + id}, title)))));
  if (explanation) showVerdict(section(parent, 'verdict', first[0].title), explanation);
  const summary = explanation ? section(parent, 'summary', first[1].title) : parent;
  showTrust(summary, result);
  showWarnings(summary, result);
  showSummary(summary, result);
  sections.forEach(({id, title, show}) => show(section(parent, id, title), result));
  printFigures();
  parent.append(element('footer', {}, origin));
}
