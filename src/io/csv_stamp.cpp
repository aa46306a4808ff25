#include "io/csv_stamp.h"

#include <array>
#include <cctype>
#include <string>
#include <utility>

#include "io/grouped_number.h"

namespace uncertainty_identification {
namespace {

constexpr std::int64_t kNanoseconds = 1000000000;
constexpr int kDigitsOfFraction = 9;  // further ones are left out
constexpr int kShortYears = 2000;     // 24 is 2024

int daysOf(int year, int month) {
  static constexpr std::array<int, 12> kDays = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2 && leap ? 29 : kDays[static_cast<std::size_t>(month) - 1];
}

/// Takes the text of a cell piece by piece from its beginning. What takes nothing returns false.
class StampScanner {
 public:
  explicit StampScanner(const CsvCell& cell) : at_(cell.begin), end_(cell.end) {}

  std::optional<CsvStamp> run() {
    const bool has_date = startsWithDate();
    if (has_date && !date()) return std::nullopt;
    if (has_date && at_ < end_) {
      if (!take('T') && !take('t') && !take(',') && *at_ != ' ') return std::nullopt;
      blanks();
    } else if (has_date) {
      return stamp_;
    }
    if (!timeOfDay(has_date) || at_ != end_) return std::nullopt;
    return stamp_;
  }

 private:
  /// A first number that is followed by a separator of dates.
  bool startsWithDate() const {
    const char* at = at_;
    while (at < end_ && isDigit(*at)) ++at;
    return at < end_ && at > at_ && *at != ':';
  }

  bool take(char character) {
    const bool taken = at_ < end_ && *at_ == character;
    if (taken) ++at_;
    return taken;
  }

  void blanks() {
    while (take(' ')) continue;
  }

  bool word(const char* text) {
    const char* at = at_;
    for (; *text != '\0'; ++text, ++at)
      if (at >= end_ || std::toupper(static_cast<unsigned char>(*at)) != *text) return false;
    at_ = at;
    return true;
  }

  /// A number of at most `most` digits, and how many these are.
  int number(int most, int& value) {
    int digits = 0;
    value = 0;
    for (; at_ < end_ && isDigit(*at_) && digits < most; ++at_, ++digits)
      value = 10 * value + (*at_ - '0');
    return digits;
  }

  bool monthName(int& month) {
    static constexpr std::array<const char*, 12> kNames = {
        "JAN", "FEB", "MAR", "APR", "MAY", "JUN", "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (!word(kNames[i])) continue;
      month = static_cast<int>(i) + 1;
      return true;
    }
    return false;
  }

  bool date() {
    int first = 0, second = 0, third = 0;
    const int digits = number(4, first);
    if (at_ == end_) return false;
    const char separator = *at_++;
    if (separator != '-' && separator != '/' && separator != '.' && separator != ' ') return false;
    const bool named = monthName(second);
    if ((!named && (separator == ' ' || number(2, second) == 0)) || !take(separator)) return false;
    const int last_digits = number(4, third);
    if (digits == 4 && last_digits > 0 && last_digits < 3 && !named)
      return setDate(DateOrder::stated, first, second, third);
    const bool short_year = last_digits == 2 && separator == '.';
    if (digits > 2 || (last_digits != 4 && !short_year)) return false;
    if (short_year) third += kShortYears;
    if (named || separator == '.') return setDate(DateOrder::stated, third, second, first);
    if (first > 12) return setDate(DateOrder::day_first, third, second, first);
    if (second > 12) return setDate(DateOrder::month_first, third, first, second);
    return setDate(DateOrder::open, third, first, second);
  }

  bool setDate(DateOrder order, int year, int month, int day) {
    stamp_.order = order;
    stamp_.year = year;
    stamp_.month = month;
    stamp_.day = day;
    return month >= 1 && month <= 12 && day >= 1 && day <= daysOf(year, month);
  }

  bool timeOfDay(bool has_date) {
    int hours = 0, minutes = 0, seconds = 0;
    if (number(2, hours) == 0 || !take(':') || number(2, minutes) != 2) return false;
    const bool has_seconds = take(':');
    if (has_seconds && number(2, seconds) != 2) return false;
    const bool has_fraction = at_ < end_ && (*at_ == '.' || *at_ == ',');
    // Spreadsheets show 00:12:34.5 as 12:34.5.
    if (!has_seconds && has_fraction) seconds = minutes, minutes = hours, hours = 0;
    std::int64_t fraction = 0;
    if (has_fraction && !fractionOfSecond(fraction)) return false;
    if (hours > 23 || minutes > 59 || seconds > 60) return false;  // 60: a leap second
    blanks();
    const bool has_half = halfOfDay(hours);
    stamp_.is_open = !has_date && !has_seconds && !has_fraction && !has_half;
    stamp_.nanoseconds = ((hours * 60LL + minutes) * 60 + seconds) * kNanoseconds + fraction;
    return at_ == end_ || zone();
  }

  bool fractionOfSecond(std::int64_t& nanoseconds) {
    ++at_;
    int digits = 0;
    for (; at_ < end_ && isDigit(*at_); ++at_, ++digits)
      if (digits < kDigitsOfFraction) nanoseconds = 10 * nanoseconds + (*at_ - '0');
    for (int i = digits; i < kDigitsOfFraction; ++i) nanoseconds *= 10;
    return digits > 0;
  }

  /// AM or PM; 12 AM is midnight.
  bool halfOfDay(int& hours) {
    const bool afternoon = word("PM");
    if (!afternoon && !word("AM")) return false;
    hours = hours % 12 + (afternoon ? 12 : 0);
    blanks();
    return true;
  }

  bool zone() {
    stamp_.zone_minutes = 0;
    if (word("Z") || word("UTC") || word("GMT")) return true;
    const bool west = take('-');
    if (!west && !take('+')) return false;
    int hours = 0, minutes = 0;
    if (number(2, hours) != 2) return false;
    const bool has_colon = take(':');
    const int digits = number(2, minutes);
    stamp_.zone_minutes = (west ? -1 : 1) * (60 * hours + minutes);
    return (digits == 2 || (digits == 0 && !has_colon)) && hours < 24 && minutes < 60;
  }

  const char* at_;
  const char* end_;
  CsvStamp stamp_;
};

}  // namespace

std::optional<CsvStamp> parseStamp(const CsvCell& cell) {
  if (cell.end - cell.begin < 5 || !isDigit(*cell.begin)) return std::nullopt;
  return StampScanner(cell).run();
}

// Counts from 1 March, so that the leap day is the last one of a year, in eras of 400 years.
std::int64_t daysSince1970(int year, int month, int day) {
  const std::int64_t y = month <= 2 ? year - 1 : year;
  const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
  const std::int64_t year_of_era = y - 400 * era;
  const std::int64_t day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
         719468;
}

}  // namespace uncertainty_identification
