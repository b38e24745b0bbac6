#include "dbc/logs/asc_date.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "dbc/logs/local_time.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {
namespace {

// A date before 1970 or after this year is not understood. So the time of every event, which is the sum of
// the start of the log and the time since the start, is below 2^63 ns.
constexpr int first_year = 1970, last_year = 2200;

// The beginnings of the months' names. A name matches the first entry with which it begins; an entry is in
// UTF-8 or, for names with an accent, also in Latin-1.
struct Month {
  std::string_view beginning;
  int number;
};
constexpr std::array months{Month{"jan", 1},
                            Month{"ene", 1},
                            Month{"gen", 1},
                            Month{"feb", 2},
                            Month{"fev", 2},
                            Month{"f\xC3\xA9v", 2},
                            Month{"f\xE9v", 2},
                            Month{"mar", 3},
                            Month{"mrz", 3},
                            Month{"m\xC3\xA4r", 3},
                            Month{"m\xE4r", 3},
                            Month{"apr", 4},
                            Month{"avr", 4},
                            Month{"abr", 4},
                            Month{"may", 5},
                            Month{"mai", 5},
                            Month{"mei", 5},
                            Month{"maj", 5},
                            Month{"mrt", 3},
                            Month{"mag", 5},
                            Month{"jun", 6},
                            Month{"juin", 6},
                            Month{"giu", 6},
                            Month{"jul", 7},
                            Month{"juil", 7},
                            Month{"lug", 7},
                            Month{"aug", 8},
                            Month{"ago", 8},
                            Month{"aou", 8},
                            Month{"ao\xC3\xBB", 8},
                            Month{"ao\xFB", 8},
                            Month{"sep", 9},
                            Month{"set", 9},
                            Month{"oct", 10},
                            Month{"okt", 10},
                            Month{"ott", 10},
                            Month{"out", 10},
                            Month{"nov", 11},
                            Month{"dec", 12},
                            Month{"dez", 12},
                            Month{"dic", 12},
                            Month{"d\xC3\xA9"
                                  "c",
                                  12},
                            Month{"d\xE9"
                                  "c",
                                  12}};

std::optional<int> month_of(std::string_view word) {
  std::string small(word);
  std::ranges::transform(small, small.begin(), lower);
  const auto found =
      std::ranges::find_if(months, [&](const Month& month) { return small.starts_with(month.beginning); });
  return found == months.end() ? std::nullopt : std::optional(found->number);
}

struct Date {
  std::optional<int> year, month, day;
  std::optional<int> hour, minute;
  std::optional<std::int64_t> second_ns;
  std::optional<bool> afternoon;
};

// A word such as "08:12:13" or "08:12:13.500".
bool read_clock(std::string_view word, Date& date) {
  const std::size_t first = word.find(':'), second = word.find(':', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return false;
  date.hour = number_of<int>(word.substr(0, first));
  date.minute = number_of<int>(word.substr(first + 1, second - first - 1));
  date.second_ns = time_of(word.substr(second + 1));
  return date.hour && date.minute && date.second_ns;
}

// A word such as "24.11.2026" (day first) or "2026-11-24".
bool read_numeric(std::string_view word, Date& date) {
  const char separator = word.find('-') != std::string_view::npos ? '-' : '.';
  const std::size_t first = word.find(separator), second = word.find(separator, first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return false;
  date.day = number_of<int>(word.substr(0, first));
  date.month = number_of<int>(word.substr(first + 1, second - first - 1));
  date.year = number_of<int>(word.substr(second + 1));
  if (separator == '-') std::swap(date.day, date.year);
  return date.day && date.month && date.year;
}

bool read_word(std::string_view word, Date& date) {
  if (word.find(':') != std::string_view::npos) return !date.hour && read_clock(word, date);
  const bool am = same(word, "am") || same(word, "a.m.") || same(word, "vorm.");
  if (am || same(word, "pm") || same(word, "p.m.") || same(word, "nachm.")) {
    date.afternoon = !am;
    return true;
  }
  std::string_view digits = word;
  while (digits.ends_with('.') || digits.ends_with(',')) digits.remove_suffix(1);
  if (const auto number = number_of<int>(digits)) {
    std::optional<int>& part = digits.size() == 4 ? date.year : date.day;
    if (part) return false;
    part = number;
    return true;
  }
  if (!word.empty() && word[0] >= '0' && word[0] <= '9') return !date.day && read_numeric(word, date);
  // The name of a weekday may be that of a month too (French "mar."), so the last name decides.
  if (const auto month = month_of(word)) date.month = month;
  return true;
}

}  // namespace

std::optional<std::int64_t> date_of(std::span<const std::string_view> words) {
  constexpr std::size_t most = 6;  // weekday, month, day, clock, am or pm, year
  Date date;
  if (words.size() > most ||
      !std::ranges::all_of(words, [&](std::string_view word) { return read_word(word, date); }))
    return std::nullopt;
  const auto within = [](const std::optional<int>& value, int least, int past) {
    return value && least <= *value && *value <= past;
  };
  if (!within(date.year, first_year, last_year) || !within(date.month, 1, 12) || !within(date.day, 1, 31) ||
      !within(date.hour, 0, 23) || !within(date.minute, 0, 59) || *date.second_ns >= 61 * ns_per_s)
    return std::nullopt;
  std::tm when{};
  when.tm_year = *date.year - 1900;
  when.tm_mon = *date.month - 1;
  when.tm_mday = *date.day;
  when.tm_hour = date.afternoon ? *date.hour % 12 + (*date.afternoon ? 12 : 0) : *date.hour;
  when.tm_min = *date.minute;
  return since_1970_s(when) * ns_per_s + *date.second_ns;
}

}  // namespace canhil::logs
