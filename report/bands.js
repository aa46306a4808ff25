'use strict';
// Figures with bands at all levels, and the buttons that select which kind of bands they show.

function hasBands(bands) {
  return Boolean(bands && bands.pointwise.length > 0);
}

/// Which bands are drawn. All figures share this choice and are notified when it changes.
class BandChoice {
  /// withSpread: whether the plants differ between experiments; otherwise the bands only show how accurately one
  /// plant is known.
  constructor(withSpread) {
    this.withSpread = withSpread;
    this.source = 'total';
    this.kind = 'pointwise';
    this.followers = [];
  }

  /// The chosen bands of {mixture, total}; those of the mixture if the errors of the estimate are not known; [] if
  /// there are none.
  of(bands) {
    if (!bands) return [];
    const chosen = hasBands(bands[this.source]) ? bands[this.source] : bands.mixture;
    return hasBands(chosen) ? chosen[this.kind] : [];
  }

  set(change) {
    Object.assign(this, change);
    this.followers.forEach(follow => follow());
  }
}

function showBandChoice(parent, bands, choices) {
  const frequency = bands.frequency;
  const controls = [choice('kind', 'Bands hold', [
    {value: 'pointwise', title: 'at each point separately'}, {value: 'simultaneous', title: 'at all points together'}],
    kind => choices.set({kind}))];
  if (choices.withSpread && hasBands(frequency.magnitude_bands.total)) {
    controls.push(choice('source', 'They count', [
      {value: 'total', title: 'spread of the plants and errors of the estimate'},
      {value: 'mixture', title: 'spread of the plants only'}], source => choices.set({source})));
  }
  parent.append(element('div', {class: 'choices'}, ...controls));
}

/// What the bands mean, for captions.
function bandsInWords(choices, withTotal) {
  const where = choices.kind === 'pointwise' ? 'at each point separately' : 'at all points together';
  if (!choices.withSpread) return `Shaded: the plant lies there with the stated probability, ${where}, given the errors of the estimate.`;
  const errors = `the errors of the estimate are${choices.source === 'total' && withTotal ? '' : ' not'} included`;
  return `Shaded: the stated share of the plants lies there, ${where}; ${errors}.`;
}

/// A figure of a nominal curve in bands. spec: figure()'s title, caption, height and axes, and
///   x, nominal, bands ({mixture, total}), toAxis (value to axis), describe (index, chosen bands), stepped.
function bandFigure(parent, spec, choices) {
  const datasets = () => {
    const chosen = choices.of(spec.bands);
    const shown = chosen.map(band => ({level: band.level, lower: band.lower.map(spec.toAxis), upper: band.upper.map(spec.toAxis)}));
    const line = {label: 'nominal model', data: points(spec.x, spec.nominal.map(spec.toAxis)), borderColor: kInk,
                  backgroundColor: kInk, stepped: spec.stepped, describe: k => spec.describe(k, chosen)};
    return [line, ...bandDatasets(spec.x, shown, kColors[0], {stepped: spec.stepped})];
  };
  const words = () => spec.caption + (spec.bands ? ' ' + bandsInWords(choices, hasBands(spec.bands.total)) : '');
  const chart = figure(parent, {...spec, caption: words(), datasets: datasets(), mode: 'index'});
  const caption = chart.canvas.closest('figure').querySelector('figcaption');
  choices.followers.push(() => {
    chart.data.datasets = datasets();
    chart.update();
    caption.textContent = words();
  });
  return chart;
}
