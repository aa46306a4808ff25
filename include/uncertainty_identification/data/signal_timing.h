#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>

namespace uncertainty_identification {

struct StampedSignal;

/// How a sample came: when, and how many before it did not.
struct Arrival {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s] NaN: not known
  long lost = 0;  ///< messages missing between the one before and this one
};

/// What stamps, arrivals and sequence numbers tell about the samples of a signal in one experiment.
/// NaN where it is not known.
struct SignalTiming {
  double age = std::numeric_limits<double>::quiet_NaN();  ///< [s] of the newest sample on arrival
  /// [s] smallest arrival minus stamp: the quickest transport and what the clock that stamps is
  /// behind the one that receives
  double delay = std::numeric_limits<double>::quiet_NaN();
  /// [s] largest departure of a stamp from a uniform grid; NaN where they follow none
  double jitter = std::numeric_limits<double>::quiet_NaN();
  long lost = 0;  ///< messages that are missing in the sequence
};

/// Age, delay and losses; the jitter is fitSampleGrid's.
SignalTiming timingOf(const StampedSignal& signal);

/// The timing of an experiment.
struct ExperimentTiming {
  SignalTiming input, output;

  /// [s] by how much the output's stamps are ahead of the input's, were both transported equally
  /// quickly at best: the difference of the lower envelopes of arrival minus stamp. A difference of
  /// the transports cannot be told from one of the clocks, and the samples themselves tell
  /// neither: to them it is dead time of the plant.
  double clockOffset() const { return input.delay - output.delay; }
};

/// Counts what is missing in the sequence numbers of messages, which each publisher counts for
/// itself. A number that does not rise tells nothing: a publisher that was started again, or one
/// that does not number.
class SequenceCounter {
 public:
  /// How many messages of the publisher are missing before this one.
  long missingBefore(const std::string& publisher, std::uint32_t sequence);

 private:
  std::map<std::string, std::uint32_t> last_;  // by publisher
};

}  // namespace uncertainty_identification
