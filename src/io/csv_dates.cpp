#include "io/csv_dates.h"

#include "io/csv_header.h"

namespace uncertainty_identification {
namespace {

constexpr std::int64_t kPerSecond = 1000000000, kPerDay = 86400 * kPerSecond;

bool sameDate(const CsvStamp& left, const CsvStamp& right) {
  return left.year == right.year && left.month == right.month && left.day == right.day;
}

bool showsOrder(const CsvStamp& stamp) {
  return stamp.order == DateOrder::day_first || stamp.order == DateOrder::month_first;
}

}  // namespace

/// The first stamp of the column with a part above 12 shows the order of all.
void CsvDates::settleOrder(const CsvStamp& stamp) {
  const bool matters = stamp.order == DateOrder::open || showsOrder(stamp);
  if (order_ != DateOrder::none || !matters) return;
  order_ = DateOrder::open;
  CsvLines lines(column_.path);
  std::vector<CsvCell> cells;
  lines.first(1);  // takes off a byte order mark
  while (lines.next()) {
    if (lines.number() < column_.first_row || isCsvRemark(lines.begin(), lines.end())) continue;
    column_.dialect.split(lines.begin(), lines.end(), cells);
    if (column_.column >= cells.size()) continue;
    const auto other = parseStamp(cells[column_.column]);
    if (!other || !showsOrder(*other)) continue;
    order_ = other->order;
    proof_ = cells[column_.column].str() + " in line " + std::to_string(lines.number());
    return;
  }
}

/// Why the stamp cannot be placed in time; empty: it can.
std::string CsvDates::objection(const CsvCell& cell, const CsvStamp& stamp,
                                const Sequence& sequence) {
  const std::string found = "found '" + cell.str() + "', ";
  if (stamp.is_open)
    return found +
           "which could be hours and minutes or minutes and seconds; write 00:12:30 or "
           "12:30:00";
  if (showsOrder(stamp) && stamp.order != order_)
    return found + "but " + proof_ + " has day and month in the other order; write 2024-05-31";
  if (!sequence.begun) return "";
  if ((stamp.order == DateOrder::none) != (sequence.first.order == DateOrder::none))
    return found + "but the first stamp of the experiment has " +
           (stamp.order == DateOrder::none ? "a" : "no") + " date; write all stamps alike";
  if (stamp.zone_minutes.has_value() != sequence.first.zone_minutes.has_value())
    return found + "but the first stamp of the experiment has " +
           (stamp.zone_minutes ? "no" : "an") +
           " offset from UTC, such as Z or +02:00; write it at all stamps or at none";
  if (stamp.order == DateOrder::open && order_ == DateOrder::open &&
      !sameDate(stamp, sequence.first))
    return found +
           "whose day and month cannot be told apart: no stamp of the file has a number above 12 "
           "there; write the year first, as in 2024-05-31";
  return "";
}

CsvDates::Instant CsvDates::instantOf(const CsvStamp& stamp, const Sequence& sequence) const {
  Instant instant{0, stamp.nanoseconds};
  const std::int64_t zone = stamp.zone_minutes.value_or(0);
  instant.nanoseconds -= zone * 60 * kPerSecond;
  if (stamp.order == DateOrder::none) {
    instant.days = sequence.midnights;
  } else if (stamp.order != DateOrder::open) {
    instant.days = daysSince1970(stamp.year, stamp.month, stamp.day);
  } else if (order_ != DateOrder::open) {
    const bool swapped = order_ == DateOrder::day_first;
    instant.days = daysSince1970(stamp.year, swapped ? stamp.day : stamp.month,
                                 swapped ? stamp.month : stamp.day);
  }
  return instant;
}

double CsvDates::seconds(const CsvCell& cell, std::size_t experiment, std::string& problem) {
  const std::optional<CsvStamp> stamp = parseStamp(cell);
  if (!stamp) {
    problem = "found '" + cell.str() +
              "' in a column of dates or times of day; write a stamp such as "
              "2024-05-31T12:00:00.250 or 12:00:00.250";
    return 0;
  }
  settleOrder(*stamp);
  if (experiment >= sequences_.size()) sequences_.resize(experiment + 1);
  Sequence& sequence = sequences_[experiment];
  problem = objection(cell, *stamp, sequence);
  if (!problem.empty()) return 0;
  if (stamp->order == DateOrder::open && order_ == DateOrder::open) same_day_ = true;
  if (sequence.begun && stamp->order == DateOrder::none &&
      stamp->nanoseconds < sequence.last.nanoseconds - kPerDay / 2) {
    ++sequence.midnights;
    rolled_ = true;
  }
  sequence.last = *stamp;
  const Instant instant = instantOf(*stamp, sequence);
  if (!sequence.begun) {
    sequence.first = *stamp;
    sequence.origin = instant;
    sequence.begun = true;
  }
  const auto days = static_cast<long double>(instant.days - sequence.origin.days);
  const auto nanoseconds =
      static_cast<long double>(instant.nanoseconds - sequence.origin.nanoseconds);
  return static_cast<double>((days * kPerDay + nanoseconds) / kPerSecond);
}

double CsvDates::start(std::size_t experiment) const {
  if (experiment >= sequences_.size()) return 0;
  const Instant& origin = sequences_[experiment].origin;
  return static_cast<double>(origin.days) * 86400 +
         static_cast<double>(origin.nanoseconds) / static_cast<double>(kPerSecond);
}

std::string CsvDates::remark() const {
  if (sequences_.empty()) return "";
  const bool dated = sequences_.front().first.order != DateOrder::none;
  std::string text = dated ? "as dates" : "as times of day";
  if (!proof_.empty())
    text += std::string(order_ == DateOrder::day_first ? ", the day" : ", the month") +
            " first as in " + proof_;
  if (same_day_) text += ", of which only the time of day is used, as day and month may be swapped";
  if (rolled_) text += ", a new day beginning where they start again";
  return text;
}

}  // namespace uncertainty_identification
