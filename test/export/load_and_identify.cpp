// The other public layers as a user's program meets them: a configuration file, a data file, a
// result file. load_and_identify CONFIG DATA RESULT

#include <iostream>

#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/result_json.h"
#include "uncertainty_identification/ros/load_data.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  if (argc != 4) {
    std::cerr << "usage: load_and_identify CONFIG DATA RESULT\n";
    return 2;
  }
  const ui::Configuration configuration = ui::loadConfiguration(argv[1]);
  const ui::Estimate estimate =
      ui::Identifier(configuration).identify(ui::loadData({argv[2]}, configuration).experiments);
  ui::saveResult(argv[3], {estimate, ui::computeBounds(estimate)});
  return estimate.usable() ? 0 : 1;
}
