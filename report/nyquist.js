'use strict';
// The response in the complex plane, with the regions that contain shares of the plants.

function extent(values) {
  return [Math.min(...values), Math.max(...values)];
}

function nyquistCurve({omega, magnitude, phase}) {
  return {
    label: 'nominal model', borderColor: kInk, backgroundColor: kInk,
    data: omega.map((value, k) => ({x: magnitude[k] * Math.cos(phase[k]), y: magnitude[k] * Math.sin(phase[k])})),
    describe: k => [`${number(omega[k])} rad/s`, `|G| ${number(magnitude[k])}, phase ${number(degrees(phase[k]))}\u00b0`,
      `real ${number(magnitude[k] * Math.cos(phase[k]))}, imaginary ${number(magnitude[k] * Math.sin(phase[k]))}`]};
}

const kMostRegions = 9;

/// The frequencies whose regions are drawn: evenly spaced along the curve, because more would hide each other, and only where
/// the plant answers.
function regionFrequencies(regions, {omega, magnitude, phase}) {
  const limit = 0.05 * Math.max(...magnitude), corners = regions.map(region => region.omega);
  const candidates = [...new Set(corners)].map(value => omega.findIndex(other => other >= value * (1 - 1e-9))).filter(k => k >= 0 && magnitude[k] >= limit);
  const at = k => [magnitude[k] * Math.cos(phase[k]), magnitude[k] * Math.sin(phase[k])];
  const lengths = candidates.map(() => 0);
  for (let i = 1; i < candidates.length; ++i) {
    const [x, y] = at(candidates[i]), [px, py] = at(candidates[i - 1]);
    lengths[i] = lengths[i - 1] + Math.hypot(x - px, y - py);
  }
  const apart = lengths[lengths.length - 1] / (kMostRegions - 1), chosen = [];
  let next = 0;
  candidates.forEach((k, i) => {
    if (lengths[i] < next) return;
    chosen.push(omega[k]);
    next = lengths[i] + 0.999 * apart;
  });
  return chosen;
}

function regionDatasets(regions, level, chosen) {
  const near = region => chosen.some(value => Math.abs(value / region.omega - 1) < 1e-6);
  return regions.filter(region => region.level === level && near(region)).map((region, index) => {
    const corners = points(region.real, region.imaginary), color = kColors[[0, 2, 3][index % 3]];
    return {label: index === 0 ? `region of ${percent(level)}` : '', group: 'regions', data: [...corners, corners[0]],
            fill: 'shape', borderWidth: 1.2, borderColor: color, backgroundColor: color + '22', pointHitRadius: 0,
            describe: () => [`${number(region.omega)} rad/s`, `region of ${percent(level)}`]};
  });
}

/// The smallest box around the regions and the curve, with a margin.
function nyquistBox(datasets) {
  const all = datasets.flatMap(dataset => dataset.data);
  const box = {x: extent(all.map(point => point.x)), y: extent(all.map(point => point.y))};
  const margin = 0.04 * Math.max(box.x[1] - box.x[0], box.y[1] - box.y[0], 1e-12);
  return {x: [box.x[0] - margin, box.x[1] + margin], y: [box.y[0] - margin, box.y[1] + margin]};
}

function showNyquist(parent, result, frequency) {
  const regions = hasBounds(result) ? result.bounds.regions : [];
  const levels = [...new Set(regions.map(region => region.level))];
  const preferred = levels.includes(0.95) ? 0.95 : levels[levels.length - 1];
  const chosen = regionFrequencies(regions, frequency);
  const datasets = level => [nyquistCurve(frequency), ...regionDatasets(regions, level, chosen)];
  const chart = figure(parent, {
    title: 'Complex plane (Nyquist)', height: 400, datasets: datasets(preferred),
    caption: 'G(e^(j\u03c9Ts)) from the lowest frequency to the highest' + (regions.length > 0 ?
      `. Each polygon contains the ${hasErrorModel(result) ? 'stated share of the plants' : 'plant with the stated probability'} at one frequency, ` +
      `including the errors of the estimate if they are known; ${counted(chosen.length, 'frequency', 'frequencies')} of many, where the plant answers.` : '.'),
    axes: {x: linearAxis(`real part [${kGainUnit}]`), y: linearAxis(`imaginary part [${kGainUnit}]`)}});
  const fit = () => chart.chartArea && chart.chartArea.width > 0 && equalUnits(chart, nyquistBox(chart.data.datasets));
  chart.fit = fit;
  chart.options.onResize = () => setTimeout(fit);
  fit();
  if (levels.length < 2) return;
  chart.canvas.parentNode.after(element('div', {class: 'choices'}, choice('level', 'Regions contain',
    levels.map(level => ({value: level, title: percent(level)})), level => {
      chart.data.datasets = datasets(level);
      fit();
    }, preferred)));
}
