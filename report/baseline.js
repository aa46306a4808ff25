'use strict';
// Results of identify --method pem or mem: a prediction-error fit of each experiment separately.

const kBaselines = {pem: 'a prediction-error fit of each experiment separately', mem: 'model error modelling'};

function showBaseline(parent, result) {
  const {baseline, nominal_model: model} = result, {omega} = baseline;
  parent.append(paragraph(`The method was ${kBaselines[baseline.method] || baseline.method}; the nominal model is the mean of ` +
    `${counted(baseline.experiments.length, 'fit')}. The standard deviations say how much the fits differ between experiments.`));
  const names = model.parameters.map(parameter => parameter.name);
  parent.append(table([{title: 'Parameter'}, {title: 'Mean of the fits', number: true}, {title: 'Standard deviation', number: true}],
    baseline.mean.map((mean, k) => [names[k] || String(k + 1), number(mean), number(baseline.deviation[k], 3)])));
  const gains = baseline.experiments.map(fit => {
    const {numerator, denominator} = plantPolynomials(fit);
    return omega.map(value => decibel(magnitudeOf(numerator, denominator, value * model.sample_time)));
  });
  const lines = baseline.experiments.map((fit, index) => ({
    label: index === 0 ? 'fit of each experiment' : '', group: 'fits', data: points(omega, gains[index]), borderWidth: 0.8,
    borderColor: 'rgba(213, 94, 0, 0.55)', backgroundColor: kColors[1],
    describe: k => [fit.id, `${number(omega[k])} rad/s`, `${number(gains[index][k], 3)} dB`]}));
  const bands = baseline.magnitude_bands.pointwise.map(({level, lower, upper}) => (
    {level, lower: lower.map(value => decibel(Math.max(value, 1e-12))), upper: upper.map(decibel)}));
  figure(parent, {
    title: 'Magnitude, fits of each experiment', height: 340, datasets: [...lines, ...bandDatasets(omega, bands, kColors[0])],
    caption: 'Shaded: the stated share of the plants lies there according to this method. Hover over a line to see its experiment.',
    axes: {x: frequencyAxis(omega), y: aligningAxis(linearAxis(`|G| [dB re 1 ${kGainUnit}]`, {grace: '2%'}))}});
}
