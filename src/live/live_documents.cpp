#include "live/live_documents.h"

#include <nlohmann/json.hpp>

#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

constexpr std::size_t kMostListed = 100;  // experiments

/// Texts come from users: one that is not UTF-8 must not keep the others from being shown.
std::string inOneLine(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// The named entries of an object, as far as it has them.
json someOf(const json& all, const std::vector<const char*>& names) {
  json some = json::object();
  for (const char* name : names) {
    if (all.contains(name)) some[name] = all[name];
  }
  return some;
}

const char* nameOf(NodeState state) {
  switch (state) {
    case NodeState::collecting:
      return "collecting";
    case NodeState::identifying:
      return "identifying";
    case NodeState::error:
      return "error";
    case NodeState::idle:
      break;
  }
  return "idle";
}

json entryOf(const ExperimentDigest& experiment) {
  const ExperimentTiming& timing = experiment.timing;
  return {{"id", experiment.id},
          {"samples", experiment.samples},
          {"sample_time", experiment.sample_time},
          {"reason", experiment.rejected},
          {"lost", timing.input.lost + timing.output.lost},
          {"jitter", timing.output.jitter}};  // NaN becomes null
}

}  // namespace

std::string liveStatus(const LiveStatus& status, const Progress* progress) {
  const WorkerStatus& worker = status.node.worker;
  json problems = status.recorder.problems;
  if (!status.node.store_problem.empty()) problems.push_back(status.node.store_problem);
  json running = json::array();
  for (const Activity& activity : status.node.running)
    running.push_back({{"what", activity.what}, {"seconds", status.now - activity.since}});
  json document = {{"state", nameOf(stateOf(status.node, status.recorder))},
                   {"recording", status.recorder.running},
                   {"message", worker.message},
                   {"problems", problems},
                   {"running", running},
                   {"waiting_requests", status.node.waiting_requests},
                   {"waiting_experiments", worker.queue},
                   {"sequence", status.node.sequence},
                   {"progress", nullptr}};
  if (progress != nullptr && worker.busy)
    document["progress"] = {{"phase", progress->phase}, {"fraction", progress->fraction}};
  return inOneLine(document);
}

std::string liveExperiments(const std::vector<ExperimentDigest>& experiments) {
  json kept = json::array(), rejected = json::array();
  std::size_t all = 0, unused = 0;
  for (auto one = experiments.rbegin(); one != experiments.rend(); ++one) {
    ++all;
    if (!one->rejected.empty()) ++unused;
    json& list = one->sample_time > 0 ? kept : rejected;
    if (list.size() < kMostListed) list.push_back(entryOf(*one));
  }
  return inOneLine({{"kept", kept}, {"rejected", rejected}, {"count", all}, {"unused", unused}});
}

std::string liveResult(const Result& result, const ResultContext& context) {
  const json all = toJson(result);
  json document =
      someOf(all, {"version", "termination", "message", "warnings", "trust", "variation",
                   "physical", "runs", "validation", "residual_tests", "origin"});
  document["experiments"] = someOf(all["experiments"], {"count", "samples", "rejected"});
  document["experiments"]["estimates"] = json::array();
  for (const json& one : all["experiments"]["estimates"])
    document["experiments"]["estimates"].push_back(someOf(one, {"samples"}));
  document["nominal_model"] = someOf(all["nominal_model"], {"sample_time"});
  document["bounds"] = someOf(all["bounds"], {"warnings"});
  document["sequence"] = context.sequence;
  document["preliminary"] = context.preliminary;
  return inOneLine(document);
}

std::string liveExplanation(const Explanation& explanation) {
  return inOneLine(someOf(toJson(explanation),
                          {"verdict", "causes", "checks_before", "checks_after", "warnings"}));
}

}  // namespace uncertainty_identification
