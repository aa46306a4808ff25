'use strict';
// What it gains to include causes in the model, and how the effects that were tried compare.

/// Horizontal bars, one for each name, with whiskers if there are intervals: values, lower, upper.
function barFigure(parent, {title, caption, axis, names, values, intervals = [], color, describe}) {
  const whiskers = intervals.flatMap(({lower, upper}, k) => (isNumber(lower) && isNumber(upper)) ?
    [{type: 'line', borderColor: kInk, borderWidth: 2, data: [{x: lower, y: k + 1}, {x: upper, y: k + 1}],
      pointRadius: 6, pointStyle: 'line', pointRotation: 90, pointBorderWidth: 2, pointBorderColor: kInk}] : []);
  const ends = [...values, ...intervals.flatMap(({lower, upper}) => [lower, upper])].filter(isNumber);
  figure(parent, {
    title, caption, height: 76 + 27 * names.length, type: 'bar',
    datasets: [...whiskers, {data: values.map((value, k) => ({x: value, y: k + 1})), backgroundColor: color, indexAxis: 'y', barThickness: 15, describe}],
    axes: {x: linearAxis(axis, {offset: false, min: 1.05 * Math.min(0, ...ends), max: 1.05 * Math.max(0, ...ends)}),
           y: linearAxis('', {title: {display: false}, reverse: true, min: 0.5, max: names.length + 0.5, grid: {display: false},
                              afterBuildTicks: scale => { scale.ticks = names.map((name, k) => ({value: k + 1})); },
                              ticks: {autoSkip: false, callback: value => names[value - 1]}})}});
}

function gainTable(causes) {
  const plain = value => number(value, 3), change = ({before, after}) => `${plain(before)} \u2192 ${plain(after)}`;
  const share = value => (isNumber(value) ? plain(100 * value) : kNone);
  const shares = (gain, side) => [gain.coverage_50, gain.coverage_90, gain.coverage_95].map(coverage => share(coverage[side])).join(', ');
  return table([{title: 'Cause'}, {title: 'Log density [nats]', number: true}, {title: 'Simulation fit [%]', number: true},
                {title: 'In 50, 90, 95\u00a0% intervals [%]', number: true}, {title: 'Noise variance', number: true},
                {title: 'Area of the Bode region', number: true}],
    causes.map(cause => {
      const {gain} = cause;
      if (!gain) return [fullName(cause), ...Array(5).fill(kNone)];
      const density = gain.held_out_log_density_per_experiment;
      return [fullName(cause), isNumber(density.value) ? plusMinus(density.value, density.standard_error) : kNone, change(gain.nrmse_fit_percent),
              `${shares(gain, 'before')} \u2192 ${shares(gain, 'after')}`, change(gain.noise_variance), change(gain.bode_area)];
    }));
}

function showGain(parent, {causes, held_out: heldOut}) {
  const gained = causes.filter(({gain}) => gain && isNumber(gain.held_out_log_density_per_experiment.value));
  if (gained.length === 0) {
    const simulated = causes.some(({gain}) => gain);
    parent.append(paragraph(causes.length === 0 ? 'No cause was named, so there is no gain.' : simulated ?
      'The causes were found in the free simulation; what it gains is told there. The model with its noise does not contain them, so there is no gain of likelihood.' :
      'The named cause was found by a test and does not change predictions, so there is no gain.'));
    if (simulated) parent.append(gainTable(causes));
    return;
  }
  const measured = heldOut.length > 0 ? `${counted(heldOut.length, 'experiment')} not used for fitting` :
    'the experiments used for fitting, because there are too few to hold any out; the gains are therefore too large';
  parent.append(paragraph(`Measured on ${measured}. The gain of each cause is in addition to the gains of those above it.`));
  const densities = gained.map(cause => cause.gain.held_out_log_density_per_experiment);
  const intervals = densities.map(({lower_90: lower, upper_90: upper}) => ({lower, upper}));
  barFigure(parent, {
    title: heldOut.length > 0 ? 'Gain on experiments not used for fitting' : 'Gain on the experiments used for fitting', color: kColorAfter, names: gained.map(fullName), values: densities.map(({value}) => value),
    axis: 'log predictive density gained per experiment [nats]', intervals,
    caption: 'Whiskers: 90\u00a0% interval of the mean over the experiments. One nat makes the data 2.7 times as probable.',
    describe: k => [fullName(gained[k]), `${plusMinus(densities[k].value, densities[k].standard_error)} nats per experiment`]});
  parent.append(gainTable(causes));
  parent.append(paragraph('Before \u2192 after. If the model is right, 50\u00a0% of the samples lie in 50\u00a0% intervals. The region of the Bode diagram that ' +
    'contains 95\u00a0% of the plants is measured in decades of frequency times decades of magnitude.', 'note'));
}

function showTried(parent, {candidates, causes}) {
  if (candidates.length === 0) {
    parent.append(paragraph('No effect was tried.'));
    return;
  }
  const ordered = [...candidates].sort((one, other) => other.score - one.score);
  const named = effect => causes.some(cause => fullName(cause) === fullName(effect));
  barFigure(parent, {
    title: 'Score of each effect', color: ordered.map(effect => (named(effect) ? kColorAfter : tint(kColorAfter, 0.45))),
    axis: 'log-likelihood gained, less a penalty for parameters and starts [nats]', names: ordered.map(fullName), values: ordered.map(({score}) => score),
    caption: 'On the experiments used for fitting. Dark: named as a cause. Effects that resemble a cause score well, too, as long as it is not in the model.',
    describe: k => [fullName(ordered[k]), `score ${number(ordered[k].score)} nats`]});
  parent.append(scrolling(table([{title: 'Effect'}, {title: 'Score [nats]', number: true}, {title: 'Gain per experiment held out [nats]', number: true}],
    ordered.map(effect => [fullName(effect), number(effect.score), plusMinus(effect.held_out_gain, effect.standard_error)]),
    index => named(ordered[index])), ordered.length));
}
