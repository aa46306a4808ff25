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

// `printed`: opened on paper, too. The others are there to be looked up on the screen.
const kSections = [
  {id: 'summary', title: 'In words', show: showSummary, printed: true},
  {id: 'responses', title: 'Responses and their uncertainty', show: showResponses, printed: true},
  {id: 'validation', title: 'Validation', show: showValidation, printed: true},
  {id: 'model', title: 'Nominal model', show: showNominalModel, printed: true},
  {id: 'uncertainty', title: 'Distribution of the model error', show: showMixture},
  {id: 'data', title: 'Experiments', show: showData},
  {id: 'residuals', title: 'Residuals', show: showResiduals},
  {id: 'estimation', title: 'How the model was found', show: (parent, result) => {
    showConvergence(parent, result);
    showCandidates(parent, result.candidates);
  }},
  {id: 'configuration', title: 'Configuration', show: showConfiguration},
];

const kBaselineSection = {id: 'baseline', title: 'Fits of each experiment', show: showBaseline, printed: true};

function navigation(entries) {
  return element('nav', {'aria-label': 'Sections'}, ...entries.map(({id, title}) => {
    const link = element('a', {href: '#' + id}, title);
    link.addEventListener('click', () => {
      const folded = document.querySelector(`#${id} > details`);
      if (folded) folded.open = true;
    });
    return link;
  }));
}

/// `explanation` is null where there is none.
function showReport(result, explanation, parent) {
  const explained = explanation ? kExplanationSections : [];
  const details = result.baseline ? [kBaselineSection, ...kSections] : kSections;
  const own = explanation && explanation.own_simulation ? [{id: 'own', title: 'What your simulation gets wrong'}] : [];
  const verdict = explanation ? [...own, {id: 'verdict', title: 'What the simulation gets wrong'}] : [];
  document.title = reportTitle(result);
  parent.append(element('header', {}, element('h1', {}, reportTitle(result)), paragraph(originLine(result), 'origin'),
    navigation([...verdict, ...explained, ...details])));
  if (own.length > 0) showOwnSimulation(section(parent, 'own', own[0].title), explanation.own_simulation);
  if (explanation) showVerdict(section(parent, 'verdict', verdict[verdict.length - 1].title), explanation);
  showFirstPage(parent, result);
  explained.forEach(({id, title, show}) => show(section(parent, id, title), explanation));
  details.forEach(({id, title, show, printed}) => show(foldedSection(parent, id, title, printed), result));
  printFigures();
  unfoldForPrint();
  parent.append(element('footer', {}, `data ${result.data_fingerprint} \u00b7 seed ${result.seed}`));
}
