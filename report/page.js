'use strict';
// Builds the page. Text from the result is inserted as text nodes only, so that an id cannot become markup.

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children.filter(child => child !== null));
  return node;
}

function paragraph(text, style) {
  return element('p', style ? {class: style} : {}, text);
}

function section(parent, id, title) {
  const node = element('section', {id}, element('h2', {}, title));
  parent.append(node);
  return node;
}

/// A section whose content shows when its title is clicked; `printed`: on paper always.
function foldedSection(parent, id, title, printed = false) {
  const content = element('details', printed ? {class: 'printed'} : {}, element('summary', {}, element('h2', {}, title)));
  parent.append(element('section', {id}, content));
  return content;
}

/// Opens what is to be printed, and closes it afterwards.
function unfoldForPrint() {
  let opened = [];
  window.addEventListener('beforeprint', () => {
    opened = [...document.querySelectorAll('details.printed:not([open])')];
    opened.forEach(node => { node.open = true; });
  });
  window.addEventListener('afterprint', () => opened.forEach(node => { node.open = false; }));
}

const kScrolls = {tabindex: '0', role: 'group', 'aria-label': 'Table that scrolls sideways'};

/// A box that scrolls where its content is wider than the page. The keyboard reaches it only then.
function sideways(content) {
  const box = element('div', {class: 'wide'}, content);
  const observer = new ResizeObserver(() => Object.entries(kScrolls).forEach(([name, value]) =>
    (box.scrollWidth > box.clientWidth ? box.setAttribute(name, value) : box.removeAttribute(name))));
  [box, content].forEach(node => observer.observe(node));
  return box;
}

/// Columns: {title, number: whether right-aligned}. Rows: lists of texts or nodes.
function table(columns, rows, isChosen = () => false) {
  const style = column => (column.number ? {class: 'number'} : {});
  const head = element('tr', {}, ...columns.map(column => element('th', style(column), column.title)));
  const body = rows.map((row, index) => element('tr', isChosen(index) ? {class: 'chosen'} : {},
    ...row.map((cell, k) => element('td', style(columns[k]), cell))));
  return sideways(element('table', {}, element('thead', {}, head), element('tbody', {}, ...body)));
}

const kMostRows = 12;

/// A long table is folded, in a box that scrolls.
function scrolling(content, rows) {
  if (rows <= kMostRows) return content;
  const title = `Table of ${counted(rows, 'row')}`;
  return element('details', {}, element('summary', {}, title), element('div', {class: 'scroll', tabindex: '0', role: 'group', 'aria-label': title}, content));
}

/// Radio buttons. Options: {value, title}; one is selected initially. Calls back with the selected value.
function choice(name, title, options, changed, chosen = options[0].value) {
  const node = element('fieldset', {}, element('legend', {}, title));
  options.forEach(({value, title: text}) => {
    const input = element('input', {type: 'radio', name, value: String(value), ...(value === chosen ? {checked: ''} : {})});
    input.addEventListener('change', () => changed(value));
    node.append(element('label', {}, input, ' ' + text));
  });
  return node;
}

function fraction(numerator, denominator) {
  return element('span', {class: 'fraction'}, element('span', {}, numerator), element('span', {}, denominator));
}

/// The sum of coefficients times variable^power; the powers start at `first` and change by `step`.
function polynomial(coefficients, variable, first = 0, step = -1) {
  let text = '';
  coefficients.forEach((coefficient, k) => {
    const power = first + step * k;
    if (coefficient === 0 && coefficients.length > 1) return;
    const size = number(Math.abs(coefficient), 5);
    const symbol = power === 0 ? '' : power === 1 ? variable : variable + superscript(power);
    const sign = coefficient < 0 ? (text ? ' \u2212 ' : '\u2212') : (text ? ' + ' : '');
    text += sign + (size === '1' && symbol ? symbol : size + (symbol ? ' ' : '') + symbol);
  });
  return text || '0';
}
