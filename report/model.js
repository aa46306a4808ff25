'use strict';
// The nominal model: polynomials and parameters.

function formula(...content) {
  return element('div', {class: 'formula'}, ...content);
}

function showNominalModel(parent, result) {
  const model = result.nominal_model, q = 'q';
  const {denominator} = plantPolynomials(model);
  parent.append(paragraph(`y = Go u + H w in discrete time, q\u207b\u00b9 being a delay by one sample of ${number(model.sample_time)} s ` +
    'and w white noise.'));
  parent.append(formula('Go(q) = ', fraction(polynomial(model.b, q, -model.delay), polynomial(denominator, q)),
    '\u2003\u2003H(q) = ', model.c.length + model.d.length === 0 ? '1'
      : fraction(polynomial([1, ...model.c], q), polynomial([1, ...model.d], q))));
  parent.append(parametersTable([...model.parameters, {...result.noise_variance, name: 'noise variance'}]));
  const undetermined = model.parameters.filter(parameter => !isNumber(parameter.standard_error)).length;
  if (result.baseline) {
    parent.append(paragraph('The mean of the fits of the single experiments; the standard errors of this mean follow from their spread.', 'note'));
    return;
  }
  parent.append(paragraph('Standard errors follow from the observed information and are valid if the model is right. Robust ones follow from the ' +
    'spread of the scores of the experiments and are valid even if it is not. A large difference means that it is not.' +
    (undetermined > 0 ? ' A dash means that the data do not determine the parameter or its error.' : ''), 'note'));
}

function parametersTable(parameters) {
  const withUnit = parameters.some(parameter => parameter.unit);
  const columns = [{title: 'Parameter'}, {title: 'Estimate', number: true}, {title: 'Standard error', number: true},
                   {title: 'Robust', number: true}, ...(withUnit ? [{title: 'Unit'}] : [])];
  const rows = parameters.map(({name, value, standard_error: error, robust_standard_error: robust, unit}) => {
    const text = withError(value, error);
    return [name, text.value, text.error, withError(value, robust).error, ...(withUnit ? [unit] : [])];
  });
  return scrolling(table(columns, rows), rows.length);
}
