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

function regionDatasets(regions, level) {
  return regions.filter(region => region.level === level).map((region, index) => {
    const corners = points(region.real, region.imaginary);
    return {label: index === 0 ? `region of ${percent(level)}` : '', group: 'regions', data: [...corners, corners[0]],
            fill: 'shape', borderWidth: 1, borderColor: 'rgba(0, 114, 178, 0.45)', backgroundColor: 'rgba(0, 114, 178, 0.13)',
            pointHitRadius: 0};
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
  const datasets = level => [nyquistCurve(frequency), ...regionDatasets(regions, level)];
  const chart = figure(parent, {
    title: 'Complex plane (Nyquist)', height: 400, datasets: datasets(preferred),
    caption: 'G(e^(j\u03c9Ts)) from the lowest frequency to the highest' + (regions.length > 0 ?
      `. Each polygon contains the ${hasErrorModel(result) ? 'stated share of the plants' : 'plant with the stated probability'} at one frequency, ` +
      'including the errors of the estimate if they are known.' : '.'),
    axes: {x: linearAxis(`real part [${kGainUnit}]`), y: linearAxis(`imaginary part [${kGainUnit}]`)}});
  const fit = () => chart.chartArea && equalUnits(chart, nyquistBox(chart.data.datasets));
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
