#include "io/result_binding.h"

namespace uncertainty_identification {

void bind(Archive& archive, PhysicalNumber& number) {
  archive("name", number.name);
  archive("unit", number.unit);
  archive("value", number.value);
  archive("lower_95", orNull(number.lower));
  archive("upper_95", orNull(number.upper));
  archive("spread", orNull(number.spread));
}

void bind(Archive& archive, PhysicalNumbers& physical) {
  archive("sentence", physical.sentence);
  archive("numbers", physical.numbers);
}

void bind(Archive& archive, SimulatedRun& run) {
  archive("id", run.id);
  archive("rank", run.rank);
  archive("validation", run.validation);
  archive("fit_percent", run.fit_percent);
  archive("time_step", run.time_step);
  archive("level", run.level);
  archive("measured", run.measured);
  archive("simulated", run.simulated);
  archive("lower", run.lower);
  archive("upper", run.upper);
}

void bind(Archive& archive, Origin& origin) {
  archive("date", origin.date);
  archive("data", origin.data);
  archive("validation", origin.validation);
}

}  // namespace uncertainty_identification
