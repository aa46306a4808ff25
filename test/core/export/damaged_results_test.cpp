// Results of which a part was replaced or removed, as a bad disk or another program may leave them,
// are refused or exported, but end no program.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "export/targets.h"
#include "io/printable.h"
#include "support/export_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

/// A part of the tree, most of the time not a number of a long list.
json* partOf(json* tree, std::mt19937_64* random) {
  while (tree->is_structured() && !tree->empty() && (*random)() % 8 != 0) {
    auto child = tree->begin();
    std::advance(child, static_cast<long>((*random)() % tree->size()));
    tree = &*child;
  }
  return tree;
}

std::string damaged(json tree, std::mt19937_64* random) {
  const std::vector<json> others{nullptr,
                                 json::array(),
                                 json::object(),
                                 -1,
                                 0,
                                 1e300,
                                 "\" */ \"\"\"\n@ \\",
                                 {1, 2},
                                 json::array({json::array({1})})};
  json* part = partOf(&tree["nominal_model"], random);
  switch ((*random)() % 4) {
    case 0:
      part = partOf(&tree, random);
      break;
    case 1:
      part = partOf(&tree["bounds"], random);
      break;
    case 2:
      part = partOf(&tree["error_model"], random);
      break;
    default:
      break;
  }
  *part = others[(*random)() % others.size()];
  return tree.dump();
}

/// Whether it could be exported; the text formats hold no byte that is no text.
bool exportsOrRefuses(const std::string& path) {
  try {
    const ExportedModel model = exportedModel(loadResult(path), "motor", 2, 1);
    EXPECT_EQ(matFile(model).size() % 8, 0u);
    for (const auto& write : {pythonModule, octaveFunction, rosParameters, cSource}) {
      std::string text = write(model);
      text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
      EXPECT_TRUE(isPrintable(text));
    }
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(DamagedResults, AreRefusedOrExported) {
  json tree = toJson(test::delayedResult());
  tree["physical"] = {{"sentence", "A plant."}, {"numbers", json::array()}};
  std::mt19937_64 random(11);
  int exported = 0, refused = 0;
  for (int k = 0; k < 120; ++k) {
    const test::WrittenFile file("result.json", damaged(tree, &random));
    ++(exportsOrRefuses(file.path()) ? exported : refused);
  }
  EXPECT_GT(exported, 15);
  EXPECT_GT(refused, 15);
}

}  // namespace
}  // namespace uncertainty_identification
