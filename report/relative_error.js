'use strict';
// The multiplicative uncertainty |G/Go - 1| and the weight W that bounds it, for robust control.

function showRelativeError(parent, result, choices) {
  const {frequency, weight} = result.bounds, Ts = result.nominal_model.sample_time;
  const last = answeringPoints(frequency), omega = frequency.omega.slice(0, last);
  const note = last < frequency.omega.length ? 'Drawn where the plant answers: beyond, |Go| is less than a hundredth of its largest value and its relative error harms nobody. ' : '';
  const cut = bands => bands.map(({level, lower, upper}) => ({level, lower: lower.slice(0, last), upper: upper.slice(0, last)}));
  const cover = weight ? omega.map(value => magnitudeOf(weight.num, weight.den, value * Ts)) : null;
  const describe = k => [`${number(omega[k])} rad/s`, ...(cover ? [`|W|: ${number(cover[k], 3)}`] : []),
    ...cut(choices.of(frequency.relative_error)).map(band => `${percent(band.level)}: up to ${number(band.upper[k], 3)}`)];
  const limits = errorLimits(frequency.relative_error, cover, cut);
  const datasets = () => {
    const bands = cut(choices.of(frequency.relative_error)).map(({level, upper}) => ({level, upper: upper.map(value => Math.max(value, limits[0]))}));
    const drawn = bandDatasets(omega, bands, kColors[2]);
    drawn[0].describe = describe;
    if (cover) drawn.unshift({label: `weight |W|, for ${percent(weight.level)} at all frequencies`, data: points(omega, cover),
                              borderColor: kColors[1], backgroundColor: kColors[1], borderDash: [7, 4], describe});
    if (cover) delete drawn[1].describe;
    return drawn;
  };
  const words = () => note + (cover ? 'The weight lies above the bound that is valid at all frequencies together. ' : '') +
    bandsInWords(choices, hasBands(frequency.relative_error.total));
  const chart = figure(parent, {
    title: 'Relative error |G/Go \u2212 1|', height: 330, datasets: datasets(), mode: 'index',
    caption: words(),
    axes: {x: frequencyAxis(omega), y: aligningAxis(logarithmicAxis('|G/Go \u2212 1| [1]', ...limits))}});
  choices.followers.push(() => {
    chart.data.datasets = datasets();
    chart.update();
    chart.canvas.closest('figure').querySelector('figcaption').textContent = words();
  });
  showWeight(parent, weight);
}

/// Limits of the axis that show the bounds and the weight, at most five decades: |G/Go - 1| may vanish at low
/// frequencies.
function errorLimits(bands, cover, cut) {
  const all = ['mixture', 'total'].filter(source => hasBands(bands[source]))
    .flatMap(source => cut([...bands[source].simultaneous, ...bands[source].pointwise]).flatMap(band => band.upper)).concat(cover || []);
  const positive = all.filter(value => value > 0);
  if (positive.length === 0) return [1e-3, 1];
  const largest = Math.max(...positive), decade = 10 ** Math.floor(Math.log10(largest));
  const lowest = 10 ** Math.floor(Math.log10(Math.min(...positive)));
  return [Math.max(decade / 1e4, lowest), [1, 2, 5, 10].find(factor => factor * decade >= largest) * decade];
}

function showWeight(parent, weight) {
  if (!weight) {
    parent.append(paragraph('There is no weight for robust control, because the plants do not differ.'));
    return;
  }
  const degree = values => values.length - 1;
  const continuous = weight.continuous;
  parent.append(paragraph('For robust control: G = Go (1 + W \u0394) with |\u0394| \u2264 1. ' +
    `W, of order ${weight.order}, is stable and minimum phase. It bounds the relative error of ${percent(weight.level_held)} of the drawn plants at all ` +
    `frequencies (requested: ${percent(weight.level)}). |W| is ${number(weight.over_bounding_median, 4)} times the bound in the median and ` +
    `${number(weight.over_bounding_max, 4)} times at most, checked at ${count(weight.check_frequencies)} frequencies.`));
  parent.append(formula('W(z) = ', fraction(polynomial(weight.num, 'z'), polynomial(weight.den, 'z'))),
    formula('W(s) = ', fraction(polynomial(continuous.num, 's', degree(continuous.num)), polynomial(continuous.den, 's', degree(continuous.den))),
      element('span', {class: 'note'}, ' by Tustin\u2019s rule')));
}
