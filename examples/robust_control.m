% Designs a robust controller for an identified plant and its uncertainty weight, with Octave's control package:
%   octave --quiet examples/robust_control.m result.json
% docs/robust_control.md explains the steps and shows a run.
pkg load control

% q^-delay num/den in powers of z. Not tf(num, den, Ts, "variable", "z^-1"), which drops the leading zeros of num, and with
% them the delay: padded to equal length the coefficients of z^-1 are those of z.
function g = sampled(num, den, delay, Ts)
  num = [zeros(1, delay), num(:)'];
  den = den(:)';
  order = max(numel(num), numel(den));
  g = tf([num, zeros(1, order - numel(num))], [den, zeros(1, order - numel(den))], Ts);
end

arguments = argv();
result = jsondecode(fileread(arguments{end}));
model = result.nominal_model;
weight = result.bounds.weight;
Ts = model.sample_time;

% Go = q^-delay B/A, its Tustin twin, and W's, which result.json holds
go = sampled(model.b, [1; model.a(:)], model.delay, Ts);
plant = d2c(ss(go), "tustin");
uncertainty = tf(weight.continuous.num(:)', weight.continuous.den(:)');

% mixsyn minimises |W1 S, W2 K S, W3 T| and wants continuous plants, so all is done in Tustin's plane. W1 asks for
% integral action up to a bandwidth: the highest that leaves the norm below 1 is found by bisection.
effort = ss(1e-3 / abs(dcgain(go)));
slowest = 1e-3 / Ts;
fastest = 2 / Ts;
for k = 1:20
  bandwidth = sqrt(slowest * fastest);
  performance = tf([0.5, bandwidth], [1, 1e-3 * bandwidth]);
  [candidate, ~, gain] = mixsyn(plant, ss(performance), effort, ss(uncertainty));
  if gain < 1
    slowest = bandwidth;
    controller = candidate;
    norm = gain;
  else
    fastest = bandwidth;
  end
end
K = c2d(controller, Ts, "tustin");

% judged where it will run: in discrete time, with the discrete weight
W = sampled(weight.num, weight.den, 0, Ts);
T = feedback(ss(go) * K, 1);
grid = logspace(log10(weight.omega(1)), log10(0.9999 * pi / Ts), 10000);
peak = max(abs(squeeze(freqresp(W, grid))) .* abs(squeeze(freqresp(T, grid))));
printf("W of order %d; bandwidth reached %.3g rad/s, H-infinity norm %.3f\n", weight.order, slowest, norm);
printf("nominal loop stable: %d, max |W T| = %.3f: margin %.3f\n", isstable(T), peak, 1 / peak);
[num, den] = tfdata(tf(K), "vector");
num = [zeros(1, numel(den) - numel(num)), num];
printf("controller, powers of z^-1\n  num: [%s]\n  den: [%s]\n", num2str(num / den(1), " %.6g"), ...
       num2str(den / den(1), " %.6g"));

% and against plants drawn from the result: sample --model result.json --count 1000 --output samples.json
if numel(arguments) > 1
  drawn = jsondecode(fileread(arguments{end - 1}));
  unstable = 0;
  furthest = 0;
  for k = 1:numel(drawn.plants)
    one = drawn.plants(k);
    g = sampled(one.num, one.den, drawn.delay, Ts);
    response = one.real(:) + 1i * one.imaginary(:);
    error_of_one = max(abs(squeeze(freqresp(g, drawn.omega(:)'))(:) - response)) / max(abs(response));
    furthest = max(furthest, error_of_one);
    unstable += ! isstable(feedback(ss(g) * K, 1));
  end
  if furthest > 1e-9
    error("the plants differ from the frequency responses in samples.json by %.2g of their largest value", furthest);
  end
  printf("frequency responses as in samples.json, to %.1g\n", furthest);
  printf("unstable with %d of %d plants drawn\n", unstable, numel(drawn.plants));
end
