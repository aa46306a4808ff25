#pragma once

#include <string>
#include <vector>

#include "io/csv_stamp.h"

namespace uncertainty_identification {

/// Where the time column of a file is.
struct CsvTimeColumn {
  std::string path;
  std::size_t column = 0;
  CsvDialect dialect;
  long first_row = 0;  ///< line of the first row
};

/// Reads a time column that holds dates or times of day. Stamps are whole nanoseconds until the
/// first stamp of their experiment has been subtracted, so that no precision is lost.
class CsvDates {
 public:
  explicit CsvDates(CsvTimeColumn column) : column_(std::move(column)) {}

  /// [s] from the first stamp of the experiment, which has this number, to the cell. A time of day
  /// that is more than 12 h earlier than the one before belongs to the next day. If the cell cannot
  /// be read, or could mean two stamps, `problem` says why and what to write.
  double seconds(const CsvCell& cell, std::size_t experiment, std::string& problem);

  /// [s] first stamp of the experiment: since 1970 if there are dates, else since midnight.
  double start(std::size_t experiment) const;

  /// What was assumed, as part of a sentence.
  std::string remark() const;

 private:
  /// An instant in whole numbers.
  struct Instant {
    std::int64_t days = 0, nanoseconds = 0;
  };
  struct Sequence {
    CsvStamp first, last;
    Instant origin;
    std::int64_t midnights = 0;  ///< passed since the first stamp, where there are no dates
    bool begun = false;
  };

  std::string objection(const CsvCell& cell, const CsvStamp& stamp, const Sequence& sequence);
  Instant instantOf(const CsvStamp& stamp, const Sequence& sequence) const;
  void settleOrder(const CsvStamp& stamp);

  CsvTimeColumn column_;
  std::vector<Sequence> sequences_;         ///< by experiment
  DateOrder order_ = DateOrder::none;       ///< none: not settled yet
  std::string proof_;                       ///< the stamp that shows the order
  bool same_day_ = false, rolled_ = false;  ///< order is not needed; a midnight was passed
};

}  // namespace uncertainty_identification
