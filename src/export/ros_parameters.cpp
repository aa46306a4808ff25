#include <cmath>

#include "export/named_array.h"
#include "export/targets.h"

namespace uncertainty_identification {
namespace {

std::string quoted(const std::string& plain) { return "\"" + plainText(plain) + "\""; }

std::string systemLines(const std::string& indent, const ExportedSystems& system) {
  return indent + "num: [" + listText(system.num.row(0).transpose()) + "]\n" + indent + "den: [" +
         listText(system.den.row(0).transpose()) + "]\n";
}

std::string entry(const char* key, const std::optional<double>& value) {
  return value && std::isfinite(*value) ? std::string(", ") + key + ": " + exactText(*value) : "";
}

std::string physicalLines(const PhysicalNumbers& physical) {
  std::string lines;
  for (const PhysicalNumber& number : physical.numbers) {
    if (!std::isfinite(number.value)) continue;
    lines += "    " + identifierText(number.name) + ": {value: " + exactText(number.value) +
             entry("lower_95", number.lower) + entry("upper_95", number.upper) +
             entry("spread", number.spread) + ", unit: " + quoted(number.unit) + "}\n";
  }
  return lines.empty() ? "" : "  physical:\n" + lines;
}

}  // namespace

std::string rosParameters(const ExportedModel& model) {
  std::string text = "# " + model.name + ": rosparam load FILE /" + model.name +
                     "\n# num and den are descending powers of z; num holds the delay.\n";
  for (const std::string& line : model.about) text += "# " + line + "\n";
  for (const std::string& line : model.missing) text += "# Missing: " + line + "\n";
  text += "sample_time: " + exactText(model.sample_time) +
          "\ndelay: " + std::to_string(model.delay) + "\n" + systemLines("", model.plant) +
          "offset_u: " + exactText(model.offset_u) + "\noffset_y: " + exactText(model.offset_y) +
          "\nnoise:\n" + systemLines("  ", model.noise) +
          "  variance: " + exactText(model.noise_variance) + "\n";
  if (model.weight)
    text += "weight:\n" + systemLines("  ", *model.weight) +
            "  level: " + exactText(model.weight_level) + "\n";
  text += std::string("uncertainty:\n  trusted: ") + (model.trust.trusted ? "true" : "false") +
          "\n  reasons: [";
  for (const std::string& reason : model.trust.reasons)
    text += (&reason == &model.trust.reasons.front() ? "" : ", ") + quoted(reason);
  return text + "]\n" + physicalLines(model.physical);
}

}  // namespace uncertainty_identification
