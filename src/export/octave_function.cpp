#include "export/named_array.h"
#include "export/targets.h"

namespace uncertainty_identification {
namespace {

// num and den are passed to tf() as powers of z: with "z^-1" Octave drops the leading zeros of num,
// which are the delay.
const char* const kOctaveFunctions = R"(
if nargin > 0 && strcmp(request, 'check')
  check(model);
end
if nargout > 1
  systems = rebuild(model);
end
end

% Numerators, denominators and responses of a part, one row per system; empty if there is none.
function [num, den, response] = part_of(model, part)
prefix = [part, '_'];
if strcmp(part, 'plant')
  prefix = '';
end
num = [];
den = [];
response = [];
if isfield(model, [prefix, 'num'])
  num = model.([prefix, 'num']);
  den = model.([prefix, 'den']);
  response = model.([prefix, 'response']);
end
end

function found = has_tf()
if exist('OCTAVE_VERSION', 'builtin')
  try
    pkg('load', 'control');
  catch
  end
end
found = exist('tf') > 0;
end

% systems.plant, noise and weight; systems.samples is a cell array.
function systems = rebuild(model)
if ~has_tf()
  error('tf is not installed: it is in the control package (Octave, MATLAB: Control System Toolbox)');
end
for part = {'plant', 'noise', 'weight', 'samples'}
  [num, den] = part_of(model, part{1});
  for k = 1:size(num, 1)
    system = tf(num(k, :), den(k, :), model.sample_time);
    if strcmp(part{1}, 'samples')
      systems.samples{k} = system;
    else
      systems.(part{1}) = system;
    end
  end
end
end

% Largest difference of a response from that of num/den, relative to its magnitude, or to the
% rounding of num(z) and den(z) where that is more than a part in 1e5 of it.
function largest = difference(found, response, num, den, z)
rounding = (sum(abs(num)) + abs(response) * sum(abs(den))) ./ abs(polyval(den, z));
largest = max(abs(found - response) ./ (abs(response) + 1e-5 * rounding));
end

% Compares polynomials, and systems where tf is installed, with the responses of the library.
function check(model)
systems = [];
if has_tf()
  systems = rebuild(model);
else
  disp('tf is not installed: only the polynomials are compared');
end
z = exp(1i * model.omega * model.sample_time);
for part = {'plant', 'noise', 'weight', 'samples'}
  [num, den, response] = part_of(model, part{1});
  largest = [0, 0];
  for k = 1:size(num, 1)
    found = polyval(num(k, :), z) ./ polyval(den(k, :), z);
    largest(1) = max(largest(1), difference(found, response(k, :), num(k, :), den(k, :), z));
    if isstruct(systems)
      system = systems.(part{1});
      if iscell(system)
        system = system{k};
      end
      found = reshape(freqresp(system, model.omega), 1, []);
      largest(2) = max(largest(2), difference(found, response(k, :), num(k, :), den(k, :), z));
    end
  end
  if ~isempty(num)
    fprintf('%s: differs by %.1e from the library at %d frequencies', part{1}, largest(1), numel(z));
    if isstruct(systems)
      fprintf(', as tf by %.1e', largest(2));
    end
    fprintf('\n');
  end
  if ~all(largest < 1e-9)
    error('%s: the responses differ', part{1});
  end
end
end
)";

std::string octaveAssignment(const std::string& field, const NamedArray& array) {
  std::string rows;
  for (Eigen::Index i = 0; i < array.values.rows(); ++i)
    rows += (i > 0 ? ";\n" : "") + rowText(array.values.row(i), array.is_complex);
  return "% " + array.meaning + "\n" + field + array.name + " = [" + rows + "];\n";
}

}  // namespace

std::string octaveFunction(const ExportedModel& model) {
  const std::string& name = model.name;
  std::string text = "function [model, systems] = " + name + "(request)\n% " + name +
                     ": plant, noise model and uncertainty.\n%   model = " + name +
                     "() has the numbers as fields; num and den are powers of z, the delay in num\n"
                     "%   [model, systems] = " +
                     name + "() also builds them by tf (control package)\n%   " + name +
                     "('check') compares them with the responses that the library computed\n";
  for (const std::string& line : model.about) text += "% " + line + "\n";
  for (const std::string& line : model.missing) text += "% Missing: " + line + "\n";
  for (const NamedArray& array : namedArrays(model)) text += octaveAssignment("model.", array);
  return text + kOctaveFunctions;
}

}  // namespace uncertainty_identification
