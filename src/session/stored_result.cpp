#include "session/stored_result.h"

#include <utility>

#include "session/checked_json.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

constexpr std::uint64_t kNanoseconds = 1000000000;  // in a second

json publication(const StoredResult& result) {
  const ResultContext& context = result.context;
  const ExperimentWindow& window = context.window;
  return {{"sequence", context.sequence},
          {"stamp", {context.stamp / kNanoseconds, context.stamp % kNanoseconds}},
          {"preliminary", context.preliminary},
          {"window",
           {{"count", window.count},
            {"first", window.first_id},
            {"last", window.last_id},
            {"start", window.start},
            {"end", window.end}}},
          {"configuration", toJson(result.configuration)}};
}

void readPublication(const json& tree, StoredResult& result) {
  ResultContext& context = result.context;
  context.sequence = tree.at("sequence");
  const json& stamp = tree.at("stamp");
  context.stamp =
      stamp.at(0).get<std::uint64_t>() * kNanoseconds + stamp.at(1).get<std::uint64_t>();
  context.preliminary = tree.at("preliminary");
  const json& window = tree.at("window");
  context.window = {window.at("count"), window.at("first"), window.at("last"), window.at("start"),
                    window.at("end")};
  result.configuration = configurationFromJson(tree.at("configuration"));
}

}  // namespace

void saveStoredResult(const std::string& path, const StoredResult& result) {
  json tree = toJson(*result.estimate);
  tree["publication"] = publication(result);
  saveChecked(path, std::move(tree));
}

StoredResult loadStoredResult(const std::string& path) {
  StoredResult result;
  try {
    const json tree = loadChecked(path);
    result.estimate = std::make_shared<const Estimate>(estimateFromJson(tree));
    readPublication(tree.at("publication"), result);
  } catch (const json::exception& error) {
    throw ConfigurationError(path + ": not a result of a node, or truncated: " + error.what());
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(path + ": " + error.what());
  }
  return result;
}

}  // namespace uncertainty_identification
