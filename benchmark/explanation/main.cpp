// Hides random effects in random systems and counts how often explain() finds them. See --help.
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>

#include "io/atomic_file.h"
#include "io/command_line.h"
#include "io/output_file.h"
#include "parts.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification::suite {
namespace {

namespace po = boost::program_options;

/// Carries out tasks, `jobs` at the same time, and keeps all outcomes.
class Runner {
 public:
  explicit Runner(int jobs) : jobs_(jobs) {}

  /// Returns the outcomes in the order of the tasks, and prints a line as each of them finishes. An
  /// exception of one task ends all and is thrown again.
  std::vector<Outcome> run(const std::vector<Task>& tasks) {
    std::vector<Outcome> outcomes(tasks.size());
    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    const auto work = [&] {
      for (std::size_t k = next++; k < tasks.size(); k = next++) {
        try {
          outcomes[k] = carryOut(tasks[k]);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(printing_);
          error = std::current_exception();
          next = tasks.size();
          return;
        }
        const std::lock_guard<std::mutex> lock(printing_);
        std::printf("%s\n", outcomes[k].line().c_str());
        std::fflush(stdout);
      }
    };
    std::vector<std::thread> threads;
    for (int j = 1; j < jobs_; ++j) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
    all_.insert(all_.end(), outcomes.begin(), outcomes.end());
    return outcomes;
  }

  const std::vector<Outcome>& all() const { return all_; }

 private:
  int jobs_;
  std::mutex printing_;
  std::vector<Outcome> all_;
};

/// Reads --seeds: "3:10" is ten runs from the third on, and "3" is the third run alone.
Runs parseRuns(const std::string& text) {
  Runs runs;
  char rest = 0;
  const int found = std::sscanf(text.c_str(), "%d:%d%c", &runs.first, &runs.count, &rest);
  if (found == 1 && text.find(':') == std::string::npos) runs.count = 1;
  const bool whole = found == 2 || (found == 1 && text.find(':') == std::string::npos);
  if (!whole || runs.first < 1 || runs.count < 1)
    throw ConfigurationError("--seeds: found '" + text +
                             "'; allowed: FIRST or FIRST:COUNT, from 1");
  return runs;
}

Scale scaleOf(const po::variables_map& arguments) {
  Scale scale;
  scale.options.strength = arguments["strength"].as<double>();
  scale.options.base.experiments = arguments["experiments"].as<int>();
  scale.options.base.samples = arguments["samples"].as<int>();
  scale.fresh = arguments["fresh"].as<int>();
  scale.threads = arguments["jobs"].as<int>() > 1 ? 1 : kAutomatic;
  return scale;
}

/// The tasks that the options describe.
std::vector<Task> chosenTasks(const po::variables_map& arguments) {
  const Runs runs = parseRuns(arguments["seeds"].as<std::string>());
  const Scale scale = scaleOf(arguments);
  std::vector<std::string> effects = test::catalogueEffects();
  if (arguments.count("effects") > 0) effects = arguments["effects"].as<std::vector<std::string>>();
  std::vector<Task> tasks;
  if (arguments.count("clean") > 0) {
    tasks = cleanTasks({runs.first, arguments["clean"].as<int>()}, scale);
  } else if (arguments.count("pairs") > 0) {
    tasks = pairTasks(arguments["pairs"].as<int>(), runs, scale);
  } else if (arguments.count("together") > 0) {
    for (int run = runs.first; run < runs.first + runs.count; ++run) {
      Task together = singleTasks({effects.front()}, {run, 1}, scale).front();
      together.part = "together";
      together.hidden = effects;
      tasks.push_back(together);
    }
  } else {
    tasks = arguments.count("remove") > 0 ? removedTasks(effects, runs, scale)
                                          : singleTasks(effects, runs, scale);
  }
  return arguments.count("orders-auto") > 0 ? withoutOrders(tasks) : tasks;
}

/// Part 1: single effects with 5 % of the output's variance. The full suite adds those with 1 %,
/// and the two effects that need more experiments.
void judgeSingleEffects(Runner& runner, Runs runs, bool full, Scale scale, Targets* targets) {
  constexpr int kFresh = 1000;
  if (full) scale.fresh = kFresh;
  const std::vector<Outcome> strong =
      runner.run(singleTasks(test::catalogueEffects(), runs, scale));
  printConfusion(strong);
  printParameters(strong);
  judgeSingles(strong, "5 %", 0.93, 0.88, 0.8, targets);
  judgeParameters(strong, targets);
  judgeGains(strong, targets);
  judgeTimes(strong, "one effect", 1.5, targets);
  if (!full) return;
  scale.fresh = 0;
  scale.options.strength = 0.01;
  const std::vector<Outcome> weak = runner.run(singleTasks(test::catalogueEffects(), runs, scale));
  printConfusion(weak);
  judgeSingles(weak, "1 %", 0.85, 0, 0, targets);
  scale.options.strength = 0.1;
  scale.options.base.experiments = 60;
  const std::vector<Outcome> mixtures =
      runner.run(singleTasks({"exp_mode", "plant_aging"}, runs, scale));
  printConfusion(mixtures);
  judgeSingles(mixtures, "M = 60, 10 %", 0.85, 0, 0, targets);
}

/// Runs the whole suite, or a sample of it that takes minutes. Returns the exit status.
int suite(Runner& runner, bool full, const Scale& scale) {
  Targets targets(!full);
  judgeSingleEffects(runner, {1, full ? 10 : 1}, full, scale, &targets);
  const std::vector<Outcome> clean = runner.run(cleanTasks({1, full ? 300 : 20}, scale));
  printConfusion(clean);
  judgeClean(clean, 0.99, &targets);
  judgeTimes(clean, "clean data", 0.5, &targets);
  const std::vector<std::string> removed =
      full ? test::catalogueEffects()
           : std::vector<std::string>{"act_deadzone", "plant_pole", "sens_hum"};
  const std::vector<Outcome> without = runner.run(removedTasks(removed, {1, full ? 3 : 1}, scale));
  printConfusion(without);
  judgeUnknown(without, "removed from the catalogue", &targets);
  const std::vector<Outcome> foreign =
      runner.run(singleTasks(test::unnamedEffects(), {1, full ? 10 : 1}, scale));
  printConfusion(foreign);
  judgeUnknown(foreign, "in no catalogue", &targets);
  const std::vector<Outcome> pairs = runner.run(pairTasks(full ? 20 : 4, {1, full ? 3 : 1}, scale));
  printConfusion(pairs);
  judgePairs(pairs, &targets);
  if (full) {
    const std::vector<Outcome> blind =
        runner.run(withoutOrders(singleTasks(test::catalogueEffects(), {1, 3}, scale)));
    printConfusion(blind);
    judgeSingles(blind, "orders auto", 0.85, 0, 0, &targets);
    const std::vector<Outcome> blind_clean = runner.run(withoutOrders(cleanTasks({1, 100}, scale)));
    judgeClean(blind_clean, 0.97, &targets);
  }
  return targets.report();
}

int run(const po::variables_map& arguments) {
  const std::string json = arguments["json"].as<std::string>();
  if (!json.empty()) requireWritable(json);
  if (arguments.count("write") > 0) {
    const std::string folder = arguments["write"].as<std::string>();
    int number = 0;
    for (const Task& task : chosenTasks(arguments)) {
      writeData(task, folder + "/" + std::to_string(++number));
      std::printf("%s/%d: %s\n", folder.c_str(), number, task.title().c_str());
    }
    return kDone;
  }
  Runner runner(arguments["jobs"].as<int>());
  int status = kDone;
  if (arguments.count("full") + arguments.count("short") > 0) {
    status = suite(runner, arguments.count("full") > 0, scaleOf(arguments));
  } else {
    const std::vector<Outcome> outcomes = runner.run(chosenTasks(arguments));
    printConfusion(outcomes);
    printParameters(outcomes);
  }
  if (!json.empty()) writeFileAtomically(json, toJson(runner.all()).dump(1) + "\n");
  return status;
}

}  // namespace
}  // namespace uncertainty_identification::suite

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  uncertainty_identification::Program program;
  program.name = "explanation_benchmark";
  program.usage = "--full | --short | [--effects NAME...] [--seeds FIRST:COUNT] [...]";
  program.purpose =
      R"(Hides random effects in random systems and tests whether explain() finds them. explain() is given only the data
and the configuration of the system without its effects. --full tests everything and compares the results with
targets. --short tests a sample within minutes, and a target counts as missed only if chance cannot explain it.
Otherwise the data sets that the options describe are tested, without targets.
Each data set gives a line as it finishes. It depends only on the names of its effects and on its run number.
Exit status: 0 done; 1 --full or --short missed a target; 2 usage.)";
  program.options.add_options()                                                           //
      ("full", "test everything, about an hour")("short", "test a sample of everything")  //
      ("effects", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME"),
       "effects to hide, of config/truth_reference.yaml (default: all of the catalogue)")  //
      ("seeds", po::value<std::string>()->default_value("1:10")->value_name("FIRST:COUNT"),
       "run numbers")  //
      ("strength", po::value<double>()->default_value(0.05),
       "of each effect, as a share of the output's variance")  //
      ("experiments", po::value<int>()->default_value(30),
       "number of experiments, besides 12 that are held out")                                //
      ("samples", po::value<int>()->default_value(300), "number of samples per experiment")  //
      ("pairs", po::value<int>()->value_name("N"),
       "hide N pairs of effects instead of single effects")                                   //
      ("together", "hide all effects of --effects at once")                                   //
      ("clean", po::value<int>()->value_name("N"), "N data sets in which nothing is hidden")  //
      ("remove", "take the hidden effects out of the catalogue")                              //
      ("orders-auto", "explain() chooses the orders of the nominal model itself")             //
      ("fresh", po::value<int>()->default_value(0),
       "number of further experiments on which gains are measured again")  //
      ("jobs", po::value<int>()->default_value(1),
       "number of data sets at a time, each with one thread")  //
      ("json", po::value<std::string>()->default_value("", "none")->value_name("FILE"),
       "where to write every outcome")  //
      ("write", po::value<std::string>()->value_name("DIR"),
       "only write the data sets as CSV files, each to its own folder below DIR");
  program.run = uncertainty_identification::suite::run;
  return uncertainty_identification::runProgram(program, argc, argv);
}
