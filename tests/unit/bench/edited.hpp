// Lets a test change the data of a run: a Spool itself can only grow.
#pragma once

#include <vector>

#include "bench/spool/spool.hpp"

namespace canhil::test {

/// All values as a vector. At the end of the expression or loop that changes the values, they are written
/// back to the Spool.
template <class T>
class Edited {
 public:
  explicit Edited(Spool<T>& of) : of_(of), all_(of.begin(), of.end()) {}
  ~Edited() { of_ = Spool<T>(all_); }
  Edited(const Edited&) = delete;
  Edited& operator=(const Edited&) = delete;
  std::vector<T>& operator*() { return all_; }
  auto begin() { return all_.begin(); }
  auto end() { return all_.end(); }
  /// Removes the values with the indices `from` to `to - 1`.
  void erase(std::ptrdiff_t from, std::ptrdiff_t to) { all_.erase(all_.begin() + from, all_.begin() + to); }

 private:
  Spool<T>& of_;
  std::vector<T> all_;
};

}  // namespace canhil::test
