// Lets a test change the data of a run: a Spool itself can only grow.
#pragma once

#include <vector>

namespace canhil::test {

/// All values as a vector. At the end of the expression or loop that changes the values, they are written
/// back to the series.
template <class Series>
class Edited {
 public:
  explicit Edited(Series& of) : of_(of), all_(of.begin(), of.end()) {}
  ~Edited() { of_ = Series(all_); }
  Edited(const Edited&) = delete;
  Edited& operator=(const Edited&) = delete;
  std::vector<typename Series::value_type>& operator*() { return all_; }
  auto begin() { return all_.begin(); }
  auto end() { return all_.end(); }
  /// Removes the values with the indices `from` to `to - 1`.
  void erase(std::ptrdiff_t from, std::ptrdiff_t to) { all_.erase(all_.begin() + from, all_.begin() + to); }

 private:
  Series& of_;
  std::vector<typename Series::value_type> all_;
};

}  // namespace canhil::test
