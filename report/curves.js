'use strict';
// What the free simulation of a linear plant lacks: curves at places of the simulation (explanation.json, "simulation").

/// "input: dead_zone".
function placeAndShape({place, shape, covariate}) {
  return `${place}${covariate ? ` [${covariate}]` : ''}${shape === place ? '' : `: ${shape}`}`.replace(/_/g, ' ');
}

function characteristicFigure(parent, cause) {
  const {of, unit, signal, value, lower_90: lower, upper_90: upper} = cause.curve;
  const values = unit === '1' ? 'factor by which the input acts, less 1' : `in units of the ${unit}`;
  figure(parent, {
    title: `Curve: ${placeAndShape(cause)}`, height: 260,
    caption: `Band: 90\u00a0%, at each point. ${['input', 'sensor'].includes(cause.place) ? 'The whole characteristic.' :
      'What is added to the linear plant; a straight line belongs to the plant and is left out.'}`,
    datasets: [{label: 'curve', data: points(signal, value), borderColor: kColorAfter, backgroundColor: kColorAfter, borderWidth: 1.5,
                describe: k => [`${of} ${number(signal[k])}`, `${number(value[k])} (90\u00a0%: ${number(lower[k])} to ${number(upper[k])})`]},
               ...bandDatasets(signal, [{level: 0.9, lower, upper}], kColorAfter)],
    axes: {x: linearAxis(of, {min: signal[0], max: signal[signal.length - 1]}), y: linearAxis(values)}});
}

function windowFigure(parent, {experiment, start, sample_time: step, measured, before, after}, changed) {
  const time = measured.map((value, k) => start + k * step);
  const line = (label, values, color) =>
    ({label, data: points(time, values), borderColor: color, backgroundColor: color, borderWidth: 1.5,
      describe: k => [`${label}: ${number(values[k])} at ${number(time[k])}\u00a0s`]});
  figure(parent, {
    title: `Not used for fitting: ${experiment}`, height: 260, caption: '',
    datasets: [{...line('measured', measured, kInk), showLine: false, pointRadius: 1.6, pointStyle: 'circle'},
               line(changed ? 'without the causes' : 'simulated', before, kColorBefore),
               ...(changed ? [line('with them', after, kColorAfter)] : [])],
    axes: {x: linearAxis('time [s]', {min: time[0], max: time[time.length - 1]}), y: linearAxis('output')}});
}

function showSimulationSearch(parent, {simulation}) {
  const fit = value => `${number(value, 3)}\u00a0%`, {causes} = simulation;
  if (simulation.skipped) {
    const compared = simulation.preparation ? ` One linear plant fits ${fit(simulation.fit_before)} of what was held out.` : '';
    parent.append(paragraph(`The free simulation was not searched for curves: ${simulation.skipped}.${compared}`));
    for (const picture of simulation.pictures) windowFigure(parent, picture, false);
    return;
  }
  parent.append(paragraph(`${asSentence(simulation.preparation)} ${causes.length === 0 ?
    `No curve makes the simulation of a linear plant better; it fits ${fit(simulation.fit_before)} of what was held out.` :
    `The fit of what was held out rises from ${fit(simulation.fit_before)} to ${fit(simulation.fit_after)}.`}`));
  if (causes.length > 0)
    parent.append(table([{title: 'Place and shape'}, {title: 'Explains as well'}, {title: 'Fit held out [%]', number: true}],
      causes.map(cause => [placeAndShape(cause), cause.ties.map(placeAndShape).join(', ') || kNone,
                           `${number(cause.fit_before, 3)} \u2192 ${number(cause.fit_after, 3)}`])));
  for (const cause of causes) if (cause.curve.signal.length > 0) characteristicFigure(parent, cause);
  for (const picture of simulation.pictures) windowFigure(parent, picture, causes.length > 0);
}
