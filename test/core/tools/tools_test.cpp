// The tools as a shell or a script meets them: exit status, messages, files.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/explanation_text.h"
#include "io/read_file.h"
#include "io/report.h"
#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "support/example1.h"
#include "support/example_explanation.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/io/csv.h"
#include "uncertainty_identification/io/explanation_json.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

const std::string kConfig = std::string(PROJECT_FOLDER) + "/config/";

ProcessResult tool(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{std::string(TOOLS_FOLDER) + "/" + name};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return runProcess(command);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Status 1 or 2, nothing on standard output, every message line with the program's name and one of
/// them with `part`.
void expectFailure(const ProcessResult& result, int status, const std::string& name,
                   const std::string& part) {
  EXPECT_EQ(result.status, status) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(contains(result.errors, part)) << result.errors;
  std::istringstream lines(result.errors);
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(line.rfind(name + ": ", 0), 0u) << line;
}

class Tools : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }

  /// Simulated experiments of Example 1, fewer and written without the tool.
  std::string data(int experiments, std::uint64_t seed) {
    Truth truth = loadTruth(kConfig + "example1_truth.yaml");
    truth.experiments = experiments;
    const std::string path = folder_ / ("data" + std::to_string(seed) + ".csv");
    writeCsv(path, simulate(truth, seed));
    return path;
  }

  ProcessResult identify(std::vector<std::string> more) {
    more.insert(more.begin(), {"--config", kConfig + "example1.yaml", "--output", result_});
    return tool("identify", more);
  }

  ProcessResult explain(std::vector<std::string> more) {
    more.insert(more.begin(), {"--config", kConfig + "example1.yaml", "--output", explanation_});
    return tool("explain", more);
  }

  std::string dataBehindDeadZone(int experiments, std::uint64_t seed, double width) {
    const std::string path = folder_ / ("dead_zone" + std::to_string(seed) + ".csv");
    writeCsv(path, example1BehindDeadZone(experiments, width, seed));
    return path;
  }

  ProcessResult simulateExample(const std::string& output, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--config", kConfig + "example1_truth.yaml", "--output", output});
    return tool("simulate", more);
  }

  TemporaryFolder folder_;
  const std::string result_ = folder_ / "result.json";
  const std::string explanation_ = folder_ / "explanation.json";
};

TEST_F(Tools, HelpAndVersion) {
  for (const std::string name : {"identify", "explain", "simulate", "report", "export"}) {
    const ProcessResult help = tool(name, {"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.errors, "");
    EXPECT_EQ(help.output.find("usage: " + name + " "), 0u) << help.output;
    EXPECT_TRUE(contains(help.output, "--output")) << help.output;
    const ProcessResult version = tool(name, {"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.output.rfind(name + " 0.", 0), 0u) << version.output;
  }
}

TEST_F(Tools, WrongUsage) {
  expectFailure(tool("identify", {}), 2, "identify", "'--output' is required");
  expectFailure(tool("simulate", {}), 2, "simulate", "'--config' is required");
  expectFailure(tool("explain", {}), 2, "explain", "'--output' is required");
  expectFailure(explain({}), 2, "explain", "no DATA given");
  expectFailure(identify({}), 2, "identify", "no DATA given");
  expectFailure(identify({"--colour", "x"}), 2, "identify", "unrecognised option '--colour'");
  expectFailure(identify({"--valid", "x", "y"}), 2, "identify", "unrecognised option '--valid'");
  expectFailure(tool("simulate", {"--config", "a", "--output", "b", "c"}), 2, "simulate",
                "positional");
  expectFailure(simulateExample("x.csv", {"--seed", "many"}), 2, "simulate", "--seed");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Tools, ReportOfAResult) {
  ASSERT_EQ(identify({data(10, 1)}).status, 0);
  const std::string output = folder_ / "report.html";
  const auto report = [&](const std::vector<std::string>& files) {
    std::vector<std::string> arguments{"--output", output};
    arguments.insert(arguments.end(), files.begin(), files.end());
    return tool("report", arguments);
  };
  const std::string obstacle = reportObstacle();
  if (!obstacle.empty()) {  // built without Chart.js
    expectFailure(report({result_}), 1, "report", "libjs-chart.js");
    return;
  }
  const std::string content = readFile(result_);
  expectFailure(report({}), 2, "report", "no result.json given");
  expectFailure(report({folder_ / "none.json"}), 2, "report", "none.json: cannot be opened");
  expectFailure(report({write("cut.json", content.substr(0, content.size() / 2))}), 2, "report",
                "cut.json: not JSON, or truncated");
  std::string other = content;
  other.replace(other.find("result/1"), 8, "result/9");
  expectFailure(report({write("other.json", other)}), 2, "report",
                "found 'uncertainty_identification/result/9'");
  saveExplanation(explanation_, test::exampleExplanation());
  expectFailure(report({result_, result_}), 2, "report",
                "expected 'uncertainty_identification/explanation/2'");
  expectFailure(report({result_, explanation_, "more.json"}), 2, "report",
                "more.json: a report holds one result.json and one explanation.json");
  expectFailure(tool("report", {"--output", folder_ / "no/report.html", result_}), 2, "report",
                "there is no folder");
  EXPECT_FALSE(fs::exists(output));
  const ProcessResult run = report({result_});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.output + run.errors, "");
  EXPECT_EQ(readFile(output), reportHtml(loadResult(result_)));
  ASSERT_EQ(report({result_, explanation_}).status, 0);
  const Explanation explanation = loadExplanation(explanation_);
  EXPECT_EQ(readFile(output), reportHtml(loadResult(result_), &explanation));
}

TEST_F(Tools, ResultsSayWhatAReportShowsFirst) {
  const ProcessResult run = identify({data(20, 1), "--validation", data(10, 2)});
  ASSERT_EQ(run.status, 0) << run.errors;
  const Result result = loadResult(result_);
  EXPECT_TRUE(contains(run.output, result.physical.sentence)) << run.output;
  EXPECT_EQ(result.physical.sentence.rfind("First-order plant: gain ", 0), 0u);
  EXPECT_TRUE(result.physical.numbers.at(0).lower.has_value());
  EXPECT_EQ(result.runs.size(), 6u);
  EXPECT_TRUE(!result.runs.front().validation && result.runs.back().validation);
  EXPECT_GT(result.runs.front().upper.size(), 0);
  EXPECT_EQ(result.origin.date.size(), std::string("2026-03-14 15:09").size());
  EXPECT_EQ(result.origin.data.at(0) + result.origin.validation.at(0), "data1.csvdata2.csv");
}

TEST_F(Tools, BaselinesFitEachExperiment) {
  for (const std::string method : {"mem", "pem"}) {
    const ProcessResult run = identify({"--method", method, data(30, 1)});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_TRUE(contains(run.output, "30 experiments, each fitted separately")) << run.output;
    const Result result = loadResult(result_);
    ASSERT_TRUE(result.baseline.has_value());
    EXPECT_EQ(nameOf(result.baseline->method), method);
    EXPECT_EQ(result.baseline->fits.size(), 30u);
    EXPECT_EQ(result.baseline->error_models.size(), method == "mem" ? 30u : 0u);
    EXPECT_TRUE(result.estimate.usable());
    EXPECT_FALSE(result.bounds.has_value());
  }
  expectFailure(identify({"--method", "pem", "--validation", data(3, 2), "--", data(5, 1)}), 2,
                "identify", "--validation: found with --method pem");
  expectFailure(identify({"--method", "ols", "d.csv"}), 2, "identify",
                "found 'ols'; allowed: se, mem, pem");
}

TEST_F(Tools, IdentifyWritesTheResultAndASummary) {
  const ProcessResult run =
      identify({"--method", "se", "--validation", data(3, 2), "--", data(60, 1)});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.errors, "");  // no progress bar: standard error is no terminal
  const Estimate estimate = loadResult(result_).estimate;
  EXPECT_EQ(estimate.experiment_count, 60);
  EXPECT_EQ(estimate.sample_count, 6000);
  EXPECT_EQ(estimate.validation.experiments.size(), 3u);
  EXPECT_EQ(estimate.termination, Termination::converged);
  EXPECT_EQ(estimate.configuration.estimation.noise_start, NoiseStart::zero);
  ASSERT_EQ(estimate.nominal_model.a.size(), 1);
  EXPECT_NEAR(estimate.nominal_model.a(0), 0.5, 0.01);  // four of its standard errors at M = 60
  EXPECT_NEAR(estimate.noise_variance.value, 0.1, 0.01);
  for (const char* part : {"Nominal model: box_jenkins", "Error model: fir", "noise_variance",
                           "Ended: converged", "Validation"}) {
    EXPECT_TRUE(contains(run.output, part)) << part << "\n" << run.output;
  }
}

TEST_F(Tools, ExplainNamesTheCauseAndMeasuresTheGain) {
  const ProcessResult run = explain(
      {"--validation", dataBehindDeadZone(10, 2, 0.4), "--", dataBehindDeadZone(30, 1, 0.4)});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.errors, "");  // no progress bar: standard error is no terminal
  const Explanation explanation = loadExplanation(explanation_);
  EXPECT_EQ(explanation.verdict, Verdict::explained);
  ASSERT_GE(explanation.causes.size(), 1u);
  const Cause& cause = explanation.causes[0];
  EXPECT_EQ(cause.name, "act_deadzone");
  ASSERT_EQ(cause.parameters.size(), 1u);
  EXPECT_NEAR(cause.parameters[0].value, 0.4, 4 * cause.parameters[0].standard_error);
  ASSERT_TRUE(cause.gain.has_value());
  EXPECT_GT(cause.gain->log_density, 2 * cause.gain->standard_error);
  ASSERT_EQ(explanation.held_out.size(), 10u);
  EXPECT_TRUE(contains(explanation.held_out[0], "_of_seed_2")) << explanation.held_out[0];
  EXPECT_EQ(run.output, explanationText(explanation));
}

TEST_F(Tools, ExplainRefusesWhatItCannotUse) {
  const std::string good = data(4, 1);
  expectFailure(explain({folder_ / "missing.csv"}), 2, "explain", "missing.csv");
  expectFailure(explain({good, "--validation", folder_ / "none.csv"}), 2, "explain", "none.csv");
  expectFailure(tool("explain", {"--config", folder_ / "none.yaml", "--output", "x.json", good}), 2,
                "explain", "none.yaml: cannot be opened");
  expectFailure(tool("explain", {"--config", kConfig + "example1.yaml", "--output",
                                 folder_ / "nowhere/file", good}),
                2, "explain", "there is no folder");
  std::string constant = "experiment,t,u,y\n";
  for (int k = 0; k < 100; ++k) constant += "still," + std::to_string(k) + ",1,0.5\n";
  expectFailure(explain({write("constant.csv", constant)}), 1, "explain", "still");
  EXPECT_FALSE(fs::exists(explanation_));
}

TEST_F(Tools, SampleDrawsPlantsFromAResult) {
  const ProcessResult identified = identify({data(30, 1)});
  ASSERT_EQ(identified.status, 0) << identified.errors;
  EXPECT_TRUE(contains(identified.output, "G = Go (1 + W Delta)")) << identified.output;
  const Result result = loadResult(result_);
  ASSERT_TRUE(result.bounds.has_value());
  EXPECT_EQ(result.bounds->frequency.omega.size(), 500);

  const std::string output = folder_ / "samples.json";
  const std::vector<std::string> request{"--model", result_, "--count", "50", "--output", output};
  const ProcessResult run = tool("sample", request);
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string first = readFile(output);
  const nlohmann::json tree = nlohmann::json::parse(first);
  ASSERT_EQ(tree["plants"].size(), 50u);
  EXPECT_EQ(tree["plants"][0]["real"].size(), tree["omega"].size());
  double mean = 0;  // of the static gains: Go's, the error model has none
  for (const nlohmann::json& plant : tree["plants"]) {
    double num = 0, den = 0;
    for (double x : plant["num"]) num += x;
    for (double x : plant["den"]) den += x;
    mean += num / den / 50;
  }
  const NominalModelEstimate& go = result.estimate.nominal_model;
  EXPECT_NEAR(mean, go.b.sum() / (1 + go.a.sum()), 0.005);
  ASSERT_EQ(tool("sample", request).status, 0);
  EXPECT_EQ(readFile(output), first);
  const auto with = [&](const std::string& key, const std::string& value) {
    std::vector<std::string> changed = request;
    changed[static_cast<std::size_t>(std::find(changed.begin(), changed.end(), key) -
                                     changed.begin()) +
            1] = value;
    return tool("sample", changed);
  };
  expectFailure(with("--count", "0"), 2, "sample", "--count: found 0; allowed: 1 to");
  expectFailure(tool("sample", {"--count", "1", "--model", output, "--output", output + "2"}), 2,
                "sample", "format: found");
  expectFailure(with("--model", write("torn.json", first.substr(0, 100))), 2, "sample",
                "not JSON, or truncated");
  expectFailure(tool("sample", {"--model", result_, "--count", "5", "--output", output,
                                "--uncertainty", "all"}),
                2, "sample", "--uncertainty: found 'all'");
}

TEST_F(Tools, FilesThatCannotBeRead) {
  const std::string good = data(2, 1);
  expectFailure(identify({folder_ / "missing.csv"}), 2, "identify", "missing.csv");
  expectFailure(identify({write("notes.txt", "hello\n")}), 2, "identify", "notes.txt");
  expectFailure(identify({write("prose.csv", "once upon a time\nthere was\n")}), 2, "identify",
                "prose.csv");
  expectFailure(identify({write("not.bag", "not a bag at all\n")}), 2, "identify", "not.bag");
  expectFailure(identify({good, "--validation", folder_ / "none.csv"}), 2, "identify", "none.csv");
  expectFailure(tool("identify", {"--config", folder_ / "none.yaml", "--output", result_, good}), 2,
                "identify", "none.yaml: cannot be opened");
  expectFailure(tool("simulate", {"--config", folder_ / "none.yaml", "--output", "x.csv"}), 2,
                "simulate", "none.yaml");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Tools, ConfigurationsThatAreWrong) {
  const std::string good = data(2, 1);
  const auto with = [&](const std::string& yaml) {
    return tool("identify", {"--config", write("c.yaml", yaml), "--output", result_, good});
  };
  expectFailure(with("error_model: {tap: 2}"), 2, "identify",
                "c.yaml: error_model.tap (line 1): unknown key; did you mean error_model.taps?");
  expectFailure(with("nominal_model: {nb: 0}"), 2, "identify",
                "c.yaml: nominal_model.nb: found 0; allowed: 1 to 50");
  expectFailure(with("nominal_model: ["), 2, "identify", "c.yaml, line 1: not YAML");
  expectFailure(
      tool("simulate", {"--config", write("t.yaml", "noise: {varaince: 1}"), "--output", "x.csv"}),
      2, "simulate", "t.yaml: noise.varaince (line 1): unknown key; did you mean noise.variance?");
}

TEST_F(Tools, OutputsThatCannotBeWritten) {
  const std::string good = data(2, 1), nowhere = folder_ / "nowhere/file";
  const auto to = [&](const std::string& output) {
    return tool("identify", {"--config", kConfig + "example1.yaml", "--output", output, good});
  };
  expectFailure(to(nowhere), 2, "identify", "there is no folder");
  expectFailure(to(folder_.path()), 2, "identify", "is a folder");
  expectFailure(to(""), 2, "identify", "the name of the output file is empty");
  expectFailure(simulateExample(nowhere + ".csv"), 2, "simulate", "nowhere/file.csv");
  expectFailure(simulateExample(nowhere + ".bag"), 2, "simulate", "nowhere/file.bag");
  expectFailure(simulateExample(good + "/below"), 2, "simulate", "cannot be created");
  expectFailure(simulateExample(folder_.path()), 2, "simulate", "the folder is not empty");
  expectFailure(simulateExample(folder_ / "new.csv", {"--answer", nowhere}), 2, "simulate",
                "there is no folder");
  EXPECT_FALSE(fs::exists(folder_ / "new.csv"));
}

TEST_F(Tools, DataThatCannotAnswer) {
  std::string constant = "experiment,t,u,y\n";
  for (int k = 0; k < 100; ++k) constant += "still," + std::to_string(k) + ",1,0.5\n";
  expectFailure(identify({write("constant.csv", constant)}), 1, "identify", "still");
  expectFailure(identify({write("empty.csv", "t,u,y\n")}), 1, "identify", "empty");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Tools, InterruptEndsWithoutAResult) {
  Truth truth = loadTruth(kConfig + "example1_truth.yaml");
  truth.samples = {2000};
  writeCsv(folder_ / "long.csv", simulate(truth, 1));
  const std::string automatic = write("auto.yaml", "nominal_model: {orders: auto}");
  for (const std::string name : {"identify", "explain"}) {
    Process process({std::string(TOOLS_FOLDER) + "/" + name, "--config", automatic, "--output",
                     result_, folder_ / "long.csv"});
    ASSERT_TRUE(process.waitUntilItHandles(SIGINT));
    ASSERT_EQ(kill(process.id(), SIGINT), 0);
    expectFailure(process.wait(), 1, name, "cancelled; nothing was written");
    EXPECT_FALSE(fs::exists(result_));
  }
}

TEST_F(Tools, SimulateWritesTheSameExperimentsInEveryForm) {
  const Truth truth = loadTruth(kConfig + "example1_truth.yaml");
  const std::vector<Experiment> expected = simulate(truth, 7);
  const std::string answer = folder_ / "answer.json";
  ASSERT_EQ(simulateExample(folder_ / "a.csv", {"--seed", "7", "--answer", answer}).status, 0);
  const ProcessResult folder = simulateExample(folder_ / "a", {"--seed", "7"});
  ASSERT_EQ(folder.status, 0) << folder.errors;
  EXPECT_EQ(folder.output + folder.errors, "");
  const std::vector<Experiment> read = readCsv(folder_ / "a.csv").experiments;
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t r = 0; r < read.size(); ++r) {
    EXPECT_EQ(read[r].id, expected[r].id);
    EXPECT_EQ(read[r].u, expected[r].u);
    EXPECT_EQ(read[r].y, expected[r].y);
    const LoadedData single = readCsv(folder_ / ("a/" + expected[r].id + ".csv"));
    ASSERT_EQ(single.experiments.size(), 1u);
    EXPECT_EQ(single.experiments[0].y, expected[r].y);
  }
  EXPECT_EQ(nlohmann::json::parse(readFile(answer)), answerJson(truth, 7));
}

TEST_F(Tools, EveryFormGivesTheSameEstimate) {
  std::vector<Estimate> estimates;
  for (const std::string name : {"e.csv", "e.bag", "e"}) {
    ASSERT_EQ(simulateExample(folder_ / name).status, 0);
    const ProcessResult run = identify({folder_ / name});
    ASSERT_EQ(run.status, 0) << run.errors;
    estimates.push_back(loadResult(result_).estimate);
  }
  for (const Estimate& estimate : estimates) {
    EXPECT_EQ(estimate.experiment_count, 100);
    EXPECT_NEAR(estimate.log_likelihood, estimates[0].log_likelihood, 1e-6);
    EXPECT_NEAR(estimate.nominal_model.b(0), estimates[0].nominal_model.b(0), 1e-9);
  }
}

}  // namespace
}  // namespace uncertainty_identification
