% Designs a robust controller for an identified plant and its uncertainty weight, with Octave's control package:
%   octave --quiet examples/robust_control.m result.json
% docs/robust_control.md explains the steps and shows a run.
pkg load control

arguments = argv();
result = jsondecode(fileread(arguments{end}));
model = result.nominal_model;
weight = result.bounds.weight;
Ts = model.sample_time;

% Go = q^-delay B/A, its Tustin twin, and W's, which result.json holds
go = tf([zeros(1, model.delay), model.b(:)'], [1, model.a(:)'], Ts, "variable", "z^-1");
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
W = tf(weight.num(:)', weight.den(:)', Ts, "variable", "z^-1");
T = feedback(ss(go) * K, 1);
grid = logspace(log10(weight.omega(1)), log10(0.9999 * pi / Ts), 10000);
peak = max(abs(squeeze(freqresp(W, grid))) .* abs(squeeze(freqresp(T, grid))));
printf("W of order %d; bandwidth reached %.3g rad/s, H-infinity norm %.3f\n", weight.order, slowest, norm);
printf("nominal loop stable: %d, max |W T| = %.3f: margin %.3f\n", isstable(T), peak, 1 / peak);
[num, den] = tfdata(tf(K), "vector");
printf("controller, powers of z^-1\n  num: [%s]\n  den: [%s]\n", num2str(num / den(1), " %.6g"), ...
       num2str(den / den(1), " %.6g"));

% and against plants drawn from the result: sample --model result.json --count 1000 --output samples.json
if numel(arguments) > 1
  drawn = jsondecode(fileread(arguments{end - 1}));
  unstable = 0;
  for k = 1:numel(drawn.plants)
    g = tf([zeros(1, drawn.delay), drawn.plants(k).num(:)'], drawn.plants(k).den(:)', Ts, "variable", "z^-1");
    unstable += ! isstable(feedback(ss(g) * K, 1));
  end
  printf("unstable with %d of %d plants drawn\n", unstable, numel(drawn.plants));
end
