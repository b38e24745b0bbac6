// Counts values that are NaN or infinite. A check that reads such a value fails, and its text says so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace canhil::checks {

class NotFinite {
 public:
  /// Takes the value or values of one answer, in order of time.
  void take(std::int64_t t_us, double value, double other = 0);
  /// "3 of 100 answers are not a number (NaN or infinite), first at 5.2 s"; empty: all values are finite.
  /// `of`: the number of answers. `what`: "answers". `to_go`: the times are minus the time to go.
  [[nodiscard]] std::string to_text(std::size_t of, std::string_view what = "answers",
                                    bool to_go = false) const;

 private:
  std::size_t count_ = 0;
  std::int64_t first_us_ = 0;
};

}  // namespace canhil::checks
