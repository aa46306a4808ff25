'use strict';
// The plant in physical terms: gain, time constants, natural frequencies, damping, dead time and bandwidth.

const kPhysicalNames = {
  gain: 'static gain', velocity_gain: 'velocity gain (the plant integrates)', acceleration_gain: 'acceleration gain (it integrates twice)',
  time_constant: 'time constant', natural_frequency: 'natural frequency', damping: 'damping ratio', dead_time: 'dead time',
  alternating_pole: 'pole that alternates, z', bandwidth: 'bandwidth (\u22123 dB)'};

/// "time_constant_2" as "time constant 2".
function physicalName({name}) {
  const [, base, index] = name.match(/^(.*?)(?:_(\d+))?$/);
  return (kPhysicalNames[base] || base) + (index ? ' ' + index : '');
}

/// Between runs, as a share of the value.
function relativeSpread({value, spread}) {
  return isNumber(spread) && value !== 0 ? spread / Math.abs(value) : null;
}

function showPhysical(parent, result) {
  const {numbers} = result.physical || {numbers: []};
  if (numbers.length === 0) return;
  const withSpread = numbers.some(({spread}) => isNumber(spread));
  const columns = [{title: 'Quantity'}, {title: 'Value', number: true}, {title: '95\u00a0% interval', number: true},
                   ...(withSpread ? [{title: 'Spread', number: true}] : [])];
  const rows = numbers.map(entry => {
    const {value, lower_95: lower, upper_95: upper} = entry, share = relativeSpread(entry);
    const known = isNumber(lower) && isNumber(upper);
    return [physicalName(entry), number(value, 3) + (entry.unit ? '\u00a0' + entry.unit : ''), known ? `${number(lower, 3)} to ${number(upper, 3)}` : kNone,
            ...(withSpread ? [share === null ? kNone : inPercent(100 * share, 2)] : [])];
  });
  const known = numbers.some(({lower_95: lower}) => isNumber(lower));
  const meaning = (known ? 'The interval says how accurately the nominal plant is known.' : 'No intervals were computed.') +
    (withSpread ? ' The spread is the standard deviation between runs; a dash: the error model does not vary it.' : '') +
    ` Gains: ${kGainUnit}.`;
  parent.append(element('h2', {id: 'numbers'}, 'The plant in numbers'), element('div', {class: 'numbers'}, table(columns, rows)), paragraph(meaning, 'note'));
}
