// Series that are read in order of time, although their items, such as the answers of a target, may arrive
// out of order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "dbc/spool/spool.hpp"

namespace canhil {

/// The items with the indices `first` to `last - 1` of a series, by merge sort: in order of time_of(item),
/// and items of the same time in their former order.
template <class T, class TimeOf>
Spool<T> sorted(const Spool<T>& series, std::size_t first, std::size_t last, TimeOf time_of) {
  if (last - first <= Spool<T>::most_in_memory) {
    std::vector<T> part(series.begin() + static_cast<std::ptrdiff_t>(first),
                        series.begin() + static_cast<std::ptrdiff_t>(last));
    std::ranges::stable_sort(part, {}, time_of);
    return Spool<T>(part);
  }
  const std::size_t middle = first + (last - first) / 2;
  const Spool<T> before = sorted(series, first, middle, time_of),
                 after = sorted(series, middle, last, time_of);
  Spool<T> both;
  std::ranges::merge(before, after, std::back_inserter(both), {}, time_of, time_of);
  return both;
}

/// Puts the items of a series into ascending order of time_of(item). Items of the same time keep their order.
/// Only the part of the series that is out of order is sorted.
template <class T, class TimeOf>
void put_in_order(Spool<T>& series, TimeOf time_of) {
  const auto unsorted = std::is_sorted_until(series.begin(), series.end(), [&](const T& a, const T& b) {
    return std::invoke(time_of, a) < std::invoke(time_of, b);
  });
  if (unsorted == series.end()) return;
  const auto earliest = std::invoke(time_of, *std::ranges::min_element(unsorted, series.end(), {}, time_of));
  const auto place = std::ranges::upper_bound(series.begin(), unsorted, earliest, {}, time_of);
  auto index = static_cast<std::size_t>(place - series.begin());
  for (const T& item : sorted(series, index, series.size(), time_of)) series[index++] = item;
}

/// A Spool that is read in ascending order of `time`, which is a member of T or a function of a T. Items of
/// the same time stay in order of arrival. The items are sorted when the series is read, so two threads must
/// not read it for the first time at once.
template <class T, auto time>
class TimeOrdered {
 public:
  using value_type = T;
  using const_iterator = typename Spool<T>::const_iterator;

  TimeOrdered() = default;
  explicit TimeOrdered(const std::vector<T>& items) {
    for (const T& item : items) push_back(item);
  }
  void push_back(const T& item) {
    const auto t = std::invoke(time, item);
    in_order_ = in_order_ && !(latest_ && t < *latest_);
    latest_ = latest_ ? std::max(*latest_, t) : t;
    items_.push_back(item);
    ++revision_;
  }
  /// The latest time of an item that has arrived; none: no item has arrived.
  [[nodiscard]] auto latest() const { return latest_; }
  /// Changes whenever an item is added or may have been changed.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

  [[nodiscard]] const Spool<T>& in_order() const {
    if (!in_order_) put_in_order(items_, time);
    in_order_ = true;
    return items_;
  }
  operator const Spool<T>&() const { return in_order(); }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  const T& operator[](std::size_t index) const { return in_order()[index]; }
  /// The time of the item must not be changed.
  T& operator[](std::size_t index) {
    ++revision_;
    return const_cast<T&>(std::as_const(*this)[index]);
  }
  [[nodiscard]] const T& front() const { return in_order().front(); }
  [[nodiscard]] const T& back() const { return in_order().back(); }
  T& back() { return (*this)[size() - 1]; }
  [[nodiscard]] const_iterator begin() const { return in_order().begin(); }
  [[nodiscard]] const_iterator end() const { return in_order().end(); }

 private:
  using Time = std::remove_cvref_t<std::invoke_result_t<decltype(time), const T&>>;
  mutable Spool<T> items_;
  mutable bool in_order_ = true;
  std::optional<Time> latest_{};
  std::uint64_t revision_ = 0;
};

}  // namespace canhil
