'use strict';
// Figures: Chart.js with this report's axes, tooltips and colours (by Okabe and Ito, distinct for the colour-blind).

const kColors = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const kInk = '#1a1a1a';
const kGrid = 'rgba(0, 0, 0, 0.09)';

/// A tint between white (0) and the colour (1).
function tint(color, amount) {
  const mixed = [1, 3, 5].map(k => Math.round(255 + amount * (parseInt(color.slice(k, k + 2), 16) - 255)));
  return `rgb(${mixed.join(', ')})`;
}

function componentColor(component) {
  return kColors[component % kColors.length];
}

function linearAxis(title, more = {}) {
  return {type: 'linear', title: {display: true, text: title, color: kInk, font: {size: 13}},
          grid: {color: kGrid, z: 1, offset: false}, ...more,
          ticks: {color: kInk, callback: value => number(value, 6), maxRotation: 0, includeBounds: false, ...more.ticks}};
}

/// An axis of equal width in all figures, so that figures below each other are aligned.
function aligningAxis(axis) {
  return {...axis, afterFit: scale => { scale.width = 72; }};
}

/// Labels at powers of ten, and at 2 and 5 times them if there are few.
function logarithmicAxis(title, minimum, maximum) {
  const few = Math.log10(maximum / minimum) < 1.7;
  const label = value => {
    const mantissa = Number((value / 10 ** Math.floor(Math.log10(value) + 1e-9)).toPrecision(6));
    return mantissa === 1 || (few && (mantissa === 2 || mantissa === 5)) ? number(value) : '';
  };
  return {...linearAxis(title), type: 'logarithmic', min: minimum, max: maximum,
          ticks: {color: kInk, callback: label, autoSkip: false, maxRotation: 0}};
}

/// Each dataset may have describe(index), which gives the tooltip's lines, and a group: datasets of one group
/// are shown and hidden together from the legend, where the one with a label stands.
function options(axes, mode, datasets) {
  const lines = datasets.some(({label, showLine}) => label && showLine !== false);
  return {
    animation: false, maintainAspectRatio: false, devicePixelRatio: Math.max(2, window.devicePixelRatio),
    interaction: {mode, intersect: false}, scales: axes,
    elements: {point: {radius: 0, hitRadius: 4, hoverRadius: 4}, line: {borderWidth: 2}},
    plugins: {
      legend: {labels: {color: kInk, usePointStyle: true, pointStyleWidth: lines ? 24 : undefined, boxHeight: 8, generateLabels: legendLabels},
               onClick: (event, item, legend) => toggleGroup(legend.chart, item.datasetIndex)},
      tooltip: {filter: item => Boolean(item.dataset.describe), displayColors: false,
                callbacks: {title: () => '', label: item => item.dataset.describe(item.dataIndex)}},
    },
  };
}

/// Legend symbols: a line for lines, a box for shaded areas, their own shape for points.
function legendLabels(chart) {
  return Chart.defaults.plugins.legend.labels.generateLabels(chart).filter(item => item.text).map(item => {
    const {fill, showLine, borderDash} = chart.data.datasets[item.datasetIndex];
    if (showLine === false) return {...item, rotation: 0};
    return {...item, pointStyle: fill ? 'rect' : 'line', lineWidth: fill ? 1 : 2, lineDash: fill ? [] : borderDash};
  });
}

/// The point nearest to the pointer among those that have a description, so not the edges of bands and ellipses.
function nearestDescribed(chart, event) {
  let nearest = [], least = Infinity;
  for (const {data, index: datasetIndex} of chart.getSortedVisibleDatasetMetas()) {
    if (!chart.data.datasets[datasetIndex].describe) continue;
    data.forEach((point, index) => {
      const distance = Math.hypot(point.x - event.x, point.y - event.y);
      if (distance < least) [nearest, least] = [[{element: point, datasetIndex, index}], distance];
    });
  }
  return nearest;
}

function toggleGroup(chart, index) {
  const visible = !chart.isDatasetVisible(index);
  const group = chart.data.datasets[index].group;
  chart.data.datasets.forEach((dataset, k) => {
    if (k === index || (group !== undefined && dataset.group === group)) chart.setDatasetVisibility(k, visible);
  });
  chart.update();
}

/// A figure with its title above, its canvas of the given height [px] and its caption below.
function figure(parent, {title, caption, height, datasets, axes, mode = 'described', type = 'line'}) {
  const canvas = element('canvas', {role: 'img', 'aria-label': title});
  const frame = element('div', {class: 'canvas', style: `height: ${height}px`}, canvas);
  parent.append(element('figure', {}, element('b', {}, title), frame, element('figcaption', {}, caption)));
  Chart.Interaction.modes.described = nearestDescribed;
  return new Chart(canvas, {type, data: {datasets}, options: options(axes, mode, datasets)});
}

function points(x, y) {
  return x.map((value, k) => ({x: value, y: y[k]}));
}

/// The datasets of nested bands, the narrowest in front. Each is shaded from its upper limit down to its lower one,
/// or to the axis if there is no lower one.
function bandDatasets(x, bands, color, more = {}) {
  const drawn = [];
  bands.forEach(({level, lower, upper}, k) => {
    const shade = tint(color, bands.length === 1 ? 0.35 : 0.62 - 0.48 * k / (bands.length - 1));
    const shared = {group: 'band' + level, borderColor: shade, backgroundColor: shade, borderWidth: 1, ...more};
    drawn.push({...shared, label: percent(level), data: points(x, upper), fill: lower ? '+1' : 'start'});
    if (lower) drawn.push({...shared, data: points(x, lower), fill: false});
  });
  return drawn;
}

const kPrintWidth = 680;  // [px] of a page's text
const kPrintRunWidth = 215;  // of a figure that has two others beside it

/// Draws all figures again in the width of a printed page, and back: if they were scaled down from the width of the
/// screen, their labels would be too small.
function printFigures() {
  const redraw = size => Object.values(Chart.instances).forEach(chart => {
    chart.resize(...size(chart));
    if (chart.fit) chart.fit();
  });
  window.addEventListener('beforeprint', () => redraw(chart => [chart.canvas.closest('.runs') ? kPrintRunWidth : kPrintWidth, chart.height]));
  window.addEventListener('afterprint', () => redraw(() => []));
}

/// Makes one unit equally long on both axes; the box {x: [min, max], y: [min, max]} stays visible.
function equalUnits(chart, box) {
  for (let pass = 0; pass < 2; ++pass) {  // twice, because labels, and with them the space left for the figure, change with the limits
    const {width, height} = chart.chartArea;
    const unit = Math.max((box.x[1] - box.x[0]) / width, (box.y[1] - box.y[0]) / height) / 2;
    for (const [axis, size] of [['x', width], ['y', height]]) {
      const middle = (box[axis][0] + box[axis][1]) / 2;
      Object.assign(chart.options.scales[axis], {min: middle - unit * size, max: middle + unit * size});
    }
    chart.update('none');
  }
}
