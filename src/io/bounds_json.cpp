#include "io/bounds_json.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/estimate_binding.h"
#include "io/result_checks.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

void bind(Archive& archive, UncertaintyBands& bands) {
  archive("mixture", bands.mixture);
  archive("total", bands.total);
}

void bind(Archive& archive, FrequencyBounds& bounds) {
  archive("omega", bounds.omega);
  archive("magnitude", bounds.magnitude);
  archive("phase", bounds.phase);
  archive("magnitude_bands", bounds.magnitude_bands);
  archive("phase_bands", bounds.phase_bands);
  archive("relative_error", bounds.relative_error);
  archive.ifThere("hidden_from", orNull(bounds.hidden_from));
}

void bind(Archive& archive, StepBounds& bounds) {
  archive("time", bounds.time);
  archive("nominal", bounds.nominal);
  archive("bands", bounds.bands);
}

void bind(Archive& archive, ComplexRegion& region) {
  archive("omega", region.omega);
  archive("level", region.level);
  archive("real", region.real);
  archive("imaginary", region.imaginary);
}

void bind(Archive& archive, UncertaintyWeight& weight) {
  archive("level", weight.level);
  archive("level_held", weight.level_held);
  archive("order", weight.order);
  archive("num", weight.num);
  archive("den", weight.den);
  archive.section("continuous", [&weight](Archive& section) {
    section("num", weight.continuous_num);
    section("den", weight.continuous_den);
  });
  archive("omega", weight.omega);
  archive("bound", weight.bound);
  archive("floor", weight.floor);
  archive("over_bounding_median", weight.over_bounding_median);
  archive("over_bounding_max", weight.over_bounding_max);
  archive("check_frequencies", weight.check_frequencies);
  archive("margin", weight.margin);
}

void bind(Archive& archive, FoldModel& fold) {
  archive("delay", fold.delay);
  archive("b", fold.b);
  archive("a", fold.a);
  archive("offset", fold.offset);
}

void bind(Archive& archive, PredictionCalibration& calibration) {
  archive("method", calibration.method);
  archive("levels", calibration.levels);
  archive("guaranteed", calibration.guaranteed);
  archive("radius", calibration.radius);
  archive("model_radius", calibration.model_radius);
  archive("folds", calibration.folds);
  archive("fold", calibration.fold);
  archive("scores", calibration.scores);
  archive("warnings", calibration.warnings);
}

void bind(Archive& archive, Bounds& bounds) {
  archive("levels", bounds.levels);
  archive("samples", bounds.samples);
  archive("seed", bounds.seed);
  archive("frequency", bounds.frequency);
  archive("step", bounds.step);
  archive("regions", bounds.regions);
  archive("warnings", bounds.warnings);
  archive.ifThere("trust", bounds.trust);
  archive("seconds", bounds.seconds);
}

void roundNumbers(nlohmann::json* tree, int digits) {
  if (tree->is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, tree->get<double>());
    *tree = std::strtod(text, nullptr);
  } else if (tree->is_structured()) {
    for (nlohmann::json& entry : *tree) roundNumbers(&entry, digits);
  }
}

nlohmann::json toJson(const Bounds& bounds) {
  nlohmann::json tree = writtenTree(bounds);
  for (const char* key : {"frequency", "step", "regions"}) roundNumbers(&tree[key], 6);
  if (bounds.weight) tree["weight"] = writtenTree(*bounds.weight);
  if (bounds.prediction) tree["prediction"] = writtenTree(*bounds.prediction);
  return tree;
}

Bounds boundsFromJson(const nlohmann::json& json) {
  Bounds bounds = readRecord<Bounds>(json);
  if (json.contains("weight")) bounds.weight = readRecord<UncertaintyWeight>(json["weight"]);
  if (json.contains("prediction"))
    bounds.prediction = readRecord<PredictionCalibration>(json["prediction"]);
  requireConsistent(bounds);
  return bounds;
}

}  // namespace uncertainty_identification
