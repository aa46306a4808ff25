// Your simulation with what recorded data say that it lacks; written by explain --write-extended.
//
//     g++ -std=c++17 -O2 extended_simulation.cpp -o extended_simulation
//     ./extended_simulation --check [RUNS.csv]
//
// compares it with the runs that were held out (held_out.csv in the working folder), or with others
// that have the same columns, and says whether it fits them as reported. Compiled with -DNO_MAIN it
// is a part of another program, which calls extended_simulation::extended(). It needs the standard
// library, and fork() where it starts a program.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace extended_simulation {

using Signal = std::vector<double>;
using Signals = std::map<std::string, Signal>;  // covariates; one value: constant
using Parameters = std::map<std::string, double>;

struct Curve {  // linear between its points, and beyond the ends as in the first and the last piece
  std::string of;
  Signal signal, value;
};

struct Filter {  // num(q^-1) / den(q^-1), from rest; no num: there is none
  Signal num, den;
};

// @FOUND@

inline std::string textOf(const Signal& values) {
  std::string text = "[";
  char number[32];
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::snprintf(number, sizeof number, k > 0 ? ",%.17g" : "%.17g", values[k]);
    text += std::isfinite(values[k]) ? number : k > 0 ? ",null" : "null";
  }
  return text + "]";
}

inline std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char each : text)
    result += each == '"' || each == '\\' ? std::string("\\") + each : std::string(1, each);
  return result + "\"";
}

// Your program, started once; it reads and writes lines of JSON.
class Program {
 public:
  static Signal output(const Signal& u, double sample_time, const Signals& covariates,
                       const Parameters& parameters) {
    static Program program;
    std::string line =
        "{\"sample_time\":" + numberOf(sample_time) + ",\"u\":" + textOf(u) + ",\"covariates\":{";
    for (const auto& [name, values] : covariates)
      line += (line.back() == '{' ? "" : ",") + quoted(name) + ":" +
              (values.size() == 1 ? numberOf(values[0]) : textOf(values));
    line += "},\"parameters\":{";
    for (const auto& [name, value] : parameters)
      line += (line.back() == '{' ? "" : ",") + quoted(name) + ":" + numberOf(value);
    return program.ask(line + "}}\n");
  }

 private:
  Program() {
    std::signal(SIGPIPE, SIG_IGN);  // a program that has ended is told when its answer is read
    int to[2], from[2];
    if (pipe(to) != 0 || pipe(from) != 0) throw std::runtime_error("no pipe to the program");
    if (fork() == 0) {
      dup2(to[0], 0);
      dup2(from[1], 1);
      for (const int each : {to[0], to[1], from[0], from[1]}) close(each);
      std::vector<char*> arguments;
      for (const std::string& each : kCommand) arguments.push_back(const_cast<char*>(each.c_str()));
      arguments.push_back(nullptr);
      std::signal(SIGPIPE, SIG_DFL);
      if (chdir(kFolder) == 0) execvp(arguments[0], arguments.data());
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    to_ = fdopen(to[1], "w");
    from_ = fdopen(from[0], "r");
  }

  static std::string numberOf(double value) {
    const std::string list = textOf({value});
    return list.substr(1, list.size() - 2);
  }

  Signal ask(const std::string& line) {
    std::fputs(line.c_str(), to_);
    std::fflush(to_);
    std::string answer;
    for (int each = std::fgetc(from_); each != '\n'; each = std::fgetc(from_)) {
      if (each == EOF) throw std::runtime_error(kCommand[0] + " ended without an answer");
      answer += static_cast<char>(each);
    }
    const std::size_t begin = answer.find('[', answer.find("\"y\""));
    if (begin == std::string::npos)
      throw std::runtime_error(kCommand[0] + " wrote no {\"y\": [...]}");
    Signal y;
    const char* at = answer.c_str() + begin + 1;
    while (*at != ']' && *at != '\0') {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      y.push_back(end == at ? std::nan("") : value);  // null
      at = std::max(static_cast<const char*>(end), at);
      while (*at != ',' && *at != ']' && *at != '\0') ++at;
      if (*at == ',') ++at;
    }
    return y;
  }

  std::FILE *to_ = nullptr, *from_ = nullptr;
};

inline double through(const Curve& curve, double x) {
  const Signal& signal = curve.signal;
  const auto above = std::upper_bound(signal.begin() + 1, signal.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - signal.begin());
  const double share = (x - signal[k - 1]) / (signal[k] - signal[k - 1]);
  return curve.value[k - 1] + share * (curve.value[k] - curve.value[k - 1]);
}

inline Signal covariate(const Signals& covariates, const std::string& name, std::size_t size) {
  const auto found = covariates.find(name);
  if (found == covariates.end()) throw std::invalid_argument("there is no covariate " + name);
  return found->second.size() == 1 ? Signal(size, found->second[0]) : found->second;
}

// The input behind a curve of its own, or times a factor that depends on time or on a covariate.
inline Signal inputBehindCurve(Signal u, const Signals& covariates) {
  if (kCurve.signal.empty() || kCurve.of == "output") return u;
  Signal argument;
  if (kCurve.of != "input" && kCurve.of != "time")
    argument = covariate(covariates, kCurve.of, u.size());
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (kCurve.of == "input")
      u[k] = through(kCurve, u[k]);
    else
      u[k] *= through(kCurve, kCurve.of == "time"
                                  ? double(k) / std::max<double>(double(u.size()) - 1, 1)
                                  : argument[k]);
  }
  return u;
}

inline Signal filtered(const Filter& system, const Signal& u) {
  Signal y(u.size());
  for (std::size_t k = 0; k < u.size(); ++k) {
    for (std::size_t j = 0; j < std::min(system.num.size(), k + 1); ++j)
      y[k] += system.num[j] * u[k - j];
    for (std::size_t j = 1; j < std::min(system.den.size(), k + 1); ++j)
      y[k] -= system.den[j] * y[k - j];
  }
  return y;
}

// The signal so many samples later; between samples by Hermite's cubic, constant beyond the ends.
inline Signal delayed(const Signal& y, double samples) {
  const double whole = std::floor(-samples), share = -samples - whole, last = double(y.size()) - 1;
  const auto at = [&](double k) {
    return y[static_cast<std::size_t>(std::min(std::max(k, 0.0), last))];
  };
  Signal later;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double left = double(k) + whole, y0 = at(left), y1 = at(left + 1);
    const double slope0 = 0.5 * (y1 - at(left - 1)), slope1 = 0.5 * (at(left + 2) - y0);
    const double square = 3 * (y1 - y0) - 2 * slope0 - slope1,
                 cube = slope0 + slope1 - 2 * (y1 - y0);
    later.push_back(y0 + share * (slope0 + share * (square + share * cube)));
  }
  return later;
}

// (1 + lead s) / (1 + lag s), time constants in samples, for a signal that is linear between its
// samples.
inline Signal leadLag(Signal y, double lead, double lag) {
  const double time = std::max(lag, 0.02), kept = std::exp(-1 / time), ramp = 1 - time * (1 - kept);
  double state = y.empty() ? 0 : y[0], previous = state;
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (k > 0) state = kept * state + (1 - kept) * previous + ramp * (y[k] - previous);
    previous = y[k];
    y[k] = lead / time * y[k] + (1 - lead / time) * state;
  }
  return y;
}

// Your simulation with values of its parameters.
inline Signal own(const Signal& u, double sample_time, const Signals& covariates,
                  const Parameters& parameters) {
  if (kKind == "program") return Program::output(u, sample_time, covariates, parameters);
  if (kKind == "logged") return covariate(covariates, kColumn, u.size());
  return filtered(kFilterYours, u);
}

// Your simulation with everything that was found.
inline Signal extended(const Signal& u, double sample_time, const Signals& covariates = {},
                       const Parameters& parameters = kMeasured) {
  const bool has_filters = !kFilterYours.num.empty();
  if (has_filters && std::abs(sample_time - kSampleTime) > 1e-6 * sample_time)
    throw std::invalid_argument("the filters are made for another sample time");
  const Signal behind = inputBehindCurve(u, covariates);
  Signal y;
  if (kKind == "linear") {
    y = filtered(kFilterMeasured, behind);
  } else {
    y = own(behind, sample_time, covariates, parameters);
    if (has_filters) {
      const Signal more = filtered(kFilterMeasured, behind);
      const Signal less = filtered(kFilterYours, kKind == "logged" ? u : behind);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += more[k] - less[k];
    }
  }
  if (kCurve.of == "output")
    for (double& value : y) value = through(kCurve, value);
  if (kDelay != 0) y = delayed(y, kDelay / sample_time);
  if (kLead != 0 || kLag != 0) y = leadLag(y, kLead / sample_time, kLag / sample_time);
  for (double& value : y) value = kGain * value + kOffset;
  return y;
}

// -- the check
// ----------------------------------------------------------------------------------------------------

struct Run {
  Signal u, y;
  Signals covariates;
};

inline std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char each : line) {
    if (each == '"')
      is_quoted = !is_quoted;
    else if (each == ',' && !is_quoted)
      cells.emplace_back();
    else if (each != '\r')
      cells.back() += each;
  }
  return cells;
}

// The experiments of a file with the columns experiment, t, u, y and covariates.
inline std::vector<Run> runsOf(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path + " cannot be read");
  const std::vector<std::string> names = cellsOf(line);
  std::vector<Run> runs;
  std::map<std::string, std::size_t> index;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    std::map<std::string, double> row;
    std::string experiment;
    for (std::size_t k = 0; k < std::min(names.size(), cells.size()); ++k) {
      if (names[k] == "experiment")
        experiment = cells[k];
      else
        row[names[k]] = cells[k].empty() ? std::nan("") : std::strtod(cells[k].c_str(), nullptr);
    }
    const auto [found, is_new] = index.emplace(experiment, runs.size());
    if (is_new) runs.emplace_back();
    Run& run = runs[found->second];
    for (const auto& [name, value] : row) {
      if (name == "u") run.u.push_back(value);
      if (name == "y") run.y.push_back(value);
      if (name != "u" && name != "y" && name != "t") run.covariates[name].push_back(value);
    }
  }
  for (Run& run : runs)
    for (auto& [name, values] : run.covariates)
      if (std::all_of(values.begin(), values.end(), [&](double each) { return each == values[0]; }))
        values.resize(1);
  return runs;
}

// Squared error; without c e^(-t / transient), with the best c of the run, if `with_transient`.
inline double squaredError(const Run& run, const Signal& output, std::size_t first,
                           bool with_transient) {
  double error = 0, power = 0, product = 0;
  for (std::size_t k = first; k < run.y.size(); ++k) {
    if (!std::isfinite(run.y[k])) continue;
    const double each = run.y[k] - output[k];
    const double shape =
        with_transient && kTransient > 0 ? std::exp(-double(k) * kSampleTime / kTransient) : 0;
    error += each * each;
    power += shape * shape;
    product += shape * each;
  }
  return power > 0 ? error - product * product / power : error;
}

// [%] 100 (1 - |error| / |y - mean|) of your simulation and of the extended one; `begin`: share of
// a run left out.
inline std::pair<double, double> fitsOf(const std::string& path, double begin) {
  double count = 0, sum = 0, power = 0, of_own = 0, of_extended = 0;
  const std::vector<Run> runs = runsOf(path);
  const auto forEach = [&](const auto& use) {
    for (const Run& run : runs)
      for (std::size_t k = std::size_t(begin * double(run.y.size())); k < run.y.size(); ++k)
        if (std::isfinite(run.y[k])) use(run.y[k]);
  };
  forEach([&](double y) { count += 1, sum += y; });
  forEach([&](double y) { power += (y - sum / count) * (y - sum / count); });
  for (const Run& run : runs) {
    const auto first = std::size_t(begin * double(run.y.size()));
    of_own += squaredError(run, own(run.u, kSampleTime, run.covariates, kYours), first, false);
    of_extended += squaredError(run, extended(run.u, kSampleTime, run.covariates), first, true);
  }
  return {100 * (1 - std::sqrt(of_own / power)), 100 * (1 - std::sqrt(of_extended / power))};
}

// Prints both fits, and whether they are the reported ones, where the data are those of the report.
inline bool check(const char* path) {
  const auto [before, after] = fitsOf(path ? path : "held_out.csv", path ? 0 : kComparedFrom);
  if (path) {
    std::printf("fit %.3f %% with your simulation, %.3f %% extended\n", before, after);
    return true;
  }
  const auto agrees = [](const char* what, double fit, double reported) {
    const bool same = std::abs(fit - reported) < 0.01;
    std::printf("%s: fit %.3f %%, reported %.3f %%: %s\n", what, fit, reported,
                same ? "agrees" : "DIFFERS");
    return same;
  };
  const bool first = agrees("your simulation", before, kFitBefore);
  return agrees("extended", after, kFitAfter) && first;
}

}  // namespace extended_simulation

#ifndef NO_MAIN
int main(int argc, char** argv) {
  if (argc < 2 || argc > 3 || std::string(argv[1]) != "--check") {
    std::cerr << "usage: " << argv[0] << " --check [RUNS.csv]\n";
    return 2;
  }
  try {
    return extended_simulation::check(argc == 3 ? argv[2] : nullptr) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 1;
  }
}
#endif
