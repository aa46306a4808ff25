'use strict';
// Numbers as text for people, with only as many digits as are significant.

const kNone = '\u2013';

function isNumber(value) {
  return typeof value === 'number' && Number.isFinite(value);
}

function withMinus(text) {
  return text.replace(/-/g, '\u2212');
}

function superscript(text) {
  const digits = {'-': '\u207b', 0: '\u2070', 1: '\u00b9', 2: '\u00b2', 3: '\u00b3', 4: '\u2074',
                  5: '\u2075', 6: '\u2076', 7: '\u2077', 8: '\u2078', 9: '\u2079'};
  return String(text).replace(/[-0-9]/g, character => digits[character]);
}

function isAwkward(value) {
  return value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6);
}

/// A number with the given number of significant digits, without trailing zeros; a dash for null (not a number).
function number(value, digits = 4) {
  if (!isNumber(value)) return kNone;
  if (!isAwkward(value)) return withMinus(String(Number(value.toPrecision(digits))));
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  return withMinus(String(Number(mantissa))) + ' \u00d7 10' + superscript(Number(exponent));
}

function fixed(value, decimals) {
  return isNumber(value) ? withMinus(value.toFixed(decimals)) : kNone;
}

function count(value) {
  return isNumber(value) ? value.toLocaleString('en') : kNone;
}

function counted(amount, singular, plural = singular + 's') {
  return count(amount) + ' ' + (amount === 1 ? singular : plural);
}

/// A percentage, with a space that no line break separates from the sign.
function inPercent(value, digits = 4) {
  return number(value, digits) + '\u00a0%';
}

function percent(share) {
  return inPercent(100 * share);
}

/// An estimate and its standard error, both to the second significant digit of the error.
function withError(value, error) {
  if (!isNumber(value) || !isNumber(error) || error <= 0) {
    return {value: number(value, 5), error: error === 0 ? '0' : kNone};
  }
  const largest = Math.max(Math.abs(value), error);
  const exponent = isAwkward(largest) ? Math.floor(Math.log10(largest)) : 0;
  const scale = 10 ** exponent;
  const decimals = Math.min(10, Math.max(0, 1 - Math.floor(Math.log10(error / scale))));
  const suffix = exponent === 0 ? '' : ' \u00d7 10' + superscript(exponent);
  return {value: fixed(value / scale, decimals) + suffix, error: fixed(error / scale, decimals) + suffix};
}

function plusMinus(value, error) {
  const text = withError(value, error);
  return text.error === kNone ? text.value : text.value + ' \u00b1 ' + text.error;
}

function vector(values) {
  return values.length === 1 ? number(values[0]) : '(' + values.map(value => number(value)).join(', ') + ')';
}

/// Texts of values in one row or column: all with as many decimals as distinguish them to three digits.
function aligned(values) {
  const numbers = values.filter(isNumber), largest = Math.max(...numbers.map(Math.abs));
  const spread = Math.max(...numbers) - Math.min(...numbers);
  if (numbers.length === 0 || isAwkward(largest)) return values.map(value => number(value));
  const decimals = spread > 0 ? 2 - Math.floor(Math.log10(spread)) : 4;
  return values.map(value => fixed(value, Math.min(6, Math.max(0, decimals))));
}

function matrix(rows) {
  return '[' + rows.map(row => row.map(value => number(value)).join(', ')).join('; ') + ']';
}

/// "a, b and c".
function listed(words) {
  return words.length < 2 ? words.join('') : words.slice(0, -1).join(', ') + ' and ' + words[words.length - 1];
}
