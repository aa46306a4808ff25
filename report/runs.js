'use strict';
// Measured against simulated: the best, the median and the worst run of those fitted to and of those held out.

const kRunRanks = {best: 'best', median: 'median', worst: 'worst'};

function runTime(run) {
  return run.measured.map((value, k) => k * run.time_step);
}

function runDatasets(run) {
  const time = runTime(run), band = run.lower.length > 0, shade = tint(kColors[0], 0.25);
  const line = (values, color, more) => ({data: points(time, values), borderColor: color, backgroundColor: color, borderWidth: 1.3, ...more});
  const describe = k => [`${number(time[k])} s`, `measured ${number(run.measured[k])}`, `simulated ${number(run.simulated[k])}`,
                         ...(band ? [`${percent(run.level)}: ${number(run.lower[k])} to ${number(run.upper[k])}`] : [])];
  const datasets = [line(run.measured, kInk, {describe}), line(run.simulated, kColors[1])];
  if (band) datasets.push(line(run.upper, shade, {fill: '+1', borderWidth: 0}), line(run.lower, shade, {borderWidth: 0}));
  return datasets;
}

/// One scale for all figures of a row, so that they can be compared.
function runAxis(runs) {
  const values = runs.flatMap(run => [run.measured, run.simulated, run.lower, run.upper]).flat().filter(isNumber);
  const [least, largest] = extent(values), margin = 0.04 * (largest - least) || 1;
  return () => linearAxis('y', {suggestedMin: least - margin, suggestedMax: largest + margin, ticks: {maxTicksLimit: 6}});
}

function showRow(parent, runs, set) {
  const row = element('div', {class: 'runs'}), axis = runAxis(runs);
  parent.append(row);
  for (const run of runs) {
    const time = runTime(run);
    figure(row, {
      title: runs.length > 1 ? `${set}, ${kRunRanks[run.rank]} run` : set, height: 190, mode: 'index', datasets: runDatasets(run),
      caption: `${run.id}: fit ${isNumber(run.fit_percent) ? inPercent(run.fit_percent, 3) : 'unknown, the output is constant'}`,
      axes: {x: linearAxis('time [s]', {min: 0, max: time[time.length - 1], ticks: {maxTicksLimit: 6}}), y: axis()}});
  }
}

function showRuns(parent, result) {
  const runs = result.runs || [];
  if (runs.length === 0) return;
  const held = runs.filter(run => run.validation), fitted = runs.filter(run => !run.validation);
  const banded = runs.find(run => run.lower.length > 0);
  parent.append(element('h2', {id: 'runs'}, 'Measured against simulated'),
    paragraph('Black: measured. Orange: the nominal model, simulated from the input alone; the fit is 100\u00a0% if the two are equal and 0\u00a0% if ' +
      'the simulation is no better than the mean.' +
      (banded ? ` Shaded: ${percent(banded.level)} of new experiments lie there at all times; it is wide because runs differ and are noisy ` +
        '(calibrated on experiments to which the model was not fitted).' : '')));
  if (fitted.length > 0) showRow(parent, fitted, 'Used for fitting');
  if (held.length > 0) showRow(parent, held, 'Validation');
}
