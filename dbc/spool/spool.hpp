// Append-only series of values in bounded memory, for the data that a run collects.
//
// The first two megabytes are in memory. The rest is in an unnamed mapped file. Pages of the file are loaded
// on access, and all pages are released from time to time. So reading the data of a day needs no more memory
// than reading the data of a minute. A released page is loaded again at the next access. Therefore references
// into a Spool remain valid exactly as long as references into a vector.
#pragma once

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace canhil {

/// An unnamed mapped file in TMPDIR (default /var/tmp). In whatever way the program ends, nothing remains on
/// the disk. If no file can be made, or if the disk is full, ordinary memory is used instead.
class SpoolFile {
 public:
  /// Throws std::bad_alloc if there is no memory.
  SpoolFile();
  ~SpoolFile();
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;

  [[nodiscard]] void* data() const { return data_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// Enlarges the file. The contents remain; the address in data() may change. Throws std::bad_alloc if there
  /// is no memory.
  void grow();
  /// Must be called at each access to the byte `offset`. From time to time, touch() releases all pages.
  /// Thread-safe.
  void touch(std::size_t offset) const {
    const std::size_t block = offset / block_bytes;
    if (block != last_block_.load(std::memory_order_relaxed)) enter(block);
  }
  [[nodiscard]] bool on_disk() const { return file_ >= 0; }

 private:
  static constexpr std::size_t block_bytes = 64 << 10;  // accesses are counted in blocks of this size
  static constexpr unsigned most_blocks = 32;  // all pages are released after so many changes of the block
  static constexpr std::size_t step_bytes = 16 << 20;  // the file grows by this size

  void enter(std::size_t block) const;
  void into_memory(std::size_t bytes);

  int file_ = -1;
  void* data_ = nullptr;
  std::size_t bytes_ = step_bytes;
  mutable std::atomic<std::size_t> last_block_ = 0;
  mutable std::atomic<unsigned> entered_ = 0;
};

/// A container like a vector, but elements can only be added at its end. The type T must be copyable as
/// bytes: a number, a struct of numbers or a matrix of numbers.
template <class T>
class Spool {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  using value_type = T;
  static constexpr std::size_t most_in_memory = std::size_t{2 << 20} / sizeof(T);

  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator() = default;
    Iterator(const Spool* of, std::ptrdiff_t index) : of_(of), place_(index) {}
    reference operator*() const { return (*of_)[static_cast<std::size_t>(place_)]; }
    pointer operator->() const { return &**this; }
    reference operator[](std::ptrdiff_t n) const { return *(*this + n); }
    Iterator& operator+=(std::ptrdiff_t n) { return place_ += n, *this; }
    Iterator& operator-=(std::ptrdiff_t n) { return place_ -= n, *this; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this -= 1; }
    Iterator operator++(int) { return std::exchange(*this, *this + 1); }
    Iterator operator--(int) { return std::exchange(*this, *this - 1); }
    friend Iterator operator+(Iterator a, std::ptrdiff_t n) { return a += n; }
    friend Iterator operator+(std::ptrdiff_t n, Iterator a) { return a += n; }
    friend Iterator operator-(Iterator a, std::ptrdiff_t n) { return a -= n; }
    friend std::ptrdiff_t operator-(const Iterator& a, const Iterator& b) { return a.place_ - b.place_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.place_ == b.place_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.place_ <=> b.place_; }

   private:
    const Spool* of_ = nullptr;
    std::ptrdiff_t place_ = 0;
  };
  using const_iterator = Iterator;

  Spool() = default;
  Spool(std::initializer_list<T> values) { add(values); }
  explicit Spool(const std::vector<T>& values) { add(values); }
  Spool(const Spool& other) { add(other); }
  Spool(Spool&& other) noexcept { swap(other); }
  Spool& operator=(Spool other) noexcept { return swap(other), *this; }
  ~Spool() = default;

  void push_back(const T& value) {
    if (few_.size() < most_in_memory) return few_.push_back(value);
    if (!file_) file_ = std::make_unique<SpoolFile>();
    if ((filed_ + 1) * sizeof(T) > file_->bytes()) file_->grow();
    std::construct_at(static_cast<T*>(file_->data()) + filed_, value);
    file_->touch(filed_++ * sizeof(T));
  }
  /// `count`: the number of elements that are going to be added. Reserves memory for as many of them as a
  /// Spool stores in memory.
  void reserve(std::size_t count) { few_.reserve(std::min(count, most_in_memory)); }

  [[nodiscard]] std::size_t size() const { return few_.size() + filed_; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  const T& operator[](std::size_t index) const {
    if (index < few_.size()) return few_[index];
    file_->touch((index - few_.size()) * sizeof(T));
    return static_cast<const T*>(file_->data())[index - few_.size()];
  }
  T& operator[](std::size_t index) { return const_cast<T&>(std::as_const(*this)[index]); }
  [[nodiscard]] const T& front() const { return (*this)[0]; }
  [[nodiscard]] const T& back() const { return (*this)[size() - 1]; }
  T& back() { return (*this)[size() - 1]; }
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, static_cast<std::ptrdiff_t>(size())}; }
  [[nodiscard]] auto rbegin() const { return std::reverse_iterator(end()); }
  [[nodiscard]] auto rend() const { return std::reverse_iterator(begin()); }

 private:
  void swap(Spool& other) noexcept {
    few_.swap(other.few_);
    file_.swap(other.file_);
    std::swap(filed_, other.filed_);
  }
  template <class Values>
  void add(const Values& values) {
    for (const T& value : values) push_back(value);
  }

  std::vector<T> few_;               // the first elements, in memory
  std::unique_ptr<SpoolFile> file_;  // the file with the other elements
  std::size_t filed_ = 0;
};

}  // namespace canhil
