#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

const EnumNames<Verdict>& enumNames(Verdict) {
  static const EnumNames<Verdict> kNames{{Verdict::none, "none"},
                                         {Verdict::explained, "explained"},
                                         {Verdict::partly_explained, "partly_explained"},
                                         {Verdict::unknown, "unknown"}};
  return kNames;
}

}  // namespace uncertainty_identification
