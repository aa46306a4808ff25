'use strict';
// What the user's own simulation gets wrong (explanation.json, "own_simulation").

function ownTable({causes}) {
  const interval = ({lower_95: lower, upper_95: upper}) =>
    isNumber(lower) && isNumber(upper) ? `${number(lower)} to ${number(upper)}` : kNone;
  return table([{title: 'Parameter'}, {title: 'Yours', number: true}, {title: 'Measured', number: true}, {title: '95\u00a0% interval', number: true},
                {title: 'Significance', number: true}, {title: 'Fit without this [%]', number: true}],
    causes.flatMap(cause => cause.values.map(value => [
      value.name + (value.unit && value.unit !== '1' ? ` [${value.unit}]` : ''), number(value.yours),
      withError(value.measured, value.standard_error).value, interval(value),
      isNumber(cause.t) ? `t = ${number(cause.t, 3)}` : kNone, number(cause.fit_without, 3)])));
}

function ownDatasets(run, time, changed) {
  const line = (values, color, more) => ({data: points(time, values), borderColor: color, backgroundColor: color, borderWidth: 1.3, ...more});
  const describe = k => [`${number(time[k])} s`, `measured ${number(run.measured[k])}`, `your simulation ${number(run.yours[k])}`,
                         ...(changed ? [`with the causes ${number(run.extended[k])}`] : [])];
  return [line(run.measured, kInk, {describe}), line(run.yours, kColorBefore), ...(changed ? [line(run.extended, kColorAfter)] : [])];
}

function ownRow(parent, runs, changed) {
  const row = element('div', {class: 'runs'});
  parent.append(row);
  const values = runs.flatMap(run => [run.measured, run.yours, run.extended]).flat().filter(isNumber);
  const [least, largest] = extent(values), margin = 0.04 * (largest - least) || 1;
  for (const run of runs) {
    const time = run.measured.map((value, k) => run.start + k * run.sample_time);
    figure(row, {
      title: `Not used for fitting, ${run.rank} run`, height: 190, mode: 'index', datasets: ownDatasets(run, time, changed),
      caption: `${run.id}: fit ${inPercent(run.fit_yours, 3)}${changed ? `, with the causes ${inPercent(run.fit_extended, 3)}` : ''}`,
      axes: {x: linearAxis('time [s]', {min: time[0], max: time[time.length - 1], ticks: {maxTicksLimit: 6}}),
             y: linearAxis('y', {suggestedMin: least - margin, suggestedMax: largest + margin, ticks: {maxTicksLimit: 6}})}});
  }
}

// Curves that halve the squared error: what was found without them may only stand for them.
function curveLeads({structure, has_curve_around: around, fit_after: fitAfter}) {
  const halves = fit => (100 - structure.fit_after) ** 2 < 0.5 * (100 - fit) ** 2;
  return !around && structure.causes.length > 0 && halves(structure.fit_before) && halves(fitAfter);
}

// Curves that it lacks: before, in and behind it.
function showOwnCurves(parent, {causes, skipped}) {
  for (const cause of causes) {
    const values = cause.values.map(({name, value, standard_error: error}) => {
      const told = withError(value, error);
      return `${name.replace(/_/g, ' ')} ${told.value} \u00b1 ${told.error}`;
    });
    parent.append(element('h3', {}, `${cause.name}: ${cause.description}`));
    if (values.length > 0) parent.append(paragraph(asSentence(listed(values))));
    if (cause.ties.length > 0)
      parent.append(paragraph(`Or ${listed(cause.ties.map(tie => `${tie.name} (${placeAndShape(tie)})`))}: the data cannot tell.`));
    parent.append(element('p', {class: 'advice'}, element('b', {}, 'What to do: '), asSentence(cause.advice)));
    if (cause.curve.signal.length > 0) characteristicFigure(parent, cause);
  }
  if (skipped) parent.append(paragraph(`About curves: ${skipped}.`));
}

function showOwnSimulation(parent, found) {
  const changed = found.causes.length > 0 || found.has_curve_around;
  parent.append(element('p', {class: 'verdict'}, asSentence(found.sentence)),
    paragraph(`Black: measured. Orange: ${found.simulation}.${changed ? ' Blue: the same with what it lacks.' : ''}`));
  ownRow(parent, found.runs, changed);
  showOwnCurves(parent, found.structure);
  if (found.causes.length === 0) return;
  parent.append(ownTable(found));
  if (curveLeads(found)) {
    parent.append(paragraph('These values may only stand for the curve: mend the curve first, and compare again.'));
    return;
  }
  for (const {name, parameter, description, remark, ties, advice} of found.causes) {
    parent.append(element('h3', {}, `${parameter || name}: ${description}`));
    if (remark || ties.length > 0)
      parent.append(paragraph([...(remark ? [asSentence(remark)] : []),
                               ...(ties.length > 0 ? [`Or ${listed(ties)}: the data cannot tell.`] : [])].join(' ')));
    parent.append(element('p', {class: 'advice'}, element('b', {}, 'What to do: '), asSentence(advice)));
  }
}
