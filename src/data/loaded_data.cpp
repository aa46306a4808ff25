#include "uncertainty_identification/data/loaded_data.h"

#include <iterator>
#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

template <typename T>
void moveInto(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void addResampled(const Recording& recording, double sample_time, const ResamplingOptions& options,
                  LoadedData& data) {
  try {
    ResamplingReport report;
    data.experiments.push_back(resample(recording, sample_time, options, &report));
    for (std::string& warning : report.warnings()) data.warnings.push_back(std::move(warning));
    if (!recording.note.empty()) {
      data.warnings.push_back("experiment '" + recording.id + "': " + recording.note);
    }
  } catch (const DataError& error) {
    data.rejected.push_back({recording.id, error.what()});
  }
}

void append(LoadedData more, LoadedData& data) {
  moveInto(more.experiments, data.experiments);
  moveInto(more.rejected, data.rejected);
  moveInto(more.warnings, data.warnings);
}

}  // namespace uncertainty_identification
