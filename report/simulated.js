'use strict';
// Single experiments: measured output and what the models simulate.

const kMostSamples = 1000;  // drawn at most; more would hide each other

/// Index of the first sample to draw: the part in which the simulation without the causes is worst.
function worstStretch({measured, simulated_before: simulated}) {
  if (measured.length <= kMostSamples) return 0;
  const error = measured.map((value, k) => (isNumber(value) && isNumber(simulated[k]) ? (value - simulated[k]) ** 2 : 0));
  let sum = error.slice(0, kMostSamples).reduce((total, value) => total + value, 0), largest = sum, begin = 0;
  for (let k = kMostSamples; k < error.length; ++k) {
    sum += error[k] - error[k - kMostSamples];
    if (sum > largest) [largest, begin] = [sum, k - kMostSamples + 1];
  }
  return begin;
}

/// The part of an experiment to draw: time [s], signals, and for each model the simulation and its limits.
function partOf(picture) {
  const begin = worstStretch(picture), part = values => values.slice(begin, begin + kMostSamples);
  const model = name => {
    const simulated = part(picture['simulated_' + name]), deviation = part(picture['deviation_' + name]);
    const limit = side => simulated.map((value, k) => (isNumber(value) && isNumber(deviation[k]) ? value + side * kQuantile95 * deviation[k] : null));
    return {simulated, lower: limit(-1), upper: limit(1)};
  };
  return {time: part(picture.measured).map((value, k) => (begin + k) * picture.sample_time),
          input: part(picture.input), measured: part(picture.measured), before: model('before'), after: model('after')};
}

function shareOutside(measured, {lower, upper}) {
  const valid = measured.map((value, k) => k).filter(k => isNumber(measured[k]) && isNumber(lower[k]));
  return valid.filter(k => measured[k] < lower[k] || measured[k] > upper[k]).length / valid.length;
}

function simulationDatasets({time, measured}, {simulated, lower, upper}, color) {
  return [
    {showLine: false, pointRadius: 1.6, pointStyle: 'circle', data: points(time, measured), borderColor: kInk, backgroundColor: kInk,
     describe: k => [`${number(time[k])} s`, `measured ${number(measured[k])}`,
                     `simulated ${number(simulated[k])} (95\u00a0%: ${number(lower[k])} to ${number(upper[k])})`]},
    {label: 'simulated', data: points(time, simulated), borderColor: color, backgroundColor: color, borderWidth: 1.5},
    ...bandDatasets(time, [{level: 0.95, lower, upper}], color)];
}

/// A figure that can be switched to another experiment; `datasets` and `axes` are functions of the part drawn.
function followingFigure(parent, part, content) {
  const chart = figure(parent, {...content, datasets: content.datasets(part), axes: content.axes(part)});
  return shown => {
    chart.data.datasets = content.datasets(shown);
    Object.assign(chart.options.scales, content.axes(shown));
    chart.update();
  };
}

function timeAxis({time}) {
  return linearAxis('time [s]', {min: time[0], max: time[time.length - 1]});
}

/// Both models on the same scale.
function outputAxis({measured, before, after}) {
  const values = [measured, before.lower, before.upper, after.lower, after.upper].flat().filter(isNumber);
  const largest = Math.max(...values), least = Math.min(...values), margin = 0.04 * (largest - least);
  return aligningAxis(linearAxis('y', {min: least - margin, max: largest + margin}));
}

function showSimulated(parent, {pictures, causes}) {
  if (pictures.length === 0) {
    parent.append(paragraph('This explanation contains no signals of experiments; those that the model of identify simulates are drawn above.'));
    return;
  }
  const parts = pictures.map(partOf), models = causes.length > 0 ? ['before', 'after'] : ['before'], followers = [];
  const sentence = part => 'Samples outside the 95\u00a0% band: ' + models.map(model => inPercent(100 * shareOutside(part.measured, part[model]), 2) +
    (causes.length === 0 ? '' : model === 'before' ? ' without the causes' : ' with them')).join(', ');
  const note = paragraph(sentence(parts[0]));
  if (parts.length > 1) {
    parent.append(element('div', {class: 'choices'}, choice('experiment', 'Experiment', pictures.map(({id}, value) => ({value, title: id})), index => {
      note.textContent = sentence(parts[index]);
      followers.forEach(follow => follow(parts[index]));
    })));
  }
  parent.append(note);
  for (const model of models) {
    const color = model === 'before' ? kColorBefore : kColorAfter;
    followers.push(followingFigure(parent, parts[0], {
      title: causes.length === 0 ? 'Measured and simulated' : `Measured and simulated ${model === 'before' ? 'without' : 'with'} the causes`, height: 270,
      caption: 'Dots: measured. Line: simulation from the input alone, with the relative error estimated for this experiment. Shaded: ' +
        '95\u00a0% of the samples should lie there. ' +
        (Math.max(...pictures.map(({measured}) => measured.length)) > kMostSamples ? `Only the ${count(kMostSamples)} samples are drawn in which the simulation without the causes is worst.` : ''),
      datasets: part => simulationDatasets(part, part[model], color), axes: part => ({x: timeAxis(part), y: outputAxis(part)})}));
  }
  followers.push(followingFigure(parent, parts[0], {
    title: 'Input of this experiment', height: 170, caption: 'Its value is held from one sample to the next.',
    datasets: ({time, input}) => [{data: points(time, input), stepped: 'before', borderColor: kInk, backgroundColor: kInk, borderWidth: 1.2,
                                   describe: k => [`${number(time[k])} s`, `u ${number(input[k])}`]}],
    axes: part => ({x: timeAxis(part), y: aligningAxis(linearAxis('u', {grace: '4%'}))})}));
}
